"""Reads what brinell wrote with SciPy, NumPy and pyuff and compares it with the CSV of the same run. See README.md."""

import json
import sys
import warnings
from pathlib import Path

import numpy as np
import pyuff
import scipy.io
import scipy.io.wavfile

folder = Path(sys.argv[1])
names = (folder / "signals.csv").open().readline().rstrip("\n").split(",")
truth = dict(zip(names, np.loadtxt(folder / "signals.csv", delimiter=",", skiprows=1, ndmin=2).T))
signals = [name for name in names if name != "t"]
fs = round(1 / np.median(np.diff(truth["t"])))


def compare(reader, found, wanted):
    same = np.ascontiguousarray(found).view(np.uint64) == np.ascontiguousarray(wanted).view(np.uint64)
    assert same.all(), f"{reader}: {np.count_nonzero(~same)} values differ"


mat = scipy.io.loadmat(folder / "signals.mat")
assert [name for name in mat if name in truth] == names
for name in names:
    assert mat[name].shape == (len(truth["t"]), 1)
    compare("scipy.io.loadmat", mat[name].ravel(), truth[name])
assert mat["fs"] == fs and mat["brinell_outcome"] == ["complete"]
units = json.loads(mat["brinell_units"][0])
assert list(units) == names or set(units) == set(names)
print(f"scipy.io.loadmat: {len(names)} variables, every bit equal")

with np.load(folder / "signals.npz") as npz:
    for name in names:
        compare("numpy.load", npz[name], truth[name])
    assert npz["fs"] == fs and json.loads(str(npz["brinell_units"])) == units
    assert str(npz["brinell_scenario"]) == mat["brinell_scenario"][0]
print(f"numpy.load: {len(names)} arrays, every bit equal")

uff = pyuff.UFF(str(folder / "signals.uff"))
assert set(uff.get_set_types()) == {58}
sets = uff.read_sets()
sets = sets if isinstance(sets, list) else [sets]
assert [one["id1"].strip() for one in sets] == signals
for one, name in zip(sets, signals):
    compare("pyuff", one["data"], truth[name])
    assert one["ordinate_axis_units_lab"].strip() == units[name] and abs(one["abscissa_inc"] * fs - 1) < 1e-6
print(f"pyuff: {len(sets)} functions, every bit equal")

with warnings.catch_warnings():
    warnings.simplefilter("error")
    rate, wav = scipy.io.wavfile.read(folder / "signals.wav")
assert rate == fs and wav.dtype == np.float32 and wav.shape == (len(truth["t"]), len(signals))
for column, name in zip(wav.T, signals):
    assert np.array_equal(column, truth[name].astype(np.float32)), name
print(f"scipy.io.wavfile: {len(signals)} channels at {rate} Hz, equal as 32-bit floats")
