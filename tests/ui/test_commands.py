"""Every command is in a menu, has a name and a key, and is found and run by the find box."""

from collections import Counter

import pytest
from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtTest import QTest
from PySide6.QtWidgets import QDockWidget, QMenu, QWidgetAction

from amp_studio.ui.base.menu_commands import commands
from amp_studio.ui.main_window import MainWindow

from .conftest import action


def menus(window: MainWindow) -> list[QMenu]:
    """Return every menu, with those inside of menus."""
    found = [a.menu() for a in window.menuBar().actions()]
    for menu in found:
        menu.aboutToShow.emit()
        found.extend(a.menu() for a in menu.actions() if a.menu())
    return found


def mnemonic(text: str) -> str:
    """Return the letter that is underlined in a menu."""
    at = text.replace("&&", "  ").find("&")
    return text[at + 1].casefold() if at >= 0 else ""


def test_every_action_of_the_window_is_in_a_menu_and_has_a_name(window: MainWindow) -> None:
    in_menus = {a for _, a in commands(window.menuBar())}
    assert set(window.actions()) <= in_menus
    assert all(a.text() for a in in_menus)


def test_every_command_has_a_keyboard_route(window: MainWindow) -> None:
    """A letter underlined in its menu, which no other of that menu has."""
    for menu in [window.menuBar(), *menus(window)]:
        letters = Counter(mnemonic(a.text()) for a in menu.actions() if not a.isSeparator())
        assert [letter for letter, n in letters.items() if not letter or n > 1] == [], [
            a.text() for a in menu.actions()
        ]


def test_no_key_means_two_things(window: MainWindow) -> None:
    keys = Counter(
        a.shortcut().toString() for _, a in commands(window.menuBar()) if not a.shortcut().isEmpty()
    )
    assert [key for key, n in keys.items() if n > 1] == []


def test_toolbar_buttons_have_an_icon_a_text_and_a_tip_with_the_key(window: MainWindow) -> None:
    buttons = [
        a
        for a in window.findChild(type(window.addToolBar("x")), "main-toolbar").actions()
        if not a.isSeparator() and not isinstance(a, QWidgetAction)
    ]
    assert len(buttons) > 8
    for button in buttons:
        assert not button.icon().isNull(), button.text()
        assert button.iconText()
        assert len(button.iconText()) < 15
        if not button.shortcut().isEmpty():
            assert button.shortcut().toString() in button.toolTip()


def listed(window: MainWindow, text: str = ">") -> dict[str, QAction]:
    """Return the commands that the find box lists, by name."""
    window.finder.box.begin(text)
    return {row.text: row.action for row in window.finder.box.model.rows if row.action is not None}


def test_the_find_box_lists_every_enabled_command_and_no_other(window: MainWindow) -> None:
    found = listed(window)
    assert set(found.values()) == {a for _, a in commands(window.menuBar()) if a.isEnabled()}
    assert window.menus["edit.undo"] not in found.values()
    assert found["✓ View › Units › Metric"].isChecked()
    assert any(row.text == "File › Save" and row.right == "Ctrl+S" for row in window.finder.box.model.rows)


def test_no_command_is_listed_twice_after_another_file(window: MainWindow, path) -> None:
    other = path.with_name("other.amp")
    other.write_bytes(path.read_bytes())
    window.files.open_path(other)
    names = [name for name, _ in commands(window.menuBar())]
    assert len(names) == len(set(names))


@pytest.mark.own_window
def test_the_find_box_runs_every_command_it_lists(window: MainWindow) -> None:
    """What is chosen is triggered once, and only when the list is closed."""
    triggered, box = [], window.finder.box
    every = list(listed(window).values())
    for command in every:
        command.triggered.disconnect()
        command.triggered.connect(lambda *_, command=command: triggered.append((command, box.is_open)))
    for command in every:
        box.begin(">")
        row = next(n for n, each in enumerate(box.model.rows) if each.action is command)
        box.list.setCurrentIndex(box.model.index(row))
        QTest.keyClick(box, Qt.Key.Key_Return)
    assert triggered == [(command, False) for command in every]


def test_commands_are_chosen_with_the_keys_and_slips_are_forgiven(window: MainWindow) -> None:
    action(window, "Commands").trigger()
    box = window.finder.box
    assert window.focusWidget() is box
    QTest.keyClicks(box, "confgure axis")
    assert box.model.rows[1].text == "Axis › Configure Axis Type"
    assert [row.text for row in box.model.rows if row.action is None] == ["Commands"]
    box.setText(">marzipan")
    box.search()
    assert [row.text for row in box.model.rows] == ["Nothing found"]
    QTest.keyClick(box, Qt.Key.Key_Return)
    assert box.is_open
    QTest.keyClick(box, Qt.Key.Key_Escape)
    assert not box.is_open
    QTest.keyClick(box, Qt.Key.Key_Escape)
    assert (box.text(), window.focusWidget()) == ("", window.table_view)


def test_panels_are_reached_and_brought_back_by_a_key(window: MainWindow) -> None:
    for name, part in (
        ("Groups", window.groups.tree),
        ("Findings", window.findings.focusProxy()),
        ("Table", window.table_view),
    ):
        action(window, name).trigger()
        assert part.hasFocus(), name
    dock = window.findChild(QDockWidget, "Findings")
    dock.close()
    assert not window.findings.isVisible()
    action(window, "Findings").trigger()
    assert window.findings.isVisible()


def test_find_from_anywhere(window: MainWindow) -> None:
    window.show_panel("Findings")
    action(window, "Find").trigger()
    assert window.focusWidget() is window.finder.box


def test_without_a_file_only_what_needs_none_is_offered(open_window) -> None:
    window = open_window()
    enabled = {name for name, a in commands(window.menuBar()) if a.isEnabled()}
    assert {"File › New", "File › Open", "Control › Read From the Control", "Help › Commands"} <= enabled
    assert not {"File › Save", "Edit › Clear (Not Set)", "Axis › Copy Axis", "View › Motion"} & enabled


def test_what_an_action_refuses_is_reported_in_one_sentence(window: MainWindow, user) -> None:
    window.guarded(lambda: (_ for _ in ()).throw(KeyError("no such thing")), "Test")
    assert user.reads() == "no such thing"
