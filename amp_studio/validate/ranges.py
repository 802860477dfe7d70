"""One value against its range, its choices and its unit."""

from __future__ import annotations

import math
from collections.abc import Hashable
from dataclasses import dataclass, field
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal
from functools import lru_cache
from itertools import chain

from amp_studio.files import ParameterFile, with_local_times
from amp_studio.schema import (
    Address,
    BoundRef,
    Limits,
    Parameter,
    Remembered,
    Schema,
    Scope,
    Value,
    bounding,
    clip,
    dimension,
    fault,
    limits,
    show_value,
    unit_text,
)

from .finding import AddressedValue, Finding

_NEAR = 0.1
"""Part of a bound by which a value may miss it for the bound to be a fix:
more than rounding and the step from a power of two."""


@dataclass(frozen=True, slots=True)
class _Facts:
    """What decides, of one parameter on one machine type, without looking at the file."""

    parameter: Parameter
    keys: frozenset[str]
    """Its choices."""
    measures: frozenset[str]
    """Dimension of its values; of more than one only where the unit systems differ in it."""
    turning: frozenset[str] | None
    """The same on an axis that turns; None where that makes no difference."""
    own_range: bool
    """Its range is the same for every instance and in every evaluation."""
    fine: Remembered = field(default_factory=Remembered, repr=False)
    """Values with nothing wrong in them, in whatever file, with what their range depends on."""
    bounded_by: dict[str, tuple[Address, ...]] = field(default_factory=dict, repr=False)
    """Instance -> the parameters that set a bound there."""


@lru_cache(maxsize=32)
def _facts(schema: Schema, machine: str) -> dict[str, _Facts]:
    found = {}
    for parameter in schema.parameters.values():
        layout = schema.on(machine).layout(parameter)
        if layout is not None:
            found[parameter.id] = _facts_of(schema, parameter, layout.scope)
    return found


def _facts_of(schema: Schema, parameter: Parameter, scope: Scope) -> _Facts:
    """Return the facts of one parameter, in all unit systems of the family."""
    systems = tuple(schema.family.units) or ("",)
    measures, turning = (
        frozenset(dimension(schema.unit(parameter, system, turns)) for system in systems)
        for turns in (False, True)
    )
    may_turn = scope == "axis" or parameter.angular_when
    return _Facts(
        parameter,
        frozenset(choice.key for choice in parameter.choices or ()),
        measures,
        turning if may_turn and turning != measures else None,
        not parameter.range_variants and not _has_other_bounds(parameter),
    )


def _has_other_bounds(parameter: Parameter) -> bool:
    """Return whether another parameter sets a bound."""
    bounds = chain.from_iterable((parameter.ranges or {}).values())
    return any(isinstance(bound, BoundRef) for bound in bounds)


class ValueChecks:
    """The values of one file, each by itself and with the parameters that bound it."""

    def __init__(self, file: ParameterFile, machine: str) -> None:
        self._file = file
        self._facts = _facts(file.schema, machine)
        self._spans: dict[tuple[str, str], tuple[float, float]] = {}
        """Bounds that depend on nothing, by parameter and unit."""
        self._turning: dict[tuple[str | None, str], bool] = {}
        """Whether an axis turns, by the condition and the axis."""

    def forget_values(self) -> None:
        """Forget what depends on values, which may have changed; called before the checks of a round."""
        self._turning.clear()

    def finding(self, address: Address, value: Value) -> Finding | None:
        """Return what is wrong with a value, if anything is."""
        facts = self._facts[address[0]]
        turns = facts.turning is not None and self._turns(facts.parameter, address[1])
        # With its class: to a key 1, 1.0 and True are one value.
        key: Hashable = (value.value.__class__, value.value, value.unit, turns)
        if not facts.own_range:
            key = key, self._bounds_of(facts, address)
        if key in facts.fine:
            return None
        if not _measures_right(facts, value, turns):
            unit = self._file.evaluation.unit(address, self._file.header.units)
            written = show_value(facts.parameter, value)
            other_unit = (
                f"{facts.parameter.name} {written} should be in {unit_text(unit) or 'a bare number'} here"
            )
            # The control knows the figure only.
            return self._finding(address, value, other_unit, Value(value.value, unit))
        if self._within(facts, address, value):
            facts.fine[key] = True
            return None
        message = fault(self._file.evaluation, address, value)
        if message is None:
            facts.fine[key] = True
            return None
        # Of a code that is not printed the control alone knows what it does: no choice is the nearest to
        # it.
        return self._finding(address, value, message, None if facts.keys else self._nearest(address, value))

    def _nearest(self, address: Address, value: Value) -> Value | None:
        """Return the nearest allowed value; None where it is not known to be the one that is meant.

        What lies far beyond a printed bound is a slip of the hand or has another unit, and the bound is often
        the highest gain or speed that there is. 0 is never the nearest to another number: a speed or a limit
        of 0 means something else. A bound that another parameter sets may be what is wrong: of a positive and
        a negative limit that are reversed, neither belongs at the edge of the other, which leaves an axis
        without travel, nor does a bound that leaves a single value say which value is meant.
        """
        other = None
        allowed = limits(self._file.evaluation, address, value.unit)
        # A bound that is printed is trusted; one that another parameter sets may itself be the slip.
        if allowed is not None and not isinstance(value.value, str):
            other = _setter_of_bound(allowed, value.value)
            if other is not None and (
                allowed.low == allowed.high or _bounds(self._file.schema.parameters[other[0]], address[0])
            ):
                return None
        nearest = _rounded_inwards(
            self._facts[address[0]].parameter, clip(self._file.evaluation, address, value), allowed
        )
        if nearest.value == 0 and value.value != 0:
            return None
        return nearest if other is not None or _is_near(value, nearest) else None

    def _turns(self, parameter: Parameter, axis: str) -> bool:
        asked = (self._file.schema.angular_when(parameter), axis)
        found = self._turning.get(asked)
        if found is None:
            found = self._turning[asked] = self._file.evaluation.turns((parameter.id, axis))
        return found

    def _bounds_of(self, facts: _Facts, address: Address) -> Hashable:
        """Return what is equal only where a range that depends on other values is the same."""
        evaluation = self._file.evaluation
        sources = facts.bounded_by.get(address[1])
        if sources is None:
            sources = facts.bounded_by[address[1]] = evaluation.bound_sources(address)
        variants = [
            evaluation.is_true(variant.when, address[1], evaluation.scope(address))
            for variant in facts.parameter.range_variants
        ]
        hidden = [evaluation.state(source).state == "hidden" for source in sources]
        return *variants, *hidden, *[evaluation.keys[source] for source in sources]

    def _within(self, facts: _Facts, address: Address, value: Value) -> bool:
        """Return quickly whether a value lies in a range that depends on nothing;
        False means that it has to be asked.
        """
        found = value.value
        # Whatever it is: a value that only the control writes is never right in a file to send; fault has
        # the words.
        if facts.parameter.access == "read":
            return False
        if isinstance(found, (str, bool)):
            return isinstance(found, bool) or found in facts.keys or facts.parameter.type == "text"
        if not facts.own_range or facts.parameter.type == "bits":
            return False
        key = (address[0], value.unit)
        span = self._spans.get(key)
        if span is None:
            span = self._spans[key] = _span(limits(self._file.evaluation, address, value.unit))
        return span[0] <= found <= span[1]

    def _finding(self, address: Address, value: Value, text: str, fixed: Value | None) -> Finding:
        """Return the error about a value; ``fixed`` is its fix if it differs and no secret is set."""
        parameter = self._facts[address[0]].parameter
        allowed = fixed is not None and fixed != value
        allowed = allowed and not parameter.secret  # a password that no user chose locks all of them out
        fix = (AddressedValue(address, fixed),) if fixed is not None and allowed else ()
        forced = (
            f" It was forced {with_local_times(self._file.forced[address])}."
            if address in self._file.forced
            else ""
        )
        kind = "schema.choice" if parameter.choices else "schema.range"
        return Finding(
            kind,
            "error",
            (address,),
            text + "." + forced,
            fix,
            parameter.page,
            compared=bounding(self._file.evaluation, address, value),
        )


def _setter_of_bound(allowed: Limits, number: float) -> Address | None:
    """Return the parameter that sets the bound which a number is beyond; None where it is printed."""
    is_low = allowed.low is not None and number < allowed.low
    return allowed.low_from if is_low else allowed.high_from


def _span(allowed: Limits | None) -> tuple[float, float]:
    """Return both bounds, infinite where there is none."""
    low, high = (allowed.low, allowed.high) if allowed else (None, None)
    return -math.inf if low is None else low, math.inf if high is None else high


def _is_near(value: Value, bound: Value) -> bool:
    """Return whether a number misses a printed bound by so little that the bound is what was meant."""
    if isinstance(value.value, str) or isinstance(bound.value, str) or not math.isfinite(value.value):
        return False
    return abs(value.value - bound.value) <= _NEAR * abs(bound.value)


def _rounded_inwards(parameter: Parameter, value: Value, allowed: Limits | None) -> Value:
    """Return a bound with the decimals that the parameter takes;
    one that came from another unit may have more.
    """
    decimals, number = parameter.decimals, value.value
    if allowed is None or decimals is None or not isinstance(number, float) or not math.isfinite(number):
        return value
    # The decimals that are printed are those of the printed unit.
    if parameter.ranges and value.unit not in parameter.ranges:
        return value
    if abs(number) > 2**53:  # a double so large is a whole number, and has more digits than a decimal
        return value
    towards = ROUND_FLOOR if number == allowed.high else ROUND_CEILING
    return Value(float(Decimal(repr(number)).quantize(Decimal(1).scaleb(-decimals), towards)), value.unit)


def _bounds(parameter: Parameter, other: str) -> bool:
    """Return whether a parameter is itself bounded by another one."""
    ranges = [
        *(parameter.ranges or {}).values(),
        *(r for v in parameter.range_variants for r in v.ranges.values()),
    ]
    return any(isinstance(bound, BoundRef) and bound.param == other for pair in ranges for bound in pair)


def _measures_right(facts: _Facts, value: Value, turns: bool) -> bool:
    """Return whether a number is in degrees where the axis turns, in a length where it does not, and so
    on.
    """
    if isinstance(value.value, (str, bool)):
        return True
    return dimension(value.unit) in (facts.turning if turns and facts.turning else facts.measures)
