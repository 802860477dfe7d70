"""What the masks say of an axis. ``axes`` are the letters of the build in order (``XYZA``),
``axis`` is one of them.
"""

from __future__ import annotations


def axis_place(axes: str, axis: str) -> float:
    """The bit of an axis in a mask (S640): Z of XYZ has bit 2.
    An axis that the build does not have has none, -1.
    """
    return float(axes.find(axis.upper()))


def mask_end(axes: str) -> float:
    """The first number that is too large for a mask of axes (S3275): 8 for XYZ."""
    return float(2 ** len(axes))


def rotary_end(axes: str) -> float:
    """The first number that is too large for a mask of rotary axes, which begins with the fourth (S467):
    4 for XYZAB.
    """
    return float(2 ** max(0, len(axes) - 3))


def homing_phases(
    axes: str,
    axis: str,
    first: float | None,
    second: float | None = None,
    third: float | None = None,
    fourth: float | None = None,
    fifth: float | None = None,
    sixth: float | None = None,
) -> float:
    """How many phases home an axis (M940): Z of XYZ with the phases 4, 3 and 0 is homed in one."""
    place = int(axis_place(axes, axis))
    phases = [phase for phase in (first, second, third, fourth, fifth, sixth) if phase is not None]
    return 0.0 if place < 0 else float(sum(int(phase) >> place & 1 for phase in phases))


def is_turning(axes: str, axis: str, rotary: float | None) -> bool:
    """Whether an axis is in the mask of the rotary axes, which begins with the fourth (S1322):
    A of XYZA with 1 is one.
    """
    place = int(axis_place(axes, axis))
    return rotary is not None and place >= 3 and bool(int(rotary) >> place - 3 & 1)
