"""Scenarios from files, texts and arguments."""

import pickle
import sys
import warnings

import numpy as np
import pytest

import brinell

OPERATION = {"speed_rpm": 1800.0, "load_n": [300.0, 0.0]}


def test_prop_arguments_mean_what_the_file_means(examples):
    built = brinell.Scenario(
        name="rectangle",
        bearing={"preset": "NN3007"},
        operation={**OPERATION, "load_on": "outer-ring"},
        defects=[brinell.rectangle(length_mm=3.0, width_mm=4.0, depth_um=20.0, row=1, center_deg=0.0)],
        simulation={"laws": "li2023", "duration_s": 0.5, "sample_rate_hz": 25600.0},
    )
    read = brinell.Scenario.from_file(examples / "rectangle.toml")
    assert built == read and built.fingerprint == read.fingerprint and hash(built) == hash(read)
    assert brinell.Scenario.from_toml(read.to_toml()) == read
    assert read.replace({"defects.0.depth_um": 10.0}) != read


def test_prop_a_written_scenario_keeps_what_was_assumed(examples, tmp_path):
    source = brinell.Scenario.from_file(examples / "rectangle.toml")
    assert len(source.assumed) >= 10
    for again in (brinell.Scenario.from_toml(source.to_toml()), brinell.Scenario.from_file(source.write(tmp_path / "s.toml"))):
        assert again.assumed == source.assumed and again.to_toml() == source.to_toml()
    key = source.assumed[0]["key"]
    stated = again.replace({key: again[key]})
    assert stated == again and key not in [value["key"] for value in stated.assumed]


def test_prop_numbers_of_any_kind_keep_their_bits():
    values = [0.1 + 0.2, 1e-300, 5e300, 1.0 / 3.0]
    for value in values:
        scenario = brinell.Scenario(bearing="NN3007", operation=OPERATION, lubricant={"viscosity_pa_s": np.float64(value)})
        assert scenario["lubricant.viscosity_pa_s"] == value
    for load in ([300, 0], (300.0, 0.0), np.array([300.0, 0.0]), np.array([300, 0]), np.float32([300, 0])):
        scenario = brinell.Scenario(bearing="NN3007", operation={"speed_rpm": np.int32(1800), "load_n": load})
        assert scenario["operation.load_n"] == [300.0, 0.0]


def test_prop_energies_of_a_damaged_contact_are_a_law():
    operation = {**OPERATION}
    spall = brinell.rectangle(length_mm=3.0, width_mm=4.0, depth_um=20.0)
    scenario = brinell.Scenario(bearing="NN3007", operation=operation, defects=[spall], simulation={"duration_s": 0.05})
    k, n = scenario["contact.outer_stiffness"], scenario["contact.exponent"]
    s, delta = np.linspace(-2.0, 2.0, 41), np.linspace(0.0, 10.0, 21)
    energy = k * (1e-6 * delta) ** (n + 1) / (n + 1)

    def run(share):
        table = {"s_mm": s, "delta_um": delta, "energy_j": np.outer(share, energy).ravel()}
        return brinell.simulate(scenario.replace({"defects.0.table": table})).quantities["sensor_ax.rms"]

    healthy = brinell.simulate(scenario.replace({"defects": []})).quantities["sensor_ax.rms"]
    assert run(np.ones(41)) == pytest.approx(healthy, rel=0.1)
    assert run(np.clip(np.abs(s) / 1.5 - 1.0 / 3.0, 0.4, 1.0)) > 1.5 * healthy


def test_prop_problems_come_all_at_once_and_without_lines_that_nobody_sees():
    with pytest.raises(brinell.ScenarioError) as caught:
        brinell.Scenario(bearing={"preset": "NN3007", "rows": 0}, operation={"speed_rpm": "fast", "lod_n": [1.0, 0.0]})
    keys = [problem["key"] for problem in caught.value.problems]
    assert {"bearing.rows", "operation.speed_rpm", "operation.lod_n"} <= set(keys)
    assert all(problem["line"] is None for problem in caught.value.problems)
    assert "line" not in str(caught.value)
    assert isinstance(caught.value, ValueError)


def test_regress_a_path_of_sixty_thousand_parts_is_refused(tmp_path):
    scenario = brinell.Scenario(bearing="NN3007", operation=OPERATION)
    path = ".".join(["a"] * 60_000)
    with pytest.raises(brinell.ScenarioError, match="60000 parts; there are at most 32"):
        scenario.replace({path: 1})
    (tmp_path / "plan.toml").write_text(f'base = "scenario.toml"\nruns = 2\n\n[vary]\n"{path}" = 1\n')
    scenario.write(tmp_path / "scenario.toml")
    with pytest.raises(brinell.ScenarioError, match="60000 parts; there are at most 32"):
        brinell.Plan(tmp_path / "plan.toml")


def test_regress_problems_stop_at_twenty_of_a_kind():
    with pytest.raises(brinell.ScenarioError) as caught:
        brinell.Scenario(bearing="NN3007", operation=OPERATION, cage={f"k{k}": 1 for k in range(2000)})
    assert len(caught.value.problems) == 21
    assert "and 1980 more like cage.k" in caught.value.problems[-1]["message"]


@pytest.mark.parametrize("value", [object(), 3 + 4j, {1, 2}, {1: 2}, b"bytes", [[[object()]]]])
def test_prop_what_no_scenario_holds_is_refused(value):
    with pytest.raises((TypeError, brinell.ScenarioError)):
        brinell.Scenario(bearing="NN3007", operation={"speed_rpm": value, "load_n": [1.0, 0.0]})


def test_prop_a_list_within_itself_ends():
    ring: list = []
    ring.append(ring)
    with pytest.raises((ValueError, RecursionError)):
        brinell.Scenario(bearing="NN3007", operation={"speed_rpm": ring, "load_n": [1.0, 0.0]})


def test_prop_an_array_of_depths_is_the_grid(base):
    s, z = np.meshgrid(np.linspace(-1.5, 1.5, 61), np.linspace(-2.0, 2.0, 41))
    depth = 20.0 * np.clip(1.0 - (s / 1.4) ** 2 - (z / 1.9) ** 2, 0.0, None)
    scenario = base.replace({"defects": [brinell.depth_map(depth, ds_mm=0.05, dz_mm=0.1, center_deg=0.0)]})
    grid = scenario["defects.0.shape.depth_map"]
    np.testing.assert_array_equal(np.array(grid["depth_um"]).reshape(41, 61), depth)
    # Any layout of the memory is the same array.
    for other in (np.asfortranarray(depth), depth[::-1][::-1], depth.astype(">f8")):
        again = base.replace({"defects": [brinell.depth_map(other, ds_mm=0.05, dz_mm=0.1, center_deg=0.0)]})
        assert again == scenario


def test_xval_shapely_polygons_are_their_points(base):
    geometry = pytest.importorskip("shapely.geometry")
    corners = [(-1.5, -2.0), (1.5, -2.0), (1.5, 2.0), (-1.5, 2.0)]
    hole = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
    plain = brinell.outline(geometry.Polygon(corners), depth_um=20.0)
    assert plain == brinell.outline(np.array(corners), depth_um=20.0)
    holed = brinell.outline(geometry.Polygon(corners, [hole]), depth_um=20.0)
    assert len(holed["shape"]["outline"]["polygons_mm"]) == 2
    several = geometry.MultiPolygon([geometry.Polygon(hole), geometry.box(-1.5, 1.0, 1.5, 2.0)])
    several = brinell.outline(several, depth_um=20.0)
    for entry in (plain, holed, several):
        assert brinell.simulate(base.replace({"defects": [entry], "simulation.duration_s": 0.01})).complete
    # The rectangle as an outline gives the rectangle's run, to round-off that impacts amplify: compare damaged lengths.
    area = [d["area_mm2"] for d in brinell.simulate(base.replace({"defects": [holed], "simulation.duration_s": 0.01})).summary["defects"]]
    np.testing.assert_allclose(area, [11.0])


@pytest.mark.parametrize("bad", [np.zeros((2, 2)), np.zeros(5), np.zeros((4, 5)), [], [[]]])
def test_prop_what_is_no_outline_is_refused(bad):
    with pytest.raises(ValueError):
        brinell.outline(bad, depth_um=20.0)


def test_prop_scenarios_travel_without_their_damage_files(examples, tmp_path):
    for name in ("photo.toml", "photo-spall.png"):
        (tmp_path / name).write_bytes((examples / name).read_bytes())
    # That the threshold was found is on the list of assumed values, no warning.
    scenario = brinell.Scenario.from_file(tmp_path / "photo.toml", {"simulation.duration_s": 0.02})
    parcel = pickle.dumps(scenario)
    (tmp_path / "photo-spall.png").unlink()
    again = pickle.loads(parcel)
    assert again == scenario and again.to_toml() == scenario.to_toml() and again.assumed == scenario.assumed
    # Files of damage are found from the scenario's folder, wherever Python runs.
    with pytest.raises(brinell.ScenarioError):
        scenario.replace({"simulation.duration_s": 0.03})


def test_prop_warnings_are_warnings():
    with pytest.warns(brinell.ScenarioWarning, match="sample_rate_hz"):
        scenario = brinell.Scenario(bearing="NN3007", operation=OPERATION, simulation={"sample_rate_hz": 1000.0},
                                    defects=[brinell.circle(diameter_mm=2.0, depth_um=10.0)])
    assert scenario.warnings
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        pickle.loads(pickle.dumps(scenario))


def test_regress_reading_values(base):
    assert base["operation.load_n.0"] == 300.0
    for key in ("operation.speed", "operation.speed_rpm.0", "defects.7", "defects.x"):
        with pytest.raises(KeyError):
            base[key]
    assert len(brinell.bearings()) >= 7
    assert any(value["key"].startswith("support.") for value in base.assumed)


def test_prop_a_scenario_file_appears_whole_or_not_at_all(base, tmp_path):
    path = base.write(tmp_path / "scenario.toml")
    assert brinell.Scenario.from_file(path) == base
    with pytest.raises(brinell.ReadError):
        base.write(tmp_path / "no" / "folder.toml")
    assert [p.name for p in tmp_path.iterdir()] == ["scenario.toml"]


def test_regress_a_scenario_is_no_sequence(base):
    with pytest.raises(TypeError, match="not iterable"):
        list(base)
    with pytest.raises(TypeError, match="a key is a dotted path"):
        base[0]
    assert "operation.speed_rpm" in base and "operation.speed" not in base and 0 not in base


def test_regress_a_set_has_no_order():
    with pytest.raises(TypeError, match="a set has no order; give a list"):
        brinell.Scenario(bearing="NN3007", operation={"speed_rpm": 1800.0, "load_n": {300.0, 0.0}})


@pytest.mark.skipif(sys.platform != "linux", reason="a folder that takes no files")
def test_regress_a_folder_that_is_there_is_not_said_to_be_missing(base):
    with pytest.raises(brinell.ReadError, match="/proc/x.toml: cannot write"):
        base.write("/proc/x.toml")


def test_regress_none_is_the_default(base):
    default = brinell.Scenario(bearing="NN3007", operation=OPERATION)["simulation.duration_s"]
    longer = base.replace({"simulation.duration_s": 0.7})
    for scenario in (longer, brinell.Scenario.from_toml(longer.to_toml()), pickle.loads(pickle.dumps(longer))):
        again = scenario.replace({"simulation.duration_s": None})
        assert again["simulation.duration_s"] == default and again.replace({"simulation.duration_s": 0.7}) == longer
    shallow = base.replace({"defects.0.center_deg": 5.0}).replace({"defects.0.row": None})
    assert shallow["defects.0.row"] == 1
    with pytest.raises(KeyError, match='did you mean "simulation.duration_s"'):
        base.replace({"simulation.duraton_s": None})


def test_regress_a_value_of_python_is_no_override():
    scenario = brinell.Scenario(bearing="NN3007", operation=OPERATION)
    with pytest.raises(brinell.ScenarioError, match="found a string") as caught:
        scenario.replace({"operation.speed_rpm": "fast"})
    assert "override" not in str(caught.value)
