"""One parameter definition as JSON."""

from __future__ import annotations

from typing import Any

from amp_studio.schema import BoundRef, Choice, Parameter, Schema, StateRule, label_of

from .manual_page import GRADES, entry_units, erratum_text
from .number_text import sharing_numbers


def definition(schema: Schema, parameter: Parameter) -> dict[str, Any]:
    """Return one parameter definition in the form of ``schema --json``."""
    machines = [m.key for m in schema.family.machines]
    layout = schema.on(schema.family.default_machine).layout(parameter)
    printed = {m: schema.on(m).numbers(parameter) for m in machines}
    # A number that the manual prints by mistake addresses another parameter: it is no number of this one.
    numbers = {m: {} if schema.on(m).is_disputed(parameter.id) else n for m, n in printed.items()}
    same = all(n == numbers[machines[0]] for n in numbers.values())
    instances = {m: list(schema.on(m).instances(parameter)) for m in machines}
    found: dict[str, Any] = {
        "id": parameter.id,
        "name": parameter.name,
        "group": schema.group_of[parameter.id].name,
        "section": schema.group_of[parameter.id].section,
        "scope": layout.scope if layout else parameter.scope,
        "type": parameter.type,
        "numbers": numbers[machines[0]] if same else next((n for n in numbers.values() if n), {}),
        "instances": next((i for i in instances.values() if i), []),
        "unit": parameter.quantity,
        "units": list(entry_units(schema, parameter)),
        "decimals": parameter.decimals,
        "ranges": {u: [_bound(b) for b in r] for u, r in (parameter.ranges or {}).items()} or None,
        "choices": [_choice(c) for c in parameter.choices] if parameter.choices else None,
        "default": _default(parameter),
        "available_when": _available(schema, parameter.states),
        "help": _help(parameter),
        "source": (
            {"document": schema.family.document, "page": parameter.page}
            | ({"pages": parameter.pages} if parameter.pages else {})
        ),
        "errata": (
            " ".join(erratum_text(schema.errata[e]) for e in parameter.errata if e in schema.errata) or None
        ),
        "effect": (parameter.effect or schema.family.effect).model_dump(exclude_none=True),
        "patch": parameter.patchable,
        "access": parameter.access,
    }
    for grade in GRADES.values():
        if statements := getattr(parameter.help, grade):
            found[grade] = [s.model_dump() for s in statements]
    if parameter.bare:
        found["bare"] = parameter.bare
    if parameter.range_variants:
        found["range_variants"] = [
            {"when": v.when, "ranges": {u: [_bound(b) for b in r] for u, r in v.ranges.items()}}
            for v in parameter.range_variants
        ]
    if parameter.bits:
        found["bits"] = [b.model_dump(exclude_none=True) for b in parameter.bits]
    if not same:
        found["numbers_by_machine"] = numbers
    if len({tuple(i) for i in instances.values() if i}) > 1:
        found["instances_by_machine"] = instances
    if any(schema.on(m).is_disputed(parameter.id) for m in machines):
        found["numbers_disputed"] = True
        found["printed_numbers"] = next(n for m, n in printed.items() if n != numbers[m])
    if sharing := sharing_numbers(schema, parameter):
        found["numbers_also_printed_for"] = sharing
    if parameter.optional:
        found["optional"] = True
    if parameter.secret:
        found["secret"] = True
    if parameter.formulas:
        found["formulas"] = list(parameter.formulas)
    if parameter.needs:
        found["needs"] = [need.model_dump() for need in parameter.needs]
    if parameter.storage:
        found["storage"] = parameter.storage.model_dump(exclude_none=True)
    return found


def _bound(bound: object) -> object:
    return {"param": bound.param} if isinstance(bound, BoundRef) else bound


def _choice(choice: Choice) -> dict[str, Any]:
    found: dict[str, Any] = {"code": choice.code, "label": choice.label, "raw": choice.raw, "key": choice.key}
    return found | ({"note": choice.note} if choice.note else {})


def _default(parameter: Parameter) -> dict[str, Any] | None:
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
