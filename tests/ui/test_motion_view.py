"""The motion page follows the file as it is edited."""

import threading
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt, QUrl
from PySide6.QtWidgets import QFileDialog, QLabel, QLineEdit
from pytestqt.qtbot import QtBot

from amp_studio.files import ParameterFile
from amp_studio.schema import Value
from amp_studio.sim import Recommendation, SweepWay, Trace, simulate
from amp_studio.sim.picture import picture_of
from amp_studio.sim.scenarios import SCENARIOS
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.task import Task
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.motion import run as motion_run
from amp_studio.ui.motion.view import MotionView
from tests.sim.tiny import tiny

from .conftest import WAIT_MS, action

_TRACES: dict[tuple[object, ...], Trace] = {}


@pytest.fixture(autouse=True)
def each_run_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Simulate the same values with the same settings once for all tests."""

    def remembered(
        file: ParameterFile,
        scenario: str,
        axis: str,
        settings: dict[str, float | str],
        like: Trace | None = None,
    ) -> Trace:
        moved = like.move if like else {}
        key = (scenario, axis, *settings.items(), *moved.items(), *file.values.items())
        if key not in _TRACES:
            _TRACES[key] = simulate(file, scenario, axis, settings, like=like)
        return _TRACES[key]

    monkeypatch.setattr(motion_run, "simulate", remembered)


@pytest.fixture
def view(window: MainWindow, qtbot: QtBot) -> MotionView:
    """Return the open step view with its first trace."""
    window.go_to(("servo.excess_error", "2"))
    action(window, "Motion").trigger()
    view = window.findChild(MotionView)
    settled(view, qtbot)
    return view


def settled(view: MotionView, qtbot: QtBot) -> None:
    """Wait until no run is on its way and its picture is there."""
    qtbot.waitUntil(lambda: view._task is None, timeout=WAIT_MS)


def field(view: MotionView, name: str) -> QLineEdit:
    """Return the field of a setting."""
    found = view.settings.editors[f"move.{name}"]
    assert isinstance(found, QLineEdit)
    return found


def choose(view: MotionView, scenario: str, qtbot: QtBot) -> None:
    """Choose a scenario and wait for its trace."""
    view.scenario.setCurrentIndex(view.scenario.findData(scenario))
    settled(view, qtbot)


def test_it_begins_with_the_selected_axis_and_draws_a_trace(view: MotionView) -> None:
    assert view.axis.currentData() == "2"
    assert view.trace.axis == "2"
    assert [len(panel.curves) for panel in view.plot.panels] == [2, 1, 2, 1]
    assert "steady following error" in view.figures.toPlainText()
    assert view.save_button.isEnabled()
    assert view.chart.isHidden()


def test_it_draws_again_after_an_edit_and_after_its_undo(
    view: MotionView, window: MainWindow, qtbot: QtBot
) -> None:
    """The lower the gain, the larger the following error."""
    before = view.trace.result["steady_following_error"][0]
    old = view.trace
    window.workspace.edit("gain", {("servo.initial_gain", "2"): Value(0.95)})
    qtbot.waitUntil(lambda: view.trace is not old, timeout=WAIT_MS)
    settled(view, qtbot)
    assert view.trace.result["steady_following_error"][0] == pytest.approx(before / 0.95, rel=0.01)

    window.menus["edit.undo"].trigger()
    settled(view, qtbot)
    assert view.trace.result["steady_following_error"][0] == pytest.approx(before)


def test_edits_while_it_runs_end_with_the_last(view: MotionView, window: MainWindow, qtbot: QtBot) -> None:
    for gain in (0.99, 0.98, 0.95):
        window.workspace.edit("gain", {("servo.initial_gain", "2"): Value(gain)})
    settled(view, qtbot)
    once = view.trace.result["steady_following_error"][0]
    view.run()
    settled(view, qtbot)
    assert view.trace.result["steady_following_error"][0] == once


def test_a_sweep_shows_how_far_it_is_and_is_stopped_and_kept(
    view: MotionView, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    go_on, ways = threading.Event(), []

    def half_of_it(_file: ParameterFile, _axis: str, _settings: object, *, way: SweepWay) -> Trace:
        ways.append(way)
        way.progress("sweep", 50, 200)
        go_on.wait(WAIT_MS / 1000.0)
        way.progress("sweep", 100, 200)
        raise AssertionError("it was not stopped")

    monkeypatch.setattr(motion_run, "sweep", half_of_it)
    view.scenario.setCurrentIndex(view.scenario.findData("sweep"))
    qtbot.waitUntil(lambda: "25 %" in view.summary.text(), timeout=WAIT_MS)
    assert view.run_button.text() == "&Stop"
    view.run_button.click()
    go_on.set()
    settled(view, qtbot)
    assert "Stopped; the same sweep goes on from here" in view.summary.text()
    assert view.run_button.text() == "&Run"
    assert ways[0].output is not None, "what is done is kept"


def test_a_sweep_of_the_saved_values_is_stopped_too(
    view: MotionView, monkeypatch: pytest.MonkeyPatch
) -> None:
    cancelled, swept, trace = threading.Event(), [], view.trace

    def stopped_in_the_second(file: ParameterFile, _axis: str, _settings: object, *, way: SweepWay) -> Trace:
        swept.append(file)
        if len(swept) == 2:
            cancelled.set()
        way.progress("sweep", 1, 2)
        return trace

    monkeypatch.setattr(motion_run, "sweep", stopped_in_the_second)
    file, saved = view._workspace.file.copy(), view._workspace.file.copy()
    asked = motion_run.AskedMotion("sweep", "2", {}, file, saved, None, None)
    ran = motion_run.run_motion(asked, lambda *_: None, cancelled)
    assert swept == [file, saved]
    assert (ran.trace, ran.before) == (trace, None)


def test_distance_and_feedrate_take_units_and_a_decimal_comma(
    view: MotionView, window: MainWindow, qtbot: QtBot
) -> None:
    field(view, "distance").setText("2 in")
    field(view, "feedrate").setText("1500,5")
    view.run()
    settled(view, qtbot)
    assert view.trace.result["distance"] == (50.8, "mm")
    assert view.trace.result["feedrate"][0] == 1500.5

    window.menus["view.switch_units"].trigger()  # to inch: a bare number is an inch now
    field(view, "distance").setText("2")
    field(view, "feedrate").clear()
    view.run()
    settled(view, qtbot)
    assert view.trace.result["distance"] == (2.0, "in")
    assert field(view, "distance").placeholderText().startswith("in,")
    assert {panel.y.unit for panel in view.plot.picture.panels} == {"in", "in/min", "%"}


def test_a_wrong_unit_is_reported_in_place(view: MotionView, qtbot: QtBot) -> None:
    field(view, "distance").setText("90 deg")
    view.run()
    assert "Give the distance of this axis in mm, not in °" in view.summary.text()
    view.axis.setCurrentIndex(view.axis.findData("4"))  # rotary
    settled(view, qtbot)
    assert view.trace.axis == "4"
    assert view.trace.result["distance"][0] == 90.0


def test_an_axis_that_is_deleted_is_no_longer_offered(
    view: MotionView, window: MainWindow, qtbot: QtBot
) -> None:
    window.workspace.edit("type", {("axis.type", "2"): Value("unfitted")})
    settled(view, qtbot)
    assert view.axis.findData("2") == -1


def test_what_cannot_be_simulated_is_shown_with_a_way_to_what_has_to_be_set(
    view: MotionView, window: MainWindow, qtbot: QtBot
) -> None:
    window.workspace.edit("gain", {("servo.initial_gain", "2"): None})
    settled(view, qtbot)
    assert 'href="param:servo.initial_gain"' in view.summary.text()
    assert (view.trace, view.plot.picture, view.save_button.isEnabled()) == (None, None, False)
    view.summary.linkActivated.emit("param:servo.initial_gain")
    assert window.selected() == ("servo.initial_gain", "2")


def test_every_scenario_of_the_family_can_be_chosen_and_has_its_own_settings(
    view: MotionView, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("amp_studio.sim.run.recommendations", lambda trial, scenario, own: (tuple(own), ()))
    assert {"step", "frequency", "circle"} <= {
        view.scenario.itemData(n) for n in range(view.scenario.count())
    }
    choose(view, "velocity", qtbot)
    assert [panel.title for panel in view.plot.picture.panels] == ["position", "velocity", "torque"]
    assert "move.distance" not in view.settings.editors
    choose(view, "circle", qtbot)
    assert view.plot.picture.above
    assert "radius error" in view.figures.toPlainText()
    choose(view, "step", qtbot)
    assert "move.distance" in view.settings.editors


def test_the_trace_before_an_edit_lies_under_the_one_after_it(
    view: MotionView, window: MainWindow, qtbot: QtBot
) -> None:
    window.workspace.edit("gain", {("servo.initial_gain", "2"): Value(0.5)})
    settled(view, qtbot)
    assert view.plot.picture.panels[1].curves[0].is_before
    assert view.before.move == view.trace.move, (
        "the default distance depends on the gain, and both make one move"
    )
    window.workspace.edit("rapid", {("feedrate.rapid", "2"): Value(5000.0, "mm/min")})
    settled(view, qtbot)
    assert view.before.result["feedrate"] == view.trace.result["feedrate"] == (5000.0, "mm/min")
    assert "saved" in view.figures.toPlainText()
    view.against.setCurrentIndex(view.against.findData("alone"))
    settled(view, qtbot)
    assert not view.plot.picture.panels[1].curves[0].is_before


def test_what_is_kept_belongs_to_its_scenario(view: MotionView, window: MainWindow, qtbot: QtBot) -> None:
    view.keep.click()
    window.workspace.edit("gain", {("servo.initial_gain", "2"): Value(0.5)})
    settled(view, qtbot)
    assert view.plot.picture.panels[1].curves[0].is_before
    assert "kept" in view.figures.toPlainText()
    choose(view, "travel", qtbot)
    assert view.against.currentData() == "saved", "each scenario has its own"
    choose(view, "step", qtbot)
    assert view.against.model().item(view.against.findData("kept")).isEnabled()


def test_a_cursor_is_dragged_or_moved_by_the_arrow_keys_and_its_values_are_shown(
    view: MotionView, qtbot: QtBot
) -> None:
    view.plot.grab()  # where the panels are is known once they are painted
    start, end = view.plot.cursors[0], 1.4 * view.plot.cursors[0]
    x = [int(view.plot._frames[0].at((place, 0.0))[0]) for place in (start, end)]
    for event, at in ((qtbot.mousePress, x[0]), (qtbot.mouseMove, x[1]), (qtbot.mouseRelease, x[1])):
        event(
            view.plot,
            *(() if event is qtbot.mouseMove else (Qt.MouseButton.LeftButton,)),
            pos=QPoint(at, 100),
        )
    assert view.plot.cursors[0] == pytest.approx(end, rel=0.01)
    error = np.interp(
        view.plot.cursors[0], view.trace.columns["time_s"], view.trace.columns["following_error"]
    )
    assert f"{error:.5g}" in view.values.text()
    a, b = view.plot.cursors
    qtbot.keyClick(view.plot, Qt.Key.Key_Right)
    qtbot.keyClick(view.plot, Qt.Key.Key_Left, Qt.KeyboardModifier.ShiftModifier)
    assert view.plot.cursors[0] > a
    assert view.plot.cursors[1] < b


def test_keys_a_dragged_place_and_zoom_to_settling_show_a_part_and_all_of_it_comes_back(
    view: MotionView, qtbot: QtBot
) -> None:
    view.plot.grab()
    low, high = whole = view.plot.span
    qtbot.keyClick(view.plot, Qt.Key.Key_Plus)
    assert view.plot.span == pytest.approx((low + 0.1 * (high - low), high - 0.1 * (high - low)))
    before = view.plot.span
    qtbot.mousePress(view.plot, Qt.MouseButton.LeftButton, pos=QPoint(200, 100))
    qtbot.mouseMove(view.plot, pos=QPoint(190, 100))
    assert view.plot.span[0] > before[0]
    qtbot.mouseRelease(view.plot, Qt.MouseButton.LeftButton, pos=QPoint(190, 100))
    qtbot.mouseDClick(view.plot, Qt.MouseButton.LeftButton, pos=QPoint(300, 100))
    assert view.plot.span == whole
    view.settling.click()
    panel = view.plot.panels[1]
    low, bottom, top = panel.x.low, panel.y.low, panel.y.high
    assert low > view.trace.columns["time_s"][-1] / 2
    assert top - bottom < view.trace.result["peak_following_error"][0] / 2
    view.all_of_it.click()
    panel = view.plot.panels[1]
    low, bottom, top = panel.x.low, panel.y.low, panel.y.high
    assert low < 0.1
    assert top > view.trace.result["peak_following_error"][0]


def test_a_recommendation_is_applied_as_one_undoable_change_and_run_again(
    view: MotionView, window: MainWindow, qtbot: QtBot
) -> None:
    address = ("servo.inposition_band", "2")
    before, old = window.workspace.file.get(address), view.trace
    view.apply([Recommendation("servo.inposition_band", 0.05, "mm", "why", "price")])
    qtbot.waitUntil(lambda: view.trace is not old, timeout=WAIT_MS)
    settled(view, qtbot)
    assert window.workspace.file.get(address) == Value(0.05, "mm")
    window.menus["edit.undo"].trigger()
    settled(view, qtbot)
    assert window.workspace.file.get(address) == before


def test_every_recommendation_has_its_price_a_button_and_a_way_to_its_parameter(
    view: MotionView, window: MainWindow
) -> None:
    found = [
        Recommendation("servo.gain_break_point", 5.0, "mm", "Because.", "A little."),
        Recommendation("no.parameter", 1.0, "", "x"),
    ]
    view.recommendations.show_all(view._workspace.file.schema, found, view._may_apply)
    texts = [label.text() for label in view.recommendations.findChildren(QLabel)]
    assert "Price: A little." in texts
    assert [button.text() for button in view.recommendations.buttons] == ["Apply"]
    view.apply([Recommendation("servo.inposition_band", -0.05, "mm", "why")])
    assert view.summary.text()
    assert view._workspace.file.get(("servo.inposition_band", "2")) != Value(-0.05, "mm")
    view.figures.anchorClicked.emit(QUrl("param:servo.gain_break_point"))
    assert window.selected() == ("servo.gain_break_point", "2")


def test_the_trace_is_saved(view: MotionView, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for ending in ("svg", "csv", "png"):
        answer = str(tmp_path / f"step.{ending}"), f"{ending.upper()} (*.{ending})"
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_, answer=answer: answer)
        view.save()
        assert Path(answer[0]).stat().st_size > 500


def test_leaving_it_runs_nothing_until_a_user_looks_again(
    view: MotionView, window: MainWindow, qtbot: QtBot
) -> None:
    view.left.emit()
    assert not window.page.turned_to
    assert window.table_view.isVisible()
    old = view.trace
    window.workspace.edit("gain", {("servo.initial_gain", "2"): Value(0.5)})
    assert view._task is None
    window.go_to(("servo.excess_error", "3"))
    action(window, "Motion").trigger()
    settled(view, qtbot)
    assert (view.trace.axis, old.axis) == ("3", "2"), "the axis that is selected now"
    action(window, "Motion").trigger()
    assert not window.page.turned_to


def test_the_panels_come_back_as_they_were(view: MotionView, window: MainWindow) -> None:
    view.left.emit()
    window.workspace.edit("small", {("servo.excess_error", "1"): Value(0.001, "mm")})
    assert not window.findings.isVisible(), "they were folded, and nobody has opened them"
    assert window.detail.isVisible()
    window.page.show_page("motion")
    assert not window.detail.isVisible()
    window.go_to(("servo.excess_error", "1"))
    assert (window.detail.isVisible(), window.findings.isVisible()) == (True, False)


def test_closing_the_program_while_it_runs_ends_well(view: MotionView, window: MainWindow) -> None:
    view.run()
    assert Task.running
    assert window.close()
    assert not Task.running


def test_it_closes_with_its_file(view: MotionView, window: MainWindow, qtbot: QtBot) -> None:
    with qtbot.waitSignal(view.destroyed, timeout=WAIT_MS):
        window.files.close()


def test_a_bode_plot_is_painted_with_plain_numbers_on_its_axis(qtbot: QtBot) -> None:
    plot = Plot()
    qtbot.addWidget(plot)
    plot.resize(700, 500)
    plot.draw(picture_of(SCENARIOS["frequency"].run(tiny(gain=2500.0), {})))
    assert not plot.grab().isNull()
    assert {"20", "50", "100"} <= {text for _, text in plot._frames[1].ticks("x")}


def test_another_scenario_shows_the_fields_of_its_settings(view: MotionView, qtbot: QtBot) -> None:
    view.show()
    for scenario in ("home", "circle", "travel", "step"):
        choose(view, scenario, qtbot)
        assert view.settings.height() >= view.settings.sizeHint().height() > 60, scenario
    assert view.trace.scenario == "step"


def test_a_record_of_the_machine_is_laid_over_until_none_is_named(
    view: MotionView, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record, plain = tmp_path / "record.csv", view.trace
    columns = (plain.columns["time_s"][::8], plain.columns["position"][::8] + 1.0)
    rows = (f"{time!r},{place!r}" for time, place in zip(*map(np.ndarray.tolist, columns), strict=True))
    record.write_text("time (s),position (mm)\n" + "\n".join(rows))
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(record), ""))
    view.recorder.open.click()
    settled(view, qtbot)
    assert view.trace.result["difference_rms_position"][0] == pytest.approx(1.0, abs=0.01)
    assert any(curve.name == "recorded position" for curve in view.plot.panels[0].curves)
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: ("", ""))
    view.recorder.open.click()
    settled(view, qtbot)
    assert "difference_rms_position" not in view.trace.result
