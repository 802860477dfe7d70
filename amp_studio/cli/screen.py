"""The standard streams of the program: there whatever the shell has closed,
and no text on them steers the terminal.
"""

from __future__ import annotations

import contextlib
import io
import os
import sys
from pathlib import Path
from typing import TextIO


class Screen(io.TextIOWrapper):
    """A standard stream that shows control characters instead of passing them on; only line ends and tabs
    pass.
    """

    overwritten = False
    """Whether the present line of the terminal is one that the next replaces."""

    def write(self, text: str) -> int:
        """Write a text with its control characters made visible."""
        return super().write(_printable(text))

    def overwrite(self, text: str, *, last: bool) -> None:
        """Write over the present line of a terminal."""
        # To the end of the line: a longer text may have been there.
        super().write("\r" + _printable(text) + "\x1b[K" + ("\n" if last else ""))
        self.flush()
        self.overwritten = not last


def _printable(text: str) -> str:
    if text.replace("\n", "").replace("\t", "").isprintable():
        return text
    from amp_studio.schema import visible  # the rooms are loaded when they are needed

    return visible(text, keep="\n\t")


def open_streams() -> None:
    """Put streams of this module in the place of Python's; a handle that the shell has closed leads
    nowhere.
    """
    while (
        handle := os.open(os.devnull, os.O_RDWR)
    ) <= 2:  # a file opened later must not become standard output
        pass
    os.close(handle)
    sys.stdin = sys.stdin or io.TextIOWrapper(io.BytesIO())
    sys.stdout, sys.stderr = _screen(sys.stdout), _screen(sys.stderr)


def _screen(stream: TextIO | None) -> TextIO:
    """Return a stream to which any character can be written; without a stream it goes nowhere."""
    if stream is None:
        # As with ``2>&-``, and for a program without a console on Windows.
        return Screen(Path(os.devnull).open("wb"), encoding="utf-8")
    if not isinstance(stream, io.TextIOWrapper):
        return stream
    encoding, lines = stream.encoding, stream.line_buffering
    # Detached, or the old stream would close the handle when it is collected. A character that the
    # terminal has no code for must not end a verb.
    return Screen(stream.detach(), encoding=encoding, errors="backslashreplace", line_buffering=lines)


def flush_results() -> None:
    """Write out what was printed; raises OSError where it cannot be taken."""
    sys.stdout.flush()


def end_results() -> None:
    """Write out what was printed as far as it is taken; the rest goes nowhere."""
    try:
        flush_results()
    except (OSError, ValueError):
        abandon(sys.stdout)


def print_notice(text: str, end: str = "\n") -> None:
    """Print a line on standard error; where it cannot be written the work goes on anyway."""
    stream = sys.stderr
    try:
        if isinstance(stream, Screen) and stream.overwritten:
            stream.overwrite("", last=False)
            stream.overwritten = False
        print(text, end=end, file=stream, flush=True)
    except (OSError, ValueError):
        abandon(sys.stderr)


def print_over(text: str, *, last: bool) -> None:
    """Show a line that the next one replaces, where standard error is a terminal."""
    stream = sys.stderr
    try:
        if isinstance(stream, Screen) and stream.isatty():
            stream.overwrite(text, last=last)
    except (OSError, ValueError):
        abandon(stream)


def abandon(stream: TextIO) -> None:
    """Lead a stream nowhere, so that the end of the program does not fail on it again."""
    with contextlib.suppress(OSError, ValueError):
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, stream.fileno())
        os.close(nowhere)
