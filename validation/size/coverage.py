"""How often the interval of `brinell analyze --size` holds the length of damage that was simulated.

    python3 validation/size/coverage.py BRINELL FOLDER [--runs 400] [--seed 4] [--jobs N] [--set known|new]

Draws runs over bearing, surface, speed, load, length, outline (rectangle, ragged, scan), depth, way to the sensor, noise and sample rate; makes them in FOLDER, where finished ones stay;
analyses each by bearing name and speed alone; and prints the tables of the book (docs/src/results/analyze-size.md). `known` are the bearings that the method's constants were set on, `new` others.
Seed 4 and the new bearings are the book's. 400 runs take some fifteen minutes of CPU. Needs NumPy and SciPy.
"""

import argparse
import json
import math
import os
import shutil
import subprocess
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from scipy.ndimage import gaussian_filter
from scipy.stats import beta

BEARINGS = {
    "known": ["6205", "6208", "6304", "6010", "NU206", "N208", "NU305", "NJ207", "6203", "6206", "6308", "6004", "NU204", "N306", "NU210", "NN3007"],
    "new": ["6002", "6207", "6209", "6303", "6310", "6007", "N205", "NU307", "N207", "NJ306", "NU208", "NU310"],
}
BINS = [0.5, 0.8, 1.2, 2, 3, 5, 8, 12]
# Share of the elements' spacing that damage takes at most: beyond 0.65 the method takes it for shorter damage, and says so.
LONGEST = 0.6


def log(rng, low, high):
    return float(np.exp(rng.uniform(math.log(low), math.log(high))))


def numbers(brinell, name):
    """Diameters and length of a bearing's elements, mm, their number, and its static load rating, N."""
    told = json.loads(subprocess.run([brinell, "bearing", "show", name, "--json"], capture_output=True, text=True, check=True).stdout)
    of = {key: number["value"] for key, number in told["numbers"].items()}
    pitch = of.get("bearing.pitch_diameter_mm") or 0.5 * (of["bearing.inner_raceway_diameter_mm"] + of["bearing.outer_raceway_diameter_mm"])
    return {
        "diameter": of["bearing.roller_diameter_mm"],
        "pitch": pitch,
        "count": of["bearing.rollers_per_row"],
        "length": of.get("bearing.roller_length_mm"),
        "rating": told["static_load_rating_n"] or 50000.0,
    }


def scan(rng, length, width, depth, path, step):
    """Depths of a spall with sloping walls and a rough floor, as a profilometer writes heights (um); returns how long what is deeper than 1 um is, mm."""
    n, m, pad = int(length / step) + 1, int(width / step) + 1, int(0.6 / step)
    s, z = np.linspace(-1, 1, n)[None, :], np.linspace(-1, 1, m)[:, None]
    angle = np.arctan2(z, s)
    edge = 1 + 0.12 * np.sin(3 * angle + rng.uniform(0, 6)) + 0.08 * np.sin(5 * angle + rng.uniform(0, 6))
    depths = depth * np.clip((1 - np.hypot(s, z) / edge) / rng.uniform(0.1, 0.4), 0, 1)
    rough = gaussian_filter(rng.normal(size=depths.shape), 0.125 / step)
    depths *= np.clip(1 + rng.uniform(0.03, 0.2) * rough / rough.std(), 0.2, 2)
    whole = np.zeros((m + 2 * pad, n + 2 * pad))
    whole[pad:-pad, pad:-pad] = depths
    np.savetxt(path, -whole, fmt="%.2f", delimiter=",")
    deep = np.nonzero((depths > 1).any(axis=0))[0]
    return (deep[-1] - deep[0] + 1) * step


def draw(k, seed, bearings, known, folder):
    """Run k: what is drawn, and its scenario."""
    rng = np.random.default_rng([seed, k])
    name = bearings[k % len(bearings)]
    b = known[name]
    on = ["outer-raceway", "inner-raceway", "outer-raceway", "inner-raceway", "roller"][rng.integers(5)]
    rpm, rate = log(rng, 300, 3600), float([12800, 25600, 51200, 102400][rng.integers(4)])
    load = b["rating"] * log(rng, 0.02, 0.2)
    radius = 0.5 * (b["pitch"] + b["diameter"]) if on == "outer-raceway" else 0.5 * (b["pitch"] - b["diameter"])
    spacing = 0.5 * math.pi * b["diameter"] if on == "roller" else 2 * math.pi * radius / b["count"]
    length = log(rng, 0.5, min(12, LONGEST * spacing))
    depth = log(rng, 20, 300)
    width = b["length"] * rng.uniform(0.3, 0.95) if b["length"] else b["diameter"] * rng.uniform(0.2, 0.45)
    outline = ["rectangle", "ragged", "scan"][rng.integers(3)]
    if on == "roller" and outline == "scan":
        outline = "ragged"
    true = length
    if outline == "rectangle":
        shape = f"rectangle = {{ length_mm = {length}, width_mm = {width} }}"
    elif outline == "ragged":
        shape = f"random = {{ length_mm = {length}, width_mm = {width}, seed = {k + 1}, roughness = {rng.uniform(0.2, 0.8):.3f} }}"
    else:
        step = min(0.06, length / 16)
        true = scan(rng, length, width, depth, folder / f"{k}.csv", step)
        shape = f'depth_map = {{ file = "{k}.csv", ds_mm = {step}, dz_mm = {step}, rolling_direction = "right", threshold_um = 1.0 }}'
    modes = int(rng.integers(0, 4))
    path = [
        f"{{ frequency_hz = {log(rng, 800, min(12000, 0.45 * rate)):.1f}, damping_ratio = {rng.uniform(0.01, 0.08):.4f}, gain = {rng.uniform(0.3, 1) * rng.choice([-1, 1]):.3f} }}"
        for _ in range(modes)
    ]
    snr = float(rng.uniform(0, 30))
    where = "roller = 1" if on == "roller" else f"center_deg = {-90 + rng.uniform(-25, 25):.2f}"
    text = f"""name = "run{k}"
[bearing]
preset = "{name}"
[operation]
speed_rpm = {rpm:.3f}
load_n = [0.0, {-load:.2f}]
load_on = "inner-ring"
gravity_m_per_s2 = [0.0, -9.81]
[[defects]]
on = "{on}"
{where}
depth_um = {depth:.2f}
shape = {{ {shape} }}
[contact]
tables = "coarse"
[simulation]
duration_s = {max(1.0, 40 * 60 / rpm):.3f}
sample_rate_hz = {rate}
start = "equilibrium"
record = ["sensor_ay"]
[sensor]
noise_rms_m_per_s2 = 1e-6
{"path = [" + ", ".join(path) + "]" if modes else ""}
"""
    told = {"bearing": name, "on": on, "rpm": rpm, "rate": rate, "length": true, "outline": outline, "depth": depth, "modes": modes, "snr": snr}
    return told, text


def one(k, args, known):
    told, text = draw(k, args.seed, BEARINGS[args.set], known, args.folder)
    record = args.folder / f"{k}.npz"
    if not record.exists():
        (args.folder / f"{k}.toml").write_text(text)
        out = args.folder / f"run{k}"
        command = [args.brinell, "run", args.folder / f"{k}.toml", "-o", out, "--signals", "npz", "--no-report", "--no-healthy", "--quiet", "--overwrite"]
        subprocess.run(command, check=True, capture_output=True)
        with np.load(out / "signals.npz") as signals:
            x = signals["sensor_ay"][int(0.15 * told["rate"]) :]
        noise = x.std() * 10 ** (-told["snr"] / 20)
        np.savez(record, x=(x + noise * np.random.default_rng([args.seed, k, 99]).normal(size=len(x))).astype("f4"))
        shutil.rmtree(out)
    command = [args.brinell, "analyze", record, "--unit", "m/s^2", "--rate", str(told["rate"]), "--speed", f"{told['rpm']:.3f}", "--bearing", told["bearing"], "--size", "--json", "-"]
    size = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["size"]
    return told | {"size": size["length_mm"], "reason": size.get("reason")}


def row(name, runs):
    told = [run for run in runs if run["size"]]
    if not told:
        return f"| {name} | {len(runs)} | 0 | | | |"
    held = sum(run["size"]["low"] <= run["length"] <= run["size"]["high"] for run in told)
    bias = np.median([run["size"]["value"] / run["length"] for run in told])
    wide = np.median([(run["size"]["high"] - run["size"]["low"]) / run["size"]["value"] for run in told])
    low = beta.ppf(0.025, held, len(told) - held + 1) if held else 0
    high = beta.ppf(0.975, held + 1, len(told) - held) if held < len(told) else 1
    share = f"{held}: {100 * held / len(told):.0f} % ({100 * low:.0f} to {100 * high:.0f} %)"
    return f"| {name} | {len(runs)} | {len(told)} | {share} | {100 * (bias - 1):+.0f} % | {100 * wide:.0f} % |"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("brinell", type=lambda p: str(Path(p).resolve()))
    parser.add_argument("folder", type=Path)
    parser.add_argument("--runs", type=int, default=400)
    parser.add_argument("--seed", type=int, default=4)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--set", choices=BEARINGS, default="new")
    args = parser.parse_args()
    args.folder.mkdir(parents=True, exist_ok=True)
    known = {name: numbers(args.brinell, name) for name in BEARINGS[args.set]}
    with ThreadPoolExecutor(args.jobs) as pool:
        runs = list(pool.map(lambda k: one(k, args, known), range(args.runs)))
    (args.folder / "runs.json").write_text(json.dumps(runs, indent=1))
    print("| | runs | told | interval holds the length (95 % of the share) | median of value over length | median width over value |\n| --- | ---: | ---: | ---: | ---: | ---: |")
    print(row("all", runs))
    for low, high in zip(BINS, BINS[1:]):
        print(row(f"{low} to {high} mm", [run for run in runs if low <= run["length"] < high]))
    print(row("ragged and scan", [run for run in runs if run["outline"] != "rectangle"]))
    for key, values in [("on", ["outer-raceway", "inner-raceway", "roller"]), ("outline", ["rectangle", "ragged", "scan"])]:
        for value in values:
            print(row(value, [run for run in runs if run[key] == value]))
    for key, low, high, words in [("rpm", 300, 700, "300 to 700 r/min"), ("rpm", 700, 3600, "700 to 3600 r/min"), ("snr", 0, 10, "noise 0 to 10 dB below"), ("snr", 10, 30, "noise 10 to 30 dB below")]:
        print(row(words, [run for run in runs if low <= run[key] < high]))
    print("\nWhere it is not told:\n")
    for reason, count in Counter(run["reason"].split(":")[0].split(" s of signal")[-1] for run in runs if run["reason"]).most_common():
        print(f"- {count}: {reason}")
    print("\nWhere the interval does not hold the length:\n")
    for k, run in enumerate(runs):
        size = run["size"]
        if size and not size["low"] <= run["length"] <= size["high"]:
            print(f"- run {k}: {run['bearing']}, {run['on']}, {run['outline']}, {run['length']:.2f} mm, {run['depth']:.0f} µm deep, {run['rpm']:.0f} r/min; told {size['low']:.2f} to {size['high']:.2f} mm")


if __name__ == "__main__":
    main()
