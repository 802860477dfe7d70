"""Panels of curves: their scales."""

import numpy as np
import pytest

from amp_studio.drawing import Curve, panel_of, round_divisions, round_step
from amp_studio.drawing.panels import DIVISIONS


@pytest.mark.parametrize(("low", "high"), [(0.0, 3.0), (-1.0, 1.0), (99_999.0, 100_003.0), (-0.017, 0.4)])
def test_round_divisions_show_all_of_a_panel_on_the_least_round_scale(low: float, high: float) -> None:
    times = np.array([0.0, 1.0])
    panel = panel_of("position", (Curve("", times, np.array([low, high])),), ("time", "s"), without_zero=True)
    divided = round_divisions(panel).y
    assert divided.low <= low < high <= divided.high
    assert divided.high - divided.low == pytest.approx(DIVISIONS * divided.step)
    assert divided.step == round_step(divided.step)
    assert (high - low) / divided.step > 2.0
