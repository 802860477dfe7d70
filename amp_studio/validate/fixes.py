"""Fixes of many findings, one after the other."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from amp_studio.files import Change
from amp_studio.schema import Address

from .finding import Finding
from .validator import Validator

_MAX_FIXES = 100_000
"""Fixes at once. Each leaves fewer or lesser findings, so they end by themselves long before."""


@dataclass(frozen=True, slots=True)
class Fixed:
    """A value that a fix replaced, and the rule whose fix it was."""

    change: Change
    rule: str


def apply_fixes(
    validator: Validator, wanted: Callable[[Finding], bool], *, even_doubtful: bool = False
) -> list[Fixed]:
    """Apply the fixes of the findings that are ``wanted``, until no such fix is offered;
    returns what was changed.

    The most severe finding comes first, then the manual's order; each fix is offered in the light of those
    before it. ``even_doubtful`` is for fixes that a user chose: one whose cause is likely another value is
    not made together with all others. The findings are up to date before and after.
    """
    done: list[Fixed] = []
    for _ in range(_MAX_FIXES):
        finding = validator.first_fix(wanted, even_doubtful=even_doubtful)
        if finding is None:
            break
        changes = validator.file.set_checked({setting.address: setting.value for setting in finding.fix})
        done += [Fixed(change, finding.rule) for change in changes]
        # Not ``update``: sorted findings with tried fixes are needed once, at the end.
        validator.recheck([change.address for change in changes])
    validator.findings()  # what is suppressed, too
    return done


def apply_all_safe(validator: Validator) -> dict[Address, None]:
    """Apply every fix that cannot change motion, until there is none; returns the addresses that were set."""
    return dict.fromkeys(fixed.change.address for fixed in apply_fixes(validator, lambda f: f.safe))
