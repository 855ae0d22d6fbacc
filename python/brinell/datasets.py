"""Data sets: a plan to Parquet files of labelled signals with ground truth, as ``brinell dataset`` makes them."""

from __future__ import annotations

import difflib
import json
import os
import warnings
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from brinell import _brinell, tables
from brinell.arguments import jobs_of
from brinell.scenario import Scenario, ScenarioWarning

if TYPE_CHECKING:
    import pandas
    import polars

__all__ = ["DataSet", "Plan", "merge"]


class Plan:
    """A plan file: which keys of a base scenario vary and how, which classes of damage there are, how many runs.

    A plan can be pickled: as its path, where the same files must be found again.

    Parameters
    ----------
    path : path
        The plan (TOML); ``brinell dataset --help`` shows one.
    check : bool
        Look at every run's values before any runs, and refuse a plan whose runs cannot be made.

    Raises
    ------
    ScenarioError
        With everything that is wrong with plan or base scenario, and the lines that it is about.

    Warns
    -----
    ScenarioWarning
        What its author should know: runs that would mislead, grids that come unequally often, a seed that gives held-out labels away.

    Examples
    --------
    >>> import brinell, pathlib, tempfile
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> _ = (folder / "base.toml").write_text(brinell.template())
    >>> _ = (folder / "plan.toml").write_text('''
    ... name = "speeds"
    ... base = "base.toml"
    ... runs = 4
    ... runs_per_file = 2
    ... signals = ["sensor_ax"]
    ... [vary]
    ... simulation.duration_s = 0.2
    ... operation.speed_rpm = { uniform = [1500, 3000] }
    ... ''')
    >>> plan = brinell.Plan(folder / "plan.toml")
    >>> plan.runs, plan.parts
    (4, 2)
    >>> data = plan.run(folder / "data", jobs=1)
    >>> data.verify()
    []
    >>> data.to_polars()["sensor_ax"].list.len().to_list()
    [5120, 5120, 5120, 5120]
    """

    __slots__ = ("_native", "path")
    path: Path
    """The plan file."""

    def __init__(self, path: str | os.PathLike[str], *, check: bool = True) -> None:
        self.path = Path(path)
        self._native = _brinell.Campaign.open(self.path, check)
        for text in self._native.warnings:
            warnings.warn(text.removeprefix("warning: "), ScenarioWarning, stacklevel=2)

    @property
    def name(self) -> str:
        """Of the data set."""
        return self._native.name

    @property
    def runs(self) -> int:
        """How many runs."""
        return self._native.runs

    @property
    def parts(self) -> int:
        """How many files of runs."""
        return self._native.parts

    def runs_of(self, part: int) -> int:
        """How many runs a file has, files counted from 0."""
        return self._native.runs_of(part)

    @property
    def identity(self) -> str:
        """SHA-256 of what the plan means, in hexadecimal."""
        return self._native.identity

    @property
    def columns(self) -> dict[str, tuple[str, str]]:
        """Unit and description of each column of the files."""
        return {name: (unit, text) for name, unit, text in self._native.columns()}

    def scenario(self, run: int) -> Scenario:
        """A run's scenario, from 0."""
        text, _ = self._native.run(run)
        return Scenario._of(_brinell.Scenario.parse(text), quiet=True)

    def label(self, run: int) -> str:
        """A run's class."""
        return self._native.run(run)[1]

    def run(
        self,
        folder: str | os.PathLike[str],
        *,
        jobs: int | None = None,
        shard: tuple[int, int] = (1, 1),
        progress: Callable[[int, int], object] | None = None,
    ) -> DataSet:
        """Does what is missing of the data set; the files' bytes depend on plan, version and kernel. Ctrl-C stops it, and the same call goes on.

        Parameters
        ----------
        folder : path
            Where it is or will be.
        jobs : int, optional
            Runs at a time; as many as there are cores by default.
        shard : (int, int)
            ``(i, n)``: only the i-th of n shares of the files, i from 1.
        progress : callable, optional
            Gets how many runs of the shard are over, and of how many.

        Returns
        -------
        DataSet

        Raises
        ------
        ValueError
            Where the folder holds another data set, or one of another version or kernel.
        ReadError
            Where the folder cannot be made, or a file not be written.

        Warns
        -----
        ScenarioWarning
            Runs that failed, are clipped, or hold a signal that is one value throughout: how many of each class.
        """
        for text in self._native.make(folder, shard, jobs_of(jobs), progress)["warnings"]:
            warnings.warn(text, ScenarioWarning, stacklevel=2)
        return DataSet(folder)

    def __reduce__(self) -> tuple[Any, ...]:
        # The folder may be another where it is read again.
        return _restored, (os.path.abspath(self.path), self.identity)

    def __repr__(self) -> str:
        return f"<brinell.Plan {self.name!r}: {self.runs} runs in {self.parts} files>"


def _restored(path: str, identity: str) -> Plan:
    # Its runs were looked at, and its warnings given, where it was made.
    plan = Plan(path, check=False)
    if plan.identity != identity:
        raise ValueError(f"{path}: not the plan that was sent; a plan travels as its path, and the files have changed")
    return plan


class DataSet:
    """The folder of a data set.

    Parameters
    ----------
    folder : path
        With ``runs/`` in it.

    Raises
    ------
    ReadError
        Where there is none.
    """

    __slots__ = ("folder",)
    folder: Path

    def __init__(self, folder: str | os.PathLike[str]) -> None:
        self.folder = Path(folder)
        if not any((self.folder / name).exists() for name in ("runs", "dataset.json", "work")):
            raise _brinell.ReadError(f"{self.folder}: no data set is here (neither runs nor dataset.json)")

    @property
    def files(self) -> list[Path]:
        """Files of runs that are there, in order."""
        return sorted((self.folder / "runs").glob("part-*.parquet"), key=_number)

    def _there(self) -> list[Path]:
        files = self.files
        if not files:
            raise _brinell.ReadError(f"{self.folder}: no data set is here (runs/part-*.parquet is missing)")
        return files

    def _chosen(self, columns: Sequence[str] | None) -> list[str] | None:
        """The columns, each of which there must be."""
        if columns is None:
            return None
        chosen = [columns] if isinstance(columns, str) else list(columns)
        for path in (self.folder / "dataset.json", self.folder / "work" / "campaign.json"):
            if path.exists():
                names = [column["name"] for column in json.loads(path.read_bytes())["columns"]]
                for name in chosen:
                    if name not in names:
                        near = difflib.get_close_matches(str(name), names, n=1)
                        hint = f', did you mean "{near[0]}"?' if near else ""
                        raise ValueError(f'columns: there is no "{name}"{hint}\n  allowed: {", ".join(names)}')
                break
        return chosen

    @property
    def about(self) -> dict[str, Any]:
        """``dataset.json``: geometry, units, licence, columns, checksums. There once all files are."""
        path = self.folder / "dataset.json"
        try:
            about: dict[str, Any] = json.loads(path.read_bytes())
        except OSError as error:
            raise _brinell.ReadError(f"cannot read {path}: {error.strerror}; it is there once all files are") from error
        return about

    def verify(self) -> list[str]:
        """Everything that is not as it should be: files missing or damaged, rows, checksums; empty where all is well."""
        return _brinell.verify(self.folder)[4]

    def to_polars(self, columns: Sequence[str] | None = None) -> polars.DataFrame:
        """A row a run, signals as lists; read the columns that are needed: names as in `Plan.columns`, else a ValueError says which there are."""
        pl = tables.need("polars")
        frame: polars.DataFrame = pl.read_parquet(self._there(), columns=self._chosen(columns))
        return frame

    def to_pandas(self, columns: Sequence[str] | None = None) -> pandas.DataFrame:
        """A row a run, signals as arrays; needs pyarrow."""
        pd = tables.need("pandas")
        chosen = self._chosen(columns)
        frame: pandas.DataFrame = pd.concat([pd.read_parquet(file, columns=chosen) for file in self._there()], ignore_index=True)
        return frame

    def __repr__(self) -> str:
        return f"<brinell.DataSet in {str(self.folder)!r}: {len(self.files)} files>"


def _number(file: Path) -> tuple[int, str]:
    """By its number: beyond 99 999 files names have more digits. One that is no number comes first."""
    digits = file.stem.removeprefix("part-")
    return (int(digits) if digits.isdecimal() else -1, file.name)


def merge(folders: Sequence[str | os.PathLike[str]], into: str | os.PathLike[str]) -> DataSet:
    """Joins folders in which shards of one plan ran apart; each file's checksum is held against what was written.

    Parameters
    ----------
    folders : sequence of path
        The folders.
    into : path
        A new folder, or one of them.

    Raises
    ------
    ValueError
        Where a folder is of another campaign, version or kernel, or a file is damaged.

    Warns
    -----
    UserWarning
        Where files are in none of the folders.

    Examples
    --------
    >>> from brinell.datasets import merge
    >>> merge([], "nowhere")
    Traceback (most recent call last):
    ...
    ValueError: no folders to merge
    """
    lack = _brinell.merge([Path(folder) for folder in folders], Path(into))
    if lack is not None:
        warnings.warn(lack, stacklevel=2)
    return DataSet(into)
