"""The documentation of a file with what the simulator and the record of exchanges add to it."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from datetime import datetime
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any, BinaryIO

from amp_studio.child_process import beside
from amp_studio.files import (
    RECORD,
    TUNINGS,
    Notify,
    ParameterFile,
    axis_letter,
    content_of,
    local_time,
    read_content,
    real_path,
    text_of_name,
)
from amp_studio.report import (
    Additions,
    CheckedMotion,
    Contents,
    ExchangeLine,
    PrintedFigure,
    PrintedProgram,
    PrintedTest,
    ProgramLimit,
    TunedFigure,
    TunedGain,
    TuningLine,
)
from amp_studio.validate import NO_RULES, BuilderRules

if TYPE_CHECKING:
    from amp_studio.report import SetReport
    from amp_studio.sim import Trace

_DRAWN, _WITH_DATA = (".pdf", ".html"), (".pdf", ".json")
"""Formats that have the drawings of a motion, and those that have its data."""
_WIDTH, _UNIT = 640, 92
"""Of a drawing: in the width of a page its letters are 8.5 points, and it is no longer than the page."""
_SCENARIOS = ("step", "frequency")
_SHORT = 12


def write_report(
    file: ParameterFile,
    path: Path | str,
    contents: Contents | None = None,
    *,
    source: Path | str | None = None,
    date: datetime | None = None,
    own: BuilderRules = NO_RULES,
    notify: Notify = lambda _note: None,
    motion: Callable[[ParameterFile], Iterable[PrintedFigure]] | None = None,
) -> bool:
    """Write the documentation of a file, as ``print_report`` does, with its motion and its exchanges.

    ``motion`` draws the motion: ``motion_figures`` where it is None, ``motion_apart`` for a program that goes
    on. Returns and raises as ``print_report`` does; OSError for a record of exchanges that cannot be read.
    """
    path, source, contents = Path(path), Path(source) if source else None, contents or Contents()
    ending = path.suffix.lower()
    drawings, data = ending in _DRAWN, ending in _WITH_DATA

    def figures() -> Iterable[PrintedFigure]:
        return motion(file) if motion else motion_figures(file, drawings=drawings, data=data)

    # Begun before the report is even loaded: what takes longest.
    has_motion = (drawings or data) and "motion" not in contents.without
    moved = beside(figures) if has_motion else ()
    from amp_studio.report import print_report

    return print_report(
        file,
        path,
        contents,
        source=source,
        date=date,
        own=own,
        notify=notify,
        added=_added(file, contents, source, moved),
    )


def set_dossier(
    file: ParameterFile,
    contents: Contents,
    ppi: int,
    *,
    source: Path,
    motion: Sequence[PrintedFigure],
    own: BuilderRules = NO_RULES,
    notify: Notify = lambda _note: None,
) -> SetReport:
    """Return the pages of what ``write_report`` writes as PDF; ``motion`` was drawn before
    (``motion_figures``), as that takes longest.
    """
    from amp_studio.report import set_report

    return set_report(
        file,
        contents,
        ppi,
        source=source,
        own=own,
        notify=notify,
        added=_added(file, contents, source, motion),
    )


def _added(
    file: ParameterFile, contents: Contents, source: Path | None, motion: Iterable[PrintedFigure]
) -> Additions:
    """Return what the documentation of a file has beside its values; a chapter left out is not made."""
    return Additions(
        motion=motion,
        exchanges=() if "exchanges" in contents.without or source is None else tuple(exchanges_of(source)),
        tunings=() if "tuning" in contents.without or source is None else tuple(_tunings_of(file, source)),
        checks=tuple(checks_of(file)) if contents.check else (),
        programs=tuple(programs_of(file, contents.programs)),
    )


def motion_figures(
    file: ParameterFile, *, drawings: bool = True, data: bool = True
) -> Iterator[PrintedFigure]:
    """Yield step and frequency response of each axis that can be simulated;
    why one cannot is a figure without a drawing.

    Without ``drawings`` or ``data`` they have none, for a format that prints none.
    """
    from amp_studio.sim import plot_svg

    made = _simulated(file)
    traces = [each for each in made if not isinstance(each, str)]
    for trace in traces:
        drawn = plot_svg(trace, width=_WIDTH, unit=_UNIT, small_print=False) if drawings else ""
        letter = "" if trace.letter in ("", trace.axis) else f" ({trace.letter})"
        title = f"{trace.scenario.capitalize()}, axis {trace.axis}{letter}"
        yield PrintedFigure(title, drawn, (), _run(trace) if data else None)
    if failed := tuple(dict.fromkeys(each for each in made if isinstance(each, str))):
        yield PrintedFigure("Not simulated", "", failed)
    if assumed := tuple(dict.fromkeys(note for each in traces for note in each.assumptions)):
        yield PrintedFigure("What was assumed", "", assumed)


def _simulated(file: ParameterFile) -> list[Trace | str]:
    """Return the printed scenarios of each axis, or why one cannot be simulated; nothing for a family
    without a law.
    """
    from amp_studio.sim import SimulationError, law_of, simulate

    try:
        law = law_of(file.schema.family.family)
    except SimulationError:
        return []
    axes, scenarios = tuple(law.axes(file)), [each for each in _SCENARIOS if each in law.motion.scenarios]
    runs: dict[tuple[str, str], Trace | str] = {}
    # Frequency responses first: what they need, the machine code, is then there for the moves too.
    for scenario in reversed(scenarios):
        for axis in axes:
            try:
                runs[axis, scenario] = simulate(file, scenario, axis, advise=False)
            except SimulationError as error:
                runs[axis, scenario] = str(error)
    return [runs[axis, scenario] for axis in axes for scenario in scenarios]


def _run(trace: Trace) -> dict[str, Any]:
    """Return a simulation as report.json has it: its figures, and the curves as they are drawn."""
    from amp_studio.drawing import panels_json
    from amp_studio.sim import picture_of

    finite = {n: (None if v is None or not isfinite(v) else v, unit) for n, (v, unit) in trace.result.items()}
    return {
        "scenario": trace.scenario,
        "axis": trace.axis,
        "letter": trace.letter or None,
        "model": trace.model,
        "figures": [{"name": n, "value": v, "unit": unit or None} for n, (v, unit) in finite.items()],
        "alarms": [
            {"code": a.code, "message": a.message, "time": a.time_s, "unit": "s"} for a in trace.alarms
        ],
        "panels": panels_json(picture_of(trace), width=_WIDTH, unit=_UNIT),
    }


def checks_of(file: ParameterFile) -> Iterator[CheckedMotion]:
    """Yield what every scenario of a file found; nothing for a family that is not simulated."""
    from amp_studio.motion_paper import check_drawings, checked_motion
    from amp_studio.sim import SimulationError, check_motion

    try:
        checks = tuple(check_motion(file))
        drawn = check_drawings(file, checks)
        yield from (replace(checked_motion(each), drawings=drawn.get(n, ())) for n, each in enumerate(checks))
    except SimulationError:  # a family without a law, a file without axes
        return


def machine_tests_of(file: ParameterFile, axis: str | None = None) -> Iterator[PrintedTest]:
    """Yield the programs and procedures that try each axis of a file out, or one axis named by itself;
    nothing for a family that prints none, and for an axis that cannot be made.
    """
    from amp_studio.sim import SimulationError, machine_tests, simulated_axes

    listed: set[tuple[str, tuple[str, ...]]] = set()
    for each in (axis,) if axis else simulated_axes(file):
        try:
            tests = machine_tests(file, each)
        except SimulationError:
            continue
        letter = axis_letter(file, each) or each
        for test in tests:
            if test.lines and (test.title, test.lines) in listed:  # of the whole machine
                continue
            listed.add((test.title, test.lines))
            name = tick_of_test(test.name, each)
            yield PrintedTest(
                name,
                f"{letter}: {test.title}",
                test.page,
                test.lines,
                tuple((f"{step.do}.", f"{step.see}.") for step in test.steps),
                test.notes,
                test.refusal,
                file.header.done.get(name, ""),
            )


def tick_of_test(name: str, axis: str) -> str:
    """Return what a tick of a test is kept under in the file."""
    return f"{name}@{axis}"


def programs_of(file: ParameterFile, paths: Sequence[Path]) -> Iterator[PrintedProgram]:
    """Yield part programs under a file. Raises ProgramBlockError for what is no program, SimulationError
    where a value is missing or no page prints how the family moves.
    """
    if not paths:
        return
    from amp_studio.drawing import picture_svg
    from amp_studio.programs import read_program
    from amp_studio.sim import ProgramJob, alarm_text, assumed_texts, contour_text, limited_by, path_picture

    for path in paths:
        run = ProgramJob(read_program(path, file)).run(file)
        drawn = ""
        if run.plan.moves:
            drawn = picture_svg(path_picture(file, run), width=_WIDTH, unit=_UNIT, small_print=False)
        yield PrintedProgram(
            text_of_name(path.name),
            run.plan.path.blocks,
            run.plan.time,
            tuple(
                ProgramLimit(row["letter"], row["name"], row["param"], row["time_s"], row["share"])
                for row in limited_by(file, run)
            ),
            contour_text(file, run),
            tuple(f"Line {alarm.line}: {alarm_text(file, alarm)}" for alarm in run.alarms),
            drawn,
            tuple(assumed_texts(file, run)),
        )


def motion_apart(file: ParameterFile) -> tuple[PrintedFigure, ...]:
    """Return ``motion_figures`` from a process apart: the simulator takes 150 MB. Raises
    ReportNotMadeError.
    """
    import pickle

    from amp_studio.report import run_apart

    figures: tuple[PrintedFigure, ...] = pickle.loads(run_apart(__name__, content_of(file)))  # noqa: S301  # the program itself has written it
    return figures


def answer(asked: BinaryIO, out: BinaryIO) -> None:
    """Draw what ``motion_apart`` asks for, in the process apart."""
    import pickle

    pickle.dump(tuple(motion_figures(read_content(Path("the file"), asked.read()))), out)


def _tunings_of(file: ParameterFile, source: Path) -> Iterator[TuningLine]:
    """Yield what the record of tunings has of a file, oldest first, and which gains it still has; raises
    OSError.
    """
    if not os.path.lexists(real_path(source).parent / TUNINGS):  # most files have none
        return
    from amp_studio.sim import read_tunings, value_at

    for each in read_tunings(source):
        gains = tuple(
            TunedGain(number, name, before, after, value_at(file, number) == after)
            for number, name, before, after in each.gains
        )
        figures = tuple(TunedFigure(*figure) for figure in each.figures)
        when = local_time(each.when)
        yield TuningLine(when, each.who, each.axis, each.aim, gains, figures, each.plant, each.note)


def exchanges_of(source: Path) -> Iterator[ExchangeLine]:
    """Yield what the record of exchanges has of a file, oldest first; raises OSError."""
    real = real_path(source)
    if not os.path.lexists(
        real.parent / RECORD
    ):  # most files have none, and the room of exchanges takes 20 ms to load
        return
    from amp_studio.transfer.client import read_exchanges

    for each in read_exchanges(real.parent, text_of_name(real.name)):
        yield ExchangeLine(
            local_time(each.when),
            each.who,
            each.verb,
            each.control,
            each.before[:_SHORT],
            each.after[:_SHORT],
            each.text,
        )
