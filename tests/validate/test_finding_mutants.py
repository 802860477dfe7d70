"""The fixes and figures of a rule are in the tables of cases too: changed in one place, a case notices it.

Of every rule of every family the expressions of its fixes, of what the control uses instead and of the
figures in its message are changed as ``test_rule_mutants.py`` changes what decides. A case notices by its
``fix``, ``effective`` and ``message`` (``make test`` tries one change in eight); also, as ``test_rules.py``
does, when there is no longer a fix, or one that should not be there, or when what the control uses instead
breaks the rule as well.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace

import pytest
from mutations import EACH, EVERY_MUTANT, variations
from rule_machines import FAMILIES, HERE, Case, cases, read

from amp_studio.schema import InvalidValueError, Rule, load_schema, program
from amp_studio.schema.expression import Expression
from amp_studio.validate import Finding
from amp_studio.validate.expressions import Expressions
from amp_studio.validate.functions import rule_functions
from amp_studio.validate.plan import RuleCheck, checks_of
from amp_studio.validate.rules import RuleChecks
from tests.campaigns import some

PARTS = {"fix": "fixes", "effective": "effective", "values": "values"}
"""Part of a rule -> the field of its compiled expressions."""

EQUIVALENT: Mapping[str, Mapping[str, str]] = read(HERE / "equivalent_finding_mutants.yaml")
"""Rule -> a piece of a mutant's text, which the rule itself does not have -> why it means the same as the
rule."""

CHOICE = re.compile(r"'([^']*)'")


@dataclass(frozen=True)
class Mutant:
    """A rule of which one expression of its findings was changed."""

    part: str
    n: int
    """Which of that part."""
    text: str
    before: str
    change: str

    def has(self, piece: str) -> bool:
        """Return whether a piece of text is what was changed here."""
        return piece in self.text and piece not in self.before

    def of(self, rule: Rule, expressions: Expressions) -> Expressions:
        """Return the expressions of the rule with this change; raises ValueError if it cannot be compiled.

        Whether the rule is broken is decided as it was: that is not what was changed.
        """
        field = PARTS[self.part]
        all_of_it = list(getattr(expressions.finding, field))
        functions = rule_functions(rule.id.partition(".")[0])
        all_of_it[self.n] = (all_of_it[self.n][0], Expression(program(self.text), functions))
        changed = copy(expressions)
        changed.finding = expressions.finding._replace(**{field: tuple(all_of_it)})
        return changed


def parts_of(rule: Rule) -> Iterator[tuple[str, int, str, str]]:
    """Yield the expressions of a rule's findings: the part, which of it, its name, its text."""
    for part in ("fix", "effective"):
        for n, assignment in enumerate(getattr(rule, part)):
            yield part, n, assignment.set, assignment.value
    for n, (name, text) in enumerate(rule.values.items()):
        yield "values", n, name, text


def mutants_of(rule: Rule) -> Iterator[Mutant]:
    """Yield the findings' expressions of a rule with one thing changed after the other."""
    for part, n, name, written in parts_of(rule):
        text = " ".join(written.split())
        for changed, change in (*variations(text), *other_values(rule, part, name, text)):
            yield Mutant(part, n, changed, text, f"{rule.id}: {part} {name}: {change}")


def other_values(rule: Rule, part: str, name: str, text: str) -> Iterator[tuple[str, str]]:
    """Yield an expression that gives another value of the parameter to be set, and what was changed for
    it.
    """
    if part == "values" or not EVERY_MUTANT:
        return
    family = load_schema(rule.id.partition(".")[0])
    parameter = family.parameters[rule.reads[name].partition("@")[0]]
    if parameter.type in ("integer", "real", "bits"):
        yield f"({text}) + 1.0", "one more"
    keys = [choice.key for choice in parameter.choices or ()]
    for named in dict.fromkeys(CHOICE.findall(text)):
        for instead in [key for key in keys if named in keys and key != named][:2]:
            yield text.replace(f"'{named}'", f"'{instead}'"), f"{named} → {instead}"


def notices(case: Case, found: Sequence[Finding], checks: Sequence[RuleCheck], has_fix: bool) -> bool:
    """Return whether a case gets something else than it lists; the findings are those of the checks.

    ``has_fix`` is whether the rule as it is written has a fix there, which a trial may refuse.
    """
    rule = checks[0].rule
    if rule.fix and any(finding.fix for finding in found) is not has_fix:
        return True
    if case.fix is not None and not case.offers(found):
        return True
    if any("?" in finding.message for finding in found) or not case.has_message(found):
        return True
    if not rule.effective:
        return False
    if case.effective is not None:
        return not case.has_effective(found)
    if not all(finding.effective for finding in found):
        return True
    here = case.machine
    with here.recorded():
        try:
            here.set({used.address: used.value for finding in found for used in finding.effective})
        except InvalidValueError:
            return True  # a file takes no such value
        values = RuleChecks(here.file, here.file.machine)
        return any(values.finding(check) for check in checks)


def alive(case: Case, rule: Rule, mutants: Sequence[Mutant]) -> tuple[Mutant, ...]:
    """Return the mutants of a rule that a case does not notice."""
    here, left = case.machine, []
    with here.changed(case.given), here.changed(case.breaks or {}):
        values = RuleChecks(here.file, here.file.machine)
        broken = [
            check for check in checks_of(here.file.evaluation, (rule,)) if values.finding(check) is not None
        ]
        has_fix = any(one.fix for check in broken if (one := values.finding(check)) is not None)
        for mutant in mutants:
            try:
                expressions = mutant.of(rule, broken[0].expressions)
            except ValueError:
                continue
            found = [
                one
                for check in broken
                if (one := values.finding(replace(check, expressions=expressions))) is not None
            ]
            if not notices(case, found, broken, has_fix):
                left.append(mutant)
    return tuple(left)


@pytest.mark.parametrize("family", some(FAMILIES))
def test_no_mutant_of_what_a_rule_reports_passes_the_tables(family: str) -> None:
    rules = {rule.id: rule for rule in load_schema(family).rules}
    every = [(rule, mutant) for rule in rules for mutant in mutants_of(rules[rule])][::EACH]
    left = {rule: tuple(mutant for of, mutant in every if of == rule) for rule in rules}
    total = len(every)
    for case in cases(family):
        if case.breaks is not None and left[case.rule]:
            left[case.rule] = alive(case, rules[case.rule], left[case.rule])
    print(f"{family}: {total} mutants of findings, {sum(map(len, left.values()))} alive")
    unknown = [
        mutant.change
        for rule, mutants in left.items()
        for mutant in mutants
        if not any(mutant.has(piece) for piece in EQUIVALENT.get(rule, {}))
    ]
    assert unknown == [], "add the fix, effective value or message to a case"
    listed = {(rule, piece) for rule in left for piece in EQUIVALENT.get(rule, {})}
    met = {(rule, piece) for rule, piece in listed for mutant in left[rule] if mutant.has(piece)}
    assert not EVERY_MUTANT or listed == met, "what is listed is alive"


def test_a_mutant_that_reports_the_same_belongs_to_a_rule() -> None:
    assert EQUIVALENT.keys() <= {rule.id for family in FAMILIES for rule in load_schema(family).rules}
