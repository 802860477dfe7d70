"""The formulas of chapters 4 and 5 of the NUM parameter manual, against every example it prints."""

import inspect
import re

import pytest

from amp_studio.families.num.formulas import (
    assignment_word,
    axis_name,
    carried_partner,
    coded_conversion,
    coded_graduation,
    combined_ratio,
    encoder_measurement,
    from_internal,
    indexing_increment,
    internal_unit_mm,
    largest_travel_mm,
    limited_in_force,
    measured_step,
    multi_divi,
    rotary_unit_deg,
    servo_coefficient,
    signal_fault,
    ssi_divi_factor,
    to_internal,
    unwatched_axis,
)
from amp_studio.validate import formulas


@pytest.mark.parametrize("name", formulas("num"))
def test_the_first_paragraph_of_a_formula_which_is_shown_cites_its_page(name: str) -> None:
    displayed = " ".join((inspect.getdoc(formulas("num")[name]) or "").partition("\n\n")[0].split())
    assert re.search(r"\b[0-9]+-[0-9]+\b", displayed)


# -- the internal unit, page 4-18 -------------------------------------------------------------------


@pytest.mark.parametrize(
    ("digits", "unit", "travel_m"),
    [(1, 0.1, 10000), (2, 0.01, 1000), (3, 0.001, 100), (4, 0.0001, 10), (5, 0.00001, 1)],
)
def test_the_internal_unit_and_the_longest_travel_are_those_of_page_4_18(
    digits: int, unit: float, travel_m: int
) -> None:
    assert unit == internal_unit_mm(digits)
    assert travel_m * 1000 == largest_travel_mm(digits)
    assert to_internal(largest_travel_mm(digits), unit) == 1e8, "the 99,999,999 of a signed word, page 1-3"


@pytest.mark.parametrize("digits", [0, 6, 255])
def test_any_other_number_of_digits_is_taken_for_micrometres(digits: int) -> None:
    assert (internal_unit_mm(digits), largest_travel_mm(digits)) == (0.001, 100_000.0)


def test_the_unit_of_rotary_axes_is_that_of_page_4_18() -> None:
    assert [rotary_unit_deg(n) for n in range(5)] == [0.0001, 0.1, 0.01, 0.001, 0.0001]
    with pytest.raises(ValueError, match="P4N4 is 0 to 4, not 5"):
        rotary_unit_deg(5)


def test_the_coefficient_k_is_that_of_pages_6_15_and_6_23() -> None:
    units = [*(internal_unit_mm(n) for n in range(1, 6)), rotary_unit_deg(0)]
    assert [servo_coefficient(unit) for unit in units] == [100, 10, 1, 0.1, 0.01, 0.1]


def test_a_dimension_becomes_a_number_of_internal_units_and_back() -> None:
    assert to_internal(5.0, internal_unit_mm(4)) == 50_000, "5 mm in units of 0.1 um, page 5-6"
    assert from_internal(6600, internal_unit_mm(3)) == 6.6, "the maximum following error of page 6-23"
    assert to_internal(-0.3, 0.1) == -3.0
    for unit in (0.0, -1.0, float("nan")):
        for formula in (to_internal, from_internal):
            with pytest.raises(ValueError, match="internal unit"):
                formula(1.0, unit)
        with pytest.raises(ValueError, match="internal unit"):
            servo_coefficient(unit)


# -- axes, pages 4-24 to 4-36 -----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "group", "word"),
    [
        ("X", 1, 0x00),
        ("Z", 1, 0x02),
        ("X", 2, 0x10),
        ("W", 2, 0x15),
        ("U", 3, 0x23),
        ("W", 3, 0x25),
        ("C", 3, 0x28),
    ],
)
def test_the_words_of_p9_are_those_of_page_4_24(name: str, group: int, word: int) -> None:
    assert word == assignment_word(name, group)
    assert f"{name} of group {group}" == axis_name(word)


def test_ff_is_no_axis_and_a_code_without_a_name_is_reported() -> None:
    assert (axis_name(255.0), axis_name(0x1F), axis_name(9.0)) == ("no axis", "? of group 2", "? of group 1")
    for word in (-1.0, 256.0, 1.5, float("nan")):
        with pytest.raises(ValueError, match="8 bits"):
            axis_name(word)
    with pytest.raises(ValueError, match="not 'S'"):
        assignment_word("S", 1)
    for group in (0, 9):
        with pytest.raises(ValueError, match="1 to 8"):
            assignment_word("X", group)


def test_an_axis_in_both_words_of_p1_is_a_modulo_one() -> None:
    """Page 4-12: the rest of the limited axes stay as they are."""
    assert limited_in_force(0x20, 0x120) == 0x100
    assert limited_in_force(0x20, 0x100) == 0x100
    assert limited_in_force(0x80000001, 0x80000003) == 2


def test_x_goes_with_u_y_with_v_and_z_with_w_of_one_group() -> None:
    assert [carried_partner(word) for word in range(9)] == [3, 4, 5, 0, 1, 2, -1, -1, -1]
    assert carried_partner(0x22) == 0x25
    assert carried_partner(255) == -1


@pytest.mark.parametrize(("degrees", "value"), [(0.5, 5000), (2.5, 25000), (1.0, 10000), (0.0, 0)])
def test_the_steps_of_page_4_36(degrees: float, value: int) -> None:
    assert value == indexing_increment(degrees)


def test_a_step_is_not_negative() -> None:
    with pytest.raises(ValueError, match="negative"):
        indexing_increment(-0.5)


# -- measurement, pages 5-6 to 5-23 -----------------------------------------------------------------


def test_the_rotary_encoder_of_page_5_6() -> None:
    """ROD456 with 2500 lines, EXE610B by 10, 5 mm a turn in units of 0.1 um."""
    assert encoder_measurement(2500, 10) == 100_000
    assert multi_divi(to_internal(5.0, internal_unit_mm(4)), encoder_measurement(2500, 10)) == (1, 2)


def test_the_scale_of_page_5_6() -> None:
    """LS107 of 20 um, EXE630 by 5, in micrometres."""
    assert encoder_measurement(1, 5) == 20
    assert multi_divi(20, encoder_measurement(1, 5)) == (1, 1)


def test_a_fraction_that_no_words_hold_is_refused() -> None:
    assert multi_divi(32767, 32766) == (32767, 32766)
    for movement, measurement in ((32768, 32767), (32767, 32768)):
        with pytest.raises(ValueError, match="below 32768"):
            multi_divi(movement, measurement)
    for movement, measurement in ((0, 1), (1, 0), (0.5, 1), (1, float("inf"))):
        with pytest.raises(ValueError, match="whole number"):
            multi_divi(movement, measurement)


@pytest.mark.parametrize(
    ("bits", "factor"), [(32, 1), (24, 1), (16, 1), (15, 2), (14, 4), (13, 8), (12, 16), (1, 32768)]
)
def test_the_factor_of_divi_is_that_of_page_5_8(bits: int, factor: int) -> None:
    assert factor == ssi_divi_factor(bits)


def test_a_frame_has_at_least_one_bit() -> None:
    with pytest.raises(ValueError, match="number of bits"):
        ssi_divi_factor(0)


@pytest.mark.parametrize(
    ("multi", "divi", "sensor", "step"),
    [
        (1, 2, 0, 0.5),
        (1, 16, 0x02000060, 1),  # page 5-8: 12 bits
        (1, 16, 0x04000060, 1 / 16),  # combined: the increments are counted
        (1, 16, 0x00000060, 1 / 16),
        (1, 16, 0x02000080, 1 / 16),  # 16 bits
        (1, 16, 0x02000007, 1 / 16),  # a frame without bits has a separate rule
        (1, 16, 0x0A0001E0 - 0x80, 1),  # bits beside the fields do not count
    ],
)
def test_the_step_of_a_short_frame_is_that_before_its_shift(
    multi: int, divi: int, sensor: int, step: float
) -> None:
    assert step == measured_step(multi, divi, sensor)


def test_a_step_needs_a_denominator_that_contains_the_shift() -> None:
    with pytest.raises(ValueError, match="greater than zero"):
        measured_step(1, 0, 0)
    assert measured_step(1, 48, 0x02000060) == 1 / 3
    with pytest.raises(ValueError, match="multiple of 16 with this frame, not 24"):
        measured_step(1, 24, 0x02000060)


def test_the_coded_scale_of_page_5_22() -> None:
    """Heidenhain LS 776C with an EXE 612: multiplier 10, 20 um, 1000 graduations between two marks."""
    assert coded_conversion(20, 10) == (1, 2)
    assert coded_graduation(20, 1, 2) == 40
    for multi, divi in ((0, 2), (1, 0)):
        with pytest.raises(ValueError, match="greater than zero"):
            coded_graduation(20, multi, divi)


def test_the_combined_sensor_of_page_5_23() -> None:
    """Heidenhain ROC 413: 13 bits, 1024 periods, IBV by 10, 10 mm a turn in micrometres."""
    multi, divi = multi_divi(10 * 1000, encoder_measurement(1024, 10))
    assert multi / divi == 250 / 1024 == 1000 / (1024 * 4)
    above, below = combined_ratio(13, 1024, 10)
    assert (above, below) == (1, 5)
    assert above / below == 8192 / (1024 * 4 * 10) == 8 / 40


def test_the_errors_of_bad_signals_are_210_to_241() -> None:
    assert (signal_fault(0), signal_fault(31)) == (210, 241), "pages 5-18 and 5-25"
    for address in (-1, 32):
        with pytest.raises(ValueError, match="address"):
            signal_fault(address)


def test_the_first_axis_whose_encoder_is_not_watched_serves_no_spindle_and_no_handwheel() -> None:
    assert unwatched_axis(0x7F, 0x7F, 0, 0) == -1.0
    assert (unwatched_axis(0x7F, 0x73, 0, 0), unwatched_axis(1, 0, 15, 15)) == (2.0, 0.0)
    assert unwatched_axis(0xFF000000, 0, 15, 15) == -1.0
    assert (unwatched_axis(0xFF000000, 0, 7, 15), unwatched_axis(0xFF000000, 0, 15, 7)) == (27.0, 31.0)
    assert unwatched_axis(0x00800000, 0, 255, 255) == 23.0
