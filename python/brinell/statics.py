"""What follows from a scenario before anything moves."""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brinell import _brinell, plot, tables
from brinell.arguments import number_of, whole_of
from brinell.scenario import Runnable, Scenario, given, of_bearing

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas

__all__ = ["LoadZone", "Pressure", "derived", "frequencies", "pressures", "static_analysis"]


@dataclass(frozen=True, eq=False)
class LoadZone:
    """Load distribution of the static balance, the rollers at several positions of the cage."""

    row: npt.NDArray[np.int64]
    """Row of each point, from 1."""
    angle_deg: npt.NDArray[np.float64]
    """Angle of the roller, -180 to 180."""
    inner_force_n: npt.NDArray[np.float64]
    outer_force_n: npt.NDArray[np.float64]
    largest_contact_force_n: float
    extent_deg: float
    """Where rolling elements of the bearing without its damage carry load between the raceways; one whose own weight rests on the inner ring carries none."""
    shift_inner_to_outer_um: list[float]
    """Mean offset (x, y), inner ring less outer."""
    stiffness_n_per_m: list[list[float]]
    """Of the bearing between its rings."""

    def to_pandas(self) -> pandas.DataFrame:
        """A row a roller and position."""
        columns = {name: getattr(self, name) for name in ("row", "angle_deg", "inner_force_n", "outer_force_n")}
        return tables.to_pandas(columns, {"row": "1", "angle_deg": "deg", "inner_force_n": "N", "outer_force_n": "N"})

    def plot(self, *, ax: Any = None) -> matplotlib.axes.Axes:
        """Forces on polar axes."""
        return plot.statics(self, ax=ax)

    def __repr__(self) -> str:
        return f"<brinell.LoadZone: up to {self.largest_contact_force_n:.4g} N over {self.extent_deg:.4g} degrees>"


def static_analysis(scenario: Runnable) -> LoadZone:
    """Load distribution, ring shift and stiffness under the full load, as the cage turns through a pitch.

    Parameters
    ----------
    scenario : Scenario or path
        Damage counts as it lies.

    Raises
    ------
    ScenarioError
        Where the rings are not held against the load.

    Examples
    --------
    >>> import brinell
    >>> scenario = brinell.Scenario(bearing="NU205", operation={"speed_rpm": 1500.0, "load_n": [1000.0, 0.0]})
    >>> zone = brinell.static_analysis(scenario)
    >>> zone.extent_deg < 180.0 < zone.largest_contact_force_n
    True
    """
    return LoadZone(**_brinell.statics(given(scenario)._native))


@dataclass(frozen=True, eq=False)
class Pressure:
    """Pressures in one contact over damage, where they are largest while the contact, held at the static deformation, passes it."""

    contact: str
    """``"outer"`` or ``"inner"``."""
    s_mm: npt.NDArray[np.float64]
    """Along the damaged surface, from the defect's centre."""
    z_mm: npt.NDArray[np.float64]
    """Across."""
    pressure_mpa: npt.NDArray[np.float64]
    """Mean over each cell, a row each ``z_mm``. Elastic: at sharp edges it grows as cells shrink."""
    largest_pressure_mpa: float
    at_mm: list[float]
    """(s, z) of the largest."""
    contact_at_s_mm: float
    """Of the contact's middle."""
    deformation_um: float
    force_n: float
    healthy_pressure_mpa: float
    """The largest without damage."""
    yield_begins_at_mpa: float
    """Largest pressure of a smooth contact at which bearing steel begins to yield, with a yield strength of 1.9 GPa assumed."""
    share_beyond_yield: float
    """Of the pressed area."""
    note: str
    """All of that in words."""

    def __repr__(self) -> str:
        return f"<brinell.Pressure: {self.contact} contact, up to {self.largest_pressure_mpa:.4g} MPa>"


def pressures(scenario: Runnable, defect: int = 1) -> list[Pressure]:
    """Pressures over damage, one a contact that meets it: of damage on a rolling element two.

    Parameters
    ----------
    scenario : Scenario or path
        Empty where its law is not ``"half-space"`` or the damage's table is from elsewhere.
    defect : int, optional
        Which of its defects, from 1.

    Examples
    --------
    >>> import brinell
    >>> pit = brinell.circle(diameter_mm=0.2, depth_um=100.0)
    >>> operation = {"speed_rpm": 1500.0, "load_n": [500.0, 0.0]}
    >>> over = brinell.pressures(brinell.Scenario(bearing="6205", operation=operation, defects=[pit]))[0]
    >>> over.pressure_mpa.shape == (over.z_mm.size, over.s_mm.size)
    True
    >>> over.largest_pressure_mpa > over.healthy_pressure_mpa
    True
    """
    found = _brinell.pressures(given(scenario)._native, whole_of(defect, "defect", "a defect, counted from 1"))
    shape = [(of["z_mm"].size, of["s_mm"].size) for of in found]
    return [Pressure(**{**of, "pressure_mpa": of["pressure_mpa"].reshape(s)}) for of, s in zip(found, shape, strict=True)]


def derived(scenario: Runnable) -> dict[str, Any]:
    """What ``brinell check`` prints: frequencies, stiffnesses, contact pressure, time scales, the longest step; ``slices`` (where
    contacts have them) with load, stiffness and life by ISO/TS 16281; ``warnings`` about what may not be meant.

    Examples
    --------
    >>> import brinell
    >>> values = brinell.derived(brinell.Scenario.from_toml(brinell.template()))
    >>> values["longest_step_s"] < values["roller_period_s"]
    True
    """
    return _brinell.derived(given(scenario)._native)


def frequencies(bearing: str | os.PathLike[str] | Scenario, speed_rpm: float | None = None) -> dict[str, float]:
    """Shaft, cage and defect frequencies in pure rolling, Hz.

    Parameters
    ----------
    bearing : str, path or Scenario
        A bearing by name (``brinell bearing list``), a scenario, or a scenario's file.
    speed_rpm : float, optional
        Needed with a name; the scenario's own by default.

    Examples
    --------
    >>> import brinell
    >>> round(brinell.frequencies("NN3007", 1800.0)["bpfo"], 2)
    250.1
    """
    name, of = of_bearing(bearing)
    return _brinell.frequencies(name, of, None if speed_rpm is None else number_of(speed_rpm, "speed_rpm", "r/min"))
