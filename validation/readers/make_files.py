"""Writes the test files of crates/brinell-io/tests/data with other people's libraries. See README.md."""

import decimal
import struct
import sys
import wave
from pathlib import Path

import h5py
import hdf5storage
import nptdms
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pyuff
import scipy.io
import scipy.io.wavfile

out = Path(sys.argv[1])
out.mkdir(parents=True, exist_ok=True)

N = 300
i = np.arange(N)


def signal(k):
    """Channel k, exact in half-precision floats and in whole eighths; tests/common/mod.rs has the same."""
    return ((i * (37 + k) + 11 * k) % 101 - 50) / 8


def column(k):
    return signal(k)[:, None]


# --- MATLAB v5, v7: laid out like the CWRU, MFPT and Paderborn data.
cwru = {"X097_DE_time": column(0), "X097_FE_time": column(1), "X097RPM": np.array([[1796.0]])}
scipy.io.savemat(out / "cwru_v5.mat", cwru, do_compression=False)
scipy.io.savemat(out / "cwru_v7.mat", cwru, do_compression=True)
mfpt = {"bearing": {"sr": 97656.0, "gs": column(2), "load": 270.0, "rate": 25.0}}
scipy.io.savemat(out / "mfpt.mat", mfpt, do_compression=True)


def structs(fields, rows):
    array = np.zeros((1, len(rows)), dtype=[(f, object) for f in fields])
    for n, row in enumerate(rows):
        array[0, n] = tuple(row)
    return array


paderborn = {
    "N09_M07_F10_K001_1": {
        "Info": {"Application": "made up", "Date": "2026-01-01"},
        "X": structs(["Name", "Data"], [["Time_64k", signal(3)[None, :]], ["Time_4k", signal(4)[None, :]]]),
        "Y": structs(
            ["Name", "Raster", "Data"],
            [["force", "Mech_4kHz", signal(5)[None, :]], ["vibration_1", "HostService", signal(6)[None, :]]],
        ),
    }
}
raster = {
    "N15": {
        "X": structs(
            ["Name", "Data", "Unit", "Raster"],
            [["Time", i[None, :] / 4000, "s", "HostService"], ["Time", i[None, :20] / 250, "s", "Mech_4kHz"]],
        ),
        "Y": structs(
            ["Name", "Data", "Unit", "Raster", "XIndex"],
            [
                ["speed", signal(5)[None, :20], "rpm", "Mech_4kHz", 2.0],
                ["vibration_1", signal(6)[None, :], "m/s^2", "HostService", 1.0],
            ],
        ),
    }
}
scipy.io.savemat(out / "raster.mat", raster, do_compression=True)
testlab = {
    "Signal_0": {
        "x_values": {"start_value": 0.0, "increment": 1 / 51200, "number_of_values": 300.0, "quantity": {"label": "s"}},
        "y_values": {"values": column(7), "quantity": {"label": "g"}},
    }
}
scipy.io.savemat(out / "testlab.mat", testlab, do_compression=True)
scipy.io.savemat(out / "paderborn.mat", paderborn, do_compression=True, long_field_names=True)
scipy.io.savemat(out / "paderborn_v6.mat", paderborn, do_compression=False, long_field_names=True)
cell = np.empty((1, 2), dtype=object)
cell[0, 0], cell[0, 1] = column(7), "a word"
kinds = {
    "i8": (8 * signal(0)).astype("i1"),
    "u8": (8 * signal(0) + 64).astype("u1"),
    "i16": (8 * signal(0)).astype("i2"),
    "u16": (8 * signal(0) + 64).astype("u2"),
    "i32": (8 * signal(0)).astype("i4"),
    "u32": (8 * signal(0) + 64).astype("u4"),
    "i64": (8 * signal(0)).astype("i8"),
    "u64": (8 * signal(0) + 64).astype("u8"),
    "single": signal(0).astype("f4"),
    "complex": signal(0) + 1j,
    "logical": signal(0) > 0,
    "matrix": np.column_stack([signal(1), signal(2), signal(3)]),
    "cell": cell,
    "empty": np.zeros((0, 0)),
    "title": "Prüfstand",
    "sparse": scipy.sparse.csc_array(np.eye(3)),
    "fs": np.array([[25600.0]]),
}
scipy.io.savemat(out / "kinds.mat", kinds, do_compression=False)
scipy.io.savemat(out / "v4.mat", {"x": column(0)}, format="4")


# --- HDF5. MATLAB's own v7.3 files: a user block with MATLAB's header, classes as attributes, references for struct arrays.
def matlab_v73(path):
    with h5py.File(path, "w", userblock_size=512, libver="earliest") as file:
        references = file.create_group("#refs#")

        def put(group, name, values, kind, **options):
            data = group.create_dataset(name, data=np.ascontiguousarray(np.atleast_2d(values).T), **options)
            data.attrs["MATLAB_class"] = np.bytes_(kind)
            return data

        def text(group, name, words):
            data = put(group, name, np.frombuffer(words.encode("utf-16-le"), "u2"), "char")
            data.attrs["MATLAB_int_decode"] = np.int32(2)

        put(file, "acc", column(0), "double", chunks=(1, 64), compression=3)
        put(file, "row", signal(1), "double")
        put(file, "counts", (8 * column(2)).astype("i2"), "int16", chunks=(1, 128), compression=9, shuffle=True)
        put(file, "matrix", np.column_stack([signal(3), signal(4)]), "double", chunks=(1, 100), compression=3)
        put(file, "fs", 25600.0, "double")
        text(file, "title", "Prüfstand")
        none = put(file, "none", np.array([0, 0], "u8"), "double")
        none.attrs["MATLAB_empty"] = np.uint8(1)
        bearing = file.create_group("bearing")
        bearing.attrs["MATLAB_class"] = np.bytes_("struct")
        put(bearing, "gs", column(5), "double")
        put(bearing, "sr", 97656.0, "double")
        y = file.create_group("Y")
        y.attrs["MATLAB_class"] = np.bytes_("struct")
        for field in ["Name", "Data"]:
            links = np.empty((2, 1), dtype=h5py.ref_dtype)
            for k in range(2):
                name = f"{field}{k}"
                if field == "Data":
                    put(references, name, signal(6 + k), "double")
                else:
                    text(references, name, ["force", "vibration_1"][k])
                links[k, 0] = references[name].ref
            y.create_dataset(field, data=links)
        cell = np.empty((1, 1), dtype=h5py.ref_dtype)
        cell[0, 0] = references["Data0"].ref
        file.create_dataset("cell", data=cell).attrs["MATLAB_class"] = np.bytes_("cell")
    header = b"MATLAB 7.3 MAT-file, Platform: GLNXA64, Created on: Thu Jan  1 00:00:00 2026 HDF5 schema 1.00 ."
    with open(path, "r+b") as file:
        file.write(header.ljust(116) + bytes(8) + b"\x00\x02IM")


matlab_v73(out / "v73.mat")
hdf5storage.savemat(str(out / "v73_hdf5storage.mat"), {"acc": column(0), "fs": 25600.0}, format="7.3", store_python_metadata=False)
with h5py.File(out / "latest.h5", "w", libver=("v110", "v110")) as file:
    data = file.create_dataset("run/acc", data=signal(0), chunks=(77,), compression=4, shuffle=True, fletcher32=True)
    data.attrs["units"] = "m/s^2"
    file.create_dataset("run/big", data=signal(1).astype(">f4"))
    file.create_dataset("run/growing", data=signal(2), chunks=(50,), maxshape=(None,), compression="lzf")
    file.create_dataset("run/matrix", data=np.column_stack([signal(3), signal(4)]), chunks=(64, 2), compression=4)
    file.create_dataset("run/fs", data=51200.0)
    file.create_dataset("run/half", shape=(100,), chunks=(10,), dtype="f8")[:10] = 1.0

# Packed as netCDF does it, and with a factor of nobody's convention.
with h5py.File(out / "packed.h5", "w", libver="earliest") as file:
    counts = (8 * signal(0)).astype("<i2")
    file.attrs["sample_rate"] = 4000
    acc = file.create_dataset("acc", data=counts)
    acc.attrs.update(scale_factor=0.25, add_offset=1.5, units="g")
    counts[7] = -999
    chunked = file.create_dataset("chunked", data=counts, chunks=(64,), compression="gzip")
    chunked.attrs.update(scale_factor=np.float32(0.25), _FillValue=np.int16(-999), units="g")
    gained = file.create_dataset("gained", data=counts)
    gained.attrs.update(gain=0.25, units="g")
    file.create_dataset("counts", data=(8 * signal(0)).astype("<i2")).attrs["gain"] = 0.25

with h5py.File(out / "groups.h5", "w", libver="earliest") as file:
    for group, hz in [("fast", 12000), ("slow", 6000)]:
        file.create_dataset(f"{group}/time", data=np.arange(300) / hz).attrs["units"] = "s"
        file.create_dataset(f"{group}/acc", data=signal(0), chunks=(77,), fletcher32=True)
    file.create_dataset("slow/half", data=signal(4).astype("f2"))
    file["fast/link"] = h5py.SoftLink("/slow/half")
    file["nowhere"] = h5py.SoftLink("/none")
    file["elsewhere"] = h5py.ExternalLink("other.h5", "/none")
    file["slow/circle"] = file["slow"]
    file["slow/top"] = file["/"]

# --- NumPy.
np.save(out / "f8.npy", signal(0))
np.save(out / "f4_matrix.npy", np.asfortranarray(np.column_stack([signal(1), signal(2)]).astype("f4")))
np.save(out / "i2_big.npy", (8 * signal(3)).astype(">i2"))
np.save(out / "f2.npy", signal(4).astype("f2"))
np.savez(out / "plain.npz", acc=signal(0), pair=np.column_stack([signal(1), signal(2)]), fs=25600.0, title="Prüfstand")
np.savez(out / "clocks.npz", time_s=np.arange(300) / 12000, acc=signal(0), slow=signal(1)[:150])
np.savez_compressed(out / "packed.npz", acc=signal(0), number=np.int32(3), z=signal(0) + 1j)

# --- Parquet: what others compress with, and columns that lie within each other.
flat = pa.table({"acc": signal(0), "count": (8 * signal(1)).astype("i4"), "single": signal(2).astype("f4")})
for codec in ["gzip", "lz4", "snappy", "brotli"]:
    pq.write_table(flat, out / f"{codec}.parquet", compression=codec)
nested = {
    "label": ["healthy", "outer"],
    "load": [100.0, 200.0],
    "acc": pa.array([signal(0), signal(1)], pa.list_(pa.float32())),
    "bearing": [{"bore": 30.0, "name": "a"}, {"bore": 35.0, "name": "b"}],
}
pq.write_table(pa.table(nested), out / "nested.parquet", compression="zstd")
# Eighths have three decimal places.
places = [decimal.Decimal(str(x)) for x in signal(1)]
numbers = pa.table({
    "half": signal(0).astype("f2"),
    "decimal": pa.array(places, pa.decimal128(9, 3)),
    "wide": pa.array(places, pa.decimal128(38, 5)),
    "whole": np.abs(8 * signal(2)).astype("u4") + 4_000_000_000,
    "day": pa.array(np.arange(300) % 2 == 0),
})
pq.write_table(numbers, out / "numbers.parquet", compression="snappy")
# The same decimals as whole numbers of four bytes.
pq.write_table(numbers.select(["decimal"]), out / "integers.parquet", store_decimal_as_integer=True)

# --- WAV.
both = 8 * np.column_stack([signal(0), signal(1)])
scipy.io.wavfile.write(out / "u8.wav", 12000, (both + 128).astype("u1"))
scipy.io.wavfile.write(out / "i16.wav", 12000, both.astype("i2"))
scipy.io.wavfile.write(out / "i32.wav", 12000, both.astype("i4"))
scipy.io.wavfile.write(out / "f32.wav", 48000, both.astype("f4") / 8)
scipy.io.wavfile.write(out / "f64.wav", 48000, both / 8)
with wave.open(str(out / "i24.wav"), "wb") as file:
    file.setnchannels(2)
    file.setsampwidth(3)
    file.setframerate(12000)
    file.writeframes(b"".join(struct.pack("<i", int(v))[:3] for v in both.ravel()))
frames = both.astype("<i2").tobytes()
extensible = struct.pack("<HHIIHHHHI", 0xFFFE, 2, 12000, 48000, 4, 16, 22, 16, 3) + bytes.fromhex("0100000000001000800000aa00389b71")
body = b"WAVEfmt " + struct.pack("<I", len(extensible)) + extensible + b"odd " + struct.pack("<I", 3) + b"abc\0" + b"data" + struct.pack("<I", len(frames)) + frames
(out / "extensible.wav").write_bytes(b"RIFF" + struct.pack("<I", len(body)) + body)

# --- UFF 58.
x = i / 25600


def function(name, k, **more):
    return {
        "type": 58, "func_type": 1, "rsp_node": 1, "rsp_dir": 1, "ref_dir": 1, "ref_node": 1, "data": signal(k), "x": x,
        "id1": name, "id2": "made up", "abscissa_spacing": 1, "abscissa_spec_data_type": 17, "ordinate_spec_data_type": 12,
        "ordinate_axis_units_lab": "m/s^2", "abscissa_axis_units_lab": "s", "abscissa_inc": 1 / 25600, "abscissa_min": 0.0, "orddenom_spec_data_type": 0,
        **more,
    }  # fmt: skip


for name, binary in [("ascii.uff", 0), ("binary.uff", 1)]:
    (out / name).unlink(missing_ok=True)
    file = pyuff.UFF(str(out / name))
    sets = [function("acc x", 0, ord_data_type=4), function("uneven", 2, ord_data_type=4, abscissa_spacing=0)]
    if not binary:  # pyuff writes doubles under a header that says singles
        sets += [function("acc y", 1, ord_data_type=2), function("single", 3, ord_data_type=2, abscissa_spacing=0)]
    sets += [function("complex", 4, ord_data_type=6) | {"data": signal(4) + 1j}]
    for one in sets:
        file._write_set(one | {"binary": binary}, "add", force_double=False)


# --- Text.
def table(name, columns, delimiter, head="", form="%.3f", end="\n", decimal="."):
    rows = [delimiter.join((form % v).replace(".", decimal) for v in row) for row in np.column_stack(columns)]
    (out / name).write_text(head + end.join(rows) + end, newline="")


pair = [signal(0), signal(1)]
table("xjtu.csv", pair, ",", "Horizontal_vibration_signals,Vertical_vibration_signals\n", "%.15g")
table("ims.txt", [signal(k) for k in range(8)], "\t")
femto = [np.full(N, 9), np.full(N, 39), np.full(N, 39), 65664.0 + 39 * i, *pair]
table("femto.csv", femto, ",", form="%g")
table("femto_semicolon.csv", femto, ";", form="%g", end="\r\n")
table("comma.csv", [x, *pair], ";", "Zeit [s];Kanal 1 [m/s²];Kanal 2\r\n", "%.9f", "\r\n", ",")
table("units.csv", [x, *pair], ",", "time,acc x,acc y\ns,g,(g)\n", "%.9f")
table("blanks.dat", pair, "  ", "# made up\n# x y\n", "%9.4f")
lvm = """LabVIEW Measurement\t
Writer_Version\t2
Reader_Version\t2
Separator\tTab
Decimal_Separator\t,
Multi_Headings\tNo
X_Columns\tNo
Time_Pref\tRelative
***End_of_Header***\t
\t
Channels\t2\t\t
Samples\t300\t300\t
Y_Unit_Label\tm/s^2\tVolts\t
X_Dimension\tTime\tTime\t
X0\t0,0E+0\t0,0E+0\t
Delta_X\t0,000040\t0,000040\t
***End_of_Header***\t\t\t
X_Value\tAcceleration\tVoltage\tComment
"""
(out / "labview.lvm").write_text(lvm + "".join(f"\t{a:.6f}\t{b:.6f}\n".replace(".", ",") for a, b in zip(*pair)))

# --- TDMS: two segments, a waveform in g, counts with a linear scaling, single values, texts.
counts = (8 * signal(1)).astype(np.int16)
scaled = {
    "NI_Number_Of_Scales": np.int32(1),
    "NI_Scale[0]_Scale_Type": "Linear",
    "NI_Scale[0]_Linear_Slope": 0.125,
    "NI_Scale[0]_Linear_Y_Intercept": 1.5,
    "NI_Scale[0]_Linear_Input_Source": np.uint32(0xFFFFFFFF),
    "NI_Scaling_Status": "unscaled",
    "unit_string": "V",
}
polynomial = {"NI_Number_Of_Scales": np.int32(1), "NI_Scale[0]_Scale_Type": "Polynomial"}
wave = {"wf_increment": 1 / 25600, "wf_start_offset": 0.0, "unit_string": "g"}
with nptdms.TdmsWriter(str(out / "segments.tdms")) as file:
    root = nptdms.RootObject(properties={"title": "made up", "runs": np.int32(2)})
    for part in np.split(i, [100]):
        file.write_segment([
            root,
            nptdms.ChannelObject("it's a rig", "acc", signal(0)[part], properties=wave),
            nptdms.ChannelObject("it's a rig", "counts", counts[part], properties=scaled),
            nptdms.ChannelObject("it's a rig", "bent", counts[part], properties=polynomial),
            nptdms.ChannelObject("it's a rig", "remarks", ["one", "two"]),
        ])
# Values in turns, which no other library writes: made of a segment of values one after the other.
with nptdms.TdmsWriter(str(out / "interleaved.tdms")) as file:
    file.write_segment([
        nptdms.ChannelObject("rig", "a", counts, properties=wave),
        nptdms.ChannelObject("rig", "b", signal(2)),
    ])
data = bytearray((out / "interleaved.tdms").read_bytes())
start = 28 + int.from_bytes(data[20:28], "little")
data[start:] = b"".join(a.tobytes() + b.tobytes() for a, b in zip(counts, signal(2)))
data[4] |= 1 << 5
(out / "interleaved.tdms").write_bytes(data)
with nptdms.TdmsFile(out / "interleaved.tdms") as file:
    assert np.array_equal(file["rig"]["a"][:], counts) and np.array_equal(file["rig"]["b"][:], signal(2))
