"""The check in motion as a window: each check as it is done, its parameters as links."""

from __future__ import annotations

from pathlib import Path

from pytestqt.qtbot import QtBot

from amp_studio.files import open_file
from amp_studio.sim import MotionCheck
from amp_studio.ui.base.task import Task
from amp_studio.ui.motion.check_window import CheckWindow

from .conftest import WAIT_MS

ROUTER = Path(__file__).parents[2] / "examples" / "grblhal-router" / "GRBL_ROUTER.amp"


def test_every_scenario_of_the_file_is_a_row_with_its_verdict(qtbot: QtBot) -> None:
    window = CheckWindow(open_file(ROUTER).file, print)
    qtbot.addWidget(window)
    window.start()
    qtbot.waitUntil(lambda: not Task.running and len(window.checks) >= 13, timeout=10 * WAIT_MS)
    assert window.table.rowCount() == len(window.checks)
    assert window.summary.text() == "13 good"
    assert {check.scenario for check in window.checks} == {"step", "home", "jog", "travel", "spindle"}


def test_a_parameter_of_what_is_not_good_can_be_followed(qtbot: QtBot) -> None:
    followed: list[str] = []
    window = CheckWindow(open_file(ROUTER).file, followed.append)
    qtbot.addWidget(window)
    window.show_check(MotionCheck("jog", "X", "X", "bad", why="too fast", params=("axis.max_rate",)))
    window.table.setCurrentCell(0, 0)
    assert "axis.max_rate" in window.detail.text()
    window.detail.linkActivated.emit("axis.max_rate")
    assert followed == ["axis.max_rate"]
    assert window.summary.text() == "1 bad"
