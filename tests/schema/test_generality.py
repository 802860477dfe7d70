"""What the words of the database must be able to say: every hard case of the control families, in small.

Each family here is made up, as short as its one difficulty allows; numbers and names follow the manual
the difficulty comes from.
"""

import pytest

from amp_studio.schema import (
    InvalidValueError,
    UnknownParameterError,
    Value,
    clip,
    fault,
    limits,
    read_value,
    resolve_address,
    show_value,
    write_value,
)

# -- numbers that mean more than one thing -------------------------------------------------------

SHARED = """
  - id: axis.type
    name: Axis Type
    scope: axis
    numbers: {start: 360, step: 1}
    type: choice
    choices: [{key: linear, label: linear}, {key: spindle, label: spindle}]
    help: {what: What stands behind the axis number.}
    page: "3-5"
  - id: servo.motor_teeth
    name: Teeth on Motor Gear
    scope: axis
    numbers: {start: 1013, step: 1000}
    type: integer
    ranges: {"": [1, 32767]}
    states: [{state: hidden, when: spindle_axis}]
    help: {what: The motor side of the gearing of a slide.}
    page: "7-52"
  - id: spindle.motor_teeth
    name: Teeth on Spindle Motor
    scope: axis
    numbers: {start: 1013, step: 1000}
    type: integer
    ranges: {"": [1, 99]}
    states: [{state: hidden, unless: spindle_axis}]
    help: {what: The motor side of the gearing of a spindle.}
    page: "7-82"
"""
SPINDLE_AXIS = """
conditions:
  spindle_axis: {reads: {axis: axis.type}, when: axis == 'spindle', why: for a spindle}
"""


def test_one_number_of_two_parameters_is_distinguished_by_the_axis_type(facts, head, machine) -> None:
    here = machine(
        facts.schema(SHARED, head + SPINDLE_AXIS),
        {"axis.type@1": Value("linear"), "axis.type@2": Value("spindle")},
    )
    assert here.evaluation.find("1013") == ("servo.motor_teeth", "1")
    assert here.evaluation.find("2013") == ("spindle.motor_teeth", "2")
    assert "outside 1 to 99" in str(fault(here.evaluation, here.evaluation.find("2013"), Value(100)))
    assert fault(here.evaluation, here.evaluation.find("1013"), Value(100)) is None


def test_the_number_follows_when_the_axis_becomes_a_spindle(facts, head, machine) -> None:
    here = machine(facts.schema(SHARED, head + SPINDLE_AXIS), {"axis.type@1": Value("linear")})
    assert here.evaluation.find("1013") == ("servo.motor_teeth", "1")
    here.set("axis.type@1", Value("spindle"))
    assert here.evaluation.find("1013") == ("spindle.motor_teeth", "1")


def test_a_shared_number_is_found_even_where_something_else_hides_both(facts, head, machine) -> None:
    both = "states: [{state: hidden, when: no_servo}, "
    text = SHARED.replace("states: [", both)
    conditions = (
        SPINDLE_AXIS + "  no_servo: {reads: {axis: axis.type}, when: axis != null, why: no servo is chosen}\n"
    )
    here = machine(
        facts.schema(text, head + conditions),
        {"axis.type@1": Value("linear"), "axis.type@2": Value("spindle")},
    )
    assert here.evaluation.state(("servo.motor_teeth", "1")).state == "hidden"
    assert here.evaluation.find("1013") == ("servo.motor_teeth", "1")
    assert here.evaluation.find("2013") == ("spindle.motor_teeth", "2")


def test_of_a_number_that_nothing_reports_apart_the_first_is_taken_and_both_are_reported(
    facts, machine
) -> None:
    text = SHARED.replace("states: [{state: hidden, when: spindle_axis}]", "").replace(
        "states: [{state: hidden, unless: spindle_axis}]", ""
    )
    here = machine(facts.schema(text))
    found = resolve_address(here.evaluation, "1013")
    assert (found.address, found.others) == (("servo.motor_teeth", "1"), (("spindle.motor_teeth", "1"),))
    assert "(servo.motor_teeth@1); the other is " in found.remark(here.schema)


def test_a_number_printed_for_two_parameters_belongs_to_the_undisputed_one(facts, machine) -> None:
    schema = facts.schema("""
      - id: zone.overtravel_used
        name: Software Overtravel Used
        scope: axis
        numbers: {start: 1020, step: 1000}
        type: integer
        help: {what: Switches the overtravels on.}
        page: "6-10"
      - id: servo.velocity_port
        name: Velocity Loop Feedback Port
        scope: axis
        numbers: {start: 1020, step: 1000, disputed: true}
        type: integer
        help: {what: The connector of the velocity feedback.}
        page: "7-46"
    """)
    here = machine(schema)
    assert here.evaluation.find("3020") == ("zone.overtravel_used", "3")
    assert schema.on("mill").short(("zone.overtravel_used", "3")) == "3020"
    assert schema.on("mill").short(("servo.velocity_port", "3")) == "servo.velocity_port@3"
    assert schema.on("mill").label(("servo.velocity_port", "3")) == "Velocity Loop Feedback Port Axis 3"


# -- what depends on mill or lathe ----------------------------------------------------------------


def test_the_numbers_of_a_parameter_may_differ_between_mill_and_lathe(facts, machine) -> None:
    schema = facts.schema("""
      - id: tool.wear
        name: Maximum Tool Wear
        layouts:
          - {machines: [mill], scope: global, numbers: {start: 97}}
          - {machines: [lathe], scope: global, numbers: {start: 98}}
        type: integer
        help: {what: The largest wear.}
        page: "20-3"
      - id: tool.life
        name: Tool Life
        numbers: {start: 98}
        layouts: [{machines: [mill], scope: global, numbers: {start: 98}}]
        type: integer
        help: {what: The life of a tool on a mill.}
        page: "20-4"
    """)
    assert machine(schema, machine="mill").evaluation.find("97") == ("tool.wear", "")
    assert machine(schema, machine="mill").evaluation.find("98") == ("tool.life", "")
    assert machine(schema, machine="lathe").evaluation.find("98") == ("tool.wear", "")
    with pytest.raises(UnknownParameterError, match="Unknown parameter '97'"):
        machine(schema, machine="lathe").evaluation.find("97")
    with pytest.raises(UnknownParameterError, match="does not exist on this machine type"):
        machine(schema, machine="lathe").evaluation.find("tool.life")


def test_the_scope_of_a_parameter_may_differ_between_mill_and_lathe(facts, machine) -> None:
    schema = facts.schema("""
      - id: plane.radius
        name: Radius Plane
        layouts:
          - {machines: [lathe], scope: axis, numbers: {start: 1100, step: 1000}}
          - {scope: global, numbers: {start: 100}}
        type: real
        quantity: length
        ranges: {mm: [0, 10]}
        help: {what: One value on a mill and one for each axis of a lathe.}
        page: "4-9"
    """)
    assert schema.on("mill").addresses == (("plane.radius", ""),)
    assert schema.on("lathe").addresses == (
        ("plane.radius", "1"),
        ("plane.radius", "2"),
        ("plane.radius", "3"),
    )
    mill, lathe = machine(schema, machine="mill"), machine(schema, machine="lathe")
    assert mill.evaluation.find("100") == ("plane.radius", "")
    assert lathe.evaluation.find("2100") == ("plane.radius", "2")
    for here, address in ((mill, ("plane.radius", "")), (lathe, ("plane.radius", "2"))):
        assert fault(here.evaluation, address, Value(10.0, "mm")) is None
        assert "outside 0 to 10 mm" in str(fault(here.evaluation, address, Value(10.1, "mm")))


def test_axis_1_is_not_taken_for_process_1(facts, head, machine) -> None:
    """9/PC: Number of Limit 2,3 Groups is 20 for the control,
    20020 and 21020 for processes 1 and 2 (page 6-6).
    """
    schema = facts.schema(
        """
        - id: zone.groups
          name: Number of Groups
          scope: process
          numbers: {listed: {"": "20", "1": "20020", "2": "21020"}}
          type: integer
          help: {what: How many groups are used.}
          page: "6-6"
        - id: zone.limit
          name: Zone Limit
          scope: axis
          type: real
          states: [{state: ignored, when: no_groups}]
          help: {what: Where the zone ends.}
          page: "6-7"
        - id: zone.speed
          name: Zone Speed
          scope: process
          type: real
          states: [{state: ignored, when: no_groups}]
          help: {what: How fast the zone is left.}
          page: "6-8"
        """,
        head.replace("  axis:", '  process: {instances: ["", "1", "2"], label: "Process {i}"}\n  axis:')
        + "conditions:\n  no_groups: {reads: {groups: zone.groups}, when: groups == 0.0, why: no groups}\n",
    )
    here = machine(schema, {"zone.groups": Value(1), "zone.groups@1": Value(0), "zone.groups@2": Value(1)})
    assert here.evaluation.state(("zone.limit", "1")).state == "in-force"
    assert here.evaluation.state(("zone.speed", "1")).state == "ignored"
    assert here.evaluation.state(("zone.speed", "2")).state == "in-force"
    here.set("zone.groups", Value(0))
    assert here.evaluation.state(("zone.limit", "1")).state == "ignored"
    assert {("zone.groups", "")} == here.evaluation.state_reads(("zone.limit", "1"))


# -- ranges ---------------------------------------------------------------------------------------


def test_a_bound_may_be_another_parameter_of_the_same_axis(facts, machine) -> None:
    schema = facts.schema("""
      - id: zone.max
        name: Maximum
        scope: axis
        type: real
        quantity: length
        ranges: {mm: [{param: zone.min}, 100], in: [{param: zone.min}, 3.9370]}
        help: {what: The larger end.}
        page: "6-7"
      - id: zone.min
        name: Minimum
        scope: axis
        numbers: {start: 1006, step: 1000}
        type: real
        quantity: length
        help: {what: The smaller end.}
        page: "6-8"
    """)
    here = machine(schema, {"zone.min@1": Value(25.4, "mm"), "zone.min@2": Value(50.0, "mm")})
    assert fault(here.evaluation, ("zone.max", "1"), Value(25.4, "mm")) is None
    assert fault(here.evaluation, ("zone.max", "1"), Value(1.0, "in")) is None
    message = fault(here.evaluation, ("zone.max", "1"), Value(0.9, "in"))
    assert message == "Maximum 0.9 in is outside 1 to 3.937 in (set by 1006 Minimum, 25.4 mm)"
    assert fault(here.evaluation, ("zone.max", "2"), Value(49.0, "mm")) is not None
    assert fault(here.evaluation, ("zone.max", "3"), Value(-1e9, "mm")) is None, (
        "an unset bound bounds nothing"
    )


def test_a_range_may_depend_on_the_axis_type(facts, head, machine) -> None:
    """9/PC Excess Error: 214.1 mm on a slide, 1440 degrees on a spindle (page 7-20)."""
    text = (
        SHARED
        + """
  - id: servo.excess_error
    name: Excess Error
    scope: axis
    type: real
    quantity: length
    ranges: {mm: [0, 214.1], in: [0, 8.42913]}
    range_variants: [{when: spindle_axis, ranges: {deg: [0, 1440]}}]
    help: {what: The error at which the axis stops.}
    page: "7-20"
"""
    )
    here = machine(
        facts.schema(text, head + SPINDLE_AXIS + "angular_when: spindle_axis\n"),
        {"axis.type@1": Value("linear"), "axis.type@2": Value("spindle")},
    )
    slide, spindle = ("servo.excess_error", "1"), ("servo.excess_error", "2")
    assert (here.evaluation.unit(slide, "metric"), here.evaluation.unit(spindle, "inch")) == ("mm", "deg")
    assert fault(here.evaluation, spindle, Value(1440.0, "deg")) is None
    assert "outside 0 to 1440 °" in str(fault(here.evaluation, spindle, Value(1440.1, "deg")))
    assert "outside 0 to 214.1 mm" in str(fault(here.evaluation, slide, Value(1440.0, "mm")))


def test_a_parameter_may_be_an_angle_on_fewer_axes_than_the_family_shows(facts, head, machine) -> None:
    """9/PC Lead Screw Thread Pitch: a length on a spindle too (page 7-17)."""
    text = (
        SHARED
        + """
  - id: servo.pitch
    name: Pitch
    scope: axis
    type: real
    quantity: length
    angular_when: never
    help: {what: Travel for a turn.}
    page: "7-17"
"""
    )
    never = "  never: {reads: {type: axis.type}, when: type == 'table', why: never}\n"
    here = machine(
        facts.schema(text, head + SPINDLE_AXIS + never + "angular_when: spindle_axis\n"),
        {"axis.type@2": Value("spindle")},
    )
    assert here.evaluation.unit(("servo.pitch", "2"), "metric") == "mm"
    assert here.evaluation.unit(("axis.type", "2"), "metric") == ""


def test_a_value_is_entered_in_one_unit_and_stored_in_another(facts, machine) -> None:
    """9/PC feedrates: mm/min or in/min in the editor, mm/s in the control (page 37-4)."""
    schema = facts.schema("""
      - id: feedrate.rapid
        name: Rapid Feedrate
        scope: axis
        type: real
        quantity: velocity
        ranges: {mm/min: [0, 10160.00004], in/min: [0, 400.0]}
        storage: {unit: mm/s, decimals: 5}
        help: {what: The rapid feedrate.}
        page: "9-2"
    """)
    here, rapid = machine(schema), ("feedrate.rapid", "1")
    parameter = schema.parameter("feedrate.rapid")
    assert (here.evaluation.unit(rapid, "metric"), here.evaluation.unit(rapid, "inch")) == (
        "mm/min",
        "in/min",
    )
    assert parameter.storage.unit == "mm/s"
    assert Value(100.0, "mm/s") == read_value(parameter, "100 mm/s", "mm/min")
    assert fault(here.evaluation, rapid, Value(169.333334, "mm/s")) is None
    assert fault(here.evaluation, rapid, Value(169.33334, "mm/s")) is not None, "10160.0004 mm/min"


# -- forms of values ------------------------------------------------------------------------------


@pytest.fixture
def word_format(facts):
    """Return a family whose one parameter is a word format."""
    return facts.schema("""
      - id: word.format
        name: X Word Format
        numbers: {start: 40}
        type: format
        ranges: {"": [0.0, 6.4]}
        help: {what: Digits before and behind the decimal point.}
        page: "15-1"
    """)


@pytest.mark.parametrize(
    ("text", "expected"),
    [("3.4", "3.4"), ("3,4", "3.4"), ("6.0", "6.0"), ("3.10", "3.10"), (" 03.4 ", "3.4")],
)
def test_a_number_format_is_no_fraction(word_format, text: str, expected: str) -> None:
    parameter = word_format.parameter("word.format")
    value = read_value(parameter, text, "")
    assert Value(expected) == value
    assert expected == write_value(parameter, value) == show_value(parameter, value)


@pytest.mark.parametrize("text", ["3", "3.", ".4", "3.4 mm", "-3.4", "3.4.5", "three", ""])
def test_what_is_no_number_format_is_refused(word_format, text: str) -> None:
    with pytest.raises(InvalidValueError, match="digits before and behind the point"):
        read_value(word_format.parameter("word.format"), text, "")


@pytest.mark.parametrize(
    ("form", "allowed"), [("6.4", True), ("0.0", True), ("7.0", False), ("0.5", False), ("3.10", False)]
)
def test_each_part_of_a_number_format_has_its_own_bound(
    word_format, machine, form: str, allowed: bool
) -> None:
    message = fault(machine(word_format).evaluation, ("word.format", ""), Value(form))
    assert (None if allowed else f"X Word Format {form} is outside 0.0 to 6.4") == message


# -- mending ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("value", "expected"), [(Value(0), Value(1)), (Value(99), Value(3)), (Value(2), Value(2))]
)
def test_a_whole_number_is_mended_to_a_whole_number_inside(
    facts, machine, value: Value, expected: Value
) -> None:
    schema = facts.schema("""
      - id: a.whole
        name: Whole
        type: integer
        ranges: {"": [0.5, 3.5]}
        help: {what: A whole number between halves.}
        page: "1"
    """)
    here = machine(schema)
    assert expected == clip(here.evaluation, ("a.whole", ""), value)
    assert fault(here.evaluation, ("a.whole", ""), clip(here.evaluation, ("a.whole", ""), value)) is None
    assert (
        limits(here.evaluation, ("a.whole", ""), "").low,
        limits(here.evaluation, ("a.whole", ""), "").high,
    ) == (0.5, 3.5)
