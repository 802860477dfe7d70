"""Measured points from a text: plain columns of a spreadsheet or a laser's own file, in one or several runs.

Nothing is guessed that could turn or scale an error: units, sign and decimal comma come from the heads of the
columns or from a person, and what was not answered is listed in ``Measurement.assumed``. Docs:
docs/tuning.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from fractions import Fraction
from pathlib import Path

from amp_studio.files import text_of_name
from amp_studio.schema import read_table_text

from . import renishaw
from .cells import is_number, lines_of, number_of, separator_of, split
from .errors import MeasurementError
from .heads import Head, direction_of, read_head, unit_of
from .measurement import (
    DECIMALS,
    ERROR_UNITS,
    POSITION_UNITS,
    SIGNS,
    MeasuredRun,
    Measurement,
    MeasurementAnswers,
)
from .raw import RawRun, RawTable

_MAX_RUNS = 1_000
_MAX_TARGETS = 10_000
_SIZES = {
    "mm": Fraction(1),
    "in": Fraction("25.4"),
    "um": Fraction(1, 1000),
    "deg": Fraction(1),
    "arcsec": Fraction(1, 3600),
    "counts": Fraction(1),
}
_BASE = {"mm": "mm", "in": "mm", "um": "mm", "deg": "deg", "arcsec": "deg", "counts": "counts"}


def read_measured_file(path: Path, answers: MeasurementAnswers, usual_unit: str = "mm") -> Measurement:
    """Read a file of measured points; raises MeasurementError with its name,
    and OSError where it cannot be read.
    """
    text = read_table_text(path)
    try:
        return read_measurement(text, answers, usual_unit)
    except MeasurementError as error:
        raise MeasurementError(f"{text_of_name(str(path))}: {error}") from None


def read_measurement(text: str, answers: MeasurementAnswers, usual_unit: str = "mm") -> Measurement:
    """Read measured points; ``usual_unit`` is that of the axis, assumed where none is named.
    Raises MeasurementError.
    """
    _check(answers)
    if "\0" in text:
        raise MeasurementError("this is no text with measured points")
    raw = renishaw.read(text, usual_unit) if renishaw.recognises(text) else _read_columns(text, answers)
    used, assumed = _settled(raw, answers, usual_unit)
    runs = tuple(_in_base(run, raw.kind, used) for run in _with_directions(raw.runs))
    # The positions of a circle are angles; what is set is a length.
    base = "mm" if raw.is_circle else _BASE[used.unit]
    return Measurement(runs, base, used, assumed, raw.notes, is_circle=raw.is_circle)


_SIGN_OF_KIND = {"correction": "target-measured", "measured": "measured-target"}
"""The kind of a table's figures -> their sign, where it leaves none to choose."""


def _sign(raw: RawTable, answered: str) -> str:
    """Return the sign of the errors, "" where neither table nor answer names it; raises MeasurementError
    where they contradict each other.
    """
    known = _SIGN_OF_KIND.get(raw.kind, answered)
    if answered not in ("", known):
        raise MeasurementError(
            f"the heads of the columns name {raw.kind} figures, which are {known}, not {answered}"
        )
    return known


def _check_units(unit: str, error_unit: str, *, is_circle: bool) -> None:
    """Raise MeasurementError for units of position and error that do not belong together."""
    if is_circle and (_BASE[unit], _BASE[error_unit]) != ("deg", "mm"):
        raise MeasurementError("a circle has angles in deg and errors of its radius in mm, in or um")
    if not is_circle and _BASE[unit] != _BASE[error_unit]:
        raise MeasurementError(f"positions in {unit} and errors in {error_unit} do not belong together")


def _settled(
    raw: RawTable, answers: MeasurementAnswers, usual_unit: str
) -> tuple[MeasurementAnswers, tuple[str, ...]]:
    """Return units and sign of a table, and which of them neither it nor an answer names;
    raises MeasurementError where they contradict each other.
    """
    named = {"unit": answers.unit or raw.unit or ("deg" if raw.is_circle else "")}
    unit = named["unit"] or usual_unit
    # What was measured beside a target is in the unit of the target.
    named["error_unit"] = answers.error_unit or raw.error_unit or (unit if raw.kind == "measured" else "")
    error_unit = named["error_unit"] or (usual_unit if raw.is_circle else unit)
    named["sign"] = _sign(raw, answers.sign)
    _check_units(unit, error_unit, is_circle=raw.is_circle)
    used = MeasurementAnswers(unit, error_unit, named["sign"] or SIGNS[0], answers.decimal or DECIMALS[0])
    return used, tuple(name for name, text in named.items() if not text)


def _check(answers: MeasurementAnswers) -> None:
    """Raise MeasurementError for an answer that was not offered."""
    for what, given, known in (
        ("unit", answers.unit, POSITION_UNITS),
        ("unit of errors", answers.error_unit, ERROR_UNITS),
        ("sign", answers.sign, SIGNS),
        ("decimal sign", answers.decimal, DECIMALS),
    ):
        if given and given not in known:
            raise MeasurementError(f"'{given[:40]}' is no {what} of measured points: {', '.join(known)}")


def _in_base(run: MeasuredRun, kind: str, used: MeasurementAnswers) -> MeasuredRun:
    size, error_size = _SIZES[used.unit], _SIZES[used.error_unit]
    turned = -1 if used.sign == SIGNS[1] else 1
    points = (
        (at * size, value * error_size - at * size if kind == "measured" else turned * value * error_size)
        for at, value in run.points
    )
    return MeasuredRun(run.rising, tuple(points))


# -- columns ------------------------------------------------------------------------------------


def _read_columns(text: str, answers: MeasurementAnswers) -> RawTable:
    """Return the table of a text of columns behind any head; raises MeasurementError."""
    lines = lines_of(text)
    # Titles, dates and serial numbers may come before the columns in any number.
    first = next((n for n, (_, line) in enumerate(lines) if _is_data(line, answers.decimal)), None)
    if first is None:
        raise MeasurementError("there is no line of numbers")
    separator = separator_of(lines[first][1], answers.decimal)
    rows = [(n, split(line, separator, n)) for n, line in lines[first:]]
    width = len(rows[0][1])
    heads, notes = _heads(lines[:first], separator, width)
    for n, cells in rows:
        if len(cells) != width:
            raise MeasurementError(
                f"{len(cells)} cells, and {width} in the lines before: {_hint(separator)}", n
            )
    return _table(rows, heads, answers.decimal, separator, notes)


def _hint(separator: str) -> str:
    return (
        "if it has decimal commas, name the decimal sign"
        if separator == ","
        else "each line has one for a column"
    )


def _is_data(line: str, decimal: str) -> bool:
    try:
        cells = split(line, separator_of(line, decimal), 0)
    except MeasurementError:
        return False
    begins = bool(cells) and (is_number(cells[0]) or direction_of(cells[0]) is not None)
    # One number may be a title, as "Axis 1"; a point has a position and an error.
    return begins and sum(is_number(cell) for cell in cells) > 1


def _heads(
    before: Sequence[tuple[int, str]], separator: str, width: int
) -> tuple[list[Head] | None, tuple[str, ...]]:
    """Return the heads of the columns, None where there are none, and what was passed over as a title."""
    heads, titles, units = None, list(before), [""] * width
    # Many instruments write the units in a line of their own below the heads.
    if titles and (found := _units(titles[-1], separator, width)):
        units = found
        titles.pop()
    if titles:
        n, line = titles[-1]
        cells = split(line, separator, n) if separator else _words(line, width)
        if len(cells) == width:
            read = (read_head(cell, column) for column, cell in enumerate(cells))
            heads = [replace(head, unit=head.unit or unit) for head, unit in zip(read, units, strict=True)]
            titles.pop()
    passed_over = {0: (), 1: ("1 line before the columns was not read",)}
    return heads, passed_over.get(len(titles), (f"{len(titles)} lines before the columns were not read",))


def _units(line: tuple[int, str], separator: str, width: int) -> list[str]:
    """Return the units of a line that contains nothing else; none for any other line."""
    cells = [unit_of(cell) for cell in (split(line[1], separator, line[0]) if separator else line[1].split())]
    units = [unit for unit in cells if unit is not None]
    return units if len(units) == len(cells) == width and any(units) else []


def _words(line: str, width: int) -> list[str]:
    """Part a head that is separated by blanks: by several of them, else by each."""
    wide = [part.strip() for part in line.strip().replace("\t", "  ").split("  ") if part.strip()]
    return wide if len(wide) == width else line.split()


def _table(
    rows: Sequence[tuple[int, list[str]]],
    heads: list[Head] | None,
    decimal: str,
    separator: str,
    notes: tuple[str, ...],
) -> RawTable:
    """Return the runs of a table; raises MeasurementError for heads that do not name what they are."""
    heads = heads or _heads_of_two(rows[0])
    kinds = [head.kind for head in heads]
    at, values = _columns(heads)

    def cell(row: tuple[int, list[str]], column: int) -> Fraction:
        return number_of(row[1][column], decimal, separator, row[0])

    figures = [[(cell(row, at), cell(row, n)) for row in rows] for n in values]
    if len(values) > 1:
        runs = [RawRun(heads[n].rising, tuple(points)) for n, points in zip(values, figures, strict=True)]
    else:
        runs = _runs_of_one(rows, kinds, figures[0])
    is_circle, kind = kinds[at] == "angle", kinds[values[0]]
    if is_circle and kind == "measured":
        raise MeasurementError("a circle needs the error of its radius, not the radius: angle, deviation")
    return RawTable(
        tuple(runs),
        "error" if kind == "mean" else kind,
        heads[at].unit,
        heads[values[0]].unit,
        (*notes, *_not_read(kinds, values)),
        is_circle,
    )


def _not_read(kinds: Sequence[str], values: Sequence[int]) -> Iterator[str]:
    """Yield how many columns were left out, in words; nothing where none was."""
    count = sum(kind == "" or (kind == "mean" and n not in values) for n, kind in enumerate(kinds))
    if count > 1:
        yield f"{count} columns that are neither position nor error were not read"
    elif count:
        yield "1 column that is neither position nor error was not read"


def _heads_of_two(row: tuple[int, list[str]]) -> list[Head]:
    """Return the heads of a table that has none; raises MeasurementError unless it has two columns."""
    if len(row[1]) != 2:
        raise MeasurementError(
            f"{len(row[1])} columns without heads: name them in a line before, as position, run 1 +, run 1 -",
            row[0],
        )
    return [Head("position", "", None), Head("error", "", None)]


def _columns(heads: Sequence[Head]) -> tuple[int, list[int]]:
    """Return the column of the position, and those of what was measured there, in one kind and unit;
    raises MeasurementError where the heads do not name them.
    """
    columns: dict[str, list[int]] = {}
    for n, head in enumerate(heads):
        columns.setdefault(head.kind, []).append(n)
    positions = columns.get("position", []) + columns.get("angle", [])
    found = [columns[kind] for kind in ("measured", "error", "correction") if kind in columns]
    found = found or [columns.get("mean", [])]  # a table of means alone
    # Measured beside its error: the reading of the instrument is the one without a sign to guess.
    values = columns.get("measured") or found[0]
    if len(positions) != 1 or not values:
        raise MeasurementError(
            "the heads of the columns do not name one position and what was measured there: position, error"
        )
    if len(found) > 1 and "measured" not in columns:
        raise MeasurementError("columns of errors and of corrections: leave one of them")
    if len({heads[n].unit for n in values}) > 1:
        raise MeasurementError("the columns of errors have several units")
    return positions[0], values


def _runs_of_one(
    rows: Sequence[tuple[int, list[str]]], kinds: Sequence[str], figures: Sequence[tuple[Fraction, Fraction]]
) -> list[RawRun]:
    """Return the runs of one column: as its lines name them, else parted where the axis turns."""
    if "direction" in kinds or "run" in kinds:
        return _grouped(rows, kinds, figures)
    return parted(figures)


def _grouped(
    rows: Sequence[tuple[int, list[str]]], kinds: Sequence[str], figures: Sequence[tuple[Fraction, Fraction]]
) -> list[RawRun]:
    """Return the runs of lines that name their run, their direction or both."""
    found: dict[tuple[str, bool | None], list[tuple[Fraction, Fraction]]] = {}
    for (n, cells), point in zip(rows, figures, strict=True):
        rising = None
        if "direction" in kinds:
            rising = direction_of(cells[kinds.index("direction")])
            if rising is None:
                raise MeasurementError(f"'{cells[kinds.index('direction')][:40]}' is no direction: + or -", n)
        run = cells[kinds.index("run")] if "run" in kinds else ""
        found.setdefault((run, rising), []).append(point)
    return [
        RawRun(part.rising if rising is None else rising, part.points)
        for (_, rising), points in found.items()
        for part in (
            parted(points) if "run" not in kinds or rising is None else [RawRun(rising, tuple(points))]
        )
    ]


# -- runs ---------------------------------------------------------------------------------------


def _piles(points: Sequence[tuple[Fraction, Fraction]]) -> list[tuple[Fraction, list[Fraction]]]:
    """Return the targets in the order of measuring, each with its readings in a row."""
    later = _later(points)
    piles: list[tuple[Fraction, list[Fraction]]] = []
    for n, (at, value) in enumerate(points):
        if piles and piles[-1][0] == at and not _turns(piles, at, later[n]):
            piles[-1][1].append(value)
        else:
            piles.append((at, [value]))
    return piles


def parted(points: Sequence[tuple[Fraction, Fraction]]) -> list[RawRun]:
    """Part points in the order of measuring into runs: a new one where the direction turns,
    or it starts over.

    Several readings of one target in a row are one of each run.
    """
    piles = _piles(points)
    runs: list[list[tuple[Fraction, list[Fraction]]]] = [piles[:1]]
    direction: int | None = None
    for pile in piles[1:]:
        last = runs[-1][-1][0]
        step = (pile[0] > last) - (pile[0] < last)
        if direction not in (None, step):
            runs.append([pile])
            # The new run has one point: its direction is known with the next.
            direction = None
            continue
        direction = step
        runs[-1].append(pile)
    if sum(max(len(values) for _, values in run) for run in runs if run) > _MAX_RUNS:
        raise MeasurementError(f"these are more than {_MAX_RUNS} runs")
    return [part for run in runs for part in _layers(run)]


def _later(points: Sequence[tuple[Fraction, Fraction]]) -> list[Fraction | None]:
    """Return for each point the next position that is another one; None behind the last."""
    found: list[Fraction | None] = [None] * len(points)
    # From behind, so that each point takes over what the next one found.
    for n in range(len(points) - 2, -1, -1):
        found[n] = points[n + 1][0] if points[n + 1][0] != points[n][0] else found[n + 1]
    return found


def _turns(piles: Sequence[tuple[Fraction, list[Fraction]]], at: Fraction, later: Fraction | None) -> bool:
    """Return whether a target that comes twice in a row is the turning point between two runs."""
    # Read three times or more, it is a target with several readings, as all others are.
    if len(piles) < 2 or later is None or len(piles[-1][1]) > 1:
        return False
    # Before and behind it the axis moves in opposite directions.
    return (later - at) * (at - piles[-2][0]) < 0


def _layers(run: Sequence[tuple[Fraction, list[Fraction]]]) -> Iterable[RawRun]:
    rising = None if len(run) < 2 else run[1][0] > run[0][0]
    for n in range(max(len(values) for _, values in run)):
        yield RawRun(rising, tuple((at, values[n]) for at, values in run if n < len(values)))


def _with_directions(runs: Sequence[RawRun]) -> list[MeasuredRun]:
    """Return runs with their directions; one that names none has that of its targets,
    a single target the rising one.
    """
    found = []
    for run in runs:
        targets = [at for at, _ in run.points]
        if len(set(targets)) != len(targets):
            raise MeasurementError(f"a run reaches the target {_text(targets)} twice: number the runs")
        rising = run.rising if run.rising is not None else len(targets) < 2 or targets[1] > targets[0]
        found.append(MeasuredRun(rising, tuple(sorted(run.points))))
    count = len({at for run in found for at, _ in run.points})
    if count < 2:
        raise MeasurementError("points at two positions at least are needed")
    if count > _MAX_TARGETS:
        raise MeasurementError(f"{count} target positions are too many: {_MAX_TARGETS} at most")
    return found


def _text(targets: Sequence[Fraction]) -> str:
    seen: set[Fraction] = set()
    return next(f"{float(at):g}" for at in targets if at in seen or seen.add(at))  # type: ignore[func-returns-value]  # set.add returns None, which is no
