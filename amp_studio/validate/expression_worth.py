"""What the parts of an expression can give at most: their kinds, sizes,
and which choices and texts they can be.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import reduce
from typing import Any, Literal

from amp_studio.schema import Parameter

from .builder_rules import LONGEST_TEXT
from .functions import NUMBER_ANNOTATIONS

_TEXT_SIZE, _LIST_SIZE = 6, 4
"""What a copy of an empty one costs; that of a number costs 1, some 50 ns."""
LARGEST = 10**15
"""Of sizes and costs; beyond it figures need not be exact."""

ValueKind = Literal["decimal", "whole", "text", "yes/no", "null", "list", "table", "any"]


@dataclass(frozen=True, slots=True)
class KnownChoices:
    """What a value that is a choice can be."""

    keys: Mapping[str, str]
    """Key -> label."""
    open: bool = False
    """``raw:`` and a code may be given too."""

    def contains(self, text: str) -> bool:
        return text in self.keys or (self.open and text.startswith("raw:"))


@dataclass(frozen=True, slots=True)
class ResultKind:
    """What a part of an expression can give: its kind, and how large it can be."""

    kind: ValueKind
    length: int = 0
    """Of a text or a list, at most."""
    item: ResultKind | None = None
    """What a list contains."""
    choices: KnownChoices | None = None
    """Where it comes from a parameter that is a choice."""
    literals: tuple[str, ...] = ()
    """The texts it can be, where they are written in the expression."""
    is_closed: bool = False
    """It can be nothing but its choices and literals."""
    size: int = 1
    """What a copy of it costs."""


DECIMAL, WHOLE, YES_NO, ANY = (
    ResultKind("decimal"),
    ResultKind("whole"),
    ResultKind("yes/no"),
    ResultKind("any"),
)


def text_result(length: int = LONGEST_TEXT) -> ResultKind:
    """Return a text of at most so many characters."""
    return ResultKind("text", length, size=_TEXT_SIZE + length // 100)


def list_result(length: int, item: ResultKind) -> ResultKind:
    """Return a list of at most so many items."""
    return ResultKind("list", length, item, size=min(_LIST_SIZE + length * item.size, LARGEST))


_GIVEN = {
    "float": DECIMAL,
    "int": WHOLE,
    "bool": YES_NO,
    "str": text_result(100),
    str(inspect.Signature.empty): DECIMAL,
}
_SEVERAL = list_result(32, ANY)


def choice_result(parameter: Parameter) -> ResultKind:
    """Return what the value of a choice parameter is."""
    keys = {choice.key: choice.label for choice in parameter.choices or ()}
    return replace(text_result(100), choices=KnownChoices(keys, parameter.more_codes), is_closed=True)


def one_of(keys: Mapping[str, str]) -> ResultKind:
    """Return a text that is one of some keys."""
    return replace(text_result(100), choices=KnownChoices(keys), is_closed=True)


@dataclass(frozen=True, slots=True)
class Signature:
    """How a function offered to rules is called."""

    fewest: int
    most: int
    gives: ResultKind
    numbers: frozenset[int] = frozenset()
    """Places of the arguments that must be numbers."""


def signature_of(function: Callable[..., Any]) -> Signature:
    """Return how a formula is called, from its annotations."""
    parameters = list(inspect.signature(function).parameters.values())
    needed = sum(p.default is p.empty for p in parameters)
    numbers = (n for n, p in enumerate(parameters) if p.annotation in NUMBER_ANNOTATIONS)
    # A formula may give null where the manual has no answer; what is asked here is how large others get.
    gives = str(inspect.signature(function).return_annotation).removesuffix(" | None")
    return Signature(needed, len(parameters), _GIVEN.get(gives, _SEVERAL), frozenset(numbers))


LANGUAGE: dict[str, Signature] = {
    "size": Signature(1, 1, WHOLE),
    "contains": Signature(2, 2, YES_NO),
    "startsWith": Signature(2, 2, YES_NO),
    "endsWith": Signature(2, 2, YES_NO),
    "matches": Signature(2, 2, YES_NO),
    "int": Signature(1, 1, WHOLE),
    "double": Signature(1, 1, DECIMAL),
    "string": Signature(1, 1, text_result()),
    "type": Signature(1, 1, ANY),
}
"""Functions of the language that a builder's rule may call: none of dates and bytes, no parameter is one."""


def any_of(results: list[ResultKind]) -> ResultKind:
    """Return what is one of several: as large as the largest."""
    # null is of every kind and costs nothing: it must not make the kind of the others unknown.
    known = [worth for worth in results if worth.kind != "null"]
    return reduce(_either, known) if known else next(iter(results), ANY)


def _either(one: ResultKind, other: ResultKind) -> ResultKind:
    """Return what is one of two: as large as the larger, and closed only if both are."""
    if one == other:
        return one
    # An empty list has no items, and goes with a list of anything.
    items = [worth.item for worth in (one, other) if worth.item]
    return ResultKind(
        one.kind if one.kind == other.kind else "any",
        max(one.length, other.length),
        any_of(items) if items else None,
        _joined_choices(one.choices, other.choices),
        tuple(dict.fromkeys((*one.literals, *other.literals))),
        one.is_closed and other.is_closed,
        max(one.size, other.size),
    )


def _joined_choices(one: KnownChoices | None, other: KnownChoices | None) -> KnownChoices | None:
    if one is None or other is None:
        return one or other
    return KnownChoices({**one.keys, **other.keys}, one.open or other.open)
