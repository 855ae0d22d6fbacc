"""Columns to pandas, polars and xarray, each where it is installed."""

from __future__ import annotations

import difflib
import importlib
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import pandas
    import polars
    import xarray

__all__ = ["columns", "meant", "need", "to_pandas", "to_polars", "to_xarray"]


def need(library: str) -> Any:
    """A library that brinell does without, or an error that says how to get it.

    Parameters
    ----------
    library : str
        What is imported.

    Raises
    ------
    ImportError
        Where it is not installed.

    Examples
    --------
    >>> from brinell.tables import need
    >>> need("json").dumps([1])
    '[1]'
    >>> need("no_such_library")
    Traceback (most recent call last):
    ...
    ImportError: this needs no_such_library: pip install no_such_library
    """
    try:
        return importlib.import_module(library)
    except ModuleNotFoundError as error:
        name = library.split(".")[0]
        if error.name is not None and error.name.split(".")[0] != name:
            raise
        raise ImportError(f"this needs {name}: pip install {name}") from None


def meant(name: object, names: Iterable[str]) -> str:
    """What is said after a name that is none of `names`: the one that it most likely means, or nothing.

    Examples
    --------
    >>> from brinell.tables import meant
    >>> meant("sensor_ax.rmss", ["sensor_ax.rms", "t"])
    ', did you mean "sensor_ax.rms"?'
    """
    near = difflib.get_close_matches(str(name), list(names), n=1)
    return f', did you mean "{near[0]}"?' if near else ""


def columns(found: Sequence[tuple[str, str, Any]]) -> dict[str, Any]:
    """Columns by name: numbers as they are, words as arrays of objects.

    Examples
    --------
    >>> from brinell.tables import columns
    >>> columns([("stage", "", ["start", None])])["stage"].dtype
    dtype('O')
    """
    return {name: np.array(cells, dtype=object) if isinstance(cells, list) else cells for name, _, cells in found}


def to_pandas(columns: Mapping[str, Any], units: Mapping[str, str]) -> pandas.DataFrame:
    """A data frame on the memory of the columns; units are in ``attrs["units"]``.

    Examples
    --------
    >>> import numpy as np
    >>> from brinell.tables import to_pandas
    >>> frame = to_pandas({"t": np.array([0.0, 0.1]), "x": np.array([1.0, 2.0])}, {"t": "s", "x": "m"})
    >>> list(frame.columns), frame.attrs["units"]["x"]
    (['t', 'x'], 'm')
    """
    pd = need("pandas")
    frame: pandas.DataFrame = pd.DataFrame(dict(columns), copy=False)
    frame.attrs["units"] = dict(units)
    return frame


def to_polars(columns: Mapping[str, Any]) -> polars.DataFrame:
    """A data frame of the columns. Polars keeps no units.

    Examples
    --------
    >>> import numpy as np
    >>> from brinell.tables import to_polars
    >>> to_polars({"t": np.array([0.0, 0.1])}).shape
    (2, 1)
    """
    pl = need("polars")
    # As lists words and empty cells are words of polars, and not objects.
    cells = {name: values.tolist() if getattr(values, "dtype", None) == object else values for name, values in columns.items()}
    frame: polars.DataFrame = pl.DataFrame(cells, strict=False)
    return frame


def to_xarray(
    columns: Mapping[str, Any],
    units: Mapping[str, str],
    along: str,
    attributes: Mapping[str, Any] | None = None,
) -> xarray.Dataset:
    """A data set along one column, each variable with its unit.

    Parameters
    ----------
    columns : mapping of str to array
        Names to values of one length.
    units : mapping of str to str
        Names to units.
    along : str
        The column that is the coordinate.
    attributes : mapping, optional
        Of the whole.

    Examples
    --------
    >>> import numpy as np
    >>> from brinell.tables import to_xarray
    >>> to_xarray({"t": np.array([0.0, 0.1]), "x": np.array([1.0, 2.0])}, {"x": "m"}, "t").x.attrs
    {'units': 'm'}
    """
    xr = need("xarray")
    variables = {
        name: (along, np.asarray(values), {"units": units[name]} if name in units else {})
        for name, values in columns.items()
    }
    coordinate = {along: variables.pop(along)}
    dataset: xarray.Dataset = xr.Dataset(variables, coords=coordinate, attrs=dict(attributes or {}))
    return dataset
