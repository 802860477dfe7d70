"""Which of the values a broken rule reads are at fault, and which they were compared with."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, Protocol

from amp_studio.schema import EVALUATION_ERRORS, Address, Context, Program

from .plan import RuleCheck

_Named = tuple[tuple[str, Program | None], ...]


class CheckContext(Protocol):
    """What the expressions of a check see."""

    @property
    def values(self) -> list[Any]:
        """The values of its names."""

    @property
    def context(self) -> Context:
        """What the engine is given."""


def about(check: RuleCheck, given: CheckContext) -> tuple[tuple[Address, ...], tuple[Address, ...]]:
    """Return what is wrong, in the order of ``blames``, and what that was compared with,
    in that of ``compares``.

    Where no value answers to a condition of ``blames``, all that it names are wrong.
    """
    if check.always_about is not None:
        return check.always_about
    entries = check.expressions.finding
    causes = dict.fromkeys(_met(check, entries.blames, given))
    if not causes:
        causes = dict.fromkeys(a for name, _ in entries.blames for a, _ in _values(check, name, given))
    compared = dict.fromkeys(_met(check, entries.compares, given))
    return tuple(causes), tuple([a for a in compared if a not in causes])


def _met(check: RuleCheck, named: _Named, given: CheckContext) -> Iterator[Address]:
    """Yield the addresses whose values answer to the conditions of their names."""
    for name, condition in named:
        if condition is None:
            yield check.address_of(name)
            continue
        asks_place, met = "at" in condition.variables(), dict[tuple[object, ...], bool]()
        for at, (address, value) in enumerate(_values(check, name, given)):
            asked = (value.__class__, value, at if asks_place else 0)  # thousands of a table are equal
            if asked not in met:
                met[asked] = _is_met(condition, given, value, at)
            if met[asked]:
                yield address


def _is_met(condition: Program, given: CheckContext, value: Any, at: int) -> bool:
    """Return whether a value answers to a condition; one that is not set,
    or of a kind that it does not name, does not.
    """
    given.context.update({"it": value, "at": at})
    try:
        return condition.execute(given.context) is True
    except EVALUATION_ERRORS:
        return False


def _values(check: RuleCheck, name: str, given: CheckContext) -> Iterator[tuple[Address, Any]]:
    """Yield what a name means with its value; of a list all that are there, the others with null."""
    value = given.values[check.names.index(name)]
    for listed_name, listed in check.lists:
        if listed_name == name:
            yield from zip(listed.addresses, value, strict=True)
            return
    yield check.address_of(name), value
