#include "state.h"

#include "model.h"

int dof;
Detail *detail;
double inner_torque, outer_torque;

int cage_at(int row) { return 4 + 3 * row; }
int roller_at(int k) { return 4 + 3 * M.rows + 3 * k; }
double pocket_angle(int row, int j) { return 2.0 * PI * j / M.Z + row * M.stagger; }
