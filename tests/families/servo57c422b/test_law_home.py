"""Homing of a 57C422B axis in its four sequences (page 4-29), and its software overtravel (4-6, 4-10)."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, Trace, simulate

PRESS = Path(__file__).parents[3] / "examples" / "57c422b-label-press" / "LABEL_PRESS.amp"


def press(switches: int | None = 0x1D, encoder: int | None = None) -> ParameterFile:
    """Return the label press with an axis X that stops soon; 01DH is home switch, negative, marker,
    overtravel switches (5-6).
    """
    file = open_file(PRESS).file
    file.set(("setup.switches", "X"), None if switches is None else Value(switches))
    if encoder is not None:
        file.set(("setup.encoder", "X"), Value(encoder))
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


def homed(switches: int | None, **move: float) -> dict[str, float | None]:
    trace = simulate(press(switches), "home", "X", {f"move.{name}": value for name, value in move.items()})
    command = trace.columns["command_velocity"] / 60.0
    place = trace.result["home_from_start"][0]
    return {"home": place, "fastest": float(command.max()), "slowest": float(command.min())}


def test_the_four_sequences_are_those_of_the_switch_setup() -> None:
    """4-29, with the inferred bits of register 2: 0 home switch, 2 negative, 3 marker."""
    assert homed(0x00)["home"] == 0.0  # no motion
    assert homed(0x00)["fastest"] == 0.0
    marker = homed(0x0C, marker=700.0)  # marker only, in the negative direction, slowly
    assert (marker["home"], marker["slowest"], marker["fastest"]) == (-700.0, -4000.0, 0.0)
    switch = homed(
        0x05, switch=5000.0
    )  # switch only: fast in the negative direction, slowly back over its edge
    assert switch["home"] == pytest.approx(-5000.0, abs=8.0)
    assert (switch["slowest"], switch["fastest"]) == (pytest.approx(-40000.0), pytest.approx(4000.0))
    both = homed(0x1D, switch=5000.0, marker=900.0)
    assert both["home"] == pytest.approx(-4100.0)


def test_what_is_inferred_is_called_so() -> None:
    assert any("inferred, not printed" in note for note in simulate(press(), "home", "X").assumptions)
    lost = simulate(press(None), "home", "X").assumptions
    assert any("Register 2 is not set. ASSUMED" in note for note in lost)


def travel(switches: int, encoder: int, **move: float) -> Trace:
    file = press(switches, encoder)
    file.set(("setup.overtravel_positive", "X"), Value(100000, "counts"))
    file.set(("setup.overtravel_negative", "X"), Value(-50000, "counts"))
    return simulate(file, "travel", "X", {f"move.{name}": value for name, value in move.items()})


def test_software_overtravel_stops_by_the_deceleration_or_lets_the_axis_coast() -> None:
    """4-6: bits 10 and 11 (inferred); 40000 counts/s down by 400000 counts/s2 are 2000 counts."""
    ramped = travel(1 << 10, 0x04)
    assert ramped.result["limit"][0] == 100000.0
    assert ramped.result["overrun"][0] == pytest.approx(2000.0, rel=0.2)
    coasting = travel(1 << 10 | 1 << 11, 0x04)
    assert "the loop is switched off" in coasting.alarms[-1].message
    assert not coasting.columns["output"][-1]


@pytest.mark.parametrize(("switches", "encoder"), [(0, 0x04), (1 << 10, 0x14)], ids=["off", "rotary"])
def test_without_it_or_on_a_rotary_axis_there_is_no_limit(switches: int, encoder: int) -> None:
    with pytest.raises(SimulationError, match="No limit"):
        travel(switches, encoder)


def test_a_jog_is_velocity_control_at_registers_19_and_21_to_24() -> None:
    """Page 4-25: the application program sets bit 2 of register 65 and takes it back."""
    trace = simulate(press(), "jog", "X", {"move.hold": 2.0, "move.direction": "minus"})
    assert trace.columns["command_velocity"].min() == pytest.approx(-40000.0 * 60.0)
    assert trace.result["stop_position"][0] == pytest.approx(-80000.0, abs=10.0)
    assert trace.alarms == ()


@pytest.mark.parametrize(
    ("distance", "marker", "home"),
    [(6000.0, 700.0, 700.0), (-6000.0, 700.0, -3300.0), (9000.0, -100.0, 3900.0)],
)
def test_passive_homing_takes_the_first_marker_of_any_motion(
    distance: float, marker: float, home: float
) -> None:
    """Page 4-33: the command moves nothing; at the marker the feedback position becomes registers 17, 18."""
    move = {"move.distance": distance, "move.marker": marker}
    found = simulate(press(), "passive-home", "X", move).result
    assert found["home_from_start"] == (home, "counts")
    assert found["home_position"] == (80000.0, "counts")
    assert found["stop_position"][0] == pytest.approx(80000.0 + distance - home, abs=10.0)


def test_passive_homing_without_a_marker_is_refused() -> None:
    with pytest.raises(SimulationError, match="waits for ever"):
        simulate(press(0x05), "passive-home", "X")
    short = simulate(press(), "passive-home", "X", {"move.distance": 500.0})
    assert [alarm.code for alarm in short.alarms] == ["NO MARKER"]
