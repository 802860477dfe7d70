"""Recommendations after a move of a 9/PC axis: limits of the following error, ramps and velocity gains, each with page and price."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from amp_studio.sim.law import AxisLaw, Source
from amp_studio.sim.rounding import rounded_down, rounded_up, shown
from amp_studio.sim.trace import Recommendation, Trace

from . import law_samples as samples
from .law_figures import Loop, following_error, printed_excess_error, response_time
from .law_units import highest_rate, lag_of

RESERVE = 0.8
"""Share of the available acceleration that a ramp may use; the rest is a reserve for load and wear. A choice of this program."""
APERIODIC = 4.0
"""Least ratio of velocity loop to position loop without overshoot (Gross, Hamann, Wiegärtner, Electrical Feed Drives in
Automation, 2001)."""
SAFE = 0.5
"""Share of the loop rate at which it oscillates: 6 dB."""
INTEGRAL_SHARE = 10.0
"""The tuning procedure ends with an integral gain 5 to 10 times below the proportional one (A-9)."""
ORDER_PRICE = "Less is left for a faster move or a lower gain."
SLOWER = "Every change of speed takes longer."
LOOSE = 2.0
"""Ratio of excess error to the recommended one from which it is too large. A choice of this program."""


@dataclass(frozen=True)
class SimulatedMove:
    """A move that was simulated: axis, trace, feedrate in u/s."""

    axis: AxisLaw
    trace: Trace
    loop: Loop
    feedrate: float

    def figure(self, name: str) -> float:
        """Return a figure of the result, 0 where it was not reached."""
        return self.trace.result.get(name, (0.0, ""))[0] or 0.0

    @property
    def p(self) -> Sequence[float]:
        return self.axis.parameters

    @property
    def rapid(self) -> float:
        return self.axis.feedrate or self.feedrate

    def speed(self, velocity: float) -> str:
        return shown(velocity * 60.0, f"{self.axis.unit}/min")

    def length(self, value: float) -> str:
        return shown(value, self.axis.unit)

    def advise(
        self, name: str, value: float, unit: str, why: str, price: str, *, up: bool = True
    ) -> Iterator[Recommendation]:
        """Yield the value in unit and bounds of the parameter behind a figure."""
        source = self.axis.sources.get(name, Source(name))
        value = rounded_up(value) if up else rounded_down(value)
        if source.whole:
            value = float(math.ceil(value) if up else math.floor(value))
        if value > source.largest:
            value = source.largest
            why = f"{why[:-1]}; the upper limit of {source.parameter} is {shown(value)}."
        why = f"{why[:-1]} (page {source.page})." if source.page else why
        yield Recommendation(
            source.parameter, value, unit if source.unit is None else source.unit, why, price
        )


def advise(axis: AxisLaw, trace: Trace) -> tuple[Recommendation, ...]:
    """Return the recommendations after the scenario `step`, the most urgent first; none after others or with an open position loop."""
    p = axis.parameters
    if trace.scenario != "step" or p[samples.OPEN] or not math.isfinite(p[samples.EXCESS]):
        return ()
    feedrate = (trace.result["feedrate"][0] or 0.0) / 60.0
    gain = p[samples.GAIN] * 60.0 / 1000.0
    loop = Loop(gain, p[samples.BREAK_POINT], p[samples.BREAK_RATIO], p[samples.FEED_FORWARD])
    move = SimulatedMove(axis, trace, loop, feedrate)
    if any(alarm.code == "UNSTABLE" for alarm in trace.alarms):
        return tuple(_loops(move))  # no other figure of such a move means anything
    parts = (_excess_error, _order, _suppression, _ramp, _loops, _gain_break, _band)
    return tuple(each for part in parts for each in part(move))


def _excess_target(m: SimulatedMove) -> float:
    """Return 110 % of the largest following error where the present limit is below that error or far above it, else the limit."""
    wanted, now = printed_excess_error(m.loop, m.rapid), m.p[samples.EXCESS]
    return wanted if math.isfinite(wanted) and (now < wanted / 1.1 or now > LOOSE * wanted) else now


def _excess_error(m: SimulatedMove) -> Iterator[Recommendation]:
    now, wanted = m.p[samples.EXCESS], _excess_target(m)
    if wanted == now:
        return
    speed = f"At {m.speed(m.rapid)} the following error reaches {m.length(wanted / 1.1)}"
    if now < wanted:
        why = f"{speed}, but the EXCESS FOLLOWING ERROR alarm comes at {m.length(now)}: allow 110 % of the error."
    else:
        late = shown((now - wanted) / m.rapid, "s", 3)
        why = f"{speed}; at {m.length(now)} a blocked axis is detected {late} later than with 110 % of the error."
    price = "A blocked axis is detected later." if now < wanted else ORDER_PRICE
    yield from m.advise("excess_error", wanted, m.axis.unit, why, price)


def _order(m: SimulatedMove) -> Iterator[Recommendation]:
    """A smaller excess error also lowers the limits below it (7-20); otherwise the control corrects them itself."""
    highest = _excess_target(m)
    if highest >= m.p[samples.EXCESS] or highest >= m.p[samples.SUPPRESSION]:
        return
    limits = "each limit of the following error must not be above the next one"
    why = f"Lower the feedrate suppression point together with the excess error: {limits}."
    yield from m.advise("feedrate_suppression", highest, m.axis.unit, why, ORDER_PRICE)
    point = m.axis.limits.get("gain break point", math.inf)
    cutting = m.p[samples.CUTTING] or 0.5 * m.feedrate
    wanted = max(cutting / m.loop.rate, 2.0 * m.axis.inposition_band)
    if highest <= point < math.inf and wanted < highest:
        why = f"Lower the gain break point too, to the following error at the cutting feedrate: {limits}."
        yield from m.advise("gain_break_point", wanted, m.axis.unit, why, ORDER_PRICE)


def _suppression(m: SimulatedMove) -> Iterator[Recommendation]:
    limit, point = _excess_target(m), m.p[samples.SUPPRESSION]
    lost = int((m.trace.columns["feed_share"] < 1.0).sum()) * _step(m)
    if lost == 0.0 or limit <= point:
        return
    why = (
        f"The feedrate was halved for {shown(lost, 's', 3)} of this move, because the following error was above {m.length(point)};"
        f" {m.speed(m.feedrate)} alone needs {m.length(following_error(m.loop, m.feedrate))}. A value equal to the excess error switches"
        " suppression off; a value between them keeps it as a warning."
    )
    price = "A following error that grows no longer slows the axis before the alarm."
    yield from m.advise("feedrate_suppression", limit, m.axis.unit, why, price)


def _step(m: SimulatedMove) -> float:
    time = m.trace.columns["time_s"]
    return float(time[-1] - time[0]) / max(1, len(time) - 1)


def _ramp(m: SimulatedMove) -> Iterator[Recommendation]:
    """Ramps against the torque there is and against the servo's own response (10-2)."""
    ramp = m.axis.ramps.get("linear")
    acceleration = np.abs(np.diff(m.trace.columns["command_velocity"] / 60.0)) / _step(m)
    used = float(acceleration.max()) if acceleration.size else 0.0
    unit = f"{m.axis.unit}/s2"
    speed = m.rapid if m.loop.feed_forward else m.feedrate
    natural = speed / response_time(m.loop)
    now = max(ramp.acceleration, ramp.deceleration) if ramp else 0.0
    if ramp is None or now == 0.0 or used > 1.01 * now:
        return  # the move was not made with the linear ramp of the axis
    steeper = "linear_deceleration" if ramp.deceleration > ramp.acceleration else "linear_acceleration"
    available = RESERVE * _available(m)
    limited = _time_at_limit(m)
    if limited > 0.0 and now > available > 0.0:
        why = (
            f"The torque was at its limit for {shown(limited, 's', 3)} with {shown(now, unit)}; {shown(available, unit)} is 80 % of what the torque"
            f" allows at {m.speed(m.feedrate)}."
        )
        yield from m.advise(steeper, min(available, natural), unit, why, SLOWER, up=False)
    elif now > natural:
        why = (
            f"A ramp of {shown(now, unit)} is steeper than the servo's response of {shown(1000.0 * response_time(m.loop), 'ms')} to"
            f" {m.speed(speed)} and acts like a step in speed; the axis can follow up to {shown(natural, unit)}."
        )
        yield from m.advise(steeper, natural, unit, why, SLOWER, up=False)


def _available(m: SimulatedMove) -> float:
    """Return the acceleration in u/s2 that the lower torque limit leaves after friction at the feedrate."""
    machine = m.axis.machine
    limit = min(m.p[samples.LIMIT_POSITIVE], m.p[samples.LIMIT_NEGATIVE]) or machine.torque_limit_positive
    friction = machine.coulomb_friction + machine.viscous_friction * m.feedrate
    return machine.acceleration_per_output * (limit - friction)


def _time_at_limit(m: SimulatedMove) -> float:
    torque = np.abs(m.trace.columns["torque"])
    limit = (
        min(m.p[samples.LIMIT_POSITIVE], m.p[samples.LIMIT_NEGATIVE]) or m.axis.machine.torque_limit_positive
    )
    return float((torque >= 0.999 * limit).sum()) * _step(m)


def _loops(m: SimulatedMove) -> Iterator[Recommendation]:
    """Overshoot: ratio of the loops (7-54), integral gain (7-56, A-9), discharge rate (7-58)."""
    over, p = (
        m.figure("overshoot") - m.axis.machine.backlash,
        m.p,
    )  # no gain changes how far the load runs in its gap
    if over <= max(m.axis.inposition_band, 2.0 * p[samples.COUNT]) or p[samples.PROPORTIONAL] == 0.0:
        return
    ran = f"The axis overshot the end position by {m.length(over)}"
    rate = p[samples.PROPORTIONAL] * m.axis.machine.acceleration_per_output
    ratio, gain = rate / m.loop.rate, _gain(m, samples.PROPORTIONAL)
    most = SAFE * highest_rate(_lag(m), _integral_time(m))
    if ratio < APERIODIC and APERIODIC * m.loop.rate > most:
        why = (
            f"{ran}: the velocity loop is only {shown(ratio, digits=2)} times as fast as the position loop, and on this axis it cannot be made 4 times"
            " as fast without oscillating."
        )
        price = "The following error grows in proportion."
        yield from m.advise(
            "position_gain", m.loop.gain * most / APERIODIC / m.loop.rate, "", why, price, up=False
        )
    elif ratio < APERIODIC:
        why = (
            f"{ran}: the velocity loop is only {shown(ratio, digits=2)} times as fast as the position loop; from 4 times on the position loop does"
            " not overshoot."
        )
        price = "A higher gain is louder and nearer to oscillation."
        yield from m.advise("velocity_proportional_gain", gain * APERIODIC / ratio, "", why, price)
    elif p[samples.INTEGRAL] * INTEGRAL_SHARE > p[samples.PROPORTIONAL]:
        why = f"{ran}: the integral gain is more than a tenth of the proportional gain."
        yield from m.advise(
            "velocity_integral_gain",
            gain / INTEGRAL_SHARE,
            "",
            why,
            "A lasting load is corrected later.",
            up=False,
        )
    elif p[samples.INTEGRAL] > 0.0 and p[samples.DISCHARGE] < 2.0:
        why = f"{ran}: the sum of the velocity error was still large; with 2 it discharges twice as fast as it charges."
        yield from m.advise(
            "integrator_discharge", 2.0, "", why, "Too high a rate makes changes of speed rough."
        )


def _lag(m: SimulatedMove) -> float:
    """Return the lag of the velocity loop in s, the torque filter included."""
    passes = m.p[samples.FILTER]
    cutoff = -math.log1p(-passes) / (2.0 * math.pi * m.p[samples.PERIOD]) if passes < 1.0 else math.inf
    return lag_of(m.axis.machine.delay, m.axis.machine.bandwidth, cutoff)


def _integral_time(m: SimulatedMove) -> float:
    integral = m.p[samples.INTEGRAL]
    return m.p[samples.PROPORTIONAL] / integral * m.p[samples.PERIOD] if integral > 0.0 else math.inf


def _gain(m: SimulatedMove, place: int) -> float:
    """Return a velocity gain as the file has it."""
    return m.p[place] / m.p[samples.TORQUE_UNIT]


def _gain_break(m: SimulatedMove) -> Iterator[Recommendation]:
    cutting = m.axis.sources.get("cutting_feedrate")
    point = m.axis.limits.get("gain break point")
    if point is None or cutting is None or not m.p[samples.CUTTING]:
        return
    wanted = m.p[samples.CUTTING] / m.loop.rate
    if point < wanted:
        why = (
            f"The gain break is at {m.speed(point * m.loop.rate)}, below the maximum cutting feedrate {m.speed(m.p[samples.CUTTING])}: contours above"
            " that speed are not accurate."
        )
        yield from m.advise(
            "gain_break_point",
            wanted,
            m.axis.unit,
            why,
            "The full gain at higher speeds is harder on the mechanism.",
        )


def _band(m: SimulatedMove) -> Iterator[Recommendation]:
    count = m.p[samples.COUNT]
    if m.axis.inposition_band >= count:
        return
    why = (
        f"One count is {m.length(count)}: inside a band of {m.length(m.axis.inposition_band)} the in-position state is not reliable; use"
        " at least two counts."
    )
    yield from m.advise(
        "inposition_band", 2.0 * count, m.axis.unit, why, "The axis may stop that much further away."
    )
