"""A machine builder's own rules: ``rules.yaml`` beside his files.

It contains ``rules`` in the form of the database's own, and ``suppressions``: findings that the builder has
checked and leaves as they are, with his name and the reason. What cannot be used in it is a finding itself,
with file and line, and keeps nothing else from being checked.
"""

from __future__ import annotations

import codecs
from collections.abc import Iterable, Iterator, Mapping
from functools import cache, lru_cache, partial
from pathlib import Path
from types import MappingProxyType
from typing import Any

from amp_studio.files import Notify, SaveError, digest_of, with_item, write_atomic
from amp_studio.schema import (
    BuilderRule,
    DatabaseError,
    Evaluation,
    FactEntry,
    KeyPath,
    MachineSchema,
    Parameter,
    Schema,
    Slip,
    Suppression,
    YamlError,
    did_you_mean,
    family_ids,
    load_schema,
    read_address,
    read_entries,
    read_yaml,
)

from .builder_rules import BuilderRules
from .expression_tree import quoted
from .expressions import RuleError
from .finding import OWN_FAULT, Finding
from .plan import checks_of
from .plausible import TITLES
from .rule_entry import entry_model
from .rule_review import MAX_STEPS, review

_SUPPRESSIONS = "suppressions"
GENERAL_RULES = ("schema.range", "schema.choice", "schema.unset", "schema.unknown", *TITLES)
"""Findings of every family that are of no separate rule."""
MAX_RULES = 2000
_MAX_SUPPRESSIONS = 10_000
MAX_FAULTS = 200
"""Of a file: the rest is reported in one finding."""
_MAX_STEPS_OF_FILE = 4 * MAX_STEPS
"""Of all its rules together."""


_NO_AXES: Mapping[str, str] = MappingProxyType({})


def read_builder_rules(path: Path, schema: Schema, axes: Mapping[str, str] = _NO_AXES) -> BuilderRules:
    """Return what a file means for files of a family; faults of the file are findings.

    ``axes`` is letter -> axis of the file at hand: a rule may read ``servo.initial_gain@X``.
    """
    try:
        return _read(path, digest_of(path), schema, tuple(sorted(axes.items())))
    except OSError as error:
        fault = DatabaseError(path, None, f"cannot be read: {error.strerror}")
        return BuilderRules(faults=(_finding(path, fault),))


@lru_cache(maxsize=32)  # it lies beside many files
def _read(path: Path, _digest: str | None, schema: Schema, axes: tuple[tuple[str, str], ...]) -> BuilderRules:
    return _RuleFileReader(path, schema, dict(axes)).read()


class _RuleFileReader:
    """What is found in one file of rules for one family."""

    def __init__(self, path: Path, schema: Schema, axes: Mapping[str, str]) -> None:
        self._path, self._schema, self._axes = path, schema, axes
        self._rules: dict[str, BuilderRule] = {}
        self._places: dict[str, str] = {}
        self._costs: dict[str, int] = {}
        self._lines: dict[str, int | None] = {}
        """Id of every rule of the file, usable or not, of this family or another -> its line."""
        self._families = family_ids()
        self._cost = 0
        self._faults: list[DatabaseError] = []

    def read(self) -> BuilderRules:
        entries, self._faults = read_entries(self._path, ("rules", _SUPPRESSIONS))
        used: dict[str, list[FactEntry]] = {}
        for kind, most in (("rules", MAX_RULES), (_SUPPRESSIONS, _MAX_SUPPRESSIONS)):
            of_kind = [entry for entry in entries if entry.kind == kind]
            for entry in of_kind[most : most + 1]:
                self._fault(
                    entry,
                    (),
                    f"there are {len(of_kind):,} {kind}, and {most:,} are the most; the rest is not used",
                )
            used[kind] = of_kind[:most]
        for entry in used["rules"]:
            self._rule(entry)
        # A suppression may name a rule of this file.
        suppressions = tuple(found for entry in used[_SUPPRESSIONS] if (found := self._suppression(entry)))
        return BuilderRules(
            tuple(self._rules.values()), suppressions, tuple(self._findings()), self._places, self._costs
        )

    def _fault(self, entry: FactEntry, place: KeyPath, what: str) -> None:
        steps = " ".join(str(step + 1) if isinstance(step, int) else quoted(step)[1:-1] for step in place)
        words = [word for word in (_named(entry.data), steps) if word]
        self._faults.append(DatabaseError(self._path, entry.line(place), ": ".join([*words, what])))

    def _findings(self) -> Iterator[Finding]:
        shown_faults = sorted(self._faults, key=lambda fault: fault.line or 0)[:MAX_FAULTS]
        for fault in shown_faults:
            yield _finding(self._path, fault)
        if more := len(self._faults) - len(shown_faults):
            yield Finding(OWN_FAULT, "error", (), f"{self._path.name}: {more:,} more entries cannot be used.")

    # -- rules -----------------------------------------------------------------

    def _rule(self, entry: FactEntry) -> None:
        """Keep a rule, or note what is wrong with its entry; one of another family is only read."""
        rule, slips = entry_model(self._by_number(entry.data), BuilderRule)
        family = rule.family if rule else ""
        # A rule of an unknown family would be of another one, and silently never run.
        if family and family not in self._families:
            slips.append(
                (("family",), f"{quoted(family)} is no family{did_you_mean(family, self._families)}")
            )
        if rule and entry.data.get("id") == rule.id:
            slips += self._same_id(entry, rule)
        if rule and family in ("", self._schema.family.family):
            slips += self._reviewed(entry, rule, slips)
        for place, what in slips:
            self._fault(entry, place, what)

    def _reviewed(self, entry: FactEntry, rule: BuilderRule, slips: list[Slip]) -> list[Slip]:
        """Return what else is wrong with a rule; one with nothing wrong that is of this family is kept."""
        found = review(rule, self._schema, any_family=not rule.family)
        more = _further(found.slips, slips)
        if slips or more or not found.is_ours:
            return more
        more = self._try(rule, found.cost)
        if not more:
            self._rules[rule.id], self._costs[rule.id] = rule, found.once
            self._places[rule.id] = f"{self._path.name}, line {entry.line(())}"
        return more

    def _by_number(self, data: Any) -> Any:
        """Return an entry whose ``reads`` have the axes of the schema in place of their letters in this
        file.
        """
        if not self._axes or not isinstance(data, dict) or not isinstance(data.get("reads"), dict):
            return data
        reads = {name: self._address(text) for name, text in data["reads"].items()}
        return {**data, "reads": reads}

    def _address(self, text: Any) -> Any:
        """Return what is read, with the axis that a letter of the file means."""
        name, sign, letter = text.rpartition("@") if isinstance(text, str) else ("", "", "")
        parameter = self._schema.parameters.get(name)
        if not sign or parameter is None or letter not in self._axes:
            return text
        machines = (self._schema.on(machine.key) for machine in self._schema.family.machines)
        # An instance that the family itself calls so is meant before a letter of this file.
        if any(letter in machine.instances(parameter) for machine in machines):
            return text
        return f"{name}@{self._axes[letter]}"

    def _same_id(self, entry: FactEntry, rule: BuilderRule) -> list[Slip]:
        line = self._lines.setdefault(rule.id, entry.line(()))
        if rule.id in _ids(self._schema):
            return [(("id",), f"a rule of {self._schema.family.family} has this id already")]
        if line != entry.line(()):
            return [(("id",), f"the rule in line {line} has this id already")]
        return []

    def _try(self, rule: BuilderRule, cost: int) -> list[Slip]:
        """See whether a rule can be used on every machine type, and is not one too many."""
        if self._cost + cost > _MAX_STEPS_OF_FILE:
            return [
                ((), "with those before it the rules can take too many steps: let them go over fewer lists")
            ]
        try:
            for machine in self._schema.family.machines:
                checks_of(Evaluation(self._schema, lambda _: None, partial(str, machine.key)), (rule,))
        except RuleError as fault:
            return [(("reads",), fault.what)]
        self._cost += cost
        return []

    # -- suppressions ----------------------------------------------------------

    def _suppression(self, entry: FactEntry) -> Suppression | None:
        """Return a suppression that is about this family."""
        found, slips = entry_model(entry.data, Suppression)
        if found and not slips:
            if self._is_of_another_family(found):
                return None
            slips += self._suppression_slips(found)
        for place, what in slips:
            self._fault(entry, place, what)
        return None if slips else found

    def _is_of_another_family(self, suppression: Suppression) -> bool:
        """Return whether a suppression is about a rule, or parameters, that only another family has."""
        if suppression.rule in self._rules or suppression.rule in _ids(self._schema):
            return False
        if suppression.rule in GENERAL_RULES:
            return bool(suppression.params) and all(
                _is_elsewhere(text, self._schema) for text in suppression.params
            )
        others = {*self._families} - {self._schema.family.family}
        return suppression.rule in self._lines or suppression.rule.partition(".")[0] in others

    def _suppression_slips(self, suppression: Suppression) -> list[tuple[KeyPath, str]]:
        """Return what a suppression names that there is not."""
        known = [*self._rules, *_ids(self._schema), *GENERAL_RULES]
        if suppression.rule in known:
            return list(self._unknown_params(suppression))
        near = did_you_mean(suppression.rule, [*self._lines, *_ids(self._schema), *GENERAL_RULES])
        return [(("rule",), f"{quoted(suppression.rule)} is no rule{near}")]

    def _unknown_params(self, suppression: Suppression) -> Iterator[Slip]:
        for n, text in enumerate(suppression.params):
            if not _is_known(text, self._schema) and not _is_elsewhere(text, self._schema):
                near = did_you_mean(text.partition("@")[0], self._schema.parameters)
                yield ("params", n), f"{quoted(text)} is no parameter of {self._schema.family.family}{near}"


def _further(slips: list[Slip], before: list[Slip]) -> list[Slip]:
    """Return what is wrong besides what is known to be: a key that cannot be used is not checked again."""
    wrong = {place[0] for place, _ in before if place}
    return [(place, what) for place, what in slips if (place[:1] or ("",))[0] not in wrong]


def _named(data: object) -> str:
    """Return the id of a rule, as messages show it."""
    name = data.get("id") if isinstance(data, dict) else None
    return quoted(name)[1:-1] if isinstance(name, str) and name else ""


@cache
def _ids(schema: Schema) -> frozenset[str]:
    return frozenset(rule.id for rule in schema.rules)


@lru_cache(maxsize=4096)
def _is_known(text: str, schema: Schema) -> bool:
    """Return whether a family has what a suppression names, on whatever machine type."""
    parameter_id, which = read_address(text.strip().casefold())
    parameter = schema.parameters.get(parameter_id)
    machines = [schema.on(machine.key) for machine in schema.family.machines]
    if parameter is None:
        word = text.strip().rpartition(".")[0] or text  # of one of its bits
        return any(on.addressed_by(text) or on.words(text) or on.addressed_by(word) for on in machines)
    if not which:
        return True
    return any(_has_instance(on, parameter, which) for on in machines)


def _has_instance(on: MachineSchema, parameter: Parameter, which: str) -> bool:
    # An axis may be named by a letter that the file gives it.
    is_letter = which.isalpha() and on.kin(on.scopes[parameter.id], "axis")
    return is_letter or which in map(str.casefold, on.instances(parameter))


@lru_cache(maxsize=4096)
def _is_elsewhere(text: str, schema: Schema) -> bool:
    """Return whether another family has what a suppression names, and this one has not."""
    return not _is_known(text, schema) and any(
        _is_known(text, load_schema(family)) for family in family_ids() if family != schema.family.family
    )


def _finding(path: Path, fault: DatabaseError) -> Finding:
    text = _fault_text(path, fault)
    return Finding(OWN_FAULT, "error", (), text if text.endswith("?") else f"{text}.")


def _fault_text(path: Path, fault: DatabaseError) -> str:
    return f"{path.name}{f', line {fault.line}' if fault.line else ''}: {fault.what.rstrip('.')}"


def suppress(
    path: Path,
    rule: str,
    params: Iterable[str],
    *,
    reason: str,
    by: str,
    notify: Notify = lambda _message: None,
) -> None:
    """Add a suppression to a file of rules, which is made where there is none; no other byte of it changes.

    ``notify`` is called with what the save could not keep. Raises ValueError where reason or name is missing
    or the file cannot be read, SaveError where it cannot be written.
    """
    try:
        entry = Suppression(rule=rule, params=tuple(params), reason=reason.strip(), by=by.strip())
    except ValueError:
        raise ValueError("A suppression needs a reason and a name.") from None
    item = entry.model_dump(exclude_defaults=True)
    write_atomic(path, lambda previous: _with_suppression(path, previous or b"", item), notify=notify)


def _with_suppression(path: Path, previous: bytes, item: dict[str, Any]) -> bytes:
    """Return the content of a file of rules with one more suppression, read back; raises ValueError,
    SaveError.
    """
    try:
        document = read_yaml(previous.decode("utf-8"), spans=True)
        data = {} if document.data is None else document.data
        there = data.get(_SUPPRESSIONS) or [] if isinstance(data, dict) else None
        if not isinstance(there, list):
            raise ValueError(f"{path.name} has no list of suppressions.")
        wanted = data | {_SUPPRESSIONS: [*there, item]}
        text = with_item(document, _SUPPRESSIONS, item)
    except (UnicodeDecodeError, YamlError) as error:
        raise ValueError(f"{path.name} cannot be read: {error}") from None
    try:
        # Read back before it replaces anything: a file written by hand may have what the amending did not
        # foresee.
        if text is None or read_yaml(text).data != wanted:
            raise SaveError(f"{path} was not written: the suppression would be read back otherwise")
    except YamlError as error:
        raise SaveError(f"{path} was not written: {error}") from None
    # The reader drops the mark; a file of a Windows editor keeps it.
    # kept.
    mark = codecs.BOM_UTF8 if previous.startswith(codecs.BOM_UTF8) else b""
    return mark + text.encode("utf-8")
