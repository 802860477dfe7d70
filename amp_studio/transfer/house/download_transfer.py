"""One download from the client's side: stage, commit, and know at every moment what the control contains."""

from __future__ import annotations

import hashlib
import threading
from dataclasses import dataclass

from amp_studio.transfer.errors import (
    AtControl,
    CancelledError,
    ConnectionCutError,
    ControlSilentError,
    ImageChangedError,
    ProtocolMismatchError,
    TransferError,
    unforeseen,
)
from amp_studio.transfer.exchange import Replacement

from .broken_transfers import BrokenTransfers
from .connection import STEPS, Connection
from .message import Abort, Aborted, Code, Commit, Committed, OpenDownload, Ready, RefusalError
from .refusals import error_of
from .streaming import push
from .transaction import Transaction

_ATTEMPTS = 3  # how often in a row a control may lose or spoil what is staged
COMMIT_WAIT = 2.0  # seconds a control may at least take to write an image to its memory
COMMIT_TRIES = 2  # then the line may be the fault: the commit is asked for again on another
ABORT_WAIT = 0.5  # seconds


@dataclass(frozen=True)
class Sent:
    """An image that a control has committed.

    ``committed`` is what it answered, ``reconnections`` how often the line was made again, ``resumed_at`` the
    byte up to which an earlier run of the program had sent it.
    """

    committed: Committed
    reconnections: int
    resumed_at: int = 0


class DownloadTransfer:
    """Sends one image under one transfer id; ``at_control`` is what the control contains as far
    as can be known.
    """

    def __init__(self, line: Connection, replacement: Replacement, broken: BrokenTransfers) -> None:
        self._line = line
        self._image = replacement.content
        self._signature = replacement.signature
        self._expected = replacement.current_digest
        self._digest = hashlib.sha256(self._image).digest()
        control = line.welcome.name if line.welcome is not None else ""
        self._broken = broken
        # Only the same image for the same control, over the same content, may go on where an earlier
        # run stopped.
        self._what = b"\n".join((self._digest, self._expected, self._signature.encode(), control.encode()))
        begun = broken.find(self._what)
        self._transfer = begun or line.random(16)
        self._is_resumed = begun is not None
        self._resumed_at = 0
        self._reached = 0
        self._lost = 0  # how often the control had less than it had answered before
        self.at_control: AtControl = "old"

    def run(self, cancel: threading.Event | None) -> Sent:
        """Return what the control answered to the commit; raises TransferError."""
        self._line.cancel = cancel
        self._line.is_committing = False
        self._line.reconnections = 0
        try:
            self._broken.keep(self._what, self._transfer)
            return Sent(self._stage_and_commit(), self._line.reconnections, self._resumed_at)
        except TransferError as error:
            error.at_control = self.at_control
            # What is staged stays for the next run where the control cannot be asked to throw it away.
            if isinstance(error, ConnectionCutError | ControlSilentError) and self.at_control == "old":
                error.what += self._what_to_do()
            else:
                self._abort()
            raise
        except KeyboardInterrupt:
            self._abort()
            raise CancelledError("stopped", self.at_control) from None
        except Exception as error:  # no memory, no handle: what the control contains is to be reported anyway
            self._abort()
            raise TransferError(f"the exchange broke off ({unforeseen(error)})", self.at_control) from error
        finally:
            self._line.cancel = None
            self._line.is_committing = False

    def _stage_and_commit(self) -> Committed:
        idle = corrupted = 0
        while True:
            before = self._reached
            try:
                return self._line.persist(self._attempt)
            except RefusalError as refusal:
                # Staged bytes that are lost or corrupted are sent again under the same id. On a serial line a
                # control may also have started again without the client's noticing; then it answers how much
                # it has.
                if refusal.code == Code.DIGEST:
                    corrupted, self._reached = corrupted + 1, 0
                elif refusal.code in (Code.UNKNOWN_TRANSFER, Code.INCOMPLETE):
                    # A control that loses its staging but gets further each time is slow, not hopeless.
                    further = self._reached - before > len(self._image) // STEPS
                    idle = 0 if further else idle + 1
                else:
                    raise self._error(refusal) from None
                if max(idle, corrupted) >= _ATTEMPTS:
                    raise self._error(refusal) from None
                self._nothing_replaced()

    def _attempt(self, transaction: Transaction) -> Committed:
        """Continue the download where the control asks, and commit it."""
        total = len(self._image)
        opening = OpenDownload(self._transfer, total, self._digest, self._expected, self._signature)
        ready = transaction.request(opening, Ready)
        if ready.offset > total:
            raise ProtocolMismatchError(
                f"the control has staged {ready.offset} bytes of {total}, which cannot be"
            )
        if ready.offset < total:
            # A commit asked for on an earlier line has not happened: what it needs is no longer staged.
            self._nothing_replaced()
        if ready.offset < self._reached:
            self._lose(ready.offset)

        def done(staged: int) -> None:
            self._reached = max(self._reached, staged)
            self._line.moved(staged, total)
            self._line.notify("download", staged, total)

        if self._is_resumed:
            self._is_resumed, self._resumed_at = False, ready.offset
        done(ready.offset)
        push(transaction, self._image, ready.offset, *self._line.sizes(transaction), done)
        return self._commit(transaction)

    def _commit(self, transaction: Transaction) -> Committed:
        """Have the control replace its image by what it has staged; ``at_control`` is unknown until it
        answers.
        """
        cancel = self._line.cancel
        if self.at_control == "old":
            # The last moment at which a stop costs nothing.
            if cancel is not None and cancel.is_set():
                raise CancelledError("stopped")
            self._line.begin()  # the time for the commit counts from its first asking, over all lines
        self._broken.forget(self._what)
        self._line.notify("commit", 0, 1)
        self._line.is_committing = True  # from here on the matter is seen through
        # Until the answer is here it is unknown whether the control has replaced its image.
        self.at_control = "unknown"
        committed = transaction.request(
            Commit(self._transfer, self._digest), Committed, at_least=COMMIT_WAIT, tries=COMMIT_TRIES
        )
        self.at_control = "new"
        self._line.further()
        self._line.notify("commit", 1, 1)
        return committed

    def _nothing_replaced(self) -> None:
        """No commit has happened, and nothing needs to be seen through."""
        self.at_control = "old"
        self._line.is_committing = False

    def _lose(self, offset: int) -> None:
        """The control has lost some of what was staged: send it again, but not for ever."""
        self._lost += 1
        if self._lost > _ATTEMPTS:
            raise ProtocolMismatchError("the control loses again and again what was sent to it")
        self._reached = offset
        self._line.begin()

    def _error(self, refusal: RefusalError) -> TransferError:
        """Return the error of a refusal, which changes nothing: a commit that has happened is not refused.

        Only where the image is another one after a commit was asked for, ours may have come and gone.
        """
        error = error_of(refusal)
        welcome = self._line.welcome
        if isinstance(error, ImageChangedError) and self.at_control == "unknown":
            error.at_control = "new" if welcome is not None and welcome.sha256 == self._digest else "unknown"
        self.at_control = error.at_control
        return error

    def _what_to_do(self) -> str:
        """Return how the staged bytes are made use of; there was no way to make the control discard them."""
        if not self._reached or self._broken.find(self._what) is None:
            return ""
        return f" (the same download goes on from byte {self._reached} of {len(self._image)})"

    def _abort(self) -> None:
        """Have the control throw the staged bytes away; one that does not hear it keeps them for nothing."""
        self._line.cancel = None
        self._broken.forget(self._what)
        if self.at_control == "old":
            self._line.once(
                lambda transaction: transaction.request(
                    Abort(self._transfer), Aborted, at_least=ABORT_WAIT, tries=1
                ),
                ABORT_WAIT,
            )
