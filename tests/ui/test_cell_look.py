"""What a cell shows where there is little room: digits in groups,
and choices that cannot be taken for one another.
"""

import pytest

from amp_studio.drawing import grouped
from amp_studio.schema import Limits, Value, family_ids, load_schema
from amp_studio.ui.base.figures import range_in_words, with_groups
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.table.cell_look import CellLook, _show_word, short_labels


@pytest.mark.parametrize(
    ("figure", "displayed"),
    [
        ("1234", "1234"),
        ("12345", "12\u202f345"),
        ("−2097152", "−2\u202f097\u202f152"),
        ("123456.789012", "123\u202f456.789012"),
        ("0.0000254", "0.0000254"),
        ("1e-07", "1e-07"),
        ("0x0000F", "0x0000F"),
    ],
)
def test_digits_are_in_groups_from_five_on(figure: str, displayed: str) -> None:
    assert grouped(figure) == displayed


@pytest.mark.parametrize(
    ("allowed", "displayed"),
    [
        (Limits(-999999.99, 999999.99, "mm"), "−999\u202f999.99 to 999\u202f999.99 mm"),
        (Limits(-9.999, 9.999, "deg"), "−9.999 to 9.999°"),
        (Limits(None, 10000.0, "mm/min"), "at most 10\u202f000 mm/min"),
        (Limits(1e-07, None, ""), "at least 1\u202f×\u202f10⁻⁷"),
        (Limits(None, None, "mm"), "no printed range"),
    ],
)
def test_a_range_is_written_as_the_values_in_it(allowed: Limits, displayed: str) -> None:
    assert range_in_words(allowed) == displayed


@pytest.mark.parametrize(
    ("label", "displayed"),
    [
        ("X -500 mm to 8 mm, Y -400 mm to 6 mm", "X −500 mm to 8 mm, Y −400 mm to 6 mm"),
        ("24000 mm/min", "24\u202f000 mm/min"),
        ("694.4 mm/s²; 0.24 s", "694.4 mm/s²; 0.24 s"),
        ("-20000 iu (-20 mm)", "−20\u202f000 iu (−20 mm)"),
        ("P30000 and P12345.5N1", "P30000 and P12345.5N1"),
    ],
)
def test_the_value_in_a_picture_is_written_as_its_scale(label: str, displayed: str) -> None:
    assert with_groups(label) == displayed


def test_a_minus_is_as_wide_as_a_digit_where_it_is_shown_and_plain_where_it_is_typed(
    window: MainWindow,
) -> None:
    address = ("zone.overtravel_negative", "1")
    assert window.table.cell_text(address) == "−500 mm"
    assert window.table.typed_value(address) == "-500 mm"
    window.edits.commit(address, "−400 mm")
    assert window.workspace.file.get(address) == Value(-400.0, "mm")


def test_the_short_text_of_a_field_keeps_what_differs_and_drops_what_all_fields_begin_with() -> None:
    look = CellLook("value")
    _show_word(look, load_schema("num").parameters["axes.assignment"], 0x21)
    assert (look.text, look.short) == ("Axis name: Y, Axis group: Group 3", "name: Y, group: Group 3")


def test_a_short_choice_is_a_code_that_no_other_has() -> None:
    ports = ("No Feedback", "Feedback Connector J1", "Feedback Connector J2")
    assert short_labels(ports) == dict(zip(ports, ("No Feedback", "J1", "J2"), strict=True))
    outputs = (
        "No Output",
        "Output Axis Mod 1 or Aout1",
        "Output axis Mod 2 or Aout2",
        "Analog Out TB2 or Aout5",
    )
    assert short_labels(outputs)["Output axis Mod 2 or Aout2"] == "… 2 or Aout2"
    signs = ("Primary axis positive", "Primary axis negative", "None")
    assert short_labels(signs)["None"] == "None"
    assert short_labels(signs)["Primary axis positive"] == "Primary axis positive", "words are no codes"


def test_what_is_left_of_a_choice_is_what_differs() -> None:
    switches = ("Negative direction off switch", "Positive direction off switch")
    assert list(short_labels(switches).values()) == ["Neg", "Pos"]
    devices = (
        "INC Encoder (Z < A)",
        "INC Encoder (Z > A)",
        "1326HR HIPERFACE Absolute (1326 only)",
        "1326HR HIPERFACE Incremental (1326 only)",
    )
    assert list(short_labels(devices).values()) == [
        "INC Encoder (Z < A)",
        "INC Encoder (Z > A)",
        "HIPERFACE Abs",
        "HIPERFACE Inc",
    ]


@pytest.mark.parametrize("family", family_ids())
def test_no_two_choices_of_a_parameter_look_the_same(family: str) -> None:
    for parameter in load_schema(family).parameters.values():
        labels = tuple(choice.label for choice in parameter.choices or ())
        if len({label.casefold() for label in labels}) == len(labels):
            short = short_labels(labels)
            assert len({text.casefold() for text in short.values()}) == len(labels), parameter.id
            assert all(short.values()), parameter.id
