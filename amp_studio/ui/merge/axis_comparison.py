"""Two axes of a file side by side: where they differ, and the value of one taken for the other."""

from __future__ import annotations

from collections.abc import Sequence

from PySide6.QtCore import QSignalBlocker, QSize, Qt
from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QHBoxLayout,
    QLabel,
    QPushButton,
    QTreeWidget,
    QTreeWidgetItem,
    QWidget,
)

from amp_studio.files import AxisDifference, axis_letter, axis_title, bits_of_axes, compare_axes, fitted_axes
from amp_studio.schema import Address, Value
from amp_studio.ui.base.figures import show_value
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.theme import ROW
from amp_studio.ui.page.file_page import FilePage

_DIFFERENCE = Qt.ItemDataRole.UserRole


class AxisComparison(QDialog):
    """A list of the parameters of which two axes have different values; it follows the file."""

    def __init__(self, page: FilePage, first: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(self.tr("Compare axes"))
        self.resize(760, 480)
        self._page, self._workspace = page, page.workspace
        self.first, self.second = self._axis_box(first), self._axis_box("")
        self.second.setCurrentIndex(1 if self.first.currentIndex() == 0 else 0)
        self.first.setAccessibleName(self.tr("First axis"))
        self.second.setAccessibleName(self.tr("Second axis"))
        self.list = QTreeWidget()
        self.list.setAccessibleName(self.tr("Parameters that differ"))
        self.list.setRootIsDecorated(False)
        self.list.setUniformRowHeights(True)
        self.list.setSelectionMode(QTreeWidget.SelectionMode.ExtendedSelection)
        self.list.itemActivated.connect(self._go)
        self.count = QLabel()
        self.take_first, self.take_second = (QPushButton() for _ in range(2))
        self.take_first.clicked.connect(lambda: self._copy_selected(to_second=True))
        self.take_second.clicked.connect(lambda: self._copy_selected(to_second=False))
        self._lay_out()
        self.first.currentIndexChanged.connect(self.refresh)
        self.second.currentIndexChanged.connect(self.refresh)
        self._workspace.changed.connect(self.refresh)
        self._workspace.closed.connect(self.close)
        self.refresh()

    def _axis_box(self, axis: str) -> QComboBox:
        box = QComboBox()
        self._fill(box, axis)
        return box

    def _fill(self, box: QComboBox, axis: object) -> None:
        """Offer the fitted axes, with ``axis`` chosen where it is one of them."""
        with QSignalBlocker(box):
            box.clear()
            for each in fitted_axes(self._workspace.file):
                box.addItem(axis_title(self._workspace.file, each), each)
            box.setCurrentIndex(max(box.findData(axis), 0))

    def _lay_out(self) -> None:
        head = QHBoxLayout()
        for text, box in ((self.tr("&First axis"), self.first), (self.tr("&Second axis"), self.second)):
            label = QLabel(text)
            label.setBuddy(box)
            head.addWidget(label)
            head.addWidget(box)
        head.addStretch()
        close = QPushButton(self.tr("&Close"))
        close.clicked.connect(self.close)
        for button in (self.take_first, self.take_second, close):
            button.setAutoDefault(False)
        footer = in_row(self.count, 0, self.take_first, self.take_second, close)
        in_column(head, self.list, footer, on=self)

    # -- what differs ----------------------------------------------------------------

    def axes(self) -> tuple[str, str]:
        """Return the two axes."""
        return str(self.first.currentData()), str(self.second.currentData())

    def _list(self, found: Sequence[AxisDifference], titles: Sequence[str]) -> None:
        self.list.clear()
        self.list.setHeaderLabels([self.tr("Parameter"), *titles])
        for difference in found:
            item = QTreeWidgetItem(self._texts(difference))
            item.setData(0, _DIFFERENCE, difference)
            item.setSizeHint(0, QSize(0, ROW))
            self.list.addTopLevelItem(item)
        for column in range(2):
            self.list.resizeColumnToContents(column)

    def refresh(self, *_: object) -> None:
        """List again what differs; the current row stays where it was."""
        file, fitted = self._workspace.file, list(fitted_axes(self._workspace.file))
        if not fitted:  # nothing is left to compare
            self.close()
            return
        for box in (self.first, self.second):
            is_other = [box.itemData(n) for n in range(box.count())] != fitted  # axes came or went
            if is_other or box.currentIndex() < 0:
                self._fill(box, box.currentData())
        first, second = self.axes()
        row = max(self.list.currentIndex().row(), 0)
        titles = [axis_title(file, axis) for axis in (first, second)]
        found = compare_axes(file, first, second)
        self._list(found, titles)
        if found:
            self.list.setCurrentIndex(self.list.model().index(min(row, len(found) - 1), 0))
        self.count.setText(self._how_many(len(found)))
        may_take = bool(found) and self._workspace.may_edit
        for button, text, target in (
            (self.take_first, self.tr("&Take for {axis}"), second),
            (self.take_second, self.tr("Ta&ke for {axis}"), first),
        ):
            button.setText(text.format(axis=axis_letter(file, target) or target))
            button.setEnabled(may_take)

    def _how_many(self, count: int) -> str:
        if count == 1:
            return self.tr("1 parameter differs")
        return (
            self.tr("{count} parameters differ").format(count=count) if count else self.tr("No differences")
        )

    def _texts(self, difference: AxisDifference) -> list[str]:
        file = self._workspace.file
        parameter, here = file.schema.parameters[difference.first[0]], file.machine_schema
        name = here.label(difference.first).removesuffix(here.instance_label(difference.first)).rstrip()
        if difference.bits is None:
            secrets = self._workspace.secrets
            values = [file.get(a) for a in (difference.first, difference.second)]
            return [name, *(show_value(parameter, v, secrets=secrets) for v in values)]
        word = _word(file.get(difference.first))
        return [name, *(self.tr("yes") if word >> bit & 1 else self.tr("no") for bit in difference.bits)]

    # -- what is done with it --------------------------------------------------------

    def _go(self, item: QTreeWidgetItem, column: int) -> None:
        difference = item.data(0, _DIFFERENCE)
        self._page.go_to(difference.second if column == 2 else difference.first)

    def _copy_selected(self, *, to_second: bool) -> None:
        """Give one axis the selected values of the other, as one step."""
        file, axes = self._workspace.file, self.axes()
        source, target = axes if to_second else axes[::-1]
        wanted: dict[Address, Value | None] = {}
        for item in self.list.selectedItems():
            difference: AxisDifference = item.data(0, _DIFFERENCE)
            there, here = (
                (difference.first, difference.second) if to_second else (difference.second, difference.first)
            )
            if difference.bits is None:
                wanted[here] = file.get(there)
            else:
                is_set = bool(_word(file.get(there)) >> difference.bits[0 if to_second else 1] & 1)
                wanted[here] = bits_of_axes(file, {target: is_set})[here]
        if wanted:
            step = self.tr("Take values of axis {source} for {target}").format(source=source, target=target)
            self._workspace.edit(step, wanted)


def _word(value: Value | None) -> int:
    return int(float(value.value)) if value is not None else 0
