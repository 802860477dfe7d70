"""The bits of a packed word below its cell while it is edited: a check for each bit,
and the number beside them.
"""

from __future__ import annotations

from PySide6.QtCore import QPoint, QRect, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFontMetrics
from PySide6.QtWidgets import QFrame, QLabel, QListWidget, QListWidgetItem, QWidget

from amp_studio.schema import Bit, Parameter, field_value
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import GAP, GAP2, ROW, colour, font, scheme
from amp_studio.ui.base.translated import label_in_words

_MAX_ROWS = 12
_NARROWEST, _WIDEST = 240, 420
_FIELD = Qt.ItemDataRole.UserRole


class MaskList(QFrame):
    """Lists the bits and fields of a word. It never takes the focus: the keys come from the field above."""

    changed = Signal(int)
    """The word after a bit was checked or unchecked."""

    def __init__(self, parameter: Parameter, parent: QWidget) -> None:
        super().__init__(parent)
        self._word = 0
        self.setObjectName("mask")
        self.list = QListWidget()
        self.list.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self.list.setFrameShape(QFrame.Shape.NoFrame)
        self.list.setUniformItemSizes(True)
        self.list.setAccessibleName(self.tr("Bits"))
        self._count, self._number = QLabel(), QLabel()
        for label in (self._count, self._number):
            label.setFont(font("small"))
        self._fields: tuple[Bit, ...] = tuple(parameter.bits or ())
        for field in self._fields:
            self._add(field)
        in_column(
            self.list,
            in_row(self._count, 0, self._number, margins=(GAP2, 0, GAP2, 0)),
            on=self,
            margins=(1, GAP, 1, GAP),
            gap=GAP,
        )
        metrics = QFontMetrics(self.list.font())
        wanted = (
            max((metrics.horizontalAdvance(self._text(field, 0)) for field in self._fields), default=0)
            + 8 * GAP2
        )
        # As wide as its labels: it covers cells of the table while it is open.
        self.setFixedWidth(max(_NARROWEST, min(_WIDEST, wanted)))
        self.list.setFixedHeight(min(_MAX_ROWS, max(1, self.list.count())) * ROW + 2)
        self.list.itemClicked.connect(self._toggle)
        self._apply_colours()
        scheme().changed.connect(self._apply_colours)

    def _apply_colours(self) -> None:
        """Take the colours of light or dark."""
        self.setStyleSheet(
            f"#mask {{ background: {colour('raised').name()}; border: 1px solid {colour('line2').name()};"
            " border-radius: 4px; }"
        )
        for label in (self._count, self._number):
            label.setStyleSheet(f"color: {colour('dim').name()}; background: transparent")
        self.show_word(self._word)

    def _add(self, field: Bit) -> None:
        item = QListWidgetItem()
        item.setData(_FIELD, field)
        item.setFlags(Qt.ItemFlag.ItemIsEnabled | Qt.ItemFlag.ItemIsSelectable)
        item.setText(self._text(field, 0))
        item.setSizeHint(QSize(0, ROW))
        self.list.addItem(item)

    def _text(self, field: Bit, word: int) -> str:
        """Return ``Handwheel 1 fitted   bit 0``, with the choice or number of a field of several bits."""
        number = field_value(field, word)
        if _is_bit(field):
            return self.tr("{label}   bit {number}").format(
                label=label_in_words(field.label), number=field.bit
            )
        label = next((c.label for c in field.choices or () if c.raw == number), str(number))
        return f"{label_in_words(field.label)}: {label_in_words(label)}"

    def show_word(self, word: int) -> None:
        """Show a word."""
        self._word = word
        checked = 0
        for n, field in enumerate(self._fields):
            item = self.list.item(n)
            item.setText(self._text(field, word))
            if _is_bit(field):
                is_set = bool(word >> field.bit & 1)
                checked += is_set
                item.setCheckState(Qt.CheckState.Checked if is_set else Qt.CheckState.Unchecked)
            else:
                # A field of several bits has no box: one click could not choose among its values.
                item.setForeground(QColor(colour("dim")))
        bits = sum(map(_is_bit, self._fields))
        self._count.setText(self.tr("{count} of {bits} bits set").format(count=checked, bits=bits))
        self._number.setText(self.tr("hex {hex}, decimal {number}").format(hex=f"{word:X}", number=word))

    def go(self, step: int) -> None:
        """Go to another row."""
        row = self.list.currentRow() + step
        self.list.setCurrentRow(max(0, min(self.list.count() - 1, row)))

    @property
    def has_current(self) -> bool:
        """Whether a row was gone to by keys."""
        return self.list.currentRow() >= 0

    def toggle_current(self) -> None:
        """Check or uncheck the current row."""
        item = self.list.currentItem()
        if item is not None:
            self._toggle(item)

    def _toggle(self, item: QListWidgetItem) -> None:
        field: Bit = item.data(_FIELD)
        if _is_bit(field):
            self.show_word(self._word ^ 1 << field.bit)
            self.changed.emit(self._word)

    def place_below(self, editor: QRect) -> None:
        """Put it below an editor, or above where there is no room."""
        size, room = self.sizeHint(), self.parentWidget().rect()
        height = min(size.height(), room.height())
        top = editor.bottom() + 2
        if top + height > room.height():
            top = max(0, editor.top() - height - 2)
        left = max(0, min(editor.left(), room.width() - self.width()))
        self.setGeometry(QRect(QPoint(left, top), QPoint(left + self.width() - 1, top + height - 1)))
        self.show()
        self.raise_()


def _is_bit(field: Bit) -> bool:
    return field.width == 1 and not field.choices
