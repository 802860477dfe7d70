"""A file of a control that describes itself in the program: its axes, its groups, its bits by name,
what it keeps.
"""

from pathlib import Path

import pytest

from amp_studio.families.grblhal.described import schema_of
from amp_studio.families.grblhal.settings import compiled_in
from amp_studio.files import Document, Header, ParameterFile, open_file
from amp_studio.schema import Value
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.main_window import MainWindow
from tests.families.grblhal.recorded import HELP, with_lines

ARC = "[SETTINGGROUP:20|0|Plasma]", "[SETTING:350|20|Arc voltage|V|6|##0.00|10|300|0|0]"


@pytest.fixture
def board(open_window, tmp_path: Path) -> MainWindow:
    """Return a window with the file of a control with a plugin."""
    window = open_window()
    schema = schema_of(with_lines(*ARC) + HELP)
    file = ParameterFile(schema, Header(name="board", machine="grblhal", signature=schema.signature))
    file.take(compiled_in(schema))
    for text, figure, unit in (
        ("$110", 500.0, "mm/min"),
        ("$111", 500.0, "mm/min"),
        ("$112", 300.0, "mm/min"),
    ):
        file.set(file.find(text), Value(figure, unit))
    window.show_workspace(Workspace(Document.create(file, tmp_path / "board.amp")))
    return window


def test_the_columns_are_the_axes_of_the_control_and_groups_that_it_does_not_have_are_hidden(
    board: MainWindow,
) -> None:
    board.page.left.show_side("groups")
    board.go_to(("axis.max_rate", "X"))
    assert board.table.columns == ["X", "Y", "Z"]
    assert "axis.jerk" not in [row.parameter.id for row in board.table.rows]
    tree = board.groups.tree
    displayed = [
        tree.topLevelItem(n).text(0)
        for n in range(tree.topLevelItemCount())
        if not tree.topLevelItem(n).isHidden()
    ]
    assert "Plasma" in displayed
    assert "Grbl 1.1" not in displayed


def test_a_value_goes_to_all_axes_that_move_alike(board: MainWindow) -> None:
    board.go_to(("axis.max_rate", "Z"))
    board.edits.range.to_all_axes()
    file = board.workspace.file
    assert [file.get(("axis.max_rate", axis)).value for axis in "XYZ"] == [300.0, 300.0, 300.0]


def test_bits_are_ticked_by_name_and_help_is_that_of_the_control(board: MainWindow) -> None:
    board.go_to(("homing.cycle", ""))
    ticks = board.detail.word.ticks
    assert [ticks.item(n).text().split("  ")[1] for n in range(2)] == [
        "Enable",
        "Enable single axis commands",
    ]
    assert "Homes the machine." in board.detail.page.toPlainText()


def test_what_the_control_keeps_and_shows_is_at_the_value(board: MainWindow) -> None:
    assert board.edits.commit(("general.junction_deviation", ""), "0.0004")
    board.go_to(("general.junction_deviation", ""))
    assert "0.0004, shown as 0.000 as stored in the control" in board.detail.page.toPlainText()


def test_it_is_saved_and_opened_again_without_the_control(board: MainWindow) -> None:
    assert board.edits.commit(("plasma.arc_voltage", ""), "120.5")
    assert board.save()
    file = open_file(board.workspace.path).file
    assert file.get(("plasma.arc_voltage", "")) == Value(120.5, "V")
    assert file.schema.signature == board.workspace.file.schema.signature
