r"""The description that a control gives of itself, line by line: axes, groups, settings, help,
alarms and errors.

    [AXS:3:XYZ]                                                        $I      number of axes, their letters
    [SETTINGGROUP:43|42|X-axis]                                        $EG     group, the group it is in, name
    [SETTING:110|43|X-axis maximum rate|mm/min|6|#####0.000|||0|0]     $ES     ten entries, see below
    [SETTINGDESCR:22|Enables homing cycle. …]                          $SED=22 help; \n is a new line
    [ALARMCODE:1||Hard limit has been triggered. …]                    $EA
    [ERRORCODE:10||Soft limits cannot be enabled …]                    $EE

The entries of a setting: number, group, name, unit, type, format, least, most, needs a restart, may be 0.
The help may also come in the sixth column of ``$ESH``, between tabs.

The lines may be in any order, and other lines are ignored: all that was read from a control is a description
too. Its size is limited, as it comes from outside; an impossible entry raises DescriptionError.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import TypeVar

from amp_studio.schema import DescriptionError, short

T = TypeVar("T")
MAX_BYTES = 2**20
_MAX_SETTINGS, _MAX_GROUPS, _MAX_CODES = 2000, 500, 1000
_LONGEST = 4000
"""Characters of a text that is kept; the longest known help has some 800."""
_HELP_ROW = 10
"""Columns of ``$ESH``."""
_MAX_NUMBER = 65535
_MAX_LABELS = 32
"""Of a mask: the control keeps it in 32 bits."""
_MAX_CHOICES = 256

BOOLEAN, MASK, SWITCHED_MASK, CHOICE, AXES, INTEGER, DECIMAL, TEXT, PASSWORD, IPV4 = range(10)
"""The types of settings, as ``$ES`` counts them. In a switched mask bit 0 switches all others."""

_TAGS = (
    "VER",
    "AXS",
    "BOARD",
    "DRIVER",
    "DRIVER VERSION",
    "FIRMWARE",
    "MAX STEP RATE",
    "SETTINGGROUP",
    "SETTING",
    "SETTINGDESCR",
    "ALARMCODE",
    "ERRORCODE",
)
_LINE = re.compile(r"\[([A-Z ]+):(.*)\]")


@dataclass(frozen=True)
class DescribedSetting:
    """One setting, as ``$ES`` lists it."""

    number: int
    group: int
    name: str
    unit: str
    type: int
    format: str
    least: str
    most: str
    needs_restart: bool
    may_be_zero: bool

    @property
    def labels(self) -> tuple[str, ...]:
        """What the bits or choices are called, in order; empty for one that this control does not have."""
        labels = (label.strip() for label in self.format.split(","))
        return tuple("" if label in ("N/A", "") else label for label in labels)


@dataclass(frozen=True)
class SettingGroup:
    """A group of settings; 0 is the root of all."""

    number: int
    parent: int
    name: str


@dataclass
class Description:
    """The whole description of a control."""

    axes: str = ""
    """The letters of its axes, in order."""
    facts: dict[str, str] = field(default_factory=dict)
    """``VER``, ``BOARD``, ``DRIVER`` … -> the text behind it."""
    groups: dict[int, SettingGroup] = field(default_factory=dict)
    settings: dict[int, DescribedSetting] = field(default_factory=dict)
    helps: dict[int, str] = field(default_factory=dict)
    alarms: dict[int, str] = field(default_factory=dict)
    errors: dict[int, str] = field(default_factory=dict)

    @property
    def max_step_rate(self) -> float | None:
        """Steps in a second that the driver can make, where it has a limit."""
        match = re.fullmatch(r"([0-9]{1,9}) Hz", self.facts.get("MAX STEP RATE", ""))
        return float(match[1]) if match else None


def _description_lines(content: bytes) -> list[str]:
    """Return the lines of a content that describe the control, in their order; raises DescriptionError."""
    if len(content) > MAX_BYTES:
        raise DescriptionError(f"the description of a control has at most {MAX_BYTES:,} bytes")
    found: list[str] = []
    begun = ""
    for came in content.decode("utf-8", "replace").split("\n"):
        # The help of a few settings goes over several lines.
        whole = (
            came.rstrip("\r") if not begun or came.startswith("[") else f"{begun}\\n{came.rstrip(chr(13))}"
        )
        begun = whole if _continues(whole) else ""
        row = whole.split("\t")
        is_row = len(row) == _HELP_ROW and row[0].isdecimal()
        line = f"[SETTINGDESCR:{row[0]}|{row[5]}]" if is_row else whole
        tagged = _LINE.fullmatch(line)
        if tagged and tagged[1] in _TAGS:
            found.append(line)
    return found


def _continues(line: str) -> bool:
    """Return whether a line is the beginning of a help that ends in a later one."""
    if len(line) > _LONGEST:
        return False
    is_row = re.match("[0-9]{1,5}\t", line) is not None and line.count("\t") < _HELP_ROW - 1
    return is_row or (line.startswith("[SETTINGDESCR:") and not line.endswith("]"))


def description_of(content: bytes) -> bytes:
    """Return what describes the control in all that was read from it: one line each,
    the same for the same control.
    """
    return "".join(f"{line}\n" for line in dict.fromkeys(_description_lines(content))).encode(
        "utf-8", "replace"
    )


def read_description(content: bytes) -> Description:
    """Return what the lines of a content say; raises DescriptionError."""
    found = Description()
    for line in _description_lines(content):
        tag, _, rest = line[1:-1].partition(":")
        _READERS.get(tag, _read_fact)(found, tag, rest)
    if not found.settings:
        raise DescriptionError("no setting is described: a control that answers $ES is needed")
    found.axes = found.axes or _axes_of_groups(found)
    return found


def _read_fact(description: Description, tag: str, rest: str) -> None:
    description.facts[tag] = _text(rest)


def _read_axes(description: Description, _tag: str, rest: str) -> None:
    """Keep the letters of the axes; raises DescriptionError."""
    count, _, letters = rest.partition(":")
    if (
        not re.fullmatch("[A-Z]{1,9}", letters)
        or len(set(letters)) != len(letters)
        or count != str(len(letters))
    ):
        raise DescriptionError(
            f"'AXS:{short(rest)}' are no axes: their number and letters are wanted, as 3:XYZ"
        )
    description.axes = letters


def _read_group(description: Description, _tag: str, rest: str) -> None:
    number, parent, name = _parts(rest, 3, "a group of settings")
    group = SettingGroup(_number(number, rest), _number(parent, rest), _text(name) or f"Group {number}")
    _keep(description.groups, group.number, group, _MAX_GROUPS, "group")


def _read_setting(description: Description, _tag: str, rest: str) -> None:
    """Keep one setting that the firmware describes; raises DescriptionError."""
    number, group, name, unit, kind, form, least, most, restart, zero = _parts(rest, 10, "a setting")
    if not re.fullmatch("[0-9]", kind):
        raise DescriptionError(f"the setting '{short(rest)}' has the type {short(kind)}, which is not known")
    if restart not in ("0", "1") or zero not in ("0", "1"):
        raise DescriptionError(f"the setting '{short(rest)}' does not end with two marks, 0 or 1")
    setting = DescribedSetting(
        _number(number, rest),
        _number(group, rest),
        _text(name) or f"Setting {number}",
        _text(unit),
        int(kind),
        _text(form),
        _bound(least, rest),
        _bound(most, rest),
        restart == "1",
        zero == "1",
    )
    count = len(setting.labels)
    if setting.type in (MASK, SWITCHED_MASK) and count > _MAX_LABELS:
        raise DescriptionError(f"${number} has {count} bits, and {_MAX_LABELS} are the most")
    if setting.type == CHOICE and count > _MAX_CHOICES:
        raise DescriptionError(f"${number} has {count} choices, and {_MAX_CHOICES} are the most")
    _keep(description.settings, setting.number, setting, _MAX_SETTINGS, "setting")


def _read_help(description: Description, _tag: str, rest: str) -> None:
    number, _, text = rest.partition("|")
    _keep(description.helps, _number(number, rest), _lines(text), _MAX_SETTINGS, "help of setting")


def _read_code(description: Description, tag: str, rest: str) -> None:
    number, _, text = _parts(rest, 3, "a code")
    codes = description.alarms if tag == "ALARMCODE" else description.errors
    _keep(codes, _number(number, rest), _text(text), _MAX_CODES, "code")


_READERS = {
    "AXS": _read_axes,
    "SETTINGGROUP": _read_group,
    "SETTING": _read_setting,
    "SETTINGDESCR": _read_help,
    "ALARMCODE": _read_code,
    "ERRORCODE": _read_code,
}


def _keep(known: dict[int, T], number: int, entry: T, most: int, what: str) -> None:
    """Keep an entry by its number, of at most so many; raises DescriptionError for a second, other one."""
    if number in known:
        # Asked twice it comes twice: only a contradiction is an error.
        if known[number] == entry:
            return
        raise DescriptionError(f"the {what} {number} is described twice, each time otherwise")
    if len(known) >= most:
        raise DescriptionError(f"the {what}s are more than {most}")
    known[number] = entry


def _parts(rest: str, count: int, what: str) -> list[str]:
    # Groups and codes end with a text, in which a bar may be.
    parts = rest.split("|", count - 1 if count == 3 else -1)
    if len(parts) != count:
        raise DescriptionError(f"'{short(rest)}' is not {what}: {count} entries between bars are wanted")
    return parts


def _number(text: str, rest: str) -> int:
    if not re.fullmatch("[0-9]{1,5}", text) or int(text) > _MAX_NUMBER:
        raise DescriptionError(f"'{short(rest)}' begins with no number of 0 to {_MAX_NUMBER}")
    return int(text)


def _bound(text: str, rest: str) -> str:
    if text and not re.fullmatch(r"-?[0-9]{1,12}(\.[0-9]{1,9})?", text):
        raise DescriptionError(f"the setting '{short(rest)}' has the bound {short(text)}, which is no number")
    return text


def _lines(text: str) -> str:
    r"""Return a help without control characters; ``\n`` becomes a new line."""
    return "\n".join(map(_text, text.split("\\n")))[:_LONGEST].strip()


def _text(text: str) -> str:
    """Return a text of one line without control characters."""
    plain = re.sub(
        r"[\x00-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ufeff\ufffe\uffff\ud800-\udfff]", " ", text
    )
    return plain[:_LONGEST].strip()


def _axes_of_groups(description: Description) -> str:
    """Return the letters of the groups ``X-axis``, ``Y-axis`` … in their order,
    of a control that lists no axes.
    """
    letters = (g.name[0] for _, g in sorted(description.groups.items()) if re.fullmatch("[A-Z]-axis", g.name))
    return "".join(dict.fromkeys(letters))[:9]
