"""The table of actions is what the window has: each row once, in its menu, with its keys,
enabled by its needs.
"""

from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu

from amp_studio.ui.actions.table import TOOL_BAR, menus
from amp_studio.ui.base.theme import _glyphs
from amp_studio.ui.main_window import MainWindow
from amp_studio.ui.window.action import Action, Menu
from amp_studio.ui.window.menus import shortcuts_of


def rows(menu: Menu) -> Iterator[tuple[Menu, Action]]:
    """Yield every action of a menu and of those in it, with the menu that it is in."""
    for row in menu.rows:
        if isinstance(row, Action):
            yield menu, row
        elif isinstance(row, Menu):
            yield from rows(row)


def every_row() -> list[tuple[Menu, Action]]:
    return [found for menu in menus() for found in rows(menu)]


def test_each_row_is_an_action_in_its_menu_with_its_keys_and_every_action_is_a_row(
    window: MainWindow,
) -> None:
    table = every_row()
    assert Counter(row.key for _, row in table).most_common(1)[0][1] == 1
    for menu, row in table:
        action = window.menus[row.key]
        assert action in window.menus.menu(menu.key).actions(), row.key
        assert action.shortcuts() == shortcuts_of(row), row.key
        assert action.isCheckable() == (row.is_on is not None), row.key
    assert set(window.menus.values()) == set(window.actions())
    assert list(window.menus) == [row.key for _, row in table]


def test_no_key_of_the_table_means_two_things(qapp: object) -> None:
    keys = Counter(each.toString() for _, row in every_row() for each in shortcuts_of(row))
    assert [key for key, n in keys.items() if n > 1] == []


def test_icons_are_in_the_set_and_buttons_in_the_table(qapp: object) -> None:
    named = {row.icon for _, row in every_row() if row.icon}
    assert {"floppy-disk", "folder-open"} <= named <= set(_glyphs())
    assert {key for part in TOOL_BAR.values() for key in part} <= {row.key for _, row in every_row()}


def test_the_menu_of_a_cell_has_the_rows_that_show_it(window: MainWindow) -> None:
    wanted = [window.menus[row.key] for _, row in every_row() if row.of_a_cell]
    assert wanted
    assert window.page.table_view.actions() == wanted


@pytest.mark.parametrize("state", ["nothing", "file", "read-only"])
def test_an_action_is_able_when_what_it_needs_is_there(
    open_window: Callable[..., MainWindow], path: Path, state: str
) -> None:
    if state == "read-only":
        path.chmod(0o444)
    window = open_window(path if state != "nothing" else None)
    able = {row.key: window.menus[row.key].isEnabled() for _, row in every_row()}
    can_edit = window.workspace is not None and window.workspace.may_edit
    met = {
        "": True,
        "file": state != "nothing",
        "edit": can_edit,
        "axes": can_edit,
        "undo": False,
        "redo": False,
        "emulated": False,
        "emulated estop": False,
        "no emulated": state != "nothing",
        "units": state != "nothing",
        "project": False,
    }
    for _, row in every_row():
        if row.why_not is None:
            assert able[row.key] == met[row.needs], row.key
        elif window.workspace is not None:
            assert able[row.key] == (met[row.needs] and not row.why_not(window.workspace)), row.key


def test_a_switch_that_is_refused_shows_what_is_true(window: MainWindow, user) -> None:
    def refuse(*_: object) -> None:
        raise ValueError("not now")

    window.workspace.show_later = refuse
    window.menus["guide.later"].trigger()
    assert user.reads() == "not now"
    assert not window.menus["guide.later"].isChecked()


def test_a_reason_is_the_tip_of_what_a_family_cannot_do(window: MainWindow, path: Path) -> None:
    row = next(row for _, row in every_row() if row.key == "axis.add")
    action: QAction = window.menus["axis.add"]
    reason = row.why_not(window.workspace)
    assert action.isEnabled() == (not reason)
    assert action.toolTip() == (reason or "Add Axis")
    assert isinstance(window.menus.menu("axis"), QMenu)
    assert window.menus.menu("axis").toolTipsVisible()


def test_a_text_of_a_control_is_imported_with_no_file_open(open_window: Callable[..., MainWindow]) -> None:
    assert open_window().menus["file.import"].isEnabled()
