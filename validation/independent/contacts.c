/* The laws of contact, `ecl` and `sliced`. */
#include "contacts.h"

#include <math.h>

#include "cover.h"
#include "defects.h"
#include "floors.h"
#include "model.h"

static double power(double x)
{
    return x > 0.0 ? pow(x, M.n) : 0.0;
}

double factor(double Ls)
{
    return pow((M.L - Ls) / M.L, 8.0 / 9.0);
}

/* phi within 1e-9 of 0 or 1 counts as that. */
static double settled(double phi) { return phi < 1e-9 ? 0.0 : phi > 1.0 - 1e-9 ? 1.0 : phi; }

/* Law `sliced`: fractions of slices. */
static Elastic sliced_law(int side, int row, int j, double theta, double phi, double W, double delta, int slope)
{
    static Met met[16], beside[1];
    const double K = side == OUTER ? M.Kout : M.Kin;
    Elastic e = {0.0, 0.0, M.L, 0.0, 0.0};
    int count = 0;
    for (int i = 0; i < M.defects; i++) {
        Defect *d = &M.defect[i];
        double u;
        if (!local_angle(d, side, row, j, theta, phi, W, &u)) continue;
        const double s = u * d->radius;
        if (s < d->first - d->reach || s > d->last + d->reach) continue;
        if (count == 16) die("too many defects at one contact", "");
        if (M.path == PATH_ENVELOPE && !d->table[side].nodes) build_table(d, side);
        find_cover(&met[count++], d, s);
    }
    if (M.path == PATH_ENVELOPE && count > 1) die("defects that meet one contact along an envelope", "are not covered");
    const double whole = power(delta), whole_rise = delta > 0.0 ? M.n * pow(delta, M.n - 1.0) : 0.0;
    for (int k = 0; k < M.slices && count; k++) {
        double depth, section = 0.0, rise = 0.0, part = fraction(met, count, k, &depth), none;
        if (M.path == PATH_ENVELOPE) {
            const Table *t = &met->d->table[side];
            part += looked_up(t, t->lifted, k, met->s, &none);
            section = looked_up(t, t->section, k, met->s, &rise);
            depth = part > 0.0 ? section / part : 0.0;
        }
        const double share = settled(fmin(part, 1.0));
        const double x = delta - depth, q = share > 0.0 ? power(x) : 0.0;
        e.elastic += K / M.slices * ((1.0 - share) * whole + share * q);
        if (slope)
            e.stiffness += K / M.slices * ((1.0 - share) * whole_rise
                                           + (share > 0.0 && x > 0.0 ? share * M.n * pow(x, M.n - 1.0) : 0.0));
        if (M.edge == EDGE_CONSERVATIVE && share > 0.0) {
            /* -dE/ds with E = (1 - phi) E(delta) + phi E(delta - h) and h = section / phi; the fraction's slope by a
             * difference. */
            const double hair = 1e-9;
            double widens = 0.0;
            if (share < 1.0) {
                double far[2];
                for (int i = 0; i < 2; i++) {
                    find_cover(beside, met->d, met->s + (i ? hair : -hair));
                    far[i] = fraction(beside, 1, k, &none);
                }
                widens = (far[1] - far[0]) / (2.0 * hair);
                /* A fraction that jumps where damage begins does no work: its depth is 0 there. */
                if (fabs(far[1] - far[0]) > 1e-3) widens = 0.0;
            }
            const double energy = (q * fmax(x, 0.0) - whole * fmax(delta, 0.0)) / (M.n + 1.0);
            const double push = K / M.slices * (q * (rise - depth * widens) - widens * energy) * met->d->radius;
            e.push += push;
            if (met->d->on == ROLLER) e.push_own += push;
        }
    }
    if (!count) {
        e.elastic = K * whole;
        e.stiffness = slope ? K * whole_rise : 0.0;
    }
    return e;
}

/* Elastic part of the law `ecl` at one contact; of several defects the smallest sum acts.
 * With equal sums (contact open) the longest damaged length is the one reported. */
Elastic elastic_law(int side, int row, int j, double theta, double phi, double W, double delta, int slope)
{
    if (M.law == LAW_SLICED) return sliced_law(side, row, j, theta, phi, W, delta, slope);
    const double K = side == OUTER ? M.Kout : M.Kin;
    Elastic e = {0.0, 0.0, M.L, 0.0, 0.0};
    const double whole = power(delta);
    e.elastic = K * whole;
    e.length = M.L;
    e.stiffness = slope && delta > 0.0 ? K * M.n * pow(delta, M.n - 1.0) : 0.0;
    for (int i = 0; i < M.defects; i++) {
        const Defect *d = &M.defect[i];
        double u, Ls, h;
        if (!local_angle(d, side, row, j, theta, phi, W, &u)) continue;
        if (!defect_at(d, u, &Ls, &h)) continue;
        if (M.path == PATH_ENVELOPE) {
            double unused;
            h = depth_of(d->floor, side, u * d->radius, &unused);
        }
        const double g = factor(Ls), rest = delta > h ? power(delta - h) : 0.0;
        const double sum = K * (g * whole + (1.0 - g) * rest);
        if (sum < e.elastic || (sum == e.elastic && M.L - Ls < e.length)) {
            e.elastic = sum;
            e.length = M.L - Ls;
            if (slope) {
                e.stiffness = delta > 0.0 ? K * g * M.n * pow(delta, M.n - 1.0) : 0.0;
                if (delta > h) e.stiffness += K * (1.0 - g) * M.n * pow(delta - h, M.n - 1.0);
            }
        }
    }
    return e;
}
