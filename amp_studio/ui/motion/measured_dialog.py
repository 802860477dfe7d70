"""Measured points of an axis: what the file does not name is asked,
and what would be set is shown before anything is.
"""

from __future__ import annotations

from functools import partial
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QDialog, QLabel, QPlainTextEdit, QPushButton, QWidget

from amp_studio.calibration import (
    DECIMALS,
    ERROR_UNITS,
    POSITION_UNITS,
    CalibrationError,
    Measurement,
    MeasurementAnswers,
    Proposal,
    ProposalRequest,
    base_unit,
    compensation_of,
    lost_motion,
    present_table,
    propose,
    read_measured_file,
)
from amp_studio.files import ParameterFile
from amp_studio.ui.base.figures import show_value
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.screen_room import fit_to_screen
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.theme import GAP2, GAP3, colour
from amp_studio.ui.base.translated import sentenced, unit_in_words
from amp_studio.ui.forms.form import Field, FieldForm

from .error_plot import ErrorPlot, ErrorTrace

_ASK = "?"
"""Data of a choice that is not made."""


class MeasuredDialog(QDialog):
    """Shows what points make of an axis; ``proposal`` is what to set when it is accepted."""

    def __init__(self, file: ParameterFile, axis: str, path: Path, parent: QWidget | None = None) -> None:
        """Read the points; raises MeasurementError for a file that no answer makes readable, and OSError."""
        super().__init__(parent)
        self._file, self._axis, self._path = file, axis, path
        self.proposal: Proposal | None = None
        self._is_circle = False
        self.setWindowTitle(self.tr("Measured Points — {name}").format(name=path.name))
        fit_to_screen(self, 920, 620)
        self._offered = compensation_of(file.schema.family.family)
        self.form = FieldForm(self._fields())
        self.form.entered.connect(lambda _: self.refresh())
        self.summary, self.missing = QLabel(), QLabel()
        for label in (self.summary, self.missing):
            label.setWordWrap(True)
            label.setTextFormat(Qt.TextFormat.PlainText)
        self.notes = QPlainTextEdit()
        self.notes.setReadOnly(True)
        self.notes.setTabChangesFocus(True)
        self.notes.setAccessibleName(self.tr("Notes"))
        self.plot = ErrorPlot(self.tr("Mean errors as measured and as expected"))
        self.set_button, cancel = QPushButton(self.tr("&Set Values")), QPushButton(self.tr("Cancel"))
        self.set_button.setDefault(True)
        self.set_button.clicked.connect(self.accept)
        cancel.clicked.connect(self.reject)
        in_column(
            (
                in_row(
                    (in_column(self.form, self.summary, 1), 2),
                    (in_column((self.plot, 3), (self.notes, 1)), 3),
                    gap=GAP3,
                ),
                1,
            ),
            in_row((self.missing, 1), self.set_button, cancel),
            on=self,
            gap=GAP2,
        )
        self.refresh()

    def _fields(self) -> tuple[Field, ...]:
        named = ("", self.tr("as the file names it"))
        signs = (
            ("measured-target", self.tr("measured less target (ISO 230-2)")),
            ("target-measured", self.tr("target less measured (correction)")),
        )
        marks = ((DECIMALS[0], self.tr("point")), (DECIMALS[1], self.tr("comma")))
        states = (
            (_ASK, self.tr("choose…")),
            ("off", self.tr("off")),
            ("on", self.tr("on: points are what is left over")),
        )
        axes = (
            ("", self.tr("choose…")),
            ("first", self.tr("the first one: it turns round at 0° and 180°")),
            ("second", self.tr("the second one: at 90° and 270°")),
        )
        table = self._offered.table
        names = {"deviation": self.tr("deviation"), "measurement": self.tr("measured position")}
        inputs = [(key, names[key]) for key in reversed(table.inputs if table else ())]
        ends = {"-": self.tr("most negative position"), "+": self.tr("most positive position")}
        starts = [(key, ends[key]) for key in reversed(table.starts if table else ())]
        units = [named, *((unit, unit_in_words(unit)) for unit in POSITION_UNITS)]
        error_units = [named, *((unit, unit_in_words(unit)) for unit in ERROR_UNITS)]
        is_compensated = self._is_compensated()
        return (
            Field("unit", self.tr("&Positions in"), "choice", "", units),
            Field("error_unit", self.tr("&Errors in"), "choice", "", error_units),
            Field("sign", self.tr("An error &is"), "choice", "", (named, *signs)),
            Field("decimal", self.tr("&Decimal sign"), "choice", choices=marks),
            Field(
                "was_on",
                self.tr("&Compensation was"),
                "choice",
                choices=states,
                visible=lambda _: is_compensated,
            ),
            Field(
                "circle",
                self.tr("A&xis of the circle"),
                "choice",
                choices=axes,
                visible=lambda _: self._is_circle,
            ),
            Field("input", self.tr("&Figures are"), "choice", choices=inputs, visible=lambda _: bool(inputs)),
            Field(
                "start",
                self.tr("Table starts &at the"),
                "choice",
                choices=starts,
                visible=lambda _: bool(starts),
            ),
            Field(
                "table",
                self.tr("Calibration &table"),
                "check",
                default=True,
                head=self.tr("Set"),
                enabled=table is not None,
            ),
            Field(
                "reversal",
                self.tr("&Reversal error"),
                "check",
                default=True,
                enabled=bool(self._offered.reversal),
            ),
        )

    def _is_compensated(self) -> bool:
        try:
            return present_table(self._file, self._offered, self._axis) is not None or bool(
                lost_motion(self._file, self._offered, self._axis)
            )
        # A table that cannot be read may still be active in the control: asked about, not left out.
        except CalibrationError:
            return True

    # -- what is shown -----------------------------------------------------------

    def refresh(self) -> None:
        """Read the points again with the present answers, and show what they come to."""
        given = self.form.answers()
        answers = MeasurementAnswers(given["unit"], given["error_unit"], given["sign"], given["decimal"])
        request = ProposalRequest(
            # Not chosen is not off: the proposal asks for it.
            None if given["was_on"] == _ASK else given["was_on"] == "on",
            given["input"] or "",
            given["start"] or "",
            table=given["table"] and self._offered.table is not None,
            reversal=given["reversal"],
            circle=given["circle"],
        )
        try:
            measurement, self.proposal = in_background(
                self, self.tr("Working out"), partial(self._work, answers, request)
            )
        except (CalibrationError, OSError) as error:
            self.proposal = None
            self._show_nothing(sentenced(str(error), self._file.schema.family.family))
        else:
            self._show(measurement, self.proposal)
        self.form.show_visible()

    def _work(self, answers: MeasurementAnswers, request: ProposalRequest) -> tuple[Measurement, Proposal]:
        unit = base_unit(self._file, self._offered, self._axis)
        measurement = read_measured_file(self._path, answers, unit)
        # Known only from the points: the field for the axis of a circle appears after the first reading.
        self._is_circle = measurement.is_circle
        return measurement, propose(self._file, self._axis, measurement, request)

    def _show_nothing(self, why: str) -> None:
        self.summary.clear()
        self.notes.clear()
        self.plot.show_errors((), "mm")
        self._demand(why)

    def _demand(self, text: str) -> None:
        self.missing.setText(text)
        self.missing.setStyleSheet(f"color: {colour('error' if text else 'text').name()}")
        self.set_button.setEnabled(not text and self.proposal is not None and bool(self.proposal.settings))

    def _show(self, measurement: Measurement, proposal: Proposal) -> None:
        questions = {
            "unit": self.tr("the unit of the positions"),
            "error_unit": self.tr("the unit of the errors"),
            "sign": self.tr("what an error is"),
        }
        asked = ", ".join(questions[name] for name in measurement.assumed)
        self._demand(self.tr("The file does not name {what}: choose it.").format(what=asked) if asked else "")
        self.summary.setText("\n".join(self._lines(measurement, proposal)))
        self.notes.setPlainText("\n".join(f"• {note}" for note in proposal.notes))
        sides = ((True, self.tr("rising")), (False, self.tr("falling")))
        before = [
            ErrorTrace(
                self.tr("{side} as measured").format(side=name),
                proposal.before[side],
                "before" if side else "output",
                True,
            )
            for side, name in sides
            if side in proposal.before
        ]
        after = [
            ErrorTrace(
                self.tr("{side} expected").format(side=name),
                proposal.after[side],
                "now" if side else "outside",
            )
            for side, name in sides
            if side in proposal.after
        ]
        self.plot.show_errors((*before, *after), proposal.unit)

    def _lines(self, measurement: Measurement, proposal: Proposal) -> list[str]:
        """Return what was read, the figures of ISO 230-2, and what would be set."""
        figures, unit = proposal.figures, unit_in_words(proposal.unit)
        used = measurement.answers
        if measurement.is_circle:
            return [
                self.tr("%n circles of a ball-bar", "", len(measurement.runs)),
                self.tr("Read as {error_unit}, {sign}").format(
                    error_unit=unit_in_words(used.error_unit), sign=used.sign
                ),
                "",
                *self._set_lines(proposal),
            ]
        lines = [
            self.tr("{count} targets, {up} runs rising, {down} falling").format(
                count=len(measurement.targets), up=figures.runs_rising, down=figures.runs_falling
            ),
            self.tr("Read as {unit} and {error_unit}, {sign}").format(
                unit=unit_in_words(used.unit), error_unit=unit_in_words(used.error_unit), sign=used.sign
            ),
            "",
        ]
        for name, figure in (
            (self.tr("Accuracy A"), figures.accuracy),
            (self.tr("Repeatability R"), figures.repeatability),
            (self.tr("Reversal value B"), figures.reversal),
            (self.tr("Systematic deviation E"), figures.systematic),
            (self.tr("Range of mean errors M"), figures.mean_range),
        ):
            lines.append(f"{name}: {figure:.5f} {unit}" if figure is not None else f"{name}: –")
        lines += [
            "",
            self.tr("Error {before:.5f} {unit} measured, {after:.5f} {unit} expected").format(
                before=float(proposal.span_before), after=float(proposal.span_after), unit=unit
            ),
            "",
        ]
        return lines + self._set_lines(proposal)

    def _set_lines(self, proposal: Proposal) -> list[str]:
        """Return what would be set."""
        lines = []
        for address, value in proposal.settings.items():
            parameter = self._file.schema.parameters[address[0]]
            # A table is stored as one long text: how many points it has is what can be compared.
            if parameter.type == "text" and proposal.table is not None:
                new = self.tr("{count} points").format(count=len(proposal.table.points))
            else:
                old = show_value(parameter, self._file.get(address))
                new = f"{old} → {show_value(parameter, value)}"
            lines.append(f"{parameter.name}: {new}")
        if not proposal.settings:
            lines.append(self.tr("Nothing would be set."))
        return lines
