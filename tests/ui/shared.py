"""The window that the tests of a module share: what one of them did is taken back, and checked."""

from __future__ import annotations

from dataclasses import dataclass

from PySide6.QtCore import QEvent, QSettings
from PySide6.QtWidgets import QApplication, QDialog

from amp_studio.schema import Address, Value
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
    """Make a window as it was when it was new; fails where a test did what cannot be taken back so."""
    page, workspace = first.page, first.page.workspace
    assert window.isVisible(), "a test that shares its window has closed it"
    assert window.tabs.pages() == [page], "a test that shares its window has opened or closed a file"
    for other in QApplication.topLevelWidgets():
        if other is not window and other.isVisible():
            other.close()
    for dialog in window.findChildren(QDialog):
        dialog.deleteLater()
    page.table_view.finish()
    window.control.leave()
    workspace.undo_stack.setIndex(0)
    workspace.undo_stack.clear()
    workspace._keep_unsaved()  # no change: it goes
    workspace._journal.stop()
    if (workspace.as_entered, workspace.file.header.units) != (False, first.header["units"]):
        workspace.show_in(str(first.header["units"]))
    workspace.shows_later = workspace.secrets = False
    _show_first(window, first)
    window.statusBar().clearMessage()
    QSettings("AMP Studio", "AMP Studio").clear()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    QApplication.processEvents()
    now = (workspace.file.values, _header(page), workspace.file.forced)
    assert now == (first.values, first.header, {}), "a test that shares its window has changed the file"
    assert not workspace.is_dirty
    left = {place.suffix for place in workspace.path.parent.iterdir()} - {".amp", ".lock", ".holder"}
    assert not left, f"a test that shares its window has left {left} beside its file"


def _show_first(window: MainWindow, first: First) -> None:
    """Show the list, the cell and the panels that a new window shows."""
    page = first.page
    page.uncover()
    page.show_pictures(False)
    page.filters.clear()
    page.show_columns(False, hidden_too=False)
    page.left.show_side(first.side)  # type: ignore[arg-type]  # as it was read
    page.select(first.address)
    page.findings.show_all()
    if bytes(window.saveState().data()) != first.docks:
        window.docks.reset()
        window.docks.fold(True)
    window.resize(1200, 640)
    page.table_view.setFocus()
    window.enable()
