"""Every rule of the 9/PC is broken by the change the table names, holds beside it, and its repair mends it.

The tables are in ``rule_cases/``; the machines they change are in ``conftest.py``.
"""

from __future__ import annotations

import math
import operator
import re
from collections.abc import Callable, Iterator

import pytest

from amp_studio.schema import Address, Value, canonical_unit, load_schema, program
from amp_studio.validate import Finding
from amp_studio.validate.plan import checks_of
from amp_studio.validate.rules import RuleChecks

RULES = {rule.id: rule for rule in load_schema("9pc").rules}


def of_rule(findings: tuple[Finding, ...], rule: str) -> list[Finding]:
    """Return the findings of one rule."""
    return [finding for finding in findings if finding.rule == rule]


@pytest.mark.parametrize("name", ["mill", "lathe", "router"])
def test_in_a_sound_machine_nothing_is_found(name: str, stands) -> None:
    assert stands(name).findings == ()


def test_every_rule_has_cases_and_every_case_a_rule(rule_cases) -> None:
    written = {case.rule for case in rule_cases}
    assert written == RULES.keys(), "a rule without a row in rule_cases/, or a row without a rule"
    assert {case.rule for case in rule_cases if case.breaks is not None} == RULES.keys()
    assert {case.rule for case in rule_cases if case.holds is not None} == RULES.keys()


def test_a_broken_rule_is_found(case_that_breaks, stands) -> None:
    case, rule = case_that_breaks, RULES[case_that_breaks.rule]
    stand = stands(case.of)
    with stand.changed(case.given) as before:
        assert of_rule(before, case.rule) == []
        with stand.changed(case.breaks) as after:
            found = of_rule(after, case.rule)
    assert len(found) == case.times
    for finding in found:
        assert (finding.severity, finding.page) == (rule.severity, rule.page)
        assert finding.addresses
        assert not re.search(r"[{}?]", finding.message), "every name of the message has its value"


def test_a_rule_that_just_holds_says_nothing(case_that_holds, stands) -> None:
    case = case_that_holds
    stand = stands(case.of)
    with stand.changed(case.given), stand.changed(case.holds) as after:
        assert of_rule(after, case.rule) == []


# --------------------------------------------------------------------------------------------- repairs


def errors_of(findings: tuple[Finding, ...]) -> set[tuple[str, tuple[Address, ...]]]:
    """Return which errors there are, and about what."""
    return {(finding.rule, finding.addresses) for finding in findings if finding.severity == "error"}


def test_the_repairs_of_a_rule_mend_it_and_cause_no_error(case_that_breaks, stands) -> None:
    case = case_that_breaks
    stand = stands(case.of)
    with stand.changed(case.given), stand.changed(case.breaks) as broken:
        mendable = [finding for finding in of_rule(broken, case.rule) if finding.repairs]
        repairs = [repair for finding in mendable for repair in finding.repairs]
        with stand.recorded():
            for repair in repairs:
                stand.file.set(repair.address, repair.value)
            mended = stand.validator.update(repair.address for repair in repairs)
    assert {f.addresses for f in mendable} & {f.addresses for f in of_rule(mended, case.rule)} == set()
    assert errors_of(mended) - errors_of(broken) == set()


def test_every_rule_with_a_repair_offers_it(rule_cases, stands) -> None:
    offered = set()
    for case in rule_cases:
        if case.breaks is not None and RULES[case.rule].fix:
            stand = stands(case.of)
            with stand.changed(case.given), stand.changed(case.breaks) as broken:
                offered |= {finding.rule for finding in broken if finding.repairs}
    assert {rule.id for rule in RULES.values() if rule.fix} - offered == set()


# ----------------------------------------------------------------------------- the bound, taken from the rule

OPERATORS: dict[str, Callable[[float, float], bool]] = {
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "==": operator.eq,
    "!=": operator.ne,
}
COMPARISON = re.compile(r"(\w+) (<=|>=|==|!=|<|>) ([^<>=!&|?']+)")


def comparisons() -> Iterator[str]:
    """Yield the rules whose check compares a number with another one, or with an expression."""
    parameters = load_schema("9pc").parameters
    for rule in RULES.values():
        found = COMPARISON.fullmatch(rule.check)
        if found and parameters[rule.reads[found[1]]].type in ("integer", "real"):
            yield rule.id


@pytest.mark.parametrize("rule_id", list(comparisons()))
def test_a_comparison_turns_exactly_at_its_bound(rule_id: str, rule_cases, stands) -> None:
    rule = RULES[rule_id]
    left, sign, right = COMPARISON.fullmatch(rule.check).groups()
    case = next(case for case in rule_cases if case.rule == rule_id and case.breaks is not None)
    stand = stands(case.of)
    with stand.changed(case.given), stand.changed(case.breaks) as broken:
        about = of_rule(broken, rule_id)[0].addresses
        checks = checks_of(stand.file.situation, (rule,))
        check = next(check for check in checks if {single.address for single in check.singles} == set(about))
        address = check.address_of(left)
        bound = program(right).execute(RuleChecks(stand.file, stand.file.machine).context_of(check))
        for number in (bound, math.nextafter(bound, -math.inf), math.nextafter(bound, math.inf)):
            with stand.recorded():
                stand.file.set(address, Value(number, canonical_unit(stand.file.get(address).unit)))
                findings = stand.validator.update([address])
                applies = program(rule.when).execute(
                    RuleChecks(stand.file, stand.file.machine).context_of(check)
                )
            said = any(finding.addresses == about for finding in of_rule(findings, rule_id))
            assert said is (applies and not OPERATORS[sign](number, bound)), (
                f"{left} = {number!r} at {bound!r}"
            )
