"""The description of one parameter as text: short facts and help."""

from __future__ import annotations

import inspect
import re
import textwrap
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Literal

from amp_studio.guide import step_of, steps_of
from amp_studio.report.language import ENGLISH, Language
from amp_studio.report.wording import severity_name, state_name
from amp_studio.schema import (
    Address,
    Bit,
    BoundRef,
    Choice,
    Erratum,
    Evaluation,
    HelpNote,
    Parameter,
    Range,
    Schema,
    UnknownParameterError,
    label_of,
    labelled,
    read_address,
    unit_text,
    unknown,
    write_number,
)
from amp_studio.validate import formulas

from .number_text import instances_without_number, number_lines, short_span, split_count
from .printed_table import table_lines, tables_of

_WIDTH = 100
_INDENT = "  "


def page_of(schema: Schema, param: str, machine: str | None = None) -> str:
    """Return what is known of a parameter, by number or id; raises UnknownParameterError.

    A number that belongs to several parameters, or to another one on another machine type,
    gives one page for each.
    """
    machines = [machine] if machine else [m.key for m in schema.family.machines]
    name = read_address(param.strip())[0]
    found = schema.parameters.get(name.casefold())
    # An id is exact; a number may be printed for several parameters, and each has its page below.
    wanted = [found.id] if found is not None else list(dict.fromkeys(_numbered(schema, name, machines)))
    if not wanted:
        raise UnknownParameterError(*unknown(schema, param.strip()))
    for parameter_id in wanted:
        _check_instance(schema, schema.parameters[parameter_id], param, machines)
    pages = [_page(schema, schema.parameters[parameter_id], machine) for parameter_id in wanted]
    return ("\n" + "=" * _WIDTH + "\n").join(pages)


def _numbered(schema: Schema, number: str, machines: Sequence[str]) -> Iterator[str]:
    """Yield the ids of the parameters that have a number on these machines, or whose word or bit it names."""
    for machine in machines:
        here = schema.on(machine)
        found = here.addressed_by(number) or here.words(number) or _word_of_bit(schema, number, machine)
        yield from (address[0] for address in found)


def _word_of_bit(schema: Schema, param: str, machine: str) -> list[Address]:
    """Return the packed words that a bit of a number (P3N0.5) is of."""
    word, _, bit = param.strip().rpartition(".")
    found = schema.on(machine).addressed_by(word) if bit.isdecimal() else []
    return [a for a in found if schema.parameters[a[0]].type == "bits"]


def _check_instance(schema: Schema, parameter: Parameter, param: str, machines: Sequence[str]) -> None:
    """Raise UnknownParameterError for an instance that the parameter has nowhere;
    a letter may be that of an axis.
    """
    instance = read_address(param.strip())[1]
    offered = {i.casefold() for m in machines for i in schema.on(m).instances(parameter)}
    on_an_axis = any(schema.on(m).kin(schema.on(m).scopes[parameter.id], "axis") for m in machines)
    if instance and instance.casefold() not in offered and not (on_an_axis and instance.isalpha()):
        evaluation = Evaluation(schema, lambda _: None, lambda: machines[0])
        evaluation.find(param)  # lists its instances


def _page(schema: Schema, parameter: Parameter, machine: str | None) -> str:
    """Return one parameter as ``show`` prints it."""
    lines = [parameter.name, "-" * len(parameter.name)]
    before = ""
    for title, text in facts(schema, parameter, machine):
        lines += _fact("" if title == before else title, text)
        before = title
    lines.append("")
    for title, text in help_parts(schema, parameter):
        lines += [title, *_wrapped(text), ""]
    lines += _section("Formulas", formula_lines(schema, parameter))
    lines += _section("Commissioning", _commissioning(schema, parameter))
    lines += _section("Guides", _steps(schema, parameter))
    messages = schema.messages_of(parameter.id)
    lines += _section(
        "Messages of the control", (f"{m.name} (page {', '.join(m.every_page)})" for m in messages)
    )
    for table in tables_of(schema, parameter):
        lines += [
            f"{table.title} (page {table.page})",
            *(f"{_INDENT}{line}" for line in table_lines(table)),
            "",
        ]
    lines += _section("Rules that use it", _rule_lines(schema, parameter))
    return "\n".join(lines).rstrip()


def _rule_lines(schema: Schema, parameter: Parameter) -> Iterator[str]:
    for rule in schema.rules:
        if any(read_address(text)[0] == parameter.id for text in rule.reads.values()):
            yield f"{severity_name(rule.severity):14} {rule.title} ({rule.cited}; {rule.id})"


def _commissioning(schema: Schema, parameter: Parameter) -> Iterator[str]:
    """Yield the steps of commissioning at which a parameter is set, or checked again."""
    own, steps = step_of(schema)[parameter.id], steps_of(schema)
    for step in steps if schema.commissioning is not None else ():
        if step is own or parameter in step.again:
            yield f"Step {step.number} of {len(steps)}: {step.title} (page {step.page})"


def _steps(schema: Schema, parameter: Parameter) -> Iterator[str]:
    """Yield the steps of the family's guides that set a parameter."""
    for guide in schema.guides:
        for n, step in enumerate(guide.steps, 1):
            if parameter.id in step.params:
                yield f"{guide.title}, step {n} of {len(guide.steps)}: {step.title} (page {step.page})"


def _fact(title: str, text: str) -> list[str]:
    return textwrap.wrap(text, _WIDTH, initial_indent=f"{title:<14} ", subsequent_indent=" " * 15) or [title]


def _wrapped(text: str) -> list[str]:
    return textwrap.wrap(text, _WIDTH, initial_indent=_INDENT, subsequent_indent=_INDENT)


def _section(title: str, entries: Iterable[str]) -> list[str]:
    lines = [
        line
        for entry in entries
        for line in textwrap.wrap(entry, _WIDTH, initial_indent=_INDENT, subsequent_indent=_INDENT * 3)
    ]
    return [title, *lines, ""] if lines else []


def formula_lines(schema: Schema, parameter: Parameter) -> list[str]:
    """Return the published formulas of a parameter, each with its arguments and description."""
    lines = []
    for name in parameter.formulas:
        function = formulas(schema.family.family)[name]
        first = (inspect.getdoc(function) or "").partition("\n\n")[0]
        description = " ".join(first.split()).replace("``", "")
        lines.append(f"{name}({', '.join(inspect.signature(function).parameters)}): {description}")
    return lines


# -- facts ---------------------------------------------------------------------


def facts(schema: Schema, parameter: Parameter, machine: str | None = None) -> list[tuple[str, str]]:
    """Return the short facts of a parameter as (title, text), for one machine type or for all of them."""
    group = schema.group_of[parameter.id]
    found = _titled("Number", number_lines(schema, parameter, machine))
    found += [("Id", parameter.id), ("Group", group.whole_name)]
    found += _titled("Instances", instances_without_number(schema, parameter, machine))
    found += _titled("Range", _ranges(schema, parameter))
    found += [("Unit", parameter.bare)] if parameter.bare else []
    found += [("Choice", _choice(choice, parameter.patchable)) for choice in parameter.choices or ()]
    found += _titled("Bits", _bits(parameter))
    found.append(("Default", _default(parameter)))
    found += _titled("At the control", _at_the_control(parameter))
    found += _titled("Command", _command(schema, parameter))
    if parameter.access == "read":
        found.append(("Access", "read-only"))
    else:
        found.append(("Takes effect", takes_effect(schema, parameter)))
    found += _states(schema, parameter)
    found += [("Needs", f"{need.what} (page {need.page})") for need in parameter.needs]
    pages = " and ".join(dict.fromkeys((parameter.page, *parameter.pages.values())))
    found.append(("Source", f"{schema.family.title}, page {pages}"))
    return found


def _titled(title: str, texts: Iterable[str]) -> list[tuple[str, str]]:
    return [(title, text) for text in texts]


_TAKES_EFFECT = {
    "at-once": "at once",
    "reset": "on reset",
    "restart": "on restart of the control",
    "online": "at once with {command} at the control, else on restart of the control",
    "command": "when {command} reads it",
    "unknown": "not given in the manual",
}


def takes_effect(schema: Schema, parameter: Parameter) -> str:
    """Return when a changed value of a parameter takes effect by the manual."""
    effect = parameter.effect or schema.family.effect
    return _TAKES_EFFECT[effect.level].format(command=effect.command)


def _states(schema: Schema, parameter: Parameter) -> Iterator[tuple[str, str]]:
    """Yield each state that a parameter can be in but active, and the reason for it."""
    for state in parameter.states:
        condition = schema.family.conditions[state.when or state.unless or ""]
        page = state.page or condition.page
        yield state_name(state.state).capitalize(), condition.why + (f" (page {page})" if page else "")


def entry_units(schema: Schema, parameter: Parameter) -> tuple[str, ...]:
    """Return the units in which a parameter is entered,
    in degrees too where it belongs to an axis that may turn.
    """
    if parameter.choices or parameter.type in ("text", "format", "bits"):
        return ()
    turns = schema.angular_when(parameter) is not None and any(
        schema.on(m.key).scopes[parameter.id] == "axis" for m in schema.family.machines
    )
    systems = tuple(schema.family.units) or ("",)
    # Straight first; turning too where it may turn.
    units = (schema.unit(parameter, s, t) for t in (False, True)[: 1 + turns] for s in systems)
    return tuple(dict.fromkeys(u for u in units if u))


def _ranges(schema: Schema, parameter: Parameter) -> Iterator[str]:
    yield from _printed_ranges(schema, parameter)
    for variant in parameter.range_variants:
        why = schema.family.conditions[variant.when].why
        yield from (f"{line}, {why}" for line in range_text(variant.ranges, schema))


def _printed_ranges(schema: Schema, parameter: Parameter) -> list[str]:
    """Return the printed ranges, or the unit alone where there is none."""
    units = " or ".join(map(unit_text, entry_units(schema, parameter)))
    if parameter.ranges or not units:
        return range_text(parameter.ranges, schema)
    return [f"no bounds printed, in {units}"]


def range_text(ranges: dict[str, Range] | None, schema: Schema, words: Language | None = None) -> list[str]:
    """Return one line for each printed unit: ``0 to 214.1 mm``; without words its numbers are as they are
    typed, so that a bound can be copied.
    """
    written, words = words.number if words else str, words or ENGLISH
    lines = []
    for printed, (low, high) in (ranges or {}).items():
        unit = words.unit(unit_text(printed))
        if low is None and high is None:
            lines.append(words.text("no bounds printed") + (f", in {unit}" if unit else ""))
            continue
        ends = [_end(schema, bound, written) for bound in (low, high)]
        lines.append(f"{ends[0]} {words.text('to')} {ends[1]} {unit}".rstrip())
    return lines


def _end(schema: Schema, bound: object, written: Callable[[str], str]) -> str:
    if bound is None:
        return "…"
    if isinstance(bound, BoundRef):
        return schema.parameters[bound.param].name
    return written(write_number(float(bound)))  # type: ignore[arg-type]  # a bound is a float, a reference or None


def _choice(choice: Choice, patchable: bool) -> str:
    code = f"({choice.code}) " if choice.code else ""
    raw = "" if choice.raw is None else f", stored as {choice.raw}"
    unprinted = ", no stored code printed" if patchable and choice.raw is None else ""
    return f"{code}{choice.label}{raw}{unprinted}{f'; {choice.note}' if choice.note else ''}"


def _bits(parameter: Parameter) -> Iterator[str]:
    """Yield one line for each field of a word; bits with counted names (Axis 2, Axis 3), or none legible,
    share one.
    """
    fields = list(parameter.bits or ())
    while fields:
        run = [fields.pop(0)]
        while fields and _continues(run[-1], fields[0]):
            run.append(fields.pop(0))
        first, last = run[0], run[-1]
        end = last.bit + last.width - 1
        where = f"{first.bit}" if end == first.bit else f"{first.bit} to {end}"
        what = first.label if first.label == last.label else f"{first.label} to {last.label}"
        unknown = " (not legible in the manual: keep the present value)" if first.unknown else ""
        yield f"{where}: {what}{unknown}"
        yield from (f"    {_choice(choice, patchable=False)}" for choice in first.choices or ())


def _continues(a: Bit, b: Bit) -> bool:
    """Return whether a bit continues a series: Axis 3 after Axis 2, or one more without a legible name."""
    (head, number), (other, following) = split_count(a.label), split_count(b.label)
    plain = a.width == b.width == 1 and not a.choices and not b.choices and a.unknown == b.unknown
    same_lost = a.unknown and a.label == b.label
    return plain and b.bit == a.bit + 1 and (same_lost or (head == other and following == number + 1))


def _default(parameter: Parameter) -> str:
    """Return the printed default with those of instances that differ, and its page."""
    default = parameter.default
    if default is None:
        return "none printed"
    if parameter.choices:
        value = label_of(parameter, str(default.value))
    else:
        number = write_number(default.value) if isinstance(default.value, (int, float)) else default.value
        value = f"{number} {unit_text(default.unit)}".rstrip()
    others = "".join(
        f", {_plain(parameter, v)} for {labelled(parameter.each or '{i}', i)}"
        for i, v in (default.instances or {}).items()
    )
    return f"{value}{others} (page {default.page})"


def _plain(parameter: Parameter, value: float | bool | str) -> str:
    if parameter.choices or isinstance(value, (str, bool)):
        return label_of(parameter, str(value))
    return write_number(value)


def _command(schema: Schema, parameter: Parameter) -> Iterator[str]:
    """Yield the command that sets the first instance, with a placeholder for each value: ``NOTCH X(…,
    …)``.
    """
    if parameter.storage and parameter.storage.command:
        machines = [schema.family.default_machine, *(m.key for m in schema.family.machines)]
        here = next((schema.on(m) for m in machines if schema.on(m).instances(parameter)), None)
        if here is None:  # it exists on no machine type
            return
        first = here.instances(parameter)[0]
        known = {"{i}": first, "{k}": "0", "{n}": here.plain_number((parameter.id, first))}
        yield re.sub("{.*?}", lambda gap: known.get(gap[0], "…"), parameter.storage.command)


def _at_the_control(parameter: Parameter) -> Iterator[str]:
    if parameter.tunable:
        yield "can be changed while the machine runs"
    if parameter.patchable:
        storage = parameter.storage
        unit = f", in {unit_text(storage.unit)}" if storage and storage.unit else ""
        places = f" with {storage.decimals} decimals" if storage and storage.decimals else ""
        yield f"can be entered by its number{unit}{places}"


# -- help ----------------------------------------------------------------------


GRADES: dict[str, Literal["danger", "warning", "note"]] = {
    "Danger": "danger",
    "Warning": "warning",
    "Note": "note",
}
"""Title of a graded part of the help -> its grade."""


def help_parts(schema: Schema, parameter: Parameter, language: Language = ENGLISH) -> list[tuple[str, str]]:
    """Return the help as (title, text), what is dangerous first; what it warns of is in a language."""
    texts = parameter.help
    parts = [
        *_statements("Danger", texts.danger, language),
        *_statements("Warning", texts.warning, language),
        ("What it does", texts.what),
        ("How to find its value", texts.find),
        ("When it is wrong", texts.wrong),
        *_statements("Note", texts.note, language),
    ]
    related = ", ".join(schema.parameters[r].name for r in texts.related if r in schema.parameters)
    parts.append(("Related", related))
    errata = [schema.errata[e] for e in parameter.errata if e in schema.errata]
    for n, erratum in enumerate(errata, 1):
        count = f" ({n} of {len(errata)})" if len(errata) > 1 else ""
        parts.append((f"Contradiction in the manual{count}", erratum_text(erratum)))
    return [(title, " ".join(text.split())) for title, text in parts if text]


def _statements(grade: str, statements: Iterable[HelpNote], language: Language) -> list[tuple[str, str]]:
    return [(grade, f"{language.sentence(s.says)} ({language.text(f'page {s.page}')})") for s in statements]


def erratum_text(erratum: Erratum) -> str:
    """Return a contradiction of the manual in one paragraph."""
    readings = "; ".join(f"page {r.page}: {r.says}" for r in erratum.readings)
    why = erratum.why.strip()
    return f"{readings}. Used here: {erratum.taken.strip().rstrip('.')}. {why}"


def one_line(schema: Schema, parameter: Parameter) -> str:
    """Return a parameter in one line: number, id, name, range."""
    spans = (short_span(schema, parameter, m.key) for m in schema.family.machines)
    span = next((s for s in spans if s), "–")
    allowed = " / ".join(_printed_ranges(schema, parameter)) or ", ".join(
        c.label for c in parameter.choices or ()
    )
    return f"{span:12} {parameter.id:32} {parameter.name}: {allowed}"
