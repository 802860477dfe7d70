"""A finding as it is printed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from amp_studio.schema import Address, Severity

PrintedSeverity = Severity | Literal["suppressed"]


@dataclass(frozen=True, slots=True)
class PrintedFinding:
    """One finding, or several equal ones about different axes."""

    severity: PrintedSeverity
    count: int
    place: str
    """``Axis 1 X, 2 Y``; empty for a finding about many values."""
    about: tuple[tuple[str, str], ...]
    """(anchor, label) of its values; the anchor is empty for a value that the report does not print."""
    message: str
    fix: str
    page: str
    rule: str = ""
    addresses: tuple[Address, ...] = ()
    """All values that it is about."""
    changes: tuple[tuple[Address, float | bool | str | None, str], ...] = ()
    """What its fix sets: address, new value as data (None for a secret) and its unit."""
    is_own: bool = False
    """Whether ``page`` is a source in words: the place in a builder's rules file,
    or why a rule is so that no manual states."""

    @property
    def cited(self) -> str:
        """The source in words: ``page 7-20``."""
        return self.page if self.is_own else f"page {self.page}"
