"""The report as one self-contained web page that can be printed."""

from __future__ import annotations

from base64 import b64encode
from pathlib import Path

from .model import MARKS, Listing, Report, printable
from .wording import counted


def render_html(report: Report) -> bytes:
    """Return the page in UTF-8; every text is escaped by the template engine."""
    return filled_page("report.html.j2", report=report, marks=MARKS, counted=counted)


def filled_page(name: str, **values: object) -> bytes:
    """Return a template of a page with its values in UTF-8, escaped."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True,
        finalize=_cleaned,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["drawing"] = _drawing
    environment.tests["listing"] = lambda part: isinstance(part, Listing)
    return environment.get_template(name).render(values).encode("utf-8")


def _drawing(svg: str) -> str:
    """Return a drawing as the address of an image that is in the page itself: what it names stays apart from the page."""
    return f"data:image/svg+xml;base64,{b64encode(svg.encode()).decode()}"


def _cleaned(value: object) -> object:
    """Return a text of the file without control characters; text of the template is not changed."""
    return printable(value) if type(value) is str else value
