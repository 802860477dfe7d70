"""The printed report, written by a worker."""

import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtGui import QDesktopServices
from PySide6.QtPrintSupport import QPrinter, QPrintPreviewDialog
from PySide6.QtWidgets import QFileDialog

from amp_studio.report import PrintedFigure
from amp_studio.ui.dialogs.file_dialogs import ReportDialog
from amp_studio.ui.main_window import MainWindow

from .conftest import User, action


@pytest.fixture
def small(window_with: Callable[[bytes], MainWindow], router: bytes) -> MainWindow:
    """Return a window with the example that has the shortest report."""
    return window_with(router)


@pytest.mark.parametrize(
    ("ending", "begins"), [("pdf", b"%PDF"), ("html", b"<!"), ("csv", b""), ("txt", b"")]
)
def test_a_report_in_each_format(
    small: MainWindow, tmp_path: Path, accept, ending: str, begins: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    # neither the simulator nor Typst is loaded into the window: together they keep 250 MB
    monkeypatch.setattr("amp_studio.dossier.motion_figures", None)
    monkeypatch.setitem(sys.modules, "typst", None)
    drawn = PrintedFigure("Step, axis 1", "", ("Not simulated: no machine",))  # tests/test_dossier.py has it
    monkeypatch.setattr("amp_studio.dossier.motion_apart", lambda file: (drawn,))
    path = tmp_path / f"report.{ending}"
    accept(
        ReportDialog,
        lambda d: (d.form.set_answer("path", str(path)), d.form.set_answer("changed", ending == "pdf")),
    )

    action(small, "Report").trigger()

    assert path.read_bytes().startswith(begins)
    assert path.stat().st_size > 1000
    assert ending != "html" or "Not simulated: no machine" in path.read_text("utf-8")
    assert str(path) in small.statusBar().currentMessage()


def test_the_report_contains_what_is_edited_and_not_what_is_saved(
    window: MainWindow, tmp_path: Path, accept
) -> None:
    path = tmp_path / "report.csv"
    window.edits.commit(("servo.excess_error", "1"), "3.75 mm")
    accept(ReportDialog, lambda d: (d.form.set_answer("path", str(path)), d.form.set_answer("changed", True)))
    action(window, "Report").trigger()
    assert "3.75" in path.read_text(encoding="utf-8")


def test_an_unknown_ending_is_reported_and_nothing_is_written(
    window: MainWindow, tmp_path: Path, accept, user: User
) -> None:
    accept(ReportDialog, lambda d: d.form.set_answer("path", str(tmp_path / "report.doc")))
    action(window, "Report").trigger()
    assert "unknown report format" in user.reads()
    assert not (tmp_path / "report.doc").exists()


def test_the_report_is_opened_when_wanted(window: MainWindow, tmp_path: Path, accept, monkeypatch) -> None:
    opened = []
    monkeypatch.setattr(QDesktopServices, "openUrl", lambda url: opened.append(Path(url.toLocalFile())))
    path = tmp_path / "report.txt"
    accept(ReportDialog, lambda d: (d.form.set_answer("path", str(path)), d.form.set_answer("open", True)))
    action(window, "Report").trigger()
    assert opened == [path]


def test_browsing_gives_the_ending_that_was_chosen(window: MainWindow, tmp_path: Path, monkeypatch) -> None:
    dialog = ReportDialog(tmp_path / "mill.amp", window)
    assert dialog.form.answer("path") == str(tmp_path / "mill.pdf")
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "named"), "HTML (*.html)"))
    dialog.form.browse("path")
    assert dialog.form.answer("path") == str(tmp_path / "named.html")


def test_a_file_that_a_name_without_an_ending_means_is_replaced_only_when_asked(
    window: MainWindow, tmp_path: Path, monkeypatch, user: User
) -> None:
    dialog, taken = ReportDialog(tmp_path / "mill.amp", window), tmp_path / "named.html"
    taken.touch()
    monkeypatch.setattr(QFileDialog, "getSaveFileName", lambda *_: (str(tmp_path / "named"), "HTML (*.html)"))
    user.answers("Cancel")
    dialog.form.browse("path")
    assert dialog.form.answer("path") == str(tmp_path / "mill.pdf")
    user.answers("Replace")
    dialog.form.browse("path")
    assert user.asked == ["named.html already exists. Replace it?"] * 2
    assert dialog.form.answer("path") == str(taken)


@pytest.mark.parametrize("verb", ["Report", "Export"])
def test_what_a_written_file_could_not_keep_is_shown(
    window: MainWindow, tmp_path: Path, accept, user: User, verb: str
) -> None:
    path = tmp_path / "out.csv"
    path.write_bytes(b"old")
    (tmp_path / "other name").hardlink_to(path)
    if verb == "Report":
        accept(ReportDialog, lambda d: d.form.set_answer("path", str(path)))
    else:
        user.chooses(path)
        user.answers("Export")  # without the secrets
    action(window, verb).trigger()
    assert "1 other name of this file (a hard link) still has" in window.statusBar().currentMessage()
    assert (tmp_path / "other name").read_bytes() == b"old"


def test_a_report_is_shown_as_pages_and_goes_to_a_printer(
    small: MainWindow, tmp_path: Path, accept, monkeypatch: pytest.MonkeyPatch
) -> None:
    out, displayed = tmp_path / "printed.pdf", []

    def printed(preview: QPrintPreviewDialog) -> int:
        printer = preview.printer()
        printer.setOutputFormat(QPrinter.OutputFormat.PdfFormat)
        printer.setOutputFileName(str(out))
        displayed.append(preview.windowTitle())
        preview.paintRequested.emit(printer)
        return 1

    monkeypatch.setattr(QPrintPreviewDialog, "exec", printed)
    monkeypatch.setattr("amp_studio.ui.paper.printing.PPI", 40)
    monkeypatch.setattr("amp_studio.dossier.motion_apart", lambda file: ())  # test_preview.py has it
    accept(ReportDialog, lambda d: (d.form.set_answer("changed", True), setattr(d, "to_printer", True)))
    action(small, "Report").trigger()
    assert displayed == ["Report"]
    content = out.read_bytes()
    assert content.startswith(b"%PDF")
    assert content.count(b"/Type /Page\n") > 3
    assert not (tmp_path / "mill.pdf").exists()
