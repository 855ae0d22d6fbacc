"""Keys over values: many runs, one table."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from brinell import _brinell, plot, tables
from brinell.arguments import jobs_of
from brinell.scenario import Runnable, given, plain, warn

if TYPE_CHECKING:
    import matplotlib.axes
    import pandas
    import polars
    import xarray

_Values = Sequence[Any] | npt.NDArray[Any] | str

__all__ = ["Table", "sweep"]


@dataclass(frozen=True, eq=False)
class Table:
    """A row a point, in the plan's order: what it sets, and every number of its run."""

    keys: list[str]
    """Keys that vary."""
    columns: dict[str, npt.NDArray[Any]]
    """As the command's: ``point`` from 1, settings by key, ``status`` (``complete`` or ``failed``), ``reason`` (None of a complete one), then numbers by
    name (``sensor_ax.rms``, its interval ``.low`` and ``.high``); NaN where a run has none."""
    units: dict[str, str]
    """SI units of the numbers; 1 where there is none."""
    failed: dict[int, str]
    """Why a point failed, by its place from 0."""
    shape: tuple[int, ...]
    """Settings of each axis."""
    warnings: list[str] = field(default_factory=list, repr=False)
    """What ``brinell sweep`` warns of, each kind once, and that points failed."""

    def __getitem__(self, name: str) -> npt.NDArray[Any]:
        """A column."""
        try:
            return self.columns[name]
        except (KeyError, TypeError):
            raise KeyError(f"{name}: no such column{tables.meant(name, self.columns)}") from None

    def __contains__(self, name: object) -> bool:
        """Whether there is a column of this name."""
        return name in list(self.columns)

    def __iter__(self) -> Iterator[str]:
        """Names of the columns."""
        return iter(self.columns)

    def _ipython_key_completions_(self) -> list[str]:
        return list(self.columns)

    def __len__(self) -> int:
        """Points."""
        return int(np.prod(self.shape))

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame; ``attrs["units"]`` has the units."""
        return tables.to_pandas(self.columns, self.units)

    def to_polars(self) -> polars.DataFrame:
        """A data frame."""
        return tables.to_polars(self.columns)

    def to_xarray(self) -> xarray.Dataset:
        """A dimension an axis; of keys that change together the first names it."""
        xr = tables.need("xarray")
        names: list[str] = []
        coordinates: dict[str, Any] = {}
        for place, axis in enumerate(self._axes):
            names.append(axis[0])
            for key in axis:
                grid = self.columns[key].reshape(self.shape)
                first = tuple(slice(None) if k == place else 0 for k in range(len(self.shape)))
                coordinates[key] = (axis[0], grid[first])
        variables = {
            name: (names, values.reshape(self.shape), {"units": self.units[name]})
            for name, values in self.columns.items()
            if name not in coordinates
        }
        dataset: xarray.Dataset = xr.Dataset(variables, coords=coordinates)
        return dataset

    def plot(self, y: str, x: str | None = None, *, ax: Any = None) -> matplotlib.axes.Axes:
        """A number over a key, with its intervals; a line for each value of the other keys.

        Parameters
        ----------
        y : str
            Column.
        x : str, optional
            Key; the first one whose values are numbers by default.
        ax : matplotlib axes, optional
            Where to draw; new ones by default.
        """
        return plot.table(self, y, x, ax=ax)

    def __repr__(self) -> str:
        failed = f", {len(self.failed)} failed" if self.failed else ""
        return f"<brinell.Table: {len(self)} points over {', '.join(self.keys) or 'nothing'}; {len(self.columns)} columns{failed}>"

    _axes: tuple[tuple[str, ...], ...] = ()


def sweep(
    scenario: Runnable,
    vary: Mapping[str, _Values] | None = None,
    *,
    together: Sequence[Mapping[str, _Values]] = (),
    jobs: int | None = None,
    progress: Callable[[int, int], object] | None = None,
    folder: str | os.PathLike[str] | None = None,
) -> Table:
    """Runs every combination of settings side by side. Ctrl-C stops it; with a `folder`, the same call resumes it.

    Parameters
    ----------
    scenario : Scenario or path
        What the settings change.
    vary : mapping of str to sequence, array or str
        Values by dotted path, or text as ``brinell sweep --vary`` has it: ``"900:1800:450"``; the last key changes fastest.
    together : sequence of mappings
        Each mapping's keys change in step: equally many values each.
    jobs : int, optional
        Runs at a time; as many as there are cores by default.
    progress : callable, optional
        Gets how many points are done, and of how many.
    folder : path, optional
        Where finished points are kept, in ``journal.jsonl`` as by ``brinell sweep``: they are not run again. One sweep to a folder.

    Returns
    -------
    Table
        A point that fails is a row with its reason.

    Raises
    ------
    ScenarioError
        Where the scenario of every point is bad.
    ValueError
        Where there is no plan: a key twice, a value twice, too many points. Where the folder is another sweep's, or of another kernel.
    ReadError
        Where the folder's journal cannot be read or written.

    Warns
    -----
    ScenarioWarning
        What ``brinell sweep`` warns of, each kind once, and that points failed: ``warnings`` of the table.

    Examples
    --------
    >>> import brinell
    >>> base = brinell.Scenario.from_toml(brinell.template(), {"simulation.duration_s": 1.0})
    >>> table = brinell.sweep(base, {"operation.speed_rpm": [900.0, 1800.0], "defects.0.depth_um": [1.0, 20.0]})
    >>> table.shape, table["defects.0.depth_um"].tolist()
    ((2, 2), [1.0, 20.0, 1.0, 20.0])
    >>> table.units["sensor_ax.rms"]
    'm/s^2'
    """
    axes: list[tuple[tuple[str, ...], list[list[Any]]]] = []
    for key, values in (vary or {}).items():
        axes.append(((key,), [[value] for value in _listed(key, values)]))
    for step in together:
        keys = tuple(step)
        lists = [_listed(key, step[key]) for key in keys]
        lengths = {len(values) for values in lists}
        if len(lengths) > 1:
            told = ", ".join(f"{key} has {len(values)}" for key, values in zip(keys, lists, strict=True))
            raise ValueError(f"keys that vary together have equally many values; {told}")
        axes.append((keys, [list(setting) for setting in zip(*lists, strict=True)]))
    places, reasons, numbers, warnings = _brinell.sweep(given(scenario)._native, axes, jobs_of(jobs), progress, folder)
    columns: dict[str, npt.NDArray[Any]] = {"point": np.arange(1.0, len(places) + 1.0)}
    for number, (keys, settings) in enumerate(axes):
        for at, key in enumerate(keys):
            columns[key] = _column([settings[place[number]][at] for place in places])
    columns["status"] = _column(["complete" if reason is None else "failed" for reason in reasons])
    columns["reason"] = _column(reasons)
    units = {"point": "1", "status": "", "reason": ""}
    for name, unit, column in numbers:
        columns[name] = column
        units[name] = unit
    failed = {k: reason for k, reason in enumerate(reasons) if reason is not None}
    for k in list(failed)[:1]:
        warnings.append(f"{len(failed)} of {len(reasons)} points failed, the first of them point {k + 1}: {failed[k]}")
    table = Table(
        keys=[key for keys, _ in axes for key in keys],
        columns=columns,
        units=units,
        failed=failed,
        shape=tuple(len(settings) for _, settings in axes),
        warnings=[plain(text) for text in warnings],
        _axes=tuple(keys for keys, _ in axes),
    )
    warn(table.warnings)
    return table


def _listed(key: str, values: _Values) -> list[Any]:
    if isinstance(values, str):
        return _brinell.values(key, values)
    try:
        listed = list(values.tolist()) if isinstance(values, np.ndarray) else list(values)
    except TypeError:
        raise TypeError(f'{key} = {values!r}: expected a list of values, or text such as "900:1800:450" or "5,10,20"') from None
    return [_brinell.in_unit(key, value) if isinstance(value, str) else value for value in listed]


def _column(values: list[Any]) -> npt.NDArray[Any]:
    """Numbers as doubles, words as they are, lists as objects."""
    if all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in values):
        return np.array(values, dtype=float)
    column = np.empty(len(values), dtype=object)
    column[:] = values
    return column
