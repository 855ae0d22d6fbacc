/* Floors of `sliced` and `envelope`, section 3. */
#ifndef FLOORS_H
#define FLOORS_H

#include "model.h"

double slice_border(int k);
void build_floors(Defect *d);
double depth_of(const Floor *f, int side, double s, double *slope);
void build_table(Defect *d, int side);
double looked_up(const Table *t, const double *values, int k, double s, double *slope);

#endif


