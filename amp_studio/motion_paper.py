"""The paper of one simulation: tuning record of an axis, machine out of a record, or any other result; and
that of a check of every scenario.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from datetime import datetime
from pathlib import Path

from amp_studio.drawing import Scene, scene_svg
from amp_studio.files import Notify, ParameterFile, user
from amp_studio.pictures import draw_homing, draw_spindle, draw_usual_approach, pictures_of
from amp_studio.report import (
    CheckDrawing,
    CheckedFigure,
    CheckedMotion,
    Language,
    Paper,
    PaperTable,
    PrintedFigure,
    language_of,
    write_paper,
)
from amp_studio.scenarios import CHARTS
from amp_studio.schema import unit_text
from amp_studio.sim import MotionCheck, Trace, address_of, figure_rows, named_parameter, plot_svg, value_text

PAPERS = (".pdf", ".html")
_WIDTH, _UNIT, _HEIGHT = 640, 92, 270
_PLANS = 3
"""Pairs of axes whose plan is printed, at most."""
GivenFigure = tuple[str, str, str]
"""``model.…``, its value, and where it is from: a file that `identify` wrote, or the command."""
_KINDS = {"tune": "Tuning record", "identify": "Machine from a record"}
_BEFORE = "_before"


def write_motion_paper(
    file: ParameterFile,
    name: str,
    trace: Trace,
    path: Path,
    notify: Notify = lambda _note: None,
    *,
    before: Trace | None = None,
    chart: str = CHARTS[0],
    machine: Sequence[GivenFigure] = (),
    language: str = "en",
) -> None:
    """Write the result of a simulation as a document; ``name`` is the file that it was made with, ``machine``
    what was given of the machine, ``language`` a code of ``language_codes``. Raises ValueError, SaveError.
    """
    paper = motion_paper(file, name, trace, before=before, chart=chart, machine=machine, language=language)
    write_paper(paper, path, notify)


def write_check_paper(
    file: ParameterFile,
    name: str,
    checks: Sequence[MotionCheck],
    path: Path,
    notify: Notify = lambda _note: None,
    *,
    language: str = "en",
) -> None:
    """Write what every scenario of a file found as a document; ``name`` is that of the file.
    Raises ValueError, SaveError.
    """
    words = language_of(language, file.schema.family.family)
    rows = tuple(
        (words.text(check.verdict), scenario, check.letter, figures, why)
        for check in checks
        for scenario, figures, why in (checked_motion(check).printed(words),)
    )
    heads = tuple(map(words.text, ("Verdict", "Scenario", "Axis", "Figures", "Why")))
    counts = Counter(check.verdict for check in checks)
    facts = (
        (words.text("File"), name),
        (words.text("Machine"), file.header.name),
        (words.text("Control"), file.schema.family.name),
        *((words.text(verdict).capitalize(), str(count)) for verdict, count in counts.items()),
    )
    title = words.text("Check in motion")
    table = PaperTable(title, heads, rows, (1.2, 1.6, 0.7, 4.0, 4.0))
    date = datetime.now().astimezone()
    figures = tuple(
        PrintedFigure(
            words.sentence(each.title), words.drawing(each.svg), tuple(map(words.sentence, each.notes))
        )
        for drawn in check_drawings(file, checks).values()
        for each in drawn
    )
    paper = Paper(title, file.header.name or name, facts, (table,), date, figures=figures, language=language)
    write_paper(paper, path, notify)


def check_drawings(file: ParameterFile, checks: Sequence[MotionCheck]) -> dict[int, tuple[CheckDrawing, ...]]:
    """Return the pictures of the page Machine by the place of the check that has them, in English: the course
    of every homing, the plan of each pair of axes, the spindle.
    """
    pictures = {each.name: each for each in pictures_of(file)}
    found = dict[int, tuple[CheckDrawing, ...]]()
    is_planned = False
    for n, check in enumerate(checks):
        if check.trace is None:
            continue
        if check.trace.course is not None:
            found[n] = (_check_drawing(draw_homing(file, check.trace)),)
        # The plan is of pairs of axes: once for all checks of the travel.
        elif check.scenario == "travel" and "travel" in pictures and not is_planned:
            is_planned = True
            plans = pictures["travel"]
            parts = [key for key, _ in plans.parts][:_PLANS]
            found[n] = tuple(_check_drawing(draw_usual_approach(plans, part)) for part in parts)
        elif check.scenario == "spindle" and "gears" in pictures:
            found[n] = (_check_drawing(draw_spindle(pictures["gears"], check.trace)),)
    return found


def _check_drawing(scene: Scene) -> CheckDrawing:
    # Several plans have one title: the pair of axes parts them.
    where = scene.subtitle.partition(",")[0] if scene.name == "travel" else ""
    return CheckDrawing(
        f"{scene.title} {where}".rstrip(),
        scene_svg(scene, _WIDTH, _HEIGHT, notes=False),
        tuple(note.text for note in scene.notes if note.wrong or note.is_remark),
    )


def checked_motion(check: MotionCheck) -> CheckedMotion:
    """Return what a scenario found as it is printed."""
    figures = tuple(
        CheckedFigure(name.replace("_", " "), float(value), unit, value_text(float(value), unit_text(unit)))
        for name, (value, unit) in check.figures.items()
        if value is not None
    )
    # The reason often is the message of the alarm: printed once.
    alarms = tuple((each.code, each.message) for each in check.alarms if each.message != check.why)
    return CheckedMotion(check.verdict, check.scenario, check.letter, figures, check.why, alarms)


def motion_paper(
    file: ParameterFile,
    name: str,
    trace: Trace,
    *,
    before: Trace | None = None,
    chart: str = CHARTS[0],
    machine: Sequence[GivenFigure] = (),
    language: str = "en",
) -> Paper:
    """Return the result of a simulation as a paper: what was recommended, figures, the machine that was taken
    and how it was found, doubts and assumptions, the picture.
    """
    words = language_of(language, file.schema.family.family)
    worded = words.sentence
    drawn = words.drawing(plot_svg(trace, before, chart=chart, width=_WIDTH, unit=_UNIT, small_print=False))
    facts = (
        ("File", name),
        ("Machine", file.header.name),
        ("Control", file.schema.family.name),
        ("Axis", trace.axis_title),
        ("Model", worded(trace.model)),
        ("Made by", user()),
    )
    return Paper(
        worded(_KINDS.get(trace.scenario, "Simulation")),
        f"{words.scenario(trace.scenario)}, {name}",
        tuple((worded(head), text) for head, text in facts if text),
        tuple(_worded(table, words) for table in _tables(file, trace, machine, words) if table.rows),
        datetime.now().astimezone(),
        figures=(PrintedFigure(worded("Picture"), drawn),),
        signed=("Checked by", "Released by"),
        language=language,
    )


def _worded(table: PaperTable, words: Language) -> PaperTable:
    """Return a table in a language; names of parameters and codes of alarms have no other words."""
    return replace(
        table,
        title=words.sentence(table.title),
        heads=tuple(map(words.sentence, table.heads)),
        rows=tuple(tuple(map(words.sentence, row)) for row in table.rows),
    )


def _tables(
    file: ParameterFile, trace: Trace, machine: Sequence[GivenFigure], words: Language
) -> Iterator[PaperTable]:
    """Yield the tables of the paper; which of the figures there are, depends on the scenario."""
    alarms = tuple((each.code, value_text(each.time_s, "s"), each.message) for each in trace.alarms)
    yield PaperTable("Alarms", ("Alarm", "Time", "Message"), alarms, (1.0, 1.0, 4.0))
    yield PaperTable(
        "Recommended",
        ("Parameter", "Name", "In the file", "Recommended", "Reason and price"),
        tuple(_recommended(file, trace, words)),
        (1.6, 2.0, 1.2, 1.2, 4.0),
    )
    if trace.scenario == "identify":
        yield PaperTable("Figures", ("Figure", "Value"), tuple(figure_rows(trace)), (1.0, 1.0))
    # A scenario that changes values has its figures before and after: side by side.
    elif any(each.endswith(_BEFORE) for each in trace.result):
        heads = ("Figure", "In the file", "Recommended")
        yield PaperTable("Figures", heads, tuple(_before_and_after(trace)), (1.0, 1.0, 1.0))
    else:
        rows = tuple((_words(key), _figure(trace, key)) for key in trace.result)
        yield PaperTable("Figures", ("Figure", "Value"), rows, (1.0, 1.0))
    yield PaperTable("Doubts", ("Doubt",), tuple((text,) for text in trace.doubts))
    yield PaperTable("Given of the machine", ("Figure", "Value", "From"), tuple(machine), (1.0, 1.0, 1.0))
    yield PaperTable("Machine and assumptions", ("Assumption",), tuple((t,) for t in trace.assumptions))


def _recommended(file: ParameterFile, trace: Trace, words: Language) -> Iterator[tuple[str, ...]]:
    """Yield parameter, name, value in the file, recommended one, and the reason with its price."""
    for each in trace.recommendations:
        address = address_of(file, each.parameter, trace.axis)
        present = file.get(address) if address else None
        known = file.schema.parameters.get(each.parameter)
        yield (
            named_parameter(file, each.parameter, trace.axis),
            known.name if known else each.parameter,
            # Nine digits, as it is set: the paper is what is keyed in again.
            "not set" if present is None else value_text(float(present.value), present.unit, 9),
            value_text(each.value, each.unit, 9),
            " ".join(words.sentence(text) for text in (each.why, each.price) if text),
        )


def _before_and_after(trace: Trace) -> Iterator[tuple[str, str, str]]:
    for key in trace.result:
        if not key.endswith(_BEFORE):
            old = f"{key}{_BEFORE}"
            yield _words(key), _figure(trace, old) if old in trace.result else "", _figure(trace, key)


def _words(key: str) -> str:
    return key.replace("_", " ")


def _figure(trace: Trace, key: str) -> str:
    value, unit = trace.result[key]
    return "–" if value is None else value_text(value, unit, 5)
