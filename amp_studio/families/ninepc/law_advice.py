"""Recommendations about a 9/PC axis: limits of the following error, which follow its gains, and ramps,
each with page and price.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from amp_studio.sim import AxisLaw, Recommendation, Source, Trace, rounded_down, rounded_up, value_text

from . import law_samples as samples
from .law_figures import Loop, following_error, printed_excess_error, response_time

_RESERVE = 0.8
"""Share of the available acceleration that a ramp may use; the rest is a reserve for load and wear.
A choice of this program."""
_ORDER_COST = "Less is left for a faster move or a lower gain."
_SLOWER = "Every change of speed takes longer."
LOOSE = 2.0
"""Ratio of excess error to the recommended one from which it is too large. A choice of this program."""


@dataclass(frozen=True)
class ServoFigures:
    """An axis and the feedrate in u/s that its limits are for."""

    axis: AxisLaw
    loop: Loop
    feedrate: float

    @property
    def p(self) -> Sequence[float]:
        return self.axis.parameters

    @property
    def rapid(self) -> float:
        return self.axis.feedrate or self.feedrate

    def speed(self, velocity: float) -> str:
        return value_text(velocity * 60.0, f"{self.axis.unit}/min")

    def length(self, value: float) -> str:
        return value_text(value, self.axis.unit)

    def advise(
        self, name: str, value: float, unit: str, why: str, price: str, *, up: bool = True
    ) -> Iterator[Recommendation]:
        """Yield the value in unit and bounds of the parameter behind a figure."""
        source = self.axis.sources.get(name, Source(name))
        value = rounded_up(value) if up else rounded_down(value)
        if source.whole:
            value = float(math.ceil(value) if up else math.floor(value))
        # The control takes no more (Patch AMP checks no range): the recommendation ends there and states
        # it.
        if value > source.largest:
            value = source.largest
            why = f"{why[:-1]}; the upper limit of {source.parameter} is {value_text(value)}."
        why = f"{why[:-1]} (page {source.page})." if source.page else why
        yield Recommendation(
            source.parameter, value, unit if source.unit is None else source.unit, why, price
        )


@dataclass(frozen=True)
class SimulatedMove(ServoFigures):
    """A move that was simulated."""

    trace: Trace


def advise(axis: AxisLaw, trace: Trace) -> tuple[Recommendation, ...]:
    """Return the recommendations after the scenario `step`, the most urgent first; none after others, with an
    open position loop or an axis that is not stable.
    """
    p = axis.parameters
    if trace.scenario != "step" or p[samples.OPEN] or not math.isfinite(p[samples.EXCESS]):
        return ()
    if any(alarm.code == "UNSTABLE" for alarm in trace.alarms):
        return ()  # no figure of such a move means anything
    move = SimulatedMove(axis, _loop(axis), (trace.result["feedrate"][0] or 0.0) / 60.0, trace)
    parts = (_excess_error, _order, _suppression, _ramp, _gain_break, _band)
    return tuple(each for part in parts for each in part(move))


def follow(axis: AxisLaw) -> tuple[Recommendation, ...]:
    """Return the limits of the following error that fit the gains of an axis (7-20)."""
    if axis.parameters[samples.OPEN] or not axis.feedrate:
        return ()
    figures = ServoFigures(axis, _loop(axis), axis.feedrate)
    return (*_excess_error(figures), *_order(figures))


def _loop(axis: AxisLaw) -> Loop:
    p = axis.parameters
    gain = p[samples.GAIN] * 60.0 / 1000.0
    return Loop(gain, p[samples.BREAK_POINT], p[samples.BREAK_RATIO], p[samples.FEED_FORWARD])


def _excess_target(m: ServoFigures) -> float:
    """Return 110 % of the largest following error where the present limit is below that error
    or far above it, else the limit.
    """
    wanted, now = printed_excess_error(m.loop, m.rapid), m.p[samples.EXCESS]
    return wanted if math.isfinite(wanted) and (now < wanted / 1.1 or now > LOOSE * wanted) else now


def _excess_error(m: ServoFigures) -> Iterator[Recommendation]:
    """Yield the recommendation to allow 110 % of the following error that the rapid speed needs."""
    now, wanted = m.p[samples.EXCESS], _excess_target(m)
    if wanted == now:
        return
    speed = f"At {m.speed(m.rapid)} the following error reaches {m.length(wanted / 1.1)}"
    if now < wanted:
        why = (
            f"{speed}, but the EXCESS FOLLOWING ERROR alarm comes at {m.length(now)}: allow 110 % of the"
            " error."
        )
    else:
        late = value_text((now - wanted) / m.rapid, "s", 3)
        why = (
            f"{speed}; at {m.length(now)} a blocked axis is detected {late} later than with 110 % of the"
            " error."
        )
    price = "A blocked axis is detected later." if now < wanted else _ORDER_COST
    yield from m.advise("excess_error", wanted, m.axis.unit, why, price)


def _order(m: ServoFigures) -> Iterator[Recommendation]:
    """A smaller excess error also lowers the limits below it (7-20);
    otherwise the control corrects them itself.
    """
    highest = _excess_target(m)
    # Only a smaller excess error can fall below the limits under it.
    if highest >= m.p[samples.EXCESS] or highest >= m.p[samples.SUPPRESSION]:
        return
    limits = "each limit of the following error must not be above the next one"
    why = f"Lower the feedrate suppression point together with the excess error: {limits}."
    yield from m.advise("feedrate_suppression", highest, m.axis.unit, why, _ORDER_COST)
    point = m.axis.limits.get("gain break point", math.inf)
    cutting = m.p[samples.CUTTING] or 0.5 * m.feedrate
    # Not below two in-position bands: the break must not come into the band in which the axis rests.
    wanted = max(cutting / m.loop.rate, 2.0 * m.axis.inposition_band)
    if highest <= point < math.inf and wanted < highest:
        why = f"Lower the gain break point too, to the following error at the cutting feedrate: {limits}."
        yield from m.advise("gain_break_point", wanted, m.axis.unit, why, _ORDER_COST)


def _suppression(m: SimulatedMove) -> Iterator[Recommendation]:
    """Yield the recommendation to raise the level at which the feedrate was halved."""
    limit, point = _excess_target(m), m.p[samples.SUPPRESSION]
    lost = int((m.trace.columns["feed_share"] < 1.0).sum()) * _step(m)
    # Above the excess error it never acts: there is nothing to gain.
    if lost == 0.0 or limit <= point:
        return
    why = (
        f"The feedrate was halved for {value_text(lost, 's', 3)} of this move, because the following "
        "error was"
        f" above {m.length(point)}; {m.speed(m.feedrate)} alone needs"
        f" {m.length(following_error(m.loop, m.feedrate))}. A value equal to the excess error switches"
        " suppression off; a value between them keeps it as a warning."
    )
    price = "A following error that grows no longer slows the axis before the alarm."
    yield from m.advise("feedrate_suppression", limit, m.axis.unit, why, price)


def _step(m: SimulatedMove) -> float:
    time = m.trace.columns["time_s"]
    return float(time[-1] - time[0]) / max(1, len(time) - 1)


def _ramp(m: SimulatedMove) -> Iterator[Recommendation]:
    """Ramps against the torque there is and against the servo's own response (10-2)."""
    import numpy as np  # what binds an axis only needs none

    ramp = m.axis.ramps.get("linear")
    acceleration = np.abs(np.diff(m.trace.columns["command_velocity"] / 60.0)) / _step(m)
    used = float(acceleration.max()) if acceleration.size else 0.0
    unit = f"{m.axis.unit}/s2"
    speed = m.rapid if m.loop.feed_forward else m.feedrate
    natural = speed / response_time(m.loop)
    now = max(ramp.acceleration, ramp.deceleration) if ramp else 0.0
    if ramp is None or now == 0.0 or used > 1.01 * now:
        return  # the move was not made with the linear ramp of the axis
    # Of two ramps the steeper one uses the most torque; a change of the other would change nothing.
    steeper = "linear_deceleration" if ramp.deceleration > ramp.acceleration else "linear_acceleration"
    available = _RESERVE * _available(m)
    limited = _time_at_limit(m)
    if limited > 0.0 and now > available > 0.0:
        why = (
            f"The torque was at its limit for {value_text(limited, 's', 3)} with {value_text(now, unit)};"
            f" {value_text(available, unit)} is 80 % of what the torque allows at {m.speed(m.feedrate)}."
        )
        yield from m.advise(steeper, min(available, natural), unit, why, _SLOWER, up=False)
    elif now > natural:
        why = (
            f"A ramp of {value_text(now, unit)} is steeper than the servo's response of"
            f" {value_text(1000.0 * response_time(m.loop), 'ms')} to {m.speed(speed)} and acts like a step in"
            f" speed; the axis can follow up to {value_text(natural, unit)}."
        )
        yield from m.advise(steeper, natural, unit, why, _SLOWER, up=False)


def _available(m: SimulatedMove) -> float:
    """Return the acceleration in u/s2 that the lower torque limit leaves after friction at the feedrate."""
    machine = m.axis.machine
    limit = min(m.p[samples.LIMIT_POSITIVE], m.p[samples.LIMIT_NEGATIVE]) or machine.torque_limit_positive
    friction = machine.coulomb_friction + machine.viscous_friction * m.feedrate
    return machine.acceleration_per_output * (limit - friction)


def _time_at_limit(m: SimulatedMove) -> float:
    """Return for how many s the torque is at its limit."""
    import numpy as np

    torque = np.abs(m.trace.columns["torque"])
    limit = (
        min(m.p[samples.LIMIT_POSITIVE], m.p[samples.LIMIT_NEGATIVE]) or m.axis.machine.torque_limit_positive
    )
    # The current loop lags: the torque comes near its limit without reaching it.
    return float((torque >= 0.999 * limit).sum()) * _step(m)


def _gain_break(m: SimulatedMove) -> Iterator[Recommendation]:
    """Yield the recommendation to move the break of the gain above the cutting speeds."""
    cutting = m.axis.sources.get("cutting_feedrate")
    point = m.axis.limits.get("gain break point")
    if point is None or cutting is None or not m.p[samples.CUTTING]:
        return
    wanted = m.p[samples.CUTTING] / m.loop.rate
    if point < wanted:
        why = (
            f"The gain break is at {m.speed(point * m.loop.rate)}, below the maximum cutting feedrate"
            f" {m.speed(m.p[samples.CUTTING])}: contours above that speed are not accurate."
        )
        yield from m.advise(
            "gain_break_point",
            wanted,
            m.axis.unit,
            why,
            "The full gain at higher speeds is harder on the mechanism.",
        )


def _band(m: SimulatedMove) -> Iterator[Recommendation]:
    """Yield the recommendation to widen a band of less than a count to two."""
    count = m.p[samples.COUNT]
    if m.axis.inposition_band >= count:
        return
    why = (
        f"One count is {m.length(count)}: inside a band of {m.length(m.axis.inposition_band)} the in-position"
        " state is not reliable; use at least two counts."
    )
    yield from m.advise(
        "inposition_band", 2.0 * count, m.axis.unit, why, "The axis may stop that much further away."
    )
