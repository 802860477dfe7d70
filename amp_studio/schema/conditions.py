"""What the conditions of a family read on one machine type: worked out once, for all its files.

Nothing here depends on a value. What a condition came to for equal values is remembered here too.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from typing import Literal

from .address import Address, UnknownParameterError, read_address, whole_of
from .catalog import Schema
from .cel_engine import Program, compile_expression, functions_called
from .model import Condition, Scope, State

Canonical = float | str | bool | None

Asked = tuple[str, str, str | None]
"""What is asked (a condition, an entry of ``reads``), for which instance, of which scope."""

Reach = Literal["all", "whole", "each"]
"""For what a condition holds alike: for all instances, for the parts of one, or for each by itself."""

_REMEMBERED = 20_000
"""Verdicts kept before all are forgotten: some megabytes."""


class Verdicts(dict[Hashable, bool]):
    """What an expression came to for values it has met: most machines have most values in common."""

    def __setitem__(self, key: Hashable, verdict: bool) -> None:
        if len(self) >= _REMEMBERED:
            self.clear()
        super().__setitem__(key, verdict)


@dataclass(frozen=True, slots=True)
class Reference:
    """One entry of ``reads``: a single value, or a list over instances."""

    addresses: tuple[Address, ...]
    is_list: bool


@dataclass(frozen=True, slots=True)
class StateInfo:
    """The state of a parameter, and why it is out of force."""

    state: State
    why: str = ""
    page: str | None = None


IN_FORCE = StateInfo("in-force")
READ_ONLY = StateInfo("unusable", "it can only be read: the control writes it itself")


@dataclass(frozen=True, slots=True, eq=False)
class StatePlan:
    """How the state of a parameter is found: one plan for all that have the same."""

    steps: tuple[tuple[Asked, bool, StateInfo], ...]
    """A condition, whether it has to hold or not to hold, and what the state is then; the first one decides."""
    otherwise: StateInfo


class Conditions:
    """The conditions and states of one family on one machine type."""

    def __init__(self, schema: Schema, machine: str) -> None:
        self._schema, self._here = schema, schema.on(machine)
        self.scopes: dict[str, Scope | None] = self._here.scopes
        self.reaches: dict[str, Reach] = {n: self._reach(c) for n, c in schema.family.conditions.items()}
        self.readers: dict[Address, set[Asked]] = {}
        """Address -> what was asked, in whatever file, that reads it."""
        self.plans_asking: dict[Asked, set[StatePlan]] = {}
        self.verdicts = Verdicts()
        self.plan_of: dict[Address, StatePlan] = {}
        """What ``state_plan`` has returned so far."""
        self._plans: dict[tuple[object, ...], StatePlan] = {}
        self._references: dict[Asked, Reference] = {}
        self._reads: dict[Asked, tuple[Reference | None, ...]] = {}

    def _reach(self, condition: Condition) -> Reach:
        if names_instance(condition.when):
            return "each"
        reads_all = True
        for parameter_id, which in map(read_address, condition.reads.values()):
            instances = self._here.instances(self._schema.parameters[parameter_id])
            if which in ("<", ">") or (which == "" and any("." in instance for instance in instances)):
                return "each"
            reads_all &= which not in ("", ".") or (which == "" and instances == ("",))
        return "all" if reads_all else "whole"

    # -- states ----------------------------------------------------------------

    def state_plan(self, address: Address) -> StatePlan:
        """Return how the state of an address is found."""
        found = self.plan_of.get(address)
        if found is None:
            found = self.plan_of[address] = self._planned(address)
        return found

    def _planned(self, address: Address) -> StatePlan:
        parameter = self._schema.parameters[address[0]]
        steps = []
        for rule in parameter.states:
            name = rule.when or rule.unless or ""
            condition = self._schema.family.conditions[name]
            info = StateInfo(rule.state, condition.why, rule.page or condition.page)
            steps.append((self.asked(name, address[1], self.scopes[address[0]]), rule.when is not None, info))
        otherwise = READ_ONLY if parameter.access == "read" else IN_FORCE
        plan = self._plans.setdefault((*steps, otherwise), StatePlan(tuple(steps), otherwise))
        for asked, _, _ in steps:
            self.plans_asking.setdefault(asked, set()).add(plan)
        return plan

    # -- what is read ----------------------------------------------------------

    def asked(self, name: str, instance: str, scope: str | None) -> Asked:
        """Return what to ask for a condition to hold for an instance: the same for all for which it holds alike."""
        reach = self.reaches.get(name)
        if reach == "all":
            return name, "", None
        return name, whole_of(instance) if reach == "whole" else instance, scope

    def reads(self, asked: Asked) -> tuple[Reference | None, ...]:
        """Return what a condition reads; None for what exists, but not on this machine type or not for this instance."""
        found = self._reads.get(asked)
        if found is None:
            name, instance, scope = asked
            condition = self._schema.family.conditions[name]
            found = tuple(self._reference_or_none(t, instance, scope) for t in condition.reads.values())
            for reference in found:
                for address in reference.addresses if reference else ():
                    self.readers.setdefault(address, set()).add(asked)
            self._reads[asked] = found
        return found

    def _reference_or_none(self, text: str, instance: str, scope: str | None) -> Reference | None:
        try:
            return self.reference(text, instance, scope)
        except UnknownParameterError:
            self._schema.parameter(read_address(text)[0])
            return None

    def reference(self, text: str, instance: str, scope: str | None) -> Reference:
        """Resolve one entry of ``reads`` for an instance; raises UnknownParameterError."""
        key = (text, instance, scope)
        found = self._references.get(key)
        if found is None:
            found = self._references[key] = self._resolve(text, instance, scope)
        return found

    def _resolve(self, text: str, instance: str, scope: str | None) -> Reference:
        parameter_id, which = read_address(text)
        parameter = self._schema.parameter(parameter_id)
        instances = self._here.instances(parameter)
        if scope is not None and not self._here.kin(self.scopes[parameter_id], scope):
            instance = ""
        if which == "":
            own = next((i for i in (instance, whole_of(instance), "") if i in instances), None)
            if own is None:
                raise UnknownParameterError(f"{parameter_id} has no instance '{instance}'")
            return Reference(((parameter_id, own),), False)
        if which == ".":
            head = f"{whole_of(instance)}."
            return Reference(tuple((parameter_id, i) for i in instances if i.startswith(head)), True)
        if which in ("*", "<", ">"):
            at = instances.index(instance) if instance in instances else len(instances)
            chosen = {"*": instances, "<": instances[:at], ">": instances[at + 1 :]}[which]
            return Reference(tuple((parameter_id, i) for i in chosen), True)
        if which not in instances:
            raise UnknownParameterError(f"{parameter_id} has no instance '{which}'")
        return Reference(((parameter_id, which),), False)


@lru_cache(maxsize=32)
def conditions_of(schema: Schema, machine: str) -> Conditions:
    """Return the conditions of a family on one machine type."""
    return Conditions(schema, machine)


@cache
def program(expression: str) -> Program:
    """Return a compiled CEL expression; raises ValueError for a syntax error."""
    return compile_expression(expression)


@cache
def functions_of(expression: str) -> frozenset[str]:
    """Return the functions an expression calls."""
    return functions_called(program(expression))


@cache
def names_instance(expression: str) -> bool:
    """Tell whether an expression asks which instance, or which part, it is worked out for."""
    return bool({"instance", "part"} & set(program(expression).variables()))


def same_values(values: Sequence[Canonical | list[Canonical]]) -> Hashable:
    """Return what is equal only for values that CEL cannot tell apart: Python takes 1 and True for equal."""
    kinds = tuple(map(type, values))
    if list not in kinds:
        return kinds, tuple(values)
    return kinds, tuple([same_values(v) if isinstance(v, list) else v for v in values])
