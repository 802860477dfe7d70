"""Functions offered to rules: arithmetic that CEL lacks, and those that a family registers."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable, Mapping
from functools import cache, wraps
from typing import Any

from amp_studio.schema import WORD_FUNCTIONS, load_part, registration_of

NUMBER_ANNOTATIONS = frozenset(("float", "int", "float | None", inspect.Parameter.empty))
"""How functions for rules declare that an argument is a number; built-in ones declare nothing."""


# All give doubles: CEL does not mix whole numbers and decimal ones in arithmetic.
def _mod(a: float, b: float) -> float:
    # The sign of ``a``, as in C; the remainder by 0 equals nothing, where fmod would raise and end the
    # rule.
    return math.fmod(a, b) if b else math.nan


def _floor(a: float) -> float:
    return float(math.floor(a))


def _ceil(a: float) -> float:
    return float(math.ceil(a))


def _abs(a: float) -> float:
    return abs(a)


def _min(a: float, b: float) -> float:
    return min(a, b)


def _max(a: float, b: float) -> float:
    return max(a, b)


def _round(a: float, digits: float) -> float:
    return round(a, int(digits))


# CEL copies what filter() found so far with each value it finds: to count those of a table takes the square
# of its length.


def _count_set(values: list[Any]) -> float:
    return float(len(values) - values.count(None))


def _count_below(values: list[Any], limit: float) -> float:
    return float(sum(value is not None and value < limit for value in values))


def _count_above(values: list[Any], limit: float) -> float:
    return float(sum(value is not None and value > limit for value in values))


GENERAL: dict[str, Callable[..., Any]] = {
    "mod": _mod,
    "floor": _floor,
    "ceil": _ceil,
    "abs": _abs,
    "round": _round,
    "min": _min,
    "max": _max,
    "count_set": _count_set,
    "count_below": _count_below,
    "count_above": _count_above,
    **WORD_FUNCTIONS,
}


_TEXT = ("str", str)


@cache
def formulas(family: str) -> dict[str, Callable[..., Any]]:
    """Return name -> function of a family's published formulas."""
    place = registration_of(family).formulas
    return dict(load_part(place)) if place else {}


@cache
def rule_functions(family: str) -> Mapping[str, Callable[..., Any]]:
    """Return every function a rule of the family may call."""
    return {name: _guarded(function) for name, function in (GENERAL | formulas(family)).items()}


def _guarded(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that takes for numbers nothing but doubles, and for texts nothing but texts.

    A rule may hand over anything, also the null of a value that is not set: Python would repeat a text a
    billion times for a whole number, and reckon a power of ten with a billion digits.
    """

    @cache
    def annotations() -> list[object]:  # of most functions of a family no rule of a file asks
        return [place.annotation for place in inspect.signature(function).parameters.values()]

    @wraps(function)
    def called(*arguments: Any) -> Any:
        for argument, annotation in zip(arguments, annotations(), strict=False):
            if annotation in NUMBER_ANNOTATIONS and type(argument) in (str, list, dict):
                raise TypeError(f"{argument!r:.20} is no number")
            if annotation in _TEXT and type(argument) is not str:
                raise TypeError(f"{argument!r:.20} is no text")
        return function(*map(_with_doubles, arguments))

    return called


def _with_doubles(argument: Any) -> Any:
    kind = type(argument)
    if kind is int:
        return float(argument)
    return [float(item) if type(item) is int else item for item in argument] if kind is list else argument
