"""The arithmetic of the firmware, with the examples of its functions."""

import pytest

from amp_studio.families.grblhal.formulas import (
    axis_place,
    homing_phases,
    is_turning,
    mask_end,
    ramp_travel,
    rotary_end,
    step_rate,
    steps_per_unit,
)


def test_steps_speeds_and_ramps() -> None:
    assert steps_per_unit(200, 16, 5) == 640
    assert step_rate(3000, 80) == 4000
    assert ramp_travel(3000, 500) == 5


@pytest.mark.parametrize(
    "call", [lambda: steps_per_unit(200, 16, 0), lambda: step_rate(-1, 80), lambda: ramp_travel(3000, 0)]
)
def test_what_makes_no_sense_is_refused(call: object) -> None:
    with pytest.raises(ValueError, match="The "):
        call()


def test_masks_go_by_the_order_of_the_axes() -> None:
    assert [axis_place("XYZU", axis) for axis in "XZUA"] == [0, 2, 3, -1]
    assert axis_place("XYZ", "z") == 2
    assert (mask_end("XYZ"), mask_end("XYZABCUV")) == (8, 256)
    assert [rotary_end(axes) for axes in ("XYZ", "XYZA", "XYZAB", "XYZABCUV")] == [1, 2, 4, 32]


def test_an_axis_is_homed_in_the_phases_that_have_it() -> None:
    assert homing_phases("XYZ", "Z", 4, 3, 0) == 1
    assert homing_phases("XYZ", "X", 1, 3, None, 1) == 3
    assert homing_phases("XYZ", "A", 15) == 0


def test_rotary_axes_begin_with_the_fourth() -> None:
    assert is_turning("XYZA", "A", 1)
    assert not is_turning("XYZAB", "A", 2)
    assert not is_turning("XYZA", "X", 31)
    assert not is_turning("XYZA", "A", None)
