"""The part of a range that the rules allow for one value, all others as they are."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value

from .checks import Checks
from .plan import FindingPlace, Plan

_SAMPLES = 12
_HALVINGS, _NEAR = 32, 1e-4
"""Most halvings of a part between two samples, and how near its ends come:
then the shortest number between them is tried."""


class AllowedByRules:
    """Finds the part of a range that breaks no rule. Takes a copy of the file when it is made,
    so it may run in another thread.
    """

    def __init__(
        self, file: ParameterFile, plan: Plan, places: Mapping[str, str], address: Address, unit: str
    ) -> None:
        self._file, self._address, self._unit = file.copy(), address, unit
        self._checks = Checks(self._file, places)
        readers = plan.rule_readers.get(address, ())
        self._rules = [check for check in readers if check.rule.severity != "advice"]
        self._is_whole = file.schema.parameters[address[0]].type == "integer"
        self._tried: dict[float, frozenset[FindingPlace]] = {}

    def around(self, low: float, high: float, near: Iterable[float]) -> tuple[float, float] | None:
        """Return the ends of the part of ``low`` to ``high`` around the first of ``near``
        that breaks no rule, or None.

        Rules that only recommend do not count, nor those that this value alone cannot meet. The range is
        sampled: a gap in that part that is narrower than a twelfth of the range may not be seen.
        """
        if not self._rules:
            return low, high
        steps = (low + (high - low) * n / _SAMPLES for n in range(_SAMPLES + 1))
        wanted = _within(near, low, high)
        try:
            points = sorted({self._value(x) for x in (*steps, *wanted)})
            # What is broken at every sample has another value to blame: counted, it would leave no part
            # at all.
            impossible = frozenset.intersection(*map(self._broken, points))
        except ValueError:  # a number that this parameter cannot have
            return None
        good = {x for x in points if not self._broken(x) - impossible}
        # A value that makes another machine type of the file has other checks than these.
        if not good or not self._checks.fit:
            return None
        first = next(map(self._value, wanted), points[0])
        start = min(good, key=lambda x: abs(x - first))
        place = points.index(start)
        return (
            self._end(list(reversed(points[:place])), start, good, impossible),
            self._end(points[place + 1 :], start, good, impossible),
        )

    def _end(
        self, points: list[float], start: float, good: set[float], impossible: frozenset[FindingPlace]
    ) -> float:
        """Return where the good values end on one side of a good one."""
        inside = start
        for outside in points:
            if outside not in good:
                return self._between(inside, outside, impossible)
            inside = outside
        return inside

    def _between(self, inside: float, outside: float, impossible: frozenset[FindingPlace]) -> float:
        """Return the last allowed value between an allowed one and one that is not: a short number, if there
        is one.
        """
        for _ in range(_HALVINGS):
            middle = self._value((inside + outside) / 2)
            # Neighbouring whole numbers or doubles: nothing lies between them.
            if middle in (inside, outside):
                return inside
            if abs(inside - outside) <= _NEAR * max(abs(inside), abs(outside)):
                break
            inside, outside = (middle, outside) if not self._broken(middle) - impossible else (inside, middle)
        # A bound of three digits is read at a glance; the sixteen digits of a halving are noise.
        middle = self._value(_shortest(inside, outside))
        return middle if not self._broken(middle) - impossible else inside

    def _value(self, x: float) -> float:
        return round(x) if self._is_whole else x

    def _broken(self, x: float) -> frozenset[FindingPlace]:
        if x not in self._tried:
            self._file.set(self._address, Value(x, self._unit))
            self._checks.forget_values()
            self._tried[x] = frozenset(c.place for c in self._rules if self._checks.rules.is_broken(c))
        return self._tried[x]


def _shortest(one: float, other: float) -> float:
    """Return the number with the fewest decimals between two."""
    low, high = sorted((one, other))
    tried = (round((low + high) / 2, digits) for digits in range(-6, 12))
    return next((x for x in tried if low <= x <= high), one)


def _within(numbers: Iterable[float], low: float, high: float) -> list[float]:
    return [x for x in numbers if low <= x <= high]
