"""What else the words of the database must be able to say: words, bits and registers,
and fields without a number.

NUM keeps arrays of typed words, the 57C422B module registers, Syntec pairs of numbers, AcroMill names only.
"""

import pytest

from amp_studio.schema import (
    DatabaseError,
    InvalidValueError,
    UnknownParameterError,
    Value,
    fault,
    field_at,
    field_value,
    read_value,
    with_field,
    write_value,
)

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
    assert len(schema.on("mill").addresses) == 32
    assert ("servo.gain", "3") == here.evaluation.find("P21N3") == here.evaluation.find("p21n3")
    assert here.evaluation.find("P21N31") == ("servo.gain", "31")
    assert schema.on("mill").label(("servo.gain", "3")) == "P21N3 Servo-System Loop Gain"
    assert fault(here.evaluation, ("servo.gain", "31"), Value(-32768)) is None
    assert fault(here.evaluation, ("servo.gain", "31"), Value(32768)) is not None
    with pytest.raises(UnknownParameterError, match="Unknown parameter 'P21N32'"):
        here.evaluation.find("P21N32")


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
    assert fault(here.evaluation, ("axes.displayed", "0"), Value(0xFFFFFFFF)) is None
    assert "does not fit its 32 bits" in str(fault(here.evaluation, ("axes.displayed", "0"), Value(2**32)))
    assert "does not fit its 32 bits" in str(fault(here.evaluation, ("axes.displayed", "0"), Value(-1)))


def test_a_word_in_hexadecimal_is_not_guessed_from_digits_that_mean_two_numbers(mask) -> None:
    """NUM P10: the manual prints 00000044 for bits 2 and 6 (page 5-4)."""
    parameter = mask.parameter("axes.displayed")
    with pytest.raises(InvalidValueError, match="'00000044' can be read two ways: write 0x00000044 or 44"):
        read_value(parameter, "00000044", "")
    assert read_value(parameter, "00000001", "") == Value(1), "the same either way"
    assert read_value(parameter, "44", "") == Value(44)
    with pytest.raises(InvalidValueError, match="'7F' is not a decimal number: write 0x7F"):
        read_value(parameter, "7F", "")


def test_a_bit_of_a_mask_is_addressed_and_changed_by_itself(mask, machine) -> None:
    here, parameter = machine(mask), mask.parameter("axes.displayed")
    assert here.evaluation.find_bit("P3N0.5") == (("axes.displayed", "0"), 5)
    assert here.evaluation.find_bit("axes.displayed@0.5") == (("axes.displayed", "0"), 5)
    assert here.evaluation.find_bit("P3N0") == (("axes.displayed", "0"), None)
    assert with_field(field_at(parameter, 5), 0b000011, "yes") == 0b100011
    assert with_field(field_at(parameter, 0), 0b000011, "0") == 0b000010
    with pytest.raises(InvalidValueError, match="bits 0 to 31, not 32"):
        field_at(parameter, 32)
    with pytest.raises(InvalidValueError, match="Axis 3, which takes 0 to 1"):
        with_field(field_at(parameter, 3), 0, "2")


@pytest.mark.parametrize("text", ["P3N1.5", "P3N0.x", "P3N0.", "1.5"])
def test_what_is_no_bit_of_a_word_is_refused_as_it_was_written(mask, machine, text: str) -> None:
    with pytest.raises(UnknownParameterError, match=rf"Unknown parameter '{text}'"):
        machine(mask).evaluation.find_bit(text)


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
    find = machine(schema).evaluation.find
    assert [find("P11N6"), find("P11N7")] == [("measure.multi", "3"), ("measure.divi", "3")]
    assert [find("P11N0"), find("P11N1")] == [("measure.multi", "0"), ("measure.divi", "0")]


def test_a_word_may_hold_a_code_in_each_nibble(facts, machine) -> None:
    codes = (
        "[{key: none, label: none, raw: 0}, {key: sin, label: sine wave, raw: 1}, {key: ssi, label: SSI,"
        " raw: 8}]"
    )
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
    assert fault(here.evaluation, address, Value(0xF081)) is None
    assert (
        fault(here.evaluation, address, Value(0xF021)) == "2 is no code of Axis 1 in Sensors of Axes 0 to 3"
    )
    assert (
        with_field(field_at(parameter, 8), with_field(field_at(parameter, 4), 0xF081, "Sine  Wave"), "ssi")
        == 0xF811
    )


def test_fields_of_many_bits_share_a_long_word_with_unknown_bits(facts, machine) -> None:
    """NUM P34: each long word an axis contains the contents of two registers (page 5-18)."""
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
            - {bit: 16, width: 3, label: Clock,
               choices: [{key: slow, label: slow, raw: 0}, {key: fast, label: fast, raw: 5}]}
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
    assert fault(here.evaluation, ("sensor.registers", "1"), Value(changed)) is None
    assert field_at(parameter, 20).unknown, "a bit that the database does not name can still be read"
    with pytest.raises(InvalidValueError, match="Length of the frame, which takes 0 to 31"):
        with_field(field_at(parameter, 0), word, "32")


SERVOED = """
- id: axes.servoed
  name: Servo-Controlled Axes
  numbers: {format: P3N0}
  type: bits
  storage: {bits: 32, signed: false, notation: hex, code: 6}
  help: {what: One bit for each axis that is controlled.}
  page: "4-14"
- id: sensor.kind
  name: Sensor
  scope: axis
  numbers: {format: "P34N{i}"}
  type: bits
  help: {what: The sensor of each axis.}
  page: "5-18"
- id: sensor.graduation
  name: Graduation
  scope: axis
  numbers: {format: "P36N{i}"}
  type: integer
  states: [{state: hidden, unless: servoed}, {state: ignored, unless: graduated}]
  help: {what: The graduation of the scale of each axis.}
  page: "5-22"
"""
SERVOED_CONDITIONS = """
conditions:
  servoed: {reads: {servoed: axes.servoed}, when: "bit(servoed, double(instance))", why: it is controlled}
  graduated: {reads: {kind: sensor.kind}, when: "field(kind, 25.0, 2.0) in [2.0, 3.0]", why: it is graduated}
"""


def test_a_condition_may_ask_for_a_bit_or_a_field_of_a_word(facts, machine) -> None:
    """NUM P21 counts for axes whose bit of P3 is set; P36 for some of the types in bits 25 and 26 of P34."""
    schema = facts.schema(SERVOED, NUM + SERVOED_CONDITIONS)
    assert schema.parameter("axes.servoed").storage.code == 6
    values = {"axes.servoed": Value(0x80000004), "sensor.kind@2": Value(0x04000000)}
    here = machine(schema, values)
    states = [here.evaluation.state(("sensor.graduation", axis)).state for axis in "0123"]
    assert states == ["hidden", "hidden", "in-force", "hidden"]
    here.set("sensor.kind@2", Value(0x02000000))
    assert here.evaluation.state(("sensor.graduation", "2")).state == "ignored"
    here.set("axes.servoed", Value(0x80000008))
    states = [here.evaluation.state(("sensor.graduation", axis)).state for axis in "23"]
    assert states == ["hidden", "ignored"], "axis 3 has no sensor yet"


def test_a_condition_that_calls_what_is_no_function_is_reported(facts) -> None:
    conditions = """
conditions:
  odd: {reads: {word: axes.word}, when: "bits(word, 0.0)", why: it is odd}
"""
    with pytest.raises(
        DatabaseError, match=r"family\.yaml, line \d+: condition odd calls 'bits', which is no function"
    ):
        facts.schema(
            """
            - id: axes.word
              name: Word
              type: bits
              help: {what: A word.}
              page: "1-1"
            """,
            NUM + conditions,
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
    find = machine(schema).evaluation.find
    expected = [("gear.screw", "1"), ("gear.motor", "1"), ("gear.screw", "2"), ("gear.motor", "3")]
    assert expected == [find(number) for number in ("Pr121", "Pr122", "Pr123", "pr126")]
    levels = [
        (schema.parameter(name).effect or schema.family.effect).level for name in ("gear.screw", "gear.motor")
    ]
    assert levels == ["reset", "restart"], "what is not said of a parameter is said of the family"


UNNUMBERED = """
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
"""
SMALL_MILL = """
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
"""


def test_a_field_may_have_no_number_at_all(facts, machine) -> None:
    schema = facts.schema(UNNUMBERED, SMALL_MILL)
    find = machine(schema).evaluation.find
    assert find("axes.pulses_per_unit@Y") == ("axes.pulses_per_unit", "Y")
    assert find("system.units") == ("system.units", "")
    assert schema.on("mill").number(("axes.pulses_per_unit", "X")) is None
    assert schema.on("mill").short(("axes.pulses_per_unit", "Z")) == "axes.pulses_per_unit@Z"
    assert schema.on("mill").label(("axes.pulses_per_unit", "Z")) == "Pulses/Unit Axis Z"
    for text, message in (
        ("axes.pulses_per_unit", "has @X to @Z"),
        ("axes.pulses_per_unit@A", "has @X to @Z"),
        ("system.units@X", "without '@'"),
        ("axes.pulses@X", "Unknown parameter 'axes.pulses@X'. Did you mean: axes.pulses_per_unit@X"),
    ):
        with pytest.raises(UnknownParameterError, match=message):
            find(text)
