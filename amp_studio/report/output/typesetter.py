"""Typst in a process apart. In the process that calls it it keeps about 100 MB of each document for those
after it.

The process loads this module and Typst, and nothing else of the program: it takes 0.03 s.
"""

from __future__ import annotations

import json

TYPE_CHECKING = False  # the typing module is not loaded for it
if TYPE_CHECKING:
    from typing import Any, BinaryIO


def set_pdf(source: str, options: dict[str, Any]) -> bytes:
    """Return the PDF of Typst source; ``options`` are those of ``typst.compile`` that JSON can have.

    Raises ReportNotMadeError.
    """
    from amp_studio.report.process import ReportNotMadeError, run_apart

    try:
        return run_apart(__name__, json.dumps([source, options]).encode("ascii"))
    except ReportNotMadeError as error:
        raise ReportNotMadeError(f"The PDF {error}") from None


def answer(asked: BinaryIO, out: BinaryIO) -> None:
    """Set what ``set_pdf`` asks for, in the process apart."""
    import typst

    source, options = json.load(asked)
    out.write(typst.compile(source.encode("utf-8"), format="pdf", **options))
