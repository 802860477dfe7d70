"""The report as PDF: a template writes Typst source, and Typst sets the pages.

Typst's built-in fonts are used, so that a report looks the same on every machine
(fonts of the system only for scripts that Typst has no font for), and nothing
but the report's date depends on the time of printing.
"""

from __future__ import annotations

import re
from pathlib import Path

from .model import MARKS, Listing, Report, printable
from .wording import counted

_TEMPLATES = Path(__file__).parent / "templates"
_BREAK = "\u200b"
"""Zero-width space: a possible line break."""
_LONG_RUN = re.compile(r"[^\s\u200b]{17,}")
_JOINT = re.compile(r"\\.|[^\w-]|_|[^\W_]{8}")
_FOREIGN = re.compile(
    r"[\u0700-\u1cff\u2e80-\ua63f\ua960-\ud7ff\uf900-\ufaff\uff00-\uffef\U00010000-\U0010ffff]"
)
"""Scripts missing in Typst's fonts (Chinese, Japanese, Korean, Thai, …); they contain Latin, Greek and Cyrillic."""
FONT = "Libertinus Serif"
"""The font of a PDF, also in its drawings."""
_FAMILY = re.compile(r'font-family="[^"]*"')
_BRIEF = 40
"""Most characters of a text in the page header."""


class Exact(str):
    """A text without added line-break places."""

    __slots__ = ()


class _Source(str):
    """Typst source that a macro of a template has written."""

    __slots__ = ()


def typst_literal(value: object) -> str:
    """Return a value of the template as a Typst literal, so that no text can become markup."""
    if isinstance(value, _Source):
        return value
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    text = printable(str(value)).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{text if isinstance(value, Exact) else _breakable(text)}"'


def _breakable(text: str) -> str:
    """Return a text with break places in long words, so that it stays in its column."""
    return _LONG_RUN.sub(lambda run: _JOINT.sub(rf"\g<0>{_BREAK}", run.group()), text)


def typst_source(report: Report) -> str:
    """Return the report as Typst."""
    return filled_template("report.typ.j2", report=report, marks=MARKS, counted=counted)


def filled_template(name: str, **values: object) -> str:
    """Return a template of Typst source with its values, each as a literal."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(_TEMPLATES),
        finalize=typst_literal,
        autoescape=False,  # noqa: S701  # every expression becomes a Typst literal
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters["exact"] = Exact
    environment.filters["source"] = _Source
    environment.filters["drawing"] = _drawing
    environment.filters["brief"] = lambda text: text if len(text) <= _BRIEF else text[: _BRIEF - 1] + "…"
    environment.filters["tied"] = lambda text: text.replace(" ", "\u00a0").replace(",\u00a0", ", ")
    environment.tests["listing"] = lambda part: isinstance(part, Listing)
    return environment.get_template(name).render(values)


def _drawing(svg: str) -> Exact:
    """Return a drawing in the font of the page, with spaces that stay."""
    return Exact(
        _FAMILY.sub(f'font-family="{FONT}"', svg).translate({0x2002: "\u00a0", 0x2003: "\u00a0\u00a0"})
    )


def render_pdf(report: Report) -> bytes:
    """Return the PDF; equal reports have equal bytes."""
    return typeset(typst_source(report))


def typeset(source: str) -> bytes:
    """Return the PDF of Typst source."""
    import typst

    own_fonts = _FOREIGN.search(source) is None
    # The root is given because Typst takes the working folder otherwise, which may be gone;
    # the library's stubs require the type of the source, the library itself does not.
    pages = typst.compile(  # type: ignore[call-overload]
        source.encode("utf-8"), root=_TEMPLATES, format="pdf", ignore_system_fonts=own_fonts
    )
    assert isinstance(pages, bytes)
    return pages
