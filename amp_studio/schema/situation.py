"""What holds for one machine's values: conditions, states, units.

A ``Situation`` looks at values through a callable and remembers what it found
until it is told that an address changed; it never changes a value.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from .catalog import Address, Schema, UnknownParameter, read_address
from .cel_engine import Program, compile_expression
from .model import Condition, Parameter, State
from .units import canonical
from .values import Value

Canonical = float | str | bool | None


@dataclass(frozen=True, slots=True)
class StateInfo:
    """The state of a parameter, and why it is out of force."""

    state: State
    why: str = ""
    page: str | None = None


IN_FORCE = StateInfo("in-force")


@dataclass(frozen=True, slots=True)
class Reading:
    """One entry of ``reads``: a single value, or a list over instances."""

    addresses: tuple[Address, ...]
    is_list: bool


@lru_cache(maxsize=None)
def program(expression: str) -> Program:
    """Return a compiled CEL expression; raises ValueError for a syntax error."""
    return compile_expression(expression)


class Situation:
    """Conditions and states of one file."""

    def __init__(self, schema: Schema, value: Callable[[Address], Value | None], machine: Callable[[], str]) -> None:
        self.schema, self._value, self._machine = schema, value, machine
        self._canonical: dict[Address, Canonical] = {}
        self._holds: dict[tuple[str, str], bool] = {}
        self._states: dict[Address, StateInfo] = {}
        self._readers: dict[Address, set[tuple[str, str]]] = {}
        self._readings: dict[tuple[str, str], Reading] = {}

    @property
    def machine(self) -> str:
        """The machine type the file describes."""
        return self._machine()

    # -- values ----------------------------------------------------------------

    def canonical(self, address: Address) -> Canonical:
        """Return a value in canonical units: double, choice key, bool or text; None when unset."""
        try:
            return self._canonical[address]
        except KeyError:
            found = self._canonical[address] = canonical_value(self._value(address))
            return found

    def reading(self, text: str, instance: str) -> Reading:
        """Resolve one entry of ``reads`` for an instance; raises UnknownParameter."""
        key = (text, instance)
        found = self._readings.get(key)
        if found is None:
            found = self._readings[key] = self._resolve(text, instance)
        return found

    def _resolve(self, text: str, instance: str) -> Reading:
        parameter_id, which = read_address(text)
        parameter = self.schema.parameter(parameter_id)
        instances = self.schema.instances(parameter, self.machine)
        if which == "":
            own = instance if instance in instances else "" if "" in instances else None
            if own is None:
                raise UnknownParameter(f"{parameter_id} has no instance '{instance}'")
            return Reading(((parameter_id, own),), False)
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

    def holds(self, name: str, instance: str) -> bool:
        """Tell whether a named condition holds for an instance; one over an unset value does not."""
        key = (name, instance)
        found = self._holds.get(key)
        if found is None:
            found = self._holds[key] = self._evaluate(name, instance)
        return found

    def _evaluate(self, name: str, instance: str) -> bool:
        condition = self.condition(name)
        names: dict[str, Any] = {"machine": self.machine, "instance": instance}
        if self.schema.family.machine_parameter:
            self._readers.setdefault((self.schema.family.machine_parameter, ""), set()).add((name, instance))
        for short, text in condition.reads.items():
            reading = self.reading(text, instance)
            for address in reading.addresses:
                self._readers.setdefault(address, set()).add((name, instance))
            got = [self.canonical(a) for a in reading.addresses]
            names[short] = got if reading.is_list else got[0]
        try:
            return program(condition.when).execute(names) is True
        except TypeError:  # CEL refuses to compare an unset value
            return False

    # -- states ----------------------------------------------------------------

    def state(self, address: Address) -> StateInfo:
        """Return whether a parameter is in force, ignored, unusable or hidden, and why."""
        found = self._states.get(address)
        if found is None:
            found = self._states[address] = self._state(address)
        return found

    def _state(self, address: Address) -> StateInfo:
        parameter = self.schema.parameters[address[0]]
        for rule in parameter.states:
            name = rule.when or rule.unless or ""
            if self.holds(name, address[1]) == (rule.when is not None):
                condition = self.condition(name)
                return StateInfo(rule.state, condition.why, rule.page or condition.page)
        return IN_FORCE

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
                    found.update(self.reading(text, address[1]).addresses)
                except UnknownParameter:
                    continue
        if parameter.layouts or any("machine" in self.condition(n).when for n in names):
            if self.schema.family.machine_parameter:
                found.add((self.schema.family.machine_parameter, ""))
        return found

    def turns(self, address: Address) -> bool:
        """Tell whether the instance belongs to an axis whose lengths are angles."""
        name = self.schema.family.angular_when
        layout = self.schema.layout(self.schema.parameters[address[0]], self.machine)
        return bool(name and layout and layout.scope == "axis" and self.holds(name, address[1]))

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
            offered = f"@{instances[0]} to @{instances[-1]}" if len(instances) > 1 else "no instances here"
            raise UnknownParameter(f"'{text}': {parameter.name} has {offered}")
        claims = self.schema.addressed_by(text, self.machine)
        existing = [a for a in claims if self.state(a).state != "hidden"] or self._nearest(claims)
        if not existing:
            raise UnknownParameter(f"'{text}' is no parameter of {self.schema.family.name}")
        if len(existing) > 1:
            names = " or ".join(f"{a[0]}@{a[1]}" for a in existing)
            raise UnknownParameter(f"number {text} means {names} here: say which by id")
        return existing[0]

    def _nearest(self, claims: list[Address]) -> list[Address]:
        """Return, of parameters that are all hidden, those that the fewest conditions hide."""
        def hiding(address: Address) -> int:
            rules = self.schema.parameters[address[0]].states
            return sum(self.holds(r.when or r.unless or "", address[1]) == (r.when is not None) for r in rules)

        counts = {address: hiding(address) for address in claims}
        return [a for a in claims if counts[a] == min(counts.values())]

    # -- changes ---------------------------------------------------------------

    def changed(self, address: Address) -> None:
        """Forget what depended on one address."""
        self._canonical.pop(address, None)
        if address == (self.schema.family.machine_parameter, ""):
            self.forget()
            return
        for key in self._readers.pop(address, ()):
            self._holds.pop(key, None)
            name, instance = key
            for dependent in self._dependents(name, instance):
                self._states.pop(dependent, None)

    def _dependents(self, name: str, instance: str) -> Iterable[Address]:
        return [a for a in self._states if a[1] == instance and name in _state_names(self.schema.parameters[a[0]])]

    def forget(self) -> None:
        """Forget everything, as after reading another file."""
        for memory in (self._canonical, self._holds, self._states, self._readers, self._readings):
            memory.clear()


def _state_names(parameter: Parameter) -> set[str]:
    return {r.when or r.unless or "" for r in parameter.states}


def canonical_value(value: Value | None) -> Canonical:
    """Return a value as rules see it: numbers as doubles in canonical units."""
    if value is None:
        return None
    if isinstance(value.value, (str, bool)):
        return value.value
    return canonical(float(value.value), value.unit)
