/* Section 17: the stiffness of a ball in a groove, by Hertz. */
#include "hertz.h"

#include <math.h>

#include "model.h"

/* Complete elliptic integrals of parameter 1 - 1/kappa^2, by the arithmetic-geometric mean. */
static void elliptic(double kappa, double *first, double *second)
{
    double a = 1.0, b = 1.0 / kappa, sum = 0.5 * (1.0 - b * b), weight = 1.0;
    while (a - b > 1e-15 * a) {
        const double c = 0.5 * (a - b), mean = 0.5 * (a + b);
        b = sqrt(a * b);
        a = mean;
        sum += weight * c * c;
        weight *= 2.0;
    }
    *first = PI / (2.0 * a);
    *second = *first * (1.0 - sum);
}

/* What kappa^2 is to be, over what it is. */
static double excess(double kappa, double gamma)
{
    double F1, E2;
    elliptic(kappa, &F1, &E2);
    return (2.0 * F1 - E2 * (1.0 + gamma)) / (E2 * (1.0 - gamma)) / (kappa * kappa);
}

double curvature_along(int side)
{
    return side == OUTER ? 1.0 / M.r - 1.0 / M.Ro : 1.0 / M.r + 1.0 / M.Ri;
}

double groove_stiffness(int side, double conformity, double youngs_modulus, double poisson_ratio, double *kappa)
{
    const double along = curvature_along(side);
    const double across = 1.0 / M.r - 1.0 / (2.0 * M.r * conformity), R = 1.0 / (along + across);
    const double gamma = R * (along - across), E = youngs_modulus / (1.0 - poisson_ratio * poisson_ratio);
    double lo = 1.0 + 1e-9, hi = 1e3, F1, E2;
    for (int i = 0; i < 200; i++) {
        const double middle = 0.5 * (lo + hi);
        if (excess(middle, gamma) > 1.0) lo = middle;
        else hi = middle;
    }
    *kappa = 0.5 * (lo + hi);
    elliptic(*kappa, &F1, &E2);
    return PI * *kappa * E * sqrt(2.0 * E2 * R / (9.0 * F1 * F1 * F1));
}
