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
"""How far a family of lines may lie from pure rolling. Simulated cages slip by up to 1.7 %, in both directions."""
PARTS = ("bpfo", "bpfi", "2bsf")
WORDS = {"IR": "inner", "OR": "outer", "B": "ball", "N": "healthy"}


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
    """A sound machine around a simulated bearing's acceleration `x` in m/s^2: levels are those of sound machines, 0.1 to 3 m/s^2.

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


def features(x, shaft_hz, orders):
    """One number a part of the bearing, of one segment of TURNS turns at RATE: the score of its family of lines.

    The score is the sum of ln(power over floor) over the first four harmonics, none counted higher than any below it, at the slip where it is highest.
    """
    over = envelope_orders(np.asarray(x[: int(round(TURNS * RATE / shaft_hz))], float), shaft_hz)
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
    columns = ["run", "status", "class", "bearing", "speed_rpm", "sample_rate_hz", "sensor_ay", "entry_force_n", "cage_slip"]
    rows = []
    for row in data.to_polars(columns).iter_rows(named=True):
        if row["status"] != "complete":
            continue
        assert row["sample_rate_hz"] == RATE
        orders, shaft_hz = brinell.frequencies(row["bearing"], 60.0), row["speed_rpm"] / 60.0
        label = {"class": row["class"].split("-")[0], "kind": row["class"], "run": row["run"]}
        label |= {"force_n": max(row["entry_force_n"], default=0.0), "cage_slip": row["cage_slip"][0]}
        start = np.asarray(row["sensor_ay"], float)[int(0.05 * RATE) :]
        for copy in range(copies):
            rng = np.random.default_rng([seed, row["run"], copy])
            rows.append(label | features(machine(rng, start, shaft_hz, orders, noise, lines), shaft_hz, orders))
    return pandas.DataFrame(rows)


def records(folder):
    """Measured records that `folder`/records.csv lists: id, file, damaged (IR, OR, B, N), set, and options of `brinell analyze`."""
    for row in csv.DictReader((Path(folder) / "records.csv").read_text().splitlines()):
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
        up = fractions.Fraction(RATE / record["rate"]).limit_denominator(1000)
        x = signal.resample_poly(record["x"], up.numerator, up.denominator)
        length = int(round(TURNS * RATE / record["shaft_hz"]))
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


def score(table, classes=("healthy", "outer", "inner"), draws=20_000):
    """Balanced accuracy over records, and its 95 % interval: each class's recall from its Jeffreys posterior, Beta(right + 1/2, wrong + 1/2)."""
    rng = np.random.default_rng(1)
    counts = {c: ((table["named"] == c) & (table["class"] == c)).sum() for c in classes}
    total = {c: (table["class"] == c).sum() for c in classes}
    drawn = np.mean([rng.beta(counts[c] + 0.5, total[c] - counts[c] + 0.5, draws) for c in classes], axis=0)
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
