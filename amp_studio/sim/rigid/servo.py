"""The data of one servo axis: plain figures in canonical units, checked on creation.

Nothing here depends on a control family or a parameter file. `sources` contains the parameter of each figure, so
that errors and recommendations can name it.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import Source

from .kernel import Loop

LONGEST_STEP = 0.25e-3
"""Longest physics step in s."""
STIFFEST_STEP = 0.5
"""Physics step times the fastest rate of the axis; Runge-Kutta 4 is stable up to 2.7 and accurate to 3e-4
here."""
MOST_SUBSTEPS = 10_000


@dataclass(frozen=True)
class AxisServo:
    """The data of one axis; lengths in `unit` (mm or deg), velocities in unit/min, accelerations in unit/s2.

    Raises SimulationError for impossible data.
    """

    position_gain: float
    """1000 unit/min per unit of following error: at 1 an axis follows 0.001 unit behind for each unit/min."""
    velocity_rate: float
    """1/s: commanded acceleration per velocity error."""
    acceleration_at_rated: float
    """unit/s2 at 100 % of rated torque."""
    feedback_counts: float
    """Counts for one turn of the feedback device."""
    travel: float
    """Travel for one turn of the lead screw."""
    servo_period: float = 1.0
    """ms between two measurements of the position."""
    integral_rate: float = 0.0
    """1/s: reciprocal of the integral time of the velocity loop; 0 for none."""
    integrator_discharge: float = 1.0
    torque_limit_positive: float = 200.0
    """% of rated torque."""
    torque_limit_negative: float = 200.0
    """% of rated torque, as a positive number."""
    gain_break_point: float = math.inf
    gain_break_ratio: float = 1.0
    zero_following_error: bool = False
    """Whether velocity feed-forward is used instead of the gain break."""
    feed_forward: float = 0.0
    """% of the command velocity."""
    gear_teeth: float = 1.0
    """Teeth on the gear of the feedback device."""
    screw_teeth: float = 1.0
    """Teeth on the lead screw."""
    ideal_feedback: bool = False
    """Whether positions are measured without rounding to counts (to compare with closed solutions)."""
    linear_acceleration: float = 0.0
    """0 for no ramp."""
    linear_deceleration: float = 0.0
    """0 for the same as the acceleration."""
    exponential_time: float | None = None
    """ms: time constant of an exponential ramp."""
    positioning_ramp: str = "linear"
    """Ramp of a positioning move: linear or exponential."""
    inposition_band: float = 0.0
    feedrate_suppression: float = math.inf
    excess_error: float = math.inf
    rapid_feedrate: float | None = None
    cutting_feedrate: float | None = None
    viscous_friction: float = 0.0
    """% of rated torque at 1000 unit/min."""
    coulomb_friction: float = 0.0
    """% of rated torque."""
    unit: str = "mm"
    axis: str = ""
    model: str = ""
    """Source of this axis, for the heading of a result."""
    sources: Mapping[str, Source] = field(default_factory=dict, compare=False)
    assumptions: tuple[str, ...] = field(default=(), compare=False)
    """The assumptions behind these figures, each with its source."""

    def __post_init__(self) -> None:
        for name in _ABOVE_ZERO:
            self._demand(name, getattr(self, name) > 0.0, "must be above 0")
        for name in _NOT_NEGATIVE:
            self._demand(name, getattr(self, name) >= 0.0, "must not be negative")
        for name in _MAYBE_ABOVE_ZERO:
            figure = getattr(self, name)
            self._demand(name, figure is None or 0.0 < figure < math.inf, "must be above 0")
        for name in _ABOVE_ZERO + _NOT_NEGATIVE:
            if name not in _MAY_BE_INFINITE:
                self._demand(name, math.isfinite(getattr(self, name)), "must be finite")
        self._demand("gain_break_ratio", self.gain_break_ratio <= 1.0, "must be between 0 and 1")
        self._demand("feed_forward", self.feed_forward <= 100.0, "must be between 0 and 100 %")
        self._demand("integrator_discharge", self.integrator_discharge >= 1.0, "must be 1 or more")
        self._demand("positioning_ramp", self.positioning_ramp in RAMPS, f"must be one of {', '.join(RAMPS)}")
        if not self._substeps_wanted <= MOST_SUBSTEPS:
            raise SimulationError(
                f"{self.described('velocity_rate')} makes a velocity loop too fast to simulate"
                f" ({self.velocity_rate:.6g} 1/s)",
                self.parameter("velocity_rate"),
            )

    def _demand(self, name: str, good: bool, what: str) -> None:
        if not good:
            figure = getattr(self, name)
            source = self.sources.get(name)
            scaled = figure * source.scale if source and isinstance(figure, float) else figure
            number = f"{scaled:.6g}" if isinstance(scaled, float) else repr(scaled)
            raise SimulationError(f"{self.described(name)} is {number}; it {what}", self.parameter(name))

    def parameter(self, name: str) -> str:
        """Return the id of the parameter of a figure, or the name of the figure if it has none."""
        source = self.sources.get(name)
        return source.parameter if source else name

    def described(self, name: str) -> str:
        """Return the name of a figure in words, with parameter and axis if known."""
        words = name.replace("_", " ")
        if name not in self.sources:
            return words
        return f"{words} ({self.parameter(name)}{'@' + self.axis if self.axis else ''})"

    @property
    def count(self) -> float:
        """Travel of one count: the device turns screw_teeth / gear_teeth times for one turn of the screw."""
        return self.travel * self.gear_teeth / (self.feedback_counts * self.screw_teeth)

    @property
    def position_rate(self) -> float:
        """The position gain in 1/s (its reciprocal is the loop's time constant)."""
        return self.position_gain * 1000.0 / 60.0

    @property
    def break_ratio(self) -> float:
        """The active gain break ratio: 1 while velocity feed-forward is used."""
        return 1.0 if self.zero_following_error else self.gain_break_ratio

    @property
    def feed_forward_share(self) -> float:
        """The active feed-forward, 0 to 1: 0 unless zero following error is chosen."""
        return self.feed_forward / 100.0 if self.zero_following_error else 0.0

    @property
    def substeps(self) -> int:
        """Physics steps in a servo period."""
        return max(1, math.ceil(self._substeps_wanted))

    @property
    def _substeps_wanted(self) -> float:
        period = self.servo_period / 1000.0
        fastest = (
            self.velocity_rate
            + math.sqrt(self.velocity_rate * self.integral_rate * self.integrator_discharge)
            + self._viscous_rate
        )
        return max(period / LONGEST_STEP - 1e-9, period * fastest / STIFFEST_STEP)

    @property
    def _viscous_rate(self) -> float:
        return self.acceleration_at_rated * self.viscous_friction / 100.0 * 60.0 / 1000.0

    def loop(self) -> Loop:
        """Return the input of the kernel, in unit and s."""
        period = self.servo_period / 1000.0
        figures = Loop(
            servo_period=period,
            position_gain=self.position_rate,
            gain_break_point=self.gain_break_point,
            gain_break_ratio=self.break_ratio,
            feed_forward=self.feed_forward_share,
            velocity_rate=self.velocity_rate,
            integral_rate=self.integral_rate,
            discharge=self.integrator_discharge,
            rated_acceleration=self.acceleration_at_rated,
            torque_positive=self.torque_limit_positive,
            torque_negative=self.torque_limit_negative,
            viscous=self._viscous_rate,
            coulomb=self.acceleration_at_rated * self.coulomb_friction / 100.0,
            resolution=0.0 if self.ideal_feedback else self.count,
            feedrate_suppression=self.feedrate_suppression,
            excess_error=self.excess_error,
        )
        return Loop(*map(float, figures))


RAMPS = ("linear", "exponential", "none")

_ABOVE_ZERO = (
    "position_gain",
    "velocity_rate",
    "acceleration_at_rated",
    "feedback_counts",
    "travel",
    "gear_teeth",
    "screw_teeth",
    "servo_period",
)
_NOT_NEGATIVE = (
    "integral_rate",
    "integrator_discharge",
    "torque_limit_positive",
    "torque_limit_negative",
    "gain_break_point",
    "gain_break_ratio",
    "feed_forward",
    "linear_acceleration",
    "linear_deceleration",
    "inposition_band",
    "feedrate_suppression",
    "excess_error",
    "viscous_friction",
    "coulomb_friction",
)
_MAY_BE_INFINITE = ("gain_break_point", "feedrate_suppression", "excess_error")
_MAYBE_ABOVE_ZERO = ("exponential_time", "rapid_feedrate", "cutting_feedrate")
