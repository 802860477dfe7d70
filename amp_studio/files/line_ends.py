"""Line ends and byte-order mark of a file, which a save leaves as they are."""

from __future__ import annotations

from codecs import BOM_UTF8
from collections.abc import Callable


def plain(content: bytes | None) -> bytes | None:
    """Return a file's content as this program writes it: lines end with LF alone, no byte-order mark."""
    return None if content is None else content.removeprefix(BOM_UTF8).replace(b"\r\n", b"\n")


def as_before(content: bytes, previous: bytes | None, tell: Callable[[str], None]) -> bytes:
    """Return new content with line ends and byte-order mark of the previous one.

    Where its line ends differ from line to line those of most lines are taken, and ``tell`` is called.
    """
    if previous is None:
        return content
    pairs = previous.count(b"\r\n")
    single = previous.count(b"\n") - pairs
    if pairs and single:
        tell(f"its lines ended differently; all of them end with {'CRLF' if pairs > single else 'LF'} now")
    if pairs > single:
        content = content.replace(b"\n", b"\r\n")
    return BOM_UTF8 + content if previous.startswith(BOM_UTF8) else content
