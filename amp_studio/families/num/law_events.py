"""Homing, jog and travel limits of a NUM axis (chapter 7, 6.18)."""

from __future__ import annotations

import math

from amp_studio.sim import AxisParameters, Handwheel, Homing, Jogging, SimulationError, Travel

from .law_facts import MOTION, ids
from .law_words import Words

JOGS = {"normal": ids.jog_normal, "slow": ids.jog_slow, "fast": ids.jog_fast}
_REDUCED = {"mm": ids.reduced_speed_linear, "deg": ids.reduced_speed_rotary}

_HOMED = (
    (
        "The position at the first encoder zero after the switch is that of P16 (7-10). The figures of the"
        " six cases (7-5 to 7-7) are lost; all of them follow from P15 and P16."
    ),
    (
        "ASSUMED: the axis goes to the switch at the normal JOG speed of P31 (the slow one can be used as"
        " approach speed, 6-8), and on to the zero at the same speed, which is not printed; then it stops"
        " along its ramp, and does not return."
    ),
    "ASSUMED: encoder zeros 10 mm or deg apart, unless move.turn gives another distance.",
)
WITHOUT = "Bit {0} of P15N1 is set: no switch is tested, the first encoder zero that comes counts (7-8)."
JOGGED = (
    "JOG speeds of P31 for all axes (6-8), at 100 % of the potentiometer; reduced: while the PLC sets"
    " V_REDUIT (6-8)."
)
_LIMITED = (
    "ASSUMED: a manual move stops at once at the limit; how the control stops there is not printed (7-12)."
)


def _bit(read: AxisParameters, parameter: str) -> bool:
    return bool(int(read.optional(parameter, everywhere=True) or 0.0) >> int(read.axis) & 1)


def homing(read: AxisParameters, length: float) -> Homing:
    """Return the sequence; ``length`` is the internal unit in u.
    Raises SimulationError for a JOG speed that is not set.
    """
    speed = read.number(JOGS["normal"], everywhere=True)
    if not speed > 0.0:
        raise SimulationError(f"Normal JOG speed (P31N1) is {speed:g}; it must be above 0", JOGS["normal"])
    sign, alone = (-1.0 if _bit(read, ids.homing_negative) else 1.0), _bit(read, ids.switch_not_tested)
    velocity = sign * speed / 60.0
    notes = (WITHOUT.format(read.axis), *_HOMED) if alone else _HOMED
    return Homing(
        approach=0.0 if alone else velocity,
        leave=velocity,
        marker="next",
        turn=MOTION.value("marker_distance"),
        coordinate=(read.optional(ids.switch_position) or 0.0) * length,
        through=not alone,
        speeds=dict.fromkeys(("approach", "leave"), JOGS["normal"]),
        page="7-8",
        notes=notes,
    )


def jogging(read: AxisParameters, unit: str) -> Jogging:
    """Return the speeds of P31 that are set."""
    names = {**JOGS, "reduced": _REDUCED[unit]}
    speeds = {
        name: (read.optional(parameter, everywhere=True) or 0.0) / 60.0 for name, parameter in names.items()
    }
    return Jogging({name: speed for name, speed in speeds.items() if speed}, page="6-8", notes=(JOGGED,))


def travel(read: AxisParameters, length: float) -> Travel:
    """Return the limits of P17 from the measurement origin; none for a modulo axis (4-12)."""
    if _bit(read, ids.axes_modulo):
        return Travel({}, "TRAVEL LIMIT", "7-12", ("A modulo axis has no travel limits (4-12).",))
    low, high = read.optional(ids.limit_min), read.optional(ids.limit_max)
    edges = (-math.inf if low is None else low * length, math.inf if high is None else high * length)
    return Travel({"the travel limit of P17": edges}, "TRAVEL LIMIT", "7-12", (_LIMITED,))


_WHEELS = 4
_PER_LINE = 4.0
"""Counts of a line: the axis card multiplies by 4 (5-12)."""
_WHEELED = (
    "A line of the wheel counts 4, and moves the axis by 4 times MULTI / DIVI internal units (5-12)."
    " ASSUMED: the axis goes no faster than P30 and has its ramp of positioning; neither is printed of a"
    " handwheel."
)
_FILTERED = "The measurement of this wheel is filtered: the axis moves by whole lines (P14N1, 4-28)."


def handwheel(read: AxisParameters, words: Words, wheel: str) -> Handwheel:
    """Return how a handwheel moves the axis (4-28, 5-10, 5-12); raises SimulationError for one that
    P14 does not declare.
    """
    declared = int(read.optional(ids.axes_handwheels, everywhere=True) or 0.0)
    known = [str(n + 1) for n in range(_WHEELS) if declared >> n & 1]
    if not known:
        raise SimulationError("P14N0 declares no handwheel (4-28)")
    chosen = wheel or known[0]
    if chosen not in known:
        raise SimulationError(
            f"P14N0 declares no handwheel {chosen}, but {', '.join(known)} (4-28)", "move.wheel"
        )
    step = _PER_LINE * _wheel_ratio(read, chosen, turns=words.unit == "deg") * words.length
    is_reversed, is_filtered = (
        int(read.optional(name, everywhere=True) or 0.0) >> int(chosen) - 1 & 1
        for name in (ids.handwheel_direction, ids.handwheel_filter)
    )
    notes = (_WHEELED, *((_FILTERED,) if is_filtered else ()))
    return Handwheel(-step if is_reversed else step, words.top, page="5-12", notes=notes)


def _wheel_ratio(read: AxisParameters, at: str, *, turns: bool) -> float:
    """Return MULTI / DIVI of a wheel: the second pair for an axis that turns, unless that is 0 (5-12)."""
    pairs = [(ids.handwheel_multi, ids.handwheel_divi)]
    if turns:
        pairs.insert(0, (ids.handwheel_rotary_multi, ids.handwheel_rotary_divi))
    for multi, divi in pairs:
        above, below = (read.optional(name, at=at) or 0.0 for name in (multi, divi))
        if above > 0.0 and below > 0.0:
            return above / below
    raise SimulationError(f"Handwheel {at} has no MULTI / DIVI above 0 in P13 (5-12)", pairs[-1][0])
