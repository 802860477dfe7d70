"""The tuning program of appendix A for one axis of a 9/PC, inside its travel and at its own feedrates
(A-8).
"""

from __future__ import annotations

import math

from amp_studio.sim import AxisLaw, BoundMachine, MachineTest, MachineTestStep, value_text

from .law_facts import ids

_PRINTED = 127.0
"""mm: 5 inches (A-8)."""
_REPEATS = 6
ROOM = 0.8
"""Share of the travel that a move may take."""
_FEED = ids.max_cutting


def machine_tests(machine: BoundMachine, axis: AxisLaw) -> list[MachineTest]:
    """Return the program that reverses at the highest cutting feedrate;
    refused where the travel is too short to reach it.
    """
    letter = machine.letter(axis.axis) or axis.axis
    feed = machine.read(axis.axis).optional(_FEED) or (axis.feedrate or 0.0) * 60.0
    title, page = "Tuning program: the axis reverses at its highest cutting feedrate", "A-8"
    if not feed:
        return [
            MachineTest(
                "tuning",
                title,
                page,
                refusal=f"Neither {_FEED} nor a rapid feedrate of axis {letter} is set.",
            )
        ]
    rate = next(iter(axis.ramps.values())).acceleration
    # Both ramps take v² / a; the half of it again is the constant speed on which overshoot shows.
    needs = (feed / 60.0) ** 2 / rate * 1.5 if rate else 0.0
    room = _room(axis)
    way = min(max(_PRINTED, needs), ROOM * room)
    if way < needs:
        why = (
            f"Axis {letter} needs {value_text(needs, axis.unit)} to reach "
            f"{value_text(feed, f'{axis.unit}/min')} and"
            f" stop, and its travel gives {value_text(ROOM * room, axis.unit)}."
        )
        return [MachineTest("tuning", title, page, refusal=why)]
    lines = (
        "N00001 G21 G94 G91;",
        "N00002 #100=0;",
        f"N00003 G01 {letter}{_word(way)} F{_word(feed)};",
        "N00004 G04 P1;",
        f"N00005 {letter}-{_word(way)};",
        "N00006 G04 P1;",
        "N00007 #100=#100+1;",
        f"N00008 IF [#100 LT {_REPEATS}] GOTO 3;",
        "N00009 M02;",
    )
    start = f"Jog axis {letter} to where {value_text(way, axis.unit)} in the plus direction are free"
    steps = (
        MachineTestStep(start, f"{letter} is inside its overtravels with that way in front of it"),
        MachineTestStep(
            "Output velocity feedback on the DAC monitor, and run the program",
            f"{_REPEATS} moves each way at {value_text(feed, f'{axis.unit}/min')}",
        ),
        MachineTestStep(
            "Look at the velocity of one reversal",
            "no overshoot that comes back, no lasting ripple (figures A.1 to A.6)",
        ),
    )
    notes = ("Without paramacros repeat N00003 to N00006 in the place of N00002, N00007 and N00008 (A-8).",)
    return [MachineTest("tuning", title, page, lines, steps, notes)]


def _room(axis: AxisLaw) -> float:
    """Return how long the travel is, u."""
    limits = axis.travel().limits.values() if axis.travel else ()
    return min((high - low for low, high in limits), default=math.inf)


def _word(number: float) -> str:
    return f"{round(number, 3):.3f}".rstrip("0")
