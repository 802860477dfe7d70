"""The machine behind an emulated ACR card: its words, the HOME key and an MDI block move its axes,
and the driver reads their status.
"""

from pathlib import Path

import pytest

from amp_studio.transfer import ControlStatus
from tests.families.acromill.lines.bench import CardBench

TUNED = "PPU X4096 Y4096|EXC AXIS0 4 AXIS1 4|PGAIN X.08 Y.08|DGAIN X.00021 Y.00021|FFVEL X.0000015 Y.0000015"
"""Figures of appendix C for the bare test motor (pages 115 to 135)."""


class MovingCard(CardBench):
    """A card whose axes are tuned, and the clock of its machine."""

    def execute(self, line: str) -> list[str]:
        return self.card._done(line)

    def after(self, seconds: float) -> ControlStatus:
        for _ in range(round(seconds / 0.1)):
            self.card.advance(0.1)
        return self.driver.status()


@pytest.fixture
def card(tmp_path: Path) -> MovingCard:
    bench = MovingCard(tmp_path)
    for line in TUNED.split("|"):
        bench.execute(line)
    return bench


def test_a_jog_moves_the_axis_and_the_terminal_shows_where(card: MovingCard) -> None:
    card.execute("JOG VEL X2")
    card.execute("JOG ACC X100")
    card.execute("JOG FWD X")
    status = card.after(1.0)
    axis = status.axes[0]
    assert (axis.axis, axis.unit) == ("X", "in")
    assert axis.position == pytest.approx(1.96, abs=0.06)  # 2 units/s less the ramp
    assert axis.following_error is not None
    assert 0.0 < abs(axis.following_error) < 0.01
    assert not status.faults
    card.execute("JOG OFF X")
    card.after(1.0)
    assert float(card.execute("?P6144")[0]) == pytest.approx(float(card.execute("?P12294")[0]), abs=40.0)


def test_home_goes_by_priority_and_g28_over_the_point_between(card: MovingCard) -> None:
    assert card.card.operate("home XY").startswith("homing")
    homed = card.after(60.0)
    assert [abs(axis.position or 0.0) < 0.01 for axis in homed.axes[:2]] == [True, True]
    card.card.operate("mdi G28 X2 Y1")
    assert (card.after(0.5).axes[0].position or 0.0) > 0.5
    assert abs(card.after(6.0).axes[0].position or 0.0) < 0.02


@pytest.mark.parametrize(
    ("line", "words"),
    [("mdi G28 X1", "home the axes first"), ("mdi G2 X1", "G0, G1 and G28"), ("home Q", "letters of axes")],
)
def test_what_the_machine_cannot_do_is_refused_in_words(card: MovingCard, line: str, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        card.card.operate(line)


def test_an_axis_that_leaves_its_excess_error_band_loses_its_bit(card: MovingCard) -> None:
    """Page 113: the bit for not excess error goes off, and the PLC takes the power from the motors."""
    card.execute("EXC AXIS0 0.001")
    card.execute("PGAIN X.0001")
    card.execute("MOV X5")
    status = card.after(2.0)
    assert card.execute("?BIT769") == ["0"]
    assert [(fault.axis, fault.code) for fault in status.faults] == [("X", "EXCESS ERROR")]
    assert status.faults[0].params == ("axes.excess_error_band", "servo.p_gain")


def test_a_loop_that_runs_away_leaves_the_card_alive(card: MovingCard) -> None:
    for line in ("EXC AXIS0 0", "PGAIN X5", "DGAIN X0", "JOG FWD X"):
        card.execute(line)
    card.after(10.0)
    assert card.execute("VER")[0].startswith("ACR8000")
