"""Backlash in a record that has the positions of motor and load."""

from __future__ import annotations

import math

import numpy as np

from amp_studio.sim.series import Series

from .beyond_friction import SURE, EstimatedFigure
from .friction import FrictionFit

_CRUISING = 0.2
"""Share of the largest acceleration below which friction decides on which side of its backlash an axis is."""
_MIN_ROWS = 40
_WEIGHT = 0.5
"""Share of the dry friction, of which the load may have that much only, from which a weight may be more."""


def is_closed_by_weight(fit: FrictionFit) -> bool:
    """Return whether the weight may keep the gap closed on the same side in both directions."""
    _, _, ahead, back = fit.coefficients.tolist()
    return bool(abs(ahead + back) > _WEIGHT * (ahead - back))


def backlash(fit: FrictionFit, time: Series, motor: Series, load: Series) -> EstimatedFigure | None:
    """Return by how much the load lags behind its motor in one direction more than in the other, in the unit
    of the record.

    Rows at a steady speed are used, in which friction of the load keeps the gap closed on one side; a scale
    error along the way is taken out. What the drive train yields to viscous friction is taken out too; what
    it yields to the dry one cannot be separated from backlash, and is taken for as uncertain as it is large,
    by the share of both. None for a record with too few such rows in one direction.
    """
    way = np.interp(fit.time, time, motor)
    gap = np.interp(fit.time, time, load) - way
    acceleration = np.abs(np.gradient(fit.velocity, fit.period))
    steady = fit.is_used & (acceleration < _CRUISING * float(acceleration.max()))
    forward = fit.velocity > 0.0
    if min((steady & forward).sum(), (steady & ~forward).sum()) < _MIN_ROWS:
        return None
    # Around its mean: a scale error then takes nothing of the offset of a direction.
    away = way - way[steady].mean()
    table = np.column_stack([forward, ~forward, away, fit.velocity])[steady].astype(float)
    coefficients, *_ = np.linalg.lstsq(table, gap[steady], rcond=None)
    rest = gap[steady] - table @ coefficients
    # Rows of one filter are not independent: as many count as there are filters.
    rows = max(1.0, len(rest) * fit.period / max(fit.window, fit.period))
    inverse = np.linalg.pinv(table.T @ table)
    # Ahead, the load is behind by friction; back, it is in front: the difference is the backlash.
    turned = np.array([-1.0, 1.0, 0.0, 0.0])
    error = math.sqrt(float(turned @ inverse @ turned) * float(rest @ rest) / rows)
    value = float(turned @ coefficients)
    if value < SURE * error:
        # None is found, and it may be as large as what is not sure.
        return EstimatedFigure(0.0, math.hypot(error, value))
    _, viscous, ahead, back = fit.coefficients.tolist()
    # What viscous friction yields shows the stiffness; dry friction yields by the same.
    yields = float(coefficients[3]) * (ahead - back) / viscous if viscous > 0.0 else 0.0
    return EstimatedFigure(value, math.hypot(error, min(yields, value)))
