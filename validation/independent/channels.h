/* The channels by name. */
#ifndef CHANNELS_H
#define CHANNELS_H

double channel(const char *name, double t, const double *q, const double *v, const double *acc);

#endif


