"""The commands that only the 57C422B has, as scenarios: its tune commands as `procedure`, gear, cam,
backlash.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from amp_studio.sim import (
    STEP,
    AxisLaw,
    Figure,
    Recommendation,
    RunEnd,
    Scenario,
    ScenarioSettings,
    SimulationError,
    Trace,
    above_zero,
    alarms_of,
    assumptions,
    column_units,
    end_of,
    move,
    number,
    per_minute,
    profile_of,
    refuse_unknown,
    run_axis,
)

from . import law_tune as tune
from .formulas.cam import word_bytes
from .formulas.motion import backlash_moves
from .law_axis import ModuleAxis
from .law_cam import position_cam, time_cam, time_cam_order
from .law_facts import ids
from .law_gear import followed, gear_fraction, pieces_of
from .law_sample import SCAN

_TUNE = {"tune.command": "tune command: gains, dynamics or feedforward; default: gains"}
GEAR = {
    "gear.speed": "speed of the gearing reference (counts/s); default: Command Velocity over the ratio",
    "gear.time": "time that the axis is geared (s); default: 1",
}
CAM = {
    "cam.cycles": "how often the profile is run; default: 1, in continuous mode 2",
    "cam.speed": "speed of the master of a position cam (counts/s); default: Command Velocity",
    "cam.reverse": "table direction of a time cam, yes or no; its bit is lost",
    "cam.mirror": "mirror image of a time cam, yes or no; its bit is lost",
    "cam.negative": "motion direction of a time cam, yes or no; its bit is lost",
}
BACKLASH = {"move.distance": "commanded distance (counts), with its sign; default: Command Position"}

_SEARCH = {
    "gains": (
        "How the module searches is not printed (page 4-29). ASSUMED: a gain is doubled until the shaft"
        " vibrates and a third of the edge is left; the integral is the aperiodic limit of the proportional"
        " gain."
    ),
    "dynamics": (
        "How the module searches is not printed (page 4-29). ASSUMED: the greatest figures up to registers 19"
        " to 24 at which no move raises a fault or reaches the clamp of register 31."
    ),
    "feedforward": (
        "How the module searches is not printed (page 4-29). ASSUMED: the gain at which the following error"
        " of both ways is 0 or just above, without the integral."
    ),
}
_PAUSE = 0.1
"""s of rest after each move."""
_FASTEST = 1e9
"""Counts/s of a reference."""
_LONGEST = 60.0
"""Most seconds of a cam or a geared run."""


def _run_procedure(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Run one of the three tune commands (pages 4-29 to 4-31) and a move with what it leaves."""
    refuse_unknown(settings, _TUNE)
    module = _module(axis)
    which = str(settings.get("tune.command", "gains"))
    if which not in _TUNES:
        raise SimulationError(f"Unknown tune command '{which}'. Known: {', '.join(_TUNES)}", "tune.command")
    left, move_settings = _TUNES[which](module)
    trace = STEP.run(left.axis, move_settings)
    figures: dict[str, Figure] = {
        _figure(parameter): (value, _unit(parameter)) for parameter, value in left.registers.items()
    }
    wanted = (
        tuple(  # gains are the solver's: what a search of the module would leave is shown and not recommended
            Recommendation(parameter, value, _unit(parameter), f"left by tune {which} (page 4-29)")
            for parameter, value in left.registers.items()
            if parameter.startswith("command.")
        )
    )
    return replace(
        trace,
        scenario="procedure",
        result={**figures, **trace.result},
        recommendations=wanted,
        assumptions=(_SEARCH[which], *trace.assumptions),
    )


def _tune_gains(axis: ModuleAxis) -> tuple[tune.CommandResult, ScenarioSettings]:
    increment = abs(
        axis.needed(ids.command_position, "tune gains moves by it, .25 to .5 turns of the motor (page 4-30)")
    )
    if increment < 1.0:
        raise SimulationError("Tune gains needs an increment of at least 1 count", ids.command_position)
    return tune.gains(axis, axis.scales, increment), {"move.distance": increment}


def _tune_dynamics(axis: ModuleAxis) -> tuple[tune.CommandResult, ScenarioSettings]:
    """Return the registers that tuning the dynamics leaves, and the travel that it takes."""
    travel = axis.needed(ids.setup_overtravel_positive, "tune dynamics takes its travel from it (page 4-30)")
    if travel < 1.0:
        raise SimulationError(
            "Tune dynamics needs a travel of at least 1 count", ids.setup_overtravel_positive
        )
    ramp = axis.ramps["linear"]
    left = tune.dynamics(axis, travel, axis.feedrate or 0.0, ramp.acceleration, ramp.deceleration)
    return left, {"move.distance": travel}


def _tune_feed_forward(axis: ModuleAxis) -> tuple[tune.CommandResult, ScenarioSettings]:
    """Return the registers that tuning the feed forward leaves, and the travel that it takes."""
    ends = [
        axis.needed(ids[f"setup_overtravel_{side}"], "tune feedforward takes its travel from it (page 4-31)")
        for side in ("positive", "negative")
    ]
    if not ends[1] < 0.0 < ends[0]:
        raise SimulationError(
            "Tune feedforward moves both ways from 0: the travel limits must be on both sides of it",
            ids.setup_overtravel_negative,
        )
    return tune.feed_forward(axis, axis.scales, ends[0], ends[1], axis.feedrate or 0.0), {
        "move.distance": ends[0]
    }


_TUNES: Mapping[str, Callable[[ModuleAxis], tuple[tune.CommandResult, ScenarioSettings]]] = {
    "gains": _tune_gains,
    "dynamics": _tune_dynamics,
    "feedforward": _tune_feed_forward,
}


def _run_gear(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Gear the axis to a reference that is already moving (pages 4-15, 4-20, 4-24)."""
    refuse_unknown(settings, GEAR)
    module = _module(axis)
    if module.bit(ids.gearing_modes, 2):
        upper, lower = gear_fraction(
            None, module.register(ids.gear_numerator), module.register(ids.gear_denominator)
        )
    else:
        upper, lower = gear_fraction(
            module.needed(ids.gear_ratio, "gearing needs it (page 4-15)"), None, None
        )
    ratio = upper / lower
    speed = above_zero(settings, "gear.speed") or (axis.feedrate or 0.0) / abs(ratio)
    if speed > _FASTEST:
        raise SimulationError(
            f"gear.speed is {speed:g}; at most {_FASTEST:g} counts/s are simulated", "gear.speed"
        )
    time = above_zero(settings, "gear.time") or 1.0
    ramped = module.bit(ids.gearing_modes, 3)
    sign = -1 if module.bit(ids.control_mode, 4) else 1
    # Whole counts of the master: what the module gears is what its encoder gives.
    master = [round(speed * SCAN * k) for k in range(_scans(time))]
    positions = followed(master, sign * upper, lower, axis.ramps["linear"].acceleration if ramped else 0.0)
    lost = abs(master[-1] * ratio) - abs(positions[-1])
    return _followed(
        axis,
        "gear",
        positions,
        {
            "gear_ratio": (sign * ratio, ""),
            "speed": (sign * ratio * speed * 60.0, "counts/min"),
            **({"lost_in_ramp": (lost, "counts")} if ramped else {}),
        },
        (
            "With ramp velocity control the axis comes to the speed of its master and what it lost in the"
            " ramp stays lost: the manual has no word of catching up (page 4-21)."
            if ramped
            else "Without ramp velocity control the axis accelerates in current limit (page 4-24): its"
            f" velocity error is at first the speed of its master, {abs(ratio) * speed * SCAN:g} counts a"
            " scan."
        ),
        rest=-SCAN,  # the master runs on
    )


def _run_cam(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Run the cam profile of registers 125 to 2046 (pages 4-49 to 4-56)."""
    refuse_unknown(settings, CAM)
    module = _module(axis)
    points = int(module.needed(ids.cam_points, "it counts the points of the cam (page 4-54)"))
    asked = number(settings, "cam.cycles")
    cycles = (2.0 if module.bit(ids.cam_mode, 3) else 1.0) if asked is None else asked
    if cycles < 1.0 or cycles != math.floor(cycles):
        raise SimulationError(f"cam.cycles is {cycles:g}; it must be a whole number from 1 on", "cam.cycles")
    most = 956 if module.bit(ids.cam_mode, 8) else 1915 if module.bit(ids.cam_mode, 0) else 3830
    if not 1 <= points <= most:
        raise SimulationError(
            f"{module.names[ids.cam_points]} is {points}; this kind of cam has 1 to {most} points "
            "(page 4-57)",
            ids.cam_points,
        )
    if module.bit(ids.cam_mode, 8):
        positions, assumption = (
            _position_cam(module, settings, points),
            "Straight lines between the points (page 4-51).",
        )
    else:
        positions = _time_cam(module, settings, points, int(cycles))
        assumption = (
            "A constant speed in each interval of the cam: what the module does between points is not"
            " printed."
        )
    return _followed(axis, "cam", positions, {"points": (float(points), "")}, assumption)


def _time_cam(axis: ModuleAxis, settings: ScenarioSettings, points: int, cycles: int) -> list[float]:
    """Return the position of a cam over time at each scan, in counts."""
    if axis.bit(ids.cam_mode, 0):
        values = _table(axis, ids.time_points, points)
    else:
        words = _table(axis, ids.byte_points, (points + 1) // 2)
        values = [value for word in words for value in word_bytes(word)][:points]
    scans = round(axis.needed(ids.cam_time, "the time between two points (page 4-54)") / 1000.0 / SCAN)
    continuous, mirror = axis.bit(ids.cam_mode, 3), _is_yes(settings, "cam.mirror")
    order = time_cam_order(
        points,
        reverse=_is_yes(settings, "cam.reverse"),
        mirror=mirror,
        continuous=continuous,
        loop_back=int(axis.register(ids.loop_back) or 0) if continuous else 0,
    )
    intervals = points * cycles * (2 if mirror and not continuous else 1)
    # For its check of the length alone, before the table is gone through.
    _scans(intervals * scans * SCAN)
    return time_cam(values, scans, order, intervals, negative=_is_yes(settings, "cam.negative"))


def _position_cam(axis: ModuleAxis, settings: ScenarioSettings, points: int) -> list[float]:
    table = _table(axis, ids.position_points, points)
    increment = int(
        axis.needed(ids.position_increment, "travel of the master from point to point (page 4-53)")
    )
    speed = above_zero(settings, "cam.speed") or axis.feedrate or 0.0
    scans = _scans((points - 1) * increment / speed)
    return [position_cam(table, increment, speed * SCAN * k) for k in range(scans + 1)]


def _table(axis: ModuleAxis, parameter: str, points: int) -> list[int]:
    """Return the points of a cam as words; raises SimulationError for one that is not set."""
    values = [axis.register(parameter, k) for k in range(points)]
    if None in values:
        raise SimulationError(
            f"Point {values.index(None)} of the cam is not set, and {axis.names[ids.cam_points]} counts"
            f" {points}",
            parameter,
        )
    return [int(value) for value in values if value is not None]


def _run_backlash(axis: AxisLaw, settings: ScenarioSettings) -> Trace:
    """Make a move with automatic backlash compensation:
    against its sign it overruns and comes back (page 4-21).
    """
    refuse_unknown(settings, BACKLASH)
    module = _module(axis)
    asked = number(settings, "move.distance")
    distance = module.needed(ids.command_position, "the distance of the move") if asked is None else asked
    if asked is None and distance == 0.0:
        raise SimulationError(
            f"{module.names[ids.command_position]} is 0: there is no move. Give move.distance",
            ids.command_position,
        )
    if not 1.0 <= abs(distance) < 2.0**31:
        raise SimulationError(
            f"The distance is {distance:g}; it must be 1 count to {2**31 - 1}", "move.distance"
        )
    play = module.needed(ids.output_backlash, "backlash compensation moves by it (page 4-21)")
    moves = backlash_moves(round(distance), round(play))
    rows: list[float] = []
    start = position = 0.0
    for way in moves:
        part = move(way, axis.feedrate or 0.0, axis.ramps["linear"])
        rows += _shifted(part, start, position)
        start, position = start + end_of(part) + _PAUSE, position + way
        # The last piece of a move is rest without an end: between two moves it is a pause.
        rows[-7] = _PAUSE
    rows[-7] = math.inf
    figures: dict[str, Figure] = {f"move_{k}": (float(way), "counts") for k, way in enumerate(moves, 1)}
    return _run(
        axis,
        "backlash",
        rows,
        start,
        figures,
        "A stop of 0.1 s between the moves: its length is not printed.",
    )


def _shifted(profile: Sequence[float], start: float, position: float) -> list[float]:
    rows = list(profile)
    # A piece of a profile has eight figures: its begin first, its position third.
    for row in range(0, len(rows), 8):
        rows[row] += start
        rows[row + 2] += position
    return rows


def _followed(
    axis: AxisLaw,
    scenario: str,
    positions: Sequence[float],
    figures: dict[str, Figure],
    assumption: str,
    rest: float = _PAUSE,
) -> Trace:
    """Run an axis along the positions of each scan."""
    profile = profile_of(pieces_of(positions), positions[-1] if positions else 0.0)
    return _run(axis, scenario, profile, end_of(profile), figures, assumption, rest)


def _run(
    axis: AxisLaw,
    scenario: str,
    profile: list[float],
    end: float,
    figures: dict[str, Figure],
    assumption: str,
    rest: float = _PAUSE,
) -> Trace:
    """Run an axis along a profile, and ``rest`` s more."""
    motion = run_axis(axis, profile, RunEnd(end + rest))
    columns = motion.columns
    # At the scans: between them the command goes on, and the module sees none of it.
    peak, off_speed = (
        float(np.abs(columns[name][:: motion.rows_per_servo_period]).max())
        for name in ("following_error", "velocity_error")
    )
    alarms = alarms_of(axis, motion)
    result: dict[str, Figure] = {
        **figures,
        "time": (None if alarms else end, "s"),
        "peak_following_error": (peak, "counts"),
        "peak_velocity_error": (off_speed / SCAN, "counts/s"),
        "peak_output": (float(np.abs(columns["output"]).max()), "V"),
        "stop_position": (None if alarms else float(columns["position"][-1]), "counts"),
    }
    return Trace(
        scenario=scenario,
        axis=axis.axis,
        model=axis.title,
        columns=per_minute(columns),
        units=column_units(axis),
        result=result,
        alarms=alarms,
        assumptions=(assumption, *assumptions(axis)),
        limits={name: (level, axis.unit) for name, level in axis.limits.items()},
    )


def _module(axis: AxisLaw) -> ModuleAxis:
    assert isinstance(axis, ModuleAxis)
    return axis


def _scans(time: float) -> int:
    if time > _LONGEST:
        raise SimulationError(f"The motion takes {time:.6g} s; at most {_LONGEST:g} s are simulated")
    return max(2, round(time / SCAN))


def _is_yes(settings: ScenarioSettings, name: str) -> bool:
    value = settings.get(name, "no")
    if value not in ("yes", "no"):
        raise SimulationError(f"{name} is {value!r}; it must be yes or no", name)
    return value == "yes"


def _figure(parameter: str) -> str:
    kind, _, name = parameter.partition(".")
    return f"command_{name}" if kind == "command" else f"{name}_gain" if name != "deadband" else name


def _unit(parameter: str) -> str:
    return {
        ids.command_velocity: "counts/s",
        ids.command_acceleration: "counts/s2",
        ids.command_deceleration: "counts/s2",
    }.get(parameter, "")


COMMANDS = {
    each.name: each
    for each in (
        Scenario(
            "procedure",
            "The three tune commands of the module, and a move with what they leave",
            _TUNE,
            _run_procedure,
        ),
        Scenario(
            "gear",
            "The axis at rest is geared to a moving reference",
            GEAR,
            _run_gear,
            part="coupling",
            checked=("gear_ratio", "speed", "peak_following_error"),
            programmed={"gear.time": 1.0},
        ),
        Scenario(
            "cam",
            "A time cam or a position cam",
            CAM,
            _run_cam,
            part="coupling",
            checked=("points", "peak_following_error", "peak_velocity_error", "peak_output"),
        ),
        Scenario(
            "backlash",
            "A move with backlash compensation",
            BACKLASH,
            _run_backlash,
            part="coupling",
            checked=("move_1", "move_2", "peak_following_error"),
        ),
    )
}
