/* The explicit midpoint rule extrapolated to order 12 (2, 4, .. 12 substeps), adaptive; for the smooth forces of Part II.
 * The error of a step is the difference of the last two extrapolations, at most M.tolerance of each number's size. */
#include "extrapolation.h"

#include <math.h>
#include <string.h>

#include "model.h"
#include "state.h"

enum { COLUMNS = 6 };
static const double LENGTH = 1e-6, ANGLE = 1e-2, SPEED = 1e-2, RADIUS = 5e-3; /* sizes below which none is judged; angles grow,
                                                                                 * and their last digit with them */

/* A slice that begins to touch adds damping by x^(1/9), a jump in all but name: steps as short as this pass over it. */
static const double SHORTEST = 1e-11;

static Rates *rates_of;
static double *store, *start_rate;

static void slope(double t, const double *y, double *dy)
{
    memcpy(dy, y + dof, sizeof(double) * (size_t)dof);
    rates_of(t, y, y + dof, dy + dof, 0);
}

static int is_angle(int i)
{
    if (i >= roller_at(M.total)) return 1;
    return i >= 4 && (i < 4 + 3 * M.rows ? (i - 4) % 3 == 2 : (i - 4 - 3 * M.rows) % 3 != 0);
}

static double error_size(const double *a, const double *b)
{
    double worst = 0.0;
    for (int i = 0; i < dof; i++) {
        const double unit = is_angle(i) ? RADIUS : 1.0;
        const double x = unit * fabs(a[i] - b[i]), v = unit * fabs(a[dof + i] - b[dof + i]);
        const double size = is_angle(i) ? ANGLE * RADIUS : LENGTH + fabs(b[i]);
        worst = fmax(worst, fmax(x / size, v / (SPEED + unit * fabs(b[dof + i]))));
    }
    return isfinite(worst) ? worst : 1e30;
}

/* One step from y by H into *best; returns its error. */
static double step(double t, double H, const double *y, double *best)
{
    const int n = 2 * dof;
    double *table[COLUMNS], *a = store + COLUMNS * n, *b = a + n, *d = b + n, error = 0.0;
    for (int k = 0; k < COLUMNS; k++) table[k] = store + k * n;
    for (int k = 0; k < COLUMNS; k++) {
        const int parts = 2 * (k + 1);
        const double h = H / parts;
        for (int i = 0; i < n; i++) { a[i] = y[i]; b[i] = y[i] + h * start_rate[i]; }
        for (int s = 1; s < parts; s++) {
            slope(t + s * h, b, d);
            for (int i = 0; i < n; i++) {
                const double next = a[i] + 2.0 * h * d[i];
                a[i] = b[i];
                b[i] = next;
            }
        }
        slope(t + H, b, d);
        /* Gragg's smoothing: the mean of y_N and y_{N-1} + h f(y_N); then Aitken and Neville, towards table[0] */
        for (int i = 0; i < n; i++) table[k][i] = 0.5 * (b[i] + a[i] + h * d[i]);
        for (int c = k - 1; c >= 0; c--) {
            const double ratio = (double)(k + 1) / (c + 1), factor = 1.0 / (ratio * ratio - 1.0);
            if (k == COLUMNS - 1 && c == 0) memcpy(a, table[1], sizeof(double) * (size_t)n);
            for (int i = 0; i < n; i++) table[c][i] = table[c + 1][i] + factor * (table[c + 1][i] - table[c][i]);
        }
    }
    error = error_size(a, table[0]);
    memcpy(best, table[0], sizeof(double) * (size_t)n);
    return error;
}

void extrapolate(Rates *rates, double from, double to, double *q, double *v)
{
    static double proposed = 1e-7;
    const int n = 2 * dof;
    if (!store) {
        store = need((size_t)((COLUMNS + 3) * n), sizeof(double));
        start_rate = need((size_t)(3 * n), sizeof(double));
    }
    double *y = start_rate + n, *best = y + n, t = from;
    rates_of = rates;
    memcpy(y, q, sizeof(double) * (size_t)dof);
    memcpy(y + dof, v, sizeof(double) * (size_t)dof);
    slope(t, y, start_rate);
    while (t < to) {
        const int last = t + 1.01 * proposed >= to;
        const double H = last ? to - t : proposed, error = step(t, H, y, best) / M.tolerance;
        const double scale = fmin(fmax(0.85 * pow(fmax(error, 1e-30), -1.0 / (2 * COLUMNS - 1)), 0.1), 3.0);
        if (error > 1.0 && H > SHORTEST) {
            proposed = H * fmin(scale, 0.7);
            continue;
        }
        t = last ? to : t + H;
        memcpy(y, best, sizeof(double) * (size_t)n);
        slope(t, y, start_rate);
        if (!last || H * scale < proposed) proposed = H * scale;
    }
    memcpy(q, y, sizeof(double) * (size_t)dof);
    memcpy(v, y + dof, sizeof(double) * (size_t)dof);
}
