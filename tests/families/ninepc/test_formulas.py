"""Every worked example and printed table value of the 9/PC manual that a formula must give back.

Chapters 3 to 7, 9, 10, 33 and appendix B, with the page in the id of each case; further chapters have files
of their own beside this one. A number printed with n decimals is compared with the result rounded half up to
n decimals; all other comparisons are exact, or marked. Chapter 3 has no arithmetic. Where a printed number
contradicts its own formula the formula is asserted and the misprint is beside it.
"""

import math
from collections.abc import Callable

import pytest

from amp_studio.families.ninepc import formulas as ninepc
from tests.families.ninepc.printed import as_printed, assert_refused

# -------------------------------------------------------------------------- chapters 4, 5 and 6


@pytest.mark.parametrize(
    ("position", "move", "rollover", "expected"),
    [
        pytest.param(270, 180, 360, 90, id="4-6 from 270 deg, 180 deg clockwise end at 90, not at 450"),
        pytest.param(270, 90, 360, 0, id="4-6 the position becomes zero at the rollover point"),
        pytest.param(270, 180, 0, 450, id="4-6 a rollover value of 0 switches rollover off"),
    ],
)
def test_a_rotary_axis_rolls_over(position: float, move: float, rollover: float, expected: float) -> None:
    assert ninepc.rollover_position(position, move, rollover) == expected


@pytest.mark.parametrize(
    ("marker", "calibration", "expected"),
    [
        pytest.param(3.0, 1.5, 4.5, id="5-2 step 8: marker distance plus Home Calibration"),
        pytest.param(3.0, -4.0, -1.0, id="5-2 step 9: the sum may point in either direction"),
    ],
)
def test_home_lies_at_the_marker_plus_calibration(marker: float, calibration: float, expected: float) -> None:
    assert ninepc.home_distance(marker, calibration) == expected


@pytest.mark.parametrize(
    ("scale", "zero", "expected"),
    [
        pytest.param(0, -5, -5, id="5-18 with -5 the zero marker of the scale is position -5"),
        pytest.param(120.5, -5, 115.5, id="5-6 new position = scale position + position at scale 0"),
        pytest.param(120.5, 0, 120.5, id="B-2 the LS176 example leaves it at 0"),
    ],
)
def test_a_coded_scale_is_shifted_by_its_zero(scale: float, zero: float, expected: float) -> None:
    assert ninepc.dcm_position(scale, zero) == expected


@pytest.mark.parametrize(
    ("position", "limits", "expected"),
    [
        pytest.param([10.5], [(10, 11)], True, id="6-4 group 1: Z between +10 and +11 is forbidden"),
        pytest.param([9.5], [(10, 11)], False, id="6-4 group 1: Z below +10 is free"),
        pytest.param([11.5], [(10, 11)], False, id="6-4 group 1: Z above +11 is free"),
        pytest.param([3, 4], [(2, 5), (2, 5)], True, id="6-4 group 2: X and Y both between +2 and +5"),
        pytest.param([3, 6], [(2, 5), (2, 5)], False, id="6-4 group 2: Y outside frees X"),
        pytest.param([1, 4], [(2, 5), (2, 5)], False, id="6-4 group 2: X outside frees Y"),
    ],
)
def test_a_zone_is_the_block_its_axes_enclose(
    position: list[float], limits: list[tuple[float, float]], expected: bool
) -> None:
    assert ninepc.inside_zone(position, limits) is expected


# ----------------------------------------------------------------------------- chapter 7: SERCOS


def test_the_slowest_drive_sets_the_ring() -> None:
    # Page 7-3: three drives with 4 MHz and one with 2 MHz make a ring of 2 MHz.
    assert ninepc.sercos_ring_baud([4, 4, 4, 2]) == 2
    # Page 7-4: three drives with 1 ms and one with 2 ms make a cycle of 2 ms.
    assert ninepc.sercos_ring_cycle([1, 1, 1, 2]) == 2


@pytest.mark.parametrize(
    ("scan_ms", "expected"),
    [
        pytest.param(6, (1, 2, 3, 6), id="7-4 a system scan of 6 ms allows 1, 2, 3 and 6 ms"),
        pytest.param(8, (1, 2, 4, 8), id="7-4 a system scan of 8 ms allows 1, 2, 4 and 8 ms"),
        pytest.param(6.0, (1, 2, 3, 6), id="7-4 the same with the doubles that a CEL rule hands over"),
        pytest.param(40, (1, 2, 4, 5, 8, 10, 20), id="7-4 40 ms divides itself but the range ends at 30"),
    ],
)
def test_sercos_cycles_divide_the_system_scan(scan_ms: float, expected: tuple[int, ...]) -> None:
    assert ninepc.sercos_cycles(scan_ms) == expected


@pytest.mark.parametrize(
    ("cycle_ms", "baud_mhz", "expected"),
    [
        pytest.param(1, 2, 4, id="7-4 not more than four servos at 1 ms and 2 MHz"),
        pytest.param(2, 2, 8, id="7-4 eight servos at 2 ms"),
        pytest.param(3, 2, 8, id="7-4 eight servos when slower than 2 ms"),
        pytest.param(1, 4, None, id="7-4 more are possible at 1 ms and 4 MHz, no number is given"),
    ],
)
def test_the_ring_contains_so_many_servos(cycle_ms: float, baud_mhz: float, expected: int | None) -> None:
    assert ninepc.sercos_servos(cycle_ms, baud_mhz) == expected


# ------------------------------------------------------------- chapter 7 and appendix B: feedback


def test_an_encoder_gives_four_counts_a_line() -> None:
    # Page 7-33: counts per cycle = 4 x lines per electrical cycle (7-49 the same for velocity).
    assert ninepc.counts_per_cycle(500) == 2000
    # The range on pages 7-33 and 7-49 begins at 4 counts, which is one line.
    assert ninepc.counts_per_cycle(1) == 4


@pytest.mark.parametrize(
    ("markers", "expected"),
    [
        pytest.param(1, 2000, id="7-33 with one marker a cycle is one revolution"),
        pytest.param(2, 4000, id="7-33 with two markers a cycle is half a revolution"),
    ],
)
def test_counts_of_a_revolution(markers: int, expected: float) -> None:
    assert ninepc.counts_per_revolution(2000, markers) == expected


def test_the_ls176_scale_gives_20000_counts() -> None:
    # Page 7-33: 0.02 mm / 5 = 0.004 mm a cycle, / 4 = 0.001 mm a count, 20 mm / 0.001 mm = 20,000.
    # Page B-2, table B.1, prints the same 20,000 for the grating of 20 um and the smaller period of 20 mm.
    assert ninepc.dcm_counts_per_cycle(0.02, 5, 20) == 20_000
    # The steps on the way: one A-quad-B cycle, and one count.
    assert ninepc.dcm_counts_per_cycle(0.02, 5, 0.004) == 4
    assert ninepc.dcm_counts_per_cycle(0.02, 5, 0.001) == 1


def test_the_larger_period_is_one_grating_longer() -> None:
    # Page B-2: 20.02 mm against 20 mm; 20 counts of 0.001 mm distinguish the markers.
    assert ninepc.dcm_counts_per_cycle(0.02, 5, 20.02) == 20_020


@pytest.mark.parametrize(
    ("lines", "length", "pitch", "expected"),
    [
        # Misprint on pages 7-33, 7-38 and 7-40: "5000 lines per .5 inch, enter 5000". A line gives four
        # counts (7-33), and page B-2 asks for counts over the pitch.
        pytest.param(5000, 0.5, 0.5, 20_000, id="7-33 a scale of 5000 lines in 0.5 inch, 5000 is printed"),
        pytest.param(5000, 0.5, 1.0, 40_000, id="B-2 counts over an entered pitch of one inch"),
        pytest.param(5000, 0.5, 0.25, 10_000, id="B-2 a smaller pitch brings the counts into the range"),
    ],
)
def test_a_plain_scale_counts_over_its_pitch(
    lines: int, length: float, pitch: float, expected: float
) -> None:
    assert ninepc.scale_counts_per_cycle(lines, length, pitch) == expected


def test_five_threads_per_inch_are_a_pitch_of_020_inch() -> None:
    # Page 7-17: 1 inch / 5 threads = .20 inch.
    assert ninepc.lead_from_threads_per_inch(5) == 0.20


@pytest.mark.parametrize(
    ("teeth", "expected"),
    [
        pytest.param((44, 40), (11, 10), id="7-38 and 7-40 a ratio of 44:40 comes back as 11:10"),
        pytest.param((1, 1), (1, 1), id="7-33 and B-2 one to one for a linear scale"),
        pytest.param((11, 10), (11, 10), id="7-38 what is reduced stays as it is"),
    ],
)
def test_gear_teeth_are_reduced(teeth: tuple[int, int], expected: tuple[int, int]) -> None:
    assert ninepc.lowest_terms(*teeth) == expected


def test_a_larger_screw_wheel_means_more_counts() -> None:
    # Pages 7-38 and 7-40: the ratio is screw revolutions between feedback revolutions. A device with 20
    # teeth on a screw with 40 teeth turns twice per screw turn, so the screw makes 0.5 turns.
    assert ninepc.screw_revolutions_per_feedback_revolution(20, 40) == 0.5
    # 2000 counts a turn, two turns on a lead of 5 mm: 800 counts per mm.
    assert ninepc.counts_per_length(2000, 20, 40, 5) == 800
    assert ninepc.counts_per_length(2000, 40, 20, 5) == 200


@pytest.mark.parametrize(
    ("counts", "pitch", "expected"),
    [
        pytest.param(2000, 1.0, 2000, id="30-6 depth probe with 2000 counts in 1 inch"),
        pytest.param(3000, 0.5, 6000, id="30-6 depth probe with 3000 counts in 0.5 inch"),
    ],
)
def test_counts_per_length_of_a_depth_probe(counts: float, pitch: float, expected: float) -> None:
    assert ninepc.counts_per_length(counts, 1, 1, pitch) == expected


@pytest.mark.parametrize(
    ("counts", "lead_mm", "expected"),
    [
        pytest.param(1_048_576, 12.7, 2_097_152, id="7-33 HR absolute on 0.5 inch stays below the limit"),
        pytest.param(2_097_152, 12.7, 4_194_304, id="7-33 HR incremental on 0.5 inch meets the limit"),
        pytest.param(2_097_152, 5.08, 10_485_760, id="7-33 HR incremental on 0.20 inch exceeds it"),
    ],
)
def test_counts_per_inch_of_the_high_resolution_devices(
    counts: float, lead_mm: float, expected: float
) -> None:
    # Both factors are printed (7-33); the product is ours, so rounding noise of the division is allowed.
    assert as_printed(ninepc.counts_per_inch(counts, 1, 1, lead_mm)) == expected
    assert (expected > ninepc.COUNTS_PER_INCH_LIMIT) == (lead_mm < 12)


# ------------------------------------------------------------------------------------- chapter 33


@pytest.mark.parametrize(
    ("axes", "expected"),
    [
        pytest.param(4, 11, id="33-20 four axes on drive 1, three on drive 2"),
        pytest.param(6, 13, id="33-20 one axis on drive 1, six on drive 2"),
    ],
)
def test_fine_foreground_minimum(axes: int, expected: int) -> None:
    assert ninepc.fine_foreground_minimum_ms(axes) == expected


def test_the_timing_procedure() -> None:
    # Page 33-22 step 1: 36 ms and 1 fine scan make a logic foreground interval of 36 ms.
    assert ninepc.coarse_scan_ms(36, 1) == 36
    # Step 3: twice the maximum of 4.3 ms is 8.6, entered as 9 ms.
    assert ninepc.fine_foreground_from_maximum_ms(4.3) == 9
    # Steps 4 and 5: 5.8 + 4.3 = 10.1 ms is more than 2.8 + 4.3 = 7.1 ms; 10.1 / 9 = 1.12 makes 2 scans.
    assert ninepc.fine_scans_per_logic_scan(9, 4.3, 5.8, 2.8) == 2
    # Step 6: the warning time is at least 9 ms x 2 = 18 ms.
    assert ninepc.coarse_scan_ms(9, 2) == 18


# ------------------------------------------------------------------------- chapter 15: word formats


@pytest.mark.parametrize(
    ("form", "inch", "expected"),
    [
        ("3.4-4.3", True, 999.9999),  # The table of page 15-1: 3 and 4 digits in inch mode,
        ("3.4-4.3", False, 9999.999),  # 4 and 3 in metric mode.
        ("5.3-6.2", True, 99999.999),
        ("5.3-6.2", False, 999999.99),
        ("6.1-7.0", False, 9999999.0),
        ("3.1", True, 999.9),  # Rotary formats are the same in both.
        ("3.1", False, 999.9),
    ],
)
def test_a_word_format_ends_at_all_nines(form: str, inch: bool, expected: float) -> None:
    assert ninepc.largest_word(form, inch) == expected


# -------------------------------------------------------------------- arguments that make no sense


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda: ninepc.rollover_position(0, 90, -360), "The rollover value must not be negative"),
        (lambda: ninepc.inside_zone([], []), "A zone group needs at least one axis"),
        (lambda: ninepc.inside_zone([1], [(5, 2)]), "The minimum of a zone must not be above its maximum"),
        (lambda: ninepc.sercos_ring_baud([]), "A SERCOS ring needs at least one drive"),
        (lambda: ninepc.sercos_ring_cycle([]), "A SERCOS ring needs at least one drive"),
        (lambda: ninepc.sercos_cycles(8.6), "The system scan time in ms must be a whole number"),
        (lambda: ninepc.counts_per_cycle(0), "The number of lines must be a whole number"),
        (lambda: ninepc.counts_per_cycle(12.5), "The number of lines must be a whole number"),
        (lambda: ninepc.dcm_counts_per_cycle(0, 5, 20), "The signal period must be greater than zero"),
        (lambda: ninepc.dcm_counts_per_cycle(0.02, 5, 0.0015), "not a whole number"),
        (lambda: ninepc.lead_from_threads_per_inch(0), "threads per inch must be greater than zero"),
        (lambda: ninepc.counts_per_length(2000, 0, 1, 5), "The number of gear teeth must be a whole number"),
        (lambda: ninepc.counts_per_length(2000, 1, 1, 0), "Lead Screw Thread Pitch must be greater than"),
        (lambda: ninepc.lowest_terms(44, -40), "The number of teeth must be a whole number"),
        (lambda: ninepc.following_error(1000, 0), "The gain must be greater than zero"),
        (lambda: ninepc.following_error(math.nan, 1), "The feedrate must not be negative"),
        (lambda: ninepc.following_error_with_feed_forward(1, 1, 120), "must be 0 to 100 %"),
        (lambda: ninepc.gain_from_following_error(1, 0), "The following error must be greater than zero"),
        (lambda: ninepc.reversal_first_direction(math.inf), "Reversal Error Compensation must be a finite"),
        (lambda: ninepc.reduced_gain(1, 1.5), "The gain break ratio must be 0 to 1"),
        (lambda: ninepc.minimum_excess_error(1000, 1, 0), "The reduced gain"),
        (lambda: ninepc.analog_voltage(10, 20, 15), "A drive of 15 A cannot give the motor 20 A"),
        (lambda: ninepc.analog_voltage(12, 9, 15), "up to 10 V of either sign"),
        (lambda: ninepc.velocity_gain_bounds(-1), "The gain must be greater than zero"),
        (lambda: ninepc.integral_gain_limit(0), "The gain must be greater than zero"),
        (lambda: ninepc.peak_current_percent(6, 0, 3), "The smaller analog servo voltage must be greater"),
        (lambda: ninepc.torque_percent(6, 0), "The rated current of the motor must be greater than zero"),
        (lambda: ninepc.torque_with_offset(3, 1, 0), "Torque Offset Direction must be 1 or -1"),
        (lambda: ninepc.maximum_servo_acceleration(12, 0), "The effective inertia must be greater than"),
        (lambda: ninepc.friction_compensation(1, 0, -1, 5, 8), "Threshold for Friction Comp must not be"),
        (lambda: ninepc.vector_feedrate_limit([0, 0], [1, 1]), "A move without length has no feedrate"),
        (lambda: ninepc.vector_feedrate_limit([1], [1, 1]), "Every axis of the move needs its distance"),
        (lambda: ninepc.arc_reaches((0, 0), (1, 1), 0), "The radius of an arc must not be zero"),
        (lambda: ninepc.f1_rapid(1000, 101), "F1 Rapid Override Percent must be 0 to 100 %"),
        (lambda: ninepc.response_time_ms(0), "The gain must be greater than zero"),
        (lambda: ninepc.linear_ramp(1000, 0), "The response time must be greater than zero"),
        (lambda: ninepc.exponential_speed(0, 100, -1, 10, 20), "The elapsed time must not be negative"),
        (lambda: ninepc.exponential_time_ms(0, 20), "The delay constant must be greater than zero"),
        (lambda: ninepc.jerk_limits(1000, 0), "The coarse scan time must be greater than zero"),
        (lambda: ninepc.scurve_time(1000, 0), "The jerk must be greater than zero"),
        (lambda: ninepc.fine_foreground_minimum_ms(0), "The number of axes on the largest drive must be"),
        (
            lambda: ninepc.largest_word("3.4 inch", True),
            "A word format is digits before and behind the point",
        ),
    ],
)
def test_nonsense_is_refused_with_one_sentence(call: Callable[[], object], message: str) -> None:
    assert_refused(call, message)
