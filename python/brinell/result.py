"""What a run leaves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brinell import _brinell, plot, tables
from brinell.analysis import Analysis, analyze
from brinell.scenario import Scenario, plain, warn
from brinell.signals import Spectrum

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas
    import polars
    import xarray

__all__ = ["Result", "Settled"]


class Settled(Mapping[str, npt.NDArray[np.float64]]):
    """The channels of a result from the time on from which it is analysed, as `Result.settled` gives them.

    A read-only mapping with the keys of the result. Each array is a view of the end of the result's own, one sample a row: nothing is copied.
    """

    def __init__(self, result: Result) -> None:
        self._result = result
        self._first = result._first()

    def __getitem__(self, channel: str) -> npt.NDArray[np.float64]:
        """A channel's samples, SI."""
        return self._result[channel][self._first :]

    def __contains__(self, channel: object) -> bool:
        """Whether a channel was recorded."""
        return channel in self._result

    def __iter__(self) -> Iterator[str]:
        """Names of the channels, time first."""
        return iter(self._result)

    def __len__(self) -> int:
        """Number of channels, as of any mapping; ``len(settled.t)`` is that of the samples."""
        return len(self._result.signals)

    @property
    def t(self) -> npt.NDArray[np.float64]:
        """Time of each sample since the start of the run, s; the first is ``analysed_from``."""
        return self["t"]

    def _ipython_key_completions_(self) -> list[str]:
        return list(self)

    def __repr__(self) -> str:
        return f"<brinell.Settled of {self._result.scenario.name!r}: {len(self.t)} samples of {len(self)} channels from {self.t[0]:g} s on>"


class Result:
    """Signals of a run and what was found in them, as `simulate` gives it.

    The arrays own the memory that the run wrote: nothing was copied. A result can be pickled.

    Examples
    --------
    >>> import brinell
    >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
    >>> result = brinell.simulate(scenario)
    >>> result.channels[:3]
    ['t', 'inner_x', 'inner_y']
    >>> result.units["sensor_ax"], result["sensor_ax"].dtype.name
    ('m/s^2', 'float64')
    >>> result.summary["status"]
    {'complete': True}
    """

    scenario: Scenario
    """What was run."""
    signals: dict[str, npt.NDArray[np.float64]]
    """Time ``t`` (s) and every recorded channel by name, SI."""
    rate_hz: float
    """Samples a second."""
    complete: bool
    """Whether the run reached its duration."""

    def __init__(self) -> None:
        raise TypeError("results come from brinell.simulate")

    @classmethod
    def _of(cls, run: _brinell.Run, scenario: Scenario) -> Result:
        result = cls.__new__(cls)
        result._run = run
        result.scenario = scenario
        result.signals = run.signals
        result.rate_hz = run.rate_hz
        result.complete = run.complete
        return result

    _run: _brinell.Run | None

    def _native(self) -> _brinell.Run:
        if self._run is None:
            raise RuntimeError("this result came from another process: what needs the run itself, such as to_html, is to be requested there")
        return self._run

    def __getitem__(self, channel: str) -> npt.NDArray[np.float64]:
        """A channel's samples."""
        try:
            return self.signals[channel]
        except (KeyError, TypeError):
            near = tables.meant(channel, self.signals)
            raise KeyError(f"{channel}: not recorded{near or '; there are ' + ', '.join(self.signals)}") from None

    def __contains__(self, channel: object) -> bool:
        """Whether a channel was recorded."""
        return channel in list(self.signals)

    def __iter__(self) -> Iterator[str]:
        """Names of the channels, time first."""
        return iter(self.signals)

    def __len__(self) -> int:
        """Samples of each channel."""
        return len(self.t)

    def _ipython_key_completions_(self) -> list[str]:
        return self.channels

    @cached_property
    def warnings(self) -> list[str]:
        """What its reader should know, as ``brinell run`` prints it: of the scenario, and of what the run shows."""
        return [plain(text) for text in self._native().warnings()]

    def _warn(self, *, stacklevel: int = 3) -> None:
        """Of the scenario itself there were warnings when it was made."""
        known = {plain(text) for text in self.scenario.warnings}
        warn((text for text in self.warnings if text not in known), stacklevel=stacklevel + 1)

    @property
    def t(self) -> npt.NDArray[np.float64]:
        """Time of each sample, s."""
        return self.signals["t"]

    def _first(self) -> int:
        """Sample from which on the run is analysed."""
        from_s = self.summary["quantities"]["analysed_from"]["value"]
        # Nought where the run did not come so far.
        first = round(from_s * self.rate_hz) if from_s else len(self)
        if first >= len(self):
            raise ValueError(f"the run ended at {self.t[-1]:g} s, before its start was over: it has no settled part")
        return first

    @property
    def settled(self) -> Settled:
        """The channels without the start of the run: ``settled["sensor_ax"]``, ``settled.t``.

        The start is the load ramp and the transient after it. It is over at ``analysed_from`` (s, in `quantities`): a turn of the shaft after the
        ramp, or half-way through the run, whichever comes first. Averages, forces and slip of the summary, spectra and `analyze` take the
        same samples; `events` and `passes` are of the whole run. Where the signal still drifts after it, `warnings` says so and the number ``not_settled`` is 1.

        Examples
        --------
        >>> import brinell
        >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
        >>> result = brinell.simulate(scenario)
        >>> float(result.settled.t[0]) == result.quantities["analysed_from"]
        True
        >>> result.settled["sensor_ax"].shape == result.settled.t.shape
        True
        """
        return Settled(self)

    @property
    def channels(self) -> list[str]:
        """Names in the order of files, time first."""
        return list(self.signals)

    @cached_property
    def _about(self) -> list[tuple[str, str, str]]:
        return self._native().channels()

    @property
    def units(self) -> dict[str, str]:
        """SI unit of each channel."""
        return {name: unit for name, unit, _ in self._about}

    @property
    def descriptions(self) -> dict[str, str]:
        """One line on each channel."""
        return {name: text for name, _, text in self._about}

    @cached_property
    def summary(self) -> dict[str, Any]:
        """What ``summary.json`` holds: indicators with intervals, defect frequencies, slip, load zone, audits, assumptions."""
        return self._native().summary()

    def spread(self, *, jobs: int | None = None) -> dict[str, Any]:
        """How far the levels hang on what is assumed, as ``brinell run --spread`` has it.

        Every assumed value is run at both ends of its plausible range, one at a time: some 30 runs more, ``jobs`` at a time (None: one a core).
        Intervals of `quantities` are scatter only; these bands are what nobody stated, and no confidence intervals.

        Returns
        -------
        dict
            ``assumed``: the keys with ``value``, ``low`` and ``high``; ``levels``: name, unit, value, the band ``low`` to ``high``, and ``by``, what each key
            does to it, the largest first.
        """
        return self._native().spread(jobs)

    @cached_property
    def quantities(self) -> dict[str, float]:
        """Every number of the run by name (``sensor_ax.rms``), as in the tables of sweeps; NaN where there is none.

        Ends of 95 % intervals have ``.low`` and ``.high`` behind the name.
        """
        values: dict[str, float] = {}
        for name, number in self.summary["quantities"].items():
            values[name] = np.nan if number["value"] is None else number["value"]
            if number.get("low") is not None:
                values[name + ".low"], values[name + ".high"] = number["low"], number["high"]
        return values

    @cached_property
    def spectrum(self) -> Spectrum | None:
        """Averaged amplitude spectrum of the sensor acceleration nearer to the load, after the start; None of a run too short."""
        found = self._native().spectrum()
        return None if found is None else Spectrum._of(found, "m/s^2")

    @cached_property
    def envelope(self) -> Spectrum | None:
        """Averaged spectrum of its envelope above the defect frequencies."""
        found = self._native().envelope()
        return None if found is None else Spectrum._of(found, "m/s^2")

    @cached_property
    def events(self) -> dict[str, npt.NDArray[Any]]:
        """Ground truth: instants ``t`` (s) at which a ``roller`` of a ``row`` enters (``enters``) or leaves a ``defect``, all from 1; of the whole run."""
        return self._native().events()

    @cached_property
    def passes(self) -> list[dict[str, Any]]:
        """The heaviest pass over each defect: ``t``, ``angle_deg`` on the damaged surface, ``effective_length_mm``, ``stiffness`` (in ``stiffness_unit``),
        ``force_n``."""
        return self._native().passes()

    @property
    def defects(self) -> list[dict[str, Any]]:
        """Where each defect lies, how large it is, and the name of its line; what was found of it is under ``defectN.`` in ``quantities``."""
        places: list[dict[str, Any]] = self.summary["defects"]
        return places

    def analyze(self, channel: str | None = None, **options: Any) -> Analysis:
        """Which defect frequencies are detected in this run, its start (``analysed_from_s``) left out.

        Where they are the outer race's, the scenario is run again without its damage: what rollers that enter the load show there too is no damage.

        Parameters
        ----------
        channel : str, optional
            The sensor acceleration nearer to the load by default.
        **options
            As of `brinell.analyze`; ``speed_rpm`` is needed where the scenario's varies.

        Examples
        --------
        >>> import brinell
        >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
        >>> brinell.simulate(scenario).analyze().damage[0]
        'outer_race'
        """
        if channel is None:
            channel = "sensor_ax" if self.spectrum is None else str(self.spectrum.channel)
        speed = self.scenario["operation.speed_rpm"]
        if "speed_rpm" not in options:
            if isinstance(speed, list):
                raise ValueError("speed_rpm: needed, for the scenario's varies")
            options["speed_rpm"] = speed
        first = self._first()
        settings: dict[str, Any] = {"rate_hz": self.rate_hz, "unit": self.units[channel], "bearing": self.scenario, "simulated": True}
        if not options.keys() & {"bearing", "sensitivity", "simulated"}:
            settings["_run"] = (channel, first / self.rate_hz)
        return analyze(self[channel][first:], **(settings | options))

    def to_pandas(self) -> pandas.DataFrame:
        """The signals as a data frame; ``attrs["units"]`` has the units.

        Examples
        --------
        >>> import brinell
        >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
        >>> frame = brinell.simulate(scenario).to_pandas()
        >>> frame.shape[0], frame.columns[0]
        (25601, 't')
        """
        return tables.to_pandas(self.signals, self.units)

    def to_polars(self) -> polars.DataFrame:
        """The signals as a data frame.

        Examples
        --------
        >>> import brinell
        >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
        >>> brinell.simulate(scenario).to_polars().height
        25601
        """
        return tables.to_polars(self.signals)

    def to_xarray(self) -> xarray.Dataset:
        """The signals along ``t``, with units, descriptions, scenario and sample rate.

        Examples
        --------
        >>> import brinell
        >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
        >>> brinell.simulate(scenario).to_xarray().sensor_ax.attrs["units"]
        'm/s^2'
        """
        attributes = {"scenario": self.scenario.to_toml(), "sample_rate_hz": self.rate_hz, "brinell": _brinell.__version__}
        dataset = tables.to_xarray(self.signals, self.units, "t", attributes)
        for name, text in self.descriptions.items():
            dataset[name].attrs["long_name"] = text
        return dataset

    def to_html(self, healthy: Result | None = None) -> str:
        """The page that ``brinell run`` writes as ``report.html``: one file that needs no network.

        ``healthy``, a run of the same scenario without its damage, is drawn behind in grey, as the command does by itself. A result
        that came from another process has no page.

        Examples
        --------
        >>> import brinell, pathlib, tempfile
        >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
        >>> page = pathlib.Path(tempfile.mkdtemp(), "report.html")
        >>> page.write_text(brinell.simulate(scenario).to_html(), encoding="utf-8") > 100_000
        True
        """
        return self._native().to_html(None if healthy is None else healthy._native())

    def plot_signal(
        self, channel: str | None = None, *, from_s: float | None = None, to_s: float | None = None, ax: Any = None
    ) -> matplotlib.axes.Axes:
        """A channel over time; lines where a roller enters damage, dashed ones where it leaves.

        Parameters
        ----------
        channel : str, optional
            The sensor acceleration nearer to the load by default.
        from_s, to_s : float, optional
            Part of the run.
        ax : matplotlib axes, optional
            Where to draw; new ones by default.
        """
        return plot.signal(self, channel, from_s=from_s, to_s=to_s, ax=ax)

    def plot_spectrum(self, *, to_hz: float | None = None, ax: Any = None) -> matplotlib.axes.Axes:
        """The amplitude spectrum."""
        return plot.spectrum(_there(self.spectrum), to_hz=to_hz, ax=ax)

    def plot_envelope(self, *, to_hz: float | None = None, harmonics: int = 5, ax: Any = None) -> matplotlib.axes.Axes:
        """The envelope spectrum; above it the harmonics of every defect frequency, those of the damage dashed through it: of the frequency that was
        found, where one was, else of pure rolling; beside each stands which."""
        return plot.envelope(self, to_hz=to_hz, harmonics=harmonics, ax=ax)

    def plot_load_zone(self, *, row: int = 1, ax: Any = None) -> matplotlib.axes.Axes:
        """Mean, largest and static force at the outer contacts of a row, on polar axes."""
        return plot.load_zone(self, row=row, ax=ax)

    def plot_pass(self, defect: int = 1, *, ax: Any = None) -> matplotlib.axes.Axes:
        """Contact length, stiffness and force as a roller passes a defect: three panels, of which the lowest is returned."""
        return plot.roller_pass(self, defect, ax=ax)

    def __getstate__(self) -> Mapping[str, Any]:
        for name, value in vars(type(self)).items():
            if isinstance(value, cached_property):
                getattr(self, name)
        return {**self.__dict__, "_run": None}

    def __repr__(self) -> str:
        ended = "complete" if self.complete else "partial"
        return f"<brinell.Result of {self.scenario.name!r}: {len(self.t)} samples at {self.rate_hz:g} Hz, {ended}>"


def _there(spectrum: Spectrum | None) -> Spectrum:
    if spectrum is None:
        raise ValueError("the run is too short for a spectrum")
    return spectrum
