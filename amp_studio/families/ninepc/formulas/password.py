"""The master password: chapter 33."""

from __future__ import annotations

from collections.abc import Sequence

LENGTH = 6
_FACTORY = "AB-D4 "


def password_codes(password: str) -> tuple[int, ...]:
    """ASCII values to enter for the master password; missing characters are blanks, 32 (page 33-12)."""
    if len(password) > LENGTH or any(not 32 <= ord(character) <= 95 for character in password):
        raise ValueError(
            "The master password is up to six characters of ASCII 32 to 95, without small letters."
        )
    return tuple(ord(character) for character in password.ljust(LENGTH))


def is_factory_password(codes: Sequence[float]) -> bool:
    """Return whether the six codes are those of the password that the manual prints (page 33-12)."""
    return list(codes) == [float(code) for code in password_codes(_FACTORY)]
