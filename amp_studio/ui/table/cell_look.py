"""What a cell of the table looks like: its text, its unit and its state,
worked out once until something changes.
"""

from __future__ import annotations

import math
import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

from amp_studio.files import HeaderSnapshot, unlike_axes, value_note, with_days_and_times
from amp_studio.report import place_of, state_name
from amp_studio.schema import (
    Address,
    Parameter,
    Schema,
    StateInfo,
    UnitError,
    Value,
    convert,
    isolated,
    labels_of_word,
    write_value,
)
from amp_studio.ui.base.figures import show_value
from amp_studio.ui.base.places import finding_text
from amp_studio.ui.base.translated import Translated, label_in_words, tr, unit_in_words, worded
from amp_studio.ui.base.workspace import Workspace
from amp_studio.validate import NOT_SET

CellKind = Literal["value", "not set", "absent"]
_BRACKETS = re.compile(r"\s*\([^()]*\)")
_DIGITS_OF_DEFAULT, _CONVERTED = 5, 1e-5
"""Digits of a default that a person wrote, and how far the printed conversion
to another unit is from it at most."""


@dataclass(slots=True)
class CellLook:
    """How one cell is painted; the delegate asks nothing else."""

    kind: CellKind
    text: str = ""
    unit: str = ""
    """What is painted in the slot of units: the unit of a number, the number of a mask. Of what is not set,
    the unit that it would have.
    """
    short: str = ""
    """A shorter text that no other choice of the parameter has, for where the whole one has no room."""
    is_unit_in_head: bool = False
    """Whether the head of the row has the unit, because all its values have this one."""
    is_number: bool = False
    is_own: bool = False
    """Not the printed default."""
    is_off_default: bool = False
    """Not the printed default, and can be set back to it."""
    is_changed: bool = False
    """Not what is on disk."""
    is_unlike: bool = False
    """Unlike the same parameter of most other axes."""
    is_inactive: bool = False
    is_locked: bool = False
    severity: str = ""
    """Of the worst finding that it causes."""
    has_note: bool = False


@lru_cache(maxsize=2_000)
def short_labels(labels: tuple[str, ...]) -> dict[str, str]:
    """Return shorter texts for the choices of a parameter, each of which no other one has.

    First the words go that all begin or end with, then a bracket without which no two look alike, then the
    words before a code (``Feedback Connector J1`` is ``J1`` where all but one begin so, else ``… J1``), at
    last long words become short ones.
    """
    short = _kept_apart(dict.fromkeys(labels, ""), dict(zip(labels, labels, strict=True)))
    for step in (_without_common_words, _without_brackets, _codes_alone, _with_short_words):
        short = _kept_apart(short, step(short))
    return short


def prepare_labels(schema: Schema) -> None:
    """Work out the shorter texts of all choices and bits of a family now; another thread may do so."""
    for parameter in schema.parameters.values():
        for labelled in (parameter.choices, parameter.bits):
            if labelled:
                short_labels(tuple(each.label for each in labelled))


def _kept_apart(before: dict[str, str], after: dict[str, str]) -> dict[str, str]:
    """Return the shorter texts, and where two would look alike both as they were."""
    count = Counter(text.casefold() for text in after.values())
    found = {
        label: text if count[text.casefold()] == 1 and text else before[label]
        for label, text in after.items()
    }
    # A text that went back to what it was may be like another one that got shorter.
    return found if len({text.casefold() for text in found.values()}) == len(found) else before


def _without_common_words(short: dict[str, str]) -> dict[str, str]:
    words = [text.split() for text in short.values()]
    if len(words) < 2:
        return short
    first = _common(words)
    last = _common([list(reversed(text[first:])) for text in words])
    rests = (" ".join(text[first : len(text) - last]).strip(" ,;:") for text in words)
    return dict(zip(short, rests, strict=True))


def _without_brackets(short: dict[str, str]) -> dict[str, str]:
    return {label: _BRACKETS.sub("", text).strip() for label, text in short.items()}


def _codes_alone(short: dict[str, str]) -> dict[str, str]:
    """Leave the words out that several begin with, where a code remains."""
    families: dict[str, list[str]] = {}
    for label, text in short.items():
        families.setdefault(text.split()[0].casefold(), []).append(label)
    cut = dict(short)
    for alike in families.values():
        if len(alike) > 1:
            mark = "" if len(alike) >= len(short) - 1 else "… "
            cut |= _rests({label: short[label] for label in alike}, mark)
    return cut


def _rests(alike: dict[str, str], mark: str) -> dict[str, str]:
    """Return texts that begin alike without that, a mark before each; empty where no codes would remain."""
    words = [text.split() for text in alike.values()]
    length = _common(words)
    rests = [" ".join(found[length:]) for found in words]
    if length and all(map(_has_digit, rests)):
        return {label: mark + rest for label, rest in zip(alike, rests, strict=True)}
    if length == 2 and _has_digit(words[0][0]):  # an order number before a name
        return {label: text.split(maxsplit=1)[1] for label, text in alike.items()}
    return {}


def _has_digit(text: str) -> bool:
    return any(map(str.isdigit, text))


_SHORT_WORDS = {
    "Incremental": "Inc",
    "Absolute": "Abs",
    "Negative": "Neg",
    "Positive": "Pos",
    "Maximum": "Max",
    "Minimum": "Min",
}


def _with_short_words(short: dict[str, str]) -> dict[str, str]:
    return {
        label: " ".join(_SHORT_WORDS.get(word, word) for word in text.split())
        for label, text in short.items()
    }


def _common(texts: list[list[str]]) -> int:
    """Return how many words all texts begin with, so that each has one left."""
    most = min(map(len, texts)) - 1
    alike = (len({text[n].casefold() for text in texts}) == 1 for n in range(most))
    return next((n for n, same in enumerate(alike) if not same), most)


def as_written(default: Value) -> Value:
    """Return a default as a person writes it: 254 for the 253.9998 that a conversion made
    of 10 inches a minute.
    """
    number = default.value
    if not isinstance(number, float) or not math.isfinite(number) or number == 0:
        return default
    simple = float(f"{number:.{_DIGITS_OF_DEFAULT}g}")
    # By two digits at least: 0.12345 is no worse a number than 0.1234.
    is_simpler = len(repr(simple)) < len(repr(number)) - 1
    return (
        Value(simple, default.unit)
        if is_simpler and math.isclose(simple, number, rel_tol=_CONVERTED)
        else default
    )


def move_unit_to_head(looks: Iterable[CellLook]) -> None:
    """Leave the unit of the cells of a row to its head where all values have the same."""
    there = [look for look in looks if look.kind != "absent"]
    numbers = [look for look in there if look.is_number]
    units = {look.unit for look in there}  # of what is not set, that of a number typed there
    if numbers and len(units) == 1 and "" not in units:
        for look in numbers:
            look.is_unit_in_head = True


class ShownValues(Translated):
    """The values of a file as the table shows them, in the unit in which they are typed."""

    def __init__(self, workspace: Workspace) -> None:
        self.workspace = workspace
        self.hidden_too = False
        """Whether hidden parameters are shown too."""
        self.worst: dict[Address, str] = {}
        self.effective: dict[Address, Value] = {}
        self.marks: set[tuple[Address, object]] = set()
        """What the present findings make of the looks of values."""
        self.header: dict[str, object] = {}
        """That of the file when its findings were taken: notes among it."""

    def find_findings(self) -> None:
        """Take the severities and effective values of the present findings."""
        worst: dict[Address, str] = {}
        for finding in self.workspace.listed:  # errors come first
            if finding.rule != NOT_SET:
                for address in finding.causes:
                    worst.setdefault(address, finding.severity)
        self.worst, self.effective = worst, self.workspace.effective()
        self.marks = {*worst.items(), *self.effective.items()}
        self.header = HeaderSnapshot.of(self.workspace.file).header

    def exists(self, address: Address) -> bool:
        """Return whether an address has a cell: it is not hidden, or hidden ones are shown too."""
        return self.hidden_too or self.workspace.file.evaluation.state(address).state != "hidden"

    def in_units(self, address: Address, value: Value | None) -> Value | None:
        """Return a value in the unit in which it is shown; a value in this unit is returned unchanged."""
        if value is None or isinstance(value.value, (str, bool)) or not value.unit:
            return value
        unit = self.workspace.typed_unit(address)
        if unit == value.unit:
            return value
        try:
            # Nine digits: a conversion must not show the last bits of a float.
            return Value(float(f"{convert(float(value.value), value.unit, unit):.9g}"), unit)
        except UnitError:
            return value

    def text(self, address: Address, value: Value | None) -> str:
        """Return a value in words, with its unit."""
        parameter = self.workspace.file.schema.parameters[address[0]]
        return show_value(parameter, self.in_units(address, value), secrets=self.workspace.secrets)

    def typed(self, address: Address) -> str:
        """Return a value as text for editing, plain and exact; empty for a masked one."""
        if self.workspace.is_masked(address):
            return ""
        parameter = self.workspace.file.schema.parameters[address[0]]
        return write_value(parameter, self.in_units(address, self.workspace.file.get(address)))

    def _why(self, state: StateInfo) -> str:
        """Return why a value is inactive."""
        return worded(state.why, self.workspace.file.schema.family.family)

    def tip(self, address: Address) -> str:
        """Return what a cell means beyond its value: findings, why it is inactive,
        what the control uses instead.
        """
        file = self.workspace.file
        if not self.exists(address):
            return tr("Does not exist here: {why}").format(why=self._why(file.evaluation.state(address)))
        state = file.evaluation.state(address)
        lines = [self.text(address, file.get(address))]
        lines += [finding_text(file, f) for f in self.workspace.findings_of(address) if f.rule != NOT_SET]
        if not state.is_active:
            page = self.tr(" (page {page})").format(page=state.page) if state.page else ""
            lines.append(f"{worded(state_name(state.state)).capitalize()}: {self._why(state)}{page}")
        if address in self.effective:
            used = self.text(address, self.effective[address])
            lines.append(tr("Effective value in the control: {value}").format(value=used))
        if address in file.forced:
            lines.append(tr("Forced {when}").format(when=with_days_and_times(file.forced[address])))
        if note := value_note(file, address):
            lines.append(tr("Note: {text}").format(text=isolated(note)))
        return "\n".join([*lines, *self._other_values(address)])

    def default_text(self, address: Address) -> str:
        """Return the printed default of a value in words, in the unit of its cell."""
        default = self.in_units(address, self.workspace.file.default(address))
        return self.text(address, None if default is None else as_written(default))

    def against_default(self, address: Address) -> str:
        """Return a value and its printed default in words: ``X: 12 mm, default 10 mm``."""
        text = tr("{value}, default {default}").format(
            value=self.text(address, self.workspace.file.get(address)), default=self.default_text(address)
        )
        place = place_of(self.workspace.file, address)
        return f"{place}: {text}" if place else text

    def _other_values(self, address: Address) -> Iterator[str]:
        """Yield the default and what is saved, with the keys that lead back, and what was entered,
        each where it is another one.
        """
        file = self.workspace.file
        value, saved = file.get(address), self.workspace.document.saved.get(address)
        if value is not None and not file.is_default(address) and file.default(address) is not None:
            yield tr("Default: {value} (Ctrl+Backspace goes back)").format(value=self.default_text(address))
        if value != saved:
            yield tr("Saved: {value} (Ctrl+Shift+Backspace goes back)").format(
                value=self.text(address, saved)
            )
        if value is not None and self.in_units(address, value) != value:
            entered = show_value(file.schema.parameters[address[0]], value, secrets=self.workspace.secrets)
            yield tr("Entered as {value}").format(value=entered)

    # -- looks -----------------------------------------------------------------

    def row_looks(self, addresses: Collection[Address]) -> dict[Address, CellLook]:
        """Return the looks of the cells of one parameter."""
        file = self.workspace.file
        there = [a for a in addresses if self.exists(a)]
        active = [a for a in there if file.get(a) is not None and file.evaluation.state(a).is_active]
        unlike = unlike_axes(file, active) if len(active) > 1 else set()
        missing = CellLook("absent")
        looks = dict.fromkeys(addresses, missing)
        looks |= {a: self._look_of(a, a in unlike) for a in there}
        return looks

    def _look_of(self, address: Address, is_unlike: bool) -> CellLook:
        file = self.workspace.file
        parameter, value = file.schema.parameters[address[0]], file.get(address)
        look = CellLook("not set" if value is None else "value")
        look.is_changed = value != self.workspace.document.saved.get(address)
        look.is_inactive = not file.evaluation.state(address).is_active
        look.is_locked = parameter.access == "read"
        look.severity = self.worst.get(address, "")
        look.is_unlike = is_unlike
        look.has_note = bool(value_note(file, address))
        if value is None:
            look.unit = unit_in_words(self.workspace.typed_unit(address))
            return look
        look.is_own = not file.is_default(address)
        look.is_off_default = look.is_own and not look.is_locked and file.default(address) is not None
        look.is_number = parameter.type in ("real", "integer", "format") and not parameter.choices
        self._put_text(look, address, value)
        used = self.effective.get(address)
        if used is not None:
            look.text += f" → {self.text(address, used)}"
        return look

    def _put_text(self, look: CellLook, address: Address, value: Value) -> None:
        """Put the text of a value into its look: masked, the bits of a word, or in the chosen unit system."""
        parameter = self.workspace.file.schema.parameters[address[0]]
        if parameter.secret and not self.workspace.secrets:
            look.text = self.text(address, value)
        elif parameter.bits and isinstance(value.value, int):
            _show_word(look, parameter, value.value)
        else:
            here = self.in_units(address, value)
            assert here is not None
            _show_plain(look, parameter, here if look.is_own else as_written(here))


def _show_word(look: CellLook, parameter: Parameter, word: int) -> None:
    """Give a cell the labels of what is set in a word, in full and short, and its number as their unit."""
    look.text = ", ".join(map(label_in_words, labels_of_word(parameter, word).split(", ")))
    look.unit = f"0x{word:X}" if word >= 0 else str(word)
    short = short_labels(tuple(label_in_words(bit.label) for bit in parameter.bits or ()))
    look.short = ", ".join(_short_part(short, part) for part in look.text.split(", "))


def _short_part(short: dict[str, str], part: str) -> str:
    """Return the shorter text of a bit, or of a field with its value: ``name: Y`` of ``Axis name: Y``."""
    label, colon, value = part.partition(": ")
    return short.get(part) or short.get(label, label) + colon + value


def _show_plain(look: CellLook, parameter: Parameter, value: Value) -> None:
    """Give a cell a value that is in the unit it is shown in."""
    plain = show_value(parameter, Value(value.value, ""), secrets=True)
    look.text = plain if look.is_number else plain.replace("\n", " ⏎ ")
    look.unit = unit_in_words(value.unit)
    if parameter.choices:
        look.short = short_labels(tuple(c.label for c in parameter.choices)).get(plain, "")
