"""The open file as the desktop program sees it: document, findings, undo, unsaved work.

Every view listens to this object and asks it; none keeps values of its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from amp_studio.files import Change, Document, ParameterFile
from amp_studio.schema import Address, Rule, Value
from amp_studio.validate import Finding, Validator


class _Edit(QUndoCommand):
    """One step of the undo stack: a few values replaced together."""

    def __init__(self, workspace: Workspace, text: str, changes: list[Change], forced: str) -> None:
        super().__init__(text)
        self._workspace, self._changes, self._forced = workspace, changes, forced
        self._first = True

    def redo(self) -> None:
        if not self._first:
            for change in self._changes:
                self._workspace.file.apply(change)
            for change in self._changes:
                if self._forced and change.new is not None:
                    self._workspace.mark_if_out_of_range(change.address, self._forced)
        self._first = False
        self._workspace.after_edit([c.address for c in self._changes])

    def undo(self) -> None:
        for change in reversed(self._changes):
            self._workspace.file.apply(change.reversed())
        self._workspace.after_edit([c.address for c in self._changes])


class Workspace(QObject):
    """One open document with its validator and undo stack."""

    changed = Signal(list)
    """Addresses whose values changed; findings and states are already up to date."""
    saved = Signal()

    def __init__(self, document: Document, extra_rules: Iterable[Rule] = ()) -> None:
        super().__init__()
        self.document = document
        self.undo_stack = QUndoStack(self)
        self.validator = Validator(document.file, extra_rules)
        self.findings: tuple[Finding, ...] = self.validator.run()
        self._journal = QTimer(self)
        self._journal.setSingleShot(True)
        self._journal.setInterval(1500)
        self._journal.timeout.connect(self._keep_unsaved)

    @property
    def file(self) -> ParameterFile:
        """The parameter file."""
        return self.document.file

    @property
    def path(self) -> Path:
        """Where it is on disk."""
        return self.document.path

    # -- editing ---------------------------------------------------------------

    def edit(self, text: str, wanted: Mapping[Address, Value | None], force: str = "") -> bool:
        """Change values as one undoable step; raises RangeFault, and then nothing is changed."""
        return self.push(text, self.file.set_many(wanted, force), force)

    def push(self, text: str, changes: list[Change], force: str = "") -> bool:
        """Put changes that were made already on the undo stack; tells whether there were any."""
        if not changes:
            return False
        self.undo_stack.push(_Edit(self, text, changes, force))
        return True

    def mark_if_out_of_range(self, address: Address, forced: str) -> None:
        """Mark a value that was forced, when it is put back by redo."""
        from amp_studio.schema import fault

        value = self.file.get(address)
        if value is not None and fault(self.file.situation, address, value):
            self.file.forced[address] = forced

    def after_edit(self, addresses: list[Address]) -> None:
        """Bring findings up to date and tell the views."""
        self.findings = self.validator.update(addresses)
        self._journal.start()
        self.changed.emit(addresses)

    def revalidate(self) -> None:
        """Check everything again."""
        self.findings = self.validator.run()
        self.changed.emit([])

    # -- disk ------------------------------------------------------------------

    @property
    def is_dirty(self) -> bool:
        """Whether there is anything to save."""
        return self.document.is_dirty

    def save(self) -> None:
        """Save in place; raises ChangedOnDisk, SaveFault, InUse."""
        self._journal.stop()
        self.document.save("studio")
        self.undo_stack.setClean()
        self.saved.emit()

    def _keep_unsaved(self) -> None:
        try:
            self.document.keep_unsaved()
        except OSError:
            self._journal.start(10_000)  # a full disk may have room again later

    def close(self) -> None:
        """Give up the file."""
        self._journal.stop()
        self.document.close()

    # -- asking ----------------------------------------------------------------

    def findings_of(self, address: Address) -> tuple[Finding, ...]:
        """Return the findings that are about one address."""
        return tuple(f for f in self.findings if address in f.addresses)
