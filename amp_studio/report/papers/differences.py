"""Papers of what differs: two files, a file and a control, several machines."""

from __future__ import annotations

import hashlib
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from datetime import datetime
from itertools import groupby
from pathlib import Path

from amp_studio.files import (
    Comparison,
    Difference,
    ParameterFile,
    by_schema,
    content_of,
    in_order,
    without_secrets,
)
from amp_studio.report.axes import place_of
from amp_studio.report.chapters import Danger
from amp_studio.report.dangers import dangers_of_change
from amp_studio.report.language import Language, language_of
from amp_studio.report.wording import counted
from amp_studio.schema import Address, Value, ValueKey, same_key, same_value, show_value

from .paper import Paper, PaperTable

_DANGER_SHARES = (8.0, 1.2, 6.0)
_SHARES = (2.2, 5.0, 2.0, 3.4, 3.4)
_LONG_NUMBER = 12
SIDE_BY_SIDE = 6
"""Machines that have a column each; more of them are grouped."""


def _danger_table(dangers: Sequence[Danger], words: Language) -> PaperTable:
    """Return what a change can do to a machine, each with the parameters it is about."""
    rows = tuple((d.says, d.page, "; ".join(label for _, label in d.about)) for d in dangers)
    return PaperTable(words.text("Dangers"), ("Danger", "Page", "Parameters"), rows, _DANGER_SHARES)


def differences_paper(
    file: ParameterFile,
    comparison: Comparison,
    names: tuple[str, str],
    facts: Sequence[tuple[str, str]] = (),
    date: datetime | None = None,
    *,
    more: tuple[ParameterFile, Sequence[Difference]] | None = None,
    language: str = "en",
) -> Paper:
    """Return what differs between a file and another side, group by group; secrets are masked.

    ``more`` are the other side and what only its schema has; ``language`` is a code of ``language_codes``.
    """
    other, only_there = more or (None, ())
    tables = list(_by_group(file, comparison.differences, language))
    if other:
        tables += _by_group(other, only_there, language)
    count = len(comparison.differences) + len(only_there)
    words = language_of(language, file.schema.family.family)
    if dangers := dangers_of_change(file, comparison.differences, words):
        tables.insert(0, _danger_table(dangers, words))
    known = {title for title, _ in facts}
    sides = zip("AB", names, (file, other), strict=True)
    own = [fact for side in sides for fact in _side(*side, words) if fact[0] not in known]
    counts = [
        *own,
        *facts,
        ("Differ", str(count)),
        ("The same", str(comparison.same)),
        ("Not set in A", str(comparison.not_set_in_a)),
        ("Not set in B", str(comparison.not_set_in_b)),
    ]
    title = file.header.name or names[0]
    return Paper(
        "Differences",
        title,
        tuple(counts),
        tuple(tables),
        date or datetime.now().astimezone(),
        "Nothing differs.",
        signed=("Checked by", "Released by"),
        language=language,
    )


def _side(letter: str, name: str, file: ParameterFile | None, words: Language) -> Iterator[tuple[str, str]]:
    """Yield what one side is: its name without its folder, when it was saved, its checksum without
    secrets.
    """
    path = Path(name)
    is_there = path.is_file()
    yield letter, path.name if is_there else name
    if is_there:
        yield f"{letter} saved", words.moment(datetime.fromtimestamp(path.stat().st_mtime).astimezone())
    if file is not None:
        yield f"SHA-256 of {letter}", hashlib.sha256(content_of(without_secrets(file))).hexdigest()


def _by_group(file: ParameterFile, differences: Sequence[Difference], language: str) -> Iterator[PaperTable]:
    """Yield a table for each run of differences of one group, which come in the manual's order."""

    def group_name(difference: Difference) -> str:
        return file.schema.group_of[difference.address[0]].name

    for title, members in groupby(differences, key=group_name):
        rows, labels = list[tuple[str, ...]](), set[int]()
        for each in members:
            if _is_label(file, each.address):
                labels.add(len(rows))
            sides = (_value_text(file, each.address, value) for value in each.in_one_unit())
            rows.append((*_named(file, each.address, language), *sides))
        yield PaperTable(
            title,
            ("Number", "Parameter", "Belongs to", "A", "B"),
            tuple(rows),
            _shares(row[0] for row in rows),
            values_from=3,
            labels=frozenset(labels),
        )


def machines_paper(
    files: Sequence[ParameterFile],
    names: Sequence[str],
    *,
    everything: bool = False,
    date: datetime | None = None,
    language: str = "en",
) -> Paper:
    """Return a table with a line for each value and a column for each machine;
    only what differs unless ``everything``.

    What most machines have is plain, what departs from it is strong. Of many machines those that agree in
    every value are a group, and each figure has a line with its groups. Raises ValueError for files of
    different families, or fewer than two.
    """
    lines, same = machine_lines(files, everything=everything, language=language)
    differing = sum(line.differs for line in lines)
    facts = (
        ("Control family", files[0].schema.family.name),
        ("Machines", str(len(files))),
        ("Differ", counted(differing, "value")),
        ("The same", counted(same, "value")),
    )
    if len(files) > SIDE_BY_SIDE:
        tables, title = tuple(_grouped(lines, names, language)), counted(len(files), "machine")
    else:
        tables, title = _side_by_side(lines, names), ", ".join(names)
    return Paper(
        "Machines compared",
        title,
        facts,
        tables if lines else (),
        date or datetime.now().astimezone(),
        "Nothing differs.",
        language=language,
    )


def _side_by_side(lines: Sequence[MachineLine], names: Sequence[str]) -> tuple[PaperTable, ...]:
    heads = ("Number", "Parameter", "Belongs to", *names)
    cells = [(*line.named, *line.texts) for line in lines]
    strong = {(at, 3 + n) for at, line in enumerate(lines) for n in line.departing}
    shares = (2.0, 4.0, 1.6, *(2.4 for _ in names))
    labels = frozenset(at for at, line in enumerate(lines) if line.is_label)
    return (PaperTable("", heads, tuple(cells), shares, frozenset(strong), 3, labels),)


def _grouped(lines: Sequence[MachineLine], names: Sequence[str], language: str) -> Iterator[PaperTable]:
    """Yield the groups, and a line for each figure that a value has on some of them;
    all but the first are strong.
    """
    groups = machine_groups([line.alike for line in lines])
    listed = [
        (str(n), str(len(group)), ", ".join(names[each] for each in group))
        for n, group in enumerate(groups, 1)
    ]
    text = language_of(language).text
    yield PaperTable(
        text("Machines that agree in every value"),
        ("Group", "Machines", "Names"),
        tuple(listed),
        (1.0, 1.2, 11.0),
    )
    rows: list[tuple[str, ...]] = []
    strong: set[tuple[int, int]] = set()
    labels: set[int] = set()
    for line in lines:
        for n, (machine, numbers) in enumerate(groups_by_value(line.alike, groups)):
            if n:
                strong.add((len(rows), 3))
            if line.is_label:
                labels.add(len(rows))
            rows.append((*line.named, line.texts[machine], ", ".join(map(str, numbers))))
    yield PaperTable(
        text("Values"),
        ("Number", "Parameter", "Belongs to", "Value", "Groups"),
        tuple(rows),
        _SHARES,
        frozenset(strong),
        3,
        frozenset(labels),
    )


@dataclass(frozen=True, slots=True)
class MachineLine:
    """One value of several machines, in words."""

    address: Address
    named: tuple[str, str, str]
    """Its number, its name and where it belongs to."""
    texts: tuple[str, ...]
    """Its value on each machine; secrets are masked."""
    departing: frozenset[int]
    """The machines that do not have what most have."""
    alike: tuple[int, ...]
    """For each machine the first one that has the same."""
    is_label: bool
    """Whether its values are words of the control."""

    @property
    def differs(self) -> bool:
        """Whether any machine has another value than the first."""
        return any(self.alike)


def machine_lines(
    files: Sequence[ParameterFile], *, everything: bool = False, language: str = "en"
) -> tuple[list[MachineLine], int]:
    """Return the rows of ``machine_rows`` in words, and how many values are the same in all;
    raises ValueError.
    """
    rows, same = machine_rows(files, everything=everything)
    first = files[0]
    return [
        MachineLine(
            address,
            _named(first, address, language),
            tuple(_value_text(first, address, value) for value in values),
            frozenset(_departing(alike)),
            alike,
            _is_label(first, address),
        )
        for address, values in rows
        for alike in [alike_of(values)]
    ], same


def alike_of(values: Sequence[Value | None]) -> tuple[int, ...]:
    """Return for each value the place of the first that is the same."""
    firsts: dict[tuple[str, ValueKey] | None, int] = {}
    return tuple(firsts.setdefault(same_key(value), place) for place, value in enumerate(values))


def machine_groups(rows: Sequence[tuple[int, ...]]) -> list[tuple[int, ...]]:
    """Return the places of the machines that have the same in every row (``alike_of``),
    the largest group first.
    """
    found: dict[tuple[int, ...], list[int]] = {}
    for place, values in enumerate(zip(*rows, strict=True)):
        found.setdefault(values, []).append(place)
    # By size, then by the order in which they were given, so that a paper is the same each time.
    return sorted(map(tuple, found.values()), key=lambda group: (-len(group), group))


def groups_by_value(
    alike: tuple[int, ...], groups: Sequence[tuple[int, ...]]
) -> list[tuple[int, tuple[int, ...]]]:
    """Return a machine that has each value of a row, and the numbers of its groups from 1;
    the most frequent value first.
    """
    found: dict[int, list[int]] = {}
    for number, group in enumerate(groups, 1):
        found.setdefault(alike[group[0]], []).append(number)

    def machines(entry: tuple[int, list[int]]) -> int:
        return -sum(len(groups[number - 1]) for number in entry[1])

    return [(machine, tuple(numbers)) for machine, numbers in sorted(found.items(), key=machines)]


def machine_names(stems: Sequence[str]) -> list[str]:
    """Return a name for each machine; machines of one name are numbered."""
    return [stem if stems.count(stem) == 1 else f"{stem} ({n})" for n, stem in enumerate(stems, 1)]


def _in_one_schema(files: Sequence[ParameterFile]) -> list[ParameterFile]:
    """Return files by the schema of the first one; raises ValueError for one alone, and for several
    families.
    """
    if len(files) < 2:
        raise ValueError("give two files or more")
    families = dict.fromkeys(file.schema.family.name for file in files)
    if len(families) > 1:
        raise ValueError(f"files of different control families cannot be compared: {', '.join(families)}")
    return [files[0], *(by_schema(file, files[0].schema) for file in files[1:])]


def machine_rows(
    files: Sequence[ParameterFile], *, everything: bool = False
) -> tuple[list[tuple[Address, tuple[Value | None, ...]]], int]:
    """Return each address with its value in each file, and how many are the same in all;
    only what differs unless ``everything``.
    """
    same_schema = _in_one_schema(files)
    rows, same = [], 0
    # Also what the first machine has not set.
    for address in in_order(files[0].schema, {a for file in same_schema for a in file.values}):
        values = tuple(file.get(address) for file in same_schema)
        differs = any(not same_value(values[0], value) for value in values[1:])
        same += not differs
        if differs or everything:
            rows.append((address, _in_one_unit(address, values)))
    return rows, same


def _in_one_unit(address: Address, values: tuple[Value | None, ...]) -> tuple[Value | None, ...]:
    """Return values in the unit of the first that is set."""
    first = next((value for value in values if value is not None), None)
    return tuple(
        value if value is None else Difference(address, first, value).in_one_unit()[1] for value in values
    )


def _departing(alike: Sequence[int]) -> Iterator[int]:
    """Yield the places of the values that are not what most have (``alike_of``);
    none where no value is more frequent than another.
    """
    ((first, most),) = Counter(alike).most_common(1)
    # A majority: of two machines, or of two pairs, neither is the one that departs.
    if most * 2 > len(alike):
        yield from (place for place, other in enumerate(alike) if other != first)


def _named(file: ParameterFile, address: Address, language: str) -> tuple[str, str, str]:
    here = file.machine_schema
    number = "" if here.is_disputed(address[0]) else here.number(address) or ""
    place = language_of(language).text(place_of(file, address))
    return number, file.schema.parameters[address[0]].name, place


def _shares(numbers: Iterable[str]) -> tuple[float, ...]:
    """Return the widths of the columns; a number that is a name (``[TRAJ]SPINDLES``) needs more."""
    is_name = any(len(number) > _LONG_NUMBER for number in numbers)
    return (4.6, 4.0, 1.6, 2.9, 2.9) if is_name else _SHARES


def _is_label(file: ParameterFile, address: Address) -> bool:
    return file.schema.parameters[address[0]].type not in ("integer", "real")


def _value_text(file: ParameterFile, address: Address, value: Value | None) -> str:
    return show_value(file.schema.parameters[address[0]], value)
