/* Forces and accelerations of the full model. */
#ifndef DYNAMICS_H
#define DYNAMICS_H

void ring_forces(double t, const double *q, const double *v, double *Fi, double *Fo);
double guidance_film(const double *e, const double *v, double wc, double wg, double *F);
void tilt_rings(double t, const double *q, const double *v, double N[2][2], double w, double *acc);
void accelerations(double t, const double *q, const double *v, double *acc, int want);

#endif


