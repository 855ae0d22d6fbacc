"""What the command warns of, Python warns of."""

import pickle
import warnings

import pytest

import brinell

OUTSIDE = {"defects.0.center_deg": 120.0}


@pytest.fixture(scope="module")
def outside(base):
    """A spall where no load is, in a run that is too short."""
    return base.replace(OUTSIDE)


def test_regress_a_run_warns_of_what_the_command_prints(outside):
    with pytest.warns(brinell.ScenarioWarning, match="outside the load zone") as told:
        result = brinell.simulate(outside)
    assert {w.filename for w in told} == {__file__}
    assert [str(w.message) for w in told] == result.warnings == [text.removeprefix("warning: ") for text in result.summary["warnings"]]
    assert any("too short to settle" in text for text in result.warnings)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        again = pickle.loads(pickle.dumps(result))
    assert again.warnings == result.warnings


def test_regress_what_a_scenario_was_warned_of_is_not_said_again():
    slow = {"sample_rate_hz": 1000.0, "duration_s": 0.05}
    with pytest.warns(brinell.ScenarioWarning, match="sample_rate_hz"):
        scenario = brinell.Scenario(
            bearing="NN3007",
            operation={"speed_rpm": 1800.0, "load_n": [300.0, 0.0]},
            defects=[brinell.circle(diameter_mm=2.0, depth_um=10.0)],
            simulation=slow,
        )
    with pytest.warns(brinell.ScenarioWarning) as told:
        result = brinell.simulate(scenario)
    assert len(result.warnings) == len(told) + len(scenario.warnings)


def test_regress_many_runs_are_warned_of_each_kind_once(base, outside):
    with pytest.warns(brinell.ScenarioWarning) as told:
        brinell.simulate_many([base, outside, outside], jobs=2)
    found = [str(w.message) for w in told if "outside the load zone" in str(w.message)]
    assert len(found) == 1 and found[0].endswith("(in 2 of 3 runs looked at, the first of them run scenarios[1])")


def test_regress_comparisons_and_calibrations_warn(outside):
    with pytest.warns(brinell.ScenarioWarning) as told:
        compared = brinell.compare({"a": outside, "b": outside.replace({"operation.speed_rpm": 900.0})})
    assert [str(w.message) for w in told] == compared.warnings and "outside the load zone" in compared.warnings[0]
    fit, targets = {"operation.speed_rpm": (1500.0, 2100.0)}, {"defect1.pure_rolling_frequency": (250.1, 0.5)}
    with pytest.warns(brinell.ScenarioWarning) as told:
        found = brinell.calibrate(outside, fit, targets, budget=6)
    assert [str(w.message) for w in told] == found.warnings and any("outside the load zone" in text for text in found.warnings)
