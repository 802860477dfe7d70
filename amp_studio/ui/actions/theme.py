"""Light, dark, or as the system is."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu

from amp_studio.ui.base.theme import ThemeChoice, scheme, wear
from amp_studio.ui.window.studio_window import StudioWindow


class ThemeActions(QObject):
    """The menu of themes; the choice is kept and every window changes at once."""

    def __init__(self, window: StudioWindow, menu: QMenu) -> None:
        super().__init__(window)
        self._settings = window.settings
        inner = menu.addMenu(self.tr("Th&eme"))
        self.group = QActionGroup(inner)
        names: tuple[tuple[ThemeChoice, str], ...] = (
            ("system", self.tr("&System")), ("light", self.tr("&Light")), ("dark", self.tr("&Dark")),
        )  # fmt: skip
        for choice, name in names:
            action = QAction(name, self.group)
            action.setCheckable(True)
            action.setChecked(scheme().choice == choice)
            action.triggered.connect(partial(self.choose, choice))
            inner.addAction(action)

    def choose(self, choice: ThemeChoice, *_: object) -> None:
        """Wear a theme and keep the choice."""
        wear(choice)
        self._settings.keep_theme(choice)
