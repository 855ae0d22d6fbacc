"""A plan on a cluster: Dask distributed or Ray. The files have the bytes that one machine makes.

The unit of work is a file of the data set (``runs_per_file`` runs). A worker makes it in a scratch folder of its own and sends it; this process writes it
into the data set's folder, its checksum held against the worker's. Workers need brinell of the same version and a processor with the same kernel, and nothing else: plan, base scenario and
files of damage travel with the work, and so do version and kernel, which a worker holds against its own before it computes. A worker that dies loses the file that it was at, which another one then makes. What is in the folder stays, so the
same call resumes where one stopped.

Processors matter: brinell uses AVX-512 where there is AVX-512, and the last bits differ from those of AVX2. `BRINELL_KERNEL=avx2` for every worker and
this process makes a mixed cluster give the bytes of one machine.

Dask and Ray run whatever reaches their scheduler: use them on a private network, or with Dask's TLS or Ray's token authentication.
"""

from __future__ import annotations

import atexit
import itertools
import os
import re
import shutil
import socket
import tempfile
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING, Any, Protocol

from brinell import _brinell, tables
from brinell.datasets import DataSet, Plan

if TYPE_CHECKING:
    import distributed

__all__ = ["on_dask", "on_ray"]

#: Version and kernel that the work is for, name of the plan file, and every file by its path from a common folder.
_Parcel = tuple[str, str, str, tuple[tuple[str, bytes], ...]]
_Files = dict[str, bytes]

#: What a worker's file may be called.
_ARRIVING = re.compile(r"(runs|truth|held_out)/part-\d{5,}\.parquet|work/(campaign|part-\d{5,})\.json")
#: What a worker writes and nobody fetches: of a data set of one file the descriptions of the whole.
_STAYING = re.compile(r"dataset\.json|croissant\.json|README\.md|bearing_datasets/.*|held_out/_plan\.json|work/part-\d{5,}/.*")
#: Temporary folders, by the process that made them.
_TEMPORARY = re.compile(r"brinell-(?:plan|part)-(\d+)-.*")


def _parcel(plan: Plan) -> _Parcel:
    """Everything that the runs are made from."""
    paths = [os.path.abspath(path) for path in plan._native.files()]
    root = os.path.commonpath([os.path.dirname(path) for path in paths])
    files = {os.path.relpath(path, root).replace(os.sep, "/"): Path(path).read_bytes() for path in paths}
    name = os.path.relpath(paths[0], root).replace(os.sep, "/")
    return _brinell.__version__, _brinell.kernel(), name, tuple(files.items())


def _below(folder: Path, path: str) -> Path:
    """A path that came over the network, below a folder."""
    parts = PurePosixPath(path).parts
    if not parts or path.startswith("/") or any(part in ("..", ".") or ":" in part or "\\" in part for part in parts):
        raise ValueError(f"{path!r}: not a path below the folder that it is for")
    return folder.joinpath(*parts)


def _alike(version: str, kernel: str) -> None:
    """That this process makes the bytes that are wanted."""
    where = f"worker {socket.gethostname()}, process {os.getpid()}"
    if version != _brinell.__version__:
        raise RuntimeError(f"{where} has brinell {_brinell.__version__}, and the work is for {version}: install that version on every worker")
    if kernel != _brinell.kernel():
        raise RuntimeError(
            f"{where} computes with {_brinell.kernel()}, and the work is for {kernel}: set BRINELL_KERNEL to one kernel that all processors have, "
            "such as avx2, for every worker and for the process that sends the work"
        )


def _is_alive(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True


def _tidy() -> None:
    """Removes temporary folders of workers of this machine that were killed."""
    # Elsewhere signal 0 is no question but an end.
    if os.name != "posix":
        return
    for path in Path(tempfile.gettempdir()).glob("brinell-p*"):
        made = _TEMPORARY.fullmatch(path.name)
        if made and not _is_alive(int(made[1])):
            shutil.rmtree(path, ignore_errors=True)


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
    version, kernel, name, files = parcel
    _alike(version, kernel)
    _tidy()
    folder = tempfile.mkdtemp(prefix=f"brinell-plan-{os.getpid()}-")
    # Files of damage are read again for each run.
    atexit.register(shutil.rmtree, folder, ignore_errors=True)
    for path, content in files:
        place = _below(Path(folder), path)
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content)
    return Plan(_below(Path(folder), name), check=False)


def _make(parcel: _Parcel, part: int) -> _Files:
    """One file of the data set with its facts, by path; on a worker."""
    plan = _unpacked(parcel)
    with tempfile.TemporaryDirectory(prefix=f"brinell-part-{os.getpid()}-") as scratch:
        plan._native.make(scratch, (part + 1, plan.parts), 1, None)
        paths = {path.relative_to(scratch).as_posix(): path for path in Path(scratch).rglob("*") if path.is_file()}
        return {name: path.read_bytes() for name, path in paths.items() if not _STAYING.fullmatch(name)}


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
    # Whose folder it is, before anything arrives.
    plan._native.claim(Path(folder))
    data = DataSet(folder)
    incoming = data.folder / "work" / "incoming"
    # What arrived before this process's last end.
    put_aside = _join(data, incoming)
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
                put_aside += _join(data, incoming)
            over += plan.runs_of(part)
            if progress is not None:
                progress(over, plan.runs)
    except BaseException:
        engine.cancel()
        raise
    finally:
        put_aside += _join(data, incoming)
    if put_aside:
        told = "\n".join(put_aside)
        raise ValueError(f"files that were received and could not be joined; the same call makes them again:\n{told}")
    return data


def _put(place: Path, files: _Files) -> None:
    """Files that appear together or not at all."""
    beside = place.with_name(place.name + ".partial")
    shutil.rmtree(beside, ignore_errors=True)
    for path, content in files.items():
        if not _ARRIVING.fullmatch(path):
            raise ValueError(f"a worker sent {path!r}, which is no file of a data set")
        (beside / path).parent.mkdir(parents=True, exist_ok=True)
        (beside / path).write_bytes(content)
    shutil.rmtree(place, ignore_errors=True)
    beside.rename(place)


def _join(data: DataSet, incoming: Path) -> list[str]:
    """Joins what arrived to the data set. What cannot be joined is excluded, and reported."""
    incoming.mkdir(parents=True, exist_ok=True)
    whole = sorted(path for path in incoming.iterdir() if path.suffix != ".partial")
    aside = []
    try:
        if whole:
            _brinell.merge(whole, data.folder)
    except ValueError:
        # One by one, to find which.
        for path in whole:
            try:
                _brinell.merge([path], data.folder)
            except ValueError as error:
                place = _free(data.folder / "work" / "put_aside" / path.name)
                place.parent.mkdir(parents=True, exist_ok=True)
                path.rename(place)
                aside.append(f"  {place}: {error}")
    for path in incoming.iterdir():
        shutil.rmtree(path, ignore_errors=True)
    return aside


def _free(path: Path) -> Path:
    """The path, or one like it where nothing is yet."""
    names = (path.with_name(f"{path.name}-{k}") for k in itertools.count(2))
    return next(place for place in itertools.chain([path], names) if not place.exists())


class _Dask:
    def __init__(self, client: Any, parcel: _Parcel, retries: int) -> None:
        library = tables.need("distributed")
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
    """Runs a plan on a Dask cluster (which needs ``dask`` and ``distributed``).

    Parameters
    ----------
    plan : Plan or path
        What to run.
    folder : path
        The data set's folder, of this machine: workers need no common file system.
    client : distributed.Client or str, optional
        The cluster, or its scheduler's address; the client of this session, or a new cluster on this machine, by default.
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
    library = tables.need("distributed")
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
        # With a timeout, so that Ctrl-C is noticed.
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
    """Runs a plan on Ray (which needs ``ray``): the cluster that ``ray.init`` joined, or this machine.

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
