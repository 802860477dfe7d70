"""What validation finds: one finding a sentence, with the parameters it is about and a suggested fix."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

from amp_studio.schema import Address, Severity, Value

SEVERITIES: tuple[Severity, ...] = ("error", "warning", "advice")
NOT_SET = "schema.unset"
"""The rule that is about all active values that are not set."""
OWN_FAULT = "rules.unusable"
"""The rule that findings about a builder's rules themselves belong to."""


class AddressedValue(NamedTuple):
    """One value of one parameter."""

    address: Address
    value: Value


@dataclass(frozen=True, slots=True)
class Finding:
    """Something wrong, doubtful or better done otherwise."""

    rule: str
    severity: Severity
    causes: tuple[Address, ...]
    """What is wrong, worst first."""
    message: str
    fix: tuple[AddressedValue, ...] = ()
    page: str | None = None
    safe: bool = False
    """Its suggested fix cannot change motion."""
    effective: tuple[AddressedValue, ...] = ()
    """What the control really uses instead of the values in the file."""
    compared: tuple[Address, ...] = ()
    """What the causes were compared with: they need not be wrong themselves."""
    instance: str | None = None
    """The instance a rule was broken for; None where no rule was."""
    is_own: bool = False
    """It is of a builder's rule: ``page`` is where he wrote it down, not a page of the manual."""
    reason: str = ""
    """Why it is so, of a rule that no manual states: ``page`` is empty then."""
    brings: Finding | None = None
    """The warning that comes up once its suggested fix is made; such a fix is made last."""
    figures: tuple[tuple[str, str], ...] | None = None
    """Name and text of what a rule puts into its message, for its words in another language; None where the
    message is not that of a rule."""

    @property
    def addresses(self) -> tuple[Address, ...]:
        """What is wrong first, then what it was compared with."""
        return self.causes + self.compared

    @property
    def key(self) -> tuple[str, str | tuple[Address, ...]]:
        """What stays the same while it is the same finding, of other values: which are wrong may change."""
        # The figures in the message are left out: a finding stays the same while its values are edited.
        return self.rule, self.causes if self.instance is None else self.instance

    @property
    def cited(self) -> str:
        """Its source in words: ``page 7-20``, or a builder's own words; empty where he gave none."""
        if self.reason:
            return self.reason
        return f"page {self.page}" if self.page and not self.is_own else self.page or ""


def family_of_rule(rule: str) -> str:
    """Return the family whose facts a rule is of: its id begins with it."""
    return rule.partition(".")[0]


def addresses_not_set(findings: Iterable[Finding]) -> tuple[Address, ...]:
    """Return the active addresses without a value among what was found: a state of the file."""
    return tuple(address for finding in findings if finding.rule == NOT_SET for address in finding.causes)
