"""States that a group has once for all its parameters, and lists that the family has once."""

import pytest

from amp_studio.schema import DatabaseError, Value
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import Compiled, compile_family
from amp_studio.schema.model.compiled_json import record_text, text_record

FACTS = """
- {id: a.speed, name: Speed, scope: axis, type: real, help: {what: How fast.}, page: "1",
   states: [{state: ignored, when: slow, page: "7"}]}
- {id: a.ramp, name: Ramp, scope: axis, type: real, help: {what: How steep.}, page: "1"}
- {id: a.count, name: Count, type: integer, help: {what: How many.}, page: "1"}
- id: a.both
  name: Both
  type: real
  layouts: [{machines: [mill], scope: axis}, {machines: [lathe], scope: global}]
  help: {what: On both.}
  page: "1"
"""
CONDITIONS = """
conditions:
  slow: {reads: {speed: a.speed}, when: speed < 1.0, why: too slow}
  absent: {reads: {count: a.count}, when: count == 0.0, why: not there}
  parked: {reads: {count: a.count}, when: count == 9.0, why: parked}
"""
STATES = """
states:
  - {state: hidden, when: absent, page: "3", scope: axis}
  - {state: hidden, when: parked, not_for: [a.ramp, a.count, a.both]}
last_states:
  - {state: unusable, unless: parked, scope: global}
"""


@pytest.fixture
def compiled(facts, head):
    """Return what compiles the small family, with lines before the parameters of its group."""

    def compile_with(before: str, parameters: str = FACTS, family: str = head + CONDITIONS) -> Compiled:
        facts.write("family.yaml", family)
        facts.write("groups/all.yaml", f'key: all\nname: All\nchapter: "1"\n{before}parameters:{parameters}')
        return compile_family(facts.folder)

    return compile_with


def states(family: Compiled, parameter: str) -> list[tuple[str, str, str | None]]:
    """Return the states of a parameter in their order."""
    found = schema_of(family).parameters[parameter].states
    return [(s.state, s.when or f"unless {s.unless}", s.page) for s in found]


def test_a_parameter_has_the_states_of_its_group_around_its_own(compiled) -> None:
    family = compiled(STATES)
    first, second, own = ("hidden", "absent", "3"), ("hidden", "parked", None), ("ignored", "slow", "7")
    last = ("unusable", "unless parked", None)
    assert states(family, "a.speed") == [first, second, own]
    assert states(family, "a.ramp") == [first]
    assert states(family, "a.count") == [last]
    assert states(family, "a.both") == [first, last], "it has both scopes, each on one machine type"


def test_states_of_the_group_are_the_same_as_states_written_out(compiled) -> None:
    once = compiled('states:\n  - {state: hidden, when: absent, page: "3", not_for: [a.count, a.both]}\n')
    out = FACTS.replace("states: [", 'states: [{state: hidden, when: absent, page: "3"}, ')
    out = out.replace("How steep.}", 'How steep.}, states: [{state: hidden, when: absent, page: "3"}]')
    assert once.model_dump() == compiled("", out).model_dump()


def test_a_family_from_the_cache_has_the_states_of_its_groups_once(compiled) -> None:
    family = compiled(STATES)
    again = text_record(record_text(family))
    assert again.groups[0].parameters == family.groups[0].parameters


def test_the_first_state_that_contains_decides_also_where_one_is_of_the_group(compiled, machine) -> None:
    schema = schema_of(compiled(STATES))
    for count, state in ((0, "hidden"), (2, "ignored")):
        values = {"a.count": Value(float(count)), "a.speed@1": Value(0.5)}
        assert machine(schema, values).evaluation.state(("a.speed", "1")).state == state


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("when: absent", "when: absnt", 6, "there is no condition 'absnt'"),
        ("unless: parked", "unless: parkd", 9, "there is no condition 'parkd'"),
        ("scope: axis", "scope: spindle", 6, "no parameter here has scope 'spindle'"),
        ("a.count, a.both", "a.count, a.boat", 7, "there is no parameter 'a.boat' here"),
    ],
)
def test_a_fault_in_a_state_of_a_group_is_reported_in_its_line(compiled, old, new, line, message) -> None:
    assert old in STATES
    with pytest.raises(DatabaseError) as refused:
        compiled(STATES.replace(old, new, 1))
    assert (refused.value.line, message in refused.value.what) == (line, True)


def test_a_fault_in_an_own_state_is_reported_in_its_line_whatever_the_group_shows(compiled) -> None:
    with pytest.raises(DatabaseError) as refused:
        compiled(STATES, FACTS.replace("when: slow", "when: slo"))
    assert refused.value.what == "a.speed: there is no condition 'slo'"
    assert refused.value.line == 12


LISTS = """
choice_lists:
  answer: [{key: "yes", label: Aye}, {key: "no", label: Nay}]
bit_lists:
  lamps: [{bit: 0, label: Red}, {bit: 1, label: Green}]
"""
LISTED = """
- {id: a.ask, name: Ask, type: boolean, choices: answer, help: {what: Whether.}, page: "1"}
- {id: a.lamps, name: Lamps, type: bits, bits: lamps, help: {what: Which.}, page: "1"}
- id: a.field
  name: Field
  type: bits
  bits: [{bit: 3, label: Asked, choices: answer}]
  help: {what: Field.}
  page: "1"
"""


def test_a_list_of_the_family_is_for_itself_by_its_name(compiled, head) -> None:
    family = compiled("", LISTED, head + LISTS)
    ask, lamps, field = family.groups[0].parameters
    assert [c.label for c in ask.choices] == ["Aye", "Nay"]
    assert [(b.bit, b.label) for b in lamps.bits] == [(0, "Red"), (1, "Green")]
    assert field.bits[0].choices == ask.choices
    again = text_record(record_text(family))
    assert again.groups == family.groups


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "boolean, choices: answer",
            "boolean, choices: anser",
            "a.ask: choices: there is no choice list 'anser'",
        ),
        ("bits: lamps", "bits: answer", "a.lamps: bits: there is no bit list 'answer'"),
    ],
)
def test_a_name_of_no_list_is_reported_with_the_parameter(compiled, head, old, new, message) -> None:
    assert old in LISTED
    with pytest.raises(DatabaseError) as refused:
        compiled("", LISTED.replace(old, new), head + LISTS)
    assert refused.value.what == message
