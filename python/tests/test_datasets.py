"""Data sets, on this machine and on clusters."""

import hashlib
import itertools
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import textwrap

import numpy as np
import pytest

from conftest import blocks

import brinell
import brinell.distributed

# Runs are short on purpose, and their plans are warned of.
pytestmark = pytest.mark.filterwarnings("ignore::brinell.ScenarioWarning")


def digests(folder):
    """Everything that is a data set's: what lies under work is not."""
    paths = [path for path in folder.rglob("*") if path.is_file() and "work" not in path.relative_to(folder).parts]
    return {path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest() for path in paths}


def test_xval_files_have_the_bytes_of_the_command(command, plan, tmp_path):
    chosen = plan()
    told = []
    data = chosen.run(tmp_path / "python", jobs=2, progress=lambda over, of: told.append((over, of)))
    assert told[-1] == (15, 15) and data.verify() == []
    done = [command, "dataset", str(chosen.path), "-o", str(tmp_path / "command"), "-q"]
    subprocess.run(done, check=True, capture_output=True)
    assert digests(tmp_path / "python") == digests(tmp_path / "command")
    frame = data.to_polars(["run", "sensor_ax", "speed_rpm", "status"])
    assert sorted(frame["run"].to_list()) == list(range(15)) and set(frame["status"]) == {"complete"}
    # A row's signal is the run's, but for the sample at the run's end.
    result = brinell.simulate(chosen.scenario(4))
    signal = frame["sensor_ax"][frame["run"].to_list().index(4)].to_numpy()
    np.testing.assert_array_equal(signal, result["sensor_ax"][:-1].astype(signal.dtype))
    assert chosen.label(0) in ("healthy", "photo") and "sensor_ax" in chosen.columns


def test_prop_shards_join_to_the_same_bytes(plan, tmp_path):
    from brinell.datasets import merge

    chosen = plan()
    whole = chosen.run(tmp_path / "whole")
    for k in (1, 2, 3):
        chosen.run(tmp_path / f"shard-{k}", shard=(k, 3))
    with pytest.warns(UserWarning, match=r"incomplete: 3 files in none of the folders \(part 1, 4, 7\); run their shards again"):
        merge([tmp_path / f"shard-{k}" for k in (3, 1)], tmp_path / "joined")
    joined = merge([tmp_path / f"shard-{k}" for k in (3, 1, 2)], tmp_path / "joined")
    assert digests(joined.folder) == digests(whole.folder)
    with pytest.raises(brinell.ReadError, match="dataset.json"):
        brinell.DataSet(tmp_path / "shard-1").about
    for shard in ((0, 3), (4, 3), (1, 0)):
        with pytest.raises(ValueError, match="expected"):
            chosen.run(tmp_path / "x", shard=shard)


def test_xval_bad_plans_are_reported_as_by_the_command(command, plan, tmp_path):
    with pytest.raises(brinell.ScenarioError) as caught:
        plan(runs=0)
    path = tmp_path / "plan" / "plan.toml"
    done = subprocess.run([command, "dataset", str(path)], capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (2, f"{caught.value}\n")
    path.write_text(path.read_text().replace("runs = 0", "runs = 4").replace("[vary]", "[vary]\noperation.load_ramp_s = { uniform = [-1, 1] }"))
    with pytest.raises(brinell.ScenarioError) as caught:
        brinell.Plan(path)
    done = subprocess.run([command, "dataset", str(path)], capture_output=True, text=True)
    assert done.returncode == 2 and str(caught.value) in done.stderr


def test_regress_what_a_plans_author_should_know_is_a_warning(plan):
    path = plan().path
    path.write_text(path.read_text().replace("[vary]", "[vary]\nlubricant.viscosity_pa_s = { grid = [0.01, 0.02, 0.03, 0.04] }"))
    with pytest.warns(brinell.ScenarioWarning, match="for 4 combinations of its grids: some combinations come once more"):
        brinell.Plan(path)
    brinell.Plan(path, check=False)


def test_prop_ctrl_c_keeps_what_is_finished(plan, tmp_path):
    chosen = plan(runs=40, duration=0.5)
    program = f"""
        import brinell, os, signal, threading
        stop = lambda over, of: over >= 3 and os.kill(os.getpid(), signal.SIGINT)
        try:
            brinell.Plan({str(chosen.path)!r}).run({str(tmp_path / "data")!r}, jobs=2, progress=stop)
        except KeyboardInterrupt:
            print("stopped")
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(program)], capture_output=True, text=True, timeout=120)
    assert done.stdout == "stopped\n", done.stderr
    told = []
    chosen.run(tmp_path / "data", progress=lambda over, of: told.append(over))
    assert told[0] >= 3 and told[-1] == 40 and brinell.DataSet(tmp_path / "data").verify() == []


@pytest.mark.filterwarnings("ignore")
@pytest.mark.skipif(sys.platform == "win32", reason="sends a POSIX signal")
def test_prop_a_dask_cluster_loses_a_worker_and_nothing_else(plan, tmp_path):
    distributed = pytest.importorskip("distributed")
    chosen = plan(runs=31, duration=0.2)
    expected = chosen.run(tmp_path / "alone")
    killed, told = [], []
    options = {"n_workers": 2, "threads_per_worker": 1, "processes": True, "host": "127.0.0.1", "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:

        def progress(over, of):
            told.append(over)
            if not killed:
                # In the midst of its next file.
                pids = client.run(os.getpid)
                killed.append(sorted(pids.values())[0])
                os.kill(killed[0], signal.SIGKILL)

        data = brinell.distributed.on_dask(chosen, tmp_path / "cluster", client, progress=progress)
        assert killed and killed[0] not in client.run(os.getpid).values()
    assert data.verify() == []
    assert digests(data.folder) == digests(expected.folder)
    assert sorted(data.to_polars(["run"])["run"].to_list()) == list(range(31))
    assert told == sorted(set(told)) and told[-1] == 31
    assert not list((data.folder / "work" / "incoming").iterdir())


@pytest.mark.filterwarnings("ignore")
def test_prop_a_cluster_goes_on_where_one_stopped(plan, tmp_path):
    distributed = pytest.importorskip("distributed")
    chosen = plan()
    expected = chosen.run(tmp_path / "alone")
    options = {"n_workers": 1, "threads_per_worker": 2, "processes": True, "host": "127.0.0.1", "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster, distributed.Client(cluster) as client:

        def stop(over, of):
            if over > 4:
                raise KeyboardInterrupt

        with pytest.raises(KeyboardInterrupt):
            brinell.distributed.on_dask(chosen, tmp_path / "cluster", client, progress=stop)
        there = digests(tmp_path / "cluster")
        assert 1 <= len([path for path in there if path.startswith("runs/")]) < chosen.parts
        told = []
        brinell.distributed.on_dask(chosen, tmp_path / "cluster", client, progress=lambda over, of: told.append(over))
        assert told[0] > 4
    assert digests(tmp_path / "cluster") == digests(expected.folder)
    assert there.items() <= digests(tmp_path / "cluster").items()


def ray_workers():
    """Processes that are at a file, on Linux."""
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if (process / "cmdline").read_bytes().startswith(b"ray::_make"):
                yield int(process.name)
        except OSError:
            pass


@pytest.mark.filterwarnings("ignore")
def test_prop_ray_loses_a_worker_and_makes_the_same_bytes(plan, tmp_path):
    ray = pytest.importorskip("ray")
    chosen = plan(runs=31, duration=0.2)
    expected = chosen.run(tmp_path / "alone")
    killed, told = [], []

    def progress(over, of):
        told.append((over, of))
        for pid in itertools.islice(ray_workers(), 0 if killed else 1):
            killed.append(pid)
            os.kill(pid, signal.SIGKILL)

    ray.init(num_cpus=2, include_dashboard=False, log_to_driver=False)
    try:
        data = brinell.distributed.on_ray(chosen, tmp_path / "cluster", progress=progress)
    finally:
        ray.shutdown()
    assert killed or sys.platform != "linux"
    assert told[-1] == (31, 31) and digests(data.folder) == digests(expected.folder)


def test_prop_what_travels_can_be_pickled(plan):
    from brinell.distributed import _parcel

    version, kernel, name, files = pickle.loads(pickle.dumps(_parcel(plan())))
    assert version == brinell.__version__ and kernel in ("avx512", "avx2", "portable", "plain")
    assert name == "plan.toml" and {path for path, _ in files} == {"plan.toml", "base.toml", "photo-spall.png"}


def test_prop_a_plan_travels_as_its_path(plan):
    made = plan()
    assert pickle.loads(pickle.dumps(made)).identity == made.identity
    sent = pickle.dumps(made)
    made.path.write_text(made.path.read_text().replace("runs = 15", "runs = 14"))
    with pytest.raises(ValueError, match="not the plan that was sent"):
        pickle.loads(sent)


def test_regress_files_and_runs_that_there_are_not(plan):
    made = plan()
    for call, words in ((made.runs_of, "part = {}: no such file"), (made.scenario, "run = {}: no such run"), (made.label, "run = {}")):
        for index in (99, -1):
            with pytest.raises(ValueError, match=words.format(index)):
                call(index)


def test_regress_files_are_in_the_order_of_their_numbers(tmp_path):
    (tmp_path / "runs").mkdir()
    for number in (100000, 99999, 7):
        (tmp_path / "runs" / f"part-{number:05}.parquet").touch()
    names = [file.stem for file in brinell.DataSet(tmp_path).files]
    assert names == ["part-00007", "part-99999", "part-100000"]


def test_regress_a_run_that_no_float_holds_has_failed(plan, tmp_path):
    path = plan(runs=2).path
    path.write_text(path.read_text().replace("[vary]", "[vary]\nsensor.noise_rms_m_per_s2 = { log = [1e50, 1e60] }"))
    data = brinell.Plan(path).run(tmp_path / "data")
    assert data.verify() == [] and data.about["runs"]["failed"] == 2


def test_prop_a_worker_of_another_version_or_kernel_refuses(plan):
    from brinell.distributed import _make, _parcel

    version, kernel, name, files = _parcel(plan())
    with pytest.raises(RuntimeError, match="the work is for 0.0.9: install that version"):
        _make(("0.0.9", kernel, name, files), 0)
    with pytest.raises(RuntimeError, match="the work is for quantum: set BRINELL_KERNEL"):
        _make((version, "quantum", name, files), 0)


def test_prop_a_part_that_cannot_be_joined_is_put_aside(plan, tmp_path):
    from brinell.distributed import _drive, _make, _parcel

    chosen = plan(runs=4)
    expected = chosen.run(tmp_path / "alone")
    parcel = _parcel(chosen)

    class OneByOne:
        """A cluster whose worker damages its first file."""

        def __init__(self, damaged):
            self.waiting, self.damaged = [], damaged

        def submit(self, part):
            self.waiting.append(part)

        def next(self):
            part = self.waiting.pop(0)
            files = _make(parcel, part)
            if part == self.damaged:
                name = f"runs/part-{part:05}.parquet"
                files[name] = files[name][:-1] + b"?"
            return part, files

        def cancel(self):
            self.waiting.clear()

        def places(self):
            return 1

    with pytest.raises(ValueError, match="put_aside/part-00000: .*checksum"):
        _drive(chosen, tmp_path / "cluster", OneByOne(0), None)
    there = digests(tmp_path / "cluster")
    assert "runs/part-00001.parquet" in there and "runs/part-00000.parquet" not in there
    data = _drive(chosen, tmp_path / "cluster", OneByOne(None), None)
    assert data.verify() == [] and digests(data.folder).items() >= digests(expected.folder).items()


def test_prop_no_path_of_a_worker_leaves_its_folder(plan, tmp_path):
    from brinell.distributed import _below, _put

    for path in ["../x", "/etc/x", "a/../../x", "C:/x", "a\\..\\x", "", "."]:
        with pytest.raises(ValueError):
            _below(tmp_path, path)
        with pytest.raises(ValueError):
            _put(tmp_path / "place", {path: b""})
    assert _below(tmp_path, "a/b.toml") == tmp_path / "a" / "b.toml"


@pytest.mark.skipif(os.name != "posix", reason="signal 0")
def test_prop_folders_of_killed_workers_are_removed(tmp_path, monkeypatch):
    from brinell.distributed import _tidy

    gone = subprocess.Popen([sys.executable, "-c", ""])
    gone.wait()
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    names = [f"brinell-part-{gone.pid}-abc", f"brinell-plan-{os.getpid()}-abc", f"other-{gone.pid}-abc"]
    for name in names:
        (tmp_path / name).mkdir()
    _tidy()
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(names[1:])


@pytest.mark.filterwarnings("ignore")
def test_prop_examples_of_the_book_run(plan, tmp_path, monkeypatch):
    pytest.importorskip("pandas")
    distributed = pytest.importorskip("distributed")
    chosen = plan(runs=4)
    monkeypatch.chdir(chosen.path.parent)
    program = blocks("docs/src/cluster.md")
    address = '"tcp://10.0.0.1:8786"'
    assert program.count(address) == 1
    options = {"n_workers": 1, "threads_per_worker": 1, "processes": True, "host": "127.0.0.1", "dashboard_address": None}
    with distributed.LocalCluster(**options) as cluster:
        exec(compile(program.replace(address, repr(cluster.scheduler_address)), "cluster.md", "exec"), {})
    assert brinell.DataSet("data").verify() == []
    # The same data set, where the other page has its own.
    os.makedirs("out")
    os.rename("data", "out/nu206")
    seen: dict = {}
    exec(compile(blocks("docs/src/datasets.md"), "datasets.md", "exec"), seen)
    assert len(seen["x"]) == 0.05 * seen["fs"] and str(seen["y"]) in ("healthy", "photo", "None", "nan")
