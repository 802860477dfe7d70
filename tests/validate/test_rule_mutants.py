"""The tables of cases are sharp: a rule changed in one place no longer gives what they say.

Of every rule of every family the check is negated, the guard left out, every comparison flipped, every "and"
made an "or", every "or" an "and", and every "not" left out; ``make test`` tries one in sixteen of them beside
the first two. The full run (``make mutants``) also replaces
every choice and number, turns every sum, product, quantifier and truth value into its opposite, and leaves
out every operand of "and" and "or". What is alive at the end is in ``equivalent_mutants.yaml``, with the
reason why no case can distinguish it.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import pytest
from mutations import EACH, EVERY_MUTANT, operands, variations
from rule_machines import FAMILIES, HERE, TrialMachine, cases, machines, read, trial_machine

from amp_studio.schema import Rule, load_schema
from amp_studio.validate.plan import RuleCheck, checks_of
from amp_studio.validate.rules import RuleChecks
from tests.campaigns import some

EQUIVALENT: Mapping[str, Mapping[str, str]] = read(HERE / "equivalent_mutants.yaml")
"""Rule -> a piece of a mutant's text, which the rule itself does not have -> why it means the same as the
rule."""


@dataclass(frozen=True)
class Mutant:
    """A rule with one change."""

    rule: Rule
    """Under a separate name, without a message."""
    text: str
    """The part that was changed, as it is now."""
    before: str
    change: str

    def has(self, piece: str) -> bool:
        """Return whether a piece of text is what was changed here."""
        return piece in self.text and piece not in self.before


def mutants(rule: Rule) -> Iterator[Mutant]:
    """Yield a rule with one thing changed after the other."""
    silent = {"message": "", "values": {}, "units": {}, "fix": (), "effective": ()}
    for n, (part, text, before, change) in enumerate(changes(rule)):
        update = {"id": f"{rule.id}-{n}", part: text}
        yield Mutant(rule.model_copy(update=silent | update), text, before, f"{rule.id}: {part}: {change}")


def changes(rule: Rule) -> Iterator[tuple[str, str, str, str]]:
    """Yield a part of a rule, its text with one thing changed, that as it was, and what was changed."""
    yield "check", f"!({rule.check}\n)", rule.check, "negated"
    if rule.when != "true":
        yield "when", "true  // the guard left out", rule.when, "left out"
    for part in ("check", "when"):
        text = " ".join(getattr(rule, part).split())
        for changed, change in variations(text):
            yield part, changed, text, change


def tried(rule: Rule) -> Iterator[Mutant]:
    """Yield the check negated, the guard left out, and each of the others or one in eight."""
    return (mutant for n, mutant in enumerate(mutants(rule)) if n < 2 or n % EACH == 0)


class Campaign:
    """The mutants of a family, and which are alive: those that gave, so far, what the tables say."""

    def __init__(self, family: str) -> None:
        self.alive = {rule.id: tuple(tried(rule)) for rule in load_schema(family).rules}
        self.total = sum(map(len, self.alive.values()))
        self._checks: dict[tuple[TrialMachine, str], dict[str, list[RuleCheck]]] = {}
        for name in machines(family)["machines"]:
            for rule in self.alive:
                self._expect(trial_machine(family, name), rule, 0)
        for case in cases(family):
            with case.machine.changed(case.given):
                self._expect(case.machine, case.rule, 0)
                for texts, times in ((case.breaks, case.times), (case.passes, 0)):
                    if texts is not None:
                        with case.machine.changed(texts):
                            self._expect(case.machine, case.rule, times)

    def _expect(self, here: TrialMachine, rule: str, times: int) -> None:
        """Strike out the mutants of a rule that give another number of findings."""
        checks, values = self._checks_of(here, rule), RuleChecks(here.file, here.file.machine)
        self.alive[rule] = tuple(
            mutant
            for mutant in self.alive[rule]
            if sum(values.finding(check) is not None for check in checks.get(mutant.rule.id, ())) == times
        )

    def _checks_of(self, here: TrialMachine, rule: str) -> Mapping[str, list[RuleCheck]]:
        """Return the checks of a rule's mutants on a machine."""
        found = self._checks.get((here, rule))
        if found is None:
            found = self._checks[here, rule] = {}
            for check in checks_of(here.file.evaluation, tuple(mutant.rule for mutant in self.alive[rule])):
                found.setdefault(check.rule.id, []).append(check)
        return found


@pytest.mark.parametrize("family", some(FAMILIES))
def test_no_mutant_of_a_rule_passes_the_tables(family: str) -> None:
    campaign = Campaign(family)
    alive = [(rule, mutant) for rule, left in campaign.alive.items() for mutant in left]
    print(f"{family}: {campaign.total} mutants, {len(alive)} alive")
    unknown = [
        mutant.change
        for rule, mutant in alive
        if not any(mutant.has(piece) for piece in EQUIVALENT.get(rule, {}))
    ]
    assert unknown == [], "add a case that tells them from the rule"
    listed = {(rule, piece) for rule in campaign.alive for piece in EQUIVALENT.get(rule, {})}
    met = {(rule, piece) for rule, piece in listed for mutant in campaign.alive[rule] if mutant.has(piece)}
    assert not EVERY_MUTANT or listed == met, "what is listed is alive"


def test_a_mutant_that_shows_the_same_belongs_to_a_rule() -> None:
    assert EQUIVALENT.keys() <= {rule.id for family in FAMILIES for rule in load_schema(family).rules}


def test_every_operand_is_left_out_in_its_turn() -> None:
    text = "a && near(b, c || d == ',&&') ? e : [f && g] || h"
    assert [(text[start:end].strip(), neutral) for start, end, neutral in operands(text)] == [
        ("c", "false"),
        ("d == ',&&'", "false"),
        ("a", "true"),
        ("near(b, c || d == ',&&')", "true"),
        ("f", "true"),
        ("g", "true"),
        ("[f && g]", "false"),
        ("h", "false"),
    ]
