"""Numbers as people write them, and that whatever is written can be read back."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.schema import InvalidValueError, read_number, write_number


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("0.5", (0.5, "")),
        ("0,5", (0.5, "")),
        (",5", (0.5, "")),
        ("-12,75 mm", (-12.75, "mm")),
        ("1.234", (1.234, "")),
        ("0,125", (0.125, "")),
        ("1,2345", (1.2345, "")),
        ("1234,567", (1234.567, "")),
        ("1,234.5", (1234.5, "")),
        ("1.234,5", (1234.5, "")),
        ("1,234,567", (1234567.0, "")),
        ("1.234.567,8", (1234567.8, "")),
        ("12 345,678", (12345.678, "")),
        ("12 345.6 mm", (12345.6, "mm")),
        ("12'345", (12345.0, "")),
        ("−12\u202f345.6 mm/min", (-12345.6, "mm/min")),
        ("12_345", (12345.0, "")),
        ("1e3", (1000.0, "")),
        ("1,5e-3 in", (0.0015, "in")),
        ("+7", (7.0, "")),
        ("3000 1/min", (3000.0, "1/min")),
        ("10mm/min", (10.0, "mm/min")),
        ('2.5"', (2.5, '"')),
        ("  4  ", (4.0, "")),
    ],
)
def test_a_number_is_read_with_comma_or_point(text: str, expected: tuple[float, str]) -> None:
    assert expected == read_number(text)


@pytest.mark.parametrize("text", ["1,234", "-1,234", "+999,000", "12,345 mm", "123,456e3"])
def test_a_comma_that_could_be_either_is_refused_with_both_ways(text: str) -> None:
    with pytest.raises(InvalidValueError, match=r"can be read two ways: write .* or .*"):
        read_number(text)


def test_the_two_ways_of_an_ambiguous_number_are_those_a_person_can_write() -> None:
    with pytest.raises(InvalidValueError) as refused:
        read_number("1,234e2")
    assert str(refused.value) == "'1,234e2' can be read two ways: write 1234e2 or 1.2340e2"


@pytest.mark.parametrize(
    "text",
    [
        "",
        "mm",
        "-",
        ".",
        ",",
        "1..5",
        "1,,5",
        "--5",
        "1.2.3",
        "12,34,567",
        "1,2.3,4",
        "1_0",
        "1'2",
        "12'34",
        "_5",
        "e5",
        "nan",
        "inf",
        "1,23.4",
        "٣",
    ],
)
def test_what_is_no_number_is_refused(text: str) -> None:
    with pytest.raises(InvalidValueError, match="is not a number"):
        read_number(text)


def test_a_number_that_no_double_holds_is_refused() -> None:
    with pytest.raises(InvalidValueError, match="too large"):
        read_number("1e400")


def test_blanks_between_digits_are_no_number() -> None:
    assert read_number("1 2") == (1.0, "2"), "what follows is told as an unknown unit, not read as 12"


def read_or_refused(text: str) -> tuple[float, str] | str:
    """Return the number and what follows it, or the sentence by which the text is refused."""
    try:
        return read_number(text)
    except InvalidValueError as refused:
        return str(refused)


finite = st.floats(allow_nan=False, allow_infinity=False)


@given(finite)
def test_a_number_is_written_so_that_it_reads_back_exactly(number: float) -> None:
    assert (number, "") == read_number(write_number(number))


@given(st.integers(min_value=1 - 2**53, max_value=2**53 - 1))
def test_a_whole_number_is_written_without_a_point(number: int) -> None:
    assert str(number) == write_number(number)
    assert (float(number), "") == read_number(write_number(number))


@given(finite)
def test_a_comma_in_place_of_the_point_is_the_same_number_or_refused(number: float) -> None:
    text = write_number(number).replace(".", ",")
    found = read_or_refused(text)
    assert found == (number, "") or "can be read two ways" in found


@given(st.text(max_size=12))
def test_reading_any_text_gives_a_finite_number_or_one_sentence(text: str) -> None:
    found = read_or_refused(text)
    if isinstance(found, str):
        assert len(found.replace(text.strip(), "").splitlines()) == 1
    else:
        assert math.isfinite(found[0])


@given(st.text(alphabet="0123456789.,' _eE+-m", max_size=14))
def test_reading_digits_in_disorder_never_breaks(text: str) -> None:
    found = read_or_refused(text)
    assert isinstance(found, str) or math.isfinite(found[0])
