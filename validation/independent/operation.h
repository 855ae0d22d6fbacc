/* Prescribed motion and load. */
#ifndef OPERATION_H
#define OPERATION_H

void drive(double t, double *w, double *angle);
double ramp_factor(double t);

#endif


