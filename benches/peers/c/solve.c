/* SUNDIALS on the bearing.
 *
 *   solve check PROBLEM STATES             accelerations at every state of a table, then the start
 *   solve METHOD PROBLEM OUT DURATION RATE LENGTH SPEED RTOL MAX_STEP BUDGET TOL...
 *       METHOD: cvode-bdf, cvode-adams, arkode-3, arkode-5 (Cash-Karp), arkode-5dp (Dormand-Prince)
 *       Each TOL is a run with absolute tolerances TOL * LENGTH and TOL * SPEED (on a surface) and relative TOL * RTOL,
 *       repeated for BUDGET seconds at most. Samples of the rings' accelerations go to OUT-<number>.f64.
 */
#include "bearing.h"

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_spgmr.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static Bearing bearing;

static void must(int flag, const char *what)
{
    if (flag >= 0) return;
    fprintf(stderr, "%s: %d\n", what, flag);
    exit(3);
}

static int rhs(realtype t, N_Vector y, N_Vector dy, void *data)
{
    bearing_rhs(data, t, N_VGetArrayPointer(y), N_VGetArrayPointer(dy));
    return 0;
}

static double clock_of(clockid_t id)
{
    struct timespec now;
    clock_gettime(id, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

typedef struct { long rhs, steps; } Work;

/* One run from the start; samples holds four accelerations for each instant. */
static Work run(const char *method, long count, double rate, N_Vector atol, double rtol, double max_step, double *samples)
{
    const int size = 2 * bearing.dof;
    Work work = {0, 0};
    SUNContext context;
    must(SUNContext_Create(NULL, &context), "SUNContext_Create");
    N_Vector y = N_VNew_Serial(size, context);
    double *state = N_VGetArrayPointer(y), *dy = malloc((size_t)size * sizeof *dy), t = 0.0;
    bearing_start(&bearing, state);

    const int multistep = !strncmp(method, "cvode", 5);
    SUNLinearSolver linear = NULL;
    SUNNonlinearSolver fixed_point = NULL;
    void *memory;
    if (multistep) {
        const int bdf = !strcmp(method, "cvode-bdf");
        memory = CVodeCreate(bdf ? CV_BDF : CV_ADAMS, context);
        must(CVodeInit(memory, rhs, 0.0, y), "CVodeInit");
        must(CVodeSetUserData(memory, &bearing), "CVodeSetUserData");
        must(CVodeSVtolerances(memory, rtol, atol), "CVodeSVtolerances");
        must(CVodeSetMaxStep(memory, max_step), "CVodeSetMaxStep");
        must(CVodeSetMaxNumSteps(memory, -1), "CVodeSetMaxNumSteps");
        must(CVodeSetMaxErrTestFails(memory, 50), "CVodeSetMaxErrTestFails");
        must(CVodeSetMaxConvFails(memory, 50), "CVodeSetMaxConvFails");
        if (bdf) {
            linear = SUNLinSol_SPGMR(y, SUN_PREC_NONE, 0, context);
            must(CVodeSetLinearSolver(memory, linear, NULL), "CVodeSetLinearSolver");
        } else {
            fixed_point = SUNNonlinSol_FixedPoint(y, 0, context);
            must(CVodeSetNonlinearSolver(memory, fixed_point), "CVodeSetNonlinearSolver");
        }
    } else {
        memory = ERKStepCreate(rhs, 0.0, y, context);
        must(ERKStepSetUserData(memory, &bearing), "ERKStepSetUserData");
        must(ERKStepSVtolerances(memory, rtol, atol), "ERKStepSVtolerances");
        const int table = !strcmp(method, "arkode-3")     ? ARKODE_BOGACKI_SHAMPINE_4_2_3
                          : !strcmp(method, "arkode-5dp") ? ARKODE_DORMAND_PRINCE_7_4_5
                                                          : ARKODE_CASH_KARP_6_4_5;
        must(ERKStepSetTableNum(memory, table), "ERKStepSetTableNum");
        /* Cubic: higher degrees cost right-hand sides of their own, and steps are far shorter than a sample. */
        must(ERKStepSetInterpolantDegree(memory, 3), "ERKStepSetInterpolantDegree");
        must(ERKStepSetMaxStep(memory, max_step), "ERKStepSetMaxStep");
        must(ERKStepSetMaxNumSteps(memory, -1), "ERKStepSetMaxNumSteps");
        must(ERKStepSetMaxErrTestFails(memory, 50), "ERKStepSetMaxErrTestFails");
    }
    for (long k = 0; k <= count; k++) {
        const double at = (double)k / rate;
        if (k > 0) {
            if (multistep) must(CVode(memory, at, y, &t, CV_NORMAL), "CVode");
            else must(ERKStepEvolve(memory, at, y, &t, ARK_NORMAL), "ERKStepEvolve");
        }
        bearing_rhs(&bearing, at, state, dy);
        memcpy(samples + 4 * k, dy + size - 4, 4 * sizeof *samples);
    }
    long linear_rhs = 0;
    if (multistep) {
        CVodeGetNumSteps(memory, &work.steps);
        CVodeGetNumRhsEvals(memory, &work.rhs);
        if (linear) CVodeGetNumLinRhsEvals(memory, &linear_rhs);
        work.rhs += linear_rhs;
        CVodeFree(&memory);
    } else {
        ERKStepGetNumSteps(memory, &work.steps);
        ERKStepGetNumRhsEvals(memory, &work.rhs);
        ERKStepFree(&memory);
    }
    if (linear) SUNLinSolFree(linear);
    if (fixed_point) SUNNonlinSolFree(fixed_point);
    N_VDestroy(y);
    free(dy);
    SUNContext_Free(&context);
    return work;
}

/* Table: the number of states, then t and y of each; out come the accelerations, then the start. */
static int check(const char *path)
{
    const int size = 2 * bearing.dof;
    double y[6 * MAX_ROLLERS + 64], dy[6 * MAX_ROLLERS + 64], t;
    int states;
    FILE *in = fopen(path, "r");
    if (!in || fscanf(in, "%d", &states) != 1) return 2;
    for (int s = 0; s < states; s++) {
        if (fscanf(in, "%lf", &t) != 1) return 2;
        for (int k = 0; k < size; k++)
            if (fscanf(in, "%lf", y + k) != 1) return 2;
        bearing_rhs(&bearing, t, y, dy);
        for (int k = bearing.dof; k < size; k++) printf("%.17g\n", dy[k]);
    }
    fclose(in);
    bearing_start(&bearing, y);
    for (int k = 0; k < size; k++) printf("%.17g\n", y[k]);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc == 4 && !strcmp(argv[1], "check")) {
        bearing_read(&bearing, argv[2]);
        return check(argv[3]);
    }
    if (argc < 12) {
        fprintf(stderr, "see the head of solve.c\n");
        return 2;
    }
    bearing_read(&bearing, argv[2]);
    const double duration = atof(argv[4]), rate = atof(argv[5]), length = atof(argv[6]), speed = atof(argv[7]);
    const double rtol = atof(argv[8]), max_step = atof(argv[9]), budget = atof(argv[10]);
    const long count = (long)floor(duration * rate + 1e-6);
    double *samples = malloc(4 * (size_t)(count + 1) * sizeof *samples);
    SUNContext context;
    must(SUNContext_Create(NULL, &context), "SUNContext_Create");
    N_Vector atol = N_VNew_Serial(2 * bearing.dof, context);
    for (int i = 11; i < argc; i++) {
        const double tol = atof(argv[i]);
        bearing_scales(&bearing, tol * length, tol * speed, N_VGetArrayPointer(atol));
        double wall = INFINITY, cpu = INFINITY, spent = 0.0;
        Work work = {0, 0};
        int repeats = 0;
        do {
            const double c0 = clock_of(CLOCK_PROCESS_CPUTIME_ID), w0 = clock_of(CLOCK_MONOTONIC);
            work = run(argv[1], count, rate, atol, tol * rtol, max_step, samples);
            const double c = clock_of(CLOCK_PROCESS_CPUTIME_ID) - c0, w = clock_of(CLOCK_MONOTONIC) - w0;
            cpu = fmin(cpu, c);
            wall = fmin(wall, w);
            spent += w;
            repeats++;
        } while (spent + wall < budget);
        char path[4096];
        snprintf(path, sizeof path, "%s-%d.f64", argv[3], i - 11);
        FILE *out = fopen(path, "wb");
        if (!out || fwrite(samples, 4 * sizeof *samples, (size_t)(count + 1), out) != (size_t)(count + 1)) {
            fprintf(stderr, "cannot write %s\n", path);
            return 2;
        }
        fclose(out);
        printf("{\"tol\": %.6g, \"cpu\": %.9g, \"wall\": %.9g, \"rhs\": %ld, \"steps\": %ld, \"repeats\": %d}\n", tol, cpu,
               wall, work.rhs, work.steps, repeats);
        fflush(stdout);
    }
    return 0;
}
