"""Inertia, friction and weight of an axis out of a record of its motion, by least squares.

The torque of a rigid axis is J·a + b·v + c+ while it moves in the positive direction, and J·a + b·v + c- in
the negative one. The equation is linear in J, b, c+ and c-, so it stays true when torque, velocity and
acceleration pass the same filter, which takes out noise and the steps of counts without a bias (the filter of
an inverse dynamic identification: M. Gautier, *Dynamic identification of robots with power model*, IEEE ICRA
1997). What is left of the noise in the acceleration would make J too small; the filter is the shortest one
with which that is below ``_WANTED_NOISE``.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from amp_studio.sim.errors import SimulationError
from amp_studio.sim.series import Series
from amp_studio.sim.tuning.sampled import Matrix

_MIN_ROWS = 100
_WANTED_NOISE, _MAX_NOISE = 1e-3, 2e-2
"""Share of noise in the variance of the filtered acceleration: J is too small by it."""
STANDSTILL = 0.02
"""Share of the top speed below which the axis counts as standing:
there the friction has any value up to the static one."""
_MIN_SPREAD, _MIN_CRUISE_SPREAD = 0.15, 0.05
"""Standard deviation of the speed over the top speed, of all rows and of those without acceleration,
where there are many."""
CRUISING, MANY = 0.1, 0.3
"""Share of the largest acceleration below which a row has none; share of rows that are many."""
_MAX_CONDITION = 200.0
"""Of the normalised columns of the equation."""
_FLAT_RUN, _FLAT_SHARE = 10, 0.02
"""Rows of exactly the largest (or smallest) torque one after the other, and their share of the record:
a limit."""
_MUCH_LONGER, _SETTLED, _MIN_KEPT = 3.0, 0.01, 0.7
"""Times as long a filter is, the share by which J may change with it, and of the rows that it has to
leave."""
_MIN_FIT = 0.5
"""r² below which the record does not show this axis."""
MAX_ERROR = 0.2
"""Standard error of J over J."""

_SWINGS, _SWINGING = 50.0, 0.5
"""Hz at which a load may swing that the record does not show, and its share of J: an assumption."""


@dataclass(frozen=True, eq=False)
class FrictionFit:
    """J, b, c+ and c- in the units of the record, their covariance, and what they were found in."""

    coefficients: Series
    covariance: Matrix
    r_squared: float
    period: float
    """s between two rows."""
    window: float
    """s: length of the filter."""
    rows: int
    used: int
    """Rows in the middle of a filter within which the axis kept its direction."""
    time: Series
    velocity: Series
    torque: Series
    predicted: Series
    """Of each row that has a filter around it, filtered."""
    is_used: npt.NDArray[np.bool_]
    """Of these rows; at a standstill the prediction is the weight alone."""


def fit_friction(
    time: Series,
    torque: Series,
    *,
    velocity: Series | None = None,
    position: Series | None = None,
    slowest: float = STANDSTILL,
) -> FrictionFit:
    """Return the fit of a record, by its velocity or its position, without rows below a share of the top
    speed; raises SimulationError for what it cannot show.
    """
    moved = velocity if velocity is not None else position
    assert moved is not None
    if len(time) < _MIN_ROWS:
        raise SimulationError(f"The record has too few rows: {len(time)} of at least {_MIN_ROWS}")
    time, (moved, torque) = even_record(time, moved, torque)
    _refuse_limit(torque, moved if velocity is not None else np.gradient(moved))
    period = float(time[1] - time[0])
    inner, slope, bend = time[1:-1], (moved[2:] - moved[:-2]) / (2.0 * period), np.diff(moved, 2) / period**2
    # A difference is a mean over two periods; what it is compared with has the same mean.
    if velocity is not None:
        speed, acceleration, torque = _mean(moved, 0.25), slope, _mean(torque, 0.25)
        taps = np.array([-0.5, 0.0, 0.5]) / period
    else:
        speed, acceleration, torque = slope, bend, _mean(torque, 1.0 / 6.0)
        taps = np.array([1.0, -2.0, 1.0]) / period**2
    noise = _noise(moved)
    # The narrowest filter that is enough: a wider one has less noise, but blurs the reversals, where dry
    # friction changes its sign, and leaves fewer rows that move in one direction.
    best, wider = None, _widths(len(inner))
    while wider:
        width = wider.pop(0)
        found = _filtered(width, inner, speed, acceleration, torque)
        used = _one_direction(speed, width, slowest)
        if used.sum() < _MIN_ROWS // 2:
            break
        left = noise * _gain(taps, width)
        share = left / (float(np.var(found[2][used])) or 1.0)
        if best is None or share < best[0]:
            best = share, left, width, found, used
        if share < _WANTED_NOISE:
            break
    if best is None:
        raise SimulationError(
            "The record has too few rows in which the axis moves in one direction for a while"
        )
    share, left, width, found, used = best
    _refuse_motion(found[1][used], found[2][used])
    if share > _MAX_NOISE:
        raise SimulationError(
            "The record shows no acceleration above its noise: record moves with longer or steeper ramps, "
            "or more samples a second"
        )
    fit = _solved(period, width, found, used, left, rows=len(time))

    def with_filter(longer: int) -> FrictionFit | None:
        used = _one_direction(speed, longer, slowest)
        if used.sum() < _MIN_KEPT * fit.used:
            return None
        found = _filtered(longer, inner, speed, acceleration, torque)
        return _solved(period, longer, found, used, noise * _gain(taps, longer), rows=len(time))

    return _of_one_mass(fit, width, wider, with_filter)


def _of_one_mass(
    fit: FrictionFit, width: int, wider: Sequence[int], with_filter: Callable[[int], FrictionFit | None]
) -> FrictionFit:
    """Return the fit whose filter is long enough for one rigid mass.

    A motor that rattles in its backlash, or swings against its load, is lighter than the axis, and a much
    longer filter finds another inertia.
    """
    for longer in wider:
        if longer < _MUCH_LONGER * width:
            continue
        try:
            other = with_filter(longer)
        # A filter so long leaves too little of the motion: what was found before counts.
        except SimulationError:
            break
        if other is None or abs(other.coefficients[0] / fit.coefficients[0] - 1.0) < _SETTLED:
            break
        fit, width = other, longer
    return fit


# -- what is refused ---------------------------------------------------------------------------------


def _refuse_limit(torque: Series, speed: Series) -> None:
    """Raise SimulationError for a torque that stays at its largest or smallest value in motion:
    what was missing is not in the record.

    A drive that is off, with the brake closed, has its smallest torque too, at rest.
    """
    if float(np.ptp(torque)) == 0.0:
        raise SimulationError("The torque is the same in every row")
    moves = np.abs(speed) > STANDSTILL * float(np.abs(speed).max())
    flat = 0
    for limit in (torque.max(), torque.min()):
        # A zero at each end, so that every run has a beginning and an end in the differences.
        at_limit = np.concatenate([[0], ((torque == limit) & moves).astype(np.int8), [0]])
        edges = np.flatnonzero(np.diff(at_limit))
        lengths = edges[1::2] - edges[::2]
        flat += int(lengths[lengths >= _FLAT_RUN].sum())
    if flat > _FLAT_SHARE * len(torque):
        raise SimulationError(
            f"The torque stays at its largest value in {flat} of {len(torque)} rows: it is at a limit. "
            "Record moves with a lower acceleration"
        )


def _refuse_motion(velocity: Series, acceleration: Series) -> None:
    """Raise SimulationError for a motion in which two of the figures look the same."""
    top = float(np.abs(velocity).max(initial=0.0))
    if not (velocity > 0.0).any() or not (velocity < 0.0).any():
        raise SimulationError(
            "The axis moves in one direction only: dry friction and weight look the same. Record moves in"
            " both directions"
        )
    if min((velocity > 0.0).sum(), (velocity < 0.0).sum()) < _MIN_ROWS // 5:
        raise SimulationError(
            "The axis moves too little in one of both directions: record longer moves in both"
        )
    speed = np.abs(velocity)
    cruise = speed[np.abs(acceleration) < CRUISING * float(np.abs(acceleration).max())]
    is_one = len(cruise) > MANY * len(speed) and float(cruise.std()) < _MIN_CRUISE_SPREAD * top
    if is_one or float(speed.std()) < _MIN_SPREAD * top:
        raise SimulationError(
            "The axis moves at one speed only: friction that rises with the speed looks like dry friction. "
            "Record moves at several speeds"
        )


# -- filters -----------------------------------------------------------------------------------------


def even_record(time: Series, moved: Series, torque: Series) -> tuple[Series, tuple[Series, Series]]:
    """Return the record at even times; raises SimulationError for times that do not rise or leave a gap."""
    steps = np.diff(time)
    back = np.flatnonzero(steps < 0.0)
    if back.size:
        raise SimulationError(f"The time goes back after {time[back[0]]:g} s")
    period = float(time[-1] - time[0]) / (len(time) - 1)
    if period <= 0.0:
        raise SimulationError("The time is the same in every row")
    even = time[0] + period * np.arange(len(time))
    if float(np.abs(time - even).max()) < 0.75 * period:  # times that were rounded when they were written
        return even, (moved, torque)
    gap = int(np.argmax(steps))
    # Rows that are missing now and then are bridged by a line; five periods without one are a gap.
    if steps[gap] > 5.0 * float(np.median(steps)) or not (steps > 0.0).all():
        raise SimulationError(f"The record has a gap after {time[gap]:g} s, or two rows of the same time")
    return even, (np.interp(even, time, moved), np.interp(even, time, torque))


def _noise(moved: Series) -> float:
    """Return the variance of the noise of a signal, counts included: of its third differences,
    which motion hardly has.
    """
    # A third difference has the taps 1, -3, 3, -1, whose squares add up to 20.
    return float(np.mean(np.diff(moved, 3) ** 2)) / 20.0


def _mean(values: Series, side: float) -> Series:
    """Return the means of a row and its two neighbours, each of which has the weight ``side``."""
    return np.asarray(side * (values[:-2] + values[2:]) + (1.0 - 2.0 * side) * values[1:-1])


def _widths(rows: int) -> list[int]:
    widths = [1]
    # A filter of three boxes is three widths long; a tenth of the record is the longest that leaves
    # enough rows.
    while 3 * widths[-1] < rows // 10:
        widths.append(max(widths[-1] + 1, round(1.5 * widths[-1])))
    return widths


def _box(values: Series, width: int) -> Series:
    """Return the means of ``width`` values one after the other."""
    # By running sums: a wide filter costs no more than a narrow one.
    sums = np.cumsum(np.concatenate([[0.0], values]))
    return np.asarray((sums[width:] - sums[:-width]) / width)


def _smooth(values: Series, width: int) -> Series:
    """Return what a filter of three boxes leaves: 3 width - 2 rows long, without a delay,
    shorter by them at both ends.
    """
    middle = float(values.mean())  # so that sums of a distant position lose no digits
    return middle + _box(_box(_box(values - middle, width), width), width)


def _filtered(width: int, *signals: Series) -> tuple[Series, ...]:
    return tuple(_smooth(signal, width) for signal in signals)


def _gain(taps: Series, width: int) -> float:
    """Return the variance that a variance of 1 at each row leaves in the filtered acceleration."""
    # Long enough for the response of the three boxes to an impulse, 3 width - 2, to lie in it whole.
    impulse = np.zeros(6 * width - 5)
    impulse[3 * width - 3] = 1.0
    response = _box(_box(_box(impulse, width), width), width)
    return float(np.sum(np.convolve(response, taps) ** 2))


def _one_direction(speed: Series, width: int, slowest: float) -> npt.NDArray[np.bool_]:
    """Return for each filter whether the axis moves in one direction all the time within it."""
    ends = (width - 1) // 2, width // 2
    smooth = _box(np.pad(speed, ends, mode="edge"), width)
    # A quantile, as one spike would raise the bound of the standstill for all rows.
    top = float(np.quantile(np.abs(smooth), 0.99))
    length = 3 * width  # and a row at each end, which is in the means of three rows
    sides = (np.pad(side * smooth > slowest * top, 1).astype(np.float64) for side in (1.0, -1.0))
    # All rows on one side: half a row below that is only the rounding of the sums.
    return np.asarray(sum(_box(side, length) > 1.0 - 0.5 / length for side in sides), dtype=bool)


# -- the equation ------------------------------------------------------------------------------------


def _solved(
    period: float, width: int, found: tuple[Series, ...], used: npt.NDArray[np.bool_], noise: float, rows: int
) -> FrictionFit:
    """Solve the equation by least squares, with the covariance of its coefficients; raises SimulationError
    for a record that does not show them.
    """
    time, speed, acceleration, torque = found
    forward = speed > 0.0
    table = np.column_stack([acceleration, speed, forward, ~forward]).astype(np.float64)
    known, given = table[used], torque[used]
    sizes = np.sqrt((known**2).sum(axis=0))
    # Columns of one length, so that the condition is one of the motion and not of its units.
    if (sizes == 0.0).any() or np.linalg.cond(known / sizes) > _MAX_CONDITION:
        raise SimulationError(
            "Acceleration, speed and direction change together in this record: record moves at several speeds"
            " and accelerations"
        )
    coefficients = _least_squares(known / sizes, given, noise / sizes[0] ** 2) / sizes
    if coefficients[1] < 0.0:  # no friction falls with the speed in the simulator: the best one that does not
        table[:, 1], known[:, 1] = 0.0, 0.0
        coefficients = (
            np.insert(
                _least_squares(known[:, [0, 2, 3]] / sizes[[0, 2, 3]], given, noise / sizes[0] ** 2), 1, 0.0
            )
            / sizes
        )
    rest = given - known @ coefficients
    spread = float(((given - given.mean()) ** 2).sum())
    r_squared = 1.0 - float((rest**2).sum()) / spread if spread else 0.0
    if coefficients[0] <= 0.0:
        raise SimulationError(
            "Torque and acceleration have opposite signs: turn the sign of one column, or take the torque of"
            " this axis"
        )
    covariance = _covariance(table, torque - table @ coefficients, used, width, sizes)
    covariance[0, 0] += (_load_swing_share(acceleration, used, period) * coefficients[0]) ** 2
    if r_squared < _MIN_FIT:
        raise SimulationError(
            f"Inertia and friction explain only {max(0.0, 100.0 * r_squared):.0f} % of the torque: "
            "the columns do not belong together, or something else loads the axis"
        )
    if np.sqrt(covariance[0, 0]) > MAX_ERROR * coefficients[0]:
        raise SimulationError(
            "The record shows too little acceleration for the inertia: record moves with steeper ramps"
        )
    standing = np.abs(speed) < STANDSTILL * float(np.abs(speed).max())
    predicted = table @ coefficients
    # At rest dry friction has any value up to the static one, and only the weight can be predicted.
    predicted[standing] = table[standing, :2] @ coefficients[:2] + 0.5 * (coefficients[2] + coefficients[3])
    return FrictionFit(
        coefficients,
        covariance,
        r_squared,
        period,
        (3 * width - 2) * period,
        rows,
        int(used.sum()),
        time,
        speed,
        torque,
        predicted,
        used,
    )


def _load_swing_share(acceleration: Series, used: npt.NDArray[np.bool_], period: float) -> float:
    """Return by which share J may be too large as the load swings: on its spring it is accelerated more than
    its motor, by (w / its own rate)², and filters do not take that away.
    """
    jerk = np.gradient(acceleration, period)[used]
    rate = float(np.mean(jerk**2) / np.mean(acceleration[used] ** 2))
    return _SWINGING * rate / (2.0 * np.pi * _SWINGS) ** 2


def _least_squares(known: Matrix, given: Series, noise: float) -> Series:
    """Return the coefficients; ``noise`` is the variance of the noise in the first column."""
    squares = known.T @ known
    # Noise in a regressor makes its square larger and the coefficient smaller: what is known of it is
    # taken out.
    squares[0, 0] -= noise * len(known)
    return np.asarray(np.linalg.solve(squares, known.T @ given))


def _covariance(
    table: Matrix, rest: Series, used: npt.NDArray[np.bool_], width: int, sizes: Series
) -> Matrix:
    """Return the covariance of the coefficients after W. Newey and K. West (Econometrica 55, 1987).

    Neighbouring filters share rows, and what the model leaves out lasts for a while:
    the errors are not independent.
    """
    # Filters that share nearly all of their rows bring nothing new: every half width one is enough.
    step = max(1, width // 2)
    scaled = (table / sizes)[::step]
    pushes = np.where(used[::step, None], scaled * rest[::step, None], 0.0)
    count = int(used[::step].sum())
    # The usual length of the window, 4 (n / 100)^(2/9), and never less than a dozen.
    lags = max(12, round(4.0 * (count / 100.0) ** (2.0 / 9.0)))
    middle = pushes.T @ pushes
    for lag in range(1, min(lags, len(pushes) - 1) + 1):
        product = pushes[lag:].T @ pushes[:-lag]
        middle += (1.0 - lag / (lags + 1.0)) * (product + product.T)
    inverse = np.linalg.pinv(scaled[used[::step]].T @ scaled[used[::step]])  # a column that is left out is 0
    # Four coefficients have been fitted: the correction for few rows.
    found = inverse @ middle @ inverse * (count / max(1, count - 4))
    return np.asarray(found / np.outer(sizes, sizes))
