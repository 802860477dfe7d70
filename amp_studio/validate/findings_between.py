"""Findings that a changed file has and did not have before."""

from __future__ import annotations

from collections.abc import Iterable

from .finding import NOT_SET, Finding


def new_findings(before: Iterable[Finding], after: Iterable[Finding]) -> list[Finding]:
    """Return the findings that were not there before, or were less severe;
    of the same rule for the same instance they are one.
    """
    known = {(f.key, f.severity) for f in before}
    # Values that are not given are a state of the file and no fault of a change.
    return [f for f in after if f.rule != NOT_SET and (f.key, f.severity) not in known]
