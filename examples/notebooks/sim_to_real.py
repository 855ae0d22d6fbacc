"""From simulated to measured signals: a machine around a simulated bearing, features that do not know the rig, and measured records.

`sim_to_real.ipynb` uses it. Needs NumPy and SciPy. Signals are accelerations of any scale; rates and frequencies in Hz, orders in turns of the shaft.
"""

import csv
import shlex
from pathlib import Path

import numpy as np
from scipy import ndimage, signal

import brinell

RATE = 12_000.0
"""All signals are brought to this rate, so that it does not tell a class."""
TURNS = 27
"""Of the shaft in a segment: what a second holds at the lowest speed of the plan, less a start."""
SLIP = 0.012
"""How far a family of lines may lie from pure rolling: what the simulated cages slip by."""
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
    """Envelope spectra of bands of 1 kHz, of `x` over TURNS turns of the shaft.

    Returns ln(power of a line over the floor about it), averaged over the bands as powers, and the depth of modulation (amplitude over mean), a
    row a band; both by bins of 1 / TURNS orders, from 0 to 30.
    """
    n, count = len(x), 30 * TURNS
    spectrum = np.fft.rfft(x - x.mean())
    f = np.fft.rfftfreq(n, 1.0 / RATE)
    window = signal.windows.hann(n, sym=False)
    depth = []
    for low in range(500, 5001, 500):
        inside = (f >= low) & (f < low + 1000)
        band = np.zeros(n, complex)
        band[: len(f)][inside] = 2 * spectrum[inside] * signal.windows.tukey(inside.sum(), 0.2)
        envelope = np.abs(np.fft.ifft(band))
        depth.append(np.abs(np.fft.rfft(window * (envelope / envelope.mean() - 1)))[:count] * 2 / window.sum())
    depth = np.array(depth)
    floor = ndimage.median_filter(depth**2, (1, 3 * TURNS), mode="nearest")
    over = np.log(np.mean(depth**2 / floor, axis=0))
    # A line may lie between two bins.
    return ndimage.maximum_filter1d(over, 3), ndimage.maximum_filter1d(depth, 3, axis=1)


def at(values, orders):
    return values[..., np.round(np.asarray(orders) * TURNS).astype(int)]


def family(over, order):
    """Levels of the first four harmonics of each order, a row an order, and their sum with none counted higher than any below it."""
    levels = at(over, np.outer(order, np.arange(1, 5)))
    return np.minimum.accumulate(levels, axis=1).sum(axis=1), levels


def features(x, shaft_hz, orders):
    """Of one segment of TURNS turns at RATE: how high and how deep the families of lines of the bearing's parts are, and what else is there."""
    over, depth = envelope_orders(np.asarray(x[: int(round(TURNS * RATE / shaft_hz))], float), shaft_hz)
    values = {}
    for part in PARTS:
        # One slip for all harmonics of a part.
        slipped = orders[part] * (1 + np.linspace(-SLIP, SLIP, 13))
        scores, levels = family(over, slipped)
        best = scores.argmax()
        values[f"{part} score"] = scores[best]
        values.update({f"{part} {h}": level for h, level in enumerate(levels[best], 1)})
        side = orders["ftf"] if part == "2bsf" else 1.0
        values[f"{part} sidebands"] = at(over, [h * slipped[best] + k * side for h in (1, 2) for k in (-1, 1)]).mean()
        values[f"{part} depth"] = np.log((at(depth, np.arange(1, 4) * slipped[best]) ** 2).sum(axis=1).max())
    values.update(ftf=at(over, orders["ftf"]), shaft=at(over, 1.0), twice_shaft=at(over, 2.0))
    # The strongest comb at none of the bearing's orders, nor at the shaft's.
    others = np.arange(1.5, 7.0, 0.5 / TURNS)
    apart = np.min([abs(others / orders[part] - 1) for part in PARTS], axis=0) > 0.02
    values["elsewhere"] = family(over, others[apart & (abs(others - np.round(others)) > 0.05)])[0].max()
    return values
