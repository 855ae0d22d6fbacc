#!/usr/bin/env python3
"""brinell beside what users write today: installs, checks, runs and plots everything.

    python3 benches/peers/run.py             about twelve minutes; writes docs/src/speed.md, docs/src/peers.csv, docs/src/pictures/work-precision.png
    python3 benches/peers/run.py --quick     about two minutes: fewer tolerances, not the slowest solvers; the same files, into the build folder

Needs Python 3.11 or later with venv, Rust, gcc, and for packages that are missing apt-get as root (or through sudo without a
password). A peer that cannot be had is a row with the reason. README.md beside this file says what is compared.
"""

import argparse
import os
import pathlib

from comparison.measure import command_line, long_run, match, measure
from comparison.peers import PEERS
from comparison.problem import Problem
from comparison.programs import Programs
from comparison.report import write_results
from comparison.settings import DEFAULT_LAWS_S, HERE, ROOT
from comparison.tools import say


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true",
                        help="fewer tolerances, no slow solvers; results stay in the build folder")
    parser.add_argument("--no-install", action="store_true", help="never call apt-get")
    parser.add_argument("--build", type=pathlib.Path, default=HERE / "build",
                        help="folder for what is built and cached")
    parser.add_argument("--docs", type=pathlib.Path,
                        help="folder for the results; default: docs/src/, or the build folder with --quick")
    parser.add_argument("--only", nargs="+", metavar="KEY",
                        help="only these peers (with brinell): " + ", ".join(p.key for p in PEERS))
    args = parser.parse_args()
    build = args.build.resolve()
    build.mkdir(parents=True, exist_ok=True)
    docs = args.docs or (build / "docs" if args.quick or args.only else ROOT / "docs/src")

    programs = Programs(build, not args.no_install)
    problem = Problem(programs)
    say(f"the reference moves by {problem.trust['outer_ax']:.1e} when its step is doubled")
    checks = {
        "brinell": ("brinell", ["check", str(problem.example)]),
        "c": ("c", ["check", str(problem.file)]),
        "numpy": ("python", ["check-numpy", str(problem.file)]),
        "numba": ("python", ["check-numba", str(problem.file)]),
        "octave": ("octave", ["check", str(problem.file)]),
    }
    for name, (program, (how, argument)) in checks.items():
        if program in programs.commands:
            problem.check(name, [*programs.commands[program], how], argument)

    peers = [p for p in PEERS if not (args.quick and p.slow)]
    if args.only:
        peers = [p for p in peers if p.key in {"brinell", "run", *args.only}]
    fast = [p for p in peers if p.program in ("brinell", "c", "diffsol") or p.key == "numba-RK45"]
    # In turns, so that a busy moment of the machine falls on nobody alone; the shortest of all repeats counts.
    for turn in range(1 if args.quick else 3):
        for peer in fast:
            measure(peer, programs, problem, args, 0.25)
    for peer in peers:
        if peer not in fast:
            measure(peer, programs, problem, args, 0.0)
    for peer in peers:
        peer.matched = match(peer)
        if peer.rungs and min(r["errors"]["outer_ax"] for r in peer.rungs) > 0.5 and not peer.reason:
            raise SystemExit(f"{peer.name} SOLVES ANOTHER PROBLEM, or its tolerances are far too loose")
        if not args.quick:
            long_run(peer, programs, problem)
    say("the command line")
    cli = command_line(programs)
    alone = command_line(programs, "--set", f"simulation.duration_s={DEFAULT_LAWS_S:g}", "--no-report", "--signals", "none")
    write_results(docs, peers, programs, problem, cli, [x / DEFAULT_LAWS_S for x in alone], args)
    print((docs / "speed.md").read_text())
    say(f"written to {os.path.relpath(docs)}")


if __name__ == "__main__":
    main()
