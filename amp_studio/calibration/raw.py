"""What a file of measured points contains, before units and sign are applied."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class RawRun:
    """One pass as the file has it: target and figure, in the units of the file."""

    rising: bool | None
    points: tuple[tuple[Fraction, Fraction], ...]


@dataclass(frozen=True)
class RawTable:
    """What a file contains, before units and sign are applied.

    ``is_circle``  positions are angles of a circle and the figures its radius less the nominal one: a
                   ball-bar
    ``kind`` of the figures: measured, error or correction;
    ``unit`` and ``error_unit`` as far as the file names them.
    """

    runs: tuple[RawRun, ...]
    kind: str
    unit: str = ""
    error_unit: str = ""
    notes: tuple[str, ...] = ()
    is_circle: bool = False
