"""A file on its way from one content to another, value by value: what each value newly breaks.

A person who keys values in at a control may be interrupted after each of them;
these are the states in between.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from dataclasses import dataclass

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value

from .builder_rules import NO_RULES, BuilderRules, sort_out
from .checks import Checks
from .finding import Finding
from .plan import FindingPlace, make_plan

_SHOWN = ("error", "warning")


@dataclass(frozen=True)
class NewValue:
    """One value that is to be set."""

    address: Address
    value: Value | None


class Interim:
    """A copy of a file, and the errors and warnings that it has at present by their keys."""

    def __init__(self, file: ParameterFile, own: BuilderRules = NO_RULES) -> None:
        self.file = file.copy()
        self._own = own
        self._check_all()

    @property
    def broken(self) -> dict[Hashable, Finding]:
        """Return the present errors and warnings; those that the builder suppresses are none."""
        kept, _, _ = sort_out(tuple(self._filed.values()), self._own.suppressions, self.file.evaluation)
        return {finding.key: finding for finding in kept}

    def set(self, step: NewValue) -> dict[Hashable, Finding]:
        """Set a value and return the errors and warnings that come up with it."""
        before = {finding.key for finding in self._filed.values()}
        self.file.set(step.address, step.value)
        if not self._checks.fit:  # another machine type has other checks
            self.file.evaluation.forget()
            self._check_all()
            return {key: finding for key, finding in self.broken.items() if key not in before}
        new = self._recheck(step.address)
        kept, _, _ = sort_out(tuple(new), self._own.suppressions, self.file.evaluation)
        return {finding.key: finding for finding in kept if finding.key not in before}

    def effort(self, address: Address) -> int:
        """Return how many values and rules are asked again when a value changes."""
        return len(self._plan.range_readers.get(address, ())) + len(self._plan.rule_readers.get(address, ()))

    def checks_of(self, address: Address) -> frozenset[FindingPlace]:
        """Return the checks that can come to something else when a value changes."""
        return self._plan.asked_by((address,))

    def _check_all(self) -> None:
        self._plan = make_plan(self.file.schema, self.file.machine, self._own.rules)
        self._checks = Checks(self.file, self._own.places)
        self._checks.forget_values()
        self._filed: dict[FindingPlace, Finding] = dict(_of_weight(self._checks.of_all(self._plan)))

    def _recheck(self, address: Address) -> list[Finding]:
        """Ask again what reads an address; return what is found there."""
        self._checks.forget_values()
        values = self._plan.range_readers.get(address, frozenset())
        rules = self._plan.rule_readers.get(address, ())
        for address_read in values:
            self._filed.pop(address_read, None)
        for check in rules:
            self._filed.pop(check.place, None)
        found = [(a, finding) for a in values if (finding := self._checks.of_value(a)) is not None]
        found_rules = ((check.place, finding) for check, finding in self._checks.rules.findings(rules))
        now = dict(_of_weight((*found, *found_rules)))
        self._filed |= now
        return list(now.values())


def _of_weight(found: Iterable[tuple[FindingPlace, Finding]]) -> Iterable[tuple[FindingPlace, Finding]]:
    return (pair for pair in found if pair[1].severity in _SHOWN)
