"""One upload from the client's side: read everything, go on after a cut, check the digest."""

from __future__ import annotations

import hashlib

from .conversation import Conversation
from .errors import ImageDamaged, ProtocolMismatch, error_of
from .line import Line
from .message import Code, OpenUpload, Refusal, UploadReady
from .progress import Progress
from .streaming import pull

MAX_IMAGE = 1 << 26  # bytes; a control that states more is not understood rightly
ATTEMPTS = 3  # how often in a row reading may be broken off by the control, or end with another digest


class Fetching:
    """Fetches the active image; ``stage`` is what it is told as to ``progress``."""

    def __init__(self, line: Line, progress: Progress, stage: str) -> None:
        self._line = line
        self._progress = progress
        self._stage = stage
        self._opened: tuple[UploadReady, int] | None = None
        self._pieces: dict[int, bytes] = {}

    def run(self) -> bytes:
        """Return the image; raises TransferError."""
        idle = spoilt = 0
        while True:
            before = len(self._pieces)
            try:
                ready = self._line.persist(self._read)
            except Refusal as refusal:
                # On a serial line a control may have begun anew without the client's noticing.
                idle = idle + 1 if len(self._pieces) <= before else 0
                if refusal.code != Code.NO_UPLOAD or idle >= ATTEMPTS:
                    raise error_of(refusal) from None
                continue
            image = b"".join(self._pieces[at] for at in sorted(self._pieces))
            if hashlib.sha256(image).digest() == ready.sha256:
                self._progress(self._stage, len(image), len(image))
                return image
            self._pieces.clear()
            spoilt += 1
            if spoilt >= ATTEMPTS:
                raise ImageDamaged("what the control sends does not have the digest it states")

    def _read(self, talk: Conversation) -> UploadReady:
        """Read the pieces that are missing; if it is another image than before, all of them."""
        ready = talk.request(OpenUpload(), UploadReady)
        if ready.size > MAX_IMAGE:
            raise ProtocolMismatch(f"the control states an image of {ready.size} bytes, which cannot be")
        chunk, limit = self._line.sizes(talk)
        if (ready, chunk) != self._opened:
            self._opened = (ready, chunk)
            self._pieces.clear()

        def done(received: int) -> None:
            self._line.moved()
            self._progress(self._stage, received, ready.size)

        pull(talk, ready.size, chunk, limit, self._pieces, done)
        return ready
