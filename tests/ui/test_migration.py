"""The window of a migration: questions, what is less safe, each parameter once, and what is written."""

from pathlib import Path

import pytest
from PySide6.QtGui import QFontMetrics
from PySide6.QtWidgets import QFileDialog
from pytestqt.qtbot import QtBot

from amp_studio.files import ParameterFile, open_file
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.translated import set_language
from amp_studio.ui.migration.rows import meanings
from amp_studio.ui.migration.window import MigrationWindow

PRESS = Path(__file__).parents[2] / "examples" / "57c422b-label-press" / "LABEL_PRESS.amp"
MILL = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"


@pytest.fixture
def followed() -> list[str]:
    return []


@pytest.fixture
def window(qtbot: QtBot, followed: list[str]) -> MigrationWindow:
    made = MigrationWindow(lambda: open_file(PRESS).file, PRESS, followed.append)
    qtbot.addWidget(made)
    made.target.set_answer("to", "linuxcnc")
    made.migrate()
    return made


def answer(window: MigrationWindow) -> None:
    """Answer all that LinuxCNC needs and the module does not know."""
    for letter in "XY":
        window.questions.set_answer(f"counts.{letter}", "1000")
        window.questions.set_answer(f"feedback.sign.{letter}", "+")
    window.migrate()


def rows(window: MigrationWindow) -> list[tuple[str, str, str]]:
    heads = [window.tree.topLevelItem(n) for n in range(window.tree.topLevelItemCount())]
    items = [head.child(n) for head in heads if head for n in range(head.childCount())]
    return [(item.text(0), item.text(1), item.text(2)) for item in items]


def test_each_parameter_is_listed_once_with_its_meaning_and_what_it_becomes(window: MigrationWindow) -> None:
    assert window.migration is not None
    assert len(rows(window)) == len(window.migration.entries) == 114
    assert any(
        "X" in meaning and new.startswith("[JOINT_0]MIN_LIMIT, [JOINT_0]MAX_LIMIT")
        for _, meaning, new in rows(window)
    ), rows(window)
    assert window.losses.text()


def test_the_old_values_are_read_whole_while_there_is_room(window: MigrationWindow) -> None:
    """They were cut at 360 pixels beside two empty columns."""
    tree = window.tree
    metrics = QFontMetrics(tree.font())
    longest = max(metrics.horizontalAdvance(old) for old, _, _ in rows(window))
    assert tree.columnWidth(0) >= min(460, longest)
    tree.setColumnWidth(0, 200)
    answer(window)
    assert tree.columnWidth(0) == 200, "what a person has made of it stays"


def test_nothing_but_a_draft_is_written_while_a_question_is_open(window: MigrationWindow) -> None:
    assert "4 questions open" in window.summary.text()
    assert (window.write_button.isEnabled(), window.draft_button.isEnabled()) == (False, True)
    window.questions.set_answer("feedback.sign.X", "left")
    window.migrate()
    assert "is no answer" in window.summary.text()
    assert (window.write_button.isEnabled(), window.draft_button.isEnabled()) == (False, False)
    answer(window)
    assert (window.write_button.isEnabled(), window.draft_button.isEnabled()) == (True, False)


def test_the_other_control_has_its_own_questions(window: MigrationWindow) -> None:
    answer(window)
    window.target.set_answer("to", "grblhal")
    window.migrate()
    assert {"steps.X", "steps.Y"} <= set(window.questions.editors)
    assert window.migration is not None
    assert window.migration.target == "grblhal"


def test_configuration_report_and_paper_go_into_a_new_folder(
    window: MigrationWindow, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, qtbot: QtBot
) -> None:
    folder = tmp_path / "retrofit"
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_, **__: (str(folder), ""))
    answer(window)
    window.write()
    qtbot.waitUntil(lambda: not Task.running)
    assert {"migration.pdf", "migration.txt", "machine.hal"} <= {path.name for path in folder.iterdir()}
    window.write()
    assert "there already" in window.bar.text.text()


def test_a_row_shows_why_and_leads_to_its_parameter(window: MigrationWindow, followed: list[str]) -> None:
    head = window.tree.topLevelItem(window.tree.topLevelItemCount() - 2)
    assert head is not None
    window.tree.setCurrentItem(head.child(0))
    row = window.tree.row()
    assert row is not None
    assert row.why
    assert row.why in window.why.text()
    window.tree.itemDoubleClicked.emit(head.child(0), 0)
    assert followed == [row.parameter]


def test_every_concept_of_a_machine_has_its_words() -> None:
    from amp_studio.meaning.description import OF_AXIS, OF_MACHINE

    assert set(meanings()) == {*OF_AXIS, *OF_MACHINE}


def test_two_axes_of_one_letter_are_asked_about_apart(qtbot: QtBot) -> None:
    """Both questions were called letter.X: one answer was given to both, which then clashed."""

    def both_x() -> ParameterFile:
        file = open_file(MILL).file
        file.set(("axis.name", "2"), file.get(("axis.name", "1")))
        return file

    window = MigrationWindow(both_x, MILL, lambda _: None)
    qtbot.addWidget(window)
    window.target.set_answer("to", "linuxcnc")
    window.migrate()
    assert window.migration is not None
    asked = [q.id for q in window.migration.written.asked]
    assert len(asked) == len(set(asked))
    assert {"letter.X1", "letter.X2"} <= set(asked)
    window.questions.set_answer("letter.X1", "Y")
    window.questions.set_answer("letter.X2", "U")
    window.migrate()
    assert window.migration.written.answered["letter.X1"] == "Y"
    assert window.migration.written.answered["letter.X2"] == "U"


def test_what_a_parameter_means_is_whole_on_a_large_screen_and_its_value_german(
    qtbot: QtBot, followed: list[str]
) -> None:
    set_language("de")
    try:
        made = MigrationWindow(lambda: open_file(MILL).file, MILL, followed.append)
        qtbot.addWidget(made)
        made.target.set_answer("to", "grblhal")
        made.migrate()
        made.resize(2560, 1440)
        made.show()
    finally:
        set_language("en")
    rows = [head.child(n) for head in made.tree._heads() for n in range(head.childCount())]
    old = {row.text(0) for row in rows}
    assert "1590 Lead Screw Thread Pitch: 12,7 mm" in old
    assert any(text.endswith(": −420 mm") for text in old)
    meaning = max((row.text(1) for row in rows), key=made.fontMetrics().horizontalAdvance)
    assert made.tree.columnWidth(1) > made.fontMetrics().horizontalAdvance(meaning)
