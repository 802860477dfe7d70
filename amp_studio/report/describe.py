"""Parameters and findings in words and as JSON: what the command line and the desktop program show."""

from __future__ import annotations

import textwrap
from typing import Any

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    Address,
    Parameter,
    Schema,
    UnknownParameter,
    label_of,
    read_address,
    shown,
    write_number,
    write_value,
)
from amp_studio.schema.model import BoundRef, Choice, Range, StateRule
from amp_studio.validate import Finding

_WIDTH = 100


def definition(schema: Schema, parameter: Parameter) -> dict[str, Any]:
    """Return one parameter definition as ``schema --json`` gives it."""
    machines = [m.key for m in schema.family.machines]
    layout = schema.layout(parameter, schema.family.default_machine)
    numbers = {m: schema.numbers(parameter, m) for m in machines}
    same = all(n == numbers[machines[0]] for n in numbers.values())
    found: dict[str, Any] = {
        "id": parameter.id,
        "name": parameter.name,
        "group": schema.group_of[parameter.id].name,
        "section": schema.group_of[parameter.id].section,
        "scope": layout.scope if layout else parameter.scope,
        "type": parameter.type,
        "numbers": numbers[machines[0]] if same else next((n for n in numbers.values() if n), {}),
        "unit": parameter.quantity,
        "decimals": parameter.decimals,
        "ranges": {u: [_bound(b) for b in r] for u, r in (parameter.ranges or {}).items()} or None,
        "choices": [_choice(c) for c in parameter.choices] if parameter.choices else None,
        "default": _default(parameter),
        "available_when": _available(schema, parameter.states),
        "help": _help(parameter),
        "source": {"document": schema.family.document, "page": parameter.page}
        | ({"pages": parameter.pages} if parameter.pages else {}),
        "errata": " ".join(erratum_text(schema, e) for e in parameter.errata) or None,
        "effect": (parameter.effect or schema.family.effect).model_dump(exclude_none=True),
        "patch": parameter.patchable,
    }
    if parameter.range_variants:
        found["range_variants"] = [
            {"when": v.when, "ranges": {u: [_bound(b) for b in r] for u, r in v.ranges.items()}}
            for v in parameter.range_variants
        ]
    if parameter.bits:
        found["bits"] = [b.model_dump(exclude_none=True) for b in parameter.bits]
    if not same:
        found["numbers_by_machine"] = numbers
    if any(schema.is_disputed(parameter.id, m) for m in machines):
        found["numbers_disputed"] = True
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
        return found | ({"instances": {i: label_of(parameter, str(v)) for i, v in default.instances.items()}}
                        if default.instances else {})  # fmt: skip
    return {default.unit: default.value}


def _available(schema: Schema, states: tuple[StateRule, ...]) -> str:
    """Return when a parameter is in force, as conditions in CEL joined by 'and'."""
    parts = []
    for state in states:
        condition = schema.family.conditions[state.when or state.unless or ""].when
        parts.append(f"!({condition})" if state.when else f"({condition})")
    return " && ".join(parts)


def _help(parameter: Parameter) -> str:
    told = parameter.help
    return "\n\n".join(part for part in (told.what, told.find, told.wrong) if part)


def erratum_text(schema: Schema, erratum_id: str) -> str:
    """Return a contradiction of the manual in one paragraph."""
    erratum = schema.errata.get(erratum_id)
    if erratum is None:
        return ""
    readings = "; ".join(f"page {r.page} says {r.says}" for r in erratum.readings)
    return f"{readings}. Taken: {erratum.taken} ({erratum.why})"


def range_text(ranges: dict[str, Range] | None, schema: Schema) -> list[str]:
    """Return one line for each printed unit: ``0 to 214.1 mm``."""
    lines = []
    for unit, (low, high) in (ranges or {}).items():
        ends = [_end(schema, bound) for bound in (low, high)]
        lines.append(f"{ends[0]} to {ends[1]} {shown(unit)}".rstrip())
    return lines


def _end(schema: Schema, bound: object) -> str:
    if bound is None:
        return "…"
    if isinstance(bound, BoundRef):
        return schema.parameters[bound.param].name
    return write_number(float(bound))  # type: ignore[arg-type]  # a bound is a float, a reference or None


def one_line(schema: Schema, parameter: Parameter) -> str:
    """Return a parameter in one line: number, id, name, range."""
    numbers = schema.numbers(parameter, schema.family.default_machine)
    first = next(iter(numbers.values()), "–")
    last = list(numbers.values())[-1] if numbers else "–"
    span = first if first == last else f"{first}…{last}"
    allowed = " / ".join(range_text(parameter.ranges, schema)) or ", ".join(
        c.label for c in parameter.choices or ()
    )
    return f"{span:12} {parameter.id:32} {parameter.name}: {allowed}"


def page_of(schema: Schema, param: str, machine: str | None = None) -> str:
    """Return one parameter as a person reads it; raises UnknownParameter."""
    machine = machine or schema.family.default_machine
    parameter_id = read_address(param)[0]
    if parameter_id in schema.parameters:
        parts = [_page(schema, schema.parameters[parameter_id], machine)]
    else:
        claims = schema.addressed_by(param, machine)
        if not claims:
            raise UnknownParameter(f"'{param}' is no parameter of {schema.family.name}")
        parts = [_page(schema, schema.parameters[a[0]], machine) for a in claims]
    return ("\n" + "=" * _WIDTH + "\n").join(parts)


def _page(schema: Schema, parameter: Parameter, machine: str) -> str:
    lines = [parameter.name, "-" * len(parameter.name)]
    lines += [f"{k + ':':<14} {v}" for k, v in facts(schema, parameter, machine)]
    lines.append("")
    for title, text in help_parts(schema, parameter):
        lines += [title, *textwrap.wrap(text, _WIDTH, initial_indent="  ", subsequent_indent="  "), ""]
    rules = [r for r in schema.rules if any(read_address(t)[0] == parameter.id for t in r.reads.values())]
    if rules:
        lines.append("Rules it takes part in")
        lines += [f"  {r.severity:8} {r.title} (page {r.page}): {r.check}" for r in rules]
    return "\n".join(lines).rstrip()


def facts(schema: Schema, parameter: Parameter, machine: str) -> list[tuple[str, str]]:
    """Return the short facts of a parameter as (title, text)."""
    numbers = schema.numbers(parameter, machine)
    group = schema.group_of[parameter.id]
    found = [("Number", _numbers_text(schema, parameter, numbers, machine)), ("Id", parameter.id),
             ("Group", f"{group.name}: {group.section}" if group.section else group.name)]  # fmt: skip
    found += [("Range", line) for line in range_text(parameter.ranges, schema)]
    for variant in parameter.range_variants:
        why = schema.family.conditions[variant.when].why
        found += [("Range", f"{line} ({why})") for line in range_text(variant.ranges, schema)]
    for choice in parameter.choices or ():
        code = f"({choice.code}) " if choice.code else ""
        raw = (
            f" — stored as {choice.raw}"
            if choice.raw is not None
            else " — no stored code printed"
            if parameter.patchable
            else ""
        )
        found.append(("Choice", f"{code}{choice.label}{raw}{f'; {choice.note}' if choice.note else ''}"))
    found.append(("Default", _default_text(parameter)))
    if parameter.storage and parameter.storage.unit:
        found.append(("Patch unit", shown(parameter.storage.unit)))
    effect = parameter.effect or schema.family.effect
    found.append(("Takes effect", {"at-once": "at once", "reset": "on reset", "restart": "on restart of the control",
                                   "command": f"when {effect.command} reads it"}[effect.level]))  # fmt: skip
    for state in parameter.states:
        condition = schema.family.conditions[state.when or state.unless or ""]
        found.append(
            (
                state.state.capitalize(),
                ("when " if state.when else "unless ") + f"[{condition.when}]: {condition.why}",
            )
        )
    found += [("Needs", f"{need.what} (page {need.page})") for need in parameter.needs]
    found.append(("Source", f"{schema.family.title}, page {pages_text(parameter)}"))
    return found


def pages_text(parameter: Parameter) -> str:
    """Return the pages on which the manual describes a parameter."""
    return " and ".join(dict.fromkeys((parameter.page, *parameter.pages.values())))


def _numbers_text(schema: Schema, parameter: Parameter, numbers: dict[str, str], machine: str) -> str:
    if not numbers:
        return "none"
    text = ", ".join(f"{n} ({i})" if i else n for i, n in numbers.items())
    return text + (
        " — printed, but they belong to another parameter"
        if schema.is_disputed(parameter.id, machine)
        else ""
    )


def _default_text(parameter: Parameter) -> str:
    default = parameter.default
    if default is None:
        return "none printed"
    value = (
        label_of(parameter, str(default.value))
        if parameter.choices
        else f"{default.value} {shown(default.unit)}".rstrip()
    )
    other = "".join(f", {label_of(parameter, str(v))} for {i}" for i, v in (default.instances or {}).items())
    return f"{value}{other} (page {default.page})"


def help_parts(schema: Schema, parameter: Parameter) -> list[tuple[str, str]]:
    """Return the help as (title, text)."""
    told = parameter.help
    parts = [
        ("What it does", told.what),
        ("How to find its value", told.find),
        ("When it is wrong", told.wrong),
    ]
    related = ", ".join(schema.parameters[r].name for r in told.related if r in schema.parameters)
    parts.append(("Related", related))
    parts += [("The manual contradicts itself", erratum_text(schema, e)) for e in parameter.errata]
    return [(title, " ".join(text.split())) for title, text in parts if text]


def finding_json(file: ParameterFile, finding: Finding) -> dict[str, Any]:
    """Return a finding as ``validate --json`` gives it."""
    schema, machine = file.schema, file.machine
    return {
        "rule": finding.rule, "severity": finding.severity,
        "params": [schema.short(a, machine) for a in finding.addresses],
        "message": finding.message,
        "fix": [{"param": schema.short(r.address, machine), "value": write_value(schema.parameters[r.address[0]], r.value)}
                for r in finding.repairs],
        "source": finding.page,
    }  # fmt: skip


def finding_text(file: ParameterFile, finding: Finding) -> str:
    """Return a finding in a line or two for the terminal."""
    names = ", ".join(_named(file, a) for a in finding.addresses[:8])
    page = f" (page {finding.page})" if finding.page else ""
    lines = [f"{finding.severity:8} {names}{': ' if names else ''}{finding.message}{page}"]
    if finding.repairs:
        mends = ", ".join(f"{_named(file, r.address)} = {write_value(file.schema.parameters[r.address[0]], r.value)}"
                          for r in finding.repairs)  # fmt: skip
        lines.append(f"         repair: {mends}")
    return "\n".join(lines)


def _named(file: ParameterFile, address: Address) -> str:
    return file.schema.label(address, file.machine)
