"""Keys of a scenario fitted to numbers that are known, or to a measured signal."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Set
from dataclasses import dataclass, field
from numbers import Real
from typing import TYPE_CHECKING, Any, Literal

import numpy.typing as npt

from brinell import _brinell, tables
from brinell.arguments import jobs_of, number_of, samples_of, whole_of
from brinell.scenario import Runnable, Scenario, given, plain, warn
from brinell.signals import Signal

if TYPE_CHECKING:
    import pandas
    import polars

    _Bounds = tuple[float, float] | tuple[float, float, Literal["log"]]

__all__ = ["Calibration", "calibrate"]


@dataclass(frozen=True, eq=False)
class Calibration:
    """The best values of keys, how sure they are, and what the data leave open."""

    values: dict[str, float]
    """The best value of each key, in the unit of the scenario file."""
    intervals: dict[str, tuple[float, float] | None]
    """The 95 % interval of each key within its bounds; None where the data do not determine it, the targets are not met, or
    the best value is expected outside: ``undetermined`` says which."""
    residuals: dict[str, float]
    """Of each target: the best run's difference from it, in standard uncertainties, the target's and the runs' own
    together."""
    met: bool
    """Whether the uncertainties explain the residuals."""
    verdict: list[str]
    """How well the targets are met, in sentences."""
    undetermined: list[str]
    """Keys and combinations of keys that the data leave open, in sentences."""
    best: Scenario
    """The scenario with the best values."""
    runs: dict[str, npt.NDArray[Any]] = field(repr=False)
    """A row a run in the order of the search, as ``calibrate.csv``: keys, ``chi_square``, the targets' numbers (SI),
    with ``.own_uncertainty`` and ``.residual`` behind, ``stage``, ``status``, ``reason``; NaN or None where there is
    none."""
    report: dict[str, Any] = field(repr=False)
    """Everything, as ``brinell calibrate --json`` writes it: correlations and directions too."""
    _native: _brinell.Calibration | None = field(repr=False)

    @property
    def warnings(self) -> list[str]:
        """What ``brinell calibrate`` warns of: of the best scenario, and of the runs each kind once."""
        return [plain(text) for text in self.report["warnings"]]

    def to_pandas(self) -> pandas.DataFrame:
        """The runs as a data frame."""
        return tables.to_pandas(self.runs, {})

    def to_polars(self) -> polars.DataFrame:
        """The runs as a data frame."""
        return tables.to_polars(self.runs)

    def to_html(self) -> str:
        """The page that ``brinell calibrate`` writes as ``calibrate.html``: one file that needs no network.

        Write it as UTF-8. A calibration that came from another process has no page.
        """
        if self._native is None:
            raise RuntimeError("this calibration came from another process: its page is to be requested there")
        return self._native.to_html()

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_native": None}

    def __repr__(self) -> str:
        found = ", ".join(f"{key} = {value:g}" for key, value in self.values.items())
        return f"<brinell.Calibration: {found}; {'met' if self.met else 'not met'}>"


def _numbers(argument: str, key: str, given: Any, shape: str) -> list[Any]:
    """A pair of numbers, and what is behind them."""
    ordered = isinstance(given, Iterable) and not isinstance(given, (str, bytes, Mapping, Set))
    parts = list(given) if ordered else []
    if len(parts) < 2 or not all(isinstance(part, Real) for part in parts[:2]):
        raise TypeError(f"{argument}: {key} = {given!r}: expected {shape}")
    return parts


def calibrate(
    scenario: Runnable,
    fit: Mapping[str, _Bounds],
    targets: Mapping[str, tuple[float, float]] | None = None,
    *,
    measured: Signal | None = None,
    axis: Literal["x", "y"] | None = None,
    model_uncertainty_percent: float = 5.0,
    events_only: bool = False,
    budget: int | None = None,
    seed: int = 1,
    jobs: int | None = None,
    progress: Callable[[int, int], object] | None = None,
    folder: str | os.PathLike[str] | None = None,
) -> Calibration:
    """Fits keys of a scenario within bounds to numbers that are known.

    Ctrl-C stops it; with a `folder`, the same call resumes it.

    Parameters
    ----------
    scenario : Scenario or path
        What the keys are of.
    fit : mapping of str to tuple
        Bounds by dotted path, in the unit of the scenario file: ``(low, high)``, or ``(low, high, "log")`` where the
        key is searched in its logarithm.
    targets : mapping of str to (float, float), optional
        Value and standard uncertainty (one sigma) by name, as in the tables of sweeps (``sensor_ax.rms``), SI.
    measured : Signal, optional
        A measured acceleration, which becomes targets itself: levels, RMS, kurtosis, frequencies of defects, and how
        far apart the two events of each pass are. Its rate is the scenario's.
    axis : {"x", "y"}, optional
        The sensor's in the simulation; the one nearer the load by default.
    model_uncertainty_percent : float
        What levels of the model may differ by from a machine's, one sigma.
    events_only : bool
        Whether the measured signal becomes the spacing of its events alone, from which the damage's length follows, and
        not levels, which the way to the sensor changes.
    budget : int, optional
        Runs at most; 30 a key by default.
    seed : int
        Which points are tried, 0 or more.
    jobs : int, optional
        Runs at a time; as many as there are cores by default. The outcome does not depend on it.
    progress : callable, optional
        Gets how many runs are over, and of how many at most.
    folder : path, optional
        Where finished runs are kept, in ``journal.jsonl`` as by ``brinell calibrate``: they are not made again. One
        calibration to a folder.

    Returns
    -------
    Calibration
        The numbers of ``brinell calibrate``, whether the targets are met or not.

    Raises
    ------
    ScenarioError
        Where a bound makes a scenario that cannot run.
    ValueError
        Where bounds, targets, budget or the measured signal are wrong. Where the folder is another calibration's.
    SignalError
        Where the measured signal is too short or not finite.
    RunError
        Where no run says anything of a target.
    ReadError
        Where the folder's journal cannot be read or written.

    Warns
    -----
    ScenarioWarning
        What ``brinell calibrate`` warns of: ``warnings`` of the calibration.

    Examples
    --------
    >>> import brinell
    >>> base = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
    >>> found = brinell.calibrate(
    ...     base, {"operation.speed_rpm": (1500.0, 2100.0)}, {"defect1.pure_rolling_frequency": (250.1, 0.5)}, budget=8
    ... )
    >>> found.met, round(found.values["operation.speed_rpm"], -1)
    (True, 1800.0)
    """
    base = given(scenario)
    keys = []
    for key, bounds in fit.items():
        low, high, *kind = _numbers("fit", key, bounds, '(low, high) or (low, high, "log")')
        if kind not in ([], ["log"]):
            raise ValueError(f'fit: {key} = {bounds}: expected (low, high) or (low, high, "log")')
        keys.append((key, low, high, bool(kind)))
    wanted = []
    for name, target in (targets or {}).items():
        value, uncertainty, *more = _numbers("targets", name, target, "(value, standard uncertainty)")
        if more:
            raise TypeError(f"targets: {name} = {target!r}: expected (value, standard uncertainty)")
        wanted.append((name, value, uncertainty))
    samples, rate, unit = None, 0.0, ""
    if measured is not None:
        if not isinstance(measured, Signal):
            raise TypeError(f"measured: expected a brinell.signals.Signal, as read_signal gives it, and it is {type(measured).__name__}")
        if measured.rate_hz is None or measured.unit is None:
            raise ValueError("measured: its rate_hz and unit are to be given, for the file states none")
        samples, unit = samples_of(measured.values, "measured.values"), measured.unit
        rate = number_of(measured.rate_hz, "measured.rate_hz", "samples a second")
    signal = (rate, unit, axis, model_uncertainty_percent, events_only)
    seed, budget = whole_of(seed, "seed", "0 or more"), None if budget is None else whole_of(budget, "budget", "runs at most")
    native = _brinell.calibrate(base._native, keys, wanted, samples, signal, seed, budget, jobs_of(jobs), progress, folder)
    report = native.report()
    values = {key["key"]: key["value"] for key in report["keys"]}
    found = Calibration(
        values=values,
        intervals={key["key"]: None if key["low"] is None else (key["low"], key["high"]) for key in report["keys"]},
        residuals={target["name"]: target["residual"] for target in report["targets"]},
        met=report["met"],
        verdict=report["verdict"],
        undetermined=report["undetermined"],
        best=base.replace(values),
        runs=tables.columns(native.columns()),
        report=report,
        _native=native,
    )
    warn(found.warnings)
    return found
