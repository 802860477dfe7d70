"""The cases of every family's rules, and the sound machines on which they are tried.

``rule_cases/README.md`` explains how cases are written; the machines are in ``sound_machines/<family>/``.
"""

import math
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML

from amp_studio.files import Change as Edit
from amp_studio.files import ParameterFile, new_file, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.schema import Address, Value, family_ids
from amp_studio.schema.expression import canonical_value
from amp_studio.validate import AddressedValue, Finding, Validator
from tests.campaigns import CAMPAIGN

HERE = Path(__file__).parent
FAMILIES = tuple(f for f in family_ids() if (HERE / "sound_machines" / f / "machines.yaml").is_file())
"""Those with rules; a family without any needs no machines (tests/schema/test_whole_family.py)."""

Change = Mapping[str, str | None]
"""``id@instance`` or a number -> the value as a person writes it; None takes the value away."""

SEVERAL = re.compile(r"(?P<before>.*?)(?:(?P<first>\d+)\.\.(?P<last>\d+)|(?<=@)(?P<each>\w+(?:,\w+)+))")
"""``id@0..9``, ``Pr61..64`` and ``id@X,Y`` are several at once."""


def read(path: Path) -> dict[str, Any]:
    """Return the content of a YAML file of these folders."""
    return YAML(typ="safe").load(path.read_text("utf-8")) or {}


def each(name: str) -> list[str]:
    """Return the names that one name of a change means."""
    several = SEVERAL.fullmatch(name)
    if several is None:
        return [name]
    if several["each"]:
        return [several["before"] + one for one in several["each"].split(",")]
    return [f"{several['before']}{n}" for n in range(int(several["first"]), int(several["last"]) + 1)]


def value_of(file: ParameterFile, address: Address, text: str) -> Value:
    """Return the value of a text that has millimetres also for what turns."""
    return file.read(address, text.replace("mm", "deg") if file.evaluation.turns(address) else text)


def change(file: ParameterFile, texts: Change) -> list[Address]:
    """Set values in a file, also out of range; returns their addresses."""
    wanted: dict[Address, Value | None] = {}
    for name, text in ((one, text) for several, text in texts.items() for one in each(several)):
        address = file.find(name)
        wanted[address] = None if text is None else value_of(file, address, str(text))
    file.set_checked(wanted, force="by a test")
    return list(wanted)


# ------------------------------------------------------------------------------------------- sound machines


@cache
def machines(family: str) -> dict[str, Any]:
    """Return the sound machines of a family, as written; cases start from the first."""
    return read(HERE / "sound_machines" / family / "machines.yaml")


def sound(family: str, name: str) -> ParameterFile:
    """Return a separate machine without a finding: a new one or an example, with its values changed."""
    return _sound(family, name).copy()


@cache
def _sound(family: str, name: str) -> ParameterFile:
    written = machines(family)
    one = written["machines"][name]

    def values(of: Mapping[str, Any]) -> Iterator[Change]:
        """Yield the values of the parts that a machine or an axis is made of, then its own."""
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


class RulesAlone(Validator):
    """What is wrong by values and rules; unless it is wanted, not what experience asks and what is not set,
    which is a third of the work.
    """

    is_alone = True

    def _general(self) -> list[Any]:
        return [] if self.is_alone else super()._general()

    @property
    def is_fit(self) -> bool:
        """Whether the file is still of the machine type, the model and the units that it was checked for."""
        return self._circumstances == self._present_circumstances()

    def filed(self, rule: str, changed: Iterable[Address]) -> dict[int, Finding]:
        """Return what is found of one rule, by the place of its check and before any fix is tried:
        after edits that no ``update`` has been given yet, without a look at whatever else reads them.
        """
        read = {c.place: c for address in changed for c in self._plan.rule_readers.get(address, ())}
        again = {place: check for place, check in read.items() if check.rule.id == rule}
        found = {p: f for p, (_, f) in self._filed.items() if f.rule == rule and p not in again}
        self._checks.forget_values()
        found |= {check.place: f for check, f in self._checks.rules.findings(again.values())}
        return dict(sorted(found.items(), key=lambda each: self._order(each[1], each[0])))


class TrialMachine:
    """A machine on which changes are tried and undone."""

    def __init__(self, family: str, machine: str, application: str = "") -> None:
        self.file = sound(family, machine)
        if application:
            self.file.header.application = application
            self.file.evaluation.forget()
        self.validator = RulesAlone(self.file)
        self._findings = self.validator.run()
        self._changed: set[Address] = set()
        """What was changed since the findings were last asked for."""
        self._looks = 0
        """How often they were worked out."""

    @property
    def findings(self) -> tuple[Finding, ...]:
        """The findings of the machine as it is now."""
        if self._changed:
            self._findings = self.validator.update(self._changed)
            self._changed = set()
            self._looks += 1
        return self._findings

    def of(self, rule: str) -> list[Finding]:
        """Return the findings of one rule."""
        found = self.filed(rule)
        if any(finding.fix for finding in found.values()):  # what is offered hangs on all that is found
            return [finding for finding in self.findings if finding.rule == rule]
        return list(found.values())

    def filed(self, rule: str) -> dict[int, Finding]:
        """Return what is found of one rule, by the place of its check and before any fix is tried;
        a campaign looks at all else that reads what was changed, too.
        """
        if CAMPAIGN or not self.validator.is_fit:
            _ = self.findings
        return self.validator.filed(rule, self._changed)

    def set(self, values: Mapping[Address, Value]) -> None:
        """Set values, whether they are allowed or not."""
        for address, value in values.items():
            self.file.set(address, value)
        self._changed |= values.keys()

    @contextmanager
    def changed(self, texts: Change) -> Iterator[None]:
        """Make changes, and undo at the end everything that was changed."""
        with self.recorded():
            self._changed.update(change(self.file, texts))
            yield

    @contextmanager
    def recorded(self) -> Iterator[None]:
        """Undo at the end everything that is changed."""
        before: dict[Address, Value | None] = {}
        forced = dict(self.file.forced)
        changed, looks = set(self._changed), self._looks

        def note(made: Edit) -> None:
            before.setdefault(made.address, made.old)

        end = self.file.listen(note)
        try:
            yield
        finally:
            end()
            touched = {a for a, value in before.items() if value != self.file.values.get(a)}
            for address in touched:
                self.file.set(address, before[address])
            self._changed |= touched | (forced.keys() ^ self.file.forced.keys())
            if self._looks == looks:  # nobody has looked: all is as it was
                self._changed = changed
            self.file.forced.clear()
            self.file.forced.update(forced)


@cache
def trial_machine(family: str, machine: str, application: str = "") -> TrialMachine:
    """Return a machine, the same one at each call."""
    return TrialMachine(family, machine, application)


# ---------------------------------------------------------------------------------------------------- cases


@dataclass(frozen=True)
class Case:
    """A change that breaks a rule, and one that just does not; ``rule_cases/README.md`` explains the
    fields.
    """

    family: str
    rule: str
    n: int
    of: str
    application: str = ""
    given: Change = field(default_factory=dict)
    breaks: Change | None = None
    times: int = 1
    effective: Change | None = None
    fix: Change | None = None
    message: str | list[str] = ""
    no_fix: str = ""
    passes: Change | None = None

    def __str__(self) -> str:
        return f"{self.rule}-{self.n}"

    @property
    def machine(self) -> TrialMachine:
        """The machine it starts from."""
        return trial_machine(self.family, self.of, self.application)

    def offers(self, found: Iterable[Finding]) -> bool:
        """Return whether findings of the machine as it is now offer the ``fix`` of the case."""
        return self._are(self.fix or {}, (setting for finding in found for setting in finding.fix))

    def has_effective(self, found: Iterable[Finding]) -> bool:
        """Return whether findings of the machine as it is now have the ``effective`` values of the case."""
        return self._are(self.effective or {}, (used for finding in found for used in finding.effective))

    def has_message(self, found: Collection[Finding]) -> bool:
        """Return whether every piece of the case's ``message`` is in the message of a finding."""
        pieces = [self.message] if isinstance(self.message, str) else self.message
        return all(any(piece in finding.message for finding in found) for piece in pieces)

    def _are(self, texts: Change, settings: Iterable[AddressedValue]) -> bool:
        """Return whether settings are the values written, but for the last digits of a number."""
        wanted = {
            a: str(text) for name, text in texts.items() for a in map(self.machine.file.find, each(name))
        }
        got = {setting.address: setting.value for setting in settings}
        return wanted.keys() == got.keys() and all(
            _as_good_as_equal(value_of(self.machine.file, address, text), got[address])
            for address, text in wanted.items()
        )


def _as_good_as_equal(one: Value, other: Value) -> bool:
    """Return whether two values are equal, numbers but for the last digits."""
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
