"""The edit menu: undo, values by keyboard and by number, suggested fixes."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from PySide6.QtGui import QAction, QKeySequence
from PySide6.QtWidgets import QMessageBox

from amp_studio.files import RangeError, describe, real_path, user
from amp_studio.schema import Address, InvalidValueError
from amp_studio.ui.base.modal import run_dialog
from amp_studio.ui.base.questions import ask, show_message
from amp_studio.ui.base.translated import Translated
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.window.studio_window import StudioWindow
from amp_studio.validate import RULES_FILE, Finding, apply_all_safe, apply_fixes, calculators, suppress

from .range import RangeActions


class EditActions(Translated):
    """Everything that changes a value."""

    def __init__(self, window: StudioWindow) -> None:
        self.window = window
        act, keys = window.action, QKeySequence.StandardKey
        self.undo = act(self.tr("&Undo"), self._undo, keys.Undo, "edit", "arrow-u-up-left", self.tr("Undo"))
        self.redo = act(self.tr("&Redo"), self._redo, keys.Redo, "edit", "arrow-u-up-right", self.tr("Redo"))
        edit = act(self.tr("&Edit Value"), self._edit, "F2", "edit")
        steps = act(self.tr("Histor&y of Steps…"), self.steps, "Ctrl+Shift+H", "file")
        quick = act(self.tr("&Quick Edit by Number…"), self.quick_edit, "F4", "edit")
        calculator = act(self.tr("Ca&lculator…"), self.calculator, "F3", "file")
        tables = act(self.tr("&Tables of the Manual…"), self.tables, "Shift+F3", "file")
        fix = act(self.tr("F&ix Selected Finding"), self._fix, "F8", "edit")
        why = act(self.tr("S&how Explanation of Finding"), self._why, "Shift+F1", "file")
        several = act(self.tr("Fix Se&veral…"), self.fix_several, "Shift+F8", "edit", "magic-wand")
        safe = act(self.tr("Apply All &Safe Fixes"), self.fix_safe, None, "edit")
        note = act(self.tr("N&ote…"), self.note, "Alt+Return", "file", "note-pencil")
        self.range = RangeActions(window)
        self.of_a_cell: list[QAction] = [edit, *self.range.actions, note]
        self.menu = menu = window.menuBar().addMenu(self.tr("&Edit"))
        for actions in (
            (self.undo, self.redo, steps),
            self.of_a_cell,
            (quick, calculator, tables),
            (fix, several, safe, why),
        ):
            menu.addActions(list(actions))
            menu.addSeparator()

    def show_state(self, workspace: Workspace | None) -> None:
        """Update text and state of Undo and Redo."""
        for action, name in ((self.undo, self.tr("&Undo")), (self.redo, self.tr("&Redo"))):
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

    def _page(self) -> FilePage:
        page = self.window.page
        assert page is not None
        return page

    def _here(self) -> Address:
        address = self.window.selected()
        if address is None:
            raise ValueError(self.tr("Select a value in the table first."))
        return address

    # -- one value -------------------------------------------------------------

    def commit(self, address: Address, text: str) -> bool:
        """Set a value of the file in front from typed text."""
        return self.commit_to(self._workspace(), address, text)

    def commit_to(self, workspace: Workspace, address: Address, text: str) -> bool:
        """Set a value from typed text; asks before a value out of range is forced. Returns whether it was set."""
        name = describe(workspace.file, address)
        try:
            workspace.enter(address, text)
        except RangeError as error:
            return self._ask_force(workspace, address, text, str(error))
        except InvalidValueError as error:
            show_message(
                self.window,
                self.tr("Value not accepted"),
                self.tr("{name}: {error}.\n\nNothing was changed.").format(name=name, error=error),
            )
            return False
        return True

    def _ask_force(self, workspace: Workspace, address: Address, text: str, problem: str) -> bool:
        force = self.tr("&Force and Mark")
        question = self.tr(
            "{problem}.\n\nNothing was changed. A forced value is marked in the file, the findings and the report."
        ).format(problem=problem)
        icon = QMessageBox.Icon.Warning
        if (
            ask(
                self.window, self.tr("Out of range"), question, force, self.tr("Cancel"), default=1, icon=icon
            )
            != force
        ):
            return False
        return workspace.enter(address, text, force=True)

    def _undo(self) -> None:
        self._workspace().undo_stack.undo()

    def _redo(self) -> None:
        self._workspace().undo_stack.redo()

    def _edit(self) -> None:
        view = self.window.table_view
        if view is not None:
            view.setFocus()
            view.edit_current()

    def note(self) -> None:
        """Edit the notes about the selected value, its group and the machine."""
        from amp_studio.ui.dialogs.note_dialog import NoteDialog

        dialog = NoteDialog(self._workspace(), self.window.selected(), self.window)
        if run_dialog(dialog):
            dialog.write()

    def steps(self) -> None:
        """Show the steps that were made, to go back to one."""
        from amp_studio.ui.page.step_list import StepList

        StepList(self._workspace(), self.window).show()

    # -- by number, by name ----------------------------------------------------

    def quick_edit(self) -> None:
        """Open quick edit by number."""
        from amp_studio.ui.table.quick_edit import QuickEdit

        page = self._page()
        commit = partial(self.commit_to, page.workspace)
        QuickEdit(page.table, commit, page.go_to, self.window).show()

    def calculator(self) -> None:
        """Open the calculators, with the formulas of the selected parameter first."""
        from amp_studio.ui.dialogs.calculator_dialog import CalculatorDialog

        workspace = self._workspace()
        if not calculators(workspace.file.schema.family.family):
            raise ValueError(
                self.tr("No formulas are published for {name}.").format(
                    name=workspace.file.schema.family.name
                )
            )
        commit = partial(self.commit_to, workspace)
        CalculatorDialog(workspace, self.window.selected(), commit, self.window).show()

    def tables(self) -> None:
        """Open the manual's tables, with those of the selected parameter first."""
        from amp_studio.ui.dialogs.tables_dialog import TablesDialog

        dialog = TablesDialog(self._workspace(), self.window.selected(), self.window)
        dialog.linked.connect(self._page().follow)
        dialog.show()

    # -- findings ---------------------------------------------------------------

    def _fix(self) -> None:
        findings = self.window.findings.current_findings() if self.window.findings else ()
        able = tuple(finding for finding in findings if finding.fix)
        if not able:
            raise ValueError(
                self.tr("The selected finding has no suggested fix. Show it to see the parameters to check.")
            )
        self.fix_all(able)

    def _why(self) -> None:
        finding = self.window.findings.current() if self.window.findings else None
        if finding is None:
            raise ValueError(self.tr("No finding is selected."))
        self.why(finding)

    def why(self, finding: Finding) -> None:
        """Open the explanation of a finding."""
        from amp_studio.ui.findings.dialogs import WhyDialog

        WhyDialog(self._workspace(), finding, self._page().go_to, self.window).show()

    def suppress(self, finding: Finding) -> None:
        """Suppress a finding; asks for a reason and a name."""
        from amp_studio.ui.findings.dialogs import SuppressDialog

        workspace = self._workspace()
        dialog = SuppressDialog(finding, user(), self.window)
        if run_dialog(dialog):
            path = real_path(workspace.path).with_name(RULES_FILE)  # where rules are looked for
            notes: list[str] = []
            suppress(
                path,
                finding.rule,
                dialog.params(),
                reason=dialog.reason.text(),
                by=dialog.name.text(),
                notify=notes.append,
            )
            workspace.read_own_rules()
            self.window.show_status("; ".join([f"Suppression saved in {path}", *notes]))

    def fix(self, finding: Finding) -> None:
        """Apply the suggested fix of a finding as one step, if the finding still exists and its fix was tried."""
        if finding not in self._workspace().findings:
            raise ValueError(
                self.tr(
                    "This finding has changed or no longer exists. Select it again in the list of findings."
                )
            )
        workspace, wanted = self._workspace(), {r.address: r.value for r in finding.fix}
        workspace.edit(self.tr("Fix: {step_text}").format(step_text=workspace.step_text(wanted)), wanted)

    def fix_all(self, findings: Sequence[Finding]) -> None:
        """Apply the suggested fixes of several findings as one step, each in the light of those before it."""
        if len(findings) == 1:
            self.fix(findings[0])
            return
        workspace, keys = self._workspace(), {finding.key for finding in findings}
        wanted = partial(apply_fixes, workspace.validator, lambda finding: finding.key in keys)
        if not workspace.do(self.tr("Fix several"), wanted):
            raise ValueError(
                self.tr(
                    "These findings have changed or no longer exist. Select them again in the list of findings."
                )
            )

    def fix_several(self) -> None:
        """List every suggested fix, and apply the checked ones as one step."""
        from amp_studio.ui.findings.dialogs import FixSeveralDialog

        workspace = self._workspace()
        if not any(finding.fix for finding in workspace.listed):
            raise ValueError(self.tr("No finding has a suggested fix."))
        dialog = FixSeveralDialog(workspace, workspace.listed, self.window)
        if run_dialog(dialog) and (chosen := dialog.chosen()):
            self.fix_all(chosen)
        dialog.deleteLater()

    def fix_safe(self) -> None:
        """Apply every suggested fix that cannot change motion, as one step."""
        workspace = self._workspace()
        if not workspace.do(self.tr("Apply all safe fixes"), lambda: apply_all_safe(workspace.validator)):
            self.window.show_status(
                self.tr("There is no safe fix: no finding has a suggested fix that cannot change motion.")
            )
