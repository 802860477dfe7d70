"""The axis menu: name, configure type and servo, add, delete, copy, swap and compare, as far as the family can."""

from __future__ import annotations

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction

from amp_studio.files import (
    add_axis,
    axis_instances,
    axis_title,
    copy_axis,
    delete_axis,
    fitted_axes,
    places_offered,
    rename_axis,
    retype_axis,
    swap_axes,
    why_axes_are_fixed,
    why_letters_are_fixed,
    why_types_are_fixed,
)
from amp_studio.schema import AxisProfile
from amp_studio.ui.base.modal import run_dialog
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.dialogs.axis_dialogs import AddAxisDialog, AxisDialog
from amp_studio.ui.merge.axis_comparison import AxisComparison
from amp_studio.ui.window.studio_window import StudioWindow


class AxisActions(QObject):
    """Axis operations, each one step to undo. An action that a family cannot do is disabled; its tooltip has the reason."""

    def __init__(self, window: StudioWindow) -> None:
        super().__init__(window)
        self.window = window
        self.menu = menu = window.menuBar().addMenu(self.tr("&Axis"))
        menu.setToolTipsVisible(True)
        act, tr = window.action, self.tr
        self.name_action = act(tr("&Name Axis…"), self.name, "Ctrl+Shift+N", "edit")
        self.type_action = act(tr("Configure Axis &Type…"), self.configure_type, "Ctrl+T", "edit")
        self.servo_action = act(tr("Configure &Servo…"), self.configure_servo, "Ctrl+Shift+T", "edit")
        self.add_action = act(tr("&Add Axis…"), self.add, None, "edit")
        self.delete_action = act(tr("&Delete Axis…"), self.delete, None, "edit")
        self.copy_action = act(tr("&Copy Axis…"), self.copy, None, "edit")
        self.swap_action = act(tr("S&wap Axes…"), self.swap, None, "edit")
        self.compare_action = act(tr("Com&pare Axes…"), self.compare, None, "file")
        menu.addActions([self.name_action, self.type_action, self.servo_action])
        menu.addSeparator()
        menu.addActions([self.add_action, self.delete_action])
        menu.addSeparator()
        menu.addActions([self.copy_action, self.swap_action, self.compare_action])
        self._tips = {action: action.toolTip() for action in menu.actions()}

    # -- what the family can do --------------------------------------------------

    def enable(self, workspace: Workspace | None) -> None:
        """Enable what the family of the file in front can do, and give the reason for what it cannot."""
        if workspace is None:
            return
        for action, reason in self._reasons(workspace).items():
            action.setEnabled(action.isEnabled() and not reason)
            action.setToolTip(reason or self._tips[action])

    def _reasons(self, workspace: Workspace) -> dict[QAction, str]:
        schema, axes = workspace.file.schema, axis_instances(workspace.file)
        profile, fixed = schema.family.axes, why_axes_are_fixed(schema)
        servo = self.tr("{family} has no parameter for the servo of an axis").format(
            family=schema.family.name
        )
        full = self.tr("All {count} axes are there").format(count=len(axes))
        alone = (
            ""
            if len(axes) > 1
            else self.tr("{family} has one axis at most").format(family=schema.family.name)
        )
        return {
            self.name_action: why_letters_are_fixed(schema) if axes else fixed,
            self.type_action: why_types_are_fixed(schema),
            self.servo_action: "" if profile and (profile.hardware or profile.loop) else servo,
            self.add_action: fixed or ("" if places_offered(workspace.file) else full),
            self.delete_action: fixed,
            self.copy_action: alone,
            self.swap_action: alone,
            self.compare_action: alone,
        }

    # -- dialogs -------------------------------------------------------------------

    def _workspace(self) -> Workspace:
        workspace = self.window.workspace
        assert workspace is not None
        return workspace

    def _profile(self) -> AxisProfile:
        profile = self._workspace().file.schema.family.axes
        assert profile is not None  # the action is disabled without it
        return profile

    def _dialog(self, title: str) -> AxisDialog:
        """Return a dialog that offers the axis of the selected cell first."""
        workspace = self._workspace()
        address, axes = self.window.selected(), fitted_axes(workspace.file)
        here = axes[0] if axes else ""
        if address and address[1] in axes and workspace.file.evaluation.scope(address) == "axis":
            here = address[1]
        return AxisDialog(workspace, title, here, self.window)

    def _ask(self, title: str, parameter_ids: list[str]) -> None:
        workspace = self._workspace()
        dialog = self._dialog(title)
        dialog.ask_for(parameter_ids)
        if run_dialog(dialog):
            file = workspace.file
            workspace.edit(title, {a: file.read(a, text) for a, text in dialog.texts().items()})

    # -- what an axis is -----------------------------------------------------------

    def name(self) -> None:
        """Give an axis its name."""
        workspace, title = self._workspace(), self.tr("Name axis")
        profile = workspace.file.schema.family.axes
        if profile is not None:
            self._ask(title, [profile.name])
            return
        dialog = self._dialog(title)
        letter = dialog.ask_for_letter()
        if run_dialog(dialog):
            axis, name = dialog.axis(), letter.currentText()
            workspace.do(title, lambda: rename_axis(workspace.file, axis, name))

    def configure_type(self) -> None:
        """Make an axis linear, rotary, a spindle or unfitted; the units of its lengths change with it."""
        workspace, profile, title = self._workspace(), self._profile(), self.tr("Configure axis type")
        dialog = self._dialog(title)
        dialog.note.setText(
            self.tr(
                "The numbers stay the same; only the unit changes, from mm to degrees or from degrees to mm."
            )
        )
        dialog.ask_for([profile.type])
        if run_dialog(dialog):
            axis, text = dialog.axis(), dialog.texts()[(profile.type, dialog.axis())]
            key = str(workspace.file.read((profile.type, axis), text).value)
            workspace.do(title, lambda: retype_axis(workspace.file, axis, key))

    def configure_servo(self) -> None:
        """Choose servo hardware and loop type of an axis."""
        profile = self._profile()
        self._ask(self.tr("Configure servo"), [p for p in (profile.hardware, profile.loop) if p])

    # -- which axes there are ------------------------------------------------------

    def add(self) -> None:
        """Fit one more axis."""
        workspace = self._workspace()
        dialog = AddAxisDialog(workspace, self.window)
        if run_dialog(dialog):
            name, place = dialog.name(), dialog.place()
            workspace.do(
                self.tr("Add axis {name}").format(name=name), lambda: add_axis(workspace.file, name, place)
            )

    def delete(self) -> None:
        """Make an axis unfitted and set its values to their defaults."""
        workspace = self._workspace()
        dialog = self._dialog(self.tr("Delete axis"))
        dialog.note.setText(
            self.tr("The axis becomes unfitted and its values are set to their defaults. You can undo this.")
        )
        if run_dialog(dialog):
            axis = dialog.axis()
            name = axis_title(workspace.file, axis)
            workspace.do(
                self.tr("Delete axis {name}").format(name=name), lambda: delete_axis(workspace.file, axis)
            )

    # -- two axes --------------------------------------------------------------------

    def copy(self) -> None:
        """Copy the values of one axis to another of the same type."""
        workspace = self._workspace()
        dialog = self._dialog(self.tr("Copy axis"))
        target = dialog.ask_for_target(self.tr("&To axis"))
        dialog.note.setText(
            self.tr("All values of the axis are copied, except its name. Both axes must have the same type.")
        )
        if run_dialog(dialog):
            source, axis = dialog.axis(), str(target.currentData())
            step = self.tr("Copy axis {source} to {target}").format(source=source, target=axis)
            workspace.do(step, lambda: copy_axis(workspace.file, source, axis))

    def swap(self) -> None:
        """Let two axes change places."""
        workspace = self._workspace()
        dialog = self._dialog(self.tr("Swap axes"))
        other = dialog.ask_for_target(self.tr("&With axis"))
        dialog.note.setText(
            self.tr("The axes change places with all their values. What names an axis by its number follows.")
        )
        if run_dialog(dialog):
            first, second = dialog.axis(), str(other.currentData())
            step = self.tr("Swap axes {first} and {second}").format(first=first, second=second)
            workspace.do(step, lambda: swap_axes(workspace.file, first, second))

    def compare(self) -> None:
        """Show where two axes differ, side by side."""
        page, first = self.window.page, self._dialog("").axis()
        assert page is not None
        AxisComparison(page, first, self.window).show()
