"""What the view menu does: units of display and entry, control type, what is shown, settings."""

from __future__ import annotations

from functools import partial

from PySide6.QtGui import QAction

from amp_studio.schema import Value
from amp_studio.ui.base.translated import tr
from amp_studio.ui.page.file_page import FilePage
from amp_studio.ui.window.studio_window import StudioWindow

# -- units and control type ------------------------------------------------


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
