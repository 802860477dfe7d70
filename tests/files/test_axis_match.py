"""Axes are matched by their letters, and one axis is compared with another."""

import pytest

from amp_studio.files import ParameterFile, compare, new_file
from amp_studio.files.axes import AxisError
from amp_studio.files.axis_match import as_axis, axis_letters, matched_by_letter
from amp_studio.schema import Value

NAME = "axis.name"


def with_rapid(file: ParameterFile, **rapids: float) -> ParameterFile:
    """Return a file whose axes have these rapid feedrates, by letter."""
    letters = {letter: axis for axis, letter in axis_letters(file).items()}
    for letter, rapid in rapids.items():
        file.set(("feedrate.rapid", letters[letter]), Value(rapid, "mm/min"))
    return file


def test_an_axis_is_known_by_its_letter() -> None:
    assert axis_letters(new_file("9pc", "mill", ["X", "Z", "C"])) == {"1": "X", "2": "Z", "3": "C"}
    assert axis_letters(new_file("57c422b")) == {"X": "X", "Y": "Y"}


def test_an_axis_with_another_number_is_compared_with_the_one_of_its_letter() -> None:
    mill = with_rapid(new_file("9pc", "mill", ["X", "Y", "Z"]), X=1000, Y=2000, Z=3000)
    other = with_rapid(new_file("9pc", "mill", ["X", "Z", "Y"]), X=1000, Y=2000, Z=3500)
    matched = matched_by_letter(other, mill)
    assert matched.moved == (("Z", "2", "3"), ("Y", "3", "2"))
    differences = compare(mill.schema, mill.values, matched.file.values).differences
    assert [d.address for d in differences] == [("feedrate.rapid", "3")]


def test_axes_of_a_num_are_matched_by_the_letters_that_its_file_gives_them() -> None:
    mill, other = (new_file("num", axes=axes) for axes in (["X", "Y", "Z"], ["X", "Z", "Y"]))
    speed = ("servo.loop_gain", "1")
    other.set(speed, other.read(speed, "77"))
    matched = matched_by_letter(other, mill)
    assert matched.moved == (("Z", "1", "2"), ("Y", "2", "1"))
    assert matched.file.get(("servo.loop_gain", "2")) == other.get(speed)
    assert axis_letters(matched.file) == axis_letters(mill)


def test_a_mark_of_a_value_out_of_range_and_a_note_go_with_their_axis() -> None:
    mill, other = (new_file("9pc", "mill", axes) for axes in (["X", "Y"], ["Y", "X"]))
    other.set_checked({("feedrate.rapid", "1"): Value(1e9, "mm/min")}, force="on site")
    other.header.value_notes = {"feedrate.rapid@1": "measured", "control.type": "old"}
    found = matched_by_letter(other, mill).file
    assert found.forced == {("feedrate.rapid", "2"): "on site"}
    assert found.header.value_notes == {"feedrate.rapid@2": "measured", "control.type": "old"}


def test_an_axis_that_the_other_machine_does_not_have_gets_a_free_number() -> None:
    mill = new_file("9pc", "mill", ["X", "Z"])
    other = with_rapid(new_file("9pc", "mill", ["X", "Y", "Z"]), Y=2000)
    matched = matched_by_letter(other, mill)
    assert (matched.moved, matched.left_out) == ((("Y", "2", "3"), ("Z", "3", "2")), ())
    assert matched.file.get(("feedrate.rapid", "3")) == Value(2000, "mm/min")
    assert len(matched.file.values) == len(other.values), "no value is lost"


def test_an_axis_for_which_there_is_no_number_is_named() -> None:
    full = new_file("9pc", "mill", ["X", "Y", "Z", "A", "B", "C", "U", "V"])
    other = new_file("9pc", "mill", ["X", "W"])
    matched = matched_by_letter(other, full)
    assert matched.left_out == ("W",)


def test_axes_that_share_a_letter_stay_where_they_are() -> None:
    mill = new_file("9pc", "mill", ["X", "Y"])
    twice = new_file("9pc", "mill", ["Y", "X"])
    twice.set((NAME, "2"), Value("Y"))
    assert matched_by_letter(twice, mill).file is twice


def test_a_machine_of_another_family_stays_as_it_is() -> None:
    module, mill = new_file("57c422b"), new_file("num")
    for file, like in ((module, mill), (mill, module)):
        matched = matched_by_letter(file, like)
        assert (matched.file, matched.moved, matched.left_out) == (file, (), ())


def test_one_axis_is_compared_with_another_by_its_values_and_keeps_its_name() -> None:
    mill = with_rapid(new_file("9pc", "mill", ["X", "Y"]), X=1000, Y=2000)
    twin = as_axis(mill, "2", "1")
    found = compare(mill.schema, mill.values, twin.values).differences
    assert [(d.address, d.a, d.b) for d in found] == [
        (("feedrate.rapid", "1"), Value(1000, "mm/min"), Value(2000, "mm/min"))
    ]


@pytest.mark.parametrize(
    ("family", "source", "target", "parameter"),
    [("acromill", "Y", "X", "axes.pulses_per_unit"), ("57c422b", "Y", "X", "gain.proportional")],
)
def test_axes_of_a_family_whose_axes_are_letters_are_compared_too(
    family: str, source: str, target: str, parameter: str
) -> None:
    file = new_file(family)
    file.set((parameter, source), file.read((parameter, source), "77"))
    assert as_axis(file, source, target).get((parameter, target)) == file.get((parameter, source))


@pytest.mark.parametrize(
    ("source", "target", "message"),
    [("9", "1", "there is no axis 9"), ("1", "1", "axis 1 cannot be compared with itself")],
)
def test_an_axis_that_cannot_be_compared_is_refused(source: str, target: str, message: str) -> None:
    with pytest.raises(AxisError, match=message):
        as_axis(new_file("9pc", "mill", ["X"]), source, target)
