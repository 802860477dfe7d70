"""The main window: groups left, table in the middle, help right, findings below."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property, partial
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QCloseEvent, QDragEnterEvent, QDropEvent, QResizeEvent
from PySide6.QtWidgets import QLabel, QMainWindow, QWidget

from amp_studio.files import ENDING, axis_instances
from amp_studio.schema import Address, isolated
from amp_studio.validate import Finding

from .actions import filters, guide, project, view
from .actions.ahead import LoadedAhead
from .actions.control import ControlDesk
from .actions.edit import Edits
from .actions.file import Files
from .actions.find import FindSearch
from .actions.parts import PartsWindow
from .actions.picture import Pictures
from .actions.preview import ReportPreview
from .actions.table import TOOL_BAR, menus
from .base.garbage import collect_by_timer, set_apart
from .base.program_icon import program_icon
from .base.questions import ask
from .base.task import Task
from .base.theme import apply_style
from .base.translated import tr
from .base.workspace import Workspace
from .forms.front_stack import FrontStack
from .page.file_page import FilePage
from .page.left_panel import as_side
from .project.files import ProjectFiles
from .project.tree import ProjectTree
from .welcome.page import WelcomePage
from .window.action import Needs
from .window.disk_watch import DiskWatch
from .window.menus import Menus
from .window.status_line import StatusBar, StatusLine
from .window.tab_corner import TabCorner
from .window.tool_bar import MainToolBar
from .window.visited import VisitedPlaces


class MainWindow(PartsWindow):
    """The open files in tabs. The table of actions fills the menus."""

    menus: Menus[PartsWindow]

    def __init__(self, *, opening: Sequence[str] = ()) -> None:
        """Begin with the welcome page, or with the names of the files that are ``opening`` at once:
        ``show_values`` shows the welcome page where that fails.
        """
        collect_by_timer()
        super().__init__()
        apply_style(self.settings.theme())
        self.setWindowIcon(program_icon())
        self.setAcceptDrops(True)
        room = self.screen().availableSize()
        self.resize(min(1360, room.width()), min(850, room.height() - 40))  # leave room for the window frame
        self.setStatusBar(StatusBar())
        self.status = StatusLine(self.statusBar())
        self.status.findings_requested.connect(lambda: self.show_panel("Findings"))
        self.status.not_set_requested.connect(lambda: self.page.show_not_set() if self.page else None)
        self.setDockOptions(QMainWindow.DockOption.AnimatedDocks | QMainWindow.DockOption.AllowNestedDocks)
        self.files = Files(self, self.show_workspace)
        self.open_path = self.files.open_path
        self.edits = Edits(self)
        self.finder = FindSearch(self)
        self.visited = VisitedPlaces(self)
        self.pictures = Pictures(self)
        self.preview = ReportPreview(self)
        LoadedAhead(self)
        self.centre = FrontStack()
        self.control = ControlDesk(self, self.files, self.centre, self.show_values)
        self.menus = Menus[PartsWindow](self, menus())
        self.project_files = ProjectFiles(
            self,
            self.files.open_path,
            self.files.comparing,
            partial(project.show_at, self),
            partial(project.change, self),
        )
        self.tools = MainToolBar(self, self.menus, TOOL_BAR)
        self.tools.take_find_box(self.finder.box)
        self.addToolBar(self.tools)
        self.tabs.take_corner(
            TabCorner(self.menus["file.new"], self.menus["view.beside"], self.tabs.to_choose)
        )
        self.centre.addWidget(self.tabs)
        self.setCentralWidget(self.centre)
        self.tabs.current_changed.connect(self._show_page)
        self.tabs.close_requested.connect(self.files.close)
        self.project_changed.connect(self.enable)
        self.settings.place(self)
        if opening:
            self.centre.setCurrentIndex(self.centre.addWidget(_opening_page(opening)))
            self.enable()
        else:
            self._show_page(None)

    @cached_property
    def welcome(self) -> WelcomePage:
        """The page that is shown while no file is open."""
        page = WelcomePage(
            self, self.files, self.control, partial(project.open_project, self), parent=self.centre
        )
        self.centre.addWidget(page)
        return page

    # -- the open files ----------------------------------------------------------

    def show_workspace(self, workspace: Workspace, instead: FilePage | None = None) -> FilePage:
        """Show a file in a new tab, or in the place of another one, which is closed."""
        page = FilePage(
            workspace,
            self.edits.commit_to,
            self.menus.of_a_cell(),
            self.tabs.place_of(instead),
            self.docks.places,
        )
        page.front_requested.connect(self.leave_control)
        page.front_requested.connect(self.tabs.bring)
        page.selected.connect(self._show_value)
        page.noted.connect(self.show_status)
        page.detail.take_others(lambda: [p.workspace for p in self.tabs.pages() if p is not page])
        page.detail.calculator_requested.connect(
            lambda: self.guarded(self.edits.calculator, self.tr("Calculator"))
        )
        page.findings.fix_requested.connect(self._fix)
        page.findings.several_requested.connect(
            lambda: self.guarded(self.edits.fix_several, self.tr("Fix Several"))
        )
        page.findings.explanation_requested.connect(self._why)
        page.findings.suppression_requested.connect(self._suppress)
        guide.connect_page(self, page)
        page.left.take_project(lambda: ProjectTree(page, self.project_files))
        if side := as_side(self.settings.left_side()):
            page.left.show_side(side)
        page.left.turned.connect(self.settings.keep_left_side)
        DiskWatch(page, self.files.comparing.with_disk, self.files.reload)
        page.table_view.fill_requested.connect(self._fill_cells)
        page.table_view.reset_requested.connect(self.edits.range.offer_defaults)
        self.docks.add(page)
        self.finder.add(page)
        self.visited.add(page)
        filters.add(self, page)
        view.apply_options(self, page)
        self.tabs.add(page, instead)
        page.changed.connect(self._update)
        page.turned.connect(lambda: self._show_page(self.page))
        if instead is not None:
            self.close_page(instead)
        page.table_view.setFocus()
        set_apart(page)
        return page

    def close_page(self, page: FilePage) -> None:
        """Close a file without a question, and forget where it was visited."""
        self.visited.forget(page)
        super().close_page(page)

    def _show_page(self, page: FilePage | None) -> None:
        """Make the window that of the file in front, or show the welcome page."""
        if self.is_leaving:
            return
        if page is None:
            self.welcome.show_recent(self.files.recent.paths())
            self.centre.setCurrentWidget(self.welcome)
            self.status.value.clear()
        else:
            self.centre.setCurrentWidget(self.tabs)
            project.notice(self, page.workspace.path.parent)
            self._show_value()
        self.docks.show_page(None if page is None or page.turned_to else page)
        self.enable()

    def leave_control(self, *_: object) -> bool:
        """Show the values where the page at the control is in front; returns whether it was."""
        was_there = self.control.is_shown
        self.control.leave()
        return was_there

    def show_values(self) -> None:
        """Show the file in front, or the welcome page, in the place of the page at the control."""
        self._show_page(self.page)
        if self.page is not None:
            self.page.setFocus()

    def _show_value(self, *_: object) -> None:
        self.status.value.setText(self.page.address_text() if self.page else "")

    def _fill_cells(self, pairs: dict[Address, Address]) -> None:
        self.guarded(lambda: self.edits.range.fill_from(pairs), self.tr("Fill"))

    def _why(self, finding: Finding) -> None:
        self.guarded(lambda: self.edits.why(finding), self.tr("Explain"))

    def _suppress(self, finding: Finding) -> None:
        self.guarded(lambda: self.edits.suppress(finding), self.tr("Suppress"))

    def _fix(self, findings: tuple[Finding, ...]) -> None:
        self.guarded(lambda: self.edits.fix_all(findings), self.tr("Fix"))

    def _update(self, page: FilePage) -> None:
        """Follow a change of a file, in front or not."""
        self.tabs.rename(page)
        if page is self.page:
            self._show_value()
            self.enable()

    # -- state of the window ---------------------------------------------------

    def enable(self, *_: object) -> None:
        """Update actions, title and status bar."""
        workspace = self.workspace
        self.menus.enable(self._what_there_is(workspace))
        self.tools.show_units()
        self.status.show_file(workspace)
        self._show_control()
        if workspace is None:
            self.setWindowTitle("AMP Studio")
            self.setWindowModified(False)
            return
        name = project.name_of(self, workspace.path)
        place = f"{isolated(name)} — " if name else ""
        only_seen = "" if workspace.may_edit else f" [{self.tr('read-only')}]"
        self.setWindowTitle(f"{isolated(workspace.path.name)}[*]{only_seen} — {place}AMP Studio")
        self.setWindowModified(workspace.is_dirty)

    def _what_there_is(self, workspace: Workspace | None) -> dict[Needs, bool]:
        """Return what actions can need (``Action.needs``), and whether it is there."""
        may_edit = workspace is not None and workspace.may_edit
        has_axes = workspace is not None and bool(axis_instances(workspace.file))
        stack = workspace.undo_stack if workspace is not None and may_edit else None
        running = self.control.emulated.is_running
        return {
            "": True,
            "seen": self.page is not None and not self.page.turned_to and not self.control.is_shown,
            "file": workspace is not None,
            "edit": may_edit,
            "axes": may_edit and has_axes,
            "units": workspace is not None and len(workspace.file.schema.family.units) > 1,
            "project": self.project is not None,
            "undo": stack is not None and stack.canUndo(),
            "redo": stack is not None and stack.canRedo(),
            "emulated": running,
            "emulated estop": self.control.emulated.has_estop,
            "no emulated": workspace is not None and not running,
        }

    def _show_control(self) -> None:
        """Show the state of the control of the file in front in the status line."""
        workspace = self.workspace
        self.status.show_control(": ".join(self.control.state_of(workspace)[:2]) if workspace else "")

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self.tools.fit(event.size().width())
        self.docks.fit(event.size())

    # -- leaving ---------------------------------------------------------------

    def closeEvent(self, event: QCloseEvent) -> None:
        if self.control.is_sending:
            stop = self.tr("&Stop and Close")
            text = self.tr("Values are being sent to a control. Closing stops at the next safe point.")
            if ask(self, self.tr("Sending"), text, stop, self.tr("Cancel")) == stop:
                self.control.stop_sending(then=self.close)
            event.ignore()
            return
        if not all(self.may_leave(page) for page in self.tabs.pages()):
            event.ignore()
            return
        self.finder.box.setEnabled(False)  # else Qt gives it the focus while the window is taken apart
        # Before the pages are closed: what is kept is how the window is now.
        self.settings.keep_place(self)
        self.docks.keep()
        self.files.keep_session()
        self.control.close()
        self.is_leaving = True
        for page in self.tabs.pages():
            self.close_page(page)
        self.summaries.stop()
        if Task.running:
            self.hide()  # pages that are being set cannot be interrupted: the user need not watch that
        # Qt ends the program at a thread that is still running when its object is deleted.
        Task.end_all()
        event.accept()

    def open_first(self, path: Path) -> None:
        """Open a file from the command line, the welcome page or a drop; an error is shown."""
        self.guarded(lambda: self._open_anything(path), self.tr("Open"))

    def dragEnterEvent(self, event: QDragEnterEvent) -> None:
        """Take files and folders of this machine."""
        if any(url.isLocalFile() for url in event.mimeData().urls()):
            event.acceptProposedAction()

    def dropEvent(self, event: QDropEvent) -> None:
        """Open what was dropped: parameter files, projects by their folder,
        and texts of controls by an import.
        """
        event.acceptProposedAction()
        for url in event.mimeData().urls():
            if url.isLocalFile():
                path = Path(url.toLocalFile())
                self.guarded(
                    partial(self._open_anything, path), self.tr("Open {name}").format(name=path.name)
                )

    def _open_anything(self, path: Path) -> None:
        """Open a parameter file, or a project by its folder; import the text of a control.
        Raises ValueError, OSError.
        """
        if path.is_dir():
            project.open_folder(self, path)
        elif path.suffix.lower() == ENDING:
            self.files.open_path(path)
        else:
            from amp_studio.formats import is_parameter_file  # not needed at program start

            if is_parameter_file(path):
                self.files.open_path(path)
            else:
                self.files.formats.read_from(path)


def _opening_page(names: Sequence[str]) -> QWidget:
    """Return what is shown until the first file is there: which one is being read."""
    first, more = Path(names[0]).name, len(names) - 1
    text = (
        tr("Opening {name} …").format(name=first)
        if not more
        else tr("Opening {name} and %n more …", "", more).format(name=first)
    )
    page = QLabel(text)
    page.setAlignment(Qt.AlignmentFlag.AlignCenter)
    page.setBackgroundRole(page.palette().ColorRole.Base)
    page.setAutoFillBackground(True)
    return page
