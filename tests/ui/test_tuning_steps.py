"""The printed ways of tuning as steps in the page Tuning: what is changed, what the simulated axis shows,
what is proposed.
"""

from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QComboBox, QToolButton
from pytestqt.qtbot import QtBot

from amp_studio.calibration import steps_of
from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import Address, Value, load_schema, registered_families
from amp_studio.sim import Recommendation, SimulationError, Trace, law_of, read_tunings, simulate
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.motion import tuning_steps
from amp_studio.ui.motion.tuning_page import TuningView
from amp_studio.ui.motion.tuning_steps import TuningSteps
from amp_studio.ui.motion.tuning_target import TuningTarget
from tests.ui.conftest import WAIT_MS

EXAMPLES = Path(__file__).parents[2] / "examples"
GAIN = ("servo.velocity_proportional_gain", "1")
RAISED = 3
"""The step at which that gain is raised (page A-9)."""


class WithFile(TuningTarget):
    """A target that sets values of a file alone."""

    def __init__(self, file: ParameterFile) -> None:
        super().__init__()
        self._file, self.changes = file, list[list[Address]]()

    @property
    def file(self) -> ParameterFile:
        return self._file

    @property
    def may_edit(self) -> bool:
        return True

    def set(self, text: str, values: Mapping[Address, Value | None]) -> None:
        self.changes.append(list(values))
        for address, value in values.items():
            self._file.set(address, value)


@pytest.fixture
def guided(workspace: Workspace, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> TuningSteps:
    """Return appendix A; its gains are not sought here, which takes seconds."""

    def quick(
        file: ParameterFile, scenario: str, axis: str, settings: Mapping[str, float]
    ) -> Trace | SimulationError:
        if scenario == "tune":
            return SimulationError("not sought")
        return simulate(file, scenario, axis, {**settings, "move.duration": 0.05}, advise=False)

    monkeypatch.setattr(tuning_steps, "_simulated", quick)
    page = TuningView(workspace, lambda: None)
    qtbot.addWidget(page)
    page.show()
    page.pages.setCurrentRow(page.pages.count() - 1)
    (steps,) = page.guided
    steps.steps.setCurrentRow(RAISED)
    qtbot.waitUntil(
        lambda: steps.now is not None and not any(work.is_busy for work in steps._work.values()),
        timeout=WAIT_MS,
    )
    return steps


def test_a_step_changes_its_value_and_shows_what_the_axis_does_now_and_did(
    guided: TuningSteps, workspace: Workspace, qtbot: QtBot
) -> None:
    assert guided.detail.change.text().startswith("Up while the curve is overdamped")
    assert guided.detail.look.text().startswith("The velocity just overshoots its command")
    assert list(guided.detail.fields) == [GAIN]
    more = next(
        b for b in guided.detail.findChildren(QToolButton) if b.accessibleName().startswith("One step more")
    )
    more.click()
    assert workspace.file.get(GAIN).value == 6010
    qtbot.waitUntil(lambda: ", was " in guided.detail.shows.text(), timeout=WAIT_MS)
    workspace.undo_stack.undo()
    assert guided.detail.fields[GAIN].text() == "6000"


def test_a_step_has_every_value_that_it_names_of_this_machine(guided: TuningSteps) -> None:
    """Those of no axis had no line: a DAC monitor, a group of axes, a spindle."""
    guided.steps.setCurrentRow(0)
    assert list(guided.detail.fields) == [("patch.dac_monitor", "2"), ("patch.dac_monitor", "3")]
    file, detail = open_file(EXAMPLES / "num-1060-mill/MILL_1060.amp").file, guided.detail
    guide = next(each for each in file.schema.guides if each.id == "procedures")
    tapping = next(step for step in guide.steps if step.page == "8-35")
    detail.show_step(WithFile(file), tapping, "0")
    labels = [file.machine_schema.short(address) for address in detail.fields]
    assert labels == ["P63N0", "P63N1", "P63N2", "P62N0", "P62N1"]


def test_why_nothing_is_tuned_has_the_letter_of_the_axis(guided: TuningSteps) -> None:
    guided._failed("tune", ValueError("The position loop of axis 1 is open: there is nothing to tune"))
    assert guided.figures.text() == "The position loop of axis X is open: there is nothing to tune"


def test_a_choice_is_chosen_and_a_mask_is_typed(guided: TuningSteps) -> None:
    """Both had a − and a + that ended in an internal error."""
    for example, axis, page, count in (("syntec-mill", "1", 0, 3), ("num-1060-mill", "0", 0, 0)):
        file = open_file(next((EXAMPLES / example).glob("*.amp"))).file
        guide = next(each for each in file.schema.guides if any(step.shows for step in each.steps))
        target = WithFile(file)
        guided.detail.show_step(target, guide.steps[page], axis)
        fields = guided.detail.fields
        chosen = {address: field for address, field in fields.items() if isinstance(field, QComboBox)}
        assert len(chosen) == count
        names = [each.accessibleName() for each in guided.detail.findChildren(QToolButton)]
        for address in fields:
            label = file.machine_schema.label(address)
            stepped = [name for name in names if name.endswith(f": {label}")]
            assert bool(stepped) == bool(steps_of(file, address)), label
        for address, field in chosen.items():
            field.textActivated.emit(field.itemText(field.count() - 1))
            assert field.currentText() == field.itemText(field.count() - 1)
            assert target.changes[-1] == [address]


def test_a_value_that_is_no_number_is_refused_and_the_old_one_is_back(
    guided: TuningSteps, workspace: Workspace
) -> None:
    guided.detail.fields[GAIN].setText("abc")
    guided.detail.fields[GAIN].editingFinished.emit()
    assert guided.detail.fields[GAIN].text() == "6000"
    assert not workspace.undo_stack.canUndo()


def test_done_ticks_a_step_in_the_file_and_changes_no_value(
    guided: TuningSteps, workspace: Workspace
) -> None:
    before, done = dict(workspace.file.values), workspace.file.header
    guided.next.click()
    assert guided.steps.currentRow() == RAISED + 1
    (key,) = done.done
    assert key == f"tuning-{RAISED + 1}@1"
    assert done.done[key] in guided.steps.item(RAISED).toolTip()
    assert workspace.file.values == before
    guided.back.click()
    assert not workspace.file.header.done
    guided.next.click()
    workspace.undo_stack.undo()
    assert not workspace.file.header.done


def test_ticks_are_there_again_and_of_one_axis(
    guided: TuningSteps, workspace: Workspace, qtbot: QtBot
) -> None:
    guided.next.click()
    again = TuningSteps(guided.guide, workspace, lambda work: work())
    qtbot.addWidget(again)
    again.show_target(guided._target)
    assert " by " in again.steps.item(RAISED).toolTip()
    again.axis.setCurrentIndex(again.axis.findData("2"))
    assert " by " not in again.steps.item(RAISED).toolTip()


def test_proposals_are_one_step_of_undo_and_go_into_the_record(
    guided: TuningSteps, workspace: Workspace, monkeypatch: pytest.MonkeyPatch
) -> None:
    found = (
        Recommendation(GAIN[0], 2996.0, "", "why", "price"),
        Recommendation("servo.initial_gain", 0.757, "", "why", "price"),
    )
    result = {"Ms": (1.3, ""), "Ms_before": (2.8, "")}
    guided.tuned = replace(guided.now, scenario="tune", recommendations=found, result=result)
    guided._apply(found[:1])
    assert read_tunings(workspace.path) == []  # with one of two the loop is neither that of before nor after
    guided._apply(found)
    assert workspace.file.get(GAIN).value == 2996
    assert workspace.undo_stack.count() == 2
    (entry,) = read_tunings(workspace.path)
    assert entry.gains[1][1:] == ("Initial Gain of Position Loop", "1", "0.757")
    assert entry.figures == (("Ms", 2.8, 1.3, ""),)


MAP = ("servo.initial_gain", GAIN[0])


@pytest.fixture
def mapped(guided: TuningSteps) -> Trace:
    """Show a map of three by three gains, and return it."""
    grid = np.array([(one, two) for one in (0.5, 1.0, 1.5) for two in (2000.0, 4000.0, 6000.4)])
    columns = {MAP[0]: grid[:, 0], MAP[1]: grid[:, 1], "Ms": np.linspace(1.2, 2.0, 9), "safe": np.ones(9)}
    columns["stiffness"] = np.arange(9.0)
    units, present = dict.fromkeys(columns, ""), {MAP[0]: (1.0, ""), MAP[1]: (6000.0, "")}
    trace = Trace("sweep", "1", "", columns, units, {}, (), (), (), present, over=MAP, figure="stiffness")
    guided._charted("sweep")
    guided._mapped(trace)
    guided.below.grab()  # what is not painted has no place
    return trace


def place_on(guided: TuningSteps, point: tuple[float, float]) -> QPoint:
    return QPoint(*map(round, guided.below._map.at(point)))


def proposed(guided: TuningSteps) -> list[float]:
    """Return the gains that would be applied."""
    found: list[float] = []
    guided._apply = lambda gains: found.extend(each.value for each in gains)
    guided.proposed._apply = guided._apply
    guided.proposed.buttons[2].click()
    return found


def test_a_click_in_the_map_proposes_its_gains(
    guided: TuningSteps, mapped: Trace, workspace: Workspace
) -> None:
    QTest.mouseClick(guided.below, Qt.MouseButton.LeftButton, pos=place_on(guided, (1.45, 4100.0)))
    assert [each.text() for each in guided.proposed.buttons] == ["Apply", "Apply", "Apply All 2"]
    guided.proposed.buttons[2].click()
    assert (workspace.file.get((MAP[0], "1")).value, workspace.file.get(GAIN).value) == (1.5, 4000)
    assert workspace.undo_stack.count() == 1
    assert "1.9" in guided.figures.text()
    other = Recommendation("servo.velocity_integral_gain", 92.0, "", "why", "price")
    guided.tuned = replace(
        guided.now, scenario="tune", recommendations=(other,), result={"Ms_before": (2.8, "")}
    )
    guided.mapped = replace(mapped, assumptions=("With the other gains as they are none is safe: here x.",))
    guided._pointed(0.5, 2000.0)
    assert len(guided.proposed.buttons) == 4  # the map is of an axis with that gain too
    assert "2.8" in guided.figures.text()


def test_the_proposed_point_of_the_map_is_dragged_and_moved_by_the_arrow_keys(
    guided: TuningSteps, mapped: Trace
) -> None:
    QTest.mousePress(guided.below, Qt.MouseButton.LeftButton, pos=place_on(guided, (1.0, 2000.0)))
    assert proposed(guided) == [1.0, 2000.0]
    QTest.mouseMove(guided.below, place_on(guided, (1.5, 4000.0)) + QPoint(500, 0))  # beyond its edge
    assert proposed(guided) == [1.5, 4000.0]
    QTest.mouseRelease(guided.below, Qt.MouseButton.LeftButton)
    for key, there in (
        (Qt.Key.Key_Up, [1.5, 6000.0]),
        (Qt.Key.Key_Left, [1.0, 6000.0]),
        (Qt.Key.Key_Right, [1.5, 6000.0]),
        (Qt.Key.Key_Down, [1.5, 4000.0]),
    ):
        QTest.keyClick(guided.below, key)
        assert proposed(guided) == there
    guided._mapped(mapped)  # another map: the keys begin at the present gains
    QTest.keyClick(guided.below, Qt.Key.Key_Down)
    assert proposed(guided) == [1.0, 4000.0]


def test_what_the_steps_of_a_family_show_are_scenarios_that_it_has() -> None:
    families = set()
    for family in registered_families():
        schema = load_schema(family)
        for step in (step for guide in schema.guides for step in guide.steps if step.shows):
            law = law_of(family)
            assert step.shows.scenario in (*law.motion.scenarios, *law.own()), step.title
            families.add(family)
    assert families == {"9pc", "num", "syntec", "57c422b", "acromill"}


def test_what_is_proposed_is_taken_into_the_file_and_sent_alone(
    guided: TuningSteps, workspace: Workspace, qtbot: QtBot
) -> None:
    guided._propose((Recommendation(GAIN[0], 2100.0, "", "calm"),), "")
    assert guided.send.isVisible()
    with qtbot.waitSignal(guided.send_requested) as wanted:
        guided.send.click()
    assert wanted.args == [[GAIN]]
    assert workspace.file.get(GAIN).value == 2100
    guided._propose((), "")
    assert not guided.send.isVisible(), "nothing is proposed"
