"""Grbl and grblHAL as one of the ways to speak to a control: settings go one line at a time, and are read back."""

from __future__ import annotations

import contextlib
import hashlib
import threading
import time
from collections.abc import Callable, Iterator
from typing import ClassVar

from amp_studio.transfer.driver import Abilities, ControlIdentity, NeverRestarts, Receipt
from amp_studio.transfer.errors import (
    CancelledError,
    ConnectionCutError,
    ImageChangedError,
    NoConnectionError,
    ProtocolMismatchError,
    TransferError,
    WrongFamilyError,
    unforeseen,
)
from amp_studio.transfer.links.endpoint import Endpoint
from amp_studio.transfer.links.link import LinkError
from amp_studio.transfer.links.opening import connect
from amp_studio.transfer.progress import Progress, quiet
from amp_studio.transfer.waiting import OpenLink

from .aftermath import after_break, answered_state
from .content import GrblContent, read_content, write_content
from .kind import FAMILY, GrblContentKind, described
from .line import GrblLine, GrblRefusalError, GrblRestartedError
from .reading import read_control, read_identity
from .refusals import refusal_text
from .states import LASTING, state_text
from .writing import Writing

PROTOCOL = "grbl"
SETTLE = 0.3  # seconds between the last answer and the reading back: the memory is written after the answer, and surely
# before the next command is executed (protocol.c ``protocol_execute_realtime``)
RECONNECT = 10.0  # seconds in which a cut line is tried again to read what the control contains
PAUSE = 0.15  # seconds between two tries


class GrblDriver(GrblContentKind, NeverRestarts):
    """Speaks to a control over its text line (docs/protocols/grblhal.md).

    It never makes a control restart: some builds do not take a setting afterwards.
    """

    # In check mode settings are answered "ok" and kept in RAM only (protocol.c ``protocol_execute_realtime``).
    abilities = Abilities(can_send=True, all_or_nothing=False, maps_numbers=True, lasting_states=LASTING)
    takes_live_values: ClassVar[bool] = True

    def __init__(
        self,
        open_link: OpenLink,
        *,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._open_link, self._clock, self._sleep = open_link, clock, sleep
        self._line: GrblLine | None = None
        self._has_lost_memory = False  # on any line of this driver
        self._last: GrblContent | None = None

    @classmethod
    def at(cls, endpoint: Endpoint, family: str = "") -> GrblDriver:
        """Return the driver of an endpoint; ``family`` is the one the control must be of, "" for any."""
        if family not in {"", FAMILY}:
            raise WrongFamilyError(
                f"the protocol {PROTOCOL} is that of the family {FAMILY}, not of {family}", ""
            )
        return cls(lambda look: connect(endpoint, look=look))

    def identify(self, progress: Progress = quiet, cancel: threading.Event | None = None) -> ControlIdentity:
        """Return what ``$I`` answers."""
        with self._conversation(progress, cancel) as line:
            who = read_identity(line)
            name = who.said("FIRMWARE") or "Grbl"
            board = who.said("BOARD") or who.said("DRIVER")
            return ControlIdentity(
                FAMILY,
                PROTOCOL,
                f"{name} on {board}" if board else name,
                who.version,
                axes=who.axes,
            )

    def fetch(
        self, progress: Progress = quiet, cancel: threading.Event | None = None, stage: str = "upload"
    ) -> bytes:
        """Return all that the control contains, as it shows it."""
        end = self._clock() + RECONNECT
        while True:
            try:
                with self._conversation(progress, cancel) as line:
                    if stage == "verify":
                        line.rest(SETTLE)
                    return write_content(self._read(line, progress, stage))
            except (ConnectionCutError, NoConnectionError):
                if stage != "verify" or self._clock() >= end:
                    raise
                self._sleep(PAUSE)

    def send(
        self,
        content: bytes,
        *,
        signature: str,  # noqa: ARG002 -- settings go by their numbers
        expected: bytes,
        held: bytes,
        progress: Progress = quiet,
        cancel: threading.Event | None = None,
    ) -> Receipt:
        """Send what differs, one line at a time, until the control shows it; offsets and harmless start-up lines too."""
        wanted, present = read_content(content), read_content(held)
        writing = Writing(wanted, present, described(held))
        try:
            with self._conversation(progress, cancel) as line:
                self._check_rest(line, writing)
                found = self._read(line)
                if hashlib.sha256(write_content(found)).digest() != expected:
                    raise ImageChangedError("somebody has changed the settings since they were read")
                line.messages, line.has_lost_memory, self._has_lost_memory = [], False, False
                writing.run(line, progress)
                self._check_memory(line)
        except GrblRefusalError as refusal:
            why = refusal_text(refusal, writing.names, present)
            raise self._told(TransferError(why), writing, progress, cancel, is_answered=True) from None
        except CancelledError as error:
            error.at_control, error.new = answered_state(writing)
            error.confirmed = writing.confirmed if writing.has_begun else None
            raise
        except ImageChangedError:
            raise
        except TransferError as error:
            if not writing.has_begun:
                raise
            raise self._told(error, writing, progress, cancel) from None
        except Exception as error:  # no memory, no handle: something may have been written anyway
            if not writing.has_begun:
                raise
            broken = TransferError(f"the download broke off ({unforeseen(error)})")
            raise self._told(broken, writing, progress, cancel) from error
        return writing.receipt()

    def close(self) -> None:
        """Hang up."""
        if self._line is not None:
            self._has_lost_memory |= self._line.has_lost_memory
            self._line.close()
            self._line = None

    # -- inside --------------------------------------------------------------------------------------

    @contextlib.contextmanager
    def _conversation(self, progress: Progress, cancel: threading.Event | None) -> Iterator[GrblLine]:
        """Give the line there is, or a new one; a line that broke is hung up, and its errors are those of a transfer."""
        try:
            if self._line is None:
                self._line = GrblLine(
                    self._open_link, progress=progress, cancel=cancel, clock=self._clock, sleep=self._sleep
                )
            self._line.serve(progress, cancel)
            yield self._line
        except (LinkError, GrblRestartedError) as error:
            self.close()
            raise ConnectionCutError(f"the line to the control broke ({error})") from None
        except TransferError:
            self.close()
            raise

    def _read(self, line: GrblLine, progress: Progress = quiet, stage: str = "upload") -> GrblContent:
        """Return what the control contains; how it describes itself is asked once, and again when it has other settings."""
        try:
            content = read_control(line, self._last, progress, stage)
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
                "the control is locked, and takes no offsets and start-up lines: unlock it ($X) or home it ($H) first"
            )

    def _check_memory(self, line: GrblLine) -> None:
        """Notice that the control could not write its memory, of which there is only a message."""
        failed = next((text for text in line.messages if "write failed" in text.casefold()), None)
        if failed:
            raise TransferError(f"the control cannot write its memory ({failed})", "unknown")

    def _told(
        self,
        error: TransferError,
        writing: Writing,
        progress: Progress,
        cancel: threading.Event | None,
        *,
        is_answered: bool = False,
    ) -> TransferError:
        """Read everything again after a break, while the control may answer, and return the error with what is true now."""
        end = self._clock() + RECONNECT
        found: GrblContent | None = None
        while (
            writing.has_begun and found is None and self._clock() < end and not (cancel and cancel.is_set())
        ):
            with contextlib.suppress(TransferError), self._conversation(progress, cancel) as line:
                line.rest(SETTLE)
                found = self._read(line)
            if found is None:
                self._sleep(PAUSE)
        lost = self._has_lost_memory or (self._line is not None and self._line.has_lost_memory)
        told = after_break(error, writing, found, has_lost_memory=lost, is_answered=is_answered)
        told.confirmed = writing.confirmed
        return told
