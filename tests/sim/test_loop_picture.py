"""The loop as a Nyquist and a Nichols chart: true to the loop, with the area that a sound one stays out
of."""

from dataclasses import replace

import numpy as np
import pytest

from amp_studio.drawing import Curve, Scene
from amp_studio.sim import Trace, picture_of

RATE, LAG = 30.0, 0.012
"""1/s and s of the loop L = rate / s · exp(-s · lag), whose margins have formulas."""


@pytest.fixture(scope="module")
def trace() -> Trace:
    frequency = np.geomspace(0.3, 60.0, 4000)
    omega = 2.0 * np.pi * frequency
    loop = RATE / (1j * omega) * np.exp(-1j * omega * LAG)
    gain, phase = 20.0 * np.log10(np.abs(loop)), np.degrees(np.unwrap(np.angle(loop)))
    columns = {"frequency_hz": frequency}
    for name in ("open_gain_db_model", "open_gain_db", "velocity_gain_db_model"):
        columns |= {name: gain, name.replace("gain_db", "phase_deg"): phase}
    result = {"Ms": (float((1.0 / np.abs(1.0 + loop)).max()), "")}
    return Trace("frequency", "1", "", columns, dict.fromkeys(columns, ""), result, (), (), (), {})


def curve(scene: Scene | None, name: str) -> Curve:
    assert scene is not None
    return next(each for each in scene.curves if each.name == name)


def test_the_nyquist_curve_comes_as_near_to_minus_one_as_ms_is_large(trace: Trace) -> None:
    scene = picture_of(trace, None, "nyquist").above
    loop = curve(scene, "position loop")
    nearest = np.hypot(loop.x + 1.0, loop.y).min()
    assert 1.0 / nearest == pytest.approx(trace.result["Ms"][0], rel=2e-3)
    edge = curve(scene, "Ms 1.6")
    assert np.hypot(edge.x + 1.0, edge.y) == pytest.approx(np.full(len(edge.x), 1.0 / 1.6))
    assert scene.equal
    assert scene.x.high - scene.x.low == pytest.approx(scene.y.high - scene.y.low)


def test_the_nichols_curve_has_the_margins_where_it_crosses(trace: Trace) -> None:
    loop = curve(picture_of(trace, None, "nichols").above, "position loop")
    phase = float(np.interp(0.0, -loop.y, loop.x))
    assert phase + 180.0 == pytest.approx(90.0 - np.degrees(RATE * LAG), abs=0.01)
    gain = float(np.interp(180.0, -loop.x, loop.y))
    assert -gain == pytest.approx(20.0 * np.log10(np.pi / 2.0 / LAG / RATE), abs=0.01)


def test_nothing_is_drawn_outside_of_a_chart_and_before_is_under_it(trace: Trace) -> None:
    before = replace(trace, columns={**trace.columns, "open_gain_db_model": trace.columns["open_gain_db"]})
    for chart in ("nyquist", "nichols"):
        scene = picture_of(trace, trace, chart).above
        assert {each.name for each in scene.curves if each.is_before} == {"before"}
        for each in scene.curves:
            assert ((each.x >= scene.x.low) & (each.x <= scene.x.high)).all()
            assert ((each.y >= scene.y.low) & (each.y <= scene.y.high)).all()
        (below,) = picture_of(trace, before, chart).panels
        assert below.title == "sensitivity"


def test_a_trace_without_a_loop_has_its_one_picture(trace: Trace) -> None:
    plain = picture_of(trace)
    assert plain.above is None
    assert len(plain.panels) == 2
