"""Comparisons."""

import pickle

import numpy as np
import pytest

import brinell


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
        ({"a": base}, {}, "1 to compare\n  allowed: 2 to 6"),
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
