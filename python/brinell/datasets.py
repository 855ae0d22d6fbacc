"""Data sets: a plan to Parquet files of labelled signals with ground truth, as ``brinell dataset`` makes them."""

from __future__ import annotations

import importlib.util
import json
import os
import warnings
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from brinell import _brinell, tables
from brinell.analysis import Analysis, analyze
from brinell.arguments import jobs_of, whole_of
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
    ... simulation.duration_s = 1.0
    ... operation.speed_rpm = { uniform = [1500, 3000] }
    ... ''')
    >>> plan = brinell.Plan(folder / "plan.toml")
    >>> plan.runs, plan.parts
    (4, 2)
    >>> data = plan.run(folder / "data", jobs=1)
    >>> data.verify()
    []
    >>> data.to_polars()["sensor_ax"].list.len().to_list()
    [25600, 25600, 25600, 25600]
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
        """Does what is missing of the data set; the files' bytes depend on plan, version, kernel and the system's mathematics library. Ctrl-C stops it, and the same call goes on.

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
    """The folder of a data set. ``len`` is the number of runs in the files that are there, ``data[k]`` is run k.

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
            waiting = sum(1 for _ in (self.folder / "work").glob("part-*/run-*.row"))
            words = f"; {waiting} finished run{'' if waiting == 1 else 's'} in work/ wait for the others of their files: Plan.run goes on" if waiting else ""
            raise _brinell.ReadError(f"{self.folder}: no data set is here (runs/part-*.parquet is missing{words})")
        return files

    def _known(self) -> dict[str, Any]:
        """What is known of the whole: ``dataset.json``, or what the runs began with."""
        for path in (self.folder / "dataset.json", self.folder / "work" / "campaign.json"):
            if path.exists():
                known: dict[str, Any] = json.loads(path.read_bytes())
                return known
        return {}

    def _of_truth(self) -> list[str]:
        """Names of the columns of truth."""
        return [column["name"] for column in self._known().get("columns", []) if column.get("table") == "truth"]

    def _truth(self, chosen: list[str] | None, whole: bool) -> list[Path]:
        """Files of truth that chosen columns need; with ``whole`` those that are there, where none are chosen."""
        of_truth = set(self._of_truth())
        needs = whole if chosen is None else not of_truth.isdisjoint(chosen)
        files = sorted((self.folder / "truth").glob("part-*.parquet"), key=_number) if needs else []
        if needs and not files and chosen is not None:
            raise _brinell.ReadError(f"{self.folder}: truth/ is not here, which has {', '.join(name for name in chosen if name in of_truth)}")
        return files

    def _chosen(self, columns: Sequence[str] | None, split: str | None) -> list[str] | None:
        """The columns, each of which there must be, and so the split."""
        known = self._known()
        if split is not None and "splits" in known:
            _one_of("split", split, [each["name"] for each in known["splits"]])
        if columns is None:
            return None
        chosen = [columns] if isinstance(columns, str) else list(columns)
        if "columns" in known:
            for name in chosen:
                _one_of("columns", name, [column["name"] for column in known["columns"]])
        return chosen

    def _polars(self, columns: Sequence[str] | None, split: str | None, run: int | None = None, *, truth: bool = False) -> polars.DataFrame:
        pl = tables.need("polars")
        chosen = self._chosen(columns, split)
        lazy, beside = pl.scan_parquet(self._there()), self._truth(chosen, truth)
        if beside:
            lazy = lazy.join(pl.scan_parquet(beside), on="run", how="left")
        for name, value in (("split", split), ("run", run)):
            lazy = lazy if value is None else lazy.filter(pl.col(name) == value)
        frame: polars.DataFrame = (lazy if chosen is None else lazy.select(list(dict.fromkeys([*chosen, "run"])))).collect()
        frame = frame if frame["run"].is_sorted() else frame.sort("run")
        return frame if chosen is None else frame.select(chosen)

    def _pandas(self, columns: Sequence[str] | None, split: str | None, run: int | None = None, *, truth: bool = False) -> pandas.DataFrame:
        pd = tables.need("pandas")
        chosen = self._chosen(columns, split)
        of_truth = set(self._of_truth())

        def read(files: list[Path], is_there: Callable[[str], bool], filters: list[tuple[str, str, object]]) -> pandas.DataFrame:
            wanted = None if chosen is None else list(dict.fromkeys(["run", *filter(is_there, chosen)]))
            parts = [pd.read_parquet(file, columns=wanted, filters=filters or None) for file in files]
            whole: pandas.DataFrame = pd.concat([part for part in parts if len(part)] or parts[:1], ignore_index=True)
            return whole

        of_run: list[tuple[str, str, object]] = [] if run is None else [("run", "==", run)]
        of_split: list[tuple[str, str, object]] = [] if split is None else [("split", "==", split)]
        frame = read(self._there(), lambda name: name not in of_truth, of_run + of_split)
        if beside := self._truth(chosen, truth):
            frame = frame.merge(read(beside, lambda name: name in of_truth, of_run), on="run", how="left")
        if not frame["run"].is_monotonic_increasing:
            frame = frame.sort_values("run", ignore_index=True)
        frame = frame if chosen is None else frame[chosen]
        frame.attrs["units"] = {c["name"]: c["unit"] for c in self._known().get("columns", []) if c["name"] in frame.columns}
        return frame

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

    def to_polars(self, columns: Sequence[str] | None = None, *, split: str | None = None, truth: bool = False) -> polars.DataFrame:
        """A row a run, in order, signals as lists. Read the columns that are needed: names as in `Plan.columns`, else a ValueError says which there are.

        Parameters
        ----------
        columns : sequence of str, optional
            All of ``runs/`` by default; of ``truth/`` those that are named.
        split : str, optional
            Runs of this split alone: ``"train"``, ``"validation"``, ``"test"``.
        truth : bool
            Without ``columns``: those of ``truth/`` too. They give the label away.
        """
        return self._polars(columns, split, truth=truth)

    def to_pandas(self, columns: Sequence[str] | None = None, *, split: str | None = None, truth: bool = False) -> pandas.DataFrame:
        """As `to_polars`, signals as arrays; ``attrs["units"]`` has the units. Needs pyarrow."""
        return self._pandas(columns, split, truth=truth)

    def __len__(self) -> int:
        """Runs in the files that are there."""
        listed = self._known().get("files")
        if isinstance(listed, list):
            rows = {Path(file["path"]).name: file["rows"] for file in listed}
        else:
            try:
                rows = {file.name: json.loads((self.folder / "work" / f"{file.stem}.json").read_bytes())["runs"]["rows"] for file in self.files}
            except FileNotFoundError:
                return len(self.to_polars("run") if _has_polars() else self.to_pandas("run"))
        return sum(rows.get(file.name, 0) for file in self.files)

    def __getitem__(self, run: int) -> dict[str, Any]:
        """A run by its number, from 0: its values by column, those of ``truth/`` too, signals as arrays."""
        number = whole_of(run, "run", "the number of a run, from 0")
        frame = self._polars(None, None, number, truth=True) if _has_polars() else self._pandas(None, None, number, truth=True)
        for row in _rows(frame):
            return row
        raise KeyError(f"run {number}: not in the files that are there, which hold {len(self)} runs")

    def analyze(self, run: int, signal: str | None = None, **options: Any) -> Analysis:
        """What `brinell.analyze` finds in a run: its signal from ``analysed_from_s`` on, with its rate, unit, speed and bearing, as one that a simulation made.

        Parameters
        ----------
        run : int
            The number of the run, from 0.
        signal : str, optional
            The column; by default what the sensor gives, ``sensor_out``, or its acceleration nearer to the load; of a machine the first.
        **options
            As of `brinell.analyze`. Where labels are held out, and the scenario with them, and of a machine, which has several bearings, ``bearing`` is needed.
        """
        row = self[run]
        if row["status"] != "complete":
            raise ValueError(f"run {run} failed, and has no signal{': ' + row['reason'] if row['reason'] else ''}")
        # An empty cell is None to polars and NaN to pandas.
        load = row["load_n"] if hasattr(row["load_n"], "__len__") else None
        if "bearing" not in options:
            if load is None:
                raise ValueError(f"bearing: the machine of run {run} has {', '.join(row['bearings'])}; say which one is near the sensor")
            if isinstance(row.get("scenario"), str):
                options = {"bearing": Scenario._of(_brinell.Scenario.parse(row["scenario"]), quiet=True)} | options
        if "tacho" not in options and row["speed_rpm"] is not None and row["speed_rpm"] == row["speed_rpm"]:
            options = {"speed_rpm": row["speed_rpm"]} | options
        units = {column["name"]: column["unit"] for column in self._known().get("columns", []) if column["type"] == "list<float>"}
        if signal is None:
            there = list(units)
            if load is not None:
                near = ["sensor_ay", "sensor_ax"] if abs(load[1]) > abs(load[0]) else ["sensor_ax", "sensor_ay"]
                there = [name for name in ["sensor_out", *near] if name in units]
            if not there:
                raise ValueError(f"signal: the data set has neither sensor_out nor sensor_ax nor sensor_ay\n  allowed: {', '.join(units)}")
            signal = there[0]
        _one_of("signal", signal, list(units))
        samples = row[signal][round(row["analysed_from_s"] * row["sample_rate_hz"]) :]
        return analyze(samples, **({"rate_hz": row["sample_rate_hz"], "unit": units[signal], "simulated": True} | options))

    def __iter__(self) -> Iterator[dict[str, Any]]:
        """Runs as by number, one file in memory at a time; where runs are split, file by file, and so not in order."""
        library = tables.need("polars" if _has_polars() else "pandas")
        # Of runs with held-out labels the truth lies elsewhere: nothing, by the same names.
        unknown = dict.fromkeys(self._of_truth()) if self._truth(None, whole=True) else {}
        for file in self._there():
            frame, beside = library.read_parquet(file), self.folder / "truth" / file.name
            if beside.exists():
                truth = library.read_parquet(beside)
                frame = frame.join(truth, on="run", how="left") if _has_polars() else frame.merge(truth, on="run", how="left")
            for row in _rows(frame):
                yield unknown | row

    # Runs are found by number, and a row is nothing that could be compared.
    __contains__ = None

    def __repr__(self) -> str:
        known = self._known()
        parts, runs = known.get("files", 0), known.get("runs", 0)
        of = {"runs": runs["total"] if isinstance(runs, dict) else runs, "files": len(parts) if isinstance(parts, list) else parts}
        there = {"runs": len(self), "files": len(self.files)}
        words = [f"{count} {what}" if count == of[what] else f"{count} of {of[what]} {what}" for what, count in there.items()]
        classes = ", ".join(each["name"] for each in known.get("classes", []))
        return f"<brinell.DataSet in {str(self.folder)!r}: {' in '.join(words)}; classes: {classes or 'unknown'}>"


def _one_of(argument: str, name: str, names: list[str]) -> None:
    if name not in names:
        raise ValueError(f'{argument}: there is no "{name}"{tables.meant(name, names)}\n  allowed: {", ".join(names)}')


def _has_polars() -> bool:
    return importlib.util.find_spec("polars") is not None


def _rows(frame: Any) -> Iterator[dict[str, Any]]:
    """Rows of a frame of either library, lists as arrays."""
    for k in range(len(frame)):
        if hasattr(frame, "iloc"):
            yield frame.iloc[k].to_dict()
        else:
            cells = {name: frame[name][k] for name in frame.columns}
            yield {name: cell.to_numpy() if hasattr(cell, "to_numpy") else cell for name, cell in cells.items()}


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
