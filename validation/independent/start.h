/* The state at t = 0, section 9. */
#ifndef START_H
#define START_H

void begin(double *q, double *v);

#endif


