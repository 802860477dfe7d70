"""Find anything by what a person remembers of it: numbers, names, values, choices, messages of the control.

Typing errors are forgiven, each hit has its reason, and the words of a family are indexed once.
"""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .entries import Entry, HitKind
    from .finder import Finder, Hit, elsewhere, index_of
    from .index import SearchIndex
    from .message_links import LinkedParameter, LinkedRule, MessagePage, message_page
    from .synonyms import prepare_synonyms
    from .value_filters import FILTER_NAMES, FilterName, ValueFilters, noted, rows_of_file
else:
    __getattr__ = front_page(__name__)
