"""What validation says: one finding a sentence, with the parameters it is about and a repair."""

from __future__ import annotations

from dataclasses import dataclass

from amp_studio.schema import Address, Value
from amp_studio.schema.model import Severity

SEVERITIES: tuple[Severity, ...] = ("error", "warning", "advice")


@dataclass(frozen=True, slots=True)
class Setting:
    """One value of one parameter."""

    address: Address
    value: Value


@dataclass(frozen=True, slots=True)
class Finding:
    """Something wrong, doubtful or better done otherwise."""

    rule: str
    severity: Severity
    addresses: tuple[Address, ...]
    message: str
    repairs: tuple[Setting, ...] = ()
    page: str | None = None
    safe: bool = False
    """Its repair cannot change motion."""
    effective: tuple[Setting, ...] = ()
    """What the control really uses instead of the values in the file."""
