"""Sound machines, in which nothing is to be found, and for every rule the changes that break it and that just do not."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from ruamel.yaml import YAML

from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Address, Value
from amp_studio.validate import Finding, Validator

Change = Mapping[str, str | None]
"""``id@instance`` -> the value as a person writes it; None takes the value away."""


def change(file: ParameterFile, texts: Change) -> list[Address]:
    """Write values into a file as a person would, out of range if it must be; returns where."""
    wanted: dict[Address, Value | None] = {}
    for name, text in texts.items():
        address = file.find(name)
        written = str(text).replace("mm", "deg") if file.situation.turns(address) else str(text)
        wanted[address] = None if text is None else file.read(address, written)
    file.set_many(wanted, force="by a test")
    return list(wanted)


def sound(name: str) -> ParameterFile:
    """Return a machine in which nothing is to be found."""
    text = Path(__file__).with_name("sound_machines.yaml").read_text("utf-8")
    written = YAML(typ="safe").load(text)

    def values(one: Mapping[str, Any]) -> dict[str, str]:
        """Return the values of the parts that a machine or an axis is like, and its own over them."""
        parts = [written["parts"][part] for part in one["like"]]
        return dict(item for values in (*parts, one.get("own", {})) for item in values.items())

    machine = written["machines"][name]
    file = new_file("9pc", machine["type"], [axis["name"] for axis in machine["axes"]])
    change(file, values(machine))
    for n, axis in enumerate(machine["axes"], 1):
        change(file, {f"{name}@{n}": text for name, text in values(axis).items()})
    return file


# ------------------------------------------------------------------------- machines that are broken and mended


class Stand:
    """A machine on which changes are tried and taken back."""

    def __init__(self, machine: str) -> None:
        self.file = sound(machine)
        self.validator = Validator(self.file)
        self.findings = self.validator.run()

    @contextmanager
    def changed(self, texts: Change) -> Iterator[tuple[Finding, ...]]:
        """Make changes; gives the findings, and takes the changes back at the end."""
        with self.recorded():
            self.findings = self.validator.update(change(self.file, texts) or self.file.addresses())
            yield self.findings

    @contextmanager
    def recorded(self) -> Iterator[None]:
        """Take back at the end whatever is changed."""
        values, forced = dict(self.file.values), dict(self.file.forced)
        try:
            yield
        finally:
            touched = {
                a for a in values.keys() | self.file.values.keys() if values.get(a) != self.file.values.get(a)
            }
            for address in touched:
                self.file.set(address, values.get(address))
            marks = forced.keys() ^ self.file.forced.keys()
            self.file.forced.clear()
            self.file.forced.update(forced)
            self.findings = self.validator.update(touched | marks)


@cache
def stand(machine: str) -> Stand:
    return Stand(machine)


@dataclass(frozen=True)
class Case:
    """One way to break a rule, and one that nearly does.

    Values are written as a person writes them; the lengths of a table or a spindle are degrees.
    """

    rule: str
    n: int
    of: str
    """The machine it starts from."""
    given: Change = field(default_factory=dict)
    """What is changed beforehand; may cause findings of its own, but not of this rule."""
    breaks: Change | None = None
    times: int = 1
    """How many findings of the rule that gives."""
    holds: Change | None = None
    """A change after which it is not broken: where it can be, the next value on the good side of the bound, or the
    same change where the rule does not apply; {} is the machine as it stands."""

    def __str__(self) -> str:
        return f"{self.rule}-{self.n}"


@cache
def cases() -> tuple[Case, ...]:
    """Read the tables of ``rule_cases/``, one for each file of rules."""
    files = sorted(Path(__file__).with_name("rule_cases").glob("*.yaml"))
    tables = [YAML(typ="safe").load(file.read_text("utf-8")) or {} for file in files]
    written = [item for table in tables for item in table.items()]
    return tuple(Case(rule, n, **row) for rule, rows in written for n, row in enumerate(rows, 1))


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    for name in ("breaks", "holds"):
        if f"case_that_{name}" in metafunc.fixturenames:
            chosen = [case for case in cases() if getattr(case, name) is not None]
            metafunc.parametrize(f"case_that_{name}", chosen, ids=str)


@pytest.fixture(scope="session")
def rule_cases() -> tuple[Case, ...]:
    return cases()


@pytest.fixture(scope="session")
def machine() -> Callable[[str], ParameterFile]:
    """Return what builds a sound machine: ``machine("mill")``."""
    return sound


@pytest.fixture(scope="session")
def stands() -> Callable[[str], Stand]:
    """Return what gives the machine of a type on which changes are tried."""
    return stand
