"""The text of a program from a file, bounded: it comes from anywhere."""

from __future__ import annotations

from pathlib import Path

from amp_studio.schema import quoted

from .words import LONGEST, ProgramBlockError

MOST_BYTES = 100_000_000
"""Of a file, counted in characters; a million blocks have about 30 million."""
MOST_LINES = 2_000_000


def read_program(path: Path) -> list[str]:
    """Return the lines of a program; raises ProgramBlockError for a file that is none, OSError."""
    lines: list[str] = []
    gone = 0
    # Lines end by LF, CR LF or CR: a control takes each for the end of a block.
    with path.open(encoding="utf-8-sig", errors="replace") as file:
        # A line is never read whole before its length is known: one line can be as long as the disk.
        while part := file.readline(LONGEST + 2):
            gone += len(part)
            name = quoted(path.name)
            if len(part) > LONGEST and not part.endswith("\n"):
                raise ProgramBlockError(
                    f"Line {len(lines) + 1} of {name} has more than {LONGEST} characters: no part program"
                )
            if "\0" in part:
                raise ProgramBlockError(f"{name} is no text: there is a zero byte in line {len(lines) + 1}")
            if gone > MOST_BYTES or len(lines) >= MOST_LINES:
                raise ProgramBlockError(
                    f"{name} is longer than {MOST_LINES} lines or {MOST_BYTES // 1_000_000} MB"
                )
            lines.append(part.strip(" \t\r\n"))
    return lines
