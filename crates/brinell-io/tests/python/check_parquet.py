"""Reads brinell's CSV and Parquet of the same run with other people's libraries and compares them bit by bit.

    brinell run examples/single-row.toml -o /tmp/brinell-io --signals csv,parquet
    python3 -m venv /tmp/venv-io && /tmp/venv-io/bin/pip install pyarrow pandas polars
    /tmp/venv-io/bin/python crates/brinell-io/tests/python/check_parquet.py /tmp/brinell-io
"""

import json
import sys
from pathlib import Path

import numpy as np
import pandas as pd
import polars as pl
import pyarrow.parquet as pq

folder = Path(sys.argv[1])
csv, parquet = folder / "signals.csv", folder / "signals.parquet"

names = csv.open().readline().rstrip("\n").split(",")
truth = np.loadtxt(csv, delimiter=",", skiprows=1, ndmin=2)


def compare(reader, found_names, values):
    assert list(found_names) == names, reader
    same = np.ascontiguousarray(values).view(np.uint64) == truth.view(np.uint64)
    assert same.all(), f"{reader}: {np.count_nonzero(~same)} values differ"
    print(f"{reader}: {truth.shape[0]} rows x {truth.shape[1]} columns, every bit equal")


frame = pd.read_csv(csv)
compare("pandas.read_csv", frame.columns, frame.to_numpy())
table = pq.read_table(parquet)
compare("pyarrow", table.column_names, np.column_stack([c.to_numpy() for c in table.columns]))
frame = pd.read_parquet(parquet)
compare("pandas.read_parquet", frame.columns, frame.to_numpy())
units = frame.attrs["units"]
frame = pl.read_parquet(parquet)
compare("polars", frame.columns, frame.to_numpy())

metadata = pq.read_metadata(parquet)
pairs = {key.decode(): value.decode() for key, value in metadata.metadata.items()}
assert json.loads(pairs["brinell.units"]) == units and set(units) == set(names)
assert pairs["brinell.outcome"] == "complete"
print(metadata, "brinell.scenario:", repr(pairs["brinell.scenario"]), sep="\n")
