"""What a person reads on the control's screen is compared exactly with what was to be keyed in."""

import pytest

from amp_studio.sheet import ReadBackError, compare_screen, make_sheet, read_screen_readings
from tests.campaigns import some


@pytest.fixture
def wanted(changed):
    """Return a file with three values that differ."""
    return changed({"1750": "40 mm", "1740": "39 mm", "399": "b"})


def states(text: str, wanted, present) -> dict[str, str]:
    """Return number -> how it compares."""
    found = compare_screen(make_sheet(wanted, present), wanted, read_screen_readings(text))
    return {each.entry.number: each.state for each in found}


def test_the_same_number_in_other_digits_is_the_same(wanted, present) -> None:
    text = "# as on the screen\n1750 40.00000\n1740 = 39,0\n\n399;1\n"
    assert states(text, wanted, present) == {"1750": "same", "1740": "same", "399": "same"}
    assert states("1750: 40\n1740,39.0\n399\t+1", wanted, present) == {
        "1750": "same",
        "1740": "same",
        "399": "same",
    }


@pytest.mark.parametrize(
    "screen_text", some(["40.00001", "39.99999", "400", "-40", "4 0", "4e1", "40 mm", "0x28", "nan", "٤٠"], 2)
)
def test_whatever_else_the_screen_shows_is_another_value(wanted, present, screen_text) -> None:
    assert states(f"1750 {screen_text}", wanted, present)["1750"] == "other"


def test_a_comma_behind_a_blank_is_that_of_a_decimal_fraction(changed, present) -> None:
    file = changed({"1750": "5 mm", "1740": "0.5 mm"})
    assert states("1750 ,5\n1740 ,5", file, present) == {"1750": "other", "1740": "same"}


def test_the_old_value_and_a_missing_one_are_distinguished(wanted, present) -> None:
    old = {e.number: e.old for e in make_sheet(wanted, present).entries}
    assert states(f"1740 {old['1740']}", wanted, present) == {
        "1750": "not read",
        "1740": "old",
        "399": "not read",
    }


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("1750", "line 1: '1750' is not a number and the value that the screen shows"),
        ("1750 40\n1750 40", "line 2: '1750' occurs twice"),
        ("\n1350 40", "line 2: '1350' is not on this sheet"),
        ("nonsense 4", "line 1: Unknown parameter 'nonsense'"),
    ],
)
def test_a_list_that_cannot_be_understood_is_refused_with_its_line(wanted, present, text, fault) -> None:
    with pytest.raises(ReadBackError) as refused:
        states(text, wanted, present)
    assert str(refused.value).startswith(fault)


def test_a_table_with_an_endless_cell_is_refused(wanted, present) -> None:
    with pytest.raises(ReadBackError, match="the table cannot be read"):
        states("step,number,read back\n1,1750," + "9" * 200_000, wanted, present)


def test_the_table_of_the_sheet_itself_comes_back_with_its_column_filled_in(wanted, present) -> None:
    for sign in ",;":
        table = "\ufeff" + sign.join(("step", "number", "read back")) + "\r\n"
        table += "".join(
            f"{n}{sign}{number}{sign}{screen_text}\r\n"
            for n, (number, screen_text) in enumerate((("1750", "40.0"), ("399", "")))
        )
        assert states(table, wanted, present) == {"1750": "same", "1740": "not read", "399": "not read"}
