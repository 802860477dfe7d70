"""The recorder of Live: triggers, what came before them, the simulation under the record, and exports."""

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from amp_studio.sim import read_recording, simulate
from amp_studio.transfer import AxisStatus
from amp_studio.ui.live.record_picture import move_of
from amp_studio.ui.live.recorder import LiveRecording
from amp_studio.ui.main_window import MainWindow

from .conftest import WAIT_MS


@pytest.fixture
def recorder(window_with: Callable[..., MainWindow], qtbot: QtBot) -> LiveRecording:
    """Return the recorder of axis X of the example press."""
    workspace = window_with("57c422b-label-press").workspace_in_front
    made = LiveRecording(workspace, lambda: workspace.file)
    qtbot.addWidget(made)
    made.resize(900, 400)
    made.show_axis("X")
    return made


def give(
    recorder: LiveRecording, places: Sequence[float], *, begin: float = 0.0, error: float = 0.0
) -> float:
    """Give readings five times a second; returns the time after them."""
    for n, place in enumerate(places):
        recorder.take(begin + 0.2 * n, AxisStatus("X", place, error, None, "counts"))
    return begin + 0.2 * len(places)


def choose(recorder: LiveRecording, trigger: str, level: str = "") -> None:
    recorder.trigger.setCurrentIndex(recorder.trigger.findData(trigger))
    recorder.level.setText(level)


def test_readings_are_drawn_as_dots_before_anything_is_recorded(recorder: LiveRecording) -> None:
    give(recorder, [0.0, 1.0, 2.0])
    picture = recorder.plot.picture
    assert picture is not None
    assert all(curve.dots for panel in picture.panels for curve in panel.curves)
    assert "Velocity: not shown by this control" in recorder.footer.text()


def test_what_a_control_cannot_show_is_named_with_its_reason(recorder: LiveRecording) -> None:
    why = {"velocity": "its report has the feed of the path, not the speed of an axis"}
    recorder.take(0.0, AxisStatus("X", 0.0, 0.0, None, "counts"), reasons=why)
    assert "not shown by this control: its report has the feed of the path" in recorder.footer.text()


def test_a_record_waits_until_the_axis_moves_and_keeps_what_came_before(recorder: LiveRecording) -> None:
    choose(recorder, "move")
    recorder.start_or_stop()
    now = give(recorder, [5.0] * 12)
    assert recorder.state.text() == "waits: the axis moves"
    give(recorder, [5.0, 9.0, 20.0, 20.0], begin=now)
    assert recorder.state.text() == "6 readings"
    recorder.start_or_stop()
    assert recorder.record is not None
    assert recorder.record.signals["position"].tolist() == [5.0, 5.0, 5.0, 9.0, 20.0, 20.0]
    assert recorder._fired == pytest.approx(0.6)


def test_an_error_of_either_sign_above_the_level_fires(recorder: LiveRecording) -> None:
    choose(recorder, "error", "20")
    recorder.start_or_stop()
    now = give(recorder, [0.0] * 3, error=-20.0)
    assert recorder.state.text() == "waits: error above 20"
    give(recorder, [0.0] * 2, begin=now, error=-21.0)
    assert recorder.state.text().endswith("readings")


def test_a_fault_ends_a_record_half_a_second_later(recorder: LiveRecording) -> None:
    recorder.start_or_stop()
    now = give(recorder, [0.0, 1.0, 2.0])
    recorder.take(now, AxisStatus("X", 3.0, 0.0, None, "counts"), is_fault=True)
    give(recorder, [3.0, 3.0], begin=now + 0.2)
    assert recorder.is_recording
    give(recorder, [3.0], begin=now + 0.6)
    assert not recorder.is_recording
    assert recorder.record is not None
    assert recorder.record.signals["position"].tolist() == [0.0, 1.0, 2.0, 3.0, 3.0, 3.0, 3.0]


def test_the_recorded_move_is_simulated_under_the_record_and_shifted_to_fit(
    recorder: LiveRecording, qtbot: QtBot
) -> None:
    file = recorder._workspace.file
    trace = simulate(file, "step", "X", {"move.distance": 30_000.0, "move.feedrate": 300_000.0})
    time = np.arange(0.0, 9.0, 0.2)
    columns = [
        np.interp(time - 1.3, trace.columns["time_s"], trace.columns[n]) for n in ("position", "velocity")
    ]
    recorder.start_or_stop()
    for at, place, speed in zip(time, *columns, strict=True):
        recorder.take(at, AxisStatus("X", 7.0 + place, None, speed / 60.0, "counts"))
    recorder.start_or_stop()
    qtbot.waitUntil(lambda: recorder.trace is not None, timeout=WAIT_MS)
    assert "simulated: 30\u202f000 counts at " in recorder.footer.text()
    # The peak of the readings is the feed: the axis ripples around it, and 1 % of the way is left.
    assert recorder.trace.result["record_lag"][0] == pytest.approx(1.3, abs=0.1)
    assert recorder.trace.result["difference_rms_position"][0] < 300.0
    names = [curve.name for curve in recorder.plot.panels[0].curves]
    assert names == ["simulated", "machine"]


def test_an_axis_that_did_not_move_is_not_simulated(recorder: LiveRecording) -> None:
    recorder.start_or_stop()
    give(recorder, [4.0] * 4)
    recorder.start_or_stop()
    assert "The axis did not move" in recorder.footer.text()
    assert recorder.trace is None


def test_a_record_is_exported_and_laid_over_again(
    recorder: LiveRecording, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    recorder.start_or_stop()
    give(recorder, list(np.arange(0.0, 50.0, 2.0)))
    recorder.start_or_stop()
    for ending, act in (("csv", recorder.to_csv), ("svg", recorder.to_svg)):
        there = str(tmp_path / f"record.{ending}")
        monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_, there=there: (there, ""))
        act.trigger()
    kept = read_recording(tmp_path / "record.csv")
    assert kept.signals["position"][:3].tolist() == [0.0, 2.0, 4.0]
    assert (tmp_path / "record.svg").read_text("utf-8").startswith("<svg")
    recorder.show_axis("Y")
    assert recorder.record is None
    monkeypatch.setattr(QFileDialog, "getOpenFileName", lambda *_: (str(tmp_path / "record.csv"), ""))
    recorder.open.click()
    assert recorder.record is not None


def test_a_move_in_inches_is_simulated_in_the_units_of_the_file(recorder: LiveRecording) -> None:
    file = recorder._workspace.file
    recorder.start_or_stop()
    give(recorder, [0.0, 1.0, 2.0])
    recorder.start_or_stop()
    assert recorder.record is not None
    _, settings, _ = move_of(file, recorder.record)
    assert settings == {"move.distance": 2.0, "move.feedrate": pytest.approx(300.0)}


def test_the_title_of_a_signal_has_its_scale_which_can_be_chosen_with_its_middle(
    recorder: LiveRecording,
) -> None:
    """A signal had a scale that followed it, which no title named, and two of three signals were drawn."""
    for n, place in enumerate((100.0, 130.0, 160.0)):
        recorder.take(0.2 * n, AxisStatus("X", place, 3.0, 150.0, "counts"))
    give(recorder, [160.0], begin=0.6)
    assert [(each.title, each.subtitle) for each in recorder.plot.panels] == [
        ("following error", "0.5 counts per division"),
        ("velocity", "50 counts/s per division"),
    ]
    table = recorder.channels
    assert table.isHidden()
    recorder.scales.click()
    assert not table.isHidden()
    table.item(1, 0).setCheckState(Qt.CheckState.Checked)
    table.item(1, 1).setText("25")
    table.item(1, 2).setText("150")
    place = recorder.plot.panels[1]
    assert (place.title, place.subtitle) == ("position", "25 counts per division")
    assert (place.y.low, place.y.high) == (50.0, 250.0)
    table.item(0, 0).setCheckState(Qt.CheckState.Unchecked)
    assert [each.title for each in recorder.plot.panels] == ["position", "velocity"]
