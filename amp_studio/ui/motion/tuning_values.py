"""A page of values that are tuned at the machine: increased and decreased in steps, replaced, or added to."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction

from PySide6.QtCore import QEvent, QObject, Qt, Signal
from PySide6.QtGui import QKeyEvent
from PySide6.QtWidgets import QComboBox, QHeaderView, QLabel, QPushButton, QTableWidgetItem

from amp_studio.calibration import CalibrationError, TuningPage, stepped, steps_of, usual_step
from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value, limits, read_exact, write_number
from amp_studio.ui.base.figures import range_in_words, show_value, written
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.places import place_in_words
from amp_studio.ui.base.questions import type_text
from amp_studio.ui.base.theme import GAP2, colour
from amp_studio.ui.base.translated import unit_in_words, worded
from amp_studio.ui.forms.table_items import item_at

from .tuning_part import TuningPart, table_of_rows
from .tuning_target import effect_words

_INSTANCE, _NAME, _VALUE, _ALLOWED, _EFFECT = range(5)
_SIGNS: dict[object, int] = {"+": 1, "-": -1, Qt.Key.Key_Plus: 1, Qt.Key.Key_Minus: -1}
"""The text or key of a step -> its sign."""
_ADDRESS = Qt.ItemDataRole.UserRole


_MIN_COLUMN = 80
"""Width in pixels of a column of the table at least."""


class ValuesPage(TuningPart):
    """The parameters of one page, a row for each axis or spindle that has them."""

    axis_chosen = Signal(str)
    """The axis under the cursor."""

    def __init__(
        self,
        page: TuningPage,
        guarded: Callable[[Callable[[], object]], object],
        measured: Callable[[str], object] | None = None,
    ) -> None:
        """``guarded`` runs what may fail and shows the error;
        ``measured`` asks for measured points of an axis.
        """
        super().__init__(guarded)
        self.page = page
        self._filling = False
        self.hint = QLabel()
        self.hint.setWordWrap(True)
        self.table = table_of_rows(5, self.tr("Values to tune: {page}").format(page=worded(page.title)))
        self.table.setHorizontalHeaderLabels(
            [
                self.tr("Axis"),
                self.tr("Parameter"),
                self.tr("Value"),
                self.tr("Allowed"),
                self.tr("Takes Effect"),
            ]
        )
        self.table.verticalHeader().hide()
        self.table.setWordWrap(False)
        head = self.table.horizontalHeader()
        head.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        head.setSectionResizeMode(_EFFECT, QHeaderView.ResizeMode.Stretch)
        for column in (_INSTANCE, _NAME, _VALUE, _ALLOWED):
            head.setSectionResizeMode(column, QHeaderView.ResizeMode.ResizeToContents)
        head.setMinimumSectionSize(_MIN_COLUMN)
        self.table.itemChanged.connect(self._typed)
        self.table.currentCellChanged.connect(lambda *_: self._moved())
        self.table.installEventFilter(self)
        self.step = QComboBox()
        self.step.setAccessibleName(self.tr("Step"))
        self.decrease = self._button(self.tr("&Decrease"), lambda: self._change(-1))
        self.increase = self._button(self.tr("&Increase"), lambda: self._change(1))
        self.replace = self._button(self.tr("&Replace"), self._replace)
        self.add = self._button(self.tr("&Add to Value…"), self._add)
        for button in (self.decrease, self.increase):
            button.setAutoRepeat(True)
        self.decrease.setToolTip(self.tr("One step less (the key −; with Ctrl ten steps)"))
        self.increase.setToolTip(self.tr("One step more (the key +; with Ctrl ten steps)"))
        self.replace.setToolTip(self.tr("Type another value (F2)"))
        self.add.setToolTip(self.tr("Add a number to the value (A)"))
        step_label = QLabel(self.tr("&Step"))
        step_label.setBuddy(self.step)
        row = in_row(self.decrease, self.increase, step_label, self.step, self.replace, self.add, 0)
        self.read: QPushButton | None = None
        if measured is not None:
            self.read = self._button(
                self.tr("Read &Measured Points…"), lambda: measured(self.address[1]) if self.address else None
            )
            row.addWidget(self.read)
        in_column(self.hint, (self.table, 1), row, on=self, gap=GAP2)

    # -- what is shown -----------------------------------------------------------

    def addresses(self) -> list[Address]:
        """Return what can be tuned here, one axis after the other."""
        assert self.target is not None
        file = self.target.file
        found = [
            (name, instance)
            for name in self.page.params
            for instance in file.machine_schema.instances(file.schema.parameters[name])
            if self._is_relevant(file, (name, instance))
        ]
        # In the order of the schema, which a sort of names would break: axis 10 behind axis 9.
        order = list(dict.fromkeys(instance for _, instance in found))
        return sorted(found, key=lambda address: order.index(address[1]))  # one axis after the other

    @staticmethod
    def _is_relevant(file: ParameterFile, address: Address) -> bool:
        """Return whether a value is shown: active, or inactive and set."""
        state = file.evaluation.state(address)
        return state.is_active or (state.state != "hidden" and file.get(address) is not None)

    @property
    def address(self) -> Address | None:
        """The value under the cursor."""
        item = self.table.item(self.table.currentRow(), _NAME)
        return item.data(_ADDRESS) if item is not None else None

    def _refresh(self, *_: object) -> None:
        if self.target is None:
            return
        self._filling = True
        row, addresses = self.table.currentRow(), self.addresses()
        self.table.setRowCount(len(addresses))
        for n, address in enumerate(addresses):
            self._fill_row(n, address)
        # The same row again, where the list has become shorter the last one.
        self.table.setCurrentCell(max(0, min(row, len(addresses) - 1)), _VALUE)
        self._filling = False
        page = self.tr("Page {page}.").format(page=self.page.page)
        none = self.tr("No axis of this file has any of these values.") if not addresses else ""
        note = worded(self.page.note, self.target.file.schema.family.family)
        self.hint.setText(" ".join(filter(None, (none, note, page))))
        may = self.target.may_edit and bool(addresses)
        for widget in (self.decrease, self.increase, self.replace, self.add, self.step, self.read):
            if widget is not None:
                widget.setEnabled(may)
        self._offer_steps()

    def _fill_row(self, row: int, address: Address) -> None:
        assert self.target is not None
        file = self.target.file
        parameter = file.schema.parameters[address[0]]
        state = file.evaluation.state(address)
        unit = file.evaluation.unit(address, file.header.units)
        allowed = limits(file.evaluation, address, unit)
        texts = (
            self._instance(address),
            file.machine_schema.label(address),
            show_value(parameter, file.get(address)),
            range_in_words(allowed) if allowed else "",
            effect_words(file.schema, address),
        )
        may = self.target.may_edit and state.is_active
        for column, text in enumerate(texts):
            item = item_at(self.table, row, column)
            flags = Qt.ItemFlag.ItemIsSelectable | Qt.ItemFlag.ItemIsEnabled
            item.setFlags(flags | Qt.ItemFlag.ItemIsEditable if column == _VALUE and may else flags)
            item.setText(text)
            item.setToolTip(text if state.is_active else worded(state.why, file.schema.family.family))
            item.setForeground(colour("text" if state.is_active and column != _ALLOWED else "dim"))
            if column == _VALUE:
                item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
            if column == _NAME:
                item.setData(_ADDRESS, address)

    def _instance(self, address: Address) -> str:
        """Return which axis, spindle or gear it is, an axis with its letter."""
        assert self.target is not None
        return place_in_words(self.target.file, address) or self.tr("Control")

    def _moved(self) -> None:
        self._offer_steps()
        if self.address is not None and not self._filling:
            self.axis_chosen.emit(self.address[1])

    def _offer_steps(self) -> None:
        address = self.address
        if self.target is None or address is None or self._filling:
            return
        file = self.target.file
        steps, unit = steps_of(file, address), file.evaluation.unit(address, file.header.units)
        texts = [f"{written(write_number(float(step)))} {unit_in_words(unit)}".strip() for step in steps]
        # Only for other steps: filling the box again would undo the person's choice at each change.
        if texts != [self.step.itemText(n) for n in range(self.step.count())]:
            self.step.clear()
            for text, step in zip(texts, steps, strict=True):
                self.step.addItem(text, step)
            self.step.setCurrentIndex(steps.index(usual_step(file, address)) if steps else -1)

    # -- changing ----------------------------------------------------------------

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take the keys + and - for steps and A for an addition, which the table would take for a search."""
        if watched is self.table and isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress:
            ten = event.modifiers() & Qt.KeyboardModifier.ControlModifier
            # By text on every keyboard layout, by key with Ctrl, where there is no text.
            if sign := _SIGNS.get(event.text()) or _SIGNS.get(event.key()):
                self._guarded(lambda: self._change(sign * (10 if ten else 1)))
                return True
            if event.key() == Qt.Key.Key_A and not event.modifiers():
                self._guarded(self._add)
                return True
        return super().eventFilter(watched, event)

    def _change(self, times: int) -> None:
        address, step = self.address, self.step.currentData()
        if address is None or step is None or self.target is None:
            return
        self._set(address, stepped(self.target.file, address, Fraction(step) * times), self.tr("Tune"))

    def _replace(self) -> None:
        item = self.table.item(self.table.currentRow(), _VALUE)
        if item is not None:
            self.table.setFocus()
            self.table.editItem(item)

    def _add(self) -> None:
        address = self.address
        if address is None or self.target is None:
            return
        file = self.target.file
        unit = unit_in_words(file.evaluation.unit(address, file.header.units))
        question = self.tr("Add to {name}, now {value} ({unit}):").format(
            name=file.machine_schema.label(address),
            value=show_value(file.schema.parameters[address[0]], file.get(address)),
            unit=unit or self.tr("a number"),
        )
        title = self.tr("Add to Value")
        text = type_text(self, title, question, title)
        if text is None or not text.strip():
            return
        # As a fraction: an addition must not leave digits that were not typed.
        number, rest = read_exact(text)
        if rest.strip():
            raise CalibrationError(
                self.tr("{text} is no bare number: it is added in {unit}.").format(text=text, unit=unit)
            )
        value = stepped(file, address, number)
        self._set(address, value, self.tr("Add to Value"))

    def _typed(self, item: QTableWidgetItem) -> None:
        if self._filling or item.column() != _VALUE or self.target is None:
            return
        address = self.table.item(item.row(), _NAME).data(_ADDRESS)
        text = item.text()
        target = self.target

        def act() -> None:
            try:
                self._set(address, target.file.read(address, text), self.tr("Tune"))
            finally:
                self._refresh()

        self._guarded(act)

    def _set(self, address: Address, value: Value, what: str) -> None:
        assert self.target is not None
        state = self.target.file.evaluation.state(address)
        # Also here: the keys and buttons reach values whose cell cannot be edited.
        if not state.is_active:
            label = self.target.file.machine_schema.label(address)
            why = worded(state.why, self.target.file.schema.family.family)
            raise CalibrationError(self.tr("{name} is not used: {why}.").format(name=label, why=why))
        self.target.set(f"{what} {self.target.file.machine_schema.label(address)}", {address: value})
