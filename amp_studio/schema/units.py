"""Units of entry, and the canonical unit of each quantity.

Rules compare in the canonical unit (mm, deg, mm/min, ms, …); a value keeps the
unit it was entered in. Factors are exact: an inch is 25.4 mm by definition.
"""

from __future__ import annotations

import math
from decimal import Decimal
from fractions import Fraction
from functools import cache, lru_cache

from .quoting import quoted

_ONE = Fraction(1)

# unit -> (dimension, factor to the canonical unit of the dimension)
UNITS: dict[str, tuple[str, Fraction]] = {
    "": ("", _ONE),
    "mm": ("length", _ONE),
    "in": ("length", Fraction(254, 10)),
    "um": ("length", Fraction(1, 1000)),
    "deg": ("angle", _ONE),
    "mm/min": ("velocity", _ONE),
    "in/min": ("velocity", Fraction(254, 10)),
    "mm/s": ("velocity", Fraction(60)),
    "in/s": ("velocity", Fraction(1524)),
    "deg/min": ("angular velocity", _ONE),
    "deg/s": ("angular velocity", Fraction(60)),
    "mm/s2": ("acceleration", _ONE),
    "in/s2": ("acceleration", Fraction(254, 10)),
    "mm/min/s": ("acceleration", Fraction(1, 60)),
    "in/min/s": ("acceleration", Fraction(254, 600)),
    "deg/s2": ("angular acceleration", _ONE),
    "deg/min/s": ("angular acceleration", Fraction(1, 60)),
    "mm/s3": ("jerk", _ONE),
    "in/s3": ("jerk", Fraction(254, 10)),
    "deg/s3": ("angular jerk", _ONE),
    "ms": ("time", _ONE),
    "s": ("time", Fraction(1000)),
    "us": ("time", Fraction(1, 1000)),
    "ms/100": ("time", Fraction(1, 100)),
    "%": ("percent", _ONE),
    "V": ("voltage", _ONE),
    "mV": ("voltage", Fraction(1, 1000)),
    "A": ("current", _ONE),
    "Hz": ("frequency", _ONE),
    "rpm": ("rotation", _ONE),
    "rev/s2": ("rotary acceleration", _ONE),
    "rpm/rev": ("rotation per turn", _ONE),
    "kbytes": ("memory", _ONE),
    "counts": ("counts", _ONE),
    "counts/s": ("count rate", _ONE),
    "counts/s2": ("count acceleration", _ONE),
    "counts/mm": ("resolution", _ONE),
    "counts/in": ("resolution", Fraction(10, 254)),
    "W": ("power", _ONE),
    # An arc is no angle here: a degree is no exact number of radians.
    "rad": ("arc", _ONE),
    # The gains of a loop from counts of following error to volts: proportional, integral, and with the rate of change
    # of the error or the speed, and with the acceleration, in counts.
    "V/count": ("gain", _ONE),
    "V/count/s": ("integral gain", _ONE),
    "Vs/count": ("derivative gain", _ONE),
    "Vs2/count": ("acceleration gain", _ONE),
    "V/rpm": ("voltage per speed", _ONE),
    # What the control counts a dimension in; another parameter sets how long one is (NUM P4).
    "iu": ("internal units", _ONE),
    "um/sample": ("travel per sample", _ONE),
    "BLU": ("basic length unit", _ONE),
    "LIU": ("least input unit", _ONE),
    "pulse/rev": ("pulses per turn", _ONE),
}

# How people write them.
ALIASES: dict[str, str] = {
    "inch": "in", "inches": "in", "in.": "in", '"': "in", "millimeter": "mm", "millimeters": "mm",
    "degree": "deg", "degrees": "deg", "°": "deg", "mmpm": "mm/min", "mm/m": "mm/min", "ipm": "in/min",
    "inch/min": "in/min", "dpm": "deg/min", "mm/sec": "mm/s", "in/sec": "in/s", "inch/sec": "in/s",
    "deg/sec": "deg/s", "ips": "in/s", "mm/s/s": "mm/s2", "mm/sec/sec": "mm/s2", "mm/s²": "mm/s2",
    "mm/sec2": "mm/s2", "in/s/s": "in/s2", "in/sec/sec": "in/s2", "inch/sec/sec": "in/s2", "in/s²": "in/s2",
    "deg/s/s": "deg/s2", "deg/sec/sec": "deg/s2", "deg/s²": "deg/s2", "mm/min/sec": "mm/min/s",
    "in/min/sec": "in/min/s", "mm/s/s/s": "mm/s3", "mm/sec/sec/sec": "mm/s3", "mm/s³": "mm/s3",
    "in/s/s/s": "in/s3", "in/sec/sec/sec": "in/s3", "in/s³": "in/s3", "deg/s/s/s": "deg/s3",
    "deg/sec/sec/sec": "deg/s3", "deg/s³": "deg/s3", "msec": "ms", "sec": "s", "second": "s", "seconds": "s",
    "µm": "um", "μm": "um", "micron": "um", "microns": "um", "µs": "us", "μs": "us", "usec": "us",
    "counts/sec": "counts/s", "cts/s": "counts/s", "counts/s/s": "counts/s2", "counts/sec/sec": "counts/s2",
    "percent": "%", "volt": "V", "volts": "V", "v": "V", "mv": "mV", "amp": "A", "amps": "A", "a": "A", "hz": "Hz",
    "r/min": "rpm", "1/min": "rpm", "rev/s/s": "rev/s2", "internalunit": "iu", "internalunits": "iu",
    "µm/sample": "um/sample", "μm/sample": "um/sample", "µm/smp": "um/sample",
    "counts/inch": "counts/in", "radian": "rad", "radians": "rad", "volts/rpm": "V/rpm", "v/rpm": "V/rpm",
    "v/count": "V/count", "v/pulse": "V/count", "v/count/s": "V/count/s", "v/s/count": "V/count/s", "vs/count": "Vs/count",
    "v·s/count": "Vs/count", "vs2/count": "Vs2/count", "v·s²/count": "Vs2/count",
    "count": "counts", "cts": "counts", "watt": "W", "w": "W", "teeth": "",
    "blu": "BLU", "liu": "LIU", "pulses/rev": "pulse/rev",
}  # fmt: skip

SHOWN: dict[str, str] = {"mm/s2": "mm/s²", "in/s2": "in/s²", "deg/s2": "deg/s²", "mm/s3": "mm/s³",
                         "in/s3": "in/s³", "deg/s3": "deg/s³", "deg": "°", "um": "µm", "us": "µs", "counts/s2": "counts/s²",
                         "rev/s2": "rev/s²", "um/sample": "µm/sample", "Vs/count": "V·s/count", "Vs2/count": "V·s²/count"}  # fmt: skip

_SIGNS = {sign: unit for unit, sign in SHOWN.items()}


class UnitError(ValueError):
    """A unit that is not known, or does not measure what is asked for."""


def define_unit(unit: str, measures: str, factor: Fraction) -> None:
    """Make a unit known that only one family has: what it measures, and the factor to the canonical unit of that.

    Raises UnitError for one that is known already with another meaning, and for a dimension without a canonical unit.
    """
    meaning = (measures, _ONE if factor == 1 else factor)
    known = UNITS.get(unit)
    if known is None and ALIASES.get(unit, ALIASES.get(unit.lower())) is not None:
        raise UnitError(f"{quoted(unit)} is how people write {ALIASES.get(unit, ALIASES.get(unit.lower()))}")
    if known is not None and known != meaning:
        raise UnitError(
            f"{quoted(unit)} measures {known[0] or 'nothing'} already, with the factor {known[1]}"
        )
    if factor <= 0:
        raise UnitError(f"the factor of {quoted(unit)} is {factor}: it must be above 0")
    if factor != 1 and (measures, _ONE) not in UNITS.values():
        raise UnitError(f"no unit of {measures} has the factor 1, which {quoted(unit)} could be converted to")
    UNITS[unit] = meaning


def unit_named(text: str) -> str:
    """Return the unit a person wrote in any of its usual spellings; raises UnitError."""
    word = text.strip().replace(" ", "")
    if word in UNITS:
        return word
    word = _SIGNS.get(word, word)
    unit = word if word in UNITS else ALIASES.get(word, ALIASES.get(word.lower()))
    if unit is None:
        unit = word.lower() if word.lower() in UNITS else None
    if unit is None:
        raise UnitError(f"{quoted(text.strip())} is not a unit")
    return unit


def dimension(unit: str) -> str:
    """Return what a unit measures (``length``, ``angular velocity``, …)."""
    return UNITS[unit][0]


def canonical(value: float, unit: str) -> float:
    """Return ``value`` in the canonical unit of its dimension, exact before one rounding: 0.3 in is 7.62 mm."""
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
    """Return the double nearest to the exact product; infinite where no double is that large, no number as it is.

    Without ``to`` it is the canonical unit.
    """
    if math.isnan(value):
        return value
    factor = UNITS[unit][1] / (UNITS[to][1] if to is not None else 1)
    try:
        return float(Fraction(Decimal(repr(float(value)))) * factor)
    except OverflowError:
        return math.copysign(math.inf, value)


@cache
def canonical_unit(unit: str) -> str:
    """Return the canonical unit of the dimension of ``unit``."""
    measured = UNITS[unit][0]
    return next(u for u, (d, f) in UNITS.items() if d == measured and f == 1)


def angular(unit: str) -> str:
    """Return the unit in degrees used when an axis turns (mm/min and in/min give deg/min)."""
    head, _, tail = unit.partition("/")
    if head in ("mm", "in"):
        return "deg/" + tail if tail else "deg"
    return unit


def shown(unit: str) -> str:
    """Return the unit as it is shown to a person."""
    return SHOWN.get(unit, unit)
