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

/* A ring at the height of one row, section 16, and what acts on it there. */
typedef struct {
    int side;
    double x[2], v[2], tau[2], dtau[2], w, W; /* centre, slopes of the axis, turning */
    double F[2], T, N[2];                     /* force, torque about its centre, tilting moment of contacts */
} Ring;

static Ring ring_at(int side, int row, const double *q, const double *v, double w, double W)
{
    Ring g = {.side = side, .w = w, .W = W};
    const int base = side == INNER ? 0 : 2;
    for (int a = 0; a < 2; a++) {
        if (M.tilting) {
            g.tau[a] = q[tilt_at(base / 2) + a];
            g.dtau[a] = v[tilt_at(base / 2) + a];
        }
        g.x[a] = q[base + a] + row_height(row) * g.tau[a];
        g.v[a] = v[base + a] + row_height(row) * g.dtau[a];
    }
    return g;
}

/* Tilting: gradient and damping of E(delta, tilt); returns Q, and T along the slice coordinate. */
static double tilted(const Ring *g, const Meeting *m, const double *V, double beta, double dbeta, double *T)
{
    const double turning = (dot(m->t, V) - dot(m->t, g->v)) / m->rho, sign = g->side == INNER ? 1.0 : -1.0;
    const double tilt = sign * (dot(m->n, g->tau) - beta);
    const double tilt_rate = sign * (turning * dot(m->t, g->tau) + dot(m->n, g->dtau) - dbeta);
    const Tilted e = tilted_energy(g->side, m->delta, tilt);
    *T = 0.0;
    if (e.Q == 0.0) return 0.0;
    const double share = M.tau * e.x / (e.x + M.roughness);
    const double Q = e.Q + share * (e.K * m->rate + e.KT * tilt_rate);
    if (Q <= 0.0) return 0.0;
    *T = e.T + share * (e.KT * m->rate + e.KTT * tilt_rate);
    return Q;
}

/* The element as contacts see it, and what they do to it. */
typedef struct {
    int row, j;
    double X[2], V[2], phi, dphi, beta, dbeta;
    double F[2], T, moment;
} Element;

/* One contact; returns Q. */
static double contact(Ring *g, Element *b, const Meeting *m, double slip, double *moment)
{
    const int inner = g->side == INNER;
    double Q, push = 0.0, P_ring = 0.0, P_element = 0.0, T = 0.0;
    if (M.tilting) {
        Q = tilted(g, m, b->V, b->beta, b->dbeta, &T);
        push = (inner ? -T : T) * dot(m->t, g->tau) / m->rho;
    } else {
        const Energy e = contact_energy(g->side, b->row, b->j, m->alpha - g->W, m->alpha + (inner ? PI : 0.0) - b->phi,
                                        m->delta);
        Q = e.E > 0.0 ? damped(e.Q, e.K, e.x, m->rate) : 0.0;
        P_ring = e.P_ring;
        P_element = e.P_element;
        push = -(P_ring + P_element) / m->rho;
    }
    const double f = M.mu * Q * tanh(slip / M.vs), away = inner ? Q : -Q;
    const double couple = M.rolling * M.r * Q * tanh((b->dphi - g->w) / SPIN_SCALE);
    const double force[2] = {away * m->n[0] + (f + push) * m->t[0], away * m->n[1] + (f + push) * m->t[1]};
    add(b->F, 1.0, force);
    add(g->F, -1.0, force);
    b->T += (inner ? -f : f) * m->arm + P_element - couple;
    g->T += -m->ring_arm * f + P_ring + couple;
    b->moment += inner ? T : -T;
    add(g->N, inner ? -T : T, m->n);
    *moment = T;
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

/* Returns the force, > 0 where the cage pushes forward. */
static double pocket(Element *b, const double *cage, const double *cage_rate, double *cage_force, double *cage_torque)
{
    double ahead;
    const Wall w = pocket_wall(b->row, b->j, b->X, cage, &ahead);
    const double angle = cage[2] + pocket_angle(b->row, b->j), e[2] = {cos(angle), sin(angle)}, p[2] = {-e[1], e[0]};
    const double relative[2] = {b->V[0] - cage_rate[0], b->V[1] - cage_rate[1]};
    const double out[2] = {b->X[0] - cage[0], b->X[1] - cage[1]};
    double rate;
    if (M.pockets == POCKETS_SLOT) {
        rate = -dot(p, relative) + cage_rate[2] * dot(e, out);
        if (!(ahead > 0.0)) rate = -rate;
    } else rate = dot(w.u, relative) - M.Rm * cage_rate[2] * dot(w.u, p);
    const double N = wall_force(w.x, rate, M.Cp, oil_force());
    if (N == 0.0) return 0.0;
    const double along[2] = {-w.u[1], w.u[0]}, lever[2] = {w.P[0] - cage[0], w.P[1] - cage[1]};
    const double slip = dot(along, relative) + M.r * b->dphi - cage_rate[2] * dot(w.u, lever);
    const double f = wall_friction(N, slip);
    const double on_cage[2] = {N * w.u[0] + f * along[0], N * w.u[1] + f * along[1]};
    add(b->F, -1.0, on_cage);
    b->T -= M.r * f;
    add(cage_force, 1.0, on_cage);
    *cage_torque += cross(lever, on_cage);
    return M.pockets == POCKETS_SLOT ? (ahead > 0.0 ? N : -N) : -N * dot(w.u, p);
}

static int has_land(void) { return M.guide != GUIDE_NONE || M.pockets == POCKETS_SLOT; }

/* Sections 6 and 21: film and land, on the cage; the guiding ring gets the reaction. */
static void guidance(const double *cage, const double *cage_rate, Ring *g, double *cage_force, double *cage_torque)
{
    if (!has_land()) return;
    const double e[2] = {cage[0] - g->x[0], cage[1] - g->x[1]};
    const double v[2] = {cage_rate[0] - g->v[0], cage_rate[1] - g->v[1]};
    const double size = hypot(e[0], e[1]), n[2] = {size > 0.0 ? e[0] / size : 1.0, size > 0.0 ? e[1] / size : 0.0};
    const double land = wall_force(size, dot(v, n), M.Cg, land_oil_force());
    double F[2] = {-land * n[0], -land * n[1]}, couple = 0.0;
    if (M.guide != GUIDE_NONE) {
        double film[2];
        couple = guidance_film(e, v, cage_rate[2], g->w, film);
        add(F, 1.0, film);
    }
    add(cage_force, 1.0, F);
    add(g->F, -1.0, F);
    *cage_torque += couple;
    g->T -= couple + cross(e, F);
}

/* Section 8's left sides for one element; keeps its numbers for the channels. */
static void element(int k, const double *q, const double *v, double *acc, Ring *in, Ring *out, double *cage_force,
                    double *cage_torque)
{
    const int p = roller_at(k), row = k / M.Z, c = cage_at(row);
    const double e[2] = {cos(q[p + 1]), sin(q[p + 1])}, s[2] = {-e[1], e[0]}, R = M.Rm + q[p], speed = M.Rm * v[p + 1];
    const double area = M.element == ELEMENT_BALL ? PI * M.r * M.r : 2.0 * M.r * M.L;
    Element b = {.row = row, .j = k % M.Z, .phi = q[p + 2], .dphi = v[p + 2]};
    for (int a = 0; a < 2; a++) {
        b.X[a] = R * e[a];
        b.V[a] = v[p] * e[a] + R * v[p + 1] * s[a];
        b.F[a] = M.m * M.g[a];
    }
    if (M.tilting) {
        b.beta = q[beta_at(k)];
        b.dbeta = v[beta_at(k)];
    }
    add(b.F, -0.5 * M.Cd * M.rho * area * speed * fabs(speed), s);
    Detail *o = &detail[k];
    const Meeting mi = meet(INNER, q + p, v + p, in->x, in->v), mo = meet(OUTER, q + p, v + p, out->x, out->v);
    o->slip_inner = ring_slip(INNER, &mi, b.V, in->v, in->w, b.dphi);
    o->slip_outer = ring_slip(OUTER, &mo, b.V, out->v, out->w, b.dphi);
    o->inner_force = contact(in, &b, &mi, o->slip_inner, &o->inner_moment);
    o->outer_force = contact(out, &b, &mo, o->slip_outer, &o->outer_moment);
    o->pocket = pocket(&b, q + c, v + c, cage_force, cage_torque);
    o->outer_length = o->inner_length = M.L;
    o->ax = b.F[0] / M.m;
    o->ay = b.F[1] / M.m;
    o->orbit_speed = (dot(mo.t, b.V) - dot(mo.t, out->v)) / mo.rho;
    acc[p] = dot(e, b.F) / M.m + R * v[p + 1] * v[p + 1];
    acc[p + 1] = (dot(s, b.F) / M.m - 2.0 * v[p] * v[p + 1]) / R;
    acc[p + 2] = b.T / M.Ir;
    if (M.tilting) acc[beta_at(k)] = b.moment / M.Jr;
}

void exact_accelerations(double t, const double *q, const double *v, double *acc, int want)
{
    double wi, W, Fi[2], Fo[2], N[2][2] = {{0.0, 0.0}, {0.0, 0.0}};
    (void)want;
    drive(t, &wi, &W);
    ring_forces(t, q, v, Fi, Fo);
    inner_torque = outer_torque = 0.0;
    for (int row = 0; row < M.rows; row++) {
        const int c = cage_at(row);
        double Fc[2] = {M.mc * M.g[0], M.mc * M.g[1]}, Tc = 0.0;
        Ring in = ring_at(INNER, row, q, v, wi, W), out = ring_at(OUTER, row, q, v, 0.0, 0.0);
        for (int j = 0; j < M.Z; j++) element(row * M.Z + j, q, v, acc, &in, &out, Fc, &Tc);
        guidance(q + c, v + c, M.guide == GUIDE_INNER ? &in : &out, Fc, &Tc);
        acc[c] = Fc[0] / M.mc;
        acc[c + 1] = Fc[1] / M.mc;
        acc[c + 2] = Tc / M.Ic;
        inner_torque -= in.T;
        outer_torque -= out.T;
        for (int a = 0; a < 2; a++) {
            Fi[a] += in.F[a];
            Fo[a] += out.F[a];
            N[0][a] += row_height(row) * in.F[a] + in.N[a];
            N[1][a] += row_height(row) * out.F[a] + out.N[a];
        }
    }
    for (int a = 0; a < 2; a++) {
        acc[a] = Fi[a] / M.mi;
        acc[2 + a] = Fo[a] / M.mo;
    }
    if (M.tilting) tilt_rings(t, q, v, N, wi, acc);
}

static double contact_stored(const Ring *g, int row, int j, const double *roller, double beta)
{
    const double rest[3] = {0.0, 0.0, 0.0};
    const Meeting m = meet(g->side, roller, rest, g->x, rest);
    const double sign = g->side == INNER ? 1.0 : -1.0, turned = g->side == INNER ? PI : 0.0;
    if (M.tilting) return tilted_energy(g->side, m.delta, sign * (dot(m.n, g->tau) - beta)).E;
    return contact_energy(g->side, row, j, m.alpha - g->W, m.alpha + turned - roller[2], m.delta).E;
}

/* What contacts, walls, land and supports store. */
double potential(double t, const double *q)
{
    double E = 0.5 * M.ki * dot(q, q) + 0.5 * M.ko * dot(q + 2, q + 2), w, W;
    drive(t, &w, &W);
    for (int g = 0; g < 2 && M.tilting; g++)
        E += 0.5 * M.tilt_stiffness[g] * dot(q + tilt_at(g), q + tilt_at(g));
    for (int row = 0; row < M.rows; row++) {
        const Ring in = ring_at(INNER, row, q, q, w, W), out = ring_at(OUTER, row, q, q, 0.0, 0.0);
        const double *cage = q + cage_at(row), *ring = M.guide == GUIDE_INNER ? in.x : out.x;
        for (int j = 0; j < M.Z; j++) {
            const double *p = q + roller_at(row * M.Z + j), R = M.Rm + p[0];
            const double X[2] = {R * cos(p[1]), R * sin(p[1])}, beta = M.tilting ? q[beta_at(row * M.Z + j)] : 0.0;
            double ahead;
            E += contact_stored(&in, row, j, p, beta) + contact_stored(&out, row, j, p, beta);
            E += wall_energy(pocket_wall(row, j, X, cage, &ahead).x, M.Cp, oil_force());
        }
        if (has_land()) E += wall_energy(hypot(cage[0] - ring[0], cage[1] - ring[1]), M.Cg, land_oil_force());
    }
    return E;
}
