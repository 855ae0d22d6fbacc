/* Depth profiles along the surface and the roller's path over them, section 3. */
#ifndef FLOORS_H
#define FLOORS_H

#include "model.h"

void build_floor(Defect *d);
double envelope_depth(const Floor *f, int side, double s);

#endif
