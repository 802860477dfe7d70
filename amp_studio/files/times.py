"""Times as a person reads them: local, to the minute. Files keep them in UTC, to the second."""

from __future__ import annotations

import re
from datetime import datetime

_MONTHS = ("Jan", "Feb", "Mar", "Apr", "May", "Jun", "Jul", "Aug", "Sep", "Oct", "Nov", "Dec")
_STAMP = re.compile(r"\b\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(?:\+00:00|Z)")


def local_time(stamp: str) -> str:
    """Return a stored time as local date and time to the minute;
    a text that is no time is returned unchanged.
    """
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


def with_days_and_times(text: str) -> str:
    """Return a text with every stored time in it as ``day_and_time`` has it."""
    return _STAMP.sub(lambda found: day_and_time(found[0]), text)


def day_and_time(stamp: str, now: datetime | None = None) -> str:
    """Return a stored time in the words of a person: ``today 14:35``, ``yesterday 17:48``, ``18 Nov 16:20``,
    ``18 Nov 2024``.

    ``now`` is the present moment unless given; a text that is no time is returned unchanged.
    """
    try:
        moment = datetime.fromisoformat(stamp).astimezone()
    except (ValueError, OverflowError, OSError):
        return stamp
    present = (now or datetime.now().astimezone()).astimezone(moment.tzinfo)
    days = (present.date() - moment.date()).days
    if days in (0, 1):
        return f"{'yesterday' if days else 'today'} {moment:%H:%M}"
    # Not by strftime: its names of months follow the locale, and the day without a zero is not on
    # Windows.
    day = f"{moment.day} {_MONTHS[moment.month - 1]}"
    return f"{day} {moment:%H:%M}" if moment.year == present.year else f"{day} {moment.year}"
