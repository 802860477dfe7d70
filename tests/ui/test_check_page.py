"""The page Machine: each check as it is done, in its part, with its bar, its figure, its picture and its
fix."""

from collections.abc import Iterator
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent, Qt
from PySide6.QtGui import QKeyEvent
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from amp_studio.files import Document, ParameterFile, new_file
from amp_studio.schema import Value
from amp_studio.sim import Alarm, LimitUse, MotionCheck, Recommendation, check_again, check_motion, simulate
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.theme import colour, scheme
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.motion import check_page
from amp_studio.ui.motion.check_list import figure_of
from amp_studio.ui.motion.check_page import CheckPage

from .conftest import WAIT_MS

EXAMPLES = Path(__file__).parents[2] / "examples"
ROUTER = EXAMPLES / "grblhal-router" / "GRBL_ROUTER.amp"
MILL = EXAMPLES / "mill-1394" / "MILL_1394.amp"


@pytest.fixture
def router(qapp: object) -> Iterator[Workspace]:
    workspace = Workspace(Document.view(ROUTER))
    yield workspace
    workspace.close()


@pytest.fixture
def mill(qapp: object, tmp_path: Path) -> Iterator[Workspace]:
    path = tmp_path / MILL.name
    path.write_bytes(MILL.read_bytes())
    workspace = Workspace(Document.open(path))
    yield workspace
    workspace.close()


def listed(page: CheckPage) -> list[str]:
    """Return the rows of the list: heads, and checks by their names."""
    return [str(page.rows.index(n).data()) for n in range(page.rows.rowCount())]


def spoken(page: CheckPage, row: int) -> str:
    return str(page.rows.index(row).data(Qt.ItemDataRole.AccessibleTextRole))


def test_every_scenario_of_the_file_is_a_row_of_its_part(router: Workspace, qtbot: QtBot) -> None:
    page = CheckPage(router, print)
    qtbot.addWidget(page)
    page.start()
    qtbot.waitUntil(lambda: not Task.running and len(page.checks) >= 16, timeout=10 * WAIT_MS)
    assert listed(page)[:5] == ["Homing", "Home X", "Home Y", "Home Z", "Travel and zones"]
    assert page.chips["good"].text() == "16"
    assert not page.chips["bad"].isVisibleTo(page)
    assert spoken(page, 1) == "Home X: good, −787 mm"
    page.choose("home", "Y")
    assert page.title.text() == "Home, Y"
    assert page.card.scene.scene is not None, "the course of a homing is seen beside it"
    assert page.card.scene.scene.title == "Homing Y"
    assert list(page.card.axes.buttons) == ["X", "Y", "Z"]
    page.choose("step", "X")
    assert page.card.plot.picture is not None
    assert {check.part for check in page.checks} == {"homing", "travel", "following", "spindle", "probing"}


def test_the_heading_is_whole_or_not_there(router: Workspace, qtbot: QtBot) -> None:
    page = CheckPage(router, lambda _: None)
    qtbot.addWidget(page)
    page.stop()
    for width, painted in ((20, ""), (400, "Checks")):
        page.heading.resize(width, 20)
        assert page.heading._elided() == painted
    page.heading.resize(20, 20)
    page.heading.setText("Checks")
    assert page.heading.toolTip() == "Checks"


def test_what_is_bad_comes_first_in_its_part_and_the_counts_filter(router: Workspace, qtbot: QtBot) -> None:
    page = CheckPage(router, print)
    qtbot.addWidget(page)
    for verdict, axis, part in (
        ("good", "X", "travel"),
        ("not possible", "S", "travel"),
        ("bad", "Y", "travel"),
        ("doubtful", "Z", "homing"),
        ("good", "Z", "travel"),
    ):
        page.show_check(MotionCheck("jog", axis, axis, verdict, part=part))
    whole = ["Homing", "Jog Z", "Travel and zones", "Jog Y", "Jog X", "Jog Z", "Jog S"]
    assert listed(page) == whole
    page.chips["bad"].click()
    assert listed(page) == ["Travel and zones", "Jog Y"]
    page.chips["doubtful"].click()
    assert listed(page) == ["Homing", "Jog Z", "Travel and zones", "Jog Y"]
    for verdict in ("bad", "doubtful"):
        page.chips[verdict].click()
    assert listed(page) == whole


def test_a_new_file_without_a_spindle_is_listed(qapp: object) -> None:
    file = new_file("9pc", "mill", ["X"])
    spindle = next(check for check in check_motion(file) if check.scenario == "spindle")
    assert (spindle.axis, figure_of(file, spindle)) == ("", "not possible")
    del file.values[("axis.type", "1")]
    assert figure_of(file, MotionCheck("step", "1", "X", "not possible", params=("axis.type",))) == "not set"


def test_a_row_has_the_share_of_its_limit_or_its_figure(router: Workspace) -> None:
    file, use = router.file, LimitUse(1.2, "excess error", 12.0, 10.0, "mm")
    assert figure_of(file, MotionCheck("step", "X", "X", "bad", use=use)) == "12 of 10 mm"
    assert figure_of(file, MotionCheck("step", "X", "X", "good", use=LimitUse(0.5, "", 5.0, 10.0))) == "50 %"
    unstable = MotionCheck("frequency", "X", "X", "doubtful", use=LimitUse(float("inf"), "margins"))
    assert figure_of(file, unstable) == "unstable"
    grid = MotionCheck(
        "home", "X", "X", "good", {"home_grid": (47.0, "%")}, part="homing", headline="home_grid"
    )
    assert figure_of(file, grid) == "47 %"
    assert figure_of(file, MotionCheck("travel", "B", "B", "not possible")) == "not possible"
    del file.values[("axis.max_rate", "X")]
    assert (
        figure_of(file, MotionCheck("jog", "X", "X", "not possible", params=("axis.max_rate",))) == "not set"
    )


def test_an_edit_checks_again_once_the_page_is_seen_and_a_row_is_wanted_as_a_motion(
    router: Workspace, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    runs: list[str] = []

    def checks(file: ParameterFile) -> Iterator[MotionCheck]:
        runs.append(str(file.get(("axis.max_rate", "X")).value))
        yield MotionCheck("jog", "X", "X", "good")

    monkeypatch.setattr(check_page, "check_motion", checks)
    page = CheckPage(router, print)
    qtbot.addWidget(page)
    router.file.set(("axis.max_rate", "X"), Value(999.0, "mm/min"))
    router.changed.emit([])
    assert runs == [], "nobody looks at it"
    page.show()
    qtbot.waitUntil(lambda: page.check is not None and not Task.running, timeout=WAIT_MS)
    assert runs == ["999.0"]
    with qtbot.waitSignal(page.motion_requested) as wanted:
        page.motion.click()
    assert wanted.args == ["jog", "X"]
    key = QKeyEvent(QEvent.Type.ShortcutOverride, Qt.Key.Key_F9, Qt.KeyboardModifier.NoModifier)
    QApplication.sendEvent(page, key)
    assert key.isAccepted(), "F9 is the page's, not that of the motion"
    QTest.keyClick(page, Qt.Key.Key_F9)
    qtbot.waitUntil(lambda: len(runs) == 2 and not Task.running, timeout=WAIT_MS)


def test_digits_choose_an_axis_of_the_chosen_scenario(router: Workspace, qtbot: QtBot) -> None:
    page = CheckPage(router, print)
    qtbot.addWidget(page)
    for scenario in ("jog", "home"):
        for axis in "XY":
            page.show_check(MotionCheck(scenario, axis, axis, "good"))
    page.choose("home", "X")
    page._show_nth(1)
    assert page.check is not None
    assert (page.check.scenario, page.check.axis) == ("home", "Y")
    page._show_nth(2)
    assert page.check.axis == "Y", "there is no third axis"


def test_what_the_control_would_say_is_german_and_links_follow_the_theme(
    router: Workspace, qtbot: QtBot, german: None
) -> None:
    page = CheckPage(router, print)
    qtbot.addWidget(page)
    alarm = Alarm("ALARM:17", 1.0, "A motor driver reports a fault (A34)")
    page._show(MotionCheck("travel", "X", "X", "bad", alarms=(alarm,), params=("axis.max_rate",)))
    assert page.card.message.text().startswith("Die Steuerung meldet: ALARM:17 Ein Motortreiber")
    followed: list[str] = []
    page.detail.linkActivated.connect(followed.append)
    page.detail.linkActivated.emit("axis.max_rate")
    assert followed == ["axis.max_rate"]
    page.show_check(MotionCheck("jog", "X", "X", "bad", why="too fast", params=("axis.max_rate",)))
    page.choose("jog", "X")
    assert page.why.text() == "too fast"
    seen = set()
    for theme in ("dark", "light"):
        scheme().choose(theme)
        assert f"color:{colour('sel').name()}" in page.detail.text()
        seen.add(page.detail.text())
    assert len(seen) == 2


def test_a_short_switch_is_an_alarm_whose_fix_mends_it(mill: Workspace, qtbot: QtBot) -> None:
    """9/PC 5-4: leaving the switch as it came onto it, the axis passed the whole switch."""
    mill.file.set(("home.direction_off_switch", "1"), Value("positive"))
    page = CheckPage(mill, print)
    qtbot.addWidget(page)
    found = check_again(mill.file, "home", "1", {"move.switch_length": "5 mm"})
    page.show_check(found)
    page.choose("home", "1")
    page._take_again(found)
    assert found.alarms[0].code == "JOGGED HOME TOO FAST: X"
    assert page.card.fix.text().startswith("Set 1011 to ")
    page.card.fix.click()
    slower = check_again(mill.file, "home", "1", {"move.switch_length": "5 mm"})
    assert slower.alarms == ()
    assert 0.0 < (slower.figures["switch_overrun"][0] or 0.0) < 4.1


def test_recommendations_of_one_loop_are_one_fix(mill: Workspace, qtbot: QtBot) -> None:
    page = CheckPage(mill, print)
    qtbot.addWidget(page)
    page.show_check(MotionCheck("step", "1", "X", "doubtful"))
    page.choose("step", "1")
    found = [
        Recommendation("servo.initial_gain", 1.5, "", "why"),
        Recommendation("servo.excess_error", 20.0, "mm", "why"),
    ]
    page._offer(found)
    assert page.card.fix.text() == "Set 2 values"
    steps = mill.undo_stack.count()
    page.card.fix.click()
    assert mill.undo_stack.count() == steps + 1
    assert mill.file.get(("servo.excess_error", "1")) == Value(20.0, "mm")


def test_a_dragged_target_is_simulated_again(mill: Workspace, qtbot: QtBot) -> None:
    page = CheckPage(mill, print)
    qtbot.addWidget(page)
    page.travel.follow(mill.file.copy())
    qtbot.waitUntil(lambda: page.travel.trace is not None, timeout=10 * WAIT_MS)
    first = page.travel.trace
    assert first is not None
    assert [alarm.code for alarm in first.alarms] == ["OVERTRAVEL"]
    page.travel.scene._move("to", (-93.6, -250.0))
    qtbot.waitUntil(lambda: page.travel.trace not in (None, first), timeout=10 * WAIT_MS)
    assert page.travel.trace is not None
    assert page.travel.trace.alarms == (), "the axis reaches a target inside of its travel"
    assert page.travel.trace.result["stop_position_Y"][0] == pytest.approx(-250.0, abs=0.1)


def test_a_typed_speed_is_shown_in_its_gear(qtbot: QtBot, qapp: object) -> None:
    workspace = Workspace(Document.view(EXAMPLES / "num-1060-mill" / "MILL_1060.amp"))
    page = CheckPage(workspace, print)
    qtbot.addWidget(page)
    page.spindle.speed.setText("S1200")
    page.spindle.follow(workspace.file.copy(), has_spindle=True)
    qtbot.waitUntil(lambda: page.spindle.scene.scene is not None, timeout=10 * WAIT_MS)
    assert page.spindle.scene.scene is not None
    words = {text.text: text.value for text in page.spindle.scene.scene.texts}
    assert words["S1200"] == "gear 42, 6 V, 0 s"
    result = simulate(workspace.file, "spindle", None, {"move.speed": 1200.0}).result
    assert result["output"] == (pytest.approx(6.0), "V")
    workspace.close()


def test_many_parameters_of_a_check_do_not_fill_a_low_page(router: Workspace, qtbot: QtBot) -> None:
    """While the machine was checked, eight of a homing were cut on a screen at 200 %."""
    page = CheckPage(router, print)
    qtbot.addWidget(page)
    known = tuple(router.file.schema.parameters)[:8]
    page._show(MotionCheck("home", "X", "X", "good", params=known))
    assert page.detail.text().count("<a href") == 5
    assert page.detail.text().endswith("3 more")
    assert page.detail.toolTip().count("\n") == 7
