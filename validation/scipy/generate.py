"""Goldens of the signal library: SciPy's and NumPy's answers on small inputs. See README.md beside this file.

Nothing here is translated from the Rust code: where SciPy has the function, SciPy is called; where it has none (kurtogram,
order resampling, frequency-domain integration), the definition is written out in NumPy.
"""

import json
import sys
from pathlib import Path

import numpy as np
import scipy
from scipy import fft, interpolate, signal, stats

FS = 2000.0
OUT = Path(__file__).resolve().parents[2] / "crates/brinell-signal/tests/signal"


def test_signal(n, seed):
    """Impacts ringing at 500 Hz, two sines, a slope and noise, rounded so that the file holds exactly what was used."""
    rng = np.random.default_rng(seed)
    t = np.arange(n) / FS
    x = 0.4 * np.sin(2 * np.pi * 47.3 * t) + 0.2 * np.cos(2 * np.pi * 211.0 * t + 0.5) + 0.1 + 0.3 * t
    for start in np.arange(0.013, n / FS, 1 / 31.7):
        late = t >= start
        x[late] += 2.0 * np.exp(-(t[late] - start) / 0.004) * np.sin(2 * np.pi * 500.0 * (t[late] - start))
    return np.round(x + 0.3 * rng.standard_normal(n), 4)


def numbers(values):
    return [float(v) for v in np.ravel(values)]


def windows():
    names = {"rectangular": "boxcar", "hann": "hann", "hamming": "hamming", "blackman-harris": "blackmanharris",
             "flat-top": "flattop"}
    return {name: {"periodic": numbers(signal.get_window(scipy_name, 24, fftbins=True)),
                   "symmetric": numbers(signal.get_window(scipy_name, 25, fftbins=False))}
            for name, scipy_name in names.items()}


def distributions():
    chi = [(x, d) for d in (1.0, 2.0, 7.3, 60.0, 900.0) for x in (0.1 * d, d, 1.5 * d, 2.0 * d + 20.0)]
    f = [(x, a, b) for a, b in ((2.0, 40.0), (2.0, 25.5), (13.0, 300.0), (31.4, 8.0)) for x in (0.2, 1.0, 3.0, 15.0)]
    p = [(q, d) for d in (2.0, 5.5, 38.0) for q in (0.01, 0.5, 0.975)]
    return {"chi_square_tail": [[x, d, float(stats.chi2.sf(x, d))] for x, d in chi],
            "f_tail": [[x, a, b, float(stats.f.sf(x, a, b))] for x, a, b in f],
            "chi_square_quantile": [[q, d, float(stats.chi2.ppf(q, d))] for q, d in p]}


def spectra(x):
    cases = []
    for window, scipy_window in (("hann", "hann"), ("blackman-harris", "blackmanharris"), ("flat-top", "flattop")):
        for length, overlap, detrend in ((128, 0.5, False), (100, 0.75, "constant"), (90, 0.0, "linear")):
            arguments = dict(fs=FS, window=scipy_window, nperseg=length, noverlap=int(overlap * length), detrend=detrend)
            density = signal.welch(x, scaling="density", **arguments)[1]
            mean_square = signal.welch(x, scaling="spectrum", **arguments)[1]
            cases.append({"window": window, "length": length, "overlap": overlap, "detrend": str(detrend),
                          "density": numbers(density), "mean_square": numbers(mean_square)})
    f, t, s = signal.spectrogram(x, FS, window="hann", nperseg=64, noverlap=48, detrend=False, scaling="density", mode="psd")
    keep = [0, 7, len(t) - 1]
    return {"welch": cases, "spectrogram": {"length": 64, "overlap": 0.75, "first_time": float(t[0]),
                                            "time_step": float(t[1] - t[0]), "frames": len(t), "kept": keep,
                                            "density": [numbers(s[:, i]) for i in keep]}}


def envelopes(x):
    """The ideal band-pass by the transform, then SciPy's analytic signal."""
    spectrum = fft.rfft(x)
    f = fft.rfftfreq(len(x), 1 / FS)
    low, high = 400.0, 650.0
    spectrum[(f < low) | (f > high)] = 0
    return {"low": low, "high": high, "envelope": numbers(np.abs(signal.hilbert(fft.irfft(spectrum, len(x)))))}


def velocities(x):
    spectrum = fft.rfft(signal.detrend(x))
    f = fft.rfftfreq(len(x), 1 / FS)
    low, high = 30.0, 700.0
    inside = (f >= low) & (f <= high)
    spectrum = np.where(inside, spectrum / (2j * np.pi * np.where(f > 0, f, 1.0)), 0)
    return {"low": low, "high": high, "transform": numbers(fft.irfft(spectrum, len(x))[::2])}


def indicators(x):
    rms = np.sqrt(np.mean(x**2))
    return {"rms": float(rms), "mean": float(x.mean()), "standard_deviation": float(x.std()), "peak": float(np.abs(x).max()),
            "peak_to_peak": float(np.ptp(x)), "crest_factor": float(np.abs(x).max() / rms),
            "kurtosis": float(stats.kurtosis(x, fisher=False)), "skewness": float(stats.skew(x)),
            "impulse_factor": float(np.abs(x).max() / np.abs(x).mean()), "shape_factor": float(rms / np.abs(x).mean())}


def kurtosis_of_bands(x, depth):
    """Each band by itself: shifted to zero frequency, through the branch's filters one after the other."""
    half = signal.firwin(33, 0.25, window="hamming")
    third = signal.firwin(49, 1 / 6, window="hamming")

    def branch(c, h, factor, turn):
        turned = c * np.exp(-2j * np.pi * turn * np.arange(len(c)))
        return signal.lfilter(h, 1.0, turned)[len(h) - 1::factor]

    def kurtosis(c):
        power = np.abs(c) ** 2
        return float(np.mean(power**2) / np.mean(power) ** 2 - 2)

    root = (x - x.mean()) * np.exp(-0.5j * np.pi * np.arange(len(x)))
    halves = [[root]]
    for _ in range(depth):
        halves.append([branch(c, half, 2, turn) for c in halves[-1] for turn in (-1 / 8, 1 / 8)])
    levels = [[float(stats.kurtosis(x))]]
    for level in range(1, depth + 1):
        if level >= 2:
            levels.append([kurtosis(branch(c, third, 3, turn)) for c in halves[level - 2] for turn in (-1 / 6, 0, 1 / 6)])
        levels.append([kurtosis(c) for c in halves[level]])
    return {"depth": depth, "levels": levels}


def orders(x):
    """Exact values of a signal of known angle, and the angle through pulses."""
    pulses = np.array([[0.0, 0.0], [0.05, 1.0], [0.09, 2.0], [0.12, 3.0], [0.16, 4.0], [0.22, 5.0], [0.3, 6.0]])
    angle = interpolate.PchipInterpolator(pulses[:, 0], pulses[:, 1])
    t = np.linspace(0.001, 0.299, 25)
    return {"pulses": pulses.tolist(), "t": numbers(t), "angle": numbers(angle(t)), "speed": numbers(angle.derivative()(t))}


def main():
    OUT.mkdir(parents=True, exist_ok=True)
    x, long = test_signal(600, 1), test_signal(4000, 2)
    made_by = f"SciPy {scipy.__version__}, NumPy {np.__version__}, Python {sys.version.split()[0]}"
    files = {"inputs": {"fs": FS, "x": numbers(x), "long": numbers(long)}, "windows": windows(),
             "distributions": distributions(), "spectra": spectra(x), "envelope": envelopes(x),
             "velocity": velocities(x), "indicators": indicators(x),
             "kurtogram": kurtosis_of_bands(long, 4), "order": orders(x)}
    for name, content in files.items():
        (OUT / f"{name}.json").write_text(json.dumps({"made_by": made_by, **content}) + "\n")


if __name__ == "__main__":
    main()
