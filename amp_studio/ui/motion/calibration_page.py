"""The calibration table of an axis: its points, put in, replaced and deleted, as a curve,
and made of measured points.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Literal

from PySide6.QtCore import Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QCheckBox, QComboBox, QHeaderView, QLabel, QSplitter, QTableWidgetItem, QWidget

from amp_studio.calibration import (
    CalibrationError,
    CalibrationTable,
    Compensation,
    TableForm,
    axes_of,
    compensation_of,
    deleted,
    inserted,
    left_over,
    present_table,
    rechosen,
    replaced,
    shown_unit,
)
from amp_studio.files import ParameterFile
from amp_studio.schema import Value, read_exact
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.questions import type_text
from amp_studio.ui.base.theme import GAP2, colour, font
from amp_studio.ui.base.translated import sentenced, unit_in_words, worded
from amp_studio.ui.forms.form import Field, FieldForm

from .error_plot import ErrorPlot, ErrorTrace
from .tuning_part import TuningPart, table_of_rows

_AT, _FIGURE, _ERROR = range(3)


class CalibrationPage(TuningPart):
    """The table of one axis at a time."""

    def __init__(
        self, guarded: Callable[[Callable[[], object]], object], measured: Callable[[str], object]
    ) -> None:
        """``guarded`` runs what may fail and shows the error;
        ``measured`` asks for measured points of an axis.
        """
        super().__init__(guarded)
        self._measured = measured
        self._filling = False
        self.axis, self.input, self.start = QComboBox(), QComboBox(), QComboBox()
        for key, text in (("measurement", self.tr("measured position")), ("deviation", self.tr("deviation"))):
            self.input.addItem(text, key)
        for key, text in (("+", self.tr("most positive position")), ("-", self.tr("most negative position"))):
            self.start.addItem(text, key)
        self.table = table_of_rows(3, self.tr("Points of the calibration table"))
        self.table.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)
        self.plot = ErrorPlot(self.tr("Errors that the table takes away"))
        self.was_on = QCheckBox(self.tr("Calibration is &on while points are measured"))
        self.was_on.setToolTip(
            self.tr(
                "A figure that is put in is what the table has left over, and is added to it (page 36-10)"
            )
        )
        self.fault, self.limits = QLabel(), QLabel()
        for label in (self.fault, self.limits):
            label.setWordWrap(True)
            label.setTextFormat(Qt.TextFormat.PlainText)
        self.limits.setFont(font("small"))
        self.insert = self._button(self.tr("&Insert Point…"), self._insert)
        self.replace = self._button(self.tr("&Replace"), self._edit)
        self.delete = self._button(self.tr("De&lete Point"), self._delete)
        self.clear = self._button(self.tr("Delete All Poin&ts"), self._clear)
        self.read = self._button(self.tr("Read &Measured Points…"), lambda: measured(self.axis.currentData()))
        self.read.setProperty("primary", "true")
        self._arrange()
        self.axis.currentIndexChanged.connect(lambda *_: self._refresh([]) if not self._filling else None)
        for box in (self.input, self.start):
            box.activated.connect(lambda *_: self._guarded(self._rechoose))
        self.table.itemChanged.connect(self._typed)
        for keys, act in (("Ins", self._insert), ("Del", self._delete)):
            shortcut = QShortcut(QKeySequence(keys), self.table)
            shortcut.setContext(Qt.ShortcutContext.WidgetShortcut)
            shortcut.activated.connect(lambda act=act: self._guarded(act))
        self._chosen = ("", "")

    def _arrange(self) -> None:
        form = FieldForm(
            (
                Field("axis", self.tr("A&xis"), "choice", editor=lambda: self.axis),
                Field(
                    "input",
                    self.tr("&Figures are"),
                    "choice",
                    editor=lambda: self.input,
                    visible=lambda _: self._offers("inputs"),
                ),
                Field(
                    "start",
                    self.tr("Starts at the"),
                    "choice",
                    editor=lambda: self.start,
                    visible=lambda _: self._offers("starts"),
                ),
            )
        )
        self._form = form
        buttons = in_row(self.insert, self.replace, self.delete, self.clear, 0)
        left, right = QWidget(), QWidget()
        in_column(form, self.was_on, (self.table, 1), buttons, on=left, margins=(0, 0, GAP2, 0))
        column = in_column((self.plot, 1), self.fault, self.limits, on=right, margins=(GAP2, 0, 0, 0))
        column.addWidget(self.read, 0, Qt.AlignmentFlag.AlignLeft)
        splitter = QSplitter()
        splitter.addWidget(left)
        splitter.addWidget(right)
        splitter.setChildrenCollapsible(False)
        in_column(splitter, on=self)

    # -- what is shown -----------------------------------------------------------

    def _refresh(self, *_: object) -> None:
        if self.target is None:
            return
        file, self._filling = self.target.file, True
        axes = axes_of(file)
        # Filled again only for other axes: the choice of the user stays.
        if [self.axis.itemData(n) for n in range(self.axis.count())] != list(axes):
            self.axis.clear()
            for axis in axes:
                self.axis.addItem(_axis_text(file, axis), axis)
        offered = self._offered(file)
        form = offered.table
        for widget in (
            self.table,
            self.input,
            self.start,
            self.insert,
            self.replace,
            self.delete,
            self.clear,
            self.plot,
        ):
            widget.setVisible(form is not None)
        self._form.show_visible()
        if axes and form is not None:
            self._show_table(file, offered)
        elif form is None:
            self.limits.setText(
                self.tr("This control has no calibration table of an axis, only a reversal error.")
            )
        self.read.setEnabled(bool(axes) and self.target.may_edit)
        self._filling = False

    def _offers(self, what: Literal["inputs", "starts"]) -> bool:
        """Return whether the table of the control has several kinds of figures, or of beginnings."""
        table = self._offered(self.target.file).table if self.target else None
        return table is not None and bool(getattr(table, what))

    @staticmethod
    def _offered(file: ParameterFile) -> Compensation:
        return compensation_of(file.schema.family.family)

    def _show_table(self, file: ParameterFile, offered: Compensation) -> None:
        form, axis = offered.table, self.axis.currentData()
        family = file.schema.family.family
        assert form is not None
        try:
            table = self.present()
            fault = " ".join(form.remarks(file, axis, table))
        except CalibrationError as error:
            # A text that is no table is shown as none, with the reason: it can still be deleted.
            table, fault = CalibrationTable("mm", ()), str(error)
        try:
            lines = (*form.limits(file, axis), form.switching)
        except CalibrationError as error:
            lines = (str(error), form.switching)
        self.fault.setText(sentenced(fault, family))
        self.fault.setStyleSheet(f"color: {colour('warn').name()}")
        self.fault.setVisible(bool(fault))
        self.limits.setText("\n".join(sentenced(line, family) for line in lines))
        self._fill(table)
        self.plot.show_errors(
            (ErrorTrace(self.tr("error that the table takes away"), table.curve, "now"),), table.unit
        )
        self._enable_changes(file, form, table)
        state = file.evaluation.state((form.parameter, axis))
        if not state.is_active:
            self.fault.setText(worded(state.why, family))
            self.fault.show()

    def _enable_changes(self, file: ParameterFile, form: TableForm, table: CalibrationTable) -> None:
        """Switch on what can be done with the table of the axis."""
        assert self.target is not None
        address = form.parameter, self.axis.currentData()
        has, state = bool(table.points), file.evaluation.state(address)
        may = self.target.may_edit and state.is_active
        self.insert.setEnabled(may and not (form.is_even and has))
        self.insert.setText(self.tr("&New Table") if form.is_even else self.tr("&Insert Point…"))
        self.delete.setVisible(not form.is_even)
        for button in (self.replace, self.delete):
            button.setEnabled(may and has)
        self.clear.setEnabled(may and file.get(address) is not None)
        for box, present in ((self.input, table.input), (self.start, table.start)):
            box.setEnabled(may and not has)
            box.setToolTip(
                self.tr("Can be chosen again when all points are deleted (page 36-6)") if has else ""
            )
            box.setCurrentIndex(max(0, box.findData(present)))

    def _fill(self, table: CalibrationTable) -> None:
        form = self._offered(self.target.file).table if self.target else None
        assert form is not None
        unit, size = shown_unit(self._file(), table)
        unit = unit_in_words(unit)
        figure = {"measurement": self.tr("Measured"), "deviation": self.tr("Deviation")}.get(
            table.input, self.tr("Correction")
        )
        heads = [self.tr("Control Reads"), figure, self.tr("Error")]
        self.table.setHorizontalHeaderLabels([f"{head} ({unit})" for head in heads])
        self.table.setColumnHidden(_ERROR, table.input == "deviation" or form.is_even)
        row = self.table.currentRow()
        self.table.setRowCount(len(table.points))
        for n, (at, by) in enumerate(table.points):
            for column, number in ((_AT, at), (_FIGURE, form.figure(table, at, by)), (_ERROR, by)):
                item = QTableWidgetItem(_figure(number / size))
                item.setTextAlignment(Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter)
                flags = Qt.ItemFlag.ItemIsSelectable | Qt.ItemFlag.ItemIsEnabled
                # A position is changed by deleting its point and inserting another.
                item.setFlags(flags | Qt.ItemFlag.ItemIsEditable if column == _FIGURE else flags)
                item.setForeground(colour("text" if column == _FIGURE else "dim"))
                self.table.setItem(n, column, item)
        if table.points:
            self.table.setCurrentCell(max(0, min(row, len(table.points) - 1)), _FIGURE)

    # -- changing ----------------------------------------------------------------

    def present(self) -> CalibrationTable:
        """Return the table of the axis, or the empty one with what was chosen; raises CalibrationError."""
        assert self.target is not None
        file, axis = self.target.file, self.axis.currentData()
        offered = self._offered(file)
        assert offered.table is not None
        table = present_table(file, offered, axis)
        # A table of fixed positions has points only once it is made.
        if table is None and offered.table.is_even:
            return CalibrationTable("mm", ())
        return offered.table.empty(file, axis, *self._chosen) if table is None else table

    def _set(self, table: CalibrationTable, what: str) -> None:
        assert self.target is not None
        file, axis = self.target.file, self.axis.currentData()
        form = self._offered(file).table
        assert form is not None
        text = form.write(file, axis, table)
        # A table without points is not set.
        value = Value(text) if text else None
        self.target.set(f"{what} {_axis_text(file, axis)}", {(form.parameter, axis): value})

    def _rechoose(self) -> None:
        table = rechosen(self.present(), self.input.currentData(), self.start.currentData())
        self._chosen = (table.input, table.start)
        self._refresh()

    def _selected(self) -> Fraction | None:
        row, points = self.table.currentRow(), self.present().points
        return points[row][0] if 0 <= row < len(points) else None

    def _insert(self) -> None:
        form = self._offered(self._file()).table
        if form is not None and form.is_even:
            self._set(form.empty(self._file(), self.axis.currentData(), "", ""), self.tr("New table of"))
            return
        table = self.present()
        unit, size = shown_unit(self._file(), table)
        question = self.tr("Position that the control reads ({unit}), and the figure beside it:").format(
            unit=unit
        )
        example = "0 0" if not table.points else ""
        title = self.tr("Insert Point")
        text = type_text(self, title, question, title, example)
        if text is None or not text.strip():
            return
        words = text.replace(";", " ").replace("=", " ").split()
        if len(words) != 2:
            raise CalibrationError(
                self.tr("{text} is not a position and a figure, as 100 0.004.").format(text=text)
            )
        at, figure = (_number(word) * size for word in words)
        form = self._offered(self._file()).table
        assert form is not None
        self._set(inserted(table, at, self._error(table, at, figure)), self.tr("Insert point of"))

    def _error(self, table: CalibrationTable, at: Fraction, figure: Fraction) -> Fraction:
        """Return the error that a typed figure means."""
        form = self._offered(self._file()).table
        assert form is not None
        error = form.error(table, at, figure)
        # Measured with the table at work, a figure is what is left: it goes on top of what the table has.
        return left_over(table, at, error) if self.was_on.isChecked() else error

    def _file(self) -> ParameterFile:
        assert self.target is not None
        return self.target.file

    def _edit(self) -> None:
        item = self.table.item(self.table.currentRow(), _FIGURE)
        if item is not None:
            self.table.setFocus()
            self.table.editItem(item)

    def _typed(self, item: QTableWidgetItem) -> None:
        # Qt emits itemChanged for what the program writes too.
        if self._filling or item.column() != _FIGURE:
            return
        row, text = item.row(), item.text()

        def act() -> None:
            try:
                table = self.present()
                at, (_, size) = table.points[row][0], shown_unit(self._file(), table)
                error = self._error(table, at, _number(text) * size)
                self._set(replaced(table, at, error), self.tr("Replace point of"))
            finally:
                self._refresh()

        self._guarded(act)

    def _delete(self) -> None:
        at = self._selected()
        if at is not None:
            self._set(deleted(self.present(), at), self.tr("Delete point of"))

    def _clear(self) -> None:
        file = self._file()
        form = self._offered(file).table
        assert form is not None
        assert self.target is not None
        axis = self.axis.currentData()
        what = self.tr("Delete all points of")
        self.target.set(f"{what} {_axis_text(file, axis)}", {(form.parameter, axis): None})


def _axis_text(file: ParameterFile, axis: str) -> str:
    from amp_studio.schema import axis_name

    letter = axis_name(file.evaluation, axis)
    return f"{axis} {letter}" if letter and letter != axis else axis


def _figure(number: Fraction) -> str:
    return f"{float(number):.5f}"


def _number(text: str) -> Fraction:
    number, rest = read_exact(text)
    if rest.strip():
        raise CalibrationError(f"{text[:40]} is no bare number: figures are in the unit of the table")
    return number
