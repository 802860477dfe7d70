"""The figures that chapter 10 of the manual prints, from the ramps that the simulator moves an axis with."""

import math

import pytest

from amp_studio.families.ninepc.law_ramps import jerk_bounds
from amp_studio.sim import SimulationError
from amp_studio.sim.command.pieces import Piece, change
from amp_studio.sim.law import Ramp

from .conftest import Axis, Values

TIMES: Values = {"timing.fine_foreground": 10.0, "timing.scans_per_logic": 2.0}
"""A system scan time of 20 ms."""


def velocity_at(pieces: list[Piece], moment: float) -> float:
    """Return the velocity of pieces at a moment in s."""
    for piece in pieces:
        if moment <= piece.duration:
            return piece.velocity_after(moment)
        moment -= piece.duration
    return pieces[-1].end


def test_an_exponential_acceleration_passes_63_and_86_ipm_after_one_and_two_time_constants(
    axis: Axis,
) -> None:
    # Page 10-15: 100 ipm, a delay constant of 10 and 20 ms of scan time; here of the programmed one (10-17).
    ramp = axis({**TIMES, "accdec.programmed_delay": 10.0}).ramps["exponential"]
    assert ramp.time == pytest.approx(0.2)
    pieces = change(ramp, 0.0, 100.0)
    assert [math.floor(velocity_at(pieces, moment)) for moment in (0.2, 0.4)] == [63, 86]


def test_an_exponential_deceleration_passes_137_and_114_ipm(axis: Axis) -> None:
    # Page 10-16: from 200 to 100 ipm, a delay constant of 8.
    ramp = axis({**TIMES, "accdec.programmed_delay": 8.0}).ramps["exponential"]
    pieces = change(ramp, 200.0, 100.0)
    assert [round(velocity_at(pieces, moment)) for moment in (0.16, 0.32)] == [137, 114]


@pytest.mark.parametrize(
    ("ramp", "scan", "printed"), [(1000.0, 0.020, (833.0, 25000.0)), (2500.0, 0.014, (2976.0, 89286.0))]
)
def test_the_bounds_of_the_jerk_are_those_of_the_table(
    ramp: float, scan: float, printed: tuple[float, float]
) -> None:
    # Pages 10-20 and 10-22: 60 and 2 scans of 20 ms, and of 14 ms.
    assert tuple(round(bound) for bound in jerk_bounds(ramp, scan)) == printed


@pytest.mark.parametrize(("ramp", "jerk", "time"), [(1000.0, 6250.0, 0.16), (2500.0, 22321.0, 0.112)])
def test_an_s_curve_takes_the_time_of_the_table_to_reach_its_ramp(
    ramp: float, jerk: float, time: float
) -> None:
    # The examples "per machine parameters" of the same table; all figures per minute as printed.
    rise, even, fall = change(Ramp("s-curve", ramp, ramp, jerk), 0.0, 2000.0)
    assert rise.duration == fall.duration == pytest.approx(time, rel=1e-4)
    assert even.acceleration == ramp


def test_a_jerk_outside_of_2_to_60_scans_is_simulated_at_its_bound_with_a_note(axis: Axis) -> None:
    # Page 10-19; the defaults, 25.4 mm/s2 and 5.08 mm/s3, are 5 s (37-3).
    curve: Values = {**TIMES, "accdec.scurve_acceleration": 25.4, "accdec.jerk": 5.08}
    law = axis(curve)
    assert law.ramps["s-curve"].jerk == pytest.approx(25.4 / 1.2)
    assert any("S-curve of 5 s" in note for note in law.assumptions)
    assert axis({**curve, "accdec.jerk": 100.0}).ramps["s-curve"].jerk == 100.0
    assert axis({**curve, "accdec.jerk": 1e6}).ramps["s-curve"].jerk == pytest.approx(25.4 / 0.04)


def test_a_deceleration_of_0_is_the_acceleration_and_an_acceleration_of_0_no_ramp(axis: Axis) -> None:
    # Pages 10-8, 10-10.
    linear = axis({"accdec.linear_acceleration": 300.0, "accdec.linear_deceleration": 0.0}).ramps["linear"]
    assert (linear.acceleration, linear.deceleration) == (300.0, 300.0)
    assert change(axis({"accdec.linear_acceleration": 0.0}).ramps["linear"], 0.0, 100.0) == []


def test_a_change_up_to_the_velocity_step_has_no_ramp_and_a_larger_one_has_its_whole_ramp(axis: Axis) -> None:
    # Page 10-7: 50 mm/min are a step, anything above is ramped.
    ramp = axis({"accdec.velocity_step": 50.0}).ramps["linear"]
    slow, fast = 50.0 / 60.0, 51.0 / 60.0
    assert change(ramp, 0.0, slow) == change(ramp, slow, 0.0) == []
    assert change(ramp, 0.0, fast)[0].velocity == 0.0
    assert change(ramp, 0.0, fast)[0].duration == pytest.approx(fast / 500.0)


def test_the_positioning_mode_is_the_ramp_of_a_move(axis: Axis) -> None:
    # Page 10-3.
    exponential: Values = {**TIMES, "accdec.programmed_delay": 10.0, "accdec.positioning_mode": "exponential"}
    assert next(iter(axis(exponential).ramps)) == "exponential"
    assert next(iter(axis().ramps)) == "linear"
    without = axis({"accdec.positioning_mode": "exponential"})
    assert next(iter(without.ramps)) == "linear"
    assert any("linear ramps are used" in note for note in without.assumptions)


def test_a_scan_time_of_0_is_refused(axis: Axis) -> None:
    with pytest.raises(SimulationError, match="is 0 ms; it must be above 0"):
        axis({"timing.fine_foreground": 0.0})
