"""The known controls at the left of the page: name and family, state and address;
the one of the project first.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QRect, QSize, Qt, Signal
from PySide6.QtGui import QFontMetrics, QKeySequence, QPainter, QShortcut
from PySide6.QtWidgets import (
    QLabel,
    QLineEdit,
    QListWidget,
    QListWidgetItem,
    QSizePolicy,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QToolButton,
    QWidget,
)

from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import GAP2, GAP3, HEAD, ICON, TWO_LINE_ROW, colour, font, icon, paint_icon
from amp_studio.ui.forms.icon_button import icon_button

from .rows import side_by_side

_KEY, _LINES = Qt.ItemDataRole.UserRole + 1, Qt.ItemDataRole.UserRole + 2


@dataclass(frozen=True, slots=True)
class ListedControl:
    """One control as it is listed."""

    address: str
    name: str
    family: str
    state: str
    warns: bool = False
    """Whether the state is one that needs something."""


class _ControlDelegate(QStyledItemDelegate):
    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        return QSize(0, TWO_LINE_ROW)

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        place, listed = option.rect, index.data(_LINES)
        if option.state & QStyle.StateFlag.State_Selected:
            painter.fillRect(place, colour("selbg"))
            painter.fillRect(place.left(), place.top(), 2, place.height(), colour("sel"))
        paint_icon(
            painter,
            QRect(place.left() + GAP3, place.center().y() - ICON // 2, ICON, ICON),
            "cpu",
            colour("dim"),
        )
        left, room = place.left() + GAP3 + ICON + GAP2, place.width() - GAP3 - ICON - 2 * GAP2
        lines = (
            (font("text", own=True), "text", listed.name, listed.family, place.top() + 4),
            (
                font("small"),
                "warn" if listed.warns else "dim",
                listed.state,
                # The usual way to a control is not written: there is little room, and the tip has all of it.
                listed.address.removeprefix("tcp://"),
                place.center().y() + 1,
            ),
        )
        for letters, colour_name, first, second, top in lines:
            metrics = QFontMetrics(letters)
            text = metrics.elidedText(first, Qt.TextElideMode.ElideRight, room)
            painter.setFont(letters)
            painter.setPen(colour(colour_name))  # type: ignore[arg-type]  # one of the two above
            painter.drawText(QRect(left, top, room, metrics.height()), Qt.AlignmentFlag.AlignLeft, text)
            wide = metrics.horizontalAdvance(text) + GAP2
            small = font("small")
            painter.setFont(small)
            painter.setPen(colour("dim"))
            rest = QFontMetrics(small).elidedText(second, Qt.TextElideMode.ElideMiddle, max(0, room - wide))
            painter.drawText(
                QRect(left + wide, top, room - wide, metrics.height()), Qt.AlignmentFlag.AlignLeft, rest
            )


class KnownList(QWidget):
    """A click chooses; "+" has a field for an address, so that nothing is asked in a box."""

    chosen = Signal(str)
    several_chosen = Signal(bool)
    """Several controls at once are wanted, or one again."""

    def __init__(self) -> None:
        super().__init__()
        title = QLabel(self.tr("Controls"))
        title.setFont(font("text", own=True))
        add = icon_button("plus", self.tr("Add a control by its address"), is_flat=True)
        add.clicked.connect(self.ask)
        top = QWidget()
        in_row((title, 1), add, on=top, margins=(GAP3, 0, GAP2, 0))
        top.setFixedHeight(HEAD)
        self.field = QLineEdit()
        self.field.setPlaceholderText("tcp://192.168.0.10:9600")
        self.field.setToolTip("tcp://192.168.0.10:9600, /dev/ttyUSB0, COM3")
        self.field.setAccessibleName(self.tr("Address of a control"))
        self.field.returnPressed.connect(self._enter)
        self.field.hide()
        self.list = QListWidget()
        self.list.setFrameShape(QListWidget.Shape.NoFrame)
        self.list.setItemDelegate(_ControlDelegate(self.list))
        self.list.setAccessibleName(self.tr("Controls"))
        self.list.itemClicked.connect(lambda item: self.chosen.emit(item.data(_KEY)))
        self.list.itemActivated.connect(lambda item: self.chosen.emit(item.data(_KEY)))
        plus = QShortcut(QKeySequence("+"), self.list)
        # In the list alone: in the field + is a character.
        plus.setContext(Qt.ShortcutContext.WidgetShortcut)
        plus.activated.connect(self.ask)
        self.setFocusProxy(self.list)
        self.several = QToolButton()
        self.several.setText(self.tr("Several Controls"))
        self.several.setIcon(icon("list-numbers"))
        self.several.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
        self.several.setCheckable(True)
        self.several.setAutoRaise(True)
        self.several.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.several.clicked.connect(self.several_chosen)
        in_column(
            top, self.field, (self.list, 1), side_by_side(HEAD, self.several), on=self, margins=0, gap=0
        )
        self.setFixedWidth(236)

    def ask(self) -> None:
        """Open the field for an address."""
        self.field.show()
        self.field.setFocus()

    def _enter(self) -> None:
        if text := self.field.text().strip():
            self.field.clear()
            self.field.hide()
            self.chosen.emit(text)

    def show_controls(self, listed: Sequence[ListedControl], chosen: str) -> None:
        """List controls and mark the chosen one."""
        self.list.clear()
        for each in listed:
            item = QListWidgetItem()
            item.setData(_KEY, each.address)
            item.setData(_LINES, each)
            item.setData(
                Qt.ItemDataRole.AccessibleTextRole, f"{each.name} {each.family}, {each.state}, {each.address}"
            )
            item.setToolTip(each.address)
            self.list.addItem(item)
            if each.address == chosen:
                self.list.setCurrentItem(item)
        # With nothing to choose the field is the way to go on.
        if not listed:
            self.field.show()
        self.setFocusProxy(self.list if listed else self.field)
