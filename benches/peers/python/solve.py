"""SciPy's solve_ivp on the bearing.

    solve.py check-numpy|check-numba PROBLEM STATES      accelerations at every state of a table, then the start
    solve.py PLATFORM-METHOD PROBLEM OUT DURATION RATE LENGTH SPEED RTOL MAX_STEP BUDGET TOL...

PLATFORM is numpy or numba, METHOD one of solve_ivp's. Each TOL is a run with absolute tolerances TOL * LENGTH and TOL * SPEED (on a
surface) and relative TOL * RTOL, repeated for BUDGET seconds at most. The rings' accelerations go to OUT-<number>.f64.
"""

import importlib
import json
import sys
import time
import warnings

import numpy as np
import problem
from scipy.integrate import solve_ivp
from scipy.sparse import csc_matrix

# solve_ivp raises smaller relative tolerances to this, with a warning.
LEAST_RTOL = 100 * np.finfo(float).eps


def check(rhs, p, path):
    numbers = np.array(open(path).read().split(), dtype=float)
    for row in numbers[1:].reshape(int(numbers[0]), 1 + 2 * p.dof):
        print(*map(float, rhs(row[0], row[1:].copy())[p.dof :]))
    print(*map(float, problem.start(p)))


def run(rhs, p, method, times, atol, rtol, max_step):
    options = {"jac_sparsity": csc_matrix(problem.sparsity(p))} if method in ("Radau", "BDF") else {}
    solution = solve_ivp(
        rhs, (0.0, times[-1]), problem.start(p), method, t_eval=times, rtol=rtol, atol=atol, max_step=max_step, **options
    )
    if not solution.success:
        raise SystemExit(solution.message)
    samples = np.array([rhs(t, y)[-4:] for t, y in zip(times, solution.y.T.copy(), strict=True)])
    return solution, samples


def main():
    platform, method = sys.argv[1].split("-")
    if platform == "check":
        platform, method = method, None
    p = problem.read(sys.argv[2])
    rhs = importlib.import_module(f"bearing_{platform}").make_rhs(p)
    if method is None:
        return check(rhs, p, sys.argv[3])
    out = sys.argv[3]
    duration, rate, length, speed, share, max_step, budget = map(float, sys.argv[4:11])
    times = np.arange(int(duration * rate + 1e-6) + 1) / rate
    rhs(0.0, problem.start(p))  # Numba compiles here, outside the clock
    warnings.simplefilter("ignore")  # differences of a contact that is about to close overflow now and then
    for i, tol in enumerate(map(float, sys.argv[11:])):
        atol, rtol = problem.scales(p, tol * length, tol * speed), max(tol * share, LEAST_RTOL)
        cpu = wall = float("inf")
        spent, repeats = 0.0, 0
        while True:
            before = time.process_time(), time.perf_counter()
            solution, samples = run(rhs, p, method, times, atol, rtol, max_step)
            took = time.perf_counter() - before[1]
            cpu, wall = min(cpu, time.process_time() - before[0]), min(wall, took)
            spent, repeats = spent + took, repeats + 1
            if spent + wall >= budget:
                break
        samples.astype("<f8").tofile(f"{out}-{i}.f64")
        print(json.dumps(dict(tol=tol, cpu=cpu, wall=wall, rhs=int(solution.nfev), steps=None, repeats=repeats)), flush=True)


if __name__ == "__main__":
    main()
