"""The spindle output and the probe of Grbl and grblHAL (spindle_control.c, motion_control.c)."""

from __future__ import annotations

from amp_studio.sim import AxisLaw, AxisParameters, Gear, Probing, SimulationError, Spindle

from .law_facts import ids

_STEPPED = (
    "The duty cycle changes in one step; a speed outside of $31 to $30 is set to the nearest of both"
    " (spindle_control.c)."
)
_LATENCY = (
    "The position is taken at the step at which the probe is seen (stepper.c, probe state monitor): the"
    " latency is a step."
)


def spindle(read: AxisParameters, number: str) -> Spindle:
    """Return the PWM spindle; raises SimulationError without a highest speed."""
    if number != "1":
        raise SimulationError("The PWM spindle is number 1", "move.spindle")
    high = read.number(ids.max_speed, everywhere=True)
    low = read.optional(ids.min_speed, everywhere=True) or 0.0
    if not high > low:
        raise SimulationError("$30 must be above $31: the duty cycle is shared between both", ids.max_speed)
    least = read.optional(ids.pwm_min, everywhere=True) or 0.0
    most = read.optional(ids.pwm_max, everywhere=True)
    gear = Gear(
        "1", low, high, full=high, output=100.0 if most is None else most, least_output=least, least=low
    )
    title = "Grbl spindle: PWM output"
    return Spindle("1", title, "%", (gear,), "spindle_control.c", (_STEPPED,), clipped=True)


def probing(_read: AxisParameters, axis: AxisLaw, cycle: str) -> Probing:
    """Return G38.2: it decelerates where it is, and its position is that of the step that met the probe.
    Raises SimulationError for another.
    """
    name = cycle.upper() or "G38.2"
    if name not in ("G38.2", "G38.3"):
        raise SimulationError(f"Unknown cycle {cycle}. Known: G38.2, G38.3", "move.cycle")
    fails = "ALARM:5" if name == "G38.2" else ""
    return Probing(f"{name} probe", 0.0, axis.servo_period, _LATENCY, outside=fails, page="motion_control.c")
