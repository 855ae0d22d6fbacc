/* Depth profiles along the surface and the roller's path over them, section 3. */
#include "floors.h"

#include <math.h>
#include <stdlib.h>

#include "defects.h"
#include "hertz.h"

static void add_piece(Floor *f, double a, double b, double ha, double hb)
{
    if (f->count == f->space) {
        f->space = 2 * f->space + 4;
        f->piece = realloc(f->piece, sizeof(Piece) * (size_t)f->space);
        if (!f->piece) die("out of memory", "");
    }
    f->piece[f->count++] = (Piece){a, b, ha, hb};
}

static void find_arc(Defect *d)
{
    switch (d->shape) {
    case RECTANGLE: d->last = 0.5 * d->length; break;
    case CIRCLE: d->last = 0.5 * d->diameter; break;
    case IRREGULAR: d->last = 0.5e-3 * IRREGULAR_ARC; break;
    case PROFILE:
        d->first = d->arc[0];
        d->last = d->arc[d->points - 1];
        return;
    default:
        d->first = d->last = d->s[0][0];
        for (int k = 0; k < d->polygons; k++)
            for (int i = 0; i < d->corners[k]; i++) {
                d->first = fmin(d->first, d->s[k][i]);
                d->last = fmax(d->last, d->s[k][i]);
            }
        return;
    }
    d->first = -d->last;
}

/* Stretches of the arc between corners on which an outline has any width; where polygons leave a gap is outside the
 * defect. */
static void outline_floor(Defect *d)
{
    double s[256];
    int count = 0;
    for (int k = 0; k < d->polygons; k++)
        for (int i = 0; i < d->corners[k]; i++) {
            if (count == 256) die("outline:", "too many corners");
            s[count++] = d->s[k][i];
        }
    qsort(s, (size_t)count, sizeof(double), ascending);
    for (int i = 0; i + 1 < count; i++)
        if (s[i + 1] > s[i] && outline_width(d, 0.5 * (s[i] + s[i + 1])) > 0.0)
            add_piece(&d->floor, s[i], s[i + 1], d->depth, d->depth);
}

void build_floor(Defect *d)
{
    find_arc(d);
    if (d->shape == OUTLINE) outline_floor(d);
    else if (d->shape != PROFILE) add_piece(&d->floor, d->first, d->last, d->depth, d->depth);
    else
        for (int i = 0; i + 1 < d->points; i++)
            if (d->arc[i + 1] > d->arc[i])
                add_piece(&d->floor, d->arc[i], d->arc[i + 1], d->depths[i], d->depths[i + 1]);
}

/* h_env(s) = min over s' of h(s') + (s - s')^2 / (2 R), exactly: within a piece the minimum is at s - R dh/ds or at an
 * end, outside them at s itself or at the nearest end. */
double envelope_depth(const Floor *f, int side, double s)
{
    const double R = 1.0 / curvature_along(side);
    double best = INFINITY;
    double gap = -INFINITY; /* where undamaged surface begins; it ends at the next piece */
    for (int i = 0; i <= f->count; i++) {
        const double end = i < f->count ? f->piece[i].a : INFINITY;
        if (i == 0 || end > gap) {
            const double x = fmin(fmax(s, gap), end);
            best = fmin(best, (s - x) * (s - x) / (2.0 * R));
        }
        if (i == f->count) break;
        const Piece *p = &f->piece[i];
        const double m = (p->hb - p->ha) / (p->b - p->a);
        const double x = fmin(fmax(s - m * R, p->a), p->b);
        best = fmin(best, p->ha + m * (x - p->a) + (s - x) * (s - x) / (2.0 * R));
        gap = p->b;
    }
    return best;
}
