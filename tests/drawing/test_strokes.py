"""What is drawn of a curve hides nothing: peaks, pauses, the band of a value that jumps."""

import numpy as np
import pytest

from amp_studio.drawing import Curve, Placement, Ring, panel_of, strokes_of, zoomed
from amp_studio.drawing.panels import ring_levels
from amp_studio.drawing.strokes import banded, thinned, without_stairs


def test_one_row_of_an_extreme_is_drawn_however_long_the_trace_is() -> None:
    y = np.zeros(1_000_000)
    y[123_456], y[123_457] = 7.0, -5.0
    x, drawn = thinned(np.arange(1e6), y, 800)
    assert len(x) <= 3200
    assert (drawn.max(), drawn.min()) == (7.0, -5.0)
    assert np.all(np.diff(x) > 0)


def test_a_constant_command_is_drawn_through_its_samples_not_as_stairs() -> None:
    x = np.arange(400.0)
    is_stepped = np.floor(x / 4) * 4
    corners, values = without_stairs(x, is_stepped)
    slopes = np.diff(values[:-1]) / np.diff(corners[:-1])
    assert slopes == pytest.approx(np.ones(len(slopes)))
    assert len(x) == 400 > 3 * len(corners)


def test_a_constant_command_that_pauses_stays_level_until_it_goes_on() -> None:
    is_stepped = np.concatenate(
        [np.repeat(np.arange(10.0), 4), np.full(400, 9.0), np.repeat(np.arange(10.0, 20.0), 4)]
    )
    x, y = without_stairs(np.arange(480.0), is_stepped)
    assert np.interp(300.0, x, y) == 9.0


def test_a_value_that_jumps_at_every_sample_is_its_mean_in_the_band_that_it_fills() -> None:
    y = np.where(np.arange(8000) % 2, 1.0, -1.0)
    y[4001] = 30.0
    x, mean, least, most = banded(np.arange(8000.0), y, 800)
    assert mean[:400] == pytest.approx(np.zeros(400))
    assert (least.min(), most.max()) == (-1.0, 30.0)
    assert len(x) == 800


def test_a_part_of_a_curve_is_drawn_with_the_points_beside_it() -> None:
    x = np.arange(1000.0)
    curve = Curve("", x, np.sin(x))
    panel = zoomed(panel_of("", [curve], ("time", "s")), (99.5, 102.5))
    line, band = strokes_of(Placement(panel, 0.0, 0.0, 300.0, 100.0), curve)
    assert band is None
    assert line[:, 0].tolist() == pytest.approx([-50.0, 50.0, 150.0, 250.0, 350.0])


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
    ring = Ring(np.array([0.0, 1.0]), np.array([peak, -0.1 * peak]), "now")
    found, most = ring_levels([ring])
    assert found == pytest.approx(levels)
    assert most >= peak
