"""Files with one axis and with twelve: every scenario, the check and the panel answer each axis."""

from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.files import ParameterFile, open_file
from amp_studio.sim import (
    FileMachine,
    SimulationError,
    bind_axis,
    check_motion,
    law_of,
    listing,
    simulate,
    simulated_axes,
)
from tests.campaigns import CAMPAIGN
from tests.sim.typical_machines import NUM, done, linuxcnc_axis, num_axis, syntec_axis

SYNTEC = "control.series=super Pr3203=2000"
TWO_GROUPS = "P97N0=2 P2N0=0xFFF P3N0=0xFFF " + " ".join(
    f"P9N{n}={n if n < 9 else 0x10 + n - 9}" for n in range(12)
)
"""Nine letters are all that a NUM has (4-24): the other three axes are X, Y and Z of a second group."""
WIDE = {
    "syntec": ("X,Y,Z,A,B,C,U,V,W,X2,Y2,Z2", SYNTEC + "".join(syntec_axis(n) for n in range(1, 13))),
    "num": (
        "X,Y,Z,U,V,W,A,B,C",
        f"{NUM.partition(' ')[2]} {TWO_GROUPS}" + "".join(num_axis(n) for n in range(12)),
    ),
}
SINGLE = {
    "num": ("X", f"{NUM} P2N0=1 P3N0=1 P9N0=0{num_axis(0)}"),
    "syntec": ("X", SYNTEC + syntec_axis(1)),
    "9pc": ("X", ""),
    "linuxcnc": (
        "X",
        "kins.joints=1 kins.kinematics=trivkins~coordinates=X traj.coordinates=X traj.linear_units=mm"
        + linuxcnc_axis(0, "X", -300, 5),
    ),
}
LEFT_OUT = {"sweep", "tune", "procedure"} | (
    set() if CAMPAIGN else {"frequency", "circle", "load", "velocity"}
)
"""Scenarios that take seconds; those of the second group are in a campaign."""


def made(family: str, machine: tuple[str, str], folder: Path) -> ParameterFile:
    axes, values = machine
    path = folder / "machine.amp"
    like = ["--like", "mill-1394"] if family == "9pc" else []
    done(["new", family, str(path), *like, "--axes", axes])
    if values:
        done(["set", str(path), *(word.replace("~", " ") for word in values.split())])
    return open_file(path).file


def answers(file: ParameterFile, axis: str) -> list[str]:
    """Return the scenarios of an axis that have figures; the others refuse it in a sentence."""
    found = []
    for scenario in listing(file).scenarios:
        if scenario.name in LEFT_OUT:
            continue
        try:
            trace = simulate(file, scenario.name, axis, advise=False)
        except SimulationError:
            continue
        assert all(value is None or abs(value) < float("inf") for value, _ in trace.result.values())
        found.append(scenario.name)
    return found


def panel_of(file: ParameterFile) -> FileMachine:
    machine = FileMachine(law_of(file.schema.family.family), bind_axis)
    machine.take(file)
    machine.make_all()
    return machine


@pytest.mark.parametrize("family", WIDE)
def test_twelve_axes_are_simulated_and_live_together(family: str, tmp_path: Path) -> None:
    file = made(family, WIDE[family], tmp_path)
    axes = list(simulated_axes(file))
    assert len(axes) == 12
    assert "step" in answers(file, axes[-1])
    machine = panel_of(file)
    assert len(list(machine.axes())) == 12
    for axis in axes:
        machine.move({axis: 1.0}, 10.0)
    for _ in range(30):
        machine.advance(0.1)
    assert all(abs(axis.position - 1.0) < 0.1 for axis in machine.axes())


@pytest.mark.parametrize(
    ("family", "words"),
    [("57c422b", "always has the axes X and Y"), ("acromill", "2 or more axes"), ("grblhal", "3 or more")],
)
def test_a_control_that_has_more_axes_refuses_one_with_its_reason(
    family: str, words: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["new", family, str(tmp_path / "machine.amp"), "--axes", "X"]) == 2
    assert words in capsys.readouterr().err


@pytest.mark.parametrize("family", SINGLE)
def test_one_axis_is_enough_for_scenarios_check_and_panel(family: str, tmp_path: Path) -> None:
    file = made(family, SINGLE[family], tmp_path)
    (axis,) = simulated_axes(file)
    assert "step" in answers(file, axis)
    verdicts = {check.verdict for check in check_motion(file)}
    assert "good" in verdicts
    assert "bad" not in verdicts
    (alone,) = panel_of(file).axes()
    assert alone.letter == "X"
