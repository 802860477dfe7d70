"""A table of the control whose rows have a few values, each of them several times:
a single one may be a slip.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from functools import lru_cache

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Schema, show_value
from amp_studio.validate.finding import Finding

from .slip import slip_between

ROW = "plausible.row"
REASON = (
    "ours, not the manual's: in a table of equal rows one that is off by a slip's factor is a slip more often"
    " than a wish"
)
_MIN_ROWS = 4
"""Rows from which a table has a habit."""
_OFTEN = 3
"""How often every other value must be there."""
_NO_FIGURES = (0.0, 1.0, -1.0)
"""What a row with nothing in it has; nothing is ten times that by a slip."""


@lru_cache(maxsize=64)
def _tables_of(schema: Schema, machine: str) -> tuple[str, ...]:
    """Return the parameters with several numbers on a machine type; the files of a shop are of few."""
    here, others = schema.on(machine), {*schema.plausible.smooth, *schema.plausible.equal_rows}
    return tuple(
        p.id
        for p in schema.parameters.values()
        if p.type in ("integer", "real")
        and not p.secret
        and p.access != "read"
        and p.id not in others
        and len(here.instances(p)) >= _MIN_ROWS
    )


class EqualRows:
    """The tables of one file that belong to no axis."""

    def __init__(self, file: ParameterFile) -> None:
        self._file = file
        scope = file.evaluation.scope
        tables = _tables_of(file.schema, file.machine)
        # Tables of axes are compared axis by axis (alike.py); a row of those is no other axis.
        self._tables = frozenset(name for name in tables if scope((name, "")) == "global")
        self._equal = file.schema.plausible.equal_rows
        self._findings: dict[str, Finding] = {}

    def check_all(self) -> None:
        """Look at every table."""
        self._findings.clear()
        for name in dict.fromkeys(address[0] for address in self._file.values):
            if name in self._tables:
                self._check_table(name)
            elif name in self._equal:
                self._check_equal_rows(name)

    def recheck(self, address: Address) -> bool:
        """Look at the table of one value again; returns whether anything is otherwise."""
        name = address[0]
        if name not in self._tables and name not in self._equal:
            return False
        before = self._findings.pop(name, None)
        if name in self._equal:
            self._check_equal_rows(name)
        else:
            self._check_table(name)
        return self._findings.get(name) != before

    def _addresses(self, name: str) -> list[Address]:
        file, state = self._file, self._file.evaluation.state
        instances = file.schema.on(file.machine).instances(file.schema.parameters[name])
        return [(name, i) for i in instances if (name, i) in file.values and state((name, i)).is_active]

    def _check_equal_rows(self, name: str) -> None:
        """Look at a table whose rows are equal as a rule, or repeat after a few."""
        keys, every = self._file.evaluation.keys, self._equal[name]
        addresses = self._addresses(name)
        # Rows that repeat after a few are as many tables, one inside the other: like is compared with like.
        for first in range(every):
            rows = addresses[first::every]
            figures = [keys[address] for address in rows]
            counts = Counter(figures)
            # Of two odd rows either may be the slip: only a single one is asked about.
            alone = [n for n, key in enumerate(figures) if counts[key] == 1]
            if len(alone) == 1 and len(rows) >= _MIN_ROWS and sorted(counts.values())[1] >= _OFTEN:
                usual, times = counts.most_common(1)[0]
                slip = slip_between(figures[alone[0]], usual) or "not"
                self._findings[name] = self._finding(rows[alone[0]], rows[figures.index(usual)], times, slip)

    def _check_table(self, name: str) -> None:
        """Keep a finding about the one value that alone differs by a slip from the others of its table."""
        keys, addresses = self._file.evaluation.keys, self._addresses(name)
        figures = [keys[address] for address in addresses]
        counts = Counter(figures)
        by_count = sorted(counts.values())
        # One value that is there once, and no other that is rare: else the table has no habit to break.
        if len(addresses) < _MIN_ROWS or by_count[0] != 1 or by_count[1] < _OFTEN:
            return
        alone = counts.most_common()[-1][0]
        # 0 is a row that is not used, and no factor leads to it.
        if not alone:
            return
        for usual in counts:
            if usual in (alone, *_NO_FIGURES):
                continue
            if slip := slip_between(alone, usual):
                address, other = addresses[figures.index(alone)], addresses[figures.index(usual)]
                self._findings[name] = self._finding(address, other, counts[usual], slip)
                return

    def findings(self) -> Iterator[Finding]:
        """Yield what was found."""
        yield from self._findings.values()

    def _finding(self, address: Address, other: Address, count: int, slip: str) -> Finding:
        schema, parameter = self._file.schema, self._file.schema.parameters[address[0]]
        here, there = (show_value(parameter, self._file.values[a]) for a in (address, other))
        label = schema.on(self._file.machine).label(address)
        message = f"{label} is {here}, {slip} the {there} that {count} others have. Is it meant?"
        return Finding(ROW, "advice", (address,), message, compared=(other,), reason=REASON)
