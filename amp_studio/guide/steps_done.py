"""How far a file has come in the steps of commissioning.

A value is *open* where the file needs it and has none: the parameter is active, can be set, and is not one
that a file is complete without. A value is *untouched* where it is open or the printed default.

A finding belongs to the last step of which it reads an untouched value: not before then has the user put that
value next to the others. Where it reads none it belongs to the step of what is wrong.

The steps are reached in their order, as far as the first that is not finished: it has an open value, or an
error belongs to it. In a file in which nothing is set but its axes none is reached; in one that lacks no
value all are, and what is ticked as done is, with the steps before it. A finding that belongs to a later step
is deferred, as delivered: a state of the file and no fault in it, unless the user has set what is wrong: he
learns it at once. A download and its preview know nothing of steps.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import Literal

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Family
from amp_studio.validate import NOT_SET, Finding, Validator

from .steps import REST, SetupStep, step_of, steps_of

StepState = Literal["not begun", "begun", "done", "not needed"]


@dataclass(frozen=True)
class StepProgress:
    """One step in one file."""

    step: SetupStep
    total: int
    """Values that the user has to give: active ones without a printed default, and open ones."""
    open: tuple[Address, ...]
    """Those of them that are not set, parameter by parameter."""
    active: int
    """Values that are active, with or without a default."""
    own: int
    """Active values that are not the printed default."""
    findings: tuple[Finding, ...]
    """The findings about its values that are not deferred."""
    errors: int
    """How many errors are about its values, deferred ones too."""
    ticked: str
    """By whom and when it was ticked as done; empty where it is not."""

    @property
    def set(self) -> int:
        """How many of the values that have to be given are set."""
        return self.total - len(self.open)

    def count(self, severity: str) -> int:
        """Return how many findings of a severity there are."""
        return sum(f.severity == severity for f in self.findings)

    @property
    def state(self) -> StepState:
        """How far it is.

        It is done when nothing is open, nothing about it is an error, and all that the user had to give is
        given. Where every value has a default the user had to give none: then it is done when it is ticked.
        """
        if not self.active or (self.step.id == REST and not (self.total or self.own)):
            return "not needed"
        if not self.open and not self.errors and (self.total or self.ticked):
            return "done"
        return "begun" if self.own or self.ticked else "not begun"


@dataclass(frozen=True)
class GuideProgress:
    """All steps of one file."""

    steps: tuple[StepProgress, ...]
    current: StepProgress | None
    """The first step that is not finished, up to which the steps are reached; None where all are."""
    deferred: tuple[Finding, ...]
    """Findings of steps that have not been reached."""
    deferred_to: tuple[int, ...]
    """The numbers of these steps, in their order."""
    places: Mapping[Address, int]
    """The place of each address in the manual's order."""

    @property
    def total(self) -> int:
        """Values that the user has to give."""
        return sum(each.total for each in self.steps)

    @property
    def set(self) -> int:
        """How many of them are set."""
        return sum(each.set for each in self.steps)

    @property
    def needed(self) -> tuple[StepProgress, ...]:
        """The steps that this machine needs."""
        return tuple(each for each in self.steps if each.state != "not needed")

    @property
    def done(self) -> int:
        """How many steps are done."""
        return sum(each.state == "done" for each in self.steps)

    def of(self, step: SetupStep) -> StepProgress:
        """Return the progress of a step."""
        return self.steps[step.number - 1]


class _StepCounts:
    """What the active values of a file make of each step, by its number."""

    def __init__(self, validator: Validator, places: Mapping[str, SetupStep]) -> None:
        file, not_set = validator.file, set(validator.not_set)
        self.total, self.active, self.own = Counter[int](), Counter[int](), Counter[int]()
        self.open: dict[int, list[Address]] = {}
        for address in validator.needed():
            number = places[address[0]].number
            self.active[number] += 1
            if address in not_set:
                self.open.setdefault(number, []).append(address)
                self.total[number] += 1
            elif address in file.values:
                # A default that is kept may be a choice too, but in a file it is like one that was never
                # checked.
                has_default = file.schema.parameters[address[0]].default is not None
                self.total[number] += not has_default
                self.own[number] += not has_default or not file.is_default(address)


class _StepFindings:
    """The findings of each step, by its number: those of steps that lie beyond ``come_to`` are deferred."""

    def __init__(
        self, belongs: Iterable[tuple[Finding, int, bool]], places: Mapping[str, SetupStep], come_to: int
    ) -> None:
        self.about: dict[int, list[Finding]] = {}
        self.errors = Counter[int]()
        self.deferred: list[tuple[Finding, int]] = []
        for finding, number, is_own in belongs:
            # Once a step, however many of its values cause it.
            its = {places[name].number for name, _ in finding.causes if name in places}
            if finding.severity == "error":
                self.errors.update(its)
            if number > come_to and not is_own:
                self.deferred.append((finding, number))
                continue
            for place in its:
                self.about.setdefault(place, []).append(finding)


def progress(validator: Validator, findings: Sequence[Finding] | None = None) -> GuideProgress:
    """Return how far the file of a validator, which has run, has come; ``findings`` are its present ones."""
    file, findings = validator.file, validator.findings() if findings is None else findings
    places, steps = step_of(file.schema), steps_of(file.schema)
    counts = _StepCounts(validator, places)
    belongs = [(f, *_belongs_to(file, f)) for f in findings if f.rule != NOT_SET]
    reached = min({*counts.open} | _steps_with_errors(belongs), default=len(steps) + 1)
    # In a fresh file nothing is reached: every finding is about printed defaults.
    come_to = len(steps) if not validator.not_set else 0 if _is_fresh(file) else reached
    ticked = (step.number for step in steps if step.id in file.header.done)
    # A tick is a person's word that the steps up to it are done: their findings count at once.
    found = _StepFindings(belongs, places, max(come_to, *ticked, 0))
    each = tuple(
        StepProgress(
            step,
            counts.total[step.number],
            _in_order(step, counts.open.get(step.number, ())),
            counts.active[step.number],
            counts.own[step.number],
            tuple(found.about.get(step.number, ())),
            found.errors[step.number],
            file.header.done.get(step.id, ""),
        )
        for step in steps
    )
    return GuideProgress(
        each,
        each[reached - 1] if reached <= len(steps) else None,
        tuple(finding for finding, _ in found.deferred),
        tuple(sorted({number for _, number in found.deferred})),
        file.machine_schema.places,
    )


def _is_fresh(file: ParameterFile) -> bool:
    """Return whether a file contains printed defaults and its axes only."""
    given = _axis_parameters(file.schema.family)
    return all(address[0] in given or file.is_default(address) for address in file.values)


def _axis_parameters(family: Family) -> frozenset[str]:
    """Return the parameters that a new file has values of besides the printed defaults."""
    named: list[str | None] = [family.machine_parameter, family.unit_parameter]
    if family.axes is not None:
        named += [family.axes.name, family.axes.type, family.axes.fitted_by]
    declared = family.declared_axes
    if declared is not None:
        named += [*declared.flags, declared.count, declared.letters, declared.group_count]
        named += [field.param for field in (declared.name, declared.group) if field is not None]
    return frozenset(filter(None, named))


def _belongs_to(file: ParameterFile, finding: Finding) -> tuple[int, bool]:
    """Return the number of the step to which a finding belongs, 0 for none,
    and whether the user has set what is wrong.
    """
    places = step_of(file.schema)

    def is_untouched(address: Address) -> bool:
        return address not in file.values or file.is_default(address)

    untouched = [places[a[0]].number for a in finding.addresses if a[0] in places and is_untouched(a)]
    causes = [places[a[0]].number for a in finding.causes if a[0] in places]
    # The last step with an untouched value: before that one is set they cannot have been compared.
    return max(untouched or causes[:1], default=0), not all(map(is_untouched, finding.causes))


def _in_order(step: SetupStep, addresses: Sequence[Address]) -> tuple[Address, ...]:
    """Return addresses parameter by parameter in the order of a step, each over its instances."""
    places = {p.id: n for n, p in enumerate(step.parameters)}
    return tuple(sorted(addresses, key=lambda address: places[address[0]]))


def next_open(now: GuideProgress, after: Address | None = None) -> Address | None:
    """Return the next open value behind an address in the order of the steps,
    from the first again after the last.

    Without an address, or one that is in no step, it is the first. None where nothing is open.
    """
    opened = [*chain.from_iterable(each.open for each in now.steps)]
    if after is None:
        return next(iter(opened), None)
    parameters = chain.from_iterable(each.step.parameters for each in now.steps)
    place = {p.id: n for n, p in enumerate(parameters)}
    here = place.get(after[0], -1)
    at = now.places.get(after, -1)
    # First the other axes of the same parameter, then what comes behind it, then from the top again.
    own = [a for a in opened if a[0] == after[0] and now.places[a] > at]
    behind = [a for a in opened if place[a[0]] > here]
    return next(iter([*own, *behind, *opened]), None)


def _steps_with_errors(belongs: Iterable[tuple[Finding, int, object]]) -> set[int]:
    return {number for finding, number, _ in belongs if finding.severity == "error" and number}
