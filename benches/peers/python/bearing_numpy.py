"""The equations of motion in NumPy, vectorised over the rollers and over both raceways."""

import math

import numpy as np

PI = math.pi


def make_rhs(p):
    n, dof, rows, rollers = p.total, p.dof, p.rows, p.rollers
    # Raceways along the first axis: inner, outer.
    sign = np.array([[1.0], [-1.0]])
    gap = np.array([[p.clearance], [0.0]])
    stiffness = np.array([[p.inner_stiffness], [p.outer_stiffness]])
    surface = np.array([[p.speed * p.inner_radius], [0.0]])
    support_stiffness = np.array([[p.support_inner_stiffness], [p.support_outer_stiffness]])
    support_damping = np.array([[p.support_inner_damping], [p.support_outer_damping]])
    ring_mass = np.array([[p.inner_mass], [p.outer_mass]])
    load = np.array([[0.0, 0.0], [p.load_x, p.load_y]])
    alpha = p.alpha.reshape(rows, rollers)
    damaged = slice(p.defect_row * rollers, (p.defect_row + 1) * rollers)
    half_arc = 0.5 * p.defect_length / p.outer_radius
    Rm, rr, share = p.pitch_radius, p.roller_radius, p.intact_share
    film = p.viscosity * p.guide_width**3 / p.guide_clearance**2
    twist = 2 * PI * p.viscosity * p.cage_outer_radius**2 * p.guide_width / p.guide_clearance
    basis = np.empty((2, n))
    across = np.empty((2, n))

    def rhs(t, y):
        dy = np.empty_like(y)
        dy[:dof] = y[dof:]
        r, theta = y[:n], y[n : 2 * n]
        cage = y[3 * n : dof - 4].reshape(rows, 3)
        ring = y[dof - 4 : dof].reshape(2, 2)
        v = y[dof:]
        dr, dtheta, dphi = v[:n], v[n : 2 * n], v[2 * n : 3 * n]
        dcage = v[3 * n : dof - 4].reshape(rows, 3)
        dring = v[dof - 4 :].reshape(2, 2)
        np.cos(theta, out=basis[0])
        np.sin(theta, out=basis[1])
        across[0] = -basis[1]
        across[1] = basis[0]

        # Normal contacts, friction.
        delta = sign * (ring @ basis - r) - gap
        power = np.maximum(delta, 0.0) ** p.exponent
        u = np.abs((theta[damaged] - p.defect_angle + PI) % (2 * PI) - PI)
        on = np.flatnonzero(u <= half_arc) + damaged.start
        if on.size:
            rest = np.maximum(delta[1, on] - p.defect_depth, 0.0) ** p.exponent
            power[1, on] = share * power[1, on] + (1 - share) * rest
        tangential = dring @ across
        rate = sign * (dring @ basis + dtheta * (ring @ across) - dr)
        Q = np.where(delta > 0.0, np.maximum(stiffness * power + p.contact_damping * rate, 0.0), 0.0)
        slip = tangential + surface - Rm * dtheta + sign * (rr * dphi)
        f = p.friction * Q * np.tanh(slip / p.slip_velocity)
        radial = Q[0] - Q[1]
        push = f[0] + f[1]
        moment = rr * (f[1] - f[0])

        # Pockets: few rollers touch theirs.
        cages = [[0.0, 0.0, 0.0] for _ in range(rows)]
        s = Rm * (cage[:, 2:] + alpha - theta.reshape(rows, rollers))
        s += cage[:, 1:2] * basis[0].reshape(rows, rollers) - cage[:, :1] * basis[1].reshape(rows, rollers)
        s = s.ravel()
        touching = np.flatnonzero(np.abs(s) > p.pocket_clearance)
        if touching.size:
            k, row = touching, touching // rollers
            ex, ey, s = basis[0, k], basis[1, k], s[k]
            xc, yc = cage[row, 0], cage[row, 1]
            vxc, vyc, wc = dcage[row].T
            side = np.sign(s)
            ds = Rm * (wc - dtheta[k]) + ex * vyc - ey * vxc - dtheta[k] * (ex * xc + ey * yc)
            size = np.maximum(p.cage_stiffness * (np.abs(s) - p.pocket_clearance) + p.cage_damping * side * ds, 0.0)
            sigma = np.where(size > 0.0, -side, 0.0)
            Fc = side * size
            u = dr[k] - sigma * rr * (dphi[k] - wc) - (ex * vxc + ey * vyc)
            a = np.abs(u)
            fc = -((-0.1 + 22.28 * a) * np.exp(-181.46 * a) + 0.1) * size * np.sign(u)
            radial[k] += fc
            push[k] += Fc
            moment[k] -= sigma * rr * fc
            forces = zip(row, Fc * ey - fc * ex, -Fc * ex - fc * ey, sigma * rr * fc - Fc * Rm)
            for i, fx, fy, m in forces:
                cages[i][0] += fx
                cages[i][1] += fy
                cages[i][2] += m

        # Rollers.
        acc = dy[dof:]
        arm = Rm + r
        acc[:n] = radial / p.roller_mass + arm * dtheta**2
        acc[n : 2 * n] = (push / p.roller_mass - 2 * dr * dtheta) / arm
        acc[2 * n : 3 * n] = moment / p.roller_inertia

        # Rings.
        F = -(sign * Q) @ basis.T - f @ across.T - support_stiffness * ring - support_damping * dring
        F -= min(t / p.ramp, 1.0) * load

        # Cages in the outer ring.
        xo, yo = ring[1].tolist()
        for i, ((xc, yc, _), (_, _, wc)) in enumerate(zip(cage.tolist(), dcage.tolist())):
            gx, gy = xc - xo, yc - yo
            e = math.hypot(gx, gy)
            eps = min(e / p.guide_clearance, 0.95)
            one = 1 - eps * eps
            root = math.sqrt(one)
            nx, ny = (gx / e, gy / e) if e > 0.0 else (1.0, 0.0)
            ue = p.cage_outer_radius * wc
            Fn = -film * abs(ue) * eps * eps / (one * one)
            if e > p.guide_clearance:
                Fn -= p.cage_stiffness * (e - p.guide_clearance)
            Ft = PI * film * ue * eps / (4 * one * root)
            fx, fy = Fn * nx - Ft * ny, Fn * ny + Ft * nx
            F[1, 0] -= fx
            F[1, 1] -= fy
            at = 3 * n + 3 * i
            acc[at] = (cages[i][0] + fx) / p.cage_mass
            acc[at + 1] = (cages[i][1] + fy) / p.cage_mass
            acc[at + 2] = (cages[i][2] - twist * ue / root) / p.cage_inertia
        acc[dof - 4 :] = (F / ring_mass).ravel()
        return dy

    return rhs
