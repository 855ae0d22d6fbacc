"""Names: of channels, numbers and columns."""

import matplotlib.pyplot as plt
import pytest

import brinell


def test_regress_what_has_names_lists_them_and_knows_a_misspelt_one(base, result):
    short = base.replace({"simulation.duration_s": 0.02})
    table = brinell.sweep(short, {"operation.speed_rpm": [900.0, 1800.0]})
    compared = brinell.compare({"a": short, "b": short})
    for thing, name, wrong in (
        (result, "sensor_ax", "sensr_ax"),
        (table, "sensor_ax.rms", "sensor_ax.rmss"),
        (compared, "sensor_ax.rms", "sensor_ax.rmss"),
    ):
        assert name in thing and wrong not in thing and 0 not in thing and [] not in thing
        assert name in list(thing) and list(thing) == thing._ipython_key_completions_()
        with pytest.raises(KeyError, match=f'{wrong}.*did you mean "{name}"'):
            thing[wrong]
        with pytest.raises(KeyError, match="0: "):
            thing[0]
    assert len(result) == len(result.t) and len(table) == 2 and len(compared) == len(list(compared))
    with pytest.raises(KeyError, match='operation.sped_rpm: .*did you mean "operation.speed_rpm"'):
        base["operation.sped_rpm"]
    assert "operation.speed_rpm" in base._ipython_key_completions_()


@pytest.mark.parametrize("bearing", ["6205", "NU205"])
def test_regress_every_picture_is_drawn_of_balls_and_rollers(bearing):
    spall = brinell.circle(diameter_mm=1.0, depth_um=10.0, center_deg=0.0)
    scenario = brinell.Scenario(
        bearing=bearing, operation={"speed_rpm": 1800.0, "load_n": [500.0, 0.0]}, defects=[spall], simulation={"duration_s": 0.5}
    )
    result = brinell.simulate(scenario)
    for draw in (result.plot_signal, result.plot_spectrum, result.plot_envelope, result.plot_load_zone, result.plot_pass):
        draw()
        plt.close("all")
    brinell.static_analysis(scenario).plot()
    result.analyze().plot()
    unit = result.plot_pass().figure.axes[1].get_ylabel()
    assert unit == {"6205": "Stiffness (N/m$^n$)", "NU205": "Stiffness (N/m$^{10/9}$)"}[bearing]


def test_regress_reasons_are_words_of_polars(base):
    polars = pytest.importorskip("polars")
    short = base.replace({"simulation.duration_s": 0.02})
    table = brinell.sweep(short, {"bearing.radial_clearance_um": [5, -500], "operation.load_n": [[300.0, 0.0], [200.0, 0.0]]})
    frame = table.to_polars()
    assert frame["reason"].dtype == polars.String and frame["reason"].is_null().to_list() == [True, True, False, False]
    assert frame["operation.load_n"].to_list()[1] == [200.0, 0.0]
    assert table.to_pandas()["status"].to_list() == ["complete", "complete", "failed", "failed"]
