"""What a person reads who exchanges with a control of a family whose controls take values at their screens only."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from amp_studio.sheet.keying import keying_of
from amp_studio.transfer.errors import TransferError

from .console import note


def note_by_hand(family: str) -> None:
    """Note that an exchange is with an emulated control or a gateway, and offer the sheet; nothing for most families."""
    if sentence := keying_of(family).only_way:
        note(f"{sentence}. What answers here is an emulated control or a gateway.")


@contextmanager
def sheet_offered(family: str) -> Iterator[None]:
    """Add the sentence to the error of an exchange that fails; ``family`` may be "" where nobody has named one."""
    try:
        yield
    except TransferError as error:
        if family and (sentence := keying_of(family).only_way):
            error.what = f"{error.what} ({sentence})"
        raise
