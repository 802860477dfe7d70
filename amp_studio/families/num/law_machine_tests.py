"""Programs and procedures that a NUM manual prints to try an axis: measurement (5-25), servo-loop (6-44),
zero point (7-16), homing ten times (7-17), both speeds (11-3), the circle of the ball-bar program (6-46).
"""

from __future__ import annotations

import math

from amp_studio.sim import AxisLaw, BoundMachine, MachineTest, MachineTestStep, value_text

from .formulas.servo import loop_gain_coefficient, max_following_error
from .law_facts import ids
from .law_words import read_words

_CHECKS = 10
_RADIUS, _CIRCLE_FEED = 20.0, 3000.0
"""mm and mm/min (6-46)."""
_SLOW = 0.1
_PRINTED_WAY = 100.0
"""mm or deg to each side (11-3)."""
ROOM = 0.8
"""Share of the travel that a program uses."""


def machine_tests(machine: BoundMachine, axis: AxisLaw) -> list[MachineTest]:
    """Return the programs of one axis."""
    letter = machine.letter(axis.axis) or axis.axis
    return [
        _measurement(machine, axis, letter),
        _servo_loop(machine, axis, letter),
        _zero_point(axis, letter),
        _homing(machine, axis, letter),
        *_speeds(machine, axis, letter),
        _circle(machine, axis, letter),
    ]


def _room(axis: AxisLaw) -> tuple[float, float]:
    limits = list(axis.travel().limits.values()) if axis.travel else []
    return limits[0] if limits else (-math.inf, math.inf)


def _measurement(machine: BoundMachine, axis: AxisLaw, letter: str) -> MachineTest:
    """Direction and size of the measurement, before the axis is servo-controlled (5-25)."""
    read = machine.read(axis.axis)
    multi, divi = read.number(ids.measure_multi), read.number(ids.measure_divi)
    steps = (
        MachineTestStep(
            "E-stop pressed, control on, utility 5: declare the axis in P2, P25 and P26, and none in P3;"
            f" enter P11 ({multi:g} / {divi:g}), P34 and P36; leave utility 5",
            "no error 210 to 241 on the AXIS page, where only the measurement is shown",
        ),
        MachineTestStep(
            f"Turn axis {letter} by hand in both directions",
            f"it counts up in the positive direction; else change bit {axis.axis} of P10",
        ),
        MachineTestStep(
            f"Turn axis {letter} by an amount that is easy to measure",
            "the shown movement is the real one; else calculate MULTI / DIVI of P11 again",
        ),
    )
    return MachineTest("measurement", "Measurement before servo-control", "5-25", steps=steps)


def _servo_loop(machine: BoundMachine, axis: AxisLaw, letter: str) -> MachineTest:
    """The loop closed for the first time, with KVAR and EMAX of its top speed and time constant (6-44)."""
    title, notes = "First motion under servo-control", list[str]()
    words = read_words(machine.read(axis.axis), notes)
    top, constant = words.top * 60.0, words.constant * 1000.0
    gain = loop_gain_coefficient(top, constant, words.length, words.voltage)
    largest = max_following_error(top, constant, words.length)
    set_gain = machine.read(axis.axis).number(ids.loop_gain)
    set_largest = machine.read(axis.axis).number(ids.max_following_error)
    at = f"at {value_text(top, f'{words.unit}/min')} and {value_text(constant, 'ms')}"
    steps = (
        MachineTestStep("Open each limit switch and machine error by hand", "it cuts off the power"),
        MachineTestStep(
            f"Compare P21N{axis.axis} and P23N{axis.axis} with the formulas of 6-14 and 6-22",
            f"KVAR {gain:.0f} and EMAX {largest:.0f} {at}; the file has {set_gain:.0f} and {set_largest:.0f}",
        ),
        MachineTestStep(
            f"Declare axis {letter} in P3 alone and switch the control on",
            f"the axis does not move, and no error 40 to 71 comes; else switch off and"
            f" change bit {axis.axis} of P10",
        ),
        MachineTestStep(
            "Continuous JOG with the potentiometer at 20 %, in both directions",
            "the axis moves the way that is asked for and stops when the key is released; else change P20 and"
            " P10",
        ),
        MachineTestStep(
            "With the axis at rest turn the zero offset of the drive",
            "the ERROR column of the AXIS page goes to 0",
        ),
    )
    return MachineTest("servo-loop", title, "6-44", steps=steps)


def _zero_point(axis: AxisLaw, letter: str) -> MachineTest:
    """Homing for the first time, and the travel (7-16, 7-19)."""
    homing = axis.homing() if axis.homing else None
    way = "-" if homing and (homing.approach or homing.leave) < 0.0 else "+"
    low, high = _room(axis)
    ends = " and ".join(value_text(end, axis.unit) for end in (low, high))
    steps = [
        MachineTestStep(
            f"Read E930{int(axis.axis):02d} while the switch of axis {letter} is pressed by hand",
            "its state changes",
        ),
        MachineTestStep(
            f"Move axis {letter} in manual mode to its datum switch, {letter}{way}",
            f"the axis is homed; the other direction means that bit {axis.axis} of P15N0 is wrong",
        ),
    ]
    if math.isfinite(high - low):
        steps.append(
            MachineTestStep(
                f"Move axis {letter} slowly to {ends}", "it is stopped by P17 before the electrical switch"
            )
        )
    return MachineTest("zero-point", "Zero point and travel", "7-16", steps=tuple(steps))


def _homing(machine: BoundMachine, axis: AxisLaw, letter: str) -> MachineTest:
    """Ten homings of an axis with a switch, of a linear or of a modulo axis (7-17, 7-18)."""
    low, high = _room(axis)
    title = "Ten homings against a dial comparator"
    is_modulo = bool(
        int(machine.read(axis.axis).optional(ids.axes_modulo, everywhere=True) or 0.0) >> int(axis.axis) & 1
    )
    reached = [place for place in (low, high) if math.isfinite(place)]
    # The middle of the travel is inside whatever the signs of P17 are.
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
        f"N4 L10=L10+1 G79 L10<{_CHECKS} N1",
        "M02",
        f"N5 L0={axis.axis} L1=90000+L0 L2=91000+L0 L3=92000+L0 L4=93000+L0 L6=91100+L0",
        *(_modulo_lines if is_modulo else _linear_lines)(letter, back),
        "N60 G94 F1000",
    )
    steps = (
        MachineTestStep(
            f"Put a dial comparator at {letter} {value_text(check, axis.unit)}",
            "it can be reached without a collision",
        ),
        MachineTestStep(
            "Run %9990 and read the comparator at each M0",
            f"{_CHECKS} readings that differ by no more than a measuring unit",
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
        (
            "The printed program is for guidance and has to be adapted to the machine (7-17).",
            *(
                ["Page 7-18 jumps to N18, which no line is: N40, the test of the switch, is taken."]
                * is_modulo
            ),
        ),
    )


def _linear_lines(letter: str, back: float) -> tuple[str, ...]:
    """Return how a linear axis moves off its switch by 1 mm and on towards the origin; ``back`` is the sign
    of the way off the switch.
    """
    return (
        f"EL6=0 EL2=0 EL1={_word(-1000.0 * back)} EL2=1 L5=EL1/1000",
        "N20 G79 EL4=0 N30",
        f"G52 G00 L5=L5{'+' if back > 0.0 else '-'}1 {letter}L5 G79 N20",
        f"N30 EL2=0 EL1={_word(-5e7 * back)} EL3=1 EL2=1",
        f"G1 G52 {letter}0 G10 @L0{'<' if back < 0.0 else '>'}0 N60",
    )


def _modulo_lines(letter: str, back: float) -> tuple[str, ...]:
    """Return how a modulo axis moves off its switch by 1 degree and on by 180 degrees (7-18)."""
    ahead = "+" if back < 0.0 else "-"
    return (
        "EL6=0 EL2=0 EL1=-1000 EL2=1 L5=EL1/1000",
        "N40 G79 EL4=0 N50",
        f"L5=L5+1 G00 G52 {letter}{'-' if back < 0.0 else ''}L5 G79 N40",
        "N50 EL2=0 EL3=1 EL1=100000 EL2=1",
        f"G01 G52 G93 F0.1 {letter}L5 G10 L5=EL1/1000{ahead}180 @L0{'<' if back < 0.0 else '>'}50 N60",
        "G79 N50",
    )


def _speeds(machine: BoundMachine, axis: AxisLaw, letter: str) -> list[MachineTest]:
    """The axis to and fro at a tenth of its top speed, then at the whole of it (11-3)."""
    title = "To and fro at {} % of the highest speed"
    top = machine.read(axis.axis).optional(ids.max_speed)
    if not top:
        refusal = f"P30 gives axis {letter} no speed."
        return [MachineTest("slow", title.format(10), "11-3", refusal=refusal)]
    low, high = _room(axis)
    rate = next(iter(axis.ramps.values())).acceleration
    feed = (axis.feedrate or 0.0) * 60.0
    half = min(_PRINTED_WAY, 0.5 * ROOM * (high - low))
    # The printed program goes to both sides of 0; where the travel has no room there, of its middle.
    middle = 0.0 if ROOM * high >= half and ROOM * low <= -half else 0.5 * (low + high)
    ends = (middle + half, middle - half)
    way = abs(ends[0] - ends[1])
    speeds = []
    for name, share in (("slow", _SLOW), ("fast", 1.0)):
        speed = feed * share
        # Half of it to speed up and half to stop: v² / 2a each.
        if rate and way < (speed / 60.0) ** 2 / rate:
            refusal = (
                f"The travel of axis {letter} is too short to reach {value_text(speed, f'{axis.unit}/min')}."
            )
            speeds.append(MachineTest(name, title.format(f"{share * 100:g}"), "11-3", refusal=refusal))
            continue
        lines = (
            f"N10 G9 {letter}{_word(ends[0])} F{_word(speed)}",
            f"N15 G9 {letter}{_word(ends[1])}",
            "N20 G79 N10",
            "N25 M02",
        )
        speeds.append(
            MachineTest(
                name, title.format(f"{share * 100:g}"), "11-3", lines, _of_speed(machine, axis, letter, speed)
            )
        )
    return speeds


def _of_speed(machine: BoundMachine, axis: AxisLaw, letter: str, speed: float) -> tuple[MachineTestStep, ...]:
    """Return what is done and seen at a speed in u/min: the following error of speed and time constant."""
    words = read_words(machine.read(axis.axis), [])
    # In internal units, as the ERROR column shows it.
    behind = speed / 60.0 * words.constant / words.length
    return (
        MachineTestStep(
            f"Home axis {letter}, potentiometer at 100 %, mode AUTO, and press CYCLE",
            "no error 40 to 71 comes; else look at P56",
        ),
        MachineTestStep(
            "Read the ERROR column of the AXIS page at the steady speed",
            f"{behind:.0f} internal units in both directions (speed x time constant); else adjust the scale"
            f" of the drive, {words.voltage:g} V at the highest speed",
        ),
        MachineTestStep(
            "Read the ERROR column of the axes that are at rest",
            "it does not move; else look at screens and earth",
        ),
    )


def _circle(machine: BoundMachine, axis: AxisLaw, letter: str) -> MachineTest:
    """Return the ball-bar test of two axes, or why there is none."""
    title = "Ball-bar: circle of the firmware program %9997.9"
    others = [name for name in machine.fitted if name != axis.axis]
    if not others:
        return MachineTest("circle", title, "6-46", refusal="A circle needs two axes.")
    pair = {letter, machine.letter(others[0]) or others[0]}
    plane = {frozenset("XY"): "G17", frozenset("XZ"): "G18", frozenset("YZ"): "G19"}.get(frozenset(pair))
    if plane is None:
        first, second = sorted(pair)
        return MachineTest(
            "circle", title, "6-46", refusal=f"{first} and {second} are in none of the planes G17 to G19."
        )
    low, high = _room(axis)
    if high - low < 2.0 * _RADIUS:
        return MachineTest(
            "circle", title, "6-46", refusal=f"Axis {letter} has no room for a radius of {_RADIUS:g} mm."
        )
    lines = ("%1020", "M997 G77 H9997.9", "G80", f"(MDI) G120 {plane} G3 R{_RADIUS:g} F{_CIRCLE_FEED:g}")
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
