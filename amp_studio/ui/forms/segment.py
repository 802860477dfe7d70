"""Small controls in a row: one of a few (segment), and a filter with a count (chip)."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import QToolButton, QWidget

from amp_studio.ui.base.layout import in_row
from amp_studio.ui.base.theme import ICON, SMALL_CONTROL, icon


class Segment(QWidget):
    """Buttons side by side of which one is pressed, or none while no choice fits what is shown."""

    chosen = Signal(str)
    """The key of the button that a person pressed."""

    def __init__(
        self, name: str, options: Sequence[tuple[str, str, str]] = (), *, is_tight: bool = False
    ) -> None:
        """Make a segment with an accessible name; each option is its key,
        its text and the name of an icon or nothing. A tight one is for a narrow panel.
        """
        super().__init__()
        self.setAccessibleName(name)
        self._is_tight = is_tight
        self._row = in_row(on=self, margins=0, gap=0)
        self.buttons: dict[str, QToolButton] = {}
        self.offer(options)

    def offer(self, options: Sequence[tuple[str, str, str]]) -> None:
        """Show these options instead; none is pressed."""
        if [(key, button.text()) for key, button in self.buttons.items()] == [(k, t) for k, t, _ in options]:
            return
        for button in self.buttons.values():
            self._row.removeWidget(button)
            button.deleteLater()
        self.buttons = {}
        for n, (key, text, icon_name) in enumerate(options):
            button = QToolButton()
            button.setText(text)
            button.setAccessibleName(f"{self.accessibleName()}: {text}")
            button.setCheckable(True)
            if icon_name:
                button.setIcon(icon(icon_name))
                button.setIconSize(QSize(ICON, ICON))
                style = Qt.ToolButtonStyle
                button.setToolButtonStyle(
                    style.ToolButtonTextBesideIcon if text else style.ToolButtonIconOnly
                )
            ends = (n == 0, n == len(options) - 1)
            places = {(True, True): "only", (True, False): "first", (False, True): "last"}
            button.setProperty("segment", places.get(ends, "middle"))
            button.setProperty("tight", self._is_tight)
            button.clicked.connect(lambda *_, key=key: self._press(key))
            self._row.addWidget(button)
            self.buttons[key] = button

    def show_choice(self, key: str | None) -> None:
        """Press one button without a signal; None presses none."""
        for each, button in self.buttons.items():
            button.setChecked(each == key)

    def show_icons(self, wanted: bool) -> None:
        """Show the icons beside the texts, or the texts alone where there is little room."""
        style = Qt.ToolButtonStyle
        for button in self.buttons.values():
            if button.text() and not button.icon().isNull():
                button.setToolButtonStyle(
                    style.ToolButtonTextBesideIcon if wanted else style.ToolButtonTextOnly
                )

    @property
    def choice(self) -> str | None:
        """The key of the pressed button."""
        return next((key for key, button in self.buttons.items() if button.isChecked()), None)

    def _press(self, key: str) -> None:
        self.show_choice(key)
        self.chosen.emit(key)


def chip(text: str, tip: str = "") -> QToolButton:
    """Return a filter that is on or off; its text may have a count."""
    made = QToolButton()
    made.setText(text)
    made.setCheckable(True)
    made.setProperty("chip", True)
    made.setToolTip(tip)
    made.setFixedHeight(SMALL_CONTROL)
    made.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
    return made
