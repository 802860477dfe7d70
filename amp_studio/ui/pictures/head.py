"""The head of the page of pictures: which picture, where the page is, and away with it."""

from __future__ import annotations

from PySide6.QtCore import QSize, Signal
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QComboBox, QLabel, QWidget

from amp_studio.ui.base.layout import in_row
from amp_studio.ui.base.theme import GAP2, GAP3, HEAD, font
from amp_studio.ui.forms.icon_button import icon_button
from amp_studio.ui.forms.segment import Segment

from .split import Arrangement


class PicturesHead(QWidget):
    """Names of the pictures as buttons, in a narrow page as a list."""

    chosen = Signal(str)
    place_requested = Signal(str)
    """Where the pictures shall be: an arrangement."""
    closed = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.names = Segment(self.tr("Pictures"))
        self.names.chosen.connect(self.chosen)
        self.list = QComboBox()
        self.list.setAccessibleName(self.names.accessibleName())
        self.list.activated.connect(lambda n: self.chosen.emit(self.list.itemData(n)))
        self.places = Segment(
            self.tr("Place of the pictures"),
            [("beside", "", "columns"), ("below", "", "rows"), ("instead", "", "square")],
        )
        for key, tip in (
            ("beside", self.tr("Pictures beside the table")),
            ("below", self.tr("Pictures below the table")),
            ("instead", self.tr("Pictures instead of the table")),
        ):
            self.places.buttons[key].setToolTip(tip)
            self.places.buttons[key].setAccessibleName(tip)
        self.places.chosen.connect(self.place_requested)
        tip, spoken = self.tr("Close the pictures (F12)"), self.tr("Close the pictures")
        self.close_button = icon_button("x", tip, spoken=spoken)
        self.close_button.clicked.connect(self.closed)
        self._title = QLabel(self.tr("Pictures"))
        self._title.setFont(font("title"))
        in_row(
            self._title,
            1,
            self.names,
            self.list,
            self.places,
            self.close_button,
            on=self,
            margins=(GAP3, 0, GAP2, 0),
            gap=GAP2,
        )
        self.setFixedHeight(HEAD + 6)
        self._fit()

    def offer(self, options: list[tuple[str, str, str]]) -> None:
        """Offer these pictures: key, name, icon."""
        self.names.offer(options)
        self.list.clear()
        for key, name, _ in options:
            self.list.addItem(name, key)
        self._fit()

    def show_choice(self, key: str) -> None:
        """Show which picture there is."""
        self.names.show_choice(key)
        self.list.setCurrentIndex(self.list.findData(key))

    def show_place(self, place: Arrangement) -> None:
        """Show where the pictures are."""
        self.places.show_choice(place)

    def minimumSizeHint(self) -> QSize:
        """Return little, so that the page can be narrow."""
        return QSize(240, super().minimumSizeHint().height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        rest = self.places.sizeHint().width() + self.close_button.sizeHint().width() + 8 * GAP2
        is_wide = self.width() >= self.names.sizeHint().width() + rest
        self.names.setVisible(is_wide)
        self.list.setVisible(not is_wide)
        title = self._title.sizeHint().width()
        names = self.names if is_wide else self.list
        self._title.setVisible(self.width() >= title + names.sizeHint().width() + rest)
