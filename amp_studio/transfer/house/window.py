"""The sliding window: which pieces of an image are under way, and which were lost.

Each sending of a piece has a separate number, and the answer names it. A
line keeps the order, so an answer to a later sending means that the earlier
ones without an answer are lost: they are sent again at once, and only they.
"""

from __future__ import annotations

import heapq
from dataclasses import dataclass


@dataclass(frozen=True)
class SentPiece:
    """One sending: where the piece is in the image (bytes) and when it was sent (seconds)."""

    offset: int
    length: int
    sent_at: float


class Window:
    """The pieces of ``size`` bytes from ``start`` on, ``chunk`` bytes each, at most ``limit`` under way."""

    def __init__(self, start: int, size: int, chunk: int, limit: int) -> None:
        self.size = size
        self._chunk = chunk
        self._limit = max(1, limit)
        # A control chooses the chunk: what is kept here grows with what is under way, not with the pieces.
        self._floor = start  # every piece before it has arrived,
        self._ahead: set[int] = set()  # and these beyond it
        self._next = start  # no piece from here on was ever sent
        self._lost: list[int] = []  # a heap of the offsets to send again
        self._flying: dict[int, SentPiece] = {}  # by number, in the order of sending
        self._number_at: dict[int, int] = {}  # offset -> the one sending of it that is under way
        self.bytes_flying = 0
        """The bytes that are under way."""
        self._numbers: set[int] = set()

    @property
    def is_done(self) -> bool:
        """Whether every piece has arrived."""
        return self._floor >= self.size

    @property
    def oldest(self) -> float | None:
        """When the piece that waits longest for its answer was sent."""
        return next((piece.sent_at for piece in self._flying.values()), None)

    def flying(self, number: int) -> SentPiece | None:
        """Return the sending with this number, while it is under way."""
        return self._flying.get(number)

    def knows(self, number: int) -> bool:
        """Return whether a piece was ever sent under this number."""
        return number in self._numbers

    def have(self, offset: int) -> None:
        """The piece at ``offset`` is there already."""
        if offset >= self._floor:
            self._ahead.add(offset)
        while self._floor in self._ahead:
            self._ahead.remove(self._floor)
            number = self._number_at.get(self._floor)
            # The control may have this piece of an earlier line: what is under way of it need not be
            # waited for.
            if number in self._flying and self._flying[number].offset == self._floor:
                self._landed(number)
            self._floor += self._chunk

    def next_piece(self) -> tuple[int, int] | None:
        """Return offset and length of the next piece to send, or None while the window is full."""
        while len(self._flying) < self._limit:
            # The gaps first: the control can only commit once they are filled.
            if self._lost:
                offset = heapq.heappop(self._lost)
            elif self._next < self.size:
                offset, self._next = self._next, self._next + self._chunk
            else:
                return None
            if self._is_missing(offset):
                return offset, min(self._chunk, self.size - offset)
        return None

    def sent(self, number: int, offset: int, length: int, now: float) -> None:
        """A piece has gone out under this number."""
        self._flying[number] = SentPiece(offset, length, now)
        self._number_at[offset] = number
        self.bytes_flying += length
        self._numbers.add(number)

    def arrived(self, number: int) -> SentPiece | None:
        """The sending with this number has arrived; earlier ones without an answer are lost."""
        piece = self._answered(number)
        if piece is not None:
            self.have(piece.offset)
        return piece

    def refused(self, number: int) -> SentPiece | None:
        """The sending with this number has come too early and must be sent again."""
        piece = self._answered(number)
        if piece is not None:
            self._again(piece)
        return piece

    def reached(self, offset: int) -> None:
        """Everything before ``offset`` has arrived."""
        while self._floor < self.size and min(self._floor + self._chunk, self.size) <= offset:
            self.have(self._floor)

    def lose_all(self) -> None:
        """No answer came in time: everything under way is to be sent again."""
        for number in tuple(self._flying):
            self._again(self._landed(number))

    def _answered(self, number: int) -> SentPiece | None:
        if number not in self._flying:
            return None
        while (first := next(iter(self._flying))) != number:
            self._again(self._landed(first))
        return self._landed(number)

    def _landed(self, number: int | None) -> SentPiece | None:
        """Take a sending from those under way, if it is one."""
        piece = None if number is None else self._flying.pop(number, None)
        if piece is not None:
            self._number_at.pop(piece.offset, None)
            self.bytes_flying -= piece.length
        return piece

    def _again(self, piece: SentPiece | None) -> None:
        if piece is not None and self._is_missing(piece.offset):
            heapq.heappush(self._lost, piece.offset)

    def _is_missing(self, offset: int) -> bool:
        return offset >= self._floor and offset not in self._ahead
