/* Reading the parameter text. */
#include "parameters.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "floors.h"
#include "halfspace.h"
#include "hertz.h"
#include "model.h"
#include "waviness.h"

static FILE *in;

void open_text(const char *path)
{
    in = fopen(path, "r");
    if (!in) die("cannot open", path);
}

double num(void)
{
    double v;
    if (fscanf(in, "%lf", &v) != 1) die("number expected", "");
    return v;
}

int integer(void) { return (int)num(); }

static void word(char *w)
{
    if (fscanf(in, "%63s", w) != 1) die("word expected", "");
}

static void ready_points(Defect *d, int points)
{
    d->points = points;
    d->arc = need((size_t)points, sizeof(double));
    d->widths = need((size_t)points, sizeof(double));
    d->depths = need((size_t)points, sizeof(double));
}

/* A depth map in `ecl`: at a column L_s is the number of its damaged nodes times dz, h their mean depth. */
static void read_map(Defect *d)
{
    const int columns = integer(), rows = integer();
    const double s0 = num(), z0 = num() + d->offset, ds = num(), dz = num();
    if (fmax(fabs(z0), fabs(z0 + (rows - 1) * dz)) > 0.5 * M.L) die("depth map:", "wider than the roller");
    d->offset = 0.0; /* all of it lies on the roller */
    ready_points(d, columns);
    for (int i = 0; i < columns; i++) d->arc[i] = s0 + i * ds;
    for (int i = 0; i < columns * rows; i++) {
        const double h = num();
        if (h < 0.0) die("depth map:", "raised edges are not covered");
        if (h > 0.0) d->widths[i % columns] += dz;
        d->depths[i % columns] += h * dz;
    }
    for (int i = 0; i < columns; i++)
        if (d->widths[i] > 0.0) d->depths[i] /= d->widths[i];
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
    const int map = sizeof shapes / sizeof shapes[0] - 1, shape = pick(w, shapes, map + 1);
    d->shape = shape == map ? PROFILE : shape;
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
    } else if (shape == map) {
        read_map(d);
    } else {
        ready_points(d, integer());
        for (int i = 0; i < d->points; i++) {
            d->arc[i] = num();
            d->widths[i] = num();
            d->depths[i] = num();
        }
    }
}

static void read_waves(Waves *w)
{
    w->amplitude = num();
    w->exponent = num();
    w->first = integer();
    w->last = integer();
}

static void read_profile(void)
{
    static const char *kinds[] = {"straight", "logarithmic", "crowned", "drops"};
    char w[64];
    word(w);
    M.profile = pick(w, kinds, 4);
    if (M.profile == CROWNED) M.crowned = num();
    if (M.profile != DROPS) return;
    M.drops = integer();
    M.drop_z = need((size_t)M.drops, sizeof(double));
    M.drop = need((size_t)M.drops, sizeof(double));
    for (int i = 0; i < M.drops; i++) { M.drop_z[i] = num(); M.drop[i] = num(); }
}

static void read_damage(void)
{
    static const char *surfaces[] = {"outer-raceway", "inner-raceway", "roller"};
    char w[64];
    M.damage = realloc(M.damage, sizeof(Damage) * (size_t)(M.damages + 1));
    if (!M.damage) die("out of memory", "");
    Damage *d = &M.damage[M.damages++];
    memset(d, 0, sizeof *d);
    word(w);
    d->on = pick(w, surfaces, 3);
    d->row = integer() - 1;
    d->roller = integer() - 1;
    d->psi = num();
    d->ns = integer();
    d->nd = integer();
    d->s = need((size_t)d->ns, sizeof(double));
    d->d = need((size_t)d->nd, sizeof(double));
    d->f = need((size_t)(d->ns * d->nd), sizeof(double));
    for (int i = 0; i < d->ns; i++) d->s[i] = num();
    for (int i = 0; i < d->nd; i++) d->d[i] = num();
    for (int i = 0; i < d->ns * d->nd; i++) d->f[i] = num();
    spline_damage(d);
}

void read_model(const char *path)
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
        {"step", &M.step}, {"perturb", &M.perturb}, {"damping_time", &M.tau}, {"roughness", &M.roughness},
        {"rolling", &M.rolling}, {"pocket_friction", &M.pocket_friction}, {"housing_mass", &M.housing},
        {"width", &M.width}, {"row_spacing", &M.spacing}, {"load_offset", &M.load_offset},
        {"inner_tilt_stiffness", &M.tilt_stiffness[0]}, {"outer_tilt_stiffness", &M.tilt_stiffness[1]},
        {"inner_tilt_damping", &M.tilt_damping[0]}, {"outer_tilt_damping", &M.tilt_damping[1]}, {"seed", &M.seed}, {"tolerance", &M.tolerance}};
    static const char *guides[] = {"rollers", "outer-ring", "inner-ring"};
    static const char *films[] = {"quasi-static", "dynamic"};
    static const char *starts[] = {"rolling", "rest", "equilibrium"};
    static const char *rings[] = {"inner-ring", "outer-ring"};
    static const char *models[] = {"full", "lumped", "tilting"};
    static const char *laws[] = {"ecl", "half-space"};
    static const char *paths[] = {"point", "envelope"};
    static const char *geometries[] = {"centred", "exact"};
    static const char *elements[] = {"roller", "ball"};
    static const char *walls[] = {"linear", "oiled"};
    static const char *pockets[] = {"slot", "round"};
    const int count = (int)(sizeof reals / sizeof reals[0]);
    char w[64];
    double groove[4] = {0.0, 0.0, 0.0, 0.0}; /* conformities, inner and outer; Young's modulus, Poisson's ratio */
    M.tau = -1.0;
    open_text(path);
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
        else if (!strcmp(w, "model")) {
            word(w);
            const int model = pick(w, models, 3);
            M.reference = model == 1;
            M.tilting = model == 2;
        }
        else if (!strcmp(w, "law")) { word(w); M.law = pick(w, laws, 2); }
        else if (!strcmp(w, "geometry")) { word(w); M.geometry = pick(w, geometries, 2); }
        else if (!strcmp(w, "element")) { word(w); M.element = pick(w, elements, 2); }
        else if (!strcmp(w, "walls")) { word(w); M.walls = pick(w, walls, 2); }
        else if (!strcmp(w, "pockets")) { word(w); M.pockets = pick(w, pockets, 2); }
        else if (!strcmp(w, "grooves")) for (int k = 0; k < 4; k++) groove[k] = num();
        else if (!strcmp(w, "profile")) read_profile();
        else if (!strcmp(w, "raceway_waves")) read_waves(&M.raceway_waves);
        else if (!strcmp(w, "element_waves")) read_waves(&M.element_waves);
        else if (!strcmp(w, "damage")) read_damage();
        else if (!strcmp(w, "roller_path")) { word(w); M.path = pick(w, paths, 2); }
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
    if (groove[2] > 0.0) {
        double kappa;
        if (M.Kin == 0.0) M.Kin = groove_stiffness(INNER, groove[0], groove[2], groove[3], &kappa);
        if (M.Kout == 0.0) M.Kout = groove_stiffness(OUTER, groove[1], groove[2], groove[3], &kappa);
    }
    M.Ir = (M.element == ELEMENT_BALL ? 0.4 : 0.5) * M.m * M.r * M.r;
    M.Jr = M.m * (3.0 * M.r * M.r + M.L * M.L) / 12.0;
    M.Jring[0] = M.mi * (0.5 * M.Ri * M.Ri + M.width * M.width / 12.0);
    M.Jring[1] = M.mo * (0.5 * M.Ro * M.Ro + M.width * M.width / 12.0); /* the ring's alone */
    M.Ip = M.mi * M.Ri * M.Ri;
    M.mo += M.housing; /* section 24 */
    M.Ic = 0.5 * M.mc * (M.cage_a * M.cage_a + M.cage_b * M.cage_b);
    for (int i = 0; i < M.defects; i++) {
        Defect *d = &M.defect[i];
        d->radius = d->on == OUTER ? M.Ro : d->on == INNER ? M.Ri : M.r;
        build_floor(d);
    }
    for (int i = 0; i < M.damages; i++)
        M.damage[i].radius = M.damage[i].on == OUTER ? M.Ro : M.damage[i].on == INNER ? M.Ri : M.r;
    if (M.geometry == GEOMETRY_EXACT) {
        if (M.defects) die("exact geometry:", "damage by tables only");
        if (M.tilting && (M.damages || M.element == ELEMENT_BALL)) die("tilting:", "healthy rollers only");
        if (M.start == START_EQUILIBRIUM) die("exact geometry:", "no equilibrium start");
        ready_waves();
    } else if (M.damages || M.tau >= 0.0 || M.walls || M.pockets || M.rolling > 0.0 || M.raceway_waves.amplitude > 0.0
               || M.element_waves.amplitude > 0.0 || M.law == LAW_HALF_SPACE)
        die("Part II", "is written for exact geometry");
    else {
        const int ball = M.element == ELEMENT_BALL;
        if (M.defects && (M.tilting || M.profile || (ball && !M.reference))) die("centred geometry:", "damage of straight, planar rollers and in the lumped model only");
        if (M.tilting && (ball || M.start == START_EQUILIBRIUM)) die("tilting:", "rollers, no equilibrium start");
        if (M.reference && (M.path || M.profile)) die("the lumped model", "is written for point, without profiles");
    }
    slice_profile();
}
