"""All that a Grbl or grblHAL control contains, as text in its own words: what is kept of it and put back.

``docs/protocols/grblhal.md`` specifies the form. The answers to the commands that ask a control about itself
are under the commands, sorted and without what changes by itself,
so that the bytes are the same while the control contains the same.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

from amp_studio.transfer import ImageError

_MAGIC = "grblHAL settings 1"
LARGEST = 1 << 20
"""Characters; the enumerations of a build with everything have about 150,000."""

IDENTITY = (
    "VER",
    "AXS",
    "FIRMWARE",
    "NVS STORAGE",
    "DRIVER",
    "DRIVER VERSION",
    "DRIVER OPTIONS",
    "BOARD",
    "PLUGIN",
    "MAX STEP RATE",
)
"""What of ``$I`` is kept: OPT and NEWOPT change with settings, others (free memory, addresses, the time)
by themselves."""

OFFSETS = (*(f"G{n}" for n in range(54, 60)), "G59.1", "G59.2", "G59.3", "G28", "G30", "G92")
"""What of ``$#`` is kept: what is in the control's memory. TLO and PRB are lost with the power."""

ENUMERATIONS = ("$EG", "$ES", "$ESH", "$EA", "$EE")
"""How a grblHAL control describes itself: groups, settings, settings with help, alarms, errors."""

_SECTIONS = ("$I", "$$", "$#", "$N", *ENUMERATIONS)
_CONTROL_CHARACTER = re.compile(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]")
_SETTING = re.compile(r"\$(0|[1-9]\d{0,4})=(.*)")
_NAMED = re.compile(r"\[([A-Z][A-Z0-9. ]*):(.*)\]")
_STARTUP = re.compile(r"\$N(\d)=(.*)")


@dataclass(frozen=True)
class GrblContent:
    """What one control contains, and how it describes itself.

    ``identity``      the lines of ``$I`` that are kept, as they come: ``[VER:1.1f.20260817:]``
    ``settings``      number -> value as the control shows it: 130 -> ``200.000``
    ``offsets``       name -> coordinates as ``$#`` shows them, in inches where $13 is 1: ``G54`` ->
    ``0.000,0.000,0.000``
    ``startup``       the start-up lines, by their number
    ``enumerations``  command -> the lines of its answer, for those of ENUMERATIONS that the control knows:
                      none for Grbl 1.1
    """

    identity: tuple[str, ...] = ()
    settings: Mapping[int, str] = field(default_factory=dict)
    offsets: Mapping[str, str] = field(default_factory=dict)
    startup: Mapping[int, str] = field(default_factory=dict)
    enumerations: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def identity_word(self, name: str) -> str:
        """Return what follows the name in a line of the identity, "" without one:
        ``said("DRIVER")`` is ``Simulator``.
        """
        for line in self.identity:
            match = _NAMED.fullmatch(line)
            if match and match[1] == name:
                return match[2]
        return ""

    @property
    def version(self) -> str:
        """The version of the firmware: ``1.1f.20260817``."""
        return self.identity_word("VER").split(":")[0]

    @property
    def describes_itself(self) -> bool:
        """Whether the control enumerates its settings; a Grbl 1.1 does not."""
        return bool(self.enumerations.get("$ES"))

    @property
    def axes(self) -> tuple[str, ...]:
        """The letters of its axes in the order of their numbers; Grbl 1.1 has X, Y and Z."""
        letters = self.identity_word("AXS").partition(":")[2]
        if letters:
            return tuple(letters)
        # Without letters the coordinates of an offset show how many axes there are.
        return tuple("XYZABCUVW"[: max(1, next(iter(self.offsets.values()), "0,0,0").count(",") + 1)])


def write_content(content: GrblContent) -> bytes:
    """Return the bytes of a content; the same for the same content."""
    sections = {
        "$I": content.identity,
        "$$": [f"${number}={value}" for number, value in sorted(content.settings.items())],
        "$#": [f"[{name}:{content.offsets[name]}]" for name in OFFSETS if name in content.offsets],
        "$N": [f"$N{number}={line}" for number, line in sorted(content.startup.items())],
        **content.enumerations,
    }
    lines = [_MAGIC]
    for name in _SECTIONS:
        if name in sections:
            lines += [f"> {name}", *sections[name]]
    return ("\n".join([*lines, f"end {len(lines)}"]) + "\n").encode()


def read_content(data: bytes) -> GrblContent:
    """Return the content of these bytes, which are exactly those that it is written as; raises ImageError."""
    sections = _sections(data)
    content = GrblContent(
        tuple(sections["$I"]),
        dict(_numbered(sections["$$"], _SETTING, "a setting")),
        dict(_named(sections["$#"])),
        dict(_numbered(sections["$N"], _STARTUP, "a start-up line")),
        {name: tuple(sections[name]) for name in ENUMERATIONS if name in sections},
    )
    # Order and repeats would be lost by reading: a copy must come back byte for byte.
    if write_content(content) != data:
        raise ImageError(
            "the copy of the settings is not in the order in which it is written, or has something twice"
        )
    return content


def _sections(data: bytes) -> dict[str, list[str]]:
    """Return the lines of each section of a copy; raises ImageError for one that is cut off or damaged."""
    if len(data) > LARGEST:
        raise ImageError(f"the copy of the settings is longer than {LARGEST} characters")
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        raise ImageError("the copy of the settings is not text") from None
    lines = text.split("\n")
    if lines[0] != _MAGIC:
        raise ImageError("this is not a copy of Grbl settings")
    # The number of lines is in the last one: a copy that was cut off anywhere is noticed.
    if lines[-1] != "" or lines[-2] != f"end {len(lines) - 2}":
        raise ImageError("the copy of the settings has been cut off")
    if match := _CONTROL_CHARACTER.search(text):
        number = text.count("\n", 0, match.start()) + 1
        raise ImageError(f"line {number} of the copy of the settings contains a control character")
    sections: dict[str, list[str]] = {}
    here = None
    for number, line in enumerate(lines[1:-2], 2):
        if line.startswith("> "):
            name = line[2:]
            if name not in _SECTIONS or name in sections:
                raise ImageError(f"line {number} of the copy of the settings begins no section")
            here = sections[name] = []
        elif here is None:
            raise ImageError(f"line {number} of the copy of the settings belongs to no section")
        else:
            here.append(line)
    # The others are of controls that describe themselves.
    for name in _SECTIONS[:4]:
        if name not in sections:
            raise ImageError(f"the copy of the settings has no section {name}")
    return sections


def _numbered(lines: Iterable[str], form: re.Pattern[str], what: str) -> Iterable[tuple[int, str]]:
    for line in lines:
        match = form.fullmatch(line)
        if match is None:
            raise ImageError(f"the copy of the settings contains '{line[:60]}', which is not {what}")
        yield int(match[1]), match[2]


def _named(lines: Iterable[str]) -> Iterable[tuple[str, str]]:
    for line in lines:
        match = _NAMED.fullmatch(line)
        if match is None or match[1] not in OFFSETS:
            raise ImageError(f"the copy of the settings contains '{line[:60]}', which is not an offset")
        yield match[1], match[2]
