"""The axis menu of the old editor: select, name, configure type and servo, copy, delete."""

from __future__ import annotations

from amp_studio.files import axis_title, copy_axis, delete_axis, fitted_axes, retype_axis
from amp_studio.schema.model import AxisProfile

from .axis_dialogs import AxisDialog
from .studio_window import StudioWindow
from .workspace import Workspace


class AxisActions:
    """Axis operations, each one step to undo."""

    def __init__(self, window: StudioWindow) -> None:
        self.window = window
        menu = window.menuBar().addMenu("&Axis")
        act = window.action
        menu.addActions([
            act("&Name Axis…", self.name, "Ctrl+Shift+N", "axes"),
            act("Configure Axis &Type…", self.configure_type, "Ctrl+T", "axes"),
            act("Configure &Servo…", self.configure_servo, "Ctrl+Shift+T", "axes"),
        ])  # fmt: skip
        menu.addSeparator()
        menu.addActions([
            act("&Copy Axis…", self.copy, None, "axes"),
            act("&Delete Axis…", self.delete, None, "axes"),
        ])  # fmt: skip

    def _workspace(self) -> tuple[Workspace, AxisProfile]:
        workspace = self.window.workspace
        assert workspace is not None
        profile = workspace.file.schema.family.axes
        if profile is None:
            raise ValueError(f"{workspace.file.schema.family.name} has no axes to configure")
        return workspace, profile

    def _dialog(self, title: str) -> AxisDialog:
        """Return a dialog that offers the axis of the selected cell first."""
        workspace, _ = self._workspace()
        address, axes = self.window.selected(), fitted_axes(workspace.file)
        here = axes[0] if axes else ""
        if address and address[1] in axes and workspace.file.evaluation.scope(address) == "axis":
            here = address[1]
        return AxisDialog(workspace, title, here, self.window)

    def _ask(self, title: str, parameter_ids: list[str]) -> None:
        workspace, _ = self._workspace()
        dialog = self._dialog(title)
        dialog.ask_for(parameter_ids)
        if dialog.exec():
            file = workspace.file
            workspace.edit(title, {a: file.read(a, text) for a, text in dialog.texts().items()})

    def name(self) -> None:
        """Give an axis its name."""
        self._ask("Name axis", [self._workspace()[1].name])

    def configure_type(self) -> None:
        """Make an axis linear, rotary, a spindle or unfitted; the units of its lengths change with it."""
        workspace, profile = self._workspace()
        dialog = self._dialog("Configure axis type")
        dialog.note.setText(
            "The numbers stay the same; only the unit changes, from mm to degrees or from degrees to mm."
        )
        dialog.ask_for([profile.type])
        if dialog.exec():
            axis, text = dialog.axis(), dialog.texts()[(profile.type, dialog.axis())]
            key = str(workspace.file.read((profile.type, axis), text).value)
            workspace.do("Configure axis type", lambda: retype_axis(workspace.file, axis, key))

    def configure_servo(self) -> None:
        """Choose servo hardware and loop type of an axis."""
        profile = self._workspace()[1]
        self._ask("Configure servo", [p for p in (profile.hardware, profile.loop) if p])

    def copy(self) -> None:
        """Copy the values of one axis to another of the same type."""
        workspace, _ = self._workspace()
        dialog = self._dialog("Copy axis")
        target = dialog.ask_for_target()
        dialog.note.setText(
            "All values of the axis are copied, except its name. Both axes must have the same type."
        )
        if dialog.exec():
            source, axis = dialog.axis(), str(target.currentData())
            workspace.do(f"Copy axis {source} to {axis}", lambda: copy_axis(workspace.file, source, axis))

    def delete(self) -> None:
        """Make an axis unfitted and set its values to their defaults."""
        workspace, _ = self._workspace()
        dialog = self._dialog("Delete axis")
        dialog.note.setText(
            "The axis becomes unfitted and its values are set to their defaults. You can undo this."
        )
        if dialog.exec():
            axis = dialog.axis()
            name = axis_title(workspace.file, axis)
            workspace.do(f"Delete axis {name}", lambda: delete_axis(workspace.file, axis))
