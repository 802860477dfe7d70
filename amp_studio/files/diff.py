"""Differences between two files, and the three-way merge, by parameter."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from amp_studio.schema import Address, Schema, UnitError, Value, convert, read_address, same_value

from .by_schema import by_schema
from .parameter_file import ParameterFile


@dataclass(frozen=True, slots=True)
class Difference:
    """One address at which two sides differ; None: not set on that side."""

    address: Address
    a: Value | None
    b: Value | None

    def in_one_unit(self) -> tuple[Value | None, Value | None]:
        """Return both sides in the unit of ``a``, to nine digits; as they are where that would make them look alike."""
        a, b = self.a, self.b
        if a is None or b is None or a.unit == b.unit or isinstance(b.value, (str, bool)):
            return a, b
        try:
            other = Value(float(f"{convert(float(b.value), b.unit, a.unit):.9g}"), a.unit)
        except UnitError:
            return a, b
        return (a, b) if other.value == a.value else (a, other)


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
    order = {p: n for n, p in enumerate(schema.parameters)}
    places = schema.on(schema.family.default_machine).places  # axes by letter are in no order of letters

    def place(address: Address) -> tuple[int, int, int, str, str]:
        return order.get(address[0], len(order)), places.get(address, len(places)), len(address[1]), *address

    both = sorted({*a, *b}, key=place)
    found = [
        Difference(address, a.get(address), b.get(address)) for address in both if not _same(a, b, address)
    ]
    return Comparison(tuple(found), len(both) - len(found))


def _same(a: Mapping[Address, Value], b: Mapping[Address, Value], address: Address) -> bool:
    return same_value(a.get(address), b.get(address))


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
    families = {f.schema.family.family for f in (base, ours, theirs)}
    if len(families) > 1:
        raise ValueError(
            f"files of different control families cannot be merged: {', '.join(sorted(families))}"
        )
    base, theirs = by_schema(base, ours.schema), by_schema(theirs, ours.schema)
    merged, conflicts = ours.copy(), []
    for difference in compare(base.schema, base.values, theirs.values).differences:
        address = difference.address
        if _same(ours.values, base.values, address):
            merged.set(address, theirs.get(address))
            if address in theirs.forced:
                merged.forced[address] = theirs.forced[address]
        elif not _same(ours.values, theirs.values, address):
            conflicts.append(Conflict(address, base.get(address), ours.get(address), theirs.get(address)))
    if ours.header.machine == base.header.machine:
        merged.set_machine(theirs.header.machine)
    return merged, conflicts + _merge_unknown(base.unknown, merged.unknown, theirs.unknown)


def _merge_unknown(base: dict[str, str], merged: dict[str, str], theirs: dict[str, str]) -> list[Conflict]:
    """Bring the changes theirs made among entries that the schema does not know into ``merged``, which is ours."""
    conflicts = []
    for key in dict.fromkeys([*base, *theirs]):
        was, mine, wanted = base.get(key), merged.get(key), theirs.get(key)
        if wanted in (was, mine):
            continue
        if mine != was:
            values = [None if text is None else Value(text) for text in (was, mine, wanted)]
            conflicts.append(Conflict(read_address(key), *values))
        elif wanted is None:
            del merged[key]
        else:
            merged[key] = wanted
    return conflicts
