"""The machine behind an emulated NUM control: jog and homing in manual mode."""

from pathlib import Path

import pytest

from amp_studio.families.num.emulated.control import NumControl
from amp_studio.families.num.formats.table import FORMAT
from amp_studio.files import open_file
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory

MILL = Path(__file__).parents[4] / "examples" / "num-1060-mill" / "MILL_1060.amp"


class Bench:
    """A control with the table of the example mill or another one."""

    def __init__(self, folder: Path, machine: Path = MILL) -> None:
        memory = Memory(folder)
        memory.replace("table", FORMAT.write(open_file(machine).file).encode("ascii"))
        self.control = NumControl(DeviceSetup("num", memory, print))

    def after(self, seconds: float) -> str:
        for _ in range(round(seconds / 0.1)):
            self.control.advance(0.1)
        return self.control.operate("position")


@pytest.fixture
def bench(tmp_path: Path) -> Bench:
    return Bench(tmp_path)


def test_a_jog_moves_an_axis_until_release(bench: Bench) -> None:
    assert bench.control.operate("jog X+ slow").startswith("X+ at ")
    assert "moving" in bench.after(0.5)
    bench.control.operate("release")
    assert "moving" not in bench.after(2.0)


def test_homing_ends_at_the_encoder_zero_and_limits_count_from_then_on(bench: Bench) -> None:
    """Pages 7-8 to 7-12."""
    assert bench.control.operate("homing X") == "homing X"
    assert " homed" in bench.after(60.0)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("jog Q+", "not fitted"),
        ("jog X", "direction"),
        ("jog X+ warp", "No jog speed"),
        ("homing Q", "not fitted"),
    ],
)
def test_what_is_not_possible_is_shown_in_words(bench: Bench, line: str, words: str) -> None:
    with pytest.raises(ValueError, match=words):
        bench.control.operate(line)


def test_the_screen_shows_the_axes_of_the_table(bench: Bench) -> None:
    """The peripheral line carries parameters alone (chapter 13)."""
    bench.control.operate("jog X+ slow")
    bench.control.advance(0.5)
    displayed = bench.control.screen()
    assert (displayed.state, displayed.axes[0].axis) == ("menu", "X")
    assert displayed.axes[0].states == ("not homed", "moving")
