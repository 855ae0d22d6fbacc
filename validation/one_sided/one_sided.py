"""Damage off the middle, with tilting and in the plane: the tables of docs/src/theory/tilting.md.

    python3 validation/one_sided/one_sided.py BRINELL

Runs variants of examples/one-sided.toml, 1 s each, and prints what differs: acceleration of the outer ring, tilt of the inner ring against
the outer one, and the share of the load that row 1 carries; then how the spall at one side depends on what is assumed. Warnings of the runs go to
standard error. Needs NumPy.
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

EXAMPLE = Path(__file__).parents[2] / "examples" / "one-sided.toml"
FULL = "defects.0.shape={ rectangle = { length_mm = 3.0, width_mm = 6.0 } }"
CENTRED = "defects.0.axial_offset_mm=0.0"
BOTH = [
    "defects.1.on=outer-raceway",
    "defects.1.row=2",
    "defects.1.center_deg=0.0",
    "defects.1.depth_um=20.0",
    "defects.1.shape={ rectangle = { length_mm = 3.0, width_mm = 6.0 } }",
]
CASES = {
    "healthy": None,
    "3 mm in the middle of row 1": [CENTRED],
    "3 mm at one side of row 1": [],
    "whole width of row 1": [CENTRED, FULL],
    "whole width of both rows": [CENTRED, FULL, *BOTH],
}


# Of the spall at one side of row 1.
ASSUMED = {
    "as above": [],
    "160 slices": ["contact.slices=160"],
    "`accuracy = \"reference\"`": ["simulation.accuracy=reference"],
    "rings held against tilting": [f"support.{ring}_tilt_stiffness_nm_per_rad=1e9" for ring in ("inner", "outer")],
    "the paper's stiffness": ["contact.inner_stiffness=1.828e8", "contact.outer_stiffness=1.898e8"],
}


def run(brinell, folder, settings, model):
    text = EXAMPLE.read_text()
    if settings is None:
        text = text[: text.index("[[defects]]")] + text[text.index("[simulation]") :]
        settings = []
    scenario = folder / "scenario.toml"
    scenario.write_text(text)
    record = ["inner_tilt_*", "outer_tilt_*", "contact*_outer_force", "roller*_orbit"]
    command = [brinell, "run", scenario, "-o", folder / "out", "--overwrite", "--no-report", "--quiet", "--signals", "csv"]
    sets = [*settings, f"simulation.model={model}", "simulation.duration_s=1.0"]
    if model == "tilting":
        sets.append(f"simulation.record={json.dumps([*record, 'sensor_*'])}")
    else:
        sets.append(f"simulation.record={json.dumps([*record[2:], 'sensor_*'])}")
    for setting in sets:
        command += ["--set", setting]
    subprocess.run(command, check=True)
    summary = json.loads((folder / "out" / "summary.json").read_text())
    path = folder / "out" / "signals.csv"
    with path.open() as file:
        names = file.readline().strip().split(",")
    values = np.loadtxt(path, delimiter=",", skiprows=1)
    return summary, dict(zip(names, values.T))


def row_share(signals):
    """Mean share of the load that row 1 carries, along X."""
    along = {1: 0.0, 2: 0.0}
    late = signals["t"] > 0.1
    for name, force in signals.items():
        if name.startswith("contact") and name.endswith("_outer_force"):
            orbit = signals[name.replace("contact", "roller").replace("_outer_force", "_orbit")]
            along[int(name[7])] += np.mean((force * np.cos(orbit))[late])
    return along[1] / (along[1] + along[2])


def main(brinell):
    print("| damage | model | RMS ax, m/s^2 | RMS ay, m/s^2 | kurtosis ax | inner from outer tilt, urad, RMS | row 1's share of the load |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name, settings in CASES.items():
        for model in ("full", "tilting"):
            with tempfile.TemporaryDirectory() as folder:
                summary, signals = run(brinell, Path(folder), settings, model)
            late = signals["t"] > 0.1
            cells = []
            for axis in "xy":
                rms = summary["quantities"][f"sensor_a{axis}.rms"]
                cells.append(f"{rms['value']:.3g} ({rms['low']:.3g} to {rms['high']:.3g})")
            cells.append(f"{summary['quantities']['sensor_ax.kurtosis']['value']:.3g}")
            if model == "tilting":
                relative = [signals[f"inner_tilt_{a}"] - signals[f"outer_tilt_{a}"] for a in "xy"]
                cells.append(f"{1e6 * np.sqrt(np.mean([r[late] ** 2 for r in relative]) * 2):.3g}")
            else:
                cells.append("-")
            cells.append(f"{100 * row_share(signals):.1f} %")
            print(f"| {name} | {model} | " + " | ".join(cells) + " |", flush=True)
    print()
    print("| spall at one side of row 1 | full, RMS ax, m/s^2 | tilting, RMS ax, m/s^2 | ratio |")
    print("| --- | --- | --- | --- |")
    for name, settings in ASSUMED.items():
        rms = []
        for model in ("full", "tilting"):
            with tempfile.TemporaryDirectory() as folder:
                # What holds rings against tilting has no effect in the plane.
                own = [s for s in settings if model == "tilting" or "tilt_stiffness" not in s]
                summary, _ = run(brinell, Path(folder), own, model)
            rms.append(summary["quantities"]["sensor_ax.rms"])
        cells = [f"{r['value']:.3g} ({r['low']:.3g} to {r['high']:.3g})" for r in rms]
        print(f"| {name} | {' | '.join(cells)} | {rms[1]['value'] / rms[0]['value']:.2f} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1])
