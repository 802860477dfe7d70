"""The table of a file and its pictures: side by side, one below the other,
or the pictures in the place of the table.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, get_args

from PySide6.QtCore import Qt, QTimer, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QSplitter, QWidget

Arrangement = Literal["beside", "below", "instead"]
_WIDE, _TALL = 1000, 440
"""Width from which pictures are beside the table, height from which they are below it,
while the user has not chosen."""
_MIN_WIDTH, _MIN_HEIGHT = 720, 380
"""Least width and height for what a person has chosen; in a smaller room the pictures cover the table."""


@dataclass(frozen=True)
class PictureLayout:
    """The chosen place of pictures, and how much of the room the table keeps then, in percent."""

    choice: Arrangement | None = None
    """None: wherever there is room."""
    beside: int = 50
    below: int = 45
    is_shown: bool = False
    """Whether a file that is opened shows its pictures."""

    def __str__(self) -> str:
        """Return it as a text for the settings."""
        return f"{self.choice or 'auto'} {self.beside} {self.below} {int(self.is_shown)}"

    @classmethod
    def read(cls, kept: object) -> PictureLayout:
        """Return what was stored; any other text is ignored."""
        parts = kept.split() if isinstance(kept, str) else []
        if len(parts) != 4 or not all(part in ("0", "1") or part.isdecimal() for part in parts[1:]):
            return cls()
        beside, below = (min(max(int(part[:3]), 20), 80) for part in parts[1:3])
        choice = next((each for each in get_args(Arrangement) if each == parts[0]), None)
        return cls(choice, beside, below, parts[3] == "1")

    def fitting(self, width: int, height: int) -> Arrangement:
        """Return the arrangement for a room."""
        if self.choice == "beside" and width >= _MIN_WIDTH:
            return "beside"
        if self.choice == "below" and height >= _MIN_HEIGHT:
            return "below"
        if self.choice is not None:
            return "instead"
        return "beside" if width >= _WIDE else "below" if height >= _TALL else "instead"


class SidePage(QWidget):
    """What is beside the table, and how high it has to be."""

    least_changed = Signal()
    """It may need more height."""

    @property
    def least_height(self) -> int:
        """The height below which it cannot be read; 0 for any height."""
        return 0


class PictureSplit(QSplitter):
    """Table and pictures with a border between them that is dragged."""

    arranged = Signal(object)
    """A person has dragged the border: the layout is new."""
    rearranged = Signal()
    """The pictures are in another place, or come or go."""

    def __init__(self, sheet: QWidget) -> None:
        super().__init__()
        self._sheet = sheet
        self._pictures: SidePage | None = None
        self._placed: Arrangement = "beside"
        self._chosen = PictureLayout()
        self.setChildrenCollapsible(False)
        self.addWidget(sheet)
        self.splitterMoved.connect(self._keep_border)

    @property
    def is_shown(self) -> bool:
        """Whether the pictures are shown."""
        return self._pictures is not None and not self._pictures.isHidden()

    @property
    def covers(self) -> bool:
        """Whether the pictures are shown in the place of the table."""
        return self.is_shown and self._sheet.isHidden()

    @property
    def arrangement(self) -> Arrangement:
        """Where the pictures are, or would be: in the place of the table where the height below it is not
        enough for the one that is shown.
        """
        place = self._chosen.fitting(self.width(), self.height())
        least = self._pictures.least_height if self._pictures is not None else 0
        low = place == "below" and (100 - self._chosen.below) * self.height() < 100 * least
        return "instead" if low else place

    def take(self, pictures: SidePage) -> None:
        """Take the page of pictures in, hidden."""
        self._pictures = pictures
        pictures.least_changed.connect(self._follow_place)
        pictures.hide()
        self.addWidget(pictures)

    def show_pictures(self, visible: bool) -> None:
        """Show the pictures where they belong, or the table alone."""
        if self._pictures is not None:
            self._pictures.setVisible(visible)
            self._arrange()

    def arrange(self, layout: PictureLayout) -> None:
        """Put the pictures into the chosen place."""
        self._chosen = layout
        self._arrange()

    def _arrange(self) -> None:
        place = self._placed = self.arrangement
        is_below = place == "below"
        self.setOrientation(Qt.Orientation.Vertical if is_below else Qt.Orientation.Horizontal)
        self._sheet.setVisible(not self.is_shown or place != "instead")
        share = self._chosen.below if is_below else self._chosen.beside
        self.setSizes([share * 100, (100 - share) * 100])
        self.rearranged.emit()

    def _keep_border(self, *_: object) -> None:
        table, pictures = self.sizes()
        share = round(100 * table / max(table + pictures, 1))
        share = min(max(share, 20), 80)
        is_below = self.orientation() == Qt.Orientation.Vertical
        self._chosen = replace(self._chosen, below=share) if is_below else replace(self._chosen, beside=share)
        self.arranged.emit(self._chosen)

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._follow_place()

    def _follow_place(self) -> None:
        if self.is_shown and self._placed != self.arrangement:
            QTimer.singleShot(0, self, self._arrange)  # not while the layout is at work
