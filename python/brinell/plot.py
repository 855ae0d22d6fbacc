"""Pictures of results with matplotlib: those of the command's reports, with their quantities, marks and axis names.

Each function draws on the axes given, or on new ones, and returns them.
"""

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

#: Okabe and Ito's colours, as the reports have them.
LINE = "#0072B2"
SECOND = "#D55E00"
GREEN = "#009E73"
BLACK = "#1b1f24"
FAINT = "#68727d"
#: Shades from least to most.
_STOPS = ((250, 251, 253), (205, 222, 240), (140, 184, 222), (66, 134, 190), (20, 78, 140), (8, 26, 58))


def _axes(ax: Any, height: float = 3.2) -> matplotlib.axes.Axes:
    plt = tables.need("matplotlib.pyplot")
    if ax is None:
        _, ax = plt.subplots(figsize=(8.0, height), layout="constrained")
    return cast("matplotlib.axes.Axes", ax)


def _shades() -> Any:
    colors = tables.need("matplotlib.colors")
    return colors.LinearSegmentedColormap.from_list("brinell", [tuple(part / 255 for part in stop) for stop in _STOPS])


def _time(span: float) -> tuple[str, float]:
    """Seconds or milliseconds, whichever reads better, and how many go into a second."""
    return ("s", 1.0) if span >= 0.5 else ("ms", 1e3)


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
    """A channel over time; lines where a roller enters damage, dashed ones where it leaves.

    Examples
    --------
    >>> import brinell, brinell.plot
    >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
    >>> brinell.plot.signal(brinell.simulate(scenario), "outer_ax").get_xlabel()
    'Time (s)'
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
    unit, scale = _time(last - first)
    ax.plot(scale * t[part], x[part], color=LINE, linewidth=0.8)
    ax.set_xlim(scale * first, scale * last)
    entries, exits = _passes(result, first, last)
    ax.vlines(scale * entries, 0.0, 1.0, transform=ax.get_xaxis_transform(), color=SECOND, linewidth=0.8, alpha=0.75)
    ax.vlines(
        scale * exits, 0.0, 1.0, transform=ax.get_xaxis_transform(), color=GREEN, linewidth=0.8, alpha=0.75, linestyle=(0, (5, 3))
    )
    return _plain(ax, f"Time ({unit})", f"{channel} ({_unit(result.units[channel])})", result.scenario.name)


#: More passes than that are a blur.
_MOST_PASSES = 40


def _passes(result: Result, first: float, last: float) -> tuple[Any, Any]:
    """When rollers enter damage and when they leave it, s."""
    t, enters = result.events["t"], result.events["enters"].astype(bool)
    seen = (t >= first) & (t <= last)
    if np.count_nonzero(seen & enters) > _MOST_PASSES:
        seen = np.zeros_like(seen)
    return t[seen & enters], t[seen & ~enters]


def _amplitude(unit: str) -> str:
    return f"Acceleration amplitude ({_unit(unit)})" if unit == "m/s^2" else f"Amplitude ({_unit(unit)})"


def spectrum(of: Spectrum, *, to_hz: float | None = None, ax: Any = None) -> matplotlib.axes.Axes:
    """Amplitude over frequency, the largest of it on a logarithmic axis.

    Examples
    --------
    >>> import brinell, brinell.plot, numpy as np
    >>> lines = brinell.spectrum(np.sin(np.arange(256.0)), rate_hz=256.0, unit="g")
    >>> brinell.plot.spectrum(lines).get_ylabel()
    'Amplitude (g)'
    """
    ax = _axes(ax)
    top = float(of.frequency_hz[-1]) if to_hz is None else to_hz
    part = of.frequency_hz <= top
    ax.plot(of.frequency_hz[part], of.amplitude[part], color=LINE, linewidth=0.8)
    ax.set_xlim(0.0, top)
    positive = of.amplitude[part][of.amplitude[part] > 0.0]
    if len(positive):
        # Whole decades, from the bulk of the lines on, six at most.
        high = np.log10(positive.max())
        low = min(max(np.floor(np.log10(np.quantile(positive, 0.05))), np.floor(high) - 5.0), np.floor(high) - 1.0)
        ax.set_yscale("log")
        ax.set_ylim(10.0**low, 10.0 ** (high + 0.1))
    return _plain(ax, "Frequency (Hz)", _amplitude(of.unit), of.channel or "")


def _lines(of: Spectrum, label: str, to_hz: float | None, ax: Any) -> matplotlib.axes.Axes:
    """Amplitude from zero on; the line at 0 Hz, the mean of an envelope, does not set the scale."""
    ax = _axes(ax, 4.2)
    top = float(of.frequency_hz[-1]) if to_hz is None else to_hz
    part = of.frequency_hz <= top
    ax.plot(of.frequency_hz[part], of.amplitude[part], color=LINE, linewidth=0.8)
    ax.set_xlim(0.0, top)
    highest = float(of.amplitude[part][1:].max(initial=0.0))
    ax.set_ylim(0.0, 1.08 * highest if highest > 0.0 else 1.0)
    return _plain(ax, "Frequency (Hz)", f"{label} ({_unit(of.unit)})", of.channel or "")


#: From the strongest down, at most.
_RANGE_DB = 60.0


def spectrogram(of: Spectrogram, *, ax: Any = None) -> matplotlib.axes.Axes:
    """Density over time and frequency.

    Examples
    --------
    >>> import brinell, brinell.plot, numpy as np
    >>> map_ = brinell.spectrogram(np.sin(np.arange(1024.0)), rate_hz=1024.0, unit="g", length=256)
    >>> brinell.plot.spectrogram(map_).get_ylabel()
    'Frequency (Hz)'
    """
    ax = _axes(ax)
    unit, scale = _time(float(of.time_s[-1] - of.time_s[0])) if len(of.time_s) else ("s", 1.0)
    decibels = 10.0 * np.log10(np.maximum(of.density.T, np.finfo(float).tiny))
    # The scale's foot follows the bulk, not the deepest notch.
    high = 5.0 * np.ceil(decibels.max() / 5.0)
    low = np.clip(5.0 * np.floor(np.quantile(decibels, 0.02) / 5.0), high - _RANGE_DB, high - 10.0)
    shades = {"cmap": _shades(), "vmin": low, "vmax": high}
    mesh = ax.pcolormesh(scale * of.time_s, of.frequency_hz, decibels, shading="nearest", rasterized=True, **shades)
    ax.figure.colorbar(mesh, ax=ax, label=f"dB re 1 ({_unit(of.unit)})²/Hz")
    return _bare(ax, f"Time ({unit})", "Frequency (Hz)")


def kurtogram(of: Kurtogram, *, ax: Any = None) -> matplotlib.axes.Axes:
    """Kurtosis of the envelope in every band; the best one is framed.

    Examples
    --------
    >>> import brinell, brinell.plot, numpy as np
    >>> x = np.random.default_rng(1).normal(size=8192)
    >>> brinell.plot.kurtogram(brinell.kurtogram(x, rate_hz=8192.0)).get_xlabel()
    'Frequency (Hz)'
    """
    ax = _axes(ax)
    widths = np.round(of.high_hz - of.low_hz, 6)
    rows = {width: row for row, width in enumerate(sorted(set(widths.tolist()), reverse=True))}
    places = np.array([rows[width] for width in widths.tolist()])
    colours = ax.figure.colorbar(ax.scatter([], [], c=[], cmap=_shades(), vmin=0.0, vmax=max(float(of.kurtosis.max()), 1e-9)), ax=ax)
    colours.set_label("kurtosis")
    shade = colours.mappable.to_rgba(of.kurtosis)
    ax.barh(places + 0.5, of.high_hz - of.low_hz, left=of.low_hz, height=1.0, color=shade, linewidth=0)
    if of.best_hz is not None:
        low, high = of.best_hz
        ax.barh(rows[round(high - low, 6)] + 0.5, high - low, left=low, height=1.0, fill=False, edgecolor=SECOND, linewidth=2.0)
    ax.margins(x=0.0, y=0.0)
    return _bare(ax, "Frequency (Hz)", "Level")


#: Of what is marked first, second, and so on.
_MARKS = (SECOND, GREEN, "#CC79A7", "#E69F00", "#56B4E9", BLACK)
#: Height of a line of marks, points.
_LANE = 11.0


def _lanes(ax: Any, marks: list[tuple[str, float, bool, str]], harmonics: int) -> None:
    """Harmonics of each frequency on a line of their own above the plot; those of damage run down through it. Behind the frequency stands what it is."""
    top = ax.get_xlim()[1]
    for k, (label, hz, through, what) in enumerate(reversed(marks)):
        colour = _MARKS[(len(marks) - 1 - k) % len(_MARKS)]
        words = BLACK if through else FAINT
        lane = {"xycoords": "axes fraction", "textcoords": "offset points", "va": "center", "fontsize": "small", "annotation_clip": False}
        height = 6.0 + _LANE * k
        ax.annotate(label, (0.0, 1.0), (-6.0, height), ha="right", color=words, fontweight="bold", **lane)
        ax.annotate(f"{hz:.4g} Hz{what}", (1.0, 1.0), (6.0, height), color=words, **lane)
        for n in range(1, harmonics + 1):
            if n * hz > top:
                break
            place = (n * hz / top, 1.0)
            ax.annotate("|", place, (0.0, height), ha="center", color=colour, alpha=1.0 if through else 0.6, **lane)
            if through:
                if n > 1:
                    ax.annotate(f"×{n}", place, (3.0, height), color=words, **lane)
                ax.axvline(n * hz, color=colour, linewidth=0.8, linestyle=(0, (4, 3)), alpha=0.75)


def _titled(ax: Any, title: str, lanes: int) -> None:
    """A title over the lines of marks."""
    ax.set_title(title, loc="left", fontsize="medium", pad=6.0 + _LANE * lanes)


#: What a report marks, and what a summary calls it.
_FREQUENCIES = {"BPFO": "bpfo", "BPFI": "bpfi", "2 BSF": "2bsf", "FTF": "ftf", "shaft": "shaft"}


def envelope(result: Result, *, to_hz: float | None = None, harmonics: int = 5, ax: Any = None) -> matplotlib.axes.Axes:
    """The envelope spectrum of a run; above it the harmonics of every defect frequency, those of its damage dashed through it.

    The frequency of damage is the one that was found in the envelope, where one was; the others are of pure rolling.

    Examples
    --------
    >>> import brinell, brinell.plot
    >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
    >>> brinell.plot.envelope(brinell.simulate(scenario)).get_xlabel()
    'Frequency (Hz)'
    """
    found = result.envelope
    if found is None:
        raise ValueError("the run is too short for an envelope spectrum")
    damage = {d["line"]["name"] for d in result.defects if "line" in d}
    hertz = result.summary["defect_frequencies"]["hz"] or {}
    lines = ((d["line"]["name"], result.quantities.get(f"defect{k}.frequency", np.nan)) for k, d in enumerate(result.defects, 1) if "line" in d)
    seen = {name: hz for name, hz in lines if np.isfinite(hz)}
    marks = [
        (label, seen.get(label, hertz[key]), label in damage, " found" if label in seen else ", pure rolling")
        for label, key in _FREQUENCIES.items()
        if hertz.get(key)
    ]
    if to_hz is None:
        there = [hz for _, hz, through, _ in marks if through] or [hz for _, hz, *_ in marks]
        to_hz = (harmonics + 0.5) * max(there) if there else float(found.frequency_hz[-1])
    axes = _lines(found, "Envelope amplitude", min(to_hz, float(found.frequency_hz[-1])), ax)
    _lanes(axes, marks, harmonics)
    low, high = found.band_hz or (0.0, 0.0)
    _titled(axes, f"{found.channel}, {low / 1e3:.1f} to {high / 1e3:.1f} kHz", len(marks))
    return axes


def _polar(ax: Any, title: str) -> matplotlib.axes.Axes:
    ax.set_title(title, loc="left", fontsize="medium")
    ax.grid(True, color="#d8d8d8", linewidth=0.6)
    ax.set_rlabel_position(135)
    ax.set_ylim(bottom=0.0)
    return cast("matplotlib.axes.Axes", ax)


def _polar_axes(ax: Any) -> Any:
    plt = tables.need("matplotlib.pyplot")
    if ax is not None:
        return ax
    _, ax = plt.subplots(figsize=(4.6, 4.6), layout="constrained", subplot_kw={"projection": "polar"})
    return ax


def _beside(ax: Any) -> None:
    """A legend that covers no angle."""
    ax.legend(loc="upper left", bbox_to_anchor=(-0.12, 0.04), fontsize="small", frameon=False)


def load_zone(result: Result, *, row: int = 1, ax: Any = None) -> matplotlib.axes.Axes:
    """Force at the outer contacts of a row around the bearing: mean, largest, and that of static equilibrium.

    Examples
    --------
    >>> import brinell, brinell.plot
    >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
    >>> brinell.plot.load_zone(brinell.simulate(scenario)).name
    'polar'
    """
    from brinell.statics import static_analysis

    zone = result.summary["load_zone"]
    rows = zone["outer_contacts_by_row"]
    if not 1 <= row <= len(rows):
        raise ValueError(f"row = {row}: no such row\n  allowed: 1 to {len(rows)}")
    ax = _polar_axes(ax)
    angle = np.radians(zone["bin_centers_deg"])

    def around(angles: Any, forces: Any, **style: Any) -> None:
        values = np.array([0.0 if f is None else f for f in forces], dtype=float)
        ax.plot(np.r_[angles, angles[:1]], np.r_[values, values[:1]], linewidth=1.2, **style)

    mean = rows[row - 1]["mean_n"]
    ax.fill(angle, [f or 0.0 for f in mean], color=LINE, alpha=0.18, linewidth=0)
    around(angle, rows[row - 1]["max_n"], color=SECOND, linestyle=(0, (5, 3)), label="largest force")
    around(angle, mean, color=LINE, label="mean force")
    if zone["static"] is not None:
        rest = static_analysis(result.scenario)
        there = rest.row == row
        order = np.argsort(rest.angle_deg[there])
        at, forces = np.radians(rest.angle_deg[there][order]), rest.outer_force_n[there][order]
        around(at, forces, color=BLACK, linestyle=":", label="static equilibrium")
    _beside(ax)
    return _polar(ax, f"Row {row}, force at the outer contact (N)")


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
    """Contact length, stiffness and force as a roller passes a defect: the heaviest pass.

    Three panels, in place of the axes given; the lowest is returned.

    Examples
    --------
    >>> import brinell, brinell.plot
    >>> scenario = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
    >>> brinell.plot.roller_pass(brinell.simulate(scenario)).get_ylabel()
    'Force (N)'
    """
    passes = [p for p in result.passes if p["defect"] == defect]
    if not passes:
        raise ValueError(f"defect = {defect}: no roller passed it\n  allowed: 1 to {len(result.defects)}, the scenario's defects")
    shown = passes[0]
    plt = tables.need("matplotlib.pyplot")
    if ax is None:
        figure, panels = plt.subplots(3, 1, sharex=True, figsize=(8.0, 5.2), layout="constrained")
    else:
        figure, place = ax.figure, ax.get_subplotspec()
        if place is None:
            raise ValueError("ax: needed is one of a grid, such as plt.subplots gives")
        ax.remove()
        panels = place.subgridspec(3, 1).subplots(sharex=True)
    unit = shown["stiffness_unit"].replace("^(10/9)", "$^{10/9}$").replace("^n", "$^n$")
    columns = (("effective_length_mm", "Contact length (mm)"), ("stiffness", f"Stiffness ({unit})"), ("force_n", "Force (N)"))
    for panel, (name, label) in zip(panels, columns, strict=True):
        panel.plot(shown["angle_deg"], shown[name], color=LINE, linewidth=1.2)
        _plain(panel, "", label, "")
        panel.set_ylim(bottom=0.0)
    panels[0].set_title(f"Roller {shown['roller']} of row {shown['row']} over defect {defect}", loc="left", fontsize="medium")
    panels[-1].set_xlabel("Angle from the defect's centre (°)")
    panels[-1].margins(x=0.0)
    return cast("matplotlib.axes.Axes", panels[-1])


def analysis(of: Analysis, *, to_hz: float | None = None, ax: Any = None) -> matplotlib.axes.Axes:
    """The envelope spectrum of an analysis; above it the harmonics of every family, those of damage dashed through it.

    Examples
    --------
    >>> import brinell, brinell.plot, numpy as np
    >>> x = np.random.default_rng(1).normal(size=24000)
    >>> found = brinell.analyze(x, rate_hz=12000.0, unit="g", speed_rpm=1800.0, bearing="6205-2RS")
    >>> brinell.plot.analysis(found).get_ylabel()
    'Envelope amplitude (g)'
    """
    axes = _lines(of.envelope, "Envelope amplitude", to_hz, ax)
    marks = [(f["name"], f["found_hz"], f["says"] == "damage", "") for f in of.families if f.get("found_hz")]
    _lanes(axes, marks, 5)
    low, high = of.envelope.band_hz or (0.0, 0.0)
    _titled(axes, f"{low / 1e3:.1f} to {high / 1e3:.1f} kHz", len(marks))
    return axes


def table(of: Table, y: str, x: str | None = None, *, ax: Any = None) -> matplotlib.axes.Axes:
    """A number of a sweep over a key, with its intervals; a line for each value of the other keys.

    Examples
    --------
    >>> import brinell, brinell.plot
    >>> base = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
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
