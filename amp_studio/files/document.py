"""An open parameter file: its place on disk, its lock, its unsaved work, its history.

Two programs on one file notice each other through an operating-system lock,
which ends with its program; the unsaved work of a killed program lies in a
journal beside the file and is offered when the file is opened again.
"""

from __future__ import annotations

import contextlib
import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import compress, filterfalse
from operator import is_not
from pathlib import Path

from amp_studio.schema import (
    MASKED,
    Address,
    InvalidValueError,
    Value,
    read_address,
    read_file,
    write_value,
    written,
)

from .atomic import append_line, check_output, digest_of, write_atomic
from .lock import EditLock, InUseError, now, user
from .origin import record_origin
from .parameter_file import Change, Header, ParameterFile
from .paths import backup_path, hidden_path, history_path, is_there, real_path, text_of_name
from .reading import HEADER_SECTIONS, Opened, open_file, read_content, read_stored
from .storage import save_file

_TYPED = ("name", "application", "revision", "notes")
"""What a person types of the file itself."""


@dataclass(frozen=True)
class HistoryEntry:
    """One value replaced in a saved file."""

    when: str
    who: str
    how: str
    param: str
    old: str
    new: str


@dataclass(frozen=True)
class Unsaved:
    """The work of a program that ended before it saved."""

    when: str
    who: str
    changes: tuple[Change, ...]
    header: dict[str, str | dict[str, str]]
    """Changed entries of the header (name, notes, …), and the notes about values and groups."""
    fits: bool
    """Whether the file is still the one the work was done on."""


class Document:
    """A parameter file that is open for editing. Close it, or leave the ``with``, to give up the lock."""

    def __init__(self, file: ParameterFile, path: Path, digest: str | None) -> None:
        self.file, self.path, self.digest = file, path, digest
        self.saved = dict(file.values)
        """The values as they are on disk."""
        self._saved_rest = _rest_of(file)
        self.opened = file.copy()
        """The file as it was when it was opened, or made."""
        self._only_viewed = False
        self._lock = EditLock(path)
        self._journal_is_ours = False
        self._history: tuple[object, bytes] = None, b""
        """The state of the history on disk when it was last read, and its content."""
        self.notes: list[str] = []
        """What the last save could not keep or do, each in one sentence for the person at work."""

    # -- opening ---------------------------------------------------------------

    @classmethod
    def open(cls, path: Path | str) -> Document:
        """Open a file for editing; raises ParameterFileError, and InUseError while another program edits
        it.
        """
        path = Path(path)
        document = cls._of(path)
        document._lock.take()
        try:  # the file may have changed while its lock was waited for
            return document if digest_of(path) == document.digest else document._again()
        except BaseException:
            document.close()
            raise

    @classmethod
    def view(cls, path: Path | str) -> Document:
        """Open a file only to look at it; it cannot be saved in place."""
        document = cls._of(Path(path))
        document._only_viewed = True
        return document

    @classmethod
    def _of(cls, path: Path) -> Document:
        opened = open_file(path)
        return cls(opened.file, path, opened.digest)

    def _again(self) -> Document:
        fresh = self._of(self.path)
        fresh._lock = self._lock
        return fresh

    @classmethod
    def create(cls, file: ParameterFile, path: Path | str) -> Document:
        """Save a new file and open it; refuses to overwrite with FileExistsError."""
        path = Path(path)
        if is_there(path):
            known = "exists already" if path.exists() else "is a link to a file that does not exist"
            raise FileExistsError(f"{path} {known}")
        if not path.parent.is_dir():
            raise FileNotFoundError(f"there is no folder {path.parent}")
        check_output(path)
        document = cls(file, path, None)
        document._lock.take()
        try:
            document.save("new")
        except BaseException:
            document.close()
            raise
        return document

    def __enter__(self) -> Document:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Give up the lock and the journal of unsaved work."""
        if self._lock.is_taken:
            self._drop_journal()
            self._lock.release()

    @property
    def is_locked(self) -> bool:
        """Whether this program may save the file in place."""
        return self._lock.is_taken

    # -- saving ----------------------------------------------------------------

    @property
    def is_dirty(self) -> bool:
        """Whether values, marks or header differ from the file on disk."""
        file = self.file
        rest = (file.header, file.forced, file.unknown)
        return self.digest is None or self.saved != file.values or self._saved_rest != rest

    def as_saved(self) -> ParameterFile:
        """Return the file as it is on disk, as far as this document knows: as it was opened,
        saved or acknowledged last.
        """
        header, forced, unknown = self._saved_rest
        file = ParameterFile(self.file.schema, replace(header, extra=dict(header.extra)))
        file.take(self.saved)
        file.forced.update(forced)
        file.unknown.update(unknown)
        return file

    def unsaved_addresses(self) -> list[Address]:
        """Return whose values differ from the file on disk."""
        saved, values = self.saved, self.file.values
        # What was not changed is the same object: the few others alone are compared.
        present = [*map(values.get, saved)]
        others = compress(
            zip(saved, present, saved.values(), strict=True), map(is_not, present, saved.values())
        )
        changed = [address for address, now, old in others if now != old]
        return [*changed, *filterfalse(saved.__contains__, values)]

    def unsaved_changes(self) -> list[Change]:
        """Return what a save would change, in the manual's order."""
        places, values = self.file.machine_schema.places, self.file.values
        found = sorted(self.unsaved_addresses(), key=lambda address: places.get(address, len(places)))
        return [Change(a, self.saved.get(a), values.get(a)) for a in found]

    def save(self, how: str = "edit") -> None:
        """Save in place; the previous file becomes the backup; ``notes`` lists what could not be kept.

        Raises ChangedOnDiskError, SaveError, InUseError.
        """
        if self._only_viewed:
            raise InUseError(f"{self.path.name} was opened only to look at it: save it under a new name")
        self._lock.take()
        changes = self.unsaved_changes() if self.digest is not None else []
        self.notes = [self._lock.remark] if self._lock.remark else []
        self.digest = save_file(self.file, self.path, self.digest, self.notes.append)
        self.saved = dict(self.file.values)
        self._saved_rest = _rest_of(self.file)
        # History and journal after the file: whatever ends the program here, the values are saved.
        self._remember(changes, how)
        self._drop_journal()

    def save_as(self, path: Path | str) -> Document:
        """Save under a new name and return that document; the original stays as it is on disk."""
        path = Path(path)
        twin = self.file.copy()
        twin.header.name = text_of_name(path.stem)
        record_origin(twin, path, self.path)
        return Document.create(twin, path)

    def acknowledge(self, on_disk: Opened) -> None:
        """Take the version on disk, which another program has written, for known: the next save replaces it,
        and it becomes the backup.
        """
        self.digest = on_disk.digest
        self.saved = dict(on_disk.file.values)
        self._saved_rest = _rest_of(on_disk.file)

    # -- history ---------------------------------------------------------------

    @property
    def history_path(self) -> Path:
        """Where the history is kept: one JSON line for each value replaced by a save."""
        return history_path(self.path)

    def _remember(self, changes: list[Change], how: str) -> None:
        """Append to the history; a history that cannot be written does not undo the save, and is noted."""
        if not changes:
            return
        lines = "".join(
            json.dumps(
                [
                    now(),
                    user(),
                    how,
                    written(c.address),
                    self._journal_text(c.address, c.old),
                    self._journal_text(c.address, c.new),
                ]
            )
            + "\n"
            for c in changes
        )
        try:
            append_line(self.history_path, lines.encode(), like=self.path)
        except OSError as error:
            self.notes.append(
                f"{self.path.name}: its history could not be written: {error.strerror or error}"
            )

    def history(self, address: Address | None = None) -> list[HistoryEntry]:
        """Return what was saved before, newest first; of one address, or of all.
        A line that is none is left out.
        """
        content, found = self._history_content(), []
        lines = (
            content.split(b"\n") if address is None else _lines_with(content, json.dumps(written(address)))
        )
        for line in lines:
            with contextlib.suppress(ValueError, RecursionError):
                entry = json.loads(line.decode("utf-8", "replace"))
                if isinstance(entry, list) and len(entry) == 6 and all(isinstance(e, str) for e in entry):
                    found.append(self._masked(HistoryEntry(*entry)))
        return [e for e in reversed(found) if address is None or e.param == written(address)]

    def _history_content(self) -> bytes:
        """Return the history on disk, read when it is another one: the window asks with every key."""
        try:
            there = self.history_path.stat(follow_symlinks=False)
            state = there.st_ino, there.st_size, there.st_mtime_ns
            if state != self._history[0]:
                # No link is followed: another user may have put it there. Of a long history the end is read.
                self._history = state, read_file(self.history_path, follow=False, tail=True)
        except OSError:
            return b""
        return self._history[1]

    def _masked(self, entry: HistoryEntry) -> HistoryEntry:
        """Return an entry without its secret, which was written in clear before secrets were marked."""
        parameter = self.file.schema.parameters.get(read_address(entry.param)[0])
        if parameter is None or not parameter.secret:
            return entry
        return replace(entry, old=MASKED if entry.old else "", new=MASKED if entry.new else "")

    def _journal_text(self, address: Address, value: Value | None) -> str:
        """Return a value as the history keeps it: the history goes where the file does not,
        so it contains no secret.
        """
        is_secret = self.file.schema.parameters[address[0]].secret
        return MASKED if is_secret and value is not None else self._text(address, value)

    def _text(self, address: Address, value: Value | None) -> str:
        return write_value(self.file.schema.parameters[address[0]], value)

    # -- unsaved work ----------------------------------------------------------

    @property
    def journal_path(self) -> Path:
        """Where unsaved work is kept while the file is open."""
        return hidden_path(self.path, ".unsaved")

    def unsaved_writer(self) -> Callable[[], None]:
        """Return what writes the unsaved work of this moment beside the file, so that a killed program loses
        none; no change removes it. Another thread may call it.
        """
        changes, header = self.unsaved_changes(), self._unsaved_header()
        if not changes and not header:
            return self._drop_journal
        entries = [
            [written(c.address), None if c.new is None else self._text(c.address, c.new)] for c in changes
        ]
        left = {"when": now(), "who": user(), "digest": self.digest, "changes": entries, "header": header}

        def write() -> None:
            content = json.dumps(left).encode()
            # No backup: of a journal only the newest state is of use.
            write_atomic(self.journal_path, content, keep_backup=False, companion_of=self.path)
            self._journal_is_ours = True

        return write

    def _unsaved_header(self) -> dict[str, str | dict[str, str]]:
        """Return the header entries that differ from the file on disk."""
        saved = self._saved_rest[0]
        changed = (
            k for k in (*_TYPED, *HEADER_SECTIONS) if getattr(self.file.header, k) != getattr(saved, k)
        )
        texts = {key: getattr(self.file.header, key) for key in changed}
        return {key: text if isinstance(text, str) else dict(text) for key, text in texts.items()}

    def _drop_journal(self) -> None:
        """Remove the journal, if it is this document's: one that a killed program left waits for its
        offer.
        """
        if self._journal_is_ours:
            with contextlib.suppress(OSError):
                self.journal_path.unlink(missing_ok=True)
            self._journal_is_ours = False

    def find_unsaved(self) -> Unsaved | None:
        """Return the work a killed program left for this file, or None; this document's own is not left yet.

        A journal that cannot be read leaves nothing to offer;
        an impossible change in it is left out.
        """
        if self._journal_is_ours:
            return None
        try:
            left = json.loads(read_file(self.journal_path, follow=False))
            changes = [self._left_change(entry, text) for entry, text in left["changes"]]
            known = (*_TYPED, *HEADER_SECTIONS)
            header = {key: text for key, text in left.get("header", {}).items() if key in known}
            when, who, digest = left["when"], left["who"], left["digest"]
        # It was written by a program that was killed, perhaps by another version: anything may be in it.
        except (OSError, ValueError, TypeError, LookupError, AttributeError, RecursionError):
            return None
        if not all(isinstance(text, str) for text in (when, who)) or not all(map(_is_entry, header.items())):
            return None
        return Unsaved(when, who, tuple(filter(None, changes)), header, digest == self.digest)

    def _left_change(self, entry: object, text: object) -> Change | None:
        """Return one change of a journal; None where this schema cannot read it."""
        schema = self.file.schema
        if not isinstance(entry, str) or not isinstance(text, (str, type(None))):
            return None
        address = read_address(entry)
        parameter = schema.parameters.get(address[0])
        # On any machine type: a change of the type may be in the journal too.
        if parameter is None or not any(
            address[1] in schema.on(machine).instances(parameter) for machine in schema.machines
        ):
            return None
        try:
            value = None if text is None else read_stored(schema, parameter, text)
        except InvalidValueError:
            return None
        return Change(address, self.file.get(address), value)

    def discard_unsaved(self) -> None:
        """Throw away the work a killed program left."""
        self.journal_path.unlink(missing_ok=True)


def _lines_with(content: bytes, text: str) -> Iterator[bytes]:
    """Yield the lines that have a text in them."""
    wanted, end = text.encode(), 0
    while (place := content.find(wanted, end)) >= 0:
        end = content.find(b"\n", place)
        end = len(content) if end < 0 else end
        yield content[content.rfind(b"\n", 0, place) + 1 : end]


def _is_entry(entry: tuple[str, object]) -> bool:
    """Return whether an entry of a journal is one of a header: a text, or notes by what they are about."""
    key, found = entry
    if key in _TYPED:
        return isinstance(found, str)
    return isinstance(found, dict) and all(isinstance(text, str) for text in found.values())


def _rest_of(file: ParameterFile) -> tuple[Header, dict[Address, str], dict[str, str]]:
    """Return what a file contains besides its values, apart from the file."""
    return replace(file.header), dict(file.forced), dict(file.unknown)


def recover_backup(path: Path, expected: str | None = "") -> str:
    """Make the backup the file again; what was there becomes the backup. Raises FileNotFoundError,
    ParameterFileError, SaveError.
    """
    backup = backup_path(path)
    try:
        content = read_file(backup)
    except FileNotFoundError:
        raise FileNotFoundError(f"{path.name} has no backup") from None
    read_content(backup, content)  # a backup that cannot be read is not put in place
    return write_atomic(real_path(path), content, expected)  # a link may lead to a file that was deleted
