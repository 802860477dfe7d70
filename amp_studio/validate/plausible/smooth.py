"""A single value that jumps out of a table that otherwise runs smoothly: a cam, a calibration.

A value that is off by ``e`` changes the second differences around it by ``e, -2 e, e``; a corner or a step of
the table itself leaves another pattern. How large ``e`` has to be follows
from the second differences of the rest of the table.
"""

from __future__ import annotations

import re
from bisect import bisect_left, insort
from collections.abc import Iterator

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, canonical, show_value
from amp_studio.validate.finding import Finding

JUMP = "plausible.jump"
REASON = (
    "ours, not the manual's: a single point of a smooth table that jumps out is a slip more often than a"
    " motion"
)
_MIN_POINTS = 8
"""Points of a table from which its course is known."""
_MANY = 6.0
"""Times the median second difference that a point must be off."""


class _Table:
    """The points of one table in their order, and their second differences."""

    def __init__(self, addresses: list[Address], points: list[float]) -> None:
        self.addresses, self.points = addresses, points
        self.place = {address: n for n, address in enumerate(addresses)}
        self.bends = [0.0, *(self._bend(n) for n in range(1, len(points) - 1)), 0.0]
        self.sorted = sorted(map(abs, self.bends[1:-1]))

    def _bend(self, n: int) -> float:
        return self.points[n - 1] - 2 * self.points[n] + self.points[n + 1]

    def change(self, n: int, point: float) -> None:
        """Take another point."""
        self.points[n] = point
        for at in range(max(1, n - 1), min(len(self.points) - 1, n + 2)):
            del self.sorted[bisect_left(self.sorted, abs(self.bends[at]))]
            self.bends[at] = self._bend(at)
            insort(self.sorted, abs(self.bends[at]))

    def jumping(self) -> Iterator[int]:
        """Yield the place of each point that jumps out."""
        if len(self.points) < _MIN_POINTS:
            return
        # The slip itself is in three differences of the sorted ones.
        # A straight table bends nowhere: what exceeds the rounding of its figures jumps.
        usual = self.sorted[(len(self.sorted) - 3) // 2] or 1e-9 * max(map(abs, self.points))
        # At the point itself the second difference is twice what the point is off.
        limit, bends = 2 * _MANY * usual, self.bends
        for n in [n for n, bend in enumerate(bends) if bend > limit or bend < -limit]:
            off = -bends[n] / 2
            # e on both sides: a corner of the course bends at one point, a step of it in two directions.
            if 1 < n < len(bends) - 2 and all(abs(bends[m] - off) <= abs(off) / 2 for m in (n - 1, n + 1)):
                yield n


class SmoothTables:
    """The tables of one file that run smoothly, as the facts of its family name them."""

    def __init__(self, file: ParameterFile) -> None:
        self._file, self._names = file, frozenset(file.schema.plausible.smooth)
        self._tables: dict[Address, _Table] = {}
        """Parameter and whole (an axis; "" for a table of the control) -> its table."""

    def check_all(self) -> None:
        """Look at every table."""
        self._tables.clear()
        points = {address for address in self._file.values if address[0] in self._names}
        if not points:
            return
        parts: dict[Address, list[Address]] = {}
        for address in self._file.addresses():
            if address in points and self._number(address) is not None:
                parts.setdefault(_whole(address), []).append(address)
        for whole, addresses in parts.items():
            self._tables[whole] = _Table(addresses, [self._number(a) or 0.0 for a in addresses])

    def recheck(self, address: Address) -> bool:
        """Look at one value again; returns whether anything is otherwise."""
        if address[0] not in self._names:
            return False
        number = self._number(address)
        table = self._tables.get(_whole(address))
        if number is None or table is None or address not in table.place:
            self.check_all()
            return True
        table.change(table.place[address], number)
        return True

    def _number(self, address: Address) -> float | None:
        value = self._file.values.get(address)
        if value is None or isinstance(value.value, (bool, str)):
            return None
        if not self._file.evaluation.state(address).is_active:
            return None
        return canonical(value.value, value.unit)

    def findings(self) -> Iterator[Finding]:
        """Yield each point that jumps out of its table."""
        for table in self._tables.values():
            for n in table.jumping():
                yield self._finding(table, n)

    def _finding(self, table: _Table, n: int) -> Finding:
        """Return the question about a value that alone jumps out of its table."""
        schema, address = self._file.schema, table.addresses[n]
        parameter, value = schema.parameters[address[0]], self._file.values[address]
        before, after = (show_value(parameter, self._file.values[table.addresses[m]]) for m in (n - 1, n + 1))
        message = (
            f"{schema.on(self._file.machine).label(address)} is {show_value(parameter, value)} between"
            f" {before} and {after}: it alone jumps out of its table. Is it meant?"
        )
        return Finding(JUMP, "advice", (address,), message, reason=REASON)


class TextCurves:
    """The texts of one file that are smooth tables, a calibration for example; facts name them."""

    def __init__(self, file: ParameterFile) -> None:
        self._file, self._signs = file, file.schema.plausible.curves
        self._findings: dict[Address, tuple[Finding, ...]] = {}

    def check_all(self) -> None:
        """Look at every text."""
        self._findings.clear()
        for address in [a for a in self._file.values if a[0] in self._signs]:
            self.recheck(address)

    def recheck(self, address: Address) -> bool:
        """Look at one text again; returns whether anything is otherwise."""
        if address[0] not in self._signs:
            return False
        before = self._findings.pop(address, ())
        value = self._file.values.get(address)
        if value is not None and self._file.evaluation.state(address).is_active:
            found = tuple(self._jumps(address, str(value.value)))
            if found:
                self._findings[address] = found
        return self._findings.get(address, ()) != before

    def findings(self) -> Iterator[Finding]:
        """Yield each point that jumps out of its table."""
        for found in self._findings.values():
            yield from found

    def _jumps(self, address: Address, text: str) -> Iterator[Finding]:
        """Yield the findings of one text; a word without a figure is no point."""
        sign = re.escape(self._signs[address[0]])
        points = re.findall(rf"(\S*?{sign}(-?[0-9]*\.?[0-9]+))(?!\S)", text)
        table = _Table([address] * len(points), [float(figure) for _, figure in points])
        label = self._file.schema.on(self._file.machine).label(address)
        for n in table.jumping():
            before, at, after = (points[m] for m in (n - 1, n, n + 1))
            message = (
                f"{label}, {at[0]} is {at[1]} between {before[1]} and {after[1]}: it alone jumps out of its"
                " table. Is it meant?"
            )
            yield Finding(JUMP, "advice", (address,), message, reason=REASON)


def _whole(address: Address) -> Address:
    name, _, _ = address[1].rpartition(".")
    return address[0], name
