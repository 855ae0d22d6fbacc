/* The NN3007 with a rectangular spall on its outer raceway: parameters and equations of motion, SI units.
 *
 * State y = [q, dq/dt], q = [r of every roller | theta | phi | x, y, theta of each cage | inner x, y | outer x, y];
 * roller j of row i (from 0) has index i * rollers + j.
 */
#ifndef BEARING_H
#define BEARING_H

enum { MAX_ROLLERS = 64 };

typedef struct {
    int rows, rollers, total, dof;
    double inner_radius, outer_radius, pitch_radius, roller_radius, roller_length;
    double clearance, pocket_clearance, guide_clearance, guide_width, guide_radius;
    double inner_mass, outer_mass, roller_mass, roller_inertia, cage_mass, cage_inertia;
    double exponent, inner_stiffness, outer_stiffness, contact_damping, cage_stiffness, cage_damping;
    double friction, slip_velocity, viscosity;
    double support_inner_stiffness, support_inner_damping, support_outer_stiffness, support_outer_damping;
    double speed, load_x, load_y, ramp;
    int defect_row;
    double defect_angle, defect_depth, defect_length, intact_share; /* ((L - width)/L)^(8/9) */
    double alpha[MAX_ROLLERS];                                      /* pocket angles */
} Bearing;

void bearing_read(Bearing *b, const char *path);
/* What a rung multiplies by its tolerance: absolute tolerances of every entry of the state. */
void bearing_scales(const Bearing *b, double length, double speed, double *scale);
void bearing_start(const Bearing *b, double *y);
void bearing_rhs(const Bearing *b, double t, const double *y, double *dy);

#endif
