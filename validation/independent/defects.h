/* Defects, section 3: their borders, widths and depths, and where a roller meets them. */
#ifndef DEFECTS_H
#define DEFECTS_H

#include "model.h"

#define IRREGULAR_ARC (1.6695 + 1.5000 + 0.7071 + 1.4142 + 0.7071 + 1.0000)

int ascending(const void *a, const void *b);
double outline_width(const Defect *d, double s);
int defect_at(const Defect *d, double u, double *Ls, double *h);
int depth_at_bottom(const Defect *d, double u, double *h);
int local_angle(const Defect *d, int side, int row, int j, double theta, double phi, double W, double *u);

#endif
