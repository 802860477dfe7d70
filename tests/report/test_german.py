"""The German report of each example: no English sentence outside names, the control's words and the help,
which is marked.
"""

import re
from collections.abc import Iterator
from dataclasses import fields, is_dataclass
from datetime import UTC, datetime
from functools import cache
from typing import Any

import pytest

from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.report.build import build_report
from amp_studio.report.contents import Contents
from amp_studio.report.language import language_of
from amp_studio.report.model import GridLine, Listing, Report, ReportRow
from amp_studio.report.output.page import render_html
from amp_studio.report.output.text import render_text
from amp_studio.schema import Value, fact_texts
from tests.campaigns import some

FUNCTION_WORDS = re.compile(
    r"\b(the|is|are|of|and|with|not|which|that|to|be|has|have|for|by|from|this|when|whose|its|where|no|it|at|than"
    r"|or|only|as|into|one|each|does|while|before|after|without|there)\b"
)
"""Words that no German sentence has; names of parameters may."""
EXAMPLES = {path.parent.name: path for path in sorted(examples_folder().glob("*/*.amp"))}
CONTROL_WORDS = {
    ReportRow: {
        "id",
        "name",
        "group",
        "value",
        "figure",
        "default",
        "plain_default",
        "detail",
        "note",
        "unit",
    },
    GridLine: {"id", "name", "default"},
    Listing: {"title"},
    Report: {
        "title",
        "family",
        "remarks",
        "remarked",
        "help",
        "contents",
        "exchanges",
        "axis_heads",
        "program",
    },
}
"""Fields with names, and with what a control or a person wrote."""


@cache
def german(name: str) -> Report:
    file = open_file(EXAMPLES[name]).file
    return build_report(
        file, Contents(language="de", inactive=True, sort="steps"), date=datetime(2026, 11, 28, tzinfo=UTC)
    )


_TEXT_OF_DRAWING = re.compile(r">\s*([^<>]*[a-z][^<>]*)<")


def texts_of(record: Any) -> Iterator[str]:
    """Yield each text of a record that is no control's word."""
    if isinstance(record, str):
        yield from _TEXT_OF_DRAWING.findall(record) if record.startswith("<svg") else (record,)
    elif is_dataclass(record):
        left_out = CONTROL_WORDS.get(type(record), set())
        for field in fields(record):
            if field.name not in left_out:
                yield from texts_of(getattr(record, field.name))
    elif isinstance(record, (tuple, list)):
        for entry in record:
            yield from texts_of(entry)


def english_in(report: Report) -> list[str]:
    """Return the texts that read as English once names of parameters and choices are taken out."""
    words = language_of("de")
    types = {dict(report.machine)[name] for name in ("Machine type", "Application")}
    names = types | {report.family} | {name for row in report.rows() for name in (row.name, row.figure)}
    found = []
    for text in dict.fromkeys(texts_of(report)):
        bare = words.title(text)
        for name in sorted(names, key=len, reverse=True):
            if len(name) > 3:
                bare = bare.replace(name, "")
        if FUNCTION_WORDS.search(bare):
            found.append(text)
    return found


GERMAN = [
    name
    for name, path in EXAMPLES.items()
    if fact_texts(open_file(path).file.schema.family.family, "de").messages
]


@pytest.mark.parametrize("name", some(GERMAN))
def test_a_german_report_has_no_english_sentence(name: str) -> None:
    assert english_in(german(name)) == []


def test_the_help_that_stays_english_is_marked_once() -> None:
    page = render_html(german("mill-1394")).decode("utf-8")
    assert page.count("Die Hilfe zu den Parametern ist englisch.") == 1


def test_figures_units_and_dates_are_written_as_in_german() -> None:
    page = render_text(german("mill-1394")).decode("utf-8")
    assert "28.11.2026 " in page
    assert "253,998 mm/min" in page
    assert "253,998 °/min" in page
    assert "500 1/min" in page  # of the spindle
    assert not re.search(r"\d\.\d+ (mm/min|1/min)", page)


def test_a_rule_has_german_words_with_the_values_in_it() -> None:
    file = open_file(EXAMPLES["mill-1394"]).file
    file.set(("servo.excess_error", "1"), Value(0.5, "mm"))
    messages = [note.message for note in build_report(file, Contents(language="de")).notes]
    assert any("mehr als Excess Error 0,5 mm zulässt" in message for message in messages)


def test_sections_and_figures_of_a_manual_keep_their_point() -> None:
    page = render_html(german("57c422b-label-press")).decode("utf-8")
    assert "dem Text von Abschnitt 4.5." in page
    loops = next(f for f in german("mill-1394").pictures if "Regelkreise S" in f.title)
    assert ", Seite 7-10<" in loops.svg
