"""A value of a parameter, and what a text is that is none."""

from __future__ import annotations

from dataclasses import dataclass

from amp_studio.errors import AmpStudioError

LONGEST_NUMBER = 400
"""Characters of a number with its unit: the longest double written out has some 330."""


class _Keyed:
    """Remembers the key of a value (``expression.key_of``), which may be in many files."""

    # A slot of the class above: dataclass would make a field of it here, which is compared and written.
    __slots__ = ("_key",)


@dataclass(frozen=True, slots=True)
class Value(_Keyed):
    """One value in the unit it was entered in.

    ``value`` is a float or int, the key of a choice, a bool for a yes/no parameter, or a text. A choice for
    which the control stores a code that the database does not know is kept as ``raw:<code>``.
    """

    value: float | bool | str
    unit: str = ""


class InvalidValueError(AmpStudioError, ValueError):
    """A value that cannot be read; the text is one clear sentence."""


def plain(text: str) -> str:
    """Return a text as texts are compared: without regard to case and to the number of blanks."""
    return " ".join(text.casefold().split())
