/* Waviness, section 23. */
#ifndef WAVINESS_H
#define WAVINESS_H

#include "model.h"

double phase(double seed, int surface, int wave);
int raceway_surface(int side, int row);
int element_surface(int row, int j);
void ready_waves(void);
double waviness(const Waves *w, int surface, double u, double *slope);

#endif
