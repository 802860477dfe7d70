"""A report by a project's template is made in a process apart: what works without end is ended there, and what takes all memory ends alone.

Typst runs in the process that calls it, cannot be interrupted, and ends it where memory is over.
"""

from __future__ import annotations

import contextlib
import json
import pickle
import subprocess
import sys
from pathlib import Path
from typing import BinaryIO, Literal

from .model import Report
from .template_copy import copied_template
from .templating import TemplateMistakeError

_PATIENCE_S = 40.0
"""Of both: jinja2 has half of it (``templating``)."""
_MOST_MEMORY = 3 * 2**30
"""Bytes of address space, where the system can bound it."""
_CHILD = "import sys; sys.path.insert(0, sys.argv.pop()); from amp_studio.report.apart import answer; answer(sys.stdin.buffer, sys.stdout.buffer)"

What = Literal["pdf", "html", "pages"]


def made_apart(what: What, report: Report, own: Path, ppi: int = 0) -> list[bytes]:
    """Return what ``made`` returns, from a process apart; raises TemplateMistakeError."""
    command = [sys.executable, "-P", "-c", _CHILD, str(Path(__file__).parents[2])]
    try:
        done = subprocess.run(
            command,
            input=pickle.dumps((_MOST_MEMORY, what, report, own, ppi)),
            capture_output=True,
            timeout=_PATIENCE_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        raise TemplateMistakeError(own, "works without end") from None
    if done.returncode:
        why = (
            "needs too much memory" if b"memory" in done.stderr.lower() else "ended the process that sets it"
        )
        raise TemplateMistakeError(own, why)
    head, _, rest = done.stdout.partition(b"\n")
    mistake, lengths = json.loads(head)
    if mistake is not None:
        raise TemplateMistakeError(own, mistake)
    files, at = [], 0
    for length in lengths:
        files.append(rest[at : at + length])
        at += length
    return files


def made(what: What, report: Report, own: Path, ppi: int = 0) -> list[bytes]:
    """Return the PDF, the web page, or the Typst source, what is known of its marks, and a PNG of each page.

    Raises TemplateMistakeError.
    """
    from .page import render_html
    from .pdf import render_pdf, set_pages

    with copied_template(own) as copy:
        if what == "html":
            return [render_html(report, copy)]
        if what == "pdf":
            return [render_pdf(report, copy)]
        found = set_pages(report, ppi, copy)
        return [found.source.encode("utf-8"), found.found_marks().encode("utf-8"), *found.pages]


def answer(asked: BinaryIO, out: BinaryIO) -> None:
    """Make what the program asks for, in the process apart: a line with mistake and lengths, then the files."""
    most_memory, *wanted = pickle.load(asked)  # noqa: S301 (the program itself has written it)
    _bound_memory(most_memory)
    mistake, files = None, []
    try:
        files = made(*wanted)
    except TemplateMistakeError as error:
        mistake = error.mistake
    out.write(json.dumps([mistake, [len(file) for file in files]]).encode("ascii") + b"\n")
    out.writelines(files)


def _bound_memory(most: int) -> None:
    with contextlib.suppress(ImportError, OSError, ValueError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (most, most))
