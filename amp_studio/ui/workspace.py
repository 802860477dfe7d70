"""The open file as the desktop program sees it: document, findings, undo, unsaved work.

Every view reads from this object and listens to it; no view stores values.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from amp_studio.files import Change, Comparison, Document, Opened, ParameterFile, compare, digest_of
from amp_studio.files.parameter_file import Marks
from amp_studio.schema import Address, Value, read_value
from amp_studio.validate import NOT_SET, Finding, Validator, rules_beside

JOURNAL_MS = 500
"""Milliseconds after an edit until the journal is written, so that a kill loses at most the last second."""


class _Edit(QUndoCommand):
    """One step of the undo stack: values changed together, with their forced marks."""

    def __init__(
        self, workspace: Workspace, text: str, changes: list[Change], before: Marks, after: Marks
    ) -> None:
        super().__init__(text)
        self._workspace, self._changes, self._before, self._after = workspace, changes, before, after
        self._first = True

    def redo(self) -> None:
        if self._first:
            self._first = False
        else:
            self._workspace.file.replay(self._changes, self._after)
        self._notify()

    def undo(self) -> None:
        self._workspace.file.take_back(self._changes, self._before)
        self._notify()

    def _notify(self) -> None:
        marked = self._before.forced.items() ^ self._after.forced.items()
        addresses = [c.address for c in self._changes] + [a for a, _ in marked]
        self._workspace.after_edit(list(dict.fromkeys(addresses)))


class Workspace(QObject):
    """One open document with its validator and undo stack."""

    changed = Signal(list)
    """Addresses whose values changed (empty: any of them); findings and states are already up to date."""
    saved = Signal()
    closed = Signal()

    def __init__(self, document: Document, validator: Validator | None = None) -> None:
        """Open a workspace on a document; a given ``validator`` has already run."""
        super().__init__()
        self.document = document
        self.undo_stack = QUndoStack(self)
        self.validator = validator or Validator(document.file)
        self.findings: tuple[Finding, ...] = validator.findings() if validator else self.validator.run()
        self.as_entered = False
        """Whether each value is shown in its unit of entry instead of the file's unit system."""
        self.secrets = False
        """Whether secrets are shown in clear text."""
        self.control: tuple[dict[Address, Value], str] | None = None
        """The values of the control when it was last read, and the time of that."""
        self.is_saving = False
        self._saved = (Marks.of(document.file), document.file.header.units)
        self._journal = QTimer(self)
        self._journal.setSingleShot(True)
        self._journal.timeout.connect(self._keep_unsaved)

    @property
    def file(self) -> ParameterFile:
        """The parameter file."""
        return self.document.file

    @property
    def path(self) -> Path:
        """Where it is on disk."""
        return self.document.path

    @property
    def may_edit(self) -> bool:
        """Whether this program has the lock of the file; without it the file is read-only."""
        return self.document.is_locked

    # -- editing ---------------------------------------------------------------

    def is_masked(self, address: Address) -> bool:
        """Return whether the value of an address is a secret that is masked."""
        return self.file.schema.parameters[address[0]].secret and not self.secrets

    def show_secrets(self, secrets: bool) -> None:
        """Show secrets in clear text, or mask them again."""
        self.secrets = secrets
        self.changed.emit([])

    def edit(self, text: str, wanted: Mapping[Address, Value | None], force: str = "") -> bool:
        """Change values as one undoable step; raises RangeError, and then nothing is changed."""
        return self.do(text, lambda: self.file.set_many(wanted, force))

    def do(self, text: str, operation: Callable[[], object]) -> bool:
        """Run an operation on the file as one undoable step; returns whether it changed anything.

        An operation that raises leaves the file as it was.
        """
        before = Marks.of(self.file)
        with self.file.step() as changes:
            operation()
        after = Marks.of(self.file)
        if not changes and before == after:
            return False
        self.undo_stack.push(_Edit(self, text, changes, before, after))
        return True

    def after_edit(self, addresses: list[Address]) -> None:
        """Update the findings and notify the views."""
        self.findings = self.validator.update(addresses)
        if (
            not self._journal.isActive()
        ):  # not restarted by the next edit, so that continued typing loses no more than this
            self._journal.start(JOURNAL_MS)
        self.changed.emit(addresses)

    def show_in(self, units: str | None) -> None:
        """Show values in a unit system of the family, or as entered (None); no value changes."""
        self.as_entered = units is None
        if units is not None:
            self.file.header.units = units
        self.findings = self.validator.run()  # messages give numbers in these units
        self.changed.emit([])

    def read_own_rules(self) -> None:
        """Check again with the present rules file beside the parameter file."""
        self.validator = Validator(self.file, rules_beside(self.path, self.file.schema))
        self.findings = self.validator.run()
        self.changed.emit([])

    # -- disk ------------------------------------------------------------------

    @property
    def is_dirty(self) -> bool:
        """Whether there are unsaved changes."""
        return self.document.is_dirty or self._saved != (Marks.of(self.file), self.file.header.units)

    def save(self, run: Callable[[Callable[[], None]], None] = lambda work: work()) -> None:
        """Save in place, through ``run`` (a thread); raises ChangedOnDiskError, SaveError, InUseError."""
        self._journal.stop()
        self.is_saving = True
        try:
            run(lambda: self.document.save("studio"))
        except BaseException:
            self._journal.start(JOURNAL_MS)
            raise
        finally:
            self.is_saving = False
        self._saved = (Marks.of(self.file), self.file.header.units)
        self.saved.emit()

    def acknowledge(self, on_disk: Opened) -> None:
        """Take the file on disk, which another program has changed, for known: a save may replace it, and it becomes the backup."""
        self.document.acknowledge(on_disk)
        self.changed.emit([])

    def disk_state(self) -> str | None:
        """Return None while the file on disk is unchanged, else ``removed`` or its present digest."""
        try:
            digest = digest_of(self.path)
        except OSError:
            return None  # a network drive may be unavailable for a moment
        return None if digest == self.document.digest else digest or "removed"

    def _keep_unsaved(self) -> None:
        if self.may_edit:
            try:
                self.document.keep_unsaved()
            except OSError:
                self._journal.start(10_000)  # a full disk may have room again later

    def close(self) -> None:
        """Close the file."""
        self._journal.stop()
        self.document.close()
        self.closed.emit()

    # -- asking ----------------------------------------------------------------

    def findings_of(self, address: Address) -> tuple[Finding, ...]:
        """Return the findings about one address."""
        return tuple(f for f in self.findings if address in f.addresses)

    def effective(self) -> dict[Address, Value]:
        """Return the effective values where they differ from the values of the file."""
        return {s.address: s.value for f in reversed(self.findings) for s in f.effective}

    def count(self, severity: str) -> int:
        """Return how many findings of a severity there are; values that are not set are a state of the file, not findings."""
        return sum(f.severity == severity and f.rule != NOT_SET for f in self.findings)

    def changes(self) -> int:
        """Return how many values differ from those on disk, as far as this program knows them."""
        saved, present = self.document.saved, self.file.values
        return sum(saved.get(a) != present.get(a) for a in saved.keys() | present.keys())

    def typed_unit(self, address: Address) -> str:
        """Return the unit of a number typed without one: the unit in which the value is shown."""
        value = self.file.get(address)
        if self.as_entered and value is not None and value.unit:
            return value.unit
        return self.file.evaluation.unit(address, self.file.header.units)

    def read(self, address: Address, text: str) -> Value | None:
        """Read what a person typed for an address, None for nothing; raises InvalidValueError."""
        if not text.strip():
            return None
        return read_value(self.file.schema.parameters[address[0]], text, self.typed_unit(address))

    def remember_control(self, values: dict[Address, Value], when: str) -> None:
        """Store the values of the control, to be shown beside the values of the file."""
        self.control = (dict(values), when)
        self.changed.emit([])

    def differences_to(self, values: Mapping[Address, Value]) -> Comparison:
        """Return the comparison of the edited file with other values, as far as its schema knows them."""
        known = {a: v for a, v in values.items() if a[0] in self.file.schema.parameters}
        return compare(self.file.schema, self.file.values, known)
