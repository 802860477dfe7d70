"""Limits of an axis for the live page, in the unit in which its control shows it."""

from amp_studio.pictures import LiveLimits, axis_limits


def test_ends_of_the_travel_and_largest_error_of_the_file(example):
    file = example("9pc")
    own = axis_limits(file, "X", "mm")
    assert (own.low, own.high) == (-500.0, 8.0)
    assert axis_limits(file, "X", "in").high == 8.0 / 25.4
    assert axis_limits(example("57c422b"), "X", "counts").error == 2000.0


def test_an_unknown_axis_and_another_dimension_have_none(example):
    assert axis_limits(example("9pc"), "Q", "mm") == LiveLimits()
    assert axis_limits(example("9pc"), "X", "counts").low is None
