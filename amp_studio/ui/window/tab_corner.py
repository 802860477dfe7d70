"""What is at the end of the tabs: a new file, two files beside each other, and the list of the open files."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial

from PySide6.QtCore import QSize
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMenu, QToolButton, QWidget

from amp_studio.ui.base.layout import in_row
from amp_studio.ui.base.theme import GAP, GAP2, ICON
from amp_studio.ui.forms.icon_button import icon_button


class TabCorner(QWidget):
    """Three small buttons; the list names every file, also one whose tab is scrolled away."""

    def __init__(
        self, new: QAction, beside: QAction, files: Callable[[], Iterable[tuple[str, Callable[[], object]]]]
    ) -> None:
        """Make the buttons of two actions, and one for the ``files``:
        each a name and what brings it to the front.
        """
        super().__init__()
        self._files = files
        row = in_row(on=self, margins=(GAP, 0, GAP2, 0), gap=GAP)
        for name, action in (("plus", new), ("columns", beside)):
            button = self._button(name, action.toolTip())
            button.clicked.connect(action.trigger)
            row.addWidget(button)
        self.list = self._button("caret-down", self.tr("Open files"))
        self.menu = QMenu(self.list)
        self.menu.aboutToShow.connect(self._fill)
        self.list.setMenu(self.menu)
        self.list.setPopupMode(QToolButton.ToolButtonPopupMode.InstantPopup)
        row.addWidget(self.list)

    def _button(self, name: str, tip: str) -> QToolButton:
        button = icon_button(name, tip)
        button.setIconSize(QSize(ICON, ICON))
        return button

    def _fill(self) -> None:
        self.menu.clear()
        for name, bring in self._files():
            self.menu.addAction(name.replace("&", "&&"), partial(bring))
