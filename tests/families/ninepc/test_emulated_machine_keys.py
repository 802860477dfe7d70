"""The machine behind the emulated 9/PC: jog and home keys, MDI blocks, E-stop, and the position screen."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from amp_studio.families.ninepc.emulated.panel import NinePcPanel
from amp_studio.files import open_file
from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.record import Identity
from amp_studio.transfer.image import decode_image, encode_image

MILL = Path(__file__).parents[3] / "examples" / "mill-1394" / "MILL_1394.amp"


class Bench:
    """A control with the example mill or another one, out of E-stop, and the clock of its machine."""

    def __init__(self, folder: Path, machine: Path = MILL) -> None:
        file = open_file(machine).file
        identity = Identity("9pc", file.schema.signature)
        self.control = Control(folder, identity, encode_image(file), accept=decode_image)
        self.panel = NinePcPanel(8)
        self.panel.started(self.control)
        self.control.set_estop(False)

    def give(self, line: str) -> str:
        verb, _, rest = line.partition(" ")
        return self.panel.operate(self.control, verb, rest) or ""

    def after(self, seconds: float) -> str:
        for _ in range(round(seconds / 0.1)):
            self.panel.advance(self.control, 0.1)
        return self.give("position")


@pytest.fixture
def bench(tmp_path: Path) -> Iterator[Bench]:
    made = Bench(tmp_path / "state")
    yield made
    made.control.close()


def test_a_jog_goes_on_until_its_key_is_released(bench: Bench) -> None:
    assert bench.give("jog X+ second").startswith("X+ at ")
    moving = bench.after(0.5)
    assert "X " in moving
    assert "moving" in moving
    bench.give("release")
    assert "moving" not in bench.after(2.0)


def test_an_incremental_jog_goes_one_increment(bench: Bench) -> None:
    """Page 8-7."""
    bench.give("jog X- increment largest")
    assert bench.after(6.0).startswith("X -10.0")


def test_a_block_needs_axes_that_are_homed_and_g28_homes_them(bench: Bench) -> None:
    """Pages 5-13 and 5-14."""
    with pytest.raises(ValueError, match="MUST HOME AXIS X"):
        bench.give("mdi G0 X-100")
    assert bench.give("mdi G28 X-50") == "homing X"
    with pytest.raises(ValueError, match="HOMING NOT ALLOWED"):
        bench.give("manual-home X")
    assert "X 6.00" in bench.after(30.0)
    assert " homed" in bench.give("position")
    bench.give("mdi G0 X-100")
    assert bench.after(3.0).startswith("X -100.0")


def test_g30_goes_over_the_point_to_1004_once_the_axis_is_homed(bench: Bench) -> None:
    """Page 5-17; any motion but G28 needs an axis that is homed (5-13)."""
    with pytest.raises(ValueError, match="MUST HOME AXIS X"):
        bench.give("mdi G30 X-50")
    bench.give("mdi G28 X-50")
    bench.after(30.0)
    assert bench.give("mdi G30 X-50") == "to the secondary home position of X"
    bench.after(0.5)
    assert bench.give("position").startswith("X -") or " moving" in bench.give("position")
    assert bench.after(10.0).removeprefix("X ").removeprefix("-").startswith("0.0000 mm")  # 1004; 1310 is 6


def test_e_stop_takes_the_drives_away(bench: Bench) -> None:
    bench.give("jog X+ second")
    bench.after(0.5)
    bench.control.set_estop(True)
    bench.after(0.1)
    with pytest.raises(ValueError, match="E-stop"):
        bench.give("jog X+")
    bench.control.set_estop(False)
    assert bench.give("jog X-").startswith("X- at")


def test_a_homed_axis_stops_at_its_overtravel(bench: Bench) -> None:
    """Page 10-18: it passes it by its following error."""
    bench.give("mdi G28 X0")
    bench.after(30.0)
    bench.give("jog X+ highest")
    assert "OVERTRAVEL" in bench.after(10.0)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("jog Q+", "not fitted"),
        ("jog X", "direction"),
        ("jog X+ warp", "No jog speed"),
        ("mdi G2 X1", "G0, G1, G28 and G30"),
    ],
)
def test_what_is_not_possible_is_shown_in_words(bench: Bench, line: str, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        bench.give(line)


def test_the_screen_shows_every_axis_and_e_stop(bench: Bench) -> None:
    """Chapter 2: a download needs E-STOP; the house protocol shows no positions."""
    bench.give("jog X+ second")
    bench.panel.advance(bench.control, 0.5)
    displayed = bench.panel.screen(bench.control)
    assert [axis.axis for axis in displayed.axes] == ["X", "Y", "Z", "B"]
    assert displayed.axes[0].states == ("not homed", "moving")
    assert displayed.axes[0].following_error
    bench.control.set_estop(True)
    assert bench.panel.screen(bench.control).state == "E-STOP"


def test_the_reset_of_an_e_stop_gives_the_drives_back(bench: Bench) -> None:
    """An axis without friction went on, and a vertical one fell, until the next key."""
    bench.give("jog Z- highest")
    bench.after(0.5)
    bench.control.set_estop(True)
    bench.after(0.5)
    bench.control.set_estop(False)
    bench.after(0.3)
    axis = bench.panel.screen(bench.control).axes[2]
    assert axis.velocity == pytest.approx(0.0, abs=0.01)
    assert axis.following_error == pytest.approx(0.0, abs=0.01)


def test_a_1394_brakes_at_an_e_stop(bench: Bench) -> None:
    """Appendix A: regenerative braking for 2 seconds. At 5000 mm/min X ran on for 178 mm."""
    bench.give("mdi G28 X0")
    bench.after(20.0)
    bench.give("mdi G1 X-300 F5000")
    bench.after(1.0)
    before = bench.panel.screen(bench.control).axes[0].position
    bench.control.set_estop(True)
    bench.after(3.0)
    axis = bench.panel.screen(bench.control).axes[0]
    assert before is not None
    assert axis.position is not None
    assert -10.0 < axis.position - before < 0.0
    assert axis.velocity == pytest.approx(0.0, abs=0.01)
    bench.control.set_estop(False)
    bench.after(1.0)
    assert bench.panel.screen(bench.control).axes[0].position == pytest.approx(axis.position, abs=0.01)


def test_a_drive_that_has_tripped_does_not_brake(bench: Bench) -> None:
    """The other axes do, which the E-stop of its fault takes along."""
    bench.give("mdi G28 X0 Y0")
    bench.after(20.0)
    bench.give("mdi G1 X-200 Y-200 F5000")
    bench.after(1.0)
    x, y = (axis.position or 0.0 for axis in bench.panel.screen(bench.control).axes[:2])
    bench.give("fault drive Y")
    bench.after(1.0)
    far_x, far_y = (axis.position or 0.0 for axis in bench.panel.screen(bench.control).axes[:2])
    assert -10.0 < far_x - x < 0.0
    assert far_y - y < -10.0
