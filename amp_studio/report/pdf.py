"""The report as PDF: a template writes Typst, Typst sets the pages.

Only Typst's own fonts are used, so that a report looks alike on every machine,
and nothing but the report's date tells when it was made.
"""

from __future__ import annotations

import re
from pathlib import Path

from .model import MARKS, Listing, Report, counted

_LONG_RUN = re.compile(r"[^\s\u200b]{13,}")
_WORD = re.compile(r"[^\W\d_]{1,16}")


def typst_literal(value: object) -> str:
    """Write a value of the template as a Typst literal, so that no text can be taken for markup."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    return '"' + "".join(_character(c) for c in _breakable(str(value))) + '"'


def _character(c: str) -> str:
    if c in '"\\':
        return "\\" + c
    if c.isprintable():
        return c
    return " " if ord(c) < 32 or 0x7F <= ord(c) < 0xA0 or 0xD800 <= ord(c) < 0xE000 else f"\\u{{{ord(c):x}}}"


def _breakable(text: str) -> str:
    """Let a long run of signs without a space be broken; a word of usual length stays whole."""

    def broken(found: re.Match[str]) -> str:
        run = found.group()
        return run if _WORD.fullmatch(run) else "\u200b".join(run[n : n + 6] for n in range(0, len(run), 6))

    return _LONG_RUN.sub(broken, text)


def typst_source(report: Report) -> str:
    """Return the report as Typst."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(Path(__file__).parent / "templates"),
        finalize=typst_literal,
        autoescape=False,  # noqa: S701  # every expression becomes a Typst literal
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.tests["listing"] = lambda part: isinstance(part, Listing)
    return environment.get_template("report.typ.j2").render(
        report=report, marks=MARKS, counted=counted
    )


def render_pdf(report: Report) -> bytes:
    """Return the PDF; the same report gives the same bytes."""
    import typst

    pages = typst.compile(typst_source(report).encode("utf-8"), format="pdf", ignore_system_fonts=True)
    assert isinstance(pages, bytes)
    return pages
