"""The machine of an axis out of the record of its drive: the fit as a picture, the figures,
and where they go.
"""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialog,
    QFormLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QWidget,
)

from amp_studio.files import ParameterFile, SaveError
from amp_studio.sim import (
    SimulationError,
    Trace,
    figure_rows,
    identify,
    identify_response,
    is_response,
    picture_of,
    value_text,
    write_machine,
)
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.figures import written
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.plot import Plot
from amp_studio.ui.base.screen_room import fit_to_screen
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.theme import GAP2, GAP3
from amp_studio.ui.base.translated import sentenced, worded, written_to
from amp_studio.ui.forms.form import Field, FieldForm


class IdentifyDialog(QDialog):
    """Shows the machine that a record of an axis is of; ``trace`` is the fit, None while there is none."""

    def __init__(self, file: ParameterFile, axis: str, path: Path, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._file, self._axis, self._path = file, axis, path
        self.trace: Trace | None = None
        self.setWindowTitle(self.tr("Machine from a Record — {name}").format(name=path.name))
        fit_to_screen(self, 980, 640)
        self.plot = Plot()
        self.plot.setAccessibleName(self.tr("Measured and predicted torque"))
        scale = Field(
            "scale",
            self.tr("S&cale"),
            tip=self.tr("Torque of the record for 1 % of rated torque, or for 1 V of output"),
            hint=self.tr("only for A, Nm or N: 0.056 A"),
        )
        turn = Field(
            "turn",
            self.tr("&Travel for a Turn"),
            tip=self.tr("Travel of the axis for one turn of the motor"),
            hint=self.tr("only for a record in rpm: 10 mm"),
        )
        # A table over the frequency is nothing else; a record may be one of moves or of a chirp.
        is_response = _is_table_of_response(path)
        chirp = Field(
            "chirp",
            self.tr("Reco&rd of a chirp: find resonance and delay too"),
            "check",
            is_response,
            visible=lambda _answers: not is_response,
        )
        motion = Field(
            "motion",
            self.tr("M&otion"),
            "choice",
            choices=(
                ("", self.tr("as slope and phase show")),
                *((name, worded(name)) for name in ("position", "velocity", "acceleration")),
            ),
            tip=self.tr("Motion of the response for 1 of torque"),
            visible=lambda answers: bool(answers["chirp"]),
        )
        self.form = FieldForm((scale, turn, chirp, motion))
        for name in ("scale", "turn"):
            self.form.editor(name, QLineEdit).editingFinished.connect(self.refresh)
        self.form.editor("chirp", QCheckBox).toggled.connect(self.refresh)
        self.form.editor("motion", QComboBox).currentIndexChanged.connect(self.refresh)
        self.message = QLabel()
        self.message.setWordWrap(True)
        self.message.setTextFormat(Qt.TextFormat.PlainText)
        self.figures = QFormLayout()
        self.use, self.save, cancel = (
            QPushButton(self.tr("&Use in Simulation")),
            QPushButton(self.tr("&Save Machine…")),
            QPushButton(self.tr("Cancel")),
        )
        self.use.setDefault(True)
        self.use.clicked.connect(self.accept)
        self.save.clicked.connect(self.save_machine)
        cancel.clicked.connect(self.reject)
        self._arrange(cancel)
        self.refresh()

    def _arrange(self, cancel: QPushButton) -> None:
        left = in_column(self.form)
        left.addSpacing(GAP2)
        left.addLayout(self.figures)
        left.addWidget(self.message)
        left.addStretch(1)
        in_column(
            (in_row((left, 2), (self.plot, 3), gap=GAP3), 1), in_row(self.save, 1, self.use, cancel), on=self
        )

    def refresh(self) -> None:
        """Fit the record again with the scale that is given."""
        scale, turn = self.form.answer("scale") or None, self.form.answer("turn") or None
        by_response, motion = self.form.answer("chirp"), self.form.answer("motion") or None

        def work() -> Trace:
            if by_response:
                return identify_response(self._file, self._path, self._axis, scale, None, motion, turn)
            return identify(self._file, self._path, self._axis, scale, turn=turn)

        try:
            self.trace = in_background(self, self.tr("Reading the Record"), work)
        except (SimulationError, OSError) as error:
            self.trace = None
            self.plot.clear_picture()
            self.message.setText(self._sentence(str(error)))
        else:
            self.plot.draw(picture_of(self.trace))
            found = [
                f"{worded(each.parameter)} {written(value_text(each.value, each.unit))}:"
                f" {self._sentence(each.why)}"
                for each in self.trace.recommendations
            ]
            texts = (
                *map(self._sentence, self.trace.doubts),
                *found,
                *map(self._sentence, self.trace.assumptions),
            )
            self.message.setText("\n".join(texts))
        self._show_figures()
        for button in (self.use, self.save):
            button.setEnabled(self.trace is not None)

    def _sentence(self, text: str) -> str:
        return sentenced(text, self._file.schema.family.family)

    def _show_figures(self) -> None:
        while self.figures.rowCount():
            self.figures.removeRow(0)
        if self.trace is None:
            return
        for words, text in figure_rows(self.trace):
            self.figures.addRow(worded(words), QLabel(self._sentence(text)))
        if "rows_used" in self.trace.result:
            used, rows = (int(self.trace.result[name][0] or 0) for name in ("rows_used", "rows"))
            text = self.tr("{used} of {all}").format(used=used, all=rows)
            self.figures.addRow(self.tr("Rows"), QLabel(text))

    def save_machine(self) -> None:
        """Write the machine for ``simulate --machine``."""
        if self.trace is None:
            return
        near = self._path.with_name(f"machine-{self.trace.letter or self.trace.axis}.yaml")
        if path := ask_to_save(self, self.tr("Save Machine"), near, self.tr("Machine (*.yaml)")):
            try:
                write_machine(self.trace, self._file.schema.family.family, path)
            except (SaveError, OSError) as error:
                self.message.setText(self._sentence(str(error)))
            else:
                self.message.setText(written_to(path))


def _is_table_of_response(path: Path) -> bool:
    try:
        return is_response(path)
    except OSError:
        return False  # the fit shows why it cannot be read
