"""The command line: every verb of the program without a display.

Exit codes: 0 done and nothing wrong; 1 done, and what was checked has errors; 2 the input cannot be used, or
the verb was stopped, and nothing was changed; 3 something was changed before the verb failed or was stopped,
and the message describes the present state; 4 it is not known whether the control changed.
"""

from __future__ import annotations

TYPE_CHECKING = False  # the typing module is not loaded for it: see main
if TYPE_CHECKING:
    from collections.abc import Sequence


_OBJECTS = 500_000
"""New objects before Python looks for unreachable ones: facts and values are many and stay,
a fifth of a check's time."""


def main(arguments: Sequence[str] | None = None) -> None:
    """Run one verb and exit with its code; without a verb the desktop program opens."""
    # Built in (and so without type hints): nothing is loaded before an early Ctrl-C ends the program without
    # a traceback.
    import _signal  # type: ignore[import-not-found]  # built in, and in no stub
    import gc

    _signal.signal(_signal.SIGINT, _signal.SIG_DFL)
    gc.set_threshold(_OBJECTS)
    from .program import start

    start(arguments)


def run(arguments: Sequence[str]) -> int:
    """Run one verb and return its exit code."""
    from .program import run_verb

    return run_verb(arguments)
