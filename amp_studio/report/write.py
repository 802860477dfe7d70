"""Writes a report in the format of its file extension."""

from __future__ import annotations

from collections.abc import Callable
from datetime import datetime
from pathlib import Path

from amp_studio.files import Notify, ParameterFile, write_atomic
from amp_studio.validate import NO_RULES, BuilderRules

from .build import build_report
from .model import Report, Sort
from .page import render_html
from .pdf import render_pdf
from .table_csv import render_csv
from .text import render_text

FORMATS: dict[str, Callable[[Report], bytes]] = {
    ".pdf": render_pdf,
    ".html": render_html,
    ".csv": render_csv,
    ".txt": render_text,
}


def write_report(
    file: ParameterFile,
    path: Path,
    *,
    sort: Sort = "group",
    changed_only: bool = False,
    source: Path | None = None,
    date: datetime | None = None,
    own: BuilderRules = NO_RULES,
    secrets: bool = False,
    notify: Notify = lambda _note: None,
) -> None:
    """Write the documentation of a file, whole or not at all; the file extension of ``path`` sets the format.

    ``sort`` is one of the three orders, ``changed_only`` keeps
    what differs from the printed default, ``source`` is the path of the file
    on disk, ``date`` is printed (now when left out), ``own`` are the builder's rules, and ``secrets`` prints
    passwords in clear text; ``notify`` is called with each attribute of a replaced file that could not be kept. Raises
    ValueError for an unknown file extension or order, SaveError when it cannot be
    written.
    """
    render = FORMATS.get(path.suffix.lower())
    if render is None:
        raise ValueError(f"{path.name}: unknown report format. Use the file extension {', '.join(FORMATS)}")
    report = build_report(
        file, sort=sort, changed_only=changed_only, source=source, date=date, own=own, secrets=secrets
    )
    write_atomic(path, render(report), keep_backup=False, notify=notify)
