"""Differences between two files, and the three-way merge, by parameter."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from amp_studio.schema import Address, Schema, UnitError, Value, convert, same_value

from .merging import Merge, in_order
from .parameter_file import ParameterFile


@dataclass(frozen=True, slots=True)
class Difference:
    """One address at which two sides differ; None: not set on that side."""

    address: Address
    a: Value | None
    b: Value | None

    def in_one_unit(self) -> tuple[Value | None, Value | None]:
        """Return both sides in the unit of ``a``, to nine digits;
        as they are where that would make them look alike.
        """
        if self.a is None:
            return self.a, self.b
        a, b = in_one_unit((self.a, self.b), self.a.unit)
        return a, b


def in_one_unit(values: Sequence[Value | None], unit: str) -> list[Value | None]:
    """Return values in one unit, to nine digits; as they are where they have no such unit,
    or different ones would look alike.
    """
    try:
        converted = [_in_unit(value, unit) for value in values]
    except UnitError:
        return list(values)
    for n, value in enumerate(values):
        for other in range(n):
            # Nine digits would hide the difference that is to be shown.
            if converted[n] == converted[other] and not same_value(value, values[other]):
                return list(values)
    return converted


def _in_unit(value: Value | None, unit: str) -> Value | None:
    if value is None or value.unit == unit or isinstance(value.value, (str, bool)):
        return value
    return Value(float(f"{convert(float(value.value), value.unit, unit):.9g}"), unit)


@dataclass(frozen=True)
class Comparison:
    """All differences of two sides, in the manual's order, and how many addresses are the same."""

    differences: tuple[Difference, ...]
    same: int

    @property
    def not_set_in_a(self) -> int:
        """Addresses that only the second side has."""
        return sum(d.a is None for d in self.differences)

    @property
    def not_set_in_b(self) -> int:
        """Addresses that only the first side has."""
        return sum(d.b is None for d in self.differences)


def compare(schema: Schema, a: Mapping[Address, Value], b: Mapping[Address, Value]) -> Comparison:
    """Compare two sets of values exactly; 1 in and 25.4 mm are the same value."""
    both = in_order(schema, {*a, *b})
    found = [
        Difference(address, a.get(address), b.get(address))
        for address in both
        if not same_value(a.get(address), b.get(address))
    ]
    return Comparison(tuple(found), len(both) - len(found))


def of_other_schema(file: ParameterFile, by_other: ParameterFile) -> list[Difference]:
    """Return the values of a file that it does not have by another schema, as differences from that."""
    return [Difference(at, None, value) for at, value in file.values.items() if at not in by_other.values]


@dataclass(frozen=True)
class Conflict:
    """An address that both sides changed, and not to the same value."""

    address: Address
    base: Value | None
    ours: Value | None
    theirs: Value | None


def merge(
    base: ParameterFile, ours: ParameterFile, theirs: ParameterFile
) -> tuple[ParameterFile, list[Conflict]]:
    """Return ours with the changes that theirs made to base, and the conflicts, where ours is kept.

    Raises ValueError when the three are not of one family.
    """
    merged = Merge(ours, theirs, base)
    return merged.result(), [Conflict(row.address, row.base, row.a, row.b) for row in merged.conflicts]
