"""A plan on a cluster: Dask distributed or Ray. The files have the bytes that one machine makes.

The unit of work is a file of the data set (``runs_per_file`` runs). A worker makes it in a scratch folder of its own and sends it; this process writes it
into the data set's folder, its checksum held against the worker's. Workers need brinell of the same version, and nothing else: plan, base scenario and
files of damage travel with the work. A worker that dies loses the file that it was at, which another one then makes. What is in the folder stays, so the
same call goes on where one stopped.

Processors matter: brinell uses AVX-512 where there is AVX-512, and the last bits differ from those of AVX2. A cluster of one kind of processor gives
the bytes of one machine of that kind.
"""

from __future__ import annotations

import atexit
import os
import shutil
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from brinell import _brinell, tables
from brinell.datasets import DataSet, Plan

if TYPE_CHECKING:
    import distributed

__all__ = ["on_dask", "on_ray"]

#: Name of the plan file, and every file by its path from a common folder.
_Parcel = tuple[str, tuple[tuple[str, bytes], ...]]
_Files = dict[str, bytes]


def _parcel(plan: Plan) -> _Parcel:
    """Everything that the runs are made from."""
    paths = [os.path.abspath(path) for path in plan._native.files()]
    root = os.path.commonpath([os.path.dirname(path) for path in paths])
    files = {os.path.relpath(path, root).replace(os.sep, "/"): Path(path).read_bytes() for path in paths}
    return os.path.relpath(paths[0], root).replace(os.sep, "/"), tuple(files.items())


#: The plan that this process was last at, and the lock of threads that come for it.
_last: tuple[_Parcel, Plan] | None = None
_coming = threading.Lock()


def _unpacked(parcel: _Parcel) -> Plan:
    """The plan of a parcel, opened once a process."""
    global _last
    with _coming:
        if _last is None or _last[0] != parcel:
            _last = parcel, _opened(parcel)
        return _last[1]


def _opened(parcel: _Parcel) -> Plan:
    name, files = parcel
    folder = tempfile.mkdtemp(prefix="brinell-plan-")
    # Files of damage are read again for each run.
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    for path, content in files:
        (Path(folder) / path).parent.mkdir(parents=True, exist_ok=True)
        (Path(folder) / path).write_bytes(content)
    return Plan(Path(folder) / name, check=False)


def _make(parcel: _Parcel, part: int) -> _Files:
    """One file of the data set with its facts, by path; on a worker."""
    plan = _unpacked(parcel)
    with tempfile.TemporaryDirectory(prefix="brinell-part-") as scratch:
        plan._native.make(scratch, (part + 1, plan.parts), 1, None)
        paths = [path for path in Path(scratch).rglob("*") if path.is_file()]
        return {path.relative_to(scratch).as_posix(): path.read_bytes() for path in paths}


class _Engine(Protocol):
    """What a cluster does."""

    def submit(self, part: int) -> None:
        """Begins with a file."""

    def next(self) -> tuple[int, _Files]:
        """The next file that is ready."""

    def cancel(self) -> None:
        """Gives up what is not ready."""

    def places(self) -> int:
        """Files that are worth having under way at once."""


#: Files that wait to be joined to the data set at most.
_WAITING = 64


def _drive(
    plan: Plan, folder: str | os.PathLike[str], engine: _Engine, progress: Callable[[int, int], object] | None
) -> DataSet:
    """Everything that is missing, through the engine."""
    data = DataSet(folder)
    incoming = data.folder / "work" / "incoming"
    # What arrived before this process's last end.
    _join(data, incoming)
    there = {path.name for path in data.files}
    parts = [part for part in range(plan.parts) if f"part-{part:05}.parquet" not in there]
    over = plan.runs - sum(map(plan.runs_of, parts))
    rest: Iterator[int] = iter(parts)
    under_way = 0
    try:
        for part in rest:
            engine.submit(part)
            under_way += 1
            if under_way >= engine.places():
                break
        while under_way:
            part, files = engine.next()
            under_way -= 1
            _put(incoming / f"part-{part:05}", files)
            following = next(rest, None)
            if following is not None:
                engine.submit(following)
                under_way += 1
            if len(list(incoming.iterdir())) >= _WAITING:
                _join(data, incoming)
            over += plan.runs_of(part)
            if progress is not None:
                progress(over, plan.runs)
    except BaseException:
        engine.cancel()
        raise
    finally:
        _join(data, incoming)
    return data


def _put(place: Path, files: _Files) -> None:
    """Files that appear together or not at all."""
    beside = place.with_name(place.name + ".partial")
    shutil.rmtree(beside, ignore_errors=True)
    for path, content in files.items():
        (beside / path).parent.mkdir(parents=True, exist_ok=True)
        (beside / path).write_bytes(content)
    shutil.rmtree(place, ignore_errors=True)
    beside.rename(place)


def _join(data: DataSet, incoming: Path) -> None:
    incoming.mkdir(parents=True, exist_ok=True)
    whole = sorted(path for path in incoming.iterdir() if path.suffix != ".partial")
    if whole:
        _brinell.merge(whole, data.folder)
    for path in incoming.iterdir():
        shutil.rmtree(path, ignore_errors=True)


class _Dask:
    def __init__(self, client: Any, parcel: _Parcel, retries: int) -> None:
        library = tables.need("distributed", "dask")
        self.client, self.parcel, self.retries = client, parcel, retries
        self.ready = library.as_completed()
        self.parts: dict[Any, int] = {}

    def submit(self, part: int) -> None:
        # Not a pure function's value: nobody should keep it once it is here.
        future = self.client.submit(_make, self.parcel, part, retries=self.retries, pure=False)
        self.parts[future] = part
        self.ready.add(future)

    def next(self) -> tuple[int, _Files]:
        future = next(self.ready)
        return self.parts.pop(future), future.result()

    def cancel(self) -> None:
        self.client.cancel(list(self.parts))

    def places(self) -> int:
        # Twice what runs at once, so that no worker waits for this process.
        threads: int = sum(self.client.nthreads().values())
        return max(2, 2 * threads)


def on_dask(
    plan: Plan | str | os.PathLike[str],
    folder: str | os.PathLike[str],
    client: distributed.Client | str | None = None,
    *,
    retries: int = 3,
    progress: Callable[[int, int], object] | None = None,
) -> DataSet:
    """Runs a plan on a Dask cluster (``pip install "brinell[dask]"``).

    Parameters
    ----------
    plan : Plan or path
        What to run.
    folder : path
        The data set's folder, of this machine: workers need no common file system.
    client : distributed.Client or str, optional
        The cluster, or its scheduler's address; the client of this session, or a new cluster on this machine, unless told.
    retries : int
        How often a file is tried again after an error. A worker that dies is another matter: Dask moves its work on, and gives up where that work has
        killed several workers (``distributed.scheduler.allowed-failures``).
    progress : callable, optional
        Gets how many runs are there, and of how many.

    Returns
    -------
    DataSet

    Examples
    --------
    >>> import brinell.distributed, distributed
    >>> with distributed.Client(processes=False, dashboard_address=None) as client:  # doctest: +SKIP
    ...     data = brinell.distributed.on_dask("plan.toml", "data", client)
    """
    library = tables.need("distributed", "dask")
    chosen = plan if isinstance(plan, Plan) else Plan(plan)
    with _client(library, client) as joined:
        return _drive(chosen, folder, _Dask(joined, _parcel(chosen), retries), progress)


@contextmanager
def _client(library: Any, client: Any) -> Iterator[Any]:
    if client is not None and not isinstance(client, str):
        yield client
        return
    if client is None:
        try:
            client = library.get_client()
        except ValueError:
            pass
        else:
            yield client
            return
    with library.Client(client) as new:
        yield new


class _Ray:
    def __init__(self, ray: Any, parcel: _Parcel, retries: int) -> None:
        self.ray = ray
        self.parcel = ray.put(parcel)
        self.task = ray.remote(_make).options(max_retries=retries, retry_exceptions=True)
        self.parts: dict[Any, int] = {}

    def submit(self, part: int) -> None:
        self.parts[self.task.remote(self.parcel, part)] = part

    def next(self) -> tuple[int, _Files]:
        # With a timeout, so that Ctrl-C is heard.
        ready: list[Any] = []
        while not ready:
            ready, _ = self.ray.wait(list(self.parts), num_returns=1, timeout=1.0)
        return self.parts.pop(ready[0]), self.ray.get(ready[0])

    def cancel(self) -> None:
        for task in self.parts:
            self.ray.cancel(task)

    def places(self) -> int:
        return max(2, 2 * int(self.ray.cluster_resources().get("CPU", 1)))


def on_ray(
    plan: Plan | str | os.PathLike[str],
    folder: str | os.PathLike[str],
    *,
    retries: int = 3,
    progress: Callable[[int, int], object] | None = None,
) -> DataSet:
    """Runs a plan on Ray (``pip install "brinell[ray]"``): the cluster that ``ray.init`` joined, or this machine.

    Parameters
    ----------
    plan, folder, progress
        As in `on_dask`.
    retries : int
        How often a file is tried again after an error or a worker's death.

    Returns
    -------
    DataSet

    Examples
    --------
    >>> import brinell.distributed
    >>> data = brinell.distributed.on_ray("plan.toml", "data")  # doctest: +SKIP
    """
    ray = tables.need("ray")
    chosen = plan if isinstance(plan, Plan) else Plan(plan)
    if not ray.is_initialized():
        ray.init(log_to_driver=False)
    return _drive(chosen, folder, _Ray(ray, _parcel(chosen), retries), progress)
