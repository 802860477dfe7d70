"""Typst in a process apart. In the process that calls it it keeps about 100 MB of each document for those
after it.

The process loads this module and Typst, and nothing else of the program: it takes 0.03 s.
"""

from __future__ import annotations

import json
import re

TYPE_CHECKING = False  # the typing module is not loaded for it
if TYPE_CHECKING:
    from typing import Any, BinaryIO


_STANDARDS = ["a-3a", "ua-1"]
"""PDF/A-3a, to be kept, which may have files attached (PDF/A-2a may not), and PDF/UA-1, to be read aloud."""
_NO_FONT = re.compile(r'the text `"(.+?)"` could not be displayed')


def set_pdf(source: str, options: dict[str, Any]) -> tuple[bytes, str]:
    """Return what ``compiled`` returns, from a process apart. Raises ReportNotMadeError."""
    from amp_studio.report.process import ReportNotMadeError, run_apart

    try:
        answered = run_apart(__name__, json.dumps([source, options]).encode("ascii"))
    except ReportNotMadeError as error:
        raise ReportNotMadeError(f"The PDF {error}") from None
    remark, _, pdf = answered.partition(b"\n")
    return pdf, json.loads(remark)


def answer(asked: BinaryIO, out: BinaryIO) -> None:
    """Set what ``set_pdf`` asks for, in the process apart."""
    pdf, remark = compiled(*json.load(asked))
    # The remark first and in ASCII on one line: what follows the first line end is the PDF byte for byte.
    out.write(json.dumps(remark).encode("ascii") + b"\n" + pdf)


def compiled(source: str, options: dict[str, Any]) -> tuple[bytes, str]:
    """Return the PDF of Typst source, and why it does not keep to the standards; empty where it does.

    It does not where no font here has a script, or where a drawing of a project's template has no words.
    ``options`` are those of ``typst.compile`` that JSON can have, a timestamp as its text.
    Raises TypstError.
    """
    from datetime import datetime

    import typst

    given: dict[str, Any] = {**options, "format": "pdf"}
    if "timestamp" in given:
        given["timestamp"] = datetime.fromisoformat(given["timestamp"])
    content = source.encode("utf-8")
    standards: Any = _STANDARDS
    try:
        return typst.compile(content, pdf_standards=standards, **given), ""
    except typst.TypstError as error:
        # Better a PDF without the standards than none: a name in Chinese must not stop the report.
        plain = typst.compile(content, **given)
        lacks = _NO_FONT.search(str(error))
        why = f"no font here has the character {lacks[1]}" if lacks else str(error.message)
        return plain, f"The PDF does not keep to PDF/A and PDF/UA: {why}"
