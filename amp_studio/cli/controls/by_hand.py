"""What a user reads who exchanges with a control of a family whose controls themselves cannot be spoken
to.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from amp_studio.cli.console import print_remark
from amp_studio.schema import load_schema
from amp_studio.transfer import ControlSilentError, NoConnectionError, TransferError
from amp_studio.transfer.links import parse_endpoint

PRINT_SHEET = "print what to key in with amp-studio sheet FILE --against OTHER"


def print_by_hand(family: str) -> None:
    """Print that an exchange is with an emulated control or a gateway, and offer the sheet;
    nothing for most families.
    """
    if sentence := load_schema(family).family.by_hand:
        print_remark(f"{sentence}: {PRINT_SHEET}. What answers here is an emulated control or a gateway.")


@contextmanager
def ways_offered(family: str, address: str) -> Iterator[None]:
    """Add to the error, where nothing answers, in which other way a control is reached; ``family`` may be
    "".
    """
    try:
        yield
    except TransferError as error:
        is_silent = isinstance(error, ControlSilentError)
        is_there = not (is_silent or isinstance(error, NoConnectionError))
        # A control that has answered is reached: another way would not help with its refusal.
        if not is_there and (hint := _hint(family, address, is_silent=is_silent)):
            error.what = f"{error.what} ({hint})"
        raise


def _hint(family: str, address: str, *, is_silent: bool) -> str:
    """Return in which way a control of a family is reached; "" where there is nothing else to try."""
    if not family:
        return ""
    facts = load_schema(family).family
    if facts.by_hand:
        return f"{facts.by_hand}: {PRINT_SHEET}"
    lines = [each for each in facts.ways if each.way == "line"]
    if not is_silent or parse_endpoint(address).protocol or facts.ways[0].way == "line":
        return ""
    names = ", ".join(f"?protocol={each.protocol} for {each.what}" for each in lines)
    return f"this asks for a gateway; the control itself is reached with {names}"
