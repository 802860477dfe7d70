"""Reports are made in a process apart where their pages are seen, and where a project's template makes them.

Typst cannot be interrupted, and ends its process where memory is over: a template without an end, or with too
much, ends alone.
"""

from __future__ import annotations

import contextlib
import json
import sys
from pathlib import Path
from typing import BinaryIO, Literal

from amp_studio.errors import AmpStudioError

from .model import Report
from .process import ReportNotMadeError, run_apart
from .templating.folder_copy import copied_template
from .templating.templates import TemplateMistakeError

_PATIENCE_S = 40.0
"""Of both: jinja2 has half of it (``templating``)."""
_MAX_MEMORY = 3 * 2**30
"""Bytes of address space, where the system can bound it."""
What = Literal["pdf", "html", "pages"]


def made_apart(what: What, report: Report, own: Path | None, ppi: int = 0) -> list[bytes]:
    """Return what ``made`` returns, from a process apart.

    Raises TemplateMistakeError where a template is the cause, ReportNotMadeError where it is not.
    """

    def failed(why: str) -> AmpStudioError:
        return TemplateMistakeError(own, why) if own else ReportNotMadeError(f"The report {why}")

    import pickle

    try:
        # Only a project's template is bounded: the program's own is known to end, and a large report takes
        # long.
        # Only the way to the process is pickled. The answer comes from a process in which a template ran,
        # and is JSON and bytes: unpickling it could run code.
        question = pickle.dumps((_MAX_MEMORY if own else None, what, report, own, ppi))
        answered = run_apart(__name__, question, _PATIENCE_S if own else None)
    except ReportNotMadeError as error:
        raise failed(str(error)) from None
    head, _, rest = answered.partition(b"\n")
    mistake, lengths = json.loads(head)
    if mistake is not None:
        raise failed(mistake)
    files, at = [], 0
    for length in lengths:
        # By length: a PDF or PNG may contain any byte that would part them.
        files.append(rest[at : at + length])
        at += length
    return files


def made(what: What, report: Report, own: Path | None, ppi: int = 0) -> list[bytes]:
    """Return the PDF, the web page, or the Typst source, what is known of its marks, and a PNG of each page.

    ``own`` is a template of the project.

    Raises TemplateMistakeError.
    """
    from .output.page import render_html
    from .output.pdf import render_pdf, set_pages

    with copied_template(own) if own else contextlib.nullcontext() as copy:
        if what == "html":
            return [render_html(report, copy)]
        if what == "pdf":
            return [render_pdf(report, copy)]
        found = set_pages(report, ppi, copy)
        return [found.source.encode("utf-8"), found.marks.encode("utf-8"), *found.pages]


def answer(asked: BinaryIO, out: BinaryIO) -> None:
    """Make what the program asks for, in the process apart: a line with mistake and lengths, then the
    files.
    """
    import pickle

    most_memory, *wanted = pickle.load(asked)  # noqa: S301  # the program itself has written it
    if most_memory:
        _bound_memory(most_memory)
    # Any other error ends this process with an exit code, which run_apart reports.
    mistake, files = None, []
    try:
        files = made(*wanted)
    except TemplateMistakeError as error:
        mistake = error.mistake
    out.write(json.dumps([mistake, [len(file) for file in files]]).encode("ascii") + b"\n")
    out.writelines(files)


def _bound_memory(most: int) -> None:
    # Windows has no such limit; there the patience alone ends a template.
    if sys.platform == "win32":
        return
    import resource

    with contextlib.suppress(OSError, ValueError):
        resource.setrlimit(resource.RLIMIT_AS, (most, most))
