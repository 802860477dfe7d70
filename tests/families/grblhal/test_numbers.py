"""Numbers go to the control as it reads them, and what it shows is compared as it rounds:
as measured on the firmware.
"""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.families.grblhal.numbers import is_shown_as, read_number, shown_number, single, written_number


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (1e-05, "0.00001"),
        (0.0004, "0.0004"),
        (250.0, "250"),
        (301.5, "301.5"),
        (1e9, "1000000000"),
        (-2.25, "-2.25"),
        (201.12345678912, "201.123457"),
        (0.00001234567891234, "0.0000123456789"),
        (0.0, "0"),
    ],
)
def test_a_number_is_written_without_an_exponent_and_with_nine_digits_at_most(
    number: float, text: str
) -> None:
    assert written_number(number) == text


@pytest.mark.parametrize("number", [float("inf"), float("nan"), 5e9, -1e300])
def test_a_number_that_the_control_cannot_show_is_none(number: float) -> None:
    with pytest.raises(ValueError, match="is too large"):
        written_number(number)


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("1e-05", 1.0),
        ("3", 3.0),
        ("0.0004", 0.0004),
        ("1234567891.5", 1234567890.0),
        (".5", 0.5),
        ("+2.5x", 2.5),
    ],
)
def test_a_text_is_read_as_the_firmware_reads_it(text: str, number: float) -> None:
    assert read_number(text) == pytest.approx(number, rel=1e-6)


@pytest.mark.parametrize(
    ("value", "decimals", "text"),
    [
        (0.0004, 3, "0.000"),
        (0.0006, 3, "0.001"),
        (301.5, 3, "301.500"),
        (5.0, 1, "5.0"),
        (5000.0, 0, "5000."),
        (-5.0, 1, "-5.0"),
    ],
)
def test_a_number_is_shown_as_the_firmware_shows_it(value: float, decimals: int, text: str) -> None:
    assert shown_number(single(value), decimals) == text


@pytest.mark.parametrize(
    ("sent", "shown", "same"),
    [
        ("0.0004", "0.000", True),
        ("0.0006", "0.000", False),
        ("250", "250.00000", True),
        ("70000", "4464", False),
        ("301.5", "301.501", False),
        ("7", "7", True),
        ("text", "text", True),
        ("x", "0.000", False),
        ("3", "", False),
        ("250.004", "250.00400", True),
        ("-0.0", "0.000", True),
    ],
)
def test_what_is_shown_is_compared_as_it_is_rounded(sent: str, shown: str, same: bool) -> None:
    assert is_shown_as(sent, shown) is same


@given(st.floats(1e-6, 1e6), st.integers(1, 5))
def test_what_was_written_is_shown_so(number: float, decimals: int) -> None:
    text = written_number(number)
    assert "e" not in text
    assert is_shown_as(text, shown_number(read_number(text), decimals))
    assert read_number(text) == pytest.approx(number, rel=1e-6)
