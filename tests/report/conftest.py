"""Machines to print: values of every kind, with marks of every kind."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import UTC, datetime

import pytest

from amp_studio.files import ParameterFile, fill_defaults, fitted_axes, new_file
from amp_studio.schema import Value

LOOPS = ("digital", "analog", "sercos")


@pytest.fixture
def date() -> datetime:
    return datetime(2026, 7, 1, 14, 5, tzinfo=UTC)


def with_servos(axes: Iterable[str]) -> ParameterFile:
    """Return a mill whose servos are chosen, one kind after the other, so that most parameters exist."""
    file = new_file("9pc", "mill", axes, name="Mill 7")
    for n, axis in enumerate(fitted_axes(file)):
        file.set(("servo.hardware_type", axis), Value("sercos"))
        file.set(("servo.loop_type", axis), Value(LOOPS[n % 3]))
    fill_defaults(file)
    return file


@pytest.fixture
def mill() -> ParameterFile:
    """Return a mill with a changed value, one in inches, one forced out of range and one taken away."""
    file = with_servos(["X", "Y", "Z", "B", "S"])
    file.set(("home.calibration", "1"), Value(12.5, "mm"))
    file.set(("home.calibration", "2"), Value(-0.1, "in"))
    file.set_many(
        {("servo.gain_break_point", "1"): Value(999999.0, "mm")}, force="by J. Fitter on 2026-07-01"
    )
    file.set(("servo.inposition_band", "2"), None)
    return file


@pytest.fixture
def eight_axes() -> ParameterFile:
    """Return a mill with every axis fitted."""
    return with_servos(["X", "Y", "Z", "A", "B", "C", "U", "S"])
