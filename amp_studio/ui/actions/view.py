"""What the view menu does: units of display and entry, control type, what is shown, settings;
the motion window.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction

from amp_studio.files import ParameterFile, SavedVersion, saved_versions
from amp_studio.schema import Address, Value, why_not_simulated
from amp_studio.ui.base.loading import load
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import tr
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.window.studio_window import StudioWindow

if TYPE_CHECKING:
    from amp_studio.ui.motion.view import MotionView


# -- units and control type ------------------------------------------------


MOST_VERSIONS = 5
"""Earlier versions of a file under which a program is run."""


def set_units(window: StudioWindow, system: str) -> None:
    """Show the file in a system of units."""
    window.workspace_in_front.show_in(system)


def switch_units(window: StudioWindow) -> None:
    """Show the file in the next system of units of its family."""
    file = window.workspace_in_front.file
    systems = list(file.schema.family.units)
    set_units(window, systems[(systems.index(file.header.units) + 1) % len(systems)])


def show_as_entered(window: StudioWindow) -> None:
    """Show each value in the unit that it was entered in, or all in one system."""
    workspace = window.workspace_in_front
    workspace.show_in(None if window.menus["view.as_entered"].isChecked() else workspace.file.header.units)


def set_machine(window: StudioWindow, machine: str) -> None:
    """Make the file one of another machine type."""
    workspace = window.workspace_in_front
    parameter = workspace.file.schema.family.machine_parameter
    if parameter:
        workspace.edit(tr("Control type"), {(parameter, ""): Value(machine)})
    else:
        workspace.do(tr("Control type"), partial(workspace.file.set_machine, machine))


def units(window: StudioWindow) -> list[tuple[str, str]] | None:
    """Return the systems of units of the file in front with their names in the menu."""
    workspace = window.workspace
    return [(u, f"&{u.capitalize()}") for u in workspace.file.schema.family.units] if workspace else None


def machines(window: StudioWindow) -> list[tuple[str, str]] | None:
    """Return the machine types of the family in front with their names in the menu."""
    workspace = window.workspace
    return [(m.key, f"&{m.name}") for m in workspace.file.schema.family.machines] if workspace else None


# -- what is shown ---------------------------------------------------------


def show_columns(window: StudioWindow) -> None:
    """Show the columns and rows that the options want."""
    if window.page is not None:
        window.page.show_columns(
            window.menus["view.unfitted_axes"].isChecked(), window.menus["view.hidden"].isChecked()
        )


def show_secrets(window: StudioWindow) -> None:
    """Show passwords in clear text, or masked."""
    window.workspace_in_front.show_secrets(window.menus["view.secrets"].isChecked())


def show_secrets_where_some_are(window: StudioWindow, action: QAction) -> None:
    """Offer to show secrets for a family that has some."""
    if window.workspace is not None:
        action.setVisible(any(p.secret for p in window.workspace.file.schema.parameters.values()))


def apply_options(window: StudioWindow, page: FilePage) -> None:
    """Show a newly opened file as the options want it."""
    if window.menus["view.as_entered"].isChecked():
        page.workspace.show_in(None)
    page.show_columns(window.menus["view.unfitted_axes"].isChecked(), window.menus["view.hidden"].isChecked())


def to_table(window: StudioWindow) -> None:
    """Go to the table."""
    if window.table_view is not None:
        window.table_view.setFocus()


# -- settings ------------------------------------------------------------------


def open_settings(window: StudioWindow, page: str = "general") -> None:
    """Open the settings at one of their pages."""
    from amp_studio.ui.dialogs.settings_dialog import SettingsDialog

    opened = window.beside.again(SettingsDialog, asked=window.workspace)  # whose units it shows
    if opened is None:
        opened = SettingsDialog(window)
        window.beside.show(opened, asked=window.workspace)
    opened.show_page(page)


def open_keys(window: StudioWindow) -> None:
    """Open the settings at the list of all keys."""
    open_settings(window, "keys")


# -- motion --------------------------------------------------------------------


def show_motion(window: StudioWindow, action: QAction) -> None:
    """Show in the menu whether the family in front can be simulated;
    the key gives the reason where it cannot.
    """
    workspace = window.workspace
    family = workspace.file.schema.family if workspace else None
    reason = why_not_simulated(family) if family else ""
    missing = tr("&Motion (not for {family})") if reason else tr("&Motion")
    action.setText(missing.format(family=family.short or family.name) if family else missing)
    action.setIconText(tr("Motion"))
    action.setToolTip(reason or tr("Motion (F9)"))


def open_motion(window: StudioWindow) -> None:
    """Show the page on which the machine moves, or the values again;
    where its family cannot be simulated the page has the reason.
    """
    page = window.page_in_front
    if not window.leave_control() and page.shows_motion:
        page.show_motion(False)
        return
    if reason := why_not_simulated(page.workspace.file.schema.family):
        page.bar.say(reason)
        return
    workspace, address = page.workspace, window.selected()
    kind = in_background(window, tr("Loading the simulator"), partial(_motion_view, workspace.file.copy()))
    if page.motion is None:
        made = kind(workspace, address, page.go_to)
        made.left.connect(lambda: page.show_motion(False))
        page.take_motion(made)
    elif isinstance(page.motion, kind) and address is not None:
        page.motion.show_axis(address[1])
    page.show_motion(True)


def open_program(window: StudioWindow) -> None:
    """Open the window of blocks and programs of the file in front."""
    page = window.page_in_front
    if not page.workspace.file.schema.program.page:
        page.bar.say(tr("No page here prints how the blocks of this control are read."))
        return
    load("amp_studio.sim", "amp_studio.programs", "amp_studio.ui.motion.program_window")
    from amp_studio.ui.motion.program_window import ProgramWindow

    workspace = page.workspace
    if (opened := window.beside.again(ProgramWindow, workspace)) is not None:
        opened.run_again()
        return

    def read() -> ParameterFile:
        return workspace.file.copy()

    def apply(values: Mapping[Address, Value]) -> bool:
        return workspace.edit(tr("Take from the program"), values)

    def earlier() -> list[SavedVersion]:
        document = workspace.document
        return list(saved_versions(document.as_saved(), document.history(), MOST_VERSIONS))

    window.beside.show(ProgramWindow(read, apply, window, earlier=earlier), workspace)


def _motion_view(file: ParameterFile) -> type[MotionView]:
    """Load the view with the plots, and the simulator with what it knows of the family of a file.
    For a thread.
    """
    load("amp_studio.sim", "amp_studio.ui.motion.view")
    from amp_studio.sim import listing
    from amp_studio.ui.motion.view import MotionView

    listing(file)

    return MotionView
