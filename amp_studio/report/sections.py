"""The orders of a report: by axis, by number, by group, by step of commissioning."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterable, Sequence
from itertools import groupby, pairwise

from amp_studio.files import ParameterFile
from amp_studio.guide import steps_of

from .axes import axis_label, axis_note, printed_axes, scope_of
from .contents import Sort
from .language import ENGLISH, Language
from .model import Column, Grid, GridLine, Listing, ReportRow, Section
from .parameter.number_text import split_count

_WIDEST_GRID = 8
"""Most axes in one grid; further axes get another grid below."""


def sections_of(
    file: ParameterFile, rows: Sequence[ReportRow], sort: Sort, language: Language = ENGLISH
) -> tuple[Section, ...]:
    """Return the rows in one of the orders; empty sections are left out. Axes and steps have their titles
    in a language, groups the one that the control shows.
    """
    if sort == "number":
        return _by_number(rows, language)
    if sort == "steps":
        return _by_step(file, rows, language)
    return _by_axis(file, rows, language) if sort == "axis" else _by_group(file, rows)


def _is_axis(file: ParameterFile, row: ReportRow) -> bool:
    return scope_of(file, (row.id, row.instance)) == "axis"


# -- by number -----------------------------------------------------------------


def number_key(row: ReportRow) -> tuple[tuple[int, int, str], ...]:
    """Return the sort key of a row: ``P2N10`` after ``P2N9``, and values without a number last."""
    if not row.number:
        return ((2, 0, ""),)
    parts = re.findall(r"\d+|\D+", row.number)
    # Numbers by size and letters apart: int and str cannot be compared.
    return tuple((0, int(p), "") if p.isdecimal() else (1, 0, p) for p in parts)


def _by_number(rows: Sequence[ReportRow], language: Language) -> tuple[Section, ...]:
    ordered = tuple(sorted(rows, key=number_key))
    part = Listing("", ordered, any(r.place for r in ordered))
    return (Section("numbers", language.text("Parameters by number"), (part,)),) if rows else ()


# -- by axis -------------------------------------------------------------------


def _by_axis(file: ParameterFile, rows: Sequence[ReportRow], language: Language) -> tuple[Section, ...]:
    """Return one section for each printed axis, and one for what belongs to no axis."""
    sections = []
    for axis in printed_axes(file):
        own = [r for r in rows if r.instance == axis and _is_axis(file, r)]
        if own:
            sections.append(
                Section(
                    f"axis-{axis}",
                    language.text(_axis_title(file, axis)),
                    _listings(file, own, by_place=False),
                )
            )
    # Behind the axes, as the manual orders it (9/PC CNC AMP Reference Manual, Documenting AMP Files).
    rest = [r for r in rows if not _is_axis(file, r)]
    if rest:
        by_place = any(r.place for r in rest)
        sections.append(
            Section("no-axis", language.text("Non-axis parameters"), _listings(file, rest, by_place))
        )
    return tuple(sections)


def _axis_title(file: ParameterFile, axis: str) -> str:
    label, note = axis_label(file, axis), axis_note(file, axis)
    return f"Axis {label} ({note})" if note and "(" not in label else label


def _listings(file: ParameterFile, rows: Iterable[ReportRow], by_place: bool) -> tuple[Listing, ...]:
    """Return one listing for each group of the manual."""
    parts = groupby(rows, key=lambda r: _group_title(file, r))
    return tuple(Listing(title, tuple(part), by_place) for title, part in parts)


def _group_title(file: ParameterFile, row: ReportRow) -> str:
    group = file.schema.group_of[row.id]
    return group.whole_name


# -- by step of commissioning --------------------------------------------------


def _by_step(file: ParameterFile, rows: Sequence[ReportRow], language: Language) -> tuple[Section, ...]:
    """Return one section for each step, its values in the order in which they are set."""
    by_parameter: dict[str, list[ReportRow]] = {}
    for row in rows:
        by_parameter.setdefault(row.id, []).append(row)
    heads, sections = _columns(file), []
    for step in steps_of(file.schema):
        own = [row for parameter in step.parameters for row in by_parameter.get(parameter.id, ())]
        if own:
            title = f"{step.number} {language.title(step.title)}"
            sections.append(Section(f"step-{step.number}", title, tuple(_group_parts(file, "", own, heads))))
    return tuple(sections)


# -- by group ------------------------------------------------------------------


def _by_group(file: ParameterFile, rows: Sequence[ReportRow]) -> tuple[Section, ...]:
    """Return one section for each group; the parts of a long group stay together."""
    heads = _columns(file)
    sections: list[Section] = []
    # Rows come in the manual's order, so that each group is one run.
    for name, members in groupby(rows, key=lambda r: r.group):
        parts: list[Listing | Grid] = []
        for title, part in groupby(members, key=lambda r: file.schema.group_of[r.id].section):
            parts += _group_parts(file, title, list(part), heads)
        sections.append(Section(f"group-{len(sections) + 1}", name, tuple(parts)))
    return tuple(sections)


def _columns(file: ParameterFile) -> dict[str, Column]:
    """Return the head of each printed axis."""
    return {axis: Column(axis_label(file, axis), axis_note(file, axis)) for axis in printed_axes(file)}


def _group_parts(
    file: ParameterFile, title: str, rows: list[ReportRow], heads: dict[str, Column]
) -> list[Listing | Grid]:
    """Return the rows of a group as a list, or as grids of eight axes at most where axes have values."""
    axes = tuple(heads)
    if not any(_is_axis(file, r) for r in rows):
        return [Listing(title, tuple(rows), any(r.place for r in rows))]
    grids: list[Listing | Grid] = []
    for start in range(0, len(axes), _WIDEST_GRID):
        listed = axes[start : start + _WIDEST_GRID]
        # Values without an axis only in the first grid, else they would be printed once for each.
        lines = tuple(_lines(file, rows, listed, with_others=start == 0))
        if lines:
            grids.append(Grid(title, tuple(heads[axis] for axis in listed), lines))
    return grids


def _lines(
    file: ParameterFile, rows: list[ReportRow], axes: Sequence[str], with_others: bool
) -> Iterable[GridLine]:
    """Yield a line for each parameter: across the axes, or one for each value that belongs to no axis."""
    for _, members in groupby(rows, key=lambda r: r.id):
        own = list(members)
        if not _is_axis(file, own[0]):
            if with_others:
                yield from (
                    GridLine(r.id, r.number, r.name, r.place, r.shown_unit, r.default, (r,), True)
                    for r in own
                )
            continue
        at = {r.instance: r for r in own}
        cells = tuple(at.get(axis) for axis in axes)
        present = [r for r in cells if r is not None]
        if present:
            yield _axis_line(present, cells)


def _axis_line(present: list[ReportRow], cells: tuple[ReportRow | None, ...]) -> GridLine:
    """Return the line of a parameter across the axes; ``by axis`` where its defaults differ."""
    defaults = dict.fromkeys(r.default for r in present)
    return GridLine(
        id=present[0].id,
        number=numbers_of(present),
        name=present[0].name,
        place="",
        shown_unit=_line_unit(present),
        default=next(iter(defaults)) if len(defaults) == 1 else "by axis",
        cells=cells,
        spans=False,
    )


def _line_unit(present: list[ReportRow]) -> str:
    """Return the unit of most cells, of those of linear axes if there are any."""
    units = [r.shown_unit for r in present]
    # Most machines have few axes that turn; their cells have their unit with them.
    straight = [u for u in units if not u.startswith(("°", "deg"))]
    return Counter(straight or units).most_common(1)[0][0]


def numbers_of(rows: Sequence[ReportRow]) -> str:
    """Return the numbers of one parameter's values: ``1300``, ``20020, 21020``, ``1300, 2300 … 5300, 8300``.

    Never a range: between two of them there are numbers of other parameters.
    Those with … between them go on in equal steps.
    """
    numbers = list(dict.fromkeys(row.number for row in rows))
    runs: list[list[str]] = []
    for number in numbers:
        if runs and _continues(runs[-1], number):
            runs[-1].append(number)
        else:
            runs.append([number])
    return ", ".join(", ".join(run) if len(run) <= 3 else f"{run[0]}, {run[1]} … {run[-1]}" for run in runs)


def _continues(run: list[str], number: str) -> bool:
    """Return whether a number follows a run of numbers in the same step."""
    # The last two decide the step that the third must keep.
    heads, counts = zip(*map(split_count, [*run[-2:], number]), strict=True)
    return len(set(heads)) == 1 and len({b - a for a, b in pairwise(counts)}) == 1
