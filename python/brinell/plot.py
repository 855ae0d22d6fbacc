"""Pictures of results with matplotlib. Each function draws on the axes given, or on new ones, and returns them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

import numpy as np

from brinell import tables

if TYPE_CHECKING:
    import matplotlib.axes

    from brinell.analysis import Analysis
    from brinell.result import Result
    from brinell.signals import Kurtogram, Spectrogram, Spectrum
    from brinell.statics import LoadZone
    from brinell.sweeps import Table

__all__ = ["analysis", "envelope", "kurtogram", "load_zone", "roller_pass", "signal", "spectrogram", "spectrum", "statics", "table"]

LINE = "#1f4e79"
SECOND = "#c0571c"
MARK = "#8a8a8a"


def _axes(ax: Any) -> matplotlib.axes.Axes:
    plt = tables.need("matplotlib.pyplot", "plot")
    if ax is None:
        _, ax = plt.subplots(figsize=(8.0, 3.2), layout="constrained")
    return cast("matplotlib.axes.Axes", ax)


def _plain(ax: matplotlib.axes.Axes, x: str, y: str, title: str) -> matplotlib.axes.Axes:
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.set_title(title, loc="left", fontsize="medium")
    ax.grid(True, color="#e4e4e4", linewidth=0.6)
    ax.set_axisbelow(True)
    ax.spines[["top", "right"]].set_visible(False)
    return ax


def _bare(ax: Any, x: str, y: str) -> matplotlib.axes.Axes:
    """A map: no grid over it."""
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    return cast("matplotlib.axes.Axes", ax)


def _unit(text: str) -> str:
    return text.replace("^2", "²")


def signal(
    result: Result,
    channel: str | None = None,
    *,
    from_s: float | None = None,
    to_s: float | None = None,
    ax: Any = None,
) -> matplotlib.axes.Axes:
    """A channel over time; shaded where a roller is on damage.

    Examples
    --------
    >>> import brinell, brinell.plot
    >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 0.05})
    >>> brinell.plot.signal(brinell.simulate(scenario), "outer_ax").get_xlabel()
    'time (s)'
    """
    ax = _axes(ax)
    if channel is None:
        channel = "sensor_ax" if result.spectrum is None else str(result.spectrum.channel)
        if channel not in result.signals:
            channel = result.channels[-1]
    t, x = result.t, result[channel]
    first = 0.0 if from_s is None else from_s
    last = float(t[-1]) if to_s is None else to_s
    part = (t >= first) & (t <= last)
    for begin, end in _on_damage(result, first, last):
        ax.axvspan(begin, end, color=SECOND, alpha=0.12, linewidth=0)
    ax.plot(t[part], x[part], color=LINE, linewidth=0.8)
    ax.set_xlim(first, last)
    return _plain(ax, "time (s)", f"{channel} ({_unit(result.units[channel])})", result.scenario.name)


#: More passes than that are a blur.
_MOST_SPANS = 40


def _on_damage(result: Result, first: float, last: float) -> list[tuple[float, float]]:
    events = result.events
    begun: dict[tuple[int, int, int], float] = {}
    spans: list[tuple[float, float]] = []
    columns = (events[name] for name in ("t", "defect", "row", "roller", "enters"))
    for t, defect, row, roller, enters in zip(*columns, strict=True):
        which = (int(defect), int(row), int(roller))
        if enters:
            begun[which] = float(t)
        elif which in begun:
            begin = begun.pop(which)
            if begin <= last and t >= first:
                spans.append((begin, float(t)))
    return spans if len(spans) <= _MOST_SPANS else []


def spectrum(of: Spectrum, *, to_hz: float | None = None, ax: Any = None) -> matplotlib.axes.Axes:
    """Amplitude over frequency.

    Examples
    --------
    >>> import brinell, brinell.plot, numpy as np
    >>> lines = brinell.spectrum(np.sin(np.arange(256.0)), rate_hz=256.0, unit="g")
    >>> brinell.plot.spectrum(lines).get_ylabel()
    'amplitude (g)'
    """
    ax = _axes(ax)
    top = float(of.frequency_hz[-1]) if to_hz is None else to_hz
    part = of.frequency_hz <= top
    ax.plot(of.frequency_hz[part], of.amplitude[part], color=LINE, linewidth=0.8)
    ax.set_xlim(0.0, top)
    ax.set_ylim(bottom=0.0)
    return _plain(ax, "frequency (Hz)", f"amplitude ({_unit(of.unit)})", of.channel or "")


def spectrogram(of: Spectrogram, *, ax: Any = None) -> matplotlib.axes.Axes:
    """Density over time and frequency, 80 dB from the strongest down.

    Examples
    --------
    >>> import brinell, brinell.plot, numpy as np
    >>> map_ = brinell.spectrogram(np.sin(np.arange(1024.0)), rate_hz=1024.0, unit="g", length=256)
    >>> brinell.plot.spectrogram(map_).get_ylabel()
    'frequency (Hz)'
    """
    ax = _axes(ax)
    top = max(float(of.density.max(initial=0.0)), np.finfo(float).tiny)
    decibels = 10.0 * np.log10(np.maximum(of.density.T, 1e-8 * top))
    mesh = ax.pcolormesh(of.time_s, of.frequency_hz, decibels, cmap="viridis", shading="nearest", rasterized=True)
    ax.figure.colorbar(mesh, ax=ax, label=f"dB re 1 ({_unit(of.unit)})²/Hz")
    return _bare(ax, "time (s)", "frequency (Hz)")


def kurtogram(of: Kurtogram, *, ax: Any = None) -> matplotlib.axes.Axes:
    """Kurtosis of the envelope in every band; the best one is framed.

    Examples
    --------
    >>> import brinell, brinell.plot, numpy as np
    >>> x = np.random.default_rng(1).normal(size=8192)
    >>> brinell.plot.kurtogram(brinell.kurtogram(x, rate_hz=8192.0)).get_xlabel()
    'frequency (Hz)'
    """
    ax = _axes(ax)
    widths = np.round(of.high_hz - of.low_hz, 6)
    rows = {width: row for row, width in enumerate(sorted(set(widths.tolist()), reverse=True))}
    places = np.array([rows[width] for width in widths.tolist()])
    colours = ax.figure.colorbar(ax.scatter([], [], c=[], cmap="viridis", vmin=0.0, vmax=max(float(of.kurtosis.max()), 1e-9)), ax=ax)
    colours.set_label("kurtosis")
    shade = colours.mappable.to_rgba(of.kurtosis)
    ax.barh(places, of.high_hz - of.low_hz, left=of.low_hz, height=1.0, color=shade, linewidth=0)
    if of.best_hz is not None:
        low, high = of.best_hz
        ax.barh(rows[round(high - low, 6)], high - low, left=low, height=1.0, fill=False, edgecolor=SECOND, linewidth=2.0)
    ax.set_yticks(list(rows.values()), [f"{width:.0f}" for width in rows])
    ax.invert_yaxis()
    ax.margins(x=0.0, y=0.0)
    return _bare(ax, "frequency (Hz)", "width of a band (Hz)")


#: Of what is marked first, second, and so on.
_MARKS = (SECOND, "#3f7d4e", "#7a4f9a")


def _mark(ax: Any, hz: float, label: str, harmonics: int, top: float, place: int = 0) -> None:
    """Harmonics of a frequency; a second one's labels stand below the first one's."""
    across, colour = ax.get_xaxis_transform(), _MARKS[place % len(_MARKS)]
    for k in range(1, harmonics + 1):
        if k * hz > top:
            break
        ax.axvline(k * hz, color=colour, linewidth=0.8, linestyle=(0, (4, 3)), alpha=0.8, zorder=0)
        text = label if k == 1 else f"{k}×"
        ax.text(k * hz, 0.98 - 0.08 * place, f" {text}", transform=across, va="top", fontsize="small", color=colour)


def envelope(result: Result, *, to_hz: float | None = None, harmonics: int = 4, ax: Any = None) -> matplotlib.axes.Axes:
    """The envelope spectrum of a run, with harmonics of the frequencies that its defects are struck with in pure rolling.

    Examples
    --------
    >>> import brinell, brinell.plot
    >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 0.1})
    >>> brinell.plot.envelope(brinell.simulate(scenario)).get_xlabel()
    'frequency (Hz)'
    """
    found = result.envelope
    if found is None:
        raise ValueError("the run is too short for an envelope spectrum")
    struck = {d["frequency"]: d["pure_rolling_hz"] for d in result.defects if d["pure_rolling_hz"]}
    if to_hz is None:
        to_hz = (harmonics + 0.6) * max(struck.values()) if struck else 1000.0
    to_hz = min(to_hz, float(found.frequency_hz[-1]))
    axes = spectrum(found, to_hz=to_hz, ax=ax)
    for place, (name, hz) in enumerate(struck.items()):
        _mark(axes, hz, name, harmonics, to_hz, place)
    low, high = found.band_hz or (0.0, 0.0)
    axes.set_title(f"envelope of {found.channel}, {low / 1e3:.1f} to {high / 1e3:.1f} kHz", loc="left", fontsize="medium")
    return axes


def _polar(ax: Any, title: str) -> matplotlib.axes.Axes:
    ax.set_title(title, loc="left", fontsize="medium")
    ax.grid(True, color="#d8d8d8", linewidth=0.6)
    ax.set_rlabel_position(135)
    ax.set_ylim(bottom=0.0)
    return cast("matplotlib.axes.Axes", ax)


def _polar_axes(ax: Any) -> Any:
    plt = tables.need("matplotlib.pyplot", "plot")
    if ax is not None:
        return ax
    _, ax = plt.subplots(figsize=(4.6, 4.6), layout="constrained", subplot_kw={"projection": "polar"})
    return ax


def _beside(ax: Any) -> None:
    """A legend that covers no angle."""
    ax.legend(loc="upper left", bbox_to_anchor=(-0.12, 0.04), fontsize="small", frameon=False)


def load_zone(result: Result, *, ax: Any = None) -> matplotlib.axes.Axes:
    """Mean force of the outer contacts around the bearing, a line a row.

    Examples
    --------
    >>> import brinell, brinell.plot
    >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 0.1})
    >>> brinell.plot.load_zone(brinell.simulate(scenario)).name
    'polar'
    """
    ax = _polar_axes(ax)
    zone = result.summary["load_zone"]
    angle = np.radians(zone["bin_centers_deg"])
    styles = [(LINE, "-"), (SECOND, "--"), (MARK, ":")]
    for row, forces in enumerate(zone["outer_contacts_by_row"]):
        mean = np.array([np.nan if f is None else f for f in forces["mean_n"]], dtype=float)
        colour, style = styles[row % len(styles)]
        closed = [np.r_[values, values[:1]] for values in (angle, mean)]
        ax.plot(*closed, color=colour, linestyle=style, linewidth=1.2, label=f"row {row + 1}")
    if len(zone["outer_contacts_by_row"]) > 1:
        _beside(ax)
    return _polar(ax, "mean force of outer contacts (N)")


def statics(zone: LoadZone, *, ax: Any = None) -> matplotlib.axes.Axes:
    """Forces of the static balance around the bearing.

    Examples
    --------
    >>> import brinell, brinell.plot
    >>> zone = brinell.static_analysis(brinell.Scenario.from_toml(brinell.template()))
    >>> brinell.plot.statics(zone).name
    'polar'
    """
    ax = _polar_axes(ax)
    angle = np.radians(zone.angle_deg)
    ax.scatter(angle, zone.outer_force_n, s=22, facecolors="none", edgecolors=LINE, linewidths=0.8, label="outer contacts")
    ax.scatter(angle, zone.inner_force_n, s=5, color=SECOND, label="inner contacts", linewidth=0)
    _beside(ax)
    return _polar(ax, "static contact forces (N)")


def roller_pass(result: Result, defect: int = 1, *, ax: Any = None) -> matplotlib.axes.Axes:
    """Contact force and effective length as a roller passes a defect: the heaviest pass.

    Examples
    --------
    >>> import brinell, brinell.plot
    >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 0.1})
    >>> brinell.plot.roller_pass(brinell.simulate(scenario)).get_ylabel()
    'contact force (N)'
    """
    passes = [p for p in result.passes if p["defect"] == defect]
    if not passes:
        raise ValueError(f"defect = {defect}: no roller passed it\n  allowed: 1 to {len(result.defects)}, the scenario's defects")
    left = _axes(ax)
    shown = passes[0]
    order = np.argsort(shown["t"])
    ms = 1e3 * (shown["t"][order] - shown["t"][order][0])
    left.plot(ms, shown["force_n"][order], color=LINE, linewidth=1.2)
    title = f"roller {shown['roller']} of row {shown['row']} over defect {defect}"
    _plain(left, "time (ms)", "contact force (N)", title)
    left.yaxis.label.set_color(LINE)
    left.set_ylim(bottom=0.0)
    left.set_xlim(ms[0], ms[-1])
    right = left.twinx()
    right.plot(ms, shown["effective_length_mm"][order], color=SECOND, linewidth=1.2, linestyle="--")
    right.set_ylabel("effective length (mm)", color=SECOND)
    right.set_ylim(bottom=0.0)
    right.spines["top"].set_visible(False)
    return left


def analysis(of: Analysis, *, to_hz: float | None = None, ax: Any = None) -> matplotlib.axes.Axes:
    """The envelope spectrum of an analysis, with the causes that were found.

    Examples
    --------
    >>> import brinell, brinell.plot, numpy as np
    >>> x = np.random.default_rng(1).normal(size=24000)
    >>> found = brinell.analyze(x, rate_hz=12000.0, unit="g", speed_rpm=1800.0, bearing="6205-2RS")
    >>> brinell.plot.analysis(found).get_ylabel()
    'amplitude (g)'
    """
    axes = spectrum(of.envelope, to_hz=to_hz, ax=ax)
    top = axes.get_xlim()[1]
    causes = [family for family in of.families if family["says"] == "damage"]
    for place, cause in enumerate(causes):
        _mark(axes, cause["found_hz"], cause["name"], 5, top, place)
    low, high = of.envelope.band_hz or (0.0, 0.0)
    axes.set_title(f"envelope, {low / 1e3:.1f} to {high / 1e3:.1f} kHz", loc="left", fontsize="medium")
    return axes


def table(of: Table, y: str, x: str | None = None, *, ax: Any = None) -> matplotlib.axes.Axes:
    """A number of a sweep over a key, with its intervals; a line for each value of the other keys.

    Examples
    --------
    >>> import brinell, brinell.plot
    >>> base = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 0.1})
    >>> swept = brinell.sweep(base, {"operation.speed_rpm": [900.0, 1800.0]})
    >>> brinell.plot.table(swept, "sensor_ax.rms").get_xlabel()
    'operation.speed_rpm'
    """
    if y not in of.columns:
        near = [name for name in of.columns if y.split(".")[-1] == name.split(".")[-1]]
        near = sorted(near or of.units, key=lambda name: not name.startswith("sensor"))[:8]
        raise ValueError(f"y = {y}: no such column\n  allowed: the columns of the table, such as {', '.join(near)}")
    numbers = [key for key in of.keys if of.columns[key].dtype != object]
    if x is None:
        x = (numbers or of.keys)[0]
    ax = _axes(ax)
    others = [key for key in of.keys if key != x]
    groups: dict[str, list[int]] = {}
    for k in range(len(of)):
        label = ", ".join(f"{key} = {of.columns[key][k]}" for key in others)
        groups.setdefault(label, []).append(k)
    # Lines that lie on each other are still told apart.
    styles = ("-", "--", ":", "-.")
    for number, (label, points) in enumerate(groups.items()):
        at, value = of.columns[x][points], of.columns[y][points]
        error = None
        if f"{y}.low" in of.columns:
            ends = of.columns[f"{y}.low"][points], of.columns[f"{y}.high"][points]
            # The interval's own middle differs from the whole run's value.
            error = np.clip([value - ends[0], ends[1] - value], 0.0, None)
        style = styles[number % len(styles)]
        ax.errorbar(at, value, yerr=error, marker="o", markersize=3.5, linestyle=style, linewidth=1.2, capsize=2.5, label=label or None)
    if len(groups) > 1:
        ax.legend(fontsize="small", frameon=False)
    unit = of.units.get(y, "1")
    return _plain(ax, x, y if unit == "1" else f"{y} ({_unit(unit)})", "")
