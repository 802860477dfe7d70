"""Secrets in the desktop program: masked wherever they would be seen, until a person asks for them."""

from pathlib import Path

import pytest
from PySide6.QtCore import Qt, QUrl
from PySide6.QtGui import QGuiApplication
from PySide6.QtWidgets import QLineEdit

from amp_studio.files import open_file
from amp_studio.schema import MASKED, Value
from amp_studio.ui.dialogs.file_dialogs import ReportDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.columns import A, B
from amp_studio.ui.merge.sources import MergeSource
from amp_studio.ui.table.quick_edit import QuickEdit

from .conftest import User, action

PASSWORD = ("password.character", "1")
SECRET = "7654321"


@pytest.fixture
def window(window: MainWindow) -> MainWindow:
    """Return the window with a figure in the password that is found nowhere else, and shown."""
    window.workspace.edit("Password", {PASSWORD: Value(int(SECRET))}, force="for a test")
    window.go_to(PASSWORD)
    return window


def texts_of_table(window: MainWindow) -> str:
    """Return everything that a view or a screen reader can ask the table about the password."""
    index = window.table.index_of(PASSWORD)
    roles = Qt.ItemDataRole
    asked = (
        roles.DisplayRole,
        roles.EditRole,
        roles.ToolTipRole,
        roles.StatusTipRole,
        roles.WhatsThisRole,
        roles.AccessibleTextRole,
        roles.AccessibleDescriptionRole,
    )
    return " ".join(str(index.data(role)) for role in asked)


def texts_of_detail(window: MainWindow) -> str:
    detail = window.detail
    detail.page.anchorClicked.emit(QUrl("fold:facts"))
    return " ".join((detail.value.text(), detail.bar.accessibleDescription(), detail.page.toHtml()))


def test_table_panel_findings_and_undo_mask_a_secret(window: MainWindow) -> None:
    window.workspace.edit("Password", {PASSWORD: Value(int(SECRET) + 1)}, force="for a test")
    window.workspace.remember_control({PASSWORD: Value(int(SECRET))}, "12:00")
    findings = window.findings.view.model()
    reported = [
        texts_of_table(window),
        texts_of_detail(window),
        window.menus["edit.undo"].text(),
        window.windowTitle(),
    ]
    reported += [
        str(findings.index(r, c).data(role))
        for r in range(findings.rowCount())
        for c in range(findings.columnCount())
        for role in (Qt.ItemDataRole.DisplayRole, Qt.ItemDataRole.ToolTipRole)
    ]
    assert not any("765432" in text for text in reported)
    assert MASKED in reported[0]
    assert MASKED in reported[1]


def test_a_secret_is_shown_while_that_is_wanted_and_masked_in_the_next_file(
    window: MainWindow, bare: bytes, tmp_path: Path
) -> None:
    action(window, "Show Secrets").trigger()
    assert SECRET in texts_of_table(window)
    assert SECRET in texts_of_detail(window)
    action(window, "Show Secrets").trigger()
    assert SECRET not in texts_of_table(window)

    action(window, "Show Secrets").trigger()
    window.workspace.save()
    (tmp_path / "next.amp").write_bytes(bare)
    window.files.open_path(tmp_path / "next.amp")
    assert not window.menus["view.secrets"].isChecked()
    assert window.table.shown_value(PASSWORD) == MASKED


def test_a_file_without_secrets_offers_nothing_to_show(window: MainWindow, tmp_path: Path) -> None:
    from amp_studio.files import content_of, new_file

    window.workspace.save()
    (tmp_path / "num.amp").write_bytes(content_of(new_file("num")))
    window.files.open_path(tmp_path / "num.amp")
    assert not window.menus["view.secrets"].isVisible()


def test_a_masked_secret_is_not_copied(window: MainWindow, user: User) -> None:
    QGuiApplication.clipboard().setText("before")
    action(window, "Copy").trigger()
    assert "is secret" in user.reads()
    assert QGuiApplication.clipboard().text() == "before"
    action(window, "Show Secrets").trigger()
    action(window, "Copy").trigger()
    assert QGuiApplication.clipboard().text() == SECRET


def test_a_masked_secret_is_typed_again_and_not_seen(window: MainWindow) -> None:
    view = window.table_view
    index = window.table.index_of(PASSWORD)
    view.setCurrentIndex(index)
    view.edit(index)
    editor = view.indexWidget(index)
    assert isinstance(editor, QLineEdit)
    assert (editor.text(), editor.echoMode()) == ("", QLineEdit.EchoMode.Password)
    assert view.finish()
    assert window.workspace.file.get(PASSWORD) == Value(int(SECRET)), "who types nothing changes nothing"
    view.edit(index)
    view.indexWidget(index).setText("66")
    assert view.finish()
    assert window.workspace.file.get(PASSWORD) == Value(66)


def test_quick_edit_does_not_show_a_secret(window: MainWindow) -> None:
    quick = QuickEdit(window.table, window.edits.commit, window.go_to, window)
    quick.number.setText("101")
    quick.look_up()
    assert isinstance(quick.editor, QLineEdit)
    assert (quick.editor.text(), quick.editor.echoMode()) == ("", QLineEdit.EchoMode.Password)
    quick.enter()
    assert window.workspace.file.get(PASSWORD) == Value(int(SECRET))


def test_a_comparison_shows_that_secrets_differ_and_not_how(window: MainWindow) -> None:
    other = window.workspace.file.copy()
    other.set(PASSWORD, Value(int(SECRET) + 1))
    displayed = window.files.comparing.open(window.page)
    displayed.use(B, MergeSource("other.amp", "", other))
    (row,) = displayed.merge.differing
    assert [displayed.model.text(row, column) for column in (A, B)] == [MASKED, MASKED]
    assert displayed.model.text_to_edit(row) == ""
    action(window, "Show Secrets").trigger()
    assert displayed.model.text(row, A) == SECRET
    action(window, "Show Secrets").trigger()
    assert displayed.model.text(row, A) == MASKED
    displayed.close()


def test_history_keeps_no_secret_and_unsaved_work_keeps_its_own(window: MainWindow) -> None:
    document = window.workspace.document
    document.unsaved_writer()()
    assert SECRET in document.journal_path.read_text("utf-8"), "work that was not saved is all there"
    window.workspace.save()
    assert SECRET not in document.history_path.read_text("utf-8")
    assert [(e.old, e.new) for e in document.history(PASSWORD)] == [(MASKED, MASKED)]
    with document.history_path.open("a", encoding="utf-8") as stream:  # as an older version wrote it
        stream.write(f'["2026-01-01", "me", "edit", "password.character@1", "", "{SECRET}"]\n')
    assert (document.history(PASSWORD)[0].old, document.history(PASSWORD)[0].new) == ("", MASKED)


def test_no_report_has_a_secret_and_an_export_only_where_it_is_asked_for(
    window: MainWindow, user: User, accept, tmp_path: Path
) -> None:
    for clear in (False, True):
        if clear:
            action(window, "Show Secrets").trigger()
        accept(ReportDialog, lambda d: d.form.set_answer("path", str(tmp_path / "r.csv")))
        action(window, "Report").trigger()
        assert SECRET not in (tmp_path / "r.csv").read_text("utf-8")
        user.chooses(tmp_path / "e.csv")
        user.answers(*([] if clear else ["Export"]))
        action(window, "Export").trigger()
        assert (SECRET in (tmp_path / "e.csv").read_text("utf-8")) is clear


def test_what_is_refused_is_not_repeated(window: MainWindow, user: User) -> None:
    assert not window.edits.commit(PASSWORD, f"x{SECRET}")
    assert SECRET not in user.reads()
    user.answers("Cancel")
    assert not window.edits.commit(PASSWORD, "9990001")
    assert "9990001" not in user.asked[-1]
    assert open_file(window.workspace.path).file.get(PASSWORD) != Value(int(SECRET))
