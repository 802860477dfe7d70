"""The options menu: units of display and entry, control type, which axes are shown; and the step plot."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu

from amp_studio.schema import Value

from .workspace import Workspace

if TYPE_CHECKING:
    from .main_window import MainWindow


class ViewActions:
    """What is shown, and in which units; nothing here changes a value but the control type."""

    def __init__(self, window: MainWindow) -> None:
        self.window = window
        menu = window.menuBar().addMenu("&Options")
        self.units_menu = QMenu("&Units", window)
        self.machine_menu = QMenu("Control &Type", window)
        self.all_axes = window.action("Show &Unfitted Axes", self._show_columns, "Ctrl+U")
        self.all_axes.setCheckable(True)
        self.hidden_too = window.action("Show &Hidden Parameters", self._show_columns, "Ctrl+H")
        self.hidden_too.setCheckable(True)
        self.as_entered = window.action("Show Values &As Entered", self._show_units, None)
        self.as_entered.setCheckable(True)
        self.switch = window.action("Switch mm / inch", self._switch, "Ctrl+M")
        self.step_action = window.action("&Step Response…", self._step, "F9")
        menu.addMenu(self.units_menu)
        menu.addMenu(self.machine_menu)
        menu.addActions([self.switch, self.as_entered, self.all_axes, self.hidden_too])
        menu.addSeparator()
        menu.addAction(self.step_action)
        self.toolbar: list[QAction] = [self.switch, self.step_action]
        self._groups: list[QActionGroup] = []

    def follow(self, workspace: Workspace) -> None:
        """Fill the menus for a newly opened file."""
        self._groups = []
        file = workspace.file
        self._fill(self.units_menu, [(u, u.capitalize()) for u in file.schema.family.units], file.header.units, self._set_units)
        machines = [(m.key, m.name) for m in file.schema.family.machines]
        self._fill(self.machine_menu, machines, file.machine, self._set_machine)
        workspace.changed.connect(lambda _: self._check(self.machine_menu, file.machine))
        self._show_units()

    def _fill(self, menu: QMenu, entries: list[tuple[str, str]], present: str, act: object) -> None:
        menu.clear()
        group = QActionGroup(menu)
        self._groups.append(group)
        for key, name in entries:
            action = self.window.action(name, partial(act, key), None)  # type: ignore[arg-type]  # a bound method
            action.setCheckable(True)
            action.setData(key)
            action.setChecked(key == present)
            group.addAction(action)
            menu.addAction(action)

    def _check(self, menu: QMenu, key: str) -> None:
        for action in menu.actions():
            action.setChecked(action.data() == key)

    def _set_units(self, system: str) -> None:
        workspace = self.window.workspace
        assert workspace is not None
        workspace.file.header.units = system
        self._check(self.units_menu, system)
        self._show_units()

    def _switch(self) -> None:
        workspace = self.window.workspace
        assert workspace is not None
        systems = list(workspace.file.schema.family.units)
        self._set_units(systems[(systems.index(workspace.file.header.units) + 1) % len(systems)])

    def _set_machine(self, machine: str) -> None:
        workspace = self.window.workspace
        assert workspace is not None
        parameter = workspace.file.schema.family.machine_parameter
        if parameter:
            workspace.edit("Control type", {(parameter, ""): Value(machine)})
        else:
            workspace.file.header.machine = machine
            workspace.file.situation.forget()
            workspace.revalidate()

    def _show_units(self) -> None:
        workspace, table = self.window.workspace, self.window.table
        if workspace is None or table is None:
            return
        table.shown_units = None if self.as_entered.isChecked() else workspace.file.header.units
        workspace.revalidate()

    def _show_columns(self) -> None:
        table = self.window.table
        if table is not None:
            table.all_axes, table.hidden_too = self.all_axes.isChecked(), self.hidden_too.isChecked()
            table.show_again()

    def _step(self) -> None:
        from .step_view import StepView

        workspace = self.window.workspace
        assert workspace is not None
        StepView(workspace, self.window.selected(), self.window.go_to, self.window).show()
