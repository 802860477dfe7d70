"""What a file is checked for, check by check: each value by itself, and each rule for each instance."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from amp_studio.files import ParameterFile
from amp_studio.schema import ACTIVE, Address, ValueKey

from .finding import Finding
from .plan import FindingPlace, Plan
from .ranges import ValueChecks
from .rules import RuleChecks

_WITHOUT_EFFECT = ("hidden", "ignored")
"""States in which a value has no effect."""


class Checks:
    """The checks of one file on one machine type."""

    def __init__(self, file: ParameterFile, places: Mapping[str, str]) -> None:
        """``places`` are those of a builder's rules: id -> file and line."""
        self._file = file
        self.machine, self.application = file.machine, file.header.application
        self._values = ValueChecks(file, self.machine)
        self.rules = RuleChecks(file, self.machine, places)
        """Those of rules."""

    @property
    def fit(self) -> bool:
        """Whether the file still describes the machine type and the model that these checks were made for."""
        return (self._file.machine, self._file.header.application) == (self.machine, self.application)

    def forget_values(self, changed: Iterable[Address] | None = None) -> None:
        """Forget the values, which may have changed, or those that were ``changed`` since the last round;
        called before the checks of a round.
        """
        self._values.forget_values()
        self.rules.forget_values(changed)

    def of_all(self, plan: Plan) -> Iterator[tuple[FindingPlace, Finding]]:
        """Yield all that is wrong, and where it is filed: what a full run finds."""
        file, order, evaluation = self._file, plan.order, self._file.evaluation
        keys, known = evaluation.keys, evaluation.known_states()
        seen: list[tuple[Address, ValueKey]] = []
        found: list[tuple[Address, Finding]] = []
        for address, value in file.values.items():
            if address not in order:
                continue
            state = known.get(address) or evaluation.state(address)
            # To a rule a value without effect is not set.
            seen.append((address, keys[address] if state is ACTIVE else None))
            if state is not ACTIVE and state.state in _WITHOUT_EFFECT and address not in file.forced:
                continue
            finding = self._values.finding(address, value)
            if finding is not None:
                found.append((address, finding))
        self.rules.add_keys(plan.read, seen)
        yield from sorted(found, key=lambda filed: order[filed[0]])
        for group in plan.groups:
            # No rule of the group applies without its first value: one look saves hundreds of checks.
            if group.first is None or self.rules.is_active(group.first):
                for check, finding in self.rules.findings_of(group):
                    yield check.place, finding

    def of_value(self, address: Address) -> Finding | None:
        """Return what is wrong with a value by itself; one without effect is checked only if it was
        forced.
        """
        value = self._file.values.get(address)
        if value is None:
            return None
        state = self._file.evaluation.state(address).state
        if state in _WITHOUT_EFFECT and address not in self._file.forced:
            return None
        return self._values.finding(address, value)
