"""A fix is tried against the whole file before it is offered.

It is offered only if with it its finding is gone and whatever comes up instead is less severe: never an
error, a warning only for an error, a recommendation for either. So each fix that is made leaves fewer
findings or lesser ones, and making one after the other comes to an end.
Values that are not given (``schema.unset``) do not count.

A fix that brings a warning has its message. One that would make a speed less than a thirtieth of itself is
not offered: then another value is wrong, and a rapid is not cut to a sixtieth for a resolution that is a
sixtieth. One that makes less than a third or more than three times of a speed or a ramp, or follows from a
value that is itself doubted, is doubtful: it is made where a user chose it, not together with all others.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import NamedTuple

from amp_studio.files import Change, HeaderSnapshot, ParameterFile, RangeError
from amp_studio.schema import Address, canonical, dimension

from .builder_rules import BuilderRules, sort_out
from .checks import Checks
from .finding import SEVERITIES, AddressedValue, Finding
from .plan import FindingPlace, Plan, RuleCheck, make_plan

MAX_STEPS = 20_000_000
"""That a builder's rules may take in all trials of a file: about a second."""
_LEAP, _CUT = 0.03, 0.3
"""The least part of a speed or ramp that a fix leaves, and that one leaves which was not asked for."""
_MOTIONS = ("velocity", "acceleration", "count rate")
_ASKED = 1000
"""Steps that it takes to ask a rule at all."""


class _Tried(NamedTuple):
    """What came of a trial, and the checks that would have to be another for it to come to something else.

    A good fix is good by every check that it can change, a bad one is bad by a single one,
    whatever the others say.
    """

    is_good: bool
    asked: frozenset[FindingPlace] | None
    """Besides the check of the finding itself; None if that is every check."""
    brings: Finding | None = None
    """The warning that comes up instead."""


class Trials:
    """Fixes of the findings of one file, tried on a copy of it.

    A copy, because the file itself notifies everyone who listens of its changes,
    and may just be saved by another thread.
    """

    def __init__(self, file: ParameterFile, plan: Plan, own: BuilderRules) -> None:
        self._original, self._plan, self._own = file, plan, own
        self._file: ParameterFile | None = None
        """The copy; made for the first trial."""
        self._checks: Checks
        self._tried: dict[FindingPlace, _Tried] = {}

    def follow_edits(self, addresses: Iterable[Address], asked: Iterable[FindingPlace]) -> None:
        """Take over values that changed, and forget the trials
        that the checks ``asked`` again have a part in.
        """
        if self._file is not None:
            for address in addresses:
                self._file.set(address, self._original.values.get(address))
                # The mark of a forced value is taken over too: without it a trial would find the value out
                # of range.
                self._file.forced.pop(address, None)
                if address in self._original.forced:
                    self._file.forced[address] = self._original.forced[address]
        if self._tried:
            again = frozenset(asked)
            for place, tried in tuple(self._tried.items()):
                if place in again or tried.asked is None or not again.isdisjoint(tried.asked):
                    del self._tried[place]

    def offered(
        self, place: FindingPlace, finding: Finding, filed: Mapping[FindingPlace, tuple[object, Finding]]
    ) -> Finding:
        """Return a finding of those that are ``filed`` with its fix, or without if that is not good."""
        if not finding.fix:
            return finding
        # Before it is tried: no rule would be against it.
        if any(map(self._is_leap, finding.fix)):
            return replace(finding, fix=(), safe=False)
        tried = self._tried.get(place)
        if tried is None:
            tried = self._tried[place] = self._try(place, finding, filed)
        if not tried.is_good:
            return replace(finding, fix=(), safe=False)
        return replace(finding, brings=tried.brings, safe=False) if tried.brings else finding

    def is_doubtful(self, finding: Finding, doubted: Collection[Address]) -> bool:
        """Return whether a fix follows from a value that is ``doubted`` itself, or makes less than a third or
        more than three times of a speed or ramp that is not.
        """
        if any(setting.address in doubted for setting in finding.fix):
            return False
        return any(a in doubted for a in finding.addresses) or any(map(self._is_far, finding.fix))

    def _is_far(self, setting: AddressedValue) -> bool:
        share = self._share(setting)
        return share is not None and not _CUT <= share <= 1 / _CUT

    def _is_leap(self, setting: AddressedValue) -> bool:
        """Return whether a fix makes so little of a speed that another value must be wrong."""
        is_speed = dimension(setting.value.unit).endswith("velocity")
        return is_speed and (share := self._share(setting)) is not None and 0 < share < _LEAP

    def _share(self, setting: AddressedValue) -> float | None:
        """Return the part of a speed or a ramp that a fix leaves; None for any other value."""
        old, new = self._original.values.get(setting.address), setting.value
        if old is None or not dimension(old.unit).endswith(_MOTIONS) or not old.value:
            return None
        before = canonical(float(old.value), old.unit)
        return abs(canonical(float(new.value), new.unit) / before) if before else None

    def too_many(self, filed: Mapping[FindingPlace, tuple[object, Finding]]) -> frozenset[FindingPlace]:
        """Return the findings that have a fix too many: trying it would ask a builder's rules for too long.

        Those of the manual's rules come first, then a builder's in the order of his file.
        """
        if not self._own.rules:
            return frozenset()
        steps, beyond = 0, set()
        wanting = [place for place, (_, finding) in filed.items() if finding.fix]
        # Values by themselves first; checks of rules have numbers, the manual's lower than a builder's.
        for place in sorted(wanting, key=lambda place: (isinstance(place, int), place)):
            if steps <= MAX_STEPS:
                steps += sum(map(self._steps, self._plan.asked_by(r.address for r in filed[place][1].fix)))
            if steps > MAX_STEPS:
                beyond.add(place)
        return frozenset(beyond)

    def _steps(self, place: FindingPlace) -> int:
        """Return what a check of a builder's rule costs; those of the manual's are not counted."""
        cost = self._own.costs.get(self._check(place).rule.id) if isinstance(place, int) else None
        return 0 if cost is None else _ASKED + cost

    def _try(
        self, place: FindingPlace, finding: Finding, filed: Mapping[FindingPlace, tuple[object, Finding]]
    ) -> _Tried:
        """Make a fix on the copy, judge it, and take it back."""
        file = self._file
        if file is None:
            file = self._file = self._original.copy()
            self._checks = Checks(file, self._own.places)
        before = HeaderSnapshot.of(file)
        try:
            changes = file.set_checked({setting.address: setting.value for setting in finding.fix})
        except RangeError as error:
            asked = self._plan.asked_by(setting.address for setting in finding.fix)
            return _Tried(False, self._bad_by(finding, error.faults, asked))
        try:
            return self._judge(place, finding, filed, changes)
        finally:
            # However the trial ended, the copy is what the file is: the next trial begins with it.
            file.take_back(changes, before)

    def _judge(
        self,
        place: FindingPlace,
        finding: Finding,
        filed: Mapping[FindingPlace, tuple[object, Finding]],
        changes: list[Change],
    ) -> _Tried:
        """Return what came of a fix that has been made on the copy."""
        # The fix made another machine type of the file: the plan of checks is of the old one.
        if not self._checks.fit:
            return _Tried(self._is_good_on_another_machine(finding, filed), None)
        # Both: a type of axis takes values along that no fix names, and a value that is equal is no
        # change.
        asked = self._plan.asked_by((*(c.address for c in changes), *(s.address for s in finding.fix)))
        self._checks.forget_values()
        if self._is_found_again(place):
            return _Tried(False, self._bad_by(finding, (), asked))
        brings = None
        for other, found in self._new(asked, filed):
            if not self._are_lesser((found,), finding):
                return _Tried(False, self._bad_by(finding, (other,), asked))
            if found.severity == "warning" and brings is None:
                brings = found
        return _Tried(True, asked, brings)

    def _new(
        self, asked: Iterable[FindingPlace], filed: Mapping[FindingPlace, tuple[object, Finding]]
    ) -> Iterator[tuple[FindingPlace, Finding]]:
        """Yield what is found now and was not before; of a check that found something before, what is about
        more values.
        """
        for place in asked:
            if self._is_found_again(place):
                found = self._finding(place)
                if place not in filed or not set(filed[place][1].causes).issuperset(found.causes):
                    yield place, found

    def _bad_by(
        self, mended: Finding, places: Iterable[FindingPlace], asked: frozenset[FindingPlace]
    ) -> frozenset[FindingPlace]:
        """Return the checks that leave a fix bad while they, and that of the finding itself,
        are not asked again.

        These are all that were ``asked`` where a builder suppresses findings, since the number he gives may
        come to mean another parameter, and where the fix may make an axis turn, since further values get
        other units with it; unless nothing but the value that it sets decides that.
        """
        turning = self._original.schema.turning_parameters
        turned = len(turning) > 1 and any(setting.address[0] in turning for setting in mended.fix)
        if self._own.suppressions or turned:
            return asked
        return frozenset(places)

    def _is_found_again(self, place: FindingPlace) -> bool:
        if isinstance(place, int):
            return self._checks.rules.is_broken(self._check(place))
        return self._checks.of_value(place) is not None

    def _finding(self, place: FindingPlace) -> Finding:
        found = (
            self._checks.rules.finding(self._check(place))
            if isinstance(place, int)
            else self._checks.of_value(place)
        )
        assert found is not None
        return found

    def _check(self, place: int) -> RuleCheck:
        return self._plan.checks[place]

    def _are_lesser(self, new: Iterable[Finding], mended: Finding) -> bool:
        """Return whether new findings may be taken for the one that is mended;
        those the builder suppresses may.
        """
        assert self._file is not None
        limit, suppressions = SEVERITIES.index(mended.severity), self._own.suppressions
        bad = (found for found in new if SEVERITIES.index(found.severity) <= limit)
        return not any(sort_out((found,), suppressions, self._file.evaluation)[0] for found in bad)

    def _is_good_on_another_machine(
        self, mended: Finding, filed: Mapping[FindingPlace, tuple[object, Finding]]
    ) -> bool:
        """Judge a fix that makes another machine type of it, where other checks are asked."""
        assert self._file is not None
        checks = Checks(self._file, self._own.places)
        plan = make_plan(self._file.schema, checks.machine, self._own.rules)
        after = {finding.key: finding for _, finding in checks.of_all(plan)}
        before = {finding.key for _, finding in filed.values()}
        new = [finding for key, finding in after.items() if key not in before]
        return mended.key not in after and self._are_lesser(new, mended)
