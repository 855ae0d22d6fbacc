"""What `brinell analyze` says of measured records that were made harder.

    python3 validation/robustness/robustness.py RECORDS BRINELL [base,sensor,cut,speed,far,rate,bearing | sum | halves | told | together] [-v]

RECORDS is a folder with records.csv (id, file, damaged, set, options) and NPZ files. Prints a row of a Markdown table for each way of making them
harder: by the other sensor of the file, cut short, at wrong speeds, at speeds far off, resampled with noise, asked about other bearings;
`sum` one of sums of two damaged bearings' records, `halves` how often the 95 % intervals of a record's two halves agree, `told` how often the
speed that is taken is that of the whole record's lines, `together` a record's pieces one by one, by --together, and the whole. -v lists every wrong call. Needs NumPy and SciPy.
"""

import collections
import csv
import json
import math
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
from scipy import signal

PARTS = {"IR": "inner_race", "OR": "outer_race", "B": "rolling_element", "N": None}
# Elements, their diameter and the pitch diameter in mm, contact angle in degrees.
BEARINGS = [
    (8, 6.75, 28.5, 0), (8, 7.92, 34.55, 0), (8, 5.969, 31.623, 0), (16, 8.4, 71.5, 15.17), (13, 7.5, 39, 0), (7, 7.94, 29.05, 0),
    (12, 7.94, 46, 0), (9, 9.525, 46, 0), (10, 6.35, 38, 0), (11, 10.3, 60, 0), (14, 6.5, 45, 0), (15, 8, 65, 12), (9, 12.7, 54, 0),
    (8, 12, 48, 0), (18, 7, 70, 0), (13, 6.35, 36, 25), (12, 5.5, 34, 15), (17, 9, 80, 10), (9, 7.1, 36.5, 0), (10, 11.1, 65, 40),
]
# Of the records' own bearing, a 6205.
OWN = (9, 7.94, 39.04, 0)
CUTS = {0.6: 2, 1.0: 3, 2.0: 2, 3.0: 1}
# Seconds, and the RMS of white noise over the record's.
PIECES = [(1.0, 0), (0.6, 0), (1.0, 2), (0.6, 2), (1.0, 3)]
SPEEDS = [1, -1, 2, -2, 3, -3, 5, -5, 10, -10]
# Of another number of poles, and of a shaft that turns otherwise.
FAR = [20, -17, 50, -50]


def orders(bearing):
    z, d, pitch, angle = bearing
    g = d / pitch * math.cos(math.radians(angle))
    return {"outer_race": z / 2 * (1 - g), "inner_race": z / 2 * (1 + g), "rolling_element": pitch / d * (1 - g * g)}


def records(folder):
    for row in csv.DictReader(open(folder / "records.csv")):
        options = shlex.split(row["options"])
        arrays = np.load(folder / row["file"])
        after = lambda key: options[options.index(key) + 1]
        channel = after("--channel") if "--channel" in options else list(arrays)[0]
        start = options.index("--bearing" if "--bearing" in options else "--rollers")
        yield {
            "id": row["id"], "truth": PARTS[row["damaged"]], "set": row["set"], "x": arrays[channel].astype(float).ravel(),
            "others": [a.astype(float).ravel() for name, a in arrays.items() if name != channel and len(arrays[channel]) == len(a)],
            "rate": float(after("--rate")), "speed": float(after("--speed")), "bearing": options[start:],
        }


def jobs(all_records, ways):
    """Way, truth, name, and what to analyse."""
    noise = np.random.default_rng(1)
    for r in all_records:
        x, rate, speed, bearing, truth = r["x"], r["rate"], r["speed"], r["bearing"], r["truth"]
        exact = not r["set"].startswith("uestc")
        if "base" in ways:
            yield "as they are" if exact else "speed off", truth, r["id"], (x, rate, speed, bearing)
        if not exact:
            continue
        for k, other in enumerate(r["others"] if "sensor" in ways else ()):
            yield "by the sensor at the motor's other end", truth, f"{r['id']} {k}", (other, rate, speed, bearing)
        for seconds, count in CUTS.items() if "cut" in ways else ():
            n = int(seconds * rate)
            for k in range(min(count, len(x) // n)):
                yield f"cut to {seconds} s", truth, f"{r['id']} {k}", (x[k * n : (k + 1) * n], rate, speed, bearing)
        for percent in (SPEEDS if "speed" in ways else []) + (FAR if "far" in ways else []):
            yield f"speed given {percent:+} %", truth, r["id"], (x, rate, speed * (1 + percent / 100), bearing)
        if "rate" in ways and rate < 13000:
            for factor in (2, 4, 8):
                up = signal.resample_poly(x, factor, 1)
                up = up + 0.01 * np.std(x) * noise.standard_normal(len(up))
                yield f"sampled {factor} times as fast, noise -40 dB", truth, r["id"], (up, rate * factor, speed, bearing)
        if "bearing" in ways and truth is not None:
            true = orders(OWN)[truth]
            for other in BEARINGS:
                near = [o / true / m for o in orders(other).values() for m in (1, 2, 3, 1 / 2, 1 / 3)]
                keys = zip(["--rollers", "--diameter", "--pitch", "--contact-angle"], map(str, other))
                asked = x, rate, speed, [word for pair in keys for word in pair]
                if all(abs(ratio - 1) >= 0.035 for ratio in near):
                    yield "asked about other bearings", None, f"{r['id']} {other}", asked
                elif any(abs(o / true - 1) <= 0.02 for part, o in orders(other).items() if part != truth):
                    yield "bearings of which another part has the true frequency", None, f"{r['id']} {other}", asked


def sums(all_records):
    """Parts, name, and what to analyse: two records of one set, at one speed, the weaker at a share of the other's RMS."""
    damaged = [r for r in all_records if r["truth"]]
    for i, a in enumerate(damaged):
        for b in damaged[i + 1 :]:
            if a["truth"] == b["truth"] or any(a[key] != b[key] for key in ("set", "rate", "speed", "bearing")):
                continue
            n = min(len(a["x"]), len(b["x"]))
            x, y = (r["x"][:n] / np.std(r["x"][:n]) for r in (a, b))
            for k, l in ((1, 1), (1, 0.4), (0.4, 1)):
                yield {a["truth"], b["truth"]}, f"{a['id']} * {k} + {b['id']} * {l}", (k * x + l * y, a["rate"], a["speed"], a["bearing"])


def analyze(brinell, x, rate, speed, bearing):
    """Of a signal, or of a list of records together."""
    with tempfile.TemporaryDirectory() as folder:
        many = isinstance(x, list)
        files = [Path(folder) / f"{k}.npz" for k in range(len(x) if many else 1)]
        for path, values in zip(files, x if many else [x]):
            np.savez(path, signal=values.astype(np.float32))
        command = [brinell, "analyze", *files, *(["--together"] if many else []), "--rate", repr(rate), "--unit", "g", "--speed", repr(speed), *bearing, "--json", "-"]
        done = subprocess.run(command, capture_output=True, text=True)
    return json.loads(done.stdout) if done.returncode == 0 else None


def outcome(found, truth):
    if found is None:
        return "not analysed"
    called = found["verdict"]["damage"]
    if truth is None:
        return "called" if called else "not called"
    if not called:
        return "missed"
    return "right" if called[0] == truth else "wrong"


def of_sums(folder, brinell, verbose):
    counts = collections.defaultdict(collections.Counter)
    together = lambda parts: " + ".join(sorted(parts)).replace("_", " ")

    def one(job):
        parts, name, what = job
        called = set(analyze(brinell, *what)["verdict"]["damage"])
        how = "another" if called - parts else ("none", "one", "both")[len(called)]
        if verbose and how == "another":
            print(f"{together(parts)}: {name}: {sorted(called)}", file=sys.stderr)
        return together(parts), how

    with ThreadPoolExecutor(2) as pool:
        for parts, how in pool.map(one, sums(list(records(folder)))):
            counts[parts][how] += 1
    print("| sums of two records | both named | one | none | another part |")
    print("| --- | --- | --- | --- | --- |")
    for parts, c in counts.items():
        print(f"| {parts} | {c['both']} | {c['one']} | {c['none']} | {c['another']} |")


def of_halves(folder, brinell):
    """Of each indicator: in how many records the halves differ by no more than their intervals say, as of two independent values."""
    agree, count = collections.Counter(), collections.Counter()

    def one(r):
        middle = len(r["x"]) // 2
        return [analyze(brinell, x, r["rate"], r["speed"], r["bearing"])["indicators"] for x in (r["x"][:middle], r["x"][middle:])]

    with ThreadPoolExecutor(2) as pool:
        for first, second in pool.map(one, records(folder)):
            # Skewness alone may be negative: of the others the interval is a factor. The record's peak has none.
            for name in (name for name in first if name != "skewness" and first[name].get("low") is not None):
                values, ends = zip(*((half[name]["value"], (half[name]["low"], half[name]["high"])) for half in (first, second)))
                widths = [math.log(high / low) / 2 for low, high in ends]
                count[name] += 1
                agree[name] += abs(math.log(values[0] / values[1])) <= math.hypot(*widths)
    print("| indicator | the halves agree within their 95 % intervals |")
    print("| --- | --- |")
    for name in count:
        print(f"| {name} | {agree[name]} of {count[name]} |")


def of_speeds(folder, brinell):
    """How often the speed taken is more than 0.3 % off what the lines of the whole record tell, at the speed given."""
    off, count = collections.Counter(), collections.Counter()

    def one(job):
        way, name, what = job
        found = analyze(brinell, *what)
        return way, name, found and found["shaft"]

    with ThreadPoolExecutor(2) as pool:
        every = list(records(folder))
        base = [("as it is", r["id"], (r["x"], r["rate"], r["speed"], r["bearing"])) for r in every]
        whole = {name: shaft["used_hz"] for _, name, shaft in pool.map(one, base) if shaft and shaft["found_in_signal"]}
        harder = ((way, name, what) for way, _, name, what in jobs([r for r in every if r["id"] in whole], ["cut", "speed"]))
        for way, name, shaft in pool.map(one, harder):
            if shaft:
                of = name if name in whole else name.rsplit(" ", 1)[0]
                count[way] += 1
                off[way] += abs(shaft["used_hz"] / whole[of] - 1) > 0.003
    print("| | speed taken more than 0.3 % off the whole record's |")
    print("| --- | --- |")
    for way in count:
        print(f"| {way} | {off[way]} of {count[way]} |")


def of_pieces(folder, brinell, verbose):
    """The first four seconds of each record in pieces, with noise."""
    random = np.random.default_rng(2)
    counts, off = collections.defaultdict(collections.Counter), collections.defaultdict(collections.Counter)
    only = collections.Counter()

    def jobs():
        for r in records(folder):
            if r["set"].startswith("uestc"):
                continue
            x = r["x"][: int(4 * r["rate"])]
            for seconds, noise in PIECES:
                n = int(seconds * r["rate"])
                y = x + noise * np.std(x) * random.standard_normal(len(x))
                yield r, (seconds, noise), y, [y[k * n : (k + 1) * n] for k in range(len(x) // n)]

    def one(job):
        r, row, x, pieces = job
        known = r["rate"], r["speed"], r["bearing"]
        ways = {"the whole": [x], "together": [pieces], "one by one": pieces}
        found = {way: [analyze(brinell, what, *known) for what in each] for way, each in ways.items()}
        for way, each in found.items():
            for result in each:
                how = outcome(result, r["truth"])
                if verbose and how in ("wrong", "called"):
                    print(f"{row}, {way}: {r['id']}: {result['verdict']['text']}", file=sys.stderr)
        return row, r["truth"], found

    with ThreadPoolExecutor(2) as pool:
        for row, truth, found in pool.map(one, jobs()):
            whole = found["the whole"][0]
            alone = [outcome(result, truth) for result in found["one by one"]]
            only[row] += outcome(found["together"][0], truth) == "right" and "right" not in alone
            for way, each in found.items():
                counts[row, way].update(outcome(result, truth) for result in each)
                if whole and whole["shaft"]["found_in_signal"]:
                    off[row, way].update(abs(f["shaft"]["used_hz"] / whole["shaft"]["used_hz"] - 1) > 0.003 for f in each if f)
    print("| pieces | noise | judged | damaged: right / wrong / no damage called | sound: called damaged | speed more than 0.3 % off the whole's |")
    print("| --- | --- | --- | --- | --- | --- |")
    for ((seconds, noise), way), c in counts.items():
        sound, told = c["called"] + c["not called"], off[(seconds, noise), way]
        damaged = f"{c['right']} / {c['wrong']} / {c['missed']}"
        print(f"| {seconds} s | {noise} | {way} | {damaged} | {c['called']} of {sound} | {told[True]} of {told[True] + told[False]} |")
    print("told together and by no piece alone:", "; ".join(f"{seconds} s, noise {noise}: {only[seconds, noise]}" for seconds, noise in PIECES))


def main():
    folder, brinell = Path(sys.argv[1]), sys.argv[2]
    rest = [a for a in sys.argv[3:] if a != "-v"]
    ways = rest[0].split(",") if rest else ["base", "sensor", "cut", "speed", "far", "rate", "bearing"]
    if ways == ["sum"]:
        of_sums(folder, brinell, "-v" in sys.argv)
        return
    if ways == ["together"]:
        of_pieces(folder, brinell, "-v" in sys.argv)
        return
    if ways == ["halves"]:
        of_halves(folder, brinell)
        return
    if ways == ["told"]:
        of_speeds(folder, brinell)
        return
    counts = collections.defaultdict(collections.Counter)

    def one(job):
        way, truth, name, what = job
        found = analyze(brinell, *what)
        how = outcome(found, truth)
        if "-v" in sys.argv and how in ("wrong", "called"):
            print(f"{way}: {name}: {found['verdict']['text']}", file=sys.stderr)
        return way, how

    with ThreadPoolExecutor(2) as pool:
        waiting = collections.deque()
        for job in jobs(list(records(folder)), ways):
            waiting.append(pool.submit(one, job))
            if len(waiting) > 8:
                way, how = waiting.popleft().result()
                counts[way][how] += 1
        for job in waiting:
            way, how = job.result()
            counts[way][how] += 1
    print("| | damaged: right / wrong / no damage called | sound: called damaged | not analysed |")
    print("| --- | --- | --- | --- |")
    for way, c in counts.items():
        damaged = f"{c['right']} / {c['wrong']} / {c['missed']}" if c["right"] + c["wrong"] + c["missed"] else "-"
        sound = f"{c['called']} of {c['called'] + c['not called']}" if c["called"] + c["not called"] else "-"
        print(f"| {way} | {damaged} | {sound} | {c['not analysed']} |")


main()
