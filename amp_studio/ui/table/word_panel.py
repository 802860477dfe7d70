"""The bits and fields of a packed word: a check box for each bit, a list or a number for each field."""

from __future__ import annotations

import re
from collections.abc import Callable

from PySide6.QtCore import QSignalBlocker, QSize, Qt
from PySide6.QtGui import QFontMetrics, QResizeEvent
from PySide6.QtWidgets import (
    QComboBox,
    QFormLayout,
    QFrame,
    QLabel,
    QListView,
    QListWidget,
    QListWidgetItem,
    QScrollArea,
    QWidget,
)

from amp_studio.schema import Address, Bit, field_value
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.theme import GAP3, ROW
from amp_studio.ui.base.translated import label_in_words
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.number_box import WholeBox

_SHORT = 12
"""Labels up to this length are shown in several columns."""
_ROWS = 9
"""Number of check boxes shown without scrolling."""
_TICK = 44
"""Width in pixels of a check box with its margins."""
_MIN_LETTERS = 15
_TALLEST = 260
"""Height in pixels from which the boxes and fields are scrolled."""


class WordPanel(QScrollArea):
    """Shows the bits and fields of one address; hidden for a parameter without them."""

    def __init__(
        self, workspace: Workspace, commit: Callable[[Address, str], bool], parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._workspace, self._commit = workspace, commit
        self._address: Address | None = None
        self._is_filling = False
        self.ticks = QListWidget()
        self.ticks.setWordWrap(True)
        self.ticks.setResizeMode(QListView.ResizeMode.Adjust)
        self.ticks.setSpacing(1)
        self.ticks.itemChanged.connect(self._ticked)
        self.fields: dict[int, QComboBox | WholeBox] = {}
        self._form = QFormLayout()
        self._form.setRowWrapPolicy(QFormLayout.RowWrapPolicy.WrapLongRows)
        self._form.setFieldGrowthPolicy(QFormLayout.FieldGrowthPolicy.AllNonFixedFieldsGrow)
        inside = QWidget()
        in_column(self._form, self.ticks, 0, on=inside, margins=(4, 4, 4, 0))
        self.setWidget(inside)
        self.setWidgetResizable(True)
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setFocusProxy(self.ticks)
        self.hide()

    def show_address(self, address: Address | None) -> None:
        """Show the word of an address, or nothing."""
        parameters = self._workspace.file.schema.parameters
        bits = parameters[address[0]].bits or () if address else ()
        if address is None or not bits:
            self._address = None
            self.hide()
            return
        if self._address is None or self._address[0] != address[0]:
            self._build(bits)
        self._address = address
        self.refresh()
        self.show()

    def refresh(self) -> None:
        """Update the view from the present value."""
        if self._address is None:
            return
        self._is_filling = True
        word, may_edit = self._word(), self._may_edit()
        for n in range(self.ticks.count()):
            item = self.ticks.item(n)
            bit = item.data(Qt.ItemDataRole.UserRole)
            item.setCheckState(Qt.CheckState.Checked if word >> bit & 1 else Qt.CheckState.Unchecked)
            flags = item.flags() | Qt.ItemFlag.ItemIsUserCheckable
            item.setFlags(flags if may_edit else flags & ~Qt.ItemFlag.ItemIsUserCheckable)
        for field in self._bits():
            editor = self.fields.get(field.bit)
            found = field_value(field, word)
            if isinstance(editor, QComboBox):
                editor.setCurrentIndex(editor.findData(found))
            elif editor is not None:
                editor.setValue(found)
            if editor is not None:
                editor.setEnabled(may_edit)
        self._is_filling = False

    # -- the widgets -----------------------------------------------------------

    def _build(self, bits: tuple[Bit, ...]) -> None:
        self._is_filling = True
        self.ticks.clear()
        while self._form.rowCount():
            self._form.removeRow(0)
        self.fields.clear()
        for bit in bits:
            if bit.width == 1 and not bit.choices:
                self._add_tick(bit)
            else:
                self._add_field(bit)
        self._arrange()
        self._is_filling = False

    def _add_tick(self, bit: Bit) -> None:
        named = re.search(rf"(?<![\d.]){bit.bit}(?![\d.])", bit.label)  # "Axis 7" already names the bit
        item = QListWidgetItem(
            label_in_words(bit.label) if named else f"{bit.bit}  {label_in_words(bit.label)}"
        )
        item.setData(Qt.ItemDataRole.UserRole, bit.bit)
        item.setToolTip(self.tr("bit {bit}").format(bit=bit.bit))
        self.ticks.addItem(item)

    def _add_field(self, bit: Bit) -> None:
        editor: QComboBox | WholeBox
        if bit.choices:
            editor = QComboBox()
            editor.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
            editor.setMinimumContentsLength(_MIN_LETTERS)
            editor.setPlaceholderText(self.tr("another code"))
            for choice in bit.choices:
                editor.addItem(label_in_words(choice.label), choice.raw)
            editor.activated.connect(lambda _, b=bit, e=editor: self._set(b, e.currentData()))
        else:
            editor = WholeBox()
            half = 1 << bit.width - 1
            editor.setRange(*((-half, half - 1) if bit.signed else (0, 2 * half - 1)))
            editor.valueChanged.connect(lambda number, b=bit: self._set(b, number))
        editor.setToolTip(
            self.tr("bits {bit} to {what}").format(bit=bit.bit, what=bit.bit + bit.width - 1)
            if bit.width > 1
            else self.tr("bit {bit}").format(bit=bit.bit)
        )
        label = QLabel(label_in_words(bit.label))
        label.setWordWrap(True)
        label.setBuddy(editor)
        self._form.addRow(label, editor)
        self.fields[bit.bit] = editor

    def _arrange(self) -> None:
        """Arrange short labels in several columns, and set the height of the list."""
        count, metrics = self.ticks.count(), QFontMetrics(self.ticks.font())
        self.ticks.setVisible(count > 0)
        widest = max((metrics.horizontalAdvance(self.ticks.item(n).text()) for n in range(count)), default=0)
        short = all(len(self.ticks.item(n).text()) <= _SHORT for n in range(count))
        several = short and count > _ROWS
        self.ticks.setFlow(QListView.Flow.LeftToRight if several else QListView.Flow.TopToBottom)
        self.ticks.setWrapping(several)
        wide = widest + _TICK
        self.ticks.setGridSize(QSize(wide, ROW) if several else QSize())
        columns = max(1, (self.width() - 2 * GAP3) // wide)
        rows = -(-count // columns) if several else min(count, _ROWS)
        with QSignalBlocker(self.ticks):  # an item of another size is no tick of a person
            for n in range(count):
                self.ticks.item(n).setSizeHint(QSize(wide - 2, ROW - 2) if several else QSize())
        self.ticks.setFixedHeight(rows * ROW + 8)
        inside = self.widget()
        self.setMinimumHeight(min(inside.sizeHint().height() if inside else 0, _TALLEST))

    def resizeEvent(self, event: QResizeEvent) -> None:
        super().resizeEvent(event)
        self._arrange()

    # -- the value -------------------------------------------------------------

    def _bits(self) -> tuple[Bit, ...]:
        address = self._address
        return self._workspace.file.schema.parameters[address[0]].bits or () if address else ()

    def _word(self) -> int:
        value = self._workspace.file.get(self._address) if self._address else None
        return int(value.value) if value is not None and isinstance(value.value, (int, float)) else 0

    def _may_edit(self) -> bool:
        address = self._address
        parameter = self._workspace.file.schema.parameters[address[0]] if address else None
        return self._workspace.may_edit and parameter is not None and parameter.access != "read"

    def _ticked(self, item: QListWidgetItem) -> None:
        bit = next(b for b in self._bits() if b.bit == item.data(Qt.ItemDataRole.UserRole))
        self._set(bit, int(item.checkState() == Qt.CheckState.Checked))

    def _set(self, bit: Bit, number: int) -> None:
        if self._is_filling or self._address is None:
            return
        mask = (1 << bit.width) - 1
        # The mask makes a negative field its two's complement of that width.
        word = self._word() & ~(mask << bit.bit) | (number & mask) << bit.bit
        # Refused: the boxes must show what the file has, not what was clicked.
        if not self._commit(self._address, f"0x{word:X}"):
            self.refresh()
