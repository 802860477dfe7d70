"""What the words of the database must be able to say: every hard case of the control families, in small.

Each family here is made up, as short as its one difficulty allows; numbers and names follow the manual
the difficulty comes from.
"""

from __future__ import annotations

import pytest

from amp_studio.schema import (
    UnknownParameter,
    Value,
    ValueFault,
    clip,
    fault,
    field_at,
    field_value,
    limits,
    read_value,
    show_value,
    with_field,
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


def test_one_number_of_two_parameters_is_told_apart_by_the_axis_type(facts, head, machine) -> None:
    here = machine(
        facts.schema(SHARED, head + SPINDLE_AXIS),
        {"axis.type@1": Value("linear"), "axis.type@2": Value("spindle")},
    )
    assert here.situation.find("1013") == ("servo.motor_teeth", "1")
    assert here.situation.find("2013") == ("spindle.motor_teeth", "2")
    assert "outside 1 to 99" in str(fault(here.situation, here.situation.find("2013"), Value(100)))
    assert fault(here.situation, here.situation.find("1013"), Value(100)) is None


def test_the_number_follows_when_the_axis_becomes_a_spindle(facts, head, machine) -> None:
    here = machine(facts.schema(SHARED, head + SPINDLE_AXIS), {"axis.type@1": Value("linear")})
    assert here.situation.find("1013") == ("servo.motor_teeth", "1")
    here.set("axis.type@1", Value("spindle"))
    assert here.situation.find("1013") == ("spindle.motor_teeth", "1")


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
    assert here.situation.state(("servo.motor_teeth", "1")).state == "hidden"
    assert here.situation.find("1013") == ("servo.motor_teeth", "1")
    assert here.situation.find("2013") == ("spindle.motor_teeth", "2")


def test_a_number_that_nothing_tells_apart_is_refused_with_both_ids(facts, machine) -> None:
    text = SHARED.replace("states: [{state: hidden, when: spindle_axis}]", "").replace(
        "states: [{state: hidden, unless: spindle_axis}]", ""
    )
    here = machine(facts.schema(text))
    with pytest.raises(UnknownParameter, match=r"servo\.motor_teeth@1 or spindle\.motor_teeth@1.*by id"):
        here.situation.find("1013")


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
    assert here.situation.find("3020") == ("zone.overtravel_used", "3")
    assert schema.short(("zone.overtravel_used", "3"), "mill") == "3020"
    assert schema.short(("servo.velocity_port", "3"), "mill") == "servo.velocity_port@3"
    assert schema.label(("servo.velocity_port", "3"), "mill") == "Velocity Loop Feedback Port Axis 3"


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
    assert machine(schema, machine="mill").situation.find("97") == ("tool.wear", "")
    assert machine(schema, machine="mill").situation.find("98") == ("tool.life", "")
    assert machine(schema, machine="lathe").situation.find("98") == ("tool.wear", "")
    with pytest.raises(UnknownParameter, match="'97' is no parameter"):
        machine(schema, machine="lathe").situation.find("97")
    with pytest.raises(UnknownParameter, match="does not exist on this machine type"):
        machine(schema, machine="lathe").situation.find("tool.life")


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
    assert schema.addresses("mill") == (("plane.radius", ""),)
    assert schema.addresses("lathe") == (("plane.radius", "1"), ("plane.radius", "2"), ("plane.radius", "3"))
    mill, lathe = machine(schema, machine="mill"), machine(schema, machine="lathe")
    assert mill.situation.find("100") == ("plane.radius", "")
    assert lathe.situation.find("2100") == ("plane.radius", "2")
    for here, address in ((mill, ("plane.radius", "")), (lathe, ("plane.radius", "2"))):
        assert fault(here.situation, address, Value(10.0, "mm")) is None
        assert "outside 0 to 10 mm" in str(fault(here.situation, address, Value(10.1, "mm")))


def test_axis_1_is_not_taken_for_process_1(facts, head, machine) -> None:
    """9/PC: Number of Limit 2,3 Groups is 20 for the control, 20020 and 21020 for processes 1 and 2 (page 6-6)."""
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
    assert here.situation.state(("zone.limit", "1")).state == "in-force"
    assert here.situation.state(("zone.speed", "1")).state == "ignored"
    assert here.situation.state(("zone.speed", "2")).state == "in-force"
    here.set("zone.groups", Value(0))
    assert here.situation.state(("zone.limit", "1")).state == "ignored"
    assert {("zone.groups", "")} == here.situation.state_reads(("zone.limit", "1"))


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
    assert fault(here.situation, ("zone.max", "1"), Value(25.4, "mm")) is None
    assert fault(here.situation, ("zone.max", "1"), Value(1.0, "in")) is None
    said = fault(here.situation, ("zone.max", "1"), Value(0.9, "in"))
    assert said == "Maximum 0.9 in is outside 1 to 3.937 in (set by 1006 Minimum)"
    assert fault(here.situation, ("zone.max", "2"), Value(49.0, "mm")) is not None
    assert fault(here.situation, ("zone.max", "3"), Value(-1e9, "mm")) is None, (
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
    assert (here.situation.unit(slide, "metric"), here.situation.unit(spindle, "inch")) == ("mm", "deg")
    assert fault(here.situation, spindle, Value(1440.0, "deg")) is None
    assert "outside 0 to 1440 °" in str(fault(here.situation, spindle, Value(1440.1, "deg")))
    assert "outside 0 to 214.1 mm" in str(fault(here.situation, slide, Value(1440.0, "mm")))


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
    assert (here.situation.unit(rapid, "metric"), here.situation.unit(rapid, "inch")) == ("mm/min", "in/min")
    assert parameter.storage.unit == "mm/s"
    assert Value(100.0, "mm/s") == read_value(parameter, "100 mm/s", "mm/min")
    assert fault(here.situation, rapid, Value(169.333334, "mm/s")) is None
    assert fault(here.situation, rapid, Value(169.33334, "mm/s")) is not None, "10160.0004 mm/min"


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
    with pytest.raises(ValueFault, match="digits before and behind the point"):
        read_value(word_format.parameter("word.format"), text, "")


@pytest.mark.parametrize(
    ("form", "allowed"), [("6.4", True), ("0.0", True), ("7.0", False), ("0.5", False), ("3.10", False)]
)
def test_each_part_of_a_number_format_has_its_own_bound(
    word_format, machine, form: str, allowed: bool
) -> None:
    said = fault(machine(word_format).situation, ("word.format", ""), Value(form))
    assert (None if allowed else f"X Word Format {form} is outside 0.0 to 6.4") == said


# -- NUM: arrays of typed words ---------------------------------------------------------------------

NUM = """
family: small
name: Small NUM
document: num-manual
title: Small NUM Manual
machines: [{key: mill, name: Mill}]
default_machine: mill
scopes:
  global: {instances: [""], label: Control}
  axis: {instances: ["0", "1", "2", "3"], label: "Axis {i}"}
  word: {instances: ["0", "1", "2", "3"], label: "N{i}"}
units:
  metric: {length: mm, velocity: mm/min}
effect: {level: reset}
groups: [all]
"""


def words(count: int) -> str:
    """Return the instances of an array of words as YAML."""
    return "[" + ", ".join(f'"{n}"' for n in range(count)) + "]"


def test_a_parameter_may_be_an_array_of_words(facts, machine) -> None:
    schema = facts.schema(
        f"""
        - id: servo.gain
          name: Servo-System Loop Gain
          scope: word
          instances: {words(32)}
          numbers: {{format: "P21N{{i}}"}}
          type: integer
          ranges: {{"": [-32768, 32767]}}
          storage: {{bits: 16, signed: true}}
          help: {{what: Gain of each axis.}}
          page: "6-14"
        """,
        NUM,
    )
    here = machine(schema)
    assert len(schema.addresses("mill")) == 32
    assert ("servo.gain", "3") == here.situation.find("P21N3") == here.situation.find("p21n3")
    assert here.situation.find("P21N31") == ("servo.gain", "31")
    assert schema.label(("servo.gain", "3"), "mill") == "P21N3 Servo-System Loop Gain"
    assert fault(here.situation, ("servo.gain", "31"), Value(-32768)) is None
    assert fault(here.situation, ("servo.gain", "31"), Value(32768)) is not None
    with pytest.raises(UnknownParameter, match="'P21N32' is no parameter"):
        here.situation.find("P21N32")


@pytest.fixture
def mask(facts):
    """Return a family with one 32-bit mask that has a bit an axis, written in hexadecimal (NUM P3)."""
    bits = "\n".join(f"            - {{bit: {n}, label: Axis {n}}}" for n in range(32))
    return facts.schema(
        f"""
        - id: axes.displayed
          name: Displayed Axes
          scope: word
          instances: ["0"]
          numbers: {{format: "P3N{{i}}"}}
          type: bits
          bits:
{bits}
          storage: {{bits: 32, signed: false, notation: hex}}
          help: {{what: One bit for each axis that is displayed.}}
          page: "4-10"
        """,
        NUM,
    )


def test_a_mask_has_a_bit_an_axis_and_is_written_in_hexadecimal(mask, machine) -> None:
    here, parameter = machine(mask), mask.parameter("axes.displayed")
    value = read_value(parameter, "0x8000001f", "")
    assert Value(0x8000001F) == value
    assert (
        Value(0x8000001F) == read_value(parameter, "$8000001F", "") == read_value(parameter, "2147483679", "")
    )
    assert write_value(parameter, value) == "0x8000001F"
    assert write_value(parameter, Value(7)) == "0x00000007"
    assert tuple(field_value(field_at(parameter, n), 0x8000001F) for n in (31, 0, 5)) == (1, 1, 0)
    assert fault(here.situation, ("axes.displayed", "0"), Value(0xFFFFFFFF)) is None
    assert "does not fit its 32 bits" in str(fault(here.situation, ("axes.displayed", "0"), Value(2**32)))
    assert "does not fit its 32 bits" in str(fault(here.situation, ("axes.displayed", "0"), Value(-1)))


def test_a_bit_of_a_mask_is_addressed_and_changed_by_itself(mask, machine) -> None:
    here, parameter = machine(mask), mask.parameter("axes.displayed")
    assert here.situation.find_bit("P3N0.5") == (("axes.displayed", "0"), 5)
    assert here.situation.find_bit("axes.displayed@0.5") == (("axes.displayed", "0"), 5)
    assert here.situation.find_bit("P3N0") == (("axes.displayed", "0"), None)
    assert with_field(field_at(parameter, 5), 0b000011, "yes") == 0b100011
    assert with_field(field_at(parameter, 0), 0b000011, "0") == 0b000010
    with pytest.raises(ValueFault, match="bits 0 to 31, not 32"):
        field_at(parameter, 32)
    with pytest.raises(ValueFault, match="Axis 3, which takes 0 to 1"):
        with_field(field_at(parameter, 3), 0, "2")


@pytest.mark.parametrize("text", ["P3N1.5", "P3N0.x", "P3N0.", "1.5"])
def test_what_is_no_bit_of_a_word_is_refused_as_it_was_written(mask, machine, text: str) -> None:
    with pytest.raises(UnknownParameter, match=rf"'{text}' is no parameter"):
        machine(mask).situation.find_bit(text)


def test_pairs_of_words_belong_to_one_axis(facts, machine) -> None:
    """NUM P11: words 2a and 2a+1 are MULTI and DIVI of axis a (page 5-6)."""
    schema = facts.schema(
        """
        - id: measure.multi
          name: Conversion, MULTI
          scope: axis
          numbers: {start: 0, step: 2, format: "P11N{n}"}
          type: integer
          ranges: {"": [1, 65535]}
          help: {what: Numerator of the conversion.}
          page: "5-6"
        - id: measure.divi
          name: Conversion, DIVI
          scope: axis
          numbers: {start: 1, step: 2, format: "P11N{n}"}
          type: integer
          ranges: {"": [1, 65535]}
          help: {what: Denominator of the conversion.}
          page: "5-6"
        """,
        NUM,
    )
    find = machine(schema).situation.find
    assert [find("P11N6"), find("P11N7")] == [("measure.multi", "3"), ("measure.divi", "3")]
    assert [find("P11N0"), find("P11N1")] == [("measure.multi", "0"), ("measure.divi", "0")]


def test_a_word_may_hold_a_code_in_each_nibble(facts, machine) -> None:
    codes = "[{key: none, label: none, raw: 0}, {key: sin, label: sine wave, raw: 1}, {key: ssi, label: SSI, raw: 8}]"
    schema = facts.schema(
        f"""
        - id: sensor.kind
          name: Sensors of Axes 0 to 3
          scope: word
          instances: ["0"]
          numbers: {{format: "P25N{{i}}"}}
          type: bits
          bits:
            - {{bit: 0, width: 4, label: Axis 0, choices: {codes}}}
            - {{bit: 4, width: 4, label: Axis 1, choices: {codes}}}
            - {{bit: 8, width: 4, label: Axis 2, choices: {codes}}}
            - {{bit: 12, width: 4, label: Axis 3}}
          storage: {{bits: 16, signed: false, notation: hex}}
          help: {{what: A code for the sensor of each axis.}}
          page: "5-18"
        """,
        NUM,
    )
    parameter, address = schema.parameter("sensor.kind"), ("sensor.kind", "0")
    here = machine(schema)
    assert [field_value(field_at(parameter, n), 0xF081) for n in (0, 4, 8, 12)] == [1, 8, 0, 15]
    assert fault(here.situation, address, Value(0xF081)) is None
    assert fault(here.situation, address, Value(0xF021)) == "2 is no code of Axis 1 in Sensors of Axes 0 to 3"
    assert (
        with_field(field_at(parameter, 8), with_field(field_at(parameter, 4), 0xF081, "Sine  Wave"), "ssi")
        == 0xF811
    )


def test_fields_of_many_bits_share_a_long_word_with_bits_nobody_knows(facts, machine) -> None:
    """NUM P34: each long word an axis holds the contents of two registers (page 5-18)."""
    schema = facts.schema(
        """
        - id: sensor.registers
          name: Sensor Registers
          scope: word
          instances: ["0", "1"]
          numbers: {format: "P34N{i}"}
          type: bits
          bits:
            - {bit: 0, width: 5, label: Length of the frame}
            - {bit: 5, label: Parity}
            - {bit: 6, width: 10, label: Figure lost, unknown: true}
            - {bit: 16, width: 3, label: Clock, choices: [{key: slow, label: slow, raw: 0}, {key: fast, label: fast, raw: 5}]}
          storage: {bits: 32, signed: false, notation: hex}
          help: {what: Two registers of the measuring input.}
          page: "5-18"
        """,
        NUM,
    )
    parameter, here = schema.parameter("sensor.registers"), machine(schema)
    word = 0xABC5_FFD9
    assert [field_value(field_at(parameter, n), word) for n in (0, 5, 6, 16)] == [25, 0, 0x3FF, 5]
    changed = with_field(field_at(parameter, 0), word, "13")
    assert changed == 0xABC5_FFCD, "every other bit stays, known or not"
    assert fault(here.situation, ("sensor.registers", "1"), Value(changed)) is None
    assert field_at(parameter, 20).unknown, "a bit that the database does not name can still be read"
    with pytest.raises(ValueFault, match="Length of the frame, which takes 0 to 31"):
        with_field(field_at(parameter, 0), word, "32")


# -- 57C422B: registers ------------------------------------------------------------------------------


def test_registers_are_read_on_a_command_and_the_second_axis_lies_2048_higher(facts, machine) -> None:
    schema = facts.schema(
        """
        - id: gain.proportional
          name: Proportional Gain
          scope: axis
          numbers: {start: 3, step: 2048, format: "R{n}"}
          type: integer
          ranges: {"": [0, 32767]}
          storage: {bits: 16}
          effect: {level: command, command: change default setups}
          help: {what: Proportional gain of the position loop.}
          page: "4-7"
        - id: limit.positive
          name: Positive Overtravel Limit
          scope: axis
          numbers: {start: 11, step: 2048, format: "R{n}"}
          type: integer
          quantity: counts
          ranges: {counts: [-2147483648, 2147483647]}
          storage: {unit: counts, bits: 32, words: 2, word_order: high-first}
          effect: {level: command, command: enable feedback}
          help: {what: Where the travel ends.}
          page: "4-9"
        - id: homing.low_speed
          name: Low Speed Homing Reference
          scope: axis
          numbers: {start: 15, step: 2048, format: "R{n}"}
          type: real
          unit: counts/s
          storage: {unit: counts/s, scale: 65.536, bits: 32, words: 2, word_order: low-first}
          effect: {level: command, command: home axis}
          help: {what: Speed of the search for the marker.}
          page: "4-10"
        """,
        """
        family: small
        name: Small servo module
        document: module-manual
        title: Small Servo Module
        machines: [{key: module, name: Module}]
        default_machine: module
        scopes: {axis: {instances: [X, Y], label: "Axis {i}"}}
        units: {}
        effect: {level: at-once}
        groups: [all]
        """,
    )
    find = machine(schema).situation.find
    assert [find("R3"), find("R2051")] == [("gain.proportional", "X"), ("gain.proportional", "Y")]
    assert [find("r11"), find("r2059")] == [("limit.positive", "X"), ("limit.positive", "Y")]
    effect = schema.parameter("gain.proportional").effect
    assert (effect.level, effect.command) == ("command", "change default setups")
    orders = [schema.parameter(name).storage.word_order for name in ("limit.positive", "homing.low_speed")]
    assert orders == ["high-first", "low-first"]
    assert schema.parameter("limit.positive").storage.words == 2
    assert Value(2**31 - 1, "counts") == read_value(
        schema.parameter("limit.positive"), "2147483647", "counts"
    )
    assert fault(machine(schema).situation, find("R2059"), Value(2**31, "counts")) is not None
    assert schema.units_of(schema.parameter("homing.low_speed")) == ("counts/s",)
    assert Value(2000.0, "counts/s") == read_value(
        schema.parameter("homing.low_speed"), "2000 counts/sec", "counts/s"
    )


# -- Syntec and AcroMill ------------------------------------------------------------------------------


def test_odd_and_even_numbers_may_be_a_pair_that_takes_effect_on_reset(facts, machine) -> None:
    """Syntec Pr121 to 160: gear teeth at the screw side and at the motor side in turn."""
    schema = facts.schema("""
      - id: gear.screw
        name: Gear Number at Screw Side
        scope: axis
        numbers: {start: 121, step: 2, format: "Pr{n}"}
        type: integer
        ranges: {"": [1, 999999999]}
        effect: {level: reset}
        help: {what: Teeth at the screw.}
        page: "99"
      - id: gear.motor
        name: Gear Number at Motor Side
        scope: axis
        numbers: {start: 122, step: 2, format: "Pr{n}"}
        type: integer
        ranges: {"": [1, 999999999]}
        help: {what: Teeth at the motor.}
        page: "99"
    """)
    find = machine(schema).situation.find
    expected = [("gear.screw", "1"), ("gear.motor", "1"), ("gear.screw", "2"), ("gear.motor", "3")]
    assert expected == [find(number) for number in ("Pr121", "Pr122", "Pr123", "pr126")]
    levels = [
        (schema.parameter(name).effect or schema.family.effect).level for name in ("gear.screw", "gear.motor")
    ]
    assert levels == ["reset", "restart"], "what is not said of a parameter is said of the family"


def test_a_field_may_have_no_number_at_all(facts, machine) -> None:
    schema = facts.schema(
        """
        - id: axes.pulses_per_unit
          name: Pulses/Unit
          scope: axis
          type: real
          help: {what: Pulses of the feedback device for a unit of travel.}
          page: "A-4"
        - id: system.units
          name: Units
          type: choice
          choices: [{key: inch, label: Inch}, {key: mm, label: Metric}]
          help: {what: The unit of the machine.}
          page: "A-1"
        """,
        """
        family: small
        name: Small mill
        document: mill-guide
        title: Small Mill Guide
        machines: [{key: mill, name: Mill}]
        default_machine: mill
        scopes: {global: {instances: [""], label: Control}, axis: {instances: [X, "Y", Z], label: "Axis {i}"}}
        units: {metric: {length: mm}}
        effect: {level: at-once}
        groups: [all]
        """,
    )
    find = machine(schema).situation.find
    assert find("axes.pulses_per_unit@Y") == ("axes.pulses_per_unit", "Y")
    assert find("system.units") == ("system.units", "")
    assert schema.number(("axes.pulses_per_unit", "X"), "mill") is None
    assert schema.short(("axes.pulses_per_unit", "Z"), "mill") == "axes.pulses_per_unit@Z"
    assert schema.label(("axes.pulses_per_unit", "Z"), "mill") == "Pulses/Unit Axis Z"
    for text, said in (
        ("axes.pulses_per_unit", "has @X to @Z"),
        ("axes.pulses_per_unit@A", "has @X to @Z"),
        ("system.units@X", "without '@'"),
        ("axes.pulses@X", "is no parameter of Small mill"),
    ):
        with pytest.raises(UnknownParameter, match=said):
            find(text)


# -- clip, where several of these meet ------------------------------------------------------------------


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
    assert expected == clip(here.situation, ("a.whole", ""), value)
    assert fault(here.situation, ("a.whole", ""), clip(here.situation, ("a.whole", ""), value)) is None
    assert (
        limits(here.situation, ("a.whole", ""), "").low,
        limits(here.situation, ("a.whole", ""), "").high,
    ) == (0.5, 3.5)
