/* Forces and accelerations of the full model. */
#include "dynamics.h"

#include <math.h>

#include "contacts.h"
#include "model.h"
#include "operation.h"
#include "state.h"

static double traction(double u)
{
    u = fabs(u);
    return (-0.1 + 22.28 * u) * exp(-181.46 * u) + 0.1;
}

/* Forces of supports, gravity and load on both rings. */
void ring_forces(double t, const double *q, const double *v, double *Fi, double *Fo)
{
    const double k = ramp_factor(t);
    for (int a = 0; a < 2; a++) {
        Fi[a] = -M.ki * q[a] - M.ci * v[a] + M.mi * M.g[a];
        Fo[a] = -M.ko * q[2 + a] - M.co * v[2 + a] + M.mo * M.g[a];
        if (M.load_outer) Fo[a] -= k * M.load[a];
        else Fi[a] += k * M.load[a];
    }
}

/* Section 6, the dynamic film's integral by Gauss-Legendre, five points on each panel of the half circle about v*. */
static void pushing_film(double ex, double ey, double vx, double vy, double scale, double *fx, double *fy)
{
    enum { PANELS = 16, POINTS = 5 };
    static const double x[POINTS] = {-0.906179845938663993, -0.538469310105683091, 0.0, 0.538469310105683091,
                                     0.906179845938663993};
    static const double weight[POINTS] = {0.236926885056189088, 0.478628670499366468, 0.568888888888888889,
                                          0.478628670499366468, 0.236926885056189088};
    static double node_cos[PANELS * POINTS], node_sin[PANELS * POINTS], node_weight[PANELS * POINTS];
    if (node_weight[0] == 0.0)
        for (int k = 0; k < PANELS * POINTS; k++) {
            const double angle = PI * ((k / POINTS + 0.5 + 0.5 * x[k % POINTS]) / PANELS - 0.5);
            node_cos[k] = cos(angle);
            node_sin[k] = sin(angle);
            node_weight[k] = 0.5 * PI / PANELS * weight[k % POINTS];
        }
    const double speed = sqrt(vx * vx + vy * vy);
    *fx = *fy = 0.0;
    if (speed == 0.0) return;
    const double ax = vx / speed, ay = vy / speed;
    double sx = 0.0, sy = 0.0;
    for (int k = 0; k < PANELS * POINTS; k++) {
        const double nx = ax * node_cos[k] - ay * node_sin[k], ny = ay * node_cos[k] + ax * node_sin[k];
        const double h = M.Cg - ex * nx - ey * ny, share = node_weight[k] * node_cos[k] / (h * h * h);
        sx += share * nx;
        sy += share * ny;
    }
    *fx = -scale * speed * sx;
    *fy = -scale * speed * sy;
}

/* Section 6 without the land, about a guiding ring at e = x_c - x_g with the rate v: F on the cage; returns M. */
double guidance_film(const double *e, const double *v, double wc, double wg, double *F)
{
    const double size = sqrt(e[0] * e[0] + e[1] * e[1]), eps = fmin(size / M.Cg, 0.95), one = 1.0 - eps * eps;
    const double R1 = M.guide == GUIDE_OUTER ? M.cage_b : M.cage_a, width3 = M.L1 * M.L1 * M.L1, half = 0.5 * (wc + wg);
    if (M.film == FILM_DYNAMIC) {
        const double held = size > 0.0 ? eps * M.Cg / size : 1.0;
        pushing_film(held * e[0], held * e[1], v[0] + half * e[1], v[1] - half * e[0], M.eta * R1 * width3, F, F + 1);
    } else {
        const double nx = size > 0.0 ? e[0] / size : 1.0, ny = size > 0.0 ? e[1] / size : 0.0, ue = 2.0 * R1 * half;
        const double Fn = -M.eta * fabs(ue) * width3 * eps * eps / (M.Cg * M.Cg * one * one);
        const double Ft = PI * M.eta * ue * width3 * eps / (4.0 * M.Cg * M.Cg * one * sqrt(one));
        F[0] = Fn * nx - Ft * ny;
        F[1] = Fn * ny + Ft * nx;
    }
    return -2.0 * PI * M.eta * R1 * (wc - wg) * R1 * R1 * M.L1 / (M.Cg * sqrt(one));
}

/* Section 16: both rings' slopes; N of contacts and guidance comes in, load's, support's and the gyroscope's are added. */
void tilt_rings(double t, const double *q, const double *v, double N[2][2], double w, double *acc)
{
    const double k = ramp_factor(t) * M.load_offset;
    for (int g = 0; g < 2; g++) {
        const int p = tilt_at(g);
        const double H = g == 0 ? M.Ip * w : 0.0;
        for (int a = 0; a < 2; a++) {
            if (g == 1 && M.load_outer) N[g][a] -= k * M.load[a];
            if (g == 0 && !M.load_outer) N[g][a] += k * M.load[a];
            N[g][a] -= M.tilt_stiffness[g] * q[p + a] + M.tilt_damping[g] * v[p + a];
        }
        acc[p] = (N[g][0] - H * v[p + 1]) / M.Jring[g];
        acc[p + 1] = (N[g][1] + H * v[p]) / M.Jring[g];
    }
}

/* Section 8, and 16 where rollers and rings tilt: accelerations of every coordinate. */
void accelerations(double t, const double *q, const double *v, double *acc, int want)
{
    double wi, W, Fi[2], Fo[2];
    drive(t, &wi, &W);
    ring_forces(t, q, v, Fi, Fo);
    double N[2][2] = {{0.0, 0.0}, {0.0, 0.0}}; /* tilting moments on the rings */

    for (int row = 0; row < M.rows; row++) {
        const int c = cage_at(row);
        /* The rings at the row's height: x_i y_i x_o y_o, their rates, and the slopes of the axes. */
        const double Z = row_height(row);
        double x[4], u[4], tau[4] = {0.0, 0.0, 0.0, 0.0}, dtau[4] = {0.0, 0.0, 0.0, 0.0};
        for (int a = 0; a < 4; a++) {
            if (M.tilting) {
                tau[a] = q[tilt_at(0) + a];
                dtau[a] = v[tilt_at(0) + a];
            }
            x[a] = q[a] + Z * tau[a];
            u[a] = v[a] + Z * dtau[a];
        }
        const double xi = x[0], yi = x[1], xo = x[2], yo = x[3], vxi = u[0], vyi = u[1], vxo = u[2], vyo = u[3];
        const double xc = q[c], yc = q[c + 1], thc = q[c + 2];
        const double vxc = v[c], vyc = v[c + 1], wc = v[c + 2];
        double Fcx = M.mc * M.g[0], Fcy = M.mc * M.g[1], Tc = 0.0;

        for (int j = 0; j < M.Z; j++) {
            const int k = row * M.Z + j, p = roller_at(k);
            const double rj = q[p], th = q[p + 1], ph = q[p + 2];
            const double drj = v[p], dth = v[p + 1], dph = v[p + 2];
            const double ex = cos(th), ey = sin(th), tx = -ey, ty = ex;

            /* section 2 */
            const double din = ex * xi + ey * yi - rj - M.Cr;
            const double ddin = ex * vxi + ey * vyi + dth * (tx * xi + ty * yi) - drj;
            const double dout = rj - (ex * xo + ey * yo) - M.outer_gap;
            const double ddout = drj - (ex * vxo + ey * vyo) - dth * (tx * xo + ty * yo);
            double Qin = 0.0, Qout = 0.0, Tin = 0.0, Tout = 0.0, Lin = M.L, Lout = M.L;
            if (M.tilting) {
                const double beta = q[beta_at(k)], dbeta = v[beta_at(k)];
                Qin = sliced_force(INNER, din, ddin, ex * tau[0] + ey * tau[1] - beta,
                                   ex * dtau[0] + ey * dtau[1] + dth * (tx * tau[0] + ty * tau[1]) - dbeta, &Tin);
                Qout = sliced_force(OUTER, dout, ddout, beta - ex * tau[2] - ey * tau[3],
                                    dbeta - ex * dtau[2] - ey * dtau[3] - dth * (tx * tau[2] + ty * tau[3]), &Tout);
                acc[beta_at(k)] = (Tin - Tout) / M.Jr;
            } else if (din > 0.0 || want) {
                const Elastic e = elastic_law(INNER, row, j, th, ph, W, din, 0);
                if (e.elastic > 0.0) Qin = fmax(e.elastic + M.c * ddin, 0.0);
                Lin = e.length;
            }
            if (!M.tilting && (dout > 0.0 || want)) {
                const Elastic e = elastic_law(OUTER, row, j, th, ph, W, dout, 0);
                if (e.elastic > 0.0) Qout = fmax(e.elastic + M.c * ddout, 0.0);
                Lout = e.length;
            }

            /* section 4 */
            const double vt = M.Rm * dth;
            const double sin_ = wi * M.Ri + tx * vxi + ty * vyi - (vt - M.r * dph);
            const double sout = tx * vxo + ty * vyo - (vt + M.r * dph);
            const double fin = Qin > 0.0 ? M.mu * Qin * tanh(sin_ / M.vs) : 0.0;
            const double fout = Qout > 0.0 ? M.mu * Qout * tanh(sout / M.vs) : 0.0;

            /* section 5 */
            const double s = M.Rm * (thc + pocket_angle(row, j) - th) + tx * xc + ty * yc;
            double Fc = 0.0, fc = 0.0, sigma = 0.0;
            if (fabs(s) > M.Cp) {
                const double ds = M.Rm * (wc - dth) + tx * vxc + ty * vyc - dth * (ex * xc + ey * yc);
                if (s > 0.0) Fc = fmax(M.kc * (s - M.Cp) + M.cc * ds, 0.0);
                else Fc = -fmax(M.kc * (-s - M.Cp) - M.cc * ds, 0.0);
                if (Fc != 0.0) {
                    sigma = Fc > 0.0 ? -1.0 : 1.0;
                    const double u = drj - sigma * M.r * (dph - wc) - (ex * vxc + ey * vyc);
                    if (u != 0.0) fc = -traction(u) * fabs(Fc) * (u > 0.0 ? 1.0 : -1.0);
                }
            }

            /* section 7 */
            const double across = M.element == ELEMENT_BALL ? 0.5 * PI * M.r : M.L; /* area over 2 r */
            const double Fd = 0.5 * M.Cd * M.rho * across * (2.0 * M.r) * vt * fabs(vt);

            /* section 8, roller */
            const double R = M.Rm + rj;
            const double radial = Qin - Qout + fc + M.m * (M.g[0] * ex + M.g[1] * ey);
            const double tangential = fin + fout + Fc - Fd + M.m * (M.g[0] * tx + M.g[1] * ty);
            acc[p] = radial / M.m + R * dth * dth;
            acc[p + 1] = (tangential / M.m - 2.0 * drj * dth) / R;
            acc[p + 2] = (M.r * (fout - fin) - sigma * M.r * fc) / M.Ir;

            /* reactions */
            Fi[0] += -Qin * ex - fin * tx;
            Fi[1] += -Qin * ey - fin * ty;
            Fo[0] += Qout * ex - fout * tx;
            Fo[1] += Qout * ey - fout * ty;
            N[0][0] += Z * (-Qin * ex - fin * tx) - Tin * ex;
            N[0][1] += Z * (-Qin * ey - fin * ty) - Tin * ey;
            N[1][0] += Z * (Qout * ex - fout * tx) + Tout * ex;
            N[1][1] += Z * (Qout * ey - fout * ty) + Tout * ey;
            Fcx += -Fc * tx - fc * ex;
            Fcy += -Fc * ty - fc * ey;
            Tc += -Fc * M.Rm + sigma * M.r * fc;

            if (want) {
                Detail *o = &detail[k];
                o->outer_force = Qout;
                o->inner_force = Qin;
                o->outer_moment = Tout;
                o->inner_moment = Tin;
                o->outer_length = Lout;
                o->inner_length = Lin;
                o->pocket = Fc;
                o->slip_inner = sin_;
                o->slip_outer = sout;
                const double ar = radial / M.m, at = tangential / M.m;
                o->ax = ar * ex + at * tx;
                o->ay = ar * ey + at * ty;
            }
        }

        /* section 6 */
        {
            /* Rollers as guides: no film, the outer ring's land alone, damped (docs/src/theory/cage.md). */
            const double eta = M.guide == GUIDE_NONE ? 0.0 : M.eta;
            const int outer = M.guide != GUIDE_INNER;
            const double gx = xc - (outer ? xo : xi), gy = yc - (outer ? yo : yi);
            const double e = sqrt(gx * gx + gy * gy), eps = fmin(e / M.Cg, 0.95);
            const double nx = e > 0.0 ? gx / e : 1.0, ny = e > 0.0 ? gy / e : 0.0;
            const double wg = outer ? 0.0 : wi, R1 = outer ? M.cage_b : M.cage_a;
            const double ue = R1 * (wc + wg), ud = R1 * (wc - wg), one = 1.0 - eps * eps;
            double Fn = -eta * fabs(ue) * M.L1 * M.L1 * M.L1 * eps * eps / (M.Cg * M.Cg * one * one);
            const double Ft = PI * eta * ue * M.L1 * M.L1 * M.L1 * eps / (4.0 * M.Cg * M.Cg * one * sqrt(one));
            const int paper = M.guide != GUIDE_NONE && M.film == FILM_QUASI_STATIC;
            if (paper && e > M.Cg) Fn -= M.kc * (e - M.Cg);
            double fx = Fn * nx - Ft * ny, fy = Fn * ny + Ft * nx;
            if (!paper) {
                const double gvx = vxc - (outer ? vxo : vxi), gvy = vyc - (outer ? vyo : vyi);
                const double half = 0.5 * (wc + wg), held = e > 0.0 ? eps * M.Cg / e : 1.0;
                pushing_film(held * gx, held * gy, gvx + half * gy, gvy - half * gx, eta * R1 * M.L1 * M.L1 * M.L1,
                             &fx, &fy);
                if (e > M.Cg) {
                    const double land = fmax(M.kc * (e - M.Cg) + M.cc * (gvx * nx + gvy * ny), 0.0);
                    fx -= land * nx;
                    fy -= land * ny;
                }
            }
            Fcx += fx;
            Fcy += fy;
            Tc += -2.0 * PI * eta * ud * R1 * R1 * M.L1 / (M.Cg * sqrt(one));
            if (outer) { Fo[0] -= fx; Fo[1] -= fy; }
            else { Fi[0] -= fx; Fi[1] -= fy; }
            N[outer][0] -= Z * fx;
            N[outer][1] -= Z * fy;
        }
        acc[c] = Fcx / M.mc;
        acc[c + 1] = Fcy / M.mc;
        acc[c + 2] = Tc / M.Ic;
    }
    acc[0] = Fi[0] / M.mi;
    acc[1] = Fi[1] / M.mi;
    acc[2] = Fo[0] / M.mo;
    acc[3] = Fo[1] / M.mo;
    if (M.tilting) tilt_rings(t, q, v, N, wi, acc);
}
