"""The answers for one machine's values: conditions, states, units.

An ``Evaluation`` looks at values through a callable and remembers what it found
until it is notified that an address changed; it never changes a value.
"""

from __future__ import annotations

from collections.abc import Callable

from .address import Address, UnknownParameterError
from .addressing import meant
from .catalog import Schema
from .conditions import Asked, Conditions, Reference, StateInfo, StatePlan, conditions_of
from .expression import Canonical, Circumstances, same_values
from .machine_schema import MachineSchema
from .model import Condition, Scope
from .quoting import quoted
from .units import canonical, dimension
from .value import Value


class Evaluation:
    """Conditions and states of one file."""

    def __init__(
        self,
        schema: Schema,
        value: Callable[[Address], Value | None],
        machine: Callable[[], str],
        application: Callable[[], str] = str,
    ) -> None:
        self.schema, self._value, self._asked_machine, self._application = schema, value, machine, application
        self._machine: str | None = None
        self._facts: Conditions | None = None
        self._canonical: dict[Address, Canonical] = {}
        self._holds: dict[Asked, bool] = {}
        self._states: dict[StatePlan, StateInfo] = {}

    @property
    def machine(self) -> str:
        """The machine type the file describes."""
        if self._machine is None:
            self._machine = self._asked_machine()
        return self._machine

    @property
    def machine_schema(self) -> MachineSchema:
        """The schema on that machine type."""
        return self.schema.on(self.machine)

    @property
    def _conditions(self) -> Conditions:
        if self._facts is None:
            self._facts = conditions_of(self.schema, self.machine)
        return self._facts

    # -- values ----------------------------------------------------------------

    def value(self, address: Address) -> Value | None:
        """Return a value as it was entered; None when not set."""
        return self._value(address)

    def canonical(self, address: Address) -> Canonical:
        """Return a value in canonical units: double, choice key, bool or text; None when not set."""
        found = self._canonical.get(address)
        if found is None and address not in self._canonical:
            found = self._canonical[address] = canonical_value(self._value(address))
        return found

    def scope(self, address: Address) -> Scope | None:
        """Return what an instance is one of (an axis, a process); None where this machine type does not have it."""
        return self._conditions.scopes[address[0]]

    def reference(self, text: str, instance: str, scope: str | None = None) -> Reference:
        """Resolve one entry of ``reads`` for an instance; raises UnknownParameterError.

        With the ``scope`` of the instance, axis 1 is not taken for process 1; without it equal names are enough.
        """
        return self._conditions.reference(text, instance, scope)

    # -- conditions ------------------------------------------------------------

    def condition(self, name: str) -> Condition:
        """Return a named condition of the family; raises UnknownParameterError."""
        try:
            return self.schema.family.conditions[name]
        except KeyError:
            raise UnknownParameterError(f"the family has no condition '{name}'") from None

    def holds(self, name: str, instance: str, scope: str | None = None) -> bool:
        """Return whether a named condition is true for an instance (of a ``scope``); false for a condition over a value that is not set."""
        return self._held(self._conditions.asked(name, instance, scope))

    def _held(self, asked: Asked) -> bool:
        found = self._holds.get(asked)
        if found is None:
            found = self._holds[asked] = self._evaluate(asked)
        return found

    def _evaluate(self, asked: Asked) -> bool:
        name, instance, _ = asked
        names = tuple(self.condition(name).reads)
        got: list[Canonical | list[Canonical]] = []
        for reference in self._conditions.reads(asked):
            if reference is None:
                got.append(None)
            elif reference.is_list:
                got.append([self.canonical(a) for a in reference.addresses])
            else:
                got.append(self.canonical(reference.addresses[0]))
        circumstances = Circumstances(self.machine, self._application(), instance)
        return self._conditions.decisions[name].holds(same_values(got), names, got, circumstances)

    # -- states ----------------------------------------------------------------

    def state(self, address: Address) -> StateInfo:
        """Return whether a parameter is active, ignored, unusable or hidden, and why."""
        facts = self._facts or self._conditions
        plan = facts.plan_of.get(address) or facts.state_plan(address)
        found = self._states.get(plan)
        if found is None:
            decided = (info for asked, wanted, info in plan.steps if self._held(asked) == wanted)
            found = self._states[plan] = next(decided, plan.otherwise)
        return found

    def state_reads(self, address: Address) -> frozenset[Address]:
        """Return every address whose value can change the state of this one."""
        return self._conditions.state_reads(address)

    def range_reads(self, address: Address) -> frozenset[Address]:
        """Return every address whose value can change the range of this one."""
        return self._conditions.range_reads(address)

    def bound_sources(self, address: Address) -> tuple[Address, ...]:
        """Return the parameters that set a bound of this one."""
        return self._conditions.bound_sources(address)

    def turns(self, address: Address) -> bool:
        """Return whether the instance belongs to an axis whose lengths are angles."""
        name = self.schema.family.angular_when
        return bool(name and self.scope(address) == "axis" and self.holds(name, address[1], "axis"))

    def unit(self, address: Address, system: str) -> str:
        """Return the unit of entry of an instance in a unit system."""
        return self.schema.unit(self.schema.parameters[address[0]], system, self.turns(address))

    # -- addressing ------------------------------------------------------------

    def find(self, text: str) -> Address:
        """Return the instance that a text means (see ``addressing``); raises UnknownParameterError with one clear sentence."""
        found = meant(self, text)
        if found.bit is not None:
            raise UnknownParameterError(f"{quoted(text.strip())} is a bit, and the whole word is wanted")
        return found.address

    def find_bit(self, text: str) -> tuple[Address, int | None]:
        """Return the instance a person means and, where he names a bit of a word (``P3N0.5``), its number.

        Raises UnknownParameterError.
        """
        found = meant(self, text)
        return found.address, found.bit

    def least_hidden(self, claims: list[Address]) -> list[Address]:
        """Return, of parameters that are all hidden, those that the fewest conditions hide."""

        def hiding(address: Address) -> int:
            steps = self._conditions.state_plan(address).steps
            return sum(
                info.state == "hidden" and self._held(asked) == wanted for asked, wanted, info in steps
            )

        counts = {address: hiding(address) for address in claims}
        return [a for a in claims if counts[a] == min(counts.values())]

    # -- changes ---------------------------------------------------------------

    def changed(self, address: Address) -> None:
        """Forget what depended on one address."""
        self._canonical.pop(address, None)
        if address == (self.schema.family.machine_parameter, ""):
            self.forget()
            return
        conditions = self._conditions
        for asked in tuple(conditions.readers.get(address, ())):  # another thread may be opening another file
            self._holds.pop(asked, None)
            for plan in tuple(conditions.plans_asking.get(asked, ())):
                self._states.pop(plan, None)

    def forget(self) -> None:
        """Forget everything, as after reading another file."""
        self._machine = self._facts = None
        for memory in (
            self._canonical,
            self._holds,
            self._states,
        ):
            memory.clear()


def same_value(a: Value | None, b: Value | None) -> bool:
    """Return whether two values are the same, whatever their units (1 in is 25.4 mm, 1 mm is not 1 deg)."""
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
