/* Section 19: a damaged contact as the healthy one at delta_eff(delta, s), tables given as files. */
#include "halfspace.h"

#include <math.h>
#include <stdlib.h>

#include "waviness.h"

static double wrap(double u) { return u - 2.0 * PI * floor((u + PI) / (2.0 * PI)); }

/* Second derivatives of the natural cubic spline through y (stride apart) at x: Thomas's algorithm. */
static void natural(int n, const double *x, const double *y, double *m, int stride)
{
    double *c = need((size_t)n, sizeof(double)), *r = need((size_t)n, sizeof(double));
    for (int i = 1; i + 1 < n; i++) {
        const double a = x[i] - x[i - 1], b = x[i + 1] - x[i];
        const double rise = (y[(i + 1) * stride] - y[i * stride]) / b - (y[i * stride] - y[(i - 1) * stride]) / a;
        const double pivot = 2.0 * (a + b) - a * c[i - 1];
        c[i] = b / pivot;
        r[i] = (6.0 * rise - a * r[i - 1]) / pivot;
    }
    m[0] = m[(n - 1) * stride] = 0.0;
    for (int i = n - 2; i > 0; i--) m[i * stride] = r[i] - c[i] * (i == n - 2 ? 0.0 : m[(i + 1) * stride]);
    free(c);
    free(r);
}

void spline_damage(Damage *d)
{
    const size_t size = (size_t)(d->ns * d->nd);
    if (d->ns < 2 || d->nd < 2) die("table:", "two nodes at least");
    d->fs = need(size, sizeof(double));
    d->fd = need(size, sizeof(double));
    d->fsd = need(size, sizeof(double));
    for (int i = 0; i < d->ns; i++) natural(d->nd, d->d, d->f + i * d->nd, d->fd + i * d->nd, 1);
    for (int j = 0; j < d->nd; j++) {
        natural(d->ns, d->s, d->f + j, d->fs + j, d->nd);
        natural(d->ns, d->s, d->fd + j, d->fsd + j, d->nd);
    }
}

static int interval(const double *x, int n, double at)
{
    int lo = 0, hi = n - 1;
    while (hi - lo > 1) {
        const int mid = (lo + hi) / 2;
        if (at >= x[mid]) lo = mid;
        else hi = mid;
    }
    return lo;
}

/* A cubic between two nodes a distance h apart, from values and second derivatives there; t is the share of the way. */
static double cubic(double h, double t, double y0, double y1, double m0, double m1)
{
    const double u = 1.0 - t;
    return u * y0 + t * y1 + h * h / 6.0 * ((u * u * u - u) * m0 + (t * t * t - t) * m1);
}

static double slope(double h, double t, double y0, double y1, double m0, double m1)
{
    const double u = 1.0 - t;
    return (y1 - y0) / h + h / 6.0 * ((1.0 - 3.0 * u * u) * m0 + (3.0 * t * t - 1.0) * m1);
}

/* 0: nothing touches, below the first delta. The caller sees to it that s is on the table. */
int depth_at(const Damage *d, double delta, double s, Depth *out)
{
    if (delta < d->d[0]) return 0;
    const int i = interval(d->s, d->ns, s), j = interval(d->d, d->nd, fmin(delta, d->d[d->nd - 1]));
    const double hs = d->s[i + 1] - d->s[i], ts = (s - d->s[i]) / hs, hd = d->d[j + 1] - d->d[j];
    double y[2], m[2], ys[2], ms[2]; /* value and delta's second derivative at s, and their slopes along s */
    for (int k = 0; k < 2; k++) {
        const int a = i * d->nd + j + k, b = a + d->nd;
        y[k] = cubic(hs, ts, d->f[a], d->f[b], d->fs[a], d->fs[b]);
        ys[k] = slope(hs, ts, d->f[a], d->f[b], d->fs[a], d->fs[b]);
        m[k] = cubic(hs, ts, d->fd[a], d->fd[b], d->fsd[a], d->fsd[b]);
        ms[k] = slope(hs, ts, d->fd[a], d->fd[b], d->fsd[a], d->fsd[b]);
    }
    const double beyond = fmax(delta - d->d[d->nd - 1], 0.0), td = beyond > 0.0 ? 1.0 : (delta - d->d[j]) / hd;
    out->f = cubic(hd, td, y[0], y[1], m[0], m[1]);
    out->fs = cubic(hd, td, ys[0], ys[1], ms[0], ms[1]);
    out->fd = slope(hd, td, y[0], y[1], m[0], m[1]);
    out->fdd = beyond > 0.0 ? 0.0 : (1.0 - td) * m[0] + td * m[1];
    if (beyond > 0.0) {
        out->f += beyond * out->fd;
        out->fs += beyond * slope(hd, td, ys[0], ys[1], ms[0], ms[1]);
    }
    return 1;
}

/* Section 15: the drop at the middle of every slice. */
void slice_profile(void)
{
    if (M.profile == STRAIGHT) return;
    M.slice_drop = need((size_t)M.slices, sizeof(double));
    const double d = 2.0 * M.r, flat = fmax(M.L - 2.5 * d, 0.0);
    for (int k = 0; k < M.slices; k++) {
        const double z = ((k + 0.5) / M.slices - 0.5) * M.L;
        double *p = &M.slice_drop[k];
        if (M.profile == CROWNED) *p = z * z / (2.0 * M.crowned);
        else if (M.profile == LOGARITHMIC) {
            const double x = (2.0 * fabs(z) - flat) / (M.L - flat);
            *p = x > 0.0 ? -(flat > 0.0 ? 0.0005 : 0.00035) * d * log(1.0 - x * x) : 0.0;
        } else {
            const int n = M.drops;
            if (z <= M.drop_z[0]) *p = M.drop[0];
            else if (z >= M.drop_z[n - 1]) *p = M.drop[n - 1];
            else {
                const int i = interval(M.drop_z, n, z);
                const double t = (z - M.drop_z[i]) / (M.drop_z[i + 1] - M.drop_z[i]);
                *p = (1.0 - t) * M.drop[i] + t * M.drop[i + 1];
            }
        }
    }
}

/* E_H, Q and K of the healthy contact. */
void healthy(int side, double delta, double *E, double *Q, double *K)
{
    const double stiff = side == OUTER ? M.Kout : M.Kin, n = M.n;
    const int slices = M.profile == STRAIGHT ? 1 : M.slices;
    *E = *Q = *K = 0.0;
    for (int k = 0; k < slices; k++) {
        const double x = delta - (M.profile == STRAIGHT ? 0.0 : M.slice_drop[k]);
        if (x <= 0.0) continue;
        const double q = stiff / slices * pow(x, n);
        *E += q * x / (n + 1.0);
        *Q += q;
        *K += n * q / x;
    }
}

Tilted tilted_energy(int side, double delta, double tilt)
{
    Tilted e = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    e.x = fmax(delta, 0.0);
    const double stiff = (side == OUTER ? M.Kout : M.Kin) / M.slices;
    for (int k = 0; k < M.slices; k++) {
        const double z = ((k + 0.5) / M.slices - 0.5) * M.L;
        const double x = delta + tilt * z - (M.profile == STRAIGHT ? 0.0 : M.slice_drop[k]);
        if (x <= 0.0) continue;
        const double q = stiff * pow(x, M.n), stiffness = M.n * q / x;
        e.E += q * x / (M.n + 1.0);
        e.Q += q;
        e.T += z * q;
        e.K += stiffness;
        e.KT += z * stiffness;
        e.KTT += z * z * stiffness;
        e.x = fmax(e.x, x);
    }
    return e;
}

/* The damage of a surface that is met at s; its table is chosen by s, so tables of one surface must not overlap. */
static const Damage *damage_at(int on, int row, int j, double angle, double *s)
{
    const Damage *met = NULL;
    for (int i = 0; i < M.damages; i++) {
        const Damage *d = &M.damage[i];
        if (d->on != on || d->row != row || (on == ROLLER && d->roller != j)) continue;
        const double at = d->radius * wrap(angle - d->psi);
        if (at < d->s[0] || at > d->s[d->ns - 1]) continue;
        if (met) die("tables of one surface", "overlap");
        met = d;
        *s = at;
    }
    return met;
}

/* Two damaged surfaces: the raceway's table first, then the element's, by the chain rule. */
Energy contact_energy(int side, int row, int j, double ring_angle, double element_angle, double delta)
{
    Energy e = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    double slope_ring = 0.0, slope_element = 0.0, s1, s2;
    if (M.raceway_waves.amplitude > 0.0)
        delta -= waviness(&M.raceway_waves, raceway_surface(side, row), ring_angle, &slope_ring);
    if (M.element_waves.amplitude > 0.0)
        delta -= waviness(&M.element_waves, element_surface(row, j), element_angle, &slope_element);
    const Damage *ring = damage_at(side, row, j, ring_angle, &s1);
    const Damage *element = damage_at(ROLLER, row, j, element_angle, &s2);
    Depth a = {delta, 1.0, 0.0, 0.0}, b;
    e.x = delta;
    if (ring && !depth_at(ring, delta, s1, &a)) return e;
    b = (Depth){a.f, 1.0, 0.0, 0.0};
    if (element && !depth_at(element, a.f, s2, &b)) return e;
    if (b.f <= 0.0) return e;
    double q, k;
    healthy(side, b.f, &e.E, &q, &k);
    const double rise = b.fd * a.fd, bend = b.fdd * a.fd * a.fd + b.fd * a.fdd;
    e.Q = q * rise;
    e.K = k * rise * rise + q * bend;
    e.x = fmax(delta, b.f);
    e.P_ring = -e.Q * slope_ring + (ring ? q * b.fd * a.fs * ring->radius : 0.0);
    e.P_element = -e.Q * slope_element + (element ? q * b.fs * element->radius : 0.0);
    return e;
}
