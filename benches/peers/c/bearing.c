#include "bearing.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

typedef struct { char name[64]; double value; } Entry;

static double get(const Entry *list, int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (!strcmp(list[i].name, name)) return list[i].value;
    fprintf(stderr, "problem file: %s is missing\n", name);
    exit(2);
}

void bearing_read(Bearing *b, const char *path)
{
    Entry list[128];
    int n = 0;
    FILE *in = fopen(path, "r");
    if (!in) { fprintf(stderr, "cannot open %s\n", path); exit(2); }
    while (n < 128 && fscanf(in, "%63s %lf", list[n].name, &list[n].value) == 2) n++;
    fclose(in);
#define GET(key) get(list, n, key)
    b->rows = (int)GET("rows");
    b->rollers = (int)GET("rollers");
    b->total = b->rows * b->rollers;
    b->dof = 3 * b->total + 3 * b->rows + 4;
    b->inner_radius = 0.5 * GET("inner_raceway_diameter");
    b->outer_radius = 0.5 * GET("outer_raceway_diameter");
    b->pitch_radius = GET("pitch_radius");
    b->roller_radius = GET("roller_radius");
    b->roller_length = GET("roller_length");
    b->clearance = GET("clearance");
    b->pocket_clearance = GET("pocket_clearance");
    b->guide_clearance = GET("guide_clearance");
    b->guide_width = GET("guide_width");
    b->guide_radius = GET("cage_outer_radius");
    b->inner_mass = GET("inner_mass");
    b->outer_mass = GET("outer_mass");
    b->roller_mass = GET("roller_mass");
    b->roller_inertia = 0.5 * b->roller_mass * b->roller_radius * b->roller_radius;
    b->cage_mass = GET("cage_mass");
    b->cage_inertia = 0.5 * b->cage_mass * (pow(GET("cage_inner_radius"), 2) + pow(GET("cage_outer_radius"), 2));
    b->exponent = GET("exponent");
    b->inner_stiffness = GET("inner_stiffness");
    b->outer_stiffness = GET("outer_stiffness");
    b->contact_damping = GET("contact_damping");
    b->cage_stiffness = GET("cage_stiffness");
    b->cage_damping = GET("cage_damping");
    b->friction = GET("friction");
    b->slip_velocity = GET("slip_velocity");
    b->viscosity = GET("viscosity");
    b->support_inner_stiffness = GET("support_inner_stiffness");
    b->support_inner_damping = GET("support_inner_damping");
    b->support_outer_stiffness = GET("support_outer_stiffness");
    b->support_outer_damping = GET("support_outer_damping");
    b->speed = GET("speed");
    b->load_x = GET("load_x");
    b->load_y = GET("load_y");
    b->ramp = GET("ramp");
    b->defect_row = (int)GET("defect_row") - 1;
    b->defect_angle = GET("defect_angle");
    b->defect_depth = GET("defect_depth");
    b->defect_length = GET("defect_length");
    b->intact_share = pow((b->roller_length - GET("defect_width")) / b->roller_length, 8.0 / 9.0);
    for (int i = 0; i < b->rows; i++)
        for (int j = 0; j < b->rollers; j++)
            b->alpha[i * b->rollers + j] = 2.0 * PI * j / b->rollers + i * GET("stagger");
#undef GET
}

void bearing_scales(const Bearing *b, double length, double speed, double *scale)
{
    const int n = b->total, dof = b->dof;
    for (int half = 0; half < 2; half++) {
        const double unit = half ? speed : length;
        double *s = scale + half * dof;
        for (int k = 0; k < dof; k++) s[k] = unit;
        for (int k = 0; k < n; k++) {
            s[n + k] = unit / b->pitch_radius;
            s[2 * n + k] = unit / b->roller_radius;
        }
        for (int i = 0; i < b->rows; i++) s[3 * n + 3 * i + 2] = unit / b->pitch_radius;
    }
}

/* Pure rolling, cages centred, both rings 1 um aside in x and y and at rest. */
void bearing_start(const Bearing *b, double *y)
{
    const int n = b->total;
    const double orbit = b->speed * b->inner_radius / (2.0 * b->pitch_radius);
    const double spin = -(b->speed * b->inner_radius - b->pitch_radius * orbit) / b->roller_radius;
    double *v = y + b->dof;
    memset(y, 0, 2 * (size_t)b->dof * sizeof *y);
    for (int k = 0; k < n; k++) {
        y[n + k] = b->alpha[k];
        v[n + k] = orbit;
        v[2 * n + k] = spin;
    }
    for (int i = 0; i < b->rows; i++) v[3 * n + 3 * i + 2] = orbit;
    for (int k = 0; k < 4; k++) y[b->dof - 4 + k] = 1e-6;
}

static double traction(double u)
{
    return (-0.1 + 22.28 * u) * exp(-181.46 * u) + 0.1;
}

void bearing_rhs(const Bearing *restrict b, double t, const double *restrict y, double *restrict dy)
{
    const int n = b->total, dof = b->dof;
    const double *r = y, *theta = r + n, *cage = y + 3 * n, *ring = y + dof - 4;
    const double *dr = y + dof, *dtheta = dr + n, *dphi = dtheta + n, *dcage = dr + 3 * n, *dring = y + 2 * dof - 4;
    double *ar = dy + dof, *atheta = ar + n, *aphi = atheta + n, *acage = ar + 3 * n, *aring = dy + 2 * dof - 4;

    memcpy(dy, y + dof, (size_t)dof * sizeof *dy);

    const double xi = ring[0], yi = ring[1], xo = ring[2], yo = ring[3];
    const double vxi = dring[0], vyi = dring[1], vxo = dring[2], vyo = dring[3];
    const double load = t < b->ramp ? t / b->ramp : 1.0;
    double Fxi = -b->support_inner_stiffness * xi - b->support_inner_damping * vxi;
    double Fyi = -b->support_inner_stiffness * yi - b->support_inner_damping * vyi;
    double Fxo = -b->support_outer_stiffness * xo - b->support_outer_damping * vxo - load * b->load_x;
    double Fyo = -b->support_outer_stiffness * yo - b->support_outer_damping * vyo - load * b->load_y;

    const double Rm = b->pitch_radius, rr = b->roller_radius, c = b->contact_damping;
    const double per_mass = 1.0 / b->roller_mass, per_inertia = 1.0 / b->roller_inertia, per_slip = 1.0 / b->slip_velocity;
    const double surface = b->speed * b->inner_radius, half_arc = 0.5 * b->defect_length;

    for (int row = 0; row < b->rows; row++) {
        const double xc = cage[3 * row], yc = cage[3 * row + 1], thc = cage[3 * row + 2];
        const double vxc = dcage[3 * row], vyc = dcage[3 * row + 1], wc = dcage[3 * row + 2];
        double Fxc = 0.0, Fyc = 0.0, Mc = 0.0;

        for (int k = row * b->rollers; k < (row + 1) * b->rollers; k++) {
            const double ex = cos(theta[k]), ey = sin(theta[k]);

            /* normal contacts */
            const double din = ex * xi + ey * yi - r[k] - b->clearance;
            const double dout = r[k] - ex * xo - ey * yo;
            double Qin = 0.0, Qout = 0.0, fin = 0.0, fout = 0.0;
            const double vt = Rm * dtheta[k];
            if (din > 0.0) {
                const double rate = ex * vxi + ey * vyi + dtheta[k] * (ex * yi - ey * xi) - dr[k];
                Qin = fmax(b->inner_stiffness * pow(din, b->exponent) + c * rate, 0.0);
                const double slip = surface + ex * vyi - ey * vxi - (vt - rr * dphi[k]);
                fin = b->friction * Qin * tanh(slip * per_slip);
            }
            if (dout > 0.0) {
                const double rate = dr[k] - ex * vxo - ey * vyo - dtheta[k] * (ex * yo - ey * xo);
                double sum = pow(dout, b->exponent);
                if (row == b->defect_row) {
                    double u = theta[k] - b->defect_angle;
                    u -= 2.0 * PI * floor((u + PI) / (2.0 * PI));
                    if (fabs(u * b->outer_radius) <= half_arc) {
                        const double rest = dout - b->defect_depth;
                        sum *= b->intact_share;
                        if (rest > 0.0) sum += (1.0 - b->intact_share) * pow(rest, b->exponent);
                    }
                }
                Qout = fmax(b->outer_stiffness * sum + c * rate, 0.0);
                const double slip = ex * vyo - ey * vxo - (vt + rr * dphi[k]);
                fout = b->friction * Qout * tanh(slip * per_slip);
            }

            /* pocket */
            const double s = Rm * (thc + b->alpha[k] - theta[k]) + ex * yc - ey * xc;
            double Fc = 0.0, fc = 0.0, sigma = 0.0;
            if (fabs(s) > b->pocket_clearance) {
                const double side = s > 0.0 ? 1.0 : -1.0;
                const double ds = Rm * (wc - dtheta[k]) + ex * vyc - ey * vxc - dtheta[k] * (ex * xc + ey * yc);
                const double push = b->cage_stiffness * (fabs(s) - b->pocket_clearance) + b->cage_damping * side * ds;
                if (push > 0.0) {
                    Fc = side * push;
                    sigma = -side;
                    const double u = dr[k] - sigma * rr * (dphi[k] - wc) - (ex * vxc + ey * vyc);
                    if (u != 0.0) fc = -copysign(traction(fabs(u)) * push, u);
                }
            }

            /* roller */
            const double arm = Rm + r[k];
            ar[k] = (Qin - Qout + fc) * per_mass + arm * dtheta[k] * dtheta[k];
            atheta[k] = ((fin + fout + Fc) * per_mass - 2.0 * dr[k] * dtheta[k]) / arm;
            aphi[k] = (rr * (fout - fin) - sigma * rr * fc) * per_inertia;

            /* reactions */
            Fxi += fin * ey - Qin * ex;
            Fyi -= fin * ex + Qin * ey;
            Fxo += fout * ey + Qout * ex;
            Fyo += Qout * ey - fout * ex;
            Fxc += Fc * ey - fc * ex;
            Fyc -= Fc * ex + fc * ey;
            Mc += sigma * rr * fc - Fc * Rm;
        }

        /* guidance of the cage in the outer ring */
        const double gx = xc - xo, gy = yc - yo, e = sqrt(gx * gx + gy * gy);
        const double eps = fmin(e / b->guide_clearance, 0.95), one = 1.0 - eps * eps, root = sqrt(one);
        const double nx = e > 0.0 ? gx / e : 1.0, ny = e > 0.0 ? gy / e : 0.0;
        const double L = b->guide_width, Cg = b->guide_clearance, ue = b->guide_radius * wc;
        double Fn = -b->viscosity * fabs(ue) * L * L * L * eps * eps / (Cg * Cg * one * one);
        if (e > Cg) Fn -= b->cage_stiffness * (e - Cg);
        const double Ft = PI * b->viscosity * ue * L * L * L * eps / (4.0 * Cg * Cg * one * root);
        const double fx = Fn * nx - Ft * ny, fy = Fn * ny + Ft * nx;
        Mc -= 2.0 * PI * b->viscosity * ue * b->guide_radius * b->guide_radius * L / (Cg * root);
        Fxo -= fx;
        Fyo -= fy;
        acage[3 * row] = (Fxc + fx) / b->cage_mass;
        acage[3 * row + 1] = (Fyc + fy) / b->cage_mass;
        acage[3 * row + 2] = Mc / b->cage_inertia;
    }
    aring[0] = Fxi / b->inner_mass;
    aring[1] = Fyi / b->inner_mass;
    aring[2] = Fxo / b->outer_mass;
    aring[3] = Fyo / b->outer_mass;
}
