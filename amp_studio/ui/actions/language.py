"""The language of the window."""

from __future__ import annotations

from functools import partial

from PySide6.QtCore import QObject
from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu

from amp_studio.ui.base.translated import LANGUAGES
from amp_studio.ui.window.studio_window import StudioWindow


class LanguageActions(QObject):
    """The menu of languages; the choice is that of the next start."""

    def __init__(self, window: StudioWindow, menu: QMenu) -> None:
        super().__init__(window)
        self._window = window
        inner = menu.addMenu(self.tr("La&nguage"))
        self.group = QActionGroup(inner)
        names = {"system": self.tr("&System"), **{code: f"&{own}" for code, own in LANGUAGES.items()}}
        for choice, name in names.items():
            action = QAction(name, self.group)
            action.setCheckable(True)
            action.setChecked(window.settings.language() == choice)
            action.triggered.connect(partial(self.choose, choice))
            inner.addAction(action)

    def choose(self, choice: str, *_: object) -> None:
        """Keep the choice."""
        self._window.settings.keep_language(choice)
        self._window.show_status(self.tr("The language is another one when AMP Studio is started again."))
