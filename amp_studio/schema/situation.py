"""What holds for one machine's values: conditions, states, units.

A ``Situation`` looks at values through a callable and remembers what it found
until it is told that an address changed; it never changes a value.
"""

from __future__ import annotations

import contextlib
import re
from collections.abc import Callable, Hashable, Iterable
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Literal

from .catalog import Address, Schema, UnknownParameter, part_of, read_address, whole_of
from .cel_engine import WORD_FUNCTIONS, Context, Program, compile_expression, functions_called
from .model import Condition, Scope, State, StateRule
from .units import canonical, dimension
from .values import Value

Canonical = float | str | bool | None

_Asked = tuple[str, str, str | None]
"""What is asked (a condition, an entry of ``reads``), for which instance, of which scope."""


@dataclass(frozen=True, slots=True)
class StateInfo:
    """The state of a parameter, and why it is out of force."""

    state: State
    why: str = ""
    page: str | None = None


_REMEMBERED = 20_000
"""Verdicts kept before all are forgotten: some megabytes."""

IN_FORCE = StateInfo("in-force")
READ_ONLY = StateInfo("unusable", "it can only be read: the control writes it itself")


@dataclass(frozen=True, slots=True)
class Reading:
    """One entry of ``reads``: a single value, or a list over instances."""

    addresses: tuple[Address, ...]
    is_list: bool


@cache
def program(expression: str) -> Program:
    """Return a compiled CEL expression; raises ValueError for a syntax error."""
    return compile_expression(expression)


@cache
def _functions(expression: str) -> frozenset[str]:
    return functions_called(program(expression))


@cache
def _names_instance(expression: str) -> bool:
    return bool({"instance", "part"} & set(program(expression).variables()))


def same_values(values: Iterable[Canonical | list[Canonical]]) -> Hashable:
    """Return what is equal only for values that CEL cannot tell apart: Python takes 1 and True for equal."""
    return tuple(
        [
            (v.__class__, v) if v.__class__ is not list else tuple([(w.__class__, w) for w in v])
            for v in values
        ]
    )


class Verdicts(dict[Hashable, bool]):
    """What an expression came to for values it has met: most machines have most values in common."""

    def __setitem__(self, key: Hashable, verdict: bool) -> None:
        if len(self) >= _REMEMBERED:
            self.clear()
        super().__setitem__(key, verdict)


class Situation:
    """Conditions and states of one file."""

    def __init__(
        self, schema: Schema, value: Callable[[Address], Value | None], machine: Callable[[], str]
    ) -> None:
        self.schema, self._value, self._asked_machine = schema, value, machine
        self._machine: str | None = None
        self._scopes: dict[str, Scope | None] | None = None
        self._canonical: dict[Address, Canonical] = {}
        self._holds: dict[_Asked, bool] = {}
        self._states: dict[Address, StateInfo] = {}
        self._states_alike: dict[tuple[int, str, str | None], StateInfo] = {}
        """The state of all parameters of an instance that have the same state rules."""
        self._states_of_parts: dict[tuple[int, str, str | None], StateInfo | None] = {}
        """The state of all parts of an instance, where it does not depend on the part."""
        self._readers: dict[Address, set[_Asked]] = {}

    @property
    def machine(self) -> str:
        """The machine type the file describes."""
        if self._machine is None:
            self._machine = self._asked_machine()
        return self._machine

    # -- values ----------------------------------------------------------------

    def canonical(self, address: Address) -> Canonical:
        """Return a value in canonical units: double, choice key, bool or text; None when unset."""
        try:
            return self._canonical[address]
        except KeyError:
            found = self._canonical[address] = canonical_value(self._value(address))
            return found

    def scope(self, address: Address) -> Scope | None:
        """Return what an instance is one of (an axis, a process); None where this machine type does not have it."""
        if self._scopes is None:
            self._scopes = self.schema.scopes(self.machine)
        return self._scopes[address[0]]

    def reading(self, text: str, instance: str, scope: str | None = None) -> Reading:
        """Resolve one entry of ``reads`` for an instance; raises UnknownParameter.

        With the ``scope`` of the instance, axis 1 is not taken for process 1; without it equal names are enough.
        """
        readings = _readings(self.schema, self.machine)
        key = (text, instance, scope)
        found = readings.get(key)
        if found is None:
            found = readings[key] = self._resolve(text, instance, scope)
        return found

    def _resolve(self, text: str, instance: str, scope: str | None) -> Reading:
        parameter_id, which = read_address(text)
        parameter = self.schema.parameter(parameter_id)
        instances = self.schema.instances(parameter, self.machine)
        if scope is not None and not self.schema.kin(self.scope((parameter_id, "")), scope):
            instance = ""
        if which == "":
            own = next((i for i in (instance, whole_of(instance), "") if i in instances), None)
            if own is None:
                raise UnknownParameter(f"{parameter_id} has no instance '{instance}'")
            return Reading(((parameter_id, own),), False)
        if which == ".":
            head = f"{whole_of(instance)}."
            return Reading(tuple((parameter_id, i) for i in instances if i.startswith(head)), True)
        if which in ("*", "<", ">"):
            at = instances.index(instance) if instance in instances else len(instances)
            chosen = {"*": instances, "<": instances[:at], ">": instances[at + 1 :]}[which]
            return Reading(tuple((parameter_id, i) for i in chosen), True)
        if which not in instances:
            raise UnknownParameter(f"{parameter_id} has no instance '{which}'")
        return Reading(((parameter_id, which),), False)

    # -- conditions ------------------------------------------------------------

    def condition(self, name: str) -> Condition:
        """Return a named condition of the family; raises UnknownParameter."""
        try:
            return self.schema.family.conditions[name]
        except KeyError:
            raise UnknownParameter(f"the family has no condition '{name}'") from None

    def holds(self, name: str, instance: str, scope: str | None = None) -> bool:
        """Tell whether a named condition holds for an instance (of a ``scope``); one over an unset value does not."""
        reach = _reaches(self.schema, self.machine).get(name)
        if reach == "all":
            key: _Asked = (name, "", None)
        else:
            key = (name, whole_of(instance) if reach == "whole" else instance, scope)
        found = self._holds.get(key)
        if found is None:
            found = self._holds[key] = self._evaluate(key)
        return found

    def _evaluate(self, asked: _Asked) -> bool:
        name, instance, scope = asked
        condition = self.condition(name)
        names: dict[str, Canonical | list[Canonical]] = {}
        for short, text in condition.reads.items():
            try:
                reading = self.reading(text, instance, scope)
            except UnknownParameter:
                self.schema.parameter(read_address(text)[0])
                names[short] = None  # it exists, but not on this machine type or not for this instance
                continue
            for address in reading.addresses:
                self._readers.setdefault(address, set()).add(asked)
            got = [self.canonical(a) for a in reading.addresses]
            names[short] = got if reading.is_list else got[0]
        verdicts = _verdicts(self.schema)
        key = (
            name,
            self.machine,
            instance if _names_instance(condition.when) else "",
            same_values(names.values()),
        )
        found = verdicts.get(key)
        if found is None:
            found = verdicts[key] = self._execute(condition.when, instance, names)
        return found

    def _execute(self, when: str, instance: str, names: dict[str, Canonical | list[Canonical]]) -> bool:
        context = Context({"machine": self.machine, "instance": instance, "part": part_of(instance), **names})
        for called in _functions(when):
            context.add_function(called, WORD_FUNCTIONS[called])
        try:
            return program(when).execute(context) is True
        except (
            TypeError,
            RuntimeError,
        ):  # neither CEL nor the functions of words make sense of an unset value
            return False

    # -- states ----------------------------------------------------------------

    def state(self, address: Address) -> StateInfo:
        """Return whether a parameter is in force, ignored, unusable or hidden, and why."""
        found = self._states.get(address)
        if found is None:
            found = self._states[address] = self._state(address)
        return found

    def _state(self, address: Address) -> StateInfo:
        alike, instance, scope = self.schema.states_alike[address[0]], address[1], self.scope(address)
        whole = whole_of(instance)
        if whole != instance:
            key = alike, whole, scope
            if key not in self._states_of_parts:
                self._states_of_parts[key] = self._of_all_parts(address)
            of_all = self._states_of_parts[key]
            if of_all is not None:
                return of_all
        key = alike, instance, scope
        found = self._states_alike.get(key)
        if found is None:
            found = self._states_alike[key] = self._worked_out(address)
        return found

    def _of_all_parts(self, address: Address) -> StateInfo | None:
        """Return the state of all parts of an instance; None where it may differ from one to the next."""
        reaches = _reaches(self.schema, self.machine)
        for rule in self.schema.parameters[address[0]].states:
            if reaches.get(rule.when or rule.unless or "") == "each":
                return None
            if self._applies(rule, address):
                break
        return self._worked_out(address)

    def _worked_out(self, address: Address) -> StateInfo:
        parameter = self.schema.parameters[address[0]]
        for rule in parameter.states:
            if self._applies(rule, address):
                condition = self.condition(rule.when or rule.unless or "")
                return StateInfo(rule.state, condition.why, rule.page or condition.page)
        return READ_ONLY if parameter.access == "read" else IN_FORCE

    def _applies(self, rule: StateRule, address: Address) -> bool:
        name = rule.when or rule.unless or ""
        return self.holds(name, address[1], self.scope(address)) == (rule.when is not None)

    def state_reads(self, address: Address) -> set[Address]:
        """Return every address whose value can change the state of this one."""
        found: set[Address] = set()
        parameter = self.schema.parameters[address[0]]
        names = [r.when or r.unless or "" for r in parameter.states]
        names += [v.when for v in parameter.range_variants]
        if self.schema.family.angular_when:
            names.append(self.schema.family.angular_when)
        for name in names:
            for text in self.condition(name).reads.values():
                try:
                    found.update(self.reading(text, address[1], self.scope(address)).addresses)
                except UnknownParameter:
                    continue
        by_machine = parameter.layouts or any("machine" in self.condition(n).when for n in names)
        if by_machine and self.schema.family.machine_parameter:
            found.add((self.schema.family.machine_parameter, ""))
        return found

    def turns(self, address: Address) -> bool:
        """Tell whether the instance belongs to an axis whose lengths are angles."""
        name = self.schema.family.angular_when
        return bool(name and self.scope(address) == "axis" and self.holds(name, address[1], "axis"))

    def unit(self, address: Address, system: str) -> str:
        """Return the unit of entry of an instance in a unit system."""
        return self.schema.unit(self.schema.parameters[address[0]], system, self.turns(address))

    # -- addressing ------------------------------------------------------------

    def find(self, text: str) -> Address:
        """Return the instance a person means by a number or ``id@instance``.

        Where a number means several parameters, the one that exists for this
        machine counts. Raises UnknownParameter with one clear sentence.
        """
        text = text.strip()
        parameter_id, instance = read_address(text)
        if parameter_id in self.schema.parameters:
            parameter = self.schema.parameters[parameter_id]
            instances = self.schema.instances(parameter, self.machine)
            if instance in instances:
                return parameter_id, instance
            raise UnknownParameter(f"'{text}': {parameter.name} {_offered(instances)}")
        claims = self.schema.addressed_by(text, self.machine)
        existing = [a for a in claims if self.state(a).state != "hidden"] or self._nearest(claims)
        if not existing:
            raise UnknownParameter(f"'{text}' is no parameter of {self.schema.family.name}")
        if len(existing) > 1:
            names = " or ".join(f"{a[0]}@{a[1]}" for a in existing)
            raise UnknownParameter(f"number {text} means {names} here: say which by id")
        return existing[0]

    def find_bit(self, text: str) -> tuple[Address, int | None]:
        """Return the instance a person means and, where he names a bit of a word (``P3N0.5``), its number.

        Raises UnknownParameter.
        """
        try:
            return self.find(text), None
        except UnknownParameter:
            head, _, bit = text.strip().rpartition(".")
            if not re.fullmatch("[0-9]{1,2}", bit):
                raise
            with contextlib.suppress(UnknownParameter):
                address = self.find(head)
                if self.schema.parameters[address[0]].type == "bits":
                    return address, int(bit)
            raise

    def _nearest(self, claims: list[Address]) -> list[Address]:
        """Return, of parameters that are all hidden, those that the fewest conditions hide."""

        def hiding(address: Address) -> int:
            rules = self.schema.parameters[address[0]].states
            return sum(r.state == "hidden" and self._applies(r, address) for r in rules)

        counts = {address: hiding(address) for address in claims}
        return [a for a in claims if counts[a] == min(counts.values())]

    # -- changes ---------------------------------------------------------------

    def changed(self, address: Address) -> None:
        """Forget what depended on one address."""
        self._canonical.pop(address, None)
        if address == (self.schema.family.machine_parameter, ""):
            self.forget()
            return
        readers = self._readers.pop(address, ())
        if readers:
            self._states_alike.clear()
            self._states_of_parts.clear()
        for key in readers:
            self._holds.pop(key, None)
        for dependent in self._dependents(readers):
            self._states.pop(dependent, None)

    def _dependents(self, asked: Iterable[_Asked]) -> Iterable[Address]:
        """Return the known states that hang on conditions which were asked for."""
        reaches, everywhere = _reaches(self.schema, self.machine), set[str]()
        here: dict[str, set[str]] = {}
        parts: dict[str, set[str]] = {}
        for name, instance, _ in asked:
            if reaches[name] == "all":
                everywhere.add(name)
            else:
                (parts if reaches[name] == "whole" else here).setdefault(instance, set()).add(name)
        names, nothing = _state_names(self.schema), frozenset[str]()
        return [
            a
            for a in self._states
            if not names[a[0]].isdisjoint(everywhere)
            or not names[a[0]].isdisjoint(here.get(a[1], nothing))
            or (parts and not names[a[0]].isdisjoint(parts.get(whole_of(a[1]), nothing)))
        ]

    def forget(self) -> None:
        """Forget everything, as after reading another file."""
        self._machine = self._scopes = None
        for memory in (
            self._canonical,
            self._holds,
            self._states,
            self._states_alike,
            self._states_of_parts,
            self._readers,
        ):
            memory.clear()


def _offered(instances: tuple[str, ...]) -> str:
    if not instances:
        return "does not exist on this machine type"
    if instances == ("",):
        return "is one for the whole control, without '@'"
    named = [i for i in instances if i]
    span = f"@{named[0]} to @{named[-1]}" if len(named) > 1 else f"only @{named[0]}"
    return f"has {span}" + (", and one without '@'" if "" in instances else "")


@lru_cache(maxsize=32)
def _verdicts(schema: Schema) -> Verdicts:  # noqa: ARG001  # it is the key
    """Return the conditions that have been worked out, for which values."""
    return Verdicts()


@lru_cache(maxsize=32)
def _readings(schema: Schema, machine: str) -> dict[_Asked, Reading]:  # noqa: ARG001  # they are the key
    """Return the entries of ``reads`` that have been resolved; they depend on no value."""
    return {}


@lru_cache(maxsize=32)
def _reaches(schema: Schema, machine: str) -> dict[str, Literal["all", "whole", "each"]]:
    """Return condition -> for what it holds alike: all instances, the parts of one, or each by itself."""
    return {name: _reach(schema, machine, c) for name, c in schema.family.conditions.items()}


def _reach(schema: Schema, machine: str, condition: Condition) -> Literal["all", "whole", "each"]:
    if _names_instance(condition.when):
        return "each"
    reads_all = True
    for parameter_id, which in map(read_address, condition.reads.values()):
        instances = schema.instances(schema.parameters[parameter_id], machine)
        if which in ("<", ">") or (which == "" and any("." in instance for instance in instances)):
            return "each"
        reads_all &= which not in ("", ".") or (which == "" and instances == ("",))
    return "all" if reads_all else "whole"


@lru_cache(maxsize=32)
def _state_names(schema: Schema) -> dict[str, frozenset[str]]:
    """Return parameter id -> the conditions its state depends on."""
    return {p.id: frozenset(r.when or r.unless or "" for r in p.states) for p in schema.parameters.values()}


def same_value(a: Value | None, b: Value | None) -> bool:
    """Tell whether two values are the same, whatever their units (1 in is 25.4 mm, 1 mm is not 1 deg)."""
    if a is None or b is None or isinstance(a.value, (str, bool)) or isinstance(b.value, (str, bool)):
        return a == b
    return dimension(a.unit) == dimension(b.unit) and canonical_value(a) == canonical_value(b)


def canonical_value(value: Value | None) -> Canonical:
    """Return a value as rules see it: numbers as doubles in canonical units."""
    if value is None:
        return None
    if isinstance(value.value, (str, bool)):
        return value.value
    return canonical(float(value.value), value.unit)
