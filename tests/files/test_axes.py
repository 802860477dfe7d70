"""The axis operations: name, retype, copy, delete; each is a list of changes that can be taken back."""

import pytest

from amp_studio.files import (
    ParameterFile,
    axis_instances,
    axis_title,
    copy_axis,
    delete_axis,
    fitted_axes,
    new_file,
    retype_axis,
)
from amp_studio.files.axes import AxisError, axis_type
from amp_studio.files.axis_fitting import name_axes
from amp_studio.schema import Value
from tests.files.axis_steps import taken_back


def axis_values(file: ParameterFile, axis: str) -> dict[str, Value]:
    """Return the values of an axis, by parameter."""
    scope = "axis"
    return {a[0]: v for a, v in file.values.items() if a[1] == axis and file.evaluation.scope(a) == scope}


def test_axes_are_named_in_order_and_the_rest_is_unfitted(mill: ParameterFile) -> None:
    before = dict(mill.values)
    changes = name_axes(mill, ["Z", "A", "S"])
    assert [(mill.get(("axis.name", axis)).value, axis_type(mill, axis)) for axis in "123"] == [
        ("z", "linear"),
        ("a", "rotary"),
        ("s", "spindle"),
    ]
    assert fitted_axes(mill) == ("1", "2", "3")
    assert before == taken_back(mill, changes)
    name_axes(mill, ["X"])
    assert fitted_axes(mill) == ("1",)


def test_an_axis_is_titled_by_number_name_and_type(mill: ParameterFile) -> None:
    assert axis_title(mill, "2") == "2 Y linear"
    assert axis_title(mill, "5") == "5 – unfitted"
    mill.set(("axis.name", "1"), Value("raw:99"))
    assert axis_title(mill, "1") == "1 ? linear"


@pytest.mark.parametrize("axis", ["1", "3"])
def test_lengths_become_angles_with_the_same_figures_and_back(mill: ParameterFile, axis: str) -> None:
    mill.set(("home.calibration", axis), Value(0.5, "in"))
    mill.set(("feedrate.rapid", axis), Value(30.0, "mm/s"))
    before = dict(mill.values)
    changes = retype_axis(mill, axis, "rotary")
    assert Value(0.5, "deg") == mill.get(("home.calibration", axis))
    assert Value(30.0, "deg/s") == mill.get(("feedrate.rapid", axis))
    assert axis_type(mill, "2") == "linear", "the other axes stay as they are"
    assert Value(0.0, "mm") == mill.get(("home.calibration", "2"))
    lengths = [v.unit for v in axis_values(mill, axis).values() if v.unit.startswith(("mm", "in"))]
    fixed = [
        v.unit
        for p, v in axis_values(mill, axis).items()
        if mill.schema.parameter(p).unit == v.unit and v.unit
    ]
    assert set(lengths) <= set(fixed), "only a unit that a parameter fixes for itself stays a length"
    assert before == taken_back(mill, changes)

    retype_axis(mill, axis, "rotary")
    retype_axis(mill, axis, "linear")
    assert Value(0.5, "mm") == mill.get(("home.calibration", axis)), "the control knows only the figure"


def test_a_type_or_an_axis_that_does_not_exist_is_refused(mill: ParameterFile) -> None:
    before = dict(mill.values)
    with pytest.raises(AxisError, match="there is no axis type 'square': linear, rotary, spindle, unfitted"):
        retype_axis(mill, "1", "square")
    for operation in (
        lambda: retype_axis(mill, "9", "linear"),
        lambda: delete_axis(mill, "9"),
        lambda: copy_axis(mill, "1", "9"),
    ):
        with pytest.raises(AxisError, match="there is no axis 9"):
            operation()
    assert before == mill.values


def test_a_copied_axis_is_the_same_in_all_but_its_name(mill: ParameterFile) -> None:
    mill.set(("home.calibration", "1"), Value(7.0, "mm"))
    mill.set(("zone.overtravel_used", "1"), Value(True))
    mill.set(("home.position", "2"), Value(3.0, "mm"))
    mill.set(("home.position", "1"), None)
    before = dict(mill.values)
    changes = copy_axis(mill, "1", "2")
    one, two = axis_values(mill, "1"), axis_values(mill, "2")
    assert (Value("x"), Value("y")) == (one.pop("axis.name"), two.pop("axis.name"))
    assert one == two
    assert {"2"} == {change.address[1] for change in changes}
    assert before == taken_back(mill, changes)


@pytest.mark.parametrize(
    ("source", "target", "message"),
    [
        ("1", "4", "axis 1 is linear and axis 4 is unfitted: only axes of the same type"),
        ("1", "1", "copied to itself"),
    ],
)
def test_only_axes_of_one_type_are_copied(
    mill: ParameterFile, source: str, target: str, message: str
) -> None:
    before = dict(mill.values)
    with pytest.raises(AxisError, match=message):
        copy_axis(mill, source, target)
    assert before == mill.values


def test_a_deleted_axis_is_unfitted_and_back_at_its_defaults(mill: ParameterFile) -> None:
    mill.set(("home.calibration", "3"), Value(7.0, "mm"))
    retype_axis(mill, "3", "rotary")
    mill.set(("axis.rollover", "3"), Value(360, "deg"))
    before = dict(mill.values)
    changes = delete_axis(mill, "3")
    assert axis_type(mill, "3") == "unfitted"
    assert Value("z") == mill.get(("axis.name", "3")), "the name is kept"
    assert Value(0.0, "mm") == mill.get(("home.calibration", "3"))
    assert mill.get(("axis.rollover", "3")) is None, "a value without a printed default is unset"
    others = [a for a in mill.addresses() if a[1] == "3" and a[0] not in ("axis.type", "axis.name")]
    assert all(mill.is_default(a) for a in others)
    with pytest.raises(AxisError, match="axis 3 is not fitted"):  # its values went to their defaults again
        delete_axis(mill, "3")
    assert before == taken_back(mill, changes)


def test_a_family_without_axes_shows_it(family) -> None:
    family(
        """
        family: plain
        name: Plain control
        document: plain
        title: Plain
        machines: [{key: one, name: One}]
        default_machine: one
        scopes: {global: {instances: [""], label: Control}}
        units: {}
        effect: {level: reset}
        groups: [all]
        """,
        """
        - id: a.number
          name: Number
          type: integer
          help: {what: A number.}
          page: "1"
        """,
    )
    file = new_file("plain")
    assert (axis_instances(file), fitted_axes(file)) == ((), ())
    with pytest.raises(AxisError, match="Plain control has no axes to configure"):
        name_axes(file, ["X"])
