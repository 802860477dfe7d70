"""The bytes of an unload, taken apart: leader, parity, the table up to its Xoff."""

from __future__ import annotations

from amp_studio.transfer import ImageDamagedError
from amp_studio.transfer.links import Parity

XON, XOFF = 0x11, 0x13
LARGEST = 1 << 18
"""Bytes of a table; the largest of the manual's parameters has some 12,000."""
LEADER = 1 << 16
"""Bytes that may come before the table: NUL of a tape's leader, line ends, Xon."""
_START = ord("%")
_BEFORE = frozenset((0x00, 0x7F, 0x0A, 0x0D, XON, XOFF))


class TableReader:
    """Takes an unload as it comes. Which parity its characters have, ``%`` shows: it has three ones,
    so A5 is even.

    The manual itself gives Xoff as 93 (page 9-20), which is 13 with even parity in the eighth bit. Odd parity
    leaves ``%`` as it is, and shows at the first character with an even number of ones.
    """

    def __init__(self) -> None:
        self.table = bytearray()
        self.parity: Parity = "none"
        self.is_whole = False
        self.has_noise = False
        """Whether something has come that belongs neither to a table nor before it."""
        self._leader = 0

    @property
    def has_begun(self) -> bool:
        """Whether the table's first character has come."""
        return bool(self.table)

    def feed(self, data: bytes) -> None:
        """Take bytes; what comes behind Xoff is left out. Raises ImageDamagedError."""
        for byte in data:
            if self.is_whole:
                return
            if not self.table:
                self._begin(byte)
            else:
                self._read_byte(byte)

    def _begin(self, byte: int) -> None:
        """Wait for the % that begins a table; its top bit shows the parity."""
        if byte & 0x7F == _START:
            self.table.append(_START)
            self.parity = "even" if byte & 0x80 else "none"
            return
        self._leader += 1
        self.has_noise |= byte & 0x7F not in _BEFORE
        if self._leader > LEADER:
            raise ImageDamagedError("what comes is not a parameter table: it does not begin with %")

    def _read_byte(self, byte: int) -> None:
        """Keep a byte of the table; raises ImageDamagedError."""
        if byte & 0x80 and self.parity == "none" and len(self.table) < 13:
            # The job reference has eight digits: one of 0, 3, 5, 6 or 9, or the ";" with its length, shows
            # odd parity.
            self.parity = "odd"
            if any(with_parity(character, "odd") != character for character in self.table):
                raise self._damaged("a character with a parity error")
        if self.parity != "none" and with_parity(byte & 0x7F, self.parity) != byte:
            raise self._damaged("a character with a parity error")
        character = byte & 0x7F if self.parity != "none" else byte
        if character == XON:
            return
        if character == XOFF:
            self.is_whole = True
        if character > 0x7E or (character < 0x20 and character not in (0x0A, 0x0D, XOFF)):
            raise self._damaged(f"the byte {character:02X}, which is in no table")
        self.table.append(character)
        if len(self.table) > LARGEST:
            raise ImageDamagedError(f"the table has no end: {LARGEST} bytes have come without Xoff")

    def _damaged(self, what: str) -> ImageDamagedError:
        line = self.table.count(b"\n") + 1
        return ImageDamagedError(f"the table has arrived damaged: {what} in line {line}")


def with_parity(character: int, parity: Parity) -> int:
    """Return a character of seven bits as it goes over the line."""
    if parity == "none":
        return character
    is_odd = character.bit_count() % 2 == 1
    return character | (0x80 if is_odd == (parity == "even") else 0)
