"""The schema of one control, made of its description and of what is known of the settings by their numbers.

The description counts: which settings there are, their names, types, labels, bounds and marks. What is known of a
number adds the id, which stays the same for every control, our own help, and the conditions and rules that go by the id.
A setting that nobody knows gets an id of its group and its name.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from amp_studio.schema import Parameter, Schema, UnitError, load_schema, unit_named
from amp_studio.schema.catalog import schema_of as made_of
from amp_studio.schema.described import DescriptionError
from amp_studio.schema.load import Compiled, FurtherFacts
from amp_studio.schema.model import (
    Bit,
    Choice,
    Condition,
    ControlMessage,
    Default,
    Effect,
    Family,
    Group,
    Help,
    Layout,
    Messages,
    Numbers,
    StateRule,
    Storage,
    ValueType,
)  # fmt: skip
from amp_studio.schema.model.compiled_json import record_text

from .description import (
    AXES,
    BOOLEAN,
    CHOICE,
    DECIMAL,
    INTEGER,
    MASK,
    PASSWORD,
    SWITCHED_MASK,
    Description,
    Setting,
    description_of,
    read_description,
)  # fmt: skip

FAMILY = "grblhal"
PAGE = "ES"
"""Where the facts of a control are: its answer to ``$ES``."""
KEPT_STATES = ("per_axis_rates",)
"""Conditions by which a setting comes and goes with another one: it is known though the control does not list it now."""
AXES_RULE = "grblhal.build.axes"
"""Which letters a build can have; those of a control are in its description."""
ABSENT = "not_here"
"""The condition by which a known setting is hidden that the control does not list."""
_AXIS_GROUP = "Axis"
_UNITS = {"microseconds": "us", "milliseconds": "ms", "step/mm": "steps/mm", "step/deg": "steps/mm"}
_LINEAR = {"deg": "mm", "deg/min": "mm/min", "deg/s2": "mm/s2", "deg/s3": "mm/s3", "steps/deg": "steps/mm"}
"""A rotary axis is described in degrees; that it turns is a matter of a setting, and the schema is the same."""
_QUANTITIES = {
    "mm": "length", "mm/min": "velocity", "mm/s2": "acceleration", "mm/s3": "jerk", "steps/mm": "counts-per-length",
    "ms": "time", "us": "time", "s": "time", "%": "percent", "rpm": "rotation", "Hz": "frequency", "V": "voltage",
    "A": "current", "deg": "angle",
}  # fmt: skip
_TYPES: dict[int, ValueType] = {
    BOOLEAN: "boolean",
    MASK: "bits",
    SWITCHED_MASK: "bits",
    CHOICE: "choice",
    AXES: "bits",
    INTEGER: "integer",
    DECIMAL: "real",
}


def schema_of(content: bytes) -> Schema:
    """Return the schema of the control that a content describes; raises DescriptionError."""
    return _Maker(read_description(content)).schema(description_of(content))


class _Maker:
    """Makes the schema of one control."""

    def __init__(self, told: Description) -> None:
        self.told = told
        self.known = load_schema(FAMILY)
        self.ids: set[str] = set()
        # What is known of other builds is for work without a control; this one describes its own settings.
        self.of_plain_build = {p.id: p for p in self.known.parameters.values() if p.in_signature}
        self.by_number = _by_number(self.known, self.of_plain_build)
        self.axes = tuple(told.axes)
        if not self.axes:
            raise DescriptionError("the axes of the control are not described: its answer to $I is needed")

    def schema(self, description: bytes) -> Schema:
        groups: dict[str, list[Parameter]] = {"build": self._build()}
        names = {"build": ("Build", "")}
        for settings in self._quantities():
            key, name, section = self._group(settings[0])
            names.setdefault(key, (name, section))
            groups.setdefault(key, []).append(self._parameter(settings, key))
        for parameter in self.of_plain_build.values():
            if parameter.id not in self.ids:
                group = self.known.group_of[parameter.id]
                names.setdefault(group.key, (group.name, ""))
                groups.setdefault(group.key, []).append(self._absent(parameter))
        made = tuple(
            Group(
                key=key,
                name=names[key][0],
                section=names[key][1],
                chapter=PAGE,
                parameters=tuple(sorted(parameters, key=_first_number)),
            )
            for key, parameters in groups.items()
        )
        known = self.known
        further = FurtherFacts(
            guides=known.guides, messages=tuple(self._messages()), commissioning=known.commissioning,
            pictures=known.pictures,
        )  # fmt: skip
        compiled = Compiled(
            family=self._family(tuple(groups)), groups=made, plausible=known.plausible, further=record_text(further),
            rules=tuple(r for r in known.rules if r.id != AXES_RULE),
        )  # fmt: skip
        return made_of(compiled, description)

    # -- family, messages -------------------------------------------------

    def _family(self, groups: tuple[str, ...]) -> Family:
        known, facts = self.known.family, self.told.facts
        scopes = {
            k: v.model_copy(update={"instances": self.axes} if k == "axis" else {})
            for k, v in known.scopes.items()
        }
        rotary = "{" + ", ".join(f"'{a}': {n}.0" for n, a in enumerate(self.axes[3:])) + "}"
        letters = "[" + ", ".join(f"'{a}'" for a in self.axes[3:]) + "]"
        when = f"instance in {letters} && bit(rotary, {rotary}[instance])" if self.axes[3:] else "false"
        conditions = known.conditions | {
            ABSENT: Condition(when="true", why="this control does not have the setting"),
            "rotary_axis": known.conditions["rotary_axis"].model_copy(update={"when": when}),
        }
        who = ", ".join(filter(None, (facts.get("VER", "").strip(":"), facts.get("BOARD"), facts.get("DRIVER"),
                                      facts.get("DRIVER VERSION"))))  # fmt: skip
        return known.model_copy(update={
            "title": f"grblHAL {who}, as the control describes itself ($ES)", "scopes": scopes, "groups": groups,
            "conditions": conditions, "machines": known.machines[:1],
        })  # fmt: skip

    def _messages(self) -> Iterable[Messages]:
        """Yield the control's own lists, with what is known of a code; the known list where it has none."""
        told = {
            "alarms": ("ALARM", "alarm", "EA", self.told.alarms),
            "errors": ("error", "error", "EE", self.told.errors),
        }
        for known in self.known.message_lists:
            word, reaction, page, texts = told[known.id]
            by_code = {message.code: message for message in known.messages}
            own = []
            for n, text in sorted(texts.items()):
                if text:
                    new = {"id": f"{reaction}-{n}", "code": f"{word}:{n}", "reaction": reaction, "page": page}
                    same = by_code.get(f"{word}:{n}")
                    facts = same.model_dump() if same is not None else new
                    own.append(
                        ControlMessage.model_validate(facts | {"text": text, "title": "", "page": page})
                    )
            yield known.model_copy(update={"page": page, "messages": tuple(own)}) if own else known

    # -- settings --------------------------------------------------------------

    def _axis(self, setting: Setting) -> str:
        """Return the letter of the axis that a setting is of; empty for a setting of the control."""
        letter, dash, _ = setting.name.partition("-axis ")
        group = self.told.groups.get(setting.group)
        inside = self.told.groups.get(group.parent) if group else None
        if dash and letter in self.axes and inside is not None and inside.name == _AXIS_GROUP:
            return letter if self.axes.index(letter) == setting.number % 10 else ""
        return ""

    def _quantities(self) -> Iterable[list[Setting]]:
        """Yield each setting of the control, and those of the axes that are the same quantity together, in its order."""
        found: dict[object, list[Setting]] = {}
        for setting in sorted(self.told.settings.values(), key=lambda s: s.number):
            axis = self._axis(setting)
            alike = (setting.type, setting.format, setting.least, setting.most, setting.needs_restart,
                     setting.may_be_zero, _unit_of(setting))  # fmt: skip
            key = (setting.number - self.axes.index(axis), alike) if axis else setting.number
            found.setdefault(key, []).append(setting)
        order = {g: n for n, g in enumerate(self.told.groups)}
        yield from sorted(found.values(), key=lambda s: (order.get(s[0].group, len(order)), s[0].number))

    def _group(self, setting: Setting) -> tuple[str, str, str]:
        """Return key, name and section of the group of a setting: a group inside another one is a section of that."""
        if self._axis(setting):
            return "axis", _AXIS_GROUP, ""
        group = self.told.groups.get(setting.group)
        if group is None:
            return "other", "Other", ""
        same = next((g for g in self.known.groups if g.name == group.name), None)
        parent = self.told.groups.get(group.parent)
        inside = parent is not None and parent.number not in (group.number, parent.parent)
        key = same.key if same else _key(group.name) or f"group_{group.number}"
        return key, parent.name if inside and parent else group.name, group.name if inside else ""

    def _parameter(self, settings: list[Setting], group: str) -> Parameter:
        first, axis = settings[0], self._axis(settings[0])
        base = first.number - (self.axes.index(axis) if axis else 0)
        kind = _TYPES.get(first.type, "text")
        known = next(
            (p for p in self.by_number.get(base, ()) if p.type == kind and (_is_axis(p) == bool(axis))), None
        )
        name = first.name.partition("-axis ")[2] if axis else first.name
        name = name[:1].upper() + name[1:]
        wanted = known.id if known else f"{group}.{_key(name) or 'setting'}"
        is_taken = wanted in self.ids or (known is None and wanted in self.of_plain_build)
        parameter_id = f"{wanted}_{first.number}" if is_taken else wanted
        self.ids.add(parameter_id)
        facts: dict[str, Any] = _value_facts(first, kind, self.axes)
        if kind == "integer" and known and known.storage:
            facts["storage"] = facts["storage"].model_copy(update={"bits": known.storage.bits})
        if kind == "bits":
            facts["first_axis"] = 0 if first.type == AXES else known.first_axis if known else None
        facts["layouts"] = (self._layout(settings, axis, base),)
        return Parameter(
            id=parameter_id, name=name, type=kind, states=known.states if known else (), page=PAGE,
            effect=Effect(level="restart") if first.needs_restart else None, secret=first.type == PASSWORD,
            help=self._help(first, known), optional=known.optional if known else False, **facts,
        )  # fmt: skip

    def _layout(self, settings: list[Setting], axis: str, base: int) -> Layout:
        if not axis:
            return Layout(scope="global", numbers=Numbers(start=base, format="${n}"))
        listed = {self._axis(s): str(s.number) for s in settings}
        return Layout(scope="axis", instances=tuple(listed), numbers=Numbers(listed=listed, format="${n}"))

    def _help(self, setting: Setting, known: Parameter | None) -> Help:
        told = self.told.helps.get(setting.number, "")
        unit = f"In {setting.unit}." if setting.unit and not _unit_of(setting) else ""
        length = (
            f"At most {setting.most} characters." if _TYPES.get(setting.type) is None and setting.most else ""
        )
        what = " ".join(
            filter(None, (told or (known.help.what if known else setting.name + "."), unit, length))
        )
        return known.help.model_copy(update={"what": what}) if known else Help(what=what)

    # -- what the control does not list ------------------------------------------

    def _absent(self, parameter: Parameter) -> Parameter:
        """Return a known setting that the control does not list: hidden and without a number, so that rules find nothing.

        What a listed one brings along keeps its number, and its state.
        """
        self.ids.add(parameter.id)
        layout = self.known.on(self.known.family.default_machine).layout(parameter)
        if layout is None:
            return parameter.model_copy(update={"layouts": (), "default": None, "page": PAGE})
        comes = "homing.cycle" in self.ids and any(
            (s.when or s.unless) in KEPT_STATES for s in parameter.states
        )
        if not comes or layout.numbers is None:
            state = StateRule(state="hidden", when=ABSENT, page=PAGE)
            bare = layout.model_copy(update={"instances": None, "numbers": None})
            return parameter.model_copy(
                update={"layouts": (bare,), "states": (state,), "default": None, "page": PAGE}
            )
        numbers = layout.numbers
        if layout.scope == "axis":
            listed = {a: str((numbers.start or 0) + n) for n, a in enumerate(self.axes)}
            layout = layout.model_copy(update={"numbers": Numbers(listed=listed, format="${n}")})
        return parameter.model_copy(update={"layouts": (layout,), "default": None})

    def _build(self) -> list[Parameter]:
        """Return what is compiled in, with the description of this control as the default."""
        axes, rate = (self.known.parameters[p] for p in ("build.axes", "build.max_step_rate"))
        told = self.told.max_step_rate
        self.ids |= {axes.id, rate.id}
        return [
            axes.model_copy(update={"default": Default(value=self.told.axes, page="I"), "page": "I"}),
            rate.model_copy(update={"default": None if told is None else Default(value=told, unit="Hz", page="I"), "page": "I"}),
        ]  # fmt: skip


def _by_number(known: Schema, parameters: Mapping[str, Parameter]) -> dict[int, list[Parameter]]:
    """Return the number of the first instance -> known parameters with it, those of grblHAL before those of Grbl 1.1."""
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


def _key(text: str) -> str:
    """Return a text as a part of an id."""
    return re.sub("[^a-z0-9]+", "_", text.casefold()).strip("_")[:60]


def _unit_of(setting: Setting) -> str:
    """Return the unit of a setting; that of a straight axis in place of degrees. Empty where it is not known."""
    text = setting.unit.replace("/sec^", "/s").replace("/sec", "/s")
    try:
        unit = _UNITS.get(text) or unit_named(text)
    except UnitError:
        return ""
    return _LINEAR.get(unit, unit)


def _value_facts(setting: Setting, kind: str, axes: tuple[str, ...]) -> dict[str, Any]:
    """Return what a setting takes: range, choices, bits, storage."""
    command = "${n}={v}"
    if kind == "boolean":
        choices = (Choice(key="yes", label="Yes", raw=1), Choice(key="no", label="No", raw=0))
        return {"choices": choices, "storage": Storage(command=command)}
    if kind == "choice":
        return {"choices": _choices(setting), "storage": Storage(command=command)}
    if kind == "bits":
        labels = axes if setting.type == AXES else setting.labels
        bits = tuple(Bit(bit=n, label=label) for n, label in enumerate(labels) if label)
        return {"bits": bits, "storage": Storage(bits=max(1, len(labels)), signed=False, command=command)}
    if kind == "text":
        return {"storage": Storage(command=command)}
    unit = _unit_of(setting)
    decimals = len(setting.format.partition(".")[2]) if "." in setting.format else 1
    # A setting without a least value refuses what is negative (S3219).
    least = 0.0 if not setting.least or setting.may_be_zero else float(setting.least)
    most = float(setting.most) if setting.most else None
    facts: dict[str, Any] = {
        "ranges": {unit: (least, most)},
        "unit": unit or None,
        "quantity": _QUANTITIES.get(unit, ""),
    }
    if unit in ("mm", "mm/min", "mm/s2", "mm/s3", "steps/mm"):
        facts["unit"] = None  # it is in degrees where the axis turns
    if kind == "integer":
        return facts | {"storage": Storage(unit=unit, bits=32, signed=least < 0, command=command)}
    storage = Storage(unit=unit, decimals=decimals, single=True, command=command)
    return facts | {"decimals": decimals, "storage": storage}


def _choices(setting: Setting) -> tuple[Choice, ...]:
    found: dict[str, Choice] = {}
    for raw, label in enumerate(setting.labels):
        if not label:
            continue
        key = _key(label) or f"choice_{raw}"
        twice = key in found
        found[f"{key}_{raw}" if twice else key] = Choice(
            key=f"{key}_{raw}" if twice else key, label=f"{label} ({raw})" if twice else label, raw=raw
        )
    if not found:
        raise DescriptionError(f"${setting.number} is a choice and has none")
    return tuple(found.values())
