"""Runs, alone and side by side."""

import gc
import pickle
import signal
import subprocess
import sys
import textwrap
import threading

import numpy as np
import pytest

import brinell


def test_prop_many_runs_are_each_alone_bit_for_bit(base):
    scenarios = [base.replace({"operation.speed_rpm": rpm, "simulation.duration_s": 0.03}) for rpm in (600.0, 1200.0, 1800.0, 2400.0)]
    alone = [brinell.simulate(scenario) for scenario in scenarios]
    for jobs in (1, 3):
        told = []
        many = brinell.simulate_many(scenarios, jobs=jobs, progress=lambda done, of: told.append((done, of)))
        assert told == [(k, 4) for k in range(1, 5)]
        for one, other in zip(alone, many, strict=True):
            assert one.summary == other.summary and one.scenario is other.scenario
            for name in one.channels:
                np.testing.assert_array_equal(one[name], other[name])
    assert brinell.simulate_many([]) == []


def test_prop_a_failure_is_raised_or_takes_its_place(base):
    loose = {"simulation.start": "equilibrium", "support.inner_stiffness_n_per_m": 0.0, "support.outer_stiffness_n_per_m": 0.0}
    with pytest.warns(brinell.ScenarioWarning, match="will drift"):
        bad = base.replace(loose)
    good = base.replace({"simulation.duration_s": 0.01})
    with pytest.raises(brinell.ScenarioError, match="no static balance"):
        brinell.simulate_many([good, bad, good])
    results = brinell.simulate_many([good, bad, good], errors="return")
    assert [type(r).__name__ for r in results] == ["Result", "ScenarioError", "Result"]
    with pytest.raises(ValueError, match="allowed: raise, return"):
        brinell.simulate_many([good], errors="ignore")
    with pytest.raises(ValueError, match="allowed: 1 or more"):
        brinell.simulate_many([good], jobs=0)


def test_prop_what_a_callback_raises_stops_the_rest(base):
    seen = []

    def reduce(result):
        seen.append(result)
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        brinell.simulate_many([base.replace({"operation.speed_rpm": 600.0 + k}) for k in range(20)], jobs=1, reduce=reduce)
    assert len(seen) == 1

    def progress(t):
        raise LookupError(t)

    with pytest.raises(LookupError):
        brinell.simulate(base, settings={"simulation.duration_s": 5.0}, progress=progress)


def test_prop_arrays_own_the_memory_of_the_run(base):
    result = brinell.simulate(base, settings={"simulation.duration_s": 0.02})
    x = result["outer_ax"]
    assert x.flags.c_contiguous and x.flags.writeable and x.dtype == np.float64
    assert result["outer_ax"] is x
    copy = x.copy()
    del result
    gc.collect()
    np.testing.assert_array_equal(x, copy)
    assert brinell.simulate(base, settings={"simulation.duration_s": 0.02})["t"][-1] == 0.02


def test_prop_other_threads_go_on_during_a_run(base):
    stop, ticks = threading.Event(), []

    def tick():
        while not stop.wait(0.001):
            ticks.append(None)

    thread = threading.Thread(target=tick)
    thread.start()
    try:
        brinell.simulate(base)
    finally:
        stop.set()
        thread.join()
    # With the lock held, none could.
    assert len(ticks) >= 3


def test_prop_runs_go_on_in_threads_of_python_too(base):
    results = {}

    def work(k):
        results[k] = brinell.simulate(base, settings={"simulation.duration_s": 0.02})

    threads = [threading.Thread(target=work, args=(k,)) for k in range(3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for k in range(3):
        np.testing.assert_array_equal(results[k]["sensor_ax"], results[0]["sensor_ax"])


@pytest.mark.skipif(sys.platform == "win32", reason="sends a POSIX signal")
@pytest.mark.parametrize(
    "call",
    [
        "brinell.simulate(base)",
        "brinell.simulate_many([base, base, base])",
        "brinell.sweep(base, {'operation.speed_rpm': [900.0, 1800.0]})",
        "brinell.compare({'full': base}, {'lumped': {'simulation.model': 'lumped'}})",
        "brinell.calibrate(base, {'operation.speed_rpm': (900.0, 1800.0)}, {'sensor_ax.rms': (30.0, 1.0)})",
    ],
)
def test_prop_ctrl_c_stops_a_run(call, examples):
    program = f"""
        import brinell, os, signal, sys, threading
        # Hours of simulated time.
        base = brinell.Scenario.from_file({str(examples / "rectangle.toml")!r}, {{"simulation.duration_s": 20000.0, "simulation.most_steps": 1e12,
            "simulation.record": ["sensor_ax"], "simulation.sample_rate_hz": 25600.0}})
        threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
        try:
            {call}
        except KeyboardInterrupt:
            print("stopped")
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(program)], capture_output=True, text=True, timeout=60)
    assert (done.stdout, done.returncode) == ("stopped\n", 0), done.stderr
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_prop_more_than_memory_holds_is_refused(base):
    # 10^15 samples.
    with pytest.raises((MemoryError, brinell.ScenarioError)) as caught:
        brinell.simulate(base, settings={"simulation.duration_s": 4e10})
    assert "GB" in str(caught.value) or "duration_s" in str(caught.value)


def test_prop_results_can_be_sent_away(result):
    again = pickle.loads(pickle.dumps(result))
    assert again.summary == result.summary and again.quantities.keys() == result.quantities.keys()
    assert again.scenario == result.scenario and again.defects == result.defects
    np.testing.assert_array_equal(again["sensor_ax"], result["sensor_ax"])
    np.testing.assert_array_equal(again.envelope.amplitude, result.envelope.amplitude)
    np.testing.assert_array_equal(again.events["t"], result.events["t"])
    assert len(again.passes) == len(result.passes) == 1
    assert again.units == result.units
    with pytest.raises(RuntimeError, match="another process"):
        again.to_html()


def test_regress_ground_truth_of_entries_and_exits(result):
    events = result.events
    on = events["t"][events["enters"]]
    assert len(on) > 10 and set(events["defect"]) == {1} and set(events["row"]) == {1}
    assert events["roller"].min() >= 1 and events["roller"].max() <= 19
    # Rollers of row 1 come on at BPFO, or a few per cent more slowly as long as the cage slips.
    late = on[on > 0.05]
    np.testing.assert_allclose(np.diff(late).mean(), 1.0 / 250.1, rtol=0.05)


def test_regress_every_entry_and_exit_of_a_run_is_kept(base):
    # The findings keep the latest 4096.
    spalls = [brinell.rectangle(length_mm=0.2, width_mm=4.0, depth_um=1.0, center_deg=8.0 * k) for k in range(45)]
    events = brinell.simulate(base, settings={"defects": spalls, "simulation.duration_s": 0.4}).events
    assert len(events["t"]) > 4096 and events["t"][0] < 0.02 and np.all(np.diff(events["t"]) >= 0.0)


def test_regress_more_jobs_than_runs_are_as_many_as_runs(base):
    for jobs in (10**9, 9 * 10**18):
        assert len(brinell.simulate_many([base], jobs=jobs)) == 1
    assert len(brinell.sweep(base, {"operation.speed_rpm": [900.0, 1800.0]}, jobs=10**9)) == 2


def test_regress_one_scenario_is_not_many(base):
    for call in (lambda: brinell.simulate_many(base), lambda: brinell.simulate_many("bearing.toml")):
        with pytest.raises(TypeError, match=r"scenarios: expected several, and it is one .*; give \[scenario\]"):
            call()


@pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX")
def test_regress_ctrl_c_ends_the_wait_for_a_spectrum():
    program = """
        import brinell, numpy as np, os, signal, threading, time
        x = np.random.default_rng(1).normal(size=2**23)
        began = time.monotonic()
        threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT)).start()
        try:
            brinell.analyze(x, rate_hz=51200.0, unit="g", speed_rpm=1800.0, bearing="6205-2RS")
        except KeyboardInterrupt:
            print(time.monotonic() - began)
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(program)], capture_output=True, text=True, timeout=120)
    assert float(done.stdout) < 2.0, done.stderr


def test_regress_names_that_are_not_there(result):
    with pytest.raises(KeyError, match='not recorded, did you mean "sensor_a'):
        result["sensor_az"]
    with pytest.raises(TypeError, match="brinell.simulate"):
        brinell.Result()
    with pytest.raises(TypeError, match="Scenario"):
        brinell.simulate(3)


def test_regress_frames(result):
    pandas = pytest.importorskip("pandas")
    frame = result.to_pandas()
    assert isinstance(frame, pandas.DataFrame) and frame.attrs["units"]["outer_x"] == "m"
    assert np.shares_memory(frame["outer_ax"].to_numpy(), result["outer_ax"])
    polars = pytest.importorskip("polars")
    assert result.to_polars().equals(polars.DataFrame(result.signals))
    pytest.importorskip("xarray")
    dataset = result.to_xarray()
    assert dataset.outer_x.attrs["units"] == "m" and dataset.outer_x.dims == ("t",)
    assert dataset.attrs["scenario"] == result.scenario.to_toml()


def test_prop_the_spread_of_a_run_has_what_was_run_by_hand(base):
    healthy = base.replace({"simulation.laws": "mechanics", "simulation.duration_s": 0.05, "defects": []})
    spread = brinell.simulate(healthy).spread()
    level = next(level for level in spread["levels"] if level["name"] == "sensor_ax.rms")
    key = next(key for key in spread["assumed"] if key["key"] == "contact.damping_time_us")
    bar = next(bar for bar in level["by"] if bar["key"] == key["key"])
    by_hand = brinell.simulate(healthy.replace({key["key"]: key["high"]}))
    assert by_hand.quantities["sensor_ax.rms"] == bar["at_high"]
    assert level["low"] <= level["value"] <= level["high"]


def test_prop_the_settled_part_is_the_end_of_each_channel_and_what_averages_are_of(base):
    result = brinell.simulate(base, settings={"simulation.duration_s": 0.5})
    settled, from_s = result.settled, result.quantities["analysed_from"]
    assert list(settled) == list(result) and "sensor_ax" in settled and len(settled) == len(result.channels)
    # A turn at 1800 r/min after the load ramp, on the grid of samples.
    assert settled.t[0] == from_s and from_s == pytest.approx(result.scenario["operation.load_ramp_s"] + 1.0 / 30.0, abs=1.0 / result.rate_hz)
    for name in result:
        np.testing.assert_array_equal(settled[name], result[name][result.t >= from_s])
        assert np.shares_memory(settled[name], result[name])
    whole_turns = round(result.quantities["analysed_turns"] / 30.0 * result.rate_hz)
    # Averages are of whole turns, to within a sample.
    mean_square = np.mean((settled["inner_x"][:whole_turns] - settled["inner_x"][:whole_turns].mean()) ** 2)
    assert np.sqrt(mean_square) == pytest.approx(result.quantities["inner_x.standard_deviation"], rel=1e-2)
    with pytest.raises(TypeError):
        settled["sensor_ax"] = settled["sensor_ax"]
    with pytest.raises(KeyError, match='sensr_ax.*did you mean "sensor_ax"'):
        settled["sensr_ax"]
    np.testing.assert_array_equal(pickle.loads(pickle.dumps(result)).settled.t, settled.t)


def test_regress_a_run_that_ended_in_its_start_has_no_settled_part(base):
    result = brinell.simulate(base)
    result.summary["quantities"]["analysed_from"]["value"] = 0.0
    with pytest.raises(ValueError, match="no settled part"):
        _ = result.settled
