/* Cage walls of section 21, and the springs of section 5. */
#ifndef WALLS_H
#define WALLS_H

double oil_force(void);
double land_oil_force(void);
double wall_force(double x, double rate, double play, double oil);
double wall_energy(double x, double play, double oil);
double wall_friction(double force, double slip);

#endif
