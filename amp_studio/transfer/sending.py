"""One download from the client's side: stage, commit, and know at every moment what the control holds."""

from __future__ import annotations

import hashlib
import threading
from dataclasses import dataclass

from .conversation import Conversation
from .errors import Cancelled, Held, ImageChanged, TransferError, error_of
from .line import Line
from .message import Abort, Aborted, Code, Commit, Committed, OpenDownload, Ready, Refusal
from .progress import Progress
from .streaming import push

ATTEMPTS = 3  # how often in a row a control may lose or spoil what is staged
COMMIT_WAIT = 2.0  # seconds a control may at least take to write an image to its memory
ABORT_WAIT = 0.5  # seconds


@dataclass(frozen=True)
class Sent:
    """An image that a control has committed: what it answered, and how often the line was made again."""

    committed: Committed
    reconnections: int


class Sending:
    """Sends one image under one transfer id; ``held`` is what the control holds as far as can be known."""

    def __init__(self, line: Line, image: bytes, signature: str, expected: bytes, progress: Progress) -> None:
        self._line = line
        self._image = image
        self._signature = signature
        self._expected = expected
        self._progress = progress
        self._digest = hashlib.sha256(image).digest()
        self._transfer = line.random(16)
        self._reached = 0
        self._cancel: threading.Event | None = None
        self.held: Held = "old"

    def run(self, cancel: threading.Event | None) -> Sent:
        """Return what the control answered to the commit; raises TransferError."""
        self._cancel = self._line.cancel = cancel
        self._line.reconnections = 0
        try:
            return Sent(self._stage_and_commit(), self._line.reconnections)
        except TransferError as error:
            error.held = self.held
            self._abort()
            raise
        except KeyboardInterrupt:
            self._abort()
            raise
        finally:
            self._line.cancel = None

    def _stage_and_commit(self) -> Committed:
        idle = spoilt = 0
        while True:
            before = self._reached
            try:
                return self._line.persist(self._attempt, lambda: self.held)
            except Refusal as refusal:
                # Staged bytes that are lost or spoilt are sent again under the same id. On a serial line a
                # control may also have begun anew without the client's noticing; then it says how much it
                # has.
                if refusal.code == Code.DIGEST:
                    spoilt, self._reached = spoilt + 1, 0
                elif refusal.code in (Code.UNKNOWN_TRANSFER, Code.INCOMPLETE):
                    idle = idle + 1 if self._reached <= before else 0
                else:
                    raise self._error(refusal) from None
                if max(idle, spoilt) >= ATTEMPTS:
                    raise self._error(refusal) from None
                self.held = "old"

    def _attempt(self, talk: Conversation) -> Committed:
        """Take the download up where the control says, and commit it."""
        total = len(self._image)
        opening = OpenDownload(self._transfer, total, self._digest, self._expected, self._signature)
        if self.held == "old":
            self._line.cancel = self._cancel
        ready = talk.request(opening, Ready)
        if ready.offset < total:
            # A commit asked for on an earlier line has not happened: what it needs is no longer staged.
            self.held = "old"
            self._line.cancel = self._cancel

        def done(staged: int) -> None:
            if staged > self._reached:
                self._reached = staged
                self._line.moved()
            self._progress("download", staged, total)

        done(ready.offset)
        push(talk, self._image, ready.offset, *self._line.sizes(talk), done)
        return self._commit(talk)

    def _commit(self, talk: Conversation) -> Committed:
        if self._cancel is not None and self._cancel.is_set() and self.held == "old":
            raise Cancelled("cancelled")
        self._line.cancel = None  # from here on the matter is seen through
        self.held = "unknown"
        self._progress("commit", 0, 1)
        committed = talk.request(Commit(self._transfer, self._digest), Committed, at_least=COMMIT_WAIT)
        self.held = "new"
        self._progress("commit", 1, 1)
        return committed

    def _error(self, refusal: Refusal) -> TransferError:
        """Return the error of a refusal, which changes nothing: a commit that has happened is not refused.

        Only where the image is another one after a commit was asked for, ours may have come and gone.
        """
        error = error_of(refusal)
        welcome = self._line.welcome
        if isinstance(error, ImageChanged) and self.held == "unknown":
            error.held = "new" if welcome is not None and welcome.sha256 == self._digest else "unknown"
        self.held = error.held
        return error

    def _abort(self) -> None:
        """Have the control throw the staged bytes away; one that does not hear it keeps them for nothing."""
        self._line.cancel = None
        if self.held != "old":
            return
        self._line.once(
            lambda talk: talk.request(Abort(self._transfer), Aborted, at_least=ABORT_WAIT, tries=1)
        )
