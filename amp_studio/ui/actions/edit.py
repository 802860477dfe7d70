"""What the edit menu does: undo, values by keyboard and by number, suggested fixes."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from PySide6.QtGui import QAction, QUndoStack
from PySide6.QtWidgets import QMessageBox

from amp_studio.files import RangeError, describe, real_path, user
from amp_studio.schema import Address, InvalidValueError
from amp_studio.ui.base.modal import run_dialog
from amp_studio.ui.base.questions import ask, show_message
from amp_studio.ui.base.translated import Translated, tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.window.studio_window import StudioWindow
from amp_studio.validate import RULES_FILE, Finding, apply_all_safe, apply_fixes, calculators, suppress

from .range import RangeEdits


class Edits(Translated):
    """Everything that changes a value."""

    def __init__(self, window: StudioWindow) -> None:
        self.window = window
        self.range = RangeEdits(window)

    # -- one value -------------------------------------------------------------

    def commit(self, address: Address, text: str) -> bool:
        """Set a value of the file in front from typed text."""
        return self.commit_to(self.window.workspace_in_front, address, text)

    def commit_to(self, workspace: Workspace, address: Address, text: str) -> bool:
        """Set a value from typed text; asks before a value out of range is forced.
        Returns whether it was set.
        """
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
            "{problem}.\n\nNothing was changed. A forced value is marked in the file, the findings and the"
            " report."
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

    def undo(self) -> None:
        """Take the last step back."""
        self.window.workspace_in_front.undo_stack.undo()

    def redo(self) -> None:
        """Make the step again that was taken back."""
        self.window.workspace_in_front.undo_stack.redo()

    def edit(self) -> None:
        """Edit the current cell."""
        view = self.window.table_view
        if view is not None:
            view.setFocus()
            view.edit_current()

    def edit_notes(self) -> None:
        """Edit the notes about the selected value, its group and the machine."""
        from amp_studio.ui.dialogs.note_dialog import NoteDialog

        dialog = NoteDialog(self.window.workspace_in_front, self.window.selected(), self.window)
        if run_dialog(dialog):
            dialog.write()

    def steps(self) -> None:
        """Show the steps that were made, to go back to one."""
        from amp_studio.ui.page.step_list import StepList

        workspace, beside = self.window.workspace_in_front, self.window.beside
        if beside.again(StepList, workspace) is None:
            beside.show(StepList(workspace, self.window), workspace)

    # -- by number, by name ----------------------------------------------------

    def quick_edit(self) -> None:
        """Open quick edit by number."""
        from amp_studio.ui.table.quick_edit import QuickEdit

        page, beside = self.window.page_in_front, self.window.beside
        if beside.again(QuickEdit, page.workspace) is None:
            commit = partial(self.commit_to, page.workspace)
            beside.show(QuickEdit(page.table, commit, page.go_to, self.window), page.workspace)

    def calculator(self) -> None:
        """Open the calculators, with the formulas of the selected parameter first."""
        from amp_studio.ui.dialogs.calculator_dialog import CalculatorDialog

        workspace = self.window.workspace_in_front
        if not calculators(workspace.file.schema.family.family):
            raise ValueError(
                self.tr("No formulas are published for {name}.").format(
                    name=workspace.file.schema.family.name
                )
            )
        address, beside = self.window.selected(), self.window.beside
        if beside.again(CalculatorDialog, workspace, address) is None:  # its result goes to that value
            commit = partial(self.commit_to, workspace)
            beside.show(CalculatorDialog(workspace, address, commit, self.window), workspace, address)

    def tables(self) -> None:
        """Open the manual's tables, with those of the selected parameter first."""
        from amp_studio.ui.dialogs.tables_dialog import TablesDialog

        page, address, beside = self.window.page_in_front, self.window.selected(), self.window.beside
        if beside.again(TablesDialog, page.workspace, address) is None:
            dialog = TablesDialog(page.workspace, address, self.window)
            dialog.linked.connect(page.follow)
            beside.show(dialog, page.workspace, address)

    # -- findings ---------------------------------------------------------------

    def fix_selected(self) -> None:
        """Apply the suggested fixes of the selected findings."""
        findings = self.window.findings.current_findings() if self.window.findings else ()
        able = tuple(finding for finding in findings if finding.fix)
        if not able:
            raise ValueError(
                self.tr("The selected finding has no suggested fix. Show it to see the parameters to check.")
            )
        self.fix_all(able)

    def explain_selected(self) -> None:
        """Open the explanation of the selected finding."""
        finding = self.window.findings.current() if self.window.findings else None
        if finding is None:
            raise ValueError(self.tr("No finding is selected."))
        self.why(finding)

    def why(self, finding: Finding) -> None:
        """Open the explanation of a finding."""
        from amp_studio.ui.findings.dialogs import WhyDialog

        page = self.window.page_in_front
        self.window.beside.show(WhyDialog(page.workspace, finding, page.go_to, self.window), page.workspace)

    def suppress(self, finding: Finding) -> None:
        """Suppress a finding; asks for a reason and a name."""
        from amp_studio.ui.findings.dialogs import SuppressDialog

        workspace = self.window.workspace_in_front
        dialog = SuppressDialog(workspace.file, finding, user(), self.window)
        if run_dialog(dialog):
            path = real_path(workspace.path).with_name(RULES_FILE)  # where rules are looked for
            notes: list[str] = []
            suppress(
                path,
                finding.rule,
                dialog.params(),
                reason=dialog.form.answer("reason"),
                by=dialog.form.answer("name"),
                notify=notes.append,
            )
            workspace.read_own_rules()
            self.window.show_status("; ".join([f"Suppression saved in {path}", *notes]))

    def fix(self, finding: Finding) -> None:
        """Apply the suggested fix of a finding as one step,
        if the finding still exists and its fix was tried.
        """
        if finding not in self.window.workspace_in_front.findings:
            raise ValueError(
                self.tr(
                    "This finding has changed or no longer exists. Select it again in the list of findings."
                )
            )
        workspace, wanted = self.window.workspace_in_front, {r.address: r.value for r in finding.fix}
        workspace.edit(self.tr("Fix: {step_text}").format(step_text=workspace.step_text(wanted)), wanted)

    def fix_all(self, findings: Sequence[Finding]) -> None:
        """Apply the suggested fixes of several findings as one step, each in the light of those before it."""
        if len(findings) == 1:
            self.fix(findings[0])
            return
        workspace, keys = self.window.workspace_in_front, {finding.key for finding in findings}
        wanted = partial(
            apply_fixes, workspace.validator, lambda finding: finding.key in keys, even_doubtful=True
        )
        if not workspace.do(self.tr("Fix several"), wanted):
            raise ValueError(
                self.tr(
                    "These findings have changed or no longer exist. Select them again in the list of"
                    " findings."
                )
            )

    def fix_several(self) -> None:
        """List every suggested fix, and apply the checked ones as one step."""
        from amp_studio.ui.findings.dialogs import FixSeveralDialog

        workspace = self.window.workspace_in_front
        if not any(finding.fix for finding in workspace.listed):
            raise ValueError(self.tr("No finding has a suggested fix."))
        dialog = FixSeveralDialog(workspace, workspace.listed, self.window)
        if run_dialog(dialog) and (chosen := dialog.chosen()):
            self.fix_all(chosen)
        dialog.deleteLater()

    def fix_safe(self) -> None:
        """Apply every suggested fix that cannot change motion, as one step."""
        workspace = self.window.workspace_in_front
        if not workspace.do(self.tr("Apply all safe fixes"), lambda: apply_all_safe(workspace.validator)):
            self.window.show_status(
                self.tr("There is no safe fix: no finding has a suggested fix that cannot change motion.")
            )


def show_undo(window: StudioWindow, action: QAction) -> None:
    """Name in the menu the step that would be taken back."""
    stack = _stack(window)
    _name_step(action, tr("&Undo"), stack.undoText() if stack is not None and stack.canUndo() else "")


def show_redo(window: StudioWindow, action: QAction) -> None:
    """Name in the menu the step that would be made again."""
    stack = _stack(window)
    _name_step(action, tr("&Redo"), stack.redoText() if stack is not None and stack.canRedo() else "")


def _stack(window: StudioWindow) -> QUndoStack | None:
    workspace = window.workspace
    return workspace.undo_stack if workspace is not None and workspace.may_edit else None


def _name_step(action: QAction, name: str, step: str) -> None:
    action.setText(f"{name} {step.replace('&', '&&')}".rstrip())
