"""A machine builder's own rules: ``rules.yaml`` beside his files.

It holds ``rules`` in the form of the database's own, and ``suppressions``: findings that somebody has looked at and
leaves as they are, with his name and the reason. What cannot be used in it is a finding itself, with file and line,
and keeps nothing else from being checked.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache, partial
from io import StringIO
from pathlib import Path

from pydantic import ValidationError

from amp_studio.files import is_there, real_path, write_atomic
from amp_studio.files.atomic import digest_of
from amp_studio.schema import (
    BuilderRule,
    DatabaseFault,
    Rule,
    Schema,
    Situation,
    Suppression,
    family_ids,
    read_entries,
)
from amp_studio.schema.regular_file import read_file

from .expressions import RuleFault
from .finding import Finding
from .plan import checks_of

RULES_FILE = "rules.yaml"
OWN_FAULT = "rules.unusable"
"""The rule that findings about the rules themselves belong to."""


@dataclass(frozen=True)
class BuilderRules:
    """What a file of a builder's rules says to files of one family."""

    rules: tuple[Rule, ...] = ()
    suppressions: tuple[Suppression, ...] = ()
    faults: tuple[Finding, ...] = ()
    """What is wrong with the rules themselves."""


NO_RULES = BuilderRules()


def rules_beside(path: Path, schema: Schema) -> BuilderRules:
    """Return the rules that lie beside a parameter file; none where there is no such file."""
    beside = real_path(path).parent / RULES_FILE
    return read_builder_rules(beside, schema) if is_there(beside) else NO_RULES


def read_builder_rules(path: Path, schema: Schema) -> BuilderRules:
    """Return what a file says to files of a family; faults of the file are findings."""
    try:
        return _read(path, digest_of(path), schema)
    except OSError as error:
        said = DatabaseFault(path, None, f"cannot be read: {error.strerror}")
        return BuilderRules(faults=(_finding(path, said),))


@lru_cache(maxsize=32)  # it lies beside many files
def _read(path: Path, _digest: str | None, schema: Schema) -> BuilderRules:
    entries, faults = read_entries(path, {"rules": BuilderRule, "suppressions": Suppression})
    rules: list[BuilderRule] = []
    suppressions: list[Suppression] = []
    known = {rule.id for rule in schema.rules}
    for entry, line in entries:
        if isinstance(entry, BuilderRule) and entry.family in ("", schema.family.family):
            try:
                _try(entry, schema, known)
            except RuleFault as fault:
                faults.append(DatabaseFault(path, line, str(fault)))
            else:
                known.add(entry.id)
                rules.append(entry)
        elif isinstance(entry, BuilderRule):
            known.add(entry.id)
    others = {*family_ids()} - {schema.family.family}
    for entry, line in entries:
        if isinstance(entry, Suppression) and entry.rule.partition(".")[0] not in others:
            if entry.rule in known or entry.rule.startswith("schema."):
                suppressions.append(entry)
            else:
                faults.append(DatabaseFault(path, line, f"suppresses '{entry.rule}', which is no rule"))
    findings = tuple(_finding(path, fault) for fault in faults)
    return BuilderRules(tuple(rules), tuple(suppressions), findings)


def _finding(path: Path, fault: DatabaseFault) -> Finding:
    return Finding(OWN_FAULT, "error", (), f"{_told(path, fault)}.")


def _try(rule: BuilderRule, schema: Schema, known: set[str]) -> None:
    """See whether a rule can be used on every machine type; raises RuleFault."""
    if rule.id in known:
        raise RuleFault(rule.id, "there are two rules of this name")
    for machine in schema.family.machines:
        checks_of(Situation(schema, lambda _: None, partial(str, machine.key)), (rule,))


def _told(path: Path, fault: DatabaseFault) -> str:
    return f"{path.name}{f', line {fault.line}' if fault.line else ''}: {fault.what.rstrip('.')}"


def suppress(path: Path, rule: str, params: Iterable[str], *, reason: str, by: str) -> None:
    """Add a suppression to a file of rules, which is made where there is none; the rest of it stays as it is.

    Raises ValueError where reason or name is missing or the file cannot be read, SaveFault where it cannot be written.
    """
    from ruamel.yaml import YAML
    from ruamel.yaml.error import YAMLError

    yaml = YAML(typ="rt")
    yaml.preserve_quotes = True
    try:
        entry = Suppression(rule=rule, params=tuple(params), reason=reason.strip(), by=by.strip())
        data = yaml.load(read_file(path).decode("utf-8")) if is_there(path) else None
    except ValidationError:
        raise ValueError("A suppression needs a reason and a name.") from None
    except YAMLError as error:
        raise ValueError(f"{path.name} cannot be read: {str(error).splitlines()[0]}") from None
    if data is None:
        data = {}
    if not isinstance(data, dict) or not isinstance(data.setdefault("suppressions", []), list):
        raise ValueError(f"{path.name} holds no list of suppressions.")
    data["suppressions"].append(entry.model_dump(mode="json", exclude_defaults=True))
    stream = StringIO()
    yaml.dump(data, stream)
    write_atomic(path, stream.getvalue().encode())


@dataclass(frozen=True, slots=True)
class Suppressed:
    """A finding that is left as it is, and who said so."""

    finding: Finding
    suppression: Suppression


def sort_out(
    findings: tuple[Finding, ...], suppressions: tuple[Suppression, ...], situation: Situation
) -> tuple[tuple[Finding, ...], tuple[Suppressed, ...], tuple[Suppression, ...]]:
    """Return the findings that stay, those that are suppressed, and the suppressions that meet nothing any more."""
    meant = [(s, [set(_addresses(situation, text)) for text in s.params]) for s in suppressions]
    stay: list[Finding] = []
    left: list[Suppressed] = []
    for finding in findings:
        by = next(
            (
                s
                for s, every in meant
                if s.rule == finding.rule and not any(named.isdisjoint(finding.addresses) for named in every)
            ),
            None,
        )
        if by is None:
            stay.append(finding)
        else:
            left.append(Suppressed(finding, by))
    used = {id(suppressed.suppression) for suppressed in left}
    return tuple(stay), tuple(left), tuple(s for s, _ in meant if id(s) not in used)


def _addresses(situation: Situation, text: str) -> Iterator[tuple[str, str]]:
    """Yield what a suppression means by a number or an id; an id alone means all its instances."""
    parameter = situation.schema.parameters.get(text)
    if parameter is not None:
        yield from ((parameter.id, i) for i in situation.schema.instances(parameter, situation.machine))
        return
    try:
        yield situation.find(text)
    except LookupError:
        return
