"""The printed ways of tuning as steps in the page Tuning: what is changed, what the simulated axis shows, what
is proposed.
"""

from __future__ import annotations

from collections.abc import Mapping

import pytest
from PySide6.QtWidgets import QToolButton
from pytestqt.qtbot import QtBot

from amp_studio.files import ParameterFile
from amp_studio.schema import load_schema, registered_families
from amp_studio.sim import Recommendation, Trace, law_of, simulate
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.motion import tuning_steps
from amp_studio.ui.motion.tuning_page import TuningView
from amp_studio.ui.motion.tuning_steps import TuningSteps
from tests.ui.conftest import WAIT_MS

GAIN = ("servo.velocity_proportional_gain", "1")
RAISED = 3
"""The step at which that gain is raised (page A-9)."""


@pytest.fixture
def guided(workspace: Workspace, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch) -> TuningSteps:
    """Return appendix A; its gains are not sought here, which takes seconds."""

    def quick(file: ParameterFile, scenario: str, axis: str, settings: Mapping[str, float]) -> Trace:
        if scenario == "tune":
            raise ValueError("not sought")
        return simulate(file, scenario, axis, {**settings, "move.duration": 0.05}, advise=False)

    monkeypatch.setattr(tuning_steps, "_simulated", quick)
    page = TuningView(workspace, lambda: None)
    qtbot.addWidget(page)
    page.show()
    page.pages.setCurrentRow(page.pages.count() - 1)
    (steps,) = page.guided
    steps.steps.setCurrentRow(RAISED)
    qtbot.waitUntil(lambda: steps.now is not None and not steps._tasks, timeout=WAIT_MS)
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


def test_a_value_that_is_no_number_is_refused_and_the_old_one_is_back(
    guided: TuningSteps, workspace: Workspace
) -> None:
    guided.detail.fields[GAIN].setText("abc")
    guided.detail.fields[GAIN].editingFinished.emit()
    assert guided.detail.fields[GAIN].text() == "6000"
    assert not workspace.undo_stack.canUndo()


def test_done_ticks_a_step_and_changes_no_value_and_proposals_are_one_step_of_undo(
    guided: TuningSteps, workspace: Workspace
) -> None:
    guided.next.click()
    assert (guided.steps.currentRow(), guided._done) == (RAISED + 1, {RAISED})
    assert not workspace.undo_stack.canUndo()
    guided.back.click()
    assert guided._done == set()
    guided._apply(
        [
            Recommendation(GAIN[0], 2996.0, "", "why", "price"),
            Recommendation("servo.initial_gain", 0.757, "", "why", "price"),
        ]
    )
    assert workspace.file.get(GAIN).value == 2996
    assert workspace.undo_stack.count() == 1


def test_what_the_steps_of_a_family_show_are_scenarios_that_it_has() -> None:
    families = set()
    for family in registered_families():
        schema = load_schema(family)
        for step in (step for guide in schema.guides for step in guide.steps if step.shows):
            law = law_of(family)
            assert step.shows.scenario in (*law.motion.scenarios, *law.own()), step.title
            families.add(family)
    assert families == {"9pc", "num", "syntec", "57c422b", "acromill"}
