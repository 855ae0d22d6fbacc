/* An independent implementation of the mathematical contract (model.md), written from the text alone.
 *
 * Planar cylindrical roller bearing: X right, Y up, angles counter-clockwise, SI units throughout.
 * Fixed-step classical Runge-Kutta of fourth order, or an adaptive extrapolation; nothing is tuned, everything is plain.
 * Section numbers in the comments are those of model.md.
 *
 * usage: model PARAMETERS > signals.csv     (the parameter text is written by generate.py)
 *        model --balance PARAMETERS | model --facts
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "channels.h"
#include "dynamics.h"
#include "exact.h"
#include "extrapolation.h"
#include "facts.h"
#include "lumped.h"
#include "model.h"
#include "parameters.h"
#include "start.h"
#include "state.h"

static void rates(double t, const double *q, const double *v, double *acc, int want)
{
    if (M.geometry == GEOMETRY_EXACT) exact_accelerations(t, q, v, acc, want);
    else if (M.reference) reference_accelerations(t, q, v, acc, want);
    else accelerations(t, q, v, acc, want);
}

int main(int argc, char **argv)
{
    if (argc == 2 && !strcmp(argv[1], "--facts")) return facts();
    const int audit = argc == 3 && !strcmp(argv[1], "--balance");
    if (argc != 2 + audit) die("usage:", "model [--balance] PARAMETERS | --facts");
    read_model(argv[1 + audit]);
    dof = M.reference ? 4 : 4 + 3 * M.rows + 3 * M.total + (M.tilting ? 4 + M.total : 0);
    detail = need((size_t)M.total, sizeof(Detail));
    const size_t n = (size_t)dof;
    double *store = need(12 * n, sizeof(double));
    double *q = store, *v = q + n, *q2 = v + n, *v2 = q2 + n, *v3 = v2 + n, *v4 = v3 + n;
    double *a1 = v4 + n, *a2 = a1 + n, *a3 = a2 + n, *a4 = a3 + n;
    begin(q, v);
    if (audit) return balance_of_flows(q, v);

    const long samples = (long)floor(M.duration * M.fs + 1e-6);
    const long substeps = (long)ceil(1.0 / (M.fs * M.step) - 1e-9);
    const double h = 1.0 / (M.fs * (double)substeps);
    for (int i = 0; i < M.channels; i++) printf("%s%s", i ? "," : "", M.channel[i]);
    printf("\n");
    for (long k = 0; k <= samples; k++) {
        const double t0 = (double)k / M.fs;
        rates(t0, q, v, a1, 1);
        for (int i = 0; i < M.channels; i++) printf("%s%.11e", i ? "," : "", channel(M.channel[i], t0, q, v, a1));
        printf("\n");
        if (k == samples) break;
        if (M.tolerance > 0.0) {
            extrapolate(rates, t0, (double)(k + 1) / M.fs, q, v);
            if (!isfinite(q[0])) die("the state left the numbers", "");
            continue;
        }
        for (long s = 0; s < substeps; s++) {
            const double t = t0 + (double)s * h;
            rates(t, q, v, a1, 0);
            for (size_t i = 0; i < n; i++) { q2[i] = q[i] + 0.5 * h * v[i]; v2[i] = v[i] + 0.5 * h * a1[i]; }
            rates(t + 0.5 * h, q2, v2, a2, 0);
            for (size_t i = 0; i < n; i++) { q2[i] = q[i] + 0.5 * h * v2[i]; v3[i] = v[i] + 0.5 * h * a2[i]; }
            rates(t + 0.5 * h, q2, v3, a3, 0);
            for (size_t i = 0; i < n; i++) { q2[i] = q[i] + h * v3[i]; v4[i] = v[i] + h * a3[i]; }
            rates(t + h, q2, v4, a4, 0);
            for (size_t i = 0; i < n; i++) {
                q[i] += h / 6.0 * (v[i] + 2.0 * v2[i] + 2.0 * v3[i] + v4[i]);
                v[i] += h / 6.0 * (a1[i] + 2.0 * a2[i] + 2.0 * a3[i] + a4[i]);
            }
        }
        if (!isfinite(q[0])) die("the state left the numbers", "");
    }
    return 0;
}
