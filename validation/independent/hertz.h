/* Section 17: the stiffness of a ball in a groove, by Hertz. */
#ifndef HERTZ_H
#define HERTZ_H

double groove_stiffness(int side, double conformity, double youngs_modulus, double poisson_ratio, double *kappa);

#endif
