"""The window as its parts see it: the open file, the panels, and what a menu action can ask for.

The action classes and the watch of the disk take this class; ``MainWindow`` is one, builds them all and has the methods
that are abstract here. So nothing that is part of the window imports it. Qt's metaclass leaves no place for ``ABCMeta``:
mypy alone, as part of ``make check``, refuses a window without one of these methods.
"""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Callable
from pathlib import Path
from typing import Literal

from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QDockWidget, QMainWindow, QStyle

from amp_studio.files import ChangedOnDiskError, Project
from amp_studio.schema import Address

from .detail_panel import DetailPanel
from .findings_panel import FindingsPanel
from .group_list import GroupList
from .parameter_table import ParameterTable
from .questions import ask, show_message
from .settings import Settings
from .task import in_background
from .theme import standard_icon
from .value_table import ValueTable
from .workspace import Workspace

Needs = Literal["", "file", "edit", "axes", "project", "units"]
"""What an action needs: nothing, an open file, the right to change it, a family with axes as well, a project."""


class StudioWindow(QMainWindow):
    """One window, one open file, its panels and its actions."""

    def __init__(self) -> None:
        super().__init__()
        self.workspace: Workspace | None = None
        self.project: Project | None = None
        self.table: ParameterTable | None = None
        self.table_view: ValueTable | None = None
        self.groups: GroupList | None = None
        self.detail: DetailPanel | None = None
        self.findings: FindingsPanel | None = None
        self.settings = Settings()
        self.actions_needing: dict[Needs, list[QAction]] = {
            "": [],
            "file": [],
            "edit": [],
            "axes": [],
            "units": [],
            "project": [],
        }

    # -- actions ---------------------------------------------------------------

    def action(
        self,
        text: str,
        act: Callable[[], object],
        shortcut: QKeySequence | QKeySequence.StandardKey | str | None = None,
        needs: Needs = "file",
        icon: QStyle.StandardPixmap | None = None,
        short: str = "",
    ) -> QAction:
        """Return a menu action that shows an error of ``act`` as a message."""
        action = QAction(text, self)
        if shortcut is not None:
            action.setShortcut(QKeySequence(shortcut))
        if icon is not None:
            action.setIcon(standard_icon(icon))
        if short:
            action.setIconText(short)
        name = text.replace("&", "").rstrip("…")
        keys = action.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
        action.setToolTip(f"{name} ({keys})" if keys else name)
        action.triggered.connect(lambda *_: self.guarded(act, name))
        self.actions_needing[needs].append(action)
        self.addAction(action)
        return action

    def guarded(self, act: Callable[[], object], title: str = "AMP Studio") -> object:
        """Run an action and return its result; an error is shown as a message, and the result is None."""
        if self.table_view is not None and not self.table_view.finish():
            return None
        try:
            return act()
        except (OSError, ValueError, KeyError, RuntimeError) as error:
            is_bare = type(error) is KeyError and error.args  # its own text is in quotes
            show_message(self, title, str(error.args[0]) if is_bare else str(error))
            return None

    # -- what is shown ---------------------------------------------------------

    @abstractmethod
    def show_nothing(self) -> None:
        """Show the welcome page in place of a file."""

    @abstractmethod
    def show_workspace(self, workspace: Workspace) -> None:
        """Close the present file and show another one."""

    @abstractmethod
    def open_first(self, path: Path) -> None:
        """Open a file; an error is shown."""

    @abstractmethod
    def enable(self, *_: object) -> None:
        """Update actions, title and status bar."""

    def show_status(self, text: str) -> None:
        """Show a short message in the status bar."""
        self.statusBar().showMessage(text, 10_000)

    def show_panel(self, title: str) -> None:
        """Show a panel that may be closed, and give it the keyboard focus."""
        for dock in self.findChildren(QDockWidget):
            if dock.objectName() == title:
                dock.show()
                dock.raise_()
                dock.widget().setFocus()

    # -- selection -------------------------------------------------------------

    def selected(self) -> Address | None:
        """Return the address of the current cell."""
        return self.table_view.address() if self.table_view is not None else None

    @abstractmethod
    def go_to(self, address: Address) -> None:
        """Select an address; shows its group when the table does not contain it."""

    def follow(self, parameter_id: str) -> None:
        """Go to a parameter, in the selected axis if it exists there."""
        assert self.workspace is not None
        file, here = self.workspace.file, self.selected()
        instances = file.machine_schema.instances(file.schema.parameters[parameter_id])
        if instances:
            self.go_to((parameter_id, here[1] if here and here[1] in instances else instances[0]))
        else:
            self.show_status(
                f"{file.schema.parameters[parameter_id].name} is not available on this machine type"
            )

    # -- leaving ---------------------------------------------------------------

    def save(self) -> bool:
        """Save and return whether it was saved; an error is shown, and the work stays open."""
        assert self.workspace is not None
        try:
            self.workspace.save(lambda work: in_background(self, "Saving", work))
        except ChangedOnDiskError as error:
            show_message(
                self, "Not saved", f"{error}.\n\nSave your work under a new name, or reload the file."
            )
            return False
        except OSError as error:
            show_message(self, "Not saved", f"{error}.\n\nYour work is still open.")
            return False
        if self.workspace.document.notes:
            self.show_status("; ".join(self.workspace.document.notes))
        return True

    def may_leave(self) -> bool:
        """Ask about unsaved work; returns whether the file may be closed."""
        if self.workspace is None or not self.workspace.is_dirty or not self.workspace.may_edit:
            return True
        question = f"Save the changes to {self.workspace.path.name}?"
        answer = ask(self, "Unsaved changes", question, "&Save", "&Discard", "Cancel")
        return self.save() if answer == "&Save" else answer == "&Discard"
