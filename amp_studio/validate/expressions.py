"""The expressions of a rule, compiled, with every name in them accounted for.

A rule that misspells a name would never be broken and never be missed, so
whatever a rule says that cannot be meant is a fault before it runs.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from string import Formatter

from amp_studio.schema import Rule, program
from amp_studio.schema.cel_engine import Program, functions_called
from amp_studio.schema.conditions import Verdicts
from amp_studio.schema.units import UNITS

ALWAYS_THERE = ("machine", "application", "instance", "part")
"""Names that a rule need not read: machine type and model of the control, the instance it runs for, its part."""

_TYPES = {
    "int",
    "uint",
    "double",
    "string",
    "bytes",
    "bool",
    "list",
    "map",
    "null_type",
    "type",
    "timestamp",
    "duration",
}
_OVER_A_LIST = re.compile(r"\.(?:all|exists|exists_one|filter|map)\(\s*([a-zA-Z_]\w*)\s*,")


class RuleFault(ValueError):
    """A rule that cannot be used: its id and what is wrong with it."""

    def __init__(self, rule: str, what: str) -> None:
        self.rule = rule
        super().__init__(f"rule {rule}: {what}")


@dataclass(frozen=True, slots=True)
class Expressions:
    """What is worked out of the values a rule reads."""

    broken: Program
    """True where the rule applies and does not hold."""
    values: tuple[tuple[str, Program], ...]
    fixes: tuple[tuple[str, Program], ...]
    """Name of the value to set, and the value."""
    effective: tuple[tuple[str, Program], ...]
    """Name of the value, and what the control uses instead."""
    functions: tuple[str, ...]
    """Functions offered to rules that these call."""
    always: tuple[str, ...]
    """Which of the names that need not be read these use."""
    verdicts: Verdicts = field(default_factory=Verdicts, repr=False)
    """Whether the rule was broken, for values it has met."""


def expressions_of(rule: Rule, functions: Collection[str]) -> Expressions:
    """Compile a rule that may call ``functions``; raises RuleFault."""
    called: set[str] = set()
    always: set[str] = set()
    for place, text in _texts(rule):
        compiled = _compiled(rule, place, text)
        variables = set(compiled.references()["variables"]) - set(_OVER_A_LIST.findall(text)) - _TYPES
        for name in sorted(variables - set(rule.reads) - set(ALWAYS_THERE)):
            raise RuleFault(rule.id, f"{place} speaks of '{name}', which it does not read")
        named = functions_called(compiled)
        for name in sorted(named - set(functions)):
            raise RuleFault(rule.id, f"{place} calls '{name}', which is no function")
        called |= named & set(functions)
        always |= variables & set(ALWAYS_THERE)
    _check_names(rule)
    return Expressions(
        # A line of its own for each bracket: an expression may end in a comment.
        _compiled(rule, "check", f"({rule.when}\n) && !({rule.check}\n)"),
        tuple((name, program(text)) for name, text in rule.values.items()),
        tuple((fix.set, program(fix.value)) for fix in rule.fix),
        tuple((used.set, program(used.value)) for used in rule.effective),
        tuple(sorted(called)),
        tuple(sorted(always)),
    )


def _texts(rule: Rule) -> Iterator[tuple[str, str]]:
    yield "when", rule.when
    yield "check", rule.check
    for name, text in rule.values.items():
        yield f"value {name}", text
    for fix in rule.fix:
        yield f"fix of {fix.set}", fix.value
    for used in rule.effective:
        yield f"effective {used.set}", used.value


def _compiled(rule: Rule, place: str, text: str) -> Program:
    try:
        return program(text)
    except ValueError as error:
        raise RuleFault(rule.id, f"{place}: {str(error).splitlines()[0]}") from None


def _check_names(rule: Rule) -> None:
    """Check the names a rule uses outside its expressions; raises RuleFault."""
    lists = {name for name, text in rule.reads.items() if text.partition("@")[2] in ("*", "<", ">", ".")}
    for place, names in (("optional", rule.optional), ("any_state", rule.any_state)):
        for name in names:
            if name not in rule.reads:
                raise RuleFault(rule.id, f"{place} names '{name}', which it does not read")
    for assignment in (*rule.fix, *rule.effective):
        if assignment.set not in rule.reads or assignment.set in lists:
            raise RuleFault(rule.id, f"it sets '{assignment.set}', which is no single value it reads")
    for name, unit in rule.units.items():
        if name not in rule.values:
            raise RuleFault(rule.id, f"units names '{name}', which is none of its values")
        if unit not in UNITS:
            raise RuleFault(rule.id, f"'{unit}' is no unit")
    known = {*rule.reads, *rule.values, *ALWAYS_THERE}
    try:
        fields = [
            (name, form, how) for _, name, form, how in Formatter().parse(rule.message) if name is not None
        ]
    except ValueError as error:
        raise RuleFault(rule.id, f"message: {error}") from None
    for name, form, how in fields:
        if name not in known or form or how:
            written = f"{name}{f'!{how}' if how else ''}{f':{form}' if form else ''}"
            raise RuleFault(
                rule.id, f"the message shows '{{{written}}}', which is neither read nor among its values"
            )
