"""brinell beside diffsol where rollers and rings tilt: cost at the same error on examples/one-sided.toml with 20 slices.

    cargo build --release -p brinell-peers
    python3 benches/peers/tilting.py [FOLDER]    # a minute or two; needs NumPy

FOLDER holds the programs (default: target/release). Both solve brinell's own equations (diffsol: Tsitouras 5(4), vectorised right-hand side), deliver the same samples, and
run a ladder of tolerances. The reference is brinell at 1/100 of its tolerance. Error and match as in run.py: the relative L2 difference of the outer
ring's ax in windows of 2.5 ms, their median; cost at 1 % between two tolerances.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

ROOT = pathlib.Path(__file__).parents[2]
RATE, DURATION = 25600.0, 0.021
WINDOW, FROM = 2.5e-3, 1e-3
MATCHED = 0.01


def launch(program, method, scenario, out, tolerances, max_step):
    # Scales of displacement and speed, relative tolerance and budget of run.py.
    settings = [DURATION, RATE, 1.0, 1000.0, 0.0, max_step, 2.0, *tolerances]
    command = [program, method, str(scenario), str(out), *map(repr, settings)]
    lines = subprocess.run(command, check=True, capture_output=True, text=True).stdout.splitlines()
    runs = [json.loads(line) for line in lines if line.startswith("{")]
    for i, run in enumerate(runs):
        run["ax"] = np.fromfile(f"{out}-{i}.f64").reshape(-1, 4)[:, 2]
    return runs


def error(ax, truth):
    edges = [round((FROM + k * WINDOW) * RATE) for k in range(9)]
    windows = list(zip(edges, edges[1:]))
    return float(np.median([np.linalg.norm(ax[a:b] - truth[a:b]) / np.linalg.norm(truth[a:b]) for a, b in windows]))


def matched(runs, truth):
    previous = None
    for run in runs:
        e = error(run["ax"], truth)
        print(f"  tolerance {run['tol']:.3g}: error {100 * e:.3g} %, {run['cpu'] / DURATION:.3g} CPU s per simulated s, {run['rhs'] / DURATION:.0f} right-hand sides", flush=True)
        if e <= MATCHED:
            if previous is None:
                return run["cpu"] / DURATION
            old, cpu = previous
            share = math.log(old / MATCHED) / math.log(old / e)
            return cpu ** (1 - share) * (run["cpu"] / DURATION) ** share
        previous = (e, run["cpu"] / DURATION)
    return None


def main(folder):
    with tempfile.TemporaryDirectory() as work:
        work = pathlib.Path(work)
        scenario = work / "tilting.toml"
        text = (ROOT / "examples" / "one-sided.toml").read_text()
        scenario.write_text(text.replace("slices = 40", "slices = 20"))
        truth = launch(folder / "brinell-peer", "solver", scenario, work / "truth", [1e-2], 1.0)[0]["ax"]
        costs = {}
        for name, program, method, tolerances, max_step in (
            ("brinell", "brinell-peer", "solver", [16.0 / 2**k for k in range(9)], 1.0),
            ("diffsol", "diffsol-peer", "tsit45", [3.2e-8 / 2**k for k in range(12)], 1.0),
        ):
            print(name)
            costs[name] = matched(launch(folder / program, method, scenario, work / name, tolerances, max_step), truth)
        if all(costs.values()):
            print(f"at 1 %: brinell {costs['brinell']:.3g}, diffsol {costs['diffsol']:.3g} CPU s per simulated s, ratio {costs['diffsol'] / costs['brinell']:.3g}")


main(pathlib.Path(sys.argv[1]) if sys.argv[1:] else ROOT / "target" / "release")
