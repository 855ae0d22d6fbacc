/* The state and what its numbers are.
 * q: x_i y_i x_o y_o | per cage x y theta | per roller r theta phi; then the same for the velocities.
 */
#ifndef STATE_H
#define STATE_H

extern int dof;

int cage_at(int row);
int roller_at(int k);
int tilt_at(int ring);  /* 0 inner, 1 outer: two slopes; tilting model only */
int beta_at(int k);
double row_height(int row);
double pocket_angle(int row, int j);

typedef struct {
    double outer_force, inner_force, outer_length, inner_length, pocket, slip_inner, slip_outer, ax, ay;
    double inner_moment, outer_moment;
    double orbit_speed; /* about the outer ring's centre (exact geometry) */
} Detail;

extern Detail *detail; /* filled only when asked for, at output instants */
extern double inner_torque, outer_torque; /* what the drive and the housing supply (exact geometry) */

#endif
