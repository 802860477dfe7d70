"""An emulated card that is set up from a file answers with its settings, and AcroMill's soft limits hold."""

from pathlib import Path

import pytest

import amp_studio as amp
from amp_studio.families.acromill.emulated.card import AcrCard
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory

VALUES = {
    "axes.pulses_per_unit": "4096 counts/in",
    "axes.excess_error_band": "4 in",
    "axes.soft_limit_plus": "2 in",
    "axes.soft_limit_minus": "-1 in",
    "axes.disable_limit": "False",
    "servo.p_gain": 0.08,
    "servo.d_gain": 0.00021,
    "servo.vel_ffwd": 0.0000015,
}
"""Of axis X: figures of appendix C for the bare test motor (pages 115 to 135), and its soft limits (page
60)."""


def the_card(folder: Path) -> AcrCard:
    machine = amp.new("acromill")
    for name, value in VALUES.items():
        machine[f"{name}@X"] = value
    machine.save(folder / "router.amp")
    return AcrCard(
        DeviceSetup("acromill", Memory(folder / "card"), print, hardware={"file": str(folder / "router.amp")})
    )


def after(card: AcrCard, seconds: float) -> float:
    """Return the position of X in units."""
    for _ in range(round(seconds / 0.1)):
        card.advance(0.1)
    return float(card._done("?P6144")[0]) / 4096.0


def test_the_settings_are_those_of_the_file_also_after_the_power_was_off(tmp_path: Path) -> None:
    card = the_card(tmp_path)
    card.operate("power")
    assert [card._done(line) for line in ("PPU X", "PGAIN X", "PPU Y")] == [["4096"], ["0.08"], ["10000"]]


def test_a_homed_axis_stops_at_its_soft_limits_and_comes_back_from_them(tmp_path: Path) -> None:
    card = the_card(tmp_path)
    card.operate("home X")
    assert abs(after(card, 60.0)) < 0.01
    card.operate("mdi G0 X5")
    assert after(card, 6.0) == pytest.approx(2.0, abs=0.1)
    assert "SOFT LIMIT" in card.operate("status")
    assert card._done("?BIT769") == ["-1"]  # a soft limit is no excess error (page 113)
    card._done("JOG FWD X")
    assert after(card, 3.0) == pytest.approx(2.0, abs=0.15)
    card.operate("mdi G0 X1")
    assert after(card, 6.0) == pytest.approx(1.0, abs=0.01)
    card._done("JOG REV X")
    assert after(card, 20.0) == pytest.approx(-1.0, abs=0.1)


def test_before_homing_there_are_no_soft_limits(tmp_path: Path) -> None:
    """Page 60: they are legal travel from home position."""
    card = the_card(tmp_path)
    card.operate("mdi G0 X3")
    assert after(card, 8.0) == pytest.approx(3.0, abs=0.01)
