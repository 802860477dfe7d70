"""The report as one web page: nothing is loaded from elsewhere, and it prints."""

from __future__ import annotations

from pathlib import Path

from .model import MARKS, Listing, Report, counted


def render_html(report: Report) -> bytes:
    """Return the page in UTF-8; every text is escaped by the template engine."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    template = environment.get_template("report.html.j2")
    is_listing = lambda part: isinstance(part, Listing)  # noqa: E731  # a test of the template, in one word
    environment.tests["listing"] = is_listing
    return template.render(report=report, marks=MARKS, counted=counted).encode("utf-8")
