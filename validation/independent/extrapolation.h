/* Gragg, Bulirsch and Stoer's extrapolation with adaptive steps. */
#ifndef EXTRAPOLATION_H
#define EXTRAPOLATION_H

typedef void Rates(double t, const double *q, const double *v, double *acc, int want);

void extrapolate(Rates *rates, double from, double to, double *q, double *v);

#endif
