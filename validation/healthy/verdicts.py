"""How `brinell analyze` judges simulated healthy bearings of the catalogue.

    python3 validation/healthy/verdicts.py BRINELL

BRINELL is the command. Twelve bearings, each at three speeds and three loads, a second or 30 revolutions long, with a sensor on the outer ring
and its housing, as by default; rollers also straight, and each with a bare ring, without a housing; and larger bearings, more clearance and
higher speed, beyond what the verdict was looked at with. Five minutes on two cores. Prints how many runs have lines that would be damage of a
measured bearing, of how many, by speed, and the range of the RMS along the load.
"""

import itertools
import json
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

BALLS = ["6203", "6205", "6207", "6305", "UC204"]
ROLLERS = ["NU204", "NU206", "N205", "NU308", "NJ206", "N208"]
LARGER = ["NU309", "NU310", "N306", "NJ308"]
SPEEDS_RPM, LOADS_N = [300, 1500, 3600], [100, 1000, 4000]
STRAIGHT, BARE = ["bearing.profile=straight"], ["housing.mass_kg=0"]


def judged(command, folder, number, bearing, rpm, load, settings):
    scenario = f"""name = "{number}"
[bearing]
preset = "{bearing}"
[operation]
speed_rpm = {rpm}
load_n = [0, -{load}]
load_on = "inner-ring"
gravity_m_per_s2 = [0, -9.81]
[simulation]
duration_s = {max(1.0, 1800 / rpm)}
sample_rate_hz = 25600
start = "equilibrium"
"""
    run = folder / str(number)
    (folder / f"{number}.toml").write_text(scenario)
    changed = [word for setting in settings for word in ("--set", setting)]
    subprocess.run([command, "run", folder / f"{number}.toml", "-o", run, "--no-report", "--quiet", *changed], check=True)
    told = subprocess.run([command, "analyze", run, "-o", folder / f"{number}-analysis", "--json", "-"], check=True, capture_output=True)
    numbers = json.loads((run / "summary.json").read_text())["quantities"]
    # What a measured signal would be: lines of passing rollers are no damage of a run that had none.
    told = json.loads(told.stdout)
    called = told["verdict"]["says"] == "damage" or any(f["says"] == "as_before" for f in told["families"])
    return called, numbers["sensor_ay.rms"]["value"]


def table(command, title, bearings, speeds, loads, settings):
    cases = list(itertools.product(bearings, speeds, loads))
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as threads:
        found = list(threads.map(lambda k: judged(command, Path(folder), k, *cases[k], settings), range(len(cases))))
    damaged = lambda these: f"{sum(called for called, _ in these)} of {len(these)}"
    by_speed = [f"{damaged([f for case, f in zip(cases, found) if case[1] == rpm])} at {rpm} r/min" for rpm in speeds]
    levels = [rms for _, rms in found]
    print(f"{title:44} {damaged(found):>8}: {', '.join(by_speed)}; RMS {min(levels):.2f} to {max(levels):.2f} m/s^2", flush=True)


def main():
    command = Path(sys.argv[1]).resolve()
    table(command, "balls", BALLS, SPEEDS_RPM, LOADS_N, [])
    table(command, "NN3007", ["NN3007"], SPEEDS_RPM, LOADS_N, [])
    for name, settings in [("", []), (", straight", STRAIGHT)]:
        table(command, f"rollers{name}", ROLLERS, SPEEDS_RPM, LOADS_N, settings)
        table(command, f"rollers{name}, bare ring", ROLLERS, SPEEDS_RPM, LOADS_N, settings + BARE)
    table(command, "larger rollers", LARGER, [300, 1500, 2400, 3600, 5000], [2000, 8000], [])
    table(command, "larger rollers, bare ring", LARGER, [300, 1500, 2400, 3600, 5000], [2000, 8000], BARE)
    table(command, "rollers, C4", ROLLERS, SPEEDS_RPM, [1000, 4000], ["bearing.clearance_class=C4"])


if __name__ == "__main__":
    main()
