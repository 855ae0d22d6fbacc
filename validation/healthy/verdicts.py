"""How `brinell analyze` judges simulated healthy bearings of the catalogue, by their bare outer ring.

    python3 validation/healthy/verdicts.py BRINELL

BRINELL is the command. Twelve bearings, each at three speeds and three loads, a second or 30 revolutions long; half a minute on two cores. Prints the verdicts by bearing and the range of the RMS along the load.
"""

import itertools
import json
import subprocess
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

BEARINGS = ["6203", "6205", "6207", "6305", "UC204", "NU204", "NU206", "N205", "NU308", "NJ206", "N208", "NN3007"]
SPEEDS_RPM, LOADS_N = [300, 1500, 3600], [100, 1000, 4000]


def judged(command, folder, bearing, rpm, load):
    name = f"{bearing}-{rpm}-{load}"
    scenario = f"""name = "{name}"
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
    (folder / f"{name}.toml").write_text(scenario)
    subprocess.run([command, "run", folder / f"{name}.toml", "-o", folder / name, "--no-report", "--quiet"], check=True)
    told = subprocess.run([command, "analyze", folder / name, "-o", folder / f"{name}-analysis", "--json", "-"], check=True, capture_output=True)
    channels = json.loads((folder / name / "summary.json").read_text())["indicators"]["channels"]
    return json.loads(told.stdout)["verdict"]["says"], channels["sensor_ay"]["anti-aliased"]["rms"]["value"]


def main():
    command = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as threads:
        for bearing in BEARINGS:
            cases = itertools.product(SPEEDS_RPM, LOADS_N)
            found = list(threads.map(lambda case: judged(command, Path(folder), bearing, *case), cases))
            levels = [rms for _, rms in found]
            print(f"{bearing:8} {dict(Counter(says for says, _ in found))}, RMS {min(levels):.2f} to {max(levels):.2f} m/s^2")


if __name__ == "__main__":
    main()
