"""The line to one control, made again whenever it is cut, until patience ends."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable
from typing import TypeVar

from amp_studio.transfer.errors import (
    CancelledError,
    ConnectionCutError,
    ControlBusyError,
    ControlSilentError,
    ProtocolMismatchError,
    TransferError,
    WrongFamilyError,
)
from amp_studio.transfer.links import LinkError
from amp_studio.transfer.progress import CUT, SILENT, Progress, Stop, quiet
from amp_studio.transfer.waiting import OpenLink

from .frame import encode_frame
from .message import MAX_CHUNK, PROTOCOL_VERSION, Code, Hello, RefusalError, Welcome, pack
from .retry_timer import RetryPolicy
from .streaming import window_limit
from .transaction import NoAnswerError, Transaction

_T = TypeVar("_T")

PAUSE = 0.2  # seconds before a cut line is tried again; each pause is half as long again as the last,
LONGEST_PAUSE = 2.0  # up to this
_SLICE = 0.1  # seconds a pause may last before the cancel event is read again
SILENT_AFTER = 1.8  # seconds without an answer until the waiting caller is notified
_SILENT_EVERY = 1.0  # seconds until he is notified again
STOP_GRACE = 5.0  # seconds a commit is seen through after a stop was asked for

ACTS_ON_GRBL = frozenset((0x03, 0x14, 0x18, 0x19, *b"!%~", *range(0x80, 0x100)))
"""Bytes that a Grbl or grblHAL obeys wherever they come, a reset and a cycle start among them (its grbl.h,
``CMD_…``)."""
_DRAWS = 500
"""Tries for a frame without them: 4.4 % of 20,000 had none, as the check sum falls."""

# Patience starts again only with a step of so many bytes (fewer of a small image, on a slow line, or at the
# end): a control cannot keep a client for ever by giving it a byte every few seconds.
STEP = 1_024
STEPS = 64


class OutOfTimeError(NoAnswerError):
    """Patience has ended, or a stop was asked for."""


class Connection:
    """Conversations with one control, one after the other; ``welcome`` is what it answered last about itself.

    ``open_link`` gets a function to call at least every 0.1 s while it waits. ``cancel`` may be set from
    another thread: then whatever waits here raises CancelledError; while ``is_committing`` it waits a little
    longer for the answer. ``progress`` is called for silences too, and nothing it raises matters.
    """

    def __init__(
        self,
        open_link: OpenLink,
        *,
        family: str,
        client: str,
        patience: float,
        policy: RetryPolicy,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        random_bytes: Callable[[int], bytes],
    ) -> None:
        self.cancel: threading.Event | None = None
        self.progress: Progress = quiet
        self.is_committing = False
        self.welcome: Welcome | None = None
        self.reconnections = 0
        self.now = clock
        self.random = random_bytes
        self._open_link = open_link
        self._family = family
        self._client = client
        self._patience = patience
        self._policy = policy
        self._sleep = sleep
        self._transaction: Transaction | None = None
        self._until: float | None = None  # when patience ends
        self._reached = 0  # bytes of the image under way when patience last began again
        self._best = 0  # the most bytes of it that were ever there
        self._moved_at = self._notified_at = clock()
        self._stopped_at: float | None = None
        self._is_cut = False  # and that was notified

    @property
    def rate(self) -> float | None:
        """Bytes a second of the present line; None where it is not known."""
        return None if self._transaction is None else self._transaction.link.bytes_per_second

    def close(self) -> None:
        """Close the line."""
        if self._transaction is not None:
            self._transaction.link.close()
            self._transaction = None

    def _open_transaction(self) -> Transaction:
        """Return the transactions of the line there is, or of a new one."""
        if self._transaction is None:
            first = int.from_bytes(_letters(self.random(2)), "little")
            link = self._open_link(self._poll)
            try:
                self._transaction = Transaction(link, self.now, self._policy, first=first, look=self._poll)
            except BaseException:
                link.close()
                raise
        return self._transaction

    def greet(self, tries: int = 3) -> Welcome:
        """Send Hello on the line there is, or on a new one.

        Raises LinkError, NoAnswerError, RefusalError; WrongFamilyError and ProtocolMismatchError,
        after which the line is closed.
        """
        transaction = self._open_transaction()
        hello = self._hello(transaction.next_number)
        welcome = transaction.request(hello, Welcome, tries=tries)
        # The answer to an earlier Hello, still on its way, is not taken for the one to this.
        if welcome.nonce != hello.nonce:
            raise NoAnswerError
        if welcome.version != PROTOCOL_VERSION or not 1 <= welcome.chunk <= MAX_CHUNK or welcome.window < 1:
            self.close()
            raise ProtocolMismatchError(
                "the control answers in a way that version 1 of the protocol does not know"
            )
        # Behind a switch or a gateway another control may answer after a break: half of an image must
        # not go there.
        if self.welcome is not None and _identity(welcome) != _identity(self.welcome):
            self.close()
            raise ProtocolMismatchError(f"another control answers on this line than before: '{welcome.name}'")
        if self._family and welcome.family != self._family:
            self.close()
            raise WrongFamilyError(f"the control is of the family {welcome.family}, not {self._family}")
        self.welcome = welcome
        return welcome

    def _hello(self, number: int) -> Hello:
        """Return a Hello whose frame acts on no Grbl: who is there is not known yet, and an axis may move."""
        for _ in range(_DRAWS):
            hello = Hello(PROTOCOL_VERSION, _letters(self.random(4)), self._client)
            if not ACTS_ON_GRBL.intersection(encode_frame(pack(hello, number))):
                break
        return hello

    def persist(self, action: Callable[[Transaction], _T]) -> _T:
        """Run ``action`` to its end, on as many lines as it takes, until patience ends.

        Raises RefusalError, ConnectionCutError, ControlSilentError, ControlBusyError, CancelledError.
        """
        self.begin()
        pause = PAUSE
        cause: Exception = NoAnswerError()
        while True:
            try:
                if self._transaction is None:
                    self.greet()
                    self.reconnections += 1
                assert self._transaction is not None
                return action(self._transaction)
            except OutOfTimeError:
                self.close()
                raise self._timeout_error(cause) from cause
            except (LinkError, NoAnswerError) as error:
                cause = error
                if isinstance(error, LinkError):
                    self._notify_cut()
            except RefusalError as refusal:
                # A line that was cut may still count as a client at the control: busy passes, every
                # other refusal stays.
                if refusal.code != Code.BUSY:
                    raise
                cause = refusal
            self.close()
            try:
                self.pause(pause)
            except OutOfTimeError:
                raise self._timeout_error(cause) from cause
            # Soon at first, for a loose plug; then rarely, for a control that restarts.
            pause = min(pause * 1.5, LONGEST_PAUSE)

    def once(self, action: Callable[[Transaction], object], seconds: float) -> None:
        """Run ``action`` if there is a line, whether or not it succeeds, for so long, and hang up."""
        self.begin(seconds)
        if self._transaction is not None:
            with contextlib.suppress(LinkError, NoAnswerError, RefusalError):
                action(self._transaction)
        self.close()

    # -- patience ----------------------------------------------------------------------------------

    def begin(self, seconds: float | None = None) -> None:
        """Let patience begin, for ``seconds`` or as long as it is on this line."""
        self.further()
        self._until = self.now() + (self._patience if seconds is None else seconds)
        self._reached = self._best = 0

    def further(self) -> None:
        """Something that was waited for is there: nothing is silent."""
        was_silent = self._is_cut or self._notified_at > self._moved_at
        self._is_cut = False
        self._moved_at = self._notified_at = self.now()
        if was_silent:
            self.notify(SILENT, 0, round(self._patience))

    def moved(self, done: int, total: int) -> None:
        """``done`` of ``total`` bytes are there: after a step of some size patience starts again."""
        if self.is_committing:
            return  # everything is there; only the answer to the commit counts
        if done > self._best:
            self._best = done
            self.further()
        rate = self._transaction.link.bytes_per_second if self._transaction is not None else None
        # Of a small image and on a slow line a step is less, or patience would end while all goes well.
        step = min(STEP, total // STEPS, total if rate is None else int(rate * self._patience / 10))
        if done >= min(total, self._reached + max(1, step)) and done > self._reached:
            self._reached = done
            self._until = self.now() + self._patience

    def _notify_cut(self) -> None:
        """Notify at once that the line has broken; of further breaks only after something has come again."""
        # A line that breaks again and again would else be reported at each try.
        if not self._is_cut:
            self._is_cut = True
            self.notify(CUT, 0, round(self._patience))

    def notify(self, stage: str, done: int, total: int) -> None:
        """Notify the waiting caller; an error in that ends no exchange."""
        with contextlib.suppress(Exception):
            self.progress(stage, done, total)

    def sizes(self, transaction: Transaction) -> tuple[int, int]:
        """Return the length of a chunk in bytes and how many may be under way."""
        assert self.welcome is not None
        chunk = self.welcome.chunk
        return chunk, window_limit(chunk, self.welcome.window, transaction.link.bytes_per_second)

    def pause(self, seconds: float) -> None:
        """Wait; raises CancelledError, OutOfTimeError."""
        end = self.now() + seconds
        while (left := end - self.now()) > 0:
            self._poll()
            self._sleep(min(left, _SLICE))

    def _poll(self) -> None:
        """Be called by everything that waits, at least every 0.1 s."""
        now = self.now()
        if self.cancel is not None and self.cancel.is_set():
            self._stop(self.cancel, now)
        if self._until is not None and now >= self._until:
            raise OutOfTimeError
        silent = now - self._moved_at
        if silent >= SILENT_AFTER and now - self._notified_at >= _SILENT_EVERY:
            self._notified_at = now
            left = 0.0 if self._until is None else self._until - now
            self.notify(SILENT, round(silent), round(silent + left))

    def _stop(self, cancel: threading.Event, now: float) -> None:
        if not self.is_committing:
            raise CancelledError("stopped")
        if self._stopped_at is None:
            self._stopped_at = now
        if now - self._stopped_at >= STOP_GRACE or (isinstance(cancel, Stop) and cancel.is_urgent):
            raise OutOfTimeError

    def _timeout_error(self, cause: Exception) -> TransferError:
        waited = f"for {self._patience:g} s"
        if self.cancel is not None and self.cancel.is_set():
            return CancelledError("stopped before the control has answered")
        if isinstance(cause, LinkError):
            return ConnectionCutError(
                f"the line to the control is cut and could not be made again {waited} ({cause})"
            )
        if isinstance(cause, RefusalError):
            return ControlBusyError(f"another client has had the control {waited}")
        return ControlSilentError(f"the control has not answered {waited}")


def _identity(welcome: Welcome) -> tuple[str, str, str]:
    return welcome.family, welcome.signature, welcome.name


def _letters(drawn: bytes) -> bytes:
    """Return random bytes as letters and figures, which act on no control."""
    return bytes(0x30 + byte % 0x40 for byte in drawn)
