"""What is found in a file, apart from what is as delivered (``steps_done``): one answer for verbs, window,
reports and library.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from amp_studio.validate import NOT_SET, Finding, Validator

from .steps_done import progress


class Present(NamedTuple):
    """The findings of a file, and its state."""

    findings: tuple[Finding, ...]
    delivered: tuple[Finding, ...] = ()
    """Findings about printed defaults of steps that the user has not reached: a state of the file."""
    steps: tuple[int, ...] = ()
    """The numbers of the steps in which these are to be set."""


def present(validator: Validator, findings: Sequence[Finding]) -> Present:
    """Return which of the findings of a validator, which has run, are a state:
    none in a file in which no value is missing.
    """
    if not validator.not_set or all(finding.rule == NOT_SET for finding in findings):
        return Present(tuple(findings))
    now = progress(validator, findings)
    deferred = set(map(id, now.deferred))
    return Present(tuple(f for f in findings if id(f) not in deferred), now.deferred, now.deferred_to)


def found_in(validator: Validator) -> tuple[Finding, ...]:
    """Run a validator and return the findings of its file."""
    return present(validator, validator.run()).findings
