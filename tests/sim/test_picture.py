"""A picture hides nothing: peaks, what was before, what is assumed."""

import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest

from amp_studio.drawing.svg import COLOURS
from amp_studio.sim import Trace
from amp_studio.sim.picture import picture_of, plot_svg, settling_span
from amp_studio.sim.scenarios import SCENARIOS
from tests.sim.tiny import tiny


@pytest.fixture(scope="module")
def trace() -> Trace:
    return SCENARIOS["step"].run(tiny(), {"move.feedrate": 6000.0, "move.distance": 20.0})


def test_the_panels_share_one_time_axis_and_output_has_one_of_its_own(trace: Trace) -> None:
    picture = picture_of(trace)
    assert [panel.title for panel in picture.panels] == ["position", "following error", "velocity", "torque"]
    assert picture.panels[3].y.unit == "%"
    assert all(
        curve.x[-1] == trace.columns["time_s"][-1] for panel in picture.panels for curve in panel.curves
    )


def test_the_close_look_begins_ten_bands_from_the_end_and_shows_the_band() -> None:
    banded_trace = SCENARIOS["step"].run(tiny(), {"move.feedrate": 6000.0, "move.distance": 20.0})
    banded_trace = replace(banded_trace, limits={"inposition band": (0.01, "mm")})
    picture = picture_of(banded_trace)
    assert picture.close is not None
    assert [level[:2] for level in picture.close.levels] == [("inposition band ±0.01", 0.01), ("", -0.01)]
    (curve,) = picture.close.curves
    assert 0.1 <= np.abs(curve.y[0]) < 0.13
    assert settling_span(banded_trace)[1] > curve.x[0]


def test_the_trace_before_a_change_lies_under_the_one_after_it(trace: Trace) -> None:
    before = SCENARIOS["step"].run(tiny(gain=10.0), {"move.feedrate": 6000.0, "move.distance": 20.0})
    for panel in picture_of(trace, before).panels:
        assert panel.curves[0].is_before
        assert not panel.curves[-1].is_before
    assert plot_svg(trace, before).count(f'stroke="{COLOURS["before"]}"') > plot_svg(trace).count(
        f'stroke="{COLOURS["before"]}"'
    )


def test_another_scenario_before_is_not_drawn(trace: Trace) -> None:
    bode = SCENARIOS["frequency"].run(tiny(gain=3000.0), {})
    assert not picture_of(trace, bode).panels[0].curves[0].is_before


def test_what_is_assumed_is_written_under_the_picture(trace: Trace) -> None:
    texts = [node.text for node in ET.fromstring(plot_svg(trace)).iter("{http://www.w3.org/2000/svg}text")]
    assert any(text.startswith("Assumed: model.acceleration_per_output = 50") for text in texts if text)


def test_a_bode_plot_has_both_loops_and_the_limit_of_stability() -> None:
    picture = picture_of(SCENARIOS["frequency"].run(tiny(gain=3000.0), {}))
    gain, phase = picture.panels
    assert picture.panels[0].x.log
    assert [curve.name for curve in gain.curves if len(curve.x)] == ["closed loop, model", "open loop, model"]
    assert phase.levels[0][:2] == ("−180 deg", -180.0)
    ET.fromstring(plot_svg(SCENARIOS["frequency"].run(tiny(gain=3000.0), {})))


def test_the_predicted_radius_error_is_drawn_on_the_side_of_the_circle_that_is_too_small() -> None:
    trace = SCENARIOS["circle"].run(tiny(), {"move.radius": 20.0, "move.feedrate": 3000.0})
    (panel,) = picture_of(trace).panels
    level = panel.levels[0].at
    assert level == pytest.approx(float(trace.columns["radius_deviation"].mean()), rel=0.01)
    assert level < 0.0


def test_a_curve_that_was_not_measured_is_not_in_the_legend() -> None:
    assert "open loop, swept" not in plot_svg(SCENARIOS["frequency"].run(tiny(gain=3000.0), {}))
