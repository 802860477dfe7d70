"""An emulated NUM control behind a gateway: its keys move the machine of what was sent to it."""

from collections.abc import Iterator
from pathlib import Path

import pytest

from amp_studio.families.num.emulated.gateway import NumPanel
from amp_studio.files import open_file
from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.record import Identity
from amp_studio.transfer.image import decode_image, encode_image

from .test_manual_keys import MILL


@pytest.fixture
def control(tmp_path: Path) -> Iterator[Control]:
    """Return a control with the example mill, in E-stop."""
    file = open_file(MILL).file
    identity = Identity("num", file.schema.signature, "CNC_1", "emulated")
    made = Control(tmp_path / "state", identity, encode_image(file), accept=decode_image)
    yield made
    made.close()


def test_live_sees_the_axes_of_what_was_sent_and_a_jog_moves_them(control: Control) -> None:
    """The emulated NUM control of the window showed no axis: there was no machine behind it."""
    panel = NumPanel()
    panel.advance(control, 0.1)
    before = {axis.axis: axis for axis in panel.screen(control).axes}
    assert {"X", "Y", "Z"} <= set(before)
    with pytest.raises(ValueError, match="in E-stop"):
        panel.operate(control, "jog", "X+ slow")
    control.set_estop(False)
    panel.advance(control, 0.1)
    assert (panel.operate(control, "jog", "X+ slow") or "").startswith("X+ at ")
    for _ in range(5):
        panel.advance(control, 0.1)
    (moving,) = (axis for axis in panel.screen(control).axes if axis.axis == "X")
    assert moving.position != before["X"].position
    assert "moving" in moving.states
    control.set_estop(True)
    for _ in range(20):
        panel.advance(control, 0.1)
    assert "moving" not in next(axis for axis in panel.screen(control).axes if axis.axis == "X").states


def test_commands_of_others_are_left_to_them(control: Control) -> None:
    assert NumPanel().operate(control, "estop", "off") is None
