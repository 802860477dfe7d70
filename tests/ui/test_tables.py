"""The manual's tables, to look things up."""

from PySide6.QtCore import QUrl

from amp_studio.ui.dialogs.tables_dialog import TablesDialog
from amp_studio.ui.main_window import MainWindow

from .conftest import action


def tables(window: MainWindow) -> TablesDialog:
    """Open the tables and return the dialog."""
    action(window, "Tables of the Manual").trigger()
    return window.findChild(TablesDialog)


def listed(dialog: TablesDialog) -> list[str]:
    """Return the titles that are listed."""
    return [dialog.list.item(n).text() for n in range(dialog.list.count())]


def test_the_tables_of_the_selected_parameter_come_first(window: MainWindow) -> None:
    window.go_to(("servo.motor_type", "1"))
    dialog = tables(window)
    known = window.workspace.file.schema.tables.values()
    own = [f"{t.title}  ({t.page})" for t in known if "servo.motor_type" in t.params]
    assert own
    assert listed(dialog)[: len(own)] == own
    assert len(listed(dialog)) == len(known)
    assert own[0].partition("  (")[0] in dialog.page.toPlainText()


def test_a_word_of_a_cell_finds_its_table_and_a_link_leads_to_the_parameter(window: MainWindow) -> None:
    dialog = tables(window)
    dialog.search.setText("b740c")
    assert 0 < len(listed(dialog)) < len(window.workspace.file.schema.tables)
    assert "B740C" in dialog.page.toPlainText()
    dialog.page.anchorClicked.emit(QUrl("param:servo.motor_type"))
    assert window.selected() is not None
    assert window.selected()[0] == "servo.motor_type"


def test_what_no_table_has_is_shown(window: MainWindow) -> None:
    dialog = tables(window)
    dialog.search.setText("no such thing")
    assert (listed(dialog), dialog.page.toPlainText()) == ([], "No table contains these words.")
