"""What is read of a data set, and what of it tells a label."""

import hashlib
import subprocess

import numpy as np
import pytest

import brinell

# Runs are short on purpose, and their plans are warned of.
pytestmark = pytest.mark.filterwarnings("ignore::brinell.ScenarioWarning")

LEAKS = """
name = "leaks"
base = "base.toml"
runs = 480
seed = 5
design = "random"
runs_per_file = 60
held_out = 0.3
secret = "9f86d081884c7d659a2feaa0c55ad015"
signals = ["sensor_ax"]

[split]
test = 0.3

[vary]
simulation.duration_s = 0.003
operation.speed_rpm = { uniform = [900, 3000] }
operation.load_n = [{ uniform = [200, 400] }, 0.0]

[[classes]]
name = "healthy"
defects = []

[[classes]]
name = "outer"
[[classes.defects]]
on = "outer-raceway"
depth_um = { log = [3, 40] }
shape.rectangle = { length_mm = 2.0, width_mm = 4.0 }

[[classes]]
name = "inner"
[[classes.defects]]
on = "inner-raceway"
depth_um = { log = [3, 40] }
shape.rectangle = { length_mm = 2.0, width_mm = 4.0 }
"""


def test_prop_nothing_but_the_signal_tells_a_label(tmp_path, examples):
    """A forest is trained on all that is published beside the signal of a run without a label, and guesses."""
    ensemble = pytest.importorskip("sklearn.ensemble")
    pandas = pytest.importorskip("pandas")
    (tmp_path / "base.toml").write_bytes((examples / "rectangle.toml").read_bytes())
    (tmp_path / "plan.toml").write_text(LEAKS)
    brinell.Plan(tmp_path / "plan.toml").run(tmp_path / "data")
    rows = pandas.concat([pandas.read_parquet(file).assign(place=lambda r: range(len(r))) for file in sorted((tmp_path / "data/runs").glob("*.parquet"))], ignore_index=True)
    held = rows["split"] == "held_out"
    beside = [c for c in rows if rows.loc[held, c].notna().all() and c not in ("sensor_ax", "split")]
    assert "class" not in beside and {"run", "speed_rpm", "operation.load_n.0"} <= set(beside)
    # Of runs with a label no more is published among the runs than of those without.
    assert set(rows) - set(beside) == {"class", "label", "reason", "sensor_ax", "split"}

    def number(value):
        value = value[0] if isinstance(value, (list, np.ndarray)) else value
        return float(int(hashlib.sha256(value.encode()).hexdigest()[:6], 16)) if isinstance(value, str) else float(value)

    known = pandas.DataFrame({c: rows[c].map(number) for c in beside})
    # A class takes its share of the open runs in turn: their numbers do tell, and are no feature (docs/src/datasets.md). A held-out run has no turn.
    order = (~held)[rows["run"].argsort()].cumsum()
    turns = pandas.DataFrame({f"turn {k}": order % k for k in range(2, 8)})
    labels = pandas.read_parquet(tmp_path / "data/held_out").set_index("run")["class"]
    train, test = rows["split"] == "train", rows["split"] == "test"
    for what, features, where, truth, tells in (
        ("held out", known.join(turns), held, rows.loc[held, "run"].map(labels), False),
        ("test", known.drop(columns=["run", "place"]), test, rows.loc[test, "class"], False),
        ("turns", known.join(turns), test, rows.loc[test, "class"], True),
    ):
        forest = ensemble.RandomForestClassifier(200, random_state=1).fit(features[train], rows.loc[train, "class"])
        right, chance = (forest.predict(features[where]) == truth).mean(), truth.value_counts(normalize=True).max()
        # Three standard deviations of guessing; the draws are the plan's, and so the same every time.
        assert len(truth) > 80 and (right > chance + 3 * (chance * (1 - chance) / len(truth)) ** 0.5) == tells, (what, right, chance)


def test_prop_runs_are_found_by_number_and_by_split(tmp_path, examples):
    polars, pandas = pytest.importorskip("polars"), pytest.importorskip("pandas")
    (tmp_path / "base.toml").write_bytes((examples / "rectangle.toml").read_bytes())
    (tmp_path / "plan.toml").write_text(
        'base = "base.toml"\nruns = 12\nruns_per_file = 4\nsignals = ["sensor_ax"]\n[split]\ntest = 0.4\nby = []\n'
        "[vary]\nsimulation.duration_s = { uniform = [0.02, 0.03] }\n"
    )
    plan = brinell.Plan(tmp_path / "plan.toml")
    # As an interruption leaves it.
    plan._native.claim(tmp_path / "begun")
    (tmp_path / "begun/work/part-00000").mkdir()
    for run in range(2):
        (tmp_path / f"begun/work/part-00000/run-{run:07}.row").touch()
    begun = brinell.DataSet(tmp_path / "begun")
    assert len(begun) == 0 and "0 of 12 runs in 0 of " in repr(begun)
    with pytest.raises(brinell.ReadError, match=r"runs/part-\*.parquet is missing; 2 finished runs in work/ wait"):
        begun.to_pandas()
    data = plan.run(tmp_path / "data")
    assert len(data) == 12 and "12 runs in " in repr(data) and "classes: all>" in repr(data)
    frame = data.to_pandas()
    assert list(frame["run"]) == list(range(12)) == data.to_polars()["run"].to_list()
    assert frame.attrs["units"]["sensor_ax"] == "m/s^2"
    test = frame[frame["split"] == "test"]
    assert 0 < len(test) < 12 and list(data.to_pandas(["run"], split="test")["run"]) == list(test["run"])
    assert data.to_polars("sensor_ax", split="test").columns == ["sensor_ax"]
    for read in (data.to_pandas, data.to_polars):
        with pytest.raises(ValueError, match='split: there is no "tests", did you mean "test"'):
            read(split="tests")
    row = data[7]
    assert row["run"] == 7 and row["sensor_ax"].dtype == np.float32
    np.testing.assert_array_equal(row["sensor_ax"], frame["sensor_ax"][7])
    assert sorted(row["run"] for row in data) == list(range(12))
    with pytest.raises(KeyError, match="run 12: not in the files that are there, which hold 12 runs"):
        data[12]
    with pytest.raises(TypeError, match="run = 'a': expected a whole number"):
        data["a"]


def test_prop_truth_is_read_where_it_is_asked_for(plan, tmp_path, monkeypatch):
    polars = pytest.importorskip("polars")
    data = plan(runs=9, per_file=4).run(tmp_path / "data")
    truth = {"defect_length_mm", "entry_t_s", "warnings", "scenario", "defects.0.depth_um", "audit_energy_parametric_j"}
    for read in (data.to_pandas, data.to_polars):
        assert truth.isdisjoint(read().columns) and truth <= set(read(truth=True).columns)
        one = read(["defect_length_mm", "class", "run"])
        assert list(one.columns) == ["defect_length_mm", "class", "run"] and list(one["run"]) == list(range(9))
        for length, label in zip(one["defect_length_mm"], one["class"]):
            known = isinstance(label, str)
            assert (length is not None and len(length) == (label == "photo")) if known else length is None or length != length
        test = read(["run", "entry_t_s"], split="train")
        assert 0 < len(test) < 9
    both = data.to_polars(truth=True).select("run", "sensor_ax", "entry_t_s")
    for row in data:
        of = both.filter(polars.col("run") == row["run"])
        for name in ("sensor_ax", "entry_t_s"):
            np.testing.assert_array_equal(row[name] if row[name] is not None else [], of[name][0] if of[name][0] is not None else [])
        one = data[row["run"]]
        assert one.keys() == row.keys() and "scenario" in one
    # A data set that was published without its truth.
    (data.folder / "truth").rename(tmp_path / "kept")
    assert len(data.to_pandas()) == 9 == len(data.to_polars(truth=True)) and "scenario" not in data[0]
    for read in (data.to_pandas, data.to_polars):
        with pytest.raises(brinell.ReadError, match="truth/ is not here, which has defect_length_mm"):
            read(["class", "defect_length_mm"])


def test_xval_a_run_of_a_data_set_is_analysed_as_its_simulation(plan, tmp_path):
    data = plan(runs=4, per_file=4, duration=1.0).run(tmp_path / "data")
    rows = [data[run] for run in range(len(data))]
    whole = [row for row in rows if isinstance(row["scenario"], str)]
    assert whole
    for row in whole:
        signal = row["sensor_ax"][round(row["analysed_from_s"] * row["sample_rate_hz"]) :]
        scenario = brinell.Scenario.from_toml(row["scenario"])
        known = {"rate_hz": row["sample_rate_hz"], "unit": "m/s^2", "bearing": scenario, "speed_rpm": scenario["operation.speed_rpm"]}
        found = data.analyze(row["run"])
        assert found.verdict == brinell.analyze(signal, simulated=True, **known).verdict
        assert data.analyze(row["run"], "sensor_ay", simulated=False).verdict == brinell.analyze(
            row["sensor_ay"][-len(signal) :], **known
        ).verdict
    with pytest.raises(ValueError, match='signal: there is no "sensor_az"'):
        data.analyze(whole[0]["run"], "sensor_az")


def test_regress_what_a_run_lacks_is_said_by_analyze(tmp_path, command):
    """Of a machine the bearing, of a failed run the signal."""
    subprocess.run([command, "init", "base.toml", "--template", "motor"], cwd=tmp_path, check=True, capture_output=True)
    plan = 'base = "base.toml"\nruns = 2\nsignals = ["housing1.*"]\n[vary]\nsimulation.duration_s = 0.7\n[[classes]]\nname = "healthy"\ndefects = []\n'
    (tmp_path / "plan.toml").write_text(plan)
    data = brinell.Plan(tmp_path / "plan.toml").run(tmp_path / "data")
    with pytest.raises(ValueError, match="bearing: the machine of run 0 has 6205, 6203; say which one is near the sensor"):
        data.analyze(0)
    assert data.analyze(0, bearing="6205").verdict and data.analyze(1, "housing1.drive_end", bearing="6205").verdict
    with pytest.raises(ValueError, match='signal: there is no "housing1.drive_ends", did you mean "housing1.drive_end"'):
        data.analyze(0, "housing1.drive_ends", bearing="6205")
    (tmp_path / "base.toml").write_text(brinell.template())
    plan = 'base = "base.toml"\nruns = 2\nout_of_range = "fail"\nsignals = ["sensor_ax"]\n[vary]\nsimulation.duration_s = 0.05\nlubricant.viscosity_pa_s = { grid = [0.01, -1.0] }\n'
    (tmp_path / "plan.toml").write_text(plan)
    data = brinell.Plan(tmp_path / "plan.toml").run(tmp_path / "failed")
    failed = [run for run in range(2) if data[run]["status"] == "failed"]
    assert len(failed) == 1
    with pytest.raises(ValueError, match=f"run {failed[0]} failed, and has no signal: .*out of range"):
        data.analyze(failed[0])
