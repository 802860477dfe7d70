"""What a setting stores as it is written. The firmware does not check all of it: of 70000 a setting of 16
bits keeps 4464, and answers ``ok``.
"""

from __future__ import annotations

import re

from amp_studio.errors import AmpStudioError

from .description import (
    AXES,
    BOOLEAN,
    CHOICE,
    DECIMAL,
    IPV4,
    MASK,
    PASSWORD,
    SWITCHED_MASK,
    TEXT,
    DescribedSetting,
)
from .numbers import LARGEST, read_number

_CLASSIC = {0: 255, 1: 255, 2: 255, 3: 255, 10: 255, 23: 255, 26: 65_535}
"""The largest whole numbers of a Grbl 1.1, which does not check them either (settings.h ``settings_t``)."""

_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)")


class BoundsError(AmpStudioError, ValueError):
    """A text that a setting would not store as what it means; one clear sentence."""


def check_text(setting: DescribedSetting | None, number: int, text: str, axes: int) -> None:
    """Refuse a text that the setting would not store as it is; raises BoundsError.

    ``setting`` is None where the control does not describe it: a Grbl 1.1.
    """
    name = f"${number} {setting.name}" if setting else f"${number}"
    # A byte of a longer character could be a real-time command, which acts in the middle of a line.
    if not text.isascii() or not text.isprintable():
        raise BoundsError(f"{name} takes plain ASCII characters only")
    if (setting is None or setting.type == DECIMAL) and not _NUMBER.fullmatch(text):
        raise BoundsError(f"{name} takes a number, not '{text[:40]}'")
    if setting is None:
        if text.isdecimal() and int(text) > _CLASSIC.get(number, LARGEST):
            raise BoundsError(f"{name} takes 0 to {_CLASSIC.get(number, 0)}, not {text}")
    elif setting.type in (TEXT, PASSWORD, IPV4):
        _check_length(setting, name, text)
    elif setting.type == DECIMAL:
        _check_decimal(setting, name, text)
    else:
        _check_whole(setting, name, text, axes)


def _check_length(setting: DescribedSetting, name: str, text: str) -> None:
    most = int(setting.most) if setting.most.isdecimal() and setting.type != IPV4 else 127
    if len(text) > most:
        raise BoundsError(f"{name} takes {most} characters, not {len(text)}")


def _check_whole(setting: DescribedSetting, name: str, text: str, axes: int) -> None:
    if not text.isdecimal():
        raise BoundsError(f"{name} takes whole numbers from 0 on, not '{text[:40]}'")
    # 0 is allowed for some below their least value: it switches them off.
    if not (setting.may_be_zero and int(text) == 0):
        low, high = _bounds(setting, axes)
        if not low <= int(text) <= high:
            raise BoundsError(f"{name} takes {low} to {high}, not {text[:40]}")


def _bounds(setting: DescribedSetting, axes: int) -> tuple[int, int]:
    """Return the smallest and the largest whole number that a setting stores."""
    if setting.type == BOOLEAN:
        return 0, 1
    if setting.type in (MASK, SWITCHED_MASK):
        return 0, (1 << len(setting.labels)) - 1
    if setting.type == AXES:
        return 0, (1 << axes) - 1
    if setting.type == CHOICE:
        return 0, len(setting.labels) - 1
    # Whether it is kept in 8, 16 or 32 bits is not enumerated: what is shown is what there is certainly room
    # for.
    digits = sum(character in "#0" for character in setting.format) or 5
    high = int(setting.most) if setting.most.isdecimal() else min(10**digits - 1, 65_535)
    return int(setting.least) if setting.least.isdecimal() else 0, high


def _check_decimal(setting: DescribedSetting, name: str, text: str) -> None:
    """Raise BoundsError for a number that the firmware would refuse."""
    least, most = setting.least or "0", setting.most
    try:
        number = read_number(text)
        fits = read_number(least) <= number <= (read_number(most) if most else LARGEST)
    except ValueError as error:
        raise BoundsError(f"{name}: {error}") from None
    if not fits and not (setting.may_be_zero and number == 0):
        raise BoundsError(f"{name} takes {least} {f'to {most}' if most else 'and more'}, not {text}")
