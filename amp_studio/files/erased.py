"""A control whose memory was erased: it contains what it was delivered with, and nothing of its machine."""

from __future__ import annotations

from .parameter_file import ParameterFile

_MIN_VALUES = 12
"""Values with a printed default from which it is no chance that all are at it."""


def erased_question(file: ParameterFile) -> str:
    """Return what to ask about the content of a control that is nothing but printed defaults;
    "" for any other.
    """
    known = [address for address in file.values if file.default(address) is not None]
    if len(known) < _MIN_VALUES or not all(map(file.is_default, known)):
        return ""
    return f"all {len(known)} values with a printed default are at it: was the memory of the control erased?"
