/* The model's parameters, SI units throughout, and small tools that every file uses. */
#ifndef MODEL_H
#define MODEL_H

#include <stddef.h>

#define PI 3.14159265358979323846

enum { RECTANGLE, CIRCLE, PROFILE, IRREGULAR, OUTLINE };
enum { LAW_ECL, LAW_HALF_SPACE };
enum { PATH_POINT, PATH_ENVELOPE };
enum { OUTER, INNER, ROLLER };
enum { START_ROLLING, START_REST, START_EQUILIBRIUM };
enum { GUIDE_NONE, GUIDE_OUTER, GUIDE_INNER };
enum { FILM_QUASI_STATIC, FILM_DYNAMIC };
enum { GEOMETRY_CENTRED, GEOMETRY_EXACT };
enum { ELEMENT_ROLLER, ELEMENT_BALL };
enum { WALLS_LINEAR, WALLS_OILED };
enum { POCKETS_SLOT, POCKETS_ROUND };
enum { STRAIGHT, LOGARITHMIC, CROWNED, DROPS };

typedef struct { double a, b, ha, hb; } Piece; /* depth ha at s = a to hb at s = b, linear between */

/* h(s) along the surface: pieces in order of s, 0 outside them. */
typedef struct {
    int count, space;
    Piece *piece;
} Floor;

typedef struct {
    int on, row, roller, shape, points; /* row and roller count from 0 */
    double psi, radius, depth;
    double offset;                      /* along z, of shapes given by width; others are moved as they are read */
    double length, width;               /* rectangle; width also the irregular shape's largest */
    double diameter;
    double *arc, *widths, *depths;      /* profile, or what a depth map comes to */
    int polygons, *corners;             /* outline */
    double **s, **z;
    double first, last;                 /* its arc */
    Floor floor;
} Defect;

/* delta_eff(delta, s) of one damaged surface, section 19: values at nodes and what natural splines need. */
typedef struct {
    int on, row, roller, ns, nd;
    double psi, radius, *s, *d; /* nodes */
    double *f, *fs, *fd, *fsd;  /* [s node * nd + delta node]: value, second derivatives along s, delta and both */
} Damage;

/* Section 23: the cosines of one kind of surface. */
typedef struct {
    double amplitude, exponent;
    int first, last;
} Waves;

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
    int reference, start, law, path, slices;
    double duration, fs, step, perturb;
    /* Part II */
    int geometry, element, walls, pockets;
    double tau, roughness, rolling, pocket_friction, housing; /* tau < 0: the damping c instead */
    int damages;
    Damage *damage;
    Waves raceway_waves, element_waves;
    double seed;
    int tilting;
    double width, spacing, load_offset, tilt_stiffness[2], tilt_damping[2]; /* inner, outer */
    double Jr, Jring[2], Ip;
    int profile, drops;
    double crowned, *drop_z, *drop, *slice_drop;
    double tolerance; /* of the extrapolation; 0: Runge-Kutta's fixed steps */
    int channels;
    char **channel;
} Model;

extern Model M;

void die(const char *what, const char *detail);
void *need(size_t n, size_t size);
int pick(const char *w, const char *names[], int count);

#endif
