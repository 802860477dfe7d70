"""The schema of a control that describes itself: made by its family from that description,
the same from the same one.

The description is data of outside: it is bounded, and no expression or path is taken from it. A file contains
it, so that it opens without the control, on this machine and on any other.
"""

from __future__ import annotations

from functools import lru_cache

from amp_studio.errors import AmpStudioError

from .catalog import Schema
from .load import family_ids
from .quoting import quoted
from .registration import load_part, registration_of


class DescriptionError(AmpStudioError, ValueError):
    """A description that no schema can be made of; one clear sentence."""


def described_schema(family: str, description: bytes) -> Schema:
    """Return the schema that a description means; raises DescriptionError."""
    if family not in family_ids() or not registration_of(family).describe:
        raise DescriptionError(f"the controls of the family {quoted(family)} do not describe themselves")
    return _described(family, description)


@lru_cache(maxsize=32)
def _described(family: str, description: bytes) -> Schema:
    found: Schema = load_part(registration_of(family).describe)(description)
    return found
