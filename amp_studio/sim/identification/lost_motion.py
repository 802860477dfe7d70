"""Backlash in a record that has the positions of motor and load."""

from __future__ import annotations

import math

import numpy as np

from amp_studio.sim.series import Series

from .beyond_friction import SURE, EstimatedFigure
from .friction import FrictionFit

CRUISING = 0.2
"""Share of the largest acceleration below which friction decides on which side of its backlash an axis is."""
LEAST_ROWS = 40


def backlash(fit: FrictionFit, time: Series, motor: Series, load: Series) -> EstimatedFigure | None:
    """Return by how much the load lags behind its motor in one direction more than in the other, in the unit
    of the record.

    Rows at a steady speed are used, in which dry friction of the load keeps the gap closed on one side; a
    scale error along the way is taken out. Backlash and what the drive train yields to that friction are one
    figure. None for a record with too few such rows in one direction.
    """
    way = np.interp(fit.time, time, motor)
    gap = np.interp(fit.time, time, load) - way
    acceleration = np.abs(np.gradient(fit.velocity, fit.period))
    steady = fit.is_used & (acceleration < CRUISING * float(acceleration.max()))
    forward = fit.velocity > 0.0
    if min((steady & forward).sum(), (steady & ~forward).sum()) < LEAST_ROWS:
        return None
    away = way - way[steady].mean()
    table = np.column_stack([forward, ~forward, away])[steady].astype(float)
    coefficients, *_ = np.linalg.lstsq(table, gap[steady], rcond=None)
    rest = gap[steady] - table @ coefficients
    # Rows of one filter are not independent: as many count as there are filters.
    rows = max(1.0, len(rest) * fit.period / max(fit.window, fit.period))
    inverse = np.linalg.pinv(table.T @ table)
    turned = np.array([-1.0, 1.0, 0.0])
    error = math.sqrt(float(turned @ inverse @ turned) * float(rest @ rest) / rows)
    found = EstimatedFigure(float(turned @ coefficients), error)
    return found if found.value > SURE * error else EstimatedFigure(0.0, error)
