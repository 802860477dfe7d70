"""Homing, jogging and software stroke limits of a Syntec axis (chapters 2 and 3)."""

from __future__ import annotations

import math

from amp_studio.sim import AxisParameters, Failure, Handwheel, Homing, Jogging, Ramp, SimulationError, Travel

from .law_facts import ids

BLU = 0.001
"""mm or deg (1.2.6)."""
_HALF = 0.5
"""Share of a turn below which home grid passes an index over (2.2)."""
_PITCHES = 5.0
"""Turns without an index, or on the dog, after which MOT-029 and MOT-036 come (2.2)."""
_SCATTER = 0.1
"""Turns between the home grids of two homings from which MOT-022 comes (2.2)."""
_FARTHEST_BLU = 999999999.0
"""The delivered stroke limits: none (3.2)."""

_WINDOW_NOTE = (
    "ASSUMED: a unit of the zero-speed window Pr901 is a BLU; the slides print neither unit nor range (2.2,"
    " alarms)."
)
_NOTES = (
    "Onto the dog at the first speed, stop, off it backwards at the second, on to the nearest index (2.2).",
    (
        "ASSUMED: a unit of Axis home offset is a BLU, its sign the machine's; neither is printed (2.2). The"
        " axis stops along its ramp and returns to the index at the second speed."
    ),
)
_STOPPED = "ASSUMED: beyond the limit the command stops at once; the slides print the alarm alone (3.2)."


def homing(read: AxisParameters, turn: float) -> Homing:
    """Return the homing sequence; ``turn`` is u from index to index.
    Raises SimulationError where a value is missing.
    """
    if read.choice(ids.encoder_type) == "absolute":
        raise SimulationError(
            f"Axis {read.axis} has an absolute encoder: it is not homed by a search (2.1.1)", ids.encoder_type
        )
    method = read.choice(ids.search_method)
    sign = -1.0 if read.choice(ids.home_direction) == "negative" else 1.0
    offset = (read.optional(ids.home_offset) or 0.0) * BLU
    second = read.above_zero(ids.second_speed) / 60.0
    alone, stays = method == "index-only", method == "stay"
    window = read.optional(ids.zero_speed_window)
    return Homing(
        approach=0.0 if alone else sign * read.above_zero(ids.first_speed) / 60.0,
        # Without a dog the index is searched in the direction of homing; with one the axis goes back off it
        # (2.2).
        leave=sign * second * (1.0 if alone else -1.0),
        marker="none" if method == "dog-only" else "next",
        turn=turn,
        coordinate=offset if stays else 0.0,
        final=second,
        offset=0.0 if stays else offset,
        skipped=_HALF if read.value(ids.home_grid) is True else 0.0,
        failures=_failures(read, turn),
        rest_window=math.inf if not window else window * BLU,
        speeds={"approach": ids.first_speed, "leave": ids.second_speed, "final": ids.second_speed},
        page="2.2",
        notes=(*_NOTES, _WINDOW_NOTE) if window else _NOTES,
    )


def _failures(read: AxisParameters, turn: float) -> dict[str, Failure]:
    """Return the alarms of a homing (2.2, alarms), lengths in turns of the motor between two indices."""
    turns = read.optional(ids.protective_turns)
    far = (turns or _PITCHES) * turn
    given = f"the {turns:g} turns of its protective revolution" if turns else "5 pitches"
    return {
        "marker": Failure(
            "MOT-029",
            "Miss index in homing: 5 pitches from the dog no index has come (2.2).",
            _PITCHES * turn,
        ),
        "stuck": Failure("MOT-036", f"Can't leave Home Dog: it is still on after {given} (2.2).", far),
        "moving": Failure(
            "MOT-030",
            "Zero speed timeout in homing: 0.1 s after the command stopped on the dog the error is above the"
            " zero-speed window (2.2).",
        ),
        "scatter": Failure(
            "MOT-022",
            "Home position inaccurate: the home grid differs from that of the first homing by more than 0.1"
            " turn (2.2).",
            _SCATTER,
        ),
    }


def jogging(read: AxisParameters) -> Jogging:
    """Return the jog speed (Pr521)."""
    return Jogging({"jog": read.above_zero(ids.jog_feedrate) / 60.0}, page="4.1")


def travel(read: AxisParameters) -> Travel:
    """Return the first software stroke limits (Pr2401), which are active after homing (3.2)."""
    edges = []
    for name, none in ((ids.limit_first_negative, -_FARTHEST_BLU), (ids.limit_first_positive, _FARTHEST_BLU)):
        value = read.optional(name)
        edges.append(math.copysign(math.inf, none) if value in (None, none) else float(value or 0.0) * BLU)
    return Travel(
        {"the 1st software stroke limit": (edges[0], edges[1])},
        "MOT-017",
        "3.2",
        (_STOPPED,),
        alarm_negative="MOT-018",
        reads_ahead="COR-040",
    )


_WHEELED = (
    "A pulse of the handwheel moves the axis by Pr2001 at the fourth step of the MPG override; what the"
    " other steps give is not printed (4.1). ASSUMED: a LIU is a BLU."
)
_WHEEL_RAMP = "ASSUMED: Pr410 is the time of a straight ramp to the MPG feedrate (4.1)."


def handwheel(read: AxisParameters, wheel: str) -> Handwheel:
    """Return how the MPG moves the axis (4.1); raises SimulationError where it moves another one or none."""
    if wheel not in ("", "1"):
        raise SimulationError("Pr2001 to 2041 are of one handwheel (4.1): leave out move.wheel", "move.wheel")
    factor = read.optional(ids.mpg_factor, everywhere=True)
    if not factor:
        raise SimulationError("Pr2001 gives a pulse of the handwheel no way (4.1)")
    moved = read.value(ids.mpg_axis, everywhere=True)
    own = read.value(ids.axis_name)
    if moved not in (None, "plc") and own is not None and str(moved) != str(own).lower():
        raise SimulationError(
            f"Pr2031 gives the handwheel to the {str(moved).upper()} axis alone, not to axis {read.axis}"
            f" (4.1)",
            ids.mpg_axis,
        )
    rate = read.optional(ids.mpg_feedrate, everywhere=True) or read.above_zero(ids.jog_feedrate)
    time = read.optional(ids.mpg_acceleration_time, everywhere=True)
    speed = rate / 60.0
    return Handwheel(
        factor * BLU,
        speed,
        read.optional(ids.mpg_resolution, everywhere=True) or None,
        Ramp("linear", speed / (time / 1000.0)) if time else None,
        "4.1",
        (_WHEELED, *((_WHEEL_RAMP,) if time else ())),
    )
