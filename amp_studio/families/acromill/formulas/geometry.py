"""Tool radius and the ends of lines: the Offsets menu and the Control tab."""

from __future__ import annotations

import re

from amp_studio.validate import finite, not_negative


def compensated_radius(geometric: float, wear: float) -> float:
    """Radius the cutter compensation works with: R Offset plus its wear, always (page 85)."""
    return finite("The radius", geometric) + finite("The wear", wear)


def is_joined(distance: float, epsilon: float) -> bool:
    """Whether two ends count as joined: not farther apart than Epsilon for Compensation (pages 61 and 104).

    The example of page 61 calls 0.0007 inch less than 0.0001 inch;
    by the words of the parameter it is not joined.
    """
    return not_negative("The distance", distance) <= not_negative("Epsilon", epsilon)


def largest_position(display_format: str) -> float:
    """Figure below which a position must stay to be shown (page 79): 3.6 has three digits in front, so
    1000.
    """
    digits = re.fullmatch(r"(\d)\.(\d+)", display_format)
    if digits is None:
        raise ValueError(f"{display_format!r} is no format such as 3.4.")
    return 10.0 ** int(digits[1])
