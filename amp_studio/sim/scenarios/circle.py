"""Scenario `circle`: two axes on a circle, as a ball-bar measures it:
radius error and what every reversal leaves.

The circle is run with a rising feedrate for half a turn, then until what the start left has died away,
then measured for one turn.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from amp_studio.sim.axis.motion import Motion, RunEnd, run_axis
from amp_studio.sim.engine.profiles import SINE
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.model import assumptions
from amp_studio.sim.rounding import value_text
from amp_studio.sim.scenario import Scenario, ScenarioSettings, above_zero, refuse_unknown
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Alarm, Figure, Trace
from amp_studio.sim.tuning.linear import LinearModel, linear_model

from .columns import alarms_of
from .sweep import DIES

SECOND = "move.second_axis"
_SETTINGS = {
    "move.radius": "radius (mm or deg); default: 20 mm or deg, or 20000 counts",
    "move.feedrate": (
        "feedrate on the circle (mm/min or deg/min); default: 3000 mm/min or deg/min, at most half the rapid"
        " feedrate"
    ),
    SECOND: "the other axis of the plane; default: the next one",
}
_RADIUS, _FEEDRATE = 20.0, 50.0
"""u, u/s: 20 mm at 3 m/min."""
_MAX_TURNS = 200
PATH = 720
"""Points of the predicted path."""
_RISE = math.pi
"""rad: the part of a turn in which the feedrate rises."""
_AWAY = (-6.0, 40.0)
"""deg before and after a reversal that belong to its spike."""


@dataclass(frozen=True)
class _Circle:
    """Radius in u, programmed feedrate in u/s, final rate in rad/s, time of the rise in s,
    whole turns until it is measured.
    """

    radius: float
    programmed: float
    rate: float
    rise: float
    turns: int

    def profile(self, phase: float) -> list[float]:
        """Return the command of one axis; it begins at ``phase`` rad of the sine, at position 0."""
        centre = -self.radius * math.sin(phase)
        faster = [0.0, self.rise, centre, self.radius, 0.0, self.rate / self.rise, SINE, phase]
        even = [self.rise, math.inf, centre, self.radius, self.rate, 0.0, SINE, phase + _RISE]
        return faster + even

    @property
    def end(self) -> float:
        """When the measured turn is over, with a quarter of a turn more for the following error."""
        return self.rise + (2.0 * math.pi * (self.turns + 1.5) - _RISE) / self.rate


def _run_circle(axis: AxisLaw, settings: ScenarioSettings, second: AxisLaw | None = None) -> Trace:
    """Run two axes on a circle; ``second`` None takes the same axis twice.
    Raises SimulationError for impossible settings.
    """
    refuse_unknown(settings, _SETTINGS)
    other = second or axis
    if other.unit != axis.unit:
        raise SimulationError(
            f"Axis {axis.axis} moves in {axis.unit}, axis {other.axis} in {other.unit}. A circle needs two"
            " axes with the same unit",
            SECOND,
        )
    models = (linear_model(axis), linear_model(other))
    circle = _circle(axis, other, models, settings)
    motions = [
        run_axis(each, circle.profile(phase), RunEnd(circle.end), thin=True)
        for each, phase in ((axis, math.pi / 2.0), (other, 0.0))
    ]
    alarms = tuple(
        alarm
        for each, motion in zip((axis, other), motions, strict=True)
        for alarm in alarms_of(each, motion)
    )
    alarms = tuple(sorted(alarms, key=lambda alarm: alarm.time_s))
    # A loop that is not stable is the cause of all other alarms: it is shown alone.
    alarms = _unstable(axis, other, models) or alarms
    columns = _columns(circle, *motions)
    return Trace(
        scenario="circle",
        axis=axis.axis,
        model=f"{axis.title}; circle of axes {axis.axis} and {other.axis}",
        columns=columns,
        units=_units(axis),
        result=_figures(axis, other, models, circle, columns, bool(alarms)),
        alarms=alarms,
        assumptions=_assumptions(axis, other, second),
        move={"move.radius": circle.radius, "move.feedrate": circle.programmed * 60.0},
    )


def _circle(
    axis: AxisLaw, other: AxisLaw, models: tuple[LinearModel, LinearModel], settings: ScenarioSettings
) -> _Circle:
    """Return the circle to run, at the feedrate that the control allows; raises SimulationError."""
    size = 1000.0 if axis.unit == "counts" else 1.0  # a count is taken as a thousandth
    radius = above_zero(settings, "move.radius") or _RADIUS * size
    given = above_zero(settings, "move.feedrate")
    known = [each.feedrate / 2.0 for each in (axis, other) if each.feedrate]
    feedrate = given / 60.0 if given else min([_FEEDRATE * size, *known])
    limit = _limit(axis, other, radius)
    programmed, feedrate = feedrate, feedrate if limit is None else min(feedrate, limit)
    rate = feedrate / radius
    slowest = max(float(np.max(np.abs(model.poles()), initial=0.0)) for model in models)
    dies = DIES * axis.servo_period / -math.log(slowest) if 0.0 < slowest < 1.0 else 0.0
    # Whole turns, so that the measured one begins at the same place whatever the start left.
    turns = max(1, math.ceil(dies * rate / (2.0 * math.pi) + 0.5))
    if turns > _MAX_TURNS:
        raise SimulationError(
            f"A circle of {radius:.4g} {axis.unit} at {feedrate * 60.0:.4g} {axis.unit}/min needs more than"
            f" {_MAX_TURNS} turns until the axes follow evenly. Give a larger radius or a lower feedrate",
            "move.radius",
        )
    # The rate rises evenly from 0, so that half a turn takes twice the time it has at the full rate.
    return _Circle(radius, programmed, rate, 2.0 * _RISE / rate, turns)


def _limit(axis: AxisLaw, other: AxisLaw, radius: float) -> float | None:
    """Return the feedrate in u/s to which the control lowers that on the circle; None for no limit."""
    allowed = [each.circle_feedrate(radius) for each in (axis, other)]
    return min((each for each in allowed if each is not None), default=None)


def _columns(circle: _Circle, first: Motion, second: Motion) -> dict[str, Series]:
    """Return the measured turn by the angle at which the axes are;
    the whole run where they do not come so far.
    """
    rows = min(len(first.columns["time_s"]), len(second.columns["time_s"]))
    one, two = ({name: column[:rows] for name, column in m.columns.items()} for m in (first, second))
    # Both commands begin at 0, at the right of the circle: x there is the radius.
    x, y = circle.radius + one["position"], two["position"]
    angle = np.unwrap(np.arctan2(y, x))
    begin = 2.0 * math.pi * circle.turns
    inside = (angle >= begin) & (angle <= begin + 2.0 * math.pi)
    # An alarm ended the run before the measured turn: all of it is shown then.
    if inside.sum() < 8:
        inside = np.ones(rows, dtype=bool)
    every = {
        "time_s": one["time_s"],
        "angle_deg": np.degrees(angle - begin if inside.sum() < rows else angle),
        "radius_deviation": np.hypot(x, y) - circle.radius,
        "position": x,
        "second_position": y,
        "following_error": one["following_error"],
        "second_following_error": two["following_error"],
        "velocity": one["velocity"] * 60.0,
        "second_velocity": two["velocity"] * 60.0,
        "output": one["output"],
        "second_output": two["output"],
    }
    return {name: np.ascontiguousarray(column[inside]) for name, column in every.items()}


def _units(axis: AxisLaw) -> dict[str, str]:
    u = axis.unit
    own = {"time_s": "s", "angle_deg": "deg", "radius_deviation": u}
    kinds = (("position", u), ("following_error", u), ("velocity", f"{u}/min"), ("output", axis.output_unit))
    return own | {f"{place}{name}": unit for name, unit in kinds for place in ("", "second_")}


def _figures(
    axis: AxisLaw,
    other: AxisLaw,
    models: tuple[LinearModel, LinearModel],
    circle: _Circle,
    columns: dict[str, Series],
    stopped: bool,
) -> dict[str, Figure]:
    """Return the named figures; a radius error above 0 is a circle that is too small."""
    u, deviation = axis.unit, columns["radius_deviation"]
    feedrate, limit = circle.rate * circle.radius, _limit(axis, other, circle.radius)
    answers = [complex(model.follows(np.array([circle.rate / (2.0 * math.pi)]))[0]) for model in models]
    lag = [circle.radius * (circle.rate / each.position_rate) ** 2 / 2.0 for each in (axis, other)]
    stable = all(model.is_stable() for model in models)
    spike, where = _spike(circle.radius, columns["angle_deg"], deviation) if not stopped else (None, None)
    return {
        "radius": (circle.radius, u),
        "feedrate": (feedrate * 60.0, f"{u}/min"),
        **({} if limit is None else {"feedrate_limit": (limit * 60.0, f"{u}/min")}),
        "radius_error": (None if stopped else -float(deviation.mean()), u),
        "predicted_radius_error": (_predicted(circle.radius, *answers) if stable else None, u),
        "first_order_radius_error": (sum(lag) / 2.0, u),
        "circularity": (None if stopped else float(deviation.max() - deviation.min()), u),
        "reversal_spike": (spike, u),
        "reversal_spike_angle": (where, "deg"),
        "time": (2.0 * math.pi / circle.rate, "s"),
    }


def _predicted(radius: float, first: complex, second: complex) -> float:
    """Return the mean radius error of the ellipse that two axes make of a circle
    by their answers at its rate.
    """
    turn = np.linspace(0.0, 2.0 * math.pi, PATH, endpoint=False)
    path = np.hypot((first * np.exp(1j * turn)).real, (second * np.exp(1j * turn)).imag)
    return radius * (1.0 - float(path.mean()))


def _spike(radius: float, angle: Series, deviation: Series) -> tuple[float | None, float | None]:
    """Return the largest departure near a reversal from the even path (offset and ellipse),
    and where it is in deg.

    1 / r² of an ellipse has harmonics 0 and 2 of the angle alone, however unequal its axes are.
    """
    after = (angle - _AWAY[0]) % 90.0
    near = after < _AWAY[1] - _AWAY[0]
    turn = np.radians(angle)
    # Fitted to the parts of the circle away from reversals only: the spikes must not bend their own
    # base line.
    base = np.column_stack([np.ones_like(turn), *(f(n * turn) for n in (1, 2) for f in (np.cos, np.sin))])
    # With fewer points than twice the unknowns the fit would follow the noise.
    if (~near).sum() < 2 * base.shape[1] or not near.any():
        return None, None
    measured = 1.0 + deviation / radius
    even = base @ np.linalg.lstsq(base[~near], measured[~near] ** -2.0, rcond=None)[0]
    if (even <= 0.0).any():
        return None, None
    apart = np.where(near, radius * np.abs(measured - even**-0.5), 0.0)
    place = int(np.argmax(apart))
    return float(apart[place]), float(angle[place] % 360.0)


def _unstable(axis: AxisLaw, other: AxisLaw, models: tuple[LinearModel, LinearModel]) -> tuple[Alarm, ...]:
    """Return the alarm of the first axis whose position loop is not stable; raises SimulationError for an
    open one.
    """
    for each, model in zip((axis, other), models, strict=True):
        if model.drifts():
            raise SimulationError(f"The position loop of axis {each.axis} is open: it closes no circle")
        if not model.is_stable():
            gain = model.margins().gain
            by = f": the gain is {value_text(-gain, 'dB', 3)} too high" if gain and gain < 0.0 else ""
            return (
                Alarm(
                    "UNSTABLE",
                    0.0,
                    f"The position loop of axis {each.axis} is not"
                    f" stable{by}.{' ' if each.undamped else ''}{each.undamped}",
                ),
            )
    return ()


def _assumptions(axis: AxisLaw, other: AxisLaw, second: AxisLaw | None) -> tuple[str, ...]:
    """Return the assumptions of both axes, those of both once."""
    every = dict.fromkeys([*assumptions(axis), *assumptions(other)])
    notes = [
        (
            "A radius error above 0 is a circle that is too small. Predicted is the linear model of both axes"
            " at this rate; the first-order figure is v² / (2 R Kv²) of two lags of first order without"
            " feed-forward."
        )
    ]
    if second is None:
        notes.append(f"ASSUMED: the second axis of the circle is like axis {axis.axis}.")
    return (*every, *notes)


SCENARIO = Scenario(
    "circle",
    "Two axes on a circle: radius error and reversal spikes",
    _SETTINGS,
    _run_circle,
    second=True,
    checked=("radius_error", "circularity"),
    once=True,
)
