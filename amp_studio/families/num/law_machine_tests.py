"""Programs that a NUM manual prints to try an axis: homing ten times (7-17), both speeds (11-3),
the circle of the ball-bar program (6-46).
"""

from __future__ import annotations

import math

from amp_studio.sim import AxisLaw, BoundMachine, MachineTest, MachineTestStep, value_text

from .law_facts import ids

CHECKS = 10
RADIUS, CIRCLE_FEED = 20.0, 3000.0
"""mm and mm/min (6-46)."""
SLOW = 0.1
ROOM = 0.8


def machine_tests(machine: BoundMachine, axis: AxisLaw) -> list[MachineTest]:
    """Return the programs of one axis."""
    letter = machine.letter(axis.axis) or axis.axis
    return [_homing(axis, letter), _speeds(machine, axis, letter), _circle(machine, axis, letter)]


def _room(axis: AxisLaw) -> tuple[float, float]:
    limits = list(axis.travel().limits.values()) if axis.travel else []
    return limits[0] if limits else (-math.inf, math.inf)


def _homing(axis: AxisLaw, letter: str) -> MachineTest:
    low, high = _room(axis)
    title = "Ten homings against a dial comparator"
    reached = [place for place in (low, high) if math.isfinite(place)]
    check = 0.5 * (low + high) if len(reached) == 2 else 0.0
    home = axis.homing().coordinate if axis.homing else 0.0
    if not low <= check <= high:
        return MachineTest(
            "homing", title, "7-17", refusal=f"No place of axis {letter} is inside the limits of P17."
        )
    back = -1.0 if axis.homing and (axis.homing().approach or axis.homing().leave) > 0.0 else 1.0
    lines = (
        "%9990",
        f"N1 G77 N5 N60 (HOME {letter})",
        f"N2 G9 G52 {letter}{_word(check)} F1000",
        "N3 M0 $CHECK THE POSITION",
        f"N4 L10=L10+1 G79 L10<{CHECKS} N1",
        "M02",
        f"N5 L0={axis.axis} L1=90000+L0 L2=91000+L0 L3=92000+L0 L4=93000+L0 L6=91100+L0",
        f"EL6=0 EL2=0 EL1={_word(-1000.0 * back)} EL2=1 L5=EL1/1000",
        "N20 G79 EL4=0 N30",
        f"G52 G00 L5=L5{'+' if back > 0.0 else '-'}1 {letter}L5 G79 N20",
        f"N30 EL2=0 EL1={_word(-5e7 * back)} EL3=1 EL2=1",
        f"G1 G52 {letter}0 G10 @L0{'<' if back < 0.0 else '>'}0 N60",
        "N60 G94 F1000",
    )
    steps = (
        MachineTestStep(
            f"Put a dial comparator at {letter} {value_text(check, axis.unit)}",
            "it can be reached without a collision",
        ),
        MachineTestStep(
            "Run %9990 and read the comparator at each M0",
            f"{CHECKS} readings that differ by no more than a measuring unit",
        ),
        MachineTestStep(
            "Compare with P16",
            f"the first encoder zero after the switch is called {value_text(home, axis.unit)}",
        ),
    )
    return MachineTest(
        "homing",
        title,
        "7-17 to 7-19",
        lines,
        steps,
        ("The printed program is for guidance and has to be adapted to the machine (7-17).",),
    )


def _speeds(machine: BoundMachine, axis: AxisLaw, letter: str) -> MachineTest:
    title = "Both speeds of the adjustment of the drive"
    top = machine.read(axis.axis).optional(ids.max_speed)
    if not top:
        return MachineTest("speeds", title, "11-3", refusal=f"P30 gives axis {letter} no speed.")
    low, high = _room(axis)
    rate = next(iter(axis.ramps.values())).acceleration
    feed = (axis.feedrate or 0.0) * 60.0
    way = min(ROOM * (high - low), max(100.0, (feed / 60.0) ** 2 / rate * 2.0 if rate else 100.0))
    if rate and way < (feed / 60.0) ** 2 / rate:
        return MachineTest(
            "speeds", title, "11-3", refusal=f"The travel of axis {letter} is too short to reach its speed."
        )
    lines = (
        "%11",
        "N1 G91 G94",
        f"N2 G00 {letter}{_word(way)} G04 F1",
        f"N3 {letter}-{_word(way)} G04 F1",
        f"N4 G01 {letter}{_word(way)} F{_word(feed * SLOW)}",
        f"N5 {letter}-{_word(way)}",
        "N6 M02",
    )
    steps = (
        MachineTestStep(
            "Run N2 and N3",
            f"the axis goes at {value_text(feed, f'{axis.unit}/min')} without a hum, and stops "
            "without overshoot",
        ),
        MachineTestStep(
            "Run N4 and N5",
            f"at {value_text(feed * SLOW, f'{axis.unit}/min')} the following error is a tenth",
        ),
    )
    return MachineTest("speeds", title, "11-3", lines, steps)


def _circle(machine: BoundMachine, axis: AxisLaw, letter: str) -> MachineTest:
    title = "Ball-bar: circle of the firmware program %9997.9"
    others = [name for name in machine.fitted if name != axis.axis]
    if not others:
        return MachineTest("circle", title, "6-46", refusal="A circle needs two axes.")
    pair = {letter, machine.letter(others[0]) or others[0]}
    plane = {frozenset("XY"): "G17", frozenset("XZ"): "G18", frozenset("YZ"): "G19"}.get(frozenset(pair))
    if plane is None:
        return MachineTest(
            "circle",
            title,
            "6-46",
            refusal=f"{' and '.join(sorted(pair))} are in none of the planes G17 to G19.",
        )
    low, high = _room(axis)
    if high - low < 2.0 * RADIUS:
        return MachineTest(
            "circle", title, "6-46", refusal=f"Axis {letter} has no room for a radius of {RADIUS:g} mm."
        )
    lines = ("%1020", "M997 G77 H9997.9", "G80", f"(MDI) G120 {plane} G3 R{RADIUS:g} F{CIRCLE_FEED:g}")
    steps = (
        MachineTestStep(
            "Preset P19 and P55, select %9997.9 on the graphic page, and run G120 in MDI",
            "a circle between the dotted ones",
        ),
        MachineTestStep(
            "Change P19 until the spikes at the reversals are gone", "no step where an axis reverses"
        ),
    )
    return MachineTest("circle", title, "6-46", lines, steps)


def _word(number: float) -> str:
    return f"{round(number, 3):.3f}".rstrip("0").rstrip(".")
