"""Axes where they have no types: words of bits, a number of axes, letters compiled in,
axes that are always there.
"""

from itertools import combinations
from pathlib import Path

import pytest

from amp_studio.files import (
    ParameterFile,
    add_axis,
    alike_axes,
    axis_head,
    axis_kind,
    axis_letter,
    axis_title,
    compare_axes,
    copy_axis,
    delete_axis,
    fitted_axes,
    letters_offered,
    new_file,
    open_file,
    places_offered,
    rename_axis,
    shown_axes,
    swap_axes,
    why_axes_are_fixed,
)
from amp_studio.files.axes import AxisError
from amp_studio.files.axis_values import words_of_axes
from amp_studio.files.example_files import examples
from amp_studio.schema import Value, load_schema
from tests.files.axis_steps import taken_back


def titles(file: ParameterFile) -> list[str]:
    """Return the heads of the fitted axes."""
    return [axis_title(file, axis) for axis in fitted_axes(file)]


def word(file: ParameterFile, parameter: str, instance: str = "") -> int:
    """Return a packed word."""
    return int(file.get((parameter, instance)).value)


# -- new files


def test_a_num_has_names_and_groups_in_p9_and_a_bit_in_p2_p3_and_p0() -> None:
    """Pages 4-8, 4-10, 4-14 and 4-24: 07 is B of group 1, FF is nothing."""
    file = new_file("num", None, ["X", "y", "Z", "B"])
    assert titles(file) == ["0 X linear", "1 Y linear", "2 Z linear", "3 B rotary"]
    assert [word(file, "axes.assignment", str(n)) for n in range(5)] == [0x00, 0x01, 0x02, 0x07, 0xFF]
    assert {word(file, f"axes.{name}") for name in ("measured", "servoed", "displayed")} == {0x0F}
    assert word(file, "axes.cnc_groups") == 1
    assert shown_axes(file) == ("0", "1", "2", "3"), "a word that is not set declares no handwheel"


def test_an_axis_of_a_num_may_be_put_into_a_group() -> None:
    """Page 4-24: 10 is X of group 2."""
    file = new_file("num", None, ["X", "Z", "X.2", "Z.2"])
    assert [word(file, "axes.assignment", str(n)) for n in range(4)] == [0x00, 0x02, 0x10, 0x12]
    assert titles(file)[1:3] == ["1 Z linear, Group 1", "2 X linear, Group 2"]
    assert word(file, "axes.cnc_groups") == 2
    assert axis_head(file, "3") == ("Z", "3 linear, Group 2")


def test_the_number_of_axes_shows_which_an_acromill_has() -> None:
    file = new_file("acromill", None, ["X", "Y", "C"])
    assert file.get(("view.number_of_axes", "")) == Value(3)
    assert titles(file) == ["Axis X", "Axis Y", "Z C"]
    assert file.get(("axes.name", "C")) == Value("c"), "what is not there keeps its name"


@pytest.mark.parametrize(
    ("family", "axes", "heads"),
    [
        ("57c422b", ["X", "Y"], ["X axis", "Y axis"]),
        (
            "grblhal",
            ["X", "Y", "Z", "A"],
            ["X axis linear", "Y axis linear", "Z axis linear", "A axis linear"],
        ),
        ("syntec", ["X", "Z"], ["1 X linear", "2 Z linear"]),
        ("9pc", ["X", "Z", "S"], ["1 X linear", "2 Z linear", "3 S spindle"]),
    ],
)
def test_every_other_family_takes_axes_too(family: str, axes: list[str], heads: list[str]) -> None:
    assert titles(new_file(family, None, axes)) == heads


@pytest.mark.parametrize(
    ("family", "axes", "message"),
    [
        ("num", ["X", "S"], "'S' is no name for an axis: X, Y, Z, U, V, W, A, B, C"),
        ("num", ["X", "none"], "'none' is no name for an axis"),
        ("num", ["5"], "'5' is no name for an axis"),
        ("num", ["X", ""], "'' is no name for an axis"),
        ("num", ["X", "Y."], "'Y.' is no name for an axis"),
        ("num", ["X", "Y.none"], "'Group none' is not a choice of Axis group"),
        ("acromill", ["X", "raw:1"], "'raw:1' is no name for an axis"),
        ("num", ["X", "X"], "the axes 0 and 1 of Group 1 would both be named X"),
        ("num", ["X", "Y.9"], "'Group 9' is not a choice of Axis group"),
        ("acromill", ["X"], "has 2 or more axes"),
        ("acromill", ["X", "X"], "would both be named X"),
        ("acromill", ["X", "Y.2"], "has no groups of axes"),
        ("acromill", list("XYZABCUVW"), "9 axes are too many"),
        ("57c422b", ["X"], r"always has the axes X and Y \(page 4-1\)"),
        ("57c422b", ["X", "Y", "Z"], "3 axes are too many"),
        ("grblhal", ["X", "Z"], "in this order"),
    ],
)
def test_axes_that_a_family_cannot_have_are_refused(family: str, axes: list[str], message: str) -> None:
    with pytest.raises(AxisError, match=message):
        new_file(family, None, axes)


def test_a_machine_type_may_have_fewer_axes_than_its_family() -> None:
    """Grbl 1.1 has X, Y and Z (G-100)."""
    with pytest.raises(AxisError, match="4 axes are too many: grblHAL and Grbl has 3"):
        new_file("grblhal", "grbl-1.1", list("XYZA"))
    assert fitted_axes(new_file("grblhal", "grbl-1.1", list("XYZ"))) == ("X", "Y", "Z")


# -- which are there


def test_the_input_of_a_spindle_is_shown_and_is_no_axis() -> None:
    """Pages 8-3 and 4-28: spindle 1 is at address 24, handwheel 1 at 28."""
    file = new_file("num", None, ["X"])
    file.set(("spindle.measured", ""), Value(1))
    file.set(("axes.handwheels", ""), Value(1))
    assert fitted_axes(file) == ("0",)
    assert [axis_title(file, axis) for axis in shown_axes(file)] == [
        "0 X linear",
        "24 spindle",
        "28 handwheel",
    ]
    assert axis_kind(file, "24") == "spindle"


def test_where_nothing_is_known_every_axis_is_there() -> None:
    assert len(fitted_axes(new_file("num"))) == 32
    assert len(fitted_axes(new_file("acromill"))) == 8


def test_a_word_has_a_bit_for_each_axis_where_all_its_bits_are_called_so() -> None:
    words = words_of_axes(load_schema("num"))
    assert {"axes.modulo", "axes.clamped", "measure.direction", "travel.homing_negative"} <= words.keys()
    assert words["axes.modulo"]["31"] == 31
    assert not {"axes.diameter_x", "axes.handwheels"} & words.keys(), "groups and handwheels are no axes"
    assert words_of_axes(load_schema("57c422b")) == {}


# -- one axis


def test_an_added_axis_takes_the_first_free_address_and_a_removed_one_leaves_no_bit() -> None:
    file = new_file("num", None, ["X", "Y"])
    file.set(("spindle.measured", ""), Value(0))
    add_axis(file, "Z")
    assert titles(file)[-1] == "2 Z linear"
    assert word(file, "axes.servoed") == 0b111
    add_axis(file, "C", "9")
    file.set(("axes.modulo", ""), Value(1 << 9 | 1 << 2))
    delete_axis(file, "2")
    assert titles(file) == ["0 X linear", "1 Y linear", "9 C rotary"]
    assert word(file, "axes.modulo") == 1 << 9
    assert word(file, "axes.assignment", "2") == 0xFF
    delete_axis(file, "9")
    assert word(file, "axes.modulo") == 0
    assert word(file, "axes.measured") == 0b11


def test_an_address_that_is_taken_is_named() -> None:
    file = new_file("num", None, ["X", "Y"])
    file.set(("spindle.measured", ""), Value(1))
    before = dict(file.values)
    with pytest.raises(AxisError, match=r"axis 1 is there already \(Y\).*address of its encoder card"):
        add_axis(file, "Z", "1")
    with pytest.raises(AxisError, match="the input 24 serves a spindle"):
        add_axis(file, "Z", "24")
    with pytest.raises(AxisError, match="would both be named Y"):
        add_axis(file, "Y")
    with pytest.raises(AxisError, match="axis 5 is not fitted"):
        delete_axis(file, "5")
    assert file.values == before


def test_counted_axes_come_and_go_at_the_end() -> None:
    file = new_file("acromill", None, ["X", "Y"])
    add_axis(file, "Z")
    with pytest.raises(AxisError, match="only the last axis can be removed, Z"):
        delete_axis(file, "X")
    delete_axis(file, "Z")
    with pytest.raises(AxisError, match="has 2 or more axes"):
        delete_axis(file, "Y")
    with pytest.raises(AxisError, match="the next one is Z"):
        add_axis(file, "B", "A")
    router = new_file("grblhal", None, ["X", "Y", "Z"])
    add_axis(router, "A")
    assert file.get(("view.number_of_axes", "")) == Value(2)
    assert router.get(("build.axes", "")) == Value("XYZA")
    assert {p for p, i in router.values if i == "A"} == {p for p, i in router.values if i == "Z"}, "defaults"


def test_an_axis_put_between_others_moves_them_up_with_everything_that_names_them(
    mill: ParameterFile,
) -> None:
    mill.set(("home.calibration", "2"), Value(7.0, "mm"))
    mill.set(("cycle.drilling_axis", ""), Value(key_of(mill, "cycle.drilling_axis", "Axis 3")))
    before = dict(mill.values)
    changes = add_axis(mill, "A", "2")
    assert titles(mill) == ["1 X linear", "2 A rotary", "3 Y linear", "4 Z linear"]
    assert mill.get(("home.calibration", "3")) == Value(7.0, "mm")
    assert mill.get(("home.calibration", "2")) == Value(0.0, "deg")
    assert mill.get(("cycle.drilling_axis", "")) == Value(key_of(mill, "cycle.drilling_axis", "Axis 4"))
    assert taken_back(mill, changes) == before


def key_of(file: ParameterFile, parameter: str, label: str) -> str:
    """Return the key of a choice."""
    return next(c.key for c in file.schema.parameters[parameter].choices if c.label == label)


def test_a_full_control_takes_no_further_axes(mill: ParameterFile) -> None:
    for name in ("A", "B", "C", "U", "V"):
        add_axis(mill, name)
    with pytest.raises(AxisError, match="no axis that is free: all 8 are fitted"):
        add_axis(mill, "W")


def test_a_syntec_axis_that_is_added_waits_for_its_port() -> None:
    file = new_file("syntec", None, ["X"])
    add_axis(file, "Y")
    assert file.get(("axis.port", "2")) is None, "what it is wired to is not guessed"
    assert titles(file) == ["1 X linear", "2 Y linear"]


def test_axes_that_are_named_alike_already_do_not_keep_another_from_its_letter() -> None:
    file = new_file("num", None, ["X", "Y", "Z"])
    file.set(("axes.assignment", "1"), Value(0))
    rename_axis(file, "2", "W")
    assert [axis_letter(file, a) for a in fitted_axes(file)] == ["X", "X", "W"]
    with pytest.raises(AxisError, match="the axes 0 and 2 of Group 1 would both be named X"):
        rename_axis(file, "2", "X")


def test_a_letter_is_changed_and_the_group_stays() -> None:
    file = new_file("num", None, ["X", "X.2"])
    rename_axis(file, "1", "U")
    assert word(file, "axes.assignment", "1") == 0x13
    with pytest.raises(AxisError, match="fixed names"):
        rename_axis(new_file("57c422b"), "X", "Y")


# -- values


def test_a_copied_axis_takes_bits_and_words_but_no_name() -> None:
    file = new_file("num", None, ["X", "Y", "B"])
    file.set(("travel.limit_max", "0"), Value(5000, "iu"))
    file.set(("measure.direction", ""), Value(0b101))
    before = dict(file.values)
    changes = copy_axis(file, "0", "1")
    assert file.get(("travel.limit_max", "1")) == Value(5000, "iu")
    assert word(file, "measure.direction") == 0b111
    assert axis_letter(file, "1") == "Y"
    assert word(file, "axes.measured") == 0b111
    assert compare_axes(file, "0", "1") == []
    assert taken_back(file, changes) == before
    with pytest.raises(AxisError, match="axis 0 is linear and axis 2 is rotary"):
        copy_axis(file, "0", "2")


def test_a_copy_takes_the_points_of_a_cam_table_along() -> None:
    file = new_file("57c422b")
    file.set(("cam.time_points", "X.3"), Value(77, "counts"))
    copy_axis(file, "X", "Y")
    assert file.get(("cam.time_points", "Y.3")) == Value(77, "counts")


def test_swapped_axes_change_places_with_names_bits_and_references() -> None:
    file = new_file("num", None, ["X", "Y", "Z"])
    file.set(("travel.limit_max", "0"), Value(5000, "iu"))
    file.set(("axes.clamped", ""), Value(0b001))
    file.set(("axes.drive_axis", "2"), Value("axis-0"))
    before = dict(file.values)
    changes = swap_axes(file, "0", "1")
    assert titles(file) == ["0 Y linear", "1 X linear", "2 Z linear"]
    assert file.get(("travel.limit_max", "1")) == Value(5000, "iu")
    assert word(file, "axes.clamped") == 0b010
    assert file.get(("axes.drive_axis", "2")) == Value("axis-1")
    swap_axes(file, "1", "0")
    assert file.values == before
    swap_axes(file, "0", "1")
    assert taken_back(file, changes) == before


def test_two_axes_are_compared_by_words_and_bits() -> None:
    file = new_file("num", None, ["X", "Y"])
    file.set(("travel.limit_max", "0"), Value(5000, "iu"))
    file.set(("travel.homing_negative", ""), Value(0b10))
    found = compare_axes(file, "0", "1")
    assert [(d.first, d.second, d.bits) for d in found] == [
        (("travel.homing_negative", ""), ("travel.homing_negative", ""), (0, 1)),
        (("travel.limit_max", "0"), ("travel.limit_max", "1"), None),
    ]


def test_axes_that_move_alike_are_alike() -> None:
    file = new_file("num", None, ["X", "Y", "B"])
    assert alike_axes(file, "0") == ("0", "1")
    assert alike_axes(new_file("acromill", None, ["X", "Y"]), "Y") == ("X", "Y")


@pytest.mark.parametrize("path", [e.path for e in examples()], ids=lambda path: path.stem)
def test_on_every_example_a_copy_leaves_no_difference_and_a_second_swap_none_either(path: Path) -> None:
    file = open_file(path).file
    before = dict(file.values)
    axes = fitted_axes(file)
    for first, second in combinations(axes, 2):
        if second not in alike_axes(file, first):
            continue
        changes = copy_axis(file, first, second)
        assert compare_axes(file, first, second) == []
        assert taken_back(file, changes) == before
        swap_axes(file, first, second)
        swap_axes(file, first, second)
        assert file.values == before


@pytest.mark.parametrize("path", [e.path for e in examples()], ids=lambda path: path.stem)
def test_on_every_example_an_axis_that_is_added_or_deleted_is_taken_back_whole(path: Path) -> None:
    file = open_file(path).file
    before = dict(file.values)
    for place in places_offered(file)[:3]:
        letters = letters_offered(file.schema) or (place,)
        free = next(n for n in letters if n not in {axis_letter(file, a) for a in fitted_axes(file)})
        changes = add_axis(file, free, place)
        assert free in {axis_letter(file, a) for a in fitted_axes(file)}
        assert taken_back(file, changes) == before
    if not why_axes_are_fixed(file.schema) and len(fitted_axes(file)) > 3:
        last = fitted_axes(file)[-1]
        changes = delete_axis(file, last)
        assert last not in fitted_axes(file)
        assert taken_back(file, changes) == before
