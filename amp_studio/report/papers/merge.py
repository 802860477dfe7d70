"""The paper of a comparison of two or three sources: what each has, what the result takes,
and which conflicts are open.
"""

from __future__ import annotations

from collections.abc import Mapping
from datetime import datetime

from amp_studio.files import Merge, MergeChoice, ParameterFile, Row, RowGroup, Side, Typed, in_one_unit
from amp_studio.report.axes import place_of
from amp_studio.schema import Value, show_value, visible

from .paper import Paper, PaperTable

_LETTERS: dict[Side, str] = {"base": "0", "a": "A", "b": "B"}
"""Source -> what it is called."""
_SHARES = (2.0, 4.6, 1.8, *(2.6,) * 4)


def merge_paper(merge: Merge, names: Mapping[Side, str]) -> Paper:
    """Return a comparison group by group with its result; ``names`` has each source. Secrets are masked."""
    left = len(merge.open_conflicts)
    facts = (
        *((_LETTERS[side], name) for side, name in names.items()),
        ("Differ", str(len(merge.differing))),
        ("The same", str(merge.same)),
        ("Conflicts", f"{len(merge.conflicts)}, {left} not settled"),
    )
    result = merge.result()
    tables = tuple(_table(merge, group, tuple(names), result) for group in merge.grouped(merge.differing))
    title = merge.a.header.name or names["a"]
    return Paper("Comparison", title, facts, tables, datetime.now().astimezone(), "Nothing differs.")


def _table(merge: Merge, group: RowGroup, sides: tuple[Side, ...], result: ParameterFile) -> PaperTable:
    """Return a group of a comparison; the side that the result takes is bold."""
    heads = ("Number", "Parameter", "Belongs to", *(_LETTERS[side] for side in sides), "Result")
    cells, strong = [], set()
    for at, row in enumerate(group.rows):
        choice = merge.choice(row)
        cells.append((*_named(merge, row), *_values(merge, row, sides, choice, result)))
        # A typed value, and a conflict that is not settled, are in the last column.
        taken = sides.index(choice) if isinstance(choice, str) and choice in sides else len(sides)
        strong.add((at, 3 + taken))
    return PaperTable(group.title, heads, tuple(cells), _SHARES[: len(heads)], frozenset(strong))


def _named(merge: Merge, row: Row) -> tuple[str, str, str]:
    if row.id.part != "value":
        return "", visible(row.id.key), ""
    file, address = merge.a, row.address
    number = "" if file.machine_schema.is_disputed(address[0]) else file.machine_schema.number(address) or ""
    return number, file.schema.parameters[address[0]].name, place_of(file, address)


def _texts(merge: Merge, row: Row, sides: tuple[Side, ...], result: ParameterFile) -> list[str]:
    """Return the values of the sides and of the result, in one unit."""
    if row.id.part != "value":
        values = [*map(row.of, sides), merge.result_of(row)]
        return ["–" if value is None else visible(str(value.value)) for value in values]
    values = [*map(row.of, sides), result.get(row.address)]
    unit = next((value.unit for value in values if value is not None and value.unit), "")
    parameter = merge.a.schema.parameters[row.address[0]]
    return [show_value(parameter, value) for value in _in_unit(values, unit)]


def _values(
    merge: Merge, row: Row, sides: tuple[Side, ...], choice: MergeChoice | None, result: ParameterFile
) -> tuple[str, ...]:
    """Return the values of a row in one unit, and that of the result in words."""
    texts = _texts(merge, row, sides, result)
    if choice is None:
        texts[-1] = "not settled"
    elif isinstance(choice, Typed):
        texts[-1] += " (typed)"
    return tuple(texts)


def _in_unit(values: list[Value | None], unit: str) -> list[Value | None]:
    return in_one_unit(values, unit) if unit else values
