"""The ballscrew table as a curve: a compensation at each whole position from home on (page 107)."""

from __future__ import annotations

from collections.abc import Sequence

from amp_studio.drawing import Point
from amp_studio.pictures import CurveText

from .formulas.ballscrew import ballscrew_words, is_ballscrew_table


def read(letter: str, text: str) -> list[Point]:
    """Return the points of a table; raises ValueError where it is none."""
    if not is_ballscrew_table(letter, text):
        raise ValueError(
            f"this is no table of axis {letter}: {letter}0E.00325 {letter}1E.00175 and so on (page 107)"
        )
    return [(float(n), float(word.partition("E")[2])) for n, word in enumerate(text.split())]


def write(letter: str, points: Sequence[Point], _text: str, _unit: str) -> str:
    """Return the words of points; raises ValueError for a compensation of 1 and more,
    for which no form is printed.
    """
    return ballscrew_words(letter, [compensation for _, compensation in points], 0)


def put_in(points: Sequence[Point], at: Point) -> list[Point]:
    """Return a table with one more position; raises ValueError where every position has its word already."""
    if at[0] < len(points) - 0.5:
        raise ValueError(
            "Each whole position has its point already: only the next one behind the last can be put in"
        )
    return [*points, (float(len(points)), at[1])]


def remove_point(points: Sequence[Point], index: int) -> list[Point]:
    """Return a table without its last position; raises ValueError for any other: a table has no gaps."""
    if index != len(points) - 1 or not index:
        raise ValueError(
            "Only the last of several positions can be taken out: a table has no gaps (page 107)"
        )
    return list(points[:-1])


CURVE = CurveText(read, write, lambda _text: "", put_in, remove_point, grain=0.00001)
