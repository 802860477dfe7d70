"""The open file as the desktop program sees it: document, findings, undo, unsaved work.

Every view reads from this object and listens to it; no view stores values.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QUndoCommand, QUndoStack

from amp_studio.files import (
    BlockEntry,
    Change,
    Document,
    HeaderSnapshot,
    Opened,
    ParameterFile,
    describe,
    digest_of,
    now,
    plan_entry,
)
from amp_studio.guide import GuideProgress, progress
from amp_studio.schema import Address, Value, axis_name, show_value
from amp_studio.validate import (
    NOT_SET,
    Earlier,
    Entered,
    Finding,
    Validator,
    earlier_beside,
    enter,
    read_plain,
    rules_beside,
)

from .single_shot import single_shot
from .task import Task
from .translated import worded

_JOURNAL_MS = 500
"""Milliseconds after an edit until the journal is written, so that a kill loses at most the last second."""


class _Edit(QUndoCommand):
    """One step of the undo stack: values changed together, with their forced marks."""

    def __init__(
        self,
        workspace: Workspace,
        text: str,
        changes: list[Change],
        before: HeaderSnapshot,
        after: HeaderSnapshot,
    ) -> None:
        super().__init__(text)
        self._workspace, self._changes, self._before, self._after = workspace, changes, before, after
        self._first = True

    def redo(self) -> None:
        # ``push`` calls this at once, for a change that has been made already: it made the step.
        if self._first:
            self._first = False
        else:
            self._workspace.file.replay(self._changes, self._after)
        self._notify()

    def undo(self) -> None:
        self._workspace.file.take_back(self._changes, self._before)
        self._notify()

    def _notify(self) -> None:
        # A mark can change without its value: then no change of a value names the cell to paint.
        marked = self._before.forced.items() ^ self._after.forced.items()
        addresses = [c.address for c in self._changes] + [a for a, _ in marked]
        self._workspace.is_stepping = True
        try:
            self._workspace.after_edit(list(dict.fromkeys(addresses)))
        finally:
            self._workspace.is_stepping = False


def earlier_of(document: Document) -> tuple[Earlier, ...]:
    """Return what an open file is compared with: the saved file, and what lies beside it."""
    saved = Earlier("in the saved file", document.saved)
    return (saved, *earlier_beside(document.path, document.file))


class Workspace(QObject):
    """One open document with its validator and undo stack."""

    changed = Signal(list)
    """Addresses whose values changed (empty: any of them); findings and states are already up to date."""
    is_stepping = False
    """Whether a step is being made or taken back: the undo stack signals it once it has it."""
    saved = Signal()
    closed = Signal()
    unsaved_at_risk = Signal(str)
    """Unsaved work cannot be kept on disk for the case that the program is killed, and why; once until it can
    be kept again.
    """

    def __init__(self, document: Document, validator: Validator | None = None) -> None:
        """Open a workspace on a document; a given ``validator`` has already run."""
        super().__init__()
        self.document = document
        self.undo_stack = QUndoStack(self)
        self.validator = validator or Validator(document.file, earlier=earlier_of(document))
        self.findings: tuple[Finding, ...] = validator.findings() if validator else self.validator.run()
        self._progress: GuideProgress | None = None
        """How far commissioning is, until the findings change."""
        self._deferred: tuple[GuideProgress, frozenset[int]] | None = None
        self.shows_later = False
        """Whether findings of steps that have not been reached are listed too."""
        self.as_entered = False
        """Whether each value is shown in its unit of entry instead of the file's unit system."""
        self.secrets = False
        """Whether secrets are shown in clear text."""
        self.control: tuple[dict[Address, Value], str] | None = None
        """The values of the control when it was last read, and the time of that."""
        self.is_saving = False
        self._saved = (HeaderSnapshot.of(document.file), document.file.header.units)
        self._is_at_risk = False
        self._keeping: Task | None = None
        """Writes the journal."""
        self._journal = single_shot(self, self._keep_unsaved)

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
        return self.do(text, lambda: self.file.set_checked(wanted, force))

    def entered(self, address: Address, text: str) -> Entered:
        """Read what a person typed for an address, a value or an expression; raises InvalidValueError."""
        return enter(self.file, address, text, self.typed_unit)

    def enter(self, address: Address, text: str, *, force: bool = False) -> bool:
        """Set a value from typed text as one undoable step; raises InvalidValueError,
        and RangeError unless it is forced.

        Returns whether it changed anything.
        """
        entered = self.entered(address, text)
        why = self.tr("on {now} in the studio").format(now=now()) if force else ""
        return self.edit(
            self.step_text({address: entered.value}, entered.expression), {address: entered.value}, why
        )

    def enter_all(self, texts: Mapping[Address, str]) -> list[str]:
        """Set several values from typed texts as one undoable step, all or none;
        returns why those refused are refused.
        """
        entry = self.plan(texts)
        if not entry.refused:
            self.take(entry)
        return [f"{self.name_of(cell.address)}: {cell.problem}" for cell in entry.refused]

    def plan(self, texts: Mapping[Address, str]) -> BlockEntry:
        """Return what setting values from typed texts would do."""
        return plan_entry(self.file, texts, lambda a, text: self.entered(a, text).value)

    def take(self, entry: BlockEntry) -> bool:
        """Set what a planned entry changes as one undoable step; returns whether it changed anything."""
        return bool(entry.changed) and self.edit(self.step_text(entry.changed), entry.changed)

    def read_plain(self, address: Address, text: str) -> Value:
        """Read a pasted text for an address, which is no expression; raises InvalidValueError."""
        return read_plain(self.file, address, text, self.typed_unit)

    def name_of(self, address: Address) -> str:
        """Return what a value is called in a sentence: ``1750 Excess Error, X``."""
        place = axis_name(self.file.evaluation, address[1]) or worded(
            self.file.machine_schema.instance_label(address)
        )
        return f"{describe(self.file, address)}, {place}" if place else describe(self.file, address)

    def step_text(self, wanted: Mapping[Address, Value | None], expression: str = "") -> str:
        """Return what a step is called in the list of steps: ``Set 1750 Excess Error,
        X to 12 mm (6 mm * 2)``.
        """
        if len(wanted) != 1:
            parameters = {a[0] for a in wanted}
            if len(parameters) == 1:
                return self.tr("Set %n values of {name}", "", len(wanted)).format(
                    name=describe(self.file, next(iter(wanted)))
                )
            return self.tr("Set %n values", "", len(wanted))
        ((address, value),) = wanted.items()
        if value is None:
            return self.tr("Clear {name}").format(name=self.name_of(address))
        parameter = self.file.schema.parameters[address[0]]
        # The list of steps is on the screen longer than a secret may be.
        value_text = show_value(parameter, value, secrets=False)
        text = self.tr("Set {name} to {value}").format(name=self.name_of(address), value=value_text)
        return f"{text} ({expression})" if expression and not parameter.secret else text

    def do(self, text: str, operation: Callable[[], object]) -> bool:
        """Run an operation on the file as one undoable step; returns whether it changed anything.

        An operation that raises leaves the file as it was.
        """
        before = HeaderSnapshot.of(self.file)
        with self.file.step() as changes:
            operation()
        after = HeaderSnapshot.of(self.file)
        # No step that undoes nothing: Ctrl+Z would seem not to work.
        if not changes and before == after:
            return False
        self.undo_stack.push(_Edit(self, text, changes, before, after))
        return True

    def after_edit(self, addresses: list[Address]) -> None:
        """Update the findings, keep the journal, and notify the views."""
        if (
            not self._journal.isActive()
        ):  # not restarted by the next edit, so that continued typing loses no more than this
            self._journal.start(_JOURNAL_MS)
        self.follow(addresses)

    def follow(self, addresses: list[Address]) -> None:
        """Update the findings and notify the views of values that are not decided yet,
        as while a handle is dragged.
        """
        self.findings, self._progress = self.validator.update(addresses), None
        self.changed.emit(addresses)

    def show_in(self, units: str | None) -> None:
        """Show values in a unit system of the family, or as entered (None); no value changes."""
        self.as_entered = units is None
        if units is not None:
            self.file.header.units = units
        self.findings, self._progress = self.validator.run(), None  # messages give numbers in these units
        self.changed.emit([])

    def read_own_rules(self) -> None:
        """Check again with the present rules file beside the parameter file."""
        own = rules_beside(self.path, self.file)
        self.validator = Validator(self.file, own, earlier_of(self.document))
        self.findings, self._progress = self.validator.run(), None
        self.changed.emit([])

    # -- disk ------------------------------------------------------------------

    @property
    def is_dirty(self) -> bool:
        """Whether there are unsaved changes."""
        return self.document.is_dirty or self._saved != (HeaderSnapshot.of(self.file), self.file.header.units)

    def save(self, run: Callable[[Callable[[], None]], None] = lambda work: work()) -> None:
        """Save in place, through ``run`` (a thread); raises ChangedOnDiskError, SaveError, InUseError."""
        self._end_keeping()
        self._journal.stop()
        self.is_saving = True
        try:
            run(lambda: self.document.save("studio"))
        except BaseException:
            # What could not be saved is unsaved work as before.
            self._journal.start(_JOURNAL_MS)
            raise
        finally:
            self.is_saving = False
        self._saved = (HeaderSnapshot.of(self.file), self.file.header.units)
        self._compare_again()
        self.saved.emit()

    def _compare_again(self) -> None:
        """Compare with what the file was before this save, which is the backup now."""
        self.validator.compare_with(earlier_of(self.document))
        now = self.validator.findings()
        if now != self.findings:
            self.findings, self._progress = now, None
            self.changed.emit([])

    def acknowledge(self, on_disk: Opened) -> None:
        """Take the file on disk, which another program has changed, for known: a save may replace it,
        and it becomes the backup.
        """
        self.document.acknowledge(on_disk)
        self._compare_again()
        self.changed.emit([])

    def disk_state(self) -> str | None:
        """Return None while the file on disk is unchanged, else ``removed`` or its present digest."""
        try:
            digest = digest_of(self.path)
        except OSError:
            return None  # a network drive may be unavailable for a moment
        return None if digest == self.document.digest else digest or "removed"

    def _keep_unsaved(self) -> None:
        """Write the journal in a thread: a disk takes as long for it as the window for several keys."""
        if self._keeping is not None:
            self._journal.start(_JOURNAL_MS)
        elif self.may_edit:
            write = self.document.unsaved_writer()
            self._keeping = Task(lambda *_: write())
            self._keeping.finished.connect(self._end_keeping)
            self._keeping.begin()

    def _end_keeping(self) -> None:
        """Wait until the journal is written, and report where it could not be."""
        task, self._keeping = self._keeping, None
        if task is None:
            return
        try:
            task.outcome()
        except OSError as error:
            self._journal.start(10_000)  # a full disk may have room again later
            if not self._is_at_risk:
                self.unsaved_at_risk.emit(error.strerror or str(error))
            self._is_at_risk = True
        else:
            self._is_at_risk = False

    def release(self) -> None:
        """Give up the lock and the journal: the file is opened again, or closed."""
        self._end_keeping()  # it would write the journal of a closed file, offered as lost work
        self._journal.stop()
        self.document.close()

    def close(self) -> None:
        """Close the file."""
        self.release()
        self.closed.emit()

    # -- asking ----------------------------------------------------------------

    @property
    def progress(self) -> GuideProgress:
        """How far commissioning is: what each step has open, and which findings are deferred."""
        if self._progress is None:
            self._progress = progress(self.validator, self.findings)
        return self._progress

    def is_deferred(self, finding: Finding) -> bool:
        """Return whether lists leave a present finding out: it is of a step that has not been reached,
        and it was not asked for.
        """
        if self.shows_later:
            return False
        if self._deferred is None or self._deferred[0] is not self.progress:
            self._deferred = self.progress, frozenset(map(id, self.progress.deferred))
        return id(finding) in self._deferred[1]

    @property
    def listed(self) -> tuple[Finding, ...]:
        """The findings that lists show."""
        return tuple(finding for finding in self.findings if not self.is_deferred(finding))

    def show_later(self, later: bool) -> None:
        """List the findings of steps that have not been reached, or leave them out."""
        self.shows_later = later
        self.changed.emit([])

    def findings_of(self, address: Address) -> tuple[Finding, ...]:
        """Return the findings about one address, deferred ones too."""
        return tuple(f for f in self.findings if address in f.addresses)

    def effective(self) -> dict[Address, Value]:
        """Return the effective values where they differ from the values of the file."""
        # The findings are in their order of weight: of two about one value the first counts.
        return {s.address: s.value for f in reversed(self.findings) for s in f.effective}

    def count(self, severity: str) -> int:
        """Return how many findings of a severity there are; values that are not set are a state of the file,
        not findings.
        """
        return sum(f.severity == severity and f.rule != NOT_SET for f in self.listed)

    def changes(self) -> int:
        """Return how many values differ from those on disk, as far as this program knows them."""
        return len(self.document.unsaved_addresses())

    def typed_unit(self, address: Address) -> str:
        """Return the unit of a number typed without one: the unit in which the value is shown."""
        value = self.file.get(address)
        if self.as_entered and value is not None and value.unit:
            return value.unit
        return self.file.evaluation.unit(address, self.file.header.units)

    def read(self, address: Address, text: str) -> Value | None:
        """Read what a person typed for an address, None for nothing; raises InvalidValueError."""
        return self.entered(address, text).value

    def remember_control(self, values: dict[Address, Value], when: str) -> None:
        """Store the values of the control, to be shown beside the values of the file."""
        self.control = (dict(values), when)
        self.changed.emit([])

    def forget_control(self) -> None:
        """Show no values of the control any more: what it contains is not known."""
        self.control = None
        self.changed.emit([])
