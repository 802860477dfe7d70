"""All that is wrong with a builder's rule, each with its place in the entry, and what the rule costs."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cache
from string import Formatter

from amp_studio.schema import (
    ALWAYS_THERE,
    UNITS,
    KeyPath,
    Parameter,
    Rule,
    Schema,
    did_you_mean,
    family_ids,
    load_schema,
    read_address,
)

from .expression_check import ExpressionCheck, nearest_choice
from .expression_tree import RESERVED, ExpressionError, quoted, read_expression
from .expression_worth import (
    ANY,
    DECIMAL,
    LANGUAGE,
    WHOLE,
    YES_NO,
    ResultKind,
    Signature,
    choice_result,
    list_result,
    one_of,
    signature_of,
    text_result,
)
from .expressions import TYPES
from .functions import rule_functions

MAX_STEPS = 5_000_000
"""Of one rule over a whole file: about a quarter of a second."""
_SHOWN = 100
"""Cost of a value in a message."""
_EACH_RUN = 50
"""Cost of a run besides its expressions."""
_LISTS = ("*", "<", ">", ".")


@dataclass
class Review:
    """What is wrong with a rule, and what it costs; ``is_ours`` where it names parameters of this family."""

    slips: list[tuple[KeyPath, str]] = field(default_factory=list)
    cost: int = 0
    """Of all runs over a file."""
    once: int = 0
    """Of one run."""
    is_ours: bool = True


def _is_of_another_family(rule: Rule, schema: Schema) -> bool:
    """Return whether another family has all parameters that a rule reads, and this one has not."""
    read = {parameter_id for parameter_id, _ in _read(rule).values()}
    # Parameters of the same id are in several families: what this one has is meant for it.
    if read <= schema.parameters.keys():
        return False
    # All of them, not some: a rule with one slip in a name would else pass as one of another family.
    others = (family for family in family_ids() if family != schema.family.family)
    return any(read <= load_schema(family).parameters.keys() for family in others)


def review(rule: Rule, schema: Schema, *, any_family: bool) -> Review:
    """Return the remarks on a rule; with ``any_family`` it may be about parameters of another one."""
    found = Review()
    if any_family and _is_of_another_family(rule, schema):
        found.is_ours = False
        return found
    found.slips += _reads_slips(rule, schema)
    found.slips += _name_slips(rule)
    found.slips += _message_slips(rule)
    found.once = _expressions(rule, schema, found)
    found.cost = found.once * _runs(rule, schema)
    if found.cost > MAX_STEPS:
        steps = f"{found.cost:,}" if found.cost < 10**12 else "far too many"
        message = (
            f"the rule can take {steps} steps in a file, and {MAX_STEPS:,} are the most: let it go over"
            " fewer lists"
        )
        found.slips.append((("check",), message))
    return found


def _read(rule: Rule) -> dict[str, tuple[str, str]]:
    return {name: read_address(text) for name, text in rule.reads.items()}


# -- what it reads -------------------------------------------------------------


def _reads_slips(rule: Rule, schema: Schema) -> Iterator[tuple[KeyPath, str]]:
    """Yield what is wrong with the names and parameters that a rule reads."""
    for name, (parameter_id, which) in _read(rule).items():
        place: KeyPath = ("reads", name)
        parameter = schema.parameters.get(parameter_id)
        if name in RESERVED:
            yield place, f"'{name}' is a word of the language and can be no name"
        if parameter is None:
            yield place, _unknown(parameter_id, schema)
            continue
        offered = _instances(schema, parameter)
        if which not in ("", *_LISTS, *offered):
            there = ", ".join(i for i in offered[:8] if i) or "none: it is one for the whole control"
            more = ", ..." if len(offered) > 8 else ""
            yield place, f"{parameter.name} has no instance {quoted(which)}; it has {there}{more}"


def _unknown(parameter_id: str, schema: Schema) -> str:
    """Return why a parameter cannot be read, with the families that have it, or one that it is near to."""
    others = [
        f for f in family_ids() if f != schema.family.family and parameter_id in load_schema(f).parameters
    ]
    if others:
        return (
            f"{quoted(parameter_id)} is a parameter of {' and '.join(others)}, not of {schema.family.family}"
        )
    near = did_you_mean(parameter_id, schema.parameters)
    return f"{quoted(parameter_id)} is no parameter of {schema.family.family}{near}"


def _instances(schema: Schema, parameter: Parameter) -> list[str]:
    every = (i for machine in schema.family.machines for i in schema.on(machine.key).instances(parameter))
    return list(dict.fromkeys(every))


# -- names outside expressions -------------------------------------------------


def _name_slips(rule: Rule) -> Iterator[tuple[KeyPath, str]]:
    """Yield names outside expressions that mean nothing, and units that there are not."""
    for place, name in _names_of_reads(rule):
        if name not in rule.reads:
            yield place, f"{quoted(name)} is not read{did_you_mean(name, rule.reads)}"
    yield from _assignment_slips(rule)
    for name in rule.values:
        if name in (*rule.reads, *ALWAYS_THERE):
            yield ("values", name), f"{quoted(name)} is the name of something else already"
    for name, unit in rule.units.items():
        if name not in rule.values:
            yield ("units", name), f"{quoted(name)} is not one of its values{did_you_mean(name, rule.values)}"
        if unit not in UNITS:
            yield ("units", name), f"{quoted(unit)} is no unit{did_you_mean(unit, UNITS)}"


def _names_of_reads(rule: Rule) -> Iterator[tuple[KeyPath, str]]:
    """Yield place and name of what must be among ``reads``."""
    for key in ("optional", "any_state"):
        yield from (((key, n), name) for n, name in enumerate(getattr(rule, key)))
    for key in ("blames", "compares"):
        yield from (((key, name), name) for name in getattr(rule, key))


def _assignment_slips(rule: Rule) -> Iterator[tuple[KeyPath, str]]:
    """Yield what a fix or an effective value sets and cannot set."""
    singles = [name for name, (_, which) in _read(rule).items() if which not in _LISTS]
    for key, assignments in (("fix", rule.fix), ("effective", rule.effective)):
        for n, name in enumerate(assignment.set for assignment in assignments):
            if name not in rule.reads:
                yield (key, n, "set"), f"{quoted(name)} is not read{did_you_mean(name, singles)}"
            elif name not in singles:
                yield (key, n, "set"), f"{quoted(name)} is a list, and only a single value can be set"


def _message_slips(rule: Rule) -> Iterator[tuple[KeyPath, str]]:
    """Yield what is wrong with the braces of a message and the names in them."""
    known = [*rule.reads, *rule.values, *ALWAYS_THERE]
    try:
        fields = [field for field in Formatter().parse(rule.message) if field[1] is not None]
    except ValueError as error:
        yield ("message",), f"a brace is not closed or is alone ({error}); write {{{{ and }}}} for braces"
        return
    for _, name, form, how in fields:
        if form or how:
            yield ("message",), f"{{{name}}} is shown as it is: leave out what comes after the name"
        elif name not in known:
            wanted = f"{{{name}}}" if name and len(name) < 60 else "{}"
            near = did_you_mean(str(name), known)
            yield ("message",), f"{wanted} is neither read nor among its values{near}"


# -- expressions ---------------------------------------------------------------


def _expressions(rule: Rule, schema: Schema, found: Review) -> int:
    """Check every expression; returns what the rule costs once at most."""
    names, functions = _names(rule, schema), _functions(schema.family.family)
    once = _cost_of_names(rule, names)
    for place, text, wanted in _texts(rule, schema):
        times = 1
        if place[0] in ("blames", "compares"):
            value = names.get(str(place[1]), ANY)
            # Which items are to blame is asked for each of them, with ``it`` and ``at`` as its names.
            times, item = (value.length, value.item or ANY) if value.kind == "list" else (1, value)
            names |= {"it": item, "at": WHOLE}
        check = ExpressionCheck(names, functions)
        try:
            result_of = check.result_of(read_expression(text))
        except ExpressionError as error:
            found.slips.append((place, str(error)))
            continue
        found.slips += [(place, slip) for slip in check.slips]
        # After the slips inside it: an unknown name gives ``any``, which fits everything.
        if slip := _unfit(result_of, wanted):
            found.slips.append((place, slip))
        once += times * check.cost
    return once


def _cost_of_names(rule: Rule, names: Mapping[str, ResultKind]) -> int:
    """Return what reading the values and writing those of the message costs."""
    lengths = {name: result_of.length for name, result_of in names.items() if result_of.kind == "list"}
    # A list in the message is written item by item.
    written = {name for _, name, _, _ in _fields(rule.message) if name in names}
    items = sum(max(1, lengths.get(name or "", 1)) for name in written)
    return _EACH_RUN + len(rule.reads) + 4 * sum(lengths.values()) + _SHOWN * items * rule.message.count("{")


def _fields(message: str) -> list[tuple[str, str | None, str | None, str | None]]:
    try:
        return list(Formatter().parse(message))
    except ValueError:
        return []


def _texts(rule: Rule, schema: Schema) -> Iterator[tuple[KeyPath, str, Parameter | bool | None]]:
    """Yield place, text and what is wanted: true or false, a value of a parameter, or anything."""
    yield ("when",), rule.when, True
    yield ("check",), rule.check, True
    for name, text in rule.values.items():
        yield ("values", name), text, None
    for key, assignments in (("fix", rule.fix), ("effective", rule.effective)):
        for n, assignment in enumerate(assignments):
            parameter_id, _ = read_address(rule.reads.get(assignment.set, ""))
            yield (key, n, "value"), assignment.value, schema.parameters.get(parameter_id)
    for key, conditions in (
        ("blames", rule.blames),
        ("compares", rule.compares),
    ):  # last: they know further names
        for name, text in conditions.items():
            yield (key, name), text, True


_WANTED = {"choice": "text", "boolean": "yes/no", "text": "text", "format": "text"}
_IN_WORDS = {"text": "a text in quotes", "yes/no": "true or false", "decimal": "a number"}


def _unfit(result_of: ResultKind, wanted: Parameter | bool | None) -> str:
    """Return why something cannot be the result of an expression."""
    if wanted is None or result_of.kind in ("any", "null"):
        return ""
    kind = "yes/no" if isinstance(wanted, bool) else _WANTED.get(wanted.type, "decimal")
    if result_of.kind != kind and not (kind == "decimal" and result_of.kind == "whole"):
        whose = "" if isinstance(wanted, bool) else f" for {wanted.name}"
        return f"it does not give {_IN_WORDS[kind]}{whose}"
    return "" if isinstance(wanted, bool) or wanted.type != "choice" else _unfit_choice(result_of, wanted)


def _unfit_choice(result_of: ResultKind, wanted: Parameter) -> str:
    choices = choice_result(wanted).choices
    for text in result_of.literals:
        if choices and not choices.contains(text):
            return f"{wanted.name} is never {quoted(text)}: {nearest_choice(text, choices)}"
    return ""


def _names(rule: Rule, schema: Schema) -> dict[str, ResultKind]:
    """Return what every name of a rule means."""
    family = schema.family
    names = dict.fromkeys(TYPES, ANY)
    names |= {
        "machine": one_of({m.key: m.name for m in family.machines}),
        "application": one_of({a: a for a in family.applications}) if family.applications else text_result(),
        "instance": text_result(100),
        "part": DECIMAL,
    }
    for name, (parameter_id, which) in _read(rule).items():
        parameter = schema.parameters.get(parameter_id)
        result_of = _value(parameter) if parameter else ANY
        length = len(_instances(schema, parameter)) if parameter else 0
        names[name] = list_result(length, result_of) if which in _LISTS else result_of
    return names


def _value(parameter: Parameter) -> ResultKind:
    if parameter.type == "choice":
        return choice_result(parameter)
    if parameter.type == "boolean":
        return YES_NO
    return text_result() if parameter.type in ("text", "format") else DECIMAL


@cache
def _functions(family: str) -> dict[str, Signature]:
    return LANGUAGE | {name: signature_of(function) for name, function in rule_functions(family).items()}


def _runs(rule: Rule, schema: Schema) -> int:
    """Return for how many instances a rule runs at most."""
    # A list is read whole in one run; what is read as a single value is run for each of its instances.
    own: Iterable[str] = (
        p for p, which in _read(rule).values() if which in ("", "<", ">") and p in schema.parameters
    )
    every = {i for parameter_id in own for i in _instances(schema, schema.parameters[parameter_id])}
    return max(1, len(every))
