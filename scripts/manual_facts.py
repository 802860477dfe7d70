"""The bare facts a manual prints, and the file that contains them:
what every ``extract_*.py`` beside this one gives.

A fact is numbers, names, letters and units, with its line, never a sentence. One fact is one line of
the file, so that a diff shows which fact has changed. An extractor reads a manual's text and nothing else: it
knows neither ``amp_studio`` nor ``parameter_db``, because what it finds is there to judge them.
"""

import argparse
import json
import sys
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path

LONGEST = 60
"""A text is cut to this length: a name or a label fits, a sentence does not."""


def cut(text: str) -> str:
    """Return a text with single blanks, no longer than a name."""
    return " ".join(text.split())[:LONGEST].rstrip()


@dataclass(frozen=True, kw_only=True)
class PrintedNumber:
    """A parameter number, and what is printed to the left of it and above it."""

    line: int
    number: str
    place: str = "table"
    """``table``, ``screen`` (a picture of the editor) or ``mention`` (perhaps in the section of another)."""
    name: str = ""
    axis: str = ""
    spindle: str = ""
    pair: str = ""
    machine: str = ""
    process: str = ""


@dataclass(frozen=True, kw_only=True)
class PrintedRange:
    """Both bounds as printed (without the commas of thousands);
    a bound that is another parameter is its words.
    """

    line: int
    low: str
    high: str
    unit: str = ""
    applies: str = ""
    """What the range is for, where a section prints several."""
    note: str = ""
    """Words behind the unit."""


@dataclass(frozen=True, kw_only=True)
class PrintedChoice:
    """A letter and its text; ``number`` where it is on a screen of one parameter."""

    line: int
    letter: str
    text: str
    number: str = ""
    applies: str = ""


@dataclass(frozen=True, kw_only=True)
class StoredRow:
    """A row of a table of stored values: bounds or codes, as they are in the control itself."""

    line: int
    numbers: tuple[str, ...]
    name: str
    default: str = ""
    low: str = ""
    high: str = ""
    unit: str = ""
    codes: dict[str, str] = field(default_factory=dict)
    machine: str = ""


@dataclass(frozen=True, kw_only=True)
class ListedParameter:
    """A row of a list of all parameters."""

    line: int
    number: str
    category: str = ""
    type: str = ""
    name: str = ""
    page: str = ""


@dataclass(frozen=True, kw_only=True)
class PrintedSize:
    """How many words a parameter has, and of which type."""

    line: int
    number: str
    words: int
    type: str = ""
    category: str = ""
    place: str = "head"
    """``head`` (of the section that describes it) or ``listing`` (an example of a file)."""


@dataclass(frozen=True, kw_only=True)
class PrintedWord:
    """A word of a parameter, or a run of words (``N0-N31``), and bits of it."""

    line: int
    number: str
    word: str = ""
    bits: str = ""
    """``5``, or ``31-27``: the first one printed is first."""


@dataclass(frozen=True, kw_only=True)
class PrintedDefault:
    """A value that a word, or a field of it, has unless another is set."""

    line: int
    number: str
    value: str
    unit: str = ""
    word: str = ""
    note: str = ""
    """Whether the manual calls it a default or a basic value, or what a table is headed by."""


@dataclass(frozen=True, kw_only=True)
class Section:
    """A heading with the facts that are under it."""

    heading: str
    page: str
    chapter: str
    line: int
    within: str = ""
    """The heading above, where this one only divides the description of that parameter."""
    within_page: str = ""
    parameter: str = ""
    """The number of the parameter it describes, where a list of parameters shows its page."""
    numbers: tuple[PrintedNumber, ...] = ()
    ranges: tuple[PrintedRange, ...] = ()
    choices: tuple[PrintedChoice, ...] = ()
    stored: tuple[StoredRow, ...] = ()
    listed: tuple[ListedParameter, ...] = ()
    sizes: tuple[PrintedSize, ...] = ()
    words: tuple[PrintedWord, ...] = ()
    bits: tuple[PrintedWord, ...] = ()
    defaults: tuple[PrintedDefault, ...] = ()


Fact = (
    PrintedNumber
    | PrintedRange
    | PrintedChoice
    | StoredRow
    | ListedParameter
    | PrintedSize
    | PrintedWord
    | PrintedDefault
)
KINDS = ("numbers", "ranges", "choices", "stored", "listed", "sizes", "words", "bits", "defaults")


Extractor = Callable[[Sequence[str], list[str]], Iterable[Section]]
"""What gives the sections for the lines of a manual, and adds what it missed to the list."""


def write_facts(about: str | None, head: str, sections: Extractor) -> int:
    """Write the facts of the manual named on the command line, and what was missed on standard error."""
    as_written = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=about, formatter_class=as_written)
    parser.add_argument(
        "manual", type=Path, help="the manual's text, the cells of its tables separated by tabs"
    )
    parser.add_argument("-o", "--output", type=Path, required=True, help="the file of facts to write")
    chosen = parser.parse_args()
    missed: list[str] = []
    lines = chosen.manual.read_text(encoding="utf-8").split("\n")
    chosen.output.write_text(written(sections(lines, missed), head), encoding="utf-8")
    sys.stderr.writelines(f"{line}\n" for line in missed)
    return 0


def written(sections: Iterable[Section], head: str) -> str:
    """Return the facts as YAML, one fact a line; ``head`` becomes the comment at the top."""
    lines = [f"# {line}".rstrip() for line in head.splitlines()]
    for section in sections:
        place = {"heading": section.heading, "page": section.page, "chapter": section.chapter}
        lines.append("")
        lines += [f"{'- ' if key == 'heading' else '  '}{key}: {_plain(said)}" for key, said in place.items()]
        lines.append(f"  line: {section.line}")
        if section.parameter:
            lines.append(f"  parameter: {section.parameter}")
        if section.within:
            lines += [f"  within: {_plain(section.within)}", f"  within_page: {_plain(section.within_page)}"]
        for kind in KINDS:
            if facts := getattr(section, kind):
                lines += [f"  {kind}:", *(f"  - {_flow(fact)}" for fact in facts)]
    return "\n".join(lines) + "\n"


def read(path: Path) -> tuple[Section, ...]:
    """Read what ``written`` wrote."""
    from pydantic import TypeAdapter
    from ruamel.yaml import YAML

    facts = YAML(typ="safe").load(path.read_text(encoding="utf-8"))
    return TypeAdapter(tuple[Section, ...]).validate_python(facts)


def _flow(fact: Fact) -> str:
    said = {f.name: getattr(fact, f.name) for f in fields(fact)}
    usual = {f.name: f.default for f in fields(fact)}
    shown = (f"{key}: {_plain(value)}" for key, value in said.items() if value not in (usual[key], {}))
    return "{" + ", ".join(shown) + "}"


def _plain(value: object) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_plain(code)}: {_plain(label)}" for code, label in value.items()) + "}"
    return json.dumps(value, ensure_ascii=False)
