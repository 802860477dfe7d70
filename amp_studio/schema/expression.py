"""The one evaluator of conditions and rules: an expression in CEL, given the values that it reads, comes to a verdict.

What an expression came to for equal values is remembered: most machines have most values in common.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

from .address import part_of
from .cel_engine import Context, Program, compile_expression, functions_called

Canonical = float | str | bool | None
"""A value as expressions see it: a double in canonical units, the key of a choice, a bool, a text; None is not set."""

ALWAYS_THERE = ("machine", "application", "instance", "part")
"""Names that need not be read: machine type and model of the control, the instance at hand, its part."""

EVALUATION_ERRORS = (TypeError, ValueError, RuntimeError, ArithmeticError, LookupError)
"""What CEL raises for a value of a kind that an expression does not speak of."""

_REMEMBERED = 20_000
"""Verdicts kept before all are forgotten: some megabytes."""


class Verdicts(dict[Hashable, bool | None]):
    """What an expression came to for values it has met; None where it made no sense of them."""

    def __setitem__(self, key: Hashable, verdict: bool | None) -> None:
        if len(self) >= _REMEMBERED:
            self.clear()
        super().__setitem__(key, verdict)


@dataclass(frozen=True, slots=True)
class Circumstances:
    """What every expression may name without reading it."""

    machine: str
    application: str
    instance: str

    def value(self, name: str) -> Canonical:
        """Return one of the names that are always there."""
        if name == "part":
            return part_of(self.instance)
        return str(getattr(self, name))


class Decision:
    """A compiled expression that is true or not, which may call some ``functions``."""

    def __init__(self, compiled: Program, functions: Mapping[str, Callable[..., Any]]) -> None:
        self.program = compiled
        self.functions = {name: functions[name] for name in sorted(functions_called(compiled))}
        named = set(compiled.variables())
        self.always = tuple(name for name in ALWAYS_THERE if name in named)
        """Which of the names that need not be read decide it."""
        self._verdicts = Verdicts()

    @property
    def asks_instance(self) -> bool:
        """Whether it asks which instance, or which part, it is worked out for."""
        return "instance" in self.always or "part" in self.always

    def holds(
        self, key: Hashable, names: Sequence[str], values: Sequence[Any], circumstances: Circumstances
    ) -> bool:
        """Return whether it is true of values; ``key`` identifies them, and is the same for equal ones alone.

        It is not where it makes no sense of them: neither CEL nor the functions make any of a value that is not set.
        """
        return self.verdict(key, names, values, circumstances) is True

    def verdict(
        self, key: Hashable, names: Sequence[str], values: Sequence[Any], circumstances: Circumstances
    ) -> bool | None:
        """Return the same, and None where it makes no sense of the values."""
        if self.always:
            key = key, *[circumstances.value(name) for name in self.always]
        if key in self._verdicts:
            return self._verdicts[key]
        context = context_of(self.functions, self.always, names, values, circumstances)
        try:
            found = self.program.execute(context) is True
        except EVALUATION_ERRORS:
            found = None
        self._verdicts[key] = found
        return found


def context_of(
    functions: Mapping[str, Callable[..., Any]],
    always: Iterable[str],
    names: Iterable[str],
    values: Iterable[Any],
    circumstances: Circumstances,
) -> Context:
    """Return what an expression sees."""
    seen: dict[str, Any] = {name: circumstances.value(name) for name in always}
    seen.update(zip(names, values, strict=True))
    context = Context(seen)
    for name, function in functions.items():
        context.add_function(name, function)
    return context


@cache
def program(expression: str) -> Program:
    """Return a compiled CEL expression; raises ValueError for a syntax error."""
    return compile_expression(expression)


def same_values(values: Sequence[Canonical | list[Canonical]]) -> Hashable:
    """Return what is equal only for values that CEL cannot distinguish: Python takes 1 and True for equal."""
    kinds = tuple(map(type, values))
    if list not in kinds:
        return kinds, tuple(values)
    return kinds, tuple([same_values(v) if isinstance(v, list) else v for v in values])
