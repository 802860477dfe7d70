"""Writes a report in the format of its file extension."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from amp_studio.files import Notify, ParameterFile, Project, ProjectInfo, real_path, write_atomic
from amp_studio.validate import NO_RULES, BuilderRules

from .apart import What, made_apart
from .build import build_report
from .contents import Contents
from .model import NOTHING_ADDED, Additions, Report
from .output.data import render_json
from .output.everything import render_workbook
from .output.page import render_html
from .output.pdf import PdfContent, SetReport, render_pdf
from .output.table_csv import render_csv
from .output.text import render_text
from .templating.templates import TemplateMistakeError, own_template

FORMATS: dict[str, Callable[[Report], bytes]] = {
    ".pdf": render_pdf,
    ".html": render_html,
    ".xlsx": render_workbook,
    ".csv": render_csv,
    ".json": render_json,
    ".txt": render_text,
}


_WITH_TEMPLATES: dict[str, tuple[What, str]] = {
    ".pdf": ("pdf", "report.typ.j2"),
    ".html": ("html", "report.html.j2"),
}


def print_report(
    file: ParameterFile,
    path: Path | str,
    contents: Contents | None = None,
    *,
    source: Path | str | None = None,
    date: datetime | None = None,
    own: BuilderRules = NO_RULES,
    added: Additions = NOTHING_ADDED,
    notify: Notify = lambda _note: None,
) -> bool:
    """Write the documentation of a file, whole or not at all; the file extension of ``path`` sets the format.

    ``source`` is the path of the file on disk, from beside which the project's information is taken;
    ``date`` is printed (now when left out), ``own`` are the builder's rules; ``notify`` is called with each
    attribute of a replaced file that could not be kept, and with the mistake of a project's template.
    Returns whether the project's own template was used, where it has one: False is the standard report in
    its place. Raises ValueError for an unknown file extension, ParameterFileError for a project that
    cannot be read, SaveError when it cannot be written.
    """
    path, source, contents = Path(path), Path(source) if source else None, contents or Contents()
    if path.suffix.lower() not in FORMATS:
        raise ValueError(f"{path.name}: unknown report format. Use the file extension {', '.join(FORMATS)}")
    if path.suffix.lower() not in _WITH_TEMPLATES:  # tables and texts have no place for a drawing
        contents = replace(contents, without=contents.without | {"pictures"})
    folder = real_path(source).parent if source else None
    project = _project_beside(source)
    report = build_report(file, contents, source=source, project=project, date=date, own=own, added=added)
    content, mistake = _rendered(report, path.suffix.lower(), folder)
    # Nothing is lost with the one before: a report is made again at any time.
    write_atomic(path, content, keep_backup=False, notify=notify)
    if isinstance(content, PdfContent) and content.remark:
        notify(content.remark)
    if mistake:
        notify(mistake.then("The standard report was written"))
    return mistake is None


def set_report(
    file: ParameterFile,
    contents: Contents,
    ppi: int,
    *,
    source: Path,
    own: BuilderRules = NO_RULES,
    added: Additions = NOTHING_ADDED,
    notify: Notify = lambda _note: None,
) -> SetReport:
    """Return the pages of what ``print_report`` writes as PDF, as pictures with ``ppi`` pixels to the inch:
    for the eye and for a printer.

    Raises ReportNotMadeError, and ParameterFileError for a project that cannot be read.
    """
    report = build_report(
        file, contents, source=source, project=_project_beside(source), own=own, added=added
    )
    template = own_template(real_path(source).parent, "report.typ.j2")
    try:
        source_text, marks, *pages = made_apart("pages", report, template, ppi)
    except TemplateMistakeError as error:
        notify(error.then("The standard report is used"))
        source_text, marks, *pages = made_apart("pages", report, None, ppi)
    return SetReport(tuple(pages), source_text.decode("utf-8"), marks.decode("utf-8"))


def _rendered(report: Report, ending: str, folder: Path | None) -> tuple[bytes, TemplateMistakeError | None]:
    """Return the report in a format, by the project's template where it has one, else, or after its mistake,
    the standard one.
    """
    form = _WITH_TEMPLATES.get(ending)
    own = own_template(folder, form[1]) if form else None
    mistake = None
    if form and own:
        try:
            (content,) = made_apart(form[0], report, own)
            return content, None
        except TemplateMistakeError as error:
            mistake = error
    return FORMATS[ending](report), mistake


def _project_beside(source: Path | None) -> ProjectInfo | None:
    """Return the content of ``project.yaml`` beside a file; None where there is none.
    Raises ParameterFileError.
    """
    folder = real_path(source).parent if source else None
    return Project.open(folder).info if folder and (folder / "project.yaml").exists() else None
