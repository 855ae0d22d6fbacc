"""Data sets of `brinell dataset`, built and read by the Python package bearing-datasets: python check_bearing_datasets.py FOLDER FOLDER...

The first FOLDER holds labels out; one is of a machine, and one of histories. See README.md."""

import json
import pathlib
import subprocess
import sys
import tempfile

import bearing_datasets as bd
import numpy as np
import pandas as pd
from bearing_datasets.bearings import fault_orders
from bearing_datasets.schema import REQUIRED

FAULTS = {"inner-raceway": "inner", "outer-raceway": "outer", "roller": "rolling_element"}


def command(root, *words):
    done = subprocess.run([sys.executable, "-m", "bearing_datasets.cli", "--root", root, *words], capture_output=True, text=True)
    assert done.returncode == 0, (words, done.stdout, done.stderr)
    return done.stdout


def check(folder, root, done):
    """Builds a data set beside those that are done and holds it against its Parquet files; its name and its table."""
    about = json.loads((folder / "dataset.json").read_text())
    before = {path for path in folder.rglob("*") if "__pycache__" not in path.parts}
    told = command(root, "build", str(folder / "bearing_datasets"))
    assert "doi:10.1007/s11071-023-09164-5" in told, told
    assert {path for path in folder.rglob("*") if "__pycache__" not in path.parts} == before
    (name,) = {path.parent.name for path in pathlib.Path(root).glob("*/metadata.parquet")} - done
    assert name.isidentifier() and ": OK" in command(root, "verify", name)
    assert about["brinell"] in command(root, "info", name)

    runs = pd.read_parquet(folder / "runs").query("status == 'complete'").set_index("run")
    truth = pd.read_parquet(folder / "truth").set_index("run")
    channels = [column["name"] for column in about["columns"] if column["type"] == "list<float>"]
    data = bd.open(name, root=root)
    meta = data.metadata()
    assert sorted(zip(meta.run, meta.channel)) == sorted((run, channel) for run in runs.index for channel in channels)
    assert meta.recording_id.nunique() == len(runs) and meta.simulated_by.unique().tolist() == [f"brinell {about['brinell']}"]
    for row in meta.itertuples():
        run = runs.loc[row.run]
        wanted = run[row.channel][round(run.analysed_from_s * run.sample_rate_hz) :]
        found = data.signal(row.signal_id)
        assert found.dtype == np.float32 and len(found) == row.n_samples > 0 and np.array_equal(found, wanted)
        assert row.fs == run.sample_rate_hz and row.signal_start_s == run.analysed_from_s and row.split == run.split
        if row.unit == "m/s^2":
            assert row.quantity == "acceleration" and np.array_equal(data.signal(row.signal_id, unit="m/s^2"), wanted.astype(float))
            # The package converts in the precision of what is stored.
            assert np.allclose(data.signal(row.signal_id, unit="g") * 9.80665, wanted, rtol=4 * np.finfo(np.float32).eps, atol=0)
        assert row.speed_rpm == run.speed_rpm and row.speed_profile == "constant"
        if run.split == "held_out":
            assert (row.native_label, row.fault_type, row.fault_location, row.fault_origin) == ("unknown",) * 4 and not row.sensor_at_fault
            continue
        damage = truth.loc[row.run]
        assert row.native_label == run["class"]
        faults = "+".join(sorted({FAULTS[on] for on in damage.defect_on})) or "normal"
        assert (row.fault_type, row.fault_origin) == (faults, "artificial" if len(damage.defect_on) else "none")
        if "fault_size_mm" in meta:
            longest = np.argmax(damage.defect_length_mm) if len(damage.defect_on) else None
            sizes = [0, 0, 0] if longest is None else [damage[f"defect_{n}"][longest] for n in ("length_mm", "width_mm", "depth_um")]
            assert [row.fault_size_mm, row.fault_width_mm, row.fault_depth_um] == sizes
        if "life_h" in truth:
            assert (row.run_id, row.time_s) == (f"machine_{run.machine:05}", 3600 * run.time_h)
            assert row.rul_s == (np.inf if np.isnan(damage.life_h) else 3600 * damage.remaining_life_h)
    # Frequencies in the Parquet files are of the first bearing, and so is the shaft's channel.
    first = meta[meta.channel == ("shaft.x1" if "shaft.x1" in channels else channels[0])].set_index("run")
    for order in ["bpfo", "bpfi", "bsf", "ftf"]:
        wanted = runs[f"{order}_hz"] * 60 / runs.speed_rpm
        assert first.index.tolist() == wanted.index.tolist() and ((first[order] - wanted).abs() < 5.01e-6).all()  # has five decimals
    (check_machine if "bearings" in runs else check_load)(meta, runs, about)
    return name, meta


def check_load(meta, runs, _):
    assert (meta.load == meta.run.map(runs.load_n.map(lambda load: np.hypot(*load)))).all() and (meta.load_unit == "N").all()


def check_machine(meta, runs, about):
    near = meta.channel.map({"housing1.drive_end": 1, "housing1.fan_end": 2, "bearing2.cage1_speed": 2, "shaft.x1": -1})
    damaged = meta.run.map(runs.damaged_bearing)
    assert (meta.sensor_at_fault == (near == damaged)).all() and meta.sensor_at_fault.any()
    assert (meta.fault_bearing == damaged).all() and "load" not in meta
    assert len(runs) < about["runs"]["total"]
    shaft, fan_end = [meta[meta.channel == channel].iloc[0] for channel in ("shaft.x1", "housing1.fan_end")]
    assert (shaft.quantity, shaft.unit) == ("displacement", "m")
    assert (fan_end.sensor_location, fan_end.sensor_bearing, fan_end.bearing_model) == ("machine_bearing_nde", 2, "6203")
    # The second bearing's frequencies by the package's own formulas.
    keys = {key["key"]: key["value"] for key in about["geometry"]["keys"]}
    sizes = [float(keys[f"bearing.1.{key}"]) for key in ("rollers_per_row", "roller_diameter_mm", "pitch_diameter_mm")]
    assert all(abs(fan_end[name] - order) < 1.01e-5 for name, order in fault_orders(*sizes).items()), fan_end


with tempfile.TemporaryDirectory() as root:
    metas = {}
    for folder in map(pathlib.Path, sys.argv[1:]):
        name, meta = check(folder, root, set(metas))
        metas[name] = meta
    held, *_ = metas.values()
    assert "unknown" in set(held.fault_type) and "fault_size_mm" not in held
    assert any("fault_bearing" in meta for meta in metas.values())
    assert any("rul_s" in meta and np.isinf(meta.rul_s).any() for meta in metas.values())
    beside = bd.load_metadata(list(metas), root=root)
    assert len(beside) == sum(map(len, metas.values())) and set(beside.dataset) == set(metas)
    common = {"fault_origin", "quantity", "unit", "axis", "sensor_mounting", "speed_rpm", "speed_profile", "bearing_model", "bpfo", "bpfi", "bsf", "ftf"}
    assert set(REQUIRED) | common <= set(beside.columns), beside.columns
print(f"bearing-datasets {bd.__version__}: {', '.join(metas)} built and read, every sample as in the Parquet files")
