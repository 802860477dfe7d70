"""The range of a parameter, apart from its value.

``limits`` says what is allowed, ``fault`` says in one sentence why a value is
not, ``clip`` mends it. Ranges are checked in the unit of entry: the printed
inch range and the printed metric range differ in the last digit.
"""

from __future__ import annotations

from dataclasses import dataclass

from .catalog import Address
from .model import Bound, BoundRef, Range
from .situation import Situation
from .units import UNITS, angular, convert, dimension, shown
from .values import Value, write_number


@dataclass(frozen=True, slots=True)
class Limits:
    """The bounds that hold for one instance in one unit; None where the manual prints none."""

    low: float | None
    high: float | None
    unit: str
    low_from: Address | None = None
    """The parameter that sets the lower bound, where another one does."""
    high_from: Address | None = None
    borrowed: bool = False
    """The manual prints no range in degrees here: the metric figures are used."""

    def text(self) -> str:
        """Return ``0 to 214.1 mm`` for a person."""
        unit = f" {shown(self.unit)}" if self.unit else ""
        if self.low is None and self.high is None:
            return "no printed range"
        if self.low is None:
            return f"at most {write_number(self.high or 0.0)}{unit}"
        if self.high is None:
            return f"at least {write_number(self.low)}{unit}"
        return f"{write_number(self.low)} to {write_number(self.high)}{unit}"


def ranges_of(situation: Situation, address: Address) -> dict[str, Range]:
    """Return the ranges that hold for one instance: the plain ones, or those of a variant."""
    parameter = situation.schema.parameters[address[0]]
    for variant in parameter.range_variants:
        if situation.holds(variant.when, address[1]):
            return variant.ranges
    return parameter.ranges or {}


def limits(situation: Situation, address: Address, unit: str) -> Limits | None:
    """Return the bounds of one instance in ``unit``; None when it has no range."""
    ranges = ranges_of(situation, address)
    if not ranges:
        return None
    printed, borrowed = _printed(ranges, unit)
    if printed is None:
        return None
    reference = ranges[printed]
    low, low_from = _bound(situation, address, reference[0], printed, unit)
    high, high_from = _bound(situation, address, reference[1], printed, unit)
    return Limits(low, high, unit, low_from, high_from, borrowed)


def _printed(ranges: dict[str, Range], unit: str) -> tuple[str | None, bool]:
    """Return the printed unit to compare in: the same, one of the same dimension, or metric figures as degrees."""
    if unit in ranges:
        return unit, False
    for printed in ranges:
        if dimension(printed) == dimension(unit) and _system(printed) == _system(unit):
            return printed, False
    for printed in ranges:
        if dimension(printed) == dimension(unit):
            return printed, False
    for printed in ranges:
        if "mm" in printed and dimension(angular(printed)) == dimension(unit):
            return printed, True
    return None, False


def _system(unit: str) -> str:
    return unit.split("/")[0]


def _bound(
    situation: Situation, address: Address, bound: Bound, printed: str, unit: str
) -> tuple[float | None, Address | None]:
    if bound is None:
        return None, None
    if isinstance(bound, BoundRef):
        source = situation.reading(bound.param, address[1]).addresses[0]
        found = situation.canonical(source)
        if not isinstance(found, float) or situation.state(source).state == "hidden":
            return None, source
        return found / float(UNITS[unit][1]), source
    if dimension(printed) != dimension(unit):  # metric figures taken as degrees
        return convert(bound, angular(printed), unit), None
    return convert(bound, printed, unit), None


def fault(situation: Situation, address: Address, value: Value) -> str | None:
    """Return one sentence why a value is not allowed, or None; bounds set by other parameters count."""
    parameter = situation.schema.parameters[address[0]]
    found = value.value
    if isinstance(found, str):
        if parameter.choices and found.startswith("raw:"):
            return f"{found[4:]} is no code of {parameter.name}"
        return None
    if isinstance(found, bool):
        return None
    allowed = limits(situation, address, value.unit)
    if allowed is None:
        return None
    if _below(found, allowed.low, allowed.low_from) or _below(allowed.high, found, allowed.high_from):
        return f"{parameter.name} {_shown(value)} is outside {_named(situation, allowed)}"
    return None


def _below(a: float | None, b: float | None, shared: Address | None) -> bool:
    """Tell whether a < b; bounds that went through a change of unit forgive the last digits of a double."""
    if a is None or b is None:
        return False
    return a < b and not (shared is not None and abs(a - b) <= 1e-12 * max(abs(a), abs(b)))


def _named(situation: Situation, allowed: Limits) -> str:
    text = allowed.text()
    for source in (allowed.low_from, allowed.high_from):
        if source is not None:
            text += f" (set by {situation.schema.label(source, situation.machine)})"
    return text


def _shown(value: Value) -> str:
    number = write_number(value.value) if not isinstance(value.value, str) else value.value
    return f"{number} {shown(value.unit)}".rstrip()


def clip(situation: Situation, address: Address, value: Value) -> Value:
    """Return the nearest allowed value in the same unit."""
    if isinstance(value.value, (str, bool)):
        return value
    allowed = limits(situation, address, value.unit)
    if allowed is None:
        return value
    number = float(value.value)
    if allowed.low is not None:
        number = max(number, allowed.low)
    if allowed.high is not None:
        number = min(number, allowed.high)
    return Value(int(number) if isinstance(value.value, int) else number, value.unit)


