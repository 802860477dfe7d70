"""The cases of every family's rules, and the sound machines on which they are tried.

``rule_cases/README.md`` says how cases are written, ``sound_machines/<family>/`` holds the machines.
"""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML

from amp_studio.demo import examples_folder
from amp_studio.files import ParameterFile, new_file, open_file
from amp_studio.schema import Address, Value, canonical_value, family_ids
from amp_studio.validate import Finding, Setting, Validator

HERE = Path(__file__).parent
FAMILIES = tuple(family_ids())

Change = Mapping[str, str | None]
"""``id@instance`` or a number -> the value as a person writes it; None takes the value away."""

SEVERAL = re.compile(r"(?P<before>.*?)(?:(?P<first>\d+)\.\.(?P<last>\d+)|(?<=@)(?P<each>\w+(?:,\w+)+))")
"""``id@0..9``, ``Pr61..64`` and ``id@X,Y`` are several at once."""


def read(path: Path) -> dict[str, Any]:
    """Return what a YAML file of these folders holds."""
    return YAML(typ="safe").load(path.read_text("utf-8")) or {}


def each(name: str) -> list[str]:
    """Return the names that one name of a change stands for."""
    several = SEVERAL.fullmatch(name)
    if several is None:
        return [name]
    if several["each"]:
        return [several["before"] + one for one in several["each"].split(",")]
    return [f"{several['before']}{n}" for n in range(int(several["first"]), int(several["last"]) + 1)]


def value_of(file: ParameterFile, address: Address, text: str) -> Value:
    """Return what a person means who writes millimetres also for what turns."""
    return file.read(address, text.replace("mm", "deg") if file.evaluation.turns(address) else text)


def change(file: ParameterFile, texts: Change) -> list[Address]:
    """Write values into a file as a person would, out of range if it must be; returns where."""
    wanted: dict[Address, Value | None] = {}
    for name, text in ((one, text) for several, text in texts.items() for one in each(several)):
        address = file.find(name)
        wanted[address] = None if text is None else value_of(file, address, str(text))
    file.set_many(wanted, force="by a test")
    return list(wanted)


# ------------------------------------------------------------------------------------------- sound machines


@cache
def machines(family: str) -> dict[str, Any]:
    """Return the sound machines of a family, as they are written; the first is the one that cases start from."""
    return read(HERE / "sound_machines" / family / "machines.yaml")


def sound(family: str, name: str) -> ParameterFile:
    """Return a machine in which nothing is to be found: a new one or an example, with values of its own."""
    written = machines(family)
    one = written["machines"][name]

    def values(of: Mapping[str, Any]) -> Iterator[Change]:
        """Yield the values of the parts that a machine or an axis is like, then its own."""
        for part in of.get("like", ()):
            listed = written.get("parts", {})
            yield listed[part] if part in listed else read(HERE / "sound_machines" / family / f"{part}.yaml")
        yield of.get("own", {})

    if "example" in one:
        (path,) = (examples_folder() / one["example"]).glob("*.amp")
        file = open_file(path).file
        file.header.machine = one.get("type", file.header.machine)
        file.evaluation.forget()
    else:
        file = new_file(family, one.get("type"), [axis["name"] for axis in one.get("axes", ())])
    for part in values(one):
        change(file, part)
    for n, axis in enumerate(one.get("axes", ()), 1):
        for part in values(axis):
            change(file, {f"{name}@{n}": text for name, text in part.items()})
    return file


class Stand:
    """A machine on which changes are tried and taken back."""

    def __init__(self, family: str, machine: str, application: str = "") -> None:
        self.file = sound(family, machine)
        if application:
            self.file.header.application = application
            self.file.evaluation.forget()
        self.validator = Validator(self.file)
        self._findings = self.validator.run()
        self._changed: set[Address] = set()
        """What was changed since anybody asked for the findings."""

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What is found in the machine as it stands now."""
        if self._changed:
            self._findings = self.validator.update(self._changed)
            self._changed = set()
        return self._findings

    def of(self, rule: str) -> list[Finding]:
        """Return the findings of one rule."""
        return [finding for finding in self.findings if finding.rule == rule]

    def set(self, values: Mapping[Address, Value]) -> None:
        """Set values, whether they are allowed or not."""
        for address, value in values.items():
            self.file.set(address, value)
        self._changed |= values.keys()

    @contextmanager
    def changed(self, texts: Change) -> Iterator[None]:
        """Make changes, and take back at the end whatever was changed."""
        with self.recorded():
            self._changed.update(change(self.file, texts))
            yield

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
            self._changed |= touched | (forced.keys() ^ self.file.forced.keys())
            self.file.forced.clear()
            self.file.forced.update(forced)


@cache
def stand(family: str, machine: str, application: str = "") -> Stand:
    """Return the machine, the same one for all who ask."""
    return Stand(family, machine, application)


# ---------------------------------------------------------------------------------------------------- cases


@dataclass(frozen=True)
class Case:
    """One way to break a rule, and one that nearly does; ``rule_cases/README.md`` explains the fields."""

    family: str
    rule: str
    n: int
    of: str
    application: str = ""
    given: Change = field(default_factory=dict)
    breaks: Change | None = None
    times: int = 1
    uses: Change | None = None
    mends: Change | None = None
    says: str | list[str] = ""
    unmended: str = ""
    holds: Change | None = None

    def __str__(self) -> str:
        return f"{self.rule}-{self.n}"

    @property
    def stand(self) -> Stand:
        """The machine it starts from."""
        return stand(self.family, self.of, self.application)

    def offers(self, found: Iterable[Finding]) -> bool:
        """Tell whether findings, of the machine as it stands now, offer what the case says it ``mends``."""
        return self._are(self.mends or {}, (setting for finding in found for setting in finding.fix))

    def knows_used(self, found: Iterable[Finding]) -> bool:
        """Tell whether findings, of the machine as it stands now, tell what the case says the control ``uses``."""
        return self._are(self.uses or {}, (used for finding in found for used in finding.effective))

    def is_said(self, found: Collection[Finding]) -> bool:
        """Tell whether every piece that the case ``says`` is in the message of a finding."""
        pieces = [self.says] if isinstance(self.says, str) else self.says
        return all(any(piece in finding.message for finding in found) for piece in pieces)

    def _are(self, texts: Change, settings: Iterable[Setting]) -> bool:
        """Tell whether settings are the values written, but for the last digits of a number."""
        wanted = {a: str(text) for name, text in texts.items() for a in map(self.stand.file.find, each(name))}
        got = {setting.address: setting.value for setting in settings}
        return wanted.keys() == got.keys() and all(
            _as_good_as_equal(value_of(self.stand.file, address, text), got[address])
            for address, text in wanted.items()
        )


def _as_good_as_equal(one: Value, other: Value) -> bool:
    """Tell whether two values are equal, numbers but for the last digits."""
    numbers = [canonical_value(value) for value in (one, other)]
    if all(isinstance(number, float) for number in numbers):
        return math.isclose(*numbers, rel_tol=1e-9)
    return one == other


@cache
def cases(family: str) -> tuple[Case, ...]:
    """Read the tables of a family, one for each file of rules."""
    usual = next(iter(machines(family)["machines"]))
    tables = map(read, sorted((HERE / "rule_cases" / family).glob("*.yaml")))
    written = [item for table in tables for item in table.items()]
    return tuple(
        Case(family, rule, n, **{"of": usual} | row)
        for rule, rows in written
        for n, row in enumerate(rows, 1)
    )


def all_cases() -> tuple[Case, ...]:
    """Return the cases of all families."""
    return tuple(case for family in FAMILIES for case in cases(family))
