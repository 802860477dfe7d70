"""Parameters that belong together: equal as a rule, rising by one factor, or below a greatest speed."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from itertools import chain

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Quotient, canonical, unit_text, write_figure
from amp_studio.validate.finding import Finding

from .active_value import ActiveValue, ActiveValues, sentence
from .axis_columns import AxisColumns
from .axis_relations import AxisRelations, Check
from .slip import slip_between

UNEQUAL, LADDER, ABOVE = "plausible.unequal", "plausible.ladder", "plausible.above-rapid"
QUOTIENT, NEEDS = "plausible.quotient", "plausible.needs"
_EQUAL_REASON = (
    "ours, not the manual's: these are equal as a rule, and a slip parts them more often than a wish"
)
_LADDER_REASON = "ours, not the manual's: steps of speeds and increments rise by one factor as a rule"
_ABOVE_REASON = "ours, not the manual's: homing and jogging are slower than a rapid move as a rule"
_QUOTIENT_REASON = "ours, not the manual's: on most machines these two are nearer to each other"
_NEEDS_REASON = "ours, not the manual's: the one does nothing without the other"
_TWICE = (2.0, 0.5)
_AGREE = 1.3
"""Factors of a ladder that are one up to this."""
_OFF = 1.9
"""Times the factor of the rest from which a value does not belong in its ladder."""


class Relations:
    """What belongs together in one file, as the facts of its family name it."""

    def __init__(self, file: ParameterFile) -> None:
        self._file = file
        self._values = ActiveValues(file)
        self._checks: list[Callable[[], list[Finding]]] = []
        self._of: dict[str, list[int]] = {}
        """Parameter -> the checks that read it."""
        parts = (AxisRelations(file, self._values), AxisColumns(file, self._values))
        for names, check in chain(self._own_checks(), *(part.checks() for part in parts)):
            self._add(names, check)
        self._findings: list[list[Finding]] = [[] for _ in self._checks]

    def _own_checks(self) -> Iterator[Check]:
        """Yield each check of this module with the parameters that it reads."""
        facts = self._file.schema.plausible
        for names in facts.same:
            yield names, partial(self._same, names)
        for pair in facts.twins:
            where = [facts.twins_where.param] if facts.twins_where else []
            yield (*pair, *where), partial(self._twins, pair)
        for names in facts.ladders:
            yield names, partial(self._ladder, names)
        for quotient in facts.quotients:
            yield (quotient.of, quotient.over), partial(self._quotient, quotient)
        for pair in facts.needs.items():
            yield pair, partial(self._needs, pair)
        for one in facts.not_above:
            yield (one.limit, *one.are), partial(self._above, one.limit, one.are)

    def _add(self, names: Sequence[str], check: Callable[[], list[Finding]]) -> None:
        for name in names:
            self._of.setdefault(name, []).append(len(self._checks))
        self._checks.append(check)

    def check_all(self) -> None:
        """Make every check."""
        self._values.clear()
        self._findings = [check() for check in self._checks]

    def recheck(self, address: Address) -> bool:
        """Make the checks of one value again; returns whether anything is otherwise."""
        is_other = False
        self._values.clear()
        for n in self._of.get(address[0], ()):
            found = self._checks[n]()
            is_other |= found != self._findings[n]
            self._findings[n] = found
        return is_other

    def findings(self) -> Iterator[Finding]:
        """Yield what was found."""
        for found in self._findings:
            yield from found

    def _rows(self, names: Sequence[str]) -> Iterator[list[ActiveValue]]:
        """Yield the values of one instance that measure the same."""
        columns = [self._values[name] for name in names]
        for instance in columns[0]:
            row = [column[instance] for column in columns if instance in column]
            if len({one.measures for one in row}) == 1:
                yield row

    def _same(self, names: Sequence[str]) -> list[Finding]:
        return [finding for row in self._rows(names) if (finding := self._outlier_of_row(row))]

    def _outlier_of_row(self, row: Sequence[ActiveValue]) -> Finding | None:
        """Return the finding about the one value that differs from all others, or about two by a slip."""
        counts = Counter(one.number for one in row)
        # Of three or more the one that differs is odd; of two it may be either, unless a slip explains
        # it.
        if len(row) > 2 and sorted(counts.values()) == [1, len(row) - 1]:
            alone = next(one for one in row if counts[one.number] == 1)
            return self._unequal([alone], next(one for one in row if one is not alone))
        if len(row) == 2 and _is_slip(row[0].number, row[1].number):
            return self._unequal(row, None)
        return None

    def _twins(self, pair: tuple[str, str]) -> list[Finding]:
        """Find unequal instances of two parameters, on machines whose text begins as the facts have it."""
        where = self._file.schema.plausible.twins_where
        if where is not None:
            texts = [str(one.number) for one in self._values[where.param].values()]
            if not any(text.lower().startswith(where.begins) for text in texts):
                return []
        left, right = (list(self._values[name].values()) for name in pair)
        if len(left) != len(right):
            return []
        return [
            self._unequal([a, b], None)
            for a, b in zip(left, right, strict=True)
            if a.measures == b.measures and a.number != b.number
        ]

    def _ladder(self, names: Sequence[str]) -> list[Finding]:
        """Find the step of each ladder that has not the factor of the others, or leads back."""
        found = []
        for row in self._rows(names):
            numbers = [one.number for one in row if isinstance(one.number, float) and one.number > 0]
            # A ladder with a step that is not set, or 0, has a gap, over which no factor is known.
            if len(numbers) != len(names):
                continue
            if (n := misfit(numbers)) is not None:
                found.append(self._out_of_ladder(row, n))
            elif (n := not_rising(numbers)) is not None:
                found.append(self._not_rising(row, n))
        return found

    def _above(self, limit: str, names: Sequence[str]) -> list[Finding]:
        """Find values that are greater than the limit of their axis, or than the greatest of all."""
        limits, found = self._values[limit], []
        for one in (one for name in names for one in self._values[name].values()):
            own = limits.get(one.address[1])
            # A value of the whole machine is compared with its fastest axis.
            all_of = [own] if own is not None else list(limits.values())
            greatest = [each for each in all_of if each.measures == one.measures]
            if not greatest or isinstance(one.number, bool | str):
                continue
            most = max(greatest, key=lambda each: float(each.number))
            # A rapid of 0 is no speed to compare with.
            if 0 < float(most.number) < abs(one.number):
                found.append(self._too_fast(one, most))
        return found

    def _quotient(self, fact: Quotient) -> list[Finding]:
        """Find values that are out of proportion to each of those that they are divided by."""
        found, others = [], self._values[fact.over]
        (low, high), places = fact.between, self._file.schema.on(self._file.machine).places
        for instance, one in self._values[fact.of].items():
            if instance not in others and (fact.over, instance) in places:
                continue  # its own is not set: that of another axis is no measure
            own = [others[instance]] if instance in others else others.values()
            divisors = [other for other in own if _divides(other, one)]
            if not divisors or not isinstance(one.number, float) or not one.number:
                continue
            other = max(divisors, key=_magnitude)
            if not any(
                low * _magnitude(each) <= abs(one.number) <= high * _magnitude(each) for each in divisors
            ):
                bounds = (low * _magnitude(other), high * _magnitude(other))
                found.append(self._out_of_proportion(one, other, bounds))
        return found

    def _needs(self, pair: tuple[str, str]) -> list[Finding]:
        """Find values without effect, because the one that they need is active and not set."""
        name, needed = pair
        values, evaluation = self._file.values, self._file.evaluation
        here = self._file.schema.on(self._file.machine)
        return [
            Finding(
                NEEDS,
                "advice",
                (one.address,),
                f"{sentence(self._file, one)}, and {here.label((needed, instance))} is not set. Is it meant?",
                compared=((needed, instance),),
                reason=_NEEDS_REASON,
            )
            for instance, one in self._values[name].items()
            if (needed, instance) not in values and evaluation.state((needed, instance)).is_active
        ]

    def _unequal(self, causes: Sequence[ActiveValue], other: ActiveValue | None) -> Finding:
        text = partial(sentence, self._file)
        texts = " and ".join(map(text, (*causes, *([other] if other else []))))
        message = f"{texts}; as a rule they are equal. Is it meant?"
        compared = (other.address,) if other else ()
        addresses = tuple(one.address for one in causes)
        return Finding(UNEQUAL, "advice", addresses, message, compared=compared, reason=_EQUAL_REASON)

    def _out_of_ladder(self, row: Sequence[ActiveValue], n: int) -> Finding:
        beside = [row[m] for m in (n - 1, n + 1) if 0 <= m < len(row)]
        texts = " and ".join(sentence(self._file, one) for one in beside)
        message = (
            f"{sentence(self._file, row[n])} beside {texts}: the others rise by one factor. Is it meant?"
        )
        compared = tuple(one.address for one in beside)
        return Finding(LADDER, "advice", (row[n].address,), message, compared=compared, reason=_LADDER_REASON)

    def _not_rising(self, row: Sequence[ActiveValue], n: int) -> Finding:
        """Return the finding about a step of a ladder that leads back."""
        before = row[n - 1]
        both = f"{sentence(self._file, row[n])}, and {sentence(self._file, before)}"
        message = f"{both}: the steps go one way as a rule"
        compared = (before.address,)
        return Finding(
            LADDER,
            "advice",
            (row[n].address,),
            f"{message}. Is it meant?",
            compared=compared,
            reason=_LADDER_REASON,
        )

    def _out_of_proportion(self, one: ActiveValue, other: ActiveValue, usual: tuple[float, float]) -> Finding:
        """Return the finding about a quotient, with what is usual in the unit of the value."""
        unit = self._file.values[one.address].unit
        low, high = (write_figure(float(f"{bound / canonical(1.0, unit):.2g}")) for bound in usual)
        both = f"{sentence(self._file, one)}, and {sentence(self._file, other)}"
        message = f"{both}: beside it usual is {low} to {high} {unit_text(unit)}".rstrip()
        return Finding(
            QUOTIENT,
            "advice",
            (one.address, other.address),
            f"{message}. Is it meant?",
            reason=_QUOTIENT_REASON,
        )

    def _too_fast(self, one: ActiveValue, most: ActiveValue) -> Finding:
        both = f"{sentence(self._file, one)}, and {sentence(self._file, most)}"
        message = f"{both}: it is faster than a rapid move. Is it meant?"
        return Finding(
            ABOVE, "advice", (one.address,), message, compared=(most.address,), reason=_ABOVE_REASON
        )


def not_rising(numbers: Sequence[float]) -> int | None:
    """Return the place of the first value that is not above the one before it, or not below it in a ladder
    that leads down.
    """
    up = 1 if numbers[-1] > numbers[0] else -1
    return next((n for n in range(1, len(numbers)) if up * numbers[n] <= up * numbers[n - 1]), None)


def _is_slip(a: float | str | bool, b: float | str | bool) -> bool:
    """Return whether one of two became the other by a slip, or was doubled."""
    if isinstance(a, bool | str) or isinstance(b, bool | str):
        return a != b
    if a != b and b and any(abs(a / b - factor) < 1e-9 for factor in _TWICE):
        return True
    return bool(slip_between(a, b) or slip_between(b, a))


def _divides(other: ActiveValue, one: ActiveValue) -> bool:
    """Return whether a value is a number above 0, linear or angular as the one that it divides."""
    is_angular = [each.measures.startswith("angular") for each in (other, one)]
    return isinstance(other.number, float) and bool(other.number) and is_angular[0] == is_angular[1]


def _magnitude(one: ActiveValue) -> float:
    return abs(float(one.number))


def misfit(numbers: Sequence[float]) -> int | None:
    """Return the place of the one value that does not rise by the factor of the others.

    Without it every step must be nearly of one factor. The first and the last may be lower: a ladder of
    speeds often begins with a creep speed and ends at the greatest speed of the axis.
    """
    last = len(numbers) - 1
    for n in range(len(numbers)):
        usual = _factor_without(n, numbers)
        # Without the slip itself the others must make a ladder: only then is it known which one is odd.
        if usual is None:
            continue
        wanted = numbers[n - 1] * usual if n else numbers[1] / usual
        ratio = numbers[n] / wanted
        if ratio >= _OFF or (ratio <= 1 / _OFF and 0 < n < last):
            return n
    return None


def _factor_without(n: int, numbers: Sequence[float]) -> float | None:
    """Return the factor by which numbers rise without the ``n``-th; None where they do not by one."""
    last = len(numbers) - 1
    steps = [numbers[m + 1] / numbers[m] for m in range(last) if n not in (m, m + 1)]
    if len(steps) < 2 or max(steps) > _AGREE * min(steps) or min(steps) <= 1:
        return None
    # The geometric mean: factors multiply.
    usual = (max(steps) * min(steps)) ** 0.5
    # Over the gap that the value leaves, two steps have to fit.
    across = numbers[n + 1] / numbers[n - 1] if 0 < n < last else usual**2
    return usual if usual**2 / _AGREE <= across <= usual**2 * _AGREE else None
