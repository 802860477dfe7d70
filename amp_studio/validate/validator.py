"""Findings of one file, kept up to date edit by edit."""

from __future__ import annotations

from collections.abc import Callable, Collection, Hashable, Iterable, Iterator, Sequence
from dataclasses import replace

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Context, Rule

from .allowed import AllowedByRules
from .builder_rules import NO_RULES, BuilderRules, Suppressed, sort_out
from .checks import Checks
from .finding import NOT_SET, SEVERITIES, Finding
from .plan import FindingPlace, Plan, RuleCheck, make_plan
from .plausible import OF_A_SLIP, Earlier, Experience
from .trial import Trials

_Order = tuple[int, int, str, int]
"""Severity, place of the first cause in the manual, rule, and place among the checks."""


class Validator:
    """Checks ranges, choices, states and rules of one file.

    ``run`` checks everything, ``update`` only what read the changed addresses;
    both leave the same findings. Asked for findings of values that it has not seen yet, it runs by itself.
    Any value whatever may be in the file.
    ``own`` are a machine builder's rules; ``earlier`` is what the file was, and what others like it are.
    """

    def __init__(
        self, file: ParameterFile, own: BuilderRules = NO_RULES, earlier: Sequence[Earlier] = ()
    ) -> None:
        self.file = file
        self.own = own
        self.earlier = earlier
        self.suppressed: tuple[Suppressed, ...] = ()
        """Findings that the builder leaves as they are."""
        self._circumstances: tuple[str, str, str] | None = None
        """Machine type, model and unit system of the present findings."""
        self._revision: int | None = None
        """The revision of the file that they are of; None before the first run."""
        self._not_set: set[Address] = set()
        self._not_set_findings: list[tuple[_Order, Finding]] | None = None
        """What is reported about them, until they change."""
        self._filed: dict[FindingPlace, tuple[_Order, Finding]] = {}
        self._checks_of: dict[Hashable, RuleCheck] | None = None
        """Key of a finding -> the check it is of, until the findings change."""
        self._prepare()

    def _prepare(self) -> None:
        self._plan: Plan = make_plan(self.file.schema, self.file.machine, self.own.rules)
        self._about: dict[Address, tuple[RuleCheck, ...]] = {}
        self._checks = Checks(self.file, self.own.places)
        self._trials = Trials(self.file, self._plan, self.own)
        self._experience = Experience(self.file, self.earlier)

    def run(self) -> tuple[Finding, ...]:
        """Check everything; returns the findings, errors first, in the manual's order."""
        self._file_all()
        return self.findings()

    def _file_all(self) -> None:
        """Check everything, without a trial of any fix."""
        if not self._checks.fit:
            self.file.evaluation.forget()  # conditions may name the model of the control
            self._prepare()
        self._trials = Trials(self.file, self._plan, self.own)  # of a file in which anything may have changed
        self._circumstances = self._present_circumstances()
        self._revision = self.file.revision
        self._checks.forget_values()
        self._experience.mark_stale()
        self._checks_of = None
        self._not_set = self._all_not_set()
        self._not_set_findings = None
        self._filed = {
            place: (self._order(finding, place if isinstance(place, int) else -1), finding)
            for place, finding in self._checks.of_all(self._plan)
        }

    def update(self, changed: Iterable[Address]) -> tuple[Finding, ...]:
        """Check again what reads the changed addresses; returns all findings."""
        self.recheck(changed)
        return self.findings()

    def recheck(self, changed: Iterable[Address]) -> None:
        """Check again what reads the changed addresses;
        whether a fix is still good is tried when it is asked for.
        """
        if self._circumstances != self._present_circumstances():
            self._file_all()
            return
        self._revision = self.file.revision
        edited = list(changed)
        addresses: set[Address] = set()
        checks: dict[int, RuleCheck] = {}
        for address in edited:
            addresses |= self._plan.range_readers.get(address, frozenset())
            for check in self._plan.rule_readers.get(address, ()):
                # By place: several edits of one step read the same checks, and each runs once.
                checks[check.place] = check
        self._check(edited, addresses, checks.values())
        self._experience.recheck(edited)
        self._trials.follow_edits(edited, (*addresses, *checks))

    def first_fix(self, wanted: Callable[[Finding], bool], *, even_doubtful: bool = False) -> Finding | None:
        """Return the first of the present ``findings`` that is ``wanted`` and has a fix;
        later fixes are not tried.

        One whose fix brings a warning is returned only where no other one is left. One whose cause is likely
        another value, which is wrong by itself or by a slip, has a doubtful fix: none that was not asked for.
        """
        too_many = self._trials.too_many(self._filed)
        fixable = [
            (order, place, finding)
            for place, (order, finding) in self._filed.items()
            if finding.fix and place not in too_many and wanted(finding)
        ]
        fixable.sort(key=lambda filed: filed[0])
        left_alone = self._left_alone(fixable)
        last, doubted = None, frozenset() if even_doubtful or not fixable else self._doubted()
        for _, place, finding in fixable:
            if id(finding) in left_alone or (
                not even_doubtful and self._trials.is_doubtful(finding, doubted)
            ):
                continue
            offered = self._trials.offered(place, finding, self._filed)
            if not offered.fix:
                continue
            # A fix that brings a warning is the last resort.
            if not offered.brings:
                return finding
            last = last or finding
        return last

    def _left_alone(self, filed: Iterable[tuple[object, FindingPlace, Finding]]) -> set[int]:
        """Return the ``id`` of findings that are suppressed."""
        findings = tuple(finding for _, _, finding in filed)
        suppressed = sort_out(findings, self.own.suppressions, self.file.evaluation)[1]
        return {id(one.finding) for one in suppressed}

    def compare_with(self, earlier: Sequence[Earlier]) -> None:
        """Compare with other earlier values from now on, as after a save."""
        self.earlier = earlier
        self._experience.compare_with(earlier)

    def take_over(
        self, file: ParameterFile, differing: Collection[Address], earlier: Sequence[Earlier] = ()
    ) -> None:
        """Check another file of the same schema, machine type, model and units in place of the present one,
        of which all ``differing`` values are another: only what reads them is checked. The findings are those
        of a full ``run``.

        The present file takes the content of the other one; it must have no listeners.
        """
        self.file.take_over(file, differing)
        if differing:
            self.recheck(differing)
        self._revision = self.file.revision
        if earlier or self.earlier:
            self.compare_with(earlier)

    def prepare_edits(self) -> None:
        """Work out now what the first update would wait for; another thread may do so."""
        _ = self._plan.range_readers, self._plan.rule_readers

    def _present_circumstances(self) -> tuple[str, str, str]:
        header = self.file.header
        return self.file.machine, header.application, header.units

    @property
    def has_run(self) -> bool:
        """Whether the present content of the file has been checked."""
        return self._revision == self.file.revision and self._circumstances == self._present_circumstances()

    def findings(self) -> tuple[Finding, ...]:
        """Return the present findings, errors first, in the manual's order."""
        if not self.has_run:
            self._file_all()
        found = sorted((*self._offered(), *self._general()), key=lambda filed: filed[0])
        stay, self.suppressed, unused = sort_out(
            tuple(finding for _, finding in found), self.own.suppressions, self.file.evaluation
        )
        meets_nothing = (
            Finding(
                "rules.unused", "advice", (), f"The suppression of {s.rule} by {s.by} meets nothing here."
            )
            for s in unused
        )
        return (*self.own.faults, *stay, *meets_nothing)

    def needed(self) -> tuple[Address, ...]:
        """Return every active value without which the file is not complete, set or not."""
        return self.file.evaluation.active(self._plan.needed)

    @property
    def not_set(self) -> tuple[Address, ...]:
        """The active values that are not set, in the manual's order.

        A value for the control as a whole speaks for each of its processes.
        """
        every = {a for a in self._not_set if not a[1] or (a[0], "") not in self.file.values}
        return tuple(sorted(every, key=self._plan.order.__getitem__))

    def rules_of(self, address: Address) -> tuple[Rule, ...]:
        """Return the rules that read an address itself."""
        return tuple({check.rule.id: check.rule for check in self._checks_about(address)}.values())

    def rules_without_values(self, address: Address) -> set[str]:
        """Return which of these rules cannot be checked, since a value that they need is not there."""
        checks = self._checks_about(address)
        return {c.rule.id for c in checks} - {c.rule.id for c in checks if self._checks.rules.is_complete(c)}

    def _checks_about(self, address: Address) -> tuple[RuleCheck, ...]:
        """Return the checks that read an address itself; looked for once, the window asks with every edit."""
        if address not in self._about:
            # What an edit wakes takes all addresses at once, and the window asks before the first edit.
            is_prepared = "rule_readers" in vars(self._plan)
            among = self._plan.rule_readers.get(address, ()) if is_prepared else self._plan.checks
            self._about[address] = tuple(check for check in among if check.is_about(address))
        return self._about[address]

    def check_of(self, finding: Finding) -> RuleCheck | None:
        """Return the rule and the instance that a present finding is of; None for a range,
        a choice and the like.
        """
        if self._checks_of is None:
            places = (place for place in self._filed if isinstance(place, int))
            self._checks_of = {self._filed[place][1].key: self._plan.checks[place] for place in places}
        return self._checks_of.get(finding.key)

    def allowed(self, address: Address, unit: str) -> AllowedByRules:
        """Return what finds the values of an address, in ``unit``, that the rules allow now,
        all others as they are.
        """
        return AllowedByRules(self.file, self._plan, self.own.places, address, unit)

    def context_of(self, check: RuleCheck) -> Context:
        """Return what the expressions of a check see."""
        return self._checks.rules.context_of(check)

    # -- filing ----------------------------------------------------------------

    def _check(
        self, edited: Iterable[Address], addresses: Iterable[Address], checks: Collection[RuleCheck]
    ) -> None:
        """File what is found about values and rules that an edit woke, in place of what was found before."""
        self._checks.forget_values(edited)
        self._checks_of = None
        for address in addresses:
            finding = self._check_address(address)
            if finding is not None:
                self._filed[address] = (self._order(finding), finding)
            else:
                self._filed.pop(address, None)
        for check in checks:
            # Rules that are satisfied now are not among the findings below.
            self._filed.pop(check.place, None)
        for check, finding in self._checks.rules.findings(checks):
            self._filed[check.place] = (self._order(finding, check.place), finding)

    def _all_not_set(self) -> set[Address]:
        values = self.file.values
        return {address for address in self.needed() if address not in values}

    def _check_address(self, address: Address) -> Finding | None:
        """Return what is wrong with a value by itself, and keep the list of those that are not set."""
        asked = (
            address not in self.file.values
            and not self.file.schema.parameters[address[0]].optional
            and self.file.evaluation.state(address).is_active
        )
        if asked != (address in self._not_set):
            # Asked and listed differ, so that the address is either added or taken out.
            self._not_set ^= {address}
            self._not_set_findings = None
        return self._checks.of_value(address)

    def _offered(self) -> Iterator[tuple[_Order, Finding]]:
        """Yield what is filed, each finding with its fix only where a trial of it came out well."""
        too_many = self._trials.too_many(self._filed)
        for place, (order, finding) in self._filed.items():
            if place in too_many:
                yield order, replace(finding, fix=(), safe=False)
            else:
                yield order, self._trials.offered(place, finding, self._filed)

    def _doubted(self) -> frozenset[Address]:
        """Return the values that are wrong by themselves, or by a slip that is not suppressed."""
        asked = tuple(f for f in self._experience.findings() if f.rule in OF_A_SLIP)
        if self.own.suppressions:
            asked = sort_out(asked, self.own.suppressions, self.file.evaluation)[0]
        wrong = (place for place in self._filed if not isinstance(place, int))
        return frozenset((*wrong, *(address for finding in asked for address in finding.causes)))

    def _order(self, finding: Finding, place: int = -1) -> _Order:
        order, last = self._plan.order, len(self._plan.order)
        # Findings about the file as a whole have no cause and come before those of its first parameter.
        first = min([order.get(address, last) for address in finding.causes], default=-1)
        return SEVERITIES.index(finding.severity), first, finding.rule, place

    def _general(self) -> list[tuple[_Order, Finding]]:
        """Return the findings that are about the file as a whole."""
        found = []
        if self._not_set_findings is None:
            self._not_set_findings = [(self._order(finding), finding) for finding in self._missing_values()]
        found += self._not_set_findings
        # A value that is wrong by itself needs no question besides.
        asked = [f for f in self._experience.findings() if self._filed.keys().isdisjoint(f.causes)]
        found += [(self._order(finding), finding) for finding in asked]
        if unknown := list(self.file.unknown):
            message = (
                f"{unknown[0]} is no parameter of this schema; it is kept as it is."
                if len(unknown) == 1
                else (
                    f"{len(unknown)} entries are no parameters of this schema; they are kept as they are:"
                    f" {', '.join(unknown)}."
                )
            )
            finding = Finding("schema.unknown", "warning", (), message)
            found.append((self._order(finding), finding))
        return found

    def _missing_values(self) -> Iterator[Finding]:
        """Yield one recommendation on all values that are missing."""
        not_set = self.not_set
        if not not_set:
            return
        names = ", ".join(self.file.schema.on(self._checks.machine).label(address) for address in not_set[:4])
        more = f" and {len(not_set) - 4} more" if len(not_set) > 4 else ""
        what = "1 active parameter has" if len(not_set) == 1 else f"{len(not_set)} active parameters have"
        message = f"{what} no value here, so the control keeps its own: {names}{more}."
        yield Finding(NOT_SET, "advice", not_set, message)
