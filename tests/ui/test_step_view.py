"""The step plot follows the file as it is edited."""

from __future__ import annotations

from pathlib import Path

import pytest
from PySide6.QtCore import QUrl
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from amp_studio.schema import Value
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.step_view import StepView
from amp_studio.ui.task import Task

from .conftest import WAIT_MS, action


@pytest.fixture
def view(window: MainWindow, qtbot: QtBot) -> StepView:
    """Return the open step view with its first trace."""
    window.go_to(("servo.excess_error", "2"))
    action(window, "Step Response").trigger()
    view = window.findChild(StepView)
    settled(view, qtbot)
    return view


def settled(view: StepView, qtbot: QtBot) -> None:
    """Wait until no run is on its way."""
    qtbot.waitUntil(lambda: view._task is None, timeout=WAIT_MS)


def test_it_begins_with_the_selected_axis_and_draws_a_trace(view: StepView) -> None:
    assert view.axis.currentData() == "2"
    assert view.trace.axis == "2"
    assert [len(panel.listDataItems()) for panel in view.plot.panels] == [2, 1, 3]
    assert "steady following error" in view.figures.toPlainText()
    assert view.save_button.isEnabled()


def test_it_draws_anew_after_an_edit_and_after_its_undo(
    view: StepView, window: MainWindow, qtbot: QtBot
) -> None:
    """The lower the gain, the larger the following error."""
    before = view.trace.result["steady_following_error"][0]
    old = view.trace
    window.workspace.edit("gain", {("servo.initial_gain", "2"): Value(0.95)})
    qtbot.waitUntil(lambda: view.trace is not old, timeout=WAIT_MS)
    settled(view, qtbot)
    assert view.trace.result["steady_following_error"][0] == pytest.approx(before / 0.95, rel=0.01)

    window.edits.undo.trigger()
    settled(view, qtbot)
    assert view.trace.result["steady_following_error"][0] == pytest.approx(before)


def test_edits_while_it_runs_end_with_the_last(view: StepView, window: MainWindow, qtbot: QtBot) -> None:
    for gain in (0.99, 0.98, 0.97, 0.95):
        window.workspace.edit("gain", {("servo.initial_gain", "2"): Value(gain)})
    settled(view, qtbot)
    once = view.trace.result["steady_following_error"][0]
    view.run()
    settled(view, qtbot)
    assert view.trace.result["steady_following_error"][0] == once


def test_distance_and_feedrate_take_units_and_a_decimal_comma(
    view: StepView, window: MainWindow, qtbot: QtBot
) -> None:
    view.distance.setText("2 in")
    view.feedrate.setText("1500,5")
    view.run()
    settled(view, qtbot)
    assert view.trace.result["distance"] == (50.8, "mm")
    assert view.trace.result["feedrate"][0] == 1500.5

    window.view.switch.trigger()  # to inch: a bare number is an inch now
    view.distance.setText("2")
    view.feedrate.clear()
    view.run()
    settled(view, qtbot)
    assert view.trace.result["distance"][0] == pytest.approx(50.8)
    assert view.distance.placeholderText().startswith("in,")


def test_a_wrong_unit_is_told_in_place(view: StepView, qtbot: QtBot) -> None:
    view.distance.setText("90 deg")
    view.run()
    assert "Give the distance of this axis in mm, not in °" in view.summary.text()
    view.axis.setCurrentIndex(view.axis.findData("4"))  # rotary
    settled(view, qtbot)
    assert view.trace.axis == "4"
    assert view.trace.result["distance"][0] == 90.0


def test_an_axis_that_is_deleted_is_no_longer_offered(
    view: StepView, window: MainWindow, qtbot: QtBot
) -> None:
    window.workspace.edit("type", {("axis.type", "2"): Value("unfitted")})
    settled(view, qtbot)
    assert view.axis.findData("2") == -1


def test_what_cannot_be_simulated_is_told_in_place(view: StepView, window: MainWindow, qtbot: QtBot) -> None:
    window.workspace.edit("gain", {("servo.initial_gain", "2"): None})
    settled(view, qtbot)
    assert "Gain" in view.summary.text() or "gain" in view.summary.text()


@pytest.mark.parametrize("ending", ["svg", "csv", "png"])
def test_the_trace_is_saved(view: StepView, tmp_path: Path, monkeypatch, ending: str) -> None:
    path = tmp_path / f"step.{ending}"
    monkeypatch.setattr(
        QFileDialog, "getSaveFileName", lambda *_: (str(path), f"({ending.upper()} (*.{ending})")
    )
    view.save()
    assert path.stat().st_size > 500


def test_advice_leads_to_its_parameter(view: StepView, window: MainWindow) -> None:
    view.figures.anchorClicked.emit(QUrl("param:servo.gain_break_point"))
    assert window.selected() == ("servo.gain_break_point", "2")


def test_closing_it_while_it_runs_ends_well(view: StepView, window: MainWindow, qtbot: QtBot) -> None:
    view.run()
    assert view._task is not None
    with qtbot.waitSignal(view.destroyed, timeout=WAIT_MS):
        view.close()
    window.workspace.edit("gain", {("servo.initial_gain", "2"): Value(0.5)})
    qtbot.waitUntil(lambda: not Task.running, timeout=WAIT_MS)


def test_closing_the_program_while_it_runs_ends_well(view: StepView, window: MainWindow) -> None:
    view.run()
    assert Task.running
    assert window.close()
    assert not Task.running


def test_it_closes_with_its_file(view: StepView, window: MainWindow, qtbot: QtBot) -> None:
    with qtbot.waitSignal(view.destroyed, timeout=WAIT_MS):
        window.files.close()
