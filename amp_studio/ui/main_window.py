"""The main window: groups left, table in the middle, help right, findings below."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from PySide6.QtCore import QByteArray, QFileSystemWatcher, QSettings, Qt, QTimer
from PySide6.QtGui import QAction, QCloseEvent, QKeySequence
from PySide6.QtWidgets import (
    QAbstractItemView,
    QDockWidget,
    QHeaderView,
    QLabel,
    QMainWindow,
    QMessageBox,
    QTableView,
    QVBoxLayout,
    QWidget,
)

from amp_studio.files import ChangedOnDisk, RangeFault, describe
from amp_studio.files.lock import now
from amp_studio.schema import Address, ValueFault
from amp_studio.validate import Finding

from .axis_actions import AxisActions
from .control_actions import ControlActions
from .detail_panel import DetailPanel
from .file_actions import FileActions
from .findings_panel import FindingsPanel
from .group_list import GroupList
from .palette import CommandPalette
from .parameter_table import AddressRole, ParameterTable
from .quick_edit import QuickEdit
from .value_delegate import ValueDelegate
from .view_actions import ViewActions
from .workspace import Workspace


class MainWindow(QMainWindow):
    """One window, one open file. Menus are filled by the action groups in the modules beside this one."""

    def __init__(self) -> None:
        super().__init__()
        self.setWindowTitle("AMP Studio")
        self.resize(1280, 800)
        self.workspace: Workspace | None = None
        self._title = ""
        self._last: Address | None = None
        self.table: ParameterTable | None = None
        self.settings = QSettings("AMP Studio", "AMP Studio")
        self.file_status, self.value_status = QLabel(), QLabel()
        self.statusBar().addWidget(self.value_status, 1)
        self.statusBar().addPermanentWidget(self.file_status)
        self.needs_file: list[QAction] = []
        self.setDockOptions(QMainWindow.DockOption.AnimatedDocks | QMainWindow.DockOption.AllowNestedDocks)
        self._watcher = QFileSystemWatcher(self)
        self._watcher.fileChanged.connect(lambda _: QTimer.singleShot(200, self._ask_reload))
        self.files = FileActions(self)
        self._edit_menu()
        self.axes = AxisActions(self)
        self.view = ViewActions(self)
        self.control = ControlActions(self)
        self._help_menu()
        self._toolbar()
        self.files.show_welcome()
        self._enable()

    # -- building --------------------------------------------------------------

    def action(
        self, text: str, act: Callable[[], object], shortcut: QKeySequence | QKeySequence.StandardKey | str | None = None,
        needs_file: bool = True,
    ) -> QAction:  # fmt: skip
        """Return a menu action that shows every refusal in one sentence instead of failing."""
        action = QAction(text, self)
        if shortcut is not None:
            action.setShortcut(QKeySequence(shortcut))
        action.triggered.connect(lambda *_: self.guarded(act))
        if needs_file:
            self.needs_file.append(action)
        self.addAction(action)
        return action

    def guarded(self, act: Callable[[], object]) -> object:
        """Run an action; what it refuses is told in one sentence, and nothing is changed."""
        try:
            return act()
        except (OSError, ValueError, KeyError, RuntimeError) as error:
            QMessageBox.warning(self, "AMP Studio", str(error))
            return None

    def _edit_menu(self) -> None:
        menu = self.menuBar().addMenu("&Edit")
        self.undo_action = self.action("&Undo", lambda: self.workspace and self.workspace.undo_stack.undo(),
                                       QKeySequence.StandardKey.Undo)  # fmt: skip
        self.redo_action = self.action("&Redo", lambda: self.workspace and self.workspace.undo_stack.redo(),
                                       QKeySequence.StandardKey.Redo)  # fmt: skip
        menu.addActions([self.undo_action, self.redo_action])
        menu.addSeparator()
        menu.addAction(self.action("&Quick Edit by Number…", self.quick_edit, "F4"))
        menu.addAction(self.action("&Find Parameter", lambda: self.groups.focus_search(), None))
        menu.addAction(self.action("Put Back to &Default", self.to_default, "Ctrl+D"))
        menu.addAction(self.action("Copy Value to All A&xes of the Type", self.to_all_axes, "Ctrl+Shift+A"))
        menu.addSeparator()
        menu.addAction(self.action("&Repair Selected Finding", lambda: self.findings.repair(), "F8"))
        menu.addAction(self.action("Repair All &Safe Findings", self.repair_safe, "Shift+F8"))

    def _help_menu(self) -> None:
        menu = self.menuBar().addMenu("&Help")
        menu.addAction(self.action("&Commands…", self.palette_of_commands, "Ctrl+Shift+P", needs_file=False))
        menu.addAction(self.action("&About AMP Studio", self._about, None, needs_file=False))

    def _toolbar(self) -> None:
        bar = self.addToolBar("Main")
        bar.setObjectName("main-toolbar")
        bar.setMovable(False)
        bar.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextOnly)
        for action in (*self.files.toolbar, None, self.undo_action, self.redo_action, None, *self.view.toolbar, None,
                       *self.control.toolbar):  # fmt: skip
            bar.addSeparator() if action is None else bar.addAction(action)

    def _about(self) -> None:
        from amp_studio import __version__

        QMessageBox.about(self, "AMP Studio", f"AMP Studio {__version__}\n\nThe numbered parameters of machine controls: "
                          "edited, checked, printed, exchanged, and seen in motion before iron moves.")  # fmt: skip

    # -- opening a workspace ---------------------------------------------------

    def show_workspace(self, workspace: Workspace) -> None:
        """Show a file in place of the one before, which has been closed."""
        if self.workspace is not None:
            self.workspace.close()
            if self._watcher.files():
                self._watcher.removePaths(self._watcher.files())
        self.workspace, self._last = workspace, None
        for dock in self.findChildren(QDockWidget):
            self.removeDockWidget(dock)
            dock.deleteLater()
        self.table = ParameterTable(workspace)
        self.table_view = self._table_view(self.table)
        self.group_title = QLabel()
        self.group_title.setContentsMargins(6, 4, 6, 4)
        centre = QWidget()
        layout = QVBoxLayout(centre)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.group_title)
        layout.addWidget(self.table_view)
        self.setCentralWidget(centre)
        self.groups, self.detail, self.findings = GroupList(workspace), DetailPanel(workspace), FindingsPanel(workspace)
        self._dock("Groups", self.groups, Qt.DockWidgetArea.LeftDockWidgetArea, 235)
        self._dock("Parameter", self.detail, Qt.DockWidgetArea.RightDockWidgetArea, 330)
        self._dock("Findings", self.findings, Qt.DockWidgetArea.BottomDockWidgetArea, 180)
        self.groups.chosen.connect(self._show_parameters)
        self.detail.linked.connect(self._follow)
        self.findings.activated.connect(self._show_finding)
        self.findings.repaired.connect(self.repair)
        workspace.changed.connect(lambda _: self._enable())
        workspace.saved.connect(self._after_save)
        self._watcher.addPath(str(workspace.path))
        self.groups.choose()
        self.view.follow(workspace)
        self._enable()
        self._restore_layout()

    def _dock(self, title: str, widget: QWidget, area: Qt.DockWidgetArea, size: int) -> None:
        dock = QDockWidget(title, self)
        dock.setObjectName(title)
        dock.setWidget(widget)
        dock.setFeatures(QDockWidget.DockWidgetFeature.DockWidgetMovable | QDockWidget.DockWidgetFeature.DockWidgetFloatable)
        self.addDockWidget(area, dock)
        side = Qt.Orientation.Vertical if area == Qt.DockWidgetArea.BottomDockWidgetArea else Qt.Orientation.Horizontal
        self.resizeDocks([dock], [size], side)

    def _table_view(self, model: ParameterTable) -> QTableView:
        view = QTableView()
        view.setModel(model)
        view.setAlternatingRowColors(True)
        view.setSelectionMode(QAbstractItemView.SelectionMode.SingleSelection)
        view.verticalHeader().hide()
        view.verticalHeader().setDefaultSectionSize(24)
        view.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Interactive)
        view.setEditTriggers(QAbstractItemView.EditTrigger.DoubleClicked | QAbstractItemView.EditTrigger.EditKeyPressed
                             | QAbstractItemView.EditTrigger.AnyKeyPressed)  # fmt: skip
        assert self.workspace is not None
        view.setItemDelegate(ValueDelegate(self.workspace, self.commit, view))
        view.selectionModel().currentChanged.connect(lambda *_: self._selected())
        model.modelReset.connect(self._after_reset)
        return view

    def _show_parameters(self, title: str, parameters: list) -> None:  # type: ignore[type-arg]  # of Parameter
        assert self.table is not None
        address = self.selected()
        self.table.show_parameters(parameters)
        self._title = title
        self._tell_title()
        self._fit_columns()
        index = self.table.index_of(address) if address else self.table.index(0, 2)
        self.table_view.setCurrentIndex(index if index.isValid() else self.table.index(0, 2))

    def _tell_title(self) -> None:
        assert self.table is not None
        hidden = self.table.hidden_rows
        more = f", {hidden} more do not exist for this configuration (Options > Show Hidden)" if hidden else ""
        self.group_title.setText(f"<b>{self._title}</b> — {len(self.table.rows)} parameters{more}")

    def _after_reset(self) -> None:
        self._fit_columns()
        self._tell_title()
        if self._last and self.table is not None:
            self.table_view.setCurrentIndex(self.table.index_of(self._last))

    def _fit_columns(self) -> None:
        assert self.table is not None
        self.table_view.setColumnWidth(0, 48)
        self.table_view.setColumnWidth(1, 216)
        for column in range(2, self.table.columnCount()):
            self.table_view.setColumnWidth(column, max(104, min(170, self.table_view.sizeHintForColumn(column) + 12)))

    # -- selection -------------------------------------------------------------

    def selected(self) -> Address | None:
        """Return the address of the current cell."""
        return self.table_view.currentIndex().data(AddressRole) if self.table else None

    def _selected(self) -> None:
        address = self.selected()
        if address is None:
            return
        self._last = address
        self.detail.show_address(address)
        self.value_status.setText(self._told(address))

    def _told(self, address: Address) -> str:
        assert self.workspace is not None
        file = self.workspace.file
        return f"{describe(file, address)}   {file.schema.instance_label(address, file.machine)}   {address[0]}"

    def go_to(self, address: Address) -> None:
        """Show and select an address, in its group when the table does not show it now."""
        assert self.table is not None
        index = self.table.index_of(address)
        if not index.isValid():
            self.groups.choose_group_of(address[0])
            index = self.table.index_of(address)
            if not index.isValid() and self.workspace and address[1] in self.workspace.file.schema.instances(
                self.workspace.file.schema.parameters[address[0]], self.workspace.file.machine
            ):
                exists = self.workspace.file.situation.state(address).state != "hidden"
                (self.view.all_axes if exists else self.view.hidden_too).trigger()
                index = self.table.index_of(address)
        self.table_view.setCurrentIndex(index)
        self.table_view.scrollTo(index)

    def _follow(self, parameter_id: str) -> None:
        assert self.workspace is not None
        file, here = self.workspace.file, self.selected()
        instances = file.schema.instances(file.schema.parameters[parameter_id], file.machine)
        self.go_to((parameter_id, here[1] if here and here[1] in instances else instances[0]))

    def _show_finding(self, finding: Finding) -> None:
        if finding.addresses:
            self.go_to(finding.addresses[0])

    # -- editing ---------------------------------------------------------------

    def commit(self, address: Address, text: str) -> bool:
        """Take a text typed for an address; asks before a value out of range is forced. Tells whether it was taken."""
        assert self.workspace is not None
        file = self.workspace.file
        name = describe(file, address)
        try:
            value = file.read(address, text) if text.strip() else None
        except ValueFault as error:
            QMessageBox.warning(self, name, f"{error}.\n\nNothing was changed.")
            return False
        try:
            self.workspace.edit(f"{name}", {address: value})
        except RangeFault as error:
            return self._ask_force(address, text, str(error))
        return True

    def _ask_force(self, address: Address, text: str, said: str) -> bool:
        assert self.workspace is not None
        box = QMessageBox(QMessageBox.Icon.Warning, "Out of range", f"{said}.\n\nNothing was changed.", parent=self)
        force = box.addButton("Force and mark it", QMessageBox.ButtonRole.DestructiveRole)
        box.addButton(QMessageBox.StandardButton.Cancel)
        box.setDefaultButton(QMessageBox.StandardButton.Cancel)
        box.exec()
        if box.clickedButton() is not force:
            return False
        value = self.workspace.file.read(address, text)
        self.workspace.edit("Force a value", {address: value}, force=f"on {now()} in the studio")
        return True

    def quick_edit(self) -> None:
        """Open quick edit by number."""
        assert self.workspace is not None
        QuickEdit(self.workspace, self.commit, self.go_to, self).show()

    def to_default(self) -> None:
        """Put the selected value back to its printed default."""
        address = self.selected()
        if address and self.workspace:
            self.workspace.edit("Default", {address: self.workspace.file.default(address)})

    def to_all_axes(self) -> None:
        """Copy the selected value to every fitted axis of the same type."""
        from amp_studio.files import axis_type, fitted_axes

        address = self.selected()
        if not address or not self.workspace or address[1] not in fitted_axes(self.workspace.file):
            return
        file = self.workspace.file
        same = [a for a in fitted_axes(file) if axis_type(file, a) == axis_type(file, address[1])]
        self.workspace.edit("Copy to all axes", {(address[0], a): file.get(address) for a in same})

    def repair(self, finding: Finding) -> None:
        """Apply the repair of a finding as one step."""
        assert self.workspace is not None
        wanted = {r.address: r.value for r in finding.repairs}
        self.guarded(lambda: self.workspace and self.workspace.edit("Repair", dict(wanted)))

    def repair_safe(self) -> None:
        """Apply every repair that cannot change motion, as one step."""
        assert self.workspace is not None
        wanted = {r.address: r.value for f in self.workspace.findings if f.safe for r in f.repairs}
        self.workspace.edit("Repair all safe findings", dict(wanted))

    def palette_of_commands(self) -> None:
        """Open the command palette."""
        CommandPalette(self.actions(), self).exec()

    # -- state of the window ---------------------------------------------------

    def _enable(self) -> None:
        workspace = self.workspace
        for action in self.needs_file:
            action.setEnabled(workspace is not None)
        if workspace is None:
            return
        self.undo_action.setEnabled(workspace.undo_stack.canUndo())
        self.redo_action.setEnabled(workspace.undo_stack.canRedo())
        self.undo_action.setText(f"&Undo {workspace.undo_stack.undoText()}".rstrip())
        self.redo_action.setText(f"&Redo {workspace.undo_stack.redoText()}".rstrip())
        name = workspace.path.name + (" •" if workspace.is_dirty else "")
        read_only = "" if workspace.document.is_locked else "  [read only]"
        self.setWindowTitle(f"{name}{read_only} — AMP Studio")
        file = workspace.file
        worst = {s: sum(f.severity == s for f in workspace.findings) for s in ("error", "warning")}
        self.file_status.setText(
            f"{file.schema.family.name}   {file.machine}   {worst['error']} errors   {worst['warning']} warnings   "
            + ("not saved" if workspace.is_dirty else "saved")
        )

    def _after_save(self) -> None:
        if self.workspace and str(self.workspace.path) not in self._watcher.files():
            self._watcher.addPath(str(self.workspace.path))  # a rename over the file ends the old watch
        self._enable()

    def _ask_reload(self) -> None:
        workspace = self.workspace
        if workspace is None or not workspace.path.exists() or not workspace.document.changed_on_disk():
            if workspace and workspace.path.exists():
                self._watcher.addPath(str(workspace.path))
            return
        answer = QMessageBox.question(
            self, "Changed on disk", f"{workspace.path.name} has been changed by another program.\n\n"
            "Load it again? Your unsaved changes would be lost." if workspace.is_dirty else
            f"{workspace.path.name} has been changed by another program.\n\nLoad it again?",
        )  # fmt: skip
        if answer == QMessageBox.StandardButton.Yes:
            self.guarded(lambda: self.files.open_path(workspace.path, ask=False))

    def _restore_layout(self) -> None:
        state = self.settings.value("layout")
        if isinstance(state, QByteArray):
            self.restoreState(state)

    def save_or_tell(self) -> bool:
        """Save; a file changed on disk or a full disk is told, and the work stays open. Tells whether it was saved."""
        assert self.workspace is not None
        try:
            self.workspace.save()
        except ChangedOnDisk as error:
            QMessageBox.warning(self, "Not saved", f"{error}.\n\nSave your work under a new name, or load the file again.")
            return False
        except OSError as error:
            QMessageBox.warning(self, "Not saved", f"{error}.\n\nYour work is still open.")
            return False
        return True

    def may_leave(self) -> bool:
        """Ask what becomes of unsaved work; tells whether the file may be closed."""
        if self.workspace is None or not self.workspace.is_dirty:
            return True
        buttons = QMessageBox.StandardButton
        answer = QMessageBox.question(
            self, "Unsaved changes", f"Save the changes to {self.workspace.path.name}?",
            buttons.Save | buttons.Discard | buttons.Cancel, buttons.Save,
        )  # fmt: skip
        if answer == buttons.Save:
            return self.save_or_tell()
        return bool(answer == buttons.Discard)

    def closeEvent(self, event: QCloseEvent) -> None:
        if not self.may_leave():
            event.ignore()
            return
        self.settings.setValue("layout", self.saveState())
        self.control.close()
        if self.workspace is not None:
            self.workspace.close()
        event.accept()

    def open_first(self, path: Path) -> None:
        """Open a file given on the command line."""
        self.guarded(lambda: self.files.open_path(path))
