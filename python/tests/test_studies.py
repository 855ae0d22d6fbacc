"""Comparisons and calibrations."""

import dataclasses
import pickle

import numpy as np
import pytest

import brinell

SPEED = {"operation.speed_rpm": (1500.0, 2100.0)}
FREQUENCY = {"defect1.pure_rolling_frequency": (250.1, 0.5)}


def test_prop_a_result_beside_its_own_scenario_is_itself(base, result):
    told = []
    found = brinell.compare({"first": result, "again": base}, progress=lambda over, of: told.append((over, of)))
    # A result is not run again.
    assert told == [(1, 1)] and found.results["first"] is result and found.baseline == "first"
    np.testing.assert_array_equal(found.columns["first"], found.columns["again"])
    ratios = found.columns["again.ratio"]
    assert (ratios[~np.isnan(ratios)] == 1.0).all() and np.count_nonzero(ratios == 1.0) > 50
    rms = found["sensor_ax.rms"]
    assert rms["unit"] == "m/s^2" and rms["runs"]["first"]["value"] == result.quantities["sensor_ax.rms"]
    assert found.to_html().startswith("<!DOCTYPE html>")
    again = pickle.loads(pickle.dumps(found))
    assert again.report == found.report
    with pytest.raises(RuntimeError, match="another process"):
        again.to_html()


def test_prop_a_variant_is_the_baseline_changed(base, result):
    change = {"operation.speed_rpm": 900.0}
    found = brinell.compare({"fast": result}, {"slow": change})
    assert found.results["slow"].scenario == base.replace(change)
    both = brinell.compare({"fast": base}, {"slow": {}}, settings=change)
    assert both.results["fast"].scenario == both.results["slow"].scenario == base.replace(change)


def test_regress_what_cannot_be_compared(base, result):
    for runs, variants, words in [
        ({"a": base}, {}, "1 to compare, and it takes two at least\n  allowed: 2 to 6"),
        ({}, {"a": {}, "b": {}}, "Give the baseline"),
        ({"a": base}, {"a": {}}, "two runs would be called a"),
        ({"a": base}, {"5": {}}, "`5` cannot name a run"),
        ({"a": base}, {"a.low": {}}, "two columns would be called a.low"),
    ]:
        with pytest.raises(ValueError, match=words):
            brinell.compare(runs, variants)
    with pytest.raises(ValueError, match="a: a result"):
        brinell.compare({"a": result, "b": base}, settings={"simulation.duration_s": 0.2})
    with pytest.raises(brinell.ScenarioError, match="operation.sped_rpm"):
        brinell.compare({"a": result}, {"b": {"operation.sped_rpm": 1.0}})
    away = pickle.loads(pickle.dumps(result))
    with pytest.raises(RuntimeError, match="another process"):
        brinell.compare({"a": away, "b": result})


def test_prop_a_known_speed_comes_back_whatever_the_threads(base):
    # The frequency of impacts in pure rolling is a multiple of the speed.
    truth = base.replace({"operation.speed_rpm": 1730.0, "simulation.duration_s": 0.02})
    value = brinell.simulate(truth).quantities["defect1.pure_rolling_frequency"]
    targets = {"defect1.pure_rolling_frequency": (value, 1e-3 * value)}
    told = []
    found = brinell.calibrate(truth, SPEED, targets, budget=12, jobs=1, progress=lambda *over: told.append(over))
    low, high = found.intervals["operation.speed_rpm"]
    assert found.met and low < 1730.0 < high
    # Three standard uncertainties of the target.
    assert abs(found.values["operation.speed_rpm"] / 1730.0 - 1.0) < 3e-3
    assert abs(found.residuals["defect1.pure_rolling_frequency"]) < 3.0
    assert found.best["operation.speed_rpm"] == found.values["operation.speed_rpm"]
    runs = len(found.runs["run"])
    assert told[-1] == (runs, 12) and [over for over, _ in told] == sorted(over for over, _ in told)
    assert set(found.runs["stage"]) <= {"start", "swarm", "local", "around"}
    assert brinell.calibrate(truth, SPEED, targets, budget=12, jobs=3).report == found.report
    again = pickle.loads(pickle.dumps(found))
    assert again.report == found.report and again.best == found.best
    with pytest.raises(RuntimeError, match="another process"):
        again.to_html()


def test_regress_what_a_callback_raises_ends_a_calibration_that_resumes(base, tmp_path):
    short = base.replace({"simulation.duration_s": 0.02})

    def progress(over, of):
        if over >= 3:
            raise LookupError("enough")

    call = {"budget": 8, "jobs": 1, "folder": tmp_path}
    with pytest.raises(LookupError, match="enough"):
        brinell.calibrate(short, SPEED, FREQUENCY, progress=progress, **call)
    kept = (tmp_path / "journal.jsonl").read_bytes()
    assert kept.count(b"\n") >= 4
    found = brinell.calibrate(short, SPEED, FREQUENCY, **call)
    assert (tmp_path / "journal.jsonl").read_bytes().startswith(kept)
    assert found.report == brinell.calibrate(short, SPEED, FREQUENCY, budget=8).report
    with pytest.raises(ValueError, match="journal of something else"):
        brinell.calibrate(short, SPEED, FREQUENCY, seed=2, **call)


def test_regress_what_cannot_be_calibrated(base):
    signal = brinell.Signal(values=np.zeros(20000), rate_hz=1000.0, unit="m/s^2", channel="x")
    good = {"fit": SPEED, "targets": FREQUENCY}
    for given, words in [
        ({"fit": {}}, "fit: no key is to be fitted"),
        ({"fit": {"operation.speed_rpm": (2100.0, 1500.0)}}, "fit: operation.speed_rpm = 2100.0:1500.0: the bounds are reversed"),
        ({"fit": {"operation.speed_rpm": (1.0, 2.0, "lin")}}, "expected \\(low, high\\)"),
        ({"fit": {"operation.speed_rpm": (1500.0, float("inf"))}}, "the upper bound, `inf`, is not a number"),
        ({"targets": {}}, "there is nothing to fit to"),
        ({"targets": {"sensor_ax.rmss": (30.0, 1.0)}}, "targets: sensor_ax.rmss: no such number of a run"),
        ({"targets": {"sensor_ax.rms": (30.0, 0.0)}}, "the standard uncertainty is not above 0"),
        ({"budget": 3}, "budget = 3: expected 6 runs or more for 1 key"),
        ({"jobs": 0}, "allowed: 1 or more"),
        ({"measured": signal}, "measured is sampled at 1000 Hz, and the scenario at 25600 Hz"),
        ({"measured": signal, "axis": "z"}, "axis z: expected x or y"),
        ({"measured": signal, "model_uncertainty_percent": 0.0}, "model_uncertainty_percent = 0: expected more than 0"),
        ({"measured": dataclasses.replace(signal, unit="V")}, "measured is in V; a calibration takes accelerations"),
        ({"measured": dataclasses.replace(signal, rate_hz=None)}, "measured: its rate_hz and unit"),
    ]:
        with pytest.raises(ValueError, match=words):
            brinell.calibrate(base, **(good | given))
    with pytest.raises(brinell.ScenarioError, match="bearing.roller_diameter_mm"):
        brinell.calibrate(base, {"bearing.roller_diameter_mm": (-3.0, 8.0)}, FREQUENCY)
    with pytest.raises(brinell.SignalError, match="measured: "):
        short = dataclasses.replace(signal, values=np.zeros(4), rate_hz=25600.0)
        brinell.calibrate(base, SPEED, measured=short)
