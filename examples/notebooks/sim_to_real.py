"""From simulated to measured signals: a machine around a simulated bearing, features that do not know the rig, and measured records.

`sim_to_real.ipynb` and `validation/sim_to_real/` use it. Needs polars, pandas, SciPy and scikit-learn. Signals are accelerations of any scale; rates and frequencies in Hz, orders in turns of the shaft.
"""

import csv
import fractions
import shlex
from pathlib import Path

import numpy as np
import pandas
from scipy import ndimage, signal
from sklearn.linear_model import LogisticRegression
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import StandardScaler

import brinell

RATE = 12_000.0
"""All signals are brought to this rate, so that it does not tell a class."""
TURNS = 27
"""Of the shaft in a segment: what a second holds at the lowest speed of the plan, less a start."""
SLIP = 0.02
"""How far a family of lines may lie from pure rolling. Simulated cages run 0.2 % ahead to 0.9 % behind."""
PARTS = ("bpfo", "bpfi", "2bsf")
WORDS = {"IR": "inner", "OR": "outer", "B": "ball", "N": "healthy"}
LEAST = 10.0
"""Of the rule and the plain envelope: below, a record is called healthy. Chosen after looking: any value from 4 to 11 says the same of the CWRU records."""


# The machine around the bearing. --------------------------------------------------------------------------------------------------------------


def coloured(rng, n, peaks=3):
    """Noise of RMS 1 through a few resonances that nobody knows, over a floor of white noise."""
    f = np.fft.rfftfreq(n, 1.0 / RATE)
    gain = np.full(len(f), rng.uniform(0.1, 1.0), complex)
    for centre, damping in zip(np.exp(rng.uniform(np.log(100), np.log(5500), peaks)), rng.uniform(0.01, 0.15, peaks)):
        gain += rng.uniform(-1, 1) * f**2 / (centre**2 - f**2 + 2j * damping * centre * f)
    x = np.fft.irfft(np.fft.rfft(rng.normal(size=n)) * gain, n)
    return x / x.std()


def tones(rng, t, shaft_hz):
    """Shaft, supply and slots: what unbalance, misalignment and a motor's field make."""
    def sine(f, a):
        return a * np.sin(2 * np.pi * (f * t + rng.uniform()))

    x = sum(sine(k * shaft_hz, rng.lognormal(0, 1) / k**0.5) for k in range(1, 13))
    line = rng.choice([50.0, 60.0])
    x = x + sum(sine(2 * k * line, rng.lognormal(0, 1) / k) for k in range(1, 4))
    slots = rng.integers(18, 60) * shaft_hz
    for f in (slots, 2 * slots):
        carrier = sine(f, rng.lognormal(0, 1)) + sum(sine(f + s * 2 * line, rng.lognormal(-1, 1)) for s in (-1, 1))
        x = x + carrier * (1 + rng.uniform(0, 0.5) * np.sin(2 * np.pi * (shaft_hz * t + rng.uniform())))
    return x / x.std()


def foreign(rng, t, shaft_hz, orders):
    """Another part's impacts at an order that is none of the bearing's: a gear, a pump, the bearing at the other end."""
    own = [h * orders[p] for p in PARTS for h in (0.5, 1, 2)]
    while True:
        order = np.exp(rng.uniform(np.log(0.5), np.log(9)))
        if min(abs(order / o - 1) for o in own) > 0.03:
            break
    period = 1.0 / (order * shaft_hz)
    at = np.cumsum(rng.normal(period, rng.uniform(0, 0.01) * period, int(t[-1] / period) + 2)) - rng.uniform() * period
    x = np.zeros(len(t))
    index = np.round(at * RATE).astype(int)
    inside = (index >= 0) & (index < len(t))
    x[index[inside]] = rng.lognormal(0, 0.3, inside.sum())
    return ring(rng, x)


def ring(rng, x):
    """Impacts through two modes; RMS 1."""
    f = np.fft.rfftfreq(2 * len(x), 1.0 / RATE)
    gain = np.zeros(len(f), complex)
    for centre, damping in zip(np.exp(rng.uniform(np.log(500), np.log(5500), 2)), rng.uniform(0.01, 0.1, 2)):
        gain += rng.uniform(-1, 1) * f**2 / (centre**2 - f**2 + 2j * damping * centre * f)
    y = np.fft.irfft(np.fft.rfft(x, 2 * len(x)) * gain, 2 * len(x))[: len(x)]
    return y / max(y.std(), 1e-12)


def machine(rng, x, shaft_hz, orders, noise=True, lines=True):
    """A sound machine around a simulated bearing's acceleration `x` in m/s^2: levels are guesses, 0.1 to 3 m/s^2, from no source.

    The ring moves in the simulation, and with a housing on a real machine: the bearing's share is scaled by 0.03 to 1 for that mass.
    """
    t = np.arange(len(x)) / RATE

    def level(low, high):
        return np.exp(rng.uniform(np.log(low), np.log(high)))

    y = x * level(0.03, 1.0)
    if lines:
        y = y + level(0.05, 3.0) * tones(rng, t, shaft_hz)
        if rng.uniform() < 0.5:
            y = y + level(0.03, 1.0) * foreign(rng, t, shaft_hz, orders)
    if noise:
        turn = 1 + rng.uniform(0, 0.5) * (rng.uniform() < 0.5) * np.sin(2 * np.pi * (shaft_hz * t + rng.uniform()))
        y = y + level(0.1, 3.0) * turn * coloured(rng, len(x))
        if rng.uniform() < 0.3:
            strokes = np.zeros(len(x))
            at = rng.integers(0, len(x), 1 + rng.poisson(5))
            strokes[at] = rng.lognormal(0, 1, len(at))
            y = y + level(0.03, 1.0) * ring(rng, strokes)
    return y


# Features. ------------------------------------------------------------------------------------------------------------------------------------


def envelope_orders(x, shaft_hz):
    """ln(power of a line of the envelope over the floor about it), the power over its floor averaged over bands of 1 kHz: by bins of 1 / TURNS orders of the shaft, from 0 to 30.

    Lines of the shaft are taken out. `x` holds TURNS turns. After the integrated cyclic coherence (Antoni, Mech. Syst. Signal Process. 21, 2007).
    """
    n, count = len(x), 30 * TURNS
    spectrum = np.fft.rfft(x - x.mean())
    f = np.fft.rfftfreq(n, 1.0 / RATE)
    window = signal.windows.hann(n, sym=False)
    power = []
    for low in range(500, 5001, 500):
        inside = (f >= low) & (f < low + 1000)
        band = np.zeros(n, complex)
        band[: len(f)][inside] = 2 * spectrum[inside] * signal.windows.tukey(inside.sum(), 0.2)
        envelope = np.abs(np.fft.ifft(band))
        power.append(np.abs(np.fft.rfft(window * (envelope - envelope.mean()))[:count]) ** 2)
    # The floor is the median of three orders, anew every third of an order.
    padded = np.pad(power, ((0, 0), (3 * TURNS // 2, 3 * TURNS // 2)), mode="reflect")
    windows = np.lib.stride_tricks.sliding_window_view(padded, 3 * TURNS, axis=1)[:, :: TURNS // 3]
    over = np.log(np.mean(power / np.repeat(np.median(windows, axis=2), TURNS // 3, axis=1), axis=0))
    # Slip may move a line of the bearing onto one of the shaft, which every machine has: what lies there says nothing.
    bins = np.arange(count)
    over[abs(bins - TURNS * np.round(bins / TURNS)) <= 1] = 0.0
    # A line may lie between two bins.
    return ndimage.maximum_filter1d(over, 3)


def resampled(x, rate):
    """At RATE. Errors: a lower rate, which leaves bands empty."""
    if rate < RATE:
        raise ValueError(f"rate: {rate:g} Hz, must be at least {RATE:g} Hz")
    ratio = fractions.Fraction(RATE / rate).limit_denominator(1000)
    return signal.resample_poly(x, ratio.numerator, ratio.denominator) if ratio != 1 else np.asarray(x, float)


def segment(x, shaft_hz):
    """Samples in TURNS turns. Errors: `x` at RATE is shorter."""
    n = int(round(TURNS * RATE / shaft_hz))
    if len(x) < n:
        raise ValueError(f"{TURNS} turns are needed: {n / RATE:.2f} s at {60 * shaft_hz:.0f} r/min, the signal has {len(x) / RATE:.2f} s")
    return n


def features(x, shaft_hz, orders):
    """One number a part of the bearing, of the first TURNS turns of `x` at RATE: the score of its family of lines.

    The score is the sum of ln(power over floor) over the first four harmonics, none counted higher than any below it, at the slip where it is highest.
    """
    over = envelope_orders(np.asarray(x[: segment(x, shaft_hz)], float), shaft_hz)
    values = {}
    for part in PARTS:
        slipped = orders[part] * (1 + np.linspace(-SLIP, SLIP, 13))
        levels = over[np.round(np.outer(slipped, np.arange(1, 5)) * TURNS).astype(int)]
        values[part] = np.minimum.accumulate(levels, axis=1).sum(axis=1).max()
    return values


# Tables of features. --------------------------------------------------------------------------------------------------------------------------


def simulated(data, copies=4, seed=1, noise=True, lines=True):
    """Features of a data set's runs, each in several machines: a pandas frame with `class`, `run`, `force_n`, `cage_slip` and `kind` beside them.

    `force_n` is the largest force under which a ball entered the damage: below a few newtons it does nothing, and the run says nothing of it.
    """
    frequencies = ["bpfo_hz", "bpfi_hz", "bsf_hz"]
    columns = ["run", "status", "class", "speed_rpm", "sample_rate_hz", "sensor_ay", "entry_force_n", "cage_slip", *frequencies]
    rows = []
    for row in data.to_polars(columns).iter_rows(named=True):
        if row["status"] != "complete":
            continue
        shaft_hz = row["speed_rpm"] / 60.0
        orders = {part: times * row[key] / shaft_hz for part, times, key in zip(PARTS, (1, 1, 2), frequencies)}
        label = {"class": row["class"].split("-")[0], "kind": row["class"], "run": row["run"]}
        label |= {"force_n": max(row["entry_force_n"], default=0.0), "cage_slip": row["cage_slip"][0]}
        try:
            start = resampled(np.asarray(row["sensor_ay"], float), row["sample_rate_hz"])[int(0.05 * RATE) :]
            segment(start, shaft_hz)
        except ValueError as error:
            raise ValueError(f"run {row['run']}: {error}, its first 0.05 s left out") from None
        for copy in range(copies):
            rng = np.random.default_rng([seed, row["run"], copy])
            rows.append(label | features(machine(rng, start, shaft_hz, orders, noise, lines), shaft_hz, orders))
    return pandas.DataFrame(rows)


def records(folder):
    """Measured records that `folder`/records.csv lists: id, file, damaged (IR, OR, B, N), set, and options of `brinell analyze`."""
    rows = list(csv.DictReader((Path(folder) / "records.csv").read_text().splitlines()))
    if missing := sorted({row["file"] for row in rows if not (Path(folder) / row["file"]).is_file()}):
        raise FileNotFoundError(f"{Path(folder) / 'records.csv'} lists files that are not there: {', '.join(missing)}")
    for row in rows:
        if row["damaged"] not in WORDS:
            raise ValueError(f"record {row['id']}: damaged is {row['damaged']!r}, must be one of {', '.join(WORDS)}")
        words = shlex.split(row["options"])
        options = {words[k].removeprefix("--"): words[k + 1] for k in range(0, len(words), 2)}
        if "bearing" in options:
            orders = brinell.frequencies(options["bearing"].removesuffix("-2RS"), 60.0)
        else:
            z, gamma = int(options["rollers"]), float(options["diameter"]) / float(options["pitch"])
            orders = {"ftf": (1 - gamma) / 2, "bpfo": z * (1 - gamma) / 2, "bpfi": z * (1 + gamma) / 2, "2bsf": (1 - gamma**2) / gamma}
        rate = float(options["rate"])
        x = brinell.read_signal(Path(folder) / row["file"], options.get("channel")).values[: int(4 * rate)]
        yield {
            "id": row["id"], "set": row["set"], "class": WORDS[row["damaged"]], "shaft_hz": float(options["speed"]) / 60.0, "orders": orders,
            "x": x, "rate": rate, "unit": options["unit"], "bearing": options.get("bearing"),
        }


def measured(folder):
    """Features of measured records in segments of TURNS turns, one after the other: a frame with `class`, `id`, `set` beside them."""
    rows = []
    for record in records(folder):
        try:
            x = resampled(record["x"], record["rate"])
            length = segment(x, record["shaft_hz"])
        except ValueError as error:
            raise ValueError(f"record {record['id']}: {error}") from None
        for start in range(0, len(x) - length + 1, length):
            values = features(x[start : start + length], record["shaft_hz"], record["orders"])
            rows.append({k: record[k] for k in ("id", "set", "class")} | values)
    return pandas.DataFrame(rows)


# Model and scores. ----------------------------------------------------------------------------------------------------------------------------


def train(frame, least_force_n=5.0):
    """Logistic regression on the scores. Of simulated runs, only those whose damage a loaded ball enters."""
    if "force_n" in frame:
        frame = frame[(frame["class"] == "healthy") | (frame["force_n"] > least_force_n)]
    model = make_pipeline(StandardScaler(), LogisticRegression(C=0.1, max_iter=3000, class_weight="balanced"))
    return model.fit(frame[list(PARTS)], frame["class"])


def verdicts(model, frame):
    """One class a record: the segments' probabilities multiplied."""
    log = pandas.DataFrame(model.predict_log_proba(frame[list(PARTS)]), columns=model.classes_, index=frame["id"])
    named = log.groupby(level=0, sort=False).mean().idxmax(axis=1)
    truth = frame.drop_duplicates("id").set_index("id")[["set", "class"]]
    return truth.assign(named=named)


def called(frame, least=LEAST):
    """One class a row of `bpfo` and `bpfi`, untrained: the part with the larger, healthy where both are below `least`."""
    part = np.where(frame["bpfo"] > frame["bpfi"], "outer", "inner")
    return frame.assign(named=np.where(frame[["bpfo", "bpfi"]].max(axis=1) < least, "healthy", part))


def rule(frame, least=LEAST):
    """One class a record, untrained, of its mean scores."""
    means = frame.groupby("id", sort=False)[["bpfo", "bpfi"]].mean()
    return called(means.join(frame.drop_duplicates("id").set_index("id")[["set", "class"]]), least)


def plain(folder, chosen, least=LEAST):
    """One class a record of those `chosen` (ids), untrained, from the envelope of the whole band alone: its highest bin within 1.5 % of BPFO and BPFI, over the median of three orders."""
    rows = []
    for r in records(folder):
        if r["id"] in chosen:
            envelope = np.abs(signal.hilbert(r["x"] - r["x"].mean()))
            lines = np.abs(np.fft.rfft((envelope - envelope.mean()) * np.hanning(len(envelope))))
            order = np.fft.rfftfreq(len(envelope), 1.0 / r["rate"]) / r["shaft_hz"]
            row = {k: r[k] for k in ("id", "set", "class")}
            for part in ("bpfo", "bpfi"):
                away = abs(order - r["orders"][part])
                row[part] = lines[away < 0.015 * r["orders"][part]].max() / np.median(lines[away < 1.5])
            rows.append(row)
    return called(pandas.DataFrame(rows).set_index("id"), least)


def impulses(orders, runs=240, seed=1):
    """Features of bare impulse trains in `machine`, without any model of a bearing: what a training set is worth that knows the frequencies alone. As `simulated`, one machine a run."""
    rows = []
    for run in range(runs):
        rng = np.random.default_rng([seed, run])
        label, shaft_hz = ("healthy", "outer", "inner")[run % 3], rng.uniform(1720, 1800) / 60.0
        x = np.zeros(int(RATE))
        if label != "healthy":
            order = orders["bpfo" if label == "outer" else "bpfi"] * (1 + rng.uniform(-SLIP, SLIP))
            at = np.arange(rng.uniform(), len(x) / RATE * order * shaft_hz - 1) / (order * shaft_hz)
            x[(at * RATE).astype(int)] = 1 if label == "outer" else np.maximum(np.cos(2 * np.pi * shaft_hz * at), 0)
            x = ring(rng, x) * np.exp(rng.uniform(np.log(0.5), np.log(20)))
        rows.append({"class": label, "run": run} | features(machine(rng, x, shaft_hz, orders), shaft_hz, orders))
    return pandas.DataFrame(rows)


def score(table, classes=("healthy", "outer", "inner"), draws=20_000):
    """Balanced accuracy over records, and a 95 % interval: each class's recall from its Jeffreys posterior, Beta(right + 1/2, wrong + 1/2), counted in bearings.

    A bearing's records at two speeds have one id but for the leading speed; half a bearing is right where one of two is.
    """
    rng = np.random.default_rng(1)
    right = table["named"] == table["class"]
    counts = {c: (right & (table["class"] == c)).sum() for c in classes}
    total = {c: (table["class"] == c).sum() for c in classes}
    shares = right.groupby([table["class"], table.index.str.replace(r"^\d+_", "", regex=True)]).mean()
    drawn = np.mean([rng.beta(shares[c].sum() + 0.5, (1 - shares[c]).sum() + 0.5, draws) for c in classes], axis=0)
    return {
        "balanced accuracy": np.mean([counts[c] / total[c] for c in classes]),
        "low": np.quantile(drawn, 0.025), "high": np.quantile(drawn, 0.975),
        **{c: f"{counts[c]} of {total[c]}" for c in classes},
    }


def analyzed(folder, chosen):
    """What `brinell analyze` says of the records `chosen` (ids): the part that leads, or healthy where it calls no damage."""
    parts = {"inner_race": "inner", "outer_race": "outer", "rolling_element": "ball", "cage": "cage"}
    rows = []
    for r in records(folder):
        if r["id"] in chosen:
            found = brinell.analyze(r["x"], rate_hz=r["rate"], unit=r["unit"], speed_rpm=60 * r["shaft_hz"], bearing=r["bearing"])
            rows.append({"id": r["id"], "class": r["class"], "named": parts[found.damage[0]] if found.damage else "healthy"})
    return pandas.DataFrame(rows).set_index("id")
