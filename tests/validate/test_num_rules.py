"""Every rule of the NUM family is broken by the change the table names, holds beside it, and its repair mends it.

The tables are in ``rule_cases/num/``, a file a group, with rows as those of the 9/PC (see ``conftest.py``); what they
change is the sound machine that the files ``machine*.yaml`` beside them describe together. ``id@0..9`` there stands
for ten instances.
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
from amp_studio.schema import load_schema
from amp_studio.validate import Finding, Validator

FOLDER = Path(__file__).parent / "rule_cases" / "num"
RULES = {rule.id: rule for rule in load_schema("num").rules}
SPAN = re.compile(r"(.+@)([0-9]+)\.\.([0-9]+)")


def read(name: str) -> dict[str, Any]:
    """Return what the files of a name hold together."""
    return {
        key: value
        for path in sorted(FOLDER.glob(name))
        for key, value in (YAML(typ="safe").load(path.read_text("utf-8")) or {}).items()
    }


def change(file: ParameterFile, texts: dict[str, str | None]) -> list[tuple[str, str]]:
    """Write values into a file as a person would, out of range if it must be; returns where."""
    wanted = {}
    for name, text in texts.items():
        span = SPAN.fullmatch(name)
        for one in [f"{span[1]}{n}" for n in range(int(span[2]), int(span[3]) + 1)] if span else [name]:
            address = file.find(one)
            wanted[address] = None if text is None else file.read(address, str(text))
    file.set_many(wanted, force="by a test")
    return list(wanted)


class Stand:
    """The sound machine, on which changes are tried and taken back."""

    def __init__(self) -> None:
        self.file = new_file("num")
        for path in sorted(
            FOLDER.glob("machine*.yaml")
        ):  # what an axis is decides in which unit the rest is read
            change(self.file, read(path.name))
        self.validator = Validator(self.file)
        self.findings = self.validator.run()

    @contextmanager
    def changed(self, texts: dict[str, str | None], application: str | None = None) -> Iterator[None]:
        """Make changes, and take them back at the end."""
        values, forced, before = dict(self.file.values), dict(self.file.forced), self.file.header.application
        self.file.header.application = application or before
        try:
            self.findings = self.validator.update(change(self.file, texts))
            yield
        finally:
            changed = {a for a in values | self.file.values if values.get(a) != self.file.values.get(a)}
            for address in changed:
                self.file.set(address, values.get(address))
            self.file.forced.clear()
            self.file.forced.update(forced)
            self.file.header.application = before
            self.findings = self.validator.update(changed)

    def of(self, rule: str) -> list[Finding]:
        """Return the findings of one rule."""
        return [finding for finding in self.findings if finding.rule == rule]


@cache
def stand() -> Stand:
    return Stand()


CASES = [
    pytest.param(rule, row, id=f"{rule}-{n}")
    for path in sorted(FOLDER.glob("[!m]*.yaml")) + sorted(FOLDER.glob("m[!a]*.yaml"))
    for rule, rows in (YAML(typ="safe").load(path.read_text("utf-8")) or {}).items()
    for n, row in enumerate(rows, 1)
]


def test_in_the_sound_machine_nothing_is_found() -> None:
    assert [finding for finding in stand().findings if finding.rule != "schema.unset"] == []


def test_every_rule_has_a_case_that_breaks_it_and_one_that_just_does_not() -> None:
    for key in ("breaks", "holds"):
        assert {case.values[0] for case in CASES if key in case.values[1]} == RULES.keys()


def test_every_rule_that_says_what_the_control_uses_has_a_case_of_it() -> None:
    told = {case.values[0] for case in CASES if "uses" in case.values[1]}
    assert told == {rule.id for rule in RULES.values() if rule.effective}


@pytest.mark.parametrize(("rule", "row"), CASES)
def test_a_rule_speaks_when_it_is_broken_and_only_then(rule: str, row: dict[str, Any]) -> None:
    here, model = stand(), row.get("application")
    with here.changed(row.get("given", {}), model):
        assert here.of(rule) == []
        if "breaks" in row:
            with here.changed(row["breaks"], model):
                found = here.of(rule)
                assert len(found) == row.get("times", 1)
                for finding in found:
                    assert (finding.severity, finding.page) == (RULES[rule].severity, RULES[rule].page)
                    assert not re.search(r"[{}?]", finding.message), "every name of the message has its value"
                uses = {used.address: used.value for finding in found for used in finding.effective}
                assert not uses or RULES[rule].effective
                for name, text in row.get("uses", {}).items():
                    assert uses[here.file.find(name)] == here.file.read(here.file.find(name), str(text))
                repairs = {repair.address: repair.value for f in found for repair in f.repairs}
                assert bool(repairs) == bool(RULES[rule].fix) or "unmended" in row
                before = {address: here.file.get(address) for address in repairs}
                for address, value in repairs.items():
                    here.file.set(address, value)
                here.findings = here.validator.update(repairs)
                assert not repairs or here.of(rule) == []
                for address, value in before.items():
                    here.file.set(address, value)
        if "holds" in row:
            with here.changed(row["holds"], model):
                assert here.of(rule) == []
