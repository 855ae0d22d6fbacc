/* The "Facts" of balls and of Part II, and the balance of momentum, angular momentum and energy at one state. */
#include "facts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "dynamics.h"
#include "exact.h"
#include "halfspace.h"
#include "hertz.h"
#include "model.h"
#include "operation.h"
#include "state.h"
#include "waviness.h"

static int failed;

static void fact(const char *what, double got, double want, double within)
{
    const int ok = fabs(got - want) <= within;
    printf("%-28s %20.12g, text %16.12g%s\n", what, got, want, ok ? "" : "   DIFFERS");
    failed += !ok;
}

/* Section 18: one roller between displaced rings. */
static void geometry(void)
{
    const double roller[3] = {5e-6, 0.3, 0.0}, rate[3] = {2e-3, 82.7, -675.0};
    const double xi[2] = {50e-6, 20e-6}, vi[2] = {1e-3, -2e-3}, xo[2] = {-4e-6, 3e-6}, vo[2] = {-0.5e-3, 0.4e-3};
    M.Rm = 24.5e-3;
    M.r = 3e-3;
    M.Cr = 10e-6;
    M.outer_gap = 0.0;
    const double e[2] = {cos(0.3), sin(0.3)}, R = M.Rm + roller[0];
    const double V[2] = {rate[0] * e[0] - R * rate[1] * e[1], rate[0] * e[1] + R * rate[1] * e[0]};
    const Meeting in = meet(INNER, roller, rate, xi, vi), out = meet(OUTER, roller, rate, xo, vo);
    fact("delta_in, um", in.delta * 1e6, 38.676845070, 1e-9);
    fact("its rate, mm/s", in.rate * 1e3, -1.276376417, 1e-9);
    fact("s_in, m/s", ring_slip(INNER, &in, V, vi, 60.0 * PI, rate[2]), 0.006407845, 1e-9);
    fact("alpha_in, rad", in.alpha, 0.299822884044, 1e-12);
    fact("delta_out, um", out.delta * 1e6, 7.935119658, 1e-9);
    fact("its rate, mm/s", out.rate * 1e3, 2.024810681, 1e-9);
    fact("s_out, m/s", ring_slip(OUTER, &out, V, vo, 0.0, rate[2]), -0.003712070, 1e-9);
    fact("alpha_out, rad", out.alpha, 0.299834825321, 1e-12);
    fact("A_in, mm", in.ring_arm * 1e3, 21.470661577, 1e-9);
    fact("b_in, mm", in.arm * 1e3, 2.980661577, 1e-9);
    fact("A_out, mm", out.ring_arm * 1e3, 27.503967560, 1e-9);
    fact("b_out, mm", out.arm * 1e3, 2.996032440, 1e-9);
}

/* Section 20: restitution of a free element on a fixed outer raceway. */
static double restitution(double mass, double K, double n, double tau, double speed)
{
    const double h = 1e-9;
    double x = 0.0, v = speed;
    M.n = n;
    M.Kout = K;
    M.tau = tau;
    M.c = 200.0;
    M.roughness = 0.1e-6;
    for (long i = 0; i < 10000000; i++) {
        double k[4], w[4];
        for (int s = 0; s < 4; s++) {
            const double part = s == 0 ? 0.0 : s == 3 ? h : 0.5 * h, y = s ? x + part * w[s - 1] : x;
            double E, Q, stiff;
            w[s] = s ? v + part * k[s - 1] : v;
            healthy(OUTER, y, &E, &Q, &stiff);
            k[s] = y > 0.0 ? -damped(Q, stiff, y, w[s]) / mass : 0.0;
        }
        x += h / 6.0 * (w[0] + 2.0 * w[1] + 2.0 * w[2] + w[3]);
        v += h / 6.0 * (k[0] + 2.0 * k[1] + 2.0 * k[2] + k[3]);
        if (x <= 0.0 && v < 0.0) break;
    }
    return -v / speed;
}

static void impacts(void)
{
    static const struct {
        const char *name;
        double mass, K, n, tau, want[3];
    } cases[] = {{"6205, restitution", 0.002057, 2.68371e10, 1.5, 2.5e-6, {0.88, 0.76, 0.64}},
                 {"NN3007", 0.0013, 8.54e8, 10.0 / 9.0, 2.5e-6, {0.86, 0.64, 0.45}},
                 {"NN3007, printed K", 0.0013, 1.898e8, 10.0 / 9.0, 2.5e-6, {0.88, 0.72, 0.60}},
                 {"6205, c = 200", 0.002057, 2.68371e10, 1.5, -1.0, {0.17, 0.25, 0.33}},
                 {"NN3007, c = 200", 0.0013, 8.54e8, 10.0 / 9.0, -1.0, {0.50, 0.52, 0.55}},
                 {"NN3007, printed K, c = 200", 0.0013, 1.898e8, 10.0 / 9.0, -1.0, {0.28, 0.31, 0.33}}};
    static const double speeds[3] = {0.01, 0.05, 0.2};
    M.profile = STRAIGHT;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        for (int k = 0; k < 3; k++)
            fact(cases[i].name, restitution(cases[i].mass, cases[i].K, cases[i].n, cases[i].tau, speeds[k]),
                 cases[i].want[k], 0.0051);
}

/* Section 17: a 6205 at 0.52. */
static void grooves(void)
{
    double kappa;
    M.r = 3.97e-3;
    M.Ri = 15.55e-3;
    M.Ro = 23.49e-3;
    fact("K_in of a 6205, N/m^1.5", groove_stiffness(INNER, 0.52, 206e9, 0.3, &kappa), 2.53251e10, 5e4);
    fact("its kappa", kappa, 9.3412, 5e-5);
    fact("K_out", groove_stiffness(OUTER, 0.52, 206e9, 0.3, &kappa), 2.68371e10, 5e4);
    fact("its kappa", kappa, 7.2653, 5e-5);
}

int facts(void)
{
    geometry();
    grooves();
    impacts();
    fact("phase, rad", phase(1.0, 0, 2), 4.685884980, 1e-9);
    printf("%d differ\n", failed);
    return failed > 0;
}

static double uniform(void) { return 2.0 * rand() / (double)RAND_MAX - 1.0; }

/* Section 18, "must hold", at a few states about the start, whatever the dampers: the rate of momentum against supports,
 * gravity and load, that of angular momentum about the origin against these, drive and housing; and, where nothing but
 * the supports damps, that of energy (else what is left is the dissipation). Drag is to be 0. */
int balance_of_flows(double *q, double *v)
{
    const size_t n = (size_t)dof;
    double *acc = need(3 * n, sizeof(double)), *ahead = acc + n, *behind = ahead + n;
    srand(1);
    printf("force, N; torque, N m; power, W: sum of sizes and what is left\n");
    for (int trial = 0; trial < 5; trial++) {
        double P[2] = {0, 0}, size = 0.0, L = 0.0, turn = 0.0, power = 0.0, w, W, Tsize = 0.0;
        const double t = 1e-3 * trial, h = 1e-8;
        for (size_t i = 0; i < n; i++) {
            if (i >= (size_t)roller_at(M.total)) {
                q[i] += 3e-4 * uniform();
                v[i] += 0.2 * uniform();
                continue;
            }
            const int angle = i >= 4 + 3 * (size_t)M.rows ? (i - 4 - 3 * (size_t)M.rows) % 3 : (i - 4) % 3 == 2 ? 1 : 0;
            q[i] += i < 4 || !angle ? 5e-6 * uniform() : 1e-3 * uniform();
            v[i] += i < 4 || !angle ? 2e-3 * uniform() : 1.0 * uniform();
        }
        drive(t, &w, &W);
        exact_accelerations(t, q, v, acc, 1);
        const double mass[2] = {M.mi, M.mo}, k[2] = {M.ki, M.ko};
        double outside[4]; /* supports, gravity and load on both rings */
        ring_forces(t, q, v, outside, outside + 2);
        for (int g = 0; g < 2; g++)
            for (int a = 0; a < 2; a++) {
                const int i = 2 * g + a;
                const double left = mass[g] * acc[i] - outside[i], arm = q[2 * g + 1 - a];
                P[a] += left;
                size += fabs(left);
                L += (a ? 1.0 : -1.0) * arm * left;
                power += (left - k[g] * q[i]) * v[i]; /* the support's spring is in the potential */
            }
        for (int g = 0; g < 2 && M.tilting; g++) {
            const int p = tilt_at(g);
            const double spin = g == 0 ? M.Ip * w : 0.0, out = M.load_offset * ramp_factor(t);
            const double on = g == 1 && M.load_outer ? -out : g == 0 && !M.load_outer ? out : 0.0;
            double left[2]; /* less the support's springs and dampers, the load and the gyroscope */
            for (int a = 0; a < 2; a++)
                left[a] = M.Jring[g] * acc[p + a] + M.tilt_stiffness[g] * q[p + a] + M.tilt_damping[g] * v[p + a]
                          + (a ? -1.0 : 1.0) * spin * v[p + 1 - a] - on * M.load[a];
            L += q[p] * left[1] - q[p + 1] * left[0];
            for (int a = 0; a < 2; a++) power += (left[a] - M.tilt_stiffness[g] * q[p + a]) * v[p + a];
        }
        for (int row = 0; row < M.rows; row++) {
            const int p = cage_at(row);
            const double A[2] = {acc[p] - M.g[0], acc[p + 1] - M.g[1]};
            P[0] += M.mc * A[0];
            P[1] += M.mc * A[1];
            L += M.mc * (q[p] * A[1] - q[p + 1] * A[0]) + M.Ic * acc[p + 2];
            power += M.mc * (v[p] * A[0] + v[p + 1] * A[1]) + M.Ic * v[p + 2] * acc[p + 2];
        }
        for (int j = 0; j < M.total; j++) {
            const int p = roller_at(j);
            const double R = M.Rm + q[p], e[2] = {cos(q[p + 1]), sin(q[p + 1])}, A[2] = {detail[j].ax - M.g[0], detail[j].ay - M.g[1]};
            if (M.tilting) power += M.Jr * v[beta_at(j)] * acc[beta_at(j)];
            const double V[2] = {v[p] * e[0] - R * v[p + 1] * e[1], v[p] * e[1] + R * v[p + 1] * e[0]};
            P[0] += M.m * A[0];
            P[1] += M.m * A[1];
            size += M.m * hypot(A[0], A[1]);
            turn = M.m * R * (e[0] * A[1] - e[1] * A[0]) + M.Ir * acc[p + 2];
            L += turn;
            Tsize += fabs(turn);
            power += M.m * (V[0] * A[0] + V[1] * A[1]) + M.Ir * v[p + 2] * acc[p + 2];
        }
        for (size_t i = 0; i < n; i++) { ahead[i] = q[i] + h * v[i]; behind[i] = q[i] - h * v[i]; }
        const double dE = (potential(t + h, ahead) - potential(t - h, behind)) / (2.0 * h);
        printf("%10.3e %9.1e  %10.3e %9.1e  %10.3e %9.1e\n", size, hypot(P[0], P[1]), Tsize, L - inner_torque - outer_torque,
               dE, power + dE - inner_torque * w);
    }
    free(acc);
    return 0;
}
