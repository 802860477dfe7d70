"""Machines to print: values of every kind, with marks of every kind."""

import os
from collections.abc import Callable, Iterable
from datetime import UTC, datetime
from functools import cache
from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, fitted_axes, new_file
from amp_studio.files.parameter_file import fill_defaults
from amp_studio.report import Contents, print_report
from amp_studio.report.contents import Sort
from amp_studio.schema import Value
from tests.campaigns import CAMPAIGN

LOOPS = ("digital", "analog", "sercos")


IN_EVERY_ORDER = pytest.mark.parametrize(
    ("which", "sort"),
    [("mill", "axis"), *([("eight axes", "group"), ("eight axes", "number"), ("mill", "steps")] * CAMPAIGN)],
)
"""One order, in a campaign each of them, of one machine or the other: a full machine takes two seconds to be
set.
"""
DATE = datetime(2026, 7, 1, 14, 5, tzinfo=UTC)


@pytest.fixture
def date() -> datetime:
    return DATE


def with_servos(axes: Iterable[str]) -> ParameterFile:
    """Return a mill whose servos are chosen, one kind after the other, so that most parameters exist."""
    file = new_file("9pc", "mill", axes, name="Mill 7")
    for n, axis in enumerate(fitted_axes(file)):
        file.set(("servo.hardware_type", axis), Value("sercos"))
        file.set(("servo.loop_type", axis), Value(LOOPS[n % 3]))
    fill_defaults(file)
    return file


@pytest.fixture
def without_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Draw no picture in a report, which is a third of its time, for tests that look at none."""
    monkeypatch.setattr("amp_studio.report.build.drawings", lambda file, language: ())


@pytest.fixture(scope="session")
def first_mill() -> ParameterFile:
    """Return the mill of which each test has a copy."""
    file = with_servos(["X", "Y", "Z", "B", "S"])
    file.set(("home.calibration", "1"), Value(12.5, "mm"))
    file.set(("home.calibration", "2"), Value(-0.1, "in"))
    file.set_checked(
        {("servo.gain_break_point", "1"): Value(999999.0, "mm")}, force="by J. Fitter on 2026-07-01"
    )
    file.set(("servo.inposition_band", "2"), None)
    return file


@pytest.fixture
def mill(first_mill: ParameterFile) -> ParameterFile:
    """Return a mill with a changed value, one in inches, one forced out of range and one taken away."""
    return first_mill.copy()


@pytest.fixture(scope="session")
def small_mill() -> ParameterFile:
    """Return a mill with few values, whose pages are soon set; tests have copies of it."""
    file = new_file("9pc", "mill", ["X", "Y"], name="Mill 7")
    for axis, value in (("1", 12.5), ("2", -0.1)):
        file.set(("home.calibration", axis), Value(value, "mm"))
    return file


@pytest.fixture(scope="session")
def first_eight_axes() -> ParameterFile:
    """Return the mill with every axis fitted of which each test has a copy."""
    return with_servos(["X", "Y", "Z", "A", "B", "C", "U", "S"])


@pytest.fixture
def eight_axes(first_eight_axes: ParameterFile) -> ParameterFile:
    """Return a mill with every axis fitted."""
    return first_eight_axes.copy()


@pytest.fixture(scope="session")
def printed(
    first_mill: ParameterFile, first_eight_axes: ParameterFile, tmp_path_factory: pytest.TempPathFactory
) -> Callable[[str, Sort], Path]:
    """Return what prints the mill, or the one with eight axes, in an order: once for all tests that read
    it, in whatever process of the run they are.
    """
    folder, files = tmp_path_factory.mktemp("printed"), {"mill": first_mill, "eight axes": first_eight_axes}
    shared = Path(
        os.environ["AMP_STUDIO_TEST_HOME"],
        "printed",
        os.environ.get("PYTEST_XDIST_TESTRUNUID", folder.parent.name),
    )
    shared.mkdir(parents=True, exist_ok=True)

    @cache
    def path_of(which: str, sort: Sort) -> Path:
        path, own = shared / f"{which}-{sort}.pdf", folder / f"{which}-{sort}.pdf"
        if not path.exists():
            print_report(
                files[which].copy(),
                own,
                Contents(sort, inactive=True, without=frozenset({"pictures"})),
                source=folder / "mill.amp",
                date=DATE,
            )
            own.replace(path)
        return path

    return path_of
