"""How far the operator has come with a sheet: kept beside the file,
so that the work can be interrupted and taken up again.

A tick belongs to a number with the old and the new text. Where one of them has changed since, the value has
to be keyed in again and the tick is gone.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path

from amp_studio.errors import AmpStudioError
from amp_studio.files import write_atomic
from amp_studio.schema import read_file

from .model import Sheet, SheetEntry

ENDING = ".ticks.json"
_LARGEST = 1 << 22  # bytes
_KEYS = ("number", "old", "new", "shown")


class TicksError(AmpStudioError, ValueError):
    """A file of ticks that cannot be read; one clear sentence."""


def ticks_path(path: Path) -> Path:
    """Return where the ticks of a file's sheet are kept."""
    return path.with_name(path.name + ENDING)


class Ticks:
    """The ticks of one sheet, and what was read back; every change is on the disk at once.

    Raises TicksError where the file that is there is no file of ticks, and OSError.
    """

    def __init__(self, path: Path, sheet: Sheet) -> None:
        self.path = path
        self._entries = {entry.number: entry for entry in sheet.entries}
        self.screen_text: dict[str, str] = {}
        """Number -> what the screen shows."""
        self._ticked: set[str] = set()
        self.forgotten = 0
        """Ticks of values that have changed since."""
        for number, old, new, screen_text, ticked in _read(path):
            entry = self._entries.get(number)
            if entry is None:  # the control contains it now
                continue
            if (entry.old, entry.new) != (old, new):
                self.forgotten += ticked
                continue
            if ticked:
                self._ticked.add(number)
            if screen_text:
                self.screen_text[number] = screen_text

    def __contains__(self, entry: object) -> bool:
        return isinstance(entry, SheetEntry) and entry.number in self._ticked

    @property
    def done(self) -> int:
        """How many entries are ticked."""
        return len(self._ticked)

    def tick(self, entries: Iterable[SheetEntry], on: bool = True) -> None:
        """Tick entries, or take their ticks away."""
        numbers = {entry.number for entry in entries}
        self._ticked = self._ticked | numbers if on else self._ticked - numbers
        self._save()

    def read_back(self, entry: SheetEntry, screen_text: str) -> None:
        """Remember what the screen shows for an entry; "" for nothing."""
        self.screen_text.pop(entry.number, None)
        if screen_text.strip():
            self.screen_text[entry.number] = screen_text.strip()
        self._save()

    def _save(self) -> None:
        """Write what is ticked or read back; entries with neither are left out."""
        kept = [
            {
                "number": e.number,
                "old": e.old,
                "new": e.new,
                "shown": self.screen_text.get(e.number, ""),
                "ticked": e.number in self._ticked,
            }
            for e in self._entries.values()
            if e.number in self._ticked or e.number in self.screen_text
        ]
        write_atomic(self.path, (json.dumps({"ticks": kept}, indent=1) + "\n").encode(), keep_backup=False)


def _read(path: Path) -> list[tuple[str, str, str, str, bool]]:
    """Return number, old and new text, what was read back, and the tick of each entry; raises TicksError,
    OSError.
    """
    try:
        content = read_file(path, _LARGEST)
    except FileNotFoundError:
        return []
    try:
        kept = json.loads(content)["ticks"]
        found = [(*(each[key] for key in _KEYS), each["ticked"]) for each in kept]
        # type() and not isinstance(): true is a number to Python, and a number here is a damaged text.
        if not all(
            isinstance(ticked, bool) and all(type(text) is str for text in texts) for *texts, ticked in found
        ):
            raise TypeError
    except (ValueError, LookupError, TypeError, RecursionError):
        raise TicksError(f"{path} is no list of ticks of a sheet: move it away to start again") from None
    return found
