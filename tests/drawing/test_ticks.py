"""Round numbers along a scale."""

import pytest

from amp_studio.drawing.ticks import decades, ticks


@pytest.mark.parametrize(
    ("low", "high", "expected"),
    [(0.0, 1.0, [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]), (-3.0, 7.0, [-2.0, 0.0, 2.0, 4.0, 6.0])],
)
def test_ticks_are_round_numbers(low: float, high: float, expected: list[float]) -> None:
    assert ticks(low, high, 5.0) == expected


def test_degrees_have_the_step_of_a_circle() -> None:
    assert ticks(-200.0, 10.0, 3.0, 90.0) == [-180.0, -90.0, 0.0]


@pytest.mark.parametrize(
    ("about", "expected"), [(4.0, [1.0, 10.0]), (12.0, [0.5, 1.0, 2.0, 5.0, 10.0, 20.0])]
)
def test_a_logarithmic_scale_has_as_many_figures_as_there_is_room_for(
    about: float, expected: list[float]
) -> None:
    assert decades(0.3, 30.0, about) == expected
