"""Homing and jogs of an AcroMill axis (pages 65 and 67)."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import simulate

ROUTER = Path(__file__).parents[3] / "examples" / "acromill-router" / "ROUTER.amp"


def router(**changes: Value) -> ParameterFile:
    """Return the example router with damped gains;
    changes of axis X by parameter id with ``__`` for the point.
    """
    file = open_file(ROUTER).file
    damped = {"servo.p_gain": Value(0.02, "V/count"), "servo.d_gain": Value(0.0001, "Vs/count")}
    for parameter, value in (
        damped | {name.replace("__", "."): value for name, value in changes.items()}
    ).items():
        file.set((parameter, "X"), value)
    return file


def test_the_three_speeds_of_homing_follow_each_other() -> None:
    file = router(
        home__direction=Value("pos"),
        home__fast_speed=Value(60.0, "in/min"),
        home__slow_speed=Value(12.0, "in/min"),
        home__marker_speed=Value(6.0, "in/min"),
        home__preset=Value(1.5, "in"),
    )
    trace = simulate(file, "home", "X", {"move.switch": 0.2, "move.marker": 0.05})
    velocity = trace.columns["command_velocity"]
    assert velocity.max() == pytest.approx(60.0)
    assert velocity.min() == pytest.approx(-12.0)
    assert trace.result["home_from_start"][0] == pytest.approx(0.15)
    assert trace.result["home_position"] == (pytest.approx(1.5), "in")
    marker_speed = velocity[(velocity < -5.99) & (velocity > -6.01)]
    assert len(marker_speed) > 100


def test_a_jog_has_the_feedrate_and_the_increments_of_the_file() -> None:
    file = router(jog__feedrate=Value(12.0, "in/min"), jog__increment_2=Value(0.1, "in"))
    jog = simulate(file, "jog", "X", {"move.increment": "2"})
    assert jog.result["feedrate"] == (pytest.approx(12.0), "in/min")
    assert jog.result["stop_position"][0] == pytest.approx(0.1, abs=0.001)
