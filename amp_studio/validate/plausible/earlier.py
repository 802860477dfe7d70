"""The file against what it was, and against its like: the saved file, the backup, the last download,
what it was made from, the fleet.

A value that became another one by a slip's factor since then is asked about until the next save or download
makes it the value that is known. What differs in many values is another machine or another unit,
and is no slip.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value, canonical, dimension, show_value
from amp_studio.validate.finding import Finding

from .slip import slip_as_written, slip_between

EARLIER = "plausible.earlier"
REASON = (
    "ours, not the manual's: a value that became ten times itself, or its negative, is a slip more often than"
    " a wish"
)
_MAX_FOUND, _SHARE = 6, 16
"""Values that may differ by a slip in a file of few values, and the part of all in one of many;
beyond that it is no slip."""


@dataclass(frozen=True)
class Earlier:
    """Values to compare with."""

    where: str
    """``in the backup``: ends the sentence "ten times the 5 mm …"."""
    values: Mapping[Address, Value]
    is_same_machine: bool = True
    """Whether travels, ports and the like must be the same too."""


class EarlierValues:
    """The values of one file that differ by a slip from earlier ones."""

    def __init__(self, file: ParameterFile, earlier: Sequence[Earlier] = ()) -> None:
        self._file, self.earlier = file, tuple(earlier)
        self._findings: list[dict[Address, str]] = []
        """What differs from each of the earlier contents, and how."""

    def check_all(self) -> None:
        """Compare everything."""
        self._findings = [
            {
                address: words
                for address, old in one.values.items()
                # Equal values, nearly all of them, end here.
                if self._file.values.get(address) != old and (words := self._words(one, address))
            }
            for one in self.earlier
        ]

    def recheck(self, address: Address) -> bool:
        """Compare one value again; returns whether anything is otherwise."""
        is_other = False
        for one, found in zip(self.earlier, self._findings, strict=True):
            before, words = found.pop(address, ""), self._words(one, address)
            if words:
                found[address] = words
            is_other |= before != words
        return is_other

    def _words(self, one: Earlier, address: Address) -> str:
        """Return how a value became what it is by a slip; "" where none explains it,
        or where it does not count.
        """
        old, new = one.values.get(address), self._file.values.get(address)
        # An axis that turns now has angles for lengths: their figures have no factor between them.
        if old is None or new is None or dimension(old.unit) != dimension(new.unit):
            return ""
        if isinstance(old.value, bool | str) or isinstance(new.value, bool | str):
            return ""
        if not self._may_have_slipped(address[0], is_same_machine=one.is_same_machine):
            return ""
        words = slip_between(canonical(new.value, new.unit), canonical(old.value, old.unit))
        return slip_as_written(words, new, old)

    def _may_have_slipped(self, name: str, *, is_same_machine: bool) -> bool:
        """Return whether a parameter is a number that a user gives, and not one by which machines differ."""
        parameter = self._file.schema.parameters[name]
        if parameter.type not in ("integer", "real") or parameter.secret or parameter.access == "read":
            return False
        unlike = self._file.schema.plausible.unlike
        return is_same_machine or not any(fnmatchcase(name, pattern) for pattern in unlike)

    def findings(self, asked: Iterable[Address]) -> Iterator[Finding]:
        """Yield what was found, of each value once; values that are ``asked`` about
        for another reason need no second question.
        """
        done = set(asked)
        for one, found in zip(self.earlier, self._findings, strict=True):
            # So many at once are another machine or another unit, and no slips.
            if len(found) > max(_MAX_FOUND, len(one.values) // _SHARE):
                continue
            for address, words in found.items():
                if address not in done and self._file.evaluation.state(address).is_active:
                    done.add(address)
                    yield self._finding(one, address, words)

    def _finding(self, one: Earlier, address: Address, words: str) -> Finding:
        parameter = self._file.schema.parameters[address[0]]
        label = self._file.schema.on(self._file.machine).label(address)
        new, old = (show_value(parameter, values[address]) for values in (self._file.values, one.values))
        message = f"{label} is {new}, {words} the {old} {one.where}. Is it meant?"
        return Finding(EARLIER, "advice", (address,), message, reason=REASON)


def values_of_fleet(others: Sequence[Mapping[Address, Value]]) -> dict[Address, Value]:
    """Return the values on which all machines of a fleet agree;
    fewer than three that have a value are no fleet.
    """
    found: dict[Address, Value] = {}
    counts: dict[Address, int] = {}
    apart: set[Address] = set()
    for values in others:
        # Missing at one machine is no other opinion: only the values that are there are compared.
        for address, value in values.items():
            counts[address] = counts.get(address, 0) + 1
            if found.setdefault(address, value) != value:
                apart.add(address)
    return {a: value for a, value in found.items() if counts[a] >= 3 and a not in apart}
