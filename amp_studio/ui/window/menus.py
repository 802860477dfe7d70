"""Makes the menus of a window of the table of its actions, and keeps their state that of the file in
front.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from typing import Generic, TypeVar

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QActionGroup, QKeySequence
from PySide6.QtWidgets import QMenu

from amp_studio.ui.base.theme import icon

from .action import Action, ChoiceMenu, FilledMenu, Menu, Needs
from .studio_window import StudioWindow

W = TypeVar("W", bound=StudioWindow)


class Menus(Mapping[str, QAction], Generic[W]):
    """The actions of a window by their keys."""

    def __init__(self, window: W, menus: Sequence[Menu[W]]) -> None:
        self._window = window
        self._actions: dict[str, QAction] = {}
        self._rows: dict[str, Action[W]] = {}
        self._menus: dict[str, QMenu] = {}
        self._choices: list[tuple[ChoiceMenu[W], QMenu, QActionGroup]] = []
        for menu in menus:
            self._fill(window.menuBar().addMenu(menu.text), menu)

    def __getitem__(self, key: str) -> QAction:
        return self._actions[key]

    def __iter__(self) -> Iterator[str]:
        return iter(self._actions)

    def __len__(self) -> int:
        return len(self._actions)

    def menu(self, key: str) -> QMenu:
        """Return a menu by its key."""
        return self._menus[key]

    def of_a_cell(self) -> list[QAction]:
        """Return the actions that are in the menu of a cell too."""
        return [self._actions[key] for key, row in self._rows.items() if row.of_a_cell]

    # -- making ------------------------------------------------------------------

    def _fill(self, into: QMenu, menu: Menu[W]) -> None:
        self._menus[menu.key] = into
        into.setToolTipsVisible(menu.shows_tips)
        for row in menu.rows:
            if row is None:
                into.addSeparator()
            elif isinstance(row, Action):
                into.addAction(self._made(row))
            elif isinstance(row, FilledMenu):
                into.addMenu(row.menu(self._window))
            elif isinstance(row, ChoiceMenu):
                inner = self._menus[row.key] = into.addMenu(row.text)
                self._choices.append((row, inner, QActionGroup(inner)))
            else:
                self._fill(into.addMenu(row.text), row)

    def _made(self, row: Action[W]) -> QAction:
        action = self._actions[row.key] = QAction(row.text, self._window)
        self._rows[row.key] = row
        action.setShortcuts(shortcuts_of(row))
        action.setCheckable(row.is_on is not None)
        if row.icon:
            action.setIcon(icon(row.icon))
        if row.short:
            action.setIconText(row.short)
        if row.only_in_table:
            action.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        action.setToolTip(row.tip or _tip_of(action))
        name = _plain_name(row.text)
        action.triggered.connect(lambda *_: self._do(row, action, name))
        # On the window too: the keys of a menu that is closed would not work everywhere.
        self._window.addAction(action)
        return action

    def _do(self, row: Action[W], action: QAction, name: str) -> None:
        self._window.guarded(partial(row.does, self._window), name)
        self._show_state(row, action)  # also where it was refused

    # -- what depends on the file in front -----------------------------------------

    def enable(self, can: Mapping[Needs, bool]) -> None:
        """Enable what can be done now, and show what depends on the file in front;
        ``can`` has whether each need is met.
        """
        for key, row in self._rows.items():
            able = can[row.needs] and (can["seen"] or not (row.of_a_cell or row.of_selected))
            self._enable(row, self._actions[key], able)
        for choice, menu, group in self._choices:
            self._offer(choice, menu, group, can[choice.needs])

    def _enable(self, row: Action[W], action: QAction, able: bool) -> None:
        """Enable one action, unless the file in front has a reason against it, and show its state."""
        if row.why_not is not None and (workspace := self._window.workspace) is not None:
            reason = row.why_not(workspace)
            able = able and not reason
            action.setToolTip(reason or _tip_of(action))
        action.setEnabled(able)
        self._show_state(row, action)
        if row.follows is not None:
            row.follows(self._window, action)

    def _show_state(self, row: Action[W], action: QAction) -> None:
        """Check an action that is on or off as it is now."""
        if row.is_on is not None and (is_on := row.is_on(self._window)) is not None:
            action.setChecked(is_on)

    def _offer(self, choice: ChoiceMenu[W], menu: QMenu, group: QActionGroup, able: bool) -> None:
        """Fill the menu of a choice where it has other rows now, and check the present one."""
        offers = choice.offers(self._window)
        if offers is not None:
            # Not filled in vain: a menu that is open would close.
            if [(row.data(), row.text()) for row in group.actions()] != list(offers):
                for row in group.actions():
                    menu.removeAction(row)
                    group.removeAction(row)
                    row.deleteLater()
                for key, name in offers:
                    menu.addAction(self._offered(choice, group, key, name))
            menu.setEnabled(able)
            self._check(choice, group)
        group.setEnabled(offers is not None and able)

    def _offered(self, choice: ChoiceMenu[W], group: QActionGroup, key: str, name: str) -> QAction:
        action = QAction(name, group)
        action.setCheckable(True)
        action.setData(key)
        choose, title = partial(choice.choose, self._window, key), _plain_name(choice.text)
        action.triggered.connect(lambda *_: self._choose(choose, title))
        return action

    def _choose(self, choose: Callable[[], object], title: str) -> None:
        self._window.guarded(choose, title)
        for choice, _, group in self._choices:
            self._check(choice, group)  # also where it was refused

    def _check(self, choice: ChoiceMenu[W], group: QActionGroup) -> None:
        if choice.offers(self._window) is not None:
            present = choice.present(self._window)
            for row in group.actions():
                row.setChecked(row.data() == present)


def _plain_name(text: str) -> str:
    """Return the name of an action without Alt letter and dots."""
    return text.replace("&", "").rstrip("…")


def _tip_of(action: QAction) -> str:
    """Return the name of an action with its keys."""
    keys = action.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
    return f"{_plain_name(action.text())} ({keys})" if keys else _plain_name(action.text())


def shortcuts_of(row: Action[W]) -> list[QKeySequence]:
    """Return the keys of a row; a key that every program has is that of the system, which may have none."""
    keys = row.keys if isinstance(row.keys, tuple) else (row.keys,)
    return [found for each in keys if not (found := QKeySequence(each)).isEmpty()]
