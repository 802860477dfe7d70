"""The window as its parts see it: the open files, the panels, and what a menu action can ask for.

What actions do and the watch of the disk take this class; ``MainWindow`` is one and has its parts. So nothing
that is part of the window imports it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, cast

from PySide6.QtCore import Qt, Signal
from PySide6.QtGui import QAction, QGuiApplication
from PySide6.QtWidgets import QApplication, QMainWindow, QWidget

from amp_studio.files import ChangedOnDiskError, Project, same_file
from amp_studio.schema import Address, isolated
from amp_studio.ui.base.garbage import collect_soon
from amp_studio.ui.base.questions import ask, show_message
from amp_studio.ui.base.side_windows import SideWindows
from amp_studio.ui.base.single_shot import single_shot
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import message_in_words
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.findings.panel import FindingsPanel
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.page.file_summaries import FileSummaries
from amp_studio.ui.page.group_list import GroupList
from amp_studio.ui.table.detail_panel import DetailPanel
from amp_studio.ui.table.parameter_table import ParameterTable
from amp_studio.ui.table.value_table import ValueTable

from .docks import Docks
from .file_tabs import FileTabs
from .settings import UserSettings

if TYPE_CHECKING:
    from .report_options import ReportOptions

_NEXT_DIALOG_MS = 100
"""Milliseconds in which another dialog may follow one that has closed, and takes the keyboard itself."""


class StudioWindow(QMainWindow):
    """The open files in tabs, their panels and the actions.
    What is asked for without naming a file means the one in front.
    """

    project_changed = Signal()
    """Another project is open, or its information has changed."""
    menus: Mapping[str, QAction]
    """The actions by their keys; the main window makes them of their table."""
    open_path: Callable[[Path], None]
    """Opens a parameter file in a tab, or comes back to its tab."""

    def __init__(self) -> None:
        super().__init__()
        self._project: Project | None = None
        self.is_leaving = False
        """Whether the whole window closes: what its files leave is no longer checked."""
        self.tabs = FileTabs()
        self.beside = SideWindows()
        self.summaries = FileSummaries(self)
        self.settings = UserSettings()
        self.docks = Docks(self, self.settings)
        self._take_keyboard = single_shot(self, self._take_keyboard_back, _NEXT_DIALOG_MS)
        cast("QApplication", QApplication.instance()).focusChanged.connect(self._follow_keyboard)

    @cached_property
    def report_options(self) -> ReportOptions:
        """What reports contain; loaded when the first is asked for."""
        from .report_options import ReportOptions

        return ReportOptions(self.settings, self)

    # -- the keyboard ------------------------------------------------------------

    def _follow_keyboard(self, before: QWidget | None, now: QWidget | None) -> None:
        """Wait for the keyboard where a dialog of this window has lost it; other windows have their own."""
        if now is not None:
            self._take_keyboard.stop()
        elif before is not None and before.window() is not self and self._is_above(before.window()):
            self._take_keyboard.start()

    def _is_above(self, dialog: QWidget | None) -> bool:
        while dialog is not None and dialog is not self:
            dialog = dialog.parentWidget()
        return dialog is self

    def _take_keyboard_back(self) -> None:
        """Take the keyboard from a dialog that has closed: without a window manager it is not given back."""
        is_nowhere = QApplication.activeWindow() is None
        # Another program that has it makes this one inactive: from that nothing is taken.
        if is_nowhere and QGuiApplication.applicationState() == Qt.ApplicationState.ApplicationActive:
            front = QApplication.activeModalWidget() or self
            if front.isVisible():
                front.activateWindow()

    # -- the project and the files -----------------------------------------------

    @property
    def project(self) -> Project | None:
        """The project whose files the project menu means."""
        return self._project

    @project.setter
    def project(self, project: Project | None) -> None:
        self._project = project
        self.project_changed.emit()

    def close_page(self, page: FilePage) -> None:
        """Close a file without a question."""
        page.blockSignals(True)  # no view follows it any more
        self.tabs.remove(page)
        self.docks.remove(page)
        page.workspace.close()
        page.workspace.deleteLater()  # else it keeps, by what follows its signals, all that was made for it
        page.deleteLater()
        if not self.is_leaving:
            collect_soon()

    @property
    def page(self) -> FilePage | None:
        """The page of the file in front; None while no file is open."""
        return self.tabs.current

    @property
    def workspace(self) -> Workspace | None:
        """The file in front."""
        return self.page.workspace if self.page else None

    @property
    def page_in_front(self) -> FilePage:
        """The page of the file in front, for what is enabled with a file only."""
        assert self.page is not None
        return self.page

    @property
    def workspace_in_front(self) -> Workspace:
        """The file in front, for what is enabled with a file only."""
        return self.page_in_front.workspace

    @property
    def table(self) -> ParameterTable | None:
        """The table model of the file in front."""
        return self.page.table if self.page else None

    @property
    def table_view(self) -> ValueTable | None:
        """The table of the file in front."""
        return self.page.table_view if self.page else None

    @property
    def groups(self) -> GroupList | None:
        """The groups of the file in front."""
        return self.page.groups if self.page else None

    @property
    def detail(self) -> DetailPanel | None:
        """The parameter panel of the file in front."""
        return self.page.detail if self.page else None

    @property
    def findings(self) -> FindingsPanel | None:
        """The findings of the file in front."""
        return self.page.findings if self.page else None

    def page_of(self, path: Path) -> FilePage | None:
        """Return the page of a file that is open here, by whatever name of it."""
        return next((p for p in self.tabs.pages() if same_file(p.workspace.path, path)), None)

    # -- actions ---------------------------------------------------------------

    def guarded(self, act: Callable[[], object], title: str = "AMP Studio") -> object:
        """Run an action and return its result; an error is shown as a message, and the result is None."""
        # A value that is being typed is taken first; while it is refused, no action works on the old one.
        if self.table_view is not None and not self.table_view.finish():
            return None
        try:
            return act()
        except (OSError, ValueError, KeyError, RuntimeError) as error:
            is_bare = type(error) is KeyError and error.args  # its own text is in quotes
            show_message(self, title, message_in_words(str(error.args[0]) if is_bare else str(error)))
            return None

    def enable(self, *_: object) -> None:
        """Update actions, title and status bar; the main window does, who has them."""

    # -- what is shown ---------------------------------------------------------

    def show_status(self, text: str) -> None:
        """Show a short message in the status bar."""
        self.statusBar().showMessage(text, 10_000)

    def show_panel(self, title: str) -> None:
        """Show a panel that may be closed, and give it the keyboard focus."""
        self.docks.show(title)

    def leave_control(self) -> bool:
        """Show the values where the page at the control is in front; returns whether it was.
        The window with that page does it.
        """
        return False

    # -- selection -------------------------------------------------------------

    def selected(self) -> Address | None:
        """Return the address of the current cell."""
        return self.table_view.address() if self.table_view is not None else None

    def go_to(self, address: Address) -> None:
        """Select an address of the file in front; shows its group when the table does not contain it."""
        if self.page is not None:
            self.page.go_to(address)

    def follow(self, parameter_id: str) -> None:
        """Go to a parameter of the file in front, in the selected axis if it exists there."""
        if self.page is not None:
            self.page.follow(parameter_id)

    # -- leaving ---------------------------------------------------------------

    def save(self, page: FilePage | None = None) -> bool:
        """Save a file, the one in front by default; an error is shown, and the work stays open.

        Returns whether it was saved. Where another program has changed the file,
        its page offers the comparison.
        """
        page = page or self.page
        assert page is not None
        workspace = page.workspace
        try:
            workspace.save(lambda work: in_background(self, self.tr("Saving"), work))
        except ChangedOnDiskError:
            page.conflict.emit()
            return False
        except OSError as error:
            show_message(
                self,
                self.tr("Not saved"),
                self.tr("{error}.\n\nYour work is still open.").format(error=message_in_words(str(error))),
            )
            return False
        if workspace.document.notes:
            self.show_status("; ".join(workspace.document.notes))
        return True

    def may_leave(self, page: FilePage | None = None) -> bool:
        """Ask about unsaved work of a file; returns whether it may be closed."""
        page = page or self.page
        if page is None or not page.table_view.finish():
            return page is None
        if not page.may_leave():
            return False
        # Without the lock nothing can be saved here: asking would be in vain.
        if not page.workspace.is_dirty or not page.workspace.may_edit:
            return True
        # The question is about a file that is seen.
        self.tabs.bring(page)
        question = self.tr("Save the changes to {name}?").format(name=isolated(page.workspace.path.name))
        answer = ask(
            self,
            self.tr("Unsaved changes"),
            question,
            self.tr("&Save"),
            self.tr("&Discard"),
            self.tr("Cancel"),
        )
        return self.save(page) if answer == self.tr("&Save") else answer == self.tr("&Discard")
