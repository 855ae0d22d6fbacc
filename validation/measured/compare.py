"""Simulated and measured envelopes of a 6205 with pits, beside each other.

    python3 validation/measured/compare.py RECORDS BRINELL [-o FOLDER] [--set KEY=NUMBER]

RECORDS is a folder with records.csv (docs/src/measured.md says which records), BRINELL the command. `brinell calibrate` fits the sensor of `drive-end.toml` to one record; all others are predicted with what it
found, by the size, depth and place of their pits and by their speed alone. Prints the state of the fit and two Markdown tables and writes measured.png to FOLDER (out/measured). Needs the brinell package, NumPy, SciPy and matplotlib.

A record's numbers are means of eight segments of half a second, in the last columns measured and predicted. A statement counts bearings, each the mean of its two speeds: of three and more, the mean and its
95 % Student interval; of one, both speeds and no interval.
"""

import argparse
import csv
import json
import re
import shlex
import subprocess
from pathlib import Path

import numpy as np
from scipy import signal, stats

import brinell

HERE = Path(__file__).resolve().parent
FITTED = "1797_OR@6_7_DE12"
RATE = 12_000.0
G = 9.80665
BAND_HZ = (2000.0, 5500.0)
SEGMENTS, SECONDS = 8, 0.5
# Diameter in thousandths of an inch to depth in inches, as the publisher states.
DEPTH_IN = {7: 0.011, 14: 0.011, 21: 0.011, 28: 0.050}
PLACE_DEG = {"6": -90.0, "3": 0.0, "12": 90.0}
FITS = {
    "sensor.path.0.frequency_hz": "500:1500", "sensor.path.0.gain": "-3:3",
    "sensor.path.1.frequency_hz": "2200:3200", "sensor.path.1.gain": "-6:6",
    "sensor.path.2.frequency_hz": "3000:4200", "sensor.path.2.gain": "-6:6",
    "sensor.noise_rms_m_per_s2": "0.05:3:log",
}


def records(folder):
    """Each record of the drive end's inner and outer race, and the healthy one: name, part, place, mil, r/min, signal in m/s^2."""
    for row in csv.DictReader((folder / "records.csv").read_text().splitlines()):
        words = shlex.split(row["options"])
        if (row["set"], row["damaged"]) not in (("cwru-DE12", "IR"), ("cwru-DE12", "OR")) and row["id"] != "1797_Normal:DE":
            continue
        rate = float(words[words.index("--rate") + 1])
        x = brinell.read_signal(folder / row["file"], "DE").values[: int(4 * rate)] * G
        if rate != RATE:
            x = signal.resample_poly(x, 1, int(rate / RATE))
        speed, part, mil = re.match(r"(\d+)_(Normal|IR|OR@\d+)_?(\d*)", row["id"]).groups()
        part, _, place = part.partition("@")
        yield {"id": row["id"], "file": folder / row["file"], "part": part, "place": place, "mil": int(mil or 0), "rpm": float(speed), "x": x}


def calibrated(record, command, folder):
    fits = [word for key, bounds in FITS.items() for word in ("--fit", f"{key}={bounds}")]
    source = ["--measured", record["file"], "--channel", "DE", "--rate", "12000", "--unit", "g", "--model-uncertainty", "30"]
    subprocess.run([command, "calibrate", HERE / "drive-end.toml", *fits, *source, "-o", folder / "calibrate", "-q"], check=True)
    return brinell.Scenario.from_file(folder / "calibrate/best.toml")


def predicted(base, record):
    defect = {"row": 1, "depth_um": 25_400.0 * DEPTH_IN.get(record["mil"], 0), "shape": {"circle": {"diameter_mm": 0.0254 * record["mil"]}}}
    if record["part"] == "OR":
        defect |= {"on": "outer-raceway", "center_deg": PLACE_DEG[record["place"]]}
    else:
        defect |= {"on": "inner-raceway", "center_deg": 0.0}
    changes = {"operation.speed_rpm": record["rpm"], "simulation.duration_s": SEGMENTS * SECONDS + 0.1}
    return base.replace(changes | {"defects": [] if record["part"] == "Normal" else [defect]})


def envelope(x):
    """Envelope in BAND_HZ over its mean, less 1, in segments: a row a segment."""
    spectrum = np.fft.fft(x)
    f = np.fft.fftfreq(len(x), 1.0 / RATE)
    spectrum[(f < BAND_HZ[0]) | (f > BAND_HZ[1])] = 0
    e = np.abs(np.fft.ifft(2 * spectrum))
    e = e[: int(SEGMENTS * SECONDS * RATE)].reshape(SEGMENTS, -1)
    return e / e.mean(axis=1, keepdims=True) - 1


def numbers(x, record):
    """By segment: RMS (dB), depth of the first five harmonics (dB), sidebands over their harmonics (dB); harmonics present."""
    part = {"IR": "bpfi", "OR": "bpfo", "Normal": "bpfo"}[record["part"]]
    orders = brinell.frequencies("6205", 60.0)
    x = np.asarray(x, float)[-int(SEGMENTS * SECONDS * RATE) :]
    e = envelope(x - x.mean())
    window = signal.windows.hann(e.shape[1], sym=False)
    lines = np.abs(np.fft.rfft(e * window)) * 2 / window.sum()
    whole = e.ravel() * signal.windows.hann(e.size, sym=False)
    fine, f = np.abs(np.fft.rfft(whole)) * 4 / e.size, np.fft.rfftfreq(e.size, 1 / RATE)
    expected = orders[part] * record["rpm"] / 60.0
    about = np.linspace(0.98, 1.02, 401) * expected
    nearest = lambda where: np.round(np.asarray(where) * e.size / RATE).astype(int)
    found = about[np.argmax(sum(np.log(fine[nearest(h * about)] + 1e-9) for h in (1, 2, 3)))]

    def level(where):
        bins = np.round(where * SECONDS).astype(int)
        return np.max([lines[:, bins + k] for k in (-1, 0, 1)], axis=0)

    shaft = record["rpm"] / 60.0
    harmonics = np.array([level(h * found) for h in range(1, 6)]).T
    sides = np.array([np.hypot(level(h * found - shaft), level(h * found + shaft)) / 2**0.5 for h in (1, 2, 3)]).T
    floor = [np.median(fine[abs(f - h * found) < 1.5 * shaft]) for h in range(1, 6)]
    tall = [fine[np.abs(f - h * found) < 1.0].max() for h in range(1, 6)]
    segments = x.reshape(SEGMENTS, -1)
    return {
        "rms": 20 * np.log10(segments.std(axis=1)), "harmonics": 20 * np.log10(harmonics), "sides": 20 * np.log10(sides / harmonics[:, :3]).mean(axis=1),
        "depth": 20 * np.log10(np.sqrt((harmonics[:, :3] ** 2).sum(axis=1))), "present": int(sum(np.array(tall) > 5 * np.array(floor))),
        "kurtosis": np.mean((segments - segments.mean()) ** 4, axis=1) / segments.var(axis=1) ** 2, "spectrum": (f, fine),
    }


def record_table(rows):
    print("| record | RMS, m/s², measured | predicted | harmonics, of 5 | modulation, dB | sidebands over harmonics, dB |")
    print("| --- | --- | --- | --- | --- | --- |")
    for record, *sides in rows:
        name = record["id"].removesuffix("_DE12") + (" (fitted)" if record["id"] == FITTED else "")
        rms = " | ".join(f"{10 ** (np.mean(v['rms']) / 20):.2f}" for v in sides)
        print(f"| {name} | {rms} |", " | ".join(", ".join(f"{np.mean(v[key]):.0f}" for v in sides) for key in ("present", "depth", "sides")), "|")


def statements(rows):
    """What is said of which bearings, and the numbers at each speed of each bearing, measured and predicted. The fitted record counts only where others refer to it.

    Shapes of families are compared where the record has a family: three of five harmonics. Outer races are in two groups: where predicted balls load the damage, and where the predicted
    record is a healthy bearing's, its RMS within 1 dB.
    """
    sound = next(np.mean(s["rms"]) for r, _, s in rows if r["part"] == "Normal")
    groups = {}
    for r, m, s in rows:
        key = (r["part"], r["place"], r["mil"])
        group = {"IR": "inner race", "OR": "outer race, damage loaded", "Normal": "healthy"}[r["part"]]
        if r["part"] == "OR" and abs(np.mean(s["rms"]) - sound) < 1.0:
            group = "outer race, damage predicted unloaded"
        if r["part"] != "Normal" and m["present"] < 3:
            group = f"{group[:10]}, without lines ({r['mil']} mil)"
        groups.setdefault(group, {}).setdefault(key, []).append((r["id"] != FITTED, m, s))
    shapes = {
        "harmonics, of 5": lambda v: v["present"],
        "third harmonic over first, dB": lambda v: np.mean(v["harmonics"][:, 2] - v["harmonics"][:, 0]),
        "sidebands over harmonics, dB": lambda v: np.mean(v["sides"]),
        "modulation, dB": lambda v: np.mean(v["depth"]),
    }
    level = lambda v: np.mean(v["rms"])
    for group, bearings in sorted(groups.items()):
        for text, what in list(shapes.items())[: 1 if "without" in group or "unloaded" in group else 4]:
            if group != "healthy" or text.startswith("mod"):
                yield f"{group}: {text}", [[(what(m), what(s)) for counts, m, s in speeds if counts] for speeds in bearings.values()]
    every = {key: speeds for bearings in groups.values() for key, speeds in bearings.items()}
    own = lambda key: [[(level(m), level(s)) for _, m, s in every[key]]]
    over = lambda a, b: [[(level(m) - level(n), level(s) - level(t)) for (_, m, s), (_, n, t) in zip(every[a], every[b])]]
    yield "healthy: RMS, dB re 1 m/s²", own(("Normal", "", 0))
    yield "inner race, 7 mil: RMS, dB re 1 m/s²", own(("IR", "", 7))
    for mil in (7, 21):
        for place in ("3", "12"):
            yield f"outer race, {mil} mil: RMS at {place} over 6 o'clock, dB", over(("OR", place, mil), ("OR", "6", mil))
    for mil in (14, 21, 28):
        yield f"inner race: RMS of {mil} over 7 mil, dB", over(("IR", "", mil), ("IR", "", 7))
    for mil in (14, 21):
        yield f"outer race, 6 o'clock: RMS of {mil} over 7 mil, dB", over(("OR", "6", mil), ("OR", "6", 7))


def verdict(measured, simulated, text):
    """Holds: the means differ by less than 3 dB (or 1 harmonic). Direction alone, of a ratio of RMS: both are beyond 3 dB on the same side."""
    if "unloaded" in text:
        return "as healthy"
    if abs(measured - simulated) < (3.0 if "dB" in text else 1.0):
        return "holds"
    return "direction alone" if "RMS" in text and " over " in text and measured * simulated > 0 and min(abs(measured), abs(simulated)) > 3 else "does not hold"


def of_bearings(bearings, side):
    """Mean over bearings, and in words."""
    means = np.array([np.mean([pair[side] for pair in speeds]) for speeds in bearings])
    mean, n = means.mean(), len(means)
    if n < 3:
        return mean, "; ".join(", ".join(f"{pair[side]:.1f}" for pair in speeds) for speeds in bearings)
    half = stats.t.ppf(0.975, n - 1) * means.std(ddof=1) / n**0.5
    return mean, f"{mean:.1f} ({mean - half:.1f} to {mean + half:.1f})"


def statement_table(rows):
    print("| statement | bearings | measured | predicted | |\n| --- | --- | --- | --- | --- |")
    for text, bearings in statements(rows):
        (m, measured), (s, simulated) = of_bearings(bearings, 0), of_bearings(bearings, 1)
        print(f"| {text} | {len(bearings)} | {measured} | {simulated} | {verdict(m, s, text)} |")


def fit(folder):
    """How good the fit is: each target's share of chi-square, keys not determined, keys on a bound."""
    found = json.loads((folder / "calibrate/calibrate.json").read_text())
    shares = sorted(((target["residual"] ** 2, target["name"]) for target in found["targets"]), reverse=True)[:4]
    keys = found["keys"]
    print(f"Fit: chi-square {found['chi_square']:.0f}, {found['degrees_of_freedom']} degrees of freedom; of it", ", ".join(f"{share:.0f} {name}" for share, name in shares), end="; ")
    print(f"{sum(not key['determined'] for key in keys)} of {len(keys)} keys not determined; on a bound:", *(key["key"] for key in keys if key["value"] in (key["low"], key["high"])), "\n")


def figure(rows, path):
    import matplotlib

    matplotlib.use("agg")
    import matplotlib.pyplot as plt

    chosen = [FITTED, "1797_OR@12_21_DE12", "1797_IR_7_DE12", "1797_IR_21_DE12"]
    _, axes = plt.subplots(len(chosen), 1, figsize=(9, 9), sharex=True, layout="constrained")
    for axis, name in zip(axes, chosen):
        record, m, s = next(row for row in rows if row[0]["id"] == name)
        for values, sign, label in ((m, 1, "measured"), (s, -1, "predicted")):
            f, lines = values["spectrum"]
            # The highest line in each 2 Hz: what is seen at this width.
            top = lines[: int(600 * len(lines) / f[-1]) // 8 * 8].reshape(-1, 8).max(axis=1)
            axis.fill_between(np.arange(len(top)) * 8 * f[1], 0, sign * top, step="mid", label=label)
        axis.set(title=name.removesuffix("_DE12") + (": the fitted record" if name == FITTED else ""), ylabel="modulation")
    axes[0].legend()
    axes[-1].set(xlabel="Hz", xlim=(0, 600))
    plt.savefig(path, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("records", type=Path)
    parser.add_argument("brinell")
    parser.add_argument("-o", "--output", type=Path, default=Path("out/measured"))
    parser.add_argument("--set", action="append", default=[], metavar="KEY=NUMBER", help="a key of the predicted runs that differs from the fitted one's")
    args = parser.parse_args()
    args.output.mkdir(parents=True, exist_ok=True)
    all_records = sorted(records(args.records), key=lambda r: (r["part"], r["place"].zfill(2), r["mil"], r["rpm"]))
    base = calibrated(next(r for r in all_records if r["id"] == FITTED), args.brinell, args.output)
    base = base.replace({key: float(value) for key, _, value in (text.partition("=") for text in args.set)})
    simulated = brinell.simulate_many([predicted(base, r) for r in all_records], reduce=lambda result: result["sensor_ay"])
    rows = [(r, numbers(r["x"], r), numbers(x, r)) for r, x in zip(all_records, simulated)]
    fit(args.output)
    statement_table(rows)
    print()
    record_table(rows)
    figure(rows, args.output / "measured.png")


if __name__ == "__main__":
    main()
