"""The main window: groups left, table in the middle, help right, findings below."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QCloseEvent
from PySide6.QtWidgets import QDockWidget, QLabel, QMainWindow, QMessageBox, QVBoxLayout, QWidget

from amp_studio.files import describe
from amp_studio.report.wording import counted
from amp_studio.schema import Address, Parameter
from amp_studio.validate import Finding

from .axis_actions import AxisActions
from .control_actions import ControlActions
from .detail_panel import DetailPanel
from .disk_watch import DiskWatch
from .edit_actions import EditActions
from .file_actions import FileActions
from .findings_panel import FindingsPanel
from .garbage import collect_by_timer
from .group_list import GroupList
from .parameter_table import ParameterTable
from .project_actions import ProjectActions
from .questions import show_message
from .studio_window import StudioWindow
from .task import Task
from .theme import program_icon
from .value_table import ValueTable
from .view_actions import ViewActions
from .welcome import WelcomePage
from .workspace import Workspace

_PANELS = (
    ("Groups", Qt.DockWidgetArea.LeftDockWidgetArea, 225),
    ("Parameter", Qt.DockWidgetArea.RightDockWidgetArea, 320),
    ("Findings", Qt.DockWidgetArea.BottomDockWidgetArea, 190),
)


class MainWindow(StudioWindow):
    """One window, one open file. Menus are filled by the action groups in the modules beside this one."""

    def __init__(self) -> None:
        collect_by_timer()
        super().__init__()
        self.setWindowIcon(program_icon())
        room = self.screen().availableSize()
        self.resize(min(1360, room.width()), min(850, room.height() - 40))  # leave room for the window frame
        self._list_title = ""
        self.file_status, self.value_status = QLabel(), QLabel()
        self.statusBar().addWidget(self.value_status, 1)
        self.statusBar().addPermanentWidget(self.file_status)
        self.setDockOptions(QMainWindow.DockOption.AnimatedDocks | QMainWindow.DockOption.AllowNestedDocks)
        self.files = FileActions(self)
        self.watch = DiskWatch(self, partial(self.files.open_path, ask_first=False))
        self.edits = EditActions(self)
        self.axes = AxisActions(self)
        self.view = ViewActions(self)
        self.control = ControlActions(self, self.files)
        self.projects = ProjectActions(self, self.files.open_path)
        self._help_menu()
        self._toolbar()
        self.settings.place(self)
        self.show_nothing()

    # -- building --------------------------------------------------------------

    def _help_menu(self) -> None:
        menu = self.menuBar().addMenu("&Help")
        menu.addAction(self.action("&Commands…", self.palette_of_commands, "Ctrl+Shift+P", ""))
        menu.addAction(self.action("&About AMP Studio", self._about, None, ""))

    def _toolbar(self) -> None:
        bar = self.addToolBar("Main")
        bar.setObjectName("main-toolbar")
        bar.setMovable(False)
        bar.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        bar.setContextMenuPolicy(Qt.ContextMenuPolicy.PreventContextMenu)
        for action in (*self.files.toolbar, None, self.edits.undo, self.edits.redo, None, *self.view.toolbar, None,
                       *self.control.toolbar):  # fmt: skip
            bar.addSeparator() if action is None else bar.addAction(action)

    def _about(self) -> None:
        from amp_studio import __version__

        show_message(self, "About AMP Studio", f"AMP Studio {__version__}\n\nThe numbered parameters of machine controls: "
             "edit, check, print, exchange and simulate them.", QMessageBox.Icon.Information)  # fmt: skip

    def palette_of_commands(self) -> None:
        """Open the command palette and run the chosen command."""
        from .palette import CommandPalette

        chosen = CommandPalette(self.menuBar(), self).ask()
        if chosen is not None:
            chosen.trigger()

    # -- opening and closing a workspace ---------------------------------------

    def show_nothing(self) -> None:
        """Show the welcome page in place of a file."""
        self._clear()
        self.workspace = None
        page = WelcomePage(self.files.welcome, self.files.recent(), self.open_first)
        self.setCentralWidget(page)
        page.setFocus()
        self.enable()

    def show_workspace(self, workspace: Workspace) -> None:
        """Close the present file and show another one."""
        self._clear()
        self.workspace = workspace
        self.table = ParameterTable(workspace)
        self.table_view = ValueTable(self.table, self.edits.commit, self.edits.of_a_cell)
        self.list_title = QLabel()
        self.list_title.setContentsMargins(6, 4, 6, 4)
        centre = QWidget()
        layout = QVBoxLayout(centre)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(0)
        layout.addWidget(self.list_title)
        layout.addWidget(self.table_view)
        self.setCentralWidget(centre)
        self.groups, self.detail, self.findings = (
            GroupList(workspace),
            DetailPanel(workspace, self.edits.commit),
            FindingsPanel(workspace),
        )
        for (title, area, size), panel in zip(
            _PANELS, (self.groups, self.detail, self.findings), strict=True
        ):
            self._dock(title, panel, area, size)
        self.groups.chosen.connect(self._show_parameters)
        self.groups.left.connect(self.table_view.setFocus)
        self.table_view.selected.connect(self._show_address)
        self.table.modelReset.connect(self._update_title)
        self.detail.linked.connect(self.follow)
        self.findings.activated.connect(self._show_finding)
        self.findings.fix_requested.connect(self._fix)
        self.findings.explanation_requested.connect(self._why)
        self.findings.suppression_requested.connect(self._suppress)
        workspace.changed.connect(self.enable)
        workspace.undo_stack.indexChanged.connect(
            self.enable
        )  # a step is on the stack only after it was made
        workspace.saved.connect(self.enable)
        self.watch.follow(workspace)
        self.view.follow(workspace)
        self.projects.notice(workspace.path.parent)
        self.groups.choose()
        self.settings.arrange(self)
        self.enable()
        self.table_view.setFocus()

    def _clear(self) -> None:
        if self.workspace is None:
            return
        self.settings.keep_arrangement(self)
        self.watch.follow(None)
        self.workspace.close()
        for dock in self.findChildren(QDockWidget):
            self.removeDockWidget(dock)
            dock.deleteLater()
        self.table = self.table_view = self.groups = self.detail = self.findings = None
        self.value_status.clear()

    def _dock(self, title: str, widget: QWidget, area: Qt.DockWidgetArea, size: int) -> None:
        dock = QDockWidget(title, self)
        dock.setObjectName(title)
        dock.setWidget(widget)
        dock.setFocusProxy(widget)
        self.addDockWidget(area, dock)
        below = area == Qt.DockWidgetArea.BottomDockWidgetArea
        self.resizeDocks([dock], [size], Qt.Orientation.Vertical if below else Qt.Orientation.Horizontal)

    # -- selection -------------------------------------------------------------

    def _show_parameters(self, title: str, parameters: list[Parameter]) -> None:
        assert self.table is not None
        self._list_title = title
        if parameters == self.table.asked:
            self._update_title()
        else:
            self.table.show_parameters(parameters)

    def _update_title(self) -> None:
        assert self.table is not None
        count, hidden = len(self.table.rows), self.table.hidden_rows
        more = f", {hidden} hidden (Ctrl+H shows them)" if hidden else ""
        what = counted(count, "parameter", none="no")
        self.list_title.setText(f"<b>{self._list_title}</b> — {what}{more}")

    def _show_address(self, address: Address) -> None:
        assert self.workspace is not None
        assert self.detail is not None
        self.detail.show_address(address)
        file = self.workspace.file
        place = file.machine_schema.instance_label(address)
        self.value_status.setText("   ".join(t for t in (describe(file, address), place, address[0]) if t))

    def go_to(self, address: Address) -> None:
        """Select an address; shows its group when the table does not contain it."""
        if self.table is None or self.table_view is None or self.groups is None or self.workspace is None:
            return
        if not self.table.index_of(address).isValid():
            self.groups.choose_group_of(address[0])
        hidden = self.workspace.file.evaluation.state(address).state == "hidden"
        for option in ([self.view.hidden_too] if hidden else []) + [self.view.all_axes]:
            if not self.table.index_of(address).isValid() and not option.isChecked():
                option.trigger()
        index = self.table.index_of(address)
        if index.isValid():
            self.table_view.setCurrentIndex(index)
            self.table_view.scrollTo(index)
        else:
            self.show_status(
                f"{describe(self.workspace.file, address)} is not available on this machine type"
            )

    def _show_finding(self, finding: Finding) -> None:
        if finding.addresses and self.table_view is not None:
            self.go_to(finding.addresses[0])
            self.table_view.setFocus()

    def _why(self, finding: Finding) -> None:
        self.guarded(lambda: self.edits.why(finding), "Explain")

    def _suppress(self, finding: Finding) -> None:
        self.guarded(lambda: self.edits.suppress(finding), "Suppress")

    def _fix(self, finding: Finding) -> None:
        self.guarded(lambda: self.edits.fix(finding), "Fix")

    # -- state of the window ---------------------------------------------------

    def enable(self, *_: object) -> None:
        """Update actions, title and status bar."""
        workspace = self.workspace
        may_edit = workspace is not None and workspace.may_edit
        has_axes = workspace is not None and workspace.file.schema.family.axes is not None
        can = {"": True, "file": workspace is not None, "edit": may_edit, "axes": may_edit and has_axes,
               "units": workspace is not None and len(workspace.file.schema.family.units) > 1,
               "project": self.project is not None}  # fmt: skip
        for needs, actions in self.actions_needing.items():
            for action in actions:
                action.setEnabled(can[needs])
        self.edits.show_state(workspace)
        self.control.enable()
        if workspace is None:
            self.setWindowTitle("AMP Studio")
            self.setWindowModified(False)
            self.file_status.clear()
            return
        project = self.projects.name_of(workspace.path)
        place = f"{project} — " if project else ""
        self.setWindowTitle(
            f"{workspace.path.name}[*]{'' if may_edit else ' [read-only]'} — {place}AMP Studio"
        )
        self.setWindowModified(workspace.is_dirty)
        file = workspace.file
        counts = [counted(workspace.count(s), s, none="no") for s in ("error", "warning")]
        saved = "not saved" if workspace.is_dirty else "saved"
        units = "as entered" if workspace.as_entered else file.header.units
        parts = (file.schema.family.name, file.machine, units, *counts, saved if may_edit else "read-only")
        self.file_status.setText("   ".join(parts))

    # -- leaving ---------------------------------------------------------------

    def closeEvent(self, event: QCloseEvent) -> None:
        if (self.table_view is not None and not self.table_view.finish()) or not self.may_leave():
            event.ignore()
            return
        self.settings.keep_place(self)
        self.control.close()
        self._clear()
        self.workspace = None
        Task.end_all()
        event.accept()

    def open_first(self, path: Path) -> None:
        """Open a file from the command line or the welcome page."""
        self.guarded(lambda: self.files.open_path(path), "Open")
