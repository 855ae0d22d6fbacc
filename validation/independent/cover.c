/* What damage covers along z, and the share of a slice that it takes. */
#include "cover.h"

#include <math.h>
#include <stdlib.h>

#include "defects.h"
#include "floors.h"

static void cover(Met *m, double from, double to)
{
    if (!(to > from)) return;
    if (m->count == INTERVALS) die("damage:", "too many intervals along z");
    m->from[m->count] = from;
    m->to[m->count++] = to;
}

static int map_column(const Defect *d, double s)
{
    int c = (int)floor((s - d->s0) / d->ds);
    if (c > d->columns - 2) c = d->columns - 2;
    return c < 0 ? 0 : c;
}

void find_cover(Met *m, const Defect *d, double s)
{
    double w;
    m->d = d;
    m->s = s;
    m->count = 0;
    m->h = 0.0;
    if (s < d->first || s > d->last) return;
    if (d->shape == DEPTH_MAP) {
        /* Between four nodes the surface is damaged unless all are 0. */
        const int c = map_column(d, s);
        for (int r = 0; r + 1 < d->rows; r++) {
            const double *a = d->grid + r * d->columns + c, *b = a + d->columns;
            if (a[0] != 0.0 || a[1] != 0.0 || b[0] != 0.0 || b[1] != 0.0)
                cover(m, d->z0 + r * d->dz, d->z0 + (r + 1) * d->dz);
        }
    } else if (d->shape == OUTLINE) {
        double z[CROSSINGS];
        const int count = crossings(d, d->s, d->z, s, z, CROSSINGS);
        m->h = d->depth;
        for (int i = 0; i + 1 < count; i += 2) cover(m, z[i], z[i + 1]);
    } else if (width_at(d, s, &w, &m->h)) {
        cover(m, d->offset - 0.5 * w, d->offset + 0.5 * w);
    }
}

/* Depth at z where it is covered, at a point. */
static double depth_under(const Met *m, double z)
{
    const Defect *d = m->d;
    if (d->shape != DEPTH_MAP) return m->h;
    const int c = map_column(d, m->s);
    int r = (int)floor((z - d->z0) / d->dz);
    r = r < 0 ? 0 : r > d->rows - 2 ? d->rows - 2 : r;
    const double x = (m->s - d->s0) / d->ds - c, y = (z - d->z0) / d->dz - r;
    const double *a = d->grid + r * d->columns + c, *b = a + d->columns;
    return (1.0 - y) * (a[0] + x * (a[1] - a[0])) + y * (b[0] + x * (b[1] - b[0]));
}

static int covers(const Met *m, double z)
{
    for (int i = 0; i < m->count; i++)
        if (z >= m->from[i] && z <= m->to[i]) return 1;
    return 0;
}

/* phi of slice k, and the mean depth at a point: the deepest of all that cover it, between all ends of what they
 * cover. */
double fraction(const Met *met, int count, int k, double *mean)
{
    static const double at[3] = {0.1127016653792583, 0.5, 0.8872983346207417};
    static const double weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
    const double lo = slice_border(k), hi = slice_border(k + 1);
    double stop[2 * 16 * INTERVALS + 2], covered = 0.0, section = 0.0;
    int stops = 0;
    stop[stops++] = lo;
    stop[stops++] = hi;
    for (int i = 0; i < count; i++)
        for (int j = 0; j < met[i].count; j++) {
            if (met[i].from[j] > lo && met[i].from[j] < hi) stop[stops++] = met[i].from[j];
            if (met[i].to[j] > lo && met[i].to[j] < hi) stop[stops++] = met[i].to[j];
        }
    qsort(stop, (size_t)stops, sizeof(double), ascending);
    for (int i = 0; i + 1 < stops; i++) {
        const double a = stop[i], b = stop[i + 1];
        int any = 0;
        for (int g = 0; g < 3 && b > a; g++) {
            const double z = a + at[g] * (b - a);
            double deepest = -INFINITY;
            for (int j = 0; j < count; j++)
                if (covers(&met[j], z)) deepest = fmax(deepest, depth_under(&met[j], z));
            if (deepest == -INFINITY) continue;
            any = 1;
            section += weight[g] * (b - a) * deepest;
        }
        if (any) covered += b - a;
    }
    *mean = covered > 0.0 ? section / covered : 0.0;
    return covered / (hi - lo);
}
