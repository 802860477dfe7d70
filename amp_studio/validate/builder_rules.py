"""What a machine builder's own rules mean: his constraints, and the findings that he leaves as they are."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple

from amp_studio.schema import Address, Evaluation, Rule, Suppression, resolve_addresses

from .finding import Finding

LONGEST_TEXT = 4000
"""Characters of a text that a builder's rule sees; it does not run where there is a longer one."""


@dataclass(frozen=True)
class BuilderRules:
    """What a file of a builder's rules means for files of one family."""

    rules: tuple[Rule, ...] = ()
    suppressions: tuple[Suppression, ...] = ()
    faults: tuple[Finding, ...] = ()
    """What is wrong with the rules themselves."""
    places: Mapping[str, str] = field(default_factory=dict)
    """Id of a rule -> file and line of it."""
    costs: Mapping[str, int] = field(default_factory=dict)
    """Id of a rule -> the steps it takes at most, each time."""


NO_RULES = BuilderRules()


class Suppressed(NamedTuple):
    """A finding that is left as it is, and who decided that."""

    finding: Finding
    suppression: Suppression


def sort_out(
    findings: tuple[Finding, ...], suppressions: tuple[Suppression, ...], evaluation: Evaluation
) -> tuple[tuple[Finding, ...], tuple[Suppressed, ...], tuple[Suppression, ...]]:
    """Return the findings that stay, those that are suppressed,
    and the suppressions that meet nothing any more.
    """
    by_rule: dict[str, list[tuple[Suppression, list[set[Address]]]]] = {}
    for s in suppressions:
        # Looked up once here, not once for each finding of the rule.
        addresses = [_addresses_of(evaluation, text) for text in s.params]
        by_rule.setdefault(s.rule, []).append((s, addresses))
    stay: list[Finding] = []
    left: list[Suppressed] = []
    for finding in findings:
        by = _suppression_of(finding, by_rule.get(finding.rule, ()))
        if by is None:
            stay.append(finding)
        else:
            left.append(Suppressed(finding, by))
    # By identity: of two equal entries the second one meets nothing, and is reported.
    used = {id(suppressed.suppression) for suppressed in left}
    return tuple(stay), tuple(left), tuple(s for s in suppressions if id(s) not in used)


def _suppression_of(
    finding: Finding, suppressions: Iterable[tuple[Suppression, list[set[Address]]]]
) -> Suppression | None:
    """Return the first suppression each of whose parameters the finding is about."""
    for suppression, every in suppressions:
        # Each one that is named: what was decided for a pair of values is not decided for one of them
        # beside a third.
        if not any(named.isdisjoint(finding.addresses) for named in every):
            return suppression
    return None


def _addresses_of(evaluation: Evaluation, text: str) -> set[Address]:
    """Return what a suppression means by a number or an id; nothing where this machine does not have it."""
    try:
        return set(resolve_addresses(evaluation, text))
    except LookupError:
        return set()
