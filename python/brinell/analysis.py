"""Which component's defect frequencies are detected in a signal."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

import numpy.typing as npt

from brinell import _brinell, plot
from brinell.arguments import band_of, number_of, rate_of, samples_of, text_of, unit_of, whole_of
from brinell.scenario import Scenario, of_bearing
from brinell.signals import Signal, Spectrum

if TYPE_CHECKING:
    import matplotlib.axes

    _MachineClass = Literal["1-rigid", "1-flexible", "2-rigid", "2-flexible"]

__all__ = ["Analysis", "analyze"]


_SAYS = {"damage": "damage", "cannot_tell": "cannot tell", "nothing_found": "no damage found"}


@dataclass(frozen=True, eq=False)
class Analysis:
    """A verdict on one signal, with its evidence."""

    verdict: str
    """In words."""
    says: str
    """``damage``, ``cannot_tell`` or ``nothing_found``, which is not the same as healthy."""
    damage: list[str]
    """Damaged components, the one that leads first: ``outer_race``, ``inner_race``, ``rolling_element``, ``cage``."""
    families: list[dict[str, Any]]
    """Each defect frequency with its harmonics and sidebands, score and modulation; what is damage comes first."""
    severity: dict[str, Any]
    """``velocity_rms_10_1000_hz`` with ``value``, ``unit``, ``low`` and ``high``, or ``why`` there is none; ``iso_20816_3`` with the ``zone`` where a
    machine's class was given; levels of the ``band_shown``."""
    drift: dict[str, Any] | None
    """How the shaft's speed changes during the record, ``lowest`` and ``highest`` in r/min and when, where lines tell it; None where it is steady."""
    flaws: list[str]
    """What is wrong with the record itself, in words: samples clipped or held, one event with most of the energy; empty of a sound one."""
    size: dict[str, Any] | None
    """``length_mm`` of the damage along the rolling direction with ``value``, ``low`` and ``high`` of its 95 % interval, or None and the ``reason``; None
    where `size` was not asked for."""
    envelope: Spectrum
    """The envelope spectrum of the band in which the damage is highest over the noise, or of all."""
    report: dict[str, Any] = field(repr=False)
    """Everything, as ``brinell analyze --json`` writes it."""
    _findings: _brinell.Findings | None = field(repr=False)

    def to_html(self, title: str = "signal") -> str:
        """The page that ``brinell analyze -o`` writes as ``report.html``: one file that needs no network. Write it as UTF-8.

        It shows the array that was analysed, which is not copied: the page is right as long as nobody writes to it. A verdict that came from another
        process has no page.

        Parameters
        ----------
        title : str
            What the signal is called.
        """
        return self._own().to_html(title)

    def to_report(
        self,
        path: str | os.PathLike[str],
        *,
        title: str = "",
        machine: str = "",
        point: str = "",
        date: Any = "",
        author: str = "",
        remark: str = "",
        damage_kind: str | None = None,
    ) -> None:
        """Write the customer's report: two pages of A4 in plain words, as HTML or PDF, in place of a file that is there.

        It shows the array that was analysed, as `to_html` does.

        Parameters
        ----------
        path : path
            A name that ends in ``.html`` or ``.pdf``.
        title, machine, point, author : str
            What stands above it; what is empty is "not stated".
        date : str or date
            When the record was taken, as ``str`` gives it.
        remark : str
            What the author adds below the verdict.
        damage_kind : str, optional
            The kind of damage that somebody has seen, by ISO 15243: ``"subsurface-fatigue"``, ``"false-brinelling"`` and others, which the message
            on a wrong one lists. Vibration does not tell it.
        """
        self._own().to_report(os.fspath(path), [title, machine, point, str(date), author, remark], damage_kind)

    def _own(self) -> _brinell.Findings:
        """What was found, where it was found."""
        if self._findings is None:
            raise RuntimeError("this verdict came from another process: its page is to be requested there")
        return self._findings

    def plot(self, *, to_hz: float | None = None, ax: Any = None) -> matplotlib.axes.Axes:
        """The envelope spectrum with what was looked for."""
        return plot.analysis(self, to_hz=to_hz, ax=ax)

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_findings": None}

    def __repr__(self) -> str:
        return f"<brinell.Analysis: {', '.join(self.damage) or _SAYS[self.says]}>"


def analyze(
    x: npt.ArrayLike | Signal,
    *,
    rate_hz: float | None = None,
    unit: str | None = None,
    speed_rpm: float | None = None,
    tacho: npt.ArrayLike | Signal | None = None,
    pulses: int = 1,
    bearing: str | os.PathLike[str] | Scenario | None = None,
    rollers: int | None = None,
    pitch_mm: float | None = None,
    diameter_mm: float | None = None,
    contact_angle_deg: float | None = None,
    bpfo: float | None = None,
    bpfi: float | None = None,
    bsf: float | None = None,
    ftf: float | None = None,
    tolerance: float = 0.02,
    band_hz: Sequence[float] | None = None,
    simulated: bool = False,
    machine_class: _MachineClass | None = None,
    sensitivity: str | None = None,
    supply_hz: float | None = None,
    size: bool = False,
    _run: tuple[str, float] | None = None,
) -> Analysis:
    """Which component of a bearing is damaged, by a vibration signal, or that nothing shows it.

    All of `x` is analysed, however long; of a longer file ``brinell analyze`` takes the first 4194304 samples. Memory and time grow with the length: some
    minutes at most say enough. Ctrl-C ends the waiting at once.

    Parameters
    ----------
    x : array_like or Signal
        Samples of one channel, or what `read_signal` gives.
    rate_hz, unit
        As in `psd`; of a `Signal` its own by default.
    speed_rpm : float
        Of the shaft.
    tacho : array_like or Signal, optional
        In place of `speed_rpm`, a channel of pulses of the same length, a tachometer's or an encoder's: rising edges give the speed, which is followed
        where it varies. Its rate is the signal's unless it is a `Signal` of its own.
    pulses : int
        Pulses of `tacho` a turn.
    bearing : str, path or Scenario, optional
        A name that ``brinell analyze --bearing`` takes, ``"unknown"`` where nobody knows it, or a scenario with this bearing, or its file.
    rollers, pitch_mm, diameter_mm, contact_angle_deg : optional
        A bearing by its numbers instead: rolling elements in a row, pitch diameter, their diameter, contact angle (0 by default). The angle also with a
        bearing by name, under its load in place of its own.
    bpfo, bpfi, bsf, ftf : float, optional
        Frequencies as multiples of the shaft's, over those of the bearing.
    tolerance : float
        How far slip and an inexact speed may move a frequency, relative.
    band_hz : (float, float), optional
        Range to demodulate; everything above three times the highest defect frequency by default.
    simulated : bool
        Whether a simulation made the signal, also a row of a data set: where its sensor (that of the scenario given as `bearing`) has no noise, healthy rollers
        that enter the load excite it too, and weak lines of the outer race say less.
    machine_class : str, optional
        Class of ISO 20816-3, for the zone of the RMS velocity: group 1 is above 300 kW, group 2 above 15 to 300 kW.
    sensitivity : str, optional
        Sensor sensitivity, for signals in V or mA, as its data sheet has it: ``100mV/g``, ``4mV/(mm/s)``. The signal is then in g or mm/s.
    supply_hz : float, optional
        Frequency of the motor's supply where an inverter makes it, known to 0.5 %, 1 to 1000: lines at its multiples are excluded. Those of 50 and
        60 Hz by default, where three are present.
    size : bool
        Also estimate how long the damage is along the rolling direction. The bearing's elements need known sizes.

    Raises
    ------
    ValueError
        Where the speed or the bearing is missing, a name or a unit is not known, a sensitivity does not fit the unit, or a value is out of its range.
    SignalError
        Where the signal is too short, its rate too low, or a sample not finite.

    Examples
    --------
    >>> import brinell, numpy as np
    >>> since = np.arange(24000) / 12000.0 % (1.0 / (3.585 * 30.0))
    >>> x = np.exp(-since / 4e-4) * np.sin(6.283 * 3000.0 * since) + 0.05 * np.random.default_rng(1).normal(size=24000)
    >>> found = brinell.analyze(x, rate_hz=12000.0, unit="g", speed_rpm=1800.0, bearing="6205-2RS")
    >>> found.says, found.damage
    ('damage', ['outer_race'])
    >>> round(found.severity["velocity_rms_10_1000_hz"]["value"], 1)
    0.3
    """
    name, scenario = of_bearing(bearing)
    if isinstance(x, Signal):
        rate_hz, unit, x = x.rate_hz if rate_hz is None else rate_hz, x.unit if unit is None else unit, x.values
    samples = samples_of(x)
    elements = None if rollers is None else whole_of(rollers, "rollers", "rolling elements in a row")

    def perhaps(value: float | None, name: str, what: str) -> float | None:
        return None if value is None else number_of(value, name, what)

    train = None
    if tacho is not None:
        tacho_hz, tacho = (tacho.rate_hz, tacho.values) if isinstance(tacho, Signal) else (rate_hz, tacho)
        train = samples_of(tacho), rate_of(tacho_hz), whole_of(pulses, "pulses", "pulses a turn")
    measures = [perhaps(pitch_mm, "pitch_mm", "mm"), perhaps(diameter_mm, "diameter_mm", "mm"), perhaps(contact_angle_deg, "contact_angle_deg", "degrees")]
    given = {"bpfo": bpfo, "bpfi": bpfi, "bsf": bsf, "ftf": ftf}
    report, found, findings = _brinell.analyze(
        samples,
        rate_of(rate_hz),
        unit_of(unit),
        perhaps(speed_rpm, "speed_rpm", "r/min"),
        train,
        name,
        scenario,
        (elements, measures),
        [perhaps(order, key, "a multiple of the shaft's frequency") for key, order in given.items()],
        number_of(tolerance, "tolerance", "a share"),
        band_of(band_hz),
        simulated,
        _run,
        machine_class if machine_class is None else text_of(machine_class, "machine_class", '"2-rigid"'),
        sensitivity if sensitivity is None else text_of(sensitivity, "sensitivity", '"100mV/g"'),
        perhaps(supply_hz, "supply_hz", "Hz"),
        bool(size),
    )
    verdict, unit = report["verdict"], report["signal"]["unit"]
    return Analysis(
        verdict["text"],
        verdict["says"],
        verdict["damage"],
        report["families"],
        report["severity"],
        report["drift"],
        report["flaws"],
        report["size"],
        Spectrum._of(found, unit),
        report,
        findings,
    )
