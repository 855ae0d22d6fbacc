"""Vibration of rolling bearings with real damage, from first principles.

A `Scenario` says what a bearing, its damage and its operation are; `simulate` gives the signals that sensors would see, and what was found in
them. Units are in the names of keys, columns and arguments, as in the scenario file; signals are SI. Angles count counter-clockwise from +x.

Examples
--------
>>> import brinell
>>> scenario = brinell.Scenario(
...     bearing="NN3007",
...     operation={"speed_rpm": 1800.0, "load_n": [300.0, 0.0]},
...     defects=[brinell.rectangle(length_mm=3.0, width_mm=4.0, depth_um=20.0)],
...     simulation={"duration_s": 1.0, "sample_rate_hz": 25600.0},
... )
>>> result = brinell.simulate(scenario)
>>> result.settled["sensor_ax"].shape  # without the start of the run
(24235,)
>>> round(result.summary["defect_frequencies"]["hz"]["bpfo"], 1)
250.1
"""

from brinell._brinell import ReadError, RunError, ScenarioError, SignalError, __version__
from brinell.analysis import Analysis, analyze
from brinell.calibrations import Calibration, calibrate
from brinell.comparisons import Comparison, compare
from brinell.damage import circle, defect, depth_map, image, outline, rectangle, svg
from brinell.datasets import DataSet, Plan
from brinell.notebook import studio
from brinell.result import Result, Settled
from brinell.runs import simulate, simulate_many
from brinell.scenario import Scenario, ScenarioWarning, bearings, schema, template
from brinell.signals import (
    Kurtogram,
    Signal,
    Spectrogram,
    Spectrum,
    envelope,
    envelope_spectrum,
    indicators,
    kurtogram,
    psd,
    read_signal,
    spectrogram,
    spectrum,
)
from brinell.statics import LoadZone, Pressure, derived, frequencies, pressures, static_analysis
from brinell.sweeps import Table, sweep

__all__ = [
    "Analysis",
    "Calibration",
    "Comparison",
    "DataSet",
    "Kurtogram",
    "LoadZone",
    "Plan",
    "Pressure",
    "ReadError",
    "Result",
    "RunError",
    "Scenario",
    "ScenarioError",
    "ScenarioWarning",
    "Settled",
    "Signal",
    "SignalError",
    "Spectrogram",
    "Spectrum",
    "Table",
    "__version__",
    "analyze",
    "bearings",
    "calibrate",
    "circle",
    "compare",
    "defect",
    "depth_map",
    "derived",
    "envelope",
    "envelope_spectrum",
    "frequencies",
    "image",
    "indicators",
    "kurtogram",
    "outline",
    "pressures",
    "psd",
    "read_signal",
    "rectangle",
    "schema",
    "simulate",
    "simulate_many",
    "spectrogram",
    "spectrum",
    "static_analysis",
    "studio",
    "svg",
    "sweep",
    "template",
]
