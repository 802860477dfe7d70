"""Feedrates, acceleration and deceleration: the printed examples of chapters 9 and 10;
how they are compared is in test_formulas.py.
"""

import math

import pytest

from amp_studio.families.ninepc import formulas as ninepc
from tests.families.ninepc.printed import as_printed

# -------------------------------------------------------------------------------------- chapter 9


@pytest.mark.parametrize(
    ("percent", "expected"),
    [
        pytest.param(0, 0, id="9-5 0 % stops positioning as in feedhold"),
        pytest.param(25, 2540, id="9-5 rapid feedrate times the percentage"),
        pytest.param(100, 10160, id="9-5 100 % leaves rapid as it is"),
    ],
)
def test_rapid_at_f1(percent: float, expected: float) -> None:
    assert ninepc.f1_rapid(10160, percent) == expected


@pytest.mark.parametrize(
    ("distances", "limits", "expected"),
    [
        pytest.param([10, 0], [1000, 500], 1000, id="9-2 one axis: its own limit"),
        pytest.param([30, 40], [600, 1000], 1000, id="9-2 3-4-5 move: 1000 keeps X at its 600"),
        pytest.param([30, 40], [600, 400], 500, id="9-2 3-4-5 move: the slower Y decides"),
        pytest.param([-30, 40], [600, 1000], 1000, id="9-1 the direction of an axis does not matter"),
    ],
)
def test_no_axis_exceeds_its_limit_on_a_path(
    distances: list[float], limits: list[float], expected: float
) -> None:
    assert ninepc.vector_feedrate_limit(distances, limits) == expected


def test_circular_error() -> None:
    # Page 9-9: start to center against end to center.
    assert ninepc.arc_radius_error((10, 0), (0, 10), (0, 0)) == 0
    assert ninepc.arc_radius_error((10, 0), (0, 12), (0, 0)) == 2
    # Page 9-9: with R the only fault is an end point more than twice the radius away.
    assert ninepc.arc_reaches((0, 0), (20, 0), 10)
    assert not ninepc.arc_reaches((0, 0), (20.1, 0), 10)


# ------------------------------------------------------------------------------------- chapter 10


@pytest.mark.parametrize(
    ("gain", "expected"),
    [
        pytest.param(0.5, 240, id="10-2 gain 1/2"),
        pytest.param(1, 120, id="10-2 gain 1"),
        pytest.param(2, 60, id="10-2 gain 2"),
        # Erratum e-1210-response: the table prints 30 and 15 ms, against its own equation 120 / gain.
        pytest.param(3, 40, id="10-2 gain 3, 30 is printed"),
        pytest.param(4, 30, id="10-2 gain 4, 15 is printed"),
    ],
)
def test_response_time(gain: float, expected: float) -> None:
    assert ninepc.response_time_ms(gain) == expected


def test_linear_ramp() -> None:
    # Page 10-2: contouring speed over response time, in in/min per ms; 240 in/min at gain 1 are 2 of them.
    assert ninepc.linear_ramp_per_ms(240, ninepc.response_time_ms(1)) == 2
    # 2 in/min per ms are 2000 in/min per s, and 33.333 in/s2.
    assert as_printed(ninepc.linear_ramp(240, 120), 3) == 33.333
    # The help of 1210: 10,000 mm/min at gain 1 give 1389 mm/s2.
    assert as_printed(ninepc.linear_ramp(10_000, 120)) == 1389


@pytest.mark.parametrize(
    ("feedrate", "after", "expected"),
    [
        pytest.param(100, 150, True, id="10-7 a change equal to 50 mm/min is a step"),
        pytest.param(150, 110, True, id="10-7 a smaller change is a step"),
        pytest.param(100, 150.1, False, id="10-7 a larger change is ramped"),
    ],
)
def test_velocity_step(feedrate: float, after: float, expected: bool) -> None:
    assert ninepc.is_velocity_step(feedrate, after, 50) is expected


@pytest.mark.parametrize(
    ("start", "commanded", "elapsed_s", "delay", "expected"),
    [
        pytest.param(0, 100, 0.2, 10, 63, id="10-14 figure 10.8 after one time constant, 63 ipm"),
        pytest.param(0, 100, 0.4, 10, 86, id="10-14 figure 10.8 after 0.4 s, 86 ipm"),
        pytest.param(200, 100, 0.16, 8, 137, id="10-14 figure 10.9 after one time constant, 137 ipm"),
        pytest.param(200, 100, 0.32, 8, 114, id="10-14 figure 10.9 after 0.32 s, 114 ipm"),
        pytest.param(0, 100, 0.0, 10, 0, id="10-14 the change begins at the initial speed"),
    ],
)
def test_exponential_speed(
    start: float, commanded: float, elapsed_s: float, delay: float, expected: float
) -> None:
    # All four examples have a system scan of 20 ms; speeds are printed without decimals.
    assert as_printed(ninepc.exponential_speed(start, commanded, elapsed_s, delay, 20)) == expected


@pytest.mark.parametrize("elapsed_s", [0.0, 0.05, 0.16, 0.32, 1.0])
def test_both_printed_exponential_equations_are_one(elapsed_s: float) -> None:
    # Page 10-14 prints one equation for speeding up and one for slowing down.
    x = (1000 / 20) * elapsed_s / 8
    slowing = 200 - (200 - 100) * (1 - math.exp(-x))
    assert ninepc.exponential_speed(200, 100, elapsed_s, 8, 20) == pytest.approx(slowing, rel=1e-12)


def test_exponential_time_is_five_time_constants() -> None:
    # Page 10-14: the constant x 20 ms x 5, so 10 takes 1 s; page 10-17: x the system scan time x 5.
    assert ninepc.exponential_time_ms(10, 20) == 1000
    assert ninepc.exponential_time_ms(10, 14) == 700
    # Page 10-14: after five time constants the change is complete for all practical purposes (99 %).
    assert as_printed(ninepc.exponential_speed(0, 100, 1.0, 10, 20)) == 99


JERK_TABLE = [
    (1000, 20, 0.04, 25_000),
    (1000, 20, 1.20, 833),
    (1000, 20, 0.16, 6_250),
    (2500, 14, 0.028, 89_286),
    (2500, 14, 0.84, 2_976),
    (2500, 14, 0.112, 22_321),
]


@pytest.mark.parametrize(
    ("ramp", "scan_ms", "time_s", "jerk"),
    [
        # The table is printed twice, on pages 10-19 ff. and 10-22, with the same numbers.
        pytest.param(*row, id=f"10-19 and 10-22 {row[0]} ipm/s in {row[2]} s at {row[1]} ms")
        for row in JERK_TABLE
    ],
)
def test_jerk_table(ramp: float, scan_ms: float, time_s: float, jerk: float) -> None:
    # J = R / T, printed without decimals.
    assert as_printed(ramp / time_s) == jerk
    # And back: T = R / J, printed with up to three decimals.
    assert as_printed(ninepc.scurve_time(ramp, jerk), 3) == time_s
    # The rows marked max. and min. are the limits of that scan time; the example lies between.
    low, high = ninepc.jerk_limits(ramp, scan_ms)
    assert as_printed(low) <= jerk <= as_printed(high)


@pytest.mark.parametrize(
    ("ramp", "scan_ms", "low", "high"),
    [
        pytest.param(1000, 20, 833, 25_000, id="10-19 at 20 ms: 60 scans are 1.20 s, 2 scans 0.04 s"),
        pytest.param(2500, 14, 2_976, 89_286, id="10-19 at 14 ms: 60 scans are 0.84 s, 2 scans 0.028 s"),
        # Erratum e-1214-default: ramps of 25.4 mm/s2 need 21.17 to 635, and 5.08 is printed (37-4).
        pytest.param(25.4, 20, 21, 635, id="37-4 the default ramp"),
    ],
)
def test_jerk_limits(ramp: float, scan_ms: float, low: float, high: float) -> None:
    # Erratum e-1214-footnote: page 10-22 has the counts of scans exchanged; 60 is the longer time.
    assert tuple(as_printed(limit) for limit in ninepc.jerk_limits(ramp, scan_ms)) == (low, high)


def test_the_default_jerk_is_too_small_for_the_default_ramp() -> None:
    # Page 37-4 gives 25.4 mm/s2 and 5.08 mm/s3: 5.0 s, while 1.20 s is the longest S-curve (10-19).
    assert ninepc.scurve_time(25.4, 5.08) == 5.0
    assert ninepc.jerk_limits(25.4, 20)[0] > 5.08
