/* The elastic force of a contact in centred geometry: the law `ecl`, and healthy slices. */
#include "contacts.h"

#include <math.h>

#include "defects.h"
#include "floors.h"
#include "halfspace.h"
#include "model.h"

static double power(double x)
{
    return x > 0.0 ? pow(x, M.n) : 0.0;
}

double factor(double Ls)
{
    return pow((M.L - Ls) / M.L, 8.0 / 9.0);
}

/* Elastic part of the law `ecl` at one contact; of several defects the smallest sum acts.
 * With equal sums (contact open) the longest damaged length is the one reported. */
Elastic elastic_law(int side, int row, int j, double theta, double phi, double W, double delta, int slope)
{
    const double K = side == OUTER ? M.Kout : M.Kin;
    Elastic e = {0.0, 0.0, M.L};
    if (M.profile) {
        double energy;
        healthy(side, delta, &energy, &e.elastic, &e.stiffness);
        return e;
    }
    const double whole = power(delta);
    e.elastic = K * whole;
    e.stiffness = slope && delta > 0.0 ? K * M.n * pow(delta, M.n - 1.0) : 0.0;
    for (int i = 0; i < M.defects; i++) {
        const Defect *d = &M.defect[i];
        double u, Ls, h;
        if (!local_angle(d, side, row, j, theta, phi, W, &u)) continue;
        if (!defect_at(d, u, &Ls, &h)) continue;
        if (M.path == PATH_ENVELOPE) h = envelope_depth(&d->floor, side, u * d->radius);
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

/* Section 16: every slice is damped by itself; delta and tilt, with their rates, at the row's middle. Returns Q. */
double sliced_force(int side, double delta, double rate, double tilt, double tilt_rate, double *T)
{
    const double K = side == OUTER ? M.Kout : M.Kin;
    double Q = 0.0;
    *T = 0.0;
    for (int k = 0; k < M.slices; k++) {
        const double z = ((k + 0.5) / M.slices - 0.5) * M.L;
        const double x = delta + tilt * z - (M.profile ? M.slice_drop[k] : 0.0);
        if (x <= 0.0) continue;
        const double q = fmax(K * pow(x, M.n) + M.c * (rate + tilt_rate * z), 0.0) / M.slices;
        Q += q;
        *T += z * q;
    }
    return Q;
}
