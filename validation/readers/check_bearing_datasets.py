"""Data sets of `brinell dataset`, built and read by the Python package bearing-datasets: python check_bearing_datasets.py FOLDER FOLDER...

The first FOLDER holds labels out, and one is of a machine. See README.md."""

import json
import pathlib
import subprocess
import sys
import tempfile

import bearing_datasets as bd
import numpy as np
import pandas as pd
from bearing_datasets.schema import REQUIRED

FAULTS = {"inner-raceway": "inner", "outer-raceway": "outer", "roller": "rolling_element"}


def command(root, *words):
    done = subprocess.run([sys.executable, "-m", "bearing_datasets.cli", "--root", root, *words], capture_output=True, text=True)
    assert done.returncode == 0, (words, done.stdout, done.stderr)
    return done.stdout


def check(folder, root):
    """Builds a data set and holds it against its Parquet files; its name."""
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
    return name, meta, runs


with tempfile.TemporaryDirectory() as root:
    done, metas = set(), {}
    for folder in map(pathlib.Path, sys.argv[1:]):
        name, meta, runs = check(folder, root)
        done.add(name)
        metas[name] = meta
        if "bearings" in runs:
            near = meta.channel.map({"housing1.drive_end": 1, "housing1.fan_end": 2, "bearing2.cage1_speed": 2, "shaft.x1": -1})
            assert (meta.sensor_at_fault == (near == meta.run.map(runs.damaged_bearing))).all() and meta.sensor_at_fault.any()
            assert (meta.fault_bearing == meta.run.map(runs.damaged_bearing)).all()
            assert len(runs) < json.loads((folder / "dataset.json").read_text())["runs"]["total"]
            assert dict(zip(meta.channel, meta.bearing_model))["housing1.fan_end"] == "6203"
            assert dict(zip(meta.channel, meta.quantity))["shaft.x1"] == "displacement" and "load" not in meta
        else:
            assert (meta.load == meta.run.map(runs.load_n.map(lambda load: np.hypot(*load)))).all() and (meta.load_unit == "N").all()
    held, *_ = metas.values()
    assert "unknown" in set(held.fault_type) and "fault_size_mm" not in held
    assert any("rul_s" in meta and np.isinf(meta.rul_s).any() for meta in metas.values())
    beside = bd.load_metadata(list(metas), root=root)
    assert len(beside) == sum(map(len, metas.values())) and set(beside.dataset) == set(metas)
    common = {"fault_origin", "quantity", "unit", "axis", "sensor_mounting", "speed_rpm", "speed_profile", "bearing_model", "bpfo", "bpfi", "bsf", "ftf"}
    assert set(REQUIRED) | common <= set(beside.columns), beside.columns
print(f"bearing-datasets {bd.__version__}: {', '.join(metas)} built and read, every sample as in the Parquet files")
