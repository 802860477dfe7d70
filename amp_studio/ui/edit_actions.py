"""The edit menu: undo, values by keyboard and by number, repairs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QGuiApplication, QKeySequence
from PySide6.QtWidgets import QMessageBox, QStyle

from amp_studio.files import RangeError, axis_type, describe, fitted_axes, real_path
from amp_studio.files.lock import now, user
from amp_studio.schema import Address, InvalidValueError, Value
from amp_studio.validate import RULES_FILE, Finding, calculators, repair_all_safe, suppress

from .questions import ask, tell
from .workspace import Workspace

if TYPE_CHECKING:
    from .main_window import MainWindow


class EditActions:
    """Everything that changes a value."""

    def __init__(self, window: MainWindow) -> None:
        self.window = window
        act, keys, icons = window.action, QKeySequence.StandardKey, QStyle.StandardPixmap
        self.undo = act("&Undo", self._undo, keys.Undo, "edit", icons.SP_ArrowBack, "Undo")
        self.redo = act("&Redo", self._redo, keys.Redo, "edit", icons.SP_ArrowForward, "Redo")
        edit = act("&Edit Value", self._edit, "F2", "edit")
        copy = act("&Copy Value", self._copy, keys.Copy, "file")
        paste = act("&Paste Value", self._paste, keys.Paste, "edit")
        default = act("Put Back to &Default", self.to_default, "Ctrl+D", "edit")
        unset = act("U&nset", self.unset, keys.Delete, "edit")
        every = act("Copy to All A&xes of the Type", self.to_all_axes, "Ctrl+Shift+A", "axes")
        quick = act("&Quick Edit by Number…", self.quick_edit, "F4", "edit")
        calculator = act("Ca&lculator…", self.calculator, "F3", "file")
        tables = act("&Tables of the Manual…", self.tables, "Shift+F3", "file")
        find = act("&Find Parameter", self._find, keys.Find, "file")
        repair = act("Repa&ir Selected Finding", self._repair, "F8", "edit")
        why = act("W&hy Is This Found", self._why, "Shift+F1", "file")
        safe = act("Repair All &Safe Findings", self.repair_safe, "Shift+F8", "edit")
        for action in (copy, paste, unset):  # a text field has its own
            action.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        self.of_a_cell: list[QAction] = [edit, copy, paste, default, unset, every]
        menu = window.menuBar().addMenu("&Edit")
        for actions in (
            (self.undo, self.redo),
            self.of_a_cell,
            (quick, calculator, tables, find),
            (repair, safe, why),
        ):
            menu.addActions(list(actions))
            menu.addSeparator()

    def show_state(self, workspace: Workspace | None) -> None:
        """Say what undo and redo would do, and whether they can."""
        for action, name in ((self.undo, "&Undo"), (self.redo, "&Redo")):
            stack = workspace.undo_stack if workspace and workspace.may_edit else None
            is_undo = action is self.undo
            can = stack is not None and (stack.canUndo() if is_undo else stack.canRedo())
            what = (stack.undoText() if is_undo else stack.redoText()) if stack and can else ""
            action.setEnabled(can)
            action.setText(f"{name} {what.replace('&', '&&')}".rstrip())

    def _workspace(self) -> Workspace:
        workspace = self.window.workspace
        assert workspace is not None
        return workspace

    def _here(self) -> Address:
        address = self.window.selected()
        if address is None:
            raise ValueError("Select a value in the table first.")
        return address

    # -- one value -------------------------------------------------------------

    def commit(self, address: Address, text: str) -> bool:
        """Take a text typed for an address; asks before a value out of range is forced. Tells whether it was taken."""
        workspace = self._workspace()
        name = describe(workspace.file, address)
        try:
            value = workspace.read(address, text)
        except InvalidValueError as error:
            tell(self.window, "Not taken", f"{name}: {error}.\n\nNothing was changed.")
            return False
        try:
            workspace.edit(name, {address: value})
        except RangeError as error:
            return self._ask_force(address, value, str(error))
        return True

    def _ask_force(self, address: Address, value: Value | None, said: str) -> bool:
        force = "&Force and mark it"
        text = f"{said}.\n\nNothing was changed. A forced value stays marked in the file, the findings and the report."
        icon = QMessageBox.Icon.Warning
        if ask(self.window, "Out of range", text, force, "Cancel", default=1, icon=icon) != force:
            return False
        workspace = self._workspace()
        name = describe(workspace.file, address)
        return workspace.edit(f"{name} (forced)", {address: value}, force=f"on {now()} in the studio")

    def _undo(self) -> None:
        self._workspace().undo_stack.undo()

    def _redo(self) -> None:
        self._workspace().undo_stack.redo()

    def _edit(self) -> None:
        view = self.window.table_view
        if view is not None and view.currentIndex().isValid():
            view.setFocus()
            view.edit(view.currentIndex())

    def _copy(self) -> None:
        workspace, address = self._workspace(), self._here()
        if workspace.is_masked(address):
            name = describe(workspace.file, address)
            raise ValueError(f"{name} is secret: it can be copied while Options, Show Secrets is on.")
        if self.window.table is not None:
            QGuiApplication.clipboard().setText(self.window.table.typed_value(address))

    def _paste(self) -> None:
        text = QGuiApplication.clipboard().text().strip()
        if text:
            self.commit(self._here(), text)

    def to_default(self) -> None:
        """Put the selected value back to its printed default."""
        workspace, address = self._workspace(), self._here()
        default, name = workspace.file.default(address), describe(workspace.file, address)
        if default is None:
            raise ValueError(f"No default is printed for {name}; Delete leaves it unset.")
        workspace.edit(f"{name} to its default", {address: default})

    def unset(self) -> None:
        """Leave the selected value to the control."""
        workspace, address = self._workspace(), self._here()
        workspace.edit(f"{describe(workspace.file, address)} unset", {address: None})

    def to_all_axes(self) -> None:
        """Copy the selected value to every fitted axis of the same type."""
        workspace, address = self._workspace(), self._here()
        file = workspace.file
        if file.evaluation.scope(address) != "axis" or address[1] not in fitted_axes(file):
            raise ValueError("Select a value of a fitted axis first.")
        same = [a for a in fitted_axes(file) if axis_type(file, a) == axis_type(file, address[1])]
        workspace.edit("Copy to all axes of the type", {(address[0], a): file.get(address) for a in same})

    # -- by number, by name ----------------------------------------------------

    def quick_edit(self) -> None:
        """Open quick edit by number."""
        from .quick_edit import QuickEdit

        assert self.window.table is not None
        QuickEdit(self.window.table, self.commit, self.window.go_to, self.window).show()

    def calculator(self) -> None:
        """Open the calculators, with the formulas of the selected parameter first."""
        from .calculator_dialog import CalculatorDialog

        workspace = self._workspace()
        if not calculators(workspace.file.schema.family.family):
            raise ValueError(f"No formulas are published for {workspace.file.schema.family.name}.")
        CalculatorDialog(workspace, self.window.selected(), self.commit, self.window).show()

    def tables(self) -> None:
        """Open the manual's tables, with those of the selected parameter first."""
        from .tables_dialog import TablesDialog

        dialog = TablesDialog(self._workspace(), self.window.selected(), self.window)
        dialog.linked.connect(self.window.follow)
        dialog.show()

    def _find(self) -> None:
        self.window.show_panel("Groups")
        if self.window.groups is not None:
            self.window.groups.focus_search()

    # -- repairs ---------------------------------------------------------------

    def _repair(self) -> None:
        finding = self.window.findings.current() if self.window.findings else None
        if finding is None or not finding.repairs:
            raise ValueError(
                "The selected finding has no repair that could be made without knowing the machine."
            )
        self.repair(finding)

    def _why(self) -> None:
        finding = self.window.findings.current() if self.window.findings else None
        if finding is None:
            raise ValueError("No finding is selected.")
        self.why(finding)

    def why(self, finding: Finding) -> None:
        """Open the explanation of a finding."""
        from .finding_dialogs import WhyDialog

        WhyDialog(self._workspace(), finding, self.window.go_to, self.window).show()

    def suppress(self, finding: Finding) -> None:
        """Leave a finding as it is, with a reason and a name that are asked for."""
        from .finding_dialogs import SuppressDialog

        workspace = self._workspace()
        dialog = SuppressDialog(finding, user(), self.window)
        if dialog.exec():
            path = real_path(workspace.path).with_name(RULES_FILE)  # where rules are looked for
            notes: list[str] = []
            suppress(
                path,
                finding.rule,
                dialog.params(),
                reason=dialog.reason.text(),
                by=dialog.name.text(),
                tell=notes.append,
            )
            workspace.read_own_rules()
            self.window.say("; ".join([f"Kept in {path}", *notes]))

    def repair(self, finding: Finding) -> None:
        """Apply the repair of a finding as one step; only one that is offered now has been tried."""
        if finding not in self._workspace().findings:
            raise ValueError("This finding has changed or is gone: look at the findings again.")
        self._workspace().edit("Repair", {r.address: r.value for r in finding.repairs})

    def repair_safe(self) -> None:
        """Apply every repair that cannot change motion, as one step."""
        workspace = self._workspace()
        if not workspace.do("Repair all safe findings", lambda: repair_all_safe(workspace.validator)):
            self.window.say("No finding has a repair that cannot change motion.")
