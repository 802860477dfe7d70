"""Other versions of an open file, to compare with: as it was opened, as it was saved, its backup,
its defaults, its history.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from amp_studio.schema import InvalidValueError, read_address

from .document import HistoryEntry
from .parameter_file import ParameterFile
from .reading import read_stored


@dataclass(frozen=True)
class SavedVersion:
    """A file as it was before one of its saves."""

    when: str
    """Of the save, in UTC."""
    changed: tuple[str, ...]
    """What the save changed, as the history has it."""
    file: ParameterFile


def saved_versions(file: ParameterFile, history: Sequence[HistoryEntry], most: int) -> Iterator[SavedVersion]:
    """Yield a saved file as it was before each of its last saves, the newest first; ``history`` is all of
    it.
    """
    seen: list[HistoryEntry] = []
    for n, (when, saved) in enumerate(groupby(history, key=lambda entry: entry.when)):
        if n == most:
            return
        entries = list(saved)
        seen += entries
        yield SavedVersion(when, tuple(entry.param for entry in entries), before_saves(file, seen))


def with_defaults(file: ParameterFile) -> ParameterFile:
    """Return a file in which every value that is set is the printed default;
    one for which none is printed stays.
    """
    twin = file.copy()
    for address in file.values:
        default = file.default(address)
        if default is not None:
            twin.values[address] = default
            twin.forced.pop(address, None)
    twin.evaluation.forget()
    return twin


def before_saves(file: ParameterFile, entries: Sequence[HistoryEntry]) -> ParameterFile:
    """Return a saved file as it was before the saves that ``entries`` of its history are of, newest first.

    A value that the history does not have in clear, or that cannot be read any more, stays as it is.
    """
    twin = file.copy()
    for entry in entries:
        address = read_address(entry.param)
        parameter = twin.schema.parameters.get(address[0])
        if parameter is None or parameter.secret or address not in twin.machine_schema.places:
            continue
        try:
            twin.set(address, read_stored(twin.schema, parameter, entry.old) if entry.old else None)
        except InvalidValueError:
            continue
    return twin
