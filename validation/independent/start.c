/* The state at t = 0, section 9. */
#include "start.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "contacts.h"
#include "dynamics.h"
#include "model.h"
#include "operation.h"
#include "state.h"

/* Radial balance of one roller between ring shifts a, b along its normal: Q_in + push = Q_out.
 * The left side falls and the right one rises with r_j, so bisection cannot fail. */
static double settle_roller(int row, int j, double a, double b, double push, double *Qin, double *Qout,
                            double *kin, double *kout)
{
    const double th = pocket_angle(row, j);
    double lo = fmin(b + M.outer_gap, a - M.Cr) - 1e-4, hi = fmax(b + M.outer_gap, a - M.Cr) + 1e-4;
    Elastic ein, eout;
    for (int it = 0; it < 200; it++) {
        const double r = 0.5 * (lo + hi);
        ein = elastic_law(INNER, row, j, th, 0.0, 0.0, a - r - M.Cr, 0);
        eout = elastic_law(OUTER, row, j, th, 0.0, 0.0, r - b - M.outer_gap, 0);
        if (ein.elastic + push > eout.elastic) lo = r;
        else hi = r;
    }
    const double r = 0.5 * (lo + hi);
    ein = elastic_law(INNER, row, j, th, 0.0, 0.0, a - r - M.Cr, 1);
    eout = elastic_law(OUTER, row, j, th, 0.0, 0.0, r - b - M.outer_gap, 1);
    *Qin = ein.elastic;
    *Qout = eout.elastic;
    *kin = ein.stiffness;
    *kout = eout.stiffness;
    return r;
}

/* Residual force on the rings and its (negative) Jacobian. */
static double balance(const double *x, double w, double *F, double J[4][4], double *r)
{
    const double zero[4] = {0, 0, 0, 0};
    ring_forces(0.0, x, zero, F, F + 2);
    memset(J, 0, 16 * sizeof(double));
    J[0][0] = J[1][1] = M.ki;
    J[2][2] = J[3][3] = M.ko;
    for (int row = 0; row < M.rows; row++)
        for (int j = 0; j < M.Z; j++) {
            const double th = pocket_angle(row, j), e[2] = {cos(th), sin(th)};
            const double push = M.m * M.Rm * w * w + M.m * (M.g[0] * e[0] + M.g[1] * e[1]);
            double Qin, Qout, kin, kout;
            r[row * M.Z + j] = settle_roller(row, j, e[0] * x[0] + e[1] * x[1], e[0] * x[2] + e[1] * x[3], push,
                                             &Qin, &Qout, &kin, &kout);
            const double ks = kin + kout > 0.0 ? kin * kout / (kin + kout) : 0.0;
            for (int a = 0; a < 2; a++) {
                F[a] -= Qin * e[a];
                F[2 + a] += Qout * e[a];
                for (int b = 0; b < 2; b++) {
                    J[a][b] += ks * e[a] * e[b];
                    J[2 + a][2 + b] += ks * e[a] * e[b];
                    J[a][2 + b] -= ks * e[a] * e[b];
                    J[2 + a][b] -= ks * e[a] * e[b];
                }
            }
        }
    return sqrt(F[0] * F[0] + F[1] * F[1] + F[2] * F[2] + F[3] * F[3]);
}

static void solve4(double A[4][4], double *b)
{
    for (int i = 0; i < 4; i++) {
        int p = i;
        for (int k = i + 1; k < 4; k++)
            if (fabs(A[k][i]) > fabs(A[p][i])) p = k;
        if (A[p][i] == 0.0) die("singular static balance", "");
        for (int c = 0; c < 4; c++) { const double x = A[i][c]; A[i][c] = A[p][c]; A[p][c] = x; }
        { const double x = b[i]; b[i] = b[p]; b[p] = x; }
        for (int k = i + 1; k < 4; k++) {
            const double f = A[k][i] / A[i][i];
            for (int c = i; c < 4; c++) A[k][c] -= f * A[i][c];
            b[k] -= f * b[i];
        }
    }
    for (int i = 3; i >= 0; i--) {
        for (int c = i + 1; c < 4; c++) b[i] -= A[i][c] * b[c];
        b[i] /= A[i][i];
    }
}

static void equilibrium(double *q, double w)
{
    double x[4] = {0, 0, 0, 0}, F[4], J[4][4], *r = need((size_t)M.total, sizeof(double));
    double size = balance(x, w, F, J, r);
    for (int it = 0; it < 500 && size > 1e-9; it++) {
        double d[4], y[4], best = size, damp = 1.0;
        memcpy(d, F, sizeof d);
        solve4(J, d);
        for (int half = 0; half < 40; half++, damp *= 0.5) {
            for (int a = 0; a < 4; a++) y[a] = x[a] + damp * d[a];
            best = balance(y, w, F, J, r);
            if (best < size) break;
        }
        if (!(best < size)) break;
        memcpy(x, y, sizeof x);
        size = best;
    }
    size = balance(x, w, F, J, r);
    fprintf(stderr, "static balance: residual %.3e N; rings %.9e %.9e %.9e %.9e m\n", size, x[0], x[1], x[2], x[3]);
    if (!(size < 1e-6)) die("static balance not found", "");
    memcpy(q, x, sizeof x);
    for (int k = 0; k < M.total; k++) q[roller_at(k)] = r[k];
    free(r);
}

void begin(double *q, double *v)
{
    double w, W;
    drive(0.0, &w, &W);
    const double orbit = w * M.Ri / (2.0 * M.Rm);
    memset(q, 0, sizeof(double) * (size_t)dof);
    memset(v, 0, sizeof(double) * (size_t)dof);
    q[0] = q[1] = q[2] = q[3] = 1e-6;
    if (M.reference) {
        if (!M.load_outer) q[2] = q[3] = 0.0; /* rigidly mounted */
        if (M.start == START_EQUILIBRIUM) die("equilibrium of the lumped model", "is not offered here");
        q[0] += M.perturb;
        return;
    }
    const int moving = M.start != START_REST;
    for (int row = 0; row < M.rows; row++) {
        if (moving) v[cage_at(row) + 2] = orbit;
        for (int j = 0; j < M.Z; j++) {
            const int p = roller_at(row * M.Z + j);
            q[p + 1] = pocket_angle(row, j);
            if (moving) {
                v[p + 1] = orbit;
                v[p + 2] = -(w * M.Ri - M.Rm * orbit) / M.r;
            }
        }
    }
    if (M.start == START_EQUILIBRIUM) equilibrium(q, orbit);
    q[0] += M.perturb;
}
