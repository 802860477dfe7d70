"""Dialogs of the file and project menus."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import QRegularExpression
from PySide6.QtGui import QRegularExpressionValidator
from PySide6.QtWidgets import (
    QCheckBox,
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPlainTextEdit,
    QPushButton,
    QWidget,
)

from amp_studio.files import Header, ProjectInfo
from amp_studio.report import Contents
from amp_studio.schema import family_ids, load_schema
from amp_studio.ui.base.questions import show_message
from amp_studio.ui.base.translated import tr
from amp_studio.ui.window.report_options import ReportOptions


class _Form(QDialog):
    """A dialog of labelled fields, with a button for what it does and Cancel."""

    def __init__(self, title: str, parent: QWidget | None) -> None:
        super().__init__(parent)
        self.setWindowTitle(title)
        self.setMinimumWidth(480)
        self.form = QFormLayout(self)

    def done(self, result: int) -> None:
        """Close the form; its input can be read until the next event."""
        super().done(result)
        self.deleteLater()

    def add_buttons(self, does: str) -> None:
        """Add Cancel below the fields, and the button that ``does`` it."""
        buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel
        )
        buttons.button(QDialogButtonBox.StandardButton.Ok).setText(does)
        buttons.accepted.connect(self.accept)
        buttons.rejected.connect(self.reject)
        self.form.addRow(buttons)


def _family_box() -> QComboBox:
    box = QComboBox()
    for family in family_ids():
        box.addItem(load_schema(family).family.name, family)
    return box


class FactsDialog(_Form):
    """Edits the header of a file."""

    def __init__(self, header: Header, parent: QWidget | None = None) -> None:
        super().__init__(self.tr("Machine facts"), parent)
        self.name, self.application = QLineEdit(header.name), QLineEdit(header.application)
        self.revision, self.notes = QLineEdit(header.revision), QPlainTextEdit(header.notes)
        self.notes.setTabChangesFocus(True)
        for label, field in (
            (self.tr("&Name"), self.name),
            (self.tr("&Application"), self.application),
            (self.tr("Control software &revision"), self.revision),
            ("N&otes", self.notes),
        ):
            self.form.addRow(label, field)
        self.add_buttons(self.tr("Change &Facts"))

    def texts(self) -> dict[str, str]:
        """Return the header entries as typed."""
        return {
            "name": self.name.text().strip(),
            "application": self.application.text().strip(),
            "revision": self.revision.text().strip(),
            "notes": self.notes.toPlainText(),
        }


class ReportDialog(_Form):
    """Asks for path, order and content of a report."""

    def __init__(self, path: Path, parent: QWidget | None = None, contents: Contents | None = None) -> None:
        super().__init__(self.tr("Report"), parent)
        self.setMinimumWidth(560)
        self.options = ReportOptions(contents or Contents())
        self.show_it = QCheckBox(self.tr("O&pen the report when it is written"))
        self.path = QLineEdit(str(path.with_suffix(".pdf").absolute()))
        self.path.setToolTip(
            self.tr("The file extension sets the format: .pdf, .html, .xlsx, .csv, .json or .txt")
        )
        browse = QPushButton(self.tr("&Browse…"))
        browse.setAutoDefault(False)
        browse.clicked.connect(self._browse)
        row = QHBoxLayout()
        row.addWidget(self.path)
        row.addWidget(browse)
        label = QLabel(self.tr("&File"))
        label.setBuddy(self.path)
        self.form.addRow(self.options)
        self.options.form.addRow(label, row)  # its labels have one column with those of the options
        self.options.form.addRow("", self.show_it)
        self.to_printer = False
        """Whether it goes to a printer instead of into a file."""
        to_printer = QPushButton(self.tr("Pre&view and Print…"))
        to_printer.setAutoDefault(False)
        to_printer.clicked.connect(self._print)
        self.options.form.addRow("", to_printer)
        self.add_buttons(self.tr("&Write Report"))

    def _browse(self) -> None:
        if path := ask_report_path(self, self.path.text()):
            self.path.setText(str(path))

    def _print(self) -> None:
        self.to_printer = True
        self.accept()

    @property
    def output(self) -> Path:
        """The file to write."""
        return Path(self.path.text().strip())

    def contents(self) -> Contents:
        """Return what the report contains, and how."""
        return self.options.contents()


def ask_report_path(parent: QWidget, near: str) -> Path | None:
    """Ask where a report goes; its ending, or that of the chosen kind, is the format.
    None where nothing was chosen.
    """
    endings = "PDF (*.pdf);;HTML (*.html);;Excel (*.xlsx);;CSV (*.csv);;JSON (*.json);;Text (*.txt)"
    text, chosen = QFileDialog.getSaveFileName(parent, tr("Report"), near, endings)
    if not text:
        return None
    return path_of_kind(text, chosen)


PAPER_KINDS = "PDF (*.pdf);;HTML (*.html);;Excel (*.xlsx);;CSV (*.csv)"
"""What a paper is saved as (``report.paper``)."""


def path_of_kind(text: str, kind: str) -> Path:
    """Return a path from a file dialog, with the ending of the chosen kind where it has none."""
    path = Path(text)
    return path if path.suffix else path.with_suffix(kind[kind.index("*") + 1 : -1])


class ProjectDialog(_Form):
    """Asks for the project information of a new or existing project."""

    def __init__(self, info: ProjectInfo | None, parent: QWidget | None = None) -> None:
        super().__init__(self.tr("Project information"), parent)
        self._info = info
        self.family = _family_box()
        self.machine = QComboBox()
        self.name = QLineEdit(info.name if info else "")
        self.name.setValidator(QRegularExpressionValidator(QRegularExpression(r".{1,64}")))
        self.control = QLineEdit(info.control if info else "")
        self.control.setPlaceholderText(self.tr("tcp://host:port or serial:/dev/ttyUSB0?baud=115200"))
        self.control.setToolTip(self.tr("On Windows, for example: serial:COM3?baud=115200"))
        self.control_name = QLineEdit(info.control_name if info else "CNC_1")
        self.revision = QLineEdit(info.revision if info else "")
        self.notes = QPlainTextEdit(info.notes if info else "")
        self.notes.setTabChangesFocus(True)
        for label, field in (
            (self.tr("&Name"), self.name),
            (self.tr("Control &family"), self.family),
            (self.tr("&Machine type"), self.machine),
            (self.tr("Control &address"), self.control),
            (self.tr("&Control name"), self.control_name),
            (self.tr("Software &revision"), self.revision),
            ("N&otes", self.notes),
        ):
            self.form.addRow(label, field)
        self.family.currentIndexChanged.connect(lambda _: self._machines())
        if info:
            self.family.setCurrentIndex(max(self.family.findData(info.family), 0))
            self.family.setEnabled(False)
        self._machines()
        if info and info.machine:
            self.machine.setCurrentIndex(self.machine.findData(info.machine))
        self.add_buttons(self.tr("Save Pro&ject") if info else self.tr("Create Pro&ject"))

    def _machines(self) -> None:
        self.machine.clear()
        for machine in load_schema(str(self.family.currentData())).family.machines:
            self.machine.addItem(machine.name, machine.key)

    def info(self) -> ProjectInfo:
        """Return the information as typed."""
        family = load_schema(str(self.family.currentData())).family
        return ProjectInfo(
            name=self.name.text().strip(),
            family=family.family,
            machine=str(self.machine.currentData() or ""),
            application=self._info.application if self._info else next(iter(family.applications), ""),
            control=self.control.text().strip(),
            control_name=self.control_name.text().strip(),
            revision=self.revision.text().strip(),
            notes=self.notes.toPlainText(),
            extra=self._info.extra if self._info else {},
        )

    def accept(self) -> None:
        """Close the dialog when a name is given."""
        if self.name.text().strip():
            super().accept()
        else:
            show_message(self, self.tr("Project information"), self.tr("Type a name for the project."))
            self.name.setFocus()
