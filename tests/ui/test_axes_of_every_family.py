"""The axis menu on families whose axes have no types, through the real window."""

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtWidgets import QComboBox

from amp_studio.files import Document, content_of, fitted_axes, new_file
from amp_studio.schema import Value
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.dialogs.axis_dialogs import AddAxisDialog, AxisDialog
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.merge.axis_comparison import AxisComparison
from amp_studio.ui.table.parameter_table import CONTROL

from .conftest import action


@pytest.fixture
def opened(window_with: Callable[..., MainWindow]) -> Callable[..., MainWindow]:
    """Return what opens a new file of a family with some axes."""
    return lambda family, axes: window_with(content_of(new_file(family, None, axes.split(","))))


def choose(dialog: AxisDialog, axis: str, other: str) -> None:
    """Choose an axis, and another one or a letter."""
    dialog.form.set_answer("axis", axis)
    second = next(b for b in dialog.findChildren(QComboBox) if b is not dialog.form.editors["axis"])
    at = second.findData(other)
    second.setCurrentIndex(at if at >= 0 else second.findText(other))


def heads(window: MainWindow) -> list[str]:
    """Return the heads of the axis columns."""
    return [
        title
        for title, column in zip(window.table.titles, window.table.columns, strict=True)
        if column != CONTROL
    ]


@pytest.mark.parametrize(
    ("family", "axes", "parameter", "titles"),
    [
        ("num", "X,Y,B", "servo.max_speed", ["X 0 linear", "Y 1 linear", "B 2 rotary"]),
        ("acromill", "X,Y", "axes.pulses_per_unit", ["X", "Y"]),
        ("57c422b", "X,Y", "setup.encoder", ["X", "Y"]),
        ("grblhal", "X,Y,Z", "axis.max_rate", ["X linear", "Y linear", "Z linear"]),
        ("syntec", "X,Z", "axis.type", ["X 1 linear", "Z 2 linear"]),
    ],
)
def test_heads_have_letters_and_unfitted_axes_are_hidden(
    opened, family: str, axes: str, parameter: str, titles: list[str]
) -> None:
    window = opened(family, axes)
    window.follow(parameter)
    assert heads(window) == titles


def test_the_values_of_a_num_axis_are_copied_and_two_change_places(opened, accept) -> None:
    window = opened("num", "X,Y,B")
    file = window.workspace.file
    window.edits.commit(("travel.limit_max", "0"), "5000 iu")
    accept(AxisDialog, lambda d: choose(d, "0", "1"))
    action(window, "Copy Axis").trigger()
    assert file.get(("travel.limit_max", "1")) == Value(5000, "iu")
    before = dict(file.values)
    action(window, "Swap Axes").trigger()
    assert file.get(("axes.assignment", "0")) == Value(1), "Y is the first axis now"
    window.menus["edit.undo"].trigger()
    assert file.values == before


def test_an_axis_of_an_acromill_is_named_added_and_deleted(opened, accept) -> None:
    window = opened("acromill", "X,Y")
    file = window.workspace.file
    accept(AddAxisDialog)
    action(window, "Add Axis").trigger()
    assert fitted_axes(file) == ("X", "Y", "Z")
    assert file.get(("view.number_of_axes", "")) == Value(3)
    accept(AxisDialog, lambda d: choose(d, "Z", "C"))
    action(window, "Name Axis").trigger()
    assert heads(window)[-1] == "C Z"
    accept(AxisDialog, lambda d: d.form.editor("axis", QComboBox).setCurrentIndex(2))
    action(window, "Delete Axis").trigger()
    assert fitted_axes(file) == ("X", "Y")


def test_what_a_family_cannot_do_is_off_and_the_reason_is_there(opened) -> None:
    window = opened("57c422b", "X,Y")
    off = {
        a.text().replace("&", ""): a.toolTip()
        for a in window.menus.menu("axis").actions()
        if a.text() and not a.isEnabled()
    }
    assert off.keys() == {
        "Name Axis…",
        "Configure Axis Type…",
        "Configure Servo…",
        "Add Axis…",
        "Delete Axis…",
    }
    assert off["Add Axis…"] == "Reliance 57C422B 2-Axis Servo Module always has the axes X and Y (page 4-1)"
    assert "no parameter for the type" in off["Configure Axis Type…"]


def test_an_action_that_works_again_has_its_own_tooltip(opened, tmp_path: Path) -> None:
    window = opened("57c422b", "X,Y")
    file = new_file("num", None, ["X", "Y"])
    window.show_workspace(Workspace(Document.create(file, tmp_path / "second.amp")))
    assert window.menus["axis.add"].isEnabled()
    assert window.menus["axis.add"].toolTip() == "Add Axis"


def test_two_axes_are_compared_side_by_side_and_a_value_is_taken(opened) -> None:
    window = opened("num", "X,Y,B")
    window.edits.commit(("travel.limit_max", "0"), "5000 iu")
    window.edits.commit(("travel.homing_negative", ""), "2")
    action(window, "Compare Axes").trigger()
    displayed = window.findChild(AxisComparison)
    rows = [
        [displayed.list.topLevelItem(n).text(c) for c in range(3)]
        for n in range(displayed.list.topLevelItemCount())
    ]
    assert rows == [
        ["P15N0 Homing Direction", "no", "yes"],
        ["P17N1 Axis Travel Limits, Maximum", "5000 iu", "not set"],
    ]
    assert displayed.count.text() == "2 parameters differ"
    displayed.list.selectAll()
    displayed.take_first.click()
    assert window.workspace.file.get(("travel.limit_max", "1")) == Value(5000, "iu")
    assert window.workspace.file.get(("travel.homing_negative", "")) == Value(0)
    assert displayed.count.text() == "No differences"
    assert not displayed.take_first.isEnabled()
    displayed.close()


def test_a_comparison_without_a_chosen_axis_takes_the_first(opened) -> None:
    """A box loses its choice where the type of the control changes."""
    window = opened("num", "X,Y,B")
    action(window, "Compare Axes").trigger()
    displayed = window.findChild(AxisComparison)
    displayed.second.blockSignals(True)
    displayed.second.setCurrentIndex(-1)
    displayed.second.blockSignals(False)
    displayed.refresh()
    assert displayed.axes() == ("0", "0")
    displayed.close()


def test_a_compared_parameter_is_shown_in_the_table(opened) -> None:
    window = opened("acromill", "X,Y")
    window.edits.commit(("axes.pulses_per_unit", "Y"), "2000")
    action(window, "Compare Axes").trigger()
    displayed = window.findChild(AxisComparison)
    item = next(
        displayed.list.topLevelItem(n)
        for n in range(displayed.list.topLevelItemCount())
        if "Pulses" in displayed.list.topLevelItem(n).text(0)
    )
    displayed.list.itemActivated.emit(item, 2)
    assert window.selected() == ("axes.pulses_per_unit", "Y")
    displayed.close()


def test_the_menu_offers_motion_again_for_a_family_that_has_it(opened) -> None:
    window = opened("syntec", "X")
    assert (window.menus["view.motion"].text(), window.menus["view.motion"].toolTip()) == (
        "&Motion",
        "Motion (F9)",
    )
