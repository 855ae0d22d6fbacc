"""Writes the page, the table and the picture."""

import csv
import datetime
import json
import os
import pathlib
import platform
import sys

from .measure import per_second
from .peers import TARGETS
from .settings import CHANNELS, DEFAULT_LAWS_S, FROM_S, HERE, LONG_S, MATCHED, WINDOW_S, WINDOWS
from .tools import capture, say


def figures(x):
    """Three of them."""
    if x is None:
        return ""
    return f"{x:.0f}" if x >= 99.95 else f"{x:.3g}"


def machine():
    cpu = platform.processor() or platform.machine()
    info = pathlib.Path("/proc/cpuinfo")
    if info.exists():
        lines = info.read_text().splitlines()
        names = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
        cpu = names[0] if names else cpu
    system = platform.freedesktop_os_release()["PRETTY_NAME"] if sys.platform == "linux" else platform.system()
    return f"{cpu}, {os.cpu_count()} cores, {system}"


def overhead(peers):
    """What a run adds to the solver at the same tolerance; above, the solver's is the looser one that meets the
    error.
    """
    solver, run = (next(p for p in peers if p.key == key) for key in ("brinell", "run"))
    alike = [r for r in solver.rungs if r["tol"] == run.matched["tol"]]
    if not alike:
        return []
    alone = per_second(alike[0], "cpu")
    return [
        f"At the same tolerance the solver alone takes {figures(alone)} s: the run costs "
        f"{figures(run.matched['cpu'] / alone)} of that. Counted instructions:",
        "`benches/peers/README.md`.",
        "",
    ]


def page(peers, programs, problem, cli, default_laws, args):
    base = next(p for p in peers if p.key == "brinell").matched
    whole = next(p for p in peers if p.key == "run").matched
    versions = ", ".join(f"{name} {v}" for name, v in programs.versions.items())
    trust = problem.trust["outer_ax"]
    lines = [
        "# Side by side",
        "",
        "The rectangle scenario (`examples/rectangle.toml`: NN3007, 248 states) in what users write today, **under the paper's laws**",
        "(`laws = \"li2023\"`, `cage.guidance_film = \"quasi-static\"`), the only ones that the other programs have; brinell's "
        "default laws have a row of their own. Written by",
        "`python3 benches/peers/run.py`; `benches/peers/README.md` says what is compared and how, and what is not "
        "fair.",
        "",
        f"Run on {datetime.date.today().isoformat()}; {machine()}. {versions}.",
        "",
        f"CPU seconds of one thread for a simulated second, at a median error of {100 * MATCHED:g} % of `outer_ax` "
        "over windows of",
        f"{1e3 * WINDOW_S:g} ms from {1e3 * FROM_S:g} ms on, all from one run on one machine. \"Ratio\" is to "
        "brinell's solver, which delivers the same",
        "samples as the peers; \"to a run\" is to brinell's whole run at `accuracy = \"standard\"`, which also feeds "
        "its anti-alias filter, gathers",
        "statistics and keeps audits of energy and momentum.",
        "",
        "| | CPU s per simulated s | ratio | to a run | wall s | right-hand sides per simulated s "
        f"| CPU s over {LONG_S:g} s | |",
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |",
    ]
    for peer in peers:
        m = peer.matched
        if m is None:
            least = min((r["errors"]["outer_ax"] for r in peer.rungs), default=None)
            note = peer.reason or (f"{100 * MATCHED:g} % not reached: {100 * least:.2g} %" if least else "no run")
            lines.append(f"| {peer.name} | | | | | | | {note} |")
            continue
        notes = []
        if peer.plain:
            notes.append(f"error {100 * m['error']:.2g} %")
        elif not m["between"]:
            notes.append(f"loosest tolerance tried: error {100 * m['error']:.2g} %")
        if peer.windows < WINDOWS:
            windows = "the first window" if peer.windows == 1 else f"the first {peer.windows} windows"
            notes.append(f"{windows} only")
        if peer.reason:
            notes.append(peer.reason)
        cells = [
            figures(m["cpu"]),
            figures(m["cpu"] / base["cpu"]),
            figures(m["cpu"] / whole["cpu"]),
            figures(m["wall"]),
            f"{m['rhs']:,.0f}".replace(",", " ") if m["rhs"] else "",
            figures(m.get("long")),
            "; ".join(notes),
        ]
        lines.append(f"| {peer.name} | {' | '.join(cells)} |")
        if peer.key == "run":
            cpu, wall = map(figures, default_laws)
            lines.append(f"| {peer.name}, its default laws | {cpu} | | | {wall} | | | another problem: contacts 4.5 times as stiff |")
    lines += [
        "",
        "The row of the default laws is `brinell run examples/rectangle.toml --set "
        f"simulation.duration_s={DEFAULT_LAWS_S:g} --no-report --signals none`. The command "
        "`brinell run examples/rectangle.toml` under them, half a second with its files and report: "
        f"{figures(cli[0])} s of CPU, {figures(cli[1])} s of wall",
        "time.",
        "",
        *overhead(peers),
        "Against what was aimed for, each time by the fastest of the kind:",
        "",
        "| | aimed for | found, by solvers | found, by a whole run |",
        "| --- | ---: | ---: | ---: |",
    ]
    for name, keys, target in TARGETS:
        costs = [p.matched["cpu"] for p in peers if p.key in keys and p.matched]
        found = [figures(min(costs) / m["cpu"]) for m in (base, whole)] if costs else ["", ""]
        lines.append(f"| {name} | {target} | {' | '.join(found)} |")
    lines += [
        "",
        '![Cost against error of every solver](pictures/work-precision.png "drawn by benches/peers/run.py")',
        "",
        "Every run is in `peers.csv`. The trajectory that errors are measured against moves by "
        f"{100 * trust:.1g} % itself when its step is doubled:",
        "points near that say no more.",
        "",
    ]
    return "\n".join(lines)


def write_results(folder, peers, programs, problem, cli, default_laws, args):
    (folder / "pictures").mkdir(parents=True, exist_ok=True)
    (folder / "speed.md").write_text(page(peers, programs, problem, cli, default_laws, args))
    with (folder / "peers.csv").open("w", newline="") as out:
        table = csv.writer(out, lineterminator="\n")
        errors = [f"error_{c}" for c in CHANNELS]
        table.writerow(["peer", "tolerance", *errors, "cpu_s_per_s", "wall_s_per_s", "rhs_per_s", "runs"])
        for peer in peers:
            for r in peer.rungs:
                cost = [per_second(r, key) for key in ("cpu", "wall", "rhs")]
                numbers = [*r["errors"].values(), *cost]
                cells = ["" if x is None else f"{x:.4g}" for x in numbers]
                table.writerow([peer.key, f"{r['tol']:.4g}", *cells, r["repeats"]])
    curves = []
    for p in peers:
        points = [(r["errors"]["outer_ax"], per_second(r, "cpu")) for r in p.rungs]
        curves.append({"key": p.key, "name": p.name.replace("`", ""), "points": points})
    plot = {"curves": curves, "matched": MATCHED, "floor": problem.trust["outer_ax"]}
    data = programs.build / "plot.json"
    data.write_text(json.dumps(plot))
    if "python" in programs.reasons:
        say(f"no picture: {programs.reasons['python']}")
        return
    picture = folder / "pictures" / "work-precision"
    capture([programs.venv / "bin" / "python", HERE / "python" / "plot.py", data, picture])
