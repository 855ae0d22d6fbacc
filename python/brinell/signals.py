"""Analysis of signals: spectra, envelopes, kurtogram, indicators; and signals from files.

Every function takes samples with their rate and, where a result carries one, their unit: nothing is guessed. Frequencies are Hz. The work is
done on a copy of the samples, by a thread of its own: Ctrl-C ends the waiting at once, and what is being computed ends on its own.
"""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from brinell import _brinell, plot, tables
from brinell.arguments import band_of, number_of, rate_of, samples_of, unit_of, whole_of

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas

    _Window = Literal["rectangular", "hann", "hamming", "blackman-harris", "flat-top"]
    _Detrend = Literal["none", "mean", "linear"]

__all__ = [
    "Kurtogram",
    "Signal",
    "Spectrogram",
    "Spectrum",
    "envelope",
    "envelope_spectrum",
    "indicators",
    "kurtogram",
    "psd",
    "read_signal",
    "spectrogram",
    "spectrum",
]

Array = npt.NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Spectrum:
    """A one-sided spectrum."""

    frequency_hz: Array
    """Of each bin."""
    amplitude: Array
    """Peak amplitude of a sine at the bin, in the signal's unit; root mean square over segments."""
    density: Array
    """Power spectral density, unit^2/Hz."""
    unit: str
    """The signal's."""
    segments: int
    """Segments averaged."""
    noise_bandwidth_hz: float
    """Equivalent noise bandwidth of a bin."""
    degrees_of_freedom: float
    """Of a bin's power under Gaussian noise."""
    mean: float | None = None
    """Mean of an envelope, in the signal's unit."""
    band_hz: tuple[float, float] | None = None
    """Band that an envelope was taken in."""
    channel: str | None = None
    """Of a run."""

    @classmethod
    def _of(cls, found: dict[str, Any], unit: str) -> Spectrum:
        values = dict(found)
        step = values.pop("frequency_step_hz")
        frequency = step * np.arange(len(values["amplitude"]))
        return cls(frequency_hz=frequency, unit=unit, **values)

    def to_pandas(self) -> pandas.DataFrame:
        """Frequency, amplitude and density as a data frame."""
        columns = {"frequency_hz": self.frequency_hz, "amplitude": self.amplitude, "density": self.density}
        units = {"frequency_hz": "Hz", "amplitude": self.unit, "density": f"({self.unit})^2/Hz"}
        return tables.to_pandas(columns, units)

    def plot(self, *, to_hz: float | None = None, ax: Any = None) -> matplotlib.axes.Axes:
        """Amplitude over frequency."""
        return plot.spectrum(self, to_hz=to_hz, ax=ax)

    def __repr__(self) -> str:
        bins = f"{len(self.frequency_hz)} bins to {self.frequency_hz[-1]:g} Hz" if len(self.frequency_hz) else "no bins"
        return f"<brinell.Spectrum: {bins}, {self.unit}, {self.segments} segment{'' if self.segments == 1 else 's'}>"


def psd(
    x: npt.ArrayLike,
    *,
    rate_hz: float,
    unit: str,
    length: int | None = None,
    overlap: float = 0.5,
    window: _Window = "hann",
    detrend: _Detrend = "none",
) -> Spectrum:
    """Amplitudes and power spectral density by Welch's method.

    Parameters
    ----------
    x : array_like
        Samples.
    rate_hz : float
        Samples a second.
    unit : str
        Of the samples: ``"m/s^2"``, ``"g"``.
    length : int, optional
        Samples of a segment; about a second of them by default, and at least four segments where the signal is long enough.
    overlap : float
        Share of a segment that the next one has too.
    window : {"rectangular", "hann", "hamming", "blackman-harris", "flat-top"}
        For each segment.
    detrend : {"none", "mean", "linear"}
        What is taken off each segment before.

    Returns
    -------
    Spectrum

    Raises
    ------
    SignalError
        Where a sample is not finite, or an argument is out of its range.

    Examples
    --------
    >>> import brinell, numpy as np
    >>> t = np.arange(4096) / 4096.0
    >>> tone = brinell.psd(3.0 * np.sin(2 * np.pi * 64 * t), rate_hz=4096.0, unit="m/s^2", length=1024)
    >>> int(tone.frequency_hz[tone.amplitude.argmax()]), round(float(tone.amplitude.max()), 6)
    (64, 3.0)
    """
    samples, rate_hz, unit = samples_of(x), rate_of(rate_hz), unit_of(unit)
    if length is None:
        length = max(min(int(rate_hz) if rate_hz < 2**31 else len(samples), len(samples) // 4), min(256, len(samples)))
    found = _brinell.psd(samples, rate_hz, whole_of(length, "length", "samples"), number_of(overlap, "overlap", "a share"), window, detrend)
    return Spectrum._of(found, unit)


def spectrum(x: npt.ArrayLike, *, rate_hz: float, unit: str, window: _Window = "hann", detrend: _Detrend = "none") -> Spectrum:
    """Amplitude spectrum of the whole signal as one segment: the finest lines.

    Parameters
    ----------
    x, rate_hz, unit, window, detrend
        As in `psd`.

    Examples
    --------
    >>> import brinell, numpy as np
    >>> t = np.arange(2000) / 2000.0
    >>> lines = brinell.spectrum(np.cos(2 * np.pi * 50 * t), rate_hz=2000.0, unit="g")
    >>> float(lines.frequency_hz[1])
    1.0
    """
    found = _brinell.psd(samples_of(x), rate_of(rate_hz), None, 0.0, window, detrend)
    return Spectrum._of(found, unit_of(unit))


def envelope(x: npt.ArrayLike, *, rate_hz: float, band_hz: Sequence[float] | None = None) -> Array:
    """Envelope in a band, sample by sample, in the signal's unit. Its ends are disturbed.

    Parameters
    ----------
    x : array_like
        Samples.
    rate_hz : float
        Samples a second.
    band_hz : (float, float), optional
        Low and high edge, at most half the rate; everything by default.

    Examples
    --------
    >>> import brinell, numpy as np
    >>> t = np.arange(1000) / 1000.0
    >>> bool(np.allclose(brinell.envelope(2.0 * np.sin(2 * np.pi * 100 * t), rate_hz=1000.0), 2.0))
    True
    """
    return _brinell.envelope(samples_of(x), rate_of(rate_hz), band_of(band_hz))


def envelope_spectrum(
    x: npt.ArrayLike,
    *,
    rate_hz: float,
    unit: str,
    band_hz: Sequence[float] | None = None,
    length: int | None = None,
    overlap: float = 0.5,
    window: _Window = "hann",
) -> Spectrum:
    """Spectrum of the envelope less its mean: what repeats in a resonance.

    Parameters
    ----------
    x, rate_hz, unit
        As in `psd`.
    band_hz : (float, float), optional
        Band to demodulate, at most to half the rate; `kurtogram` finds an impulsive one.
    length : int, optional
        Samples of a segment; the whole signal by default.
    overlap, window
        As in `psd`.

    Examples
    --------
    >>> import brinell, numpy as np
    >>> t = np.arange(8192) / 8192.0
    >>> x = (1.0 + 0.5 * np.cos(2 * np.pi * 40 * t)) * np.sin(2 * np.pi * 2000 * t)
    >>> lines = brinell.envelope_spectrum(x, rate_hz=8192.0, unit="g", band_hz=(1500.0, 2500.0))
    >>> float(lines.frequency_hz[lines.amplitude.argmax()]), round(float(lines.amplitude.max() / lines.mean), 3)
    (40.0, 0.5)
    """
    samples, band = None if length is None else whole_of(length, "length", "samples"), band_of(band_hz)
    found = _brinell.envelope_spectrum(samples_of(x), rate_of(rate_hz), band, samples, number_of(overlap, "overlap", "a share"), window)
    found["band_hz"] = band
    return Spectrum._of(found, unit_of(unit))


@dataclass(frozen=True, eq=False)
class Spectrogram:
    """Power spectral density over time."""

    time_s: Array
    """Middle of each frame."""
    frequency_hz: Array
    """Of each bin."""
    density: Array
    """(frames, bins), unit^2/Hz."""
    unit: str
    """The signal's."""

    def plot(self, *, ax: Any = None) -> matplotlib.axes.Axes:
        """Density over time and frequency."""
        return plot.spectrogram(self, ax=ax)

    def __repr__(self) -> str:
        frames, bins = self.density.shape
        return f"<brinell.Spectrogram: {frames} frames of {bins} bins, ({self.unit})^2/Hz>"


def spectrogram(
    x: npt.ArrayLike, *, rate_hz: float, unit: str, length: int, overlap: float = 0.5, window: _Window = "hann"
) -> Spectrogram:
    """Power spectral density of each segment by itself.

    Parameters
    ----------
    x, rate_hz, unit, length, overlap, window
        As in `psd`.

    Examples
    --------
    >>> import brinell, numpy as np
    >>> map_ = brinell.spectrogram(np.sin(np.arange(1024.0)), rate_hz=1024.0, unit="g", length=256)
    >>> map_.density.shape == (len(map_.time_s), len(map_.frequency_hz)) == (7, 129)
    True
    """
    samples, length, overlap = samples_of(x), whole_of(length, "length", "samples"), number_of(overlap, "overlap", "a share")
    first, time_step, step, density = _brinell.spectrogram(samples, rate_of(rate_hz), length, overlap, window)
    frames, bins = density.shape
    time = first + time_step * np.arange(frames, dtype=float)
    return Spectrogram(time.astype(float), (step * np.arange(bins)).astype(float), density, unit_of(unit))


@dataclass(frozen=True, eq=False)
class Kurtogram:
    """Kurtosis of the envelope in every band: impulsive ones have a high value."""

    low_hz: Array
    high_hz: Array
    kurtosis: Array
    """0 for Gaussian noise."""
    noise_scatter: Array
    """Standard deviation of the kurtosis under Gaussian noise."""
    best_hz: tuple[float, float] | None
    """The band of the largest kurtosis. Noise has one too, whose kurtosis is up to some 9 of its ``noise_scatter``."""
    best_kurtosis: float | None

    @property
    def is_impulsive(self) -> bool:
        """Whether the best band's kurtosis is larger than noise alone has: more than ten times its scatter."""
        if self.best_hz is None or self.best_kurtosis is None:
            return False
        best = (self.low_hz == self.best_hz[0]) & (self.high_hz == self.best_hz[1])
        return bool(self.best_kurtosis > 10.0 * self.noise_scatter[best].max())

    def plot(self, *, ax: Any = None) -> matplotlib.axes.Axes:
        """Kurtosis of every band, a line of bands of one width above the other."""
        return plot.kurtogram(self, ax=ax)

    def __repr__(self) -> str:
        best = "no band is impulsive"
        if self.best_hz is not None:
            of = f"{self.best_hz[0]:g} to {self.best_hz[1]:g} Hz, kurtosis {self.best_kurtosis:.3g}"
            best = f"best {of}" if self.is_impulsive else f"{best}: the largest, {of}, is within what noise has"
        return f"<brinell.Kurtogram: {len(self.kurtosis)} bands, {best}>"


def kurtogram(x: npt.ArrayLike, *, rate_hz: float, depth: int = 7, narrowest_hz: float = 0.0) -> Kurtogram:
    """The fast kurtogram.

    Parameters
    ----------
    x : array_like
        Samples.
    rate_hz : float
        Samples a second.
    depth : int
        How often the band is halved at most.
    narrowest_hz : float
        The best band is at least so wide: three times a repetition frequency, for its impacts to be told apart.

    Examples
    --------
    >>> import brinell, numpy as np
    >>> x = np.random.default_rng(1).normal(size=8192)
    >>> since = np.arange(8192) % 512 / 8192.0
    >>> x += 20.0 * np.exp(-since / 1e-3) * np.sin(2 * np.pi * 3000.0 * since)
    >>> low, high = brinell.kurtogram(x, rate_hz=8192.0, narrowest_hz=100.0).best_hz
    >>> low < 3000.0 < high
    True
    """
    depth, narrowest = whole_of(depth, "depth", "halvings"), number_of(narrowest_hz, "narrowest_hz", "Hz")
    return Kurtogram(**_brinell.kurtogram(samples_of(x), rate_of(rate_hz), depth, narrowest))


def indicators(x: npt.ArrayLike, *, rate_hz: float, unit: str, block_s: float) -> dict[str, dict[str, Any]]:
    """RMS, peak, kurtosis and others, averaged over whole blocks, each with its 95 % interval.

    Parameters
    ----------
    x, rate_hz, unit
        As in `psd`.
    block_s : float
        Length of a block, s: a turn of the shaft.

    Returns
    -------
    dict
        By name: ``value``, ``unit``, ``low``, ``high``, ``blocks``. Peaks are those of a block; fewer than 6 blocks have no interval.

    Examples
    --------
    >>> import brinell, numpy as np
    >>> x = np.sin(2 * np.pi * np.arange(1000) / 100.0)
    >>> found = brinell.indicators(x, rate_hz=1000.0, unit="m/s^2", block_s=0.1)
    >>> round(found["rms"]["value"], 4), found["rms"]["unit"], found["rms"]["blocks"]
    (0.7071, 'm/s^2', 10)
    """
    return _brinell.indicators(samples_of(x), rate_of(rate_hz), unit_of(unit), number_of(block_s, "block_s", "s"))


@dataclass(frozen=True, eq=False)
class Signal:
    """One channel of a file."""

    values: Array
    rate_hz: float | None
    """What the file states; None where it does not."""
    unit: str | None
    """As the file spells it; None where it does not."""
    channel: str

    def __repr__(self) -> str:
        rate = "an unknown rate" if self.rate_hz is None else f"{self.rate_hz:g} Hz"
        return f"<brinell.Signal {self.channel!r}: {len(self.values)} samples at {rate}, {self.unit or 'unknown unit'}>"


def read_signal(path: str | os.PathLike[str], channel: str | int | None = None) -> Signal:
    """One channel of a measured signal's file: CSV and text, Parquet, MAT, HDF5, NPY, NPZ, TDMS, UFF 58 or WAV.

    Parameters
    ----------
    path : path
        The file; its content says the format.
    channel : str or int, optional
        Which one; needed where there are several. As ``--channel`` has it: its name, its number from 1, or whole words of its name, whatever the case:
        ``"DE"`` is ``X098_DE_time``.

    Raises
    ------
    ReadError
        Where the file cannot be read or has no such channel; it names those that are there.

    Examples
    --------
    >>> import brinell, numpy as np, pathlib, tempfile
    >>> path = pathlib.Path(tempfile.mkdtemp()) / "signal.npy"
    >>> np.save(path, np.arange(5.0))
    >>> brinell.read_signal(path).values
    array([0., 1., 2., 3., 4.])
    """
    if channel is not None and not isinstance(channel, str):
        channel = str(whole_of(channel, "channel", "counted from 1, or the name of a channel"))
    return Signal(**_brinell.read_signal(path, channel))
