"""The report as PDF: a template writes Typst source, and Typst sets the pages.

Typst's built-in fonts are used, so that a report looks the same on every machine
(fonts of the system only for scripts that Typst has no font for), and nothing
but the report's date depends on the time of printing.
"""

from __future__ import annotations

import contextlib
import json
import os
import re
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any

from amp_studio.report.language import ENGLISH, Language, language_of
from amp_studio.report.model import MARKS, Report
from amp_studio.report.templating.templates import TEMPLATES, TemplateMistakeError, filled, line_of_source
from amp_studio.report.wording import printable
from amp_studio.schema import UNITS, Address, isolated, unit_text

from .data import render_json
from .typesetter import compiled, set_pdf

_BREAK = "\u200b"
"""Zero-width space: a possible line break."""
_LONG_RUN = re.compile(r"[^\s\u200b]{17,}")
_JOINT = re.compile(r"(?<![^\W_])[^\W\d_]{1,12}(?![^\W_])|(\\.|[^\w-]|_|[^\W_]{8})")
"""What a break may follow, as a group: a sign, an underscore, eight signs of a figure or a long word."""
_SENTENCE, _LONGEST_WORD = 4, 30
"""Blanks that make a text a sentence, whose column is wide, and letters of its words that stay whole there
(Amplitudenreserve)."""
_FOREIGN = r"[\u0700-\u1cff\u2e80-\ua63f\ua960-\ud7ff\uf900-\ufaff\uff00-\uffef\U00010000-\U0010ffff]"
"""Scripts missing in Typst's fonts (Chinese, Japanese, Korean, Thai, …); they contain Latin,
Greek and Cyrillic."""
_FONT = "Libertinus Serif"
"""The font of a PDF, also in its drawings."""
_PACKAGE = re.compile(r'(?:import|include)\s*"@')
_FAMILY = re.compile(r'font-family="[^"]*"')
_BRIEF = 40
"""Most characters of a text in the page header."""


class PdfContent(bytes):
    """A PDF, and what a person has to know about it."""

    remark: str = ""
    """Why it is no PDF/A and PDF/UA; empty where it is."""

    @classmethod
    def with_remark(cls, content: bytes, remark: str) -> PdfContent:
        """Return a content with its remark."""
        pdf = cls(content)
        pdf.remark = remark
        return pdf


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
    # The backslash first: it is what the quote is then escaped with.
    text = printable(str(value)).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{text if isinstance(value, Exact) else isolated(_breakable(text))}"'


def _breakable(text: str) -> str:
    """Return a text with break places in long words, so that it stays in its column."""
    is_sentence = text.count(" ") >= _SENTENCE

    def broken(run: re.Match[str]) -> str:
        if is_sentence and len(run[0]) <= _LONGEST_WORD and run[0].strip(".,;:()").isalpha():
            return run[0]
        return _JOINT.sub(lambda at: at[0] + (_BREAK if at[1] else ""), run[0])

    return _LONG_RUN.sub(broken, text)


@dataclass(frozen=True, slots=True)
class PrintedPlace:
    """Where a value is in a report: the page, counted from 1, and points from its left and its upper edge."""

    page: int
    x: float
    y: float


@dataclass(frozen=True)
class SetReport:
    """A report as pictures of its pages, which knows where each value is on them."""

    pages: tuple[bytes, ...]
    """Each as PNG."""
    source: str
    marks: str
    """What Typst knows of the marks at the values, as JSON."""

    def places(self) -> dict[Address, PrintedPlace]:
        """Return where each value is; a project's template can leave them out."""
        found = json.loads(self.marks)
        return {
            (anchor.rpartition("@")[0], anchor.rpartition("@")[2]): PrintedPlace(page, x, y)
            for anchor, page, x, y in (found[0] if found else ())
        }


def typst_source(report: Report, own: Path | None = None, *, places: bool = False) -> str:
    """Return the report as Typst; ``own`` is a template of the project. Raises TemplateMistakeError.

    With ``places`` it has marks at each value.
    """
    source = filled_template(
        "report.typ.j2",
        own,
        language_of(report.contents.language, report.family_id),
        report=report,
        marks=MARKS,
        places=places,
    )
    # In what it has written, not in the template: an expression could write the import.
    if own is not None and _PACKAGE.search(source):
        raise TemplateMistakeError(own, "imports a package of Typst, which would be loaded from the network")
    return source


def filled_template(
    name: str, own: Path | None = None, language: Language = ENGLISH, **values: object
) -> str:
    """Return a template of Typst source with its values, each as a literal. Raises TemplateMistakeError."""
    settings = {"finalize": typst_literal, "autoescape": False}  # every expression becomes a Typst literal
    filters = {"exact": Exact, "source": _Source, "drawing": _drawing, "brief": _brief, "tied": _tied}
    values = {"whole_units": _whole_units(language), **values}
    return filled(name, values, settings, filters, own, language)


def _whole_units(language: Language) -> str:
    """Return a pattern for the units with a stroke, the longest first: a line would break behind it."""
    units = {*map(unit_text, UNITS), *language.units.values()}
    parted = sorted((unit for unit in units if "/" in unit), key=len, reverse=True)
    return "|".join(map(re.escape, parted))


def _brief(text: str) -> str:
    return text if len(text) <= _BRIEF else text[: _BRIEF - 1] + "…"


def _tied(text: str) -> str:
    return text.replace(" ", "\u00a0").replace(",\u00a0", ", ")


def _drawing(svg: str) -> Exact:
    """Return a drawing in the font of the page, with spaces that stay."""
    return Exact(
        _FAMILY.sub(f'font-family="{_FONT}"', svg).translate({0x2002: "\u00a0", 0x2003: "\u00a0\u00a0"})
    )


def render_pdf(report: Report, own: Path | None = None) -> PdfContent:
    """Return the PDF; equal reports have equal bytes. ``own`` is a template of the project: for a process
    apart. Raises TemplateMistakeError, ReportNotMadeError.
    """
    source = typst_source(report, own)
    # With the machine in it the PDF can be opened as a file again years later.
    attached = {"machine": report.machine_file, "report": render_json(report).decode("utf-8")}
    if own is None:
        return PdfContent.with_remark(
            *set_pdf(source, _options(source, TEMPLATES) | {"sys_inputs": attached})
        )
    with _mistakes(source, own):
        return PdfContent.with_remark(
            *compiled(source, _options(source, own.parent) | {"sys_inputs": attached})
        )


def set_pages(report: Report, ppi: int, own: Path | None = None) -> SetReport:
    """Return each page as PNG, ``ppi`` pixels to the inch; ``own`` is a template of the project.
    Raises TemplateMistakeError.
    """
    import tempfile

    import typst

    source = typst_source(report, own, places=True)
    with contextlib.ExitStack() as stack, _mistakes(source, own):
        root = (
            own.parent
            if own
            else Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="amp-studio-")))
        )
        # Typst sets a file once for both questions, and a text once for each: nearly half of the time.
        # Inside of the root: Typst reads nothing else.
        handle, name = tempfile.mkstemp(dir=root, suffix=".typ")
        stack.callback(os.unlink, name)
        with os.fdopen(handle, "wb") as file:
            file.write(source.encode("utf-8"))
        compiler = typst.Compiler(name, **_options(source, root))
        pages = compiler.compile(format="png", ppi=ppi)
        marks = compiler.query("<amp-places>", field="value")
    return SetReport(tuple([pages] if isinstance(pages, bytes) else pages or ()), source, marks)


@contextlib.contextmanager
def _mistakes(source: str, own: Path | None) -> Iterator[None]:
    """Turn what Typst refuses of a project's template into a TemplateMistakeError with its line."""
    from typst import TypstError

    try:
        yield
    except TypstError as error:
        if own is None:
            raise
        line = line_of_source(own, source, error.diagnostic)
        raise TemplateMistakeError(own, f"{line}Typst: {error}") from None


def typeset(source: str, date: datetime) -> PdfContent:
    """Return the PDF of Typst source, made at a date with its zone; raises ReportNotMadeError."""
    # The date of the paper and not that of the run: equal papers are equal files.
    when = {"timestamp": date.replace(microsecond=0).isoformat()}
    return PdfContent.with_remark(*set_pdf(source, _options(source, TEMPLATES) | when))


def _options(source: str, root: Path) -> dict[str, Any]:
    """Return how Typst reads a source; the root is given because Typst takes the working folder otherwise,
    which may be gone.
    """
    # Typst's own fonts look the same everywhere; those of the system are for a script that they lack.
    return {"root": str(root), "ignore_system_fonts": re.search(_FOREIGN, source) is None}
