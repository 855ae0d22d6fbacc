"""This data set for the Python package bearing-datasets, version 0.3:

    bearing-datasets --root ROOT build FOLDER        FOLDER: where this file lies

Reads dataset.json, runs/ and truth/ in the folder above, and nothing else: labels that are held out, and damage where truth/
is not there, are "unknown". The format has no empty cells: a column that one run lacks is left out."""

import hashlib
import json
import math
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq

FOLDER = Path(__file__).resolve().parent.parent
ABOUT = json.loads((FOLDER / "dataset.json").read_text(encoding="utf-8"))
SIGNALS = {column["name"]: column["unit"] for column in ABOUT["columns"] if column["type"] == "list<float>"}
BATCH = 16  # runs whose signals are in memory at a time

FAULTS = {"inner-raceway": "inner", "outer-raceway": "outer", "roller": "rolling_element"}
# Units of the data set, and how the format calls the quantity and the unit.
QUANTITIES = {
    "m/s^2": ("acceleration", "m/s^2"),
    "mV": ("acceleration", "mV"),
    "m/s": ("velocity", "m/s"),
    "m": ("displacement", "m"),
    "N": ("force", "N"),
    "N m": ("torque", "Nm"),
    "rad": ("angle", "rad"),
    "rad/s": ("speed", "unknown"),
}
OF_RUNS = """run split status class sample_rate_hz duration_s analysed_from_s bearing bearings damaged_bearing speed_rpm load_n
    bpfo_hz bpfi_hz bsf_hz ftf_hz machine time_h""".split()
OF_TRUTH = "run defect_on defect_length_mm defect_width_mm defect_depth_um signal_to_noise_db remaining_life_h".split()


def parsed(value):
    """A value as TOML has it; words where JSON has no such value."""
    try:
        return value and json.loads(value)
    except ValueError:
        return value


# The first run's scenario by key; None where a key varies.
KEYS = {key["key"]: parsed(key["value"]) for key in ABOUT["geometry"]["keys"]}
IS_MACHINE = "shaft.stations_mm" in KEYS


# --- what there is


def under(prefix):
    return {key.removeprefix(prefix): value for key, value in KEYS.items() if key.startswith(prefix)}


def listed(name):
    """The tables of that name, in the file's order."""
    numbers = {int(key.split(".")[0]) for key in under(f"{name}.")}
    return [under(f"{name}.{number}.") for number in sorted(numbers)]


BEARINGS = listed("bearing") if IS_MACHINE else [under("bearing.")]
SENSORS = {sensor["name"]: sensor for sensor in listed("sensor")} if IS_MACHINE else {"sensor_out": under("sensor.")}


def distance(bearing, at_mm):
    return math.inf if bearing.get("at_mm") is None or at_mm is None else abs(bearing["at_mm"] - at_mm)


def places():
    """Where each bearing is. Of a machine's two that at the coupling is the drive end, or else the first; the format has no words for
    more."""
    if not IS_MACHINE:
        return ["test_bearing"]
    if len(BEARINGS) != 2:
        return ["machine_bearing"] * len(BEARINGS)
    order = sorted(range(2), key=lambda k: distance(BEARINGS[k], KEYS.get("shaft.coupling.0.at_mm")))
    return ["machine_bearing_de" if k == order[0] else "machine_bearing_nde" for k in range(2)]


PLACES = places()


# --- channels


def housing_of(channel):
    part = channel.split(".")[0]
    return int(part.removeprefix("housing")) if part.startswith("housing") else None


def held_by(housing):
    return [k for k, bearing in enumerate(BEARINGS) if bearing.get("housing", 1) == housing]


def bearing_of(channel):
    """The bearing that a channel is of, or that is nearest to its sensor, from 0."""
    part, _, name = channel.partition(".")
    if part.startswith("bearing"):
        return int(part.removeprefix("bearing")) - 1
    at_mm = SENSORS.get(name, {}).get("at_mm")
    return min(held_by(housing_of(channel)) or range(len(BEARINGS)), key=lambda k: distance(BEARINGS[k], at_mm))


def mounting_of(channel):
    if channel.startswith("shaft."):
        return "shaft"
    if housing := housing_of(channel):
        return "pedestal" if len(held_by(housing)) == 1 else "casing"
    name = channel.split(".")[-1]
    if name.startswith("sensor_"):
        return "casing" if any(key.startswith("sensor.path") for key in KEYS) else "outer_ring"
    return "outer_ring" if name.startswith("outer_") else "none"


def axis_of(channel):
    name = channel.split(".")[-1]
    if name in SENSORS:
        degrees = SENSORS[name].get("direction_deg")
        return "radial" if degrees is None or degrees % 90 else "xy"[int(degrees // 90) % 2]
    last = name.split("_")[-1].rstrip("0123456789")
    return last[-1] if last in ("x", "y", "ax", "ay", "vx", "vy") else "none"


def described(channel, unit):
    quantity, known = QUANTITIES.get(unit, ("unknown", "unknown"))
    place = "rig_shaft" if channel.startswith("shaft.") else PLACES[bearing_of(channel)]
    facts = {
        "sensor_location": place,
        "quantity": quantity,
        "unit": known,
        "axis": axis_of(channel),
        "sensor_mounting": mounting_of(channel),
    }
    if "mV" in SIGNALS.values():
        volts = KEYS.get("sensor.sensitivity_mv_per_m_per_s2")
        facts["sensitivity"] = "none" if unit != "mV" else "unknown" if volts is None else f"{volts} mV/(m/s^2)"
    return facts


CHANNELS = {channel: described(channel, unit) for channel, unit in SIGNALS.items()}


# --- runs


def orders(run, k):
    """Frequencies of bearing `k` over that of the shaft, in pure rolling; None where its geometry is not known."""
    names = ["bpfo", "bpfi", "bsf", "ftf"]
    if k == 0 and run["speed_rpm"] and run.get("bpfo_hz"):
        return {name: round(run[f"{name}_hz"] * 60 / abs(run["speed_rpm"]), 5) for name in names}
    lengths = [BEARINGS[k].get(f"{name}_diameter_mm") for name in ("inner_raceway", "pitch", "roller")]
    rollers = BEARINGS[k].get("rollers_per_row")
    if None in (rollers, *lengths):
        return dict.fromkeys(names)
    inner, pitch, roller = lengths
    cage = inner / (2 * pitch)
    values = [rollers * cage, rollers * (1 - cage), inner / (2 * roller) + cage, cage]
    return dict(zip(names, (round(value, 5) for value in values)))


def speed_profile(run):
    if run["speed_rpm"] is not None:
        return "constant"
    points = KEYS.get("operation.speed_rpm")
    if not isinstance(points, list):
        return "varying"
    times = np.linspace(run["analysed_from_s"] or 0, run["duration_s"], 1000)
    speeds = np.abs(np.interp(times, *np.transpose(points)))
    steps = np.sign(np.diff(np.round(speeds, 6)))
    turns = steps[steps != 0]
    turns = tuple(turns[np.flatnonzero(np.diff(turns, prepend=0))])
    words = {(): "constant", (1,): "increasing", (-1,): "decreasing", (1, -1): "inc_dec", (-1, 1): "dec_inc"}
    return words.get(turns, "varying")


def damage(run):
    """What the truth says of damage, None where it is not known; sizes are those of the longest defect."""
    on = run.get("defect_on")
    sizes = ["fault_size_mm", "fault_width_mm", "fault_depth_um"]
    if on is None:
        words = {"fault_type": "unknown", "fault_location": "unknown", "fault_origin": "unknown"}
        return words | dict.fromkeys(sizes)
    if not on:
        return {"fault_type": "normal", "fault_location": "none", "fault_origin": "none"} | dict.fromkeys(sizes, 0.0)
    faults = [FAULTS[one] for one in FAULTS if one in on]
    place = PLACES[(run.get("damaged_bearing") or 1) - 1]
    longest = int(np.argmax(run["defect_length_mm"]))
    lengths = [run[name][longest] for name in ("defect_length_mm", "defect_width_mm", "defect_depth_um")]
    return {
        "fault_type": "+".join(faults),
        "fault_location": "unknown" if len(PLACES) > 2 else "+".join([place] * len(faults)),
        "fault_origin": "artificial",
        **dict(zip(sizes, lengths)),
    }


def life(run):
    """Of histories; a machine that stays healthy has no end of life."""
    if "machine" not in run:
        return {}
    remaining = run.get("remaining_life_h")
    if remaining is None and run.get("defect_on") is not None:
        remaining = math.inf
    return {
        "run_id": f"machine_{run['machine']:05}",
        "time_s": run["time_h"] * 3600,
        "rul_s": None if remaining is None else remaining * 3600,
    }


def facts_of(run):
    bearings = run.get("bearings") or [run["bearing"]]
    models = {channel: bearings[bearing_of(channel)] or "unknown" for channel in SIGNALS}
    of_channels = {channel: orders(run, bearing_of(channel)) for channel in SIGNALS}
    noisy = [channel for channel in SIGNALS if channel.startswith("sensor_")]
    ratios = dict(zip(noisy, run.get("signal_to_noise_db") or []))
    load = run.get("load_n")
    of_machines = {
        "fault_bearing": run.get("damaged_bearing"),
        "sensor_bearing": {channel: bearing_of(channel) + 1 for channel in SIGNALS},
    }
    return {
        "recording_id": f"run_{run['run']:07}",
        "native_label": run["class"] or "unknown",
        **damage(run),
        "speed_rpm": run["speed_rpm"],
        "speed_profile": speed_profile(run),
        "load": load and math.hypot(*load),
        "load_unit": load and "N",
        "bearing_model": models,
        **{name: {channel: of[name] for channel, of in of_channels.items()} for name in ("bpfo", "bpfi", "bsf", "ftf")},
        **life(run),
        **(of_machines if IS_MACHINE else {}),
        "fs": run["sample_rate_hz"],
        "run": run["run"],
        "split": run["split"],
        "signal_start_s": run["analysed_from_s"] or 0.0,
        "signal_to_noise_db": {channel: ratios.get(channel) for channel in SIGNALS},
        "simulated_by": f"brinell {ABOUT['brinell']}",
    }


def is_lacking(value):
    return None in value.values() if isinstance(value, dict) else value is None


def opened(entry):
    """A Parquet file, once it is found to be the one that was written."""
    path = FOLDER / entry["path"]
    if hashlib.sha256(path.read_bytes()).hexdigest() != entry["sha256"]:
        raise ValueError(f"{path}: its checksum is another than in dataset.json; `brinell dataset verify` says more")
    return pq.ParquetFile(path)


def rows_of(entry, names):
    file = opened(entry)
    return file.read([name for name in names if name in file.schema_arrow.names]).to_pylist()


def complete_runs():
    """What is known of each run that has signals, by its number."""
    truth = {Path(entry["path"]).name: entry for entry in ABOUT.get("truth", []) if (FOLDER / entry["path"]).exists()}
    runs = {}
    for entry in ABOUT["files"]:
        beside = truth.get(Path(entry["path"]).name)
        known = {row["run"]: row for row in rows_of(beside, OF_TRUTH)} if beside else {}
        for run in rows_of(entry, OF_RUNS):
            if run["status"] == "complete":
                runs[run["run"]] = facts_of(known.get(run["run"], {}) | run)
    lacking = {name for facts in runs.values() for name, value in facts.items() if is_lacking(value)}
    return {run: {name: value for name, value in facts.items() if name not in lacking} for run, facts in runs.items()}


def recordings(raw_dir):
    # The package removes it afterwards and makes it for files that it has fetched.
    raw_dir.mkdir(parents=True, exist_ok=True)
    runs = complete_runs()
    for entry in ABOUT["files"]:
        file = pq.ParquetFile(FOLDER / entry["path"])
        for batch in file.iter_batches(BATCH, columns=["run", *SIGNALS]):
            columns = [batch.column(name) for name in SIGNALS]
            for row, run in enumerate(batch.column("run").to_pylist()):
                if run not in runs:
                    continue
                facts = runs[run]
                start = round(facts["signal_start_s"] * facts["fs"])
                there = {name: column[row] for name, column in zip(SIGNALS, columns) if column[row].is_valid}
                signals = {name: samples.values.to_numpy()[start:] for name, samples in there.items()}
                yield {**facts, "signals": signals}
