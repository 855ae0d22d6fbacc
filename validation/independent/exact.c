/* Section 18: full levers, so that momentum, angular momentum and energy close. */
#include "exact.h"

#include <math.h>

#include "dynamics.h"
#include "halfspace.h"
#include "model.h"
#include "operation.h"
#include "state.h"
#include "walls.h"

static const double SPIN_SCALE = 5.0; /* w_0, rad/s, section 22 */

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1]; }
static double cross(const double *a, const double *b) { return a[0] * b[1] - a[1] * b[0]; }
static void add(double *to, double share, const double *a) { to[0] += share * a[0]; to[1] += share * a[1]; }

/* roller: r, theta and their rates. */
Meeting meet(int side, const double *roller, const double *roller_rate, const double *ring, const double *ring_rate)
{
    Meeting m;
    const double e[2] = {cos(roller[1]), sin(roller[1])}, p[2] = {-e[1], e[0]};
    const double a = roller[0] - dot(e, ring), Dr = M.Rm + a, Dt = -dot(p, ring);
    m.rho = hypot(Dr, Dt);
    const double rise = (a * (2.0 * M.Rm + a) + Dt * Dt) / (m.rho + M.Rm);
    for (int k = 0; k < 2; k++) m.n[k] = (Dr * e[k] + Dt * p[k]) / m.rho;
    m.t[0] = -m.n[1];
    m.t[1] = m.n[0];
    m.alpha = roller[1] + atan(Dt / Dr);
    double closing = 0.0;
    for (int k = 0; k < 2; k++)
        closing += m.n[k] * (roller_rate[0] * e[k] + (M.Rm + roller[0]) * roller_rate[1] * p[k] - ring_rate[k]);
    m.delta = side == INNER ? -M.Cr - rise : rise - M.outer_gap;
    m.rate = side == INNER ? -closing : closing;
    m.arm = M.r - 0.5 * m.delta;
    m.ring_arm = side == INNER ? m.rho - m.arm : m.rho + m.arm;
    return m;
}

double ring_slip(int side, const Meeting *m, const double *V, const double *ring_rate, double w, double dphi)
{
    const double along = dot(m->t, ring_rate) - dot(m->t, V) + w * m->ring_arm;
    return side == INNER ? along + dphi * m->arm : along - dphi * m->arm;
}

/* Section 20, or the damping c in its stead. */
double damped(double Q, double K, double x, double rate)
{
    if (M.tau < 0.0) return fmax(Q + M.c * rate, 0.0);
    return fmax(Q + M.tau * x / (x + M.roughness) * fmax(K, 0.0) * rate, 0.0);
}

/* One contact: adds to the element's force and torque, the ring's force and torque; returns Q. */
static double contact(int side, int row, int j, const Meeting *m, double slip, double phi, double W, double dphi,
                      double w, double *F, double *T, double *ring, double *ring_torque)
{
    const Energy e = contact_energy(side, row, j, m->alpha - W, m->alpha + (side == INNER ? PI : 0.0) - phi, m->delta);
    if (e.Q == 0.0 && e.E == 0.0) return 0.0;
    const double Q = damped(e.Q, e.K, e.x, m->rate), f = M.mu * Q * tanh(slip / M.vs);
    const double push = -(e.P_ring + e.P_element) / m->rho, away = side == INNER ? Q : -Q;
    const double couple = M.rolling * M.r * Q * tanh((dphi - w) / SPIN_SCALE);
    const double force[2] = {away * m->n[0] + (f + push) * m->t[0], away * m->n[1] + (f + push) * m->t[1]};
    add(F, 1.0, force);
    add(ring, -1.0, force);
    *T += (side == INNER ? -f : f) * m->arm + e.P_element - couple;
    *ring_torque += -m->ring_arm * f + e.P_ring + couple;
    return Q;
}

typedef struct { double x, u[2], P[2]; } Wall; /* distance, direction towards the wall, where it is met */

static Wall pocket_wall(int row, int j, const double *X, const double *cage, double *ahead)
{
    const double angle = cage[2] + pocket_angle(row, j), e[2] = {cos(angle), sin(angle)}, p[2] = {-e[1], e[0]};
    const double from[2] = {X[0] - cage[0] - M.Rm * e[0], X[1] - cage[1] - M.Rm * e[1]};
    Wall w;
    *ahead = -dot(p, from);
    if (M.pockets == POCKETS_SLOT) {
        w.x = fabs(*ahead);
        for (int k = 0; k < 2; k++) w.u[k] = *ahead > 0.0 ? -p[k] : p[k];
    } else {
        w.x = hypot(from[0], from[1]);
        for (int k = 0; k < 2; k++) w.u[k] = w.x > 0.0 ? from[k] / w.x : e[k];
    }
    for (int k = 0; k < 2; k++) w.P[k] = X[k] + M.r * w.u[k];
    return w;
}

/* Adds to the element's force and torque and to the cage's; returns the force, > 0 where the cage pushes forward. */
static double pocket(int row, int j, const double *X, const double *V, double dphi, const double *cage,
                     const double *cage_rate, double *F, double *T, double *cage_force, double *cage_torque)
{
    double ahead;
    const Wall w = pocket_wall(row, j, X, cage, &ahead);
    const double angle = cage[2] + pocket_angle(row, j), e[2] = {cos(angle), sin(angle)}, p[2] = {-e[1], e[0]};
    const double relative[2] = {V[0] - cage_rate[0], V[1] - cage_rate[1]};
    const double out[2] = {X[0] - cage[0], X[1] - cage[1]};
    double rate;
    if (M.pockets == POCKETS_SLOT) {
        rate = -dot(p, relative) + cage_rate[2] * dot(e, out);
        if (!(ahead > 0.0)) rate = -rate;
    } else rate = dot(w.u, relative) - M.Rm * cage_rate[2] * dot(w.u, p);
    const double N = wall_force(w.x, rate, M.Cp, oil_force());
    if (N == 0.0) return 0.0;
    const double along[2] = {-w.u[1], w.u[0]}, lever[2] = {w.P[0] - cage[0], w.P[1] - cage[1]};
    const double slip = dot(along, relative) + M.r * dphi - cage_rate[2] * dot(w.u, lever);
    const double f = wall_friction(N, slip);
    const double on_cage[2] = {N * w.u[0] + f * along[0], N * w.u[1] + f * along[1]};
    add(F, -1.0, on_cage);
    *T -= M.r * f;
    add(cage_force, 1.0, on_cage);
    *cage_torque += cross(lever, on_cage);
    return M.pockets == POCKETS_SLOT ? (ahead > 0.0 ? N : -N) : -N * dot(w.u, p);
}

static int has_land(void) { return M.guide != GUIDE_NONE || M.pockets == POCKETS_SLOT; }

/* Sections 6 and 21: film and land, on the cage; the guiding ring gets the reaction. */
static void guidance(const double *cage, const double *cage_rate, const double *ring, const double *ring_rate, double wg,
                     double *cage_force, double *cage_torque, double *ring_force, double *ring_torque)
{
    if (!has_land()) return;
    const double e[2] = {cage[0] - ring[0], cage[1] - ring[1]};
    const double v[2] = {cage_rate[0] - ring_rate[0], cage_rate[1] - ring_rate[1]};
    const double size = hypot(e[0], e[1]), n[2] = {size > 0.0 ? e[0] / size : 1.0, size > 0.0 ? e[1] / size : 0.0};
    const double land = wall_force(size, dot(v, n), M.Cg, land_oil_force());
    double F[2] = {-land * n[0], -land * n[1]}, couple = 0.0;
    if (M.guide != GUIDE_NONE) {
        double film[2];
        couple = guidance_film(e, v, cage_rate[2], wg, film);
        add(F, 1.0, film);
    }
    add(cage_force, 1.0, F);
    add(ring_force, -1.0, F);
    *cage_torque += couple;
    *ring_torque -= couple + cross(e, F);
}

void exact_accelerations(double t, const double *q, const double *v, double *acc, int want)
{
    double wi, W, Fi[2], Fo[2], Ti = 0.0, To = 0.0;
    drive(t, &wi, &W);
    ring_forces(t, q, v, Fi, Fo);
    for (int row = 0; row < M.rows; row++) {
        const int c = cage_at(row);
        double Fc[2] = {M.mc * M.g[0], M.mc * M.g[1]}, Tc = 0.0;
        for (int j = 0; j < M.Z; j++) {
            const int k = row * M.Z + j, p = roller_at(k);
            const double e[2] = {cos(q[p + 1]), sin(q[p + 1])}, s[2] = {-e[1], e[0]}, R = M.Rm + q[p];
            const double X[2] = {R * e[0], R * e[1]}, phi = q[p + 2], dphi = v[p + 2];
            const double V[2] = {v[p] * e[0] + R * v[p + 1] * s[0], v[p] * e[1] + R * v[p + 1] * s[1]};
            const double speed = M.Rm * v[p + 1];
            const double area = M.element == ELEMENT_BALL ? PI * M.r * M.r : 2.0 * M.r * M.L;
            double F[2] = {M.m * M.g[0], M.m * M.g[1]}, T = 0.0;
            add(F, -0.5 * M.Cd * M.rho * area * speed * fabs(speed), s);
            const Meeting in = meet(INNER, q + p, v + p, q, v), out = meet(OUTER, q + p, v + p, q + 2, v + 2);
            const double slip_in = ring_slip(INNER, &in, V, v, wi, dphi);
            const double slip_out = ring_slip(OUTER, &out, V, v + 2, 0.0, dphi);
            const double Qin = contact(INNER, row, j, &in, slip_in, phi, W, dphi, wi, F, &T, Fi, &Ti);
            const double Qout = contact(OUTER, row, j, &out, slip_out, phi, 0.0, dphi, 0.0, F, &T, Fo, &To);
            const double push = pocket(row, j, X, V, dphi, q + c, v + c, F, &T, Fc, &Tc);
            acc[p] = dot(e, F) / M.m + R * v[p + 1] * v[p + 1];
            acc[p + 1] = (dot(s, F) / M.m - 2.0 * v[p] * v[p + 1]) / R;
            acc[p + 2] = T / M.Ir;
            if (want) {
                Detail *o = &detail[k];
                o->outer_force = Qout;
                o->inner_force = Qin;
                o->outer_length = o->inner_length = M.L;
                o->pocket = push;
                o->slip_inner = slip_in;
                o->slip_outer = slip_out;
                o->ax = F[0] / M.m;
                o->ay = F[1] / M.m;
                o->orbit_speed = (dot(out.t, V) - dot(out.t, v + 2)) / out.rho;
            }
        }
        const int inside = M.guide == GUIDE_INNER;
        guidance(q + c, v + c, q + (inside ? 0 : 2), v + (inside ? 0 : 2), inside ? wi : 0.0, Fc, &Tc, inside ? Fi : Fo,
                 inside ? &Ti : &To);
        acc[c] = Fc[0] / M.mc;
        acc[c + 1] = Fc[1] / M.mc;
        acc[c + 2] = Tc / M.Ic;
    }
    for (int a = 0; a < 2; a++) {
        acc[a] = Fi[a] / M.mi;
        acc[2 + a] = Fo[a] / M.mo;
    }
    inner_torque = -Ti;
    outer_torque = -To;
}

/* What contacts, walls, land and supports store. */
double potential(double t, const double *q)
{
    double E = 0.5 * M.ki * dot(q, q) + 0.5 * M.ko * dot(q + 2, q + 2), w, W;
    const double rest[3] = {0.0, 0.0, 0.0};
    drive(t, &w, &W);
    for (int row = 0; row < M.rows; row++) {
        const double *cage = q + cage_at(row), *ring = q + (M.guide == GUIDE_INNER ? 0 : 2);
        for (int j = 0; j < M.Z; j++) {
            const double *p = q + roller_at(row * M.Z + j), R = M.Rm + p[0];
            const double X[2] = {R * cos(p[1]), R * sin(p[1])};
            const Meeting in = meet(INNER, p, rest, q, rest), out = meet(OUTER, p, rest, q + 2, rest);
            double ahead;
            E += contact_energy(INNER, row, j, in.alpha - W, in.alpha + PI - p[2], in.delta).E;
            E += contact_energy(OUTER, row, j, out.alpha, out.alpha - p[2], out.delta).E;
            E += wall_energy(pocket_wall(row, j, X, cage, &ahead).x, M.Cp, oil_force());
        }
        if (has_land()) E += wall_energy(hypot(cage[0] - ring[0], cage[1] - ring[1]), M.Cg, land_oil_force());
    }
    return E;
}
