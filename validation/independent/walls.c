/* Section 21: oil between element and wall, then Hertz; friction at pockets. */
#include "walls.h"

#include <math.h>

#include "model.h"

static const double OIL = 11.0, HERTZ = 2e9, TIME = 17e-6, STANDARD_GRAVITY = 9.81;

double oil_force(void) { return OIL; }

/* The land's oil: none where a film acts. */
double land_oil_force(void)
{
    return M.guide != GUIDE_NONE ? 0.0 : fmax(OIL, 4.0 * M.mc * STANDARD_GRAVITY);
}

/* x >= 0: distance from the centred position; rate: its own. */
double wall_force(double x, double rate, double play, double oil)
{
    const double beyond = fmax(x - play, 0.0), y = x / play;
    if (M.walls == WALLS_LINEAR) return beyond > 0.0 ? fmax(M.kc * beyond + M.cc * rate, 0.0) : 0.0;
    const double elastic = oil * pow(y, 5) + HERTZ * beyond * sqrt(beyond);
    const double stiffness = 5.0 * oil / play * pow(y, 4) + 1.5 * HERTZ * sqrt(beyond);
    return fmax(elastic + TIME * stiffness * rate, 0.0);
}

double wall_energy(double x, double play, double oil)
{
    const double beyond = fmax(x - play, 0.0);
    if (M.walls == WALLS_LINEAR) return 0.5 * M.kc * beyond * beyond;
    return oil * play / 6.0 * pow(x / play, 6) + 0.4 * HERTZ * beyond * beyond * sqrt(beyond);
}

/* Against the slip; the springs keep the traction curve of section 5. */
double wall_friction(double force, double slip)
{
    if (M.walls == WALLS_OILED) return M.pocket_friction * force * tanh(slip / M.vs);
    const double u = fabs(slip), mu = (-0.1 + 22.28 * u) * exp(-181.46 * u) + 0.1;
    return u > 0.0 ? copysign(mu * force, slip) : 0.0;
}
