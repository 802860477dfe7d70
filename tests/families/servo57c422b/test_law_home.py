"""Homing of a 57C422B axis with switch and marker (page 4-29)."""

from __future__ import annotations

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import simulate

PRESS = Path(__file__).parents[3] / "examples" / "57c422b-label-press" / "LABEL_PRESS.amp"


def press() -> ParameterFile:
    """Return the label press with an axis X that stops soon."""
    file = open_file(PRESS).file
    for parameter, value in (
        ("command.acceleration", Value(400000.0, "counts/s2")),
        ("command.deceleration", Value(400000.0, "counts/s2")),
        ("command.velocity", Value(40000.0, "counts/s")),
        ("command.home_speed_low", Value(4000.0, "counts/s")),
    ):
        file.set((parameter, "X"), value)
    return file


@pytest.mark.parametrize(("direction", "sign"), [("plus", 1.0), ("minus", -1.0)])
def test_fast_onto_the_switch_slow_off_it_and_on_to_the_marker(direction: str, sign: float) -> None:
    move = {"move.switch": 5000.0, "move.marker": 900.0, "move.direction": direction}
    trace = simulate(press(), "home", "X", move)
    velocity = sign * trace.columns["velocity"] / 60.0
    assert velocity.max() == pytest.approx(40000.0, rel=0.05)  # registers 19 and 20
    command = sign * trace.columns["command_velocity"] / 60.0
    assert command.min() == pytest.approx(-4000.0)  # registers 15 and 16
    assert trace.result["home_from_start"][0] == pytest.approx(sign * 4100.0)
    assert trace.result["home_position"] == (80000.0, "counts")  # registers 17 and 18
    # It stops behind the marker: 4000²/2/400000 counts, and what a scan and the following error add.
    assert 18.0 < sign * (80000.0 - trace.result["stop_position"][0]) < 35.0
