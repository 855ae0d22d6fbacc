"""Scenarios: the whole truth of a run."""

from __future__ import annotations

import json
import os
import warnings as _warnings
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from brinell import _brinell, tables

__all__ = ["Scenario", "ScenarioWarning", "bearings", "schema", "template"]


class ScenarioWarning(UserWarning):
    """A scenario runs, and its author should know something about it."""


def plain(words: str) -> str:
    """A warning without the word before it."""
    return words.removeprefix("warning: ")


def warn(texts: Iterable[str], *, stacklevel: int = 3) -> None:
    """Gives warnings, by default as of whoever called the function that calls this one."""
    for text in texts:
        _warnings.warn(plain(text), ScenarioWarning, stacklevel=stacklevel)


class Scenario:
    """Bearing, damage, operation and what to record. A scenario never changes; `replace` makes another.

    Each argument is a section of the scenario file with the file's keys, units in their names. What is left out has a default, and
    ``assumed`` lists the values that were not given.

    Parameters
    ----------
    name : str
        For results.
    bearing : str or dict
        A bearing of the catalogue (`bearings`), or keys of ``[bearing]``; ``{"preset": "NN3007", "radial_clearance_um": 5.0}`` for both.
    operation : dict
        Speed and load: ``{"speed_rpm": 1800.0, "load_n": [300.0, 0.0]}``.
    defects : sequence of dict
        Damage, as `rectangle`, `outline`, `depth_map` and others make it.
    simulation : dict
        Duration, sample rate, what to record.
    **sections
        Every other section: ``cage``, ``contact``, ``friction``, ``lubricant``, ``support``.

    Raises
    ------
    ScenarioError
        With everything that is wrong: key, value, allowed range, unit.

    Examples
    --------
    >>> import brinell
    >>> scenario = brinell.Scenario(bearing="NN3007", operation={"speed_rpm": 1800.0, "load_n": [300.0, 0.0]})
    >>> scenario["bearing.rollers_per_row"], scenario["operation.speed_rpm"]
    (19, 1800.0)
    >>> scenario.replace({"operation.speed_rpm": 3000})["operation.speed_rpm"]
    3000.0
    >>> brinell.Scenario(bearing="NN3007", operation={"speed_rpm": "fast", "load_n": [300.0, 0.0]})
    Traceback (most recent call last):
    ...
    brinell.ScenarioError: error: operation.speed_rpm = "fast": expected a number ...
    """

    __slots__ = ("_native",)
    _native: _brinell.Scenario

    def __init__(
        self,
        *,
        name: str = "python",
        bearing: str | Mapping[str, Any] | None = None,
        operation: Mapping[str, Any] | None = None,
        defects: Sequence[Mapping[str, Any]] | None = None,
        simulation: Mapping[str, Any] | None = None,
        **sections: Mapping[str, Any],
    ) -> None:
        given: dict[str, Any] = {
            "name": name,
            "bearing": {"preset": bearing} if isinstance(bearing, str) else bearing,
            "operation": operation,
            "defects": defects,
            "simulation": simulation,
            **sections,
        }
        self._take(_brinell.Scenario.build(_plain(given)))

    def _take(self, native: _brinell.Scenario, *, quiet: bool = False) -> None:
        self._native = native
        if not quiet:
            warn(native.warnings, stacklevel=4)

    @classmethod
    def _of(cls, native: _brinell.Scenario, *, quiet: bool = False) -> Scenario:
        scenario = cls.__new__(cls)
        scenario._take(native, quiet=quiet)
        return scenario

    @classmethod
    def from_file(cls, path: str | os.PathLike[str], settings: Mapping[str, Any] | None = None) -> Scenario:
        """Of a TOML file. Files of damage that it names count from its folder.

        Parameters
        ----------
        path : path
            The scenario.
        settings : mapping, optional
            Values over those of the file, by dotted path: ``{"operation.speed_rpm": 3000, "defects.0.depth_um": 10.0}``.

        Raises
        ------
        ReadError
            Where there is no such file.
        ScenarioError
            With everything that is wrong, and the lines that it is about.

        Examples
        --------
        >>> import brinell, pathlib, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "bearing.toml"
        >>> _ = path.write_text(brinell.template())
        >>> brinell.Scenario.from_file(path, {"operation.speed_rpm": 900})["operation.speed_rpm"]
        900.0
        """
        return cls._of(_brinell.Scenario.read(path, _plain(settings or {})))

    @classmethod
    def from_toml(
        cls, text: str, settings: Mapping[str, Any] | None = None, folder: str | os.PathLike[str] = ""
    ) -> Scenario:
        """Of a scenario file's text.

        Parameters
        ----------
        text : str
            TOML.
        settings : mapping, optional
            As in `from_file`.
        folder : path, optional
            Where paths in the text count from; the current folder by default.

        Examples
        --------
        >>> import brinell
        >>> brinell.Scenario.from_toml(brinell.template()).name
        'nn3007-rectangle'
        """
        return cls._of(_brinell.Scenario.parse(text, _plain(settings or {}), folder))

    def replace(self, settings: Mapping[str, Any]) -> Scenario:
        """The same with other values; what was derived from the old ones is derived anew.

        Parameters
        ----------
        settings : mapping
            Dotted paths to values; elements of lists by number from 0. None is the default of a key that has a value.

        Examples
        --------
        >>> import brinell
        >>> scenario = brinell.Scenario(bearing="NU205", operation={"speed_rpm": 1500.0, "load_n": [500.0, 0.0]})
        >>> faster = scenario.replace({"operation.speed_rpm": 3000.0, "simulation.duration_s": 0.2})
        >>> faster["simulation.duration_s"]
        0.2
        """
        for key in (key for key, value in settings.items() if value is None):
            self[key]
        return type(self)._of(self._native.changed(_plain(settings)))

    @property
    def name(self) -> str:
        """The scenario's name."""
        return self._native.name

    @property
    def values(self) -> dict[str, Any]:
        """Every section with every key's value, defaults filled in."""
        return self._native.values()

    # No sequence, though it has items.
    __iter__ = None

    def __contains__(self, key: object) -> bool:
        """Whether there is a value with this dotted path."""
        try:
            self[key]  # type: ignore[index]
        except (KeyError, TypeError):
            return False
        return True

    def _keys(self) -> list[str]:
        """The dotted paths of sections and values."""
        found = []
        for section, values in self.values.items():
            found.append(section)
            if isinstance(values, dict):
                found += [f"{section}.{key}" for key in values]
        return found

    def _ipython_key_completions_(self) -> list[str]:
        return self._keys()

    def __getitem__(self, key: str) -> Any:
        """A value by its dotted path."""
        if not isinstance(key, str):
            raise TypeError(f'{key!r}: a key is a dotted path, such as "operation.speed_rpm"')
        value: Any = self._native.values()
        for step in key.split("."):
            try:
                value = value[int(step)] if isinstance(value, list) else value[step]
            except (KeyError, IndexError, ValueError, TypeError):
                raise KeyError(f"{key}: there is no such value{tables.meant(key, self._keys())}") from None
        return value

    def to_toml(self) -> str:
        """The scenario file with every default filled in, assumed values with their reasons; it reads back with the same `assumed`.

        Examples
        --------
        >>> import brinell
        >>> text = brinell.Scenario.from_toml(brinell.template()).to_toml()
        >>> brinell.Scenario.from_toml(text).to_toml().splitlines()[0]
        'name = "nn3007-rectangle"'
        """
        return self._native.toml

    def write(self, path: str | os.PathLike[str]) -> Path:
        """Writes `to_toml` into a file that ``brinell run`` takes.

        Examples
        --------
        >>> import brinell, pathlib, tempfile
        >>> path = pathlib.Path(tempfile.mkdtemp()) / "bearing.toml"
        >>> brinell.Scenario.from_toml(brinell.template()).write(path).name
        'bearing.toml'
        """
        path = Path(path)
        self._native.write(path)
        return path

    @property
    def warnings(self) -> list[str]:
        """What its author should know."""
        return self._native.warnings

    @property
    def assumed(self) -> list[dict[str, Any]]:
        """Assumed values: key, value, unit, why."""
        return self._native.assumed

    @property
    def fingerprint(self) -> str:
        """SHA-256 of what it means, in hexadecimal: the same however it was written."""
        return self._native.fingerprint

    def __repr__(self) -> str:
        return f"<brinell.Scenario {self.name!r}>"

    def __eq__(self, other: object) -> bool:
        return self.fingerprint == other.fingerprint if isinstance(other, Scenario) else NotImplemented

    def __hash__(self) -> int:
        return hash(self.fingerprint)

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, self._native.state()


Runnable = Scenario | str | os.PathLike[str]


def given(of: Runnable) -> Scenario:
    """A scenario, or that of a file."""
    if isinstance(of, Scenario):
        return of
    if isinstance(of, (str, os.PathLike)):
        return Scenario.from_file(of)
    raise TypeError(f"scenario: expected a Scenario or the path of a scenario file, and it is {type(of).__name__}")


def of_bearing(bearing: Any) -> tuple[str | None, _brinell.Scenario | None]:
    """A bearing by its name, or the scenario that has it, as the command takes both."""
    if isinstance(bearing, Scenario):
        return None, bearing._native
    if bearing is not None and not isinstance(bearing, (str, os.PathLike)):
        raise TypeError(f"bearing = {bearing!r}: expected a name, a Scenario or the path of a scenario file")
    if bearing is None:
        return None, None
    path = Path(bearing)
    if not isinstance(bearing, str) or path.suffix.lower() == ".toml" or (not _brinell.is_bearing(bearing) and path.is_file()):
        return None, Scenario.from_file(path)._native
    return bearing, None


def _restored(*state: Any) -> Scenario:
    # Its warnings were given where it was made.
    return Scenario._of(_brinell.Scenario.restore(*state), quiet=True)


def _plain(value: Mapping[str, Any]) -> dict[str, Any]:
    """Dicts all through: the module of Rust knows no other mappings."""

    def plain(value: Any) -> Any:
        if isinstance(value, Mapping):
            return {key: plain(item) for key, item in value.items()}
        if isinstance(value, (list, tuple)):
            return [plain(item) for item in value]
        return value

    return {key: plain(item) for key, item in value.items()}


def bearings() -> dict[str, str]:
    """The catalogue, whose names ``bearing.preset`` takes: with one line on each.

    Examples
    --------
    >>> import brinell
    >>> "NN3007" in brinell.bearings()
    True
    """
    return dict(_brinell.bearings())


def schema(*, plan: bool = False) -> dict[str, Any]:
    """JSON Schema of the scenario file.

    Parameters
    ----------
    plan : bool
        Of a data set's plan instead.

    Examples
    --------
    >>> import brinell
    >>> sorted(brinell.schema()["properties"])[:3]
    ['bearing', 'cage', 'contact']
    >>> brinell.schema(plan=True)["required"]
    ['base']
    """
    loaded: dict[str, Any] = json.loads(_brinell.schema(plan))
    return loaded


def template() -> str:
    """A commented scenario to begin from, as ``brinell init`` writes it.

    Examples
    --------
    >>> import brinell
    >>> brinell.template().startswith("#")
    True
    """
    return _brinell.template()
