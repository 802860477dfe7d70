"""The axis menu of the old editor: select, name, configure type and servo, copy, delete."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from amp_studio.files import Change, copy_axis, delete_axis, fitted_axes, retype_axis
from amp_studio.schema.model import AxisProfile

from .axis_dialogs import AxisDialog
from .workspace import Workspace

if TYPE_CHECKING:
    from .main_window import MainWindow


class AxisActions:
    """Axis operations, each one step to undo."""

    def __init__(self, window: MainWindow) -> None:
        self.window = window
        menu = window.menuBar().addMenu("&Axis")
        act = window.action
        menu.addActions([
            act("&Name Axis…", self.name, None),
            act("Confi&gure Axis Type…", self.configure_type, None),
            act("Configure &Servo…", self.configure_servo, None),
        ])  # fmt: skip
        menu.addSeparator()
        menu.addActions([act("&Copy Axis…", self.copy, None), act("&Delete Axis…", self.delete, None)])

    def _workspace(self) -> tuple[Workspace, AxisProfile]:
        workspace = self.window.workspace
        assert workspace is not None
        profile = workspace.file.schema.family.axes
        if profile is None:
            raise ValueError(f"{workspace.file.schema.family.name} has no axes to configure")
        return workspace, profile

    def _here(self, workspace: Workspace) -> str:
        address = self.window.selected()
        axes = fitted_axes(workspace.file)
        return address[1] if address and address[1] in axes else axes[0] if axes else ""

    def _ask(self, title: str, parameter_ids: list[str]) -> None:
        workspace, _ = self._workspace()
        dialog = AxisDialog(workspace, title, self._here(workspace), self.window)
        dialog.ask_for(parameter_ids)
        if dialog.exec():
            file = workspace.file
            workspace.edit(title, {a: file.read(a, text) for a, text in dialog.texts().items()})

    def name(self) -> None:
        """Give an axis its name."""
        self._ask("Name Axis", [self._workspace()[1].name])

    def configure_type(self) -> None:
        """Make an axis linear, rotary, a spindle or unfitted; its lengths become angles or lengths with it."""
        workspace, profile = self._workspace()
        dialog = AxisDialog(workspace, "Configure Axis Type", self._here(workspace), self.window)
        dialog.ask_for([profile.type])
        if dialog.exec():
            for address, text in dialog.texts().items():
                key = str(workspace.file.read(address, text).value)
                self._push("Configure axis type", lambda address=address, key=key: retype_axis(workspace.file, address[1], key))

    def configure_servo(self) -> None:
        """Choose servo hardware and loop type of an axis."""
        profile = self._workspace()[1]
        self._ask("Configure Servo", [p for p in (profile.hardware, profile.loop) if p])

    def copy(self) -> None:
        """Copy the values of one axis to another of the same type."""
        workspace, _ = self._workspace()
        dialog = AxisDialog(workspace, "Copy Axis", self._here(workspace), self.window)
        target = dialog.ask_for_target()
        dialog.note.setText("Every per-axis value of all groups is copied; the name stays. Both axes must be of one type.")
        if dialog.exec():
            self._push("Copy axis", lambda: copy_axis(workspace.file, dialog.axis(), str(target.currentData())))

    def delete(self) -> None:
        """Make an axis unfitted, with its values at their defaults."""
        workspace, _ = self._workspace()
        dialog = AxisDialog(workspace, "Delete Axis", self._here(workspace), self.window)
        dialog.note.setText("The axis becomes unfitted and its values go back to their defaults. You can undo it.")
        if dialog.exec():
            self._push("Delete axis", lambda: delete_axis(workspace.file, dialog.axis()))

    def _push(self, text: str, operation: Callable[[], list[Change]]) -> None:
        workspace, _ = self._workspace()
        workspace.push(text, operation())
