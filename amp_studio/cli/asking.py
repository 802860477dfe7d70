"""The question for the password of a control, at the terminal."""

from __future__ import annotations

import getpass
import signal
import sys
import threading

from amp_studio.transfer.links import ask_with


def ask_at_terminal() -> None:
    """Have the person at the terminal asked for a password that is set nowhere."""
    ask_with(_ask)


def _ask(place: str) -> str:
    """Return what is entered without showing it;
    Ctrl-C ends the question also where it is only noted otherwise.
    """
    # Signals can be set in the main thread only, and two threads must not ask at one terminal.
    if threading.current_thread() is not threading.main_thread():
        return ""
    # Where Ctrl-C is only noted, to stop at a safe point, the question would not end by it.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        return getpass.getpass(f"Password of {place}: ", sys.stderr)
    except EOFError:
        return ""
    finally:
        signal.signal(signal.SIGINT, before)
