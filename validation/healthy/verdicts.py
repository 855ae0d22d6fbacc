"""How `brinell analyze` judges simulated healthy bearings of the catalogue.

    python3 validation/healthy/verdicts.py BRINELL

BRINELL is the command. Twelve bearings, each at three speeds and three loads, a second or 30 revolutions long, with a sensor on the bare outer
ring and with an outer ring of 2 kg, as one that sits in a housing; a minute on two cores. Prints the verdicts by bearing: below the makers' least
load (0.02 C of roller bearings, 0.01 C of ball bearings), from it on, and from it on in the housing; and the range of the RMS along the load.
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
BARE, HOUSED = "", "outer_ring_mass_kg = 2.0"


def judged(command, folder, bearing, rpm, load, ring):
    name = f"{bearing}-{rpm}-{load}-{'housed' if ring else 'bare'}"
    scenario = f"""name = "{name}"
[bearing]
preset = "{bearing}"
{ring}
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


def least_load(command, bearing):
    told = subprocess.run([command, "bearing", "show", bearing, "--json"], check=True, capture_output=True)
    share = 0.02 if bearing.startswith("N") else 0.01
    return share * (json.loads(told.stdout).get("dynamic_load_rating_n") or 0.0)


def main():
    command = Path(sys.argv[1]).resolve()
    sums = {}
    with tempfile.TemporaryDirectory() as folder, ThreadPoolExecutor(2) as threads:
        for bearing in BEARINGS:
            least = least_load(command, bearing)
            cases = list(itertools.product(SPEEDS_RPM, LOADS_N, [BARE, HOUSED]))
            found = list(threads.map(lambda case: judged(command, Path(folder), bearing, *case), cases))
            parts = {"below": [], "bare": [], "housed": []}
            for (_, load, ring), told in zip(cases, found):
                if load >= least:
                    parts["housed" if ring else "bare"].append(told)
                elif not ring:
                    parts["below"].append(told)
            texts = []
            for part, tolds in parts.items():
                counts = Counter(says for says, _ in tolds)
                levels = [rms for _, rms in tolds]
                kind = "NN3007" if bearing == "NN3007" else "rollers" if bearing.startswith("N") else "balls"
                sums.setdefault((kind, part), Counter()).update(counts)
                if tolds:
                    texts.append(f"{part} {dict(counts)}, RMS {min(levels):.2f} to {max(levels):.2f} m/s^2")
            print(f"{bearing:8} {'; '.join(texts)}", flush=True)
    for (kind, part), counts in sums.items():
        print(f"{kind:8} {part:7} damage in {counts['damage']} of {sum(counts.values())}")


if __name__ == "__main__":
    main()
