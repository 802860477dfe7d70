"""Which of the values a broken rule reads are at fault, and which they were compared with."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from amp_studio.schema import Address
from amp_studio.schema.cel_engine import Context, Program
from amp_studio.schema.expression import EVALUATION_ERRORS

from .plan import RuleCheck

_Named = tuple[tuple[str, Program], ...]


def about(
    check: RuleCheck, context: Context, values: list[Any]
) -> tuple[tuple[Address, ...], tuple[Address, ...]]:
    """Return what is wrong, in the order of ``blames``, and what that was compared with, in that of ``compares``.

    Where no value answers to a condition of ``blames``, all that it names are wrong.
    """
    entries = check.expressions.finding
    given = dict(zip(check.names, values, strict=True))
    causes = dict.fromkeys(_met(check, entries.blames, context, given))
    if not causes:
        causes = dict.fromkeys(a for name, _ in entries.blames for a, _ in _values(check, name, given))
    compared = dict.fromkeys(_met(check, entries.compares, context, given))
    return tuple(causes), tuple(a for a in compared if a not in causes)


def _met(check: RuleCheck, named: _Named, context: Context, given: dict[str, Any]) -> Iterator[Address]:
    """Yield the addresses whose values answer to the conditions of their names."""
    for name, condition in named:
        for at, (address, value) in enumerate(_values(check, name, given)):
            context.update({"it": value, "at": at})
            try:
                if condition.execute(context) is True:
                    yield address
            except EVALUATION_ERRORS:
                continue  # a value that is not set, or of a kind that the condition does not speak of


def _values(check: RuleCheck, name: str, given: dict[str, Any]) -> Iterator[tuple[Address, Any]]:
    """Yield what a name means with its value; of a list all that are there, the others with null."""
    for listed_name, listed in check.lists:
        if listed_name == name:
            yield from zip(listed.addresses, given[name], strict=True)
            return
    yield check.address_of(name), given[name]
