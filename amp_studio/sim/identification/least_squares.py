"""Non-linear least squares by K. Levenberg (1944) and D. Marquardt (1963), over few parameters,
with the covariance at the end.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from amp_studio.sim.series import Series
from amp_studio.sim.tuning.sampled import Matrix

STEPS = 200
SMALL = 1e-7
"""Step of a difference; every parameter is scaled so that 1 is much."""
_ENOUGH = 1e-12
"""Share by which the sum has to become smaller to go on."""


@dataclass(frozen=True, eq=False)
class LeastSquares:
    """The parameters, their covariance, the sum of the squared residuals, and the residuals."""

    parameters: Series
    covariance: Matrix
    cost: float
    residual: Series


def fit(
    residual: Callable[[Series], Series], start: Series, slopes_at: Callable[[Series], Matrix] | None = None
) -> LeastSquares:
    """Return the parameters with the least sum of squares from a start on;
    the covariance is that of the residuals' own spread.

    ``slopes_at`` returns the slopes of the residuals, a column a parameter, where they have a formula;
    else differences are taken.
    """
    there, rest = np.array(start, dtype=float), residual(start)
    cost, damping = float(rest @ rest), 1e-3
    for _ in range(STEPS):
        slopes = slopes_at(there) if slopes_at else _slopes(residual, there, rest)
        squares, push = slopes.T @ slopes, slopes.T @ rest
        # Marquardt: damped by its own curvature, so that the unit of a parameter does not count; never 0.
        sizes = np.diag(squares) + 1e-12
        better = False
        while damping < 1e12:
            # lstsq, as a parameter without effect makes the squares singular.
            step = np.linalg.lstsq(squares + np.diag(damping * sizes), -push, rcond=None)[0]
            tried = residual(there + step)
            now = float(tried @ tried)
            if np.isfinite(now) and now < cost:
                better = cost - now > _ENOUGH * cost
                # Closer to Gauss and Newton after a success, closer to the steepest descent after a
                # failure.
                there, rest, cost, damping = there + step, tried, now, max(damping / 10.0, 1e-12)
                break
            damping *= 10.0
        if not better:
            break
    slopes = slopes_at(there) if slopes_at else _slopes(residual, there, rest)
    freedom = max(1, len(rest) - len(there))
    covariance = np.linalg.pinv(slopes.T @ slopes) * cost / freedom
    return LeastSquares(there, covariance, cost, rest)


def _slopes(residual: Callable[[Series], Series], there: Series, rest: Series) -> Matrix:
    columns = []
    for n in range(len(there)):
        ahead = there.copy()
        ahead[n] += SMALL
        columns.append((residual(ahead) - rest) / SMALL)
    return np.array(columns).T
