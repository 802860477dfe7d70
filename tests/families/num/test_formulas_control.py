"""Times, memory and characters: every worked example of chapters 9 and 10 of the NUM manual, with its page.

Numbers that the manual does not print, and that are worked by hand from its words, are marked "by hand".
"""

import pytest

from amp_studio.families.num import formulas as num


@pytest.mark.parametrize(
    ("period", "uc_sii", "taken"),
    [
        pytest.param(5000, False, 5000, id="9-10 1060 SI and SII"),
        pytest.param(6000, False, 6000, id="9-10 1020, 1040 and 1050"),
        pytest.param(1999, False, 2000, id="9-10 the lower limit is forced"),
        pytest.param(20001, False, 20000, id="9-10 the upper limit is forced"),
        pytest.param(6000, True, 6000, id="9-10 UC SII, 6 ms"),
        pytest.param(5000, True, 4000, id="9-10 UC SII, rounded down to a multiple of 2 ms"),
        pytest.param(100, True, 2000, id="9-10 UC SII, the lower limit"),
    ],
)
def test_the_sampling_period_that_the_control_takes(period: float, uc_sii: bool, taken: float) -> None:
    assert num.sampling_period_in_force(period, uc_sii) == taken


def test_a_cnc_sample_has_a_whole_number_of_qvn_samples() -> None:
    # Page 9-10, by hand.
    assert num.qvn_samples(5000, 500) == 10
    assert num.qvn_samples(5000, 750) != round(num.qvn_samples(5000, 750))


@pytest.mark.parametrize(
    ("axes", "groups", "bounds"),
    [(2, 1, (6, 12)), (8, 3, (6, 12)), (9, 1, (20, 20)), (32, 8, (20, 20)), (2, 4, (20, 20))],
)
def test_the_least_block_time_goes_by_axes_and_groups(
    axes: int, groups: int, bounds: tuple[float, float]
) -> None:
    # Page 9-12.
    assert num.block_time_bounds(axes, groups) == bounds


def test_200_points_of_interaxis_calibration_have_these_parameters() -> None:
    # Page 9-14.
    assert num.calibration_parameters(200) == ("E81000", "E81199", "E82000", "E82199")
    assert num.calibration_parameters(1000)[1] == "E81999"
    assert num.calibration_parameters(1001) == num.calibration_parameters(1000)


def test_a_stack_of_20480_words_has_40_kbytes() -> None:
    # Page 9-14; the least of 10 kbytes by hand.
    assert num.stack_kbytes(20480) == 40
    assert num.stack_kbytes(5120) == 10


@pytest.mark.parametrize(
    ("low", "high", "spindle", "taken"),
    [
        pytest.param(0, 120, False, (0, 120), id="9-18 as given"),
        pytest.param(0, 255, True, (0, 255), id="9-18 the widest"),
        pytest.param(100, 120, True, (100, 120), id="9-18 100 % is within"),
        pytest.param(101, 120, False, (0, 120), id="9-18 100 % is not within, feed rate"),
        pytest.param(50, 99, True, (50, 100), id="9-18 100 % is not within, spindle"),
        pytest.param(100, 100, True, (50, 100), id="9-18 max is not above min"),
        pytest.param(-1, 120, False, (0, 120), id="9-18 negative"),
        pytest.param(0, 256, True, (50, 100), id="9-18 above 255 %"),
    ],
)
def test_a_potentiometer_has_the_range_given_or_that_of_the_control(
    low: float, high: float, spindle: bool, taken: tuple[float, float]
) -> None:
    assert num.potentiometer_range_in_force(low, high, spindle) == taken


def test_what_the_protected_areas_leave_is_the_free_access_area() -> None:
    # Page 9-22, by hand.
    assert num.free_access_kbytes(256, 32, 48, 16) == 160
    assert num.free_access_kbytes(96, 32, 48, 16) == 0
    with pytest.raises(ValueError, match="The areas are 1 kbytes larger than the memory"):
        num.free_access_kbytes(95, 32, 48, 16)


@pytest.mark.parametrize(("time", "taken"), [(3, 4), (4, 4), (10, 10), (14, 14), (16, 14)])
def test_the_plc_has_4_to_14_ms(time: float, taken: float) -> None:
    # Page 9-28.
    assert num.plc_time_in_force(time) == taken


def test_a_sequence_is_written_with_its_last_character_to_the_right() -> None:
    # Page 10-4 prints 001B9143 for ESC[C: 91 is the decimal code of the bracket (erratum e-p38-bracket).
    assert num.sequence_word("\x1b[C") == 0x001B5B43
    assert num.sequence_word("\x1b\x91C") == 0x001B9143
    assert num.sequence_word("\x08") == 8
    for characters in ("", "ABCDE"):
        with pytest.raises(ValueError, match="one to four characters"):
            num.sequence_word(characters)
    with pytest.raises(ValueError, match="one byte"):
        num.sequence_word("€")
