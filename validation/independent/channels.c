/* The channels by name. */
#include "channels.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "model.h"
#include "state.h"

double channel(const char *name, double t, const double *q, const double *v, const double *acc)
{
    int row, j, used = 0, p;
    const char *rest;
    if (!strcmp(name, "t")) return t;
    if (!strncmp(name, "inner_", 6) || !strncmp(name, "outer_", 6)) {
        static const char *axes[] = {"x", "y", "vx", "vy", "ax", "ay"};
        if (!strcmp(name + 6, "torque") && M.geometry == GEOMETRY_EXACT) return name[0] == 'o' ? outer_torque : inner_torque;
        if (M.tilting && !strncmp(name + 6, "tilt_", 5)) return q[tilt_at(name[0] == 'o') + (name[11] == 'y')];
        const int k = pick(name + 6, axes, 6), base = name[0] == 'o' ? 2 : 0;
        return (k < 2 ? q : k < 4 ? v : acc)[base + k % 2];
    }
    if (sscanf(name, "cage%d_%n", &row, &used) == 1 && used) {
        rest = name + used;
        p = cage_at(row - 1);
        if (!strcmp(rest, "x")) return q[p];
        if (!strcmp(rest, "y")) return q[p + 1];
        if (!strcmp(rest, "ax")) return acc[p];
        if (!strcmp(rest, "ay")) return acc[p + 1];
        if (!strcmp(rest, "speed")) return v[p + 2];
    }
    used = 0;
    if (sscanf(name, "roller%d_%d_%n", &row, &j, &used) == 2 && used) {
        rest = name + used;
        const int k = (row - 1) * M.Z + j - 1;
        p = roller_at(k);
        if (!strcmp(rest, "r")) return q[p];
        if (!strcmp(rest, "x")) return q[p] * cos(q[p + 1]);
        if (!strcmp(rest, "y")) return q[p] * sin(q[p + 1]);
        if (M.tilting && !strcmp(rest, "tilt")) return q[beta_at(k)];
        if (!strcmp(rest, "ax")) return detail[k].ax;
        if (!strcmp(rest, "ay")) return detail[k].ay;
        if (!strcmp(rest, "orbit")) return q[p + 1];
        if (!strcmp(rest, "orbit_speed")) return M.geometry == GEOMETRY_EXACT ? detail[k].orbit_speed : v[p + 1];
        if (!strcmp(rest, "spin")) return q[p + 2];
        if (!strcmp(rest, "spin_speed")) return v[p + 2];
        if (!strcmp(rest, "slip_inner")) return detail[k].slip_inner;
        if (!strcmp(rest, "slip_outer")) return detail[k].slip_outer;
    }
    used = 0;
    if (sscanf(name, "contact%d_%d_%n", &row, &j, &used) == 2 && used) {
        const Detail *o = &detail[(row - 1) * M.Z + j - 1];
        rest = name + used;
        if (!strcmp(rest, "outer_force")) return o->outer_force;
        if (!strcmp(rest, "inner_force")) return o->inner_force;
        if (M.tilting && !strcmp(rest, "outer_moment")) return o->outer_moment;
        if (M.tilting && !strcmp(rest, "inner_moment")) return o->inner_moment;
        if (!strcmp(rest, "outer_length")) return o->outer_length;
        if (!strcmp(rest, "inner_length")) return o->inner_length;
    }
    used = 0;
    if (sscanf(name, "pocket%d_%d_%n", &row, &j, &used) == 2 && used && !strcmp(name + used, "force"))
        return detail[(row - 1) * M.Z + j - 1].pocket;
    die("unknown channel", name);
    return 0.0;
}
