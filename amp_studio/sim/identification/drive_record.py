"""Reads the record of a drive: time, velocity or position, and torque,
as columns with their units in the heads.

Nothing is guessed that could scale a figure:
a column without a unit and a number that can be read in two ways are refused.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from amp_studio.files import text_of_name
from amp_studio.schema import UnitError, canonical, dimension, read_number, read_table_text, unit_named
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.series import Series

MAX_ROWS = 500_000
LARGEST = 1e12
_LONGEST_LINE = 10_000
_HEAD_WITHIN = 60
"""Lines from the top in which the heads are looked for; oscilloscopes and drives write their settings
above."""
_NUMBER = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]{1,3})?")
_BRACKETED = re.compile(r"(.*?)\s*[\[(]\s*([^\])(]*?)\s*[\])]\s*")
_TRAILING = re.compile(r"(.*?)(?:_|\s*,\s*|\s+in\s+|\s+)(\S+)")
_TIMES = {"s": 1.0, "ms": 1e-3, "us": 1e-6}
_ALSO = {
    "m": ("mm", 1e3),
    "m/s": ("mm/s", 1e3),
    "m/min": ("mm/min", 1e3),
    "rad": ("deg", 180.0 / np.pi),
    "rad/s": ("deg/s", 180.0 / np.pi),
    "°/s": ("deg/s", 1.0),
    "counts/min": ("counts/s", 1.0 / 60.0),
}
"""Units of records that no parameter has -> one that has a size, and how much of it."""
TORQUE_UNITS = {
    "%": ("%", 1.0),
    "percent": ("%", 1.0),
    "pct": ("%", 1.0),
    "arms": ("A", 1.0),
    "v": ("V", 1.0),
    "mv": ("V", 1e-3),
    "a": ("A", 1.0),
    "ma": ("A", 1e-3),
    "nm": ("Nm", 1.0),
    "mnm": ("Nm", 1e-3),
    "ncm": ("Nm", 1e-2),
    "n": ("N", 1.0),
    "kn": ("N", 1e3),
}
"""Unit of a torque, a force or a current without blanks and dots -> its own unit, and how much of that it
is."""

_KINDS: dict[str, tuple[str, ...]] = {
    "time": ("time|t|zeit",),
    "velocity": (
        "velocity|speed|vel|v|geschwindigkeit|drehzahl",
        (
            "((actual|measured|feedback|axis|load) (velocity|speed)|velocity"
            " (actual|feedback)|istgeschwindigkeit|v ?ist"
            "|(motor|ist)drehzahl|n ?ist)"
        ),
    ),
    "position": (
        "position|pos|lage|weg",
        "((actual|measured|feedback|axis|load) (position|pos)|position (actual|feedback)|istposition|x ?ist)",
    ),
    "torque": (
        "torque|force|current|drehmoment|moment|kraft|strom",
        (
            "((actual|measured|motor|axis) (torque|force|current)|torque (actual|feedback)|iq|i"
            " q|istmoment|iststrom)"
        ),
        (
            "((torque|force|current) (command|demand|reference|setpoint)|commanded"
            " (torque|current)|sollmoment|sollstrom)"
        ),
        "output",
    ),
}
"""What a column is -> its names, the ones that are taken first before the others."""
_SIDES = {
    "motor": (
        "(motor|encoder|first) (position|pos)|motor encoder|resolver( position)?"
        "|motor(lage|position)|position|pos"
    ),
    "load": (
        "(load|scale|table|second|external|direct) (position|pos|encoder)|(linear|glass) scale"
        "|last(lage|position)"
    ),
}
"""Positions on both sides of a backlash -> their names; in a record of both, its position is the motor's."""
_EXAMPLE = "time (s), velocity (mm/min), torque (%)"


@dataclass(frozen=True, eq=False)
class DriveRecord:
    """Time in s and, in the units of the columns, velocity or position (the other one is None) and torque."""

    time: Series
    velocity: Series | None
    position: Series | None
    torque: Series
    motion_unit: str
    """Of velocity or position: a unit of the program."""
    torque_unit: str
    columns: tuple[str, ...]
    """The heads of the columns that were used."""
    sides: tuple[Series, Series] | None = None
    """Positions of motor and load where the record has both, in ``sides_unit``."""
    sides_unit: str = ""


def read_drive_record(path: Path) -> DriveRecord:
    """Read a record from a file; raises SimulationError with its name, and OSError where it cannot be
    read.
    """
    text = read_table_text(path)
    try:
        return drive_record_of(text)
    except SimulationError as error:
        raise SimulationError(f"{text_of_name(path.name)}: {error}") from None


def _lines_of(text: str) -> _Lines:
    """Return the lines of a text with their numbers, without empty ones and remarks."""
    numbered = enumerate(text.splitlines(), 1)
    return [(n, line) for n, line in numbered if line.strip() and line.lstrip()[0] != "#"]


def _separator_of(line: str) -> str:
    """Return the character between the cells of a line; a comma where there is none."""
    # In this order: beside semicolons or tabs a comma is a decimal one.
    return next((character for character in ";\t," if character in line), ",")


def drive_record_of(text: str) -> DriveRecord:
    """Read a record from a text of comma, semicolon or tab separated columns;
    raises SimulationError naming the line.
    """
    lines = _lines_of(text)
    if len(lines) > MAX_ROWS + _HEAD_WITHIN:
        raise SimulationError(f"{len(lines)} lines are too many: {MAX_ROWS} at most")
    heads, names, separator, rest = _heads(lines)
    sides, sides_unit = _both_sides(names, rest, separator)
    # A velocity is differenced once for the acceleration, a position twice: it has less noise.
    motion = "velocity" if "velocity" in heads else "position"
    used = [heads[kind] for kind in ("time", motion, "torque")]
    units = [_unit(names[n], kind) for n, kind in zip(used, ("time", motion, "torque"), strict=True)]
    time, moved, torque = _columns(rest, used, len(names), separator)
    (time_unit, time_size), (motion_unit, motion_size), (torque_unit, torque_size) = units
    moved *= motion_size
    return DriveRecord(
        time * time_size * _TIMES[time_unit],
        moved if motion == "velocity" else None,
        moved if motion == "position" else None,
        torque * torque_size,
        motion_unit,
        torque_unit,
        tuple(" ".join(part for part in names[n] if part) for n in used),
        sides,
        sides_unit,
    )


def _both_sides(
    names: Sequence[tuple[str, str]], rest: _Lines, separator: str
) -> tuple[tuple[Series, Series] | None, str]:
    """Return the positions of motor and load, in one unit of the program; none where a column is missing."""
    places = {}
    for side, pattern in _SIDES.items():
        fitting = [n for n, (name, _) in enumerate(names) if re.fullmatch(pattern, name)]
        if len(fitting) != 1:
            return None, ""
        places[side] = fitting[0]
    units = [_unit(names[n], "position") for n in places.values()]
    if units[0][0] != units[1][0]:
        raise SimulationError(f"Motor and load are in {units[0][0]} and {units[1][0]}: give one unit")
    motor, load = _columns(rest, list(places.values()), len(names), separator)
    return (motor * units[0][1], load * units[1][1]), units[0][0]


# -- heads -------------------------------------------------------------------------------------------

_Lines = Sequence[tuple[int, str]]


def _heads(lines: _Lines) -> tuple[dict[str, int], list[tuple[str, str]], str, _Lines]:
    """Return what each used column is, name and unit of all columns, the separator, and the lines of
    numbers.
    """
    for place, (n, line) in enumerate(lines[:_HEAD_WITHIN]):
        separator = _separator_of(line)
        cells = _cells(line, separator, n)
        names = [_name_and_unit(cell) for cell in cells]
        found = _with_motor(_kinds([name for name, _ in names]), names)
        if not {"time", "torque"} <= found.keys() or not {"velocity", "position"} & found.keys():
            continue
        rest = lines[place + 1 :]
        if rest and (units := _line_of_units(_cells(rest[0][1], separator, rest[0][0]), len(names))):
            names = [(name, unit or below) for (name, unit), below in zip(names, units, strict=True)]
            rest = rest[1:]
        return found, names, separator, rest
    raise SimulationError(f"No line names the columns. Write it above the numbers, with units: {_EXAMPLE}")


def _with_motor(found: dict[str, int], names: Sequence[tuple[str, str]]) -> dict[str, int]:
    """Return the columns with the position of the motor where that of the load, or none, was found."""
    if "position" in found and not re.fullmatch(_SIDES["load"], names[found["position"]][0]):
        return found
    motor = [n for n, (name, _) in enumerate(names) if re.fullmatch(_SIDES["motor"], name)]
    return found | ({"position": motor[0]} if motor else {})


def named_columns(text: str, wanted: Mapping[str, str]) -> dict[str, tuple[int, str]]:
    """Return place and unit of each wanted column (name -> pattern)
    in the first line of a text that names one; {} where none does.
    """
    for n, line in enumerate(text.splitlines()[:_HEAD_WITHIN], 1):
        separator = _separator_of(line)
        heads = [_name_and_unit(cell) for cell in _cells(line, separator, n)]
        found = {
            name: (place, heads[place][1])
            for name, pattern in wanted.items()
            for place in [next((k for k, head in enumerate(heads) if re.fullmatch(pattern, head[0])), None)]
            if place is not None
        }
        if found:
            return found
    return {}


def _kinds(names: Sequence[str]) -> dict[str, int]:
    """Return kind -> its column; raises SimulationError where two columns have the same right to be it."""
    found = {}
    for kind, ranks in _KINDS.items():
        for pattern in ranks:
            fitting = [n for n, name in enumerate(names) if re.fullmatch(pattern, name)]
            if len(fitting) > 1:
                raise SimulationError(f"{len(fitting)} columns are a {kind}: leave one of them")
            if fitting:
                found[kind] = fitting[0]
                break
    return found


def _name_and_unit(cell: str) -> tuple[str, str]:
    """Return the name in plain small letters, and the unit as it is written; "" where there is none."""
    text = cell.strip().strip("\"'")
    bracketed = _BRACKETED.fullmatch(text)
    name, unit = bracketed.groups() if bracketed else (text, "")
    trailing = None if bracketed else _TRAILING.fullmatch(text)
    if trailing and (_is_unit(trailing[2])):
        name, unit = trailing.groups()
    return " ".join(name.casefold().replace("_", " ").replace("-", " ").split()), unit


def _is_unit(text: str) -> bool:
    word = text.strip("[]() ")
    try:
        return bool(word) and (_torque_unit(word) is not None or word in _ALSO or bool(unit_named(word)))
    except UnitError:
        return False


def _line_of_units(cells: Sequence[str], width: int) -> list[str]:
    """Return the units of a line that contains nothing else, none for another line."""
    words = [cell.strip().strip("[]()") for cell in cells]
    fits = len(words) == width and any(words) and all(not word or _is_unit(word) for word in words)
    return words if fits else []


def _unit(head: tuple[str, str], kind: str) -> tuple[str, float]:
    """Return the unit of a column and how much of it one is;
    raises SimulationError for one that does not fit.
    """
    name, text = head
    if not text:
        raise SimulationError(f"The column {name} has no unit. Write it in its head: {_EXAMPLE}")
    if kind == "torque":
        unit = _torque_unit(text)
        if unit is None:
            raise SimulationError(f"The column {name} is in {text[:20]}; known are %, V, A, Nm and N")
        return unit
    if text in _ALSO and kind != "time":
        return _ALSO[text]
    try:
        unit_name = unit_named(text)
    except UnitError as error:
        raise SimulationError(f"The column {name}: {error}") from None
    if not _fits_kind(unit_name, kind):
        raise SimulationError(
            f"The column {name} is in {text[:20]}, which is no unit of a {kind} of the axis"
        )
    return unit_name, 1.0


def _fits_kind(unit: str, kind: str) -> bool:
    """Return whether a column of a kind may be in a unit."""
    if kind == "time":
        return unit in _TIMES
    return (kind, unit) == ("velocity", "rpm") or dimension(unit) in _DIMENSIONS[kind]


_DIMENSIONS = {
    "velocity": ("velocity", "angular velocity", "count rate"),
    "position": ("length", "angle", "counts"),
}


def _torque_unit(text: str) -> tuple[str, float] | None:
    word = re.sub(r"[\s·.*]", "", text).casefold()
    return TORQUE_UNITS.get("%" if word.startswith("%") else word)  # % of rated torque, % Mn


def torque_figure(text: str) -> tuple[float, str]:
    """Read a torque with its unit, ``0.056 A``; raises SimulationError."""
    match = re.fullmatch(rf"({_NUMBER.pattern})\s*(\D+)", text.strip().replace(",", "."))
    unit = _torque_unit(match[2]) if match else None
    if match is None or unit is None or not 0.0 < float(match[1]) * unit[1] < np.inf:
        raise SimulationError(f"'{text[:40]}' is no torque above 0 with its unit: 0.056 A, 0.02 Nm")
    return float(match[1]) * unit[1], unit[0]


# -- numbers -----------------------------------------------------------------------------------------


def read_number_table(text: str, used: Sequence[int]) -> list[Series]:
    """Return the columns at the places ``used`` of a text, below its first line that has no number;
    raises SimulationError naming the line.
    """
    lines = _lines_of(text)
    if len(lines) > MAX_ROWS:
        raise SimulationError(f"{len(lines)} lines are too many: {MAX_ROWS} at most")
    for place, (n, line) in enumerate(lines):
        separator = _separator_of(line)
        cells = _cells(line, separator, n)
        if len(cells) > max(used) and not _NUMBER.fullmatch(cells[used[0]].replace(",", ".")):
            return _columns(lines[place + 1 :], used, len(cells), separator)
    return [np.empty(0) for _ in used]


def _cells(line: str, separator: str, number: int) -> list[str]:
    """Return the cells of a line; raises SimulationError for what is no line of a table."""
    if len(line) > _LONGEST_LINE:
        raise SimulationError(f"line {number}: it has more than {_LONGEST_LINE} characters")
    try:
        (cells,) = csv.reader([line], delimiter=separator, strict=True)
    except (csv.Error, ValueError) as error:
        raise SimulationError(f"line {number}: this is no line of a table ({error})") from None
    # A separator at the end of a line begins no cell.
    if len(cells) > 1 and not cells[-1].strip():
        cells.pop()
    return [cell.strip() for cell in cells]


def _columns(lines: _Lines, used: Sequence[int], width: int, separator: str) -> list[Series]:
    """Return the used columns as numbers; raises SimulationError for a cell that is none, or may be two."""
    first_lines: dict[str, int] = {}
    columns: list[list[float]] = [[] for _ in used]
    for n, line in lines:
        cells = _cells(line, separator, n)
        if len(cells) != width:
            hint = (
                "; if its numbers have decimal commas, separate the columns by semicolons"
                if separator == ","
                else ""
            )
            raise SimulationError(f"line {n}: {len(cells)} cells, and {width} heads{hint}")
        for column, place in zip(columns, used, strict=True):
            # The minus of typesetters, U+2212, which some programs write.
            cell = cells[place].replace("\u2212", "-")
            for character in ".,":
                if character in cell:
                    first_lines.setdefault(character, n)
            text = cell.replace(",", ".")
            if len(text) > 40 or not _NUMBER.fullmatch(text):
                raise SimulationError(
                    f"line {n}: '{cell[:40]}' is no number" if cell else f"line {n}: a cell is empty"
                )
            number = float(text)
            if not abs(number) < LARGEST:
                raise SimulationError(f"line {n}: {cell[:40]} is too large: below 10^12 are read")
            column.append(number)
    # "1,234" with both characters in one record may be either: nothing that could scale a figure is
    # guessed.
    if len(first_lines) > 1:
        raise SimulationError(
            f"line {first_lines[',']} has a decimal comma and line {first_lines['.']} a decimal point:"
            " write all numbers in one way"
        )
    return [np.array(column) for column in columns]


def travel_per_turn(text: str, unit: str) -> float:
    """Read the travel for a turn of the motor, in the ``unit`` of the axis; raises SimulationError."""
    try:
        number, rest = read_number(text)
        own = unit_named(rest)
    except ValueError as error:
        raise SimulationError(f"The travel for a turn: {error}; give it as '10 mm'") from None
    if dimension(own) != {"mm": "length", "deg": "angle"}.get(unit) or not number > 0.0:
        raise SimulationError(
            f"The travel for a turn is '{text[:40]}': give it above 0 and in {unit}, the unit of the axis"
        )
    return canonical(number, own)


def position_factor(unit: str, of_axis: str) -> float:
    """Return how many u of an axis one of a position's ``unit`` is;
    raises SimulationError where an axis in that unit has no such positions.
    """
    wanted = {"mm": "length", "deg": "angle", "counts": "counts"}[of_axis]
    if dimension(unit) != wanted:
        raise SimulationError(
            f"Motor and load are in {unit}, and the axis moves in {of_axis}: give {of_axis}"
        )
    return canonical(1.0, unit)


def speed_factor(record: DriveRecord, unit: str, turn: str | None = None) -> float:
    """Return how many u/s (or u of a position) of an axis in ``unit`` one of the record's motion is.

    Raises SimulationError where an axis in that unit does not move so.
    """
    own = record.motion_unit
    # Of a linear axis an angle is that of its motor.
    if own == "rpm" or (unit == "mm" and dimension(own) in ("angle", "angular velocity")):
        if turn is None:
            raise SimulationError(
                f"The record is in {own}: give the travel for a turn of the motor, as '10 mm'", "turn"
            )
        way = travel_per_turn(turn, unit)
        turns = 1.0 if own == "rpm" else canonical(1.0, own) / 360.0
        return way * turns / (60.0 if record.velocity is not None else 1.0)
    wanted = {
        "mm": ("length", "velocity"),
        "deg": ("angle", "angular velocity"),
        "counts": ("counts", "count rate"),
    }[unit]
    if dimension(own) not in wanted:
        raise SimulationError(
            f"The record is in {own}, and the axis moves in {unit}: give {unit} or {unit}/s"
        )
    # Counts have their canonical rate in seconds, lengths and angles in minutes.
    if own == "counts/s" or record.velocity is None:
        return canonical(1.0, own)
    return canonical(1.0, own) / 60.0


def seconds_of(name: str, unit: str) -> float:
    """Return the s of one unit of the times of a table, without one of 1 s; raises SimulationError."""
    try:
        return canonical(1.0, unit_named(unit or "s")) / canonical(1.0, "s")
    except UnitError as error:
        raise SimulationError(f"{name}: {error}") from None
