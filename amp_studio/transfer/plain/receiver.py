"""The receiving end of XMODEM and YMODEM: every block is asked for until it is whole."""

from __future__ import annotations

import contextlib
from enum import Enum, auto

from .blocks import ACK, CAN, EOT, LENGTHS, NAK, WANT_CRC, decode_block
from .line import ByteLine, PlainFileError

_TRIES = 20  # of one block
_CRC_REQUESTS = 4  # unanswered ones, after which checksums are asked for
LARGEST = 64 * 1024 * 1024  # bytes of all files of a transfer; what takes parameters has less
_LAST_ANSWERS = 5  # repetitions of the last message that are acknowledged once more


class Came(Enum):
    """What came instead of a block."""

    END = auto()
    NOTHING = auto()
    DAMAGED = auto()


class BlockReceiver:
    """Receives numbered blocks. ``room`` is how many bytes are taken yet."""

    def __init__(self, line: ByteLine, *, crc: bool = True, may_fall_back: bool = True) -> None:
        self._line = line
        self._crc = crc
        self._may_fall_back = may_fall_back
        self.room = LARGEST

    def receive(self, total: int | None) -> bytes:
        """Return a whole file, with its padding; ``total`` is its size if known."""
        content, number = bytearray(), 1
        while (block := self.block(number, is_first=number == 1 and not content)) is not None:
            content += block
            self.room -= len(block)
            if self.room < 0:
                raise PlainFileError(f"the other end sends more than {LARGEST} bytes")
            number = number + 1 & 0xFF
            self._line.progress(
                "receive", len(content) if total is None else min(len(content), total), total or 0
            )
        return bytes(content)

    def block(self, number: int, *, is_first: bool) -> bytes | None:
        """Return the block of a number, acknowledged; None at the end of the file. ``is_first``:
        it has to be asked for.
        """
        line = self._line
        patience = line.patience
        end, tries, silences = line.now() + (patience.start if is_first else patience.stall), 0, 0
        if is_first:
            line.put(self._request(silences))
        while tries < _TRIES and line.now() < end:
            came = self._next(patience.ask if is_first else patience.answer)
            if isinstance(came, tuple):
                self._acknowledge(came[0], number)
                if came[0] == number:
                    return came[1]
                if is_first:
                    line.put(self._request(silences))
                tries += 1
                continue
            if came is Came.END and self._is_end(is_repeated=is_first and number == 0):
                return None
            # Asked for again only when the line is quiet: what is still on its way of a damaged block may
            # contain any byte, and one of them would be taken for the header of the next block.
            if came is Came.DAMAGED:
                line.wait_until_quiet()
            if came is Came.NOTHING and is_first:
                silences += 1
            else:
                tries += 1
            line.put(self._request(silences) if is_first else bytes([NAK]))
        if is_first:
            raise PlainFileError(f"the other end has not begun within {patience.start:g} s")
        raise PlainFileError(f"block {number} has not come whole")

    def _acknowledge(self, came: int, number: int) -> None:
        """Acknowledge a block, also the one before ``number`` once more: its acknowledgement was lost. Raises
        PlainFileError for any other.
        """
        if came not in (number, number - 1 & 0xFF):
            raise PlainFileError(f"block {came} has come, and block {number} was to come: one is lost")
        self._line.put(bytes([ACK]))

    def finish(self) -> None:
        """Acknowledge the last message again where it is repeated: its acknowledgement was disturbed."""
        with contextlib.suppress(PlainFileError):  # everything is here, whatever becomes of the line
            for _ in range(_LAST_ANSWERS):
                if not self._line.get(1, self._line.patience.quiet):
                    return
                self._line.wait_until_quiet()
                self._line.put(bytes([ACK]))

    def _request(self, silences: int) -> bytes:
        """Return what asks for the first block; a sender that does not know CRC does not answer to C."""
        if self._may_fall_back and self._crc and silences >= _CRC_REQUESTS:
            self._crc = False
        return bytes([WANT_CRC if self._crc else NAK])

    def _next(self, seconds: float) -> tuple[int, bytes] | Came:
        """Return number and content of the next block, or what came instead;
        raises where the other end gives up.
        """
        line = self._line
        header = line.get(1, seconds)
        if not header:
            return Came.NOTHING
        if header[0] == EOT:
            return Came.END
        # Two in a row: a single CAN may be a byte that noise has changed.
        if header[0] == CAN and line.get(1, line.patience.gap) == bytes([CAN]):
            raise PlainFileError("the other end has given the transfer up")
        if header[0] not in LENGTHS:
            return Came.DAMAGED
        rest = line.get(LENGTHS[header[0]] + 3 + self._crc, line.patience.gap)
        return decode_block(header[0], rest, crc=self._crc) or Came.DAMAGED

    def _is_end(self, *, is_repeated: bool) -> bool:
        """Return whether an EOT is one: it comes again when it is asked for.
        One of the file before is only acknowledged.
        """
        line = self._line
        if is_repeated:
            line.put(bytes([ACK]))
            return False
        for _ in range(_TRIES):
            line.put(bytes([NAK]))
            came = line.get(1, line.patience.answer)
            if came == bytes([EOT]):
                line.put(bytes([ACK]))
                return True
            if came and came[0] in LENGTHS:
                line.put_back(came)  # the EOT was a disturbed block, which comes again
                return False
            if not came:
                break
            line.wait_until_quiet()
        raise PlainFileError("the end of the file was announced once and not confirmed")
