"""The printed check list of commissioning: every step with a box to tick,
every value that is not set with a blank.
"""

from __future__ import annotations

import textwrap
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path

from amp_studio.files import Notify, ParameterFile, axis_letter, with_local_times
from amp_studio.guide import GuideProgress, StepProgress
from amp_studio.report.chapters import PrintedTest
from amp_studio.report.language import ENGLISH, Language, language_of
from amp_studio.report.output.page import filled_page
from amp_studio.report.output.pdf import filled_template, typeset
from amp_studio.report.wording import counted, printable
from amp_studio.schema import Address, limits, unit_text
from amp_studio.validate import SEVERITIES
from amp_studio.version import __version__

from .endings import write_by_ending

WIDTH = 100
_AT_MACHINE = "Tests at the machine"
_MAX_CHOICES = 6
"""Choices that a line of the list still has room for."""


@dataclass(frozen=True)
class OpenValue:
    """One value to give."""

    number: str
    name: str
    place: str
    """Which axis or instance; empty for the only one."""
    unit: str
    allowed: str
    """Its range, or its choices where they are few."""
    page: str


@dataclass(frozen=True)
class ListedStep:
    """One step of the list."""

    progress: StepProgress
    title: str
    what: str
    values: tuple[OpenValue, ...]
    summary: str
    findings: tuple[str, ...]

    def summary_in(self, text: Callable[[str], str]) -> str:
        """Return the summary in the language of ``text``, which returns a phrase in it."""
        return ", ".join(map(text, self.summary.split(", ")))

    @property
    def is_done(self) -> bool:
        """Whether its box is ticked already."""
        return self.progress.state == "done"


@dataclass(frozen=True)
class CheckList:
    """The list of one file at one moment."""

    title: str
    family: str
    file_name: str
    order: str
    """Whose order the steps have."""
    summary: str
    steps: tuple[ListedStep, ...]
    date: datetime
    tests: tuple[PrintedTest, ...] = ()
    program: str = f"AMP Studio {__version__}"
    language: str = "en"
    """Code of the language of the list's own words."""

    @property
    def when(self) -> str:
        """Date and time in printed form."""
        return language_of(self.language).moment(self.date)


def build_check_list(
    file: ParameterFile,
    now: GuideProgress,
    path: Path | None = None,
    date: datetime | None = None,
    language: str = "en",
    tests: Iterable[PrintedTest] = (),
) -> CheckList:
    """Return the check list of a file: the steps that its machine needs, and ``tests`` at the machine;
    ``language`` is a code of ``language_codes``.
    """
    order, words = file.schema.commissioning, language_of(language, file.schema.family.family)
    source = words.sentence(order.why) if order else ""
    if order and order.order == "manual":
        source += f" ({words.text(f'page {order.page}')})"
    done = f"{now.done} of {len(now.needed)} steps done, {now.set} of {now.total} values set."
    return CheckList(
        title=file.header.name or (path.name if path else file.schema.family.name),
        family=file.schema.family.name,
        file_name=path.name if path else "",
        order=source,
        summary=done,
        steps=tuple(_listed(file, each, words) for each in now.needed),
        date=date or datetime.now().astimezone(),
        tests=tuple(_test_in(words, test) for test in tests),
        language=language,
    )


def _test_in(words: Language, test: PrintedTest) -> PrintedTest:
    """Return a test in a language; its program is the control's."""
    axis, _, title = test.title.partition(": ")
    return replace(
        test,
        title=f"{axis}: {words.sentence(title)}",
        page=words.pages(test.page),
        steps=tuple((words.sentence(do), words.sentence(see)) for do, see in test.steps),
        notes=tuple(map(words.sentence, test.notes)),
        refusal=words.sentence(test.refusal),
    )


def _listed(file: ParameterFile, each: StepProgress, words: Language) -> ListedStep:
    """Return a step as the list prints it: what is open, how many values are set, and its errors."""
    # Active, not set by the file, and not open: the control has its default, which is to be checked.
    defaults = each.active - each.own - len(each.open)
    parts = {
        f"{len(each.open)} not set": each.open,
        f"{each.own} set": each.own,
        f"{defaults} at {'its' if defaults == 1 else 'their'} default: check": defaults,
        # What is 0 is left out below.
        **{counted(each.count(severity), severity): each.count(severity) for severity in SEVERITIES},
        f"ticked {with_local_times(each.ticked)}": each.ticked,
    }
    # Errors alone are printed: the list is worked through with a pen.
    errors = tuple(dict.fromkeys(words.finding(f) for f in each.findings if f.severity == "error"))
    values = tuple(open_value(file, address, words) for address in each.open)
    title, what = words.title(each.step.title), words.sentence(each.step.what)
    return ListedStep(
        each, title, what, values, ", ".join(text for text, is_so in parts.items() if is_so), errors
    )


def open_value(file: ParameterFile, address: Address, words: Language = ENGLISH) -> OpenValue:
    """Return what is printed about a value that is not set."""
    here, parameter = file.machine_schema, file.schema.parameters[address[0]]
    # A printed number that belongs to another parameter would lead there: the name alone.
    number = here.number(address) if not here.is_disputed(address[0]) else None
    unit = file.evaluation.unit(address, file.header.units)
    allowed = ""
    if parameter.choices:
        labels = [choice.label for choice in parameter.choices]
        allowed = (
            " / ".join(labels) if len(labels) <= _MAX_CHOICES else words.text(f"one of {len(labels)} choices")
        )
    elif parameter.type in ("integer", "real"):
        found = limits(file.evaluation, address, unit)
        allowed = words.quantity(words.message(found.text())) if found else ""
    place = here.instance_label(address)
    if here.scopes[address[0]] == "axis" and (letter := axis_letter(file, address[1])):
        place = letter
    page = file.schema.page(address)
    return OpenValue(
        number or "", parameter.name, words.text(place), words.unit(unit_text(unit)), allowed, page
    )


def render_check_list_text(checks: CheckList) -> bytes:
    """Return plain text in UTF-8, of 100 columns."""
    return ("\n".join(line.rstrip() for line in _check_list_lines(checks)) + "\n").encode("utf-8")


def _check_list_lines(checks: CheckList) -> Iterator[str]:
    """Yield the lines of the list as text."""
    words = language_of(checks.language)
    head = f"{words.text('Check list').upper()}  {printable(checks.title)}"
    yield "=" * WIDTH
    yield head.ljust(WIDTH - len(checks.when)) + checks.when
    yield "=" * WIDTH
    for name, text in (("Control", checks.family), ("File", checks.file_name), ("Order", checks.order)):
        if text:
            yield from _wrapped(text, f"{words.text(name) + ' ':.<12} ")
    yield words.text(checks.summary)
    for each in checks.steps:
        step = each.progress.step
        page = f" ({words.text(f'page {step.page}')})" if step.page else ""
        yield ""
        yield from _wrapped(f"{each.title}{page}", f"[{'x' if each.is_done else ' '}] {step.number:>2}  ")
        for text in filter(None, (each.what, each.summary_in(words.text), *each.findings)):
            yield from _wrapped(text, " " * 8)
        for value in each.values:
            yield from _value_lines(value, words)
    if checks.tests:
        yield from ("", words.text(_AT_MACHINE).upper())
    for test in checks.tests:
        yield from _test_lines(test, words)


def _test_lines(test: PrintedTest, words: Language) -> Iterator[str]:
    """Yield a test: its program as it is, each step with a box."""
    mark = "x" if test.ticked else " "
    yield ""
    yield from _wrapped(f"{test.title} ({words.text(f'page {test.page}')})", f"[{mark}] ")
    if test.ticked:
        yield from _wrapped(with_local_times(test.ticked), " " * 8)
    if test.refusal:
        yield from _wrapped(test.refusal, " " * 8)
        return
    # Not wrapped: a block of a program is one line.
    yield from (f"{'':12}{printable(line)}" for line in test.lines)
    for do, see in test.steps:
        yield from _wrapped(do, "        [ ] ")
        yield from _wrapped(see, f"{'':12}{words.text('Must be seen')}: ")
    for note in test.notes:
        yield from _wrapped(note, " " * 8)


def _value_lines(value: OpenValue, words: Language) -> Iterator[str]:
    what = " ".join(filter(None, (value.number, value.name, value.place)))
    about = "; ".join(filter(None, (value.allowed, words.text(f"page {value.page}"))))
    yield from _wrapped(f"{what} ({about})", f"        [ ] {'_' * 14} {value.unit:<7} ")


def _wrapped(text: str, head: str) -> list[str]:
    head = printable(head)
    return textwrap.wrap(printable(text), WIDTH, initial_indent=head, subsequent_indent=" " * len(head)) or [
        head
    ]


def render_check_list_html(checks: CheckList) -> bytes:
    """Return one web page that can be printed."""
    return filled_page("check_list.html.j2", language=language_of(checks.language), checks=checks)


def _render_check_list_pdf(checks: CheckList) -> bytes:
    """Return the PDF."""
    words = language_of(checks.language)
    return typeset(filled_template("check_list.typ.j2", language=words, checks=checks), checks.date)


_CHECK_LIST_FORMATS: dict[str, Callable[[CheckList], bytes]] = {
    ".pdf": _render_check_list_pdf,
    ".html": render_check_list_html,
    ".txt": render_check_list_text,
}


def write_check_list(checks: CheckList, path: Path, notify: Notify = lambda _note: None) -> None:
    """Write a check list, whole or not at all, in the format of the path's ending; raises ValueError,
    SaveError.
    """
    write_by_ending(path, _CHECK_LIST_FORMATS, checks, "a check list", notify)
