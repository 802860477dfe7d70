"""Like axes against each other: where they agree in nearly all values, the one that differs may be a slip.

Of two axes (spindles, processes) it counts in how many values they can be compared and in which they differ;
an edit changes the counts of its instance only.
Facts of the family name what differs among like axes without any slip.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Iterator, Mapping
from fnmatch import filter as matching
from functools import lru_cache
from itertools import combinations
from typing import NamedTuple

from amp_studio.files import ParameterFile, are_alike, axis_letter
from amp_studio.schema import ACTIVE, Address, Parameter, Schema, StateInfo, Value, dimension, show_value
from amp_studio.validate.finding import Finding

from .slip import slip_as_written, slip_between

ALIKE = "plausible.alike"
REASON = (
    "ours, not the manual's: axes that are alike in nearly all values seldom differ in one by a slip's factor"
)
_SCOPES = ("axis", "spindle", "process", "group")
_SURE = 15
"""Compared values from which two instances that differ in a single one are asked about it,
whatever the difference."""
_MIN_COMPARED = 3
"""Compared values below which nothing is known of the likeness of two instances."""


class _Seen(NamedTuple):
    """What is compared of a value."""

    key: Hashable
    measures: str


class _Pair(NamedTuple):
    """Two instances: in how many values they can be compared, and in which they differ."""

    compared: list[int]
    """A single number."""
    differing: set[str]

    def update(self, name: str, change: int, *, is_same: bool) -> None:
        """Count that so many values more can be compared, and whether this one is the same."""
        self.compared[0] += change
        if is_same:
            self.differing.discard(name)
        else:
            self.differing.add(name)


class _Outlier(NamedTuple):
    """One instance, and how its value came of that of all others."""

    instance: str
    words: str


@lru_cache(maxsize=32)
def _comparable(schema: Schema) -> dict[str, bool]:
    """Return the parameters whose values like instances share, and whether all do:
    a difference without a slip counts too.
    """
    family = schema.family
    # What distinguishes axes (name, type, board, loop) differs between them by its nature.
    own = [family.axes.name, family.axes.type, family.axes.hardware, family.axes.loop] if family.axes else []
    if family.declared_axes is not None:
        fields = (family.declared_axes.name, family.declared_axes.group)
        own += [field.param for field in fields if field is not None]
    may_differ = _named(schema, schema.plausible.may_differ)
    left_out = {*own, *_named(schema, schema.plausible.unlike)}
    return {
        p.id: p.id not in may_differ
        for p in schema.parameters.values()
        if p.id not in left_out and _has_figure_of_a_user(p)
    }


def _has_figure_of_a_user(parameter: Parameter) -> bool:
    """Return whether a parameter has a value that a user gives and that can be compared with others."""
    return parameter.type not in ("text", "format") and not parameter.secret and parameter.access != "read"


def _named(schema: Schema, patterns: Iterable[str]) -> set[str]:
    """Return the parameters that ids, and patterns of ids with ``*``, mean."""
    return {
        name
        for pattern in patterns
        for name in (matching(schema.parameters, pattern) if "*" in pattern else (pattern,))
    }


@lru_cache(maxsize=32)
def _places(schema: Schema, machine: str) -> dict[tuple[str, str], tuple[Address, ...]]:
    """Return what can be compared of each instance of a scope, whatever is set."""
    here, comparable = schema.on(machine), _comparable(schema)
    places: dict[tuple[str, str], list[Address]] = {}
    for address in here.addresses:
        scope = here.scopes.get(address[0])
        # Parts of an instance (``X.3``: points of a table, gears) are not compared: of so many the few
        # that differ would never be odd.
        if address[0] in comparable and scope in _SCOPES and address[1] and "." not in address[1]:
            places.setdefault((scope, address[1]), []).append(address)
    return {place: tuple(addresses) for place, addresses in places.items()}


class Alike:
    """The like instances of one file."""

    def __init__(self, file: ParameterFile) -> None:
        self._file = file
        self._comparable = _comparable(file.schema)
        self._signed = frozenset(file.schema.plausible.signed)
        self._rows: dict[str, dict[str, dict[str, _Seen]]] = {}
        """Scope -> instance -> parameter -> what is compared."""
        self._pairs: dict[tuple[str, str, str], _Pair] = {}
        self._odd: dict[tuple[str, str], _Outlier] = {}
        """Scope and parameter -> the one instance that a slip parts from all others."""

    def check_all(self) -> None:
        """Compare everything."""
        self._rows.clear()
        known = self._file.evaluation.known_states()
        for (scope, instance), addresses in _places(self._file.schema, self._file.machine).items():
            if row := self._row(addresses, known):
                self._rows.setdefault(scope, {})[instance] = row
        self._pairs = {
            (scope, a, b): _compare(rows[a], rows[b])
            for scope, rows in self._rows.items()
            for a, b in combinations(rows, 2)
        }
        self._odd.clear()
        for scope, name in {(key[0], name) for key, pair in self._pairs.items() for name in pair.differing}:
            self._check_column(scope, name)

    def _row(self, addresses: Iterable[Address], known: Mapping[Address, StateInfo]) -> dict[str, _Seen]:
        """Return the active values among addresses of one instance, by parameter."""
        evaluation, values = self._file.evaluation, self._file.values
        keys = evaluation.keys
        return {
            address[0]: self._seen(address[0], keys[address], value)
            for address in addresses
            if (value := values.get(address)) is not None
            and (known.get(address) or evaluation.state(address)) is ACTIVE
        }

    def recheck(self, address: Address) -> bool:
        """Compare one value again; returns whether anything is otherwise."""
        name, instance = address
        scope = self._file.evaluation.scope(address) if name in self._comparable else None
        if scope not in _SCOPES or not instance or "." in instance:
            return False
        rows = self._rows.setdefault(scope, {})
        row = rows.get(instance)
        # An instance that had no value until now is compared in all of them.
        if row is None:
            self.check_all()
            return True
        old, new = row.get(name), self._key(address)
        if old == new:
            return False
        row.pop(name, None)
        if new is not None:
            row[name] = new
        # The number of values that can be compared changes only where one comes or goes.
        change = (new is not None) - (old is not None)
        for other in rows.keys() - {instance}:
            if name in rows[other]:
                pair = self._pair(scope, instance, other)
                pair.update(name, change, is_same=new in (None, rows[other][name]))
        self._check_column(scope, name)
        return True

    def _pair(self, scope: str, a: str, b: str) -> _Pair:
        return self._pairs.get((scope, a, b)) or self._pairs[scope, b, a]

    def _check_column(self, scope: str, name: str) -> None:
        """Note the one instance of at least three, all moving alike, whose value is another by a slip."""
        self._odd.pop((scope, name), None)
        column = {instance: row[name] for instance, row in self._rows[scope].items() if name in row}
        counts = Counter(column.values())
        # One value alone against a single other one; with two rare ones either may be the slip.
        if len(column) < 3 or sorted(counts.values()) != [1, len(column) - 1]:
            return
        usual = max(counts, key=lambda seen: counts[seen])
        odd = min(column, key=lambda instance: counts[column[instance]])
        like = next(instance for instance in column if instance != odd)
        words = self._slip(scope, name, odd, like) if column[odd].measures == usual.measures else ""
        if words and self._move_alike(scope, odd, column):
            self._odd[scope, name] = _Outlier(odd, words)

    def _move_alike(self, scope: str, one: str, others: Iterable[str]) -> bool:
        return scope != "axis" or all(are_alike(self._file, one, other) for other in others)

    def _key(self, address: Address) -> _Seen | None:
        """Return what is equal for equal values; None where the value does not count."""
        evaluation = self._file.evaluation
        value = self._file.values.get(address)
        if value is None or not evaluation.state(address).is_active:
            return None
        return self._seen(address[0], evaluation.keys[address], value)

    def _seen(self, name: str, key: Hashable, value: Value) -> _Seen:
        """Return what is compared; of a value whose sign is a direction only the size."""
        if name in self._signed and isinstance(key, int | float):
            key = abs(key)
        # With what it measures: 100 mm and 100 deg are no agreement.
        return _Seen(key, dimension(value.unit))

    def findings(self) -> Iterator[Finding]:
        """Yield what differs between instances that are otherwise alike, a finding a parameter and scope."""
        asked: dict[tuple[str, str], list[tuple[str, str, int]]] = {}
        for scope, a, b, name, agreeing in self._unequal_pairs():
            asked.setdefault((scope, name), []).append((a, b, agreeing))
        for (scope, name), pairs in asked.items():
            yield self._finding(scope, name, pairs)
        several = Counter((scope, *odd) for (scope, _), odd in self._odd.items())
        for (scope, name), odd in self._odd.items():
            # The same factor in several values is another motor or screw, and no slip of the keyboard.
            if several[scope, *odd] == 1 and (scope, name) not in asked:
                yield from self._alone(scope, name, odd.instance)

    def _unequal_pairs(self) -> Iterator[tuple[str, str, str, str, int]]:
        """Yield scope and both instances of each pair that differs in little, the parameter in which it
        does, and the number of those in which it agrees.
        """
        for (scope, a, b), pair in self._pairs.items():
            compared, count = pair.compared[0], len(pair.differing)
            # What differs in more than an eighth differs on purpose.
            if not count or compared < _MIN_COMPARED or count > max(1, compared // 8):
                continue
            is_sure = count == 1 and compared >= _SURE
            for name in pair.differing:
                if (is_sure and self._comparable[name]) or self._is_slip(scope, name, a, b):
                    yield scope, a, b, name, compared - count

    def _alone(self, scope: str, name: str, odd: str) -> Iterator[Finding]:
        """Yield what a slip explains on one axis where all others have one value, however unlike they are.

        Another axis is in several values so many times the others: a slip is in one. And it agrees with the
        others in more values than it differs.
        """
        others = [i for i, row in self._rows[scope].items() if i != odd and name in row]
        pairs = [self._pairs.get((scope, odd, i)) or self._pairs[scope, i, odd] for i in others]
        if all(pair.compared[0] > 2 * len(pair.differing) for pair in pairs):
            agree = [pair.compared[0] - len(pair.differing) for pair in pairs]
            yield self._finding(scope, name, [(odd, i, n) for i, n in zip(others, agree, strict=True)])

    def _is_slip(self, scope: str, name: str, a: str, b: str) -> bool:
        left, right = self._rows[scope][a][name], self._rows[scope][b][name]
        same = left.measures == right.measures
        # In both directions: of two instances either may be the wrong one.
        return same and bool(self._slip(scope, name, a, b) or self._slip(scope, name, b, a))

    def _slip(self, scope: str, name: str, a: str, b: str) -> str:
        """Return in words how the value of one instance came of that of another; "" for no slip."""
        rows, values = self._rows[scope], self._file.values
        words = slip_between(rows[a][name].key, rows[b][name].key)
        return slip_as_written(words, values[name, a], values[name, b])

    def _finding(self, scope: str, name: str, pairs: list[tuple[str, str, int]]) -> Finding:
        """Return the finding about a parameter: the one that differs from the rest, or both of two."""
        instances = list(dict.fromkeys(i for a, b, _ in pairs for i in (a, b)))
        odd, others = self._split_outliers(scope, name, instances)
        parameter = self._file.schema.parameters[name]
        texts = [
            f"{show_value(parameter, self._file.values[name, i])} on {self._label(name, i)}"
            for i in (*odd, *others[:1])
        ]
        slip = self._words(scope, name, odd[0], (others or odd[1:])[0])
        agree = min(n for _, _, n in pairs)
        return Finding(
            ALIKE,
            "advice",
            tuple((name, i) for i in odd),
            f"{parameter.name} is {_listed(texts)}{slip}; they agree in {agree} other values. Is it meant?",
            compared=tuple((name, i) for i in others),
            reason=REASON,
        )

    def _split_outliers(self, scope: str, name: str, instances: list[str]) -> tuple[list[str], list[str]]:
        """Return the instances that differ from the most frequent value, and the rest; without one most
        frequent value all are odd.
        """
        by_value: dict[Hashable, list[str]] = {}
        for instance in instances:
            by_value.setdefault(self._rows[scope][instance][name], []).append(instance)
        *_, second, usual = ([], *sorted(by_value.values(), key=len))
        if len(second) == len(usual):
            return instances, []
        return [i for i in instances if i not in usual], usual

    def _words(self, scope: str, name: str, a: str, b: str) -> str:
        words = self._slip(scope, name, a, b)
        return f" ({words} the other)" if words else ""

    def _label(self, name: str, instance: str) -> str:
        label = self._file.schema.on(self._file.machine).instance_label((name, instance))
        scope = self._file.evaluation.scope((name, instance))
        return (axis_letter(self._file, instance) if scope == "axis" else "") or label


def _compare(a: dict[str, _Seen], b: dict[str, _Seen]) -> _Pair:
    both = a.keys() & b.keys()
    return _Pair([len(both)], {name for name in both if a[name] != b[name]})


def _listed(texts: Iterable[str]) -> str:
    *first, last = texts
    return f"{', '.join(first)} and {last}" if first else last
