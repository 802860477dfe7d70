"""The internal measurement unit, in which the CNC stores its dimensions: page 4-18.

Word P4N2 sets it for linear axes and word P4N4 for rotary axes. A change of either gives another meaning to every
dimension among the machine parameters.
"""

from __future__ import annotations

_LINEAR = {1.0: (0.1, 1e7), 2.0: (0.01, 1e6), 3.0: (0.001, 1e5), 4.0: (0.0001, 1e4), 5.0: (0.00001, 1e3)}
"""P4N2 -> the unit and the largest travel, both in mm (page 4-18)."""
_ROTARY = {0.0: 0.0001, 1.0: 0.1, 2.0: 0.01, 3.0: 0.001, 4.0: 0.0001}
"""P4N4 -> the unit in degrees (page 4-18)."""


def internal_unit_mm(decimals: float) -> float:
    """Internal unit of linear axes in mm by the number of decimals in P4N2 (page 4-18).

    1 gives 0.1 mm, 3 gives 0.001 mm, 5 gives 0.00001 mm. The control takes any other number for 3.
    """
    return _LINEAR.get(decimals, _LINEAR[3.0])[0]


def largest_travel_mm(decimals: float) -> float:
    """Longest travel of a machine in mm by the number of decimals in P4N2 (page 4-18): 100 m with micrometres."""
    return _LINEAR.get(decimals, _LINEAR[3.0])[1]


def rotary_unit_deg(divider: float) -> float:
    """Internal unit of rotary axes in degrees by P4N4 (page 4-18): 0 and 4 give 0.0001 degrees, 1 gives 0.1."""
    try:
        return _ROTARY[divider]
    except KeyError:
        raise ValueError(f"P4N4 is 0 to 4, not {divider:g}.") from None


def to_internal(length: float, unit: float) -> float:
    """Number of internal units, each ``unit`` long, in a length or angle (page 4-18): 5 mm are 50000 of 0.0001 mm."""
    if not unit > 0.0:
        raise ValueError(f"An internal unit is longer than nothing, not {unit:g}.")
    return round(length / unit, 6)


def from_internal(number: float, unit: float) -> float:
    """Length or angle of a number of internal units, each ``unit`` long (page 4-18): 6600 of 0.001 mm are 6.6 mm."""
    if not unit > 0.0:
        raise ValueError(f"An internal unit is longer than nothing, not {unit:g}.")
    return round(number * unit, 9)


def servo_coefficient(unit: float) -> float:
    """Coefficient k of the formulas for P21 and P23 (pages 6-15 and 6-23): the internal unit over one thousandth.

    100 with 0.1 mm, 1 with micrometres, 0.1 with ten-thousandths of a degree.
    """
    if not unit > 0.0:
        raise ValueError(f"An internal unit is longer than nothing, not {unit:g}.")
    return round(unit / 0.001, 9)
