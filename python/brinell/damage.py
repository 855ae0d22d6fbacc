"""Damage as the scenario file's ``[[defects]]`` entries: from measures, polygons, arrays and files.

The length of a defect runs along s, counter-clockwise around the damaged surface, its width along the axis (z), both from the defect's centre.
"""

from __future__ import annotations

import os
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from brinell.arguments import masked_values, number_of

__all__ = ["circle", "defect", "depth_map", "image", "outline", "rectangle", "svg"]

if TYPE_CHECKING:
    _Surface = Literal["outer-raceway", "inner-raceway", "roller"]


def defect(
    shape: dict[str, Any],
    *,
    depth_um: float | None = None,
    axial_offset_mm: float | None = None,
    on: _Surface = "outer-raceway",
    row: int | None = None,
    center_deg: float | None = None,
    roller: int | None = None,
) -> dict[str, Any]:
    """One entry of ``defects``.

    Parameters
    ----------
    shape : dict
        As in the scenario file: ``{"circle": {"diameter_mm": 2.0}}``.
    depth_um : float, optional
        Depth, um; a depth map has its own.
    axial_offset_mm : float, optional
        Moves the shape along +z; 0 by default.
    on : {"outer-raceway", "inner-raceway", "roller"}
        Damaged surface.
    row : int, optional
        Row of rollers, from 1; 1 by default.
    center_deg : float, optional
        Where it lies, counter-clockwise from +x; the middle of the load zone by default, on the outer raceway.
    roller : int, optional
        Which roller of the row, from 1, where ``on`` is ``"roller"``.

    Returns
    -------
    dict
        For ``Scenario(defects=[...])``.

    Examples
    --------
    >>> import brinell
    >>> brinell.defect({"li2023_irregular": {"max_width_mm": 4.0}}, depth_um=20.0)
    {'on': 'outer-raceway', 'depth_um': 20.0, 'shape': {'li2023_irregular': {'max_width_mm': 4.0}}}
    """
    given = {"on": on, "row": row, "roller": roller, "center_deg": center_deg, "depth_um": depth_um, "axial_offset_mm": axial_offset_mm}
    return {key: value for key, value in given.items() if value is not None} | {"shape": shape}


def rectangle(
    *,
    length_mm: float,
    width_mm: float,
    depth_um: float,
    on: _Surface = "outer-raceway",
    row: int | None = None,
    center_deg: float | None = None,
    roller: int | None = None,
    axial_offset_mm: float | None = None,
) -> dict[str, Any]:
    """A rectangular spall.

    Parameters
    ----------
    length_mm, width_mm, depth_um : float
        Around the surface (s), along the axis, and into the material.
    on, row, center_deg, roller, axial_offset_mm
        As in `defect`.

    Examples
    --------
    >>> import brinell
    >>> brinell.rectangle(length_mm=3.0, width_mm=4.0, depth_um=20.0, center_deg=0.0)["center_deg"]
    0.0
    """
    shape = {"rectangle": {"length_mm": length_mm, "width_mm": width_mm}}
    return defect(shape, depth_um=depth_um, on=on, row=row, center_deg=center_deg, roller=roller, axial_offset_mm=axial_offset_mm)


def circle(
    *,
    diameter_mm: float,
    depth_um: float,
    on: _Surface = "outer-raceway",
    row: int | None = None,
    center_deg: float | None = None,
    roller: int | None = None,
    axial_offset_mm: float | None = None,
) -> dict[str, Any]:
    """A round pit.

    Parameters
    ----------
    diameter_mm, depth_um : float
        At most the roller's length across, and into the material.
    on, row, center_deg, roller, axial_offset_mm
        As in `defect`.

    Examples
    --------
    >>> import brinell
    >>> brinell.circle(diameter_mm=2.0, depth_um=15.0, on="inner-raceway")["on"]
    'inner-raceway'
    """
    return defect({"circle": {"diameter_mm": diameter_mm}}, depth_um=depth_um, on=on, row=row, center_deg=center_deg, roller=roller, axial_offset_mm=axial_offset_mm)


def outline(
    polygon: Any,
    *,
    depth_um: float,
    on: _Surface = "outer-raceway",
    row: int | None = None,
    center_deg: float | None = None,
    roller: int | None = None,
    axial_offset_mm: float | None = None,
) -> dict[str, Any]:
    """Damage of any plan.

    Parameters
    ----------
    polygon : array_like, or a polygon or collection of polygons
        (N, 2) points (s, z) in mm, or a sequence of such arrays where there are holes or several parts (even-odd), or anything with
        ``exterior.coords`` and ``interiors``, or with ``geoms`` of these: shapely's polygons and multipolygons.
    depth_um : float
        Into the material.
    on, row, center_deg, roller, axial_offset_mm
        As in `defect`.

    Raises
    ------
    ValueError
        Where there are no points, or they are not pairs.

    Examples
    --------
    >>> import brinell, numpy as np
    >>> angle = np.linspace(0.0, 2.0 * np.pi, 24, endpoint=False)
    >>> spall = brinell.outline(np.c_[1.5 * np.cos(angle), np.sin(angle)], depth_um=20.0)
    >>> len(spall["shape"]["outline"]["points_mm"])
    24
    """
    rings = [_points(ring) for ring in _rings(polygon)]
    if not rings:
        raise ValueError("the outline has no polygon")
    shape = {"points_mm": rings[0]} if len(rings) == 1 else {"polygons_mm": rings}
    return defect({"outline": shape}, depth_um=depth_um, on=on, row=row, center_deg=center_deg, roller=roller, axial_offset_mm=axial_offset_mm)


def _rings(polygon: Any) -> Iterable[Any]:
    """Closed lines: a polygon's border and holes, all parts of a collection."""
    if hasattr(polygon, "geoms"):
        for part in polygon.geoms:
            yield from _rings(part)
    elif hasattr(polygon, "exterior"):
        if len(polygon.exterior.coords):
            yield polygon.exterior.coords
        for hole in polygon.interiors:
            yield hole.coords
    else:
        try:
            several = np.ndim(polygon) == 3
        except ValueError:
            several = True
        if several:
            yield from polygon
        else:
            yield polygon


def _real(values: Any, name: str) -> npt.NDArray[np.float64]:
    if masked := masked_values(values):
        raise ValueError(f"{name}: {masked} of {np.size(values)} values are masked; give what is there, such as 0 for undamaged, with .filled(...)")
    if np.iscomplexobj(values):
        raise TypeError(f"{name}: expected real numbers, and it is complex")
    return np.asarray(values, dtype=float)


def _points(ring: Any) -> list[list[float]]:
    points = _real(ring, "an outline")
    if points.ndim != 2 or points.shape[1] not in (2, 3) or len(points) < 3:
        raise ValueError(f"an outline of shape {points.shape}: expected (N, 2) with N of 3 or more, points (s, z) in mm")
    points = points[:, :2]
    # A ring closes on its first point; shapely repeats it.
    if np.array_equal(points[0], points[-1]):
        points = points[:-1]
    listed: list[list[float]] = points.tolist()
    return listed


def depth_map(
    depth_um: npt.ArrayLike,
    *,
    ds_mm: float,
    dz_mm: float,
    s0_mm: float | None = None,
    z0_mm: float | None = None,
    on: _Surface = "outer-raceway",
    row: int | None = None,
    center_deg: float | None = None,
    roller: int | None = None,
    axial_offset_mm: float | None = None,
) -> dict[str, Any]:
    """Damage as depths on a grid, bilinear between its nodes.

    Parameters
    ----------
    depth_um : array_like, 2-D
        ``depth_um[i, j]`` at ``z0_mm + i dz_mm``, ``s0_mm + j ds_mm``: columns along s, rows along the axis. 0 is
        undamaged, negative a raised edge.
    ds_mm, dz_mm : float
        From point to point along s (of columns) and along the axis (of rows).
    s0_mm, z0_mm : float, optional
        First column and row; the grid is centred by default.
    on, row, center_deg, roller, axial_offset_mm
        As in `defect`.

    Raises
    ------
    ValueError
        Where it is no grid.

    Examples
    --------
    >>> import brinell, numpy as np
    >>> s, z = np.meshgrid(np.linspace(-1.5, 1.5, 31), np.linspace(-1.0, 1.0, 21))
    >>> bowl = 20.0 * np.clip(1.0 - (s / 1.4) ** 2 - (z / 0.9) ** 2, 0.0, None)
    >>> brinell.depth_map(bowl, ds_mm=0.1, dz_mm=0.1)["shape"]["depth_map"]["s0_mm"]
    -1.5
    """
    grid = _real(depth_um, "depth_um")
    if grid.ndim != 2:
        raise ValueError(f"a depth map of shape {grid.shape}: expected two dimensions, rows along the axis")
    rows, columns = grid.shape
    ds_mm, dz_mm = number_of(ds_mm, "ds_mm", "mm"), number_of(dz_mm, "dz_mm", "mm")
    entry = {
        "s0_mm": -0.5 * (columns - 1) * ds_mm if s0_mm is None else s0_mm,
        "z0_mm": -0.5 * (rows - 1) * dz_mm if z0_mm is None else z0_mm,
        "ds_mm": ds_mm,
        "dz_mm": dz_mm,
        "columns": columns,
        "rows": rows,
        "depth_um": grid.ravel(),
    }
    return defect({"depth_map": entry}, on=on, row=row, center_deg=center_deg, roller=roller, axial_offset_mm=axial_offset_mm)


def image(
    file: str | os.PathLike[str],
    *,
    mm_per_pixel: float,
    depth_um: float,
    options: dict[str, Any] | None = None,
    on: _Surface = "outer-raceway",
    row: int | None = None,
    center_deg: float | None = None,
    roller: int | None = None,
    axial_offset_mm: float | None = None,
) -> dict[str, Any]:
    """Damage in a photo or mask, PNG or JPEG: dark is damaged by default.

    Parameters
    ----------
    file : path
        Read when the scenario is made.
    mm_per_pixel, depth_um : float
        The side of a pixel; the depth.
    options : dict, optional
        More keys of the scenario file's ``image``: ``threshold``, ``invert``, ``rolling_direction`` (where +s, counter-clockwise, points in the
        picture) and so on.
    on, row, center_deg, roller, axial_offset_mm
        As in `defect`.

    Examples
    --------
    >>> import brinell
    >>> brinell.image("spall.png", mm_per_pixel=0.02, depth_um=20.0)["shape"]["image"]["file"]
    'spall.png'
    """
    shape = {"image": {"file": os.fspath(file), "mm_per_pixel": mm_per_pixel, **(options or {})}}
    return defect(shape, depth_um=depth_um, on=on, row=row, center_deg=center_deg, roller=roller, axial_offset_mm=axial_offset_mm)


def svg(
    file: str | os.PathLike[str],
    *,
    depth_um: float,
    options: dict[str, Any] | None = None,
    on: _Surface = "outer-raceway",
    row: int | None = None,
    center_deg: float | None = None,
    roller: int | None = None,
    axial_offset_mm: float | None = None,
) -> dict[str, Any]:
    """Damage drawn in a vector editor.

    Parameters
    ----------
    file : path
        Read when the scenario is made.
    depth_um : float
        Into the material.
    options : dict, optional
        More keys of the scenario file's ``svg``: ``path_id``, ``mm_per_unit`` and so on.
    on, row, center_deg, roller, axial_offset_mm
        As in `defect`.

    Examples
    --------
    >>> import brinell
    >>> brinell.svg("spall.svg", depth_um=20.0, options={"path_id": "rim"})["shape"]["svg"]["path_id"]
    'rim'
    """
    return defect({"svg": {"file": os.fspath(file), **(options or {})}}, depth_um=depth_um, on=on, row=row, center_deg=center_deg, roller=roller, axial_offset_mm=axial_offset_mm)
