"""One upload from the client's side: read everything, go on after a cut, check the digest."""

from __future__ import annotations

import hashlib
import random

from amp_studio.transfer.errors import ImageDamagedError, ProtocolMismatchError

from .connection import STEPS, Connection
from .message import Code, OpenUpload, RefusalError, UploadReady
from .refusals import error_of
from .streaming import pull
from .transaction import Transaction

# An image is some hundred kilobytes of text at most; a control that states more is not understood rightly.
MAX_IMAGE = 1 << 22  # bytes
MAX_PIECES = 1 << 16
_ATTEMPTS = 3  # how often reading may be broken off by the control, start again, or end with another digest


SLOW = 5.0  # seconds that a line of known rate may take for an image until only some of it is read back
_ONE_OF = 16  # pieces of which one is read back then
_MIN_PIECES = 6  # pieces that are read back at least


class UploadTransfer:
    """Fetches the active image; ``stage`` is the name it gives to ``progress``.

    ``sent`` is an image that the control has committed in this session, after the digest it stated was right
    for everything it had before. Where a line of known rate would take longer than ``SLOW`` and the control
    states the digest of ``sent`` for what it contains now, only pieces chosen at random are read, and
    ``sampled`` is their number and that of all. Whatever does not fit is read whole.
    """

    def __init__(self, line: Connection, stage: str, sent: bytes | None = None) -> None:
        self._line = line
        self._stage = stage
        self._sent = sent
        self.sampled: tuple[int, int] | None = None
        self._opened: tuple[UploadReady, int] | None = None
        self._pieces: dict[int, bytes] = {}
        self._begun = 0  # how often reading has begun

    def run(self) -> bytes:
        """Return the image; raises TransferError."""
        idle = corrupted = 0
        while True:
            before = self._received()
            try:
                ready = self._line.persist(self._read)
            except RefusalError as refusal:
                # On a serial line a control may have started again without the client's noticing.
                size = self._opened[0].size if self._opened is not None else 0
                idle = 0 if self._received() - before > size // STEPS else idle + 1
                if refusal.code != Code.NO_UPLOAD or idle >= _ATTEMPTS:
                    raise error_of(refusal) from None
                continue
            image = b"".join(self._pieces[at] for at in sorted(self._pieces))
            if hashlib.sha256(image).digest() == ready.sha256:
                self._line.notify(self._stage, len(image), len(image))
                return image
            self._opened, self._sent, self.sampled = None, None, None
            corrupted += 1
            if corrupted >= _ATTEMPTS:
                raise ImageDamagedError("what the control sends does not have the digest it states")

    def _read(self, transaction: Transaction) -> UploadReady:
        """Read the pieces that are missing; if it is another image than before, all of them."""
        ready = transaction.request(OpenUpload(), UploadReady)
        if ready.size > MAX_IMAGE:
            raise ProtocolMismatchError(f"the control states an image of {ready.size} bytes, which cannot be")
        chunk, limit = self._line.sizes(transaction)
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

        pull(transaction, ready.size, chunk, limit, self._pieces, done)
        return ready

    def _begin(self, ready: UploadReady, chunk: int) -> None:
        """Read from the first byte on; what was read before is of another image."""
        self._begun += 1
        if self._begun > 2 * _ATTEMPTS:
            raise ImageDamagedError("the image changes again and again while it is read")
        self._opened = (ready, chunk)
        self._pieces.clear()
        self.sampled = None
        if self._sent is not None and self._may_sample(ready):
            self._take_as_read(self._sent, chunk)
        self._line.begin()

    def _may_sample(self, ready: UploadReady) -> bool:
        rate = self._line.rate
        is_sent = self._sent is not None and ready.sha256 == hashlib.sha256(self._sent).digest()
        return is_sent and rate is not None and ready.size / rate > SLOW

    def _take_as_read(self, image: bytes, chunk: int) -> None:
        """Leave only pieces to be read that could not be known before: the first, the last,
        and some at random.
        """
        offsets = range(0, len(image), chunk)
        count = min(len(offsets), max(_MIN_PIECES, len(offsets) // _ONE_OF))
        chance = random.Random(self._line.random(16))  # noqa: S311  # seeded by what the control cannot know
        inner = chance.sample(offsets[1:-1], max(0, count - 2))
        chosen = {*offsets[:1], *inner, *offsets[-1:]}
        self._pieces.update((at, image[at : at + chunk]) for at in offsets if at not in chosen)
        self.sampled = len(chosen), len(offsets)

    def _received(self) -> int:
        return sum(map(len, self._pieces.values()))
