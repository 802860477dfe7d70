"""Every rule of AcroMill is broken by the change its table names, and holds beside it.

The tables are in ``rule_cases/acromill/``, the machine they change is the router of the examples, in which nothing is
found. A case has ``given`` (changed beforehand), ``breaks`` and ``times`` (how many findings that gives), ``holds`` (a
change after which the rule is not broken), and ``application`` for another controller.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
from ruamel.yaml import YAML

from amp_studio.demo import examples_folder
from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Rule, load_schema
from amp_studio.validate import Finding, Validator
from amp_studio.validate.plan import checks_of
from amp_studio.validate.rules import RuleChecks

RULES = {rule.id: rule for rule in load_schema("acromill").rules}
TABLES = sorted((Path(__file__).parent / "rule_cases" / "acromill").glob("*.yaml"))
CASES = [
    (rule, case)
    for table in TABLES
    for rule, cases in YAML(typ="safe").load(table.read_text("utf-8")).items()
    for case in cases
]
NAMES = [f"{rule}-{n}" for n, (rule, _) in enumerate(CASES)]


def router(case: Mapping[str, object] = {}, *changes: str) -> ParameterFile:
    """Return the router with some of a case's changes."""
    (path,) = (examples_folder() / "acromill-router").glob("*.amp")
    file = open_file(path).file
    file.header.application = str(case.get("application", file.header.application))
    for name in changes:
        for text, value in (case.get(name) or {}).items():  # type: ignore[attr-defined]  # a table of YAML
            address = file.find(text)
            file.set(address, None if value is None else file.read(address, str(value)))
    return file


def of_rule(file: ParameterFile, rule: str) -> list[Finding]:
    """Return the findings of one rule."""
    return [finding for finding in Validator(file).run() if finding.rule == rule]


def test_in_the_router_nothing_is_found() -> None:
    assert Validator(router()).run() == ()


def test_nobody_is_asked_for_what_a_file_is_complete_without() -> None:
    file = router()
    file.set(("offset.r_geometric", "1"), None)
    assert Validator(file).run() == ()
    file.set(("speeds.rapid", ""), None)
    (advice,) = Validator(file).run()
    assert (advice.rule, advice.addresses) == ("schema.unset", (("speeds.rapid", ""),))


def test_every_rule_has_cases_that_break_it_and_that_do_not() -> None:
    for said in ("breaks", "holds"):
        assert {rule for rule, case in CASES if said in case} == RULES.keys()
    assert [
        sorted(case.keys() - {"application", "given", "breaks", "times", "holds"}) for _, case in CASES
    ] == [[]] * len(CASES)


@pytest.mark.parametrize(("rule", "case"), CASES, ids=NAMES)
def test_a_rule_is_broken_and_just_holds(rule: str, case: Mapping[str, object]) -> None:
    if "breaks" in case:
        assert of_rule(router(case, "given"), rule) == []
        found = of_rule(router(case, "given", "breaks"), rule)
        assert len(found) == case.get("times", 1)
        for finding in found:
            assert (finding.severity, finding.page) == (RULES[rule].severity, RULES[rule].page)
            assert not re.search(r"[{}?]", finding.message), "every name of the message has its value"
        assert [f.addresses for f in found if RULES[rule].fix and not f.repairs] == []
        used = {setting.address: setting.value for finding in found for setting in finding.effective}
        assert len(used) == len(RULES[rule].effective) * len(found)
        obeyed = router(case, "given", "breaks")
        obeyed.set_many(used)
        assert used == {} or of_rule(obeyed, rule) == [], "what the control uses keeps the rule"
        repairs = {repair.address: repair.value for finding in found for repair in finding.repairs}
        mended = router(case, "given", "breaks")
        mended.set_many(repairs)
        assert repairs == {} or of_rule(mended, rule) == []
    if "holds" in case:
        assert of_rule(router(case, "given", "holds"), rule) == []


# -- the tables are sharp -------------------------------------------------------------------------

FLIPS = {
    "<": ("<=", ">="), "<=": ("<", ">"), ">": (">=", "<="), ">=": (">", "<"), "==": ("!=",), "!=": ("==",),
    "&&": ("||",), "||": ("&&",),
}  # fmt: skip
OPERATOR = re.compile(r"<=|>=|==|!=|&&|\|\||<|>")


def mutants(rule: Rule) -> Iterator[Rule]:
    """Yield a rule with one operator changed after the other."""
    for part in ("check", "when"):
        text = " ".join(getattr(rule, part).split())
        for found in OPERATOR.finditer(text):
            for instead in FLIPS[found[0]]:
                changed = text[: found.start()] + instead + text[found.end() :]
                yield rule.model_copy(update={part: changed})


def count(file: ParameterFile, rule: Rule) -> int:
    """Return how many findings a rule gives."""
    checks = RuleChecks(file, file.machine)
    return sum(checks.finding(check) is not None for check in checks_of(file.situation, (rule,)))


@pytest.mark.parametrize("rule_id", RULES)
def test_no_mutant_of_a_rule_passes_the_tables(rule_id: str) -> None:
    alive = list(mutants(RULES[rule_id]))
    trials = [(router(), 0)]
    for rule, case in CASES:
        if rule == rule_id:
            trials.append((router(case, "given"), 0))
            if "breaks" in case:
                trials.append((router(case, "given", "breaks"), int(str(case.get("times", 1)))))
            if "holds" in case:
                trials.append((router(case, "given", "holds"), 0))
    for file, times in trials:
        alive = [rule for rule in alive if count(file, rule) == times]
    assert [f"{rule.check}  when  {rule.when}" for rule in alive] == []
