/* Forces and accelerations in exact geometry, section 18. */
#ifndef EXACT_H
#define EXACT_H

/* How an element meets a ring; lengths in m, n from the ring's centre to the element's. */
typedef struct {
    double n[2], t[2], rho, delta, rate, alpha, arm, ring_arm;
} Meeting;

Meeting meet(int side, const double *roller, const double *roller_rate, const double *ring, const double *ring_rate);
double ring_slip(int side, const Meeting *m, const double *V, const double *ring_rate, double w, double dphi);
double damped(double Q, double K, double x, double rate);
void exact_accelerations(double t, const double *q, const double *v, double *acc, int want);
double potential(double t, const double *q);

#endif
