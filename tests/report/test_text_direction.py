"""A report of a machine whose name and notes are in Hebrew."""

import html

from amp_studio.files import new_file
from amp_studio.files.notes import set_machine_note, set_value_note
from amp_studio.report.build import build_report
from amp_studio.report.output.page import render_html
from amp_studio.report.output.pdf import render_pdf, typst_source

NOTE, ISOLATED = "סטייה -3.5 mm בציר X", "\u2068סטייה \u2066-3.5 mm\u2069 בציר X\u2069"


def test_a_number_in_a_hebrew_note_is_printed_as_it_was_written() -> None:
    """The PDF had "3.5-" and, far from it, "mm"; the page in a browser, too."""
    file = new_file("9pc", "mill", ["X"], "bare")
    file.header.name = "כרסומת 3"
    set_machine_note(file, NOTE)
    set_value_note(file, ("servo.excess_error", "1"), NOTE)
    report = build_report(file)
    assert typst_source(report).count(ISOLATED) == 2
    page = html.unescape(render_html(report).decode())
    assert page.count(ISOLATED) >= 2
    assert NOTE not in page
    assert render_pdf(report).remark == "", "still PDF/A: no font has to show what is not seen"
