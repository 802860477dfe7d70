"""Dialogs of the file and project menus."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtWidgets import QDialogButtonBox, QWidget

from amp_studio.files import Header, ProjectInfo
from amp_studio.report import Contents
from amp_studio.schema import family_ids, load_schema
from amp_studio.ui.base.ask_path import ask_to_save
from amp_studio.ui.base.translated import tr
from amp_studio.ui.forms.form import Field, FormDialog
from amp_studio.ui.window.report_options import contents_of, report_fields

_LONGEST = 64
"""Characters of the name of a project."""


def family_choices() -> list[tuple[str, str]]:
    """Return the families by id with their names."""
    return [(family, load_schema(family).family.name) for family in family_ids()]


class FactsDialog(FormDialog):
    """Edits the header of a file; the answers are its entries."""

    def __init__(self, header: Header, parent: QWidget | None = None) -> None:
        fields = (
            Field("name", tr("&Name"), default=header.name),
            Field("application", tr("&Application"), default=header.application),
            Field("revision", tr("Control software &revision"), default=header.revision),
            Field("notes", tr("N&otes"), "lines", header.notes),
        )
        super().__init__(tr("Machine facts"), fields, tr("Change &Facts"), parent)


class ReportDialog(FormDialog):
    """Asks for path, order and content of a report."""

    def __init__(self, path: Path, parent: QWidget | None = None, contents: Contents | None = None) -> None:
        tip = tr("The file extension sets the format: .pdf, .html, .xlsx, .csv, .json or .txt")
        fields = (
            *report_fields(contents or Contents()),
            Field(
                "path",
                tr("&File"),
                default=str(path.with_suffix(".pdf").absolute()),
                tip=tip,
                check=lambda text: "" if text else tr("Type a path for the report."),
                browse=ask_report_path,
            ),
            Field("open", tr("O&pen the report when it is written"), "check", default=False),
        )
        super().__init__(tr("Report"), fields, tr("&Write Report"), parent, width=560)
        self.to_printer = False
        """Whether it goes to a printer instead of into a file."""
        button = self.buttons.addButton(tr("Pre&view and Print…"), QDialogButtonBox.ButtonRole.ActionRole)
        button.setAutoDefault(False)
        button.clicked.connect(self._print)

    def _print(self) -> None:
        self.to_printer = True
        self.accept()

    @property
    def output(self) -> Path:
        """The file to write."""
        return Path(self.form.answer("path"))

    def contents(self) -> Contents:
        """Return what the report contains, and how."""
        return contents_of(self.form.answers())


def ask_report_path(parent: QWidget, near: str) -> Path | None:
    """Ask where a report goes; its ending, or that of the chosen kind, is the format.
    None where nothing was chosen.
    """
    endings = "PDF (*.pdf);;HTML (*.html);;Excel (*.xlsx);;CSV (*.csv);;JSON (*.json);;Text (*.txt)"
    return ask_to_save(parent, tr("Report"), near, endings)


PAPER_KINDS = "PDF (*.pdf);;HTML (*.html);;Excel (*.xlsx);;CSV (*.csv)"
"""What a paper is saved as (``report.paper``)."""


class ProjectDialog(FormDialog):
    """Asks for the project information of a new or existing project."""

    def __init__(self, info: ProjectInfo | None, parent: QWidget | None = None) -> None:
        self._info = info
        families = family_choices()
        family = info.family if info else families[0][0]
        fields = (
            Field("name", tr("&Name"), default=info.name if info else "", check=_name_fault),
            # Not changed later: its files belong to one family.
            Field("family", tr("Control &family"), "choice", family, families, enabled=info is None),
            Field("machine", tr("&Machine type"), "choice", choices=_machines(family)),
            Field(
                "control",
                tr("Control &address"),
                default=info.control if info else "",
                tip=tr("On Windows, for example: serial:COM3?baud=115200"),
                hint=tr("tcp://host:port or serial:/dev/ttyUSB0?baud=115200"),
            ),
            Field("control_name", tr("&Control name"), default=info.control_name if info else "CNC_1"),
            Field("revision", tr("Software &revision"), default=info.revision if info else ""),
            Field("notes", tr("N&otes"), "lines", info.notes if info else ""),
        )
        does = tr("Save Pro&ject") if info else tr("Create Pro&ject")
        super().__init__(tr("Project information"), fields, does, parent)
        if info:
            self.form.set_answer("machine", info.machine)
        self.form.entered.connect(self._choose)

    def _choose(self, key: str) -> None:
        if key == "family":
            self.form.offer_choices("machine", _machines(self.form.answer("family")), None)

    def info(self) -> ProjectInfo:
        """Return the information as typed."""
        given = self.form.answers()
        family = load_schema(given["family"]).family
        return ProjectInfo(
            **{**given, "machine": given["machine"] or ""},
            application=self._info.application if self._info else next(iter(family.applications), ""),
            extra=self._info.extra if self._info else {},
        )


def _machines(family: str) -> list[tuple[str, str]]:
    return [(machine.key, machine.name) for machine in load_schema(family).family.machines]


def _name_fault(name: str) -> str:
    if not name:
        return tr("Type a name for the project.")
    return tr("A name has at most {most} characters.").format(most=_LONGEST) if len(name) > _LONGEST else ""
