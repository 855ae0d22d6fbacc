/* Section 17: curvature of element and raceway along the raceway, and the stiffness of a ball in a groove, by Hertz. */
#ifndef HERTZ_H
#define HERTZ_H

double curvature_along(int side);
double groove_stiffness(int side, double conformity, double youngs_modulus, double poisson_ratio, double *kappa);

#endif
