"""Times as a person reads them: local, to the minute. Files keep them in UTC, to the second."""

from __future__ import annotations

import re
from datetime import datetime

_STAMP = re.compile(r"\b\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(?:\+00:00|Z)")


def local_time(stamp: str) -> str:
    """Return a stored time as local date and time to the minute; a text that is no time is returned unchanged."""
    try:
        moment = datetime.fromisoformat(stamp)
    except ValueError:
        return stamp
    try:
        return f"{moment.astimezone():%Y-%m-%d %H:%M}"
    except (OverflowError, OSError, ValueError):  # the year 1, or 9999
        return stamp


def with_local_times(text: str) -> str:
    """Return a text with every stored time in it as local time."""
    return _STAMP.sub(lambda found: local_time(found[0]), text)
