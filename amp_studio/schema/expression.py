"""The one evaluator of conditions and rules: an expression in CEL, given the values that it reads,
comes to a verdict.

What an expression came to for equal values is remembered: most machines have most values in common.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection, Hashable, Iterable, Mapping, Sequence
from functools import cached_property, lru_cache
from operator import attrgetter
from typing import Any

from .address import Address, part_of
from .cel_engine import Context, Program, compile_expression, functions_called
from .units import canonical
from .value import Value

Canonical = float | str | bool | None
"""A value as expressions see it: a double in canonical units, the key of a choice, a bool, a text;
None is not set."""

ALWAYS_THERE = ("machine", "application", "instance", "part")
"""Names that need not be read: machine type and model of the control, the instance at hand, its part."""

EVALUATION_ERRORS = (TypeError, ValueError, RuntimeError, ArithmeticError, LookupError)
"""What CEL raises for a value of a kind that an expression does not speak of."""

ValueKey = float | str | object | None
"""By what results are looked up: the key of a value, or a tuple of keys for a list.

It is the value itself but for true, false and minus zero: Python takes 1 and True for equal, and 0 and -0
too, by which CEL divides with different results.
"""
_TRUE, _FALSE = object(), object()

_PARTS = "_parts"
"""The parts of an instance, in an expression over all of them."""

NO_RESULT = object()
"""What an expression comes to that makes no sense of its values."""

MAX_REMEMBERED = 5_000
"""Results of one expression before all are forgotten: those of 700 machines with seven axes and no value in
common. Such machines take 0.2 MB each."""


def key_of(value: Value | None) -> ValueKey:
    """Return the key of a value."""
    try:
        return value._key  # type: ignore[union-attr, no-any-return]  # any object may be asked; one without a key gets it below
    except AttributeError:
        found = canonical_value(value)
        key: ValueKey = (
            (_TRUE if found else _FALSE) if found.__class__ is bool else 0.0 if found == 0 else found
        )
        if value is not None:
            # Values are frozen and shared by many files: the key is worked out once for all of them.
            object.__setattr__(value, "_key", key)
        return key


def value_of(key: ValueKey) -> Canonical | list[Canonical]:
    """Return the value that has a key."""
    if key.__class__ is tuple:
        if _TRUE not in key and _FALSE not in key:
            return list(key)  # thousands of a table
        return [value_of(one) for one in key]  # type: ignore[misc]  # a list of a CEL value has no lists in it
    return key is _TRUE if key is _TRUE or key is _FALSE else key  # type: ignore[return-value]  # what is left of a key is a number or a text


class ValueKeys(dict[Address, ValueKey]):
    """The keys of a file's values, each worked out when it is first asked for."""

    def __init__(self, value: Callable[[Address], Value | None]) -> None:
        self._value = value

    def __missing__(self, address: Address) -> ValueKey:
        value = self._value(address)
        found: ValueKey = None
        if value is not None:
            try:
                found = value._key  # type: ignore[attr-defined]  # most are known: this is done for every value of a file
            except AttributeError:
                found = key_of(value)
        self[address] = found
        return found


def canonical_value(value: Value | None) -> Canonical:
    """Return a value as rules see it: numbers as doubles in canonical units."""
    if value is None:
        return None
    found = value.value
    kind = found.__class__
    return found if kind is str or kind is bool else canonical(float(found), value.unit)


class Remembered(dict[Hashable, Any]):
    """What an expression came to for values it has met."""

    def __setitem__(self, key: Hashable, result: Any) -> None:
        # All at once: to choose what goes would cost more at each look than to work it out again.
        if len(self) >= MAX_REMEMBERED:
            self.clear()
        super().__setitem__(key, result)


class Circumstances:
    """What every expression may name without reading it: ``ALWAYS_THERE``."""

    __slots__ = (*ALWAYS_THERE, "key")

    def __init__(self, machine: str, application: str, instance: str) -> None:
        self.machine, self.application, self.instance = machine, application, instance
        self.part = part_of(instance)
        self.key = (machine, application, instance)


class Expression:
    """A compiled expression, which may call some ``functions``."""

    def __init__(self, compiled: Program, functions: Mapping[str, Callable[..., Any]]) -> None:
        self.program = compiled
        # Only what it calls: each function costs when a context is made.
        self.functions = {name: functions[name] for name in sorted(functions_called(compiled))}
        self.named = named = frozenset(compiled.variables())
        """Every name in it."""
        self.always = tuple(name for name in ALWAYS_THERE if name in named)
        """Which of the names that need not be read it depends on."""
        self._always = attrgetter(*self.always) if self.always else None
        self.remembered = Remembered()
        """Keys of the values, with what is ``always`` there behind them -> what it came to."""

    def result(
        self, keys: tuple[ValueKey, ...], circumstances: Circumstances, context: Callable[[], Context]
    ) -> Any:
        """Return what it comes to for values, given by their keys,
        in a ``context`` that is made when it is needed.

        ``NO_RESULT`` if it makes no sense of them: neither CEL nor the functions make any
        of a value that is not set.
        """
        asked: Hashable = keys
        if self._always is not None:
            asked = keys, self._always(circumstances)
        found = self.remembered.get(asked)
        if found is None:
            try:
                found = self.program.execute(context())
            except EVALUATION_ERRORS:
                found = NO_RESULT
            if found.__class__ not in (str, list, dict):  # which may be of any size
                self.remembered[asked] = found
        return found


class Decision(Expression):
    """An expression that is true or not; of lists that are ``counted`` it asks nothing but what functions
    count in them.
    """

    def __init__(
        self, compiled: Program, functions: Mapping[str, Callable[..., Any]], counted: Collection[str] = ()
    ) -> None:
        super().__init__(compiled, functions)
        self._counted = counted

    @property
    def asks_instance(self) -> bool:
        """Whether it asks which instance, or which part, it is worked out for."""
        return "instance" in self.always or "part" in self.always

    def is_true(self, keys: tuple[ValueKey, ...], names: Sequence[str], circumstances: Circumstances) -> bool:
        """Return whether it is true of the values of its names; it is not where it makes no sense of them."""
        return self.verdict(keys, names, circumstances) is True

    def verdict(
        self, keys: tuple[ValueKey, ...], names: Sequence[str], circumstances: Circumstances
    ) -> bool | None:
        """Return the same, and None where it makes no sense of the values."""
        found = self.result_of(keys, names, circumstances)
        return None if found is NO_RESULT else found is True

    def result_of(
        self, keys: tuple[ValueKey, ...], names: Sequence[str], circumstances: Circumstances
    ) -> Any:
        """Return what it comes to for the values of its names, true or false or anything else."""

        def context() -> Context:
            values = dict(zip(names, map(value_of, keys), strict=True))
            # Named by bytes: no value of a parameter is of that kind, so a function knows the name of a
            # list from a value.
            lists = {name.encode(): values[name] for name in self._counted}
            functions = {name: _counting(function, lists) for name, function in self.functions.items()}
            given: dict[str, Any] = {**values, **{name.decode(): name for name in lists}}
            return context_of(functions, self.always, given, given.values(), circumstances)

        return self.result(keys, circumstances, context)


class PartsDecision:
    """A decision that asks nothing of an instance but which part of its whole it is, for many parts at once.

    Parts beside each other mostly have one answer (the points that a cam uses, and those that it does not):
    they are asked about in halves until it is one. An expression makes a list of nothing: CEL copies it with
    each element.
    """

    def __init__(self, decision: Decision, text: str) -> None:
        self._decision, self._text = decision, text

    def are_true(
        self, keys: tuple[ValueKey, ...], names: Sequence[str], parts: Sequence[Circumstances]
    ) -> list[bool]:
        """Return whether it is true for each of the parts of one instance."""
        if len(parts) == 1:
            return [self._decision.is_true(keys, names, parts[0])]
        for is_true, every in ((False, self._none), (True, self._all)):
            if self._is_true(every, keys, names, parts):
                return [is_true] * len(parts)
        half = len(parts) // 2
        return [*self.are_true(keys, names, parts[:half]), *self.are_true(keys, names, parts[half:])]

    def _is_true(
        self, every: Program, keys: tuple[ValueKey, ...], names: Sequence[str], parts: Sequence[Circumstances]
    ) -> bool:
        """Return whether an expression over all parts is true; False where it makes no sense of them."""
        # The name of the parts is none that an expression can read.
        given = {**dict(zip(names, map(value_of, keys), strict=True)), _PARTS: [one.part for one in parts]}
        functions = self._decision.functions
        context = context_of(functions, self._decision.always, given, given.values(), parts[0])
        try:
            return every.execute(context) is True
        except EVALUATION_ERRORS:
            return False

    @cached_property
    def _none(self) -> Program:
        # On a line by itself the bracket is not part of a comment at the end of the text.
        return program(f"{_PARTS}.all(part, !({self._text}\n))")

    @cached_property
    def _all(self) -> Program:
        return program(f"{_PARTS}.all(part, ({self._text}\n))")


def _counting(function: Callable[..., Any], lists: Mapping[bytes, Any]) -> Callable[..., Any]:
    """Return a function that gets ``lists`` by their names: CEL would copy thousands of points in,
    and out again for each call.
    """
    if not lists:
        return function
    bare = inspect.unwrap(function)  # what is in a list are doubles already

    def called(first: Any, *others: Any) -> Any:
        return bare(lists[first], *others) if first.__class__ is bytes else function(first, *others)

    return called


def context_of(
    functions: Mapping[str, Callable[..., Any]],
    always: Iterable[str],
    names: Iterable[str],
    values: Iterable[Any],
    circumstances: Circumstances,
) -> Context:
    """Return what an expression sees."""
    seen: dict[str, Any] = {name: getattr(circumstances, name) for name in always}
    seen.update(zip(names, values, strict=True))
    context = Context(seen)
    for name, function in functions.items():
        context.add_function(name, function)
    return context


@lru_cache(maxsize=10_000)  # more than all families have; a builder's are as many as he writes
def program(expression: str) -> Program:
    """Return a compiled CEL expression; raises ValueError for a syntax error."""
    return compile_expression(expression)
