"""What is on a sheet, in what words, and what is not on it."""

import pytest

from amp_studio.files import new_file
from amp_studio.schema import Value, load_schema
from amp_studio.sheet import SheetError, make_sheet
from tests.campaigns import some


def entry_of(wanted, present, **how):
    """Return the only entry of a sheet."""
    (entry,) = make_sheet(wanted, present, **how).entries
    return entry


def test_nothing_is_on_the_sheet_of_a_control_that_contains_the_file_already(present) -> None:
    sheet = make_sheet(present.copy(), present)
    assert (sheet.entries, sheet.left_out, sheet.same) == ((), (), len(present.values))


@pytest.mark.parametrize(
    ("number", "given", "keyed", "unit"),
    some(
        [
            ("1350", "400 ipm", "169.3333", "mm/s"),  # page 37-3: all values are in millimetres or degrees
            ("1750", "7 in", "177.8", "mm"),
            ("399", "a", "0", ""),
            ("83", "2 mm", "0.07874", "in"),  # the one value that the table prints in inches
            ("70", "100 ms", "100", "ms"),
            ("1350", "1e-4 mm/s", "0.0001", "mm/s"),
        ],
        2,
    ),
)
def test_a_value_is_keyed_in_as_patch_amp_takes_it(lathe, changed, number, given, keyed, unit) -> None:
    other = {"83": "1 mm", "70": "50 ms", "399": "b"}.get(number, "1 mm/s" if number == "1350" else "9 mm")
    entry = entry_of(changed({number: given}, lathe), changed({number: other}, lathe))
    assert (entry.number, entry.new, entry.unit) == (number, keyed, unit)


def test_a_value_of_an_axis_that_turns_is_keyed_in_in_degrees(present, changed) -> None:
    rotary = next(i for i in "12345678" if present.get(("axis.type", i)) == Value("rotary"))
    entry = entry_of(changed({f"{rotary}750": "16"}), present)
    assert (entry.new, entry.unit) == ("16", "°")


def test_a_value_with_more_decimals_than_the_control_has_is_rounded_and_shows_it(present, changed) -> None:
    entry = entry_of(changed({"1735": "0.00123456 mm"}), present)
    assert (entry.new, entry.meaning) == ("0.00123", "0.00123456 mm, rounded")


def test_a_difference_that_the_control_cannot_show_is_none(present, changed) -> None:
    a, b = changed({"1735": "0.001230001 mm"}), changed({"1735": "0.00123 mm"})
    assert make_sheet(a, b).entries == ()


def test_the_same_length_in_another_unit_is_no_difference(present, changed) -> None:
    assert make_sheet(changed({"1750": "7 in"}), changed({"1750": "177.8 mm"})).entries == ()


def test_what_patch_amp_does_not_offer_is_listed_with_the_reason(present, changed) -> None:
    (left,) = make_sheet(changed({"2030": "a"}), present).left_out
    assert (left.number, left.why) == (
        "2030",
        "Patch AMP does not offer it: it has to be downloaded (page 37-2)",
    )


def test_a_choice_without_a_printed_code_cannot_be_keyed_in(present) -> None:
    schema = load_schema("9pc")
    key = next(c.key for c in schema.parameters["servo.amplifier_type"].choices if c.raw is None)
    wanted = present.copy()
    wanted.set(("servo.amplifier_type", "1"), Value(key))
    sheet = make_sheet(wanted, present)
    assert sheet.entries == ()
    assert "no code is printed" in sheet.left_out[0].why


def test_the_value_for_internal_use_is_never_on_a_sheet(present) -> None:
    """Page 37-3 prints 1755 as not to be adjusted."""
    wanted, here = present.copy(), present.copy()
    wanted.set(("patch.internal", "1"), Value(7))
    here.set(("patch.internal", "1"), Value(9))
    sheet = make_sheet(wanted, here)
    assert (sheet.entries, [left.number for left in sheet.left_out]) == ((), ["1755"])


def test_what_the_file_does_not_set_stays_and_what_the_control_hides_is_not_known(present) -> None:
    address = ("servo.excess_error", "1")
    without = present.copy()
    without.set(address, None)
    (left,) = make_sheet(without, present).left_out
    assert left.why == "the file does not set it: the control keeps its own value"
    assert entry_of(present, without).old == ""


def test_a_password_is_on_a_sheet_only_where_it_is_asked_for(present, changed) -> None:
    sheet = make_sheet(changed({"101": "77"}), changed({"101": "66"}))
    assert sheet.entries == ()
    assert "77" not in repr(sheet.left_out)


def test_sides_of_other_families_or_machine_types_make_no_sheet(present, lathe) -> None:
    with pytest.raises(SheetError, match="one side is for Allen-Bradley 9/PC AMP, the other for Syntec"):
        make_sheet(present, new_file("syntec"))
    with pytest.raises(SheetError, match="machine type lathe, and the control contains one for mill"):
        make_sheet(lathe, present)


@pytest.mark.parametrize(
    ("family", "setting", "number", "keyed", "unit"),
    [
        ("num", ("P9N2", "0x1A"), "P9N2", "1A", "hexadecimal"),  # page 13-8 shows such words so
        ("syntec", ("Pr821", "7"), "Pr821", "7", None),
        ("acromill", ("axes.pulses_per_unit@X", "12345.5"), "axes.pulses_per_unit@X", "12345.5", None),
        ("57c422b", ("R4", "3"), "R4", "3", None),
    ],
)
def test_every_family_has_a_sheet_in_its_own_numbers(family, setting, number, keyed, unit) -> None:
    present, wanted = new_file(family), new_file(family)
    address = wanted.find(setting[0])
    wanted.set(address, wanted.read(address, setting[1]))
    entry = next(e for e in make_sheet(wanted, present).entries if e.address == address)
    assert (entry.number, entry.new) == (number, keyed)
    assert unit is None or entry.unit == unit


# -- a control that is configured otherwise --------------------------------------------------------

OTHERWISE = "the control is configured otherwise than the file, so that it would mean something else there"


def test_degrees_are_never_keyed_in_where_the_control_takes_millimetres(present, changed) -> None:
    """The type of an axis cannot be patched: on a linear axis 16 degrees would be 16 mm."""
    wanted = changed({"4750": "16", "1750": "16 mm"})
    control = present.copy()
    control.set(("axis.type", "4"), Value("linear"))
    sheet = make_sheet(wanted, control)
    assert [entry.number for entry in sheet.entries] == ["1750"]
    assert OTHERWISE in {left.why for left in sheet.left_out if left.number == "4750"}


def test_a_number_that_is_another_parameter_in_the_control_is_not_keyed_in(present, changed) -> None:
    """1013 is the gear on the motor of an axis and the teeth on the motor of a spindle (page 7-82)."""
    wanted, control = present.copy(), present.copy()
    wanted.set(("servo.spindle_motor_teeth", "7"), Value(33))
    for name in ("servo.spindle_motor_teeth", "servo.spindle_shaft_teeth"):
        control.set((name, "7"), None)
    control.set(("axis.type", "7"), Value("linear"))
    sheet = make_sheet(wanted, control)
    assert "7013" not in {entry.number for entry in sheet.entries}
    assert OTHERWISE in {left.why for left in sheet.left_out if left.number == "7013"}
