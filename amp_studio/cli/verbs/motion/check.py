"""Every scenario that a file allows: what of the machine in motion is good, and what is not."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from amp_studio.cli.arguments import AXIS, JSON, OUTPUT, PATH, TEXT
from amp_studio.cli.console import print_json
from amp_studio.cli.errors import UsageError
from amp_studio.cli.motion.text import as_json, counts, figure_text, text
from amp_studio.cli.opened import opened
from amp_studio.cli.output import check_replaced
from amp_studio.cli.verb import Options, Verb

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile
    from amp_studio.sim import MotionCheck

VERB = Verb(
    __doc__,
    PATH,
    AXIS,
    OUTPUT.but(required=False, help="file to write: .pdf, .html"),
    JSON,
    *TEXT,
    writes=("output",),
    sections=("scenarios",),
    examples=("amp-studio check MILL_1394.amp", "amp-studio check MILL_1394.amp --axis X -o motion.html"),
)
PAPERS = (".pdf", ".html")


def run(options: Options) -> int:
    """Check a file in motion: 1 where something is bad."""
    if options.output:
        check_replaced(options.output, options.path)
        if options.output.suffix.lower() not in PAPERS:
            raise UsageError(f"{options.output}: a check is written as {' or '.join(PAPERS)}")
    machine = opened(options.path, options)
    file = machine.file
    checks = machine.check_motion(machine.axis(options.axis) if options.axis else None)
    if options.output:
        _write(options, file, checks)
    if options.json:
        print_json(as_json(file, checks))
    else:
        print(text(checks))
    return int(any(check.verdict == "bad" for check in checks))


def _write(options: Options, file: ParameterFile, checks: Sequence[MotionCheck]) -> None:
    from amp_studio.files import write_atomic

    rows = [_row(check) for check in checks]
    head = ("Verdict", "Scenario", "Axis", "Figures", "What is not good")
    title = f"{file.header.name or options.path.stem}: in motion"
    summary = ", ".join(f"{count} {verdict}" for verdict, count in counts(checks).items())
    as_document = _html if options.output.suffix.lower() == ".html" else _pdf
    write_atomic(options.output, as_document(title, summary, head, rows), keep_backup=False)


def _row(check: MotionCheck) -> tuple[str, ...]:
    """Return verdict, scenario, axis, figures and reason of a check, in words."""
    figures = "; ".join(figure_text(name, value, unit) for name, (value, unit) in check.figures.items())
    alarms = (f"{alarm.code}." for alarm in check.alarms if alarm.code not in check.why)
    return check.verdict, check.scenario, check.letter, figures, " ".join((check.why, *alarms)).strip()


def _html(title: str, summary: str, head: Sequence[str], rows: Sequence[Sequence[str]]) -> bytes:
    from html import escape

    body = "".join("<tr>" + "".join(f"<td>{escape(cell)}</td>" for cell in row) + "</tr>\n" for row in rows)
    return (
        '<!doctype html>\n<html lang="en"><meta'
        f' charset="utf-8"><title>{escape(title)}</title>\n<style>body{{font:14px'
        " sans-serif;margin:2em}td,th{text-align:left;padding:.2em .8em;border-bottom:1px solid"
        f" #ccc}}</style>\n<h1>{escape(title)}</h1>\n<p>{escape(summary)}</p>\n<table>\n<tr>"
        + "".join(f"<th>{cell}</th>" for cell in head)
        + f"</tr>\n{body}</table>\n</html>\n"
    ).encode()


def _pdf(title: str, summary: str, head: Sequence[str], rows: Sequence[Sequence[str]]) -> bytes:
    import json
    from datetime import datetime

    from amp_studio.report import typeset

    cells = ", ".join(f"[#{json.dumps(cell, ensure_ascii=False)}]" for row in (head, *rows) for cell in row)
    source = (
        f"#set document(title: {json.dumps(title, ensure_ascii=False)})\n"
        '#set page(paper: "a4", flipped: true, margin: 15mm)\n#set text(size: 9pt)\n'
        f"= #{json.dumps(title, ensure_ascii=False)}\n#{json.dumps(summary)}\n"
        f"#table(columns: (auto, auto, auto, 1fr, 1fr), stroke: 0.4pt, {cells})\n"
    )
    return typeset(source, datetime.now().astimezone())
