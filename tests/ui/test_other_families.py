"""A family that is nothing like the 9/PC: axes that are always there, words of bits, texts,
machine types in the header.
"""

from collections.abc import Callable
from pathlib import Path

import pytest
from PySide6.QtCore import Qt
from PySide6.QtWidgets import QLabel
from pytestqt.qtbot import QtBot

from amp_studio.files import Document, Header, ParameterFile, content_of, new_file
from amp_studio.schema import Schema, Value
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.motion.view import MotionView

from .at_control import at_control
from .conftest import action


@pytest.fixture
def wide(open_window: Callable[..., MainWindow], wide_family: Schema, tmp_path: Path) -> MainWindow:
    """Return a window with a file of the wide family."""
    file = ParameterFile(wide_family, Header(name="wide", machine="small"))
    file.values[("axis.position", "11")] = Value(1.5, "mm")
    window = open_window()
    window.show_workspace(Workspace(Document.create(file, tmp_path / "wide.amp")))
    return window


def test_every_axis_has_a_column_and_every_word_a_row(wide: MainWindow) -> None:
    titles = [wide.table.headerData(n, Qt.Orientation.Horizontal) for n in range(wide.table.columnCount())]
    assert titles[:13] == ["Control", *(f"Axis {n}" for n in range(12))]
    read_by = titles.index("Read by")
    rows = [n for n in range(wide.table.rowCount()) if not wide.table.rows[n].section]
    reported = [wide.table.index(n, read_by).data() for n in rows]
    assert set(reported) == {"", "load modes"}, "which command makes the control read a value"
    assert not wide.table.index(0, read_by).flags() & Qt.ItemFlag.ItemIsEditable
    heads = [wide.table.headerData(n, Qt.Orientation.Vertical) for n in rows]
    assert any(head.startswith("P10N0") for head in heads)
    names = [wide.table.row_name(n) for n in range(wide.table.rowCount())]
    assert [name[-8:] for name in names if ", Word" in name] == [", Word 0", ", Word 1", ", Word 2"]


def test_a_guide_leads_through_the_parameters_in_its_own_order(wide: MainWindow) -> None:
    steps_tree = wide.page.left.steps.tree
    guide = steps_tree.findItems("Order of integration", Qt.MatchFlag.MatchExactly)[0]
    steps = [guide.child(n) for n in range(guide.childCount())]
    assert [step.text(0) for step in steps] == ["1  The words", "2  The axes"]
    steps_tree.setCurrentItem(steps[1])
    displayed = [row.parameter.id for row in wide.table.rows if not row.section]
    assert displayed == [*["word.mode"] * 3, "axis.position"], (
        "the values of the whole control are above those of the axes"
    )
    steps_tree.setCurrentItem(guide)
    assert [row.parameter.id for row in wide.table.rows if not row.section][:3] == ["word.mode"] * 3
    assert "Set the words first." in steps[0].toolTip(0)


def test_texts_and_words_of_bits_are_edited(wide: MainWindow) -> None:
    file = wide.workspace.file
    assert wide.edits.commit(("machine.name", ""), "Mill, 3 axes")
    assert wide.edits.commit(("word.mode", "1"), "0x9")
    assert file.get(("machine.name", "")) == Value("Mill, 3 axes")
    assert file.get(("word.mode", "1")) == Value(9)


def test_what_it_does_not_have_is_off_or_reported(wide: MainWindow) -> None:
    assert not action(wide, "Configure Axis Type").isEnabled()
    wide.menus["view.switch_units"].trigger()
    assert wide.workspace.file.header.units == "metric"
    wide.menus["view.motion"].trigger()
    assert wide.page.bar.text.text() == "Wide control has no simulation: no law of its servo axes is known."
    assert wide.findChild(MotionView) is None


def test_the_machine_type_of_the_header_is_a_step_too(wide: MainWindow) -> None:
    action(wide, "Large machine").trigger()
    assert wide.workspace.file.machine == "large"
    assert wide.workspace.is_dirty
    wide.menus["edit.undo"].trigger()
    assert wide.workspace.file.machine == "small"
    assert not wide.workspace.is_dirty


def test_a_control_of_another_family_is_refused(
    window_with: Callable[..., MainWindow], start_control, qtbot: QtBot
) -> None:
    window = window_with(content_of(new_file("syntec")))
    page = at_control(window, start_control().address, "compare", qtbot)
    assert page.bar.text.text() == "The control is of the family 9pc, not syntec."


def test_a_family_to_whose_controls_no_way_is_known_is_keyed_in(wide: MainWindow) -> None:
    action(wide, "Send to the Control").trigger()
    assert wide.control.page.hand.isVisible()
    texts = " ".join(label.text() for label in wide.control.page.hand.findChildren(QLabel))
    assert "The sheet lists the values that differ" in texts


@pytest.mark.parametrize(
    ("family", "axes", "changes", "address", "texts"),
    [
        ("syntec", "X,Y", {}, ("limit.first_positive", "1"), ("1000 BLU", "1000 BLU = 1 mm")),
        (
            "num",
            "",
            {("axes.internal_unit", ""): 4},
            ("travel.limit_max", "1"),
            ("1000 iu", "1000 iu = 0.1 mm"),
        ),
        ("num", "", {("axes.internal_unit", ""): None}, ("travel.limit_max", "1"), ("1000 iu", "1000 iu")),
    ],
)
def test_a_count_of_internal_units_is_shown_with_its_length(
    window_with: Callable[..., MainWindow], family: str, axes: str, changes, address, texts
) -> None:
    file = new_file(family, None, axes.split(",") if axes else [])
    for changed, number in changes.items():
        file.set(changed, None if number is None else Value(number))
    window = window_with(content_of(file))
    window.edits.commit(address, texts[0])
    window.detail.show_address(address)
    assert window.detail.value.text() == texts[1]
