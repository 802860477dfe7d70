"""Figures by ISO 230-2, against numpy, against figures worked out by hand,
and against a machine whose truth is known.
"""

from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.calibration import Measurement
from amp_studio.calibration.curve import mean_curve
from amp_studio.calibration.figures import figures
from amp_studio.calibration.measurement import MeasuredRun, MeasurementAnswers


def measurement(up: np.ndarray, down: np.ndarray, targets: np.ndarray) -> Measurement:
    """Return runs (rows) over targets (columns)."""

    def run(rising: bool, row: np.ndarray) -> MeasuredRun:
        return MeasuredRun(
            rising, tuple((Fraction(float(t)), Fraction(float(v))) for t, v in zip(targets, row, strict=True))
        )

    return Measurement(
        (*(run(True, r) for r in up), *(run(False, r) for r in down)), "mm", MeasurementAnswers()
    )


def by_numpy(up: np.ndarray, down: np.ndarray) -> dict[str, float]:
    """Every figure from the formulas of the standard, independent of the program."""
    mu, md, su, sd = up.mean(0), down.mean(0), up.std(0, ddof=1), down.std(0, ddof=1)
    b = mu - md
    return {
        "reversal": np.abs(b).max(),
        "mean_reversal": b.mean(),
        "mean_range": np.ptp((mu + md) / 2),
        "systematic_rising": np.ptp(mu),
        "systematic_falling": np.ptp(md),
        "systematic": max(mu.max(), md.max()) - min(mu.min(), md.min()),
        "repeatability_rising": 4 * su.max(),
        "repeatability_falling": 4 * sd.max(),
        "repeatability": np.max([2 * su + 2 * sd + np.abs(b), 4 * su, 4 * sd]),
        "accuracy_rising": (mu + 2 * su).max() - (mu - 2 * su).min(),
        "accuracy_falling": (md + 2 * sd).max() - (md - 2 * sd).min(),
        "accuracy": (
            max((mu + 2 * su).max(), (md + 2 * sd).max()) - min((mu - 2 * su).min(), (md - 2 * sd).min())
        ),
    }


@given(st.integers(0, 2**32 - 1), st.integers(2, 7), st.integers(2, 15))
def test_every_figure_is_that_of_numpy(seed: int, runs: int, count: int) -> None:
    chance = np.random.default_rng(seed)
    targets = np.sort(chance.uniform(-500, 500, count))
    up, down = chance.normal(0, 0.01, (runs, count)), chance.normal(0.003, 0.01, (runs, count))
    found = figures(measurement(up, down, targets))
    for name, value in by_numpy(up, down).items():
        assert getattr(found, name) == pytest.approx(value, rel=1e-9, abs=1e-15), name
    mean = mean_curve(measurement(up, down, targets))
    assert [float(v) for _, v in mean.points] == pytest.approx(list((up.mean(0) + down.mean(0)) / 2))


def test_two_targets_and_two_runs_worked_out_by_hand() -> None:
    up = np.array([[0.0, 4.0], [2.0, 6.0]])
    down = np.array([[5.0, 9.0], [5.0, 13.0]])
    found = figures(measurement(up, down, np.array([0.0, 100.0])))
    root2 = 2**0.5
    assert found.mean_reversal == pytest.approx(-5)  # 1 - 5 and 5 - 11 are -4 and -6
    assert found.reversal == pytest.approx(6)
    assert found.mean_range == pytest.approx(5)  # 3 and 8
    assert found.systematic == pytest.approx(10)  # 1 to 11
    assert found.repeatability_rising == pytest.approx(4 * root2)
    assert found.repeatability == pytest.approx(2 * root2 + 4 * root2 + 6)  # at 100, with s 2.83 falling
    assert found.accuracy == pytest.approx(11 + 4 * root2 - (1 - 2 * root2))


def test_one_direction_has_no_reversal_and_one_run_no_repeatability() -> None:
    one = figures(measurement(np.array([[0.0, 1.0], [0.5, 1.0]]), np.empty((0, 2)), np.array([0.0, 1.0])))
    assert (one.reversal, one.systematic, one.repeatability, one.accuracy) == (None, None, None, None)
    assert one.repeatability_rising is not None
    single = figures(measurement(np.array([[0.0, 1.0]]), np.array([[1.0, 2.0]]), np.array([0.0, 1.0])))
    assert single.reversal == 1
    assert (single.repeatability, single.accuracy, single.repeatability_falling) == (None, None, None)
