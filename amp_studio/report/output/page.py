"""The report as one self-contained web page that can be printed."""

from __future__ import annotations

from base64 import b64encode
from pathlib import Path

from amp_studio.report.language import ENGLISH, Language, language_of
from amp_studio.report.model import MARKS, Report
from amp_studio.report.parameter.manual_page import GRADES
from amp_studio.report.templating.templates import filled
from amp_studio.report.wording import printable
from amp_studio.schema import isolated


def render_html(report: Report, own: Path | None = None) -> bytes:
    """Return the page in UTF-8; every text is escaped. ``own`` is a template of the project.
    Raises TemplateMistakeError.
    """
    language = language_of(report.contents.language, report.family_id)
    # With its grade, by which the template chooses a colour: the titles are in a language.
    help_texts = {
        parameter: [(GRADES.get(title, ""), language.of_help(title), text) for title, text in parts]
        for parameter, parts in report.help.items()
    }
    return filled_page("report.html.j2", own, language, report=report, marks=MARKS, help=help_texts)


def filled_page(name: str, own: Path | None = None, language: Language = ENGLISH, **values: object) -> bytes:
    """Return a template of a page with its values in UTF-8, escaped. Raises TemplateMistakeError."""
    settings = {"autoescape": True, "finalize": _cleaned}
    return filled(name, values, settings, {"drawing": _drawing}, own, language).encode("utf-8")


def _drawing(svg: str) -> str:
    """Return a drawing as the address of an image that is in the page itself:
    what it names stays apart from the page.
    """
    # As an image no script in it runs, and its ids and styles meet none of the page.
    return f"data:image/svg+xml;base64,{b64encode(svg.encode()).decode()}"


def _cleaned(value: object) -> object:
    """Return a text of the file without control characters; text of the template is not changed."""
    # Exactly str: Markup is a text of the template, already escaped.
    return isolated(printable(value)) if type(value) is str else value
