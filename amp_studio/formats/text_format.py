"""What a text format is: a family's own notation for its parameters, read from text and written to it.

A reader gives the values it understood and, if it was asked to keep them, the entries it did not; it raises
FormatError at the first line that cannot be meant, and nothing is imported then.
"""

from __future__ import annotations

from codecs import BOM_UTF8, BOM_UTF16_BE, BOM_UTF16_LE
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from amp_studio.errors import AmpStudioError
from amp_studio.files import ParameterFile
from amp_studio.schema import Address, Schema, Value


class FormatError(AmpStudioError, ValueError):
    """A text that a format cannot take: line, column (both from 1) and one clear sentence."""

    def __init__(self, what: str, line: int | None = None, column: int | None = None) -> None:
        self.line, self.column, self.what = line, column, what
        place = ", ".join(f"{name} {n}" for name, n in (("line", line), ("column", column)) if n is not None)
        super().__init__(f"{place}: {what}" if place else what)


class FamilyNotGivenError(FormatError):
    """A text of a format that several families share: which one it is for has to be named."""


@dataclass(frozen=True)
class ReadOptions:
    """What a person decides about a text that is read."""

    keep_unknown: bool = False
    """Keep what is not understood, to be written back."""
    machine: str = ""
    """The machine type; empty where the text shall decide."""
    listing: int = 0
    """Which of several listings of one text, counted from 1; 0 is the last one."""
    beside: Callable[[str], str | None] = lambda _name: None
    """Returns the text of a file beside this one that it names, its bytes as latin-1;
    None where there is none."""


@dataclass
class TextRead:
    """What a text contains."""

    values: dict[Address, Value] = field(default_factory=dict)
    unknown: dict[str, str] = field(default_factory=dict)
    """Entries that the format has and the schema does not: kept in the parameter file, and written back."""
    unknown_lines: dict[str, int] = field(default_factory=dict)
    """The line of each of these, from 1, where it is one."""
    value_lines: dict[Address, int] = field(default_factory=dict)
    """The line of each value, from 1, where it is one of this text."""
    kept: list[str] = field(default_factory=list)
    """Lines that set nothing: kept for the format, and written back in their place."""
    name: str = ""
    machine: str = ""
    """Machine type, where the text names it."""
    extra: dict[str, object] = field(default_factory=dict)
    """What the format needs to write the same text again: kept in the header of the parameter file."""
    value_notes: dict[str, str] = field(default_factory=dict)
    """Address as files write it -> what a person noted about the value."""
    notes: list[str] = field(default_factory=list)
    """What a person should know of a text that can be taken: words it leaves out."""


@dataclass(frozen=True)
class TextOffer:
    """What a person may decide about a text before it is read."""

    family: str
    listings: tuple[str, ...]
    """Each of several listings in it: its place and heading, in their order."""
    machine: str
    """The machine type that the text decides on."""


WRITTEN_AROUND = (BOM_UTF8, b"\x1a")
"""What editors write before a text and DOS behind it."""


@dataclass(frozen=True)
class TextFormat:
    """One text format."""

    key: str
    """What ``--format`` calls it."""
    title: str
    ending: str
    """Of the files it writes, with the point."""
    recognises: Callable[[str], bool]
    """Returns whether a text is meant for this format."""
    read: Callable[[str, Schema, ReadOptions], TextRead]
    """Reads a text for a family."""
    write: Callable[[ParameterFile], str]
    """Writes a file; raises FormatError for a value it cannot write."""
    encoding: str = "utf-8"
    newline: str = "\n"
    newline_of: Callable[[ParameterFile], str] | None = None
    """Returns the line end of a file that remembers the one of its text; None where all have the same."""
    other_endings: tuple[str, ...] = ()
    """Names that are as good for its files."""
    offer: Callable[[str, Schema], TextOffer] | None = None
    """Returns what may be decided about a text; raises FormatError. None where a text decides everything."""
    included: Callable[[ParameterFile], Mapping[str, str]] | None = None
    """Returns the texts, by name, that a text takes in and that the file keeps; None where a text is
    alone."""
    is_of: Callable[[str, Schema], bool] | None = None
    """Returns whether the names of a text are those of a family; None where a text does not show it."""
    around: tuple[bytes, ...] = ()
    """What it reads and writes before and behind its text; of ``WRITTEN_AROUND`` the rest is left out."""
    otherwise: str = ""
    """The encoding of a text that is not of ``encoding``; without it such a text is refused."""

    @property
    def endings(self) -> tuple[str, ...]:
        """Endings of its files, that of the files it writes first."""
        return (self.ending, *self.other_endings)


def plain_content(content: bytes) -> bytes:
    """Return the bytes of a text as its control wrote them, whatever wrote them down since: 16-bit characters
    (a terminal or an editor of Windows), lines that end with a carriage return alone.
    """
    # "replace" at both ends: a character that is damaged costs one value, an error the whole text.
    if content.startswith((BOM_UTF16_LE, BOM_UTF16_BE)):
        content = content.decode("utf-16", "replace").encode("utf-8", "replace")
    # Only where there is no line feed at all: beside one, a lone carriage return is part of a line.
    return content if b"\n" in content else content.replace(b"\r", b"\n")


def text_to_recognise(content: bytes) -> str:
    """Return a text by which its format is recognised, whatever its encoding;
    a no-break space of a page or a chat is a space.
    """
    for mark in WRITTEN_AROUND:
        content = content.removeprefix(mark).removesuffix(mark)
    # Latin-1 has a character for every byte: this never fails on a text of another encoding.
    return content.replace(b"\xc2\xa0", b" ").decode("latin-1")
