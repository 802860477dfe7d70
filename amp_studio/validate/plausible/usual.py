"""One value against what it usually is: a range of experience where the manual prints none,
and a sign that makes no sense.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from functools import lru_cache

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    Address,
    Parameter,
    Remembered,
    Schema,
    Usual,
    Value,
    canonical,
    convert,
    dimension,
    show_value,
    unit_text,
    write_figure,
)
from amp_studio.validate.finding import Finding

from .slip import MIN_DIGITS, significant_digits, slip_of_default

USUAL = "plausible.usual"
REASON = "ours, not the manual's: what the parameter usually is, or can mean"
_NEVER_NEGATIVE = frozenset(
    {
        "velocity",
        "angular velocity",
        "acceleration",
        "angular acceleration",
        "rotary acceleration",
        "jerk",
        "angular jerk",
        "time",
        "frequency",
        "resolution",
        "power",
        "memory",
        "gain",
        "integral gain",
        "derivative gain",
        "acceleration gain",
        "percent",
    }
)
"""Dimensions of which nothing is ever less than zero, where the manual does not say so."""


@dataclass(frozen=True, slots=True)
class _Known:
    """What is usual of one parameter."""

    parameter: Parameter
    usual: Usual | None
    spans: dict[str, tuple[float, float]]
    """Dimension -> least and greatest usual value, in its canonical unit."""
    signed: bool
    """Whether a negative value may mean something, or is an error by itself."""
    default: float | None
    """The printed default, in the canonical unit of ``default_measures``;
    None where it has too few digits to know a slip by."""
    default_measures: str
    default_digits: int
    fine: Remembered = field(default_factory=Remembered, repr=False)
    """Numbers with their units that nothing is asked about, in whatever file."""


@lru_cache(maxsize=32)
def _facts(schema: Schema) -> dict[str, _Known]:
    usual = schema.plausible.usual
    return {
        parameter.id: known
        for parameter in schema.parameters.values()
        if _is_entered(parameter, usual.get(parameter.id))
        if (known := _known(parameter, usual.get(parameter.id)))
    }


def _is_entered(parameter: Parameter, usual: Usual | None) -> bool:
    """Return whether a parameter is a number, or a choice of which some are usual, and can be entered."""
    can_be_compared = parameter.type in ("integer", "real") or (
        usual is not None and bool(usual.choices or usual.bits)
    )
    return can_be_compared and not parameter.secret and parameter.access != "read"


def _known(parameter: Parameter, usual: Usual | None) -> _Known | None:
    """Return what is usual of a parameter; None where nothing is."""
    between = usual.between if usual else {}
    spans = {dimension(unit): (canonical(a, unit), canonical(b, unit)) for unit, (a, b) in between.items()}
    signed = _is_signed(parameter, between)
    measures, number, digits = _printed_default(parameter)
    if usual or not signed or digits >= 2:
        return _Known(parameter, usual, spans, signed, number if digits >= 2 else None, measures, digits)
    return None


def _is_signed(parameter: Parameter, usual: Mapping[str, tuple[float, float]]) -> bool:
    """Return whether the manual prints a least value or a negative default, or one is usual."""
    default = parameter.default.value if parameter.default else 0
    if parameter.range_variants or (isinstance(default, (int, float)) and default < 0):
        return True
    printed = any(low is not None for low, _ in (parameter.ranges or {}).values())
    return printed or any(low < 0 for low, _ in usual.values())


def _printed_default(parameter: Parameter) -> tuple[str, float, int]:
    """Return dimension, number and significant digits of the one default; no digits without one."""
    default = parameter.default
    if default is None:
        return "", 0.0, 0
    measures = dimension(default.unit)
    # Where instances have different defaults no slip of one can be known.
    if default.instances or not isinstance(default.value, (int, float)):
        return measures, 0.0, 0
    return measures, canonical(default.value, default.unit), significant_digits(default.value)


class UsualValues:
    """The values of one file that are not as they usually are."""

    def __init__(self, file: ParameterFile) -> None:
        self._file = file
        self._facts = _facts(file.schema)
        self._findings: dict[Address, Finding] = {}

    def check_all(self) -> None:
        """Look at every value."""
        self._findings.clear()
        facts, state = self._facts, self._file.evaluation.state
        for address, value in self._file.values.items():
            known = facts.get(address[0])
            # Most files have the same few values: what was found fine once is not worked out again.
            if known is None or (value.value, value.unit) in known.fine:
                continue
            what = _doubt(known, value)
            if not what:
                known.fine[value.value, value.unit] = True
            if what and state(address).is_active:
                self._findings[address] = self._finding(known, address, value, what)

    def recheck(self, address: Address) -> bool:
        """Look at one value again; returns whether anything is otherwise."""
        facts = self._facts.get(address[0])
        if facts is None:
            return False
        before = self._findings.pop(address, None)
        value = self._file.values.get(address)
        if value is not None:
            what = _doubt(facts, value)
            if what and self._file.evaluation.state(address).is_active:
                self._findings[address] = self._finding(facts, address, value, what)
        return self._findings.get(address) != before

    def findings(self) -> Iterator[Finding]:
        """Yield what was found."""
        yield from self._findings.values()

    def _finding(self, facts: _Known, address: Address, value: Value, what: str) -> Finding:
        label = self._file.schema.on(self._file.machine).label(address)
        message = f"{label} is {show_value(facts.parameter, value)}; {what}. Is it meant?"
        return Finding(USUAL, "advice", (address,), message, reason=REASON)


def _not_usual(facts: _Known, usual: Usual, number: float, unit: str) -> str:
    """Return what is usual instead of a number; "" where it is one of the usual."""
    if usual.bits:
        return _doubt_of_bits(usual, int(number))
    # Values outside of the span with a meaning, as 0 for off.
    if number in usual.also:
        return ""
    if usual.among:
        return "" if number in usual.among else f"usual are {', '.join(map(write_figure, usual.among))}"
    measures = dimension(unit)
    span = facts.spans.get(measures)
    if span is None or span[0] <= canonical(number, unit) <= span[1]:
        return ""
    printed, bounds = next((u, b) for u, b in usual.between.items() if dimension(u) == measures)
    low, high = (_in_unit(bound, printed, unit) for bound in bounds)
    return f"usual is {write_figure(low)} to {write_figure(high)} {unit_text(unit)}".rstrip()


def _in_unit(bound: float, printed: str, unit: str) -> float:
    """Return a bound in another unit, with the two digits that such a bound has."""
    return bound if unit == printed else float(f"{convert(bound, printed, unit):.2g}")


def _doubt(facts: _Known, value: Value) -> str:
    """Return what is unusual about a number, in words; "" for nothing."""
    usual = facts.usual
    if isinstance(value.value, (bool, str)):
        return _doubt_of_choice(facts.parameter, usual, value.value) if usual is not None else ""
    number = float(value.value)
    measures = dimension(value.unit)
    if usual is not None and (words := _not_usual(facts, usual, number, value.unit)):
        return words
    if facts.default is not None and (words := _slip_of_default(facts, facts.default, number, value.unit)):
        return f"that is {words} the printed default"
    if number < 0 and not facts.signed and measures in _NEVER_NEGATIVE:
        return f"a negative {measures} has no meaning"
    return ""


def _is_as_round(facts: _Known, number: float, unit: str) -> bool:
    """Return whether a number in another unit is as round as the printed default: 150 mm/s2 is chosen in a
    metric file, as 150 in/s2 was for an inch one.
    """
    default = facts.parameter.default
    return default is not None and unit != default.unit and significant_digits(number) <= facts.default_digits


def _doubt_of_bits(usual: Usual, word: int) -> str:
    """Return which bits of a word are set without a known meaning, in words; "" for none."""
    unknown = [str(bit) for bit in range(word.bit_length()) if word >> bit & 1 and bit not in usual.bits]
    if not unknown:
        return ""
    are = "bits {} have" if len(unknown) > 1 else "bit {} has"
    return f"{are.format(', '.join(unknown))} no meaning that is printed or known"


def _slip_of_default(facts: _Known, default: float, number: float, entered: str) -> str:
    """Return by what slip a number in a unit would be the printed default; "" for none."""
    unit = entered
    if dimension(unit) != facts.default_measures and facts.default_digits >= MIN_DIGITS:
        unit = unit.replace("deg", "mm")  # the manual prints one number for linear and rotary axes
    if dimension(unit) != facts.default_measures:
        return ""
    words = slip_of_default(canonical(number, unit), default, facts.default_digits)
    # The factor of an inch alone may be a choice of a round figure in the other unit system.
    return "" if "25.4" in words and _is_as_round(facts, number, entered) else words


def _doubt_of_choice(parameter: Parameter, usual: Usual, value: bool | str) -> str:
    """Return what is unusual about a choice, in words; "" for nothing."""
    key = ("yes" if value else "no") if isinstance(value, bool) else value
    if not usual.choices or key in usual.choices:
        return ""
    return f"usual is {' or '.join(c.label for c in parameter.choices or () if c.key in usual.choices)}"
