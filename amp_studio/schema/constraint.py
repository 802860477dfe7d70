"""The range of a parameter, apart from its value.

``limits`` returns the allowed range, ``fault`` the reason why a value is not, ``clip`` mends it. Ranges are
checked in the unit of entry: the printed inch range and the printed metric range differ in the last digit.
"""

from __future__ import annotations

import math
from decimal import ROUND_CEILING, ROUND_FLOOR, Context
from typing import NamedTuple

from .address import Address
from .bit_fields import field_value
from .evaluation import Evaluation
from .model import Bit, Bound, BoundRef, Parameter, Range
from .storage import exact, stored_range, stored_unit
from .units import UNITS, angular, canonical_unit, convert, dimension, unit_text
from .value import Value
from .values import MASKED, digits_of, show_value, write_number


class Limits(NamedTuple):
    """The bounds that apply to one instance in one unit; None where there is none."""

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
        unit = f" {unit_text(self.unit)}" if self.unit else ""
        if self.low is None and self.high is None:
            return "no printed range"
        if self.low is None:
            return f"at most {_bound_text(self.high or 0.0, ROUND_FLOOR)}{unit}"
        if self.high is None:
            return f"at least {_bound_text(self.low, ROUND_CEILING)}{unit}"
        return f"{_bound_text(self.low, ROUND_CEILING)} to {_bound_text(self.high, ROUND_FLOOR)}{unit}"


def _bound_text(bound: float, inwards: str) -> str:
    """Return a bound for a person; one that was converted has ten digits, and is allowed itself."""
    if not math.isfinite(bound):
        return write_number(bound)
    return write_number(float(Context(prec=10, rounding=inwards).create_decimal(repr(bound))))


def ranges_of(evaluation: Evaluation, address: Address) -> dict[str, Range]:
    """Return the ranges that apply to one instance: the plain ones, or those of a variant."""
    parameter = evaluation.schema.parameters[address[0]]
    for variant in parameter.range_variants:
        if evaluation.is_true(variant.when, address[1], evaluation.scope(address)):
            return variant.ranges
    return parameter.ranges or {}


def limits(evaluation: Evaluation, address: Address, unit: str) -> Limits | None:
    """Return the bounds of one instance in ``unit``: the range, as far as the control's words can store it.

    None when there is neither.
    """
    parameter = evaluation.schema.parameters[address[0]]
    ranges = ranges_of(evaluation, address)
    storable = _storable(parameter, unit)
    printed, borrowed = _printed(ranges, unit)
    if printed is None:
        return Limits(*storable, unit) if storable else None
    reference = ranges[printed]
    low, low_from = _bound(evaluation, address, reference[0], printed, unit)
    high, high_from = _bound(evaluation, address, reference[1], printed, unit)
    # A printed range that is wider than the words of the control cannot be used up.
    if storable and (low is None or low < storable[0]):
        low, low_from = storable[0], None
    if storable and (high is None or high > storable[1]):
        high, high_from = storable[1], None
    return Limits(low, high, unit, low_from, high_from, borrowed)


def _storable(parameter: Parameter, unit: str) -> tuple[float, float] | None:
    """Return the smallest and the largest number that the control's words can store, in ``unit``."""
    storage = parameter.storage
    if storage is None or storage.bits is None or parameter.type not in ("integer", "real"):
        return None
    stored = stored_unit(parameter, unit)
    if dimension(stored) != dimension(unit):
        return None
    factor = UNITS[stored][1] / UNITS[unit][1] / exact(storage.scale)
    low, high = stored_range(parameter)
    return float(low * factor), float(high * factor)


def _printed(ranges: dict[str, Range], unit: str) -> tuple[str | None, bool]:
    """Return the printed unit to compare in: the same, one of the same dimension,
    or metric figures as degrees.
    """
    if unit in ranges:
        return unit, False
    for printed in ranges:
        # Its own system of units first: printed inch and metric ranges differ in the last digit.
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
    return unit.split("/", maxsplit=1)[0]


def _bound(
    evaluation: Evaluation, address: Address, bound: Bound, printed: str, unit: str
) -> tuple[float | None, Address | None]:
    """Return a bound in ``unit``, and the parameter that sets it; no bound where that one has no number
    here.
    """
    if bound is None:
        return None, None
    if isinstance(bound, BoundRef):
        source = evaluation.reference(bound.param, address[1], evaluation.scope(address)).addresses[0]
        found = evaluation.canonical(source)
        # A parameter that does not exist on this machine, or has no number, bounds nothing.
        if not isinstance(found, float) or evaluation.state(source).state == "hidden":
            return None, source
        return convert(found, canonical_unit(unit), unit), source
    if dimension(printed) != dimension(unit):  # metric figures taken as degrees
        return convert(bound, angular(printed), unit), None
    return convert(bound, printed, unit), None


def fault(evaluation: Evaluation, address: Address, value: Value) -> str | None:
    """Return one sentence why a value is not allowed, or None; bounds set by other parameters count."""
    parameter = evaluation.schema.parameters[address[0]]
    found = value.value
    # Before anything else: no value is right, so none would be a better one.
    if parameter.access == "read":
        return f"{parameter.name} can only be read: the control writes it itself"
    if isinstance(found, str):
        return _text_fault(evaluation, address, found)
    if isinstance(found, bool):
        return None
    if parameter.type == "bits" and (message := _bits_fault(parameter, int(found))):
        return message
    allowed = limits(evaluation, address, value.unit)
    if allowed is not None and _beyond(found, allowed):
        figure = MASKED if parameter.secret else _value_text(value)
        return f"{parameter.name} {figure} is outside {_named(evaluation, allowed)}"
    return None


def _text_fault(evaluation: Evaluation, address: Address, text: str) -> str | None:
    """Return why the text of a choice or a format is not allowed, or None."""
    parameter = evaluation.schema.parameters[address[0]]
    if parameter.choices and text.startswith("raw:") and not parameter.more_codes:
        return f"{text[4:]} is no code of {parameter.name}"
    return _format_fault(evaluation, address, text) if parameter.type == "format" else None


def bounding(evaluation: Evaluation, address: Address, value: Value) -> tuple[Address, ...]:
    """Return the parameter whose value is the bound that a number lies beyond;
    empty where no other one sets it.
    """
    if isinstance(value.value, (str, bool)):
        return ()
    allowed = limits(evaluation, address, value.unit)
    beyond = _beyond(value.value, allowed) if allowed else ()
    return tuple(source for _, source in beyond if source is not None)


def _beyond(found: float, allowed: Limits) -> tuple[tuple[float | None, Address | None], ...]:
    """Return the bounds that a number lies beyond, each with the parameter that sets it."""
    low, high = (allowed.low, allowed.low_from), (allowed.high, allowed.high_from)
    return ((low,) if _below(found, *low) else ()) + ((high,) if _below(high[0], found, high[1]) else ())


def _format_fault(evaluation: Evaluation, address: Address, form: str) -> str | None:
    """Return why a word format is not allowed; its digits before
    and behind the point each have their own bounds.
    """
    # A format is stored as a number (3.4), and so are its bounds: the digits on each side are compared,
    # not the numbers.
    low, high = ranges_of(evaluation, address).get("", (None, None))
    for index in (0, 1):
        digits = digits_of(form)[index]
        bounds = [digits_of(repr(b))[index] if isinstance(b, float) else digits for b in (low, high)]
        if not bounds[0] <= digits <= bounds[1]:
            allowed = " to ".join(repr(b) if isinstance(b, float) else "…" for b in (low, high))
            return f"{evaluation.schema.parameters[address[0]].name} {form} is outside {allowed}"
    return None


def _bits_fault(parameter: Parameter, word: int) -> str | None:
    """Return why a word of bits is not allowed: too wide for the control,
    or a code that a field does not have.
    """
    width = parameter.word_width
    # Where no width is printed, every word that is not negative fits.
    if word < 0 or word >> (width or word.bit_length()):
        return f"{parameter.name} {word} does not fit {f'its {width} bits' if width else 'a word of bits'}"
    for field in parameter.bits or ():
        if not _may_contain(field, field_value(field, word)):
            return f"{field_value(field, word)} is no code of {field.label} in {parameter.name}"
    return None


def _may_contain(field: Bit, code: int) -> bool:
    """Return whether a field has a code; one of which not every code is printed may contain any."""
    codes = {choice.raw for choice in field.choices or ()}
    return not codes or not codes.isdisjoint({None, code})


def _below(a: float | None, b: float | None, shared: Address | None) -> bool:
    """Return whether a < b; bounds that went through a change of unit forgive the last digits of a double."""
    if a is None or b is None:
        return False
    return a < b and not (shared is not None and abs(a - b) <= 1e-12 * max(abs(a), abs(b)))


def _named(evaluation: Evaluation, allowed: Limits) -> str:
    text = allowed.text()
    for bound, source in ((allowed.low, allowed.low_from), (allowed.high, allowed.high_from)):
        if bound is not None and source is not None:
            label = evaluation.machine_schema.label(source)
            shown_value = show_value(evaluation.schema.parameters[source[0]], evaluation.value(source))
            text += f" (set by {label}, {shown_value})"
    return text


def _value_text(value: Value) -> str:
    number = write_number(value.value) if not isinstance(value.value, str) else value.value
    return f"{number} {unit_text(value.unit)}".rstrip()


def clip(evaluation: Evaluation, address: Address, value: Value) -> Value:
    """Return the nearest allowed value in the same unit."""
    if isinstance(value.value, (str, bool)):
        return value
    allowed = limits(evaluation, address, value.unit)
    if allowed is None:
        return value
    number = float(value.value)
    whole = isinstance(value.value, int)
    if allowed.low is not None and math.isfinite(allowed.low):
        # Rounded inwards: the nearest whole number may lie outside.
        number = max(number, float(math.ceil(allowed.low)) if whole else allowed.low)
    if allowed.high is not None and math.isfinite(allowed.high):
        number = min(number, float(math.floor(allowed.high)) if whole else allowed.high)
    return Value(int(number) if whole else number, value.unit)
