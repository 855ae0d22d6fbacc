"""The equations of motion as a plain loop, compiled by Numba."""

import math

import numpy as np
from numba import njit

PI = math.pi


def make_rhs(p):
    # Numba compiles what it finds here into constants.
    n, dof, rows, rollers, defect_row = p.total, p.dof, p.rows, p.rollers, p.defect_row
    alpha = p.alpha
    Rm, rr, clearance, pocket_clearance = p.pitch_radius, p.roller_radius, p.clearance, p.pocket_clearance
    inner_stiffness, outer_stiffness, exponent, damping = p.inner_stiffness, p.outer_stiffness, p.exponent, p.contact_damping
    friction, slip_velocity, surface = p.friction, p.slip_velocity, p.speed * p.inner_radius
    cage_stiffness, cage_damping = p.cage_stiffness, p.cage_damping
    roller_mass, roller_inertia, cage_mass, cage_inertia = p.roller_mass, p.roller_inertia, p.cage_mass, p.cage_inertia
    inner_mass, outer_mass = p.inner_mass, p.outer_mass
    ki, ci, ko, co = (
        p.support_inner_stiffness,
        p.support_inner_damping,
        p.support_outer_stiffness,
        p.support_outer_damping,
    )
    load_x, load_y, ramp = p.load_x, p.load_y, p.ramp
    psi, depth, half_arc, share = p.defect_angle, p.defect_depth, 0.5 * p.defect_length / p.outer_radius, p.intact_share
    guide_clearance, guide_radius = p.guide_clearance, p.cage_outer_radius
    film = p.viscosity * p.guide_width**3 / p.guide_clearance**2
    twist = 2 * PI * p.viscosity * p.cage_outer_radius**2 * p.guide_width / p.guide_clearance

    @njit(error_model="numpy")
    def rhs(t, y):
        dy = np.empty(2 * dof)
        dy[:dof] = y[dof:]
        xi, yi, xo, yo = y[dof - 4], y[dof - 3], y[dof - 2], y[dof - 1]
        v = y[dof:]
        a = dy[dof:]
        vxi, vyi, vxo, vyo = v[dof - 4], v[dof - 3], v[dof - 2], v[dof - 1]
        load = min(t / ramp, 1.0)
        Fxi = -ki * xi - ci * vxi
        Fyi = -ki * yi - ci * vyi
        Fxo = -ko * xo - co * vxo - load * load_x
        Fyo = -ko * yo - co * vyo - load * load_y
        for row in range(rows):
            c = 3 * n + 3 * row
            xc, yc, thc = y[c], y[c + 1], y[c + 2]
            vxc, vyc, wc = v[c], v[c + 1], v[c + 2]
            Fxc, Fyc, Mc = 0.0, 0.0, 0.0
            for k in range(row * rollers, (row + 1) * rollers):
                r, theta = y[k], y[n + k]
                dr, dtheta, dphi = v[k], v[n + k], v[2 * n + k]
                ex, ey = math.cos(theta), math.sin(theta)

                # Normal contacts, friction.
                din = ex * xi + ey * yi - r - clearance
                dout = r - ex * xo - ey * yo
                Qin, Qout, fin, fout = 0.0, 0.0, 0.0, 0.0
                vt = Rm * dtheta
                if din > 0.0:
                    rate = ex * vxi + ey * vyi + dtheta * (ex * yi - ey * xi) - dr
                    Qin = max(inner_stiffness * din**exponent + damping * rate, 0.0)
                    slip = surface + ex * vyi - ey * vxi - (vt - rr * dphi)
                    fin = friction * Qin * math.tanh(slip / slip_velocity)
                if dout > 0.0:
                    rate = dr - ex * vxo - ey * vyo - dtheta * (ex * yo - ey * xo)
                    total = dout**exponent
                    if row == defect_row:
                        u = theta - psi
                        u -= 2 * PI * math.floor((u + PI) / (2 * PI))
                        if abs(u) <= half_arc:
                            total *= share
                            if dout > depth:
                                total += (1 - share) * (dout - depth) ** exponent
                    Qout = max(outer_stiffness * total + damping * rate, 0.0)
                    slip = ex * vyo - ey * vxo - (vt + rr * dphi)
                    fout = friction * Qout * math.tanh(slip / slip_velocity)

                # Pocket.
                s = Rm * (thc + alpha[k] - theta) + ex * yc - ey * xc
                Fc, fc, sigma = 0.0, 0.0, 0.0
                if abs(s) > pocket_clearance:
                    side = 1.0 if s > 0.0 else -1.0
                    ds = Rm * (wc - dtheta) + ex * vyc - ey * vxc - dtheta * (ex * xc + ey * yc)
                    size = cage_stiffness * (abs(s) - pocket_clearance) + cage_damping * side * ds
                    if size > 0.0:
                        Fc = side * size
                        sigma = -side
                        u = dr - sigma * rr * (dphi - wc) - (ex * vxc + ey * vyc)
                        if u != 0.0:
                            b = abs(u)
                            fc = -math.copysign(((-0.1 + 22.28 * b) * math.exp(-181.46 * b) + 0.1) * size, u)

                # Roller.
                arm = Rm + r
                a[k] = (Qin - Qout + fc) / roller_mass + arm * dtheta * dtheta
                a[n + k] = ((fin + fout + Fc) / roller_mass - 2 * dr * dtheta) / arm
                a[2 * n + k] = (rr * (fout - fin) - sigma * rr * fc) / roller_inertia

                # Reactions.
                Fxi += fin * ey - Qin * ex
                Fyi -= fin * ex + Qin * ey
                Fxo += fout * ey + Qout * ex
                Fyo += Qout * ey - fout * ex
                Fxc += Fc * ey - fc * ex
                Fyc -= Fc * ex + fc * ey
                Mc += sigma * rr * fc - Fc * Rm

            # Cage in the outer ring.
            gx, gy = xc - xo, yc - yo
            e = math.sqrt(gx * gx + gy * gy)
            eps = min(e / guide_clearance, 0.95)
            one = 1 - eps * eps
            root = math.sqrt(one)
            nx, ny = 1.0, 0.0
            if e > 0.0:
                nx, ny = gx / e, gy / e
            ue = guide_radius * wc
            Fn = -film * abs(ue) * eps * eps / (one * one)
            if e > guide_clearance:
                Fn -= cage_stiffness * (e - guide_clearance)
            Ft = PI * film * ue * eps / (4 * one * root)
            fx, fy = Fn * nx - Ft * ny, Fn * ny + Ft * nx
            Fxo -= fx
            Fyo -= fy
            a[c] = (Fxc + fx) / cage_mass
            a[c + 1] = (Fyc + fy) / cage_mass
            a[c + 2] = (Mc - twist * ue / root) / cage_inertia
        a[dof - 4] = Fxi / inner_mass
        a[dof - 3] = Fyi / inner_mass
        a[dof - 2] = Fxo / outer_mass
        a[dof - 1] = Fyo / outer_mass
        return dy

    return rhs
