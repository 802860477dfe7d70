"""What has to be checked for a machine type, worked out once for every file of a family.

A plan resolves each rule's names to addresses and turns them round: from an
address to the checks that read it, so that an edit runs only those again.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from itertools import chain, count
from typing import NamedTuple

from amp_studio.schema import (
    Address,
    BuilderRule,
    Evaluation,
    Reference,
    Rule,
    Schema,
    UnknownParameterError,
    quoted,
    read_address,
    record_text,
)

from .expressions import Expressions, RuleError, check_rule, is_list
from .functions import rule_functions

FindingPlace = Address | int
"""Where a finding is filed: under the value that is wrong,
or under the place of the rule's check in the plan."""

_MAX_SOUND_VALUES = 200
"""Values of a group of checks before all are forgotten: of so many machines without a value in common."""


class Single(NamedTuple):
    """A single value that a check reads."""

    name: str
    address: Address
    optional: bool
    any_state: bool


@dataclass(frozen=True, eq=False)
class Listed:
    """Instances that rules read as a list: one object for all that read the same,
    so that it is quick to look up.
    """

    addresses: tuple[Address, ...]

    @cached_property
    def places(self) -> dict[Address, int]:
        """Address -> its place in the list."""
        return {address: n for n, address in enumerate(self.addresses)}


@lru_cache(maxsize=10_000)
def _listed(addresses: tuple[Address, ...]) -> Listed:
    return Listed(addresses)


@dataclass(
    eq=False
)  # not frozen, which would take three times as long to make thousands of them at each start
class RuleCheck:
    """One rule for one instance, its names resolved; never changed."""

    place: int
    """Position among all checks of the plan."""
    rule: Rule
    instance: str
    expressions: Expressions
    names: tuple[str, ...]
    """Of the single values, then of the lists."""
    reads: tuple[Address, ...]
    """The addresses of the single values."""
    lists: tuple[tuple[str, Listed], ...]
    is_own: bool
    """Of a builder's rule."""
    is_lenient: bool
    """Whether some of the single values need not be there, or active."""

    @cached_property
    def singles(self) -> tuple[Single, ...]:
        """The single values that it reads."""
        optional, any_state = self.rule.optional, self.rule.any_state
        own = zip(self.names, self.reads, strict=False)
        return tuple([Single(name, address, name in optional, name in any_state) for name, address in own])

    @cached_property
    def always_about(self) -> tuple[tuple[Address, ...], tuple[Address, ...]] | None:
        """What is wrong, and what that was compared with, if it is the same whatever the values."""
        entries = self.expressions.finding
        if not entries.blames or any(
            condition is not None for _, condition in (*entries.blames, *entries.compares)
        ):
            return None
        causes, compared = (
            dict.fromkeys(self.address_of(name) for name, _ in named)
            for named in (entries.blames, entries.compares)
        )
        return tuple(causes), tuple(address for address in compared if address not in causes)

    @cached_property
    def addresses(self) -> tuple[Address, ...]:
        """Every address the rule reads here, single values first."""
        return (*self.reads, *(a for _, listed in self.lists for a in listed.addresses))

    def is_about(self, address: Address) -> bool:
        """Return whether the rule reads an address here."""
        if address in self.reads:
            return True
        return bool(self.lists) and any(address in listed.places for _, listed in self.lists)

    def address_of(self, name: str) -> Address:
        """Return what a name of a single value means."""
        return self._by_name[name]

    @cached_property
    def _by_name(self) -> dict[str, Address]:
        return {single.name: single.address for single in self.singles}


@dataclass(frozen=True, eq=False)
class CheckGroup:
    """Checks that are made together in a full run."""

    first: Address | None
    """What all of them come to nothing without, where it is not active."""
    together: tuple[RuleCheck, ...]
    """Those that depend on nothing but the values of ``reads``, the machine and the model."""
    reads: tuple[Address, ...]
    others: tuple[RuleCheck, ...]
    sound: Sound
    """The values with which none of ``together`` finds anything, in whatever file."""

    @classmethod
    def of(cls, first: Address | None, checks: Sequence[RuleCheck]) -> CheckGroup:
        """Return the group of some checks."""
        together = tuple([check for check in checks if not check.lists and not check.is_own])
        reads = tuple(dict.fromkeys(address for check in together for address in check.reads))
        others = tuple([check for check in checks if check.lists or check.is_own])
        return cls(first, together, reads, others, Sound())


class Sound(set[Hashable]):
    """Values that were met; few enough that the groups of all plans take some megabytes."""

    def add(self, values: Hashable) -> None:
        if len(self) >= _MAX_SOUND_VALUES:
            self.clear()
        super().add(values)


@dataclass(frozen=True)
class Plan:
    """All checks for one schema, machine type and set of rules."""

    addresses: tuple[Address, ...]
    order: Mapping[Address, int] = field(repr=False)
    """Address -> its place in the manual's order."""
    checks: tuple[RuleCheck, ...]
    evaluation: Evaluation = field(repr=False)
    """Of a file without values."""

    @cached_property
    def needed(self) -> tuple[tuple[Address, ...], ...]:
        """The addresses without which a file is not complete where they are active."""
        parameters = self.evaluation.schema.parameters
        return self.evaluation.groups(a for a in self.addresses if not parameters[a[0]].optional)

    @cached_property
    def read(self) -> Mapping[Address, None]:
        """What the rules read as single values."""
        return dict.fromkeys(address for check in self.checks for address in check.reads)

    @cached_property
    def groups(self) -> tuple[CheckGroup, ...]:
        """The checks by what they read first, as a full run makes them."""
        found: dict[tuple[bool, Address | None], list[RuleCheck]] = {}
        for check in self.checks:
            first = check.reads[0] if check.reads else None
            # A lenient check may find something though its first value is not there: it cannot be skipped
            # by that.
            found.setdefault((check.is_lenient, first), []).append(check)
        return tuple(
            [CheckGroup.of(None if lenient else first, some) for (lenient, first), some in found.items()]
        )

    # What an edit needs is worked out with the first one: most files of a check are only opened.

    @cached_property
    def _states(self) -> dict[Address, frozenset[Address]]:
        """Address -> what its state depends on."""
        return {address: self.evaluation.state_reads(address) for address in self.addresses}

    @cached_property
    def range_readers(self) -> Mapping[Address, frozenset[Address]]:
        """Address -> addresses whose range check must run again when it changes."""
        readers: dict[Address, set[Address]] = {}
        for address in self.addresses:
            for read in {address} | self.evaluation.range_reads(address):
                readers.setdefault(read, set()).add(address)
        return {a: frozenset(r) for a, r in readers.items()}

    @cached_property
    def rule_readers(self) -> Mapping[Address, tuple[RuleCheck, ...]]:
        """Address -> checks that must run again when it changes."""
        readers: dict[Address, list[RuleCheck]] = {}
        for check in self.checks:
            # A rule passes by what is inactive: what decides on the state of a value it reads wakes it
            # too.
            for address in {seen for read in check.addresses for seen in {read} | self._states[read]}:
                readers.setdefault(address, []).append(check)
        return {a: tuple(c) for a, c in readers.items()}

    def asked_by(self, addresses: Iterable[Address]) -> frozenset[FindingPlace]:
        """Return the checks that can come to something else when these values change."""
        return frozenset().union(*map(self._asked.__getitem__, addresses))

    @cached_property
    def _asked(self) -> _AskedBy:
        return _AskedBy(self)


class _AskedBy(dict[Address, frozenset[FindingPlace]]):
    """Address -> the places of the checks that must run again when it changes."""

    def __init__(self, plan: Plan) -> None:
        self._plan = plan

    def __missing__(self, address: Address) -> frozenset[FindingPlace]:
        plan = self._plan
        rules = (check.place for check in plan.rule_readers.get(address, ()))
        found = self[address] = frozenset((*plan.range_readers.get(address, ()), *rules))
        return found


def make_plan(schema: Schema, machine: str, extra: tuple[Rule, ...] = ()) -> Plan:
    """Return the plan for a machine type with the family's rules and further ones; raises RuleError."""
    return _make(schema, machine, _Further(tuple(record_text(rule) for rule in extra), extra))


@dataclass(frozen=True)
class _Further:
    """Rules of which equal ones have one plan, in whatever file they were read for."""

    texts: tuple[str, ...]
    rules: tuple[Rule, ...] = field(compare=False)


@lru_cache(maxsize=32)
def _make(schema: Schema, machine: str, further: _Further) -> Plan:
    evaluation = Evaluation(schema, lambda _: None, lambda: machine)
    here = schema.on(machine)
    checks = checks_of(evaluation, schema.rules + further.rules, late=len(schema.rules))
    return Plan(here.addresses, here.places, checks, evaluation)


def checks_of(evaluation: Evaluation, rules: tuple[Rule, ...], late: int = 0) -> tuple[RuleCheck, ...]:
    """Return the checks of rules on one machine type; raises RuleError.

    The expressions of the first ``late`` rules, those of the family,
    are compiled and checked when they are needed.
    """
    functions = rule_functions(evaluation.schema.family.family)
    seen: set[str] = set()
    checks: list[RuleCheck] = []
    places = count()
    for n, rule in enumerate(rules):
        # Findings, suppressions and texts in other languages are known by the id of their rule.
        if rule.id in seen:
            raise RuleError(rule.id, "there are two rules of this name")
        seen.add(rule.id)
        finding = None if n < late else check_rule(rule, functions)
        expressions, is_own = Expressions(rule, functions, finding), isinstance(rule, BuilderRule)
        singles, lists = _singles_and_lists(rule)
        names = (*singles, *lists)
        is_lenient = not {*rule.optional, *rule.any_state}.isdisjoint(singles)
        for instance, references in _resolved(evaluation, rule, names):
            reads = tuple([reference.addresses[0] for reference in references[: len(singles)]])
            listed = [_listed(reference.addresses) for reference in references[len(singles) :]]
            named = tuple(zip(lists, listed, strict=True))
            checks.append(
                RuleCheck(next(places), rule, instance, expressions, names, reads, named, is_own, is_lenient)
            )
    return tuple(checks)


def _singles_and_lists(rule: Rule) -> tuple[list[str], list[str]]:
    """Return the names that a rule reads one value as, and those that are lists."""
    singles: list[str] = []
    lists: list[str] = []
    for name, text in rule.reads.items():
        (lists if is_list(text) else singles).append(name)
    return singles, lists


def _resolved(
    evaluation: Evaluation, rule: Rule, names: Iterable[str]
) -> Iterator[tuple[str, list[Reference]]]:
    """Yield the instances a rule runs for, each with what the names mean there;
    none where that does not exist.
    """
    for text in rule.reads.values():
        _check_read(evaluation.schema, rule, text)
    scope, instances = _runs_for(evaluation, rule)
    texts = [rule.reads[name] for name in names]
    for instance in instances:
        try:
            references = evaluation.references(texts, instance, scope)
        except UnknownParameterError:
            continue
        yield instance, references


def _check_read(schema: Schema, rule: Rule, text: str) -> None:
    """Raise RuleError for a parameter, or an instance of it, that no machine type has."""
    parameter_id, which = read_address(text)
    parameter = schema.parameters.get(parameter_id)
    if parameter is None:
        raise RuleError(rule.id, f"reads {quoted(parameter_id)}, which the family does not have")
    machines = (schema.on(machine.key) for machine in schema.family.machines)
    if which not in ("", "*", "<", ">", ".") and not any(which in m.instances(parameter) for m in machines):
        raise RuleError(
            rule.id, f"reads {quoted(text)}, but {parameter.name} has no instance {quoted(which)}"
        )


def _runs_for(evaluation: Evaluation, rule: Rule) -> tuple[str | None, tuple[str, ...]]:
    """Return the scope a rule runs over and its instances there.

    It runs for each instance of what it reads of "its own" (``id``, ``id@<``, ``id@>``). If that is of
    several scopes, it is the first for which all the rest can be read: a rule over axes takes of a parameter
    of processes the entry of a control with a single process. Raises RuleError if there is none.
    """
    own = _read_of_its_own(rule)
    instances = {p: evaluation.machine_schema.instances(evaluation.schema.parameters[p]) for p in own}
    if not all(instances.values()):
        return None, ()
    several = {p: evaluation.scope((p, "")) for p in own if instances[p] != ("",)}
    for scope in dict.fromkeys(several.values()):
        here = {p: instances[p] for p in several if several[p] == scope}
        alone = (instances[p] for p in several.keys() - here if own[p])
        # A parameter of another scope can be read in this one by its entry for the whole control.
        if all("" in others for others in alone):
            return scope, tuple(dict.fromkeys(chain.from_iterable(here.values())))
    if several:
        raise RuleError(rule.id, f"reads {' and '.join(several)}, whose instances do not go together")
    return None, ("",)


def _read_of_its_own(rule: Rule) -> dict[str, bool]:
    """Return the parameters that are read of the instance or its neighbours -> whether of itself.

    Only what is read of the instance itself has to exist there; a neighbour (<, >) may be missing at the end.
    """
    own: dict[str, bool] = {}
    for text in rule.reads.values():
        parameter_id, which = read_address(text)
        if which in ("", "<", ">"):
            own[parameter_id] = own.get(parameter_id, False) or which == ""
    return own
