"""A picture hides nothing: peaks, what was before, what is assumed."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest

from amp_studio.sim import Trace
from amp_studio.sim.plot.panels import Ring
from amp_studio.sim.plot.picture import banded, picture_of, settling_span, thinned, unheld
from amp_studio.sim.plot.svg import plot_svg
from amp_studio.sim.plot.svg_parts import COLOURS
from amp_studio.sim.plot.ticks import ring_levels
from amp_studio.sim.scenarios import SCENARIOS
from tests.sim.tiny import tiny


@pytest.fixture(scope="module")
def trace() -> Trace:
    return SCENARIOS["step"].run(tiny(), {"move.feedrate": 6000.0, "move.distance": 20.0})


def test_one_row_of_an_extreme_is_drawn_however_long_the_trace_is() -> None:
    y = np.zeros(1_000_000)
    y[123_456], y[123_457] = 7.0, -5.0
    x, drawn = thinned(np.arange(1e6), y, 800)
    assert len(x) <= 3200
    assert (drawn.max(), drawn.min()) == (7.0, -5.0)
    assert np.all(np.diff(x) > 0)


def test_a_held_command_is_drawn_through_its_samples_not_as_stairs() -> None:
    x = np.arange(400.0)
    held = np.floor(x / 4) * 4
    corners, values = unheld(x, held)
    slopes = np.diff(values[:-1]) / np.diff(corners[:-1])
    assert slopes == pytest.approx(np.ones(len(slopes)))
    assert len(x) == 400 > 3 * len(corners)


def test_a_held_command_that_pauses_stays_level_until_it_goes_on() -> None:
    held = np.concatenate(
        [np.repeat(np.arange(10.0), 4), np.full(400, 9.0), np.repeat(np.arange(10.0, 20.0), 4)]
    )
    x, y = unheld(np.arange(480.0), held)
    assert np.interp(300.0, x, y) == 9.0


def test_a_value_that_jumps_at_every_sample_is_its_mean_in_the_band_that_it_fills() -> None:
    y = np.where(np.arange(8000) % 2, 1.0, -1.0)
    y[4001] = 30.0
    x, mean, least, most = banded(np.arange(8000.0), y, 800)
    assert mean[:400] == pytest.approx(np.zeros(400))
    assert (least.min(), most.max()) == (-1.0, 30.0)
    assert len(x) == 800


def test_the_panels_share_one_time_axis_and_output_has_one_of_its_own(trace: Trace) -> None:
    picture = picture_of(trace)
    assert [panel.label for panel in picture.panels] == ["position", "following error", "velocity", "torque"]
    assert picture.panels[3].unit == "%"
    assert all(
        curve.x[-1] == trace.columns["time_s"][-1] for panel in picture.panels for curve in panel.curves
    )


def test_the_close_look_begins_ten_bands_from_the_end_and_shows_the_band() -> None:
    banded_trace = SCENARIOS["step"].run(tiny(), {"move.feedrate": 6000.0, "move.distance": 20.0})
    banded_trace = replace(banded_trace, limits={"inposition band": (0.01, "mm")})
    picture = picture_of(banded_trace)
    assert picture.close is not None
    assert picture.close.levels == (("inposition band ±0.01", 0.01), ("", -0.01))
    (curve,) = picture.close.curves
    assert 0.1 <= np.abs(curve.y[0]) < 0.13
    assert settling_span(banded_trace)[1] > curve.x[0]


def test_the_trace_before_a_change_lies_under_the_one_after_it(trace: Trace) -> None:
    before = SCENARIOS["step"].run(tiny(gain=10.0), {"move.feedrate": 6000.0, "move.distance": 20.0})
    for panel in picture_of(trace, before).panels:
        assert panel.curves[0].role == "before"
        assert panel.curves[-1].role != "before"
    assert plot_svg(trace, before).count(f'stroke="{COLOURS["before"]}"') > plot_svg(trace).count(
        f'stroke="{COLOURS["before"]}"'
    )


def test_another_scenario_before_is_not_drawn(trace: Trace) -> None:
    bode = SCENARIOS["frequency"].run(tiny(gain=3000.0), {})
    assert picture_of(trace, bode).panels[0].curves[0].role != "before"


def test_what_is_assumed_is_written_under_the_picture(trace: Trace) -> None:
    texts = [node.text for node in ET.fromstring(plot_svg(trace)).iter("{http://www.w3.org/2000/svg}text")]
    assert any(text.startswith("Assumed: model.acceleration_per_output = 50") for text in texts if text)


def test_a_bode_plot_has_both_loops_and_the_limit_of_stability() -> None:
    picture = picture_of(SCENARIOS["frequency"].run(tiny(gain=3000.0), {}))
    gain, phase = picture.panels
    assert picture.x_log
    assert [curve.name for curve in gain.curves if len(curve.x)] == [
        "closed loop, model",
        "open loop, model",
    ]
    assert ("−180 deg", -180.0) in phase.levels
    ET.fromstring(plot_svg(SCENARIOS["frequency"].run(tiny(gain=3000.0), {})))


def test_the_predicted_radius_error_is_drawn_on_the_side_of_the_circle_that_is_too_small() -> None:
    trace = SCENARIOS["circle"].run(tiny(), {"move.radius": 20.0, "move.feedrate": 3000.0})
    (panel,) = picture_of(trace).panels
    (_, level) = panel.levels[1]
    assert level == pytest.approx(float(trace.columns["radius_deviation"].mean()), rel=0.01)
    assert level < 0.0


@pytest.mark.parametrize(
    ("peak", "levels"),
    [
        (0.0459, [-0.05, 0.0, 0.05]),
        (0.012, [-0.02, -0.01, 0.0, 0.01, 0.02]),
        (1.0, [-1.0, -0.5, 0.0, 0.5, 1.0]),
    ],
)
def test_the_rings_of_a_ball_bar_plot_are_round_numbers_that_hold_the_path(
    peak: float, levels: list[float]
) -> None:
    ring = Ring("", np.array([0.0, 1.0]), np.array([peak, -0.1 * peak]), "actual")
    found, most = ring_levels([ring])
    assert found == pytest.approx(levels)
    assert most >= peak


def test_a_curve_that_was_not_measured_is_not_in_the_legend() -> None:
    assert "open loop, swept" not in plot_svg(SCENARIOS["frequency"].run(tiny(gain=3000.0), {}))
