"""Grbl and grblHAL as one of the ways to speak to a control: settings go one line at a time,
and are read back.
"""

from __future__ import annotations

import contextlib
from collections.abc import Collection, Iterator
from dataclasses import replace
from typing import ClassVar

from amp_studio.transfer import (
    Abilities,
    ConnectionCutError,
    ControlIdentity,
    ControlStatus,
    ImageChangedError,
    LineDriver,
    NoConnectionError,
    OpenLink,
    ProtocolMismatchError,
    Receipt,
    Remains,
    Replacement,
    SentValues,
    TransferError,
    Waiting,
    quiet,
)
from amp_studio.transfer.links import LinkError

from .aftermath import after_break, names_of
from .content import GrblContent, read_content, write_content
from .kind import FAMILY, GrblContentKind, described
from .line import GrblLine, GrblRefusalError, GrblRestartedError
from .reading import read_control, read_identity
from .refusals import refusal_text
from .states import LASTING, state_in, state_text
from .status import status_of
from .writing import Writing

# seconds between the last answer and the reading back: the memory is written after the answer, and surely
SETTLE = 0.3
# before the next command is executed (protocol.c ``protocol_execute_realtime``)
RECONNECT = 10.0  # seconds in which a cut line is tried again to read what the control contains
AT_REST = ("Idle", "Alarm")
"""States in which ``$I`` is answered at once."""
PAUSE = 0.15  # seconds between two tries


class GrblDriver(GrblContentKind, LineDriver):
    """Speaks to a control over its text line (docs/protocols/grblhal.md).

    It never makes a control restart: some builds do not take a setting afterwards.
    """

    family, protocol = FAMILY, "grbl"
    # In check mode settings are answered "ok" and kept in RAM only (protocol.c
    # ``protocol_execute_realtime``).
    abilities = Abilities(all_or_nothing=False, maps_numbers=True, lasting_states=LASTING)
    takes_live_values: ClassVar[bool] = True

    def __init__(self, open_link: OpenLink, waiting: Waiting | None = None) -> None:
        super().__init__(open_link, waiting)
        self._line: GrblLine | None = None
        self._has_lost_memory = False  # on any line of this driver
        self._last: GrblContent | None = None
        self._writing: Writing | None = None
        self._known: ControlIdentity | None = None

    def close(self) -> None:
        """Close the line."""
        if self._line is not None:
            self._has_lost_memory |= self._line.has_lost_memory
            self._line.close()
            self._line = None

    # -- what the driver is made of ----------------------------------------------------------------

    def _identity(self) -> ControlIdentity:
        """Return what ``$I`` answers."""
        with self._opened_line() as line:
            who = read_identity(line)
            name = who.identity_word("FIRMWARE") or "Grbl"
            board = who.identity_word("BOARD") or who.identity_word("DRIVER")
            return ControlIdentity(
                FAMILY, self.protocol, f"{name} on {board}" if board else name, who.version, axes=who.axes
            )

    def status(self) -> ControlStatus:
        """Return what ``?`` answers, and ``$I`` once while nothing moves; nothing is written."""
        with self._opened_line() as line:
            report = line.report()
            alarm = f"ALARM:{line.alarm}" if line.alarm else ""
        # While it moves, `$I` would wait behind the moves: the state alone is asked for then.
        if self._known is None and state_in(report) in AT_REST:
            self._known = self._identity()
        return status_of(self._known or ControlIdentity(FAMILY, self.protocol, "Grbl"), report, alarm)

    def _fetched(self, stage: str) -> bytes:
        """Return all that the control contains, as it shows it;
        after a download the line is made again where it is cut.
        """
        end = self._waiting.now() + RECONNECT
        while True:
            try:
                with self._opened_line() as line:
                    if stage == "verify":
                        line.wait(SETTLE)
                    return write_content(self._read(line, stage))
            except (ConnectionCutError, NoConnectionError):
                # Before a download a broken line is reported; after one it is worth the patience to
                # learn what the control contains.
                if stage != "verify" or self._waiting.now() >= end:
                    raise
                # The line that broke is closed (`_opened_line`): the next turn makes another one.
                self._waiting.sleep(PAUSE)

    def _names(self, content: bytes) -> dict[str, str]:
        return names_of(read_content(content))

    def _send(self, replacement: Replacement, sent: SentValues) -> Receipt:
        """Send what differs, one line at a time, until the control shows it;
        offsets and harmless start-up lines too.
        """
        wanted, present = read_content(replacement.content), read_content(replacement.current)
        writing = self._writing = Writing(wanted, present, described(replacement.current), sent)
        try:
            with self._opened_line() as line:
                self._check_rest(line, writing)
                # The plan was made from an earlier reading: what was changed since at the
                # machine is not overwritten.
                if write_content(self._read(line)) != replacement.current:
                    raise ImageChangedError("somebody has changed the settings since they were read")
                # What was reported earlier belongs to earlier commands: from here on a message is about
                # this download.
                line.messages, line.has_lost_memory, self._has_lost_memory = [], False, False
                writing.run(line, self._waiting.notify)
                self._check_memory(line)
        except GrblRefusalError as refusal:
            error = TransferError(refusal_text(refusal, writing.names, present))
            self._find_out(error, replacement, is_answered=True)
            raise error from None
        return writing.receipt()

    def _with_new(self, replacement: Replacement, names: Collection[str]) -> bytes:
        present, wanted = read_content(replacement.current), read_content(replacement.content)
        settings = {n: text for n, text in wanted.settings.items() if f"${n}" in names}
        offsets = {name: text for name, text in wanted.offsets.items() if name in names}
        startup = {n: text for n, text in wanted.startup.items() if f"$N{n}" in names}
        new = replace(
            present,
            settings={**present.settings, **settings},
            offsets={**present.offsets, **offsets},
            startup={**present.startup, **startup},
        )
        return write_content(new)

    def _after_break(self, error: TransferError, sent: SentValues, replacement: Replacement) -> None:  # noqa: ARG002  # Writing has it
        self._find_out(error, replacement)

    # -- inside --------------------------------------------------------------------------------------

    @contextlib.contextmanager
    def _opened_line(self) -> Iterator[GrblLine]:
        """Give the line there is, or a new one; a line that broke is closed,
        and its errors are those of a transfer.
        """
        try:
            if self._line is None:
                self._line = GrblLine(self._open_link, self._waiting)
            yield self._line
        except (LinkError, GrblRestartedError) as error:
            self.close()
            raise ConnectionCutError(f"the line to the control broke ({error})") from None
        except TransferError:
            self.close()
            raise

    def _read(self, line: GrblLine, stage: str = "") -> GrblContent:
        """Return what the control contains; how it describes itself is asked once,
        and again when it has other settings.

        Steps are shown where a ``stage`` is named.
        """
        try:
            content = read_control(line, self._last, self._waiting.notify if stage else quiet, stage)
        except GrblRefusalError as refusal:
            raise ProtocolMismatchError(
                f"the control does not show its settings: {refusal_text(refusal, {}, None)}"
            ) from None
        self._last = content
        return content

    def _check_rest(self, line: GrblLine, writing: Writing) -> None:
        """Refuse what the state of the control does not allow, before anything is sent."""
        state = line.state()
        self.abilities.check_lasts(state, state_text(state))
        if state != "Idle" and writing.others:
            raise TransferError(
                "the control is locked, and takes no offsets and start-up lines: unlock it ($X) or home it"
                " ($H) first"
            )

    def _check_memory(self, line: GrblLine) -> None:
        """Notice that the control could not write its memory, of which there is only a message."""
        failed = next((text for text in line.messages if "write failed" in text.casefold()), None)
        if failed:
            raise TransferError(f"the control cannot write its memory ({failed})", "unknown")

    def _find_out(self, error: TransferError, replacement: Replacement, *, is_answered: bool = False) -> None:
        """Read everything again after a break, while the control may answer,
        and write into the error what is true now.
        """
        writing, end = self._writing, self._waiting.now() + RECONNECT
        assert writing is not None
        found: GrblContent | None = None
        # Nothing was sent: the control still contains what was read before.
        has_begun = writing.sent.has_begun
        while has_begun and found is None and self._waiting.now() < end and not self._waiting.is_stopped:
            with contextlib.suppress(TransferError), self._opened_line() as line:
                line.wait(SETTLE)
                found = self._read(line)
            if found is None:
                self._waiting.sleep(PAUSE)
        lost = self._has_lost_memory or (self._line is not None and self._line.has_lost_memory)
        error.remains = self._by_answers(writing.sent, replacement)
        # What it shows is not what its memory contains where that could not be written.
        if found is not None and error.at_control != "unknown":
            error.remains = Remains(content := write_content(found), content, is_read=True)
        after_break(error, writing, found, has_lost_memory=lost, is_answered=is_answered)
        error.confirmed = writing.sent.confirmed
