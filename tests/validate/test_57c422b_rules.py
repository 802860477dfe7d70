"""Every rule of the 57C422B is broken by the change the table names, holds beside it, and its repair mends it.

The tables are in ``rule_cases/57c422b/``, a file a group, with rows as those of the 9/PC (see ``conftest.py``); what
they change is the sound machine of ``machine.yaml`` beside them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Address, Rule, Value, load_schema
from amp_studio.validate import Finding, Validator
from amp_studio.validate.plan import checks_of
from amp_studio.validate.rules import RuleChecks

FOLDER = Path(__file__).parent / "rule_cases" / "57c422b"
RULES = {rule.id: rule for rule in load_schema("57c422b").rules}

Change = dict[str, str | None]


def read(name: str) -> dict[str, Any]:
    """Return what a file of the folder holds."""
    return YAML(typ="safe").load((FOLDER / name).read_text("utf-8"))


def change(file: ParameterFile, texts: Change) -> list[Address]:
    """Write values into a file as a person would, out of range if it must be; returns where."""
    wanted: dict[Address, Value | None] = {}
    for name, text in texts.items():
        address = file.find(name)
        wanted[address] = None if text is None else file.read(address, str(text))
    file.set_many(wanted, force="by a test")
    return list(wanted)


class Stand:
    """The sound machine, on which changes are tried and taken back."""

    def __init__(self) -> None:
        self.file = new_file("57c422b")
        machine = read("machine.yaml")
        change(self.file, machine["module"])
        for axis in ("X", "Y"):
            own = machine["both"] | machine[axis]
            change(self.file, {key if "@" in key else f"{key}@{axis}": text for key, text in own.items()})
        self.validator = Validator(self.file)
        self.findings = self.validator.run()

    @contextmanager
    def changed(self, texts: Change) -> Iterator[None]:
        """Make changes, and take them back at the end."""
        values, forced = dict(self.file.values), dict(self.file.forced)
        try:
            self.findings = self.validator.update(change(self.file, texts))
            yield
        finally:
            touched = {a for a in values | self.file.values if values.get(a) != self.file.values.get(a)}
            for address in touched:
                self.file.set(address, values.get(address))
            self.file.forced.clear()
            self.file.forced.update(forced)
            self.findings = self.validator.update(touched)

    def of(self, rule: str) -> list[Finding]:
        """Return the findings of one rule."""
        return [finding for finding in self.findings if finding.rule == rule]


@cache
def stand() -> Stand:
    return Stand()


CASES = [
    (rule, row)
    for path in sorted(FOLDER.glob("*.yaml"))
    if path.name != "machine.yaml"
    for rule, rows in read(path.name).items()
    for row in rows
]
NAMED = [pytest.param(*case, id=f"{case[0]}-{n}") for n, case in enumerate(CASES, 1)]


def test_in_the_sound_machine_nothing_is_found() -> None:
    assert [finding for finding in stand().findings if finding.rule != "schema.unset"] == []


def test_every_rule_has_a_case_that_breaks_it_and_one_that_just_does_not() -> None:
    for key in ("breaks", "holds"):
        assert {rule for rule, row in CASES if key in row} == RULES.keys()


@pytest.mark.parametrize(("rule", "row"), NAMED)
def test_a_rule_speaks_when_it_is_broken_and_only_then(rule: str, row: dict[str, Any]) -> None:
    here = stand()
    with here.changed(row.get("given", {})):
        assert here.of(rule) == []
        if "breaks" in row:
            with here.changed(row["breaks"]):
                (found,) = here.of(rule)
                assert (found.severity, found.page) == (RULES[rule].severity, RULES[rule].page)
                assert not re.search(r"[{}?]", found.message), "every name of the message has its value"
                assert bool(found.repairs) == bool(RULES[rule].fix)
                uses = {setting.address: setting.value for setting in found.effective}
                assert bool(uses) == bool(RULES[rule].effective)
                for name, text in row.get("uses", {}).items():
                    address = here.file.find(name)
                    assert uses[address] == here.file.read(address, str(text))
                with here.changed({}):
                    for repair in found.repairs:
                        here.file.set(repair.address, repair.value)
                    here.findings = here.validator.update(repair.address for repair in found.repairs)
                    assert found.repairs == () or here.of(rule) == []
        if "holds" in row:
            with here.changed(row["holds"]):
                assert here.of(rule) == []


# -- the tables are sharp: a rule changed in one place no longer gives what they say -------------------

FLIPS = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&"}
PLACE = re.compile(r"<=|>=|==|!=|&&|\|\||<|>|(?<![\w.])\d+\.\d+|(?<=!)bit|(?<![!\w])bit")

THE_SAME = {
    # 32767 is the largest denominator; six digits or seven only take away what the division left.
    "57c422b.command.gear-ratio-illegal": {"numerator * 32768.0", "32767.0, 7.0)"},
    # 0 times anything decides as the condition before it; 32767 is the largest denominator.
    "57c422b.command.gear-words-range": {"denominator >= 0.0", "32768.0"},
}
"""Mutants that say the same as the rule, by a piece of their text, each with the reason."""


def mutants(rule: Rule) -> Iterator[tuple[Rule, str]]:
    """Yield a rule with one operator, one number or one negation changed after the other."""
    for part in ("check", "when"):
        text = " ".join(getattr(rule, part).split())
        for found in PLACE.finditer(text):
            start, end, instead = found.start(), found.end(), FLIPS.get(found[0], "")
            if found[0] == "bit":
                start, instead = (start - 1, "bit") if text[start - 1 : start] == "!" else (start, "!bit")
            elif not instead:
                instead = repr(float(found[0]) + 1)
            changed = text[:start] + instead + text[end:]
            yield rule.model_copy(update={part: changed}), changed


def count(file: ParameterFile, rule: Rule) -> int:
    checks = RuleChecks(file, file.machine)
    return sum(checks.finding(check) is not None for check in checks_of(file.situation, (rule,)))


@pytest.mark.parametrize("rule", RULES)
def test_no_mutant_of_a_rule_passes_the_table(rule: str) -> None:
    here = stand()
    alive = [(mutant, text) for mutant, text in mutants(RULES[rule]) if count(here.file, mutant) == 0]
    for _, row in (case for case in CASES if case[0] == rule):
        with here.changed(row.get("given", {})):
            for key in ("breaks", "holds"):
                if key in row:
                    with here.changed(row[key]):
                        alive = [m for m in alive if count(here.file, m[0]) == (key == "breaks")]
    unknown = [text for _, text in alive if not any(piece in text for piece in THE_SAME.get(rule, ()))]
    assert unknown == [], "add a case that tells them from the rule"
