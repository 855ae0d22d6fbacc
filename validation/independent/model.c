/* An independent implementation of the mathematical contract (model.md), written from the text alone.
 *
 * Planar cylindrical roller bearing: X right, Y up, angles counter-clockwise, SI units throughout.
 * Fixed-step classical Runge-Kutta of fourth order; nothing is tuned, everything is plain.
 * Section numbers in the comments are those of model.md.
 *
 * usage: model PARAMETERS > signals.csv     (the parameter text is written by generate.py)
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { RECTANGLE, CIRCLE, PROFILE, IRREGULAR, OUTLINE, DEPTH_MAP };
enum { LAW_ECL, LAW_SLICED };
enum { PATH_POINT, PATH_ENVELOPE };
enum { EDGE_NONE, EDGE_CONSERVATIVE };
enum { OUTER, INNER, ROLLER };
enum { START_ROLLING, START_REST, START_EQUILIBRIUM };
enum { GUIDE_NONE, GUIDE_OUTER, GUIDE_INNER };
enum { FILM_QUASI_STATIC, FILM_DYNAMIC };

typedef struct { double a, b, ha, hb; } Piece; /* depth ha at s = a to hb at s = b, linear between */

/* h(s) along the surface, whole (ecl) or under one slice: pieces in order of s, 0 outside them. */
typedef struct {
    int count, space;
    Piece *piece;
} Floor;

/* Of every slice at equal steps of s: the integral of h_env over what is covered over the slice's width, and the fraction that a raised edge
 * lifts beside it. */
typedef struct {
    int nodes;
    double from, step, *section, *lifted; /* [node * slices + slice] */
} Table;

typedef struct {
    int on, row, roller, shape, points; /* row and roller count from 0 */
    double psi, radius, depth;
    double offset;                      /* along z, of shapes given by width; others are moved as they are read */
    double length, width;               /* rectangle; width also the irregular shape's largest */
    double diameter;
    double *arc, *widths, *depths;      /* profile */
    int polygons, *corners;             /* outline */
    double **s, **z;
    int columns, rows;                  /* depth map */
    double s0, z0, ds, dz, *grid;
    double first, last;                 /* its arc */
    double reach;                       /* how far before it a raised edge lifts a roller */
    Floor *floor;                       /* one (ecl), or one per line z = const (sliced along the envelope) */
    Table table[2];                     /* by side, sliced along the envelope */
} Defect;

typedef struct {
    int rows, Z, total;
    double Di, Do, Rm, r, Ri, Ro, L, stagger, Cr, outer_gap, mi, mo, m, Ir;
    double mc, cage_a, cage_b, Ic, Cp, Cg, L1, kc, cc;
    int guide, film;
    double n, Kin, Kout, c;
    double mu, vs, eta, Cd, rho;
    double ki, ci, ko, co;
    int speed_points;
    double *speed_t, *speed_w;
    double load[2], ramp, g[2];
    int load_outer;
    int defects;
    Defect *defect;
    int reference, start, law, path, edge, slices;
    double duration, fs, step, perturb;
    int channels;
    char **channel;
} Model;

static Model M;

static void die(const char *what, const char *detail)
{
    fprintf(stderr, "model: %s %s\n", what, detail);
    exit(2);
}

static void *need(size_t n, size_t size)
{
    void *p = calloc(n ? n : 1, size);
    if (!p) die("out of memory", "");
    return p;
}

/* ---------- reading the parameter text ---------- */

static FILE *in;

static double num(void)
{
    double v;
    if (fscanf(in, "%lf", &v) != 1) die("number expected", "");
    return v;
}

static int integer(void) { return (int)num(); }

static void word(char *w)
{
    if (fscanf(in, "%63s", w) != 1) die("word expected", "");
}

static int pick(const char *w, const char *names[], int count)
{
    for (int i = 0; i < count; i++)
        if (!strcmp(w, names[i])) return i;
    die("unknown word", w);
    return -1;
}

static void read_defect(void)
{
    static const char *surfaces[] = {"outer-raceway", "inner-raceway", "roller"};
    static const char *shapes[] = {"rectangle", "circle", "profile", "li2023_irregular", "outline", "depth_map"};
    char w[64];
    M.defect = realloc(M.defect, sizeof(Defect) * (size_t)(M.defects + 1));
    if (!M.defect) die("out of memory", "");
    Defect *d = &M.defect[M.defects++];
    memset(d, 0, sizeof *d);
    word(w);
    d->on = pick(w, surfaces, 3);
    d->row = integer() - 1;
    d->roller = integer() - 1;
    d->psi = num();
    d->depth = num();
    d->offset = num();
    word(w);
    d->shape = pick(w, shapes, 6);
    if (d->shape == RECTANGLE) {
        d->length = num();
        d->width = num();
    } else if (d->shape == CIRCLE) {
        d->diameter = num();
    } else if (d->shape == IRREGULAR) {
        d->width = num();
    } else if (d->shape == OUTLINE) {
        d->polygons = integer();
        d->corners = need((size_t)d->polygons, sizeof(int));
        d->s = need((size_t)d->polygons, sizeof(double *));
        d->z = need((size_t)d->polygons, sizeof(double *));
        for (int k = 0; k < d->polygons; k++) {
            d->corners[k] = integer();
            d->s[k] = need((size_t)d->corners[k], sizeof(double));
            d->z[k] = need((size_t)d->corners[k], sizeof(double));
            for (int i = 0; i < d->corners[k]; i++) { d->s[k][i] = num(); d->z[k][i] = num() + d->offset; }
        }
    } else if (d->shape == DEPTH_MAP) {
        d->columns = integer();
        d->rows = integer();
        d->s0 = num();
        d->z0 = num() + d->offset;
        d->ds = num();
        d->dz = num();
        d->grid = need((size_t)(d->columns * d->rows), sizeof(double));
        for (int i = 0; i < d->columns * d->rows; i++) d->grid[i] = num();
    } else {
        d->points = integer();
        d->arc = need((size_t)d->points, sizeof(double));
        d->widths = need((size_t)d->points, sizeof(double));
        d->depths = need((size_t)d->points, sizeof(double));
        for (int i = 0; i < d->points; i++) {
            d->arc[i] = num();
            d->widths[i] = num();
            d->depths[i] = num();
        }
    }
}

static void build_floors(Defect *d);

static void read_model(const char *path)
{
    static const struct { const char *name; double *to; } reals[] = {
        {"inner_raceway_diameter", &M.Di}, {"outer_raceway_diameter", &M.Do}, {"pitch_radius", &M.Rm},
        {"roller_radius", &M.r}, {"roller_length", &M.L}, {"stagger", &M.stagger}, {"clearance", &M.Cr},
        {"outer_gap", &M.outer_gap}, {"inner_mass", &M.mi}, {"outer_mass", &M.mo}, {"roller_mass", &M.m},
        {"cage_mass", &M.mc}, {"cage_inner_radius", &M.cage_a}, {"cage_outer_radius", &M.cage_b},
        {"pocket_clearance", &M.Cp}, {"guide_clearance", &M.Cg}, {"guide_width", &M.L1},
        {"cage_stiffness", &M.kc}, {"cage_damping", &M.cc}, {"exponent", &M.n}, {"inner_stiffness", &M.Kin},
        {"outer_stiffness", &M.Kout}, {"contact_damping", &M.c}, {"friction", &M.mu}, {"slip_velocity", &M.vs},
        {"viscosity", &M.eta}, {"drag", &M.Cd}, {"density", &M.rho}, {"support_inner_stiffness", &M.ki},
        {"support_inner_damping", &M.ci}, {"support_outer_stiffness", &M.ko},
        {"support_outer_damping", &M.co}, {"load_x", &M.load[0]}, {"load_y", &M.load[1]}, {"ramp", &M.ramp},
        {"gravity_x", &M.g[0]}, {"gravity_y", &M.g[1]}, {"duration", &M.duration}, {"sample_rate", &M.fs},
        {"step", &M.step}, {"perturb", &M.perturb}};
    static const char *guides[] = {"rollers", "outer-ring", "inner-ring"};
    static const char *films[] = {"quasi-static", "dynamic"};
    static const char *starts[] = {"rolling", "rest", "equilibrium"};
    static const char *rings[] = {"inner-ring", "outer-ring"};
    static const char *models[] = {"full", "lumped"};
    static const char *laws[] = {"ecl", "sliced"};
    static const char *paths[] = {"point", "envelope"};
    static const char *edges[] = {"none", "conservative"};
    const int count = (int)(sizeof reals / sizeof reals[0]);
    char w[64];
    in = fopen(path, "r");
    if (!in) die("cannot open", path);
    while (fscanf(in, "%63s", w) == 1) {
        int i = 0;
        while (i < count && strcmp(w, reals[i].name)) i++;
        if (i < count) *reals[i].to = num();
        else if (!strcmp(w, "rows")) M.rows = integer();
        else if (!strcmp(w, "rollers")) M.Z = integer();
        else if (!strcmp(w, "guidance")) { word(w); M.guide = pick(w, guides, 3); }
        else if (!strcmp(w, "guidance_film")) { word(w); M.film = pick(w, films, 2); }
        else if (!strcmp(w, "start")) { word(w); M.start = pick(w, starts, 3); }
        else if (!strcmp(w, "load_on")) { word(w); M.load_outer = pick(w, rings, 2); }
        else if (!strcmp(w, "model")) { word(w); M.reference = pick(w, models, 2); }
        else if (!strcmp(w, "law")) { word(w); M.law = pick(w, laws, 2); }
        else if (!strcmp(w, "roller_path")) { word(w); M.path = pick(w, paths, 2); }
        else if (!strcmp(w, "edge_reaction")) { word(w); M.edge = pick(w, edges, 2); }
        else if (!strcmp(w, "slices")) M.slices = integer();
        else if (!strcmp(w, "defect")) read_defect();
        else if (!strcmp(w, "speed")) {
            M.speed_points = integer();
            M.speed_t = need((size_t)M.speed_points, sizeof(double));
            M.speed_w = need((size_t)M.speed_points, sizeof(double));
            for (int k = 0; k < M.speed_points; k++) { M.speed_t[k] = num(); M.speed_w[k] = num(); }
        } else if (!strcmp(w, "record")) {
            M.channels = integer();
            M.channel = need((size_t)M.channels, sizeof(char *));
            for (int k = 0; k < M.channels; k++) {
                word(w);
                M.channel[k] = need(strlen(w) + 1, 1);
                strcpy(M.channel[k], w);
            }
        } else die("unknown parameter", w);
    }
    fclose(in);
    M.total = M.rows * M.Z;
    M.Ri = 0.5 * M.Di;
    M.Ro = 0.5 * M.Do;
    M.Ir = 0.5 * M.m * M.r * M.r;
    M.Ic = 0.5 * M.mc * (M.cage_a * M.cage_a + M.cage_b * M.cage_b);
    for (int i = 0; i < M.defects; i++) {
        Defect *d = &M.defect[i];
        d->radius = d->on == OUTER ? M.Ro : d->on == INNER ? M.Ri : M.r;
        build_floors(d);
    }
    if (M.edge && !(M.law == LAW_SLICED && M.path == PATH_ENVELOPE)) die("edge reaction:", "sliced and envelope only");
    if (M.reference && (M.law || M.path)) die("the lumped model", "is written for ecl and point");
}

/* ---------- prescribed motion and load ---------- */

/* Inner-ring speed and angle; the profile is linear between its points and constant beyond them. */
static void drive(double t, double *w, double *angle)
{
    const double *T = M.speed_t, *W = M.speed_w;
    const int n = M.speed_points;
    double sum = 0.0;
    if (t <= T[0]) {
        *w = W[0];
        *angle = W[0] * t;
        return;
    }
    sum = W[0] * T[0];
    for (int i = 0; i + 1 < n; i++) {
        const double dt = T[i + 1] - T[i];
        if (t <= T[i + 1]) {
            const double x = t - T[i], slope = (W[i + 1] - W[i]) / dt;
            *w = W[i] + slope * x;
            *angle = sum + x * (W[i] + 0.5 * slope * x);
            return;
        }
        sum += 0.5 * dt * (W[i] + W[i + 1]);
    }
    *w = W[n - 1];
    *angle = sum + W[n - 1] * (t - T[n - 1]);
}

static double ramp_factor(double t)
{
    if (M.start == START_EQUILIBRIUM || M.ramp <= 0.0) return 1.0;
    return t < M.ramp ? t / M.ramp : 1.0;
}

/* ---------- defects, section 3 ---------- */

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

#define IRREGULAR_ARC (1.6695 + 1.5000 + 0.7071 + 1.4142 + 0.7071 + 1.0000)

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Where the line p = at crosses an outline's edges, ascending in the other coordinate q. Between odd and even crossings lies
 * damage, so a polygon within another is a hole. Half-open edges: a corner on the line counts once. */
static int crossings(const Defect *d, double **p, double **q, double at, double *found, int space)
{
    int count = 0;
    for (int k = 0; k < d->polygons; k++)
        for (int i = 0; i < d->corners[k]; i++) {
            const int j = (i + 1) % d->corners[k];
            const double pa = p[k][i], pb = p[k][j];
            if ((pa <= at) == (pb <= at)) continue;
            if (count == space) die("outline:", "too many crossings");
            found[count++] = q[k][i] + (at - pa) / (pb - pa) * (q[k][j] - q[k][i]);
        }
    qsort(found, (size_t)count, sizeof(double), ascending);
    return count;
}

enum { CROSSINGS = 64 };

static double within(double from, double to, double lo, double hi)
{
    return fmax(fmin(to, hi) - fmax(from, lo), 0.0);
}

/* L_s(s): the measure of the damaged z under the roller. */
static double outline_width(const Defect *d, double s)
{
    double z[CROSSINGS], sum = 0.0;
    const int count = crossings(d, d->s, d->z, s, z, CROSSINGS);
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
    case DEPTH_MAP:
        die("depth map:", "sliced only");
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

/* Damaged length and depth at local angle u; returns 0 outside the arc. */
static int defect_at(const Defect *d, double u, double *Ls, double *h)
{
    double w;
    if (!width_at(d, u * d->radius, &w, h)) return 0;
    *Ls = d->shape == OUTLINE ? w : within(d->offset - 0.5 * w, d->offset + 0.5 * w, -0.5 * M.L, 0.5 * M.L);
    return 1;
}

/* Local angle of a roller on a defect's surface as met by the contact `side` (OUTER or INNER);
 * returns 0 where this defect never meets that contact. */
static int local_angle(const Defect *d, int side, int row, int j, double theta, double phi, double W, double *u)
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

/* ---------- floors of `sliced` and `envelope`, section 3 ---------- */

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

static double slice_border(int k) { return ((double)k / M.slices - 0.5) * M.L; }

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
    if (M.path == PATH_ENVELOPE) d->reach = sqrt(2.0 * raised * fmax(equivalent_radius(OUTER), equivalent_radius(INNER)));
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

static void build_floors(Defect *d)
{
    find_arc(d);
    find_reach(d);
    if (M.law == LAW_ECL) {
        d->floor = need(1, sizeof(Floor));
        if (d->shape == OUTLINE) outline_floor(d, d->floor); /* not where polygons leave a gap: that is outside the defect */
        else add_range(d, d->floor, d->first, d->last);
        return;
    }
    if (M.path != PATH_ENVELOPE) return;
    d->floor = need((size_t)M.slices * LINES, sizeof(Floor));
    for (int i = 0; i < M.slices * LINES; i++) {
        const int k = i / LINES;
        line_floor(d, &d->floor[i], slice_border(k) + (i % LINES + 0.5) / LINES * (slice_border(k + 1) - slice_border(k)));
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

/* h_env(s) = min over s' of h(s') + (s - s')^2 / (2 R), exactly: within a piece the minimum is at s - R dh/ds or at an end, outside
 * them at s itself or at the nearest end. Its slope is (s - s')/R at the s' that holds the roller up. */
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
static double depth_of(const Floor *f, int side, double s, double *slope)
{
    return M.path == PATH_ENVELOPE ? envelope_depth(f, s, equivalent_radius(side), slope) : point_depth(f, s, slope);
}

static int on_a_piece(const Floor *f, double s)
{
    for (int i = 0; i < f->count; i++)
        if (s >= f->piece[i].a && s <= f->piece[i].b) return 1;
    return 0;
}

static void build_table(Defect *d, int side)
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

static double looked_up(const Table *t, const double *values, int k, double s, double *slope)
{
    const double x = (s - t->from) / t->step;
    int node = (int)floor(x);
    if (node < 0) node = 0;
    if (node > t->nodes - 2) node = t->nodes - 2;
    const double a = values[node * M.slices + k], b = values[(node + 1) * M.slices + k];
    *slope = (b - a) / t->step;
    return a + (b - a) * (x - node);
}

static double power(double x)
{
    return x > 0.0 ? pow(x, M.n) : 0.0;
}

static double factor(double Ls)
{
    return pow((M.L - Ls) / M.L, 8.0 / 9.0);
}

typedef struct {
    double elastic;   /* K times the bracketed sum */
    double stiffness; /* its derivative by delta */
    double length;    /* L_e of the acting defect (ecl) */
    double push;      /* -dE/du of the damage's slopes, all of it */
    double push_own;  /* the part that damage on the roller has in it */
} Elastic;

enum { INTERVALS = 256 };

/* A defect at its s: which z it covers, ascending. */
typedef struct {
    const Defect *d;
    double s, h, from[INTERVALS], to[INTERVALS];
    int count;
} Met;

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

static void find_cover(Met *m, const Defect *d, double s)
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

/* phi of slice k, and the mean depth at a point: the deepest of all that cover it, between all ends of what they cover. */
static double fraction(const Met *met, int count, int k, double *mean)
{
    static const double at[3] = {0.1127016653792583, 0.5, 0.8872983346207417}, weight[3] = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
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
        if (slope) e.stiffness += K / M.slices * ((1.0 - share) * whole_rise + (share > 0.0 && x > 0.0 ? share * M.n * pow(x, M.n - 1.0) : 0.0));
        if (M.edge == EDGE_CONSERVATIVE && share > 0.0) {
            /* -dE/ds with E = (1 - phi) E(delta) + phi E(delta - h) and h = section / phi; the fraction's slope by a difference. */
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
static Elastic elastic_law(int side, int row, int j, double theta, double phi, double W, double delta, int slope)
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

/* ---------- state ----------
 * q: x_i y_i x_o y_o | per cage x y theta | per roller r theta phi; then the same for the velocities.
 */

static int dof;

static int cage_at(int row) { return 4 + 3 * row; }
static int roller_at(int k) { return 4 + 3 * M.rows + 3 * k; }
static double pocket_angle(int row, int j) { return 2.0 * PI * j / M.Z + row * M.stagger; }

typedef struct {
    double outer_force, inner_force, outer_length, inner_length, pocket, slip_inner, slip_outer, ax, ay;
} Detail;

static Detail *detail; /* filled only when asked for, at output instants */

static double traction(double u)
{
    u = fabs(u);
    return (-0.1 + 22.28 * u) * exp(-181.46 * u) + 0.1;
}

/* Forces of supports, gravity and load on both rings. */
static void ring_forces(double t, const double *q, const double *v, double *Fi, double *Fo)
{
    const double k = ramp_factor(t);
    for (int a = 0; a < 2; a++) {
        Fi[a] = -M.ki * q[a] - M.ci * v[a] + M.mi * M.g[a];
        Fo[a] = -M.ko * q[2 + a] - M.co * v[2 + a] + M.mo * M.g[a];
        if (M.load_outer) Fo[a] -= k * M.load[a];
        else Fi[a] += k * M.load[a];
    }
}

/* Section 8: accelerations of every coordinate. */
/* Section 6, the dynamic film's integral by Gauss-Legendre, five points on each panel of the half circle about v*. */
static void pushing_film(double ex, double ey, double vx, double vy, double scale, double *fx, double *fy)
{
    enum { PANELS = 16, POINTS = 5 };
    static const double x[POINTS] = {-0.906179845938663993, -0.538469310105683091, 0.0, 0.538469310105683091, 0.906179845938663993};
    static const double weight[POINTS] = {0.236926885056189088, 0.478628670499366468, 0.568888888888888889, 0.478628670499366468,
                                          0.236926885056189088};
    static double node_cos[PANELS * POINTS], node_sin[PANELS * POINTS], node_weight[PANELS * POINTS];
    if (node_weight[0] == 0.0)
        for (int k = 0; k < PANELS * POINTS; k++) {
            const double angle = PI * ((k / POINTS + 0.5 + 0.5 * x[k % POINTS]) / PANELS - 0.5);
            node_cos[k] = cos(angle);
            node_sin[k] = sin(angle);
            node_weight[k] = 0.5 * PI / PANELS * weight[k % POINTS];
        }
    const double speed = sqrt(vx * vx + vy * vy);
    *fx = *fy = 0.0;
    if (speed == 0.0) return;
    const double ax = vx / speed, ay = vy / speed;
    double sx = 0.0, sy = 0.0;
    for (int k = 0; k < PANELS * POINTS; k++) {
        const double nx = ax * node_cos[k] - ay * node_sin[k], ny = ay * node_cos[k] + ax * node_sin[k];
        const double h = M.Cg - ex * nx - ey * ny, share = node_weight[k] * node_cos[k] / (h * h * h);
        sx += share * nx;
        sy += share * ny;
    }
    *fx = -scale * speed * sx;
    *fy = -scale * speed * sy;
}

static void accelerations(double t, const double *q, const double *v, double *acc, int want)
{
    double wi, W, Fi[2], Fo[2];
    drive(t, &wi, &W);
    ring_forces(t, q, v, Fi, Fo);
    const double xi = q[0], yi = q[1], xo = q[2], yo = q[3];
    const double vxi = v[0], vyi = v[1], vxo = v[2], vyo = v[3];

    for (int row = 0; row < M.rows; row++) {
        const int c = cage_at(row);
        const double xc = q[c], yc = q[c + 1], thc = q[c + 2];
        const double vxc = v[c], vyc = v[c + 1], wc = v[c + 2];
        double Fcx = M.mc * M.g[0], Fcy = M.mc * M.g[1], Tc = 0.0;

        for (int j = 0; j < M.Z; j++) {
            const int k = row * M.Z + j, p = roller_at(k);
            const double rj = q[p], th = q[p + 1], ph = q[p + 2];
            const double drj = v[p], dth = v[p + 1], dph = v[p + 2];
            const double ex = cos(th), ey = sin(th), tx = -ey, ty = ex;

            /* section 2 */
            const double din = ex * xi + ey * yi - rj - M.Cr;
            const double ddin = ex * vxi + ey * vyi + dth * (tx * xi + ty * yi) - drj;
            const double dout = rj - (ex * xo + ey * yo) - M.outer_gap;
            const double ddout = drj - (ex * vxo + ey * vyo) - dth * (tx * xo + ty * yo);
            double Qin = 0.0, Qout = 0.0, Lin = M.L, Lout = M.L;
            double push = 0.0, push_own = 0.0;
            if (din > 0.0 || want || M.law == LAW_SLICED) { /* a raised slice touches sooner */
                const Elastic e = elastic_law(INNER, row, j, th, ph, W, din, 0);
                if (e.elastic > 0.0) Qin = fmax(e.elastic + M.c * ddin, 0.0);
                Lin = e.length;
                push += e.push;
                push_own += e.push_own;
            }
            if (dout > 0.0 || want || M.law == LAW_SLICED) {
                const Elastic e = elastic_law(OUTER, row, j, th, ph, W, dout, 0);
                if (e.elastic > 0.0) Qout = fmax(e.elastic + M.c * ddout, 0.0);
                Lout = e.length;
                push += e.push;
                push_own += e.push_own;
            }

            /* section 4 */
            const double vt = M.Rm * dth;
            const double sin_ = wi * M.Ri + tx * vxi + ty * vyi - (vt - M.r * dph);
            const double sout = tx * vxo + ty * vyo - (vt + M.r * dph);
            const double fin = Qin > 0.0 ? M.mu * Qin * tanh(sin_ / M.vs) : 0.0;
            const double fout = Qout > 0.0 ? M.mu * Qout * tanh(sout / M.vs) : 0.0;

            /* section 5 */
            const double s = M.Rm * (thc + pocket_angle(row, j) - th) + tx * xc + ty * yc;
            double Fc = 0.0, fc = 0.0, sigma = 0.0;
            if (fabs(s) > M.Cp) {
                const double ds = M.Rm * (wc - dth) + tx * vxc + ty * vyc - dth * (ex * xc + ey * yc);
                if (s > 0.0) Fc = fmax(M.kc * (s - M.Cp) + M.cc * ds, 0.0);
                else Fc = -fmax(M.kc * (-s - M.Cp) - M.cc * ds, 0.0);
                if (Fc != 0.0) {
                    sigma = Fc > 0.0 ? -1.0 : 1.0;
                    const double u = drj - sigma * M.r * (dph - wc) - (ex * vxc + ey * vyc);
                    if (u != 0.0) fc = -traction(u) * fabs(Fc) * (u > 0.0 ? 1.0 : -1.0);
                }
            }

            /* section 7 */
            const double Fd = 0.5 * M.Cd * M.rho * M.L * (2.0 * M.r) * vt * fabs(vt);

            /* section 8, roller */
            const double R = M.Rm + rj;
            const double radial = Qin - Qout + fc + M.m * (M.g[0] * ex + M.g[1] * ey);
            const double tangential = fin + fout + Fc - Fd + push / R + M.m * (M.g[0] * tx + M.g[1] * ty);
            acc[p] = radial / M.m + R * dth * dth;
            acc[p + 1] = (tangential / M.m - 2.0 * drj * dth) / R;
            acc[p + 2] = (M.r * (fout - fin) - sigma * M.r * fc - push_own) / M.Ir;

            /* reactions */
            Fi[0] += -Qin * ex - fin * tx;
            Fi[1] += -Qin * ey - fin * ty;
            Fo[0] += Qout * ex - fout * tx;
            Fo[1] += Qout * ey - fout * ty;
            Fcx += -Fc * tx - fc * ex;
            Fcy += -Fc * ty - fc * ey;
            Tc += -Fc * M.Rm + sigma * M.r * fc;

            if (want) {
                Detail *o = &detail[k];
                o->outer_force = Qout;
                o->inner_force = Qin;
                o->outer_length = Lout;
                o->inner_length = Lin;
                o->pocket = Fc;
                o->slip_inner = sin_;
                o->slip_outer = sout;
                const double ar = radial / M.m, at = tangential / M.m;
                o->ax = ar * ex + at * tx;
                o->ay = ar * ey + at * ty;
            }
        }

        /* section 6 */
        {
            /* Rollers as guides: no film, the outer ring's land alone, damped (docs/src/theory/cage.md). */
            const double eta = M.guide == GUIDE_NONE ? 0.0 : M.eta;
            const int outer = M.guide != GUIDE_INNER;
            const double gx = xc - (outer ? xo : xi), gy = yc - (outer ? yo : yi);
            const double e = sqrt(gx * gx + gy * gy), eps = fmin(e / M.Cg, 0.95);
            const double nx = e > 0.0 ? gx / e : 1.0, ny = e > 0.0 ? gy / e : 0.0;
            const double wg = outer ? 0.0 : wi, R1 = outer ? M.cage_b : M.cage_a;
            const double ue = R1 * (wc + wg), ud = R1 * (wc - wg), one = 1.0 - eps * eps;
            double Fn = -eta * fabs(ue) * M.L1 * M.L1 * M.L1 * eps * eps / (M.Cg * M.Cg * one * one);
            const double Ft = PI * eta * ue * M.L1 * M.L1 * M.L1 * eps / (4.0 * M.Cg * M.Cg * one * sqrt(one));
            const int paper = M.guide != GUIDE_NONE && M.film == FILM_QUASI_STATIC;
            if (paper && e > M.Cg) Fn -= M.kc * (e - M.Cg);
            double fx = Fn * nx - Ft * ny, fy = Fn * ny + Ft * nx;
            if (!paper) {
                const double gvx = vxc - v[outer ? 2 : 0], gvy = vyc - v[outer ? 3 : 1];
                const double half = 0.5 * (wc + wg), held = e > 0.0 ? eps * M.Cg / e : 1.0;
                pushing_film(held * gx, held * gy, gvx + half * gy, gvy - half * gx, eta * R1 * M.L1 * M.L1 * M.L1, &fx, &fy);
                if (e > M.Cg) {
                    const double land = fmax(M.kc * (e - M.Cg) + M.cc * (gvx * nx + gvy * ny), 0.0);
                    fx -= land * nx;
                    fy -= land * ny;
                }
            }
            Fcx += fx;
            Fcy += fy;
            Tc += -2.0 * PI * eta * ud * R1 * R1 * M.L1 / (M.Cg * sqrt(one));
            if (outer) { Fo[0] -= fx; Fo[1] -= fy; }
            else { Fi[0] -= fx; Fi[1] -= fy; }
        }
        acc[c] = Fcx / M.mc;
        acc[c + 1] = Fcy / M.mc;
        acc[c + 2] = Tc / M.Ic;
    }
    acc[0] = Fi[0] / M.mi;
    acc[1] = Fi[1] / M.mi;
    acc[2] = Fo[0] / M.mo;
    acc[3] = Fo[1] / M.mo;
}

/* Section 10: kinematic cage, contacts in series; only the rings move. */
static void reference_accelerations(double t, const double *q, const double *v, double *acc, int want)
{
    double wi, W, Fi[2], Fo[2];
    drive(t, &wi, &W);
    ring_forces(t, q, v, Fi, Fo);
    if (M.load_outer)
        for (int a = 0; a < 2; a++) Fo[a] += M.ko * q[2 + a] + M.co * v[2 + a]; /* no support */
    const double dth = wi * M.Ri / (2.0 * M.Rm), turn = W * M.Ri / (2.0 * M.Rm);
    const double spin = -W * M.Ri / (2.0 * M.r); /* the pure-rolling angle */
    for (int row = 0; row < M.rows; row++)
        for (int j = 0; j < M.Z; j++) {
            const double th = pocket_angle(row, j) + turn;
            const double ex = cos(th), ey = sin(th), tx = -ey, ty = ex;
            const double x = q[0] - q[2], y = q[1] - q[3];
            double delta = ex * x + ey * y - M.Cr - M.outer_gap;
            const double dd = ex * (v[0] - v[2]) + ey * (v[1] - v[3]) + dth * (tx * x + ty * y);
            double g[2] = {1.0, 1.0}, depth[2] = {0.0, 0.0}, length[2] = {M.L, M.L};
            for (int side = OUTER; side <= INNER; side++)
                for (int i = 0; i < M.defects; i++) {
                    double u, Ls, h;
                    if (!local_angle(&M.defect[i], side, row, j, th, spin, W, &u)) continue;
                    if (!defect_at(&M.defect[i], u, &Ls, &h)) continue;
                    if (Ls < M.L) g[side] = fmin(g[side], factor(Ls));
                    else depth[side] = fmax(depth[side], h);
                    length[side] = fmin(length[side], M.L - Ls);
                }
            delta -= depth[OUTER] + depth[INNER];
            double Q = 0.0;
            if (delta > 0.0) {
                const double Ks = pow(pow(M.Kin * g[INNER], -1.0 / M.n) + pow(M.Kout * g[OUTER], -1.0 / M.n), -M.n);
                Q = fmax(Ks * pow(delta, M.n) + 0.5 * M.c * dd, 0.0);
            }
            Fi[0] -= Q * ex;
            Fi[1] -= Q * ey;
            Fo[0] += Q * ex;
            Fo[1] += Q * ey;
            if (want) {
                Detail *o = &detail[row * M.Z + j];
                memset(o, 0, sizeof *o);
                o->outer_force = o->inner_force = Q;
                o->outer_length = length[OUTER];
                o->inner_length = length[INNER];
            }
        }
    acc[0] = Fi[0] / M.mi;
    acc[1] = Fi[1] / M.mi;
    acc[2] = M.load_outer ? Fo[0] / M.mo : 0.0;
    acc[3] = M.load_outer ? Fo[1] / M.mo : 0.0;
}

static void rates(double t, const double *q, const double *v, double *acc, int want)
{
    if (M.reference) reference_accelerations(t, q, v, acc, want);
    else accelerations(t, q, v, acc, want);
}

/* ---------- start, section 9 ---------- */

/* Radial balance of one roller between ring shifts a, b along its normal: Q_in + push = Q_out.
 * The left side falls and the right one rises with r_j, so bisection cannot fail. */
static double settle_roller(int row, int j, double a, double b, double push, double *Qin, double *Qout,
                            double *kin, double *kout)
{
    const double th = pocket_angle(row, j);
    double lo = fmin(b + M.outer_gap, a - M.Cr) - 1e-4, hi = fmax(b + M.outer_gap, a - M.Cr) + 1e-4;
    Elastic ein, eout;
    for (int it = 0; it < 200; it++) {
        const double r = 0.5 * (lo + hi);
        ein = elastic_law(INNER, row, j, th, 0.0, 0.0, a - r - M.Cr, 0);
        eout = elastic_law(OUTER, row, j, th, 0.0, 0.0, r - b - M.outer_gap, 0);
        if (ein.elastic + push > eout.elastic) lo = r;
        else hi = r;
    }
    const double r = 0.5 * (lo + hi);
    ein = elastic_law(INNER, row, j, th, 0.0, 0.0, a - r - M.Cr, 1);
    eout = elastic_law(OUTER, row, j, th, 0.0, 0.0, r - b - M.outer_gap, 1);
    *Qin = ein.elastic;
    *Qout = eout.elastic;
    *kin = ein.stiffness;
    *kout = eout.stiffness;
    return r;
}

/* Residual force on the rings and its (negative) Jacobian. */
static double balance(const double *x, double w, double *F, double J[4][4], double *r)
{
    const double zero[4] = {0, 0, 0, 0};
    ring_forces(0.0, x, zero, F, F + 2);
    memset(J, 0, 16 * sizeof(double));
    J[0][0] = J[1][1] = M.ki;
    J[2][2] = J[3][3] = M.ko;
    for (int row = 0; row < M.rows; row++)
        for (int j = 0; j < M.Z; j++) {
            const double th = pocket_angle(row, j), e[2] = {cos(th), sin(th)};
            const double push = M.m * M.Rm * w * w + M.m * (M.g[0] * e[0] + M.g[1] * e[1]);
            double Qin, Qout, kin, kout;
            r[row * M.Z + j] = settle_roller(row, j, e[0] * x[0] + e[1] * x[1], e[0] * x[2] + e[1] * x[3], push,
                                             &Qin, &Qout, &kin, &kout);
            const double ks = kin + kout > 0.0 ? kin * kout / (kin + kout) : 0.0;
            for (int a = 0; a < 2; a++) {
                F[a] -= Qin * e[a];
                F[2 + a] += Qout * e[a];
                for (int b = 0; b < 2; b++) {
                    J[a][b] += ks * e[a] * e[b];
                    J[2 + a][2 + b] += ks * e[a] * e[b];
                    J[a][2 + b] -= ks * e[a] * e[b];
                    J[2 + a][b] -= ks * e[a] * e[b];
                }
            }
        }
    return sqrt(F[0] * F[0] + F[1] * F[1] + F[2] * F[2] + F[3] * F[3]);
}

static void solve4(double A[4][4], double *b)
{
    for (int i = 0; i < 4; i++) {
        int p = i;
        for (int k = i + 1; k < 4; k++)
            if (fabs(A[k][i]) > fabs(A[p][i])) p = k;
        if (A[p][i] == 0.0) die("singular static balance", "");
        for (int c = 0; c < 4; c++) { const double x = A[i][c]; A[i][c] = A[p][c]; A[p][c] = x; }
        { const double x = b[i]; b[i] = b[p]; b[p] = x; }
        for (int k = i + 1; k < 4; k++) {
            const double f = A[k][i] / A[i][i];
            for (int c = i; c < 4; c++) A[k][c] -= f * A[i][c];
            b[k] -= f * b[i];
        }
    }
    for (int i = 3; i >= 0; i--) {
        for (int c = i + 1; c < 4; c++) b[i] -= A[i][c] * b[c];
        b[i] /= A[i][i];
    }
}

static void equilibrium(double *q, double w)
{
    double x[4] = {0, 0, 0, 0}, F[4], J[4][4], *r = need((size_t)M.total, sizeof(double));
    double size = balance(x, w, F, J, r);
    for (int it = 0; it < 500 && size > 1e-9; it++) {
        double d[4], y[4], best = size, damp = 1.0;
        memcpy(d, F, sizeof d);
        solve4(J, d);
        for (int half = 0; half < 40; half++, damp *= 0.5) {
            for (int a = 0; a < 4; a++) y[a] = x[a] + damp * d[a];
            best = balance(y, w, F, J, r);
            if (best < size) break;
        }
        if (!(best < size)) break;
        memcpy(x, y, sizeof x);
        size = best;
    }
    size = balance(x, w, F, J, r);
    fprintf(stderr, "static balance: residual %.3e N; rings %.9e %.9e %.9e %.9e m\n", size, x[0], x[1], x[2], x[3]);
    if (!(size < 1e-6)) die("static balance not found", "");
    memcpy(q, x, sizeof x);
    for (int k = 0; k < M.total; k++) q[roller_at(k)] = r[k];
    free(r);
}

static void begin(double *q, double *v)
{
    double w, W;
    drive(0.0, &w, &W);
    const double orbit = w * M.Ri / (2.0 * M.Rm);
    memset(q, 0, sizeof(double) * (size_t)dof);
    memset(v, 0, sizeof(double) * (size_t)dof);
    q[0] = q[1] = q[2] = q[3] = 1e-6;
    if (M.reference) {
        if (!M.load_outer) q[2] = q[3] = 0.0; /* rigidly mounted */
        if (M.start == START_EQUILIBRIUM) die("equilibrium of the lumped model", "is not offered here");
        q[0] += M.perturb;
        return;
    }
    const int moving = M.start != START_REST;
    for (int row = 0; row < M.rows; row++) {
        if (moving) v[cage_at(row) + 2] = orbit;
        for (int j = 0; j < M.Z; j++) {
            const int p = roller_at(row * M.Z + j);
            q[p + 1] = pocket_angle(row, j);
            if (moving) {
                v[p + 1] = orbit;
                v[p + 2] = -(w * M.Ri - M.Rm * orbit) / M.r;
            }
        }
    }
    if (M.start == START_EQUILIBRIUM) equilibrium(q, orbit);
    q[0] += M.perturb;
}

/* ---------- output ---------- */

static double channel(const char *name, double t, const double *q, const double *v, const double *acc)
{
    int row, j, used = 0, p;
    const char *rest;
    if (!strcmp(name, "t")) return t;
    if (!strncmp(name, "inner_", 6) || !strncmp(name, "outer_", 6)) {
        static const char *axes[] = {"x", "y", "vx", "vy", "ax", "ay"};
        const int k = pick(name + 6, axes, 6), base = name[0] == 'o' ? 2 : 0;
        return (k < 2 ? q : k < 4 ? v : acc)[base + k % 2];
    }
    if (sscanf(name, "cage%d_%n", &row, &used) == 1 && used) {
        rest = name + used;
        p = cage_at(row - 1);
        if (!strcmp(rest, "x")) return q[p];
        if (!strcmp(rest, "y")) return q[p + 1];
        if (!strcmp(rest, "ax")) return acc[p];
        if (!strcmp(rest, "ay")) return acc[p + 1];
        if (!strcmp(rest, "speed")) return v[p + 2];
    }
    used = 0;
    if (sscanf(name, "roller%d_%d_%n", &row, &j, &used) == 2 && used) {
        rest = name + used;
        const int k = (row - 1) * M.Z + j - 1;
        p = roller_at(k);
        if (!strcmp(rest, "r")) return q[p];
        if (!strcmp(rest, "x")) return q[p] * cos(q[p + 1]);
        if (!strcmp(rest, "y")) return q[p] * sin(q[p + 1]);
        if (!strcmp(rest, "ax")) return detail[k].ax;
        if (!strcmp(rest, "ay")) return detail[k].ay;
        if (!strcmp(rest, "orbit")) return q[p + 1];
        if (!strcmp(rest, "orbit_speed")) return v[p + 1];
        if (!strcmp(rest, "spin")) return q[p + 2];
        if (!strcmp(rest, "spin_speed")) return v[p + 2];
        if (!strcmp(rest, "slip_inner")) return detail[k].slip_inner;
        if (!strcmp(rest, "slip_outer")) return detail[k].slip_outer;
    }
    used = 0;
    if (sscanf(name, "contact%d_%d_%n", &row, &j, &used) == 2 && used) {
        const Detail *o = &detail[(row - 1) * M.Z + j - 1];
        rest = name + used;
        if (!strcmp(rest, "outer_force")) return o->outer_force;
        if (!strcmp(rest, "inner_force")) return o->inner_force;
        if (!strcmp(rest, "outer_length")) return o->outer_length;
        if (!strcmp(rest, "inner_length")) return o->inner_length;
    }
    used = 0;
    if (sscanf(name, "pocket%d_%d_%n", &row, &j, &used) == 2 && used && !strcmp(name + used, "force"))
        return detail[(row - 1) * M.Z + j - 1].pocket;
    die("unknown channel", name);
    return 0.0;
}

/* ---------- integration ---------- */

int main(int argc, char **argv)
{
    if (argc != 2) die("usage:", "model PARAMETERS");
    read_model(argv[1]);
    dof = M.reference ? 4 : 4 + 3 * M.rows + 3 * M.total;
    detail = need((size_t)M.total, sizeof(Detail));
    const size_t n = (size_t)dof;
    double *store = need(12 * n, sizeof(double));
    double *q = store, *v = q + n, *q2 = v + n, *v2 = q2 + n, *v3 = v2 + n, *v4 = v3 + n;
    double *a1 = v4 + n, *a2 = a1 + n, *a3 = a2 + n, *a4 = a3 + n;
    begin(q, v);

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
