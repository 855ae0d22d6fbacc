#include "state.h"

#include "model.h"

int dof;
Detail *detail;
double inner_torque, outer_torque;

int cage_at(int row) { return 4 + 3 * row; }
int roller_at(int k) { return 4 + 3 * M.rows + 3 * k; }
int tilt_at(int ring) { return roller_at(M.total) + 2 * ring; }
int beta_at(int k) { return roller_at(M.total) + 4 + k; }
double row_height(int row) { return (row - 0.5 * (M.rows - 1)) * M.spacing; }
double pocket_angle(int row, int j) { return 2.0 * PI * j / M.Z + row * M.stagger; }
