"""Spindles and solid tapping of a 9/PC (chapters 12, 14 and 27)."""

from __future__ import annotations

from amp_studio.sim import (
    AxisLaw,
    AxisParameters,
    BoundMachine,
    Gear,
    Orient,
    SimulationError,
    SpeedWatch,
    Spindle,
    Tapping,
)

from .law_facts import MOTION, ids

_GEARS = 8
_PER_GAIN = 1000.0 / 60.0
"""1/s for a gain of 1 rpm in 0.001 revolutions (12-15)."""
_RAMPED = (
    "The ramp takes Acceleration Time up to Maximum Tapping Speed with the solid tapping option, else Dev."
    " Detection Filter Time up to Max. Spindle Speed (12-3); its table names the ramp parameter itself for"
    " the second, which is a slip. ASSUMED: the option is there where Acceleration Time is set."
)
_STEPPED = "Spindle DAC Output Ramping is off: the output changes in one step (12-3)."
_SHARED = "ASSUMED: the output is in proportion to the speed, to Voltage at Max at Max. Spindle Speed (12-5)."
_NO_GEARS = (
    "A gear that is used has no legal minimum and maximum speed, or no tapping values: the control takes it"
    " that no gears are there and never requests one (12-8, 27-2)"
)
_TAPPED = (
    "While tapping, the lower gain and the lower acceleration of axis and spindle are those of both (12-15,"
    " 27-2)."
)
FORCED = "The axis has zero following error: the spindle is forced to the same loop and feed-forward (27-1)."
_SIGN = {"clockwise": 1.0, "counterclockwise": -1.0}


def spindle(read: AxisParameters, number: str) -> Spindle:
    """Return a spindle; raises SimulationError where no axis is it, or it is not set."""
    names = [str(n) for n in range(1, _gear_count(read, number) + 1)]
    gears = tuple(gear for name in names if (gear := _gear(read, number, name)) is not None)
    ramped = read.value(ids.dac_ramping, at=number) is True
    notes = (_SHARED, _RAMPED if ramped else _STEPPED)
    # The code of a gear that is not requested is ours: the control shows none.
    return Spindle(
        number,
        f"9/PC spindle {number}: {len(names)} gear{'s' if len(names) != 1 else ''}, analog output",
        "V",
        gears,
        "12-3 to 12-9",
        notes,
        iteration=_logic_scan(read) if ramped else 0.0,
        orient=_orient(read, number),
        watch=_watch(read, number),
        refusal=_NO_GEARS if len(gears) < len(names) else "",
    )


def _gear_count(read: AxisParameters, number: str) -> int:
    """Return how many gears a spindle uses; raises SimulationError where no axis is it, or it is not set."""
    fitted = (axis for axis in MOTION.axes if read.value(ids.axis_type, at=axis) == "spindle")
    if not any(read.value(ids.spindle_type, at=axis) == f"s{number}" for axis in fitted):
        raise SimulationError(f"No axis is spindle {number} (3-5, 7-82)", ids.axis_type)
    count = read.optional(ids.gear_count, at=number)
    if count is None:
        raise SimulationError(f"Number of Gears Used of spindle {number} is not set", ids.gear_count)
    return min(int(count), _GEARS)


def _logic_scan(read: AxisParameters) -> float:
    """Return s of a scan of the logic, at which a ramped output is written; 0 where it is not known."""
    fine = read.optional(ids.fine_foreground, everywhere=True)
    scans = read.optional(ids.scans_per_logic, everywhere=True)
    return 0.0 if fine is None else fine * (scans or 1.0) / 1000.0


def _gear(read: AxisParameters, number: str, name: str) -> Gear | None:
    """Return a gear; None for one without legal values."""
    at = f"{number}.{name}"
    low = read.optional(ids.spindle_min_speed, at=at)
    high = read.optional(ids.spindle_max_speed, at=at)
    if low is None or high is None or not 0.0 <= low < high:
        return None
    volts = read.optional(ids.voltage_at_max, at=at)
    time, top = (
        read.optional(ids[f"tapping_{which}"], at=at) for which in ("acceleration_time", "max_speed")
    )
    ramp_time, ramp_top = _output_ramp(read, number, time, top, high)
    return Gear(
        name,
        low,
        high,
        full=high,
        output=10.0 if volts is None else volts,
        ramp_time=ramp_time,
        ramp_top=ramp_top,
        gain=(read.optional(ids.spindle_gain, at=at) or 0.0) * _PER_GAIN,
        tap_rate=top / 60.0 / (time / 1000.0) if time and top else 0.0,
        tap_speed=top or high,
    )


def _output_ramp(
    read: AxisParameters, number: str, tapping: float | None, top: float | None, high: float
) -> tuple[float, float]:
    """Return s that the ramp of an output takes and the rpm to which: the tapping time, in ms, to the tapping
    speed; the filter of the deviation to the highest one where no tapping time is set. 0 s without a ramp.
    """
    filtered = read.optional(ids.deviation_filter_time, at=number)
    time, ends_at = (tapping, top or high) if tapping else (filtered or 0.0, high)
    is_ramped = read.value(ids.dac_ramping, at=number) is True
    return (time / 1000.0 if is_ramped else 0.0), ends_at


def _orient(read: AxisParameters, number: str) -> Orient | None:
    """Return how a spindle is oriented, in rpm and deg; None where no speed is set."""
    speed = read.optional(ids.orient_speed, at=number)
    if not speed:
        return None
    direction = read.value(ids.orient_direction, at=number)
    return Orient(
        speed,
        _SIGN.get(str(direction), 1.0),
        read.optional(ids.marker_calibration, at=number) or 0.0,
        read.optional(ids.orient_angle, at=number) or 0.0,
        read.optional(ids.orient_inposition_band, at=number) or 0.0,
        page="12-10 to 12-15",
    )


def _watch(read: AxisParameters, number: str) -> SpeedWatch | None:
    tolerance = read.optional(ids.deviation_tolerance, at=number)
    if tolerance is None:
        return None
    time = (read.optional(ids.deviation_filter_time, at=number) or 0.0) / 1000.0
    return SpeedWatch(tolerance / 100.0, time, "Spindle Speed Deviation Excessive", "12-5")


def tapping(machine: BoundMachine, _spindle: Spindle, gear: Gear, axis: AxisLaw, pitch: float) -> Tapping:
    """Return how axis and spindle follow one command (12-15, 27-1, 27-2)."""
    read = machine.read(axis.axis)
    own = axis.position_rate
    gain = min(own, gear.gain) if gear.gain else own
    rates = [rate for rate in (next(iter(axis.ramps.values())).acceleration, gear.tap_rate * pitch) if rate]
    axis_gain = read.optional(ids.initial_gain)
    # The gain goes to the axis as its parameter, in the ratio of both loops: units cancel.
    overrides = {} if axis_gain is None or gain >= own else {ids.initial_gain: axis_gain * gain / own}
    forced = read.value(ids.position_loop_type) == "zfe"
    notes = (_TAPPED, FORCED) if forced else (_TAPPED,)
    forward = (read.optional(ids.feed_forward) or 0.0) / 100.0 if forced else 0.0
    return Tapping(
        overrides,
        gain,
        forward,
        min(rates, default=0.0),
        gear.tap_speed,
        page="12-15, 27-1, 27-2",
        notes=notes,
    )
