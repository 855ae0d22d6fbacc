"""Analysis of signals: spectra, envelopes, kurtogram, indicators; and signals from files.

Every function takes samples with their rate and, where a result carries one, their unit: nothing is guessed. Frequencies are Hz. The work is
done on a copy of the samples, by a thread of its own: Ctrl-C ends the waiting at once, and what is being computed ends on its own.
"""

from __future__ import annotations

import numbers
import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from brinell import _brinell, tables

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


def _kind(x: object) -> str:
    dtype = getattr(x, "dtype", None)
    return type(x).__name__ if dtype is None else f"{type(x).__name__} of {dtype}"


def number_of(value: Any, name: str, what: str) -> float:
    """A number, which `name` is called; `what` says in which unit it is expected."""
    try:
        if isinstance(value, (str, bytes)):
            raise TypeError
        return float(value)
    except TypeError:
        raise TypeError(f"{name} = {value!r}: expected a number, {what}") from None


def masked_values(x: Any) -> int:
    """How many values of an array are masked.

    Examples
    --------
    >>> import numpy as np
    >>> masked_values(np.ma.masked_less([1.0, 2.0, 3.0], 2.0))
    1
    """
    return int(np.count_nonzero(x.mask)) if isinstance(x, np.ma.MaskedArray) else 0


def samples_of(x: npt.ArrayLike, name: str = "x") -> Array:
    """One channel's samples as doubles; a column or row of a matrix counts as one.

    Parameters
    ----------
    x : array_like
        Samples.
    name : str
        What errors call them.

    Raises
    ------
    TypeError
        Where they are no real numbers, or those of several channels.
    SignalError
        Where some are masked.

    Examples
    --------
    >>> from brinell.signals import samples_of
    >>> samples_of([[1], [2]])
    array([1., 2.])
    >>> samples_of([[1, 2], [3, 4]])
    Traceback (most recent call last):
    ...
    TypeError: x: expected the samples of one channel, and its shape is (2, 2); give one of them, such as x[:, 0]
    """
    if masked := masked_values(x):
        raise _brinell.SignalError(f"{name}: {masked} of {np.size(x)} samples are masked; give a stretch without, or {name}.filled(...) with values")
    try:
        if x is None or np.iscomplexobj(x):
            raise TypeError
        given = np.asarray(x)
        # Others convert too, instants and text among them, and are no vibration.
        if given.dtype.kind not in "iuf" and not (given.dtype.kind == "O" and all(isinstance(v, numbers.Real) and not isinstance(v, bool) for v in given.flat)):
            raise TypeError
        samples: Array = given.astype(float, copy=False)
    except (TypeError, ValueError):
        kind = "complex numbers" if np.iscomplexobj(x) else _kind(x)
        raise TypeError(f"{name}: expected the samples of one channel, real numbers, and it is {kind}") from None
    if samples.ndim == 2 and 1 in samples.shape:
        samples = samples.reshape(-1)
    if samples.ndim != 1:
        # Of a matrix of few rows and many columns the rows are the channels.
        first = "[0]" if samples.ndim == 2 and samples.shape[0] < samples.shape[1] else "[:, 0]"
        raise TypeError(
            f"{name}: expected the samples of one channel, and its shape is {samples.shape}; give one of them, such as {name}{first}"
        )
    return samples


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
        from brinell import plot

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
    samples, rate_hz = samples_of(x), number_of(rate_hz, "rate_hz", "samples a second")
    if length is None:
        length = max(min(int(rate_hz) if rate_hz < 2**31 else len(samples), len(samples) // 4), min(256, len(samples)))
    found = _brinell.psd(samples, rate_hz, length, overlap, window, detrend)
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
    found = _brinell.psd(samples_of(x), rate_hz, None, 0.0, window, detrend)
    return Spectrum._of(found, unit)


def envelope(x: npt.ArrayLike, *, rate_hz: float, band_hz: tuple[float, float] | None = None) -> Array:
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
    return _brinell.envelope(samples_of(x), rate_hz, band_hz)


def envelope_spectrum(
    x: npt.ArrayLike,
    *,
    rate_hz: float,
    unit: str,
    band_hz: tuple[float, float] | None = None,
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
    found = _brinell.envelope_spectrum(samples_of(x), rate_hz, band_hz, length, overlap, window)
    found["band_hz"] = band_hz
    return Spectrum._of(found, unit)


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
        from brinell import plot

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
    samples = samples_of(x)
    first, time_step, step, density = _brinell.spectrogram(samples, rate_hz, length, overlap, window)
    frames, bins = density.shape
    time = first + time_step * np.arange(frames, dtype=float)
    return Spectrogram(time.astype(float), (step * np.arange(bins)).astype(float), density, unit)


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
    """The most impulsive band."""
    best_kurtosis: float | None

    def plot(self, *, ax: Any = None) -> matplotlib.axes.Axes:
        """Kurtosis of every band, a line of bands of one width above the other."""
        from brinell import plot

        return plot.kurtogram(self, ax=ax)

    def __repr__(self) -> str:
        best = "no band is impulsive" if self.best_hz is None else f"best {self.best_hz[0]:g} to {self.best_hz[1]:g} Hz"
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
    return Kurtogram(**_brinell.kurtogram(samples_of(x), rate_hz, depth, narrowest_hz))


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
    return _brinell.indicators(samples_of(x), rate_hz, unit, block_s)


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


def read_signal(path: str | os.PathLike[str], channel: str | None = None) -> Signal:
    """One channel of a measured signal's file: CSV and text, Parquet, MAT, HDF5, NPY, NPZ, UFF 58 or WAV.

    Parameters
    ----------
    path : path
        The file; its content says the format.
    channel : str, optional
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
    return Signal(**_brinell.read_signal(path, channel))
