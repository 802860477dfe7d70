"""The table: a row a parameter, a column an axis."""

import pytest
from PySide6.QtCore import QPoint, Qt
from PySide6.QtWidgets import QApplication, QMenu
from pytestqt.qtbot import QtBot

from amp_studio.files import ParameterFile, set_value_note
from amp_studio.schema import Value
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.table.cell_look import CellLook
from amp_studio.ui.table.parameter_table import AddressRole, ParameterTable

EXCESS = ("servo.excess_error", "1")


def look(table: ParameterTable, address: tuple[str, str]) -> CellLook:
    """Return how a cell is painted."""
    index = table.index_of(address)
    return table.look(index.row(), index.column())


# -- what is shown -------------------------------------------------------------


def test_a_column_an_axis_and_one_for_the_control(table: ParameterTable) -> None:
    titles = [table.headerData(n, Qt.Orientation.Horizontal) for n in range(table.columnCount())]
    assert titles[:6] == ["Control", "X 1 linear", "Y 2 linear", "Z 3 linear", "B 4 rotary", "S 5 spindle"]


def test_a_row_a_process_a_gear_and_a_macro_call(table: ParameterTable) -> None:
    """Process 1 is not axis 1, and fifteen macro calls side by side would fit no screen."""
    rows = {table.number(n): table.row_name(n) for n in range(table.rowCount())}
    assert rows["20020"] == "Number of Limit 2,3 Groups, Process 1"
    assert rows["901"].endswith(", Spindle 1, Gear 2")
    assert rows["742"].endswith(", Macro call 15")
    assert rows["1300"] == "Home Calibration", "its axes are columns"
    assert rows["1020"] == "Software Overtravel Used", "page 7-46 prints it for another parameter by mistake"


def test_every_cell_leads_to_its_address_and_back(table: ParameterTable, file: ParameterFile) -> None:
    displayed = {
        table.address_at(r, c) for r in range(table.rowCount()) for c in range(table.columnCount())
    } - {None}
    for address in displayed:
        assert table.index_of(address).data(AddressRole) == address
    existing = {a for a in file.addresses() if file.evaluation.state(a).state != "hidden"}
    unfitted = {a for a in existing if a[1] in "678" and file.evaluation.scope(a) == "axis"}
    assert existing - unfitted <= displayed


def test_unfitted_axes_and_hidden_parameters_are_options(window: MainWindow) -> None:
    table = window.table
    window.groups.tree.setCurrentItem(window.groups._items[0])
    assert "8" not in table.columns
    hidden, rows = table.hidden_rows, table.count
    assert hidden > 0
    assert f"{hidden} hidden" in window.page.list_title.text()

    window.menus["view.unfitted_axes"].trigger()
    window.menus["view.hidden"].trigger()

    assert "8" in table.columns
    assert table.count == rows + hidden
    assert "hidden" not in window.page.list_title.text()


def test_a_row_comes_and_goes_with_what_makes_it_exist(window: MainWindow, workspace: Workspace) -> None:
    """Mill Type exists on a mill only (page 3-9);
    the cell that was selected stays selected as long as it exists.
    """
    window.groups.tree.setCurrentItem(window.groups._items[0])
    only_mill = ("control.mill_type", "")
    assert window.table.index_of(only_mill).isValid()
    window.go_to(EXCESS)

    workspace.edit("lathe", {("control.type", ""): Value("lathe")})
    assert not window.table.index_of(only_mill).isValid()
    assert window.selected() == EXCESS

    workspace.undo_stack.undo()
    assert window.table.index_of(only_mill).isValid()
    assert window.selected() == EXCESS


def test_what_is_not_for_this_configuration_cannot_be_edited(
    table: ParameterTable, file: ParameterFile
) -> None:
    hidden = next(
        a
        for a in file.addresses()
        if file.evaluation.state(a).state == "hidden" and table.index_of(a).isValid()
    )
    index = table.index_of(hidden)
    assert index.data() == ""
    assert table.look(index.row(), index.column()).kind == "absent"
    assert not index.flags() & Qt.ItemFlag.ItemIsEditable

    table.hidden_too = True
    table.show_again()
    assert table.index_of(hidden).flags() & Qt.ItemFlag.ItemIsEditable


def test_a_finding_colours_its_cells_and_reports_itself(table: ParameterTable, workspace: Workspace) -> None:
    plain = look(table, EXCESS)
    workspace.edit("force", {EXCESS: Value(1e9, "mm")}, force="on a day")

    index = table.index_of(EXCESS)
    assert plain.severity == ""
    assert look(table, EXCESS).severity == "error"
    assert "is outside" in index.data(Qt.ItemDataRole.ToolTipRole)
    assert "Forced on a day" in index.data(Qt.ItemDataRole.ToolTipRole)


def test_what_a_wrong_value_was_compared_with_is_not_coloured(table: ParameterTable) -> None:
    """Maximum Cutting Feedrate must not be above Rapid Feedrate for Positioning, which is as it should be."""
    cutting, rapid = ("feedrate.max_cutting", "1"), ("feedrate.rapid", "1")
    before = look(table, rapid).severity
    table.workspace.edit("force", {cutting: Value(1e5, "mm/min")}, force="on a day")
    assert look(table, cutting).severity
    assert look(table, rapid).severity == before
    assert any(rapid in finding.compared for finding in table.workspace.findings_of(cutting))


def test_an_own_value_is_loud_and_a_default_is_not(table: ParameterTable, workspace: Workspace) -> None:
    default = workspace.file.default(EXCESS)
    assert look(table, EXCESS).is_own
    workspace.edit("default", {EXCESS: default})
    assert not look(table, EXCESS).is_own


def test_the_text_of_a_choice_that_is_cut_off_is_in_its_tip(table: ParameterTable) -> None:
    index = table.index_of(("servo.position_feedback_type", "1"))
    assert index.data() in index.data(Qt.ItemDataRole.ToolTipRole)


def test_the_other_cells_of_the_selected_finding_are_outlined(
    window: MainWindow, workspace: Workspace
) -> None:
    """Gain Break Point 12 mm is not below Feedrate Suppression Point 11 mm, which is not at fault."""
    workspace.edit("raise", {("servo.gain_break_point", "1"): Value(12.0, "mm")})
    finding = next(f for f in workspace.findings if ("servo.gain_break_point", "1") in f.causes)
    window.findings.select(finding)
    assert window.table.outlined == frozenset({("servo.feedrate_suppression", "1")})
    assert window.table.outline_severity == finding.severity


def every_look(table: ParameterTable) -> list[str]:
    """Return how every cell is painted."""
    places = ((row, column) for row in range(table.rowCount()) for column in range(table.columnCount()))
    return [repr(table.look(*place)) for place in places]


@pytest.mark.parametrize(
    "value",
    [
        ("servo.gain_break_point", Value(12.0, "mm")),
        ("servo.excess_error", Value(11.5, "mm")),
        ("axis.type", Value("rotary")),
    ],
)
def test_an_edit_paints_the_rows_that_look_other_than_before_and_few_more(
    table: ParameterTable, workspace: Workspace, value: tuple[str, Value]
) -> None:
    """A finding of another row, a note of the same step, another state: none is left as it was."""

    def change() -> None:
        workspace.file.set((value[0], "1"), value[1])
        if value[1].value == 11.5:
            set_value_note(workspace.file, ("servo.gain_break_point", "2"), "Measured.")

    before, painted = every_look(table), set[int]()
    table.dataChanged.connect(lambda first, last: painted.update(range(first.row(), last.row() + 1)))
    workspace.do("change", change)
    after = every_look(table)
    table._looks.clear()
    assert after == every_look(table) != before
    if value[0] == "servo.gain_break_point":
        assert 0 < len(painted) < 10


# -- back to the default ---------------------------------------------------------


def test_the_mark_of_a_row_offers_the_way_back_to_each_default(
    window: MainWindow, workspace: Workspace, qtbot: QtBot
) -> None:
    workspace.edit(
        "two", {("home.calibration", axis): Value(n, "mm") for n, axis in ((1.5, "1"), (2.5, "2"))}
    )
    names, table = window.table_view.verticalHeader(), window.table
    row = table.index_of(("home.calibration", "1")).row()
    window.table_view.scrollTo(table.index(row, 0))
    tip = table.headerData(row, Qt.Orientation.Vertical, Qt.ItemDataRole.ToolTipRole)
    assert "X: 1.5 mm, default 0 mm" in tip
    place = QPoint(4, names.sectionViewportPosition(row) + 8)
    qtbot.mouseClick(names.viewport(), Qt.MouseButton.LeftButton, pos=place)
    menu = QApplication.activePopupWidget()
    assert isinstance(menu, QMenu)
    offered = {action.text(): action for action in menu.actions()}
    offered["Back to default: X: 1.5 mm, default 0 mm"].trigger()
    menu.close()
    assert workspace.file.is_default(("home.calibration", "1"))
    assert not workspace.file.is_default(("home.calibration", "2")), "only what was chosen"
    workspace.undo_stack.undo()
    assert not workspace.file.is_default(("home.calibration", "1")), "one step to undo"


def test_a_row_without_its_own_values_has_no_mark_and_is_selected(
    window: MainWindow, workspace: Workspace
) -> None:
    table = window.table
    rows = range(len(table.rows))
    own = {n for n in rows if table.off_default(n)}
    assert own
    assert len(own) < table.count
    for n in own:
        assert all(not workspace.file.is_default(a) for a in table.off_default(n))
    assert "Ctrl+Backspace" in table.values.tip(table.off_default(min(own))[0])


def test_the_tip_of_a_long_help_or_note_has_room_on_a_screen(
    table: ParameterTable, file: ParameterFile
) -> None:
    """Qt makes one line of a paragraph: a help was wider than the screen, and so was a note."""
    set_value_note(file, EXCESS, "a long note " * 333)
    rows = range(len(table.rows))
    tips = [table.headerData(n, Qt.Orientation.Vertical, Qt.ItemDataRole.ToolTipRole) or "" for n in rows]
    tips.append(table.index_of(EXCESS).data(Qt.ItemDataRole.ToolTipRole))
    assert max(len(line) for tip in tips for line in tip.split("\n")) <= 100
    assert max(tip.count("\n") for tip in tips) <= 24
    assert table.index_of(EXCESS).data(Qt.ItemDataRole.AccessibleDescriptionRole).count("long note") == 333
