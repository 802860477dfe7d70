"""Two or three sources side by side, and the result that is made of them row by row."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import chain
from typing import Literal, NamedTuple, TypeVar

from amp_studio.schema import Address, Schema, Value, read_address, same_value

from .other_schema import by_schema
from .parameter_file import Change, ParameterFile

K = TypeVar("K")
Side = Literal["base", "a", "b"]
RowPart = Literal["value", "header", "entry"]
"""What a row is about: a parameter, an entry of the header, or an entry that the schema does not know."""
RowKind = Literal["same", "a", "b", "both", "different", "conflict"]
"""``a``, ``b``: only that side changed it (without a base: only that side has it); ``both``: to the same;
``different``: two values, and no base that would show who changed it; ``conflict``: both changed it,
and not to the same."""

HEADER_TEXTS = ("application", "revision", "notes")
"""Header entries that are compared as texts. The name stays with its file; units are how a file is shown."""
MACHINE, EXTRA = "machine", "extra"


FACTS, NOTES, ENTRIES = "Machine facts", "Notes and ticks", "Entries that this family does not know"
"""Titles of the groups that are none of the manual's."""


class RowId(NamedTuple):
    """What a row is about."""

    part: RowPart
    address: Address
    key: str = ""
    """The name of an entry as it is written in the file; empty for a parameter."""


class Typed(NamedTuple):
    """A value that a person typed for the result instead of taking one; None: not set."""

    value: Value | None


MergeChoice = Side | Typed


@dataclass(frozen=True, slots=True)
class Row:
    """One address with what each source has there; None: not set. ``base`` is None without a base too."""

    id: RowId
    base: Value | None
    a: Value | None
    b: Value | None
    kind: RowKind

    @property
    def address(self) -> Address:
        """Parameter and instance; for an entry of the header its name."""
        return self.id.address

    def of(self, side: Side) -> Value | None:
        """Return what a side has."""
        return self.base if side == "base" else self.a if side == "a" else self.b


@dataclass(frozen=True)
class RowGroup:
    """The rows of one group of the manual."""

    title: str
    rows: tuple[Row, ...]

    @property
    def conflicts(self) -> int:
        """Rows that both sides changed, settled or not."""
        return sum(row.kind == "conflict" for row in self.rows)


class Merge:
    """Sources A and B, and what both come from, if that is known;
    by default the result takes what one side changed.

    Without a base the result is A (``initial``) until something is taken from B. The sources are not touched.
    Raises ValueError when they are not of one family.
    """

    def __init__(
        self, a: ParameterFile, b: ParameterFile, base: ParameterFile | None = None, *, initial: Side = "a"
    ) -> None:
        _demand_one_family(a, b, base)
        self.initial: Side = initial
        """The side that the result has where nothing else is taken: that of the file into which it goes."""
        # Controls that describe themselves have separate schemas: B is seen by that of A.
        self.a, self.b = a, by_schema(b, a.schema)
        self.base = None if base is None else by_schema(base, a.schema)
        self.rows: tuple[Row, ...] = tuple(self._rows())
        """Every row, those that are the same too, in the manual's order."""
        self._choices: dict[RowId, MergeChoice] = {}

    def _sources(self) -> dict[Side, ParameterFile]:
        sources: dict[Side, ParameterFile] = {"a": self.a, "b": self.b}
        return sources if self.base is None else sources | {"base": self.base}

    # -- the rows --------------------------------------------------------------

    def _rows(self) -> Iterator[Row]:
        """Yield the rows: the header, then the values in the manual's order, then what the schema does not
        know.
        """
        sources = (self.base, self.a, self.b)
        texts = [_header_texts(file) for file in sources]
        for place in dict.fromkeys(chain.from_iterable(texts)):
            yield self._row(RowId("header", place, ".".join(filter(None, place))), texts, place)
        values: list[Mapping[Address, Value]] = [{} if file is None else file.values for file in sources]
        for address in in_order(self.a.schema, set(chain.from_iterable(values))):
            yield self._row(RowId("value", address), values, address)
        entries = [
            {} if file is None else {key: Value(text) for key, text in file.unknown.items()}
            for file in sources
        ]
        for key in dict.fromkeys(chain.from_iterable(entries)):
            yield self._row(RowId("entry", read_address(key), key), entries, key)

    def _row(self, row_id: RowId, sources: Sequence[Mapping[K, Value]], key: K) -> Row:
        """Return the row of what base, A and B have under a key."""
        base, a, b = (source.get(key) for source in sources)
        return Row(row_id, base, a, b, self._kind(base, a, b))

    def _kind(self, base: Value | None, a: Value | None, b: Value | None) -> RowKind:
        """Return which side changed a value, seen from the base."""
        if self.base is None:
            return self._kind_without_base(a, b)
        if a is b is base:  # equal texts of files are one object
            return "same"
        if same_value(a, b):
            return "same" if same_value(a, base) else "both"
        if same_value(a, base):
            return "b"
        return "a" if same_value(b, base) else "conflict"

    @staticmethod
    def _kind_without_base(a: Value | None, b: Value | None) -> RowKind:
        if a is b or same_value(a, b):
            return "same"
        return "a" if b is None else "b" if a is None else "different"

    @cached_property
    def differing(self) -> tuple[Row, ...]:
        """The rows in which the sources do not all agree."""
        return tuple(row for row in self.rows if row.kind != "same")

    @property
    def same(self) -> int:
        """How many rows are the same in all sources."""
        return len(self.rows) - len(self.differing)

    @cached_property
    def conflicts(self) -> tuple[Row, ...]:
        """The rows that both sides changed, and not to the same; settled or not."""
        return tuple(row for row in self.differing if row.kind == "conflict")

    def grouped(self, rows: Iterable[Row]) -> list[RowGroup]:
        """Return rows by the groups of the manual: the header first, what the schema does not know last."""
        groups: dict[str, list[Row]] = {}
        for row in rows:
            groups.setdefault(self.group_title(row), []).append(row)
        return [RowGroup(title, tuple(members)) for title, members in groups.items()]

    def group_title(self, row: Row) -> str:
        """Return the group of a row: ``Servo Parameters: Position Loop``."""
        if row.id.part == "header":
            return NOTES if row.address[1] and row.address[0] != EXTRA else FACTS
        group = self.a.schema.group_of.get(row.address[0]) if row.id.part == "value" else None
        if group is None:
            return ENTRIES
        return group.whole_name

    # -- the result ------------------------------------------------------------

    @property
    def choices(self) -> Mapping[RowId, MergeChoice]:
        """What was chosen, by row; any other row has its default."""
        return self._choices

    def choose(self, row: Row, choice: MergeChoice | None) -> None:
        """Take a side for a row, or a typed value; None goes back to what it was without a choice."""
        if choice is None:
            self._choices.pop(row.id, None)
        else:
            self._choices[row.id] = choice

    def take(self, side: Side, rows: Iterable[Row] | None = None) -> None:
        """Take a side for these rows, for all that differ by default."""
        for row in self.differing if rows is None else rows:
            if row.kind != "same":
                self.choose(row, side)

    def choice(self, row: Row) -> MergeChoice | None:
        """Return what the result takes; None for a conflict that is not settled."""
        chosen = self._choices.get(row.id)
        if chosen is not None:
            return chosen
        if row.kind == "conflict":
            return None
        if self.base is not None and row.kind in ("a", "b"):
            return "a" if row.kind == "a" else "b"
        return self.initial

    def result_of(self, row: Row) -> Value | None:
        """Return the value in the result; a conflict that is not settled keeps what the file has into which
        it goes.
        """
        choice = self.choice(row) or self.initial
        return choice.value if isinstance(choice, Typed) else row.of(choice)

    @property
    def open_conflicts(self) -> list[Row]:
        """The conflicts that are not settled."""
        return [row for row in self.conflicts if row.id not in self._choices]

    def keep_choices(self, before: Merge, *, swapped: bool = False, without: Side | None = None) -> None:
        """Take over what was chosen in an earlier merge, for the rows that still differ.

        With ``swapped`` sides A is B now. ``without`` is the side whose source is another one now: nobody has
        chosen its values.
        """
        other: dict[Side, Side] = {"a": "b", "b": "a", "base": "base"}
        rows = {row.id for row in self.differing}
        for row_id, choice in before._choices.items():  # a merge of the same class
            if row_id not in rows or choice == without or (choice == "base" and self.base is None):
                continue
            self._choices[row_id] = choice if isinstance(choice, Typed) or not swapped else other[choice]

    def result(self) -> ParameterFile:
        """Return the file into which the result goes, with what it takes from elsewhere."""
        file = self._sources()[self.initial].copy()
        self.apply_to(file)
        return file

    def refitted(self, result: ParameterFile) -> list[Row]:
        """Return the rows whose value has another unit in the result than where it was taken:
        their axis moves otherwise now.
        """
        return [
            row
            for row in self.rows
            if row.id.part == "value" and not same_value(result.get(row.address), self.result_of(row))
        ]

    def apply_to(self, file: ParameterFile) -> list[Change]:
        """Put the result into a file that contains A or B; returns the values changed.

        A value that is the same already stays as it is written. An axis that begins to turn takes its lengths
        along as angles, as everywhere. Marks of values out of range come with their values.
        """
        changes: list[Change] = []
        for row in self.differing:
            if row.id.part == "value":
                changes += self._put_value(file, row)
            elif row.id.part == "entry":
                self._put_entry(file, row)
            else:
                self._put_header(file, row)
        return changes + file.refit_turned(changes)

    def _put_value(self, file: ParameterFile, row: Row) -> Iterator[Change]:
        """Set a value as the result has it, with its mark; yields the change where it is one."""
        address, value = row.address, self.result_of(row)
        choice = self.choice(row) or self.initial
        if not same_value(file.get(address), value):
            change = file.set(address, value)
            if change is not None:
                yield change
        source = None if isinstance(choice, Typed) else self._sources().get(choice)
        # A value out of range that a user has forced stays forced by him, not by the one who merges.
        mark = source.forced.get(address) if source is not None else file.forced.get(address)
        if mark is None or value is None:
            file.forced.pop(address, None)
        else:
            file.forced[address] = mark

    def _put_entry(self, file: ParameterFile, row: Row) -> None:
        value = self.result_of(row)
        if value is None:
            file.unknown.pop(row.id.key, None)
        else:
            file.unknown[row.id.key] = str(value.value)

    def _put_header(self, file: ParameterFile, row: Row) -> None:
        """Put an entry of the header: a text, one entry of a list of texts,
        or a key that this program does not know.
        """
        (name, inner), value, choice = row.address, self.result_of(row), self.choice(row) or self.initial
        text = "" if value is None else str(value.value)
        if name == MACHINE:
            file.set_machine(text)
        elif not inner:
            setattr(file.header, name, text)
            file.evaluation.forget()  # conditions may name the model of the control
        else:
            entries = dict(getattr(file.header, name))
            entries.pop(inner, None)
            if name == EXTRA:  # as it is, whatever kind it is of
                source = self._sources()[self.initial if isinstance(choice, Typed) else choice]
                if inner in source.header.extra:
                    entries[inner] = source.header.extra[inner]
            elif value is not None:
                entries[inner] = text
            setattr(file.header, name, entries)


def _demand_one_family(*files: ParameterFile | None) -> None:
    """Raise ValueError when files are not of one family."""
    families = {f.schema.family.family for f in files if f is not None}
    if len(families) > 1:
        raise ValueError(
            f"files of different control families cannot be merged: {', '.join(sorted(families))}"
        )


def _header_texts(file: ParameterFile | None) -> dict[Address, Value]:
    """Return what is compared of a header: its texts, the entries of its lists (notes, ticked steps),
    unknown keys.

    The machine type is there only where no parameter is for it.
    """
    if file is None:
        return {}
    header, family = file.header, file.schema.family
    found = {(name, ""): Value(text) for name in HEADER_TEXTS if (text := getattr(header, name))}
    if not family.machine_parameter and len(family.machines) > 1:
        found[MACHINE, ""] = Value(file.machine)
    for name, entries in vars(header).items():
        if isinstance(entries, Mapping):
            found |= {(name, str(key)): Value(str(entry)) for key, entry in entries.items()}
    return found


def in_order(schema: Schema, addresses: Iterable[Address]) -> Sequence[Address]:
    """Return addresses in the manual's order; what the schema does not have comes last."""
    order = {p: n for n, p in enumerate(schema.parameters)}
    places = schema.on(schema.family.default_machine).places  # axes by letter are in no order of letters
    first, last = len(order), len(places)

    def place(address: Address) -> tuple[int, int, int, str, str]:
        return order.get(address[0], first), places.get(address, last), len(address[1]), *address

    return sorted(addresses, key=place)
