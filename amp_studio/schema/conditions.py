"""What the conditions of a family read on one machine type: worked out once, for all its files.

Nothing here depends on a value. What needs to know what an expression reads asks here: an edit, to forget
what hung on it, and the plan of all checks.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import lru_cache
from itertools import chain
from typing import Literal, NamedTuple

from .address import Address, UnknownParameterError, read_address, whole_of
from .catalog import Schema
from .cel_engine import WORD_FUNCTIONS
from .expression import Decision, PartsDecision, ValueKey, program
from .model import BoundRef, Parameter, ParameterState, Scope

Asked = tuple[str, str, str | None]
"""What is asked (a condition, an entry of ``reads``), for which instance, of which scope."""

Reach = Literal["all", "whole", "each"]
"""For what a condition has the same answer: for all instances, for the parts of one, or for each by
itself."""


class Reference(NamedTuple):
    """One entry of ``reads``: a single value, or a list over instances."""

    addresses: tuple[Address, ...]
    is_list: bool


class StateInfo(NamedTuple):
    """The state of a parameter, and why it is inactive."""

    state: ParameterState
    why: str = ""
    page: str | None = None

    @property
    def is_active(self) -> bool:
        """Whether the parameter takes effect on this machine as configured."""
        return self.state == "in-force"


ACTIVE = StateInfo("in-force")
_READ_ONLY = StateInfo("unusable", "it can only be read: the control writes it itself")


@dataclass(frozen=True, slots=True, eq=False)
class StatePlan:
    """How the state of a parameter is found: one plan for all that have the same."""

    steps: tuple[tuple[Asked, bool, StateInfo], ...]
    """A condition, whether it has to be true or false, and what the state is then; the first one decides."""
    otherwise: StateInfo


class Question(NamedTuple):
    """A condition asked for an instance."""

    decision: Decision
    names: tuple[str, ...]
    references: tuple[Reference | None, ...]
    """What the names mean; None for what exists, but not on this machine type or not for this instance."""
    plain: tuple[Address, ...]
    """The same, if it reads single values alone."""


StateGroups = tuple[tuple[Address, ...], ...]
"""Addresses, those together whose states are the same whatever the values, or that are parts of one
instance."""


@dataclass(frozen=True, slots=True)
class Answers:
    """What follows from the values that conditions read: the same for all files in which these are equal."""

    conditions: dict[Asked, bool] = field(default_factory=dict)
    states: dict[StatePlan, StateInfo] = field(default_factory=dict)
    by_address: dict[Address, StateInfo] = field(default_factory=dict)
    """The same states, so that they are quick to look up."""
    turning: dict[Address, bool] = field(default_factory=dict)
    """Whether the length of an address is an angle, for those that were asked."""
    active: dict[int, tuple[StateGroups, tuple[Address, ...]]] = field(default_factory=dict)
    """Groups of addresses that were asked for, by their identity, and those of them that are active."""


_MAX_ANSWERS = 100
"""Kept before all are forgotten: some hundred kilobytes each."""


class Conditions:
    """The conditions and states of one family on one machine type."""

    def __init__(self, schema: Schema, machine: str) -> None:
        self._schema, self._here = schema, schema.on(machine)
        self.scopes: dict[str, Scope | None] = self._here.scopes
        self.decisions = {
            n: Decision(program(c.when), WORD_FUNCTIONS) for n, c in schema.family.conditions.items()
        }
        self.reaches: dict[str, Reach] = {n: self._reach(n) for n in self.decisions}
        self.by_part = {
            name: PartsDecision(decision, schema.family.conditions[name].when)
            for name, decision in self.decisions.items()
            if self._asks_part_alone(name)
        }
        """Conditions whose answer for the parts of one instance depends on the number of the part alone."""
        self.readers: dict[Address, set[Asked]] = {}
        """Address -> what was asked, in whatever file, that reads it."""
        self.plans_asking: dict[Asked, set[StatePlan]] = {}
        self.plan_of: dict[Address, StatePlan] = {}
        """What ``state_plan`` has returned so far."""
        self._plans: dict[tuple[object, ...], StatePlan] = {}
        self._plans_of: dict[Address, StatePlan] = {}
        """The same plans, by parameter and how much of an instance its conditions look at."""
        self._reaches_of: dict[str, Reach] = {}
        self._references: dict[Asked, Reference] = {}
        self._names: dict[tuple[str, str | None], tuple[str, str, dict[str, int], bool]] = {}
        self._questions: dict[Asked, Question] = {}
        read = {read_address(t)[0] for c in schema.family.conditions.values() for t in c.reads.values()}
        self.deciding = tuple(address for address in self._here.addresses if address[0] in read)
        """Every address that a condition may read."""
        self.decides = frozenset(self.deciding)
        self._answers: dict[tuple[ValueKey, ...], Answers] = {}

    def _reach(self, name: str) -> Reach:
        return "each" if self.decisions[name].asks_instance else self._reach_of_reads(name)

    def _reach_of_reads(self, name: str) -> Reach:
        """Return for which instances a condition reads the same values: all, the parts of one, or each by
        itself.
        """
        condition, reads_all = self._schema.family.conditions[name], True
        for parameter_id, which in map(read_address, condition.reads.values()):
            instances = self._here.instances(self._schema.parameters[parameter_id])
            # What comes before or after an instance is another one for each, and so is a part.
            if which in ("<", ">") or (which == "" and any("." in instance for instance in instances)):
                return "each"
            reads_all &= which not in ("", ".") or (which == "" and instances == ("",))
        return "all" if reads_all else "whole"

    def _asks_part_alone(self, name: str) -> bool:
        always = self.decisions[name].always
        return "part" in always and "instance" not in always and self._reach_of_reads(name) != "each"

    # -- states ----------------------------------------------------------------

    def groups(self, addresses: Iterable[Address]) -> StateGroups:
        """Return addresses by how their states are found."""
        found: dict[object, list[Address]] = {}
        for address in addresses:
            name, instance = address
            is_part = self.reach_of_states(name) == "each"
            found.setdefault((name, whole_of(instance)) if is_part else self.state_plan(address), []).append(
                address
            )
        return tuple(map(tuple, found.values()))

    def state_plan(self, address: Address) -> StatePlan:
        """Return how the state of an address is found."""
        found = self.plan_of.get(address)
        if found is None:
            name, instance = address
            reach = self.reach_of_states(name)
            alike = (name, "" if reach == "all" else whole_of(instance) if reach == "whole" else instance)
            found = self._plans_of.get(alike)
            if found is None:
                found = self._plans_of[alike] = self._planned(address)
            self.plan_of[address] = found
        return found

    def reach_of_states(self, name: str) -> Reach:
        """Return for which instances of a parameter the state is found in one way."""
        found = self._reaches_of.get(name)
        if found is None:
            rules = self._schema.parameters[name].states
            reaches = {self.reaches.get(rule.when or rule.unless or "", "each") for rule in rules}
            found = "each" if "each" in reaches else "whole" if "whole" in reaches else "all"
            self._reaches_of[name] = found
        return found

    def steps(self, name: str) -> tuple[tuple[tuple[str, bool, StateInfo], ...], StateInfo]:
        """Return how the state of a parameter is found, whatever its instance: conditions, whether each has
        to be true or false, and what the state is then, the first one decides; and what it is otherwise.
        """
        parameter, steps = self._schema.parameters[name], []
        for rule in parameter.states:
            asked = rule.when or rule.unless or ""
            condition = self._schema.family.conditions[asked]
            info = StateInfo(rule.state, condition.why, rule.page or condition.page)
            steps.append((asked, rule.when is not None, info))
        return tuple(steps), _READ_ONLY if parameter.access == "read" else ACTIVE

    def _planned(self, address: Address) -> StatePlan:
        """Return how the state of an address is found: one object for all that ask the same."""
        named, otherwise = self.steps(address[0])
        scope = self.scopes[address[0]]
        steps = [(self.asked(name, address[1], scope), wanted, info) for name, wanted, info in named]
        # One object for equal steps: answers are kept by plan, so a state that was found for one address
        # is known for all that share it.
        plan = self._plans.setdefault((*steps, otherwise), StatePlan(tuple(steps), otherwise))
        for asked, _, _ in steps:
            self.plans_asking.setdefault(asked, set()).add(plan)
        return plan

    # -- answers ---------------------------------------------------------------

    def answers(
        self, keys: tuple[ValueKey, ...], before: Answers | None = None, changed: Iterable[Address] = ()
    ) -> Answers:
        """Return the answers for the keys of the ``deciding`` values, and of the model of the control.

        One that is new knows what the one ``before`` it knew, but for what reads a ``changed`` address.
        """
        found = self._answers.get(keys)
        if found is None:
            # All at once, as `expression.Remembered` does.
            if len(self._answers) >= _MAX_ANSWERS:
                self._answers.clear()
            found = self._answers[keys] = Answers() if before is None else self._after(before, changed)
        return found

    def _after(self, before: Answers, changed: Iterable[Address]) -> Answers:
        answers = Answers(dict(before.conditions), dict(before.states))
        for address in changed:
            for asked in tuple(self.readers.get(address, ())):  # another thread may be opening another file
                answers.conditions.pop(asked, None)
                for plan in tuple(self.plans_asking.get(asked, ())):
                    answers.states.pop(plan, None)
        return answers

    # -- what is read ----------------------------------------------------------

    def state_reads(self, address: Address) -> frozenset[Address]:
        """Return every address whose value can change the state,
        the unit or the choice of the range of this one.
        """
        parameter, family = self._schema.parameters[address[0]], self._schema.family
        names = self._names_asked(parameter)
        asked = [self.asked(name, address[1], self.scopes[address[0]]) for name in names]
        references = chain.from_iterable(self.question(one).references for one in asked)
        found = {a for reference in references if reference for a in reference.addresses}
        by_machine = parameter.layouts or any("machine" in self.decisions[name].always for name in names)
        # On another machine type the parameter may have another layout, or none.
        if by_machine and family.machine_parameter:
            found.add((family.machine_parameter, ""))
        return frozenset(found)

    def _names_asked(self, parameter: Parameter) -> list[str]:
        """Return the conditions on which state, range and unit of a parameter depend."""
        names = [r.when or r.unless or "" for r in parameter.states]
        names += [v.when for v in parameter.range_variants]
        return [*names, *filter(None, [self._schema.angular_when(parameter)])]

    def range_reads(self, address: Address) -> frozenset[Address]:
        """Return every address whose value can change the range of this one,
        where other parameters set its bounds too.
        """
        found = self.state_reads(address)
        for source in self.bound_sources(address):
            found |= {source} | self.state_reads(source)
        return found

    def bound_sources(self, address: Address) -> tuple[Address, ...]:
        """Return the parameters that set a bound of this one."""
        parameter = self._schema.parameters[address[0]]
        ranges = [parameter.ranges or {}, *(variant.ranges for variant in parameter.range_variants)]
        bounds = (bound for units in ranges for pair in units.values() for bound in pair)
        return tuple(
            self.reference(bound.param, address[1], self.scopes[address[0]]).addresses[0]
            for bound in bounds
            if isinstance(bound, BoundRef)
        )

    def asked(self, name: str, instance: str, scope: str | None) -> Asked:
        """Return what to ask for a condition to be true for an instance:
        the same for all with the same answer.
        """
        reach = self.reaches.get(name)
        if reach == "all":
            return name, "", None
        return name, whole_of(instance) if reach == "whole" else instance, scope

    def question(self, asked: Asked) -> Question:
        """Return what is asked, with what its names mean."""
        found = self._questions.get(asked)
        if found is None:
            name, instance, scope = asked
            reads = self._schema.family.conditions[name].reads
            references = tuple(self._reference_or_none(t, instance, scope) for t in reads.values())
            for reference in references:
                for address in reference.addresses if reference else ():
                    # By this an edit finds what it makes stale, see ``_after``.
                    self.readers.setdefault(address, set()).add(asked)
            singles = [r.addresses[0] for r in references if r is not None and not r.is_list]
            plain = tuple(singles) if len(singles) == len(references) else ()
            found = self._questions[asked] = Question(self.decisions[name], tuple(reads), references, plain)
        return found

    def _reference_or_none(self, text: str, instance: str, scope: str | None) -> Reference | None:
        try:
            return self.reference(text, instance, scope)
        except UnknownParameterError:
            # Raises for a name that no machine type has: that is a fault of the facts.
            self._schema.parameter(read_address(text)[0])
            return None

    def reference(self, text: str, instance: str, scope: str | None) -> Reference:
        """Resolve one entry of ``reads`` for an instance; raises UnknownParameterError."""
        key = (text, instance, scope)
        found = self._references.get(key)
        if found is None:
            # One object for every instance: a list over a table has thousands of addresses.
            same = instance and text.endswith("@*")  # for every instance
            found = self.reference(text, "", scope) if same else self._resolve(text, instance, scope)
            self._references[key] = found
        return found

    def all_references(self, texts: Iterable[str], instance: str, scope: str | None) -> list[Reference]:
        """Resolve several entries of ``reads`` for an instance; raises UnknownParameterError."""
        known = self._references.get
        return [known((text, instance, scope)) or self.reference(text, instance, scope) for text in texts]

    def _named(self, text: str, scope: str | None) -> tuple[str, str, dict[str, int], bool]:
        """Return the parameter and the instances that a text means, its own instances in order,
        and whether it is kin.
        """
        found = self._names.get((text, scope))
        if found is None:
            parameter_id, which = read_address(text)
            instances = self._here.instances(self._schema.parameter(parameter_id))
            kin = scope is None or self._here.kin(self.scopes[parameter_id], scope)
            order = {name: at for at, name in enumerate(instances)}
            found = self._names[text, scope] = parameter_id, which, order, kin
        return found

    def _resolve(self, text: str, instance: str, scope: str | None) -> Reference:
        """Return what an entry of ``reads`` means for an instance; raises UnknownParameterError."""
        parameter_id, which, order, kin = self._named(text, scope)
        # Axis 1 and process 1 have one name and nothing in common.
        if not kin:
            instance = ""
        instances = tuple(order)
        if which == ".":
            head = f"{whole_of(instance)}."
            return Reference(tuple((parameter_id, i) for i in instances if i.startswith(head)), True)
        if which in ("*", "<", ">"):
            at = order.get(instance, len(instances))
            chosen = {"*": instances, "<": instances[:at], ">": instances[at + 1 :]}[which]
            return Reference(tuple((parameter_id, i) for i in chosen), True)
        # For a part (1.3): its own value, that of its whole (1), else the one of the control.
        candidates = (which,) if which else (instance, whole_of(instance), "")
        for own in candidates:
            if own in order:
                return Reference(((parameter_id, own),), False)
        raise UnknownParameterError(f"{parameter_id} has no instance '{candidates[0]}'")


@lru_cache(maxsize=32)
def conditions_of(schema: Schema, machine: str) -> Conditions:
    """Return the conditions of a family on one machine type."""
    return Conditions(schema, machine)
