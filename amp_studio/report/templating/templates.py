"""Templates of documents: those of the program, and those of a project that extend or replace them.

A project's template is the text of another author: it is run in jinja2's sandbox, sees the report and nothing
else, and has a bound for its size and its time. Its mistakes have their line.
"""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Mapping
from importlib.util import cache_from_source
from pathlib import Path
from typing import TYPE_CHECKING, Any

from amp_studio.errors import AmpStudioError
from amp_studio.report.language import ENGLISH, Language

if TYPE_CHECKING:
    from jinja2 import BaseLoader, BytecodeCache, Environment

TEMPLATES = Path(__file__).parents[1] / "templates"
OWN = "templates"
"""The folder of a project with its templates."""
_MAX_TEMPLATE = 256 * 1024
_MAX_OUTPUT = 64 * 2**20
_PATIENCE_S = 20.0
_LONGEST_MISTAKE = 500
_HALF = re.compile("[\ud800-\udfff]")
_COMPLAINT = re.compile(r"\.typ:(\d+):\d+")
"""The line in a complaint of Typst, which is one of the source that a template has written."""
_EXPRESSION = re.compile(r"\{\{.*?\}\}|\{%.*?%\}|\{#.*?#\}")
_MIN_SHAPE = 4
"""Characters beside expressions that make a line known."""
_MISTAKES = (
    ArithmeticError,
    AssertionError,
    AttributeError,
    LookupError,
    MemoryError,
    RuntimeError,
    TypeError,
    ValueError,
)
"""What a template can raise by what it does, beside the errors of jinja2."""


class TemplateMistakeError(AmpStudioError, ValueError):
    """A template of a project cannot be used; the text has its file and its line,
    and is one line that can be read.
    """

    def __init__(self, own: Path, mistake: str) -> None:
        words = " ".join(mistake.split())
        self.mistake = words if len(words) <= _LONGEST_MISTAKE else words[:_LONGEST_MISTAKE] + "…"
        super().__init__(f"{own}: {self.mistake}")

    def then(self, sentence: str) -> str:
        """Return the text with a sentence after it."""
        return f"{self}{'' if self.mistake.endswith('?') else '.'} {sentence}"


def own_template(folder: Path | None, name: str) -> Path | None:
    """Return the template of a project that takes the place of one of the program; None where there is
    none.
    """
    path = folder / OWN / name if folder is not None else None
    try:
        return path if path is not None and path.is_file() else None
    except PermissionError:  # the reader of it notes why, and goes on without it
        return path


def filled(
    name: str,
    values: Mapping[str, object],
    settings: Mapping[str, Any],
    filters: Mapping[str, Any],
    own: Path | None = None,
    language: Language = ENGLISH,
) -> str:
    """Return a template with its values; raises TemplateMistakeError for one of a project.

    ``own`` is used in the place of ``name``, which it can extend as ``standard/NAME``.
    """
    from jinja2 import Environment, StrictUndefined, TemplateError, TemplateNotFound

    from amp_studio.report.model import Listing
    from amp_studio.report.wording import note_lines

    whole: dict[str, Any] = {"loader": _loader(own), "trim_blocks": True, "lstrip_blocks": True}
    if own is None:
        # Strict: a misspelt name must not be printed as nothing.
        environment = Environment(  # noqa: S701  # settings escape a page, filters the source of Typst
            undefined=StrictUndefined, bytecode_cache=_compiled_templates(), **whole, **settings
        )
    else:
        from .bounded import BoundedEnvironment, StandardTemplates, UnknownName

        environment = BoundedEnvironment(
            _PATIENCE_S,
            undefined=UnknownName,
            bytecode_cache=StandardTemplates(TEMPLATES),
            **whole,
            **settings,
        )
    environment.globals.update(_=language.text, counted=language.counted, language=language.code)
    environment.filters.update(
        filters,
        worded=language.drawing,
        titled=language.title,
        listed=language.listed,
        of_place=language.of_place,
        unit=language.unit,
        stated=language.sentence,
        lines=note_lines,
        checked=lambda check: check.printed(language),
        tuned=lambda tuning: (tuning.head(language), tuning.rows(language)),
    )
    environment.tests["listing"] = lambda part: isinstance(part, Listing)
    if own is None:
        return environment.get_template(name).render(values)
    # Before it is parsed, which no clock interrupts.
    if own.stat().st_size > _MAX_TEMPLATE:
        raise TemplateMistakeError(own, f"is larger than {_MAX_TEMPLATE // 1024} KB")
    try:
        return _bounded(environment, own, values)
    except TemplateMistakeError:  # has its file and its line already
        raise
    except TemplateNotFound as error:
        where = "; those of the program are standard/report.html.j2 and standard/report.typ.j2"
        raise TemplateMistakeError(
            own, f"{_line(own, error)}there is no template '{error}' beside it{where}"
        ) from None
    except TemplateError as error:
        raise _mistake(own, error, str(error.message or error)) from None
    except _MISTAKES as error:
        raise _mistake(own, error, str(error) or "needs too much memory") from None


def _mistake(own: Path, error: BaseException, what: str) -> TemplateMistakeError:
    """Return the text of an error of a template, with its line and without its own full stop:
    a sentence follows.
    """
    return TemplateMistakeError(own, f"{_line(own, error)}{what.rstrip('.')}")


def _loader(own: Path | None) -> BaseLoader:
    from jinja2 import ChoiceLoader, FileSystemLoader, PrefixLoader

    standard = FileSystemLoader(TEMPLATES)
    if own is None:
        return standard
    # Under a prefix, so that a project's template can extend the one whose name it has.
    return ChoiceLoader([PrefixLoader({"standard": standard}), FileSystemLoader(own.parent)])


def _compiled_templates() -> BytecodeCache | None:
    """Return the cache of the program's own templates; None where there is none.

    It lies where Python keeps the program's compiled modules, under the same rights: who can write there can
    write the program. A project's template is compiled each time.
    """
    if sys.dont_write_bytecode:
        return None
    from jinja2 import FileSystemBytecodeCache

    folder = Path(cache_from_source(__file__)).parent
    return FileSystemBytecodeCache(str(folder)) if os.access(folder, os.W_OK) else None


def _bounded(environment: Environment, own: Path, values: Mapping[str, object]) -> str:
    """Return what a template writes, up to a size; its environment bounds the time."""
    _check_blocks(environment, own)
    parts, size = [], 0
    # Part by part: a template without an end is stopped before its text fills the memory.
    for part in environment.get_template(own.name).generate(values):
        parts.append(part)
        size += len(part)
        if size > _MAX_OUTPUT:
            raise TemplateMistakeError(own, "writes without end")
    text = "".join(parts)
    # A report without a word would replace the standard one in silence.
    if not text.strip():
        raise TemplateMistakeError(own, "writes nothing")
    if _HALF.search(text):
        raise TemplateMistakeError(own, "writes half a character, as \\ud800")
    return text


def _check_blocks(environment: Environment, own: Path) -> None:
    """Refuse a block that the standard template does not have: nothing would be printed of it."""
    from jinja2 import nodes

    tree = environment.parse(own.read_text("utf-8"), own.name, str(own))
    bases = [node.template for node in tree.body if isinstance(node, nodes.Extends)]
    if not bases or not isinstance(bases[0], nodes.Const) or not str(bases[0].value).startswith("standard/"):
        return
    known = environment.get_template(str(bases[0].value)).blocks
    for node in tree.body:
        if isinstance(node, nodes.Block) and node.name not in known:
            names = ", ".join(sorted(known))
            raise TemplateMistakeError(
                own, f"line {node.lineno}: there is no block '{node.name}'. Known: {names}"
            )


def line_of_source(own: Path, source: str, diagnostic: str) -> str:
    """Return ``line 7: ``, the line of a template that has written what Typst complains of;
    empty where it is not known.
    """
    try:
        lines = [_EXPRESSION.split(line.strip()) for line in own.read_text("utf-8").splitlines()]
    except (OSError, UnicodeError):  # it has just been saved
        return ""
    written = source.splitlines()
    for number in map(int, _COMPLAINT.findall(diagnostic)):
        text = written[number - 1].strip() if 0 < number <= len(written) else ""
        found = [n for n, parts in enumerate(lines, 1) if _can_write(parts, text)]
        # A line that several could have written would be named at random.
        if len(found) == 1:
            return f"line {found[0]}: "
    return ""


def _can_write(parts: list[str], text: str) -> bool:
    """Return whether a line of a template, given as what is between its expressions, can have written a
    text.
    """
    if len("".join(parts).replace(" ", "")) < _MIN_SHAPE:
        return False
    first, last = parts[0], parts[-1]
    if len(parts) == 1:
        return text == first
    if not (text.startswith(first) and text.endswith(last) and len(text) >= len(first) + len(last)):
        return False
    at, end = len(first), len(text) - len(last)
    for part in parts[1:-1]:
        at = text.find(part, at, end)
        if at < 0:
            return False
        at += len(part)
    return True


def _line(own: Path, error: BaseException) -> str:
    """Return ``line 7: ``, of a template that ``own`` includes ``part.html: line 7: ``;
    empty where it is not known.
    """
    line, file = getattr(error, "lineno", None), getattr(error, "filename", None) or str(own)
    # Templates are compiled into code whose frames have the file and the line of the template.
    trace = error.__traceback__
    while trace is not None and not getattr(error, "lineno", None):
        name = trace.tb_frame.f_code.co_filename
        if Path(name).parent == own.parent:
            line, file = trace.tb_lineno, name
        trace = trace.tb_next
    where = "" if Path(file) == own else f"{Path(file).name}: "
    return f"{where}line {line}: " if line else ""
