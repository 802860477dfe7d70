"""Scenario `spindle`: what an S word makes of a spindle: its gear, the output, the ramp,
the watch of its speed, and an orient.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import BoundMachine
from amp_studio.sim.rounding import page_text, value_text
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, number, refuse_unknown
from amp_studio.sim.series import Series
from amp_studio.sim.spindle import Gear, Orient, SpeedWatch, Spindle
from amp_studio.sim.trace import Alarm, Figure, Trace

SETTINGS = {
    "move.speed": (
        "programmed speed with its sign, minus for M4 (rpm), or highest; S1500 behind the scenario is the"
        " same"
    ),
    "move.spindle": "which spindle, by its number; default: the first",
    "move.gear": "the gear it is in, or the range that is programmed; default: none",
    "move.from": "speed before (rpm); default: 0",
    "move.drive_time": "time constant of the spindle drive (s); default: 0.05, assumed",
    "move.reached": "speed that the drive really reaches (rpm); default: the programmed one",
    "move.orient": "orient to this angle (deg), or yes for that of the file",
    "move.marker": "unknown where the marker was not seen since power-up; default: known",
    "move.position": "angle at which an orient begins (deg); default: 0",
    "move.estop_time": "when the emergency stop comes (s)",
}
HIGHEST = "highest"
DRIVE_TIME = 0.05
"""s"""
STEP = 0.001
"""s from row to row."""
SLOWEST = 60.0
"""s: the largest time constant of a drive."""
AFTER = 5.0
"""Time constants of the drive that are shown after the ramp."""
LONGEST = 600.0
"""s of a ramp that are simulated."""
HALF_TURN = 180.0
LAG = (
    "ASSUMED: the drive follows its command as a lag of {0}; nothing of the drive or the inertia of the"
    " spindle is in the file (move.drive_time)."
)


def run_spindle(machine: BoundMachine, settings: ScenarioSettings) -> Trace:
    """Run one change of speed, or an orient; raises SimulationError where the spindle is not set."""
    refuse_unknown(settings, SETTINGS)
    machine.one_chosen("spindle")
    spindle = spindle_of(machine, settings)
    if settings.get("move.orient") is not None:
        return _oriented(spindle, settings)
    before = number(settings, "move.from") or 0.0
    speed = _programmed(spindle, settings)
    gear, notes, alarms = _geared(spindle, settings, speed)
    lag = above_zero(settings, "move.drive_time", SLOWEST) or DRIVE_TIME
    reached = number(settings, "move.reached")
    estop = above_zero(settings, "move.estop_time", LONGEST)
    commanded = before if gear is None else math.copysign(min(abs(speed), gear.full), speed)
    lasts = ramp_time(before, commanded, gear) if gear else 0.0
    if lasts > LONGEST:
        raise SimulationError(f"The ramp takes {lasts:g} s, more than {LONGEST:g} s", "move.speed")
    time = np.arange(0.0, max(lasts, estop or 0.0) + AFTER * lag + 0.2, STEP)
    command = ramp(before, commanded, gear, spindle.iteration)(time) if gear else np.full_like(time, before)
    if estop is not None:
        command = np.where(time >= estop, 0.0, command)
        notes.append(f"Emergency stop: the output is 0 at once, without a ramp ({page_text(spindle.page)}).")
    aim = command if reached is None or speed == 0.0 else command * (reached / speed)
    actual = lagged(time, aim, before, lag)
    output = np.array([gear.output_at(float(each)) if gear else 0.0 for each in command])
    result = _of_gear(spindle, gear, commanded, lasts) | _gap(spindle)
    columns = {"time_s": time, "command_velocity": command, "velocity": actual, "output": output}
    units = {"time_s": "s", "command_velocity": "rpm", "velocity": "rpm", "output": spindle.unit}
    if spindle.watch and gear:
        result |= _watched(spindle.watch, time, actual, before, commanded, columns, units)
    return Trace(
        scenario="spindle",
        axis="",
        model=spindle.title,
        columns=columns,
        units=units,
        result=result,
        alarms=tuple(alarms),
        assumptions=(*notes, *spindle.notes, LAG.format(value_text(lag, "s"))),
    )


def _programmed(spindle: Spindle, settings: ScenarioSettings) -> float:
    """Return the programmed speed in rpm; raises SimulationError where none is given."""
    if settings.get("move.speed") == HIGHEST:
        return max((gear.high for gear in spindle.gears), default=0.0)
    speed = number(settings, "move.speed")
    if speed is None:
        raise SimulationError("Give the programmed speed: move.speed, as 1500", "move.speed")
    return speed


def _of_gear(spindle: Spindle, gear: Gear | None, commanded: float, lasts: float) -> dict[str, Figure]:
    """Return the figures of the gear that is in; None for each where no gear has the speed."""
    units = {
        "gear": "",
        "output": spindle.unit,
        "ramp_time": "s",
        "speed": "rpm",
        "gear_low": "rpm",
        "gear_high": "rpm",
    }
    if gear is None:
        return {name: (None, unit) for name, unit in units.items()}
    figures = (float(gear.name), gear.output_at(commanded), lasts, commanded, gear.low, gear.high)
    return {name: (figure, unit) for (name, unit), figure in zip(units.items(), figures, strict=True)}


def _gap(spindle: Spindle) -> dict[str, Figure]:
    """Return the widest range of speeds between two gears that no gear has; none where there is none."""
    gears = sorted(spindle.gears, key=lambda gear: gear.low)
    reached = [max(gear.high for gear in gears[: n + 1]) for n in range(len(gears))]
    gaps = [(low, gear.low) for low, gear in zip(reached, gears[1:], strict=False) if gear.low > low]
    widest = max(gaps, key=lambda gap: gap[1] - gap[0], default=None)
    return {} if widest is None else {"gap_low": (widest[0], "rpm"), "gap_high": (widest[1], "rpm")}


def spindle_of(machine: BoundMachine, settings: ScenarioSettings) -> Spindle:
    """Return the spindle that is asked for; raises SimulationError where there is none."""
    law = machine.law
    if law.spindle is None:
        raise SimulationError("No output to a spindle is printed for this family")
    chosen = settings.get("move.spindle")
    name = f"{chosen:g}" if isinstance(chosen, float) else str(chosen or "1")
    return law.spindle(machine.parameters, name)


def _geared(
    spindle: Spindle, settings: ScenarioSettings, speed: float
) -> tuple[Gear | None, list[str], list[Alarm]]:
    """Return the gear, notes, and the alarm where none has the speed."""
    notes: list[str] = []
    present = _name_of_gear(settings.get("move.gear"))
    if spindle.refusal:
        notes.append(spindle.refusal)
        return None, notes, [Alarm(spindle.no_gear, 0.0, spindle.refusal)]
    if spindle.clipped:
        return spindle.gears[0], _clipped(spindle, speed), []
    found: Gear | None
    if speed == 0.0:
        found, assumption = (spindle.gear_for(spindle.gears[0].low, present)[0] or spindle.gears[0]), ""
    else:
        found, assumption = spindle.gear_for(
            speed, present, programmed=spindle.programs_ranges and present is not None
        )
    if assumption:
        notes.append(assumption)
    if found is None:
        ranges = ", ".join(f"{gear.name}: {gear.low:g} to {gear.high:g}" for gear in spindle.gears)
        where = f"Range {present} does not have" if present else "No gear has"
        text = f"{where} {value_text(abs(speed), 'rpm', 6)} ({ranges} rpm; {page_text(spindle.page)})"
        return None, notes, [Alarm(spindle.no_gear, 0.0, text)]
    return found, notes, []


def _clipped(spindle: Spindle, speed: float) -> list[str]:
    """Return the note that a speed outside of the one range is taken to its nearest end."""
    gear = spindle.gears[0]
    if gear.low <= abs(speed) <= gear.high or speed == 0.0:
        return []
    allowed = f"{value_text(gear.low, 'rpm')} to {value_text(gear.high, 'rpm')}"
    end = f"the nearest end is used ({page_text(spindle.page)})"
    return [f"{value_text(abs(speed), 'rpm')} is outside of {allowed}: {end}."]


def _name_of_gear(given: object) -> str | None:
    if given is None:
        return None
    return f"{given:g}" if isinstance(given, float) else str(given)


def ramp_time(before: float, after: float, gear: Gear) -> float:
    """Return how long the ramp of the output takes, s."""
    return abs(after - before) * gear.ramp_time / gear.ramp_top if gear.ramp_time and gear.ramp_top else 0.0


def ramp(before: float, after: float, gear: Gear, iteration: float) -> Callable[[Series], Series]:
    """Return the commanded speed over time: a straight ramp,
    in steps of an iteration where the control makes them.
    """
    lasts = ramp_time(before, after, gear)

    def course(time: Series) -> Series:
        if lasts == 0.0:
            return np.full_like(time, after)
        # The output changes once an iteration, at its begin to what the ramp is at its end.
        moment = np.floor(time / iteration + 1e-9) * iteration + iteration if iteration else time
        found: Series = before + (after - before) * np.clip(moment / lasts, 0.0, 1.0)
        return found

    return course


def lagged(time: Series, aim: Series, start: float, lag: float) -> Series:
    """Return what follows an aim as a first-order lag, sampled where the aim is."""
    out, now, share = np.empty_like(time), start, 1.0 - math.exp(-STEP / lag)
    for n, wanted in enumerate(aim.tolist()):
        out[n] = now
        now += share * (wanted - now)
    return out


def _watched(
    watch: SpeedWatch,
    time: Series,
    actual: Series,
    before: float,
    after: float,
    columns: dict[str, Series],
    units: dict[str, str],
) -> dict[str, Figure]:
    """Add the expected speed to the columns; returns for how long the flag is set, and the band at the
    end.
    """
    share = np.clip(time / watch.time, 0.0, 1.0) if watch.time else np.ones_like(time)
    expected = before + (after - before) * share
    columns["expected_speed"], units["expected_speed"] = expected, "rpm"
    # A share of nothing is nothing: what is asked for at rest is not printed, and the flag is left off there.
    outside = (np.abs(actual - expected) > watch.tolerance * np.abs(expected)) & (expected != 0.0)
    low, high = sorted((after * (1.0 - watch.tolerance), after * (1.0 + watch.tolerance)))
    return {
        "deviation_low": (low, "rpm"),
        "deviation_high": (high, "rpm"),
        "deviation_time": (float(np.count_nonzero(outside)) * STEP, "s"),
        "deviation_at_end": (float(outside[-1]), ""),
    }


def _oriented(spindle: Spindle, settings: ScenarioSettings) -> Trace:
    """Orient a spindle: to the orient speed, to the marker where it is not known, then to the angle."""
    orient = spindle.orient
    if orient is None:
        raise SimulationError(
            f"The orient of spindle {spindle.name} is not set, or not printed for this family", "move.orient"
        )
    speed = number(settings, "move.speed")
    given = settings.get("move.orient")
    angle = orient.angle if given in ("yes", True) else number(settings, "move.orient")
    assert angle is not None
    gear, notes, alarms = _orient_gear(spindle, settings, speed)
    unknown = settings.get("move.marker", "known")
    if unknown not in ("known", "unknown"):
        raise SimulationError("move.marker must be known or unknown", "move.marker")
    start = number(settings, "move.position") or 0.0
    before = number(settings, "move.from") or speed or 0.0
    sign = math.copysign(1.0, before) if before else orient.sign
    turning = before != 0.0 or unknown == "unknown"
    lasts = ramp_time(before, sign * orient.speed, gear) if turning else 0.0
    # 1 rpm is 6 deg/s.
    at = start + (before + sign * orient.speed) / 2.0 * 6.0 * lasts
    way = _way(orient, at, angle, sign, turning=turning, unknown=unknown == "unknown")
    rows = _approach(orient, gear, start, before, lasts, at, way, sign, turning=turning)
    time, position, velocity, done = rows
    end = at + way
    notes.append(
        "Before the marker is known the direction is that of the file, then the marker and its calibration"
        f" are passed ({page_text(orient.page)})."
        if unknown == "unknown"
        else (
            "A spindle that turns goes on in its direction, one at rest the shortest way (page"
            f" {orient.page})."
        )
    )
    notes.append(
        "ASSUMED: the marker is where the angle is 0; at the end the position loop is a first-order lag of"
        " its gain, without the lag of the drive."
    )
    result: dict[str, Figure] = {
        "orient_angle": (angle % 360.0, "deg"),
        "orient_turn": (end - start, "deg"),
        "time": (done, "s"),
        "speed": (sign * orient.speed, "rpm"),
        "following_error": (orient.speed * 6.0 / gear.gain, "deg"),
        "gear": (float(gear.name), ""),
        "in_position_band": (orient.band, "deg"),
    }
    return Trace(
        scenario="spindle",
        axis="",
        model=spindle.title,
        columns={"time_s": time, "position": position, "velocity": velocity},
        units={"time_s": "s", "position": "deg", "velocity": "rpm"},
        result=result,
        alarms=tuple(alarms),
        assumptions=(*notes, *spindle.notes),
    )


def _orient_gear(
    spindle: Spindle, settings: ScenarioSettings, speed: float | None
) -> tuple[Gear, list[str], list[Alarm]]:
    """Return the gear of a speed, or the first one, in which a spindle is oriented, with notes and alarms;
    raises SimulationError for a gear without a gain.
    """
    notes: list[str] = []
    alarms: list[Alarm] = []
    gear = spindle.gears[0] if spindle.gears and speed is None else None
    if speed is not None:
        gear, notes, alarms = _geared(spindle, settings, speed)
    if gear is None or gear.gain <= 0.0:
        raise SimulationError(
            f"No gain is set for the gear in which spindle {spindle.name} is oriented", "move.orient"
        )
    return gear, notes, alarms


def _way(orient: Orient, at: float, angle: float, sign: float, *, turning: bool, unknown: bool) -> float:
    """Return the signed way in deg from an angle to the orient angle."""
    if unknown:  # on to the marker at 0, by the calibration, then to the angle
        # In the direction of rotation: a spindle that turns does not go back.
        to_marker = sign * ((-sign * at) % 360.0)
        calibration = sign * (sign * orient.calibration % 360.0)
        return to_marker + calibration + _shortest(angle)
    target = angle + orient.calibration
    if turning:
        return sign * ((sign * (target - at)) % 360.0)
    return _shortest(target - at)


def _shortest(way: float) -> float:
    found = way % 360.0
    return found - 360.0 if found > HALF_TURN else found


def _approach(
    orient: Orient,
    gear: Gear,
    start: float,
    before: float,
    lasts: float,
    at: float,
    way: float,
    sign: float,
    *,
    turning: bool,
) -> tuple[Series, Series, Series, float]:
    """Return time, angle, speed, and when the spindle is oriented: a ramp, an even way,
    and the loop that ends it.
    """
    rate = orient.speed * 6.0  # deg/s
    loop = rate / gear.gain  # deg: where the position loop gives the orient speed
    goes = math.copysign(1.0, way) if way else sign
    even = max(abs(way) - loop, 0.0) / rate
    fades = min(abs(way), loop)
    standstill_band = orient.standstill * 6.0 / gear.gain if math.isfinite(orient.standstill) else math.inf
    # The position loop fades as an exponential and never reaches a band of 0.
    band = min(max(orient.band, 1e-6), standstill_band)
    settles = math.log(fades / band) / gear.gain if fades > band else 0.0
    done = lasts + even + settles
    time = np.arange(0.0, done + 3.0 / gear.gain + STEP, STEP)
    up = np.minimum(time, lasts)
    slope = (sign * rate - before * 6.0) / lasts if lasts else 0.0
    first = start + before * 6.0 * up + 0.5 * slope * up * up
    mid = np.clip(time - lasts, 0.0, even)
    tail = np.maximum(time - lasts - even, 0.0)
    left = fades * np.exp(-gear.gain * tail)
    position = np.where(time < lasts, first, at + goes * (rate * mid + (fades - left)))
    speed = np.where(
        time < lasts,
        before * 6.0 + slope * time,
        np.where(time < lasts + even, goes * rate, goes * left * gear.gain),
    )
    if not turning and lasts == 0.0 and even == 0.0:
        speed = goes * left * gear.gain
    return time, position, speed / 6.0, done


SCENARIO = Scenario(
    "spindle",
    "What an S word makes of a spindle: gear, output, ramp, deviation; orient",
    SETTINGS,
    run_spindle,
    gains=False,
    of_machine=True,
    part="spindle",
    headline="speed",
    checked=("gear", "output", "ramp_time", "speed"),
    once=True,
    programmed={"move.speed": HIGHEST},
)
