"""Signals, statics, sweeps, pictures."""

import pickle

import numpy as np
import pytest

import brinell
import brinell.plot


def test_xval_psd_is_that_of_a_known_tone_in_known_noise():
    rng = np.random.default_rng(3)
    x = 0.5 * np.sin(2 * np.pi * 100.0 * np.arange(200_000) / 10_000.0) + rng.normal(scale=0.2, size=200_000)
    found = brinell.psd(x, rate_hz=10_000.0, unit="m/s^2", length=2000)
    peak = found.amplitude.argmax()
    assert found.frequency_hz[peak] == 100.0
    np.testing.assert_allclose(found.amplitude[peak], 0.5, rtol=0.02)
    # White noise of variance s^2 has the density 2 s^2 / rate.
    far = found.frequency_hz > 1000.0
    np.testing.assert_allclose(found.density[far].mean(), 2 * 0.04 / 10_000.0, rtol=0.02)
    np.testing.assert_allclose(found.density.sum() * found.frequency_hz[1], np.mean(x**2), rtol=0.01)


def test_prop_any_array_of_numbers_will_do():
    x = np.sin(np.arange(4000) / 7.0)
    expected = brinell.psd(x, rate_hz=1000.0, unit="g", length=500).amplitude
    wide = np.zeros((4000, 2))
    wide[:, 0] = x
    for other in (x.tolist(), wide[:, 0], x[::-1].copy()[::-1], x.astype(">f8")):
        np.testing.assert_array_equal(brinell.psd(other, rate_hz=1000.0, unit="g", length=500).amplitude, expected)
    with pytest.raises(TypeError):
        brinell.psd(wide, rate_hz=1000.0, unit="g")


@pytest.mark.parametrize(
    "call",
    [
        lambda x: brinell.psd(x, rate_hz=0.0, unit="g"),
        lambda x: brinell.psd(x[:3], rate_hz=10.0, unit="g"),
        lambda x: brinell.psd(x, rate_hz=10.0, unit="g", length=2),
        lambda x: brinell.psd(x, rate_hz=10.0, unit="g", overlap=1.0),
        lambda x: brinell.psd(x, rate_hz=10.0, unit="g", window="kaiser"),
        lambda x: brinell.psd(x * np.nan, rate_hz=10.0, unit="g"),
        lambda x: brinell.envelope(x, rate_hz=10.0, band_hz=(5.0, 2.0)),
        lambda x: brinell.envelope(x[:0], rate_hz=10.0),
        lambda x: brinell.envelope_spectrum(x, rate_hz=np.inf, unit="g"),
        lambda x: brinell.spectrogram(x, rate_hz=10.0, unit="g", length=0),
        lambda x: brinell.kurtogram(0.0 * x, rate_hz=10.0),
        lambda x: brinell.indicators(x, rate_hz=10.0, unit="g", block_s=0.0),
        lambda x: brinell.analyze(x, rate_hz=10.0, unit="g", speed_rpm=1800.0, bearing="6205"),
    ],
)
def test_prop_what_cannot_be_analysed_is_an_error(call):
    with pytest.raises(brinell.SignalError):
        call(np.sin(np.arange(1000.0)))


def test_prop_a_speed_or_a_bearing_that_is_missing_is_a_wrong_argument():
    x = np.sin(np.arange(1000.0))
    for given, words in (
        ({"speed_rpm": 0.0, "bearing": "6205"}, "expected a speed other than 0; give speed_rpm"),
        ({"bearing": "6205"}, "speed_rpm"),
        ({"speed_rpm": 1800.0}, "rollers, pitch_mm and diameter_mm"),
    ):
        with pytest.raises(ValueError, match=words) as caught:
            brinell.analyze(x, rate_hz=1e4, unit="g", **given)
        assert not isinstance(caught.value, brinell.SignalError)


def outer_race(seconds: float = 2.0) -> np.ndarray:
    """Impacts on the outer race of a 6205-2RS at 1800 r/min, at 12 kHz, in a little noise."""
    since = np.arange(int(12000 * seconds)) / 12000.0 % (1.0 / (3.585 * 30.0))
    noise = np.random.default_rng(1).normal(size=len(since))
    return np.exp(-since / 4e-4) * np.sin(6.283 * 3000.0 * since) + 0.05 * noise


KNOWN = {"rate_hz": 12000.0, "speed_rpm": 1800.0, "bearing": "6205-2RS"}


def test_analytic_pulses_give_the_speed():
    x = outer_race()
    turns = 30.0 * np.arange(len(x)) / 12000.0
    given = {key: value for key, value in KNOWN.items() if key != "speed_rpm"}
    for pulses in (1, 8):
        train = 5.0 * ((pulses * turns) % 1.0 < 0.3)
        found = brinell.analyze(x, unit="g", tacho=train, pulses=pulses, **given)
        assert (found.says, found.damage) == ("damage", ["outer_race"])
        signal = brinell.Signal(train, 12000.0, "V", "tacho")
        assert brinell.analyze(x, unit="g", tacho=signal, pulses=pulses, **given).verdict == found.verdict
    with pytest.raises(brinell.SignalError, match="tacho: it has 0 rising edges"):
        brinell.analyze(x, unit="g", tacho=0.0 * x, **given)
    with pytest.raises(brinell.SignalError, match="tacho: its 12000 values last"):
        brinell.analyze(x, unit="g", tacho=train[:12000], **given)
    with pytest.raises(ValueError, match="either it or tacho"):
        brinell.analyze(x, unit="g", tacho=train, **KNOWN)


def test_analytic_a_sensitivity_turns_volts_into_vibration():
    x = outer_race()
    plain = brinell.analyze(x, unit="g", **KNOWN)
    volts = brinell.analyze(0.1 * x, unit="V", sensitivity="100mV/g", **KNOWN)
    assert volts.says == plain.says == "damage" and volts.damage == plain.damage == ["outer_race"]
    assert volts.envelope.unit == "g" and repr(volts) == "<brinell.Analysis: outer_race>"
    velocity = [found.severity["velocity_rms_10_1000_hz"] for found in (plain, volts)]
    assert velocity[0]["unit"] == "mm/s"
    np.testing.assert_allclose(velocity[0]["value"], velocity[1]["value"], rtol=1e-9)
    low, high = velocity[0]["low"], velocity[0]["high"]
    assert low <= velocity[0]["value"] <= high
    unscaled = brinell.analyze(x, unit="V", **KNOWN).severity["velocity_rms_10_1000_hz"]
    assert unscaled["value"] is None and "neither an acceleration nor a velocity" in unscaled["why"]


def test_analytic_a_zone_where_a_class_is_given():
    # 10 m/s^2 at 159.155 Hz are 10 mm/s, 7.07 RMS.
    x = 10.0 * np.sin(2 * np.pi * 159.155 * np.arange(48000) / 12000.0) + 0.01 * np.random.default_rng(2).normal(size=48000)
    found = brinell.analyze(x, unit="m/s^2", machine_class="2-rigid", **KNOWN)
    np.testing.assert_allclose(found.severity["velocity_rms_10_1000_hz"]["value"], 50.0**0.5, rtol=5e-3)
    assert found.severity["iso_20816_3"]["zone"] == "D"
    assert brinell.analyze(x, unit="m/s^2", **KNOWN).severity["iso_20816_3"] is None


def test_prop_a_verdict_says_which_kind_it_is():
    noise = np.random.default_rng(5).normal(size=24000)
    found = brinell.analyze(noise, unit="g", **KNOWN)
    assert (found.says, found.damage, found.drift) == ("nothing_found", [], None)
    assert repr(found) == "<brinell.Analysis: no damage found>"
    assert [family["name"] for family in found.families]


def test_prop_without_a_bearing_the_comb_and_who_has_it_are_named():
    found = brinell.analyze(outer_race(), unit="g", **{**KNOWN, "bearing": "unknown"})
    assert found.says == "cannot_tell" and found.families == [] and "6205 (BPFO 3.585)" in found.verdict
    assert "no bearing is given" in found.verdict


def test_prop_lines_of_the_supply_are_set_aside():
    # Six poles: 3.05 times the shaft's speed, where a 6203 has its BPFO.
    t = np.arange(48000) / 12000.0
    sidebands = sum(np.cos(2 * np.pi * (3000.0 + k * 3.05 * 30.0) * t) for k in range(-6, 7))
    x = np.random.default_rng(6).normal(size=len(t)) + 0.2 * sidebands
    given = {"unit": "g", **KNOWN, "bearing": "6203-2RS"}
    assert brinell.analyze(x, **given).damage == ["outer_race"]
    assert brinell.analyze(x, supply_hz=1.002 * 3.05 * 30.0, **given).says == "nothing_found"


def test_prop_what_is_wrong_with_a_record_is_told():
    x = outer_race()
    assert brinell.analyze(x, unit="g", **KNOWN).flaws == []
    clipped = brinell.analyze(np.clip(x, -0.5, 0.5), unit="g", **KNOWN)
    assert len(clipped.flaws) == 1 and "clipped" in clipped.flaws[0]
    assert "clipped" in clipped.to_html()


def test_prop_a_verdict_has_a_page_where_it_was_found():
    x = outer_race()
    found = brinell.analyze(0.1 * x, unit="V", sensitivity="100mV/g", **KNOWN)
    page = found.to_html("motor <1>")
    assert page.startswith("<!DOCTYPE html>") and "motor &lt;1&gt;" in page and found.verdict in page
    assert "sensitivity 100 mV/g, as given" in page and "shaft speed 1800 r/min, as given" in page
    again = pickle.loads(pickle.dumps(found))
    assert again.verdict == found.verdict and again.flaws == found.flaws
    with pytest.raises(RuntimeError, match="another process"):
        again.to_html()


def test_prop_the_customers_report_as_html_and_pdf(tmp_path):
    found = brinell.analyze(outer_race(), unit="g", machine_class="2-rigid", **KNOWN)
    given = {"title": "Pump <1>", "machine": "P-301", "point": "drive end", "date": "2026-03-02", "author": "A. Writer", "remark": "Noise since May."}
    for name in ("report.html", "report.pdf"):
        found.to_report(tmp_path / name, damage_kind="false-brinelling", **given)
    page = (tmp_path / "report.html").read_text(encoding="utf-8")
    for part in ("Pump &lt;1&gt;", "P-301", "drive end", "2026-03-02", "Noise since May.", "The outer race is damaged", "5.3.3.3"):
        assert part in page, part
    pdf = (tmp_path / "report.pdf").read_bytes()
    assert pdf.startswith(b"%PDF-1.") and b"/Count 2" in pdf and b"/Author (A. Writer)" in pdf
    assert sorted(path.name for path in tmp_path.iterdir()) == ["report.html", "report.pdf"]
    with pytest.raises(ValueError, match="allowed: subsurface-fatigue, "):
        found.to_report(tmp_path / "report.pdf", damage_kind="rust")
    with pytest.raises(ValueError, match="ends in .html or .pdf"):
        found.to_report(tmp_path / "report.txt")
    with pytest.raises(OSError, match="none"):
        found.to_report(tmp_path / "none" / "report.pdf")


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"unit": "g", "machine_class": "3-rigid"}, "machine_class = \"3-rigid\".*2-flexible"),
        ({"unit": "V", "sensitivity": "100"}, "100mV/g"),
        ({"unit": "g", "supply_hz": 0.0}, "supply_hz = 0: expected 1 to 1000 Hz"),
        ({"unit": "g", "sensitivity": "100mV/g"}, "expected a signal that is a voltage"),
        ({"unit": "g", "bpfo": 500.0}, "500.0000 times the shaft's 30.000 Hz, expected 1 to 200"),
        ({"unit": "g", "bpfo": 5.0, "bpfi": 4.0}, "BPFO 5.0000x and BPFI 4.0000x"),
    ],
)
def test_prop_options_that_do_not_fit_are_refused(settings, words):
    with pytest.raises(ValueError, match=f"(?s){words}"):
        brinell.analyze(outer_race(), **KNOWN, **settings)


def test_prop_unknown_bearings_are_reported_with_some_known():
    with pytest.raises(ValueError, match="N204.*`brinell bearing list` shows all"):
        brinell.analyze(np.arange(9.0), rate_hz=1e4, unit="g", speed_rpm=1800.0, bearing="X")
    with pytest.raises(ValueError, match="N204.*`brinell bearing list` shows all"):
        brinell.frequencies("X", 1800.0)
    with pytest.raises(ValueError, match="speed_rpm"):
        brinell.frequencies("NN3007")


def test_prop_pressures_over_damage_add_up_to_the_force(base):
    base = base.replace({"simulation.laws": "mechanics"})
    (over,) = brinell.pressures(base)
    assert over.contact == "outer" and over.pressure_mpa.shape == (over.z_mm.size, over.s_mm.size)
    cell = (over.s_mm[1] - over.s_mm[0]) * (over.z_mm[1] - over.z_mm[0])
    assert over.pressure_mpa.sum() * cell == pytest.approx(over.force_n, rel=1e-9)
    assert over.pressure_mpa.max() == over.largest_pressure_mpa > over.healthy_pressure_mpa > 0.0
    # Beside the spall of 3 by 4 mm, whose floor is out of reach.
    assert abs(over.at_mm[0]) > 1.5 or abs(over.at_mm[1]) > 2.0
    assert "largest" in over.note and repr(over).startswith("<brinell.Pressure: outer")
    assert brinell.pressures(base.replace({"simulation.laws": "li2023"})) == []
    for wrong in (0, 2, -1):
        with pytest.raises(ValueError, match=f"defect = {wrong}: the scenario has 1"):
            brinell.pressures(base, defect=wrong)
    with pytest.raises(TypeError, match="defect = 1.0"):
        brinell.pressures(base, defect=1.0)


def test_analytic_static_forces_hold_the_load(base):
    zone = brinell.static_analysis(base.replace({"defects": []}))
    angle = np.radians(zone.angle_deg)
    positions = 16
    # The outer ring is pushed with the load; supports carry the difference, a few per cent.
    push = (zone.outer_force_n * np.cos(angle)).sum() / positions
    across = (zone.outer_force_n * np.sin(angle)).sum() / positions
    assert 0.0 < push <= 300.0 * 1.05 and abs(across) < 1e-6 * push
    values = brinell.derived(base)
    assert values["load_n"] == 300.0 and values["frequencies_hz"] == pytest.approx(brinell.frequencies(base))
    np.testing.assert_allclose(brinell.frequencies(base, 3600.0)["bpfo"], 2 * brinell.frequencies(base)["bpfo"])


def test_regress_sweeps_of_keys_in_step_and_across(base):
    table = brinell.sweep(
        base,
        {"simulation.model": ["full", "lumped"]},
        together=[{"operation.speed_rpm": np.array([900.0, 1800.0]), "operation.load_n": [[200.0, 0.0], [400.0, 0.0]]}],
    )
    assert table.shape == (2, 2) and not table.failed
    assert list(table["simulation.model"]) == ["full", "full", "lumped", "lumped"]
    assert table["operation.load_n"][1] == [400.0, 0.0]
    alone = brinell.simulate(base, settings={"operation.speed_rpm": 1800.0, "operation.load_n": [400.0, 0.0]})
    for name, value in alone.quantities.items():
        np.testing.assert_array_equal(table[name][1], value, err_msg=name)
    pytest.importorskip("xarray")
    grid = table.to_xarray()
    assert grid["sensor_ax.rms"].dims == ("simulation.model", "operation.speed_rpm")
    assert float(grid["sensor_ax.rms"].sel({"simulation.model": "full", "operation.speed_rpm": 1800.0})) == alone.quantities["sensor_ax.rms"]
    pytest.importorskip("pandas")
    assert len(table.to_pandas()) == 4


def test_regress_values_with_a_unit_are_numbers_of_their_key(base):
    table = brinell.sweep(base, {"operation.speed_rpm": ["20 Hz", 1800.0], "simulation.duration_s": ["100 ms"]})
    assert list(table["operation.speed_rpm"]) == [1200.0, 1800.0] and not table.failed
    assert table["operation.speed_rpm"].dtype == float


def test_prop_a_sweep_without_a_sound_point_is_refused(base):
    with pytest.raises(brinell.ScenarioError, match="sped"):
        brinell.sweep(base, {"operation.speed_rpm": [1000, 2000], "operation.sped": [1, 2]})


def test_prop_a_sweep_in_a_folder_resumes(base, tmp_path):
    vary = {"operation.speed_rpm": [900.0, 1800.0], "bearing.radial_clearance_um": [5.0, -500.0]}
    done = []

    def stop_after_one(count, total):
        done.append((count, total))
        if len(done) > 1:
            raise LookupError

    with pytest.raises(LookupError):
        brinell.sweep(base, vary, folder=tmp_path, jobs=1, progress=stop_after_one)
    finished = len((tmp_path / "journal.jsonl").read_text().splitlines())
    assert finished >= 2
    counts = []
    table = brinell.sweep(base, vary, folder=tmp_path, progress=lambda count, total: counts.append(count))
    whole = brinell.sweep(base, vary)
    assert counts[0] >= done[0][0] + 1 and counts[-1] == len(whole) and table.failed == whole.failed
    for name in whole.columns:
        np.testing.assert_array_equal(table[name], whole[name], err_msg=name)
    with pytest.raises(ValueError, match="something else"):
        brinell.sweep(base, {"operation.speed_rpm": [900.0]}, folder=tmp_path)


@pytest.mark.parametrize(
    ("vary", "together"),
    [
        ({"operation.speed_rpm": []}, ()),
        ({"operation.speed_rpm": [900.0, 900.0]}, ()),
        ({"defects.0": [1], "defects.0.depth_um": [2]}, ()),
        ({"a.b": range(1000), "a.c": range(1000)}, ()),
        ({}, [{"a.b": [1, 2], "a.c": [1]}]),
        ({"a.b": [1]}, [{"a.b": [1], "a.c": [1]}]),
    ],
)
def test_prop_plans_that_cannot_be(base, vary, together):
    with pytest.raises(ValueError):
        brinell.sweep(base, vary, together=together)


def test_regress_pictures(result, base, tmp_path):
    pytest.importorskip("matplotlib")
    table = brinell.sweep(base, {"operation.speed_rpm": [900.0, 1800.0], "simulation.model": ["full", "lumped"]})
    x = result["sensor_ax"]
    settings = {"rate_hz": result.rate_hz, "unit": "m/s^2", "speed_rpm": 1800.0, "bearing": result.scenario}
    longer = brinell.simulate(base, settings={"simulation.duration_s": 0.5})
    pictures = {
        "signal": result.plot_signal(from_s=0.05, to_s=0.07),
        "spectrum": result.plot_spectrum(to_hz=8000.0),
        "envelope": longer.plot_envelope(),
        "load_zone": longer.plot_load_zone(),
        "pass": result.plot_pass(),
        "statics": brinell.static_analysis(base).plot(),
        "sweep": table.plot("sensor_ax.rms"),
        "analysis": brinell.analyze(longer["sensor_ax"], **settings).plot(),
        "psd": brinell.psd(x, rate_hz=result.rate_hz, unit="m/s^2").plot(),
    }
    # The frequency that was found, not that of pure rolling, and which is which.
    words, found = {text.get_text() for text in pictures["envelope"].texts}, longer.quantities["defect1.frequency"]
    assert f"{found:.4g} Hz found" in words and any(word.endswith("Hz, pure rolling") for word in words)
    assert found == pytest.approx(pictures["envelope"].lines[1].get_xdata()[0])
    for name, ax in pictures.items():
        ax.figure.savefig(tmp_path / f"{name}.png", dpi=110)
        assert (tmp_path / f"{name}.png").stat().st_size > 5000
    with pytest.raises(ValueError, match="sensor_ax.rms"):
        table.plot("x.rms")
    with pytest.raises(ValueError, match="1 to 1"):
        result.plot_pass(2)


def test_regress_the_best_band_of_noise_is_not_called_impulsive():
    x = np.random.default_rng(1).normal(size=20_000)
    found = brinell.kurtogram(x, rate_hz=10_000.0)
    assert not found.is_impulsive and "no band is impulsive: the largest, " in repr(found)
    x[::400] += 20.0
    found = brinell.kurtogram(x, rate_hz=10_000.0)
    assert found.is_impulsive and ", best " in repr(found)
