"""A file of a builder's rules costs in proportion to its length, and no rule in it can take the program
down.
"""

import json
import sys
from pathlib import Path

import pytest
from rule_machines import FAMILIES

from amp_studio.files import Change, ParameterFile
from amp_studio.schema import Value, load_schema
from amp_studio.validate import Finding, Validator, explain, read_builder_rules, rule_file, trial
from amp_studio.validate.functions import GENERAL
from amp_studio.validate.plan import make_plan
from amp_studio.validate.rule_file import MAX_FAULTS
from tests.campaigns import some


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Return where the rules of a builder lie."""
    return tmp_path / "rules.yaml"


def rule(n: int, check: str = "rapid <= 10000.0", reads: str = "rapid: feedrate.rapid") -> str:
    """Return one rule."""
    return f"""
  - id: works.rule{n}
    title: Rule {n}
    severity: warning
    reads: {{{reads}, rapids: feedrate.rapid@*, name: axis.name}}
    check: {json.dumps(check)}
    message: "{{rapid}}"
    fix: [{{set: rapid, value: "{9000 + n}.0"}}]
"""


def findings(path: Path, text: str, file: ParameterFile) -> list[Finding]:
    """Return what rules say of a file, with the reason of each."""
    path.write_text("rules:\n" + text, encoding="utf-8")
    validator = Validator(file, read_builder_rules(path, file.schema))
    found = [f for f in validator.run() if f.rule.startswith(("rules.", "works."))]
    for finding in found:
        explain(validator, finding)
    return found


@pytest.mark.parametrize(
    "check",
    some(
        [
            " + ".join(["1.0"] * 20_000) + " > rapid",
            "(" * 100_000 + "true" + ")" * 100_000,
            "size([1, 2]" + ".map(x, [x, x])" * 30 + ") > 0",
            "size([name]" + ".map(x, x + x)" * 40 + "[0]) > 0",
            "rapids.all(a, " * 9 + "true" + ")" * 9,
            r"name.matches('((\w{100}){100}){100}')",
            "rapid < 1e400",
            "a" + ".a" * 500,
            "true ? " * 300 + "true" + " : false" * 300,
        ],
        2,
    ),
    ids=lambda check: check[:12],
)
def test_a_rule_beyond_its_budget_is_one_finding_and_the_others_run(mill, path: Path, check: str) -> None:
    found = findings(path, rule(1, check) + rule(2), mill)
    assert [f.rule for f in found] == ["rules.unusable"] + 7 * ["works.rule2"]
    assert found[0].message.startswith("rules.yaml, line 7: works.rule1: check: ")
    assert len(found[0].message) < 200


def test_what_makes_no_sense_of_its_values_is_not_broken(mill, path: Path) -> None:
    checks = (
        "field(rapid, 0.0, 1e10) > 0.0",
        "round(rapid, 1e300) > 0.0",
        "1 / 0 > 0",
        "9223372036854775807 + 1 > 0",
        "rapids[int(rapid * 1e300)] > 0.0",
        "rapids[-1] > 0.0",
        "int(string(rapid) + '9') > 0",
        "double(name) > 0.0",
        "[null][0] < 1.0",
    )
    text = "".join(rule(10 + n, check) for n, check in enumerate(checks))
    assert {f.rule for f in findings(path, text + rule(2), mill)} == {"works.rule2"}


def test_rules_that_together_take_too_long_are_left_out_one_by_one(mill, path: Path) -> None:
    heavy = "rapids.all(a, rapids.all(b, rapids.all(c, rapids.all(d, a >= 0.0))))"
    found = findings(path, "".join(rule(n, heavy) for n in range(60)) + rule(99), mill)
    unusable = [f for f in found if f.rule == "rules.unusable"]
    assert 20 < len(unusable) < 59
    assert "with those before it the rules can take too many steps" in unusable[0].message
    assert unusable[-1].message.startswith("rules.yaml, line ")


def test_of_very_many_fixes_the_first_are_tried_and_the_others_when_these_are_made(
    mill, path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each trial asks all rules that read the value,
    so trying them all would take the square of their number.
    """
    monkeypatch.setattr(trial, "MAX_STEPS", 300_000)
    path.write_text("rules:\n" + "".join(rule(n) for n in range(10)), encoding="utf-8")
    validator = Validator(mill, read_builder_rules(path, mill.schema))
    found = [f for f in validator.run() if f.rule.startswith("works.")]
    offered = [f.rule for f in found if f.fix]
    assert (len(found), 0 < len(offered) < 10, set(offered)) == (70, True, {"works.rule0"})
    mill.set(("feedrate.rapid", "1"), Value(9000.0, "mm/min"))
    assert validator.update([("feedrate.rapid", "1")]) == Validator(mill, validator.own).run()


def test_a_text_of_any_length_in_the_file_costs_a_rule_nothing(mill, path: Path) -> None:
    """The budget reckons with 4000 characters; a longer value is an error by itself."""
    text = rule(1, "size(name + name) < 0") + rule(2)
    assert len([f for f in findings(path, text, mill) if f.rule == "works.rule1"]) == 7
    name = ("axis.name", "1")
    mill.apply(Change(name, mill.get(name), Value("x" * 5000)))
    assert len([f for f in findings(path, text, mill) if f.rule == "works.rule1"]) == 6


@pytest.mark.parametrize("key", ["id", "title", "message", "page", "family"])
def test_a_text_of_a_megabyte_is_reported_in_a_line(mill, path: Path, key: str) -> None:
    lines = [line for line in rule(1).splitlines(keepends=True) if f" {key}:" not in line]
    text = "".join(lines).replace("    title", "  - title", key == "id") + f"    {key}: a.{'b' * 1_000_000}\n"
    found = findings(path, text + rule(2), mill)
    assert [f.rule for f in found] == ["rules.unusable"] + 7 * ["works.rule2"]
    assert f"{key}: is too long: 1,000,002, and " in found[0].message
    assert len(found[0].message) < 250


def test_names_by_the_thousand_are_refused(mill, path: Path) -> None:
    names = ", ".join(f"n{n}: feedrate.rapid@*" for n in range(5000))
    found = findings(path, rule(1, reads=f"rapid: feedrate.rapid, {names}") + rule(2), mill)
    assert (
        found[0].message
        == "rules.yaml, line 6: works.rule1: reads: is too long: 5,003, and 100 are the most."
    )
    assert len(found) == 8


def test_of_slips_without_end_the_first_are_reported(mill, path: Path) -> None:
    found = findings(path, "".join(rule(n, "rapid <") for n in range(MAX_FAULTS + 50)), mill)
    assert len(found) == MAX_FAULTS + 1
    assert found[-1].message == "rules.yaml: 50 more entries cannot be used."


def test_rules_without_end_are_reported(mill, path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rule_file, "MAX_RULES", 5)
    found = findings(path, "".join(rule(n, "rapid > 0.0") for n in range(9)), mill)
    assert [f.message for f in found] == [
        "rules.yaml, line 43: works.rule5: there are 9 rules, and 5 are the most; the rest is not used."
    ]


def test_the_work_grows_with_the_number_of_rules_and_not_with_its_square(mill, path: Path) -> None:
    def calls(count: int) -> int:
        path.write_text(
            "rules:\n" + "".join(rule(n, f"rapid <= {count}{n}.0") for n in range(count)), encoding="utf-8"
        )
        made: list[None] = []
        sys.setprofile(lambda _frame, event, _arg: made.append(None) if event == "call" else None)
        try:
            own = read_builder_rules(path, mill.schema)
        finally:
            sys.setprofile(None)
        assert (len(own.rules), own.faults) == (count, ())
        return len(made)

    calls(10)
    assert calls(160) < 5 * calls(40), "four times as many take four times as much, not sixteen"


@pytest.mark.parametrize("family", FAMILIES)
def test_no_rule_filters_a_table_of_thousands(family: str) -> None:
    """The engine copies what ``filter`` and ``map`` have so far for each value: count_set()
    and the like do not.
    """
    schema = load_schema(family)
    slow = {
        check.rule.id
        for machine in schema.machines
        for check in make_plan(schema, machine).checks
        if any(len(listed.addresses) > 200 for _, listed in check.lists)
        and any(
            word in text
            for text in (check.rule.when, check.rule.check, *check.rule.values.values())
            for word in (".filter(", ".map(")
        )
    }
    assert slow == set()


def test_values_of_a_list_are_counted_without_those_that_are_not_set() -> None:
    values = [3.0, None, -1.0, 3.0, 0.0]
    assert GENERAL["count_set"](values) == 4.0
    assert (GENERAL["count_below"](values, 3.0), GENERAL["count_above"](values, 0.0)) == (2.0, 2.0)
    assert GENERAL["count_set"]([]) == 0.0
