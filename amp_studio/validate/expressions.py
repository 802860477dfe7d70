"""The expressions of a rule, compiled, with every name in them accounted for.

A rule that misspells a name would never report anything, unnoticed: an unknown name is an error
before the rule runs.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cached_property
from string import Formatter
from typing import Any, NamedTuple

from amp_studio.errors import AmpStudioError
from amp_studio.schema import (
    ALWAYS_THERE,
    NO_RESULT,
    UNITS,
    Circumstances,
    Decision,
    Expression,
    Program,
    Remembered,
    Rule,
    ValueKey,
    functions_called,
    program,
    quoted,
)

_AT_HAND = ("it", "at")
"""Names in the conditions of ``blames`` and ``compares``: the value at hand, and its position in a list."""

TYPES = {
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
# The engine lists the name of an item among the variables; those that a macro binds are found in the
# text.
_OVER_A_LIST = re.compile(r"\.(?:all|exists|exists_one|filter|map)\(\s*([a-zA-Z_]\w*)\s*,")
_COUNTED = re.compile(r"\bcount_(?:set|below|above)\(\s*([a-zA-Z_]\w*)\s*[,)]")


class RuleError(AmpStudioError, ValueError):
    """A rule that cannot be used: its id and what is wrong with it."""

    def __init__(self, rule: str, what: str) -> None:
        self.rule, self.what = rule, what
        super().__init__(f"rule {rule}: {what}")


class FindingExpressions(NamedTuple):
    """The message and the fixes of a broken rule, worked out of the values it reads."""

    values: tuple[tuple[str, Expression], ...]
    fixes: tuple[tuple[str, Expression], ...]
    """Name of the value to set, and the value."""
    effective: tuple[tuple[str, Expression], ...]
    """Name of the value, and what the control uses instead."""
    blames: tuple[tuple[str, Program | None], ...]
    """Name of what is at fault, and whether it is; None where it always is."""
    compares: tuple[tuple[str, Program | None], ...]
    """Name of what that is compared with, and whether it is."""
    functions: tuple[str, ...]
    """Functions offered to rules that the rule calls anywhere."""
    check_names: frozenset[str]
    """Names in the message."""


class _Part:
    """An expression of a rule that is decided by itself, and which of the rule's values it names."""

    def __init__(self, decision: Decision, names: Sequence[str]) -> None:
        self._decision = decision
        self._places = [n for n, name in enumerate(names) if name in decision.named]
        self._names = [names[n] for n in self._places]

    def result(self, keys: tuple[ValueKey, ...], circumstances: Circumstances) -> Any:
        """Return what it comes to for the keys of all values of the rule."""
        return self._decision.result_of(tuple([keys[n] for n in self._places]), self._names, circumstances)


class Expressions:
    """The expressions of a rule that may call ``functions``.

    Each is compiled when it is first asked for: whether the rule applies when it is first decided, its
    ``check`` where it does, and ``finding`` when it is first broken, since most rules of a file do not apply
    or are satisfied. A rule that cannot be used raises RuleError then; ``check_rule`` does at once.
    """

    def __init__(
        self,
        rule: Rule,
        functions: Mapping[str, Callable[..., Any]],
        finding: FindingExpressions | None = None,
    ) -> None:
        self._rule, self._functions, self._finding = rule, functions, finding
        self._names = (
            # The order in which RuleCheck.names and the keys of a check come.
            *(n for n in rule.reads if not is_list(rule.reads[n])),
            *(n for n in rule.reads if is_list(rule.reads[n])),
        )
        self.remembered = Remembered()
        """Keys of the values of the rule, with the circumstances where it hangs on them -> whether it is
        broken.
        """

    def verdict(self, keys: tuple[ValueKey, ...], circumstances: Circumstances) -> bool | None:
        """Return whether values break the rule: it applies and is not satisfied;
        None where it makes no sense of them.

        ``keys`` are those of the single values, then of the lists. What is not asked separately comes to what
        CEL makes of ``when && !check``.
        """
        applies = True if self._rule.when == "true" else self._when.result(keys, circumstances)
        if applies is False:
            found = False
        else:
            part = self._not_satisfied if applies is True else self._broken
            found = part.result(keys, circumstances)
        verdict = None if found is NO_RESULT else found is True
        # None cannot be remembered: it is also what an unknown key gives.
        if verdict is not None:
            self.remembered[keys if self.depends_on_values_alone else (keys, circumstances.key)] = verdict
        return verdict

    @cached_property
    def depends_on_values_alone(self) -> bool:
        """Whether equal values decide alike for every instance and machine type."""
        # As a part of the text: where a longer name contains one of these, more is remembered than
        # needed, nothing less.
        return not any(name in self._rule.when or name in self._rule.check for name in ALWAYS_THERE)

    @cached_property
    def _when(self) -> _Part:
        return self._part(self._rule.when)

    @cached_property
    def _not_satisfied(self) -> _Part:
        return self._part(f"!({self._rule.check}\n)")  # the line ends a comment of the expression

    @cached_property
    def _broken(self) -> _Part:
        """Both, for what makes no sense of the values:
        an error on one side is none where the other one decides.
        """
        return self._part(f"({self._rule.when}\n) && !({self._rule.check}\n)")

    def _part(self, text: str) -> _Part:
        """Return a text of the rule as an expression that is decided by itself; raises RuleError."""
        rule = self._rule
        lists = _OVER_A_LIST.findall(text)
        known = {*rule.reads, *ALWAYS_THERE, *TYPES, *lists}
        try:
            decision = Decision(_compiled(rule, "check", text), self._functions, _counted(rule, text))
        except KeyError:  # a function that there is not
            decision = None
        if decision is None or not known.issuperset(decision.named):
            check_rule(rule, self._functions)  # names in which of the expressions
        assert decision is not None
        return _Part(decision, self._names)

    @cached_property
    def finding(self) -> FindingExpressions:
        """Its message and fixes where it is broken."""
        return self._finding or check_rule(self._rule, self._functions)


def _counted(rule: Rule, text: str) -> list[str]:
    """Return the lists of which an expression asks nothing but what the functions count in them."""
    counted = _COUNTED.findall(text)
    return [
        name
        for name in dict.fromkeys(counted)
        if is_list(rule.reads.get(name, "")) and len(re.findall(rf"\b{name}\b", text)) == counted.count(name)
    ]


def check_rule(rule: Rule, functions: Mapping[str, Callable[..., Any]]) -> FindingExpressions:
    """Compile a rule that may call ``functions`` and return its message and fixes; raises RuleError."""
    called: set[str] = set()
    named_values: set[str] = set()
    asked_of: set[str] = set()
    for place, text in _texts(rule):
        compiled = _compiled(rule, place, text)
        found = set(compiled.references()["variables"]) - set(_OVER_A_LIST.findall(text))
        variables = found - TYPES
        known = {*rule.reads, *ALWAYS_THERE, *(_AT_HAND if place.startswith(("blames", "compares")) else ())}
        for name in sorted(variables - known):
            raise RuleError(rule.id, f"{place} names {quoted(name)}, which it does not read")
        if place.startswith(("check", "value ")):
            named_values |= found
        if place == "when":
            asked_of |= found
        named = functions_called(compiled)
        for name in sorted(named - set(functions)):
            raise RuleError(rule.id, f"{place} calls {quoted(name)}, which is no function")
        called |= named & set(functions)
    printed_names = _check_names(rule)
    blames, compares = _about(rule, named_values | printed_names, asked_of)

    def expression(text: str) -> Expression:
        return Expression(program(text), functions)

    return FindingExpressions(
        tuple((name, expression(text)) for name, text in rule.values.items()),
        tuple((fix.set, expression(fix.value)) for fix in rule.fix),
        tuple((used.set, expression(used.value)) for used in rule.effective),
        tuple(_at_hand(rule, blames)),
        tuple(_at_hand(rule, compares)),
        tuple(sorted(called)),
        frozenset(printed_names),
    )


def _about(rule: Rule, named_values: set[str], asked_of: set[str]) -> tuple[dict[str, str], dict[str, str]]:
    """Return what a finding of a rule is about, and what that is compared with, each with its condition:
    what the rule checks or shows comes before what decides whether it applies.
    """
    replaced = {used.set: f"({used.value}\n) != it" for used in rule.effective}
    # Where a rule does not name it: what the control replaces, else the first value that is read.
    blames = rule.blames or replaced or dict.fromkeys(list(rule.reads)[:1], "true")
    own = {*blames, *rule.compares}
    others = [name for name, text in rule.reads.items() if name not in own and not is_list(text)]
    named = [name for of in (named_values, asked_of) for name in others if name in of]
    return blames, {**rule.compares, **dict.fromkeys(named, "true")}


def _texts(rule: Rule) -> Iterator[tuple[str, str]]:
    """Yield every expression of a rule with its place in words."""
    yield "when", rule.when
    yield "check", rule.check
    for name, text in rule.values.items():
        yield f"value {name}", text
    for fix in rule.fix:
        yield f"fix of {fix.set}", fix.value
    for used in rule.effective:
        yield f"effective {used.set}", used.value
    for name, text in rule.blames.items():
        yield f"blames of {name}", text
    for name, text in rule.compares.items():
        yield f"compares of {name}", text


def _compiled(rule: Rule, place: str, text: str) -> Program:
    try:
        return program(text)
    except ValueError as error:
        raise RuleError(rule.id, f"{place}: {str(error).splitlines()[0]}") from None


def _at_hand(rule: Rule, conditions: dict[str, str]) -> Iterator[tuple[str, Program | None]]:
    """Yield names and conditions; of a list that is named without one, the values that are there."""
    for name, text in conditions.items():
        if text == "true":
            yield name, program("it != null") if is_list(rule.reads[name]) else None
        else:
            yield name, program(text)


def is_list(read: str) -> bool:
    """Return whether an entry of ``reads`` is a list over instances."""
    return read.partition("@")[2] in ("*", "<", ">", ".")


def _check_names(rule: Rule) -> set[str]:
    """Check the names a rule uses outside its expressions; returns those its message shows, raises
    RuleError.
    """
    lists = {name for name, text in rule.reads.items() if is_list(text)}
    for place in ("optional", "any_state", "blames", "compares"):
        for name in getattr(rule, place):
            if name not in rule.reads:
                raise RuleError(rule.id, f"{place} names {quoted(name)}, which it does not read")
    for assignment in (*rule.fix, *rule.effective):
        if assignment.set not in rule.reads or assignment.set in lists:
            raise RuleError(rule.id, f"it sets {quoted(assignment.set)}, which is no single value it reads")
    _check_units(rule)
    return _names_in_message(rule)


def _check_units(rule: Rule) -> None:
    for name, unit in rule.units.items():
        if name not in rule.values:
            raise RuleError(rule.id, f"units names {quoted(name)}, which is not one of its values")
        if unit not in UNITS:
            raise RuleError(rule.id, f"{quoted(unit)} is no unit")


def _names_in_message(rule: Rule) -> set[str]:
    """Return the names that the message of a rule shows; raises RuleError for one that it cannot."""
    known = {*rule.reads, *rule.values, *ALWAYS_THERE}
    try:
        parsed = [*Formatter().parse(rule.message)]
    except ValueError as error:
        raise RuleError(rule.id, f"message: {error}") from None
    fields = [_field(name, how, form) for _, name, form, how in parsed if name is not None]
    for field in fields:
        if field not in known:
            raise RuleError(
                rule.id,
                f"the message shows {quoted(f'{{{field}}}')}, which is neither read nor among its values",
            )
    return set(fields)


def _field(name: str, how: str | None, form: str | None) -> str:
    """Return a field as it is written, also with a conversion or a form, which a message does not have:
    its figures are written as values are.
    """
    return f"{name}{f'!{how}' if how else ''}{f':{form}' if form else ''}"
