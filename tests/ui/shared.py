"""The window that the tests of a module share: what one of them did is taken back, and checked."""

import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QEvent, QObject, QSettings
from PySide6.QtWidgets import QApplication, QDialog

from amp_studio.files import Document
from amp_studio.schema import Address, Value
from amp_studio.ui.base.task import Task
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.page.file_page import FilePage


@dataclass(frozen=True)
class First:
    """What a window was when it was new, as far as a test can change it and still share it."""

    page: FilePage
    values: dict[Address, Value]
    header: dict[str, object]
    address: Address
    side: str
    docks: bytes


def first_of(window: MainWindow) -> First:
    """Return what a new window shows."""
    page = window.page_in_front
    address = page.table_view.address()
    assert address is not None
    return First(
        page,
        dict(page.workspace.file.values),
        _header(page),
        address,
        page.left.side,
        bytes(window.saveState().data()),
    )


def _header(page: FilePage) -> dict[str, object]:
    entries = vars(page.workspace.file.header)
    return {key: dict(entry) if isinstance(entry, dict) else entry for key, entry in entries.items()}


def put_back(window: MainWindow, first: First) -> None:
    """Take back what was done to the file, and show what a new window shows; fails where undo does not do
    it.
    """
    page, workspace = first.page, first.page.workspace
    page.table_view.finish()
    workspace.undo_stack.setIndex(0)
    workspace.undo_stack.clear()
    workspace._end_keeping()
    workspace._keep_unsaved()  # no change: it goes
    workspace._end_keeping()
    workspace._journal.stop()
    if (workspace.as_entered, workspace.file.header.units) != (False, first.header["units"]):
        workspace.show_in(str(first.header["units"]))
    workspace.shows_later = workspace.secrets = False
    _show_first(window, first)
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    QApplication.processEvents()
    now = (workspace.file.values, _header(page), workspace.file.forced)
    assert now == (first.values, first.header, {}), "a test that shares its window has changed the file"
    assert not workspace.is_dirty


def _show_first(window: MainWindow, first: First) -> None:
    """Show the list, the cell and the panels that a new window shows."""
    page = first.page
    page.uncover()
    page.show_pictures(False)
    page.filters.clear()
    page.show_columns(False, hidden_too=False)
    page.left.show_side(first.side)  # type: ignore[arg-type]  # as it was read
    page.select(first.address)
    page._follow_table()
    page.findings.withhold(page.workspace.is_deferred)
    page.findings.show_all()
    if bytes(window.saveState().data()) != first.docks:
        window.docks.reset()
        window.docks.fold(True)
    window.resize(1200, 640)
    page.table_view.setFocus()
    window.enable()


class Brush(QObject):
    """Paints a window when a test ends, and not after each of its steps: that took a quarter of the time."""

    def __init__(self, window: MainWindow) -> None:
        super().__init__(window)
        self._paints = False
        window.installEventFilter(self)

    def eventFilter(self, window: QObject, event: QEvent) -> bool:  # noqa: N802  # as Qt calls it
        return not self._paints and event.type() == QEvent.Type.UpdateRequest

    def paint(self) -> None:
        """Paint what has changed."""
        self._paints = True
        QApplication.sendEvent(self.parent(), QEvent(QEvent.Type.UpdateRequest))
        self._paints = False


class SharedWindow:
    """A window with one file, for test after test: each gets it as if it were new."""

    def __init__(self, path: Path, new_window: Callable[[Path], MainWindow]) -> None:
        self.path, self._new_window = path, new_window
        self._content = path.read_bytes()
        self._window: MainWindow | None = None
        self._first: First | None = None

    def get(self) -> MainWindow:
        """Return the window; a new one where there is none yet, or none that could be put back."""
        if self._window is None:
            QSettings("AMP Studio", "AMP Studio").clear()
            self._clean_folder()
            self._window = self._new_window(self.path)
            self._first = first_of(self._window)
        return self._window

    def put_back(self) -> None:
        """Make it as it was when it was new. A file that was saved, closed or shown on a page of motion is
        opened again in the same window; one that was closed, or has been at a control, is thrown away.
        """
        window, first, self._window = self._window, self._first, None
        if window is None or first is None:
            return
        if not window.isVisible() or window.control._page is not None or window.preview.panel is not None:
            close_windows([window])
            return
        try:
            paint_and_end(window)
            if self._is_taken_back_by_undo(window, first):
                put_back(window, first)
            else:
                first = self._open_again(window)
        except BaseException:
            close_windows([window])
            raise
        window.statusBar().clearMessage()
        QSettings("AMP Studio", "AMP Studio").clear()
        window.files.recent.remember(self.path)
        self._window, self._first = window, first

    def _is_taken_back_by_undo(self, window: MainWindow, first: First) -> bool:
        """Return whether the one file is still open and on disk as it was, and nothing else was made for
        it.
        """
        if window.tabs.pages() != [first.page] or first.page.pages or window.project is not None:
            return False
        taken_back = first.page.workspace.document.journal_path
        beside = {each for each in self.path.parent.iterdir() if each.suffix not in (".lock", ".holder")}
        return beside - {taken_back} == {self.path} and self.path.read_bytes() == self._content

    def _open_again(self, window: MainWindow) -> First:
        """Open the file as it was in the place of what is open."""
        window.docks.show_preview(False)
        first, *others = window.tabs.pages() or [None]
        for page in others:
            window.close_page(page)
        if first is not None:
            first.workspace.document.close()
        window.project = None
        vars(window).pop("report_options", None)
        self._clean_folder()
        QSettings("AMP Studio", "AMP Studio").clear()
        window.show_workspace(Workspace(Document.open(self.path)), first)
        QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
        _show_first(window, first_of(window))
        QApplication.processEvents()
        return first_of(window)

    def _clean_folder(self) -> None:
        for each in self.path.parent.iterdir():
            if each != self.path:
                shutil.rmtree(each) if each.is_dir() else each.unlink()
        self.path.write_bytes(self._content)

    def close(self) -> None:
        """Close the window."""
        if self._window is not None:
            close_windows([self._window])
            self._window = None


def paint_and_end(window: MainWindow) -> None:
    """Paint a window as the test has left it; end what is at work, and close what is beside it."""
    window.findChild(Brush).paint()
    ending = list(Task.running)
    Task.end_all()
    QApplication.processEvents()  # what they have found arrives while they are still there
    del ending
    for other in QApplication.topLevelWidgets():
        if not isinstance(other, MainWindow) and other.isVisible():
            other.close()
    for dialog in window.findChildren(QDialog):
        dialog.deleteLater()
    window.control.leave()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def close_windows(windows: list[MainWindow]) -> None:
    """Close windows, and throw unsaved work away."""
    for window in windows:
        window.findChild(Brush).paint()
        window.may_leave = lambda *_: True
        if window.is_leaving:
            Task.end_all()  # closed by its test: it gets no second event, while its timers went on
        window.close()
        window.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    assert not windows or not Task.running, [task._work for task in Task.running]
