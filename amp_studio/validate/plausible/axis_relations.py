"""Values of like axes that keep to one order of magnitude, their travels, and the gears of a spindle.

Unlike ``alike.py`` this needs no axes that agree: each fact names what motors, screws and tables of one
machine have in proportion.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from operator import itemgetter

from amp_studio.files import ParameterFile, are_alike, axis_letter
from amp_studio.schema import AmongAxes, Gears, Proportion, Towards, TravelEnds
from amp_studio.validate.finding import Finding

from .active_value import ActiveValue, ActiveValues, sentence
from .slip import slip_between

AMONG, TABLE, UPRIGHT, TRAVEL, TOWARDS, GEAR, PROPORTION = (
    "plausible.among-axes",
    "plausible.table",
    "plausible.upright",
    "plausible.travel",
    "plausible.towards",
    "plausible.gear",
    "plausible.proportion",
)
_AMONG_REASON = "ours, not the manual's: like axes of one machine seldom lie so far apart"
_TABLE_REASON = "ours, not the manual's: X and Y of a table have the same motors, screws and ramps as a rule"
_TRAVEL_REASON = "ours, not the manual's: the travels of one machine are in proportion to each other"
_UPRIGHT_REASON = (
    "ours, not the manual's: the upright axis is about as fast as the table, or slower, as a rule"
)
_TOWARDS_REASON = "ours, not the manual's: a search goes to the end of the travel at which the switch is"
_GEAR_REASON = "ours, not the manual's: every gear multiplies the speeds of one and the same motor"
_PROPORTION_REASON = "ours, not the manual's: the two pairs of ends belong to one straight line"
_NEAR, _SHARE = 8.0, 5.0
"""Times that the end at the reference point lies farther out than those of all other axes, also
in proportion to its travel, from which it is asked about."""
_SPREAD = 4.0
"""Times that the speeds of one gear are spread wider than those of every other one."""
_UPRIGHT = 3.0
"""Times that the upright axis is longer than the longer side of the table."""
_UNLIMITED = 1e6
"""Length in mm or deg from which on an axis has no ends."""
_BESIDE = 0.1
"""Part of the travel that a place is at most away from an end that it is at."""

Ends = tuple[ActiveValue, ActiveValue]
"""The end of a travel at the reference point, and the other one."""
Check = tuple[tuple[str, ...], Callable[[], list[Finding]]]


class AxisRelations:
    """What the facts of a family compare among the axes of one file."""

    def __init__(self, file: ParameterFile, values: ActiveValues) -> None:
        self._file, self._values = file, values

    def checks(self) -> Iterator[Check]:
        """Yield the parameters that a check reads, and the check."""
        facts = self._file.schema.plausible
        for among in facts.among_axes:
            yield (among.of, *((among.over,) if among.over else ())), partial(self._among, among)
        for travel in facts.travels:
            yield tuple(filter(None, (travel.low, travel.high))), partial(self._travels, travel)
        if facts.table:
            yield tuple(facts.table), partial(self._same_on_table, facts.table)
        for name, span in facts.upright.items():
            yield (name,), partial(self._beside_table, name, span)
        for one in facts.towards:
            yield (one.speed, one.place, one.low, one.high), partial(self._towards, one)
        for gears in facts.gears:
            yield (gears.low, gears.high), partial(self._gears, gears)
        for pair in facts.proportions:
            yield (*pair.part_of, *pair.as_of), partial(self._proportion, pair)

    def _among(self, fact: AmongAxes) -> list[Finding]:
        """Find the one value that is far from those of all like axes, or is 0 alone."""
        numbers = [*self._sizes(fact)]
        if fact.is_zero_odd and (found := self._zero_among(fact, [one for _, one in numbers])):
            return found
        odd = []
        for number, one in numbers:
            least, nearest = self._nearest(number, one, numbers)
            # The small part more: a quotient of exactly the bound may be rounded above it.
            if least > fact.within * (1 + 1e-9):
                odd.append((one, nearest))
        if len(numbers) > 2 and len(odd) > 1:
            return []  # each of several is far from all others: nothing is known of what is usual
        # Of two values either is far from the other: one finding names both.
        return [self._finding(AMONG, _AMONG_REASON, one, other) for one, other in odd[:1]]

    def _zero_among(self, fact: AmongAxes, others: Sequence[ActiveValue]) -> list[Finding]:
        """Find the one value that is 0 beside ``others`` that are not."""
        every = self._values[fact.of]
        if not others or len(others) != len(every) - 1:
            return []
        zero = next(one for one in every.values() if not one.number)
        is_odd = are_alike(self._file, zero.address[1], others[0].address[1])
        return [self._finding(AMONG, _AMONG_REASON, zero, others[0])] if is_odd else []

    def _nearest(
        self, number: float, one: ActiveValue, among: list[tuple[float, ActiveValue]]
    ) -> tuple[float, ActiveValue]:
        """Return the value of a like axis that is least apart from one, and how far; itself where none is."""
        like = [(_apart(number, other), seen) for other, seen in among if self._is_like(seen, one)]
        return min(like, key=itemgetter(0), default=(0.0, one))

    def _sizes(self, fact: AmongAxes) -> Iterator[tuple[float, ActiveValue]]:
        """Yield each value with its size, or with its quotient where another parameter divides it."""
        over = self._values[fact.over] if fact.over else {}
        for instance, one in self._values[fact.of].items():
            under = over[instance].number if instance in over else None if fact.over else 1.0
            if isinstance(one.number, float) and one.number and isinstance(under, float) and under:
                yield abs(one.number / under), one

    def _is_like(self, other: ActiveValue, one: ActiveValue) -> bool:
        return (
            other is not one
            and other.measures == one.measures
            and are_alike(self._file, other.address[1], one.address[1])
        )

    def _travels(self, fact: TravelEnds) -> list[Finding]:
        ends = [*self._ends(fact)]
        found = [] if fact.is_zone else self._table(ends, fact.side)
        # Of two ends either may be the odd one.
        if fact.low and len(ends) > 2:
            found += [f for n in range(len(ends)) for f in self._near(ends[n], ends[:n] + ends[n + 1 :])]
        return [*found, *self._one_sided(fact)]

    def _ends(self, fact: TravelEnds) -> Iterator[Ends]:
        """Yield the ends of each travel, the nearer one first; one end twice where it is all there is."""
        lows = self._values[fact.low] if fact.low else {}
        for instance, high in self._values[fact.high].items():
            low = lows.get(instance)
            if not isinstance(high.number, float) or (fact.low and low is None) or self._is_unlimited(high):
                continue
            if low is None:
                yield high, high
            elif isinstance(low.number, float) and low.measures == high.measures:
                near, far = sorted((low, high), key=_size)
                yield near, far

    def _one_sided(self, fact: TravelEnds) -> Iterator[Finding]:
        """Yield an axis that has one end only, or both without a limit on one side."""
        unlimited = fact.unlimited
        if not fact.low or not unlimited:
            return
        lows, highs = self._values[fact.low], self._values[fact.high]
        for low, high in ((lows[i], highs[i]) for i in highs if i in lows):
            none = [self._is_beyond(unlimited, one) for one in (low, high)]
            # Both far out, one on each side, are switched off on purpose.
            if any(none) and not (all(none) and _side(low) < 0 < _side(high)):
                odd, other = (high, low) if none[0] else (low, high)
                yield self._finding(TRAVEL, _TRAVEL_REASON, odd, other)

    def _is_beyond(self, unlimited: float, end: ActiveValue) -> bool:
        """Return whether an end is so far out that it is no limit."""
        number = self._file.values[end.address].value
        return isinstance(number, int | float) and abs(number) >= unlimited

    def _is_unlimited(self, end: ActiveValue) -> bool:
        """Return whether an end is the printed default: no limit, as a rule."""
        default = self._file.schema.parameters[end.address[0]].default
        return default is not None and self._file.values[end.address].value == default.value

    def _near(self, own: Ends, others: Sequence[Ends]) -> list[Finding]:
        """Compare the end at the reference point with those of the other axes."""
        near = own[0]
        like = [pair for pair in others if are_alike(self._file, pair[0].address[1], near.address[1])]
        if len(like) < 2 or any(pair[0].measures != near.measures for pair in like):
            return []
        if _is_on_one_side(own, like) or _is_far_out(own, like):
            return [self._finding(TRAVEL, _TRAVEL_REASON, near, like[0][0])]
        return []

    def _table(self, ends: Sequence[Ends], most: float) -> list[Finding]:
        """Compare the lengths of the travels of X and Y, of which one is ``most`` times the other at most."""
        named: dict[str, tuple[float, ActiveValue]] = {}
        for near, far in ends:
            length = _size(far) if near is far else abs(float(far.number) - float(near.number))
            named.setdefault(axis_letter(self._file, far.address[1]), (length, far))
        x, y = named.get("X"), named.get("Y")
        if x is None or y is None or not x[0] or not y[0] or x[1].measures != y[1].measures:
            return []
        z = named.get("Z")
        if z is not None and z[1].measures == x[1].measures and z[0] > _UPRIGHT * max(x[0], y[0]):
            return [self._finding(TRAVEL, _TRAVEL_REASON, z[1], max(x, y, key=lambda side: side[0])[1])]
        longer, shorter = (x, y) if x[0] > y[0] else (y, x)
        if longer[0] > most * shorter[0]:
            return [self._finding(TRAVEL, _TRAVEL_REASON, longer[1], shorter[1])]
        return []

    def _same_on_table(self, names: Mapping[str, float]) -> list[Finding]:
        """Compare X and Y of a table: the motors, screws and ramps of both are of one kind."""
        compared = [pair for name in names if (pair := self._x_and_y(name))]
        differing = [(x, y) for x, y in compared if x.number != y.number]
        # Only where all else is the same: a table with unlike sides differs in several values.
        if len(compared) < 3 or len(differing) != 1:
            return []
        x, y = differing[0]
        is_slip = slip_between(x.number, y.number) or slip_between(y.number, x.number)
        is_odd = is_slip or _apart(_size(x), _size(y)) >= names[x.address[0]]
        return [self._finding(TABLE, _TABLE_REASON, x, y)] if is_odd else []

    def _beside_table(self, name: str, span: tuple[float, float]) -> list[Finding]:
        """Compare the upright axis with the faster side of the table."""
        named = {axis_letter(self._file, i): one for i, one in self._values[name].items()}
        sides = [one for letter in "XY" if (one := named.get(letter)) is not None]
        z = named.get("Z")
        if z is None or len(sides) != 2 or any(one.measures != z.measures for one in sides):
            return []
        most = max(sides, key=_size)
        if not _size(z) or span[0] * _size(most) <= _size(z) <= span[1] * _size(most):
            return []
        return [self._finding(UPRIGHT, _UPRIGHT_REASON, z, most)]

    def _towards(self, fact: Towards) -> list[Finding]:
        """Find each search that leads away from the end of travel at which its place is."""
        found, values = [], self._values
        for instance, speed in values[fact.speed].items():
            places = (values[name].get(instance) for name in (fact.place, fact.low, fact.high))
            ends = [*filter(None, places)]
            if not _size(speed) or len(ends) < 3 or len({one.measures for one in ends}) > 1:
                continue
            place, low, high = ends
            down, up = float(place.number) - float(low.number), float(high.number) - float(place.number)
            is_at_end = 0 < down + up < _UNLIMITED and min(abs(down), abs(up)) <= _BESIDE * (down + up)
            if is_at_end and _side(speed) != (1 if abs(up) < abs(down) else -1):
                found.append(self._finding(TOWARDS, _TOWARDS_REASON, speed, place))
        return found

    def _x_and_y(self, name: str) -> Ends | None:
        """Return the values of X and Y, where both can be compared."""
        named = {axis_letter(self._file, instance): one for instance, one in self._values[name].items()}
        x, y = named.get("X"), named.get("Y")
        return None if x is None or y is None or x.measures != y.measures else (x, y)

    def _gears(self, fact: Gears) -> list[Finding]:
        lows, highs = self._values[fact.low], self._values[fact.high]
        spindles: dict[str, list[tuple[ActiveValue, ActiveValue]]] = {}
        for instance in highs:
            if instance in lows:
                spindles.setdefault(instance.rpartition(".")[0], []).append((lows[instance], highs[instance]))
        return [finding for gears in spindles.values() for finding in self._of_spindle(gears)]

    def _of_spindle(self, gears: Sequence[Ends]) -> Iterator[Finding]:
        used = [n for n, (_, high) in enumerate(gears) if _size(high)]
        for n, before in zip(used, (-1, *used), strict=False):
            high = gears[n][1]
            # The numbering may begin at the second one; a gap is a line that was missed.
            if n > before + 1 + (before < 0) or (before >= 0 and _size(high) <= _size(gears[before][1])):
                yield self._finding(GEAR, _GEAR_REASON, high, gears[max(before, 0)][1])
        yield from self._unequal_gears([gears[n] for n in used])

    def _unequal_gears(self, gears: Sequence[Ends]) -> Iterator[Finding]:
        """Yield gears whose speeds are spread otherwise than those of all others."""
        for n, (low, high) in enumerate(gears):
            others = [_size(b) / _size(a) for a, b in (*gears[:n], *gears[n + 1 :]) if _size(a)]
            if not _size(low):
                if n and len(others) == len(gears) - 1 > 1:
                    yield self._finding(GEAR, _GEAR_REASON, low, gears[0][0])
            elif len(others) > 1 and all(_apart(_size(high) / _size(low), s) >= _SPREAD for s in others):
                yield self._finding(GEAR, _GEAR_REASON, low, high)

    def _proportion(self, fact: Proportion) -> list[Finding]:
        """Find two pairs of ends that do not belong to one straight line."""
        rows = []
        for name in (*fact.part_of, *fact.as_of):
            seen = next(iter(self._values[name].values()), None)
            if seen is None or not isinstance(seen.number, float):
                return []
            rows.append(seen)
        part, whole, other, other_whole = rows
        if not _size(part) or not _size(whole) or not _size(other_whole):
            return []
        share, as_share = _size(part) / _size(whole), _size(other) / _size(other_whole)
        if as_share and _apart(share, as_share) <= fact.within:
            return []
        return [self._finding(PROPORTION, _PROPORTION_REASON, part, other)]

    def _finding(self, rule: str, reason: str, one: ActiveValue, other: ActiveValue) -> Finding:
        """Return the recommendation on a value beside the one that it was compared with."""
        message = f"{sentence(self._file, one)}, and {sentence(self._file, other)}: {_WORDS[rule]}"
        return Finding(
            rule,
            "advice",
            (one.address,),
            f"{message}. Is it meant?",
            compared=(other.address,),
            reason=reason,
        )


_WORDS = {
    AMONG: "on one machine they are nearer to each other as a rule",
    TABLE: "in all else X and Y agree",
    UPRIGHT: "beside X and Y the upright axis is about as fast, or slower, as a rule",
    TOWARDS: "that is at the other end of the travel",
    TRAVEL: "the ends of travel of one machine are in proportion as a rule",
    GEAR: "the ranges of the gears do not follow each other",
    PROPORTION: "speed and output do not begin on one straight line",
}


def _is_on_one_side(own: Ends, like: Sequence[Ends]) -> bool:
    """Return whether both ends are on one side of the reference point, and those of all others are not."""
    return _side(own[0]) * _side(own[1]) > 0 and all(_side(a) * _side(b) < 0 for a, b in like)


def _is_far_out(own: Ends, like: Sequence[Ends]) -> bool:
    """Return whether the end at the reference point is far from those of all others, which are near to each
    other.
    """
    sizes = [(_size(a), _size(a) / _size(b)) for a, b in like if _size(b)]
    least, most = min(sizes, default=(0.0,))[0], max(sizes, default=(0.0,))[0]
    if not least or most > 3 * least:  # or the other axes have no travel: limits that are not set
        return False
    size = _size(own[0])
    if size == 0:
        return least == most
    share = size / _size(own[1]) if _size(own[1]) else 0.0
    return all(_apart(size, other) >= _NEAR and _apart(share, part) >= _SHARE for other, part in sizes)


def _apart(a: float, b: float) -> float:
    """Return how many times the greater of two values is the lesser."""
    least = min(a, b)
    # Nothing is in proportion to 0.
    return max(a, b) / least if least else float("inf")


def _size(one: ActiveValue) -> float:
    return abs(float(one.number))


def _side(one: ActiveValue) -> int:
    number = float(one.number)
    return (number > 0) - (number < 0)
