"""The recorder of the motion page: a record with its trigger, live from a control, channels on scales of
their own."""

from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from amp_studio.transfer import AxisStatus, ControlStatus
from amp_studio.ui.control.readings import StatusReadings
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.motion.view import MotionView

from .conftest import WAIT_MS, action


@pytest.fixture
def view(window: MainWindow, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> MotionView:
    """Return the motion page of axis X with its first trace, and a control that is chosen."""
    monkeypatch.setattr(type(window.control), "read_address", lambda _: "bench")
    window.go_to(("servo.excess_error", "1"))
    action(window, "Motion").trigger()
    found = window.findChild(MotionView)
    ran(found, qtbot)
    return found


def ran(view: MotionView, qtbot: QtBot) -> None:
    qtbot.waitUntil(lambda: view._task is None, timeout=WAIT_MS)


def laid(view: MotionView, qtbot: QtBot, path: Path, monkeypatch: pytest.MonkeyPatch, late: float) -> None:
    """Lay a record of the simulated move itself over it, later and 1 mm off."""
    time = np.arange(0.0, 3.0, 0.002)
    here, trace = time - late, view.trace
    columns = [
        np.interp(here, trace.columns["time_s"], trace.columns[name]) for name in ("position", "velocity")
    ]
    rows = zip(time.tolist(), (columns[0] + 1.0).tolist(), columns[1].tolist(), strict=True)
    path.write_text(
        "\n".join(["time (s),position (mm),velocity (mm/min)", *(",".join(map(repr, r)) for r in rows)])
    )
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    view.recorder.open.click()
    ran(view, qtbot)


def test_a_record_is_laid_over_by_the_trigger_that_is_chosen(
    view: MotionView, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    laid(view, qtbot, tmp_path / "record.csv", monkeypatch, 0.4)
    assert view.trace.result["record_lag"][0] == pytest.approx(0.4, abs=1e-3)
    assert "RMS of the difference: position 1 mm" in view.recorder.state.text()
    form = view.recorder.trigger
    form.editors["signal"].setCurrentIndex(form.editors["signal"].findData("velocity"))
    form.editors["level"].setText("500")
    form.editors["before"].setText("0.05")
    form.entered.emit("level")
    ran(view, qtbot)
    recorded = np.isfinite(view.trace.columns["recorded_velocity"])
    passes = view.trace.columns["time_s"][int(np.argmax(view.trace.columns["velocity"] > 500.0))]
    first = view.trace.columns["time_s"][int(np.argmax(recorded))]
    assert first == pytest.approx(max(0.0, passes - 0.05), abs=3e-3)
    form.editors["level"].setText("1e6")
    form.entered.emit("level")
    ran(view, qtbot)
    assert "never goes above" in view.recorder.state.text()
    assert view.trace is not None


def test_a_channel_has_its_scale_and_can_be_left_out(view: MotionView, qtbot: QtBot) -> None:
    table, before = view.recorder.channels, len(view.plot.panels)
    assert table.item(0, 3).text() == "mm"
    table.item(0, 1).setText("25")
    table.item(0, 2).setText("100")
    scale = view.plot.panels[0].y
    assert (scale.low, scale.high, scale.step) == (0.0, 200.0, 25.0)
    table.item(1, 0).setCheckState(Qt.CheckState.Unchecked)
    assert len(view.plot.panels) == before - 1
    assert "B − A" in view.values.text()  # the cursors read what is seen


def test_a_control_is_recorded_from_its_trigger_on_and_kept_beside_the_file(
    view: MotionView, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[str] = []
    monkeypatch.setattr(StatusReadings, "start", lambda self: asked.append(self._address))
    clock = iter(np.arange(0.0, 100.0, 0.2).tolist())
    monkeypatch.setattr("amp_studio.ui.motion.recorder.time.monotonic", lambda: next(clock))
    form, recorder = view.recorder.trigger, view.recorder
    form.editors["signal"].setCurrentIndex(form.editors["signal"].findData("position"))
    form.editors["level"].setText("2")
    form.editors["span"].setText("20")
    recorder.record.click()
    assert (asked, recorder.is_recording) == (["bench"], True)
    for place in [0.0] * 5:
        recorder.take(ControlStatus("9pc", "", "", "", (AxisStatus("X", place, None, 0.0, "mm"),)))
    assert "waits for position > 2" in recorder.state.text()
    for place in np.arange(0.0, 60.0, 0.5).tolist():
        recorder.take(ControlStatus("9pc", "", "", "", (AxisStatus("X", place, None, 0.0, "mm"),)))
    assert not recorder.is_recording
    ran(view, qtbot)
    (kept,) = view._workspace.path.parent.glob("*-X-*.csv")
    assert kept.read_text().startswith("time (s),position (mm),velocity (mm/min)\n")
    assert recorder.recording.signals["position"][:3].tolist() == [2.0, 2.5, 3.0]


def test_an_axis_that_the_control_does_not_show_ends_the_record(
    view: MotionView, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(StatusReadings, "start", lambda self: None)
    view.recorder.record.click()
    view.recorder.take(ControlStatus("9pc", "", "", "", (AxisStatus("Q", 1.0),)))
    assert view.recorder.state.text() == "The control shows no axis 1 X: Q"
    assert not view.recorder.is_recording


def test_a_record_is_read_where_nothing_can_be_simulated(
    view: MotionView, qtbot: QtBot, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    view._workspace.edit("Undo", {("servo.lead_screw_pitch", "1"): None})
    ran(view, qtbot)
    assert view.trace is None
    time = np.arange(0.0, 1.0, 0.002)
    path = tmp_path / "record.csv"
    rows = [f"{t!r},{900.0 * t!r}" for t in time.tolist()]
    path.write_text("\n".join(["time (s),velocity (mm/min)", *rows]))
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(path), ""))
    view.recorder.open.click()
    ran(view, qtbot)
    assert [(panel.title, panel.y.unit) for panel in view.plot.panels] == [("velocity", "mm/min")]
    assert "nothing is simulated" in view.recorder.state.text()
    form = view.recorder.trigger
    form.editors["signal"].setCurrentIndex(form.editors["signal"].findData("velocity"))
    form.editors["level"].setText("450")
    form.editors["before"].setText("0.1")
    form.entered.emit("level")
    ran(view, qtbot)
    (curve,) = view.plot.panels[0].curves
    assert (curve.x[0], curve.y[0]) == (pytest.approx(-0.1), pytest.approx(360.0))
    view.recorder.channels.item(0, 1).setText("250")
    view.recorder.channels.item(0, 2).setText("500")
    assert view.plot.panels[0].y.step == 250.0
    assert "B − A" in view.values.text()
