"""Typst in a process apart. In the process that calls it it keeps about 100 MB of each document for those
after it.

The process loads this module and Typst, and nothing else of the program: it takes 0.03 s.
"""

from __future__ import annotations

import json
import re
from bisect import bisect_left

TYPE_CHECKING = False  # the typing module is not loaded for it
if TYPE_CHECKING:
    from typing import Any, BinaryIO


_STANDARDS = ["a-3a", "ua-1"]
"""PDF/A-3a, to be kept, which may have files attached (PDF/A-2a may not), and PDF/UA-1, to be read aloud."""
_TABLE, _END = b"startxref", b"\nendstream\nendobj"
_ENTRY = re.compile(rb"\b\d{10}(?= \d{5} n)")
"""The place of an object in the table of a PDF."""
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
    ``options`` are those of ``typst.compile`` that JSON can have, a timestamp as its text. Raises TypstError.
    """
    from datetime import datetime

    import typst

    given: dict[str, Any] = {**options, "format": "pdf"}
    if "timestamp" in given:
        given["timestamp"] = datetime.fromisoformat(given["timestamp"])
    content = source.encode("utf-8")
    standards: Any = _STANDARDS
    try:
        return ends_parted(typst.compile(content, pdf_standards=standards, **given)), ""
    except typst.TypstError as error:
        # Better a PDF without the standards than none: a name in Chinese must not stop the report.
        plain = typst.compile(content, **given)
        lacks = _NO_FONT.search(str(error))
        why = f"no font here has the character {lacks[1]}" if lacks else str(error.message)
        return plain, f"The PDF does not keep to PDF/A and PDF/UA: {why}"


def ends_parted(pdf: bytes) -> bytes:
    """Return a PDF in which CR and LF are before the ``endstream`` of each stream whose data end in CR.

    Typst writes LF alone, and then a checker takes CR and LF for the end of the line and the data for a byte
    shorter than their length. One stream in 256 ends so: every byte behind it has another place in the table.
    """
    at = int(pdf[pdf.rindex(_TABLE) :].split()[1])
    if pdf[at : at + 4] != b"xref":  # another kind of table, of another version of Typst
        return pdf
    entries, trailer = (
        pdf[at : pdf.index(b"trailer", at)],
        pdf[pdf.index(b"trailer", at) : pdf.rindex(_TABLE)],
    )
    places = sorted(int(place) for place in _ENTRY.findall(entries))
    # From the end of each object: the data of a stream may contain the same bytes.
    ends = [pdf.rfind(_END, start, end) for start, end in zip(places, [*places[1:], at], strict=True)]
    unclear = [end for end in ends if pdf[end - 1 : end] == b"\r"]
    if not unclear:
        return pdf
    parts = [pdf[start:end] for start, end in zip([0, *unclear], [*unclear, at], strict=True)]
    moved = _ENTRY.sub(
        lambda entry: b"%010d" % (int(entry[0]) + bisect_left(unclear, int(entry[0]))), entries
    )
    return b"".join((b"\r".join(parts), moved, trailer, b"%s\n%d\n%%%%EOF" % (_TABLE, at + len(unclear))))
