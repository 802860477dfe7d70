"""The answers for one machine's values: conditions, states, units.

An ``Evaluation`` looks at values through a callable and remembers what it found
until it is notified that an address changed; it never changes a value.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence

from .address import Address, UnknownParameterError
from .addressing import resolve_address
from .catalog import Schema
from .conditions import Answers, Asked, Conditions, Question, Reference, StateGroups, StateInfo, conditions_of
from .expression import Canonical, Circumstances, ValueKey, ValueKeys, key_of, value_of
from .machine_schema import MachineSchema
from .model import Condition, Scope
from .quoting import quoted
from .units import dimension
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
        self.keys = ValueKeys(value)
        """The key of each value in canonical units."""
        self._answers: Answers | None = None
        self._before: Answers | None = None
        """The last one, until it is asked what the next one is."""
        self._decided: set[Address] = set()
        """What conditions read that has changed since then."""
        self._model = ""
        """The model of the control in the present situation."""

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
        return value_of(self.keys[address])  # type: ignore[return-value]  # a list has no address

    def scope(self, address: Address) -> Scope | None:
        """Return what an instance is one of (an axis, a process);
        None where this machine type does not have it.
        """
        return self._conditions.scopes[address[0]]

    def reference(self, text: str, instance: str, scope: str | None = None) -> Reference:
        """Resolve one entry of ``reads`` for an instance; raises UnknownParameterError.

        With the ``scope`` of the instance, axis 1 is not taken for process 1;
        without it equal names are enough.
        """
        return self._conditions.reference(text, instance, scope)

    def references(self, texts: Iterable[str], instance: str, scope: str | None) -> list[Reference]:
        """Resolve several entries of ``reads`` for an instance; raises UnknownParameterError."""
        return self._conditions.all_references(texts, instance, scope)

    # -- conditions ------------------------------------------------------------

    def condition(self, name: str) -> Condition:
        """Return a named condition of the family; raises UnknownParameterError."""
        try:
            return self.schema.family.conditions[name]
        except KeyError:
            raise UnknownParameterError(f"the family has no condition '{name}'") from None

    def is_true(self, name: str, instance: str, scope: str | None = None) -> bool:
        """Return whether a named condition is true for an instance (of a ``scope``);
        false for a condition over a value that is not set.
        """
        return self._answer(self._conditions.asked(name, instance, scope))

    def _answer(self, asked: Asked) -> bool:
        known = self._present().conditions
        found = known.get(asked)
        if found is None:
            found = known[asked] = self._evaluate(asked)
        return found

    def _evaluate(self, asked: Asked) -> bool:
        if asked[0] not in self.schema.family.conditions:
            self.condition(asked[0])  # raises
        question = self._conditions.question(asked)
        circumstances = Circumstances(self.machine, self._model, asked[1])
        return question.decision.is_true(self._keys_read(question), question.names, circumstances)

    def _keys_read(self, question: Question) -> tuple[ValueKey, ...]:
        keys = self.keys
        if question.plain:
            # Most conditions read single values alone, which need no look at what kind of reference
            # each is.
            return tuple([keys[a] for a in question.plain])
        return tuple([None if r is None else self._key(r) for r in question.references])

    def _key(self, reference: Reference) -> ValueKey:
        keys = self.keys
        return (
            tuple([keys[a] for a in reference.addresses])
            if reference.is_list
            else keys[reference.addresses[0]]
        )

    # -- states ----------------------------------------------------------------

    def _present(self) -> Answers:
        """Return the answers for the present values, shared with all files in which the deciding ones are
        equal.
        """
        found = self._answers
        if found is None:
            conditions, keys = self._conditions, self.keys
            self._model = self._application()
            # Files in which the same values decide share their answers.
            deciding = (self._model, *[keys[a] for a in conditions.deciding])
            found = self._answers = conditions.answers(deciding, self._before, self._decided)
            self._before = None
            self._decided.clear()
        return found

    def state(self, address: Address) -> StateInfo:
        """Return whether a parameter is active, ignored, unusable or hidden, and why."""
        answers = self._answers or self._present()
        return answers.by_address.get(address) or self._state(answers, address)

    def _state(self, answers: Answers, address: Address) -> StateInfo:
        plan = self._conditions.state_plan(address)
        found = answers.states.get(plan)
        if found is None:
            decided = (info for asked, wanted, info in plan.steps if self._answer(asked) == wanted)
            found = answers.states[plan] = next(decided, plan.otherwise)
        answers.by_address[address] = found
        return found

    def known_states(self) -> Mapping[Address, StateInfo]:
        """Return the states that were asked for already, until the next change."""
        return (self._answers or self._present()).by_address

    def groups(self, addresses: Iterable[Address]) -> StateGroups:
        """Return addresses in groups, of which ``active`` returns the active ones quickly."""
        return self._conditions.groups(addresses)

    def active(self, groups: StateGroups) -> tuple[Address, ...]:
        """Return the active ones of ``groups`` of addresses."""
        answers = self._answers or self._present()
        kept = answers.active.get(id(groups))
        if kept is None:
            found: list[Address] = []
            for alike in groups:
                if self._conditions.reach_of_states(alike[0][0]) == "each":
                    found += self._active_parts(alike)
                elif self.state(alike[0]).is_active:  # the others have its state whatever the values
                    found += alike
            # The groups are kept with it, so that no other object can get their id.
            kept = answers.active[id(groups)] = groups, tuple(found)
        return kept[1]

    def _active_parts(self, parts: Sequence[Address]) -> list[Address]:
        """Return the active ones of the parts of one instance of a parameter, as ``state`` finds them."""
        (name, _), left, active = parts[0], list(parts), list[Address]()
        steps, otherwise = self._conditions.steps(name)
        for condition, wanted, info in steps:
            if not left:
                break
            answers = self._answers_for(condition, left)
            if info.is_active:
                active += [part for part, answer in zip(left, answers, strict=True) if answer == wanted]
            left = [part for part, answer in zip(left, answers, strict=True) if answer != wanted]
        return active + left if otherwise.is_active else active

    def _answers_for(self, name: str, parts: Sequence[Address]) -> list[bool]:
        """Return what a condition comes to for parts of one instance."""
        conditions = self._conditions
        scope = self.scope(parts[0])
        if conditions.reaches[name] != "each":
            return [self._answer(conditions.asked(name, parts[0][1], scope))] * len(parts)
        by_part = conditions.by_part.get(name)
        if by_part is None:
            return [self._answer(conditions.asked(name, instance, scope)) for _, instance in parts]
        question = conditions.question(conditions.asked(name, parts[0][1], scope))
        circumstances = [Circumstances(self.machine, self._model, instance) for _, instance in parts]
        return by_part.are_true(self._keys_read(question), question.names, circumstances)

    def state_reads(self, address: Address) -> frozenset[Address]:
        """Return every address whose value can change the state of this one."""
        return self._conditions.state_reads(address)

    def range_reads(self, address: Address) -> frozenset[Address]:
        """Return every address whose value can change the range of this one."""
        return self._conditions.range_reads(address)

    def decides_states(self, address: Address) -> bool:
        """Return whether the value of an address can change the state of any parameter."""
        machine = self.schema.family.machine_parameter
        return address in self._conditions.decides or (machine is not None and address[0] == machine)

    def bound_sources(self, address: Address) -> tuple[Address, ...]:
        """Return the parameters that set a bound of this one."""
        return self._conditions.bound_sources(address)

    def turns(self, address: Address) -> bool:
        """Return whether the length of an instance is an angle, as its axis turns.

        What belongs to no axis (a motor) has an angle only by the condition that its parameter names.
        """
        known = (self._answers or self._present()).turning
        found = known.get(address)
        if found is None:
            parameter, scope = self.schema.parameters[address[0]], self.scope(address)
            name = self.schema.angular_when(parameter) if scope == "axis" else parameter.angular_when
            found = known[address] = bool(name and self.is_true(name, address[1], scope))
        return found

    def unit(self, address: Address, system: str) -> str:
        """Return the unit of entry of an instance in a unit system."""
        return self.schema.unit(self.schema.parameters[address[0]], system, self.turns(address))

    # -- addressing ------------------------------------------------------------

    def find(self, text: str) -> Address:
        """Return the instance that a text means (see ``addressing``);
        raises UnknownParameterError with one clear sentence.
        """
        resolved = resolve_address(self, text)
        if resolved.bit is not None:
            raise UnknownParameterError(f"{quoted(text.strip())} is a bit, and the whole word is wanted")
        return resolved.address

    def find_bit(self, text: str) -> tuple[Address, int | None]:
        """Return the instance a person means and, where he names a bit of a word (``P3N0.5``), its number.

        Raises UnknownParameterError.
        """
        resolved = resolve_address(self, text)
        return resolved.address, resolved.bit

    def least_hidden(self, claims: list[Address]) -> list[Address]:
        """Return, of parameters that are all hidden, those that the fewest conditions hide."""

        def hiding(address: Address) -> int:
            steps = self._conditions.state_plan(address).steps
            return sum(
                info.state == "hidden" and self._answer(asked) == wanted for asked, wanted, info in steps
            )

        counts = {address: hiding(address) for address in claims}
        return [a for a in claims if counts[a] == min(counts.values())]

    # -- changes ---------------------------------------------------------------

    def forget_dependents(self, address: Address) -> None:
        """Forget what depended on one address."""
        self.keys.pop(address, None)
        # Another machine type has other instances, numbers and conditions.
        if address == (self.schema.family.machine_parameter, ""):
            self.forget()
        elif address in self._conditions.decides:
            # Kept until they are asked for again: most edits leave all conditions as they were, and
            # their answers with them.
            self._before = self._before or self._answers
            self._decided.add(address)
            self._answers = None

    def forget(self) -> None:
        """Forget everything, as after reading another file."""
        self._machine = self._facts = self._answers = self._before = None
        self._decided.clear()
        self.keys.clear()


def same_value(a: Value | None, b: Value | None) -> bool:
    """Return whether two values are the same, whatever their units (1 in is 25.4 mm, 1 mm is not 1 deg)."""
    return same_key(a) == same_key(b)


def same_key(value: Value | None) -> tuple[str, ValueKey] | None:
    """Return what two values have in common if and only if they are the same: thousands are sorted by it."""
    if value is None:
        return None
    return value.unit if isinstance(value.value, (str, bool)) else dimension(value.unit), key_of(value)
