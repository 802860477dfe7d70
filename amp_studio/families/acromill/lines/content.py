"""What an ACR card contains: a script that would set it as it is, and its ballscrew words,
under a line that names the kind.

A setting is a line in the form of its command. One that the card has and that is off is its name alone:
``LOPASS X``.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from decimal import Decimal
from functools import cache

from amp_studio.families.acromill.formats import acr_script, ballscrew
from amp_studio.families.acromill.formats.acr_command import CommandSetting, commands_of
from amp_studio.files import ParameterFile
from amp_studio.formats import (
    FormatError,
    ReadOptions,
    TextRead,
    default_system,
    file_of,
    system_of,
    write_figure,
)
from amp_studio.schema import Address, InvalidValueError, Value, load_schema
from amp_studio.transfer import ImageError, TakesAllOrRefuses

KIND = "ACR script 1"
FAMILY = "acromill"
TABLE = "ballscrew.table"
LONGEST = 250
"""Characters of a line; the longest figure that a card shows has some hundred."""
_DIGITS = 7
"""Digits that a card shows (pages 92 and 94)."""
_HEAD = re.compile(rf"{KIND}\nREM units ([a-z]+)\n")
_BALLSCREW = re.compile(r"BSC (([A-Z])[0-9]{1,6})E(-?\.[0-9]{5})")
_NAMED = 5


@dataclass
class CardContent:
    """A content taken apart; names are those of commands (``PPU X``) and of ballscrew positions (``BSC
    X0``).
    """

    system: str
    figures: dict[str, tuple[str, ...]] = field(default_factory=dict)
    """Setting -> its figures; none for a filter that is off."""
    ballscrew: dict[str, str] = field(default_factory=dict)
    """Position -> compensation."""

    @classmethod
    def read(cls, content: bytes) -> CardContent:
        """Take a content apart; raises ImageError."""
        try:
            text = content.decode("ascii")
        except UnicodeDecodeError:
            raise ImageError("the script of the card contains more than ASCII") from None
        head = _HEAD.match(text)
        if head is None:
            raise ImageError("this is not the script of an ACR card")
        found = cls(head[1])
        *lines, end, rest = text[head.end() :].split("\n") if text.endswith("\n") else ["", ""]
        # The number of lines at its end shows a script that was cut off, between two lines too.
        if rest or end != f"end {len(lines)}":
            raise ImageError("the script of the card has been cut off")
        by_name = {setting.name: setting for setting in settings()}
        for number, line in enumerate(lines, 3):
            found._read_line(line, number, by_name)
        return found

    def _read_line(self, line: str, number: int, by_name: dict[str, CommandSetting]) -> None:
        """Keep what a line of the script sets; raises ImageError for one that sets nothing known, or sets it
        again.
        """
        # Cut before it is matched: a damaged line may be of any length.
        word = _BALLSCREW.fullmatch(line[: LONGEST + 1])
        name, figures = (f"BSC {word[1]}", (str(word[3]),)) if word else _figures_of(line, by_name)
        if not name or len(line) > LONGEST or name in self.figures or name in self.ballscrew:
            raise ImageError(
                f"line {number} of the script of the card sets nothing that is known, or twice: {line[:60]}"
            )
        if word:
            self.ballscrew[name] = figures[0]
        else:
            self.figures[name] = figures

    def names(self) -> dict[str, tuple[str, ...]]:
        """Return every setting with its figures."""
        return {**self.figures, **{name: (figure,) for name, figure in self.ballscrew.items()}}

    def lines(self) -> dict[str, str]:
        """Return the line that sets each setting, in the order in which they are sent;
        the name alone if it is off.
        """
        lines = {}
        for setting in settings():
            figures = self.figures.get(setting.name)
            if figures is not None:
                lines[setting.name] = setting.write(list(figures)) if figures else setting.name
        return lines | {
            name: f"{name}E{figure}" for name, figure in sorted(self.ballscrew.items(), key=_position)
        }

    def written(self) -> bytes:
        """Return the bytes."""
        lines = list(self.lines().values())
        return "\n".join([KIND, f"REM units {self.system}", *lines, f"end {len(lines)}", ""]).encode("ascii")


class AcrContent(TakesAllOrRefuses):
    """Between a parameter file and the settings of one card."""

    has_header = False

    def decode(self, content: bytes) -> ParameterFile:
        """Return what the settings mean; raises ImageError."""
        card, schema = CardContent.read(content), load_schema(FAMILY)
        lines = card.lines()
        script = [
            f"REM units {card.system}",
            *(lines[name] for name, figures in card.figures.items() if figures),
        ]
        try:
            found = acr_script.FORMAT.read("\n".join(script), schema, ReadOptions())
            if card.ballscrew:
                words = [lines[name].removeprefix("BSC ") for name in lines if name in card.ballscrew]
                found.values.update(ballscrew.FORMAT.read("\n".join(words), schema, ReadOptions()).values)
        except FormatError as error:
            raise ImageError(f"the script of the card: {error}") from None
        if card.system == default_system(schema) and schema.family.unit_parameter:
            del found.values[
                schema.family.unit_parameter, ""
            ]  # as delivered; the card itself does not know it
        return file_of(schema, TextRead(found.values), "card")

    def encode(self, file: ParameterFile, current: bytes) -> bytes:
        """Return the settings of the card with those of a file in them; raises ImageError,
        which names what it does not have.
        """
        card = CardContent.read(current)
        if system_of(file) != card.system:
            raise ImageError(
                f"the figures of the file are {system_of(file)}, and the card was read as {card.system}: a"
                " card does not know its unit (?protocol=terminal is inch, ?protocol=terminal-metric is"
                " metric)"
            )
        wanted = _figures_in(file, card)
        if missing := [name for name in wanted if name not in card.figures]:
            raise ImageError(f"the card does not have {names_of(missing)}, which the file sets")
        for name, figures in wanted.items():
            if not same_figures(figures, card.figures[name]):
                card.figures[name] = figures
        _take_ballscrew(card, _ballscrew_in(file))
        return card.written()

    def lacks(self, content: bytes, earlier: bytes) -> str:
        """Return the settings that the card had; a ballscrew table may become shorter. Raises ImageError."""
        present = CardContent.read(content).figures
        return names_of([name for name in CardContent.read(earlier).figures if name not in present])

    def refit(self, content: bytes, current: bytes) -> bytes:
        """Return what the card contains once settings that were kept are put back; raises ImageError."""
        copy = CardContent.read(content)
        if not current:
            return content
        card = CardContent.read(current)
        if missing := [name for name in copy.figures if name not in card.figures]:
            raise ImageError(f"the card does not have {names_of(missing)}, which the copy sets")
        if short := [name for name in card.figures if name not in copy.figures]:
            raise ImageError(
                f"the copy does not have {names_of(short)}, which the card has: it is short and cannot be put"
                " back as a whole (the parameter file beside it can be downloaded: it sets what it has)"
            )
        stuck = [name for name, figures in copy.figures.items() if not figures and card.figures[name]]
        if stuck:
            raise ImageError(
                f"{names_of(stuck)} is off in the copy and on at the card, and how a filter is switched off"
                " is not printed"
            )
        for name, figures in copy.figures.items():
            if not same_figures(figures, card.figures[name]):
                card.figures[name] = figures
        _take_ballscrew(card, copy.ballscrew, as_a_whole=True)
        return card.written()

    def displayed(self, content: bytes, found: bytes) -> bytes:
        """Return a content with the figures of another one that a card shows the same."""
        wanted, present = CardContent.read(content), CardContent.read(found)
        for name, figures in present.figures.items():
            if name in wanted.figures and same_figures(wanted.figures[name], figures):
                wanted.figures[name] = figures
        return wanted.written()

    def difference(self, content: bytes, found: bytes) -> str:
        """Return the settings that differ by what a card shows, in a few words."""
        try:
            different = differing_settings(content, found)
        except ImageError:
            return "so much that it cannot be read"
        return f"in {names_of(different)}" if different else ""


def differing_settings(a: bytes, b: bytes) -> list[str]:
    """Return the settings that differ between two contents, in the order in which they are sent;
    raises ImageError.
    """
    first, second = CardContent.read(a), CardContent.read(b)
    one, other = first.names(), second.names()
    return [
        name
        for name in {**first.lines(), **second.lines()}
        if name not in one or name not in other or not same_figures(one[name], other[name])
    ]


def same_figures(a: Iterable[str], b: Iterable[str]) -> bool:
    """Return whether a card shows two settings the same."""
    return [_rounded(figure) for figure in a] == [_rounded(figure) for figure in b]


def plain_figure(text: str) -> str:
    """Return a figure without an exponent: ``1.99E-07`` is ``0.000000199``."""
    number = Decimal(text)
    # abs of a zero: "-0" and "0" are one figure.
    plain = format(number or abs(number), "f")
    return plain.rstrip("0").rstrip(".") if "." in plain else plain


def _rounded(figure: str) -> Decimal:
    number = Decimal(figure)
    return number if not number else round(number, _DIGITS - 1 - number.adjusted()).normalize()


@cache
def settings() -> tuple[CommandSetting, ...]:
    """Return all settings that a card keeps, in the order in which they are sent.
    P parameters do not outlast its power.
    """
    schema = load_schema(FAMILY)
    rank = {word: n for n, word in enumerate(acr_script.ORDER)}

    def order(setting: CommandSetting) -> int:
        word = re.match("[A-Z]*", setting.template)
        return rank.get(word[0] if word else "", len(rank))

    commands = commands_of(schema, schema.family.default_machine)
    return tuple(
        sorted((s for c in commands for s in c.settings if not s.template.startswith("P{")), key=order)
    )


def _figures_of(line: str, by_name: dict[str, CommandSetting]) -> tuple[str, tuple[str, ...]]:
    """Return which setting a line sets and with which figures, none for its name alone;
    an empty name where it sets none.
    """
    if line in by_name:
        return line, ()
    figure = r"([+-]?(?:[0-9]+(?:\.[0-9]+)?|\.[0-9]+))"
    # A name may be the beginning of another one: the whole line decides.
    for name, setting in by_name.items():
        if line.startswith(name):
            pattern = re.escape(setting.write(["\0"] * len(setting.addresses))).replace("\0", figure)
            if match := re.fullmatch(pattern.replace(re.escape("\0"), figure), line):
                return name, match.groups()
    return "", ()


def _figures_in(file: ParameterFile, card: CardContent) -> dict[str, tuple[str, ...]]:
    """Return the settings that a file makes; the part that it leaves open stays as the card has it."""
    wanted = {}
    for setting in settings():
        values = [file.get(address) for address in setting.addresses]
        hidden = any(file.evaluation.state(address).state == "hidden" for address in setting.addresses)
        if hidden or all(value is None for value in values):
            continue
        name, figures = setting.name, list[str]()
        present = card.figures.get(name, ())
        for n, (address, value) in enumerate(zip(setting.addresses, values, strict=True)):
            if value is None and n >= len(present):
                raise ImageError(f"{name} has several figures, and the file sets only some of them")
            figures.append(present[n] if value is None else _figure(file, address, value, card.system))
        wanted[name] = tuple(figures)
    return wanted


def _figure(file: ParameterFile, address: Address, value: Value, system: str) -> str:
    try:
        return write_figure(file.schema, file.schema.parameters[address[0]], value, system)
    except InvalidValueError as error:
        raise ImageError(f"{file.machine_schema.label(address)}: {error}") from None


def _ballscrew_in(file: ParameterFile) -> dict[str, str]:
    found = {}
    for address in file.addresses():
        value = file.get(address) if address[0] == TABLE else None
        for word in str(value.value).split() if value is not None else ():
            position, _, figure = word.partition("E")
            found[f"BSC {position}"] = figure
    return found


def _take_ballscrew(card: CardContent, wanted: dict[str, str], *, as_a_whole: bool = False) -> None:
    """Put a table into the card's; positions that the card has too many of cannot be taken out."""
    axes = {name[4] for name in (card.ballscrew if as_a_whole else wanted)}
    if left := [name for name in card.ballscrew if name[4] in axes and name not in wanted]:
        raise ImageError(f"the card has {names_of(left)} too, and how positions are taken out is not printed")
    card.ballscrew.update(wanted)


def _position(item: tuple[str, str]) -> tuple[str, int]:
    return item[0][4], int(item[0][5:])


def names_of(names: list[str]) -> str:
    """Return some names for a sentence, and how many more there are."""
    more = len(names) - _NAMED
    return ", ".join(names[:_NAMED]) + (f" and {more} more" if more > 0 else "")


def positions_of(rows: list[str]) -> Iterator[tuple[str, str]]:
    """Yield the positions of a ballscrew table that a card lists, ``X0E.00325``;
    raises ValueError for something else.
    """
    for row in rows:
        match = _BALLSCREW.fullmatch(f"BSC {row.strip()}")
        if match is None:
            raise ValueError(row)
        yield f"BSC {match[1]}", match[3]
