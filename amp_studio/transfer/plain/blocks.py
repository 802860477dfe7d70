"""The blocks of XMODEM and YMODEM: a header, a number and its complement, 128 or 1024 bytes,
a checksum or CRC-16.
"""

from __future__ import annotations

from binascii import crc_hqx

SOH, STX, EOT, ACK, NAK, CAN, SUB = 0x01, 0x02, 0x04, 0x06, 0x15, 0x18, 0x1A
WANT_CRC = ord("C")
SHORT, LONG = 128, 1024
LENGTHS = {SOH: SHORT, STX: LONG}
CANCEL = bytes([CAN] * 8 + [0x08] * 8)
"""What gives a transfer up: two are enough, the rest is for noise; backspaces clear them from a command
line."""


def encode_block(number: int, content: bytes, *, crc: bool) -> bytes:
    """Return a block of 128 or 1024 bytes as it goes on the line; shorter content is filled up with 1Ah."""
    length = SHORT if len(content) <= SHORT else LONG
    content = content.ljust(length, bytes([SUB]))
    number &= 0xFF
    return (
        bytes([SOH if length == SHORT else STX, number, number ^ 0xFF]) + content + check_of(content, crc=crc)
    )


def check_of(content: bytes, *, crc: bool) -> bytes:
    """Return what follows the content: CRC-16 of polynomial 1021h from 0, high byte first,
    or the sum of the bytes.
    """
    return crc_hqx(content, 0).to_bytes(2, "big") if crc else bytes([sum(content) & 0xFF])


def decode_block(header: int, rest: bytes, *, crc: bool) -> tuple[int, bytes] | None:
    """Return number and content of a block behind its header byte, or None where it is damaged."""
    length = LENGTHS[header]
    if len(rest) != length + 3 + crc or rest[0] ^ rest[1] != 0xFF:
        return None
    # The complement has been checked first: the check at the end covers the content alone, so that a damaged
    # number would put a good block in a wrong place.
    content = rest[2 : 2 + length]
    return (rest[0], content) if check_of(content, crc=crc) == rest[2 + length :] else None
