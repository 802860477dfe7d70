"""Active, ignored, hidden, unusable: each with its reason, and right after every edit."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.files import Header, ParameterFile
from amp_studio.schema import (
    ACTIVE,
    Evaluation,
    StateInfo,
    UnknownParameterError,
    Value,
    load_schema,
    program,
    read_address,
)
from tests.campaigns import examples

FOUR = """
  - id: device.kind
    name: Kind
    type: choice
    choices: [{key: none, label: none}, {key: scale, label: scale}, {key: motor, label: motor}]
    help: {what: What is fitted.}
    page: "1"
  - id: device.speed
    name: Speed
    type: real
    help: {what: Only counts for a motor.}
    page: "2"
    states:
      - {state: hidden, when: nothing, page: "2-1"}
      - {state: unusable, when: scale}
      - {state: ignored, unless: fast, page: "2-3"}
  - id: device.limit
    name: Limit
    type: real
    help: {what: The limit.}
    page: "3"
"""
CONDITIONS = """
conditions:
  nothing: {reads: {kind: device.kind}, when: kind == 'none', why: nothing is fitted, page: "1-1"}
  scale: {reads: {kind: device.kind}, when: kind == 'scale', why: a scale has no speed, page: "1-2"}
  fast: {reads: {limit: device.limit}, when: limit > 10.0, why: only above a limit of 10}
"""


@pytest.mark.parametrize(
    ("kind", "limit", "expected"),
    [
        ("none", 99.0, StateInfo("hidden", "nothing is fitted", "2-1")),
        ("scale", 99.0, StateInfo("unusable", "a scale has no speed", "1-2")),
        ("motor", 10.0, StateInfo("ignored", "only above a limit of 10", "2-3")),
        ("motor", 10.5, ACTIVE),
    ],
)
def test_a_parameter_is_in_one_of_four_states_and_says_why(
    facts, head, machine, kind, limit, expected
) -> None:
    schema = facts.schema(FOUR, head + CONDITIONS)
    here = machine(schema, {"device.kind": Value(kind), "device.limit": Value(limit)})
    assert expected == here.evaluation.state(("device.speed", ""))


def test_the_first_rule_that_holds_decides(facts, head, machine) -> None:
    here = machine(
        facts.schema(FOUR, head + CONDITIONS), {"device.kind": Value("scale"), "device.limit": Value(1.0)}
    )
    assert here.evaluation.state(("device.speed", "")).state == "unusable"
    here.set("device.kind", Value("motor"))
    assert here.evaluation.state(("device.speed", "")).state == "ignored"


def test_a_condition_over_an_unset_value_does_not_hold(facts, head, machine) -> None:
    here = machine(facts.schema(FOUR, head + CONDITIONS))
    assert (here.evaluation.is_true("nothing", ""), here.evaluation.is_true("fast", "")) == (False, False)
    assert here.evaluation.state(("device.speed", "")).state == "ignored", "because 'fast' does not hold"


def test_files_with_equal_values_share_their_states_until_one_is_changed(facts, head, machine) -> None:
    schema, values = facts.schema(FOUR, head + CONDITIONS), {"device.kind": Value("motor")}
    one, other = machine(schema, values), machine(schema, values)
    speed = ("device.speed", "")
    assert one.evaluation.known_states() is other.evaluation.known_states()
    one.set("device.kind", Value("scale"))
    assert (one.evaluation.state(speed).state, other.evaluation.state(speed).state) == ("unusable", "ignored")
    one.set("device.kind", Value("motor"))
    assert one.evaluation.known_states() is other.evaluation.known_states(), "as they were before"


def test_what_is_asked_first_after_a_change_is_not_taken_for_the_values_before_it(
    facts, head, machine
) -> None:
    schema, values = facts.schema(FOUR, head + CONDITIONS), {"device.limit": Value(1.0)}
    one, other = machine(schema, values), machine(schema, values)
    one.evaluation.known_states()
    one.set("device.limit", Value(11.0))
    assert one.evaluation.is_true("fast", "")
    assert not other.evaluation.is_true("fast", "")


def test_another_model_is_no_news_for_a_file_with_the_same_values(facts, head, machine) -> None:
    model = "conditions:\n  nothing: {reads: {}, when: application == 'B', why: it is a B}\n"
    schema = facts.schema(
        FOUR.replace("when: scale", "when: nothing").replace("fast", "nothing"), head + model
    )
    one, other = (
        ParameterFile(schema, Header(application="A")),
        ParameterFile(schema, Header(application="A")),
    )
    one.evaluation.known_states()
    one.header.application = "B"
    assert not one.evaluation.is_true("nothing", ""), "it was asked for before"
    one.evaluation.forget()
    assert one.evaluation.is_true("nothing", "")
    assert not other.evaluation.is_true("nothing", "")


def test_a_state_knows_what_can_change_it(facts, head, machine) -> None:
    here = machine(facts.schema(FOUR, head + CONDITIONS))
    assert {("device.kind", ""), ("device.limit", "")} == here.evaluation.state_reads(("device.speed", ""))
    assert set() == here.evaluation.state_reads(("device.limit", ""))


def test_a_condition_may_read_what_this_machine_type_does_not_have(facts, head, machine) -> None:
    schema = facts.schema(
        """
        - id: lathe.kind
          name: Lathe Type
          layouts: [{machines: [lathe], scope: global}]
          type: choice
          choices: [{key: a, label: A}, {key: b, label: B}]
          help: {what: The type of the lathe.}
          page: "1"
        - id: axis.name
          name: Name
          type: integer
          states: [{state: ignored, unless: lathe_a}]
          help: {what: Counts on a lathe of type A.}
          page: "2"
        """,
        head
        + "conditions:\n  lathe_a: {reads: {kind: lathe.kind}, when: kind == 'a', why: only on a lathe A}\n",
    )
    assert machine(schema, machine="mill").evaluation.state(("axis.name", "")).state == "ignored"
    lathe = machine(schema, {"lathe.kind": Value("a")}, machine="lathe")
    assert lathe.evaluation.state(("axis.name", "")) == ACTIVE


def test_readings_before_and_after_an_axis_are_told_apart(facts, head, machine) -> None:
    schema = facts.schema(
        """
        - id: axis.type
          name: Type
          scope: axis
          type: choice
          choices: [{key: linear, label: linear}, {key: none, label: none}]
          states: [{state: ignored, when: gap_before}]
          help: {what: What the axis is.}
          page: "1"
        """,
        head
        + """
conditions:
  gap_before:
    reads: {before: "axis.type@<", all: "axis.type@*", after: "axis.type@>", second: "axis.type@2"}
    when: before.exists(t, t == 'none')
    why: behind a gap
""",
    )
    here = machine(
        schema, {f"axis.type@{n}": Value(t) for n, t in (("1", "linear"), ("2", "none"), ("3", "linear"))}
    )
    states = [here.evaluation.state(("axis.type", n)).state for n in "123"]
    assert states == ["in-force", "in-force", "ignored"]
    for which, axes in (("*", "123"), ("<", "1"), (">", "3"), ("3", "3")):
        read = here.evaluation.reference(f"axis.type@{which}", "2").addresses
        assert read == tuple(("axis.type", n) for n in axes)
    with pytest.raises(UnknownParameterError, match=r"axis\.type has no instance '9'"):
        here.evaluation.reference("axis.type@9", "1")
    here.set("axis.type@2", Value("linear"))
    assert here.evaluation.state(("axis.type", "3")).state == "in-force"


def test_an_expression_with_a_fault_is_refused() -> None:
    with pytest.raises(ValueError, match="loop"):
        program("loop == 'none'")  # a word that CEL keeps for itself


# -- the real family -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "values", "state"),
    [
        ("axis.rollover@2", {"axis.type@2": "linear"}, "hidden"),
        ("axis.rollover@2", {"axis.type@2": "rotary"}, "in-force"),
        ("axis.integrand_name@1", {"axis.type@1": "unfitted"}, "hidden"),
        ("axis.diameter_axis_name", {"control.type": "mill"}, "ignored"),
        ("axis.diameter_axis_name", {"control.type": "lathe"}, "in-force"),
        ("zone.overtravel_positive@1", {"axis.type@1": "linear", "zone.overtravel_used@1": False}, "ignored"),
        ("zone.overtravel_positive@1", {"axis.type@1": "linear", "zone.overtravel_used@1": True}, "in-force"),
        ("servo.output_port@1", {"axis.type@1": "linear", "servo.hardware_type@1": "none"}, "hidden"),
        (
            "servo.output_port@1",
            {"axis.type@1": "linear", "servo.hardware_type@1": "sercos", "servo.loop_type@1": "digital"},
            "in-force",
        ),
        (
            "servo.output_port@1",
            {"axis.type@1": "linear", "servo.hardware_type@1": "sercos", "servo.loop_type@1": "sercos"},
            "ignored",
        ),
    ],
)
def test_a_9pc_parameter_is_out_of_force_for_a_reason(ninepc, machine, name, values, state) -> None:
    here = machine(
        ninepc, {key: Value(value) for key, value in values.items()}, str(values.get("control.type", ""))
    )
    found = here.evaluation.state(read_address(name))
    assert state == found.state
    assert (found.why == "") == (state == "in-force")


def drivers() -> list[str]:
    """Return every parameter of the 9/PC that a condition reads."""
    family = load_schema("9pc").family
    return sorted({read_address(text)[0] for c in family.conditions.values() for text in c.reads.values()})


@st.composite
def edits(draw) -> list[tuple[tuple[str, str], Value | None]]:
    """Draw edits of what conditions read: a choice, a code nobody knows, a number, or nothing at all."""
    schema = load_schema("9pc")
    found = []
    for _ in range(draw(st.integers(1, 12))):
        name = draw(st.sampled_from([*drivers(), "control.type"]))
        parameter = schema.parameter(name)
        address = (name, draw(st.sampled_from(schema.on("mill").instances(parameter))))
        if parameter.type == "boolean":
            values = st.booleans().map(Value)
        elif parameter.choices:
            values = st.sampled_from([Value(c.key) for c in parameter.choices] + [Value("raw:99")])
        else:
            values = st.integers(0, 2).map(Value)
        found.append((address, draw(st.none() | values)))
    return found


@settings(max_examples=examples(40))
@given(edits())
def test_after_any_edits_the_situation_is_that_of_a_fresh_one(changes) -> None:
    schema = load_schema("9pc")
    values: dict[tuple[str, str], Value] = {
        ("axis.type", "1"): Value("linear"),
        ("axis.type", "2"): Value("spindle"),
    }

    def control() -> str:
        kind = values.get(("control.type", ""))
        return str(kind.value) if kind and kind.value in ("mill", "lathe") else "lathe"

    kept = Evaluation(schema, values.get, control)
    watched = [a for a in schema.on("mill").addresses if a[1] in ("", "1", "2")]

    def seen(evaluation: Evaluation) -> list[object]:
        return [(evaluation.state(a), evaluation.unit(a, "metric"), evaluation.canonical(a)) for a in watched]

    seen(kept)
    for address, value in changes:
        if value is None:
            values.pop(address, None)
        else:
            values[address] = value
        kept.forget_dependents(address)
        assert seen(Evaluation(schema, values.get, control)) == seen(kept), address


@settings(max_examples=examples(40))
@given(edits())
def test_only_what_a_state_reads_can_change_it(changes) -> None:
    schema = load_schema("9pc")
    values: dict[tuple[str, str], Value] = {("axis.type", "1"): Value("linear")}
    for address, value in changes:
        evaluation = Evaluation(schema, values.get, lambda: "mill")
        watched = [a for a in schema.on("mill").addresses if a[1] in ("", "1")]
        unread = [a for a in watched if address not in evaluation.state_reads(a)]
        before = {a: evaluation.state(a) for a in unread}
        if value is None:
            values.pop(address, None)
        else:
            values[address] = value
        after = Evaluation(schema, values.get, lambda: "mill")
        assert before == {a: after.state(a) for a in unread}, address


def test_a_condition_may_name_the_model_of_the_control_as_a_rule_may(facts, head) -> None:
    model = "\nconditions:\n  scale: {when: application == 'T', why: the T has no speed}\n"
    model += "  nothing: {when: 'false', why: never}\n  fast: {when: 'true', why: always}\n"
    file = ParameterFile(facts.schema(FOUR, head + model), Header(application="M"))
    assert file.evaluation.state(("device.speed", "")) == ACTIVE
    file.header.application = "T"
    file.evaluation.forget()
    assert file.evaluation.state(("device.speed", "")) == StateInfo("unusable", "the T has no speed")


def test_a_step_that_is_taken_back_takes_back_what_followed_from_the_model(facts, head) -> None:
    model = "\nconditions:\n  scale: {when: application == 'T', why: the T has no speed}\n"
    model += "  nothing: {when: 'false', why: never}\n  fast: {when: 'true', why: always}\n"
    file = ParameterFile(facts.schema(FOUR, head + model), Header(application="M"))

    def change_and_fail() -> None:
        with file.step():
            file.header.application = "T"
            file.evaluation.forget()
            assert file.evaluation.state(("device.speed", "")).state == "unusable"
            raise RuntimeError("the operation broke off")

    with pytest.raises(RuntimeError):
        change_and_fail()
    assert file.evaluation.state(("device.speed", "")) == ACTIVE
