"""What can be compared with an open file, and how each of it is read: other versions of it, other files,
controls, axes.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from functools import partial
from pathlib import Path

from PySide6.QtCore import QObject

from amp_studio.files import (
    HeaderSnapshot,
    HistoryEntry,
    ParameterFile,
    as_axis,
    axis_letters,
    backup_path,
    before_saves,
    by_schema,
    matched_by_letter,
    open_file,
    real_path,
    with_defaults,
)
from amp_studio.ui.base.task import TaskProgress
from amp_studio.ui.base.time_words import stored_in_words
from amp_studio.ui.base.workspace import Workspace

_NEWEST = 10
"""How many of the saves, and of the kept copies, are offered."""


@dataclass(frozen=True)
class MergeSource:
    """One source as it was read.

    ``title`` and ``detail`` are its two lines; ``is_now`` is the file in front with its unsaved changes;
    ``remark`` is what a person has to know of it: axes that were matched by their letters,
    another machine type.
    """

    title: str
    detail: str
    file: ParameterFile
    is_now: bool = False
    remark: str = ""


ReadSource = Callable[[TaskProgress, threading.Event], MergeSource]
"""Reads a source; is run in the background, and may be cancelled."""


@dataclass(frozen=True)
class Offer:
    """A source that can be chosen, or a list of them.

    ``start`` is called in the window's thread: it takes copies of what is open, asks for a file or an
    address, and returns what reads the source; None if nothing was chosen.
    """

    text: str
    start: Callable[[], ReadSource | None] | None = None
    inner: tuple[Offer, ...] = ()


class MergeSources(QObject):
    """The sources for one open file."""

    def __init__(self, workspace: Workspace, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._workspace = workspace
        self._name = workspace.path.name

    @property
    def _file(self) -> ParameterFile:
        return self._workspace.file

    @property
    def folder(self) -> Path:
        """Where the file is."""
        return self._workspace.path.parent

    # -- versions of the file ----------------------------------------------------

    def now(self) -> MergeSource:
        """Return the file as it is, with what is not saved."""
        changes = len(self._workspace.document.unsaved_changes())
        detail = self.tr("this file, %n unsaved changes", "", changes) if changes else self.tr("this file")
        # A copy: the file is edited on while it is compared.
        return MergeSource(self._name, detail, self._file.copy(), is_now=True)

    def as_saved(self) -> MergeSource:
        """Return the file as it was saved or opened last."""
        return MergeSource(self.tr("Last saved"), self._name, self._workspace.document.as_saved())

    def as_opened(self) -> MergeSource:
        """Return the file as it was when it was opened."""
        return MergeSource(self.tr("When opened"), self._name, self._workspace.document.opened.copy())

    def on_disk(self, file: ParameterFile) -> MergeSource:
        """Return the file as it is on disk; raises ValueError for one of another family."""
        return MergeSource(self.tr("On disk"), self._name, self._fitting(file, self._name))

    def backup(self) -> ReadSource:
        """Return what reads the file as it was before its last save."""
        path = backup_path(self._workspace.path)

        def read(_progress: TaskProgress, _cancel: threading.Event) -> MergeSource:
            return MergeSource(self.tr("Backup"), path.name, self._fitting(open_file(path).file, path.name))

        return read

    def defaults(self) -> ReadSource:
        """Return what makes the file with the printed defaults."""
        return self.from_copy(self._defaults)

    def _defaults(self, file: ParameterFile) -> MergeSource:
        return MergeSource(self.tr("Defaults"), self.tr("as the manual prints them"), with_defaults(file))

    def _earlier(self, file: ParameterFile, entries: Sequence[HistoryEntry]) -> MergeSource:
        title = self.tr("Before {time}").format(time=stored_in_words(entries[-1].when))
        return MergeSource(title, self._name, before_saves(file, entries))

    def _saves(self) -> list[list[HistoryEntry]]:
        """Return for each of the newest saves the entries that lead back to what was there before it."""
        entries = self._workspace.document.history()
        found: list[list[HistoryEntry]] = []
        n = 0
        while n < len(entries) and len(found) < _NEWEST:
            when = entries[n].when
            # All entries of one save have its time.
            while n < len(entries) and entries[n].when == when:
                n += 1
            found.append(entries[:n])
        return found

    def axis(self, file: ParameterFile, target: str, source: str) -> MergeSource:
        """Return the file with one axis in the place of another."""
        letters = axis_letters(file)
        title = self.tr("Axis {source}").format(source=letters.get(source, source))
        detail = self.tr("in the place of axis {target}").format(target=letters.get(target, target))
        return MergeSource(title, detail, as_axis(file, source, target))

    # -- other files and controls ------------------------------------------------

    def other_file(self, mine: ParameterFile, path: Path) -> MergeSource:
        """Return another file, its axes matched by their letters; raises ParameterFileError, ValueError."""
        return self.other(mine, open_file(path).file, path.name, str(path.parent))

    def other(self, mine: ParameterFile, file: ParameterFile, name: str, detail: str) -> MergeSource:
        """Return a file of another machine, its axes matched by the letters of ``mine``; raises
        ValueError.
        """
        matched = matched_by_letter(self._fitting(file, name), mine)
        moved = self.tr("Axis {letter} is axis {number} in {file}; it is compared with axis {place} here.")
        remarks = [
            moved.format(letter=letter, number=number, file=name, place=place)
            for letter, number, place in matched.moved
        ]
        if matched.left_out:
            only = self.tr("Only {file} has the axes {letters}, and there is no free axis for them here.")
            remarks.append(only.format(file=name, letters=", ".join(matched.left_out)))
        if file.machine != mine.machine:
            kind = self.tr("{file} is for another machine type ({machine}).")
            remarks.append(kind.format(file=name, machine=file.machine))
        return MergeSource(name, detail, matched.file, remark=" ".join(remarks))

    def last_download(self, file: ParameterFile) -> MergeSource:
        """Return what the last download put into a control; raises NoDownloadError."""
        from amp_studio.transfer.client import last_download

        found = last_download(file, self._workspace.path)
        return MergeSource(self.tr("Last download"), stored_in_words(found.when), found.file)

    def kept_copy(self, file: ParameterFile, path: Path) -> MergeSource:
        """Return a copy of what a control contained; raises CopyError, ParameterFileError, ValueError."""
        from amp_studio.transfer.client import CopyError, completed, open_copy

        copy = open_copy(path)
        if copy.file is None:
            raise CopyError(self.tr("{file} cannot be shown: {why}").format(file=path.name, why=copy.fault))
        content = self._fitting(copy.file, path.name)
        # Completed by this file: a control does not contain its notes, ticks and header.
        return MergeSource(self.tr("Kept copy"), _stamp(path), completed(content, copy.image, file))

    def of_content(self, file: ParameterFile, image: bytes, address: str) -> MergeSource:
        """Return what a control contains; raises ImageError, ValueError."""
        from amp_studio.transfer import decode_content
        from amp_studio.transfer.client import completed

        content = self._fitting(decode_content(image), address)
        detail = self.tr("read from the control at {time}").format(
            time=f"{datetime.now(UTC).astimezone():%H:%M}"
        )
        return MergeSource(address, detail, completed(content, image, file))

    def control_now(self, address: str) -> ReadSource:
        """Return what reads a control."""
        file = self._file.copy()

        def read(progress: TaskProgress, cancel: threading.Event) -> MergeSource:
            from amp_studio.transfer import Exchange
            from amp_studio.transfer.client import fetch_image

            image = fetch_image(address, Exchange(progress, cancel), family=file.schema.family.family)
            return self.of_content(file, image, address)

        return read

    def copies(self) -> list[Path]:
        """Return the newest kept copies of what controls contained before this file was downloaded."""
        place = real_path(self._workspace.path)
        # A name may contain the characters of a pattern.
        stem = "".join(f"[{c}]" if c in "*?[" else c for c in place.stem)
        return sorted(place.parent.glob(f"{stem}.before-*.img"), reverse=True)[:_NEWEST]

    def _fitting(self, file: ParameterFile, name: str) -> ParameterFile:
        """Return a file by the schema of the open one; raises ValueError for one of another family."""
        wanted, found = self._file.schema.family, file.schema.family
        if found.family != wanted.family:
            text = self.tr(
                "{file} is for {other} and {this} is for {family}: only files of one family can be compared."
            )
            raise ValueError(text.format(file=name, other=found.name, this=self._name, family=wanted.name))
        # One schema for all sources: rows are compared by address.
        return by_schema(file, self._file.schema)

    # -- what is offered -----------------------------------------------------------

    def offers(
        self,
        others: Sequence[Workspace],
        ask_file: Callable[[], ReadSource | None],
        ask_control: Callable[[], ReadSource | None],
        ask_copy: Callable[[], ReadSource | None],
    ) -> list[tuple[str, list[Offer]]]:
        """Return everything that the file can be compared with, by sections."""
        copies = tuple(
            Offer(_stamp(path), partial(self.from_copy, self.kept_copy, path)) for path in self.copies()
        )
        return [
            (self.tr("This File"), list(self._versions())),
            (self.tr("Other Files"), [*self._others(others), Offer(self.tr("Another &File…"), ask_file)]),
            (
                self.tr("Control"),
                [
                    Offer(self.tr("&Control Now…"), ask_control),
                    Offer(self.tr("Last Do&wnload"), partial(self.from_copy, self.last_download)),
                    Offer(
                        self.tr("&Kept Copies"), inner=(*copies, Offer(self.tr("Another &Copy…"), ask_copy))
                    ),
                ],
            ),
        ]

    def from_copy(self, make: Callable[..., MergeSource], *rest: object) -> ReadSource:
        """Return what reads a source from a copy of the file, which may be edited meanwhile."""
        file = self._file.copy()
        return lambda _progress, _cancel: make(file, *rest)

    def _done(self, make: Callable[[], MergeSource]) -> ReadSource:
        """Return what has been read already."""
        source = make()
        return lambda _progress, _cancel: source

    def _versions(self) -> Iterator[Offer]:
        """Yield what the open file can be compared with: its earlier contents, defaults, another axis."""
        yield Offer(self.tr("&Now, With Unsaved Changes"), partial(self._done, self.now))
        yield Offer(self.tr("As Last &Saved"), partial(self._done, self.as_saved))
        yield Offer(self.tr("As &Opened"), partial(self._done, self.as_opened))
        path = self._workspace.path
        yield Offer(
            self.tr("On &Disk"), lambda: lambda _progress, _cancel: self.on_disk(open_file(path).file)
        )
        # Asked each time the menu opens: the first save makes it.
        if backup_path(path).is_file():
            yield Offer(self.tr("&Backup"), self.backup)
        if saves := self._saves():
            text = self.tr("Before {time}, {who}")
            yield Offer(
                self.tr("&Earlier Saves"),
                inner=tuple(
                    Offer(
                        text.format(time=stored_in_words(save[-1].when), who=save[-1].who),
                        partial(self._before, save),
                    )
                    for save in saves
                ),
            )
        yield Offer(self.tr("Default &Values"), self.defaults)
        letters = axis_letters(self._file)
        if len(letters) > 1:
            yield Offer(self.tr("Another A&xis"), inner=tuple(self._axes(letters)))

    def _before(self, save: Sequence[HistoryEntry]) -> ReadSource:
        file = self._workspace.document.as_saved()
        return lambda _progress, _cancel: self._earlier(file, save)

    def _axes(self, letters: dict[str, str]) -> Iterator[Offer]:
        for target, letter in letters.items():
            inner = (
                Offer(
                    self.tr("Axis {source}").format(source=name),
                    partial(self.from_copy, self.axis, target, source),
                )
                for source, name in letters.items()
                if source != target
            )
            yield Offer(self.tr("In the Place of Axis {target}").format(target=letter), inner=tuple(inner))

    def _others(self, others: Sequence[Workspace]) -> Iterator[Offer]:
        family = self._file.schema.family.family
        for each in others:
            if each is not self._workspace and each.file.schema.family.family == family:
                yield Offer(each.path.name.replace("&", "&&"), partial(self._open_file, each))

    def _open_file(self, each: Workspace) -> ReadSource:
        mine, file = self._file.copy(), each.file.copy()
        detail = self.tr("open in another tab")
        return lambda _progress, _cancel: self.other(mine, file, each.path.name, detail)


def is_same_content(a: ParameterFile, b: ParameterFile) -> bool:
    """Return whether two states of a file are the same: values, marks,
    header and what the schema does not know.
    """
    return a.values == b.values and HeaderSnapshot.of(a) == HeaderSnapshot.of(b)


def _stamp(path: Path) -> str:
    """Return when a copy was kept, as its name has it: ``2026-11-18 16:20``."""
    stamp = path.stem.partition(".before-")[2]
    digits = stamp.partition("-")[0] + stamp.partition("-")[2][:6]
    if len(digits) != 14 or not digits.isdecimal():
        return path.name
    return f"{digits[:4]}-{digits[4:6]}-{digits[6:8]} {digits[8:10]}:{digits[10:12]}{stamp[15:]}"
