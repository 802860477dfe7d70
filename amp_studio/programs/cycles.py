"""The moves of a drilling cycle from its printed steps."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from .words import ProgramBlockError

MOST_PECKS = 10_000


@dataclass
class CycleWords:
    """What a cycle keeps from block to block; lengths in mm, the dwell in s."""

    depth: float | None = None
    level: float | None = None
    peck: float | None = None
    dwell: float | None = None


@dataclass(frozen=True)
class CycleMove:
    """One move or dwell."""

    to: float | None = None
    """Along the axis of the tool."""
    is_rapid: bool = False
    shift: float | None = None
    """In X."""
    seconds: float | None = None


def cycle_moves(
    steps: Sequence[str],
    initial: float,
    level: float,
    depth: float,
    words: CycleWords,
    clearance: float | str,
    retract: float | str,
    *,
    to_initial: bool,
) -> Iterator[CycleMove]:
    """Yield what a cycle does at its hole; ``clearance``, ``retract`` are lengths, or why there is none.
    Raises ProgramBlockError for a word or a length that is missing.
    """
    back = initial if to_initial else level
    for n, step in enumerate(steps):
        if step == "rapid to R" and n < 2:
            yield CycleMove(level, is_rapid=True)
        elif step == "feed to the depth":
            yield CycleMove(depth)
        elif step == "feed by Q":
            yield from _pecks(steps[n + 1 :], level, depth, words, clearance, retract)
        elif step == "feed to R":
            yield CycleMove(level)
        elif step == "rapid back":
            yield CycleMove(back, is_rapid=True)
        elif step == "to the first level in rapid with G98" and to_initial:
            yield CycleMove(initial, is_rapid=True)
        elif step == "dwell P":
            if words.dwell is None:
                raise ProgramBlockError("The cycle needs P, the seconds of its dwell", "no-number")
            yield CycleMove(seconds=words.dwell)
        elif step == "shift by Q in X":
            if words.peck is None:
                raise ProgramBlockError("The cycle needs Q, its shift", "no-number")
            yield CycleMove(shift=words.peck, is_rapid=True)


def _pecks(
    steps: Sequence[str],
    level: float,
    depth: float,
    words: CycleWords,
    clearance: float | str,
    retract: float | str,
) -> Iterator[CycleMove]:
    """Yield feeds by Q with what is between them, until the depth is reached."""
    peck = words.peck
    if peck is None or peck <= 0.0:
        raise ProgramBlockError("The cycle needs Q, the depth of a peck, above 0", "no-number")
    if (level - depth) / peck > MOST_PECKS:
        raise ProgramBlockError(f"The cycle needs more than {MOST_PECKS} pecks")
    at = level
    while True:
        at = max(at - peck, depth)
        yield CycleMove(at)
        if at <= depth:
            return
        for step in steps:
            if step == "again to the depth":
                break
            if step == "rapid to R":
                yield CycleMove(level, is_rapid=True)
            elif step == "rapid back by the retract distance":
                yield CycleMove(min(at + _length(retract), level), is_rapid=True)
            elif step == "rapid to D before the depth reached":
                yield CycleMove(min(at + _length(clearance), level), is_rapid=True)


def _length(found: float | str) -> float:
    if isinstance(found, str):
        raise ProgramBlockError(f"A cycle cannot be worked out: {found}")
    return found
