/* The lumped model. */
#include "lumped.h"

#include <math.h>
#include <string.h>

#include "contacts.h"
#include "defects.h"
#include "dynamics.h"
#include "model.h"
#include "operation.h"
#include "state.h"

/* Section 10: kinematic cage, contacts in series; only the rings move. */
void reference_accelerations(double t, const double *q, const double *v, double *acc, int want)
{
    double wi, W, Fi[2], Fo[2];
    drive(t, &wi, &W);
    ring_forces(t, q, v, Fi, Fo);
    if (M.load_outer)
        for (int a = 0; a < 2; a++) Fo[a] += M.ko * q[2 + a] + M.co * v[2 + a]; /* no support */
    const double dth = wi * M.Ri / (2.0 * M.Rm), turn = W * M.Ri / (2.0 * M.Rm);
    const double spin = -W * M.Ri / (2.0 * M.r); /* the pure-rolling angle */
    for (int row = 0; row < M.rows; row++)
        for (int j = 0; j < M.Z; j++) {
            const double th = pocket_angle(row, j) + turn;
            const double ex = cos(th), ey = sin(th), tx = -ey, ty = ex;
            const double x = q[0] - q[2], y = q[1] - q[3];
            double delta = ex * x + ey * y - M.Cr - M.outer_gap;
            const double dd = ex * (v[0] - v[2]) + ey * (v[1] - v[3]) + dth * (tx * x + ty * y);
            double g[2] = {1.0, 1.0}, depth[2] = {0.0, 0.0}, length[2] = {M.L, M.L};
            for (int side = OUTER; side <= INNER; side++)
                for (int i = 0; i < M.defects; i++) {
                    double u, Ls, h;
                    if (!local_angle(&M.defect[i], side, row, j, th, spin, W, &u)) continue;
                    if (M.element == ELEMENT_BALL) {
                        if (depth_at_bottom(&M.defect[i], u, &h)) depth[side] = fmax(depth[side], h);
                        continue;
                    }
                    if (!defect_at(&M.defect[i], u, &Ls, &h)) continue;
                    if (Ls < M.L) g[side] = fmin(g[side], factor(Ls));
                    else depth[side] = fmax(depth[side], h);
                    length[side] = fmin(length[side], M.L - Ls);
                }
            delta -= depth[OUTER] + depth[INNER];
            double Q = 0.0;
            if (delta > 0.0) {
                const double Ks = pow(pow(M.Kin * g[INNER], -1.0 / M.n) + pow(M.Kout * g[OUTER], -1.0 / M.n), -M.n);
                Q = fmax(Ks * pow(delta, M.n) + 0.5 * M.c * dd, 0.0);
            }
            Fi[0] -= Q * ex;
            Fi[1] -= Q * ey;
            Fo[0] += Q * ex;
            Fo[1] += Q * ey;
            if (want) {
                Detail *o = &detail[row * M.Z + j];
                memset(o, 0, sizeof *o);
                o->outer_force = o->inner_force = Q;
                o->outer_length = length[OUTER];
                o->inner_length = length[INNER];
            }
        }
    acc[0] = Fi[0] / M.mi;
    acc[1] = Fi[1] / M.mi;
    acc[2] = M.load_outer ? Fo[0] / M.mo : 0.0;
    acc[3] = M.load_outer ? Fo[1] / M.mo : 0.0;
}
