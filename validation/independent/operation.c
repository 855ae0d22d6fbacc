/* Prescribed motion and load. */
#include "operation.h"

#include "model.h"

/* Inner-ring speed and angle; the profile is linear between its points and constant beyond them. */
void drive(double t, double *w, double *angle)
{
    const double *T = M.speed_t, *W = M.speed_w;
    const int n = M.speed_points;
    double sum = 0.0;
    if (t <= T[0]) {
        *w = W[0];
        *angle = W[0] * t;
        return;
    }
    sum = W[0] * T[0];
    for (int i = 0; i + 1 < n; i++) {
        const double dt = T[i + 1] - T[i];
        if (t <= T[i + 1]) {
            const double x = t - T[i], slope = (W[i + 1] - W[i]) / dt;
            *w = W[i] + slope * x;
            *angle = sum + x * (W[i] + 0.5 * slope * x);
            return;
        }
        sum += 0.5 * dt * (W[i] + W[i + 1]);
    }
    *w = W[n - 1];
    *angle = sum + W[n - 1] * (t - T[n - 1]);
}

double ramp_factor(double t)
{
    if (M.start == START_EQUILIBRIUM || M.ramp <= 0.0) return 1.0;
    return t < M.ramp ? t / M.ramp : 1.0;
}
