"""What the words of the database must be able to express of registers, as the 57C422B module has them."""

import pytest

from amp_studio.schema import InvalidValueError, Value, fault, field_at, field_value, read_value, with_field

# -- 57C422B: registers ------------------------------------------------------------------------------


REGISTERS = """
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
"""
SMALL = """
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
"""


def test_registers_are_read_on_a_command_and_the_second_axis_lies_2048_higher(facts, machine) -> None:
    schema = facts.schema(REGISTERS, SMALL)
    find, effect = machine(schema).evaluation.find, schema.parameter("gain.proportional").effect
    assert [find("R3"), find("R2051")] == [("gain.proportional", "X"), ("gain.proportional", "Y")]
    assert [find("r11"), find("r2059")] == [("limit.positive", "X"), ("limit.positive", "Y")]
    assert (effect.level, effect.command) == ("command", "change default setups")


def test_words_of_a_register_lie_in_either_order_and_bound_its_value(facts, machine) -> None:
    schema = facts.schema(REGISTERS, SMALL)
    limit, speed = schema.parameter("limit.positive"), schema.parameter("homing.low_speed")
    assert (limit.storage.words, limit.storage.word_order) == (2, "high-first")
    assert speed.storage.word_order == "low-first"
    assert read_value(limit, "2147483647", "counts") == Value(2**31 - 1, "counts")
    assert fault(machine(schema).evaluation, ("limit.positive", "Y"), Value(2**31, "counts")) is not None
    assert schema.units_of(speed) == ("counts/s",)
    assert read_value(speed, "2000 counts/sec", "counts/s") == Value(2000.0, "counts/s")


MODULE = """
family: small
name: Small servo module
document: module-manual
title: Small Servo Module
machines: [{key: module, name: Module}]
default_machine: module
scopes:
  axis: {instances: [X, Y], label: "{i} axis"}
  register: {instances: [X, Y], label: "{i} axis, point {j}", of: axis}
units: {}
effect: {level: at-once}
groups: [all]
"""
CAM = """
- id: cam.points
  name: Number of Points
  scope: axis
  numbers: {start: 128, step: 2048, format: "R{n}"}
  type: integer
  storage: {bits: 16}
  help: {what: How many points the table has.}
  page: "4-54"
- id: cam.data
  name: Cam Data
  scope: register
  instances: ["X.0..1914", "Y.0..1914"]
  numbers: {starts: {X: 132, Y: 2180}, step: 1, format: "R{n}"}
  type: integer
  storage: {bits: 16}
  states: [{state: hidden, unless: point_used}]
  help: {what: Travel of a step.}
  page: "4-57"
- id: cam.pairs
  name: Cam Pairs
  scope: register
  instances: ["X.0..2", "Y.0..2"]
  numbers: {starts: {X: 132, Y: 2180}, step: 2, format: "P{n}"}
  type: bits
  bits: [{bit: 0, width: 8, label: First, signed: true}, {bit: 8, width: 8, label: Second, signed: true}]
  storage: {bits: 16, signed: false, notation: hex}
  help: {what: Two values in a word.}
  page: "4-49"
"""
POINT_USED = """
conditions:
  point_used: {reads: {points: cam.points}, when: part < points, why: only the points that are counted}
"""


def test_the_points_of_a_table_are_parts_of_their_axis(facts, machine) -> None:
    schema = facts.schema(CAM, MODULE + POINT_USED)
    here = machine(schema, {"cam.points@Y": Value(3)})
    find, state = here.evaluation.find, here.evaluation.state
    assert [find(n) for n in ("R132", "R2046", "R2180", "R4094")] == [
        ("cam.data", i) for i in ("X.0", "X.1914", "Y.0", "Y.1914")
    ]
    assert [find(n) for n in ("P132", "P136", "P2182")] == [("cam.pairs", i) for i in ("X.0", "X.2", "Y.1")]
    states = {i: state(("cam.data", i)).state for i in ("Y.0", "Y.2", "Y.3", "X.0")}
    assert [i for i, found in states.items() if found == "in-force"] == ["Y.0", "Y.2"]
    here.set("cam.points@X", Value(1))
    assert [state(("cam.data", i)).state for i in ("X.0", "X.1")] == ["in-force", "hidden"]
    assert schema.on("module").label(("cam.data", "Y.7")) == "R2187 Cam Data"
    assert schema.on("module").instance_label(("cam.data", "Y.7")) == "Y axis, point 7"
    assert len(here.evaluation.reference("cam.data@.", "Y", "axis").addresses) == 1915


def test_a_field_of_a_word_may_hold_a_number_with_its_sign(facts) -> None:
    parameter = facts.schema(CAM, MODULE + POINT_USED).parameter("cam.pairs")
    word = with_field(field_at(parameter, 8), with_field(field_at(parameter, 0), 0, "-1"), "-128")
    assert word == 0x80FF
    assert [field_value(field_at(parameter, n), word) for n in (0, 8)] == [-1, -128]
    assert with_field(field_at(parameter, 8), word, "127") == 0x7FFF
    for text in ("128", "-129", "x"):
        with pytest.raises(InvalidValueError, match="First, which takes -128 to 127"):
            with_field(field_at(parameter, 0), 0, text)


def test_a_value_has_to_fit_the_words_of_the_control(facts, machine) -> None:
    schema = facts.schema(
        """
        - id: move.speed
          name: Command Velocity
          scope: axis
          type: real
          unit: counts/s
          ranges: {counts/s: [null, 65536000]}
          storage: {unit: counts/s, scale: 65.536, bits: 32, words: 2}
          help: {what: Speed of a move.}
          page: "4-13"
        - id: move.points
          name: Points
          scope: axis
          type: integer
          storage: {bits: 16, signed: false}
          help: {what: How many.}
          page: "4-54"
        """,
        MODULE,
    )
    here = machine(schema).evaluation
    for parameter_id, value, allowed in (
        ("move.speed", Value(32767999.9, "counts/s"), True),
        ("move.speed", Value(32768000.0, "counts/s"), False),
        ("move.speed", Value(-32768000.0, "counts/s"), True),
        ("move.points", Value(65535), True),
        ("move.points", Value(65536), False),
        ("move.points", Value(-1), False),
    ):
        assert (fault(here, (parameter_id, "X"), value) is None) is allowed, value


def test_what_can_only_be_read_is_not_set_and_not_asked_for(facts, machine) -> None:
    schema = facts.schema(
        """
        - id: status.fault
          name: Fault
          scope: axis
          numbers: {start: 73, step: 2048, format: "R{n}"}
          type: bits
          bits: [{bit: 5, label: Velocity error}]
          storage: {bits: 16, signed: false, notation: hex}
          access: read
          help: {what: Faults of the axis.}
          page: "4-37"
        - id: status.reset
          name: Reset
          scope: axis
          type: integer
          help: {what: Takes the faults back.}
          page: "4-37"
        """,
        MODULE,
    )
    here = machine(schema).evaluation
    assert here.state(("status.fault", "X")).state == "unusable"
    assert "only be read" in here.state(("status.fault", "X")).why
    assert "only be read" in str(fault(here, ("status.fault", "X"), Value(0)))
    assert here.state(("status.reset", "X")).state == "in-force"
