"""One upload from the client's side: read everything, go on after a cut, check the digest."""

from __future__ import annotations

import hashlib

from amp_studio.transfer.errors import ImageDamagedError, ProtocolMismatchError

from .connection import STEPS, Connection
from .message import Code, OpenUpload, RefusalError, UploadReady
from .refusals import error_of
from .streaming import pull
from .transaction import Transaction

# An image is some hundred kilobytes of text at most; a control that states more is not understood rightly.
MAX_IMAGE = 1 << 22  # bytes
MAX_PIECES = 1 << 16
ATTEMPTS = 3  # how often reading may be broken off by the control, start again, or end with another digest


class UploadTransfer:
    """Fetches the active image; ``stage`` is the name it gives to ``progress``."""

    def __init__(self, line: Connection, stage: str) -> None:
        self._line = line
        self._stage = stage
        self._opened: tuple[UploadReady, int] | None = None
        self._pieces: dict[int, bytes] = {}
        self._begun = 0  # how often reading has begun

    def run(self) -> bytes:
        """Return the image; raises TransferError."""
        idle = spoilt = 0
        while True:
            before = self._received()
            try:
                ready = self._line.persist(self._read)
            except RefusalError as refusal:
                # On a serial line a control may have started again without the client's noticing.
                size = self._opened[0].size if self._opened is not None else 0
                idle = 0 if self._received() - before > size // STEPS else idle + 1
                if refusal.code != Code.NO_UPLOAD or idle >= ATTEMPTS:
                    raise error_of(refusal) from None
                continue
            image = b"".join(self._pieces[at] for at in sorted(self._pieces))
            if hashlib.sha256(image).digest() == ready.sha256:
                self._line.notify(self._stage, len(image), len(image))
                return image
            self._opened = None
            spoilt += 1
            if spoilt >= ATTEMPTS:
                raise ImageDamagedError("what the control sends does not have the digest it states")

    def _read(self, talk: Transaction) -> UploadReady:
        """Read the pieces that are missing; if it is another image than before, all of them."""
        ready = talk.request(OpenUpload(), UploadReady)
        if ready.size > MAX_IMAGE:
            raise ProtocolMismatchError(f"the control states an image of {ready.size} bytes, which cannot be")
        chunk, limit = self._line.sizes(talk)
        if ready.size > chunk * MAX_PIECES:
            raise ProtocolMismatchError(
                f"the control gives an image of {ready.size} bytes only {chunk} at a time: "
                f"{MAX_PIECES} pieces are the most"
            )
        if (ready, chunk) != self._opened:
            self._begin(ready, chunk)

        def done(received: int) -> None:
            self._line.moved(received, ready.size)
            self._line.notify(self._stage, received, ready.size)

        pull(talk, ready.size, chunk, limit, self._pieces, done)
        return ready

    def _begin(self, ready: UploadReady, chunk: int) -> None:
        """Read from the first byte on; what was read before is of another image."""
        self._begun += 1
        if self._begun > 2 * ATTEMPTS:
            raise ImageDamagedError("the image changes again and again while it is read")
        self._opened = (ready, chunk)
        self._pieces.clear()
        self._line.begin()

    def _received(self) -> int:
        return sum(map(len, self._pieces.values()))
