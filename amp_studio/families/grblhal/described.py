"""What a grblHAL describes of itself, for the schema of that control (schema/described_parameters.py)."""

from __future__ import annotations

from collections.abc import Iterable

from amp_studio.schema import (
    ControlMessage,
    Default,
    DescribedControl,
    DescribedGroup,
    DescribedParameter,
    DescribedSchema,
    DescriptionError,
    Family,
    Messages,
    Parameter,
    Schema,
    UnitError,
    ValueType,
    group_key,
    load_schema,
    unit_named,
)

from .description import (
    AXES,
    BOOLEAN,
    CHOICE,
    DECIMAL,
    INTEGER,
    MASK,
    PASSWORD,
    SWITCHED_MASK,
    DescribedSetting,
    Description,
    description_of,
    read_description,
)

FAMILY = "grblhal"
_PAGE = "ES"
"""Where the facts of a control are: its answer to ``$ES``."""
_KEPT_STATES = ("per_axis_rates",)
"""Conditions by which a setting comes and goes with another one:
it is known though the control does not list it now."""
_AXES_RULE = "grblhal.build.axes"
"""Which letters a build can have; those of a control are in its description."""
_AXIS_GROUP = "Axis"
_UNITS = {"microseconds": "us", "milliseconds": "ms", "step/mm": "steps/mm", "step/deg": "steps/mm"}
_LINEAR = {"deg": "mm", "deg/min": "mm/min", "deg/s2": "mm/s2", "deg/s3": "mm/s3", "steps/deg": "steps/mm"}
"""A rotary axis is described in degrees; that it turns is a matter of a setting, and the schema is the
same."""
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
    """Hands over what one control describes of itself, in the terms of every control that does."""

    def __init__(self, described: Description) -> None:
        self.described = described
        self.known = load_schema(FAMILY)
        self.axes = tuple(described.axes)
        self._order = {number: n for n, number in enumerate(described.groups)}
        if not self.axes:
            raise DescriptionError("the axes of the control are not described: its answer to $I is needed")

    def schema(self, description: bytes) -> Schema:
        control = DescribedControl(
            known=self.known,
            parameters=[self._parameter(setting) for setting in self.described.settings.values()],
            axes=self.axes,
            page=_PAGE,
            number_format="${n}",
            command="${n}={v}",
            left_out=frozenset({_AXES_RULE}),
            stays=_keeps_its_place,
        )
        made = DescribedSchema(control, {"build": self._build()})
        return made.made(self._family(), self._messages(), description)

    # -- family, messages -------------------------------------------------

    def _family(self) -> Family:
        """Return the record of the family with the axes and the revision that the control describes."""
        known, facts = self.known.family, self.described.facts
        scopes = {
            k: v.model_copy(update={"instances": self.axes} if k == "axis" else {})
            for k, v in known.scopes.items()
        }
        rotary = "{" + ", ".join(f"'{a}': {n}.0" for n, a in enumerate(self.axes[3:])) + "}"
        letters = "[" + ", ".join(f"'{a}'" for a in self.axes[3:]) + "]"
        when = f"instance in {letters} && bit(rotary, {rotary}[instance])" if self.axes[3:] else "false"
        turning = known.conditions["rotary_axis"].model_copy(update={"when": when})
        who = ", ".join(
            filter(
                None,
                (
                    facts.get("VER", "").strip(":"),
                    facts.get("BOARD"),
                    facts.get("DRIVER"),
                    facts.get("DRIVER VERSION"),
                ),
            )
        )
        return known.model_copy(
            update={
                "title": f"grblHAL {who}, as the control describes itself ($ES)",
                "scopes": scopes,
                "conditions": known.conditions | {"rotary_axis": turning},
                "machines": known.machines[:1],
            }
        )

    def _messages(self) -> Iterable[Messages]:
        """Yield the control's own lists, with what is known of a code; the known list where it has none."""
        described = {
            "alarms": ("ALARM", "alarm", "EA", self.described.alarms),
            "errors": ("error", "error", "EE", self.described.errors),
        }
        for known in self.known.message_lists:
            if known.id not in described:  # symptoms: a control does not know of them
                yield known
                continue
            word, reaction, page, texts = described[known.id]
            by_code = {message.code: message for message in known.messages}
            own = []
            for n, text in sorted(texts.items()):
                if text:
                    new = {"id": f"{reaction}-{n}", "code": f"{word}:{n}", "reaction": reaction, "page": page}
                    same = by_code.get(f"{word}:{n}")
                    # The control's words, with the causes and cures that are known of the code.
                    facts = same.model_dump() if same is not None else new
                    own.append(
                        ControlMessage.model_validate(facts | {"text": text, "title": "", "page": page})
                    )
            yield known.model_copy(update={"page": page, "messages": tuple(own)}) if own else known

    # -- settings --------------------------------------------------------------

    def _axis(self, setting: DescribedSetting) -> str:
        """Return the letter of the axis that a setting is of; empty for a setting of the control."""
        letter, dash, _ = setting.name.partition("-axis ")
        group = self.described.groups.get(setting.group)
        inside = self.described.groups.get(group.parent) if group else None
        if dash and letter in self.axes and inside is not None and inside.name == _AXIS_GROUP:
            # The last digit of a number is its axis; another one only looks like the setting of an axis.
            return letter if self.axes.index(letter) == setting.number % 10 else ""
        return ""

    def _group(self, setting: DescribedSetting) -> DescribedGroup:
        """Return the group of a setting: a group inside another one is a section of that."""
        order = self._order.get(setting.group, len(self._order))
        if self._axis(setting):
            return DescribedGroup("axis", _AXIS_GROUP, order=order)
        group = self.described.groups.get(setting.group)
        if group is None:
            return DescribedGroup("other", "Other", order=order)
        same = next((g for g in self.known.groups if g.name == group.name), None)
        parent = self.described.groups.get(group.parent)
        # The root group is its own parent: it is no heading of anything.
        inside = parent is not None and parent.number not in (group.number, parent.parent)
        key = same.key if same else group_key(group.name) or f"group_{group.number}"
        if inside and parent:
            return DescribedGroup(key, parent.name, group.name, order)
        return DescribedGroup(key, group.name, order=order)

    def _parameter(self, setting: DescribedSetting) -> DescribedParameter:
        """Return a setting as the schema takes the parameters of a control that describes itself."""
        axis, kind, unit = self._axis(setting), _TYPES.get(setting.type, "text"), _unit_of(setting)
        further = (
            f"In {setting.unit}." if setting.unit and not unit else "",
            f"At most {setting.most} characters." if kind == "text" and setting.most else "",
        )
        return DescribedParameter(
            number=setting.number,
            name=setting.name.partition("-axis ")[2] if axis else setting.name,
            kind=kind,
            group=self._group(setting),
            base=setting.number - (self.axes.index(axis) if axis else 0),
            axis=axis,
            whole_name=setting.name,
            unit=unit,
            # A setting without a least value refuses what is negative (S3219).
            least=0.0 if not setting.least or setting.may_be_zero else _number(setting.least, kind),
            most=_number(setting.most, kind) if setting.most else None,
            decimals=len(setting.format.partition(".")[2]) if "." in setting.format else 1,
            labels=self.axes if setting.type == AXES else setting.labels,
            of_axes=setting.type == AXES,
            needs_restart=setting.needs_restart,
            secret=setting.type == PASSWORD,
            text=self.described.helps.get(setting.number, ""),
            further=further,
            also_alike=(setting.type, setting.format, setting.least, setting.most, setting.may_be_zero),
        )

    def _build(self) -> tuple[Parameter, ...]:
        """Return what is compiled in, with the description of this control as the default."""
        axes, rate = (self.known.parameters[p] for p in ("build.axes", "build.max_step_rate"))
        described = self.described.max_step_rate
        return (
            axes.model_copy(update={"default": Default(value=self.described.axes, page="I"), "page": "I"}),
            rate.model_copy(
                update={
                    "default": None if described is None else Default(value=described, unit="Hz", page="I"),
                    "page": "I",
                }
            ),
        )


def _keeps_its_place(parameter: Parameter, listed: frozenset[str]) -> bool:
    """Return whether a setting that the control does not list now comes with one that it lists."""
    return "homing.cycle" in listed and any((s.when or s.unless) in _KEPT_STATES for s in parameter.states)


def _number(text: str, kind: str) -> float | None:
    """Return a bound of a number; those of other kinds are no range."""
    return float(text) if kind in ("integer", "real") else None


def _unit_of(setting: DescribedSetting) -> str:
    """Return the unit of a setting; that of a straight axis in place of degrees. Empty where it is not
    known.
    """
    text = setting.unit.replace("/sec^", "/s").replace("/sec", "/s")
    try:
        unit = _UNITS.get(text) or unit_named(text)
    except UnitError:
        return ""
    return _LINEAR.get(unit, unit)
