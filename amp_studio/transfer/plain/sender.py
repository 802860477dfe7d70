"""The sending end of XMODEM and YMODEM: every block is sent until it is acknowledged."""

from __future__ import annotations

from .blocks import ACK, CAN, EOT, LONG, NAK, SHORT, WANT_CRC, encode_block
from .line import ByteLine, PlainFileError

_TRIES = 20  # of one block
_EASY = 32  # short blocks after one that needed several tries; then long ones again


class BlockSender:
    """Sends numbered blocks.

    ``has_begun`` once a block was on the line, whatever became of it;
    ``taken`` counts the bytes that were acknowledged.
    """

    def __init__(self, line: ByteLine, *, long_blocks: bool) -> None:
        self._line = line
        self._long_blocks = long_blocks
        self._easy = 0
        self._crc = False
        self.has_begun = False
        self.accepted_bytes = 0

    def await_start(self) -> None:
        """Wait until the receiver asks for the first block: by C with CRC, by NAK with checksums."""
        line = self._line
        asked = self._answer(line.now(), line.patience.start, (WANT_CRC, NAK))
        if asked is None:
            raise PlainFileError(f"nobody has asked for a file for {line.patience.start:g} s")
        self._crc = asked == WANT_CRC

    def send(self, content: bytes) -> None:
        """Send a file as blocks from 1 on, and its end."""
        number, at = 1, 0
        while at < len(content):
            piece = content[at : at + self._length(len(content) - at)]
            self.send_block(number, piece)
            number, at = number + 1, at + len(piece)
            self.accepted_bytes += len(piece)
            self._line.progress("send", at, len(content))
        self._repeat(bytes([EOT]), "the end of the file")

    def send_block(self, number: int, content: bytes) -> None:
        """Send one block; raises PlainFileError."""
        tries = self._repeat(encode_block(number, content, crc=self._crc), f"block {number}")
        self._easy = _EASY if tries > 2 else max(0, self._easy - 1)

    def _length(self, left: int) -> int:
        """Return how much the next block takes: a long one while it pays, and no more padding than needed."""
        is_long = self._long_blocks and self._crc and not self._easy
        return LONG if is_long and left > LONG - SHORT else SHORT

    def _repeat(self, data: bytes, what: str) -> int:
        """Send until it is acknowledged and return how often it was sent.

        The same bytes each time: whether an earlier sending has arrived cannot be known.
        """
        line, late = self._line, False
        end = line.now() + line.patience.stall
        for tries in range(1, _TRIES + 1):
            if line.drop():
                raise PlainFileError("the other end has given the transfer up")
            self.has_begun = True
            answer = self._answer(line.put(data), line.patience.answer, (ACK, NAK, WANT_CRC))
            if answer == ACK:
                if late:
                    # The acknowledgement of an earlier sending is not that of the next block.
                    line.wait_until_quiet()
                return tries
            late |= answer is None
            if line.now() > end:
                break
        raise PlainFileError(f"{what} was not acknowledged")

    def _answer(self, since: float, seconds: float, wanted: tuple[int, ...]) -> int | None:
        """Return the first wanted byte, or None where none has come so long after a time;
        raises where the other end gives up.
        """
        end, cancels = since + seconds, 0
        while (left := end - self._line.now()) > 0:
            came = self._line.get(1, left)
            if not came:
                return None
            cancels = cancels + 1 if came[0] == CAN else 0
            if cancels == 2:
                raise PlainFileError("the other end has given the transfer up")
            if came[0] in wanted:
                return came[0]
            if ACK in wanted:
                end = min(end, max(since, self._line.now()) + self._line.noise)
        return None
