"""ValueFilters of values, by which a list is filtered: not set, changed, with findings, unlike on the axes,
changed since a download.

A list is made of rows, each the addresses of one parameter on its axes. What is asked of one value is asked
of it alone; whether the axes differ is asked of the row.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Literal, get_args

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value, read_address, same_value
from amp_studio.validate import NOT_SET, Finding, addresses_not_set

FilterName = Literal[
    "not-set",
    "changed",
    "findings",
    "axes-differ",
    "unsaved",
    "since-download",
    "restart",
    "recent",
    "bookmarked",
    "noted",
]
FILTER_NAMES: tuple[FilterName, ...] = get_args(FilterName)
_RESTART = ("restart", "reset")


@dataclass
class ValueFilters:
    """Which values of a file have a mark. What is remembered of a value is forgotten by ``forget``."""

    file: ParameterFile
    not_set: frozenset[Address] = frozenset()
    caused: frozenset[Address] = frozenset()
    """Values that cause a finding."""
    saved: Mapping[Address, Value] = field(default_factory=dict)
    """The values on disk."""
    downloaded: Mapping[Address, Value] | None = None
    """The values of the last download, once they were asked for."""
    recent: Collection[Address] = ()
    bookmarked: Collection[str] = ()
    """Ids of parameters."""
    noted: Collection[Address] = ()
    _own: dict[Address, bool] = field(default_factory=dict)
    """Address -> whether its value is not the printed default."""
    _differ: dict[tuple[Address, ...], bool] = field(default_factory=dict)

    def take_findings(self, findings: Iterable[Finding]) -> None:
        """Take what a check found now."""
        found = tuple(findings)
        self.not_set = frozenset(addresses_not_set(found))
        self.caused = frozenset(a for f in found if f.rule != NOT_SET for a in f.causes)

    def forget(self, addresses: Collection[Address]) -> None:
        """Forget what depends on edited values; all of it without any,
        or where they decide what else is active.
        """
        decides = self.file.evaluation.decides_states
        # A choice makes other values active or inactive: everything that is remembered may be wrong.
        if not addresses or any(map(decides, addresses)):
            self._own.clear()
            self._differ.clear()
            return
        edited = {address[0] for address in addresses}
        for known in [
            a for a in self._own if a[0] in edited
        ]:  # a secret is the default as a whole or not at all
            del self._own[known]
        for row in [row for row in self._differ if row[0][0] in edited]:
            del self._differ[row]

    # -- asking ------------------------------------------------------------------------

    def has(self, mark: FilterName, address: Address) -> bool:
        """Return whether a value by itself has a mark; whether axes differ is asked of the row."""
        return self._asks[mark](address)

    def passing(self, marks: Collection[FilterName], row: Sequence[Address]) -> int:
        """Return how many values of a row have all the marks; one of a row whose axes differ are all of
        it.
        """
        if "axes-differ" in marks and not self.differs(row):
            return 0
        asks = [self._asks[mark] for mark in marks if mark != "axes-differ"]
        return sum(all(ask(address) for ask in asks) for address in row)

    def counted(self, mark: FilterName, rows: Iterable[Sequence[Address]]) -> int:
        """Return how many values of a list have a mark; of rows whose axes differ, how many rows."""
        if mark == "axes-differ":
            return sum(self.differs(row) for row in rows)
        ask = self._asks[mark]
        return sum(ask(address) for row in rows for address in row)

    def differs(self, row: Sequence[Address]) -> bool:
        """Return whether the active values of one parameter are not the same on all axes of a kind;
        names and types never are.
        """
        if len(row) < 2:
            return False
        key = tuple(row)
        found = self._differ.get(key)
        if found is None:
            found = self._differ[key] = self._compared(row)
        return found

    def _compared(self, row: Sequence[Address]) -> bool:
        """Return whether two axes of a row differ in a value that could be the same."""
        file, profile = self.file, self.file.schema.family.axes
        # What makes an axis another one differs by its nature.
        if profile is not None and row[0][0] in (profile.name, profile.type, profile.fitted_by):
            return False
        if not file.machine_schema.kin(file.machine_schema.scopes[row[0][0]], "axis"):
            return False
        keys: dict[str, object] = {}
        for address in row:
            if file.get(address) is not None and file.evaluation.state(address).is_active:
                unit = file.evaluation.unit(address, file.header.units)
                key = file.evaluation.keys[address]
                # By unit: mm/min of X and deg/min of A are no difference, only two axes of one kind can
                # differ.
                if keys.setdefault(unit, key) != key:
                    return True
        return False

    @property
    def _asks(self) -> dict[FilterName, Callable[[Address], bool]]:
        """Filter -> the question that it asks of an address; "axes-differ" is asked of a whole row."""
        return {
            "not-set": self.not_set.__contains__,
            "changed": self._is_own,
            "findings": self.caused.__contains__,
            "axes-differ": lambda _: False,
            "unsaved": lambda a: self.file.get(a) != self.saved.get(a),
            "since-download": self._is_newer,
            "restart": self._needs_restart,
            "recent": self.recent.__contains__,
            "bookmarked": lambda a: a[0] in self.bookmarked,
            "noted": self.noted.__contains__,
        }

    def _is_own(self, address: Address) -> bool:
        found = self._own.get(address)
        if found is None:
            is_set = self.file.get(address) is not None
            found = self._own[address] = is_set and not self.file.is_default(address)
        return found

    def _is_newer(self, address: Address) -> bool:
        if self.downloaded is None:
            return False
        return not same_value(self.file.get(address), self.downloaded.get(address))

    def _needs_restart(self, address: Address) -> bool:
        schema = self.file.schema
        effect = schema.parameters[address[0]].effect or schema.family.effect
        return effect.level in _RESTART and self.file.get(address) is not None


def noted(file: ParameterFile) -> frozenset[Address]:
    """Return the values of a file on which there is a note."""
    return frozenset(map(read_address, file.header.value_notes))


def rows_of_file(file: ParameterFile) -> list[tuple[Address, ...]]:
    """Return the rows of all parameters of a file that are not hidden: the axes of each, or its only
    value.
    """
    rows: dict[tuple[str, str], list[Address]] = {}
    here = file.machine_schema
    for address in file.addresses():
        if file.evaluation.state(address).state != "hidden":
            of_axes = here.kin(here.scopes[address[0]], "axis")
            part = address[1].partition(".")[2] if of_axes else address[1]
            rows.setdefault((address[0], part), []).append(address)
    return [tuple(row) for row in rows.values()]
