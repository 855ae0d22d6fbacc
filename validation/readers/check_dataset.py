"""A data set of `brinell dataset`, read by pandas, pyarrow, fastparquet, Hugging Face datasets and mlcroissant: python check_dataset.py FOLDER"""

import hashlib
import json
import pathlib
import sys
import tempfile

import datasets
import fastparquet
import mlcroissant
import numpy as np
import pandas as pd
import pyarrow as pa
import pyarrow.parquet as pq

folder = pathlib.Path(sys.argv[1])
about = json.loads((folder / "dataset.json").read_text())
secret = json.loads((folder / "held_out/_plan.json").read_text())
for entry in about["files"] + about["truth"] + secret["files"]:
    data = (folder / entry["path"]).read_bytes()
    assert hashlib.sha256(data).hexdigest() == entry["sha256"], entry
    assert len(data) == entry["bytes"], entry

tables = {name: pq.read_table(folder / name) for name in ("runs", "truth")}
types = {
    "bool": pa.bool_(), "int64": pa.int64(), "double": pa.float64(), "string": pa.string(),
    "list<float>": pa.list_(pa.float32()), "list<int64>": pa.list_(pa.int64()),
    "list<double>": pa.list_(pa.float64()), "list<string>": pa.list_(pa.string()),
}
for name, table in tables.items():
    listed = [c["name"] for c in about["columns"] if c["table"] == name or c["name"] == "run"]
    assert listed == table.column_names, name
for column in about["columns"]:
    found, expected = tables[column["table"]].schema.field(column["name"]).type, types[column["type"]]
    same = found == expected or (pa.types.is_list(found) and found.value_type == expected.value_type)
    assert same, (column, found)

runs = pd.read_parquet(folder / "runs")
truth = pd.read_parquet(folder / "truth")
assert sorted(runs.run) == list(range(about["runs"]["total"]))
# Each file's runs are for one thing, and the files are in the order of the splits.
for entry in about["files"]:
    part = pd.read_parquet(folder / entry["path"], columns=["run", "split"])
    assert (part.split == entry["split"]).all() and part.run.is_monotonic_increasing
assert {s["name"]: s["runs"] for s in about["splits"]} == runs.split.value_counts().to_dict()
held = runs.split == "held_out"
labels = pd.read_parquet(folder / "held_out")
assert labels.run.tolist() == runs.run[held].tolist() and 0 < held.sum() < len(runs)
assert runs["class"][held].isna().all() and runs["class"][~held].notna().all()
for _, run in runs.iterrows():
    expected = round(run.duration_s * run.sample_rate_hz)
    for signal in ["sensor_ax", "sensor_ay"]:
        x = run[signal]
        assert x.dtype == np.float32 and x.shape == (expected,) and np.isfinite(x).all() and x.std() > 0
# Beside every file of open runs lies that of their truth.
for entry in about["truth"]:
    beside = pd.read_parquet(folder / entry["path"].replace("truth/", "runs/"), columns=["run"])
    assert beside.run.tolist() == pd.read_parquet(folder / entry["path"], columns=["run"]).run.tolist()
assert sorted(truth.run) == sorted(runs.run[~held])
whole = runs.set_index("run").combine_first(labels.set_index("run")).combine_first(truth.set_index("run")).reset_index()
names = {c["label"]: c["name"] for c in about["classes"]}
assert [names[label] for label in whole.label] == whole["class"].tolist()
for _, run in whole.iterrows():
    assert (len(run.entry_t_s) > 0) == (run["class"] == "outer")
    assert len(run.entry_t_s) == len(run.entry_force_n) == len(run.entry_side)
some = pq.read_table(folder / "runs", columns=["operation.speed_rpm", "sensor_ax"])
assert some.column_names == ["operation.speed_rpm", "sensor_ax"] and some.num_rows == len(runs)
for entry in about["files"]:
    whole_file = fastparquet.ParquetFile(str(folder / entry["path"])).to_pandas()
    assert len(whole_file) == entry["rows"] and len(whole_file.sensor_ax[0]) == 1280
with tempfile.TemporaryDirectory() as cache:
    loaded = datasets.load_dataset(str(folder), cache_dir=cache)
    assert {name: split.num_rows for name, split in loaded.items()} == {s["name"]: s["runs"] for s in about["splits"]}
    assert len(loaded["train"][0]["sensor_ax"]) == 1280
    beside = datasets.load_dataset(str(folder), "truth", cache_dir=cache)
    assert all(split["run"] == loaded[name]["run"] for name, split in beside.items()) and "held_out" not in beside
card = mlcroissant.Dataset(jsonld=str(folder / "croissant.json"))
assert not card.metadata.issues.errors
assert sorted(record["run/run"] for record in card.records("run")) == sorted(runs.run)
assert sorted(record["run_truth/run"] for record in card.records("run_truth")) == sorted(truth.run)
print(f"{folder}: {len(runs)} runs, {held.sum()} of them with labels apart, as dataset.json says")
