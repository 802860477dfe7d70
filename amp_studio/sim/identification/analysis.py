"""One analysis of a drive's record (inertia, friction, time shift, static friction), and by how much
another one that leaves out slower rows is different.

The standard errors of a fit are those of its noise. What its equation does not have (friction before it
slides, a Stribeck curve that is not found, a load that swings) moves the figures in the same way in every
move, most at low speed. Where figures without the slowest rows are others than noise explains, they are the
better ones (J. A. Hausman, Specification Tests in Econometrics, Econometrica 46, 1978). By how much they
still change, and by how much those of every second row do, is part of their uncertainty.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace

import numpy as np

from amp_studio.sim.errors import SimulationError
from amp_studio.sim.law import AxisLaw
from amp_studio.sim.series import Series
from amp_studio.sim.trace import Figure

from .beyond_friction import SLOWEST, EstimatedFigure, StaticFriction, is_shifted, static_friction, time_shift
from .drive_record import DriveRecord
from .friction import STANDSTILL, FrictionFit, fit_friction

_WAYS = ((STANDSTILL, SLOWEST), (0.08, 0.01), (0.2, 0.03))
"""Shares of the top speed below which rows are left out, of the fit and of the search for static friction."""
OTHER = 3.0
"""Standard errors from which a figure is another one."""
ERROR, SHIFT = "_standard_error", "time_shift"


@dataclass(frozen=True)
class Analysis:
    """What is found in a record."""

    fit: FrictionFit
    shift: EstimatedFigure
    static: StaticFriction | None

    @property
    def is_shifted(self) -> bool:
        """Whether the torque was shifted against the motion."""
        return is_shifted(self.fit, self.shift)


@dataclass(frozen=True)
class MeasuredTorque:
    """A record in the units of an axis: torque, and the factor of its motion."""

    record: DriveRecord
    torque: Series
    factor: float
    bound: AxisLaw

    def analysis(
        self, slowest: float = STANDSTILL, slowest_static: float = SLOWEST, by: float | None = None
    ) -> Analysis:
        """Return what is found without the rows below a share of the top speed; ``by`` shifts the torque by
        so many s, in place of the shift that is found.
        """
        torque, time = self.torque, self.record.time
        fit = self._fit(torque, slowest)
        shift = time_shift(fit)
        by = by if by is not None else shift.value if is_shifted(fit, shift) else 0.0
        if by:
            torque = np.interp(time - by, time, torque)
            fit = self._fit(torque, slowest)
        # c+ is friction and weight, c- the weight less the friction.
        coulomb = 0.5 * float(fit.coefficients[2] - fit.coefficients[3])
        static = static_friction(fit, coulomb, slowest_static)
        if static is not None:
            fit = self._without_static(torque, fit, static, slowest)
        return Analysis(fit, shift, static)

    def every_second_row(self) -> MeasuredTorque:
        """Return it with half of its rows."""
        record = self.record
        thinned = replace(
            record,
            time=record.time[::2],
            velocity=None if record.velocity is None else record.velocity[::2],
            position=None if record.position is None else record.position[::2],
        )
        return replace(self, record=thinned, torque=self.torque[::2])

    def _without_static(
        self, torque: Series, fit: FrictionFit, static: StaticFriction, slowest: float
    ) -> FrictionFit:
        """Return the fit of the record without what static friction adds at low speed, where it would be
        taken for Coulomb friction, and the viscous one for less; torque and prediction are with it.
        """
        excess = np.interp(self.record.time, fit.time, static.excess(fit.velocity), left=0.0, right=0.0)
        fit = self._fit(torque - excess, slowest)
        again = static.excess(fit.velocity)
        return replace(fit, torque=fit.torque + again, predicted=fit.predicted + again)

    def _fit(self, torque: Series, slowest: float) -> FrictionFit:
        record = self.record
        if record.velocity is not None:
            return fit_friction(record.time, torque, velocity=record.velocity * self.factor, slowest=slowest)
        assert record.position is not None
        moved = record.position * self.factor
        if self.bound.unit == "deg":  # a rotary axis may begin again after a turn
            moved = np.unwrap(moved, period=360.0)
        return fit_friction(record.time, torque, position=moved, slowest=slowest)


def settled_analysis(
    measured: MeasuredTorque, figures_of: Callable[[Analysis], dict[str, Figure]]
) -> tuple[Analysis, dict[str, Figure]]:
    """Return the analysis whose figures the next one does not change beyond its errors, and these figures,
    with what they do change in their errors; raises SimulationError for what the record cannot show.
    """
    now, way = measured.analysis(), _WAYS[0]
    figures = others = figures_of(now)
    for slower in _WAYS[1:]:
        try:
            later = measured.analysis(*slower)
            others = figures_of(later)
        except SimulationError:  # too little is left of a short record
            break
        if not _has_changed(figures, others):
            break
        now, way, figures, others = later, slower, others, figures
    found = _with_change(figures, figures, others)
    with suppress(SimulationError):
        found = _with_change(found, figures, figures_of(measured.every_second_row().analysis(*way)))
    with suppress(SimulationError):
        others = figures_of(measured.analysis(*way, by=_farther(now)))
        found = _with_change(found, figures, {name: others[name] for name in others if name != SHIFT})
    return now, found


def _farther(now: Analysis) -> float:
    """Return another shift that the record allows as well. Of a sine a shift looks like viscous friction, as
    its jerk is its speed turned round.
    """
    taken, error = now.shift.value if now.is_shifted else 0.0, now.shift.error
    left = math.hypot(error, now.shift.value - taken)
    return taken + math.copysign(min(left, now.fit.period), now.shift.value)


def _changes(figures: Mapping[str, Figure], others: Mapping[str, Figure]) -> dict[str, float]:
    """Return by how much the figures that have an error are others."""
    found = {}
    for name, (value, _) in figures.items():
        other = others.get(name, (None, ""))[0]
        if f"{name}{ERROR}" in figures and value is not None and other is not None:
            found[name] = other - value
    return found


def _has_changed(figures: Mapping[str, Figure], others: Mapping[str, Figure]) -> bool:
    return any(
        abs(change) > OTHER * (others[f"{name}{ERROR}"][0] or 0.0)
        for name, change in _changes(figures, others).items()
    )


def _with_change(
    found: Mapping[str, Figure], figures: Mapping[str, Figure], others: Mapping[str, Figure]
) -> dict[str, Figure]:
    """Return what is found, the changes from figures to others in its errors."""
    changed = dict(found)
    for name, change in _changes(figures, others).items():
        error, unit = found[f"{name}{ERROR}"]
        changed[f"{name}{ERROR}"] = math.hypot(error or 0.0, change), unit
    return changed
