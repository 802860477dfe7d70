"""One parameter definition as JSON."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from amp_studio.schema import BoundRef, Choice, Model, Parameter, Schema, StateRule, label_of

from .manual_page import GRADES, entry_units, erratum_text
from .number_text import sharing_numbers


def definition(schema: Schema, parameter: Parameter) -> dict[str, Any]:
    """Return one parameter definition in the form of ``schema --json``."""
    layout = schema.on(schema.family.default_machine).layout(parameter)
    numbers = _numbers(schema, parameter)
    instances = {m: list(schema.on(m).instances(parameter)) for m in numbers}
    return {
        "id": parameter.id,
        "name": parameter.name,
        "group": schema.group_of[parameter.id].name,
        "section": schema.group_of[parameter.id].section,
        "scope": layout.scope if layout else parameter.scope,
        "type": parameter.type,
        "numbers": _of_first_machine(numbers),
        "instances": next((i for i in instances.values() if i), []),
        "unit": parameter.quantity,
        "units": list(entry_units(schema, parameter)),
        "decimals": parameter.decimals,
        "ranges": _ranges(parameter.ranges) if parameter.ranges else None,
        "choices": [_choice(c) for c in parameter.choices] if parameter.choices else None,
        "default": _default(parameter),
        "available_when": _available(schema, parameter.states),
        "help": _help(parameter),
        "source": {"document": schema.family.document, "page": parameter.page}
        | _present({"pages": parameter.pages}),
        "errata": _errata(schema, parameter) or None,
        "effect": (parameter.effect or schema.family.effect).model_dump(exclude_none=True),
        "patch": parameter.patchable,
        "access": parameter.access,
    } | _present(_facts_of_some(schema, parameter, numbers, instances))


def _errata(schema: Schema, parameter: Parameter) -> str:
    return " ".join(erratum_text(schema.errata[e]) for e in parameter.errata if e in schema.errata)


def _facts_of_some(
    schema: Schema,
    parameter: Parameter,
    numbers: Mapping[str, Mapping[str, str]],
    instances: Mapping[str, list[str]],
) -> dict[str, Any]:
    """Return the facts that only some parameters have, empty where one has none; ``numbers`` and
    ``instances`` by machine type.
    """
    return {
        **{grade: _dumped(getattr(parameter.help, grade)) for grade in GRADES.values()},
        "bare": parameter.bare,
        "range_variants": [{"when": v.when, "ranges": _ranges(v.ranges)} for v in parameter.range_variants],
        "bits": [b.model_dump(exclude_none=True) for b in parameter.bits or ()],
        **_differences_of_machines(schema, parameter, numbers, instances),
        "numbers_also_printed_for": sharing_numbers(schema, parameter),
        "optional": parameter.optional,
        "secret": parameter.secret,
        "formulas": list(parameter.formulas),
        "needs": _dumped(parameter.needs),
        "storage": parameter.storage.model_dump(exclude_none=True) if parameter.storage else None,
    }


def _differences_of_machines(
    schema: Schema,
    parameter: Parameter,
    numbers: Mapping[str, Mapping[str, str]],
    instances: Mapping[str, list[str]],
) -> dict[str, Any]:
    """Return numbers and instances where the machine types differ in them, and numbers printed by mistake."""
    printed = {m: schema.on(m).numbers(parameter) for m in numbers}
    return {
        "numbers_by_machine": {} if _is_same(numbers) else numbers,
        "instances_by_machine": instances if len({tuple(i) for i in instances.values() if i}) > 1 else {},
        "numbers_disputed": any(schema.on(m).is_disputed(parameter.id) for m in numbers),
        "printed_numbers": next((n for m, n in printed.items() if n != numbers[m]), {}),
    }


def _numbers(schema: Schema, parameter: Parameter) -> dict[str, Mapping[str, str]]:
    """Return the numbers of a parameter on each machine type. One that the manual prints by mistake
    addresses another parameter: it is no number of this one.
    """
    on = {m.key: schema.on(m.key) for m in schema.family.machines}
    return {m: {} if on[m].is_disputed(parameter.id) else on[m].numbers(parameter) for m in on}


def _present(facts: dict[str, Any]) -> dict[str, Any]:
    """Return the facts that there are: a key without a fact is left out."""
    return {key: fact for key, fact in facts.items() if fact}


def _dumped(models: Iterable[Model]) -> list[dict[str, Any]]:
    return [model.model_dump() for model in models]


def _is_same(numbers: Mapping[str, Mapping[str, str]]) -> bool:
    """Return whether a parameter has the same numbers on all machine types."""
    first, *others = numbers.values()
    return all(other == first for other in others)


def _of_first_machine(numbers: Mapping[str, Mapping[str, str]]) -> Mapping[str, str]:
    """Return the numbers that all machine types share, else those of the first that has any."""
    return next((n for n in numbers.values() if n or _is_same(numbers)), {})


def _ranges(ranges: Mapping[str, tuple[object, object]]) -> dict[str, list[object]]:
    return {unit: [_bound(bound) for bound in pair] for unit, pair in ranges.items()}


def _bound(bound: object) -> object:
    # The address and not its value: a definition is the same for every file.
    return {"param": bound.param} if isinstance(bound, BoundRef) else bound


def _choice(choice: Choice) -> dict[str, Any]:
    found: dict[str, Any] = {"code": choice.code, "label": choice.label, "raw": choice.raw, "key": choice.key}
    return found | ({"note": choice.note} if choice.note else {})


def _default(parameter: Parameter) -> dict[str, Any] | None:
    """Return the printed default: unit -> value, and that of each instance with another; None without one."""
    default = parameter.default
    if default is None:
        return None
    if parameter.choices:
        found: dict[str, Any] = {"": label_of(parameter, str(default.value))}
        return found | (
            {"instances": {i: label_of(parameter, str(v)) for i, v in default.instances.items()}}
            if default.instances
            else {}
        )

    def plain(value: float | bool | str) -> float | bool | str:
        is_whole = parameter.type in ("integer", "bits") and isinstance(value, float)
        return int(value) if is_whole else value

    numbers: dict[str, Any] = {default.unit: plain(default.value)}
    if default.instances:
        numbers["instances"] = {i: plain(v) for i, v in default.instances.items()}
    return numbers


def _available(schema: Schema, states: tuple[StateRule, ...]) -> str:
    """Return when a parameter is active, as CEL conditions joined by 'and'."""
    parts = []
    for state in states:
        condition = schema.family.conditions[state.when or state.unless or ""].when
        parts.append(f"!({condition})" if state.when else f"({condition})")
    return " && ".join(parts)


def _help(parameter: Parameter) -> str:
    texts = parameter.help
    return "\n\n".join(part for part in (texts.what, texts.find, texts.wrong) if part)
