"""How much work something is, in calls of functions: the same on every machine, however busy it is."""

import cProfile
from collections.abc import Callable


def calls_of(act: Callable[[], object]) -> int:
    """Return how many functions, of Python and of C, a call of ``act`` calls. What takes long within one of
    them, a regular expression that goes back and forth, is judged by its seconds in ``make faults``.
    """
    profile = cProfile.Profile()
    profile.runcall(act)
    return sum(entry.callcount for entry in profile.getstats())
