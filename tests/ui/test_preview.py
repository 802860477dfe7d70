"""The report beside the table: set again after an edit, turned to what is selected,
with the project's template.
"""

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QDesktopServices
from PySide6.QtPrintSupport import QPrintDialog, QPrinter
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QCheckBox
from pytestqt.qtbot import QtBot

from amp_studio.report import Contents, PrintedFigure
from amp_studio.schema import Address
from amp_studio.ui.dialogs.file_dialogs import ReportDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.paper import preview_panel
from amp_studio.ui.paper.preview_panel import PreviewPanel
from amp_studio.ui.window.report_options import ReportOptions
from amp_studio.ui.window.settings import UserSettings

from .conftest import WAIT_MS, User, action

TRAVEL, FIRST = ("axis.max_travel", "X"), ("general.junction_deviation", "")
"""The last and the first line of the values of the example router."""
VALUES = 4
"""The page with them."""
SHORT = Contents(changed_only=True, without=frozenset({"pictures", "motion", "exchanges"}))


@pytest.fixture
def path(tmp_path: Path, router: bytes) -> Path:
    """Return a copy of the example with the shortest report."""
    path = tmp_path / "router.amp"
    path.write_bytes(router)
    return path


@pytest.fixture(autouse=True)
def _quickly(monkeypatch: pytest.MonkeyPatch) -> None:
    """Set small pages at once."""
    monkeypatch.setattr(preview_panel, "WAIT_MS", 0)
    monkeypatch.setattr(preview_panel, "PPI", 24)
    monkeypatch.setattr(preview_panel, "SHARP_PPI", 24)


@pytest.fixture
def settled(qtbot: QtBot) -> Callable[[PreviewPanel], None]:
    """Return what waits until the pages are those of now."""

    def wait(panel: PreviewPanel) -> None:
        qtbot.waitUntil(lambda: panel.is_settled, timeout=WAIT_MS)

    return wait


@pytest.fixture
def panel(window: MainWindow, qtbot: QtBot, settled) -> PreviewPanel:
    """Return the preview of the example router, opened by its command."""
    window.report_options.contents = SHORT
    action(window, "Report Preview").trigger()
    qtbot.waitUntil(
        lambda: window.preview.panel is not None and bool(window.preview.panel.view.pages), timeout=WAIT_MS
    )
    assert window.preview.panel is not None
    settled(window.preview.panel)
    return window.preview.panel


def test_an_edit_sets_the_pages_again_and_the_reader_stays_where_he_was(
    window: MainWindow, panel: PreviewPanel, settled
) -> None:
    view = panel.view
    assert action(window, "Report Preview").isChecked()
    assert view.hasFocus()
    QTest.keyClick(view, Qt.Key.Key_Escape)
    assert window.table_view.hasFocus()
    panel.head.page.setText("3")
    QTest.keyClick(panel.head.page, Qt.Key.Key_Return)
    before, pages = view.verticalScrollBar().value(), view.pages
    assert view.spot().page == 2

    window.edits.commit(TRAVEL, "795 mm")
    settled(panel)

    assert view.pages[VALUES - 1] != pages[VALUES - 1]
    assert view.verticalScrollBar().value() == before
    assert panel.head.page.text() == "3"


def point_of(panel: PreviewPanel, address: Address) -> QPointF:
    """Return where a value is in the view."""
    view, place = panel.view, panel.view.places[address]
    line = view._band(place).translated(0, -view.verticalScrollBar().value())
    return QPointF(view._left(place.page - 1) + place.x * view._scale(place.page - 1) + 2, line.center().y())


def test_the_pages_turn_to_the_selected_value_or_its_absence_is_reported_and_a_click_goes_back(
    window: MainWindow, panel: PreviewPanel
) -> None:
    view = panel.view
    view.go_to_page(1)
    window.go_to(TRAVEL)
    assert view.viewport().rect().contains(point_of(panel, TRAVEL).toPoint())
    assert view.value_at(point_of(panel, TRAVEL)) == TRAVEL
    assert view.value_at(point_of(panel, FIRST) - QPointF(0, 60)) is None

    view.go_to_page(1)
    panel.set_follows(False)
    window.go_to(FIRST)
    assert view.spot().page == 0, "it turns only where that is wanted"
    panel.set_follows(True)
    assert view.viewport().rect().contains(point_of(panel, FIRST).toPoint())

    view.highlight(TRAVEL, scroll=True)
    QTest.mouseClick(view.viewport(), Qt.MouseButton.LeftButton, pos=point_of(panel, TRAVEL).toPoint())
    assert window.selected() == TRAVEL
    window.go_to(("general.arc_tolerance", ""))  # at its default, and only changed values are printed
    panel.go_to_selected()
    assert panel.bar.text.text() == "$12 Arc tolerance is not in this report."


def test_a_saved_template_is_shown_at_once_and_its_mistake_with_its_line(
    window: MainWindow, panel: PreviewPanel, qtbot: QtBot, monkeypatch: pytest.MonkeyPatch
) -> None:
    opened: list[Path] = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: opened.append(Path(url.toLocalFile())))
    standard = panel.view.pages
    action(window, "New Report Template").trigger()
    folder = window.workspace.path.parent / "templates"
    assert opened == [folder]
    qtbot.waitUntil(lambda: panel.view.pages != standard, timeout=WAIT_MS)
    assert panel.bar.isHidden()

    template = folder / "report.typ.j2"
    right = template.read_text("utf-8")
    template.write_text(right.replace("= Service", "= Service\n#mistaken"), "utf-8")
    qtbot.waitUntil(lambda: not panel.bar.isHidden(), timeout=WAIT_MS)
    line = next(n for n, text in enumerate(right.splitlines(), 1) if text == "= Service") + 1
    mistake = f"{Path('templates', 'report.typ.j2')}: line {line}: Typst: unknown variable: mistaken"
    assert panel.bar.text.text().startswith(mistake)
    assert len(panel.view.pages) == len(standard), "the standard report is shown meanwhile"
    panel.bar.buttons[0].click()
    assert opened == [folder, folder]

    template.write_text(right, "utf-8")
    qtbot.waitUntil(lambda: not panel._known[window.workspace].notes, timeout=WAIT_MS)
    assert panel.bar.isHidden()


def test_a_template_that_is_there_is_never_replaced(window: MainWindow, user: User) -> None:
    folder = window.workspace.path.parent / "templates"
    folder.mkdir()
    (folder / "report.typ.j2").write_text("mine")
    action(window, "New Report Template").trigger()
    assert "exists already: it is left as it is" in user.reads()
    assert (folder / "report.typ.j2").read_text() == "mine"


def test_the_contents_are_chosen_once_for_the_preview_and_the_dialog(
    window: MainWindow, panel: PreviewPanel, settled, accept, tmp_path: Path
) -> None:
    pages = len(panel.view.pages)
    panel.head.options.editor("signatures", QCheckBox).click()
    panel.head.options.set_answer("paper", "letter")
    settled(panel)
    assert len(panel.view.pages) == pages - 1
    assert panel.view._sizes[0] == pytest.approx((612, 792), abs=3)

    seen: list[Contents] = []

    def fill(dialog: ReportDialog) -> None:
        seen.append(dialog.contents())
        dialog.form.set_answer("language", "de")
        dialog.form.set_answer("path", str(tmp_path / "report.txt"))

    accept(ReportDialog, fill)
    action(window, "Report").trigger()
    assert (seen[0].paper, seen[0].changed_only) == ("letter", True)
    assert "signatures" in seen[0].without
    assert panel.head.options.answer("language") == "de"
    assert ReportOptions(UserSettings()).contents == window.report_options.contents


def test_a_stored_choice_that_is_none_is_left_out(qapp) -> None:
    settings = UserSettings()
    settings.keep_report(
        dict.fromkeys(("sort", "changed", "inactive", "units", "language", "without", "paper"), "?")
    )
    assert ReportOptions(settings).contents == Contents()


def test_the_preview_is_open_again_at_the_next_start_and_loaded_only_when_it_is_seen(
    open_window: Callable[..., MainWindow], path: Path, qtbot: QtBot
) -> None:
    window = open_window(path)
    assert window.preview.panel is None
    action(window, "Report Preview").trigger()
    window.close()
    again = open_window()
    assert again.preview.panel is None
    assert not again.docks.preview.isVisible()
    again.open_first(path)
    qtbot.waitUntil(lambda: again.preview.panel is not None, timeout=WAIT_MS)
    assert again.docks.preview.isVisible()
    action(again, "Reset Layout").trigger()
    assert not again.docks.preview.isVisible()
    assert not action(again, "Report Preview").isChecked()


def test_drawings_of_the_simulator_come_when_they_are_ready(
    window: MainWindow, panel: PreviewPanel, settled, monkeypatch: pytest.MonkeyPatch
) -> None:
    figure = PrintedFigure("Step, axis 1", "", ("Not simulated: no machine",))
    monkeypatch.setattr("amp_studio.dossier.motion_apart", lambda _file: (figure,))
    pages = [*panel.view.pages]
    window.report_options.contents = Contents(changed_only=True, without=SHORT.without - {"motion"})
    settled(panel)
    assert panel.view.pages != pages, "a short chapter shares the page of another"
    assert panel._known[window.workspace].motion == (figure,)


def test_what_is_seen_is_exported_and_printed(
    window: MainWindow, panel: PreviewPanel, user: User, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    user.chooses(tmp_path / "out.csv")
    window.preview.export()
    assert len((tmp_path / "out.csv").read_text("utf-8").splitlines()) == 33

    def prints(dialog: QPrintDialog) -> int:
        dialog.printer().setOutputFormat(QPrinter.OutputFormat.PdfFormat)
        dialog.printer().setOutputFileName(str(tmp_path / "printed.pdf"))
        return 1

    monkeypatch.setattr(QPrintDialog, "exec", prints)
    monkeypatch.setattr("amp_studio.ui.paper.printing.PPI", 24)
    window.preview.print()
    assert (tmp_path / "printed.pdf").read_bytes().startswith(b"%PDF")


def test_tables_to_fill_in_by_hand_are_written(window: MainWindow, tmp_path: Path, user: User) -> None:
    user.chooses(tmp_path / "form.html")
    action(window, "Form to Fill In").trigger()
    page = (tmp_path / "form.html").read_text("utf-8")
    assert "Maximum travel" in page
    assert "______ mm" in page
    assert str(tmp_path / "form.html") in window.statusBar().currentMessage()


def test_zoom_by_keys_keeps_the_page_and_the_table_its_room(window: MainWindow, panel: PreviewPanel) -> None:
    view = panel.view
    view.go_to_page(3)
    page, scale = view.spot().page, view.scale()
    QTest.keyClicks(view, "+")
    assert view.scale() == pytest.approx(scale * 1.2)
    assert view.spot().page == page
    QTest.keyClicks(view, "0")
    assert view.zoom is None
    QTest.keyClick(view, Qt.Key.Key_End)
    assert view.spot().page == len(view.pages) - 1
    assert view.accessibleDescription() == f"Page {len(view.pages)} of {len(view.pages)}"
    window.resize(1024, 700)
    assert window.table_view.width() > 400
    assert not window.docks._dock("Groups").isVisible()
    action(window, "Report Preview").trigger()
    assert window.docks._dock("Groups").isVisible()
    assert window.table_view.hasFocus()
