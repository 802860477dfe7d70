"""The options menu: units of display and entry, control type, what is shown, the panels; and the motion window."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu

from amp_studio.files import ParameterFile
from amp_studio.schema import Value, why_not_simulated
from amp_studio.ui.base.loading import load
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import Translated, tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.window.studio_window import StudioWindow

if TYPE_CHECKING:
    from amp_studio.ui.motion.view import MotionView


class ViewActions(Translated):
    """What is shown, and in which units; only the control type changes values."""

    def __init__(self, window: StudioWindow) -> None:
        self.window = window
        act = window.action
        self.menu = menu = window.menuBar().addMenu(tr("&View"))
        self.units_menu, self.machine_menu = (
            QMenu(self.tr("&Units"), window),
            QMenu(self.tr("Control &Type"), window),
        )
        self._groups: list[QActionGroup] = []
        self.switch = act(
            self.tr("S&witch mm / inch"),
            self._switch,
            "Ctrl+M",
            "units",
            "ruler",
            self.tr("mm / inch"),
        )
        self.as_entered = self._option(self.tr("Show Values &As Entered"), self._show_as_entered, "Ctrl+E")
        self.all_axes = self._option(self.tr("Show Un&fitted Axes"), self._show_columns, "Ctrl+U")
        self.hidden_too = self._option(self.tr("Show &Hidden Parameters"), self._show_columns, "Ctrl+H")
        self.secrets = self._option(self.tr("Show Se&crets"), self._show_secrets)
        self.secrets.setToolTip(self.tr("Show passwords in clear text, also in exports"))
        self.motion_action = act(
            self.tr("&Motion…"), self._motion, "F9", "file", "activity", self.tr("Motion")
        )
        menu.addMenu(self.units_menu)
        menu.addMenu(self.machine_menu)
        menu.addActions([self.switch, self.as_entered, self.all_axes, self.hidden_too, self.secrets])
        menu.addSeparator()
        self.panels = panels = menu.addMenu(self.tr("&Go To"))
        for n, (title, panel) in enumerate(
            (
                (self.tr("&Groups"), "Groups"),
                (self.tr("&Parameter Help"), "Parameter"),
                (self.tr("&Findings"), "Findings"),
            ),
            2,
        ):
            panels.addAction(act(title, partial(window.docks.toggle, panel), f"Ctrl+{n}"))
        panels.insertAction(panels.actions()[0], act(self.tr("&Table"), self._to_table, "Ctrl+1"))
        menu.addSeparator()
        tabs = window.tabs
        self.beside = act(self.tr("Show File &Beside"), tabs.move_across, "Ctrl+\\")
        menu.addActions([
            act(self.tr("Ne&xt File"), partial(tabs.turn, 1), "Ctrl+Tab"),
            act(self.tr("Pre&vious File"), partial(tabs.turn, -1), "Ctrl+Shift+Tab"),
            self.beside,
        ])  # fmt: skip
        menu.addSeparator()
        menu.addAction(self.motion_action)
        self.toolbar: list[QAction] = [self.motion_action]

    def _option(self, text: str, act: Callable[[], None], shortcut: str | None = None) -> QAction:
        action = self.window.action(text, act, shortcut)
        action.setCheckable(True)
        return action

    def apply_options(self, page: FilePage) -> None:
        """Show a newly opened file as the options want it."""
        if self.as_entered.isChecked():
            page.workspace.show_in(None)
        page.show_columns(self.all_axes.isChecked(), self.hidden_too.isChecked())

    def follow(self, workspace: Workspace) -> None:
        """Fill the menus for the file that comes to the front."""
        for group in self._groups:
            group.deleteLater()  # with its actions
        family, file = workspace.file.schema.family, workspace.file
        units = [(u, f"&{u.capitalize()}") for u in family.units]
        machines = [(m.key, f"&{m.name}") for m in family.machines]
        self._groups = [
            self._fill(self.units_menu, units, file.header.units, self._set_units),
            self._fill(self.machine_menu, machines, file.machine, self._set_machine),
        ]
        self.machine_menu.setEnabled(workspace.may_edit)
        self.secrets.setVisible(any(p.secret for p in file.schema.parameters.values()))
        self.check(workspace)

    def _fill(
        self, menu: QMenu, entries: list[tuple[str, str]], present: str, choose: Callable[[str], None]
    ) -> QActionGroup:
        menu.clear()
        group = QActionGroup(menu)
        for key, name in entries:
            action = QAction(name, group)
            action.setCheckable(True)
            action.setData(key)
            action.setChecked(key == present)
            action.triggered.connect(
                lambda *_, key=key: self.window.guarded(partial(choose, key), menu.title().replace("&", ""))
            )
            menu.addAction(action)
        return group

    def check(self, workspace: Workspace | None) -> None:
        """Check the present options; an undo may have changed them, and another file has its own."""
        self._show_motion(workspace)
        table = self.window.table
        for n, group in enumerate(self._groups):  # units, control types
            group.setEnabled(workspace is not None and (n == 0 or workspace.may_edit))
        if workspace is None or table is None or not self._groups:
            return
        for group, present in zip(
            self._groups, (workspace.file.header.units, workspace.file.machine), strict=True
        ):
            for action in group.actions():
                action.setChecked(action.data() == present)
        self.as_entered.setChecked(workspace.as_entered)
        self.secrets.setChecked(workspace.secrets)
        self.all_axes.setChecked(table.all_axes)
        self.hidden_too.setChecked(table.hidden_too)

    def _workspace(self) -> Workspace:
        workspace = self.window.workspace
        assert workspace is not None
        return workspace

    # -- units and control type ------------------------------------------------

    def _set_units(self, system: str) -> None:
        self._workspace().show_in(system)

    def _switch(self) -> None:
        file = self._workspace().file
        systems = list(file.schema.family.units)
        self._set_units(systems[(systems.index(file.header.units) + 1) % len(systems)])

    def _show_as_entered(self) -> None:
        workspace = self._workspace()
        workspace.show_in(None if self.as_entered.isChecked() else workspace.file.header.units)

    def _set_machine(self, machine: str) -> None:
        workspace = self._workspace()
        parameter = workspace.file.schema.family.machine_parameter
        if parameter:
            workspace.edit(self.tr("Control type"), {(parameter, ""): Value(machine)})
        else:
            workspace.do(self.tr("Control type"), partial(workspace.file.set_machine, machine))
        self.check(workspace)

    # -- what is shown ---------------------------------------------------------

    def _show_columns(self) -> None:
        if self.window.page is not None:
            self.window.page.show_columns(self.all_axes.isChecked(), self.hidden_too.isChecked())

    def _show_secrets(self) -> None:
        self._workspace().show_secrets(self.secrets.isChecked())

    def _to_table(self) -> None:
        if self.window.table_view is not None:
            self.window.table_view.setFocus()

    def _show_motion(self, workspace: Workspace | None) -> None:
        """Show in the menu whether the family in front can be simulated; the key gives the reason where it cannot."""
        family = workspace.file.schema.family if workspace else None
        reason, action = why_not_simulated(family) if family else "", self.motion_action
        missing = self.tr("&Motion… (not for {family})") if reason else self.tr("&Motion…")
        action.setText(missing.format(family=family.short or family.name) if family else missing)
        action.setIconText(self.tr("Motion"))
        action.setToolTip(reason or self.tr("Motion (F9)"))

    def _motion(self) -> None:
        page = self.window.page
        assert page is not None
        if reason := why_not_simulated(page.workspace.file.schema.family):
            page.bar.say(reason)
            return
        view = in_background(
            self.window, self.tr("Loading the simulator"), partial(_motion_view, page.workspace.file.copy())
        )
        view(page.workspace, self.window.selected(), page.go_to, self.window).show()


def _motion_view(file: ParameterFile) -> type[MotionView]:
    """Load the view with the plots, and the simulator with what it knows of the family of a file. For a thread."""
    load("amp_studio.sim", "amp_studio.ui.motion.view")
    from amp_studio.sim import listing
    from amp_studio.ui.motion.view import MotionView

    listing(file)

    return MotionView
