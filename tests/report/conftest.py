"""A machine to print: five axes, with values of every kind and marks of every kind."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from datetime import UTC, datetime

import pytest

from amp_studio.files import ParameterFile, fill_defaults, fitted_axes, new_file
from amp_studio.schema import Value

Machine = Callable[[Iterable[str]], ParameterFile]

LOOPS = ("digital", "analog", "sercos")


@pytest.fixture
def date() -> datetime:
    return datetime(2026, 7, 1, 14, 5, tzinfo=UTC)


@pytest.fixture
def machine() -> Machine:
    """Return what makes a mill with the given axes, each with its servo chosen, so that most parameters exist."""

    def made(axes: Iterable[str]) -> ParameterFile:
        file = new_file("9pc", "mill", axes, name="Mill 7")
        for n, axis in enumerate(fitted_axes(file)):
            file.set(("servo.hardware_type", axis), Value("sercos"))
            file.set(("servo.loop_type", axis), Value(LOOPS[n % 3]))
        fill_defaults(file)
        return file

    return made


@pytest.fixture
def mill(machine: Machine) -> ParameterFile:
    """Return a mill with a changed value, one in inches, one forced out of range and one taken away."""
    file = machine(["X", "Y", "Z", "B", "S"])
    file.set(("home.calibration", "1"), Value(12.5, "mm"))
    file.set(("home.calibration", "2"), Value(-0.1, "in"))
    file.set_many({("servo.gain_break_point", "1"): Value(999999.0, "mm")}, force="by J. Fitter on 2026-07-01")
    file.set(("servo.inposition_band", "2"), None)
    return file
