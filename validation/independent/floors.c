/* Floors of `sliced` and `envelope`, section 3. */
#include "floors.h"

#include <math.h>
#include <stdlib.h>

#include "defects.h"

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
    case DEPTH_MAP:
        d->first = d->s0;
        d->last = d->s0 + d->ds * (d->columns - 1);
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

/* Is z damaged at s, by a shape given by width alone? */
static int wide_enough(const Defect *d, double s, double z)
{
    double w, h;
    return width_at(d, s, &w, &h) && w > 0.0 && fabs(z - d->offset) <= 0.5 * w;
}

/* The depth from a to b within one stretch of constant or linear depth. */
static void add_stretch(const Defect *d, Floor *f, double a, double b, double lo, double hi, double hlo, double hhi)
{
    a = fmax(a, lo);
    b = fmin(b, hi);
    if (!(b > a)) return;
    const double m = d->shape == PROFILE ? (hhi - hlo) / (hi - lo) : 0.0;
    add_piece(f, a, b, hlo + m * (a - lo), hlo + m * (b - lo));
}

static void add_range(const Defect *d, Floor *f, double a, double b)
{
    if (d->shape != PROFILE) {
        add_stretch(d, f, a, b, d->first, d->last, d->depth, d->depth);
        return;
    }
    for (int i = 0; i + 1 < d->points; i++)
        add_stretch(d, f, a, b, d->arc[i], d->arc[i + 1], d->depths[i], d->depths[i + 1]);
}

/* Floor under a slice at z of a shape given by width alone: borders by scanning its arc and bisecting. */
static void width_floor(const Defect *d, Floor *f, double z)
{
    const int steps = 20000;
    double from = 0.0;
    int inside = 0;
    for (int i = 0; i <= steps; i++) {
        const double s = i < steps ? d->first + (d->last - d->first) * i / steps : d->last;
        const int now = wide_enough(d, s, z);
        if (now != inside) {
            double border = s;
            if (i > 0) {
                double lo = d->first + (d->last - d->first) * (i - 1) / steps, hi = s;
                for (int it = 0; it < 60; it++) {
                    border = 0.5 * (lo + hi);
                    if (wide_enough(d, border, z) == inside) lo = border;
                    else hi = border;
                }
            }
            if (now) from = border;
            else add_range(d, f, from, border);
            inside = now;
        }
    }
    if (inside) add_range(d, f, from, d->last);
}

/* R_eq of a roller on the raceway of `side`, also for damage on the roller itself. */
static double equivalent_radius(int side)
{
    return 1.0 / (side == OUTER ? 1.0 / M.r - 1.0 / M.Ro : 1.0 / M.r + 1.0 / M.Ri);
}

double slice_border(int k) { return ((double)k / M.slices - 0.5) * M.L; }

/* Lines z = const of one slice whose envelopes are averaged. */
enum { LINES = 200, NODES = 20000 };

/* Stretches of the arc between corners on which an outline has any width. */
static void outline_floor(const Defect *d, Floor *f)
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
            add_piece(f, s[i], s[i + 1], d->depth, d->depth);
}

static void find_reach(Defect *d)
{
    double raised = 0.0;
    for (int i = 0; d->shape == DEPTH_MAP && i < d->columns * d->rows; i++) raised = fmax(raised, -d->grid[i]);
    if (M.path == PATH_ENVELOPE)
        d->reach = sqrt(2.0 * raised * fmax(equivalent_radius(OUTER), equivalent_radius(INNER)));
}

/* The floor along z = const. */
static void line_floor(const Defect *d, Floor *f, double z)
{
    if (d->shape == OUTLINE) {
        double s[CROSSINGS];
        const int count = crossings(d, d->z, d->s, z, s, CROSSINGS);
        for (int i = 0; i + 1 < count; i += 2) add_range(d, f, s[i], s[i + 1]);
    } else if (d->shape == DEPTH_MAP) {
        const double y = (z - d->z0) / d->dz;
        if (y < 0.0 || y > d->rows - 1) return;
        int r = (int)y;
        if (r > d->rows - 2) r = d->rows - 2;
        const double *low = d->grid + r * d->columns, *high = low + d->columns, x = y - r;
        for (int i = 0; i + 1 < d->columns; i++) {
            const double a = low[i] + x * (high[i] - low[i]), b = low[i + 1] + x * (high[i + 1] - low[i + 1]);
            if (a != 0.0 || b != 0.0) add_piece(f, d->s0 + i * d->ds, d->s0 + (i + 1) * d->ds, a, b);
        }
    } else {
        width_floor(d, f, z);
    }
}

void build_floors(Defect *d)
{
    find_arc(d);
    find_reach(d);
    if (M.law == LAW_ECL) {
        d->floor = need(1, sizeof(Floor));
        /* Not where polygons leave a gap: that is outside the defect. */
        if (d->shape == OUTLINE) outline_floor(d, d->floor);
        else add_range(d, d->floor, d->first, d->last);
        return;
    }
    if (M.path != PATH_ENVELOPE) return;
    d->floor = need((size_t)M.slices * LINES, sizeof(Floor));
    for (int i = 0; i < M.slices * LINES; i++) {
        const int k = i / LINES;
        line_floor(d, &d->floor[i],
                   slice_border(k) + (i % LINES + 0.5) / LINES * (slice_border(k + 1) - slice_border(k)));
    }
}

/* h(s); `slope` receives dh/ds. */
static double point_depth(const Floor *f, double s, double *slope)
{
    *slope = 0.0;
    for (int i = 0; i < f->count; i++) {
        const Piece *p = &f->piece[i];
        if (s < p->a || s > p->b) continue;
        *slope = (p->hb - p->ha) / (p->b - p->a);
        return p->ha + *slope * (s - p->a);
    }
    return 0.0;
}

/* h_env(s) = min over s' of h(s') + (s - s')^2 / (2 R), exactly: within a piece the minimum is at s - R dh/ds or at an
 * end, outside them at s itself or at the nearest end. Its slope is (s - s')/R at the s' that holds the roller up. */
static double envelope_depth(const Floor *f, double s, double R, double *slope)
{
    double best = INFINITY, where = s;
    double gap = -INFINITY; /* where undamaged surface begins; it ends at the next piece */
    for (int i = 0; i <= f->count; i++) {
        const double end = i < f->count ? f->piece[i].a : INFINITY;
        if (i == 0 || end > gap) {
            const double x = fmin(fmax(s, gap), end), h = (s - x) * (s - x) / (2.0 * R);
            if (h < best) { best = h; where = x; }
        }
        if (i == f->count) break;
        const Piece *p = &f->piece[i];
        const double m = (p->hb - p->ha) / (p->b - p->a);
        const double x = fmin(fmax(s - m * R, p->a), p->b);
        const double h = p->ha + m * (x - p->a) + (s - x) * (s - x) / (2.0 * R);
        if (h < best) { best = h; where = x; }
        gap = p->b;
    }
    *slope = (s - where) / R;
    return best;
}

/* Depth that acts at arc s under floor f (ecl). */
double depth_of(const Floor *f, int side, double s, double *slope)
{
    return M.path == PATH_ENVELOPE ? envelope_depth(f, s, equivalent_radius(side), slope) : point_depth(f, s, slope);
}

static int on_a_piece(const Floor *f, double s)
{
    for (int i = 0; i < f->count; i++)
        if (s >= f->piece[i].a && s <= f->piece[i].b) return 1;
    return 0;
}

void build_table(Defect *d, int side)
{
    Table *t = &d->table[side];
    const double R = equivalent_radius(side);
    t->nodes = NODES;
    t->from = d->first - d->reach;
    t->step = (d->last + d->reach - t->from) / (NODES - 1);
    t->section = need((size_t)(NODES * M.slices), sizeof(double));
    t->lifted = need((size_t)(NODES * M.slices), sizeof(double));
    for (int node = 0; node < NODES; node++)
        for (int k = 0; k < M.slices; k++) {
            const double s = t->from + node * t->step;
            double sum = 0.0;
            int lifted = 0;
            for (int i = 0; i < LINES; i++) {
                const Floor *f = &d->floor[k * LINES + i];
                double slope;
                if (!f->count) continue;
                const double h = envelope_depth(f, s, R, &slope);
                const int covered = on_a_piece(f, s);
                if (!covered && h >= 0.0) continue;
                lifted += !covered;
                sum += h;
            }
            t->section[node * M.slices + k] = sum / LINES;
            t->lifted[node * M.slices + k] = (double)lifted / LINES;
        }
}

double looked_up(const Table *t, const double *values, int k, double s, double *slope)
{
    const double x = (s - t->from) / t->step;
    int node = (int)floor(x);
    if (node < 0) node = 0;
    if (node > t->nodes - 2) node = t->nodes - 2;
    const double a = values[node * M.slices + k], b = values[(node + 1) * M.slices + k];
    *slope = (b - a) / t->step;
    return a + (b - a) * (x - node);
}
