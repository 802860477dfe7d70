"""A program in motion in words, as JSON and as CSV."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any

import numpy as np
import numpy.typing as npt

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Value, show_value
from amp_studio.sim.errors import SimulationError
from amp_studio.sim.path_rules import PathLimit, PathRows
from amp_studio.sim.rounding import rounded, value_text
from amp_studio.sim.unit_system import in_text, length_unit, path_error_text, path_error_unit

from .job import ProgramVersion, WhatIf, scaled
from .limits_met import PathAlarm
from .planned import PlannedProgram
from .planner import ProgramPlan
from .program import ProgramRun
from .summing import LAST_BIT

_TRIED_SHARE, _MAX_TRIES = 1.2, 5
"""By what a parameter that limits is multiplied to see what that brings, and how many are tried at most."""
SMALL = 0.0005
"""Share of the time below which a limit is not listed."""
_LETTERS = "BCDEFGHIJKLMNOPQSTUVWXYZ"
"""Of the limits, by their time: A is the programmed feed and R rapid."""


def limit_name(file: ParameterFile, limit: PathLimit) -> str:
    """Return a limit as a person reads it."""
    if limit.param is None:
        return limit.title
    parameter = file.schema.parameters[limit.param[0]]
    axis = f" {limit.param[1]}" if limit.param[1] else ""
    return f"{parameter.name}{axis}"


def limit_letters(run: ProgramRun) -> dict[int, str]:
    """Return cause -> its letter in picture and list: A for the programmed feed, the others by their time."""
    times = run.plan.time_by_cause
    order = sorted((n for n in range(1, len(times)) if times[n] > 0.0), key=lambda n: -times[n])
    return {0: "A", **{n: letter for letter, n in zip(_LETTERS, order, strict=False)}}


def line_columns(run: ProgramRun, most: int) -> tuple[npt.NDArray[np.str_], PathRows]:
    """Return of each line up to ``most``, by its number from 1, the letter of what limits it longest ("R" in
    rapid, "" where it moves nothing), and its time in s.
    """
    lines, causes, rapid, times = run.plan.listed.columns(most)
    letters, found = np.full(most + 1, "", "<U1"), np.zeros(most + 1)
    names = np.full(len(run.plan.causes) + 1, "", "<U1")
    for cause, letter in limit_letters(run).items():
        names[cause] = letter
    letters[lines], found[lines] = np.where(rapid, "R", names[causes]), times
    return letters, found


def lines_limited_by(run: ProgramRun, letter: str, most: int) -> npt.NDArray[np.int64]:
    """Return the lines up to ``most`` that a limit has a part of, by its letter ("R": those in rapid)."""
    if letter == "R":
        return np.flatnonzero(line_columns(run, most)[0] == "R")
    bits = sum(1 << min(n, LAST_BIT) for n, own in limit_letters(run).items() if own == letter)
    return np.flatnonzero(run.plan.listed.causes(most) & np.uint32(bits))


class LinesOfTime(list[dict[str, Any]]):
    """The time of each line, which is written as it comes: a list in memory would grow with the program."""

    def __init__(self, plan: PlannedProgram) -> None:
        super().__init__()
        self._plan = plan

    def __len__(self) -> int:
        return self._plan.moves

    def __iter__(self) -> Iterator[dict[str, Any]]:
        sums, present = np.zeros(1), np.zeros(1, bool)
        # A line may be run again by a loop: its sum is not known before the end.
        for plan in self._plan:
            lines = plan.lines
            if len(lines) and lines.max() >= len(sums):
                sums, present = (
                    np.pad(each, (0, int(lines.max()) + 1 - len(sums))) for each in (sums, present)
                )
            sums += np.bincount(lines, plan.whole, len(sums))
            present[lines] = True
        for line in np.flatnonzero(present).tolist():
            yield {"line": line, "time_s": rounded(float(sums[line]), 6)}


def limited_by(file: ParameterFile, run: ProgramRun) -> list[dict[str, Any]]:
    """Return what limits, the longest first: ``param`` as it is typed ("" for none), name, letter, time,
    share.
    """
    times, whole, letters = run.plan.time_by_cause, run.plan.time, limit_letters(run)
    rows = [
        {
            "param": file.machine_schema.short(limit.param) if limit.param else "",
            "name": limit_name(file, limit),
            "letter": letters.get(n, ""),
            "time_s": rounded(float(time), 6),
            "share": rounded(float(time) / whole, 4) if whole else 0.0,
        }
        for n, (limit, time) in enumerate(zip(run.plan.causes, times, strict=True))
        if whole and time > 0.0
    ]
    return sorted(rows, key=lambda row: -float(row["time_s"]))


def limit_tries(file: ParameterFile, run: ProgramRun) -> Iterator[Mapping[Address, Value]]:
    """Yield another value of each parameter that limits a program, the longest first: its value times
    `_TRIED_SHARE`.
    """
    times = run.plan.time_by_cause
    # One more than tried: the programmed feed is among the limits and has no parameter.
    for n in sorted(range(len(times)), key=lambda n: -times[n])[: _MAX_TRIES + 1]:
        limit = run.plan.causes[n]
        if limit.param is not None and times[n] > 0.0:
            with suppress(SimulationError):
                yield {limit.param: scaled(file, limit.param, _TRIED_SHARE)}


def program_summary(
    file: ParameterFile, run: ProgramRun, tries: Sequence[WhatIf] = (), others: Sequence[ProgramVersion] = ()
) -> dict[str, Any]:
    """Return a program as JSON; lengths in mm or deg."""
    plan, contour = run.plan, run.contour
    return {
        "file": str(file.header.name),
        "time": {"value": rounded(plan.time, 7), "unit": "s"},
        "limited_by": limited_by(file, run),
        "contour_error": None
        if contour is None
        else {
            "max": {"value": rounded(contour.largest, 5), "unit": "mm"},
            "p95": {"value": rounded(contour.p95, 5), "unit": "mm"},
            "where": {"line": _line(run), "time_s": rounded(float(contour.time[contour.worst]), 6)},
            "following_error": {
                axis: {"value": rounded(float(np.abs(contour.following[:, n]).max()), 5), "unit": "mm"}
                for n, axis in enumerate(plan.path.axes)
            },
        },
        "why_no_contour_error": run.why_no_contour,
        "alarms": [
            {
                "line": alarm.line,
                "time_s": rounded(alarm.time_s, 6),
                "code": alarm.code,
                "message": alarm.message,
            }
            for alarm in run.alarms
        ],
        "blocks": LinesOfTime(plan),
        "read_blocks": plan.path.blocks,
        "what_if": [try_summary(file, run, each) for each in tries],
        "versions": [{"file": each.name, **run_against(run, each.run, each.why_not)} for each in others],
        "assumptions": list(run.assumptions),
    }


def _line(run: ProgramRun) -> int:
    assert run.contour is not None
    row = int(run.contour.row[run.contour.worst])
    return int(run.plan.whole.lines[row])


def try_summary(file: ParameterFile, before: ProgramRun, each: WhatIf) -> dict[str, Any]:
    found: dict[str, Any] = {
        "changes": [
            {"param": file.machine_schema.short(address), "from": before_it, "to": after_it}
            for address, before_it, after_it in _changes(file, each)
        ],
        "not_allowed": list(each.not_allowed),
    }
    return found | run_against(before, each.run, each.why_not)


def run_against(before: ProgramRun, run: ProgramRun | None, why_not: str = "") -> dict[str, Any]:
    """Return time and error of another run, and by what they differ."""
    if run is None:
        return {"error": why_not}
    time = run.plan.time
    found: dict[str, Any] = {"time": {"value": rounded(time, 7), "unit": "s"}}
    found["time_change"] = rounded(time / before.plan.time - 1.0, 4) if before.plan.time else 0.0
    if run.contour is not None and before.contour is not None:
        found["contour_error"] = {"value": rounded(run.contour.largest, 5), "unit": "mm"}
        change = run.contour.largest - before.contour.largest
        found["contour_error_change"] = {"value": rounded(change, 4), "unit": "mm"}
    found["alarms"] = len(run.alarms)
    return found


def _changes(file: ParameterFile, each: WhatIf) -> Iterator[tuple[Address, str, str]]:
    """Yield address, value of the file and tried value, as a person reads them."""
    for address, (old, new) in each.changes.items():
        parameter = file.schema.parameters[address[0]]
        yield address, show_value(parameter, old), show_value(parameter, new)


def program_text(
    file: ParameterFile, run: ProgramRun, tries: Sequence[WhatIf] = (), others: Sequence[ProgramVersion] = ()
) -> str:
    """Return a program as lines of text, in the unit of the file."""
    length = length_unit(file)
    return "\n".join(in_text(line, length) for line in _lines(file, run, tries, others))


def assumed_texts(file: ParameterFile, run: ProgramRun) -> list[str]:
    """Return what a run assumes, each a sentence that begins so, in the unit of the file."""
    notes = (note if note.startswith("ASSUMED") else f"ASSUMED: {note}" for note in run.assumptions)
    return [in_text(note, length_unit(file)) for note in notes]


def alarm_text(file: ParameterFile, alarm: PathAlarm) -> str:
    """Return code and message of an alarm in the unit of the file."""
    return in_text(f"{alarm.code} {alarm.message}".strip(), length_unit(file))


def contour_text(file: ParameterFile, run: ProgramRun) -> str:
    """Return the contour error in words, in the unit of the file, or why there is none."""
    contour = run.contour
    if contour is None:
        return f"No contour error: {run.why_no_contour}"
    largest, p95 = (path_error_text(each, length_unit(file)) for each in (contour.largest, contour.p95))
    return (
        f"Contour error: at most {largest} in line {_line(run)}"
        f" after {value_text(float(contour.time[contour.worst]), 's', 4)}; 95 % of the time below {p95}"
    )


def _lines(
    file: ParameterFile, run: ProgramRun, tries: Sequence[WhatIf], others: Sequence[ProgramVersion]
) -> Iterator[str]:
    """Yield what a program takes, by what it is limited, and its alarms, a line each."""
    plan = run.plan
    yield f"{plan.path.blocks} blocks, {plan.moves} moves, {value_text(plan.time, 's', 5)}"
    yield from _shares_of_time(file, run)
    yield contour_text(file, run)
    if tries:
        yield "What if:"
        yield from (_try_line(file, run, each) for each in tries)
    if others:
        yield "Under other files:"
        yield from (f"  {each.name}: {_other_line(file, run, each.run, each.why_not)}" for each in others)
    for alarm in run.alarms:
        code = f"{alarm.code}: " if alarm.code else ""
        yield f"Line {alarm.line}: {code}{alarm.message}"
    yield from assumed_texts(file, run)


def _shares_of_time(file: ParameterFile, run: ProgramRun) -> Iterator[str]:
    if run.plan.moves:
        yield "Where the time goes:"
    for row in limited_by(file, run):
        if row["share"] >= SMALL:
            param = f"  {row['param']}" if row["param"] else ""
            time = value_text(row["time_s"], "s", 5)
            yield f"  {100.0 * row['share']:5.1f} %  {time:>10}  {row['name']}{param}"


def _try_line(file: ParameterFile, before: ProgramRun, each: WhatIf) -> str:
    changed = ", ".join(
        f"{file.machine_schema.short(address)} {before_it} -> {after_it}"
        for address, before_it, after_it in _changes(file, each)
    )
    text = f"  {changed}: {_other_line(file, before, each.run, each.why_not)}"
    if each.run is not None and each.not_allowed:
        text += f"; not allowed: {'; '.join(each.not_allowed)}"
    return text


def _other_line(file: ParameterFile, before: ProgramRun, run: ProgramRun | None, why_not: str) -> str:
    if run is None:
        return why_not
    share = run.plan.time / before.plan.time - 1.0 if before.plan.time else 0.0
    text = f"{value_text(run.plan.time, 's', 5)}, {100.0 * share:+.1f} % time"
    if run.contour is not None and before.contour is not None:
        unit, times = path_error_unit(length_unit(file))
        text += f", {times * (run.contour.largest - before.contour.largest):+.3g} {unit}"
    return text


def program_csv(file: ParameterFile, run: ProgramRun) -> Iterator[str]:
    """Yield a row for each planned move, many at a time: line, start, time, speeds, ends of the axes, what
    limits it.
    """
    names = [limit_name(file, limit) for limit in run.plan.causes]
    head = ["line", "start_s", "time_s", "length_mm", "entry_mm_s", "peak_mm_s", "leave_mm_s"]
    head += [f"{axis}_mm" for axis in run.plan.path.axes] + ["faster_by", "even_by", "slower_by"]
    yield ",".join(head) + "\n"
    for plan in run.plan:
        yield "".join(f"{row}\n" for row in _csv_rows(plan, names))


def _csv_rows(plan: ProgramPlan, names: Sequence[str]) -> Iterator[str]:
    columns = [plan.start, plan.whole, plan.geometry.length, plan.entry, plan.peak, plan.leave]
    numbers = np.column_stack([*columns, plan.geometry.ends])
    causes = np.column_stack([plan.faster_by, plan.even_by, plan.slower_by])
    lines = plan.lines
    for n in range(len(lines)):
        named = [
            f'"{names[cause]}"' if time > 0.0 else ""
            for cause, time in zip(causes[n].tolist(), plan.times[n].tolist(), strict=True)
        ]
        yield ",".join([str(int(lines[n])), *(repr(float(each)) for each in numbers[n]), *named])
