"""What else the words must be able to say: long tables, commands that set a value,
and the unit of bare figures.
"""

import pytest

from amp_studio.schema import DatabaseError

FILTER = """
  - id: notch.frequency
    name: Frequency
    scope: axis
    type: real
    unit: Hz
    storage: {command: "NOTCH {i}({notch.frequency}, {notch.width})"}
    help: {what: What is taken out.}
    page: "1"
  - id: notch.width
    name: Width
    scope: axis
    type: real
    unit: Hz
    storage: {command: "NOTCH {i}({notch.frequency}, {notch.width})"}
    help: {what: How much beside it.}
    page: "1"
"""
OFFSETS = """
  - id: tool.radius
    name: Radius
    instances: ["0", "1..400", last]
    each: R{i}
    type: real
    quantity: length
    optional: true
    help: {what: Radius of each tool.}
    page: "1"
"""


def test_a_span_of_instances_is_counted_out(facts) -> None:
    schema = facts.schema(OFFSETS)
    instances = schema.on("mill").instances(schema.parameter("tool.radius"))
    assert (len(instances), instances[:3], instances[-2:]) == (402, ("0", "1", "2"), ("400", "last"))


def test_a_value_knows_the_command_that_sets_it(facts) -> None:
    schema = facts.schema(FILTER)
    storage = schema.parameter("notch.width").storage
    assert storage is not None
    assert storage.command == "NOTCH {i}({notch.frequency}, {notch.width})"


def test_a_command_of_a_parameter_that_does_not_exist_is_reported(facts) -> None:
    with pytest.raises(
        DatabaseError, match=r"all\.yaml, line \d+: notch\.frequency: there is no .*'notch\.depth'"
    ):
        facts.schema(FILTER.replace("{notch.width}", "{notch.depth}", 1))


def test_the_unit_of_bare_figures_is_named_by_a_parameter_that_exists(facts, head) -> None:
    with pytest.raises(DatabaseError, match=r"family\.yaml, line \d+: there is no parameter 'system\.units'"):
        facts.schema(FILTER, head + "unit_parameter: system.units\n")


def test_a_checksum_knows_the_commands(facts) -> None:
    first = facts.schema(FILTER).signature
    assert facts.schema(FILTER.replace("NOTCH", "NOTCH2")).signature != first
