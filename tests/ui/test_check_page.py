"""The page of the check in motion: each check as it is done, its parameters as links."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from pytestqt.qtbot import QtBot

from amp_studio.files import Document, ParameterFile
from amp_studio.schema import Value
from amp_studio.sim import Alarm, MotionCheck, picture_of
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.theme import colour, scheme
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.motion.check_page import CheckPage

from .conftest import WAIT_MS

ROUTER = Path(__file__).parents[2] / "examples" / "grblhal-router" / "GRBL_ROUTER.amp"


@pytest.fixture
def router(qapp: object) -> Iterator[Workspace]:
    workspace = Workspace(Document.view(ROUTER))
    yield workspace
    workspace.close()


def test_every_scenario_of_the_file_is_a_row_with_its_verdict(router: Workspace, qtbot: QtBot) -> None:
    window = CheckPage(router, print)
    qtbot.addWidget(window)
    window.start()
    qtbot.waitUntil(lambda: not Task.running and len(window.checks) >= 16, timeout=10 * WAIT_MS)
    assert window.table.rowCount() == len(window.checks)
    assert window.summary.text() == "16 good"
    window.table.setCurrentCell(1, 0)
    assert window.plot.picture is not None, "the move of a check is seen beside it"
    drawn, expected = window.plot.picture, picture_of(window.checks[1].trace)
    assert [panel.title for panel in drawn.panels] == [panel.title for panel in expected.panels]
    assert window.title.text() == "Step · Y · good"
    assert window.table.item(1, 1).text()[0].isdigit(), "of what has no room the number stays"
    assert window.table.item(1, 0).data(Qt.ItemDataRole.AccessibleTextRole) == "Step Y: good"
    assert {check.scenario for check in window.checks} == {
        "step",
        "home",
        "jog",
        "travel",
        "spindle",
        "probe",
    }


def test_a_parameter_of_what_is_not_good_can_be_followed(router: Workspace, qtbot: QtBot) -> None:
    followed: list[str] = []
    window = CheckPage(router, followed.append)
    qtbot.addWidget(window)
    window.show_check(MotionCheck("jog", "X", "X", "bad", why="too fast", params=("axis.max_rate",)))
    window.table.setCurrentCell(0, 0)
    assert "axis.max_rate" in window.detail.text()
    window.detail.linkActivated.emit("axis.max_rate")
    assert followed == ["axis.max_rate"]
    assert window.summary.text() == "1 bad"


def test_an_edit_checks_again_once_the_page_is_seen_and_a_row_is_wanted_as_a_motion(
    router: Workspace, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs: list[str] = []

    def checks(file: ParameterFile) -> Iterator[MotionCheck]:
        runs.append(str(file.get(("axis.max_rate", "X")).value))
        yield MotionCheck("jog", "X", "X", "good")

    monkeypatch.setattr("amp_studio.ui.motion.check_page.check_motion", checks)
    page = CheckPage(router, print)
    qtbot.addWidget(page)
    router.file.set(("axis.max_rate", "X"), Value(999.0, "mm/min"))
    router.changed.emit([])
    assert runs == [], "nobody looks at it"
    page.show()
    qtbot.waitUntil(lambda: len(page.checks) == 1, timeout=WAIT_MS)
    assert runs == ["999.0"]
    page.table.setCurrentCell(0, 0)
    with qtbot.waitSignal(page.motion_wanted) as wanted:
        page.motion.click()
    assert wanted.args == ["jog", "X"]


def test_what_is_bad_comes_first_and_a_row_stays_its_own_check(router: Workspace, qtbot: QtBot) -> None:
    page = CheckPage(router, print)
    qtbot.addWidget(page)
    for verdict, axis in (("good", "X"), ("not possible", "S"), ("bad", "Y"), ("good", "Z"), ("bad", "Z")):
        page.show_check(MotionCheck("jog", axis, axis, verdict))
    assert [page.table.item(row, 0).text()[-1] for row in range(5)] == ["Y", "Z", "X", "Z", "S"]
    assert [check.letter for check in page.checks] == ["Y", "Z", "X", "Z", "S"]
    assert page.summary.text() == "2 bad, 2 good, 1 not possible"


def test_what_is_below_the_checks_is_german_and_its_links_follow_the_theme(
    router: Workspace, qtbot: QtBot, german: None
) -> None:
    """An alarm was English, and a link of a light window stayed dark blue in a dark one."""
    page = CheckPage(router, print)
    qtbot.addWidget(page)
    alarm = Alarm("ALARM:17", 1.0, "A motor driver reports a fault (A34)")
    page.show_check(MotionCheck("travel", "X", "X", "bad", alarms=(alarm,), params=("axis.max_rate",)))
    page.table.setCurrentCell(0, 0)
    assert "<b>ALARM:17</b> Ein Motortreiber" in page.detail.text()
    page.show_check(MotionCheck("jog", "X", "X", "bad", why="too fast", params=("axis.max_rate",)))
    page.table.setCurrentCell(1, 0)
    assert "too fast" in page.detail.text(), "a reason that is cut in the table is whole here"
    seen = set()
    for theme in ("dark", "light"):
        scheme().choose(theme)
        assert f"color:{colour('sel').name()}" in page.detail.text()
        seen.add(page.detail.text())
    assert len(seen) == 2
