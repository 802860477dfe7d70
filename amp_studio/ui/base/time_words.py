"""Times in lists of files, in words."""

from __future__ import annotations

from datetime import datetime, timedelta

from PySide6.QtCore import QDate, QLocale

from .translated import tr


def stored_in_words(stamp: str) -> str:
    """Return a stored time in words; a text that is no time is returned unchanged."""
    try:
        moment = datetime.fromisoformat(stamp).astimezone()
    except (ValueError, OverflowError, OSError):
        return stamp
    return in_words(moment, datetime.now().astimezone())


def in_words(moment: datetime, now: datetime) -> str:
    """Return a local time in words, seen from ``now``: ``today 14:35``, ``yesterday 17:48``,
    ``19 Nov 09:12``, ``3 Mar 2024``.
    """
    time = f"{moment:%H:%M}"
    if moment.date() == now.date():
        return tr("today {time}").format(time=time)
    if moment.date() == (now - timedelta(days=1)).date():
        return tr("yesterday {time}").format(time=time)
    day = QDate(moment.year, moment.month, moment.day)
    month = QLocale(tr("en", "language of the names of months")).toString(
        day, tr("d MMM", "day and month, as QDate writes them")
    )
    return f"{month} {time}" if moment.year == now.year else f"{month} {moment.year}"
