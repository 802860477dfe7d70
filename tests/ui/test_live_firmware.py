"""Live at the real firmware of grblHAL, which moves meanwhile; then its power is taken."""

import socket
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
from pytestqt.qtbot import QtBot

from amp_studio.schema import Value
from amp_studio.ui.main_window import MainWindow
from tests.families.grblhal.real_control import FIRMWARE, RealControl, real_control

from .conftest import WAIT_MS, User
from .test_keyboard import Hands

pytestmark = pytest.mark.skipif(not FIRMWARE.exists(), reason="the firmware is not built here: make peers")


@pytest.fixture
def control(tmp_path: Path) -> Iterator[RealControl]:
    """Return a control that takes for a move the time of the clock."""
    with real_control(tmp_path, pace="1") as made:
        yield made


def send_lines(control: RealControl, *lines: str) -> None:
    """Send lines as another program does, which leaves the line after the answers."""
    with socket.create_connection(("127.0.0.1", control.port), timeout=60) as line:
        answers = line.makefile("rb")
        for text in lines:
            line.sendall(f"{text}\n".encode())
            while answers.readline().strip() not in (b"ok", b"error:8"):
                pass


def live_at(control: RealControl, window: MainWindow) -> Any:
    """Return the page Live of the control."""
    window.control.exchanges.choose(window.workspace, control.address)
    window.menus["control.live"].trigger()
    return window.page_in_front.pages["live"]


def test_a_machine_that_moves_is_looked_at_and_moves_on_and_a_line_that_is_cut_is_called_lost(
    control: RealControl, qtbot: QtBot, window_with: Callable[..., MainWindow]
) -> None:
    send_lines(control, "$X", "G91 G1 X-5000 F100")
    window = window_with("grblhal-router")
    page = live_at(control, window)
    qtbot.waitUntil(lambda: page._status is not None, timeout=3 * WAIT_MS)
    assert page._status.state == "Run"
    assert page.is_live
    assert "cannot be read while the machine moves" in page.reason.text()
    first = page._status.axes[0].position
    qtbot.waitUntil(lambda: page._status.axes[0].position < first - 1.0, timeout=3 * WAIT_MS)
    assert page.recorder.plot.picture is not None
    control.kill()
    qtbot.waitUntil(lambda: not page.is_live, timeout=3 * WAIT_MS)
    assert window.control.state_of(window.workspace)[1:] == ("connection lost", True)
    assert [button.text() for button in page.bar.buttons] == ["Try Again", "At the Control"]


def test_a_value_that_was_written_alone_is_not_the_whole_file(
    control: RealControl, qtbot: QtBot, window_with: Callable[..., MainWindow], user: User
) -> None:
    """The window had the control contain the file, all of it, after one value had been written."""
    send_lines(control, "$X")
    window = window_with("grblhal-router")
    workspace = window.workspace_in_front
    page = live_at(control, window)
    qtbot.waitUntil(lambda: page._present() is not None and page.is_live, timeout=3 * WAIT_MS)
    rate = workspace.file.find("$110")
    before = dict(page._present().values)
    user.answers("Write Now")
    page.write(rate, Value(1234.0, "mm/min"))
    qtbot.waitUntil(lambda: rate in page.turned and page.is_live, timeout=3 * WAIT_MS)
    contained = page._present().values
    assert contained[rate].value == 1234.0
    assert {each for each in contained if contained[each] != before[each]} == {rate}
    assert workspace.control is not None
    assert workspace.control[0] == contained  # what the panel shows beside the file
    assert workspace.control[0] != workspace.file.values
    assert window.settings.controls()[0].verb == "verify"
    control.kill()
    qtbot.waitUntil(lambda: not page.is_live, timeout=3 * WAIT_MS)


def test_live_and_a_restore_take_no_mouse(
    control: RealControl, qtbot: QtBot, window_with: Callable[..., MainWindow], user: User
) -> None:
    send_lines(control, "$X")
    window, hands = window_with("grblhal-router"), Hands()
    window.activateWindow()
    window.control.exchanges.choose(window.workspace, control.address)
    rate = window.workspace_in_front.file.find("$110")
    window.go_to(rate)
    window.table_view.setFocus()
    hands.press("Ctrl+L")
    page: Any = window.page_in_front.pages["live"]
    qtbot.waitUntil(lambda: page.frame.isVisible() and page.is_live, timeout=3 * WAIT_MS)
    assert page.rows.address == rate
    hands.go_to("Value to be written")
    before = page._present().get(rate)
    user.answers("Write Now")
    hands.press("Up", "Ctrl+Return")
    qtbot.waitUntil(lambda: rate in page.turned and page.is_live, timeout=3 * WAIT_MS)
    assert page._present().get(rate) != before
    hands.go_to("Value to be written")
    hands.press("Ctrl+Backspace")
    qtbot.waitUntil(lambda: not page.turned and page.is_live, timeout=3 * WAIT_MS)
    hands.press("Ctrl+L")
    qtbot.waitUntil(lambda: not page.is_live, timeout=3 * WAIT_MS)
    assert hands.here is window.table_view
    (kept, *_) = sorted(window.workspace_in_front.path.parent.glob("*.before-*"))
    user.chooses(kept)
    hands.press("Ctrl+Shift+P")
    hands.enter("restore")
    hands.press("Return")
    at = window.control.page
    qtbot.waitUntil(lambda: at.backup is not None and not at.session.is_busy, timeout=3 * WAIT_MS)
    assert hands.here.window() is window
    assert at.isAncestorOf(hands.here)
