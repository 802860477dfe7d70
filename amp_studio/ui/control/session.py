"""What the window knows of one control: who answers, what it contains, what it lacks,
and the exchange that is under way.

Nothing waits here: each act runs in a thread, and ``changed`` is emitted when there is something new to show.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Mapping
from contextlib import closing
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from PySide6.QtCore import QObject, Signal

from amp_studio.files import ParameterFile, by_schema
from amp_studio.schema import Address, Value
from amp_studio.ui.base.task import Task, TaskProgress

if TYPE_CHECKING:
    from amp_studio.transfer import Abilities, ControlDriver, ControlIdentity, Exchange, TransferError
    from amp_studio.transfer.client import Copy, ImageComparison, Outcome

BackupReturn = Literal["whole", "its values"]
"""What a backup replaces: all that the control contains, or the values that are in it alone."""
SILENT = ("silent", "cut")
"""Stages in which an exchange waits: the one that was under way still is."""
WRITING = ("download", "commit", "restart", "verify")
"""Stages in which something has been written."""
SessionPhase = Literal["away", "connecting", "ready", "running", "done", "failed"]
"""Not connected; being read; read; something is sent; it was sent and read back; it did not reach its end."""


@dataclass(frozen=True)
class ReadControl:
    """What one reading found: who answered, what it can do,
    and its content in bytes and as a file where it can be read.
    """

    control: ControlIdentity
    abilities: Abilities
    takes_one: bool
    """Whether a single value goes into it while it is at work."""
    content: bytes
    file: ParameterFile | None
    why_unreadable: str
    when: datetime = field(default_factory=lambda: datetime.now(UTC).astimezone())


@dataclass(frozen=True, slots=True)
class SentChanges:
    """What an exchange puts into a control, in words, as it was when it began: a line for each value, and the
    names of those that the control keeps.
    """

    lines: tuple[str, ...] = ()
    kept: tuple[str, ...] = ()
    is_one: bool = False
    """Whether it is a value alone, which leaves the others as they were."""
    file: ParameterFile | None = None
    """All that the control was to contain, where it can be read."""


@dataclass(frozen=True, slots=True)
class AfterBreak:
    """What a control contains after an exchange that broke off: what differs from what was sent, with the
    value that the control has, where it has as little (``least``) and as much (``most``) of it as it may.
    """

    least: Mapping[Address, Value | None]
    most: Mapping[Address, Value | None]
    is_read: bool
    """Whether it was read since; else it is what the control has answered."""
    is_certain: bool
    """Whether what it has answered is what it contains."""


class ControlSession(QObject):
    """The exchanges of one file with one control, one at a time."""

    changed = Signal()
    progressed = Signal(str, int, int)
    ended = Signal(str, bool)
    """An act ("connect", "download", "restore") ended, and whether the control answered."""
    value_written = Signal(object)

    def __init__(self, address: str, family: str, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self.address, self.family = address, family
        self.phase: SessionPhase = "away"
        self.seen: ReadControl | None = None
        self.is_seen_old = False
        """Whether something was written since it was read."""
        self.in_estop: bool | None = None
        """As it was asked last; None where there is no such state."""
        self.asked_at: datetime | None = None
        self.error = ""
        self.failure: TransferError | None = None
        """Why the last download or restore did not reach its end."""
        self.outcome: Outcome | None = None
        self.sent = SentChanges()
        self.replaced = b""
        """What the control contained before the last exchange."""
        self.backup_name = ""
        """The backup that was put back last; empty where a file or a value was sent."""
        self.is_silent, self.answers = False, ""
        """Whether nothing has answered in the way of the family; and the protocol of what is there, where it
        is known.
        """
        self.must_wait = False
        """Whether a password was refused because others were wrong just before."""
        self.has_answered = self.is_refused = False
        """Whether it ever answered; and whether the last answer was that it moves and cannot be read."""
        self.needs_password = False
        self.has_password = False
        """Whether one was entered for it here."""
        self.notes: list[str] = []
        self.stage, self.percent = "", 0
        """What an exchange is doing, and how much of that is done."""
        self.prompt = ""
        """What the user is to do at the control now, for the exchange to go on."""
        self._task: Task | None = None
        self._compared: tuple[object, ImageComparison] | None = None
        """The last comparison, after all that it was made of."""
        self._after_break: tuple[object, AfterBreak | None] | None = None
        """What the last exchange has left, after what that was made of."""

    @property
    def is_busy(self) -> bool:
        """Whether an exchange is under way."""
        return self._task is not None

    @property
    def has_sent(self) -> bool:
        """Whether the last exchange came as far as writing."""
        return self.stage in WRITING or (self.failure is not None and bool(self.failure.kept))

    @property
    def lacks_password(self) -> bool:
        """Whether it is not reached because it asks for a password."""
        return self.needs_password and self.phase in ("away", "connecting")

    # -- reading -----------------------------------------------------------------

    def read(self) -> None:
        """Connect and read all that the control contains."""
        self.error, self.failure, self.outcome, self.is_refused = "", None, None, False
        self.is_silent, self.answers = False, ""
        self._begin("connecting", self._read_control, self._take_seen, self._not_reached)

    def go_on(self) -> None:
        """Be ready for the next exchange after one that was read back."""
        if self.phase == "done":
            self.phase, self.outcome = "ready", None
            self.ask()

    def ask(self) -> None:
        """Ask the control for its state again; nothing is read or changed."""
        if self.seen is not None and not self.is_busy:
            # In the phase it is in: a question every 2 s must not make the page flicker.
            self._begin(self.phase, self._identify, self._take_state, self._not_reached)

    def enter_password(self, password: str) -> None:
        """Try again with a password, which is known until the program ends."""
        from amp_studio.transfer.links import enter_password, parse_endpoint

        enter_password(parse_endpoint(self.address), password)
        self.has_password = bool(password)
        self.read()

    def _driver(self, exchange: Exchange) -> ControlDriver:
        from amp_studio.transfer.client import open_driver_at
        from amp_studio.transfer.links import ask_with

        def no_terminal(_: str) -> str:
            self.needs_password = True  # the page has a field for it
            return ""

        self.needs_password = False
        ask_with(no_terminal, forget=False)
        return open_driver_at(self.address, self.family, exchange)

    def _read_control(self, exchange: Exchange) -> ReadControl:
        from amp_studio.transfer import ControlSilentError, TakesLiveValues
        from amp_studio.transfer.client import look_at, who_answers

        with closing(self._driver(exchange)) as driver:
            try:
                control, content, _ = look_at(driver, exchange)
            except ControlSilentError:
                driver.close()  # a control has one client
                self.answers = who_answers(self.address, exchange)
                raise
            takes_one = isinstance(driver, TakesLiveValues)
            return ReadControl(control, driver.abilities, takes_one, content, *_decoded(content))

    def _identify(self, exchange: Exchange) -> ControlIdentity:
        with closing(self._driver(exchange)) as driver:
            return driver.identify(exchange)

    def _take_content(self, content: bytes) -> None:
        """Take it that the control contains what was read back."""
        file, why = _decoded(content)
        if self.seen is not None:
            self.seen = replace(
                self.seen, content=content, file=file, why_unreadable=why, when=datetime.now(UTC).astimezone()
            )
            self.is_seen_old = False

    def _take_seen(self, seen: ReadControl) -> None:
        self.seen, self.phase, self.is_seen_old = seen, "ready", False
        self._take_state(seen.control)
        self.ended.emit("connect", True)

    def note_loss(self, error: Exception) -> None:
        """Take it that the control is not reached any more: another line to it was lost. How an exchange
        failed stays.
        """
        if not self.is_busy and self.phase != "failed":
            self.error, self.phase, self.is_refused = str(error), "away", False
            self.changed.emit()

    def note_answer(self) -> None:
        """Take it that the control has answered on another line: it is there again where it was lost."""
        self.has_answered = True
        if self.is_busy or self.is_refused or self.phase != "away" or not self.error:
            return
        self.error = ""
        if self.seen is not None and not self.is_seen_old:
            self.phase = "ready"
        self.changed.emit()

    def _take_state(self, control: ControlIdentity) -> None:
        self.has_answered = True
        self.in_estop, self.asked_at = control.in_estop, datetime.now(UTC).astimezone()

    def _not_reached(self, error: Exception) -> None:
        from amp_studio.transfer import ControlSilentError, MovingError
        from amp_studio.transfer.links import PasswordError, TooManyWrongError

        self.error, self.phase = str(error), "away"
        self.is_refused = isinstance(error, MovingError)
        self.has_answered |= self.is_refused
        self.is_silent = isinstance(error, ControlSilentError)
        self.must_wait = isinstance(error.__cause__, TooManyWrongError)
        if isinstance(error.__cause__, PasswordError):
            self.needs_password = True  # a wrong one is asked for again
        self.ended.emit("connect", False)

    def present(self, file: ParameterFile) -> ParameterFile | None:
        """Return what the control contains in the schema of a file;
        None if it is not known or of another family.
        """
        present = self.seen.file if self.seen else None
        if present is None or present.schema.family.family != file.schema.family.family:
            return None
        return by_schema(present, file.schema)

    def comparison(self, file: ParameterFile) -> ImageComparison | None:
        """Return the file compared with what the control contains; None if that is not known."""
        from amp_studio.transfer.client import verify_content

        if self.seen is None or (self.is_seen_old and self.phase == "failed"):
            return None
        state = self.seen.content, _content_of(file)
        # A page asks for it at every change, and a comparison of a whole file lasts.
        if self._compared is None or self._compared[0] != state:
            self._compared = state, verify_content(file, self.seen.content)
        return self._compared[1]

    def after_break(self) -> AfterBreak | None:
        """Return what the control contains of the last exchange, where that broke off and left some of it."""
        failure, outcome = self.failure, self.outcome
        if self.phase != "failed" or (failure is not None and failure.at_control in ("", "old", "new")):
            return None
        source = failure or outcome
        if self._after_break is None or self._after_break[0] is not source:
            self._after_break = source, self._found_after_break()
        return self._after_break[1]

    def _found_after_break(self) -> AfterBreak | None:
        from amp_studio.transfer import Remains
        from amp_studio.transfer.client import verify_content

        failure, outcome, file = self.failure, self.outcome, self.sent.file
        remains = failure.remains if failure is not None else None
        if outcome is not None and outcome.content:
            remains = Remains(outcome.content, outcome.content, is_read=True)
        if remains is None or file is None:
            return None
        found = verify_content(file, remains.least), verify_content(file, remains.most)
        if any(each.unreadable for each in found):
            return None
        least, most = ({d.address: d.b for d in each.values.differences} for each in found)
        is_certain = remains.is_read or (failure is not None and failure.at_control == "mixed")
        return AfterBreak(least, most, remains.is_read, is_certain)

    # -- writing -----------------------------------------------------------------

    def send(self, file: ParameterFile, path: Path, sent: SentChanges) -> None:
        """Put a file into the control; only what was read before may be replaced,
        and it is kept beside ``path``.
        """
        seen = self.seen
        assert seen is not None

        def work(exchange: Exchange) -> Outcome:
            from amp_studio.transfer.client import download_file, sha256

            # A control that was changed since it was read is noticed: then nothing is replaced.
            expected = sha256(seen.content)
            return download_file(file, self.address, exchange, expected=expected, known=seen.content)

        self._write("download", work, path, replace(sent, file=file))

    def backup_return(self) -> BackupReturn | None:
        """Return what a backup would replace; None before the control was read."""
        if self.seen is None:
            return None
        return "whole" if self.seen.abilities.all_or_nothing else "its values"

    def restore(self, copy: Copy, path: Path, sent: SentChanges) -> None:
        """Put back what a control contained, byte for byte."""
        seen = self.seen
        assert seen is not None

        def work(exchange: Exchange) -> Outcome:
            from amp_studio.transfer.client import restore_copy, sha256

            return restore_copy(copy, self.address, exchange, expected=sha256(seen.content))

        self._write("restore", work, path, replace(sent, file=copy.file), backup_name=path.name)

    def write_one(self, address: Address, file: ParameterFile, path: Path, line: str = "") -> None:
        """Write one value of a file into the control now; it is read back and recorded."""

        def work(exchange: Exchange) -> Outcome:
            from amp_studio.transfer.client import LiveTuning

            with closing(LiveTuning(self._driver(exchange), path, address=self.address, record=path)) as live:
                live.look(exchange)
                return live.set({address: file.get(address)}, exchange)

        # Not as a download: the control does not contain the file now.
        sent = SentChanges((line,), is_one=True)
        self._write("verify", work, path, sent, then=lambda: self.value_written.emit(address))

    def _write(
        self,
        verb: str,
        work: Callable[[Exchange], Outcome],
        path: Path,
        sent: SentChanges,
        then: Callable[[], None] = lambda: None,
        backup_name: str = "",
    ) -> None:
        self.outcome, self.failure, self.error, self.notes = None, None, "", []
        self.backup_name, self.sent = backup_name, sent
        self.replaced = self.seen.content if self.seen is not None else b""
        self.is_seen_old = True

        def done(outcome: Outcome) -> None:
            self.outcome, self.phase = outcome, "failed"
            if outcome.verified:
                # The rest of the file is still to be sent after one value.
                self.phase = "ready" if sent.is_one else "done"
                self._take_content(outcome.content)
            self.ended.emit(verb, True)
            then()

        def failed(error: Exception) -> None:
            from amp_studio.transfer import ImageChangedError, TransferError

            self.failure = error if isinstance(error, TransferError) else None
            self.error, self.phase = str(error), "failed"
            is_untouched = self.failure is None or self.failure.at_control in ("old", "")
            self.is_seen_old = not is_untouched or isinstance(error, ImageChangedError)
            self.ended.emit(verb, False)

        self._begin("running", work, done, failed, path)

    def cancel(self) -> None:
        """Break off what is under way, at its next safe point."""
        if self._task is not None:
            self._task.cancelled.set()

    # -- the thread --------------------------------------------------------------

    def _begin(
        self,
        phase: SessionPhase,
        work: Callable[[Exchange], Any],
        done: Callable[[Any], None],
        failed: Callable[[Exception], None],
        path: Path | None = None,
    ) -> None:
        if self._task is not None:
            return
        self.phase, self.stage, self.percent, self.prompt = phase, "", 0, ""

        def run(progress: TaskProgress, cancel: threading.Event) -> Any:
            from amp_studio.transfer import Exchange

            return work(Exchange(progress, cancel, keep=path, record=path, notify=self.notes.append))

        task = self._task = Task(run)
        # Taken after the thread has ended: what a result sets off may begin the next exchange, for which
        # this one must be over.
        results: list[Callable[[], None]] = []
        task.done.connect(lambda result: results.append(lambda: done(result)))
        task.failed.connect(lambda error: results.append(lambda: failed(error)))
        task.progressed.connect(self._follow_stage)
        task.finished.connect(lambda: self._finish(results))
        task.begin()
        self.changed.emit()

    def _follow_stage(self, stage: str, done: int, total: int) -> None:
        if total < 0:  # a sentence for the user, and no stage
            self.prompt = stage
        elif stage not in SILENT:
            self.prompt = ""
            self.stage, self.percent = stage, 100 * done // total if total > 0 else 0
        self.progressed.emit(stage, done, total)

    def _finish(self, results: Iterable[Callable[[], None]]) -> None:
        self._task = None
        for take in results:
            take()
        self.changed.emit()


def _decoded(content: bytes) -> tuple[ParameterFile | None, str]:
    """Return what a control contains as a file, or why it cannot be read."""
    from amp_studio.transfer import ImageError, decode_content

    try:
        return decode_content(content) if content else None, ""
    except ImageError as error:
        return None, str(error)


def _content_of(file: ParameterFile) -> tuple[object, ...]:
    """Return all of a file that a comparison depends on, to be compared later. Values count as the same
    objects alone: 0.0 is equal to -0.0, and a control stores them otherwise.
    """
    values = dict(file.values)  # as long as they exist, no other object has their ids
    ids = tuple(map(id, values.values()))
    return file.schema, ids, values, dict(file.forced), dict(file.unknown), dict(vars(file.header))
