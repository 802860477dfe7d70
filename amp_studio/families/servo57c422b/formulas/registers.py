"""Registers of 16 bits, alone and in pairs, and the scan of the module."""

from __future__ import annotations

from amp_studio.validate import finite, not_negative, whole

SCAN_MS = 1.25
"""Update rate of velocity and position loops (page A-2)."""


def scans(time_ms: float) -> float:
    """Scans of 1.25 ms in a time, as registers 83 and 129 contain it (pages 4-41, 4-54 and A-2)."""
    return finite("The time", time_ms) / SCAN_MS


def double_words(number: float) -> tuple[int, int]:
    """First and second register of a double precision number (page 4-48): the upper half comes first.

    A negative number is its two's complement.
    """
    word = whole("The number", number, -(2**31))
    if word >= 2**32:
        raise ValueError(f"The number must fit 32 bits, not {number!r}.")
    return word >> 16 & 0xFFFF, word & 0xFFFF


def double_of(first: float, second: float) -> int:
    """Double precision number, with its sign, in two registers (page 4-48): the upper half is the first."""
    halves = [whole("A register", half, 0) for half in (first, second)]
    if max(halves) >= 2**16:
        raise ValueError(f"A register must fit 16 bits, not {max(first, second)!r}.")
    number = halves[0] << 16 | halves[1]
    return number - 2**32 if number >= 2**31 else number


def commands_set(register_66: float, register_67: float) -> float:
    """How many commands are given at once in registers 66 and 67 (page 4-27): only one is allowed."""
    return float(
        sum(int(not_negative("A command register", word)).bit_count() for word in (register_66, register_67))
    )
