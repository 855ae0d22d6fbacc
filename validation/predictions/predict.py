#!/usr/bin/env python3
"""What brinell predicts for two open measured sets of roller bearings with known damage, written before their data were seen.

    python3 validation/predictions/predict.py target/release/brinell docs/src/predictions

Needs NumPy. Writes adelaide.csv and saarland.csv into the folder, and the tables into the page beside it of the folder's name, between its marks
(else table.md into the folder). Runs go to a temporary folder; some four minutes of CPU.

Adelaide (an N-type cylindrical roller bearing; outer race, 110 um deep, edges of 5 to 90 degrees) has no bearing number in what could be read: an N208 stands for it,
the damage is 8 mm long and as wide as the roller. Saarland's is the NU206 of the catalogue, with damage of the inner raceway of 2 x 3 mm; its depth, 100 um, is assumed.
"""

import csv
import json
import math
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

EDGES_DEG = (5, 20, 30, 45, 90)
SPEEDS_HZ = (5.0, 7.5, 10.0, 12.5)
LOADS_N = (2500.0, 5000.0, 10000.0)
LENGTH_MM, DEPTH_UM, WIDTH_MM = 8.0, 110.0, 9.6
BASE = (90, 10.0, 5000.0)
TURNS = 12.0
RAMP_S = 0.02
# Diameter of the N208's outer raceway.
OUTER_MM = 71.5
# The page holds the tables between these.
BEGIN = "<!-- Written by validation/predictions/predict.py; edits are lost. -->"
END = "<!-- End of what is written. -->"

SCENARIO = """name = "{name}"
[bearing]
preset = "{bearing}"
[operation]
speed_rpm = {rpm}
load_n = [0.0, {down}]
load_on = "inner-ring"
gravity_m_per_s2 = [0.0, -9.81]
[[defects]]
on = "{on}"
center_deg = {center}
depth_um = {depth}
shape = {{ {shape} }}
[simulation]
duration_s = {duration}
record = ["inner_y", "outer_y", "sensor_ay"]
"""


def profile(edge_deg):
    """Arc, width and depth of damage LENGTH_MM long at the surface, whose edges fall by `edge_deg`."""
    ramp = 1e-3 * DEPTH_UM / math.tan(math.radians(edge_deg)) if edge_deg < 90 else 0.0
    half = 0.5 * LENGTH_MM
    return [-half, -half + ramp, half - ramp, half], [WIDTH_MM] * 4, [0.0, DEPTH_UM, DEPTH_UM, 0.0]


def run(brinell, folder, text, *options):
    """The summary of a run and its folder."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "scenario-in.toml").write_text(text)
    command = [brinell, "run", folder / "scenario-in.toml", "-o", folder / "out", "--no-report", "--overwrite", "--json", *options]
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}\n{done.stderr}")
    return json.loads(done.stdout), folder / "out"


def signals(folder):
    with open(folder / "signals.csv") as file:
        names = file.readline().strip().split(",")
    data = np.loadtxt(folder / "signals.csv", delimiter=",", skiprows=1)
    return {name: data[:, k] for k, name in enumerate(names)}


def passes(t, across, speed_hz, kinematic):
    """Entry and time from entry to exit, s, of every pass: how long the ring stays beyond the middle of its displacements while an element is unloaded.
    Shorter ones than a part of what a point of the roller's path takes, `kinematic`, are bounces."""
    low, high = np.percentile(across, [2.0, 98.0])
    beyond = across < 0.5 * (low + high)
    edges = np.flatnonzero(np.diff(beyond.astype(int)))
    pairs = [(t[a], t[b] - t[a]) for a, b in zip(edges[:-1], edges[1:]) if beyond[a + 1]]
    return [(at, gap) for at, gap in pairs if at > 1.5 / speed_hz and 0.4 < gap / kinematic < 1.6]


def interval(values):
    """Mean and 95 % interval of single passes, by Student's t for many."""
    mean = statistics.fmean(values)
    half = 2.0 * statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else float("nan")
    return mean, mean - half, mean + half


def adelaide(brinell, work, edge, speed, load, *options):
    arc, width, depths = profile(edge)
    name = f"adelaide-{edge}-{speed}-{load}"
    text = SCENARIO.format(
        name=name, bearing="N208", rpm=60.0 * speed, down=-load, on="outer-raceway", center=-90.0, depth=DEPTH_UM,
        shape=f"profile = {{ arc_mm = {arc}, width_mm = {width}, depth_um = {depths} }}", duration=round(RAMP_S + TURNS / speed, 6),
    )
    summary, out = run(brinell, work / name, text, "--no-healthy", "--signals", "csv", *options)
    columns = signals(out)
    t, across = columns["t"], 1e6 * (columns["inner_y"] - columns["outer_y"])
    acceleration = columns["sensor_ay"]
    kinematic = LENGTH_MM / (math.pi * OUTER_MM * summary["defect_frequencies"]["hz"]["ftf"])
    found = passes(t, across, speed, kinematic)
    gaps = [1e3 * gap for _, gap in found]
    dips, entries, exits = [], [], []
    period = 1.0 / summary["defect_frequencies"]["hz"]["bpfo"]
    for at, gap in found:
        around = (t > at - 0.3 * period) & (t < at + gap + 0.3 * period)
        before = (t > at - 0.5 * gap) & (t < at + 0.5 * gap)
        after = (t >= at + 0.5 * gap) & (t < at + 1.5 * gap)
        if after.any() and before.any() and t[-1] > at + gap + 0.3 * period:
            dips.append(np.ptp(across[around]))
            entries.append(np.abs(acceleration[before]).max())
            exits.append(np.abs(acceleration[after]).max())
    rms = summary["quantities"]["sensor_ay.rms"]
    ratio = [b / a for a, b in zip(entries, exits)]
    row = {"edge_deg": edge, "speed_hz": speed, "load_n": load, "passes": len(dips)}
    for name, values in (("entry_to_exit_ms", gaps), ("displacement_um", dips), ("exit_over_entry", ratio)):
        row[name], row[name + "_low"], row[name + "_high"] = interval(values) if len(values) > 1 else (float("nan"),) * 3
    row["rms_m_per_s2"], row["rms_low"], row["rms_high"] = rms["value"], rms.get("low"), rms.get("high")
    return row, summary


def saarland(brinell, work, speed, load, *options):
    name = f"saarland-{speed}-{load}"
    text = SCENARIO.format(
        name=name, bearing="NU206", rpm=speed, down=-load, on="inner-raceway", center=0.0, depth=100.0,
        shape="rectangle = { length_mm = 2.0, width_mm = 3.0 }", duration=round(RAMP_S + 2.0 + 600.0 / speed, 6),
    )
    summary, _ = run(brinell, work / name, text, "--signals", "none", *options)
    numbers, healthy = summary["quantities"], summary["healthy"]
    return {
        "speed_rpm": speed, "load_n": load, "bpfi_hz": numbers["defect1.pure_rolling_frequency"]["value"], "found_hz": numbers["defect1.frequency"]["value"],
        "rms_over_healthy": healthy["ratio"]["value"], "ratio_low": healthy["ratio"].get("low"), "ratio_high": healthy["ratio"].get("high"),
    }, summary


def write(path, rows):
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        table.writeheader()
        table.writerows({k: f"{v:.5g}" if isinstance(v, float) else v for k, v in row.items()} for row in rows)


def short(x):
    return "-" if x is None or not math.isfinite(x) else f"{x:.3g}"


def of(row, name):
    return f"{short(row[name])} [{short(row[name + '_low'])}, {short(row[name + '_high'])}]"


def tables(adelaides, saarlands, spreads):
    """The tables of the page."""
    at = {(row["edge_deg"], row["speed_hz"], row["load_n"]): row for row in adelaides}
    lines = [BEGIN, ""]
    lines += ["### Edges, at 10 Hz and 5 kN", "", "| edge | entry to exit, ms | displacement, um | peak after exit over after entry | RMS, m/s^2 | RMS over that of 90 degrees |", "| --- | --- | --- | --- | --- | --- |"]
    upright = at[BASE]["rms_m_per_s2"]
    for edge in EDGES_DEG:
        row = at[(edge, BASE[1], BASE[2])]
        rms = f"{short(row['rms_m_per_s2'])} [{short(row['rms_low'])}, {short(row['rms_high'])}]"
        lines.append(f"| {edge} | {of(row, 'entry_to_exit_ms')} | {of(row, 'displacement_um')} | {of(row, 'exit_over_entry')} | {rms} | {short(row['rms_m_per_s2'] / upright)} |")
    for title, key, values in (("Speeds, edges of 90 degrees, 5 kN", "speed_hz", SPEEDS_HZ), ("Loads, edges of 90 degrees, 10 Hz", "load_n", LOADS_N)):
        lines += ["", f"### {title}", "", f"| {'speed, Hz' if key == 'speed_hz' else 'load, N'} | entry to exit, ms | way along the raceway, mm | displacement, um | RMS over that at 10 Hz and 5 kN |", "| --- | --- | --- | --- | --- |"]
        for value in values:
            row = at[(90, value, BASE[2])] if key == "speed_hz" else at[(90, BASE[1], value)]
            lines.append(f"| {value:g} | {of(row, 'entry_to_exit_ms')} | {short(row['way_mm'])} | {of(row, 'displacement_um')} | {short(row['rms_m_per_s2'] / upright)} |")
    lines += ["", "### The NU206 with damage of the inner raceway", "", "| speed, r/min | load, N | BPFI pure rolling, Hz | found, Hz | RMS over the healthy bearing's |", "| --- | --- | --- | --- | --- |"]
    for row in saarlands:
        ratio = f"{short(row['rms_over_healthy'])} [{short(row['ratio_low'])}, {short(row['ratio_high'])}]"
        lines.append(f"| {row['speed_rpm']:g} | {row['load_n']:g} | {row['bpfi_hz']:.2f} | {'-' if row['found_hz'] is None else format(row['found_hz'], '.2f')} | {ratio} |")
    lines += ["", "### What is assumed does to the levels", "", "| case | level | value | band by what is assumed | first by |", "| --- | --- | --- | --- | --- |"]
    for case, spread in spreads.items():
        level = next(one for one in spread["levels"] if one["name"] == "sensor_ay.rms")
        lines.append(f"| {case} | `{level['name']}`, m/s^2 | {short(level['value'])} | {short(level['low'])} to {short(level['high'])} | `{level['by'][0]['key']}` |")
    return "\n".join([*lines, "", END])


def within(page, text):
    """A page with the text in the place of the one that it has between its marks."""
    before, rest = page.split(BEGIN)
    _, after = rest.split(END)
    return before + text + after


def main(brinell, folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    spreads, adelaides, saarlands = {}, [], []
    with tempfile.TemporaryDirectory() as work:
        work = Path(work)
        for edge in EDGES_DEG:
            for speed in SPEEDS_HZ:
                for load in LOADS_N:
                    options = ["--spread"] if (edge, speed, load) == BASE else []
                    row, summary = adelaide(brinell, work, edge, speed, load, *options)
                    # Way along the raceway between entry and exit, in pure rolling.
                    row["way_mm"] = 1e-3 * row["entry_to_exit_ms"] * summary["defect_frequencies"]["hz"]["ftf"] * math.pi * OUTER_MM
                    adelaides.append(row)
                    if options:
                        spreads["N208, edges of 90 degrees, 10 Hz, 5 kN"] = summary["spread"]
                    print(edge, speed, load, of(row, "entry_to_exit_ms"), of(row, "displacement_um"), flush=True)
        for speed in (85.0, 300.0, 600.0, 969.0):
            for load in (1600.0, 2500.0, 3300.0):
                options = ["--spread"] if (speed, load) == (600.0, 2500.0) else []
                row, summary = saarland(brinell, work, speed, load, *options)
                saarlands.append(row)
                if options:
                    spreads["NU206, 600 r/min, 2500 N"] = summary["spread"]
                print(row, flush=True)
    write(folder / "adelaide.csv", adelaides)
    write(folder / "saarland.csv", saarlands)
    text, page = tables(adelaides, saarlands, spreads), folder.with_suffix(".md")
    if page.is_file():
        page.write_text(within(page.read_text(), text))
    else:
        (folder / "table.md").write_text(text + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
