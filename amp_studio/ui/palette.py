"""The command palette: every action of the menus by typing a part of its name."""

from __future__ import annotations

from collections.abc import Iterator

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction, QKeyEvent, QKeySequence
from PySide6.QtWidgets import (
    QDialog,
    QHeaderView,
    QLineEdit,
    QMenu,
    QMenuBar,
    QTreeWidget,
    QTreeWidgetItem,
    QVBoxLayout,
    QWidget,
)

_ACTION = Qt.ItemDataRole.UserRole


def commands(menu: QMenuBar | QMenu, path: str = "") -> Iterator[tuple[str, QAction]]:
    """Yield every command of a menu with its path: ``File › Save``; dynamic menus are filled first."""
    for action in menu.actions():
        name = action.text().replace("&&", "\0").replace("&", "").replace("\0", "&").rstrip("…")
        inner = action.menu()
        if isinstance(inner, QMenu):
            inner.aboutToShow.emit()
            yield from commands(inner, f"{path}{name} › ")
        elif name and not action.isSeparator():
            yield f"{path}{name}", action


class CommandPalette(QDialog):
    """Lists the actions that are enabled now."""

    def __init__(self, menu: QMenuBar, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("Commands")
        self.resize(560, 400)
        self._actions = [(name, action) for name, action in commands(menu) if action.isEnabled()]
        self._items: list[QTreeWidgetItem] = []
        self.chosen: QAction | None = None
        self.search = QLineEdit()
        self.search.setPlaceholderText("Type a part of a command's name")
        self.search.textChanged.connect(self._fill)
        self.list = QTreeWidget()
        self.list.setColumnCount(2)
        self.list.setHeaderHidden(True)
        self.list.setRootIsDecorated(False)
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.header().setStretchLastSection(False)
        self.list.header().setSectionResizeMode(0, QHeaderView.ResizeMode.Stretch)
        self.list.header().setSectionResizeMode(1, QHeaderView.ResizeMode.ResizeToContents)
        self.list.itemClicked.connect(self._choose)
        layout = QVBoxLayout(self)
        layout.addWidget(self.search)
        layout.addWidget(self.list)
        self._fill("")

    def ask(self) -> QAction | None:
        """Return the chosen action, or None; the caller runs it when the palette is closed."""
        self.exec()
        self.deleteLater()
        return self.chosen

    def _fill(self, text: str) -> None:
        words = text.casefold().split()
        self.list.clear()
        self._items = []
        for name, action in self._actions:
            if all(word in name.casefold() for word in words):
                mark = "✓ " if action.isCheckable() and action.isChecked() else ""
                keys = action.shortcut().toString(QKeySequence.SequenceFormat.NativeText)
                item = QTreeWidgetItem([mark + name, keys])
                item.setData(0, _ACTION, action)
                self._items.append(item)
        self.list.addTopLevelItems(self._items)
        if self._items:
            self.list.setCurrentItem(self._items[0])

    def _choose(self, *_: object) -> None:
        item = self.list.currentItem()
        if item is not None:
            self.chosen = item.data(0, _ACTION)
            self.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Move in the list while the focus stays in the search field."""
        step = {Qt.Key.Key_Up: -1, Qt.Key.Key_Down: 1, Qt.Key.Key_PageUp: -10, Qt.Key.Key_PageDown: 10}.get(
            Qt.Key(event.key())
        )
        if step is not None and self._items:
            row, last = self.list.currentIndex().row() + step, len(self._items) - 1
            row = row % (last + 1) if abs(step) == 1 else max(0, min(last, row))
            self.list.setCurrentItem(self._items[row])
        elif event.key() in (Qt.Key.Key_Return, Qt.Key.Key_Enter):
            self._choose()
        else:
            super().keyPressEvent(event)
