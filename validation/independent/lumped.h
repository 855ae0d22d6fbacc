/* The lumped model. */
#ifndef LUMPED_H
#define LUMPED_H

void reference_accelerations(double t, const double *q, const double *v, double *acc, int want);

#endif


