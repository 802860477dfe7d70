"""Makes the schema of one control of what it describes and of what is known
of the same parameters by their numbers.

The description counts: which parameters there are, their names, types, labels, bounds and marks. What is
known of a number adds the id, which stays the same for every control, our own help, and the conditions and
rules that go by the id. A parameter that is not known gets an id of its group and its name. How a description
is written is a matter of its family, which hands over DescribedParameters.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from .catalog import Schema, schema_of
from .described import DescriptionError
from .load import Compiled, FurtherFacts
from .model import (
    Bit,
    Choice,
    Condition,
    Effect,
    Family,
    Group,
    Help,
    Layout,
    Messages,
    Numbers,
    Parameter,
    StateRule,
    Storage,
    ValueType,
)
from .model.compiled_json import record_text

_NOT_AT_CONTROL = "not_here"
"""The condition by which a known parameter is hidden that the control does not list."""
_QUANTITIES = {
    "mm": "length",
    "mm/min": "velocity",
    "mm/s2": "acceleration",
    "mm/s3": "jerk",
    "steps/mm": "counts-per-length",
    "ms": "time",
    "us": "time",
    "s": "time",
    "%": "percent",
    "rpm": "rotation",
    "Hz": "frequency",
    "V": "voltage",
    "A": "current",
    "deg": "angle",
}
_YES_NO = (Choice(key="yes", label="Yes", raw=1), Choice(key="no", label="No", raw=0))
_TURNING = ("mm", "mm/min", "mm/s2", "mm/s3", "steps/mm")
"""Units that are degrees where the axis turns."""


@dataclass(frozen=True)
class DescribedGroup:
    """The group of a parameter; its ``order`` among the groups of the control."""

    key: str
    name: str
    section: str = ""
    order: int = 0


@dataclass(frozen=True)
class DescribedParameter:
    """One parameter as a control describes it; what it does not state is empty.

    ``number``  its own; ``base`` that of the first axis, by which it is known: the same for a parameter of
                the control
    ``axis``    the letter of its axis; ``name`` is without it, ``whole_name`` with it
    ``kind``    its type: boolean, bits, choice, integer, real or text
    ``labels``  of its choices or bits, in the order of what is stored; "" for one that is not used
    ``least``, ``most``  its range; None for a bound that is not described
    ``of_axes`` its bits are the axes
    ``text``    what the control writes about it; ``further`` is added to that, or to what is known of it
    """

    number: int
    name: str
    kind: ValueType
    group: DescribedGroup
    base: int
    axis: str = ""
    whole_name: str = ""
    unit: str = ""
    least: float | None = None
    most: float | None = None
    decimals: int = 1
    labels: tuple[str, ...] = ()
    of_axes: bool = False
    needs_restart: bool = False
    secret: bool = False
    text: str = ""
    further: tuple[str, ...] = ()
    also_alike: tuple[object, ...] = field(default=(), repr=False)
    """What else must be the same for parameters of the axes to be one quantity."""

    @property
    def quantity(self) -> object:
        """What parameters of the axes have in common that are one quantity."""
        if not self.axis:
            return self.number
        return self.base, self.kind, self.least, self.most, self.needs_restart, self.unit, self.also_alike


@dataclass(frozen=True)
class DescribedControl:
    """What one control describes, and what is known of its family.

    ``known``   the facts of its family
    ``axes``    its axes
    ``page``    where the facts of a control are
    ``number_format``, ``command``  how a number and an assignment are written: ``${n}``, ``${n}={v}``
    ``left_out``  rules that its own description replaces
    ``stays``   whether a known parameter that the control does not list now is there with another one
    """

    known: Schema
    parameters: Sequence[DescribedParameter]
    axes: tuple[str, ...]
    page: str
    number_format: str
    command: str
    left_out: frozenset[str] = frozenset()
    stays: Callable[[Parameter, frozenset[str]], bool] = lambda _parameter, _listed: False


class DescribedSchema:
    """Makes the schema; ``first`` are parameters that come before those of the description, by their
    group.
    """

    def __init__(self, described: DescribedControl, first: Mapping[str, tuple[Parameter, ...]]) -> None:
        self._described, self._known = described, described.known
        # What is known of other builds is for work without a control; this one describes its own parameters.
        self._of_this = {p.id: p for p in self._known.parameters.values() if p.in_signature}
        self._by_base = _by_base(self._known, self._of_this)
        self._ids = {parameter.id for parameters in first.values() for parameter in parameters}
        self._names = {key: (key.capitalize(), "") for key in first}
        self._groups = {key: list(parameters) for key, parameters in first.items()}

    def made(self, family: Family, messages: Iterable[Messages], description: bytes) -> Schema:
        """Return the schema with the facts of the family as this control has them; raises
        DescriptionError.
        """
        for alike in self._quantities():
            self._add(alike[0].group, self._parameter(alike))
        for parameter in self._of_this.values():
            if parameter.id not in self._ids:
                group = self._known.group_of[parameter.id]
                self._add(DescribedGroup(group.key, group.name), self._not_at_control(parameter))
        made = tuple(
            Group(
                key=key,
                name=self._names[key][0],
                section=self._names[key][1],
                chapter=self._described.page,
                parameters=tuple(sorted(parameters, key=_first_number)),
            )
            for key, parameters in self._groups.items()
        )
        known = self._known
        further = FurtherFacts(
            guides=known.guides,
            messages=tuple(messages),
            commissioning=known.commissioning,
            pictures=known.pictures,
        )
        not_at_control = Condition(when="true", why="this control does not have the setting")
        conditions = family.conditions | {_NOT_AT_CONTROL: not_at_control}
        compiled = Compiled(
            family=family.model_copy(update={"groups": tuple(self._groups), "conditions": conditions}),
            groups=made,
            plausible=known.plausible,
            further=record_text(further),
            rules=tuple(rule for rule in known.rules if rule.id not in self._described.left_out),
        )
        return schema_of(compiled, description)

    def _add(self, group: DescribedGroup, parameter: Parameter) -> None:
        self._names.setdefault(group.key, (group.name, group.section))
        self._groups.setdefault(group.key, []).append(parameter)

    def _quantities(self) -> Iterable[list[DescribedParameter]]:
        """Yield each parameter of the control, and those of the axes that are one quantity together,
        in its order.
        """
        found: dict[object, list[DescribedParameter]] = {}
        for each in sorted(self._described.parameters, key=lambda p: p.number):
            found.setdefault(each.quantity, []).append(each)
        yield from sorted(found.values(), key=lambda alike: (alike[0].group.order, alike[0].number))

    def _parameter(self, alike: list[DescribedParameter]) -> Parameter:
        """Return the one parameter that alike settings of several axes are."""
        first = alike[0]
        known = self._known_one(first)
        name = first.name[:1].upper() + first.name[1:]
        facts = _value_facts(first, self._described)
        if first.kind == "integer" and known and known.storage:
            # A description has no width of whole numbers.
            facts["storage"] = facts["storage"].model_copy(update={"bits": known.storage.bits})
        if first.kind == "bits":
            facts["first_axis"] = 0 if first.of_axes else known.first_axis if known else None
        return Parameter(
            id=self._id(first, known),
            name=name,
            type=first.kind,
            states=known.states if known else (),
            page=self._described.page,
            effect=Effect(level="restart") if first.needs_restart else None,
            secret=first.secret,
            help=_help(first, known),
            optional=known.optional if known else False,
            layouts=(self._layout(alike),),
            **facts,
        )

    def _known_one(self, described: DescribedParameter) -> Parameter | None:
        """Return the parameter of the facts that has the same number, type and scope."""
        kind = (described.kind, bool(described.axis))
        # A build may use a number for something else: what is known of it then does not fit.
        same_number = self._by_base.get(described.base, ())
        return next((p for p in same_number if (p.type, _is_axis(p)) == kind), None)

    def _id(self, first: DescribedParameter, known: Parameter | None) -> str:
        wanted = known.id if known else f"{first.group.key}.{group_key(first.name) or 'setting'}"
        # An id of the facts stays theirs, whether this control lists that parameter or not.
        is_taken = wanted in self._ids or (known is None and wanted in self._of_this)
        parameter_id = f"{wanted}_{first.number}" if is_taken else wanted
        self._ids.add(parameter_id)
        return parameter_id

    def _layout(self, alike: list[DescribedParameter]) -> Layout:
        first, form = alike[0], self._described.number_format
        if not first.axis:
            return Layout(scope="global", numbers=Numbers(start=first.base, format=form))
        listed = {each.axis: str(each.number) for each in alike}
        return Layout(scope="axis", instances=tuple(listed), numbers=Numbers(listed=listed, format=form))

    def _not_at_control(self, parameter: Parameter) -> Parameter:
        """Return a known parameter that the control does not list: hidden and without a number,
        so that rules find nothing.

        One that comes with another parameter keeps its number, and its state.
        """
        self._ids.add(parameter.id)
        page = self._described.page
        layout = self._known.on(self._known.family.default_machine).layout(parameter)
        if layout is None:
            return parameter.model_copy(update={"layouts": (), "default": None, "page": page})
        if layout.numbers is None or not self._described.stays(parameter, frozenset(self._ids)):
            state = StateRule(state="hidden", when=_NOT_AT_CONTROL, page=page)
            bare = layout.model_copy(update={"instances": None, "numbers": None})
            return parameter.model_copy(
                update={"layouts": (bare,), "states": (state,), "default": None, "page": page}
            )
        if layout.scope == "axis":
            start = layout.numbers.start or 0
            listed = {axis: str(start + n) for n, axis in enumerate(self._described.axes)}
            numbers = Numbers(listed=listed, format=self._described.number_format)
            layout = layout.model_copy(update={"numbers": numbers})
        return parameter.model_copy(update={"layouts": (layout,), "default": None})


def group_key(text: str) -> str:
    """Return a text as a part of an id."""
    return re.sub("[^a-z0-9]+", "_", text.casefold()).strip("_")[:60]


def _value_facts(described: DescribedParameter, control: DescribedControl) -> dict[str, Any]:
    """Return what a described parameter takes: range, choices, bits, storage; raises DescriptionError."""
    kind, command = described.kind, control.command
    if kind == "boolean":
        return {"choices": _YES_NO, "storage": Storage(command=command)}
    if kind == "choice":
        return {"choices": _choices(described, control), "storage": Storage(command=command)}
    if kind == "bits":
        labels = described.labels
        bits = tuple(Bit(bit=n, label=label) for n, label in enumerate(labels) if label)
        return {"bits": bits, "storage": Storage(bits=max(1, len(labels)), signed=False, command=command)}
    if kind == "text":
        return {"storage": Storage(command=command)}
    return _number_facts(described, command)


def _number_facts(described: DescribedParameter, command: str | None) -> dict[str, Any]:
    """Return range, unit and storage of a described number."""
    unit, least = described.unit, described.least
    facts: dict[str, Any] = {
        "ranges": {unit: (least, described.most)},
        "unit": None if unit in _TURNING else unit or None,
        "quantity": _QUANTITIES.get(unit, ""),
    }
    if described.kind == "integer":
        is_signed = least is None or least < 0
        return facts | {"storage": Storage(unit=unit, bits=32, signed=is_signed, command=command)}
    storage = Storage(unit=unit, decimals=described.decimals, single=True, command=command)
    return facts | {"decimals": described.decimals, "storage": storage}


def _choices(described: DescribedParameter, control: DescribedControl) -> tuple[Choice, ...]:
    """Return the choices of a described parameter by their codes; a label that occurs twice gets its code."""
    found: dict[str, Choice] = {}
    for raw, label in enumerate(described.labels):
        if not label:
            continue
        key = group_key(label) or f"choice_{raw}"
        twice = key in found
        found[f"{key}_{raw}" if twice else key] = Choice(
            key=f"{key}_{raw}" if twice else key, label=f"{label} ({raw})" if twice else label, raw=raw
        )
    if not found:
        number = control.number_format.replace("{n}", str(described.number))
        raise DescriptionError(f"{number} is a choice and has none")
    return tuple(found.values())


def _help(described: DescribedParameter, known: Parameter | None) -> Help:
    own = described.text or (known.help.what if known else f"{described.whole_name or described.name}.")
    what = " ".join(filter(None, (own, *described.further)))
    return known.help.model_copy(update={"what": what}) if known else Help(what=what)


def _by_base(known: Schema, parameters: Mapping[str, Parameter]) -> dict[int, list[Parameter]]:
    """Return the number of the first instance -> known parameters with it,
    those of the first machine type before others.
    """
    found: dict[int, list[Parameter]] = {}
    for machine in known.family.machines:
        for parameter in parameters.values():
            layout = known.on(machine.key).layout(parameter)
            start = layout.numbers.start if layout and layout.numbers else None
            if start is not None and parameter not in found.setdefault(start, []):
                found[start].append(parameter)
    return found


def _first_number(parameter: Parameter) -> int:
    layout = parameter.layouts[0] if parameter.layouts else None
    numbers = layout.numbers if layout else None
    if numbers is None:
        return -1
    return min(map(int, numbers.listed.values())) if numbers.listed else numbers.start or 0


def _is_axis(parameter: Parameter) -> bool:
    return "axis" in parameter.scopes
