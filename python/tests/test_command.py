"""The same physics, bits and words as the command's."""

import csv
import dataclasses
import json
import re
import pathlib
import subprocess
import sys

import numpy as np
import pytest
from conftest import ROOT

import brinell


def run(command, *args, code=0, cwd=None):
    done = subprocess.run([command, *map(str, args)], capture_output=True, text=True, cwd=cwd)
    assert done.returncode == code, done.stderr
    return done


def test_xval_the_wheel_carries_the_command(command, examples, tmp_path):
    own = [sys.executable, "-m", "brinell"]
    told = run(*own, "--version").stdout
    assert told == run(command, "--version").stdout
    # What pip installs beside Python.
    assert run(pathlib.Path(sys.executable).parent / "brinell", "--version").stdout == told
    args = ["frequencies", "--speed", "1800", "6205"]
    assert run(*own, *args).stdout == run(command, *args).stdout
    assert "speed_rpm" in run(*own, "check", examples / "rectangle.toml", "--set", "operation.speed_rpm=-inf", code=2).stderr
    run(*own, "run", examples / "rectangle.toml", "--set", "simulation.duration_s=0.05", "-o", tmp_path / "out", "-q")
    result = brinell.simulate(examples / "rectangle.toml", settings={"simulation.duration_s": 0.05})
    summary = json.loads((tmp_path / "out/summary.json").read_text())
    assert summary["made_by"] == result.summary["made_by"]
    # An agent's calls are processes of the same command.
    asked = {"jsonrpc": "2.0", "id": 2, "method": "tools/call", "params": {"name": "frequencies", "arguments": {"bearing": "6205", "only": ["bpfo_hz"]}}}
    about = {"protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": {"name": "test", "version": "1"}}
    lines = [{"jsonrpc": "2.0", "id": 1, "method": "initialize", "params": about}, {"jsonrpc": "2.0", "method": "notifications/initialized"}, asked]
    for start in [own, [pathlib.Path(sys.executable).parent / "brinell"]]:
        with subprocess.Popen([*start, "mcp", tmp_path], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as server:
            server.stdin.write("".join(json.dumps(line) + "\n" for line in lines))
            server.stdin.flush()
            answers = {answer["id"]: answer for answer in map(json.loads, [server.stdout.readline(), server.stdout.readline()])}
            server.stdin.close()
        assert not answers[2]["result"].get("isError"), answers[2]
    assert f"commit {summary['made_by']['commit']}" in told.replace("commit unknown", "commit None")


def test_xval_signals_and_summary_have_the_bits_of_the_command(command, examples, tmp_path):
    overrides = {"simulation.duration_s": 0.1, "simulation.record": ["outer_*", "sensor_*", "contact1_01_*"]}
    sets = ["--set", "simulation.duration_s=0.1", "--set", 'simulation.record=["outer_*", "sensor_*", "contact1_01_*"]']
    run(command, "run", examples / "rectangle.toml", *sets, "-o", tmp_path, "--signals", "npz", "--no-report", "-q")
    result = brinell.simulate(examples / "rectangle.toml", settings=overrides)
    with np.load(tmp_path / "signals.npz") as arrays:
        assert [name for name in arrays.files if name in result.signals] == result.channels
        for name, values in result.signals.items():
            np.testing.assert_array_equal(values.view(np.uint64), arrays[name].view(np.uint64), err_msg=name)
    summary = json.loads((tmp_path / "summary.json").read_text())
    # Only a run of the command has files.
    assert sorted(summary.pop("files")) == sorted(path.name for path in tmp_path.iterdir())
    assert result.summary == summary
    assert result.scenario.to_toml() == (tmp_path / "scenario.toml").read_text()


def test_xval_the_page_of_a_run_is_that_of_the_command(command, examples, tmp_path):
    run(command, "run", examples / "rectangle.toml", "--set", "simulation.duration_s=0.3", "-o", tmp_path, "--signals", "none", "-q")
    result = brinell.simulate(examples / "rectangle.toml", settings={"simulation.duration_s": 0.3})
    # The command runs the bearing without its damage too.
    healthy = brinell.simulate(result.scenario.replace({"defects": []}))
    assert result.to_html(healthy) == (tmp_path / "report.html").read_text(encoding="utf-8")
    assert "the same bearing without the damage" not in result.to_html()


def test_xval_sweep_has_the_table_of_the_command(command, examples, tmp_path):
    sets = ["--set", "simulation.duration_s=0.1"]
    vary = ["--vary", "operation.speed_rpm=900,1800", "--vary", "bearing.radial_clearance_um=5,-500"]
    run(command, "sweep", examples / "rectangle.toml", *sets, *vary, "-o", tmp_path, "-q", code=1)
    base = brinell.Scenario.from_file(examples / "rectangle.toml", {"simulation.duration_s": 0.1})
    with pytest.warns(brinell.ScenarioWarning) as told:
        table = brinell.sweep(base, {"operation.speed_rpm": [900, 1800], "bearing.radial_clearance_um": [5, -500]})
    same_cells(tmp_path / "sweep.csv", table.columns)
    assert sorted(table.failed) == [1, 3] and [row in table.failed for row in range(4)] == list(table["status"] == "failed")
    expected = json.loads((tmp_path / "sweep.json").read_text())["warnings"]
    assert table.warnings[:-1] == [text.removeprefix("warning: ") for text in expected] and len(expected) == 2
    assert table.warnings[-1].startswith("2 of 4 points failed, the first of them point 2: ")
    assert [str(warning.message) for warning in told] == table.warnings
    kept = brinell.sweep(base, {"operation.speed_rpm": [900, 1800], "bearing.radial_clearance_um": [5, -500]}, folder=tmp_path / "kept")
    assert kept.warnings == table.warnings


def same_cells(path, columns):
    """A table of the command has these columns, bit for bit."""
    rows = list(csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#")))
    assert list(rows[0]) == list(columns)
    for name, cells in columns.items():
        assert len(cells) == len(rows)
        for row, cell in zip(rows, cells, strict=True):
            if isinstance(cell, float):
                np.testing.assert_array_equal(cell, float(row[name] or "nan"), err_msg=name)
            else:
                assert (cell or "") == row[name], name


def test_xval_a_comparison_is_that_of_the_command(command, examples, tmp_path):
    scenarios = {name: examples / f"{name}.toml" for name in ("healthy", "rectangle")}
    variant = ["--variant", "lumped:simulation.model=lumped", "--set", "simulation.duration_s=0.3"]
    run(command, "compare", *scenarios.values(), *variant, "-o", tmp_path, "-q")
    settings = {"simulation.duration_s": 0.3}
    found = brinell.compare(scenarios, {"lumped": {"simulation.model": "lumped"}}, settings=settings)
    expected = json.loads((tmp_path / "compare.json").read_text())
    # Only a comparison of the command has files.
    del expected["files"]
    assert found.report == expected
    same_cells(tmp_path / "compare.csv", found.columns)
    assert found.to_html() == (tmp_path / "compare.html").read_text(encoding="utf-8")


def test_xval_a_calibration_is_that_of_the_command_and_resumes_it(command, examples, tmp_path):
    given = ["--set", "simulation.duration_s=0.1", "--fit", "operation.speed_rpm=1500:2100", "--fit", "operation.load_n.0=100:1000:log"]
    targets = ["--target", "defect1.pure_rolling_frequency=250.1~0.5", "--target", "row1.largest_outer_force=200~20"]
    call = ["calibrate", examples / "rectangle.toml", *given, *targets, "--budget", "12", "-o", tmp_path, "-q"]
    run(command, *call)
    base = brinell.Scenario.from_file(examples / "rectangle.toml", {"simulation.duration_s": 0.1})
    fit = {"operation.speed_rpm": (1500, 2100), "operation.load_n.0": (100, 1000, "log")}
    wanted = {"defect1.pure_rolling_frequency": (250.1, 0.5), "row1.largest_outer_force": (200, 20)}
    found = brinell.calibrate(base, fit, wanted, budget=12)
    assert found.report == json.loads((tmp_path / "calibrate.json").read_text())
    same_cells(tmp_path / "calibrate.csv", found.runs)
    assert found.best.to_toml() == (tmp_path / "best.toml").read_text()
    assert found.to_html() == (tmp_path / "calibrate.html").read_text(encoding="utf-8")
    journal = (tmp_path / "journal.jsonl").read_bytes()
    again = brinell.calibrate(base, fit, wanted, budget=12, folder=tmp_path)
    assert again.report == found.report and (tmp_path / "journal.jsonl").read_bytes() == journal


def test_xval_a_calibration_to_a_measured_signal_is_that_of_the_command(command, examples, tmp_path):
    # In 0.3 s the line of the damage is found in one run of two, by how impacts amplify round-off.
    base = brinell.Scenario.from_file(examples / "rectangle.toml", {"simulation.duration_s": 0.5})
    result = brinell.simulate(base, settings={"operation.speed_rpm": 1850.0})
    np.save(tmp_path / "rig.npy", result["sensor_ax"] / 9.80665)
    given = ["--set", "simulation.duration_s=0.5", "--fit", "operation.speed_rpm=1750:1950", "--budget", "6"]
    of_file = ["--measured", tmp_path / "rig.npy", "--rate", result.rate_hz, "--unit", "g", "--axis", "x"]
    run(command, "calibrate", examples / "rectangle.toml", *given, *of_file, "-o", tmp_path / "out", "-q")
    measured = dataclasses.replace(brinell.read_signal(tmp_path / "rig.npy"), rate_hz=result.rate_hz, unit="g")
    found = brinell.calibrate(base, {"operation.speed_rpm": (1750.0, 1950.0)}, measured=measured, axis="x", budget=6)
    expected = json.loads((tmp_path / "out" / "calibrate.json").read_text())
    # The command says where the samples are from.
    del found.report["measured"], expected["measured"]
    assert found.report == expected
    assert "signature.octave_5120_10240_hz" in found.residuals


@pytest.mark.parametrize(
    ("key", "value"),
    [("operation.load_ramp_s", -1.0), ("bearing.pitch_diameter_mm", 3.0), ("operation.sped_rpm", 3.0), ("defects.0.depth_um", True)],
)
def test_xval_errors_have_the_words_of_the_command(command, examples, key, value):
    path = examples / "rectangle.toml"
    with pytest.raises(brinell.ScenarioError) as caught:
        brinell.Scenario.from_file(path, {key: value})
    told = run(command, "check", path, "--set", f"{key}={json.dumps(value)}", code=2).stderr
    assert told == f"{caught.value}\n"
    assert caught.value.problems[0]["severity"] == "error"


def test_xval_errors_point_at_the_line(command, tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text('name = "bad"\n[bearing]\npreset = "NN3007"\n[operation]\nspeed_rpm = "fast"\nload_n = [1.0, 0.0]\n[simulaton]\n')
    with pytest.raises(brinell.ScenarioError) as caught:
        brinell.Scenario.from_file(path)
    assert run(command, "check", path, code=2).stderr == f"{caught.value}\n"
    assert f"--> {path}:5:13" in str(caught.value)
    assert caught.value.problems[0]["line"] == 5
    path = tmp_path / "none.toml"
    with pytest.raises(brinell.ReadError) as caught:
        brinell.Scenario.from_file(path)
    assert run(command, "check", path, code=2).stderr == f"error: {caught.value}\n"


def test_xval_a_damage_file_that_is_missing_is_told_alike(command, examples, tmp_path):
    path = tmp_path / "photo.toml"
    path.write_text((examples / "photo.toml").read_text())
    with pytest.raises(brinell.ScenarioError) as caught:
        brinell.Scenario.from_file(path)
    assert run(command, "check", path, code=2).stderr == f"{caught.value}\n"


def test_xval_a_failed_run_has_the_words_of_the_command(command, tmp_path, examples):
    # No support holds the rings against the load.
    sets = {"simulation.start": "equilibrium", "support.inner_stiffness_n_per_m": 0.0, "support.outer_stiffness_n_per_m": 0.0}
    given = [part for key, value in sets.items() for part in ("--set", f"{key}={value}")]
    told = run(command, "run", examples / "rectangle.toml", *given, "-o", tmp_path, "-q", code=2).stderr
    with pytest.raises(brinell.ScenarioError) as caught, pytest.warns(brinell.ScenarioWarning):
        brinell.simulate(examples / "rectangle.toml", settings=sets)
    assert told.splitlines()[-1] == f"error: {caught.value}"


def test_xval_analysis_is_that_of_the_command(command, examples, tmp_path):
    second = {"simulation.duration_s": 1.0}
    run(command, "run", examples / "rectangle.toml", "-o", tmp_path, "--signals", "npz", "--no-report", "-q", "--set", "simulation.duration_s=1.0")
    done = run(command, "analyze", tmp_path / "signals.npz", "--channel", "sensor_ax", "--json", "-")
    expected = json.loads(done.stdout)
    signal = brinell.read_signal(tmp_path / "signals.npz", "sensor_ax")
    scenario = brinell.Scenario.from_file(examples / "rectangle.toml", second)
    assert signal.unit == "m/s^2"
    rate = expected["signal"]["sample_rate_hz"]
    # The command leaves out the start of a run.
    settled = signal.values[-expected["signal"]["samples"]:]
    found = brinell.analyze(settled, rate_hz=rate, unit=signal.unit, speed_rpm=1800.0, bearing=scenario, simulated=True)
    assert found.damage == expected["verdict"]["damage"] and found.damage[0] == "outer_race"
    for part in ("verdict", "families", "bands", "indicators", "velocity_bands", "kurtogram"):
        assert found.report[part] == expected[part], part
    assert brinell.simulate(scenario).analyze().damage[0] == "outer_race"
    # The pages tell from where signal, speed and bearing come, and differ there alone.
    run(command, "analyze", tmp_path / "signals.npz", "--channel", "sensor_ax", "-o", tmp_path / "page", "-q")
    page = (tmp_path / "page" / "report.html").read_text(encoding="utf-8")
    title = re.search(r'subtitle">(.*?), [0-9.]+ s at', page)[1]
    own = found.to_html(title)

    def sections(page):
        return re.sub(r"<li>.*?</li>\s*", "", page, flags=re.DOTALL)

    assert sections(own) == sections(page)
