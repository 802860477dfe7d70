"""Scenario `procedure`: the tuning procedure of appendix A on the simulated axis, step by step (A-8 to A-10).

Printed: the order of the steps, and what the strip chart recorder shows at each. By how much a gain is
changed is not: here it is raised and lowered by a tenth, the integral gain by a tenth too. An overshoot is
slight up to `SLIGHT` of the feedrate; an oscillation is one where the torque swings through a quarter of its
limits at the end of the constant speed or at rest.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from amp_studio.sim import (
    AxisLaw,
    Figure,
    Motion,
    ParameterValue,
    Ramp,
    RunEnd,
    Scenario,
    SimulationError,
    Trace,
    above_zero,
    assumptions,
    column_units,
    end_of,
    move,
    per_minute,
    refuse_unknown,
    rounded_down,
    run_axis,
    value_text,
)

from . import law_samples as samples
from .law_notes import TUNING_START

_SETTINGS = {
    "move.feedrate": "feedrate of the tuning move (mm/min or deg/min); default: Maximum Cutting Feedrate"
}
SLIGHT = 0.02
"""Share of the feedrate."""
SWING = 0.5
"""Share of the torque limit through which the torque swings in an oscillation."""
STEP = 1.1
"""Factor from one gain to the next one tried."""
_MAX_GAIN = 65535.0
"""Both gains end there (7-54, 7-57)."""
_FIRST_INTEGRAL = 50.0
"""The first integral gain is the proportional one divided by this."""
_LONGEST = 30.0
"""s of one tuning move."""
_WINDOW = 0.15
"""s in which a swing is looked for."""
_BELOW = 0.8
"""Share of what the torque allows for the ramp: "slightly less" than the servo can do (A-2)."""


@dataclass(frozen=True)
class Chart:
    """What the recorder shows of one tuning move."""

    motion: Motion
    overshoot: float
    """Share of the feedrate."""
    moving: float
    """Swing of the torque at the end of the constant speed, as a share of its limit."""
    resting: float
    """The same at rest."""

    @property
    def clean(self) -> bool:
        """Whether there is neither more than a slight overshoot nor an oscillation."""
        return self.overshoot < SLIGHT and self.moving < SWING and self.resting < SWING


@dataclass(frozen=True)
class Tuned:
    """The end of the procedure: both gains, the highest proportional gain alone,
    the integral gain that nothing stops.
    """

    highest: float
    proportional: float
    integral: float
    unstoppable: float


def with_gains(axis: AxisLaw, proportional: float, integral: float) -> AxisLaw:
    """Return the axis with other gains and set as in Table A.A: no torque filter, discharge rate 1,
    no torque offset.
    """
    p = list(axis.parameters)
    p[samples.PROPORTIONAL] = proportional * p[samples.TORQUE_UNIT]
    p[samples.INTEGRAL] = integral * p[samples.TORQUE_UNIT]
    p[samples.FILTER], p[samples.DISCHARGE] = 1.0, 1.0
    # An alarm would cut off the chart of a gain that is only too low yet.
    p[samples.EXCESS] = p[samples.SUPPRESSION] = math.inf
    return replace(axis, parameters=p)


def chart(axis: AxisLaw, feedrate: float, proportional: float, integral: float) -> Chart:
    """Make the tuning move at ``feedrate`` u/s with these gains; the position loop is closed,
    as the manual recommends (A-8).
    """
    axis = with_gains(axis, proportional, integral)
    limit = min(axis.parameters[samples.LIMIT_POSITIVE], axis.parameters[samples.LIMIT_NEGATIVE])
    lag = 1.0 / axis.position_rate
    ramp = min(_BELOW * limit * axis.machine.acceleration_per_output, feedrate / (2.0 * lag))
    # Both ramps together, 0.8 s and five time constants of constant speed: long enough for an overshoot to
    # die away before the braking.
    profile = move(feedrate * (feedrate / ramp + 0.8 + 5.0 * lag), feedrate, Ramp("linear", ramp, ramp))
    end = end_of(profile)
    if end > _LONGEST:
        raise SimulationError(
            f"The tuning move of axis {axis.axis} takes {value_text(end, 's', 3)}; at most {_LONGEST:g} s are"
            " simulated. Raise its position gain or torque limits"
        )
    motion = run_axis(axis, profile, RunEnd(end + 13.0 * lag), engine="compiled", thin=True)
    time, velocity, torque = (motion.columns[name] for name in ("time_s", "velocity_feedback", "output"))
    # Cut off by an alarm or unstable: worse than any figure.
    if motion.stop or time[-1] < end:
        return Chart(motion, math.inf, math.inf, math.inf)
    braking = end - feedrate / ramp
    steady = (time > braking - _WINDOW) & (time < braking)
    rest = time > time[-1] - _WINDOW
    return Chart(
        motion,
        float(velocity[time < braking].max()) / feedrate - 1.0,
        float(np.ptp(torque[steady])) / limit,
        float(np.ptp(torque[rest])) / limit,
    )


def highest(axis: AxisLaw, feedrate: float) -> float:
    """Return the highest proportional gain that is clean without an integral one (steps 1 to 4).

    Raises SimulationError where the axis is not clean at any gain.
    """
    gain = TUNING_START
    while not chart(axis, feedrate, gain, 0.0).clean:  # underdamped at the start: too light or too heavy
        gain *= STEP
        if gain > _MAX_GAIN:
            gain = _below(axis, feedrate, TUNING_START, 0.0)
            break
    while gain * STEP <= _MAX_GAIN and chart(axis, feedrate, gain * STEP, 0.0).clean:
        gain *= STEP
    return gain


def _below(axis: AxisLaw, feedrate: float, proportional: float, integral: float) -> float:
    found = lowered(axis, feedrate, proportional, integral)
    if found is None:
        raise SimulationError(f"No proportional gain keeps axis {axis.axis} from overshoot or oscillation")
    return found


def lowered(axis: AxisLaw, feedrate: float, proportional: float, integral: float) -> float | None:
    """Return the first clean proportional gain at or below, None if there is none down to an eighth (step
    6).
    """
    gain = proportional
    while gain > proportional / 8.0:
        if chart(axis, feedrate, gain, integral).clean:
            return gain
        gain /= STEP
    return None


def procedure(axis: AxisLaw, feedrate: float) -> Tuned:
    """Return where the procedure ends: the integral gain raised
    and the proportional one lowered in turn (steps 5 to 7).
    """
    first = proportional = highest(axis, feedrate)
    integral, last = proportional / _FIRST_INTEGRAL, 0.0
    while (found := lowered(axis, feedrate, proportional, integral)) is not None and integral <= _MAX_GAIN:
        proportional, last, integral = found, integral, integral * STEP
    return Tuned(first, proportional, last, integral)


def procedure_run(axis: AxisLaw, settings: Mapping[str, ParameterValue]) -> Trace:
    """Run the procedure; raises SimulationError for an axis without a digital velocity loop
    or a closed position loop.
    """
    refuse_unknown(settings, _SETTINGS)
    if axis.velocity_sample is None or axis.parameters[samples.OPEN]:
        raise SimulationError(
            f"Axis {axis.axis} has no digital velocity loop inside a closed position loop to tune (A-1)"
        )
    if min(axis.parameters[samples.LIMIT_POSITIVE], axis.parameters[samples.LIMIT_NEGATIVE]) <= 0.0:
        raise SimulationError(f"A torque limit of axis {axis.axis} is 0: it cannot move")
    # Alone, without the other servo of a split axis: one is tuned after the other.
    axis = replace(axis, after=None)
    given = above_zero(settings, "move.feedrate")
    feedrate = given / 60.0 if given else axis.parameters[samples.CUTTING] or axis.feedrate
    if not feedrate:
        raise SimulationError(
            "The cutting feedrate of the axis is not set. Give a feedrate for the move", "move.feedrate"
        )
    found = procedure(axis, feedrate)
    # Rounded down: the procedure ends at the edge of stability, and a gain above it would be over it.
    proportional, integral = (rounded_down(each) for each in (found.proportional, found.integral))
    last = chart(axis, feedrate, proportional, integral)
    result: dict[str, Figure] = {
        "feedrate": (feedrate * 60.0, f"{axis.unit}/min"),
        "highest_proportional_gain": (rounded_down(found.highest), ""),
        "velocity_proportional_gain": (proportional, ""),
        "velocity_integral_gain": (integral, ""),
        "gain_ratio": (found.proportional / found.integral if found.integral else None, ""),
        "oscillating_integral_gain": (rounded_down(found.unstoppable), ""),
        "overshoot": (max(0.0, 100.0 * last.overshoot), "%"),
    }
    return Trace(
        scenario="procedure",
        axis=axis.axis,
        model=axis.title,
        columns=per_minute(last.motion.columns),
        units=column_units(axis),
        result=result,
        assumptions=(NOTE, *assumptions(axis)),
    )


NOTE = (
    "Appendix A (A-8 to A-10) on the simulated axis, without torque filter and with discharge rate 1 (Table"
    " A.A): the gains fit the assumed machine; steps of a tenth, an overshoot of 2 % and a swing of half the"
    " torque limit are choices of this program. It ends at the edge of stability; tune finds gains with a"
    " reserve."
)


SCENARIO = Scenario(
    "procedure",
    "The tuning procedure of appendix A, step by step, up to where it ends",
    _SETTINGS,
    procedure_run,
)
