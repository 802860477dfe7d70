"""Find anything by what a person remembers of it: numbers, names, values, choices, messages of the control.

Typing errors are forgiven, each hit has its reason, and the words of a family are indexed once.
"""

from .entries import Entry, HitKind
from .finder import Finder, Hit, index_of
from .marks import MARKS, Mark, ValueMarks, noted, rows_of_file
from .message_page import LinkedParameter, LinkedRule, LinkedValue, MessagePage, message_page

__all__ = [
    "MARKS",
    "Entry",
    "Finder",
    "Hit",
    "HitKind",
    "LinkedParameter",
    "LinkedRule",
    "LinkedValue",
    "Mark",
    "MessagePage",
    "ValueMarks",
    "index_of",
    "message_page",
    "noted",
    "rows_of_file",
]
