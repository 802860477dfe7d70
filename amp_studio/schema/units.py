"""Units of entry, and the canonical unit of each quantity.

Rules compare in the canonical unit (mm, deg, mm/min, ms, …); a value keeps the
unit it was entered in. Factors are exact: an inch is 25.4 mm by definition.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from decimal import Decimal
from fractions import Fraction
from functools import cache, lru_cache
from pathlib import Path
from typing import Any

from amp_studio.errors import AmpStudioError

from .compiled_cache import cached_data
from .folder import database_folder
from .quoting import quoted
from .yaml_reader import read_yaml, text_scalar

_ONE = Fraction(1)

UNITS_FILE = database_folder() / "units.yaml"
"""The units that every family may use."""

UNITS: dict[str, tuple[str, Fraction]] = {}
"""Unit -> what it measures, and the factor to the canonical unit of that."""
ALIASES: dict[str, str] = {}
"""How people write them -> the unit."""
_SHOWN: dict[str, str] = {}
"""Unit -> how it is shown, if that is otherwise than it is written."""


class UnitError(AmpStudioError, ValueError):
    """A unit that is not known, or does not measure what is asked for."""


def _check_unit(unit: str, meaning: tuple[str, Fraction]) -> None:
    """Raise UnitError for a unit that is known with another meaning, and for one without a canonical unit."""
    known = UNITS.get(unit)
    if known is None and (other := _alias(unit)) is not None:
        raise UnitError(f"{quoted(unit)} is how people write {other}")
    if known is not None and known != meaning:
        raise UnitError(
            f"{quoted(unit)} measures {known[0] or 'nothing'} already, with the factor {known[1]}"
        )
    measures, factor = meaning
    if factor <= 0:
        raise UnitError(f"the factor of {quoted(unit)} is {factor}: it must be above 0")
    if factor != 1 and (measures, _ONE) not in UNITS.values():
        raise UnitError(f"no unit of {measures} has the factor 1, which {quoted(unit)} could be converted to")


def define_unit(
    unit: str, measures: str, factor: Fraction, display: str = "", also: Iterable[str] = ()
) -> None:
    """Make a unit known: what it measures, the factor to the canonical unit of that, and how people write it.

    Raises UnitError for one that is known already with another meaning,
    and for a dimension without a canonical unit.
    """
    # The one object by which ``canonical`` knows that there is nothing to convert.
    meaning = (measures, _ONE if factor == 1 else factor)
    _check_unit(unit, meaning)
    for text in (*also, display):
        if text and (UNITS.keys() & {text} - {unit} or _alias(text) not in (None, unit)):
            raise UnitError(f"{quoted(text)} is how people write {_alias(text) or text} already")
    UNITS[unit] = meaning
    ALIASES.update(dict.fromkeys(also, unit))
    if display:
        _SHOWN[unit] = display
        ALIASES.setdefault(display, unit)


def _alias(text: str) -> str | None:
    return ALIASES.get(text, ALIASES.get(text.lower()))


def _read_units() -> Any:
    return read_yaml(UNITS_FILE.read_text(encoding="utf-8"), text_scalar).data["units"]


def _define_all() -> None:
    """Make the units of the file known."""
    entries: dict[str, dict[str, Any]] = cached_data("_units", (UNITS_FILE, Path(__file__)), _read_units)
    for unit, entry in entries.items():
        factor = Fraction(entry.get("factor", "1"))
        define_unit(unit, entry["measures"], factor, entry.get("shown", ""), entry.get("also", ()))


_define_all()


def unit_named(text: str) -> str:
    """Return the unit a person wrote in any of its usual spellings; raises UnitError."""
    word = text.strip().replace(" ", "")
    if word in UNITS:
        return word
    unit = _alias(word)
    if unit is None:
        # Case is forgiven only where the text as it is written is no unit.
        unit = word.lower() if word.lower() in UNITS else None
    if unit is None:
        raise UnitError(f"{quoted(text.strip())} is not a unit")
    return unit


def dimension(unit: str) -> str:
    """Return what a unit measures (``length``, ``angular velocity``, …)."""
    return UNITS[unit][0]


def canonical(value: float, unit: str) -> float:
    """Return ``value`` in the canonical unit of its dimension, exact before one rounding: 0.3 in is 7.62
    mm.
    """
    # By identity: define_unit stores this one object, and comparing fractions takes longer than the
    # conversion of most values, which is none.
    return float(value) if UNITS[unit][1] is _ONE else _converted(value, unit, None)


def convert(value: float, unit: str, to: str) -> float:
    """Return ``value`` in another unit of the same dimension, exact before one rounding; raises UnitError."""
    if unit == to:
        return value
    if UNITS[unit][0] != UNITS[to][0]:
        raise UnitError(f"{unit or 'a bare number'} cannot be given in {to or 'a bare number'}")
    return _converted(value, unit, to)


@lru_cache(maxsize=10_000)  # exact and slow; the same bounds and values come up again and again
def _converted(value: float, unit: str, to: str | None) -> float:
    """Return the double nearest to the exact product; infinite where no double is that large,
    no number as it is.

    Without ``to`` it is the canonical unit.
    """
    if math.isnan(value):
        return value
    factor = UNITS[unit][1] / (UNITS[to][1] if to is not None else 1)
    try:
        # By the digits that were typed, not by the double beside them: 0.3 in is 7.62 mm.
        return float(Fraction(Decimal(repr(float(value)))) * factor)
    except OverflowError:
        return math.copysign(math.inf, value)


@cache
def canonical_unit(unit: str) -> str:
    """Return the canonical unit of the dimension of ``unit``."""
    measured = UNITS[unit][0]
    # The first in the file, where several have the factor 1: it decides in which unit rules compare.
    return next(u for u, (d, f) in UNITS.items() if d == measured and f == 1)


def angular(unit: str) -> str:
    """Return the unit in degrees used when an axis turns (mm/min gives deg/min,
    steps/mm steps/deg if there is that).
    """
    head, _, tail = unit.partition("/")
    if head in ("mm", "in"):
        return "deg/" + tail if tail else "deg"
    return f"{head}/deg" if tail in ("mm", "in") and f"{head}/deg" in UNITS else unit


def unit_text(unit: str) -> str:
    """Return the unit as it is shown to a person."""
    return _SHOWN.get(unit, unit)
