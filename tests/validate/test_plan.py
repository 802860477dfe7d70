"""What a rule reads: which instances it runs for, what it gets of other scopes, and what cannot be meant."""

from dataclasses import replace
from pathlib import Path
from textwrap import dedent

import pytest

from amp_studio.files import ParameterFile
from amp_studio.schema import Evaluation, Rule, Schema, Value, family_ids, load_schema
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import compile_family
from amp_studio.validate import BuilderRules, Validator
from amp_studio.validate.expressions import RuleError, check_rule
from amp_studio.validate.functions import rule_functions
from amp_studio.validate.plan import checks_of, make_plan

FAMILY = """
family: small
name: Small control
document: small-manual
title: Small Manual
machines: [{key: mill, name: Mill}, {key: lathe, name: Lathe}]
default_machine: mill
scopes:
  global: {instances: [""], label: Control}
  axis: {instances: ["1", "2", "3"], label: "Axis {i}"}
  process: {instances: ["", "1", "2"], label: "Process {i}"}
  spindle: {instances: ["1", "2"], label: "Spindle {i}"}
units: {metric: {length: mm, velocity: mm/min}, inch: {length: in, velocity: in/min}}
effect: {level: restart}
groups: [all]
conditions:
  parked: {reads: {kind: axis.kind}, when: kind == 'parked', why: the axis is parked}
"""

GROUP = """
key: all
name: All
chapter: "1"
parameters:
  - {id: control.top, name: Top, type: real, quantity: length, help: {what: The top.}, page: "1"}
  - {id: axis.length, name: Length, scope: axis, type: real, quantity: length, help: {what: Its length.},
     page: "1", ranges: {mm: [0, {param: axis.room}]}, states: [{state: ignored, when: parked}]}
  - {id: axis.room, name: Room, scope: axis, type: real, quantity: length, help: {what: Its room.}, page: "1"}
  - {id: axis.kind, name: Kind, scope: axis, type: choice, help: {what: Its kind.}, page: "1",
     choices: [{key: moving, label: Moving}, {key: parked, label: Parked}]}
  - {id: process.groups, name: Groups, scope: process, type: integer, help: {what: How many.}, page: "1"}
  - {id: spindle.speed, name: Speed, scope: spindle, type: real, help: {what: How fast.}, page: "1"}
  - {id: lathe.only, name: Only on a lathe, type: real, help: {what: A lathe's.}, page: "1",
     layouts: [{machines: [lathe], scope: axis}]}
"""


@pytest.fixture(scope="module")
def small(tmp_path_factory) -> Schema:
    """Return a family with scopes whose instances have the same names."""
    folder: Path = tmp_path_factory.mktemp("small")
    (folder / "groups").mkdir()
    (folder / "family.yaml").write_text(dedent(FAMILY), encoding="utf-8")
    (folder / "groups" / "all.yaml").write_text(dedent(GROUP), encoding="utf-8")
    return schema_of(compile_family(folder))


def rule(reads: dict[str, str], check: str = "true", **more: object) -> Rule:
    """Return a rule with nothing in it that a test does not name."""
    plain = {
        "id": "own.rule",
        "title": "Ours",
        "severity": "warning",
        "message": "It is broken.",
        "page": "1",
    }
    return Rule.model_validate({**plain, "reads": reads, "check": check, **more})


def seen(schema: Schema, reads: dict[str, str], machine: str = "mill") -> dict[str, dict[str, object]]:
    """Return instance -> name -> the instances a rule reads there."""
    evaluation = Evaluation(schema, lambda _: None, lambda: machine)
    return {
        check.instance: (
            {s.name: s.address[1] for s in check.singles}
            | {name: [a[1] for a in listed.addresses] for name, listed in check.lists}
        )
        for check in checks_of(evaluation, (rule(reads),))
    }


# ----------------------------------------------------------------------------------- which instances


def test_a_rule_over_one_axis_parameter_runs_for_every_axis(small) -> None:
    assert seen(small, {"length": "axis.length", "top": "control.top"}) == {
        axis: {"length": axis, "top": ""} for axis in ("1", "2", "3")
    }


@pytest.mark.parametrize("order", [1, -1])
def test_axis_one_is_not_taken_for_process_one(small, order: int) -> None:
    reads = dict(list({"length": "axis.length", "groups": "process.groups"}.items())[::order])
    assert seen(small, reads) == {axis: {"length": axis, "groups": ""} for axis in ("1", "2", "3")}


def test_a_rule_over_a_process_parameter_alone_runs_for_every_process(small) -> None:
    assert seen(small, {"groups": "process.groups", "lengths": "axis.length@*"}) == {
        process: {"groups": process, "lengths": ["1", "2", "3"]} for process in ("", "1", "2")
    }


def test_a_rule_over_lists_runs_once(small) -> None:
    assert seen(small, {"lengths": "axis.length@*", "groups": "process.groups@*"}) == {
        "": {"lengths": ["1", "2", "3"], "groups": ["", "1", "2"]}
    }


def test_before_and_after_are_those_of_the_axis_at_hand(small) -> None:
    assert seen(small, {"before": "axis.length@<", "after": "axis.length@>"}) == {
        "1": {"before": [], "after": ["2", "3"]},
        "2": {"before": ["1"], "after": ["3"]},
        "3": {"before": ["1", "2"], "after": []},
    }


def test_one_instance_can_be_named(small) -> None:
    assert seen(small, {"second": "axis.length@2", "groups": "process.groups@1"}) == {
        "": {"second": "2", "groups": "1"}
    }


def test_a_rule_does_not_run_where_what_it_reads_does_not_exist(small) -> None:
    reads = {"own": "lathe.only", "length": "axis.length"}
    assert seen(small, reads, "mill") == {}
    assert list(seen(small, reads, "lathe")) == ["1", "2", "3"]


def test_scopes_that_do_not_go_together_are_a_fault(small) -> None:
    with pytest.raises(
        RuleError, match=r"rule own.rule: reads axis.length and spindle.speed, whose instances"
    ):
        seen(small, {"length": "axis.length", "speed": "spindle.speed"})


@pytest.mark.parametrize("machine", ["mill", "lathe"])
def test_a_zone_group_is_kept_against_the_groups_of_a_single_process(machine: str) -> None:
    schema = load_schema("9pc")
    (rule,) = (rule for rule in schema.rules if rule.id == "9pc.zone.group-not-checked")
    found = seen(schema, rule.reads, machine)
    assert found == {str(axis): {"group": str(axis), "count": ""} for axis in range(1, 9)}


def test_every_rule_of_the_family_runs_somewhere() -> None:
    schema = load_schema("9pc")
    running = {check.rule.id for machine in ("mill", "lathe") for check in make_plan(schema, machine).checks}
    assert running == {rule.id for rule in schema.rules}


# --------------------------------------------------------------------------------------- who reads what


def test_a_check_runs_again_for_what_it_reads_and_what_decides_its_state(small) -> None:
    plan = make_plan(small, "mill", (rule({"length": "axis.length"}, "length > 1.0"),))
    readers = {
        address for address, checks in plan.rule_readers.items() if any(c.instance == "2" for c in checks)
    }
    assert readers == {("axis.length", "2"), ("axis.kind", "2")}


def test_a_range_is_checked_again_for_its_bound_and_its_state(small) -> None:
    plan = make_plan(small, "mill")
    readers = {address for address, read in plan.range_readers.items() if ("axis.length", "2") in read}
    assert readers == {("axis.length", "2"), ("axis.kind", "2"), ("axis.room", "2")}


def test_a_fix_is_looked_at_again_when_its_bound_moves(small) -> None:
    own = rule({"length": "axis.length"}, "length >= 5.0", fix=[{"set": "length", "value": "5.0"}])
    file = ParameterFile(small)
    validator = Validator(file, BuilderRules((own,)))
    validator.run()
    file.set(("axis.length", "1"), Value(1.0, "mm"))
    file.set(("axis.room", "1"), Value(2.0, "mm"))
    (finding,) = (
        f for f in validator.update([("axis.length", "1"), ("axis.room", "1")]) if f.rule == "own.rule"
    )
    assert finding.fix == (), "5 mm is more than its room"
    file.set(("axis.room", "1"), Value(6.0, "mm"))
    (finding,) = (f for f in validator.update([("axis.room", "1")]) if f.rule == "own.rule")
    assert [setting.value for setting in finding.fix] == [Value(5.0, "mm")]


def test_the_plan_of_a_family_is_made_once(small) -> None:
    assert make_plan(small, "mill") is make_plan(small, "mill")
    length, width = rule(LENGTH), rule(LENGTH, title="Width")
    assert make_plan(small, "mill", (length,)) is make_plan(small, "mill", (length.model_copy(),))
    assert make_plan(small, "mill", (length,)) is not make_plan(small, "mill", (width,))


# ------------------------------------------------------------------------------- rules that cannot be meant

LENGTH = {"length": "axis.length"}


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        (rule({"x": "axis.missing"}), "reads 'axis.missing', which the family does not have"),
        (rule({"x": "axis.length@9"}), "reads 'axis.length@9', but Length has no instance '9'"),
        (rule(LENGTH, "length > "), "check: Failed to parse expression"),
        (rule(LENGTH, "lenght > 1.0"), "check names 'lenght', which it does not read"),
        (rule(LENGTH, when="kind == 'moving'"), "when names 'kind', which it does not read"),
        (rule(LENGTH, "maximum(length, 1.0) > 1.0"), "check calls 'maximum', which is no function"),
        (rule(LENGTH, values={"twice": "size * 2.0"}), "value twice names 'size', which it does not read"),
        (
            rule(LENGTH, fix=[{"set": "length", "value": "other"}]),
            "fix of length names 'other', which it does not read",
        ),
        (
            rule(LENGTH, fix=[{"set": "room", "value": "1.0"}]),
            "it sets 'room', which is no single value it reads",
        ),
        (
            rule({"all": "axis.length@*"}, fix=[{"set": "all", "value": "1.0"}]),
            "it sets 'all', which is no single value",
        ),
        (rule(LENGTH, optional=["room"]), "optional names 'room', which it does not read"),
        (rule(LENGTH, any_state=["room"]), "any_state names 'room', which it does not read"),
        (rule(LENGTH, units={"twice": "mm"}), "units names 'twice', which is not one of its values"),
        (rule(LENGTH, values={"twice": "length * 2.0"}, units={"twice": "ell"}), "'ell' is no unit"),
        (
            rule(LENGTH, message="{lenght} is short."),
            "the message shows '{lenght}', which is neither read nor",
        ),
        (
            rule(LENGTH, message="{length:.2f} is short."),
            "the message shows '{length:.2f}', which is neither",
        ),
        (rule(LENGTH, message="{length is short."), "message: expected '}' before end of string"),
        (rule(LENGTH, message="{} is short."), "the message shows '{}', which is neither"),
    ],
    ids=lambda given: given if isinstance(given, str) else "",
)
def test_a_rule_that_cannot_be_understood_is_refused(small, wrong: Rule, sentence: str) -> None:
    with pytest.raises(RuleError) as caught:
        Validator(ParameterFile(small), BuilderRules((wrong,)))
    assert str(caught.value).startswith(f"rule own.rule: {sentence}")
    assert caught.value.rule == "own.rule"


def test_two_rules_of_one_name_are_refused(small) -> None:
    with pytest.raises(RuleError, match=r"rule own.rule: there are two rules of this name"):
        make_plan(small, "mill", (rule(LENGTH), rule(LENGTH)))


def test_what_a_rule_may_say(small) -> None:
    """Names of lists, of the machine and the instance, types and functions of CEL, and a comment at the
    end.
    """
    own = rule(
        {"lengths": "axis.length@*", "length": "axis.length"},
        "lengths.all(l, l == null || min(l, 2.0) < 3.0) // of every axis",
        when="machine == 'mill' && instance != '3' && type(length) == double // of two axes",
        values={"count": "size(lengths.filter(l, l != null))"},
        message="{count} axes; axis {instance} of the {machine} is {length}, all {lengths}.",
    )
    file = ParameterFile(small)
    file.set(("axis.length", "2"), Value(5.0, "mm"))
    findings = [
        finding for finding in Validator(file, BuilderRules((own,))).run() if finding.rule == "own.rule"
    ]
    assert findings == [], "the smaller of 5 and 2 is below 3"

    broken = own.model_copy(update={"check": own.check.replace("3.0", "2.0")})
    (finding,) = (f for f in Validator(file, BuilderRules((broken,))).run() if f.rule == "own.rule")
    assert finding.message == "1 axes; axis 2 of the mill is 5 mm, all not set, 5 mm, not set."


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        (rule(LENGTH, "lenght > 1.0"), "check names 'lenght', which it does not read"),
        (rule(LENGTH, "greatest(length) > 1.0"), "check calls 'greatest', which is no function"),
        (rule(LENGTH, "length >> 1.0"), "check: "),
        (rule(LENGTH, "length > 9.0", message="{lenght} is short."), "the message shows '{lenght}'"),
    ],
    ids=lambda given: given if isinstance(given, str) else "",
)
def test_a_rule_of_the_family_that_cannot_be_understood_is_refused_when_it_is_first_decided(
    small, wrong: Rule, sentence: str
) -> None:
    """Its expressions are compiled late, but a slip in them is never taken for a rule that is satisfied."""
    faulty = replace(small, rules=(wrong,))
    file = ParameterFile(faulty)
    file.set(("axis.length", "2"), Value(5.0, "mm"))
    with pytest.raises(RuleError) as caught:
        Validator(file).run()
    assert str(caught.value).startswith(f"rule own.rule: {sentence}")


@pytest.mark.parametrize("family", family_ids())
def test_every_rule_of_every_family_can_be_used(family: str) -> None:
    functions = rule_functions(family)
    for one in load_schema(family).rules:
        check_rule(one, functions)
