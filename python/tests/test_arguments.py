"""Arguments that are wrong are refused by name, and places that are none by `ReadError`."""

import numpy as np
import pytest

import brinell

X = np.sin(np.arange(4096.0))


def analyze(**settings):
    return brinell.analyze(X, **({"rate_hz": 1e4, "unit": "g", "speed_rpm": 1800.0, "bearing": "6205"} | settings))


def scenario(**operation):
    return brinell.Scenario(bearing="NN3007", operation=operation)


@pytest.mark.parametrize(
    ("x", "kind", "words"),
    [
        (np.ma.masked_greater(X, 0.9), brinell.SignalError, r"x: \d+ of 4096 samples are masked"),
        (np.zeros((4096, 2)), TypeError, r"x: expected the samples of one channel, and its shape is \(4096, 2\)"),
        (None, TypeError, "x: expected the samples of one channel, real numbers, and it is NoneType"),
        (np.zeros((2, 4096)), TypeError, r"give one of them, such as x\[0\]"),
        (X * 1j, TypeError, "complex numbers"),
        (X > 0.0, TypeError, "real numbers, and it is ndarray of bool"),
        (["a"], TypeError, "x: expected .* and it is list"),
        (3.0, TypeError, r"its shape is \(\)"),
        (np.arange(4096).astype("datetime64[s]"), TypeError, r"it is ndarray of datetime64\[s\]"),
        (np.arange(4096).astype("timedelta64[s]"), TypeError, "real numbers"),
        (np.arange(4096).astype(str), TypeError, "real numbers"),
        (["1.0", "2.0"] * 2048, TypeError, "real numbers, and it is list"),
    ],
)
def test_prop_what_is_no_channel_is_refused_by_name(x, kind, words):
    for call in (
        lambda: brinell.psd(x, rate_hz=1e4, unit="g"),
        lambda: brinell.envelope(x, rate_hz=1e4),
        lambda: brinell.analyze(x, rate_hz=1e4, unit="g", speed_rpm=1800.0, bearing="6205"),
    ):
        with pytest.raises(kind, match=words):
            call()


def test_prop_damage_of_masked_or_complex_values_is_refused():
    depth = np.ma.masked_greater([[0.0, 5.0], [0.0, 0.0]], 1.0)
    with pytest.raises(ValueError, match="depth_um: 1 of 4 values are masked"):
        brinell.depth_map(depth, ds_mm=0.1, dz_mm=0.1)
    with pytest.raises(TypeError, match="depth_um: expected real numbers, and it is complex"):
        brinell.depth_map(np.zeros((2, 2)) + 0j, ds_mm=0.1, dz_mm=0.1)
    ring = np.ma.masked_greater([[0.0, 0.0], [1.0, 0.0], [9.0, 9.0]], 5.0)
    with pytest.raises(ValueError, match="an outline: 2 of 6 values are masked"):
        brinell.outline(ring, depth_um=5.0)


def test_prop_a_column_is_a_channel():
    expected = brinell.psd(X, rate_hz=1e4, unit="g").amplitude
    for x in (X[:, None], X[None, :], np.ma.array(X)):
        np.testing.assert_array_equal(brinell.psd(x, rate_hz=1e4, unit="g").amplitude, expected)


def test_regress_bands_samples_and_units_are_refused_as_by_the_command():
    for call in (brinell.envelope_spectrum, lambda x, unit, **rest: brinell.envelope(x, **rest)):
        with pytest.raises(brinell.SignalError, match="ends at 6000 Hz: expected at most 5000 Hz, half the sample rate"):
            call(X, rate_hz=1e4, unit="g", band_hz=(1000.0, 6000.0))
    bad = X.copy()
    bad[2] = np.nan
    with pytest.raises(brinell.SignalError, match=r"sample 3 is not finite \(counted from 1\)"):
        brinell.psd(bad, rate_hz=1e4, unit="g")
    with pytest.raises(brinell.SignalError, match=r"sample 3 is not finite \(counted from 1\)"):
        brinell.indicators(bad, rate_hz=1e4, unit="g", block_s=0.1)
    with pytest.raises(ValueError, match=r'unit = "bar": no unit is called `bar`; known are m/s\^2'):
        brinell.analyze(X, rate_hz=1e4, unit="bar", speed_rpm=1800.0, bearing="6205")


def test_regress_a_zone_that_is_not_known_has_its_reason():
    rng = np.random.default_rng(1)
    found = brinell.analyze(
        rng.normal(size=24_000), rate_hz=12_000.0, unit="V", speed_rpm=1800.0, bearing="6205", machine_class="2-rigid"
    )
    zone = found.severity["iso_20816_3"]
    assert zone["zone"] is None and zone["why"] == found.severity["velocity_rms_10_1000_hz"]["why"]


def test_prop_a_channel_is_named_as_by_the_command(tmp_path):
    path = tmp_path / "rig.npz"
    np.savez(path, X098_DE_time=X, X098_FE_time=-X, grade_of_oil=np.ones(9))
    found = brinell.read_signal(path, channel="DE")
    assert found.channel == "X098_DE_time"
    np.testing.assert_array_equal(found.values, X)
    assert brinell.read_signal(path, channel="2").channel == "X098_FE_time"
    for channel, words in (("time", "several channels are called like that: X098_DE_time, X098_FE_time"), ("E", "no such channel")):
        with pytest.raises(brinell.ReadError, match=words):
            brinell.read_signal(path, channel=channel)


def test_prop_a_column_of_times_gives_the_rate(tmp_path):
    path = tmp_path / "own.csv"
    path.write_text("time [s],acc [g]\n" + "".join(f"{k / 1000},{(-1) ** k}\n" for k in range(100)))
    found = brinell.read_signal(path)
    assert (found.channel, found.rate_hz, found.unit) == ("acc [g]", pytest.approx(1000.0), "g")


def test_prop_a_sweep_takes_the_commands_ranges(base):
    table = brinell.sweep(base.replace({"simulation.duration_s": 0.02}), {"operation.speed_rpm": "900:1800:450", "simulation.model": "full, lumped"})
    assert table.shape == (3, 2) and sorted(set(table["operation.speed_rpm"])) == [900.0, 1350.0, 1800.0]
    assert list(table["simulation.model"][:2]) == ["full", "lumped"] and not table.failed
    with pytest.raises(ValueError, match="a range has three parts, FROM:TO:STEP"):
        brinell.sweep(base, {"operation.speed_rpm": "900:1800"})
    with pytest.raises(TypeError, match="operation.speed_rpm = 900: expected a list of values, or text"):
        brinell.sweep(base, {"operation.speed_rpm": 900})


@pytest.mark.filterwarnings("ignore::brinell.ScenarioWarning")
def test_prop_a_data_set_that_is_none_is_an_error_of_reading(tmp_path, examples):
    with pytest.raises(brinell.ReadError, match="no data set is here"):
        brinell.DataSet(tmp_path / "none")
    (tmp_path / "base.toml").write_bytes((examples / "rectangle.toml").read_bytes())
    (tmp_path / "plan.toml").write_text('base = "base.toml"\nruns = 2\n[vary]\nsimulation.duration_s = { uniform = [0.02, 0.03] }\n')
    plan = brinell.Plan(tmp_path / "plan.toml")
    for folder in (tmp_path / "base.toml", tmp_path / "base.toml" / "in"):
        with pytest.raises(brinell.ReadError, match="cannot make the folder"):
            plan.run(folder)
    data = plan.run(tmp_path / "data")
    assert data.to_polars("status")["status"].to_list() == ["complete", "complete"]
    for read in (data.to_polars, data.to_pandas):
        with pytest.raises(ValueError, match=r'columns: there is no "klass", did you mean "class"\?\n  allowed: run, split, status, '):
            read(["klass"])


@pytest.mark.filterwarnings("ignore::brinell.ScenarioWarning")
def test_prop_clipped_runs_are_warned_of(tmp_path, examples):
    (tmp_path / "base.toml").write_bytes((examples / "rectangle.toml").read_bytes())
    (tmp_path / "plan.toml").write_text(
        'base = "base.toml"\nruns = 2\n[vary]\nsimulation.duration_s = { uniform = [0.02, 0.03] }\n'
        "sensor.converter_bits = 8\nsensor.converter_range_m_per_s2 = 0.1\n"
    )
    plan = brinell.Plan(tmp_path / "plan.toml")
    with pytest.warns(brinell.ScenarioWarning, match=r"2 of 2 runs have samples beyond the ADC's range, which are clipped \(all 2 of 2\)"):
        data = plan.run(tmp_path / "data")
    assert (data.to_polars(["clipped_samples"])["clipped_samples"] > 0).all()


@pytest.mark.parametrize(
    ("call", "kind", "words"),
    [
        (lambda: brinell.psd(X, rate_hz="25600", unit="g"), TypeError, "rate_hz = '25600': expected a number, samples a second"),
        (lambda: brinell.psd(X, rate_hz=1e4, unit="g", length=-1), ValueError, "length = -1\n  allowed: 0 or more"),
        (lambda: brinell.kurtogram(X, rate_hz=1e4, depth=-1), ValueError, "depth = -1\n  allowed: 0 or more"),
        (lambda: brinell.envelope(X, rate_hz=1e4, band_hz=(2000.0, 1000.0)), brinell.SignalError, "lower edge of the band"),
        (lambda: brinell.envelope(X * np.nan, rate_hz=1e4), brinell.SignalError, "sample 1 is not finite"),
        (lambda: brinell.psd(X, rate_hz=1e4, unit=None), TypeError, "unit = None: expected text, such as"),
        (lambda: brinell.psd(X, rate_hz=1e4, unit="g", length=1024.0), TypeError, "length = 1024.0: expected a whole number, samples"),
        (lambda: brinell.envelope(X, rate_hz="1e4"), TypeError, "rate_hz = '1e4': expected a number"),
        (lambda: brinell.envelope(X, rate_hz=1e4, band_hz=[1e3]), TypeError, r"band_hz = \[1000.0\]: expected two numbers, \(low, high\), Hz"),
        (lambda: analyze(speed_rpm="1797"), TypeError, "speed_rpm = '1797': expected a number, r/min"),
        (lambda: analyze(bpfo="3.6"), TypeError, "bpfo = '3.6': expected a number"),
        (lambda: analyze(bearing={"preset": "6205"}), TypeError, "bearing = {'preset': '6205'}: expected a name, a Scenario or the path"),
        (lambda: analyze(sensitivity=0.1), TypeError, 'sensitivity = 0.1: expected text, such as "100mV/g"'),
        (lambda: analyze(bearing=None, rollers=9, pitch_mm=39.0), ValueError, "rollers, pitch_mm and diameter_mm describe a bearing together"),
        (lambda: analyze(rollers=9, pitch_mm=39.0, diameter_mm=7.9), ValueError, "bearing and rollers, .* are given"),
        (
            lambda: analyze(bearing=None, rollers=30, pitch_mm=39.0, diameter_mm=7.9),
            ValueError,
            r"rollers = 30, pitch_mm = 39, diameter_mm = 7.9, contact_angle_deg = 0: expected 3 or more elements \(up to 15 have room",
        ),
        (lambda: brinell.compare([1, 2]), TypeError, "runs: expected runs by name, .* and it is list"),
        (lambda: brinell.simulate_many([], jobs=1.5), TypeError, "jobs = 1.5: expected a whole number, runs at a time"),
        (lambda: brinell.depth_map(np.zeros((3, 3)), ds_mm="0.1 mm", dz_mm=0.1), TypeError, "ds_mm = '0.1 mm': expected a number, mm"),
        (lambda: brinell.rectangle(length_mm=1.0, width_mm=1.0, depth_um=1.0, centre_deg=0), TypeError, r"rectangle\(\) got .*'centre_deg'"),
        (lambda: scenario(speed_rpm=3 + 4j), TypeError, "operation.speed_rpm: complex: a scenario holds numbers"),
        (lambda: scenario(speed_rpm=1.0, load_n=[None, 0.0]), TypeError, "operation.load_n.0: None: a scenario holds numbers"),
    ],
)
def test_regress_numbers_out_of_range_are_refused_by_name(call, kind, words):
    with pytest.raises(kind, match=words):
        call()


@pytest.mark.parametrize(
    ("settings", "kind", "words"),
    [
        ({"targets": {"sensor_ax.rms": 30.0}}, TypeError, r"targets: sensor_ax.rms = 30.0: expected \(value, standard uncertainty\)"),
        ({"targets": {"sensor_ax.rms": (30.0,)}}, TypeError, "targets: sensor_ax.rms"),
        ({"fit": {"operation.speed_rpm": 1.0}}, TypeError, r"fit: operation.speed_rpm = 1.0: expected \(low, high\)"),
        ({"fit": {"operation.speed_rpm": {1.0, 2.0}}}, TypeError, "fit: operation.speed_rpm"),
        ({"measured": X}, TypeError, "measured: expected a brinell.signals.Signal.*ndarray"),
        ({"measured": brinell.signals.Signal(X, "25600", "g", "a")}, TypeError, "measured.rate_hz = '25600'"),
        ({"seed": -1}, ValueError, "seed = -1\n  allowed: 0 or more"),
        ({"seed": 1.5}, TypeError, "seed = 1.5: expected a whole number"),
        ({"fit": {"bearing.radial_clearance_um": (-1e308, 1e308)}}, ValueError, "the bounds are too far apart"),
    ],
)
def test_regress_what_cannot_be_calibrated_is_refused_by_name(base, settings, kind, words):
    usual = {"fit": {"operation.speed_rpm": (1500.0, 2100.0)}, "targets": {"sensor_ax.rms": (30.0, 1.0)}}
    with pytest.raises(kind, match=words):
        brinell.calibrate(base, **(usual | settings))


def test_regress_what_is_meant_is_taken(base, tmp_path):
    np.testing.assert_array_equal(brinell.envelope(X, rate_hz=1e4, band_hz=[1000, 2000]), brinell.envelope(X, rate_hz=1e4, band_hz=(1e3, 2e3)))
    np.savez(tmp_path / "rig.npz", a=X, b=-X)
    assert brinell.read_signal(tmp_path / "rig.npz", channel=np.int64(2)).channel == "b"
    table = brinell.sweep(base.replace({"simulation.duration_s": 0.02}), {"operation.speed_rpm": np.linspace(900.0, 1800.0, 2)})
    assert list(table["operation.speed_rpm"]) == [900.0, 1800.0]


def test_regress_a_bearing_is_a_file_a_name_or_its_numbers(base, tmp_path, monkeypatch):
    path = base.write(tmp_path / "b.toml")
    monkeypatch.chdir(tmp_path)
    (tmp_path / "rig").write_bytes(path.read_bytes())
    expected = brinell.frequencies("NN3007", 1797)
    for bearing in ("b.toml", path, "rig", base):
        assert brinell.frequencies(bearing, 1797) == expected
    with pytest.raises(brinell.ReadError, match="none.toml"):
        brinell.frequencies("none.toml", 1797)
    with pytest.raises(ValueError, match="no bearing"):
        brinell.frequencies("no bearing", 1797)
    x = np.random.default_rng(1).normal(size=20_000)
    call = {"rate_hz": 2e4, "unit": "g", "speed_rpm": 1800.0}
    by_file = brinell.analyze(x, bearing="b.toml", **call)
    by_numbers = brinell.analyze(x, rollers=19, pitch_mm=49.0, diameter_mm=6.0, **call)
    hertz = [sorted(family["expected_hz"] for family in found.families) for found in (by_file, by_numbers)]
    np.testing.assert_allclose(*hertz, rtol=1e-12)
    of_signal = brinell.analyze(brinell.Signal(x, 2e4, "g", "x"), bearing="b.toml", speed_rpm=1800.0)
    assert of_signal.families == by_file.families
    with pytest.raises(TypeError, match="rate_hz = None: expected a number, samples a second"):
        brinell.analyze(brinell.Signal(x, None, "g", "x"), bearing="NN3007", speed_rpm=1800.0)
