"""Ctrl-C, answered once and by everything that runs.

The first one raises KeyboardInterrupt; what comes while the verb ends and describes the present state is
ignored. Python and the rule engine lose an interrupt that comes in the wrong moment (while an object is put
away, inside a function that an expression calls): ``stop_was_requested`` remembers it.
"""

from __future__ import annotations

import contextlib
import signal
import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any, NoReturn

if TYPE_CHECKING:
    from amp_studio.transfer import Stop

_asked: list[int] = []


def raise_on_interrupt() -> None:
    """Begin to answer Ctrl-C."""
    signal.signal(signal.SIGINT, _stop)
    # An interrupt inside of a destructor is not raised but printed, with a traceback.
    sys.unraisablehook = _unraised


def ignore_interrupts() -> None:
    """Answer no more: nothing is left that could be stopped."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def stop_was_requested() -> bool:
    """Return whether Ctrl-C has come, also where nothing was raised by it in the end."""
    return bool(_asked)


@contextlib.contextmanager
def stop_requested() -> Iterator[Stop]:
    """Give the event that Ctrl-C or a kill sets inside, for what must end with the truth of another place.

    What comes later is ignored: the verb knows its result and prints it.
    """
    from amp_studio.transfer import Stop, interrupts

    stop = Stop()
    is_program = signal.getsignal(signal.SIGINT) is _stop
    # A program that uses this one as a library has its answer to Ctrl-C back afterwards.
    with interrupts(stop.set, after=signal.SIG_IGN if is_program else None):
        yield stop


def _stop(number: int, _frame: object) -> NoReturn:
    ignore_interrupts()
    _asked.append(number)
    raise KeyboardInterrupt


def _unraised(unraisable: Any) -> None:
    if unraisable.exc_type is not KeyboardInterrupt:
        sys.__unraisablehook__(unraisable)
