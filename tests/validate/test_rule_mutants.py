"""The table of cases is sharp: a rule changed in one place no longer gives what the table says.

Every comparison of every rule is flipped, every "and" made an "or" and the other way round, every choice and every
number replaced by another, and every check negated. What is still alive at the end is listed here with the reason.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from dataclasses import dataclass

import pytest

from amp_studio.files import ParameterFile
from amp_studio.schema import Rule, load_schema
from amp_studio.validate.plan import checks_of
from amp_studio.validate.rules import RuleChecks

EVERY_MUTANT = os.environ.get("AMP_STUDIO_FULL") == "1"
"""Without it choices and numbers are left alone: comparisons, logic and negations remain."""

FLIPS = {
    "<": ("<=", ">="),
    "<=": ("<", ">"),
    ">": (">=", "<="),
    ">=": (">", "<"),
    "==": ("!=",),
    "!=": ("==",),
    "&&": ("||",),
    "||": ("&&",),
}
PLACE = re.compile(
    r"(?P<operator><=|>=|==|!=|&&|\|\||<|>)|(?P<choice>'[^']*')"
    r"|(?<![\w.\[])(?P<number>\d+\.\d+|\d+(?![\w.,\]]))"  # not the positions of a list, nor a digit of a name
)

THE_SAME = {
    # A limit of zero times anything, or a division by zero, decides as the condition before it does.
    "9pc.axis.rollover-turn": {"rollover >= 0.0"},
    "9pc.servo.cycle-divides-scan": {"cycle > 1.0", "cycle < fine * scans"},
    "9pc.servo.excess-margin": {"gain >= 0.0", "ratio >= 0.0"},
    "9pc.servo.inposition-resolution": {"pitch >= 0.0"},
    "9pc.servo.motor-speed-margin": {"pitch >= 0.0", "gear >= 0.0"},
    "9pc.accdec.min-jerk-window": {"ramp >= 0.0"},
    # The axis name is ignored on an unfitted axis, zone.group without groups, and the incremental name but on
    # lathe type A, where it is U, V, W or none.
    "9pc.axis.name-duplicate": {"type != 'other'"},
    "9pc.axis.dollar-name": {"type != 'other'"},
    "9pc.zone.group-not-checked": {"count >= 0.0"},
    "9pc.axis.lathe-a-name-incremental": {"lathe_type == 'a' ||", "|| name in"},
    # What the tables do not print compares with nothing, with or without the condition that leaves it out.
    "9pc.servo.standard-motor-gains": {"motor == 'other'", "['other', 'b740c']", "['nonstandard', 'other']"},
    # At position i stands the slave itself, which is left out.
    "9pc.deskew.slave-last": {"j >= i"},
    "9pc.deskew.slave-last-2": {"j >= i"},
    # Rounding only takes away the last bits of a number that was converted; one digit more or less is the same.
    "9pc.format.travel": {", 7.0)"},
    "9pc.letter.feed-digits": {", 7.0)"},
    # A third spindle can only have no type, or one twice.
    "9pc.servo.spindle-type-order": {"<= 2", "< 3", "filter(t, t == 'other')"},
}
"""Mutants that say the same as the rule, by a piece of their text, each with the reason."""


@dataclass(frozen=True)
class Mutant:
    """A rule with one change."""

    rule: Rule
    text: str
    """The part that was changed, as it stands now."""
    change: str


def mutants(rule: Rule) -> Iterator[Mutant]:
    """Yield a rule with one thing changed after the other."""
    negated = f"!({rule.check})"
    yield Mutant(rule.model_copy(update={"check": negated}), negated, "check negated")
    for part in ("check", "when"):
        text = " ".join(getattr(rule, part).split())
        for found in PLACE.finditer(text):
            for instead in instead_of(found):
                before, after = text[: found.start()], text[found.end() :]
                if instead == "<=" and after.startswith(" size("):
                    continue  # one position more is an error of the index, which exists() passes over
                changed = before + instead + after
                change = f"{part}: …{before[-25:]}[{found[0]} → {instead}]{after[:25]}…"
                yield Mutant(rule.model_copy(update={part: changed}), changed, change)


def instead_of(found: re.Match[str]) -> tuple[str, ...]:
    """Return what is put in the place of an operator, a choice or a number."""
    if found["operator"]:
        return FLIPS[found[0]]
    if not EVERY_MUTANT:
        return ()
    if found["choice"]:
        return ("'other'",)
    return (repr(float(found[0]) + 1) if "." in found[0] else str(int(found[0]) + 1),)


def says_the_same(mutant: Mutant) -> bool:
    """Tell whether a mutant is among those that cannot be told from the rule."""
    plain = " ".join(f"{mutant.rule.check} && {mutant.rule.when}".split())
    original = {rule.id: rule for rule in load_schema("9pc").rules}[mutant.rule.id]
    before = " ".join(f"{original.check} && {original.when}".split())
    return any(piece in plain and piece not in before for piece in THE_SAME.get(mutant.rule.id, ()))


class Campaign:
    """Mutants that are alive: those that gave, so far, what the table says."""

    def __init__(self) -> None:
        self.alive = {rule.id: list(mutants(rule)) for rule in load_schema("9pc").rules}
        self.total = sum(map(len, self.alive.values()))

    def expect(self, file: ParameterFile, rule: str, times: int) -> None:
        """Strike out the mutants of a rule that give another number of findings."""
        self.alive[rule] = [mutant for mutant in self.alive[rule] if self._count(file, mutant.rule) == times]

    def _count(self, file: ParameterFile, rule: Rule) -> int:
        checks = RuleChecks(file, file.machine)
        return sum(checks.finding(check) is not None for check in checks_of(file.situation, (rule,)))


def test_no_mutant_of_a_rule_passes_the_table(rule_cases, stands) -> None:
    campaign = Campaign()
    assert campaign.total > (1400 if EVERY_MUTANT else 900)
    for name in ("mill", "lathe", "router"):
        for rule in campaign.alive:
            campaign.expect(stands(name).file, rule, 0)
    for case in rule_cases:
        stand = stands(case.of)
        with stand.changed(case.given):
            campaign.expect(stand.file, case.rule, 0)
            for texts, times in ((case.breaks, case.times), (case.holds, 0)):
                if texts is not None:
                    with stand.changed(texts):
                        campaign.expect(stand.file, case.rule, times)
    alive = [mutant for left in campaign.alive.values() for mutant in left]
    unknown = [f"{mutant.rule.id}: {mutant.change}" for mutant in alive if not says_the_same(mutant)]
    assert unknown == [], (
        f"{len(unknown)} of {campaign.total} mutants pass: add a case that tells them from the rule"
    )


@pytest.mark.parametrize("rule", THE_SAME)
def test_a_mutant_that_says_the_same_belongs_to_a_rule(rule: str) -> None:
    assert rule in {known.id for known in load_schema("9pc").rules}
