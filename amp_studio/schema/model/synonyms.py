"""What people type for what the manuals call otherwise (``synonyms.yaml``)."""

from .record import Model


class Synonym(Model):
    """Words of the trade in any language, or what people see, and what to look for instead."""

    words: tuple[str, ...]
    """Words and groups of words that mean the same; upper and lower case are one, and ä is ae too."""
    mean: tuple[str, ...]
    """Questions in the words of the manuals, the likeliest first; each is asked in every family."""


class Synonyms(Model):
    """The synonyms of all families."""

    synonyms: tuple[Synonym, ...]
