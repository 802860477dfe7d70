"""Scenario `synchronize`: two spindles brought to one speed and their markers to each other (chapter 14), and
how far they are apart afterwards, at another speed too.

Both get the same commands (14-5). What differs is how far each is behind its command, by its gain (12-15), so
that a change of speed turns them against each other: Maximum Deviation watches that, Synch Gain makes it
smaller.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from amp_studio.sim import (
    Alarm,
    BoundMachine,
    Figure,
    Gear,
    Scenario,
    ScenarioSettings,
    SimulationError,
    Spindle,
    Trace,
    above_zero,
    number,
    refuse_unknown,
    value_text,
)

from .formulas.spindle_sync import synchronized_feedback_ratio, synchronized_speed
from .law_facts import MOTION, ids
from .law_spindle import spindle

_SETTINGS = {
    "move.speed": "programmed speed (rpm), or highest",
    "move.from": "speed of both before (rpm); default: 0",
    "move.then": "speed after they are synchronized (rpm); default: the same",
    "move.gear": "gear of the controlling spindle; default: the lowest that has the speed",
    "move.follower_gear": "gear of the follower; default: the lowest that has the speed",
    "move.phase": "how far the markers are apart when both have the speed (deg); default: 180",
    "move.offset": "position offset of the block (deg); default: Default Position Offset",
    "move.drive_time": "time constant of both spindle drives (s); default: 0.05, assumed",
}
_HIGHEST = "highest"
STEP, DRIVE_TIME, SLOWEST = 0.001, 0.05, 10.0
"""s"""
_THIN = 5
"""Steps from row to row."""
_LONGEST = 300.0
"""s: the longest Seek Timeout (14-8)."""
WATCHED, LATER = 0.5, 8.0
"""s in which the deviation is watched after the seek; time constants of the slower loop after a change."""
_AT_SPEED = 0.01
"""Share of the speed within which both have it."""
_SEEKS = 0.25
"""Share of its position loop with which the follower takes up the angle."""
_TO_DEG = 6.0
"""deg/s of 1 rpm."""
MISCONFIGURED = "SYNCH SPINDLES MISCONFIGURED"
_DEVIATES, _TIMEOUT = "BR_SYNE", "BW_SYNTO"
_LOOPS = (
    "Both spindles get the same commands (14-5), and each is behind by its speed over its gain (12-15)."
    " ASSUMED: each drive is a lag of {0}; nothing of the drive is in the file (move.drive_time)."
)
_BEYOND = "{0} lies beyond the speeds that both gears have: both turn at {1}, with a warning (14-2)."
_SEEK = (
    "ASSUMED: once both have the speed, the follower takes up the angle of the markers with a quarter of its"
    " position gain, inside of the speeds of its gear; they are synchronized when Seek Tolerance is kept, and"
    " the angle stays as it is from there. Seek Timeout counts from the command. How the control seeks is not"
    " printed (14-7)."
)
_GAINED = (
    "ASSUMED: Synch Gain times the difference of the following errors, as a share of that of the controlling"
    " spindle, is added to the gain of the follower; its unit is not printed (14-5)."
)


@dataclass(frozen=True)
class SpindlePair:
    """Two spindles in their gears."""

    gears: tuple[Gear, Gear]
    gain: float
    """Synch Gain."""
    offset: float
    """deg"""
    seek: float
    """deg: Seek Tolerance."""
    deviation: float
    """deg: Maximum Deviation."""
    timeout: float
    """s"""
    lag: float
    """s of both drives."""
    sign: float
    """-1.0 where the follower turns the other way."""


@dataclass
class Course:
    """How both have turned."""

    rows: list[tuple[float, ...]]
    found: float | None = None
    """When they were synchronized, s."""
    furthest: float = 0.0
    """deg: the largest deviation afterwards."""


COLUMNS = (
    "time_s",
    "command_velocity",
    "velocity",
    "follower_velocity",
    "deviation",
    "following_error_difference",
)


def _run_synchronize(machine: BoundMachine, settings: ScenarioSettings) -> Trace:
    """Synchronize both spindles; raises SimulationError where the file has no pair that can be."""
    refuse_unknown(settings, _SETTINGS)
    machine.one_chosen("synchronize")
    first, second = _spindles(machine)
    asked = _asked(settings, first, second)
    pair, speed = _pair(machine, settings, first, second, asked)
    phase = number(settings, "move.phase")
    phase = 180.0 if phase is None else phase
    before, then = number(settings, "move.from") or 0.0, above_zero(settings, "move.then")
    later = speed if then is None else _common(pair, then)
    course = _turned(pair, before, speed, later, _wrapped(phase))
    return Trace(
        scenario="synchronize",
        axis="",
        model=f"9/PC spindles {first.name} and {second.name}: two position loops with the same commands",
        columns={
            name: np.array(column)
            for name, column in zip(COLUMNS, zip(*course.rows, strict=True), strict=True)
        },
        units={
            "time_s": "s",
            "command_velocity": "rpm",
            "velocity": "rpm",
            "follower_velocity": "rpm",
            "deviation": "deg",
            "following_error_difference": "deg",
        },
        result=_figures(pair, speed, later, course),
        alarms=_alarms(pair, course),
        assumptions=(
            *(
                ()
                if asked == speed
                else (_BEYOND.format(value_text(asked, "rpm"), value_text(speed, "rpm")),)
            ),
            _LOOPS.format(value_text(pair.lag, "s")),
            _SEEK,
            *((_GAINED,) if pair.gain else ()),
        ),
        limits={"maximum deviation": (pair.deviation, "deg"), "seek tolerance": (pair.seek, "deg")},
    )


def _spindles(machine: BoundMachine) -> tuple[Spindle, Spindle]:
    """Return the controlling spindle and the follower; raises SimulationError where 590 and 591 name none."""
    read = machine.parameters
    names = [str(read.value(name)) for name in (ids.sync_controlling, ids.sync_follower)]
    if "none" in names or "None" in names:
        raise SimulationError("Controlling Spindle and Follower Spindle name no pair (14-2)")
    if names[0] == names[1]:
        raise SimulationError(
            f"{MISCONFIGURED}: Controlling Spindle and Follower Spindle are both {names[0].upper()} (14-2)",
            ids.sync_follower,
        )
    counts = [_counts(machine, name) for name in names]
    try:
        synchronized_feedback_ratio(*counts)
    except ValueError as error:
        raise SimulationError(f"{str(error).rstrip('.')} (14-1)", ids.position_counts) from None
    first, second = (spindle(read, name.removeprefix("s")) for name in names)
    return first, second


def _counts(machine: BoundMachine, name: str) -> float:
    """Return the counts of a turn of the axis that is a spindle; raises SimulationError where none is it."""
    read = machine.parameters
    for axis in MOTION.axes:
        if read.value(ids.axis_type, at=axis) == "spindle" and read.value(ids.spindle_type, at=axis) == name:
            return read.number(ids.position_counts, at=axis)
    raise SimulationError(f"No axis is spindle {name.removeprefix('s')} (3-5, 7-82)", ids.spindle_type)


def _asked(settings: ScenarioSettings, first: Spindle, second: Spindle) -> float:
    if settings.get("move.speed") is None:
        raise SimulationError("Give the programmed speed", "move.speed")
    if settings["move.speed"] != _HIGHEST:
        return above_zero(settings, "move.speed") or 0.0
    tops = [max((gear.high for gear in each.gears), default=0.0) for each in (first, second)]
    return min(tops)


def _pair(
    machine: BoundMachine, settings: ScenarioSettings, first: Spindle, second: Spindle, asked: float
) -> tuple[SpindlePair, float]:
    """Return the pair in its gears and the speed at which it synchronizes (14-2); raises SimulationError."""
    read = machine.parameters
    gears = (_gear(first, settings, "move.gear", asked), _gear(second, settings, "move.follower_gear", asked))
    offset = number(settings, "move.offset")
    pair = SpindlePair(
        gears,
        read.optional(ids.sync_gain) or 0.0,
        (read.optional(ids.sync_offset) or 0.0) if offset is None else offset,
        read.number(ids.sync_seek_tolerance),
        read.optional(ids.sync_max_deviation) or 0.0,
        read.number(ids.sync_seek_timeout) / 1000.0,
        above_zero(settings, "move.drive_time", SLOWEST) or DRIVE_TIME,
        -1.0 if read.value(ids.sync_orientation) == "reversed" else 1.0,
    )
    return pair, _common(pair, asked)


def _gear(each: Spindle, settings: ScenarioSettings, name: str, asked: float) -> Gear:
    """Return the gear of a spindle; raises SimulationError for one without a gain."""
    if each.refusal or not each.gears:
        raise SimulationError(f"{each.refusal} (spindle {each.name})", ids.gear_count)
    given = settings.get(name)
    text = f"{given:g}" if isinstance(given, float) else given
    gear = next((gear for gear in each.gears if gear.name == text), None)
    if given is not None and gear is None:
        raise SimulationError(f"Gear {text} of spindle {each.name} is not used", name)
    fitting = gear or next((gear for gear in each.gears if gear.low <= asked <= gear.high), each.gears[0])
    if fitting.gain <= 0.0:
        raise SimulationError(
            f"No gain is set for gear {fitting.name} of spindle {each.name}", ids.spindle_gain
        )
    return fitting


def _common(pair: SpindlePair, asked: float) -> float:
    """Return the speed of both (example 14.1); raises SimulationError where they have none."""
    ranges = [(gear.low, gear.high) for gear in pair.gears]
    speed = synchronized_speed(asked, ranges[0], ranges[1])
    if speed is None:
        spans = " and ".join(f"{low:g} to {high:g} rpm" for low, high in ranges)
        raise SimulationError(
            f"The gears of both spindles, {spans}, have no speed in common (14-2)", ids.spindle_max_speed
        )
    return speed


def _wrapped(angle: float) -> float:
    return (angle + 180.0) % 360.0 - 180.0 if angle % 360.0 != 180.0 else 180.0


class _Loop:
    """One spindle: its position loop and the lag of its drive; deg and deg/s."""

    def __init__(self, gain: float, lag: float, speed: float) -> None:
        self.gain, self.lag, self.speed = gain, lag, speed
        self.error = speed / gain

    def step(self, commanded: float, gain: float) -> None:
        """Turn for one step, commanded in deg/s."""
        self.error += (commanded - self.speed) * STEP
        self.speed += (gain * self.error - self.speed) * STEP / (self.lag + STEP)


class _Turning:
    """Both spindles on their way, step by step."""

    def __init__(self, pair: SpindlePair, before: float, phase: float) -> None:
        self.pair, self.command, self.phase = pair, before, phase
        self.first, self.second = (_Loop(gear.gain, pair.lag, before * _TO_DEG) for gear in pair.gears)
        self.apart: float | None = None
        """deg between the commands of both from the seek on; None before it."""
        self.extra = 0.0

    @property
    def errors(self) -> float:
        """Deg by which the follower is farther behind."""
        return self.second.error - self.first.error

    @property
    def deviation(self) -> float:
        """Deg between the markers."""
        return self.phase if self.apart is None else _wrapped(self.apart + self.errors)

    def has_speed(self, speed: float) -> bool:
        """Return whether both have a speed, rpm."""
        near = _AT_SPEED * speed * _TO_DEG
        return all(abs(each.speed - speed * _TO_DEG) <= near for each in (self.first, self.second))

    def step(self, aim: float, *, seeks: bool) -> None:
        """Turn both for one step towards a speed, rpm, and the angle of the markers."""
        ramp = max((gear.ramp_time / gear.ramp_top for gear in self.pair.gears if gear.ramp_top), default=0.0)
        way = aim - self.command
        self.command += math.copysign(min(abs(way), STEP / ramp), way) if ramp else way
        extra = _seek(self.pair, self.command, self.deviation) if seeks and self.apart is not None else 0.0
        self.first.step(self.command * _TO_DEG, self.first.gain)
        raised = _raised(self.pair, self.first.error, self.second.error)
        self.second.step(self.command * _TO_DEG + extra, self.second.gain * raised)
        # What the follower is commanded beyond the controlling spindle takes the angle away.
        self.apart = None if self.apart is None else self.apart - extra * STEP


def _turned(pair: SpindlePair, before: float, speed: float, later: float, phase: float) -> Course:
    """Turn both until they are synchronized, and on to the later speed."""
    turning, course, ends, steps = _Turning(pair, before, phase), Course([]), math.inf, 0
    while (time := steps * STEP) < ends:
        if turning.apart is None and steps and turning.has_speed(speed):
            turning.apart = phase - turning.errors
        if course.found is None and turning.apart is not None and abs(turning.deviation) <= pair.seek:
            course.found = time
            ends = time + WATCHED + LATER / min(gear.gain for gear in pair.gears) + LATER * pair.lag
            ends += max(gear.ramp_time for gear in pair.gears)
        if course.found is not None:
            course.furthest = max(course.furthest, abs(turning.deviation))
        if steps % _THIN == 0:
            course.rows.append(_row(turning, time))
        if course.found is None and time >= min(pair.timeout, _LONGEST):
            break
        aim = later if course.found is not None and time >= course.found + WATCHED else speed
        turning.step(aim, seeks=course.found is None)
        steps += 1
    return course


def _row(turning: _Turning, time: float) -> tuple[float, ...]:
    follower = turning.pair.sign * turning.second.speed / _TO_DEG
    return time, turning.command, turning.first.speed / _TO_DEG, follower, turning.deviation, turning.errors


def _seek(pair: SpindlePair, command: float, deviation: float) -> float:
    """Return what the follower turns faster, deg/s, to take up a deviation inside of its gear's speeds."""
    gear = pair.gears[1]
    wanted = _SEEKS * gear.gain * deviation
    room = max((gear.high - command if wanted > 0.0 else command - gear.low) * _TO_DEG, 0.0)
    if room == 0.0:  # the long way round
        wanted = _SEEKS * gear.gain * (deviation - math.copysign(360.0, deviation))
        room = max((gear.high - command if wanted > 0.0 else command - gear.low) * _TO_DEG, 0.0)
    return math.copysign(min(abs(wanted), room), wanted)


def _raised(pair: SpindlePair, error: float, follower_error: float) -> float:
    """Return by what Synch Gain multiplies the gain of the follower."""
    if not pair.gain or abs(error) < 1e-9:
        return 1.0
    return min(max(1.0 + pair.gain * (follower_error - error) / abs(error), 0.1), 10.0)


def _figures(pair: SpindlePair, speed: float, later: float, course: Course) -> dict[str, Figure]:
    """Return speeds, errors and times of a synchronized pair."""
    gears, last = pair.gears, course.rows[-1]
    return {
        "speed": (speed, "rpm"),
        "follower_speed": (pair.sign * speed, "rpm"),
        "gear": (float(gears[0].name), ""),
        "follower_gear": (float(gears[1].name), ""),
        "following_error": (speed * _TO_DEG / gears[0].gain, "deg"),
        "follower_following_error": (speed * _TO_DEG / gears[1].gain, "deg"),
        "seek_time": (course.found, "s"),
        "deviation": (None if course.found is None else course.furthest, "deg"),
        "deviation_at_end": (None, "deg") if course.found is None else (abs(last[4]), "deg"),
        "later_speed": (later, "rpm"),
        "offset": (pair.offset, "deg"),
    }


def _alarms(pair: SpindlePair, course: Course) -> tuple[Alarm, ...]:
    """Return the flags that logic gets."""
    alarms = []
    end = course.rows[-1][0]
    if course.found is None:
        text = (
            f"The spindles are not synchronized within Seek Timeout, {value_text(pair.timeout, 's')} (14-8)"
        )
        alarms.append(Alarm(_TIMEOUT, end, text))
    elif course.furthest > pair.deviation:
        text = (
            f"The markers are {value_text(course.furthest, 'deg')} apart after synchronization, more"
            f" than Maximum Deviation, {value_text(pair.deviation, 'deg')} (14-7)"
        )
        alarms.append(Alarm(_DEVIATES, course.found, text))
    return tuple(alarms)


SCENARIO = Scenario(
    "synchronize",
    "Two spindles brought to one speed and angle, and their deviation afterwards",
    _SETTINGS,
    _run_synchronize,
    gains=False,
    of_machine=True,
    checked=("speed", "seek_time", "deviation"),
    once=True,
    part="spindle",
    programmed={"move.speed": _HIGHEST},
)
