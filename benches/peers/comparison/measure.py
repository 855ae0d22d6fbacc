"""Runs the peers, and matches their costs at one error."""

import array
import json
import math
import os
import pathlib
import subprocess
import sys
import time

from .settings import (FROM_S, LENGTH, LONG_S, MATCHED, RATE, RTOL, SCENARIO, SPEED, TIME_LIMIT_S, WINDOW_S)
from .tools import capture, one_thread, say


def read_samples(path):
    values = array.array("d")
    values.frombytes(path.read_bytes())
    if sys.byteorder == "big":
        values.byteswap()
    return [values[k : k + 4] for k in range(0, len(values), 4)]


def launch(peer, programs, problem, tolerances, duration, budget, out):
    """Lines of JSON, one for each tolerance; fewer where time ran out or the solver gave up."""
    scenario = problem.example if peer.program in ("brinell", "diffsol") else problem.file
    settings = [duration, RATE, LENGTH, SPEED, RTOL, peer.max_step, budget, *tolerances]
    command = [*programs.commands[peer.program], peer.method, str(scenario), str(out), *map(repr, settings)]
    before = os.times()
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=one_thread())
    reason = None
    try:
        stdout, stderr = process.communicate(timeout=TIME_LIMIT_S)
        if process.returncode:
            reason = (stderr.strip().splitlines() or ["?"])[-1][:200]
    except subprocess.TimeoutExpired:
        process.kill()
        stdout, _ = process.communicate()
        reason = f"stopped after {TIME_LIMIT_S:g} s"
    after = os.times()
    whole = after.children_user + after.children_system - before.children_user - before.children_system
    return [json.loads(line) for line in stdout.splitlines() if line.startswith("{")], reason, whole


def measure(peer, programs, problem, args, budget):
    if peer.program in programs.reasons or peer.program not in programs.commands:
        peer.reason = programs.reasons.get(peer.program, "not built")
        return
    duration = FROM_S + peer.windows * WINDOW_S + 1 / RATE
    tolerances = peer.tolerances[::2] if args.quick else peer.tolerances
    out = programs.build / f"out-{peer.key}"
    lines, reason, whole = launch(peer, programs, problem, tolerances, duration, budget, out)
    for i, line in enumerate(lines):
        if i < len(peer.rungs):
            rung = peer.rungs[i]
            rung["cpu"], rung["wall"] = min(rung["cpu"], line["cpu"]), min(rung["wall"], line["wall"])
            rung["repeats"] += line["repeats"]
        else:
            line["duration"] = duration
            line["errors"] = problem.errors(read_samples(pathlib.Path(f"{out}-{i}.f64")), peer.windows)
            peer.rungs.append(line)
    peer.reason = reason
    done = [f"{r['errors']['outer_ax']:.1e} at {r['cpu'] / r['duration']:.3g}" for r in peer.rungs]
    say(f"{peer.name}: {whole:.1f} s of CPU; {', '.join(done)}{'; ' + reason if reason else ''}")


def per_second(rung, key):
    return None if rung.get(key) is None else rung[key] / rung["duration"]


def match(peer):
    """Cost at the matched error: on the line (in logarithms) between the loosest tolerance that meets it and the next
    looser one.
    """
    previous = None
    for rung in peer.rungs:
        error = rung["errors"]["outer_ax"]
        if error <= MATCHED or peer.plain:
            row = {key: per_second(rung, key) for key in ("cpu", "wall", "rhs")}
            row |= {"error": error, "inner": rung["errors"]["inner_ax"], "tol": rung["tol"], "between": False}
            if previous and not peer.plain:
                old = previous["errors"]["outer_ax"]
                share = math.log(old / MATCHED) / math.log(old / error)
                for key in ("cpu", "wall", "rhs"):
                    if row[key] is not None:
                        row[key] = per_second(previous, key) ** (1 - share) * row[key] ** share
                row |= {"error": MATCHED, "between": True}
            return row
        previous = rung
    return None


def long_run(peer, programs, problem):
    """Cost of a simulated second over a longer run, at the tolerance that meets the matched error."""
    if peer.matched and peer.long:
        out = programs.build / f"long-{peer.key}"
        lines, _, _ = launch(peer, programs, problem, [peer.matched["tol"]], LONG_S, 0.0, out)
        for line in lines:
            peer.matched["long"] = line["cpu"] / LONG_S
            say(f"{peer.name} over {LONG_S:g} s: {peer.matched['long']:.3g} s of CPU a simulated second")


def command_line(programs, *options):
    """The whole command on the whole scenario, under the default laws, with what `options` say: the best of three."""
    best = None
    for _ in range(3):
        before, started = os.times(), time.perf_counter()
        capture([programs.cli, "run", SCENARIO, "-o", programs.build / "cli", "-q", "--overwrite", *options])
        wall, after = time.perf_counter() - started, os.times()
        cpu = after.children_user + after.children_system - before.children_user - before.children_system
        best = (cpu, wall) if best is None or cpu < best[0] else best
    return best
