/* Damaged and healthy contacts of section 19: energy, its derivatives. */
#ifndef HALFSPACE_H
#define HALFSPACE_H

#include "model.h"

/* delta_eff and its derivatives at one (delta, s). */
typedef struct { double f, fd, fdd, fs; } Depth;

/* One contact: E, its derivatives by delta, and dE/du of damage and waviness on the ring and on the element. */
typedef struct {
    double E, Q, K, x; /* x = max(delta, delta_eff), after waviness */
    double P_ring, P_element;
} Energy;

/* The healthy contact under tilt: E and its gradient and Hessian by delta and tilt; x of the deepest slice. */
typedef struct { double E, Q, T, K, KT, KTT, x; } Tilted;

Tilted tilted_energy(int side, double delta, double tilt);
void spline_damage(Damage *d);
int depth_at(const Damage *d, double delta, double s, Depth *out);
void slice_profile(void);
void healthy(int side, double delta, double *E, double *Q, double *K);
Energy contact_energy(int side, int row, int j, double ring_angle, double element_angle, double delta);

#endif
