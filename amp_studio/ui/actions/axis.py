"""What the axis menu does: name, configure type and servo, add, delete, copy, swap and compare,
as far as the family can.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

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
from amp_studio.ui.base.translated import message_in_words, tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.window.studio_window import StudioWindow

if TYPE_CHECKING:
    from amp_studio.ui.dialogs.axis_dialogs import AxisDialog

# -- what the family can do --------------------------------------------------


def why_no_name(workspace: Workspace) -> str:
    """Return why the axes have their names for good; empty where they can have others, as in all of these."""
    schema = workspace.file.schema
    why = why_letters_are_fixed(schema) if axis_instances(workspace.file) else why_axes_are_fixed(schema)
    return message_in_words(why)


def why_no_type(workspace: Workspace) -> str:
    """Return why the types of axes are fixed."""
    return message_in_words(why_types_are_fixed(workspace.file.schema))


def why_no_servo(workspace: Workspace) -> str:
    """Return why the servo of an axis cannot be configured."""
    family = workspace.file.schema.family
    if family.axes and (family.axes.hardware or family.axes.loop):
        return ""
    return tr("{family} has no parameter for the servo of an axis").format(family=family.name)


def why_full(workspace: Workspace) -> str:
    """Return why no axis can be added."""
    if fixed := why_axes_are_fixed(workspace.file.schema):
        return message_in_words(fixed)
    full = tr("All {count} axes are there")
    return "" if places_offered(workspace.file) else full.format(count=len(axis_instances(workspace.file)))


def why_none_less(workspace: Workspace) -> str:
    """Return why no axis can be deleted."""
    return message_in_words(why_axes_are_fixed(workspace.file.schema))


def why_no_other(workspace: Workspace) -> str:
    """Return why there is no second axis to copy to, to swap or compare with."""
    if len(axis_instances(workspace.file)) > 1:
        return ""
    return tr("{family} has one axis at most").format(family=workspace.file.schema.family.name)


# -- dialogs -------------------------------------------------------------------


def _profile(window: StudioWindow) -> AxisProfile:
    profile = window.workspace_in_front.file.schema.family.axes
    assert profile is not None  # the action is disabled without it
    return profile


def _axis_here(window: StudioWindow) -> str:
    """Return the axis of the selected cell, else the first one; empty without axes."""
    file, address = window.workspace_in_front.file, window.selected()
    axes = fitted_axes(file)
    if address and address[1] in axes and file.evaluation.scope(address) == "axis":
        return address[1]
    return axes[0] if axes else ""


def _dialog(window: StudioWindow, title: str, hint: str = "") -> AxisDialog:
    """Return a dialog that offers the axis of the selected cell first."""
    from amp_studio.ui.dialogs.axis_dialogs import AxisDialog

    return AxisDialog(window.workspace_in_front, title, _axis_here(window), window, hint)


def _ask(window: StudioWindow, title: str, parameter_ids: list[str]) -> None:
    workspace = window.workspace_in_front
    dialog = _dialog(window, title)
    dialog.ask_for(parameter_ids)
    if run_dialog(dialog):
        file = workspace.file
        workspace.edit(title, {a: file.read(a, text) for a, text in dialog.texts().items()})


# -- what an axis is -----------------------------------------------------------


def name(window: StudioWindow) -> None:
    """Give an axis its name."""
    workspace, title = window.workspace_in_front, tr("Name Axis")
    profile = workspace.file.schema.family.axes
    if profile is not None:
        _ask(window, title, [profile.name])
        return
    dialog = _dialog(window, title)
    dialog.ask_for_letter()
    if run_dialog(dialog):
        axis, name = dialog.axis(), dialog.form.answer("letter")
        workspace.do(title, lambda: rename_axis(workspace.file, axis, name))


def configure_type(window: StudioWindow) -> None:
    """Make an axis linear, rotary, a spindle or unfitted; the units of its lengths change with it."""
    workspace, profile, title = window.workspace_in_front, _profile(window), tr("Configure Axis Type")
    hint = tr("The numbers stay the same; only the unit changes, from mm to degrees or from degrees to mm.")
    dialog = _dialog(window, title, hint)
    dialog.ask_for([profile.type])
    if run_dialog(dialog):
        axis, text = dialog.axis(), dialog.texts()[(profile.type, dialog.axis())]
        key = str(workspace.file.read((profile.type, axis), text).value)
        workspace.do(title, lambda: retype_axis(workspace.file, axis, key))


def configure_servo(window: StudioWindow) -> None:
    """Choose servo hardware and loop type of an axis."""
    profile = _profile(window)
    _ask(window, tr("Configure Servo"), [p for p in (profile.hardware, profile.loop) if p])


# -- which axes there are ------------------------------------------------------


def add(window: StudioWindow) -> None:
    """Fit one more axis."""
    from amp_studio.ui.dialogs.axis_dialogs import AddAxisDialog

    workspace = window.workspace_in_front
    dialog = AddAxisDialog(workspace, window)
    if run_dialog(dialog):
        name, place = dialog.form.answer("letter"), dialog.form.answer("place")
        workspace.do(tr("Add axis {name}").format(name=name), lambda: add_axis(workspace.file, name, place))


def delete(window: StudioWindow) -> None:
    """Make an axis unfitted and set its values to their defaults."""
    workspace = window.workspace_in_front
    hint = tr("The axis becomes unfitted and its values are set to their defaults. You can undo this.")
    dialog = _dialog(window, tr("Delete Axis"), hint)
    if run_dialog(dialog):
        axis = dialog.axis()
        name = axis_title(workspace.file, axis)
        workspace.do(tr("Delete axis {name}").format(name=name), lambda: delete_axis(workspace.file, axis))


# -- two axes --------------------------------------------------------------------


def copy(window: StudioWindow) -> None:
    """Copy the values of one axis to another of the same type."""
    workspace = window.workspace_in_front
    hint = tr("All values of the axis are copied, except its name. Both axes must have the same type.")
    dialog = _dialog(window, tr("Copy Axis"), hint)
    dialog.ask_for_target(tr("&To axis"))
    if run_dialog(dialog):
        source, axis = dialog.axis(), dialog.form.answer("target")
        step = tr("Copy axis {source} to {target}").format(source=source, target=axis)
        workspace.do(step, lambda: copy_axis(workspace.file, source, axis))


def swap(window: StudioWindow) -> None:
    """Let two axes change places."""
    workspace = window.workspace_in_front
    hint = tr("The axes change places with all their values. What names an axis by its number follows.")
    dialog = _dialog(window, tr("Swap Axes"), hint)
    dialog.ask_for_target(tr("&With axis"))
    if run_dialog(dialog):
        first, second = dialog.axis(), dialog.form.answer("target")
        step = tr("Swap axes {first} and {second}").format(first=first, second=second)
        workspace.do(step, lambda: swap_axes(workspace.file, first, second))


def compare(window: StudioWindow) -> None:
    """Show where two axes differ, side by side."""
    page, first = window.page_in_front, _axis_here(window)
    from amp_studio.ui.merge.axis_comparison import AxisComparison

    if window.beside.again(AxisComparison, page.workspace, first) is None:
        window.beside.show(AxisComparison(page, first, window), page.workspace, first)
