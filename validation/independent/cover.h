/* What damage covers along z, and the share of a slice that it takes. */
#ifndef COVER_H
#define COVER_H

#include "model.h"

enum { INTERVALS = 256 };

/* A defect at its s: which z it covers, ascending. */
typedef struct {
    const Defect *d;
    double s, h, from[INTERVALS], to[INTERVALS];
    int count;
} Met;

void find_cover(Met *m, const Defect *d, double s);
double fraction(const Met *met, int count, int k, double *mean);

#endif
