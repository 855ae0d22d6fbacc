/* Section 23: w(u) = sum of A_k cos(k u + phase_k), w > 0 a valley. */
#include "waviness.h"

#include <math.h>
#include <stdint.h>

static double **cosine, **sine; /* A_k cos(phase_k) and A_k sin(phase_k) of every surface, by k - k_1 */

double phase(double seed, int surface, int wave)
{
    uint64_t z = (uint64_t)seed + (((uint64_t)surface << 20) + (uint64_t)wave) * 0x9E3779B97F4A7C15u;
    z ^= z >> 30;
    z *= 0xBF58476D1CE4E5B9u;
    z ^= z >> 27;
    z *= 0x94D049BB133111EBu;
    z ^= z >> 31;
    return 2.0 * PI * ((double)(z >> 11) / 9007199254740992.0);
}

int raceway_surface(int side, int row) { return 2 * row + (side == OUTER); }
int element_surface(int row, int j) { return 2 * M.rows + row * M.Z + j; }

void ready_waves(void)
{
    const int surfaces = 2 * M.rows + M.total;
    cosine = need((size_t)surfaces, sizeof(double *));
    sine = need((size_t)surfaces, sizeof(double *));
    for (int i = 0; i < surfaces; i++) {
        const Waves *w = i < 2 * M.rows ? &M.raceway_waves : &M.element_waves;
        if (w->amplitude <= 0.0) continue;
        cosine[i] = need((size_t)(w->last - w->first + 1), sizeof(double));
        sine[i] = need((size_t)(w->last - w->first + 1), sizeof(double));
        for (int k = w->first; k <= w->last; k++) {
            const double A = w->amplitude * pow(k, -w->exponent), p = phase(M.seed, i, k);
            cosine[i][k - w->first] = A * cos(p);
            sine[i][k - w->first] = A * sin(p);
        }
    }
}

/* Re sum c_k z^k with z = exp(i u), c_k = A_k exp(i phase_k), by Horner's rule; the slope is Re sum i k c_k z^k. */
double waviness(const Waves *w, int surface, double u, double *slope)
{
    const double zr = cos(u), zi = sin(u), *c = cosine[surface], *s = sine[surface];
    double a = 0.0, b = 0.0, ka = 0.0, kb = 0.0;
    for (int k = w->last; k >= w->first; k--) {
        const double ar = a * zr - b * zi, br = a * zi + b * zr, kr = ka * zr - kb * zi, ki = ka * zi + kb * zr;
        a = ar + c[k - w->first];
        b = br + s[k - w->first];
        ka = kr + k * c[k - w->first];
        kb = ki + k * s[k - w->first];
    }
    const double pr = cos(w->first * u), pi = sin(w->first * u);
    *slope = -(ka * pi + kb * pr);
    return a * pr - b * pi;
}
