/* Where the peers' tables of right-hand sides come from: the independent implementation of the model.
 *
 *   reference PARAMETERS STATES      accelerations at every state of a table, then the start, in the peers' order
 */
#include <stdio.h>

#include "../../../validation/independent/dynamics.h"
#include "../../../validation/independent/model.h"
#include "../../../validation/independent/parameters.h"
#include "../../../validation/independent/start.h"
#include "../../../validation/independent/state.h"

/* Where the peers' coordinate k is in the independent implementation. */
static int place(int k)
{
    const int n = M.total, cages = 3 * M.rows;
    if (k < 3 * n) return roller_at(k % n) + k / n;
    if (k < 3 * n + cages) return 4 + k - 3 * n;
    return k - 3 * n - cages;
}

int main(int argc, char **argv)
{
    if (argc != 3) die("usage:", "reference PARAMETERS STATES");
    read_model(argv[1]);
    dof = 4 + 3 * M.rows + 3 * M.total;
    detail = need((size_t)M.total, sizeof(Detail));
    double *q = need((size_t)dof, sizeof *q), *v = need((size_t)dof, sizeof *v), *a = need((size_t)dof, sizeof *a);
    open_text(argv[2]);
    for (int states = integer(); states > 0; states--) {
        const double t = num();
        for (int k = 0; k < dof; k++) q[place(k)] = num();
        for (int k = 0; k < dof; k++) v[place(k)] = num();
        accelerations(t, q, v, a, 0);
        for (int k = 0; k < dof; k++) printf("%.17g\n", a[place(k)]);
    }
    begin(q, v);
    for (int k = 0; k < dof; k++) printf("%.17g\n", q[place(k)]);
    for (int k = 0; k < dof; k++) printf("%.17g\n", v[place(k)]);
    return 0;
}
