"""The Tuning window on values in a connected control."""

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QApplication
from pytestqt.qtbot import QtBot

from amp_studio.files import Document, new_file, open_file
from amp_studio.schema import Value
from amp_studio.transfer.client.live import LiveTuning
from amp_studio.transfer.exchange import Exchange
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.motion.tuning_page import TuningView
from tests.families.grblhal.bench import Bench, sent
from tests.ui.conftest import User

from .test_tuning import REVERSAL, TABLE, demand_manners, displayed, page, put_cursor


@pytest.fixture
def router(qapp: QApplication, tmp_path: Path) -> Workspace:
    path = tmp_path / "router.amp"
    Document.create(new_file("grblhal"), path).close()
    workspace = Workspace(Document.open(path))
    yield workspace
    workspace.close()


@pytest.fixture
def live(router: Workspace, tmp_path: Path, qtbot: QtBot, user: User) -> tuple[TuningView, Bench]:
    bench = Bench(tmp_path / "control")
    tuning = TuningView(router, lambda: LiveTuning(bench.driver, tmp_path / "router", address="bench"))
    displayed(tuning, qtbot)
    tuning.switch.buttons["control"].click()
    assert tuning.control is not None
    return tuning, bench


ACCELERATION = ("axis.acceleration", "X")


def test_a_live_value_goes_into_the_control_at_once_and_not_into_the_file(live, router: Workspace) -> None:
    tuning, bench = live
    values = page(tuning, "steps")
    put_cursor(values, ACCELERATION)
    values.table.item(values.table.currentRow(), 2).setText("25")
    assert sent(bench) == ["$120=25.000"]
    assert "read back equal" in tuning.message.text.text()
    assert tuning.message.text.text().endswith("Takes effect: at once.")
    assert "1 value changed" in tuning.state.text()
    assert not router.is_dirty
    QTest.keyClick(values.table, Qt.Key.Key_Z, Qt.KeyboardModifier.ControlModifier)
    assert sent(bench) == ["$120=25.000", "$120=10.000"]
    QTest.keySequence(values.table, QKeySequence(QKeySequence.StandardKey.Redo))
    assert sent(bench)[-1] == "$120=25.000"
    tuning.take.click()
    assert router.file.get(ACCELERATION).value == 25
    assert router.undo_stack.index() == 1


def test_what_a_control_does_not_state_is_simulated_as_in_the_file(live, router: Workspace) -> None:
    """An ACR card does not state its servo period at its terminal: nothing could be simulated there."""
    control, travel = live[0].control, ("axis.max_travel", "X")
    router.file.set(ACCELERATION, Value(77.0, "mm/s2"))
    own = control.file.get(ACCELERATION)
    control.file.set(travel, None)
    assert control.simulated().get(travel) == router.file.get(travel)
    assert control.simulated().get(ACCELERATION) == own != router.file.get(ACCELERATION)
    assert control.file.get(travel) is None


def test_the_old_values_are_offered_when_the_control_is_left(live, router: Workspace, user: User) -> None:
    tuning, bench = live
    tuning.target.set("Tune", {ACCELERATION: Value(25.0, "mm/s2")})
    user.answers("Cancel")
    assert not tuning.may_leave()
    user.answers("Put the Old Values Back")
    assert tuning.may_leave()
    assert sent(bench) == ["$120=25.000", "$120=10.000"]
    assert all("differ" in question for question in user.asked)


def test_after_a_lost_line_the_window_shows_what_is_known_and_reads_again(live, user: User) -> None:
    tuning, bench = live
    plain = bench.spoil_in

    def cut(data: bytes) -> bytes:
        bench.is_cut = bench.is_cut or b"$120=" in data
        return plain(data)

    bench.spoil_in = cut
    tuning.guarded(lambda: tuning.target.set("Tune", {ACCELERATION: Value(25.0, "mm/s2")}))
    assert "is not known" in tuning.message.text.text()
    assert "not known what the control contains" in tuning.state.text()
    assert not page(tuning, "steps").increase.isEnabled()
    bench.is_cut, bench.spoil_in = False, plain
    tuning.look.click()
    assert page(tuning, "steps").increase.isEnabled()
    user.answers("Keep Them in the Control")
    assert tuning.may_leave()


def test_a_control_that_takes_everything_at_once_gets_the_values_together(
    workspace: Workspace, qtbot: QtBot, user: User, start_house: Callable[[], LiveTuning]
) -> None:
    tuning = displayed(TuningView(workspace, lambda: None), qtbot)
    tuning._connect = start_house
    tuning.switch.buttons["control"].click()
    tuning.guarded(lambda: tuning.target.set("Tune", {REVERSAL: Value(0.004, "mm")}))
    assert tuning.send.text() == "Do&wnload 1 Value"
    tuning.guarded(lambda: tuning.target.set("Tune", {TABLE: Value("deviation - mm 0:0 100:0.004")}))
    assert tuning.send.text() == "Do&wnload 2 Values"
    tuning.send.click()
    assert tuning.control is not None
    assert tuning.control.waiting == 0
    assert tuning.control.file.get(TABLE) == Value("deviation - mm 0:0 100:0.004")
    assert "Restart" in tuning.message.text.text() or "restarted" in tuning.message.text.text()
    assert workspace.file.get(REVERSAL) == Value(0.0, "mm")
    tuning.control.put_back()
    assert tuning.control.file.get(REVERSAL) == Value(0.0, "mm")


@pytest.fixture
def start_house(tmp_path: Path, path: Path) -> Callable[[], LiveTuning]:
    """Return what connects to an emulated 9/PC in E-stop that contains the example."""
    from amp_studio.transfer.client.drivers import open_driver
    from amp_studio.transfer.client.parameters import download_file
    from tests.ui.conftest import Control

    control = Control(tmp_path / "control")
    download_file(open_file(path).file, control.address, Exchange(keep=tmp_path / "mill"))
    made: list[LiveTuning] = []

    def connect() -> LiveTuning:
        made.append(
            LiveTuning(open_driver(control.address, "9pc"), tmp_path / "mill", address=control.address)
        )
        return made[-1]

    yield connect
    for each in made:
        each.close()
    control.stop()


def test_the_same_is_true_with_a_control(live) -> None:
    demand_manners(live[0])


def test_the_window_fits_a_small_screen_with_a_control_too(live) -> None:
    tuning, _ = live
    for n in range(tuning.pages.count()):
        tuning.pages.setCurrentRow(n)
        hint = tuning.minimumSizeHint()
        assert (hint.width() <= 1000, hint.height() <= 660) == (True, True), tuning.pages.item(n).text()
