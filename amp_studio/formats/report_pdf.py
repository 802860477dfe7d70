"""The machine that a report has with it: a parameter file attached to a PDF.

A PDF of this program has the file as an embedded stream (ISO 32000-1, 7.11.4), which is found by its type: no
other part of the PDF is read. What another program has packed otherwise is not found.
"""

from __future__ import annotations

import re
import zlib
from collections.abc import Iterator

HEAD = re.compile(rb"(?m)^(?:\xef\xbb\xbf)?amp_studio[ \t]*:")
"""The line by which a parameter file is known, under whatever name."""
_EMBEDDED = re.compile(rb"/EmbeddedFile\b[^\0]{0,1000}?\bstream\r?\n", re.DOTALL)
_MAX_FILES = 16
"""Files attached to a PDF that are read."""
_MAX_BYTES = 4 * 2**20
"""Of one of them, unpacked: as much as a text that is imported."""


def is_pdf(content: bytes) -> bool:
    """Return whether a content is a PDF."""
    return content.startswith(b"%PDF-")


def attached_machine(content: bytes) -> bytes | None:
    """Return the parameter file that is attached to a PDF; None where there is none."""
    return next((each for each in _attached(content) if HEAD.search(each)), None)


def _attached(content: bytes) -> Iterator[bytes]:
    """Yield the contents of the files that are attached, unpacked up to a bound."""
    for number, found in enumerate(_EMBEDDED.finditer(content)):
        if number == _MAX_FILES:
            return
        packed = content[found.end() : content.find(b"endstream", found.end())]
        try:
            # Bounded while it unpacks: a few kilobytes can become gigabytes.
            unpacked = zlib.decompressobj().decompress(packed, _MAX_BYTES)
        except zlib.error:
            # A PDF may have it unpacked.
            unpacked = packed[:_MAX_BYTES]
        yield unpacked
