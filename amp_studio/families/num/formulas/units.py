"""The internal measurement unit, in which the CNC stores its dimensions: page 4-18.

Word P4N2 sets it for linear axes and word P4N4 for rotary axes. A change of either gives another meaning to
every dimension among the machine parameters. The sizes are facts:
``scales`` of ``parameter_db/num/family.yaml``.
"""

from __future__ import annotations

from functools import lru_cache

from amp_studio.schema import Value, load_schema, unit_size

_LARGEST_COUNT = 1e8
"""Internal units in the longest travel: 10 km at 0.1 mm, 1 m at 0.00001 mm (page 4-18)."""


@lru_cache(maxsize=100)
def _size(number: float, *, turns: bool) -> float | None:
    """Return the size of an internal unit, in mm or degrees, with a number in P4N2 or P4N4;
    None for no such number.
    """
    scale = load_schema("num").family.scales["iu"]
    found = unit_size((scale.angle or scale.length) if turns else scale.length, Value(number))
    return float(found[0]) if found else None


def internal_unit_mm(decimals: float) -> float:
    """Internal unit of linear axes in mm by the number of decimals in P4N2 (page 4-18).

    1 gives 0.1 mm, 3 gives 0.001 mm, 5 gives 0.00001 mm. The control takes any other number for 3.
    """
    size = _size(decimals, turns=False)
    assert size is not None
    return size


def largest_travel_mm(decimals: float) -> float:
    """Longest travel of a machine in mm by the number of decimals in P4N2 (page 4-18):
    100 m with micrometres.
    """
    return round(_LARGEST_COUNT * internal_unit_mm(decimals), 6)


def rotary_unit_deg(divider: float) -> float:
    """Internal unit of rotary axes in degrees by P4N4 (page 4-18): 0 and 4 give 0.0001 degrees, 1 gives
    0.1.
    """
    size = _size(divider, turns=True)
    if size is None:
        raise ValueError(f"P4N4 is 0 to 4, not {divider:g}.")
    return size


def to_internal(length: float, unit: float) -> float:
    """Number of internal units, each ``unit`` long, in a length or angle (page 4-18):
    5 mm are 50000 of 0.0001 mm.
    """
    if not unit > 0.0:
        raise ValueError(f"An internal unit is longer than nothing, not {unit:g}.")
    # Rounded: 0.3 mm of 0.1 mm are 3 units, and not a hair less.
    return round(length / unit, 6)


def from_internal(number: float, unit: float) -> float:
    """Length or angle of a number of internal units, each ``unit`` long (page 4-18):
    6600 of 0.001 mm are 6.6 mm.
    """
    if not unit > 0.0:
        raise ValueError(f"An internal unit is longer than nothing, not {unit:g}.")
    return round(number * unit, 9)


def servo_coefficient(unit: float) -> float:
    """Coefficient k of the formulas for P21 and P23 (pages 6-15 and 6-23):
    the internal unit over one thousandth.

    100 with 0.1 mm, 1 with micrometres, 0.1 with ten-thousandths of a degree.
    """
    if not unit > 0.0:
        raise ValueError(f"An internal unit is longer than nothing, not {unit:g}.")
    return round(unit / 0.001, 9)
