"""Arguments that are taken as they are meant, or refused by name."""

from __future__ import annotations

import numbers
import operator
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from brinell import _brinell

__all__ = ["band_of", "jobs_of", "masked_values", "number_of", "rate_of", "samples_of", "text_of", "unit_of", "whole_of"]

Array = npt.NDArray[np.float64]


def number_of(value: Any, name: str, what: str) -> float:
    """A number, which `name` is called; `what` says in which unit it is expected.

    Examples
    --------
    >>> from brinell.arguments import number_of
    >>> number_of("1797", "speed_rpm", "r/min")
    Traceback (most recent call last):
    ...
    TypeError: speed_rpm = '1797': expected a number, r/min
    """
    try:
        if isinstance(value, (str, bytes)):
            raise TypeError
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} = {value!r}: expected a number, {what}") from None


def whole_of(value: Any, name: str, what: str) -> int:
    """A whole number, which `name` is called; `what` says of what.

    Examples
    --------
    >>> from brinell.arguments import whole_of
    >>> whole_of(1024.0, "length", "samples")
    Traceback (most recent call last):
    ...
    TypeError: length = 1024.0: expected a whole number, samples
    """
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"{name} = {value!r}: expected a whole number, {what}") from None


def jobs_of(jobs: Any) -> int | None:
    """How many runs at a time, where that is said.

    Examples
    --------
    >>> from brinell.arguments import jobs_of
    >>> jobs_of(2)
    2
    """
    return None if jobs is None else whole_of(jobs, "jobs", "runs at a time")


def text_of(value: Any, name: str, such_as: str) -> str:
    """A text, which `name` is called; `such_as` shows one or two.

    Examples
    --------
    >>> from brinell.arguments import text_of
    >>> text_of("g", "unit", '"g"')
    'g'
    """
    if not isinstance(value, str):
        raise TypeError(f"{name} = {value!r}: expected text, such as {such_as}")
    return value


def rate_of(value: Any) -> float:
    """A sample rate, Hz.

    Examples
    --------
    >>> from brinell.arguments import rate_of
    >>> rate_of(25600)
    25600.0
    """
    return number_of(value, "rate_hz", "samples a second")


def unit_of(value: Any) -> str:
    """The unit of a signal.

    Examples
    --------
    >>> from brinell.arguments import unit_of
    >>> unit_of("g")
    'g'
    """
    return text_of(value, "unit", '"m/s^2" or "g"')


def band_of(band_hz: Sequence[float] | None) -> tuple[float, float] | None:
    """The edges of a band, Hz; None is everything.

    Examples
    --------
    >>> from brinell.arguments import band_of
    >>> band_of([2000, 5000])
    (2000.0, 5000.0)
    """
    if band_hz is None:
        return None
    try:
        low, high = (number_of(edge, "band_hz", "Hz") for edge in band_hz)
    except (TypeError, ValueError):
        raise TypeError(f"band_hz = {band_hz!r}: expected two numbers, (low, high), Hz") from None
    return low, high


def _kind(x: object) -> str:
    dtype = getattr(x, "dtype", None)
    return type(x).__name__ if dtype is None else f"{type(x).__name__} of {dtype}"


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
    >>> from brinell.arguments import samples_of
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
