/* Defects, section 3: their borders, widths and depths, and where a roller meets them. */
#include "defects.h"

#include <math.h>
#include <stdlib.h>

enum { CROSSINGS = 64 };

static double wrap(double u)
{
    return u - 2.0 * PI * floor((u + PI) / (2.0 * PI));
}

/* Half-width (mm) of the paper's irregular shape at the arc s (mm) from its first point; arcs of section 12. */
static double irregular_half_width(double a)
{
    static const double arc[6] = {1.6695, 1.5000, 0.7071, 1.4142, 0.7071, 1.0000};
    int k = 0;
    while (k < 5 && a > arc[k]) a -= arc[k++];
    const double s = fmin(fmax(a / arc[k], 0.0), 1.0);
    switch (k) {
    case 0: { const double q = 1.6695 * s + 1.1589; return 3.8284 - sqrt(16.0 - q * q); }
    case 1: return 1.0;
    case 2: return 1.0 + 0.7071 * s;
    case 3: { const double q = 1.4142 * s - 0.7071; return 1.0 + sqrt(fmax(1.0 - q * q, 0.0)); }
    case 4: return 1.7071 - 0.7071 * s;
    default: return sqrt(fmax(1.0 - s * s, 0.0));
    }
}

int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Where the line s = at crosses an outline's edges, ascending in z. Between odd and even crossings lies damage, so a
 * polygon within another is a hole. Half-open edges: a corner on the line counts once. */
static int crossings(const Defect *d, double at, double *found, int space)
{
    int count = 0;
    for (int k = 0; k < d->polygons; k++)
        for (int i = 0; i < d->corners[k]; i++) {
            const int j = (i + 1) % d->corners[k];
            const double sa = d->s[k][i], sb = d->s[k][j];
            if ((sa <= at) == (sb <= at)) continue;
            if (count == space) die("outline:", "too many crossings");
            found[count++] = d->z[k][i] + (at - sa) / (sb - sa) * (d->z[k][j] - d->z[k][i]);
        }
    qsort(found, (size_t)count, sizeof(double), ascending);
    return count;
}

static double within(double from, double to, double lo, double hi)
{
    return fmax(fmin(to, hi) - fmax(from, lo), 0.0);
}

/* L_s(s): the measure of the damaged z under the roller. */
double outline_width(const Defect *d, double s)
{
    double z[CROSSINGS], sum = 0.0;
    const int count = crossings(d, s, z, CROSSINGS);
    for (int i = 0; i + 1 < count; i += 2) sum += within(z[i], z[i + 1], -0.5 * M.L, 0.5 * M.L);
    return sum;
}

/* Width, unclipped, and depth at s; returns 0 outside the arc. */
static int width_at(const Defect *d, double s, double *width, double *h)
{
    double w = 0.0;
    *h = d->depth;
    switch (d->shape) {
    case RECTANGLE:
        if (fabs(s) > 0.5 * d->length) return 0;
        w = d->width;
        break;
    case CIRCLE: {
        const double a = 0.5 * d->diameter;
        if (fabs(s) > a) return 0;
        w = 2.0 * sqrt(a * a - s * s);
        break;
    }
    case IRREGULAR: {
        const double mm = s * 1e3;
        if (fabs(mm) > 0.5 * IRREGULAR_ARC) return 0;
        w = 2.0 * irregular_half_width(mm + 0.5 * IRREGULAR_ARC) * (d->width / 4e-3) * 1e-3;
        break;
    }
    case OUTLINE:
        if (s < d->first || s > d->last) return 0;
        w = outline_width(d, s);
        break;
    default: {
        const int n = d->points;
        if (s < d->arc[0] || s > d->arc[n - 1]) return 0;
        int i = 0;
        while (i + 2 < n && s >= d->arc[i + 1]) i++;
        const double da = d->arc[i + 1] - d->arc[i];
        const double x = da > 0.0 ? (s - d->arc[i]) / da : 1.0;
        w = d->widths[i] + x * (d->widths[i + 1] - d->widths[i]);
        *h = d->depths[i] + x * (d->depths[i + 1] - d->depths[i]);
    }
    }
    *width = fmax(w, 0.0);
    return 1;
}

/* Section 17: depth at the groove's bottom, z = 0. */
int depth_at_bottom(const Defect *d, double u, double *h)
{
    const double s = u * d->radius;
    double w, z[CROSSINGS];
    int inside = 0;
    if (!width_at(d, s, &w, h)) return 0;
    if (d->shape != OUTLINE) return fabs(d->offset) <= 0.5 * w;
    const int count = crossings(d, s, z, CROSSINGS);
    for (int i = 0; i < count; i++) inside ^= z[i] <= 0.0;
    return inside;
}

/* Damaged length and depth at local angle u; returns 0 outside the arc. */
int defect_at(const Defect *d, double u, double *Ls, double *h)
{
    double w;
    if (!width_at(d, u * d->radius, &w, h)) return 0;
    *Ls = d->shape == OUTLINE ? w : within(d->offset - 0.5 * w, d->offset + 0.5 * w, -0.5 * M.L, 0.5 * M.L);
    return 1;
}

/* Local angle of a roller on a defect's surface as met by the contact `side` (OUTER or INNER);
 * returns 0 where this defect never meets that contact. */
int local_angle(const Defect *d, int side, int row, int j, double theta, double phi, double W, double *u)
{
    if (d->row != row) return 0;
    if (d->on == ROLLER) {
        if (d->roller != j) return 0;
        *u = wrap(theta + (side == INNER ? PI : 0.0) - phi - d->psi);
        return 1;
    }
    if (d->on != side) return 0;
    *u = wrap(theta - d->psi - (side == INNER ? W : 0.0));
    return 1;
}
