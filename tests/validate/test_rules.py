"""Every rule of every family is broken by the change of its table, not by the one beside it,
and its fix ends the finding.

The tables are in ``rule_cases/``; the machines they change are in ``sound_machines/``. ``make test`` makes
the fixes of some cases of each rule, and looks at the others' values alone; ``make campaign`` makes all of
them.
"""

import math
import operator
import re
from collections import Counter
from collections.abc import Callable, Iterable, Iterator

import pytest
from rule_machines import FAMILIES, HERE, Case, all_cases, cases, machines, sound

from amp_studio.schema import Value, canonical_unit, load_schema, program
from amp_studio.validate import Finding, Validator
from amp_studio.validate.rules import RuleChecks
from tests.campaigns import CAMPAIGN

RULES = {rule.id: rule for family in FAMILIES for rule in load_schema(family).rules}
CASES: dict[str, list[Case]] = {rule: [] for rule in RULES}
for each in all_cases():
    CASES[each.rule].append(each)
Check = Callable[[Case], None]
"""What has to hold while the change of a case is made."""


@pytest.mark.parametrize("rule", RULES)
def test_a_rule_does_what_its_cases_list(rule: str) -> None:
    failed: list[Exception] = []
    for case in CASES[rule]:
        with case.machine.changed(case.given):
            if case.breaks is not None:
                failed += failures(case, [nothing_is_found])
            for texts, checks in ((case.breaks, checks_of(case)), (case.passes, [nothing_is_found])):
                if texts is not None:
                    with case.machine.changed(texts):
                        failed += failures(case, checks)
    if failed:
        raise ExceptionGroup(f"{len(failed)} failures of {rule}", failed)


def failures(case: Case, checks: Iterable[Check]) -> Iterator[Exception]:
    """Yield what fails while the change of a case is made: every check is tried, whatever becomes of
    another.
    """
    for check in checks:
        try:
            check(case)
        except Exception as error:
            error.add_note(f"case {case}: {check.__name__}")
            yield error


def checks_of(case: Case) -> Iterator[Check]:
    """Yield what has to hold while a case breaks its rule."""
    yield a_broken_rule_is_found
    if RULES[case.rule].fix:
        yield its_fixes_are_those_of_the_table
        if CAMPAIGN or is_tried(case):
            yield its_fixes_end_the_finding_and_cause_no_error
    if RULES[case.rule].effective:
        yield the_effective_value_is_in_the_finding
    if case is next(c for c in CASES[case.rule] if c.breaks is not None) and compares_numbers(case.rule):
        yield a_comparison_turns_exactly_at_its_bound


def is_tried(case: Case) -> bool:
    """Return whether ``make test`` makes the fixes of a case: of the first one that breaks its rule,
    and of every fourth.
    """
    broken = [each for each in CASES[case.rule] if each.breaks is not None]
    return broken.index(case) % 4 == 0


def test_no_check_of_a_case_is_lost() -> None:
    """How many there were when this was written: more may come, a filter that drops some is noticed."""
    every = [case for cases_of_a_rule in CASES.values() for case in cases_of_a_rule]
    tried = Counter(check for case in every if case.breaks is not None for check in checks_of(case))
    assert tried[a_broken_rule_is_found] >= 2418
    assert sum(case.passes is not None for case in every) >= 2518
    assert tried[its_fixes_are_those_of_the_table] >= 706
    assert tried[its_fixes_end_the_finding_and_cause_no_error] >= (706 if CAMPAIGN else 250)
    assert tried[the_effective_value_is_in_the_finding] >= 191
    assert tried[a_comparison_turns_exactly_at_its_bound] >= 217


@pytest.mark.parametrize(
    ("family", "name"), [(f, name) for f in FAMILIES for name in machines(f)["machines"]]
)
def test_a_sound_machine_has_no_finding(family: str, name: str) -> None:
    findings = Validator(sound(family, name)).run()
    assert [finding for finding in findings if finding.rule != "schema.unset"] == []


@pytest.mark.parametrize("family", FAMILIES)
def test_every_rule_has_a_case_that_breaks_it_and_one_that_just_does_not(family: str) -> None:
    rules = {rule.id for rule in load_schema(family).rules}
    assert {case.rule for case in cases(family)} == rules, "a rule without a row, or a row without a rule"
    assert {case.rule for case in cases(family) if case.breaks is not None} == rules
    assert {case.rule for case in cases(family) if case.passes is not None} == rules


def test_no_table_of_cases_is_beside_the_folders_of_the_families() -> None:
    assert {path.parent.name for path in (HERE / "rule_cases").rglob("*.yaml")} == set(FAMILIES)


def nothing_is_found(case: Case) -> None:
    assert case.machine.filed(case.rule) == {}


def a_broken_rule_is_found(case: Case) -> None:
    rule, found = RULES[case.rule], list(case.machine.filed(case.rule).values())
    assert len(found) == case.times
    for finding in found:
        assert (finding.severity, finding.page) == (rule.severity, rule.page)
        assert finding.causes
        assert not re.search(r"[{}?]", finding.message), "every name of the message has its value"
    assert case.has_message(found), [finding.message for finding in found]


# --------------------------------------------------------------------------------------------- fixes


def errors_of(findings: tuple[Finding, ...]) -> set[tuple[str, object]]:
    """Return the errors, each with what it is about."""
    return {finding.key for finding in findings if finding.severity == "error"}


def its_fixes_are_those_of_the_table(case: Case) -> None:
    fixable = [finding for finding in case.machine.filed(case.rule).values() if finding.fix]
    assert case.fix is None or case.offers(fixable), [finding.fix for finding in fixable]


def its_fixes_end_the_finding_and_cause_no_error(case: Case) -> None:
    here = case.machine
    broken = here.findings
    fixable = [finding for finding in here.of(case.rule) if finding.fix]
    assert bool(fixable) is not bool(case.no_fix), "a case whose findings offer no fix has the reason"
    assert case.fix is None or case.offers(fixable), [finding.fix for finding in fixable]
    with here.recorded():
        here.set({setting.address: setting.value for finding in fixable for setting in finding.fix})
        assert {f.key for f in fixable} & {f.key for f in here.of(case.rule)} == set()
        assert errors_of(here.findings) - errors_of(broken) == set()


def the_effective_value_is_in_the_finding(case: Case) -> None:
    here = case.machine
    found = list(here.filed(case.rule).values())
    uses = {setting.address: setting.value for finding in found for setting in finding.effective}
    if case.effective is not None:
        assert case.has_effective(found), uses
        return
    assert all(finding.effective for finding in found)
    with here.recorded():
        here.set(uses)
        assert here.filed(case.rule) == {}


@pytest.mark.parametrize("family", FAMILIES)
def test_every_rule_with_a_fix_offers_it(family: str) -> None:
    fixed = {case.rule for case in cases(family) if case.breaks is not None and not case.no_fix}
    assert {rule.id for rule in load_schema(family).rules if rule.fix} <= fixed


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


def compares_numbers(rule_id: str) -> bool:
    """Return whether the check of a rule compares a number with another one, or with an expression."""
    rule = RULES[rule_id]
    found = COMPARISON.fullmatch(rule.check)
    if not found or found[3] == "null":
        return False
    parameters = load_schema(CASES[rule_id][0].family).parameters
    return parameters[rule.reads[found[1]].partition("@")[0]].type in ("integer", "real")


def numbers_at(bound: float) -> tuple[float, float, float]:
    """Return a bound and the numbers next to it."""
    return bound, math.nextafter(bound, -math.inf), math.nextafter(bound, math.inf)


def whole_numbers_at(bound: float) -> tuple[int, ...]:
    """Return the bound, where it is a whole number, and the whole numbers next to it."""
    return tuple(
        dict.fromkeys((math.floor(bound), math.ceil(bound), math.ceil(bound) - 1, math.floor(bound) + 1))
    )


def a_comparison_turns_exactly_at_its_bound(case: Case) -> None:
    rule = RULES[case.rule]
    left, sign, right = COMPARISON.fullmatch(rule.check).groups()
    here = case.machine
    _ = here.findings
    check = here.validator.check_of(here.of(case.rule)[0])
    address = check.address_of(left)
    bound = program(right).execute(RuleChecks(here.file, here.file.machine).context_of(check))
    whole = here.file.schema.parameters[address[0]].type == "integer"
    for number in whole_numbers_at(bound) if whole else numbers_at(bound):
        with here.recorded():
            here.set({address: Value(number, canonical_unit(here.file.get(address).unit))})
            applies = program(rule.when).execute(RuleChecks(here.file, here.file.machine).context_of(check))
            is_found = check.place in here.filed(case.rule)
        assert is_found is (applies and not OPERATORS[sign](number, bound)), (
            f"{left} = {number!r} at {bound!r}"
        )
