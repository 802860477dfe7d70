"""The form of a command that sets parameters, taken from the schema: ``NOTCH {i}({notch.frequency},
{notch.width})``.

A figure may be in brackets (``EXC X(0.25)``): an argument in brackets is an expression, and a
constant is one (Parker Hannifin, ACR Programmer's Guide, page 60, "Parametric Evaluation"). Any other
expression is the controller's to work out, and no setting here.

``{i}`` is the instance, ``{k}`` its place from 0, ``{n}`` its number, ``{v}`` the value of the parameter that
names the command, and ``{other.id}`` that of another one. Blanks between characters may be there or not
(``TLM X 2``, ``TLM X4``, page 115).
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property

from amp_studio.schema import Address, Parameter, Schema

_NUMBER = r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:E[+-]?[0-9]+)?"
_PART = re.compile(r"\{(?P<place>.*?)\}|(?P<word>[A-Za-z0-9]+)|(?P<blank>\s+)|(?P<sign>.)")


@dataclass(frozen=True)
class CommandSetting:
    """One command for one instance: it sets a value or, as NOTCH does, several."""

    template: str
    instance: str
    place: int
    number: str
    """As the manual numbers it, without what is written around the number; empty where it has none."""
    addresses: tuple[Address, ...]

    def write(self, figures: list[str]) -> str:
        """Return the command with these figures."""
        left = iter(figures)
        fill = {"i": self.instance, "k": str(self.place), "n": self.number}
        return _PART.sub(
            lambda found: (
                found[0]
                if found["place"] is None
                else fill[found["place"]]
                if found["place"] in fill
                else next(left)
            ),
            self.template,
        )

    @property
    def name(self) -> str:
        """Its name in messages: ``PPU X``, ``EXC AXIS0``."""
        return self.write(["" for _ in self.addresses]).split("(")[0].rstrip(" =")


@dataclass(frozen=True)
class CommandArgument:
    """A setting as it is in a line: its figures, each with its column, and where it ends."""

    setting: CommandSetting
    figures: tuple[tuple[str, int], ...]
    column: int
    end: int


class Command:
    """One form of a command, for all its instances."""

    def __init__(self, template: str, settings: tuple[CommandSetting, ...]) -> None:
        head, _, tail = template.partition(" ")
        self.word, self.form = ("", template) if "{" in head else (head.upper(), tail)
        """A word in front of all arguments, which need not be repeated: PPU,
        but not the DAC of ``DAC{k} GAIN``."""
        self.settings = settings
        self._by_instance = {s.instance.casefold(): s for s in settings}
        self._by_place = {s.place: s for s in settings}
        self._by_number = {s.number: s for s in settings}

    @property
    def instances(self) -> list[str]:
        return [s.instance for s in self.settings]

    @property
    def example(self) -> str:
        return self.settings[0].write(["1" for _ in self.settings[0].addresses])

    def read(self, text: str, at: int) -> CommandArgument | None:
        """Return the setting at a place of a line; None where there is none."""
        match = self._pattern.match(text, at)
        if match is None:
            return None
        groups = match.groupdict()
        setting: CommandSetting | None = self.settings[0]
        if "n" in groups:
            setting = self._by_number.get(groups["n"])
        elif "k" in groups:
            setting = self._by_place.get(int(groups["k"]))
        elif "i" in groups:
            setting = self._by_instance.get(groups["i"].casefold())
        if setting is None:
            return None
        named = [f"v{n}" if groups[f"v{n}"] else f"w{n}" for n in range(len(setting.addresses))]
        figures = tuple((groups[name], match.start(name) + 1) for name in named)
        return CommandArgument(setting, figures, at + 1, match.end())

    @cached_property
    def _pattern(self) -> re.Pattern[str]:
        """The expression of a command as a person may type it: instances and figures are its groups."""
        # The longest first, or AXIS1 would be found in AXIS10.
        names = "|".join(re.escape(i) for i in sorted(self.instances, key=len, reverse=True))
        places = {"i": rf"\s*(?P<i>{names})\s*", "k": "(?P<k>[0-9]{1,9})", "n": "(?P<n>[0-9]{1,9})"}
        text, count = "", 0
        for part in _PART.finditer(self.form):
            if part["place"] is not None:
                text += places.get(part["place"], _figure(count))
                count += part["place"] not in places
            elif part["blank"]:
                # A blank may be left out only beside a sign, which parts the words anyway.
                text += r"(?:\s+|(?<=[^A-Za-z0-9.])|(?=[^A-Za-z0-9.+-]))"
            else:
                text += re.escape(part[0]) if part["word"] else rf"\s*{re.escape(part[0])}\s*"
        return re.compile(rf"{text}(?:\s+|$)", re.IGNORECASE)


def _figure(n: int) -> str:
    """Return the pattern of a figure, alone or in brackets."""
    return rf"(?:(?P<v{n}>{_NUMBER})|\s*\(\s*(?P<w{n}>{_NUMBER})\s*\))"


def commands_of(schema: Schema, machine: str) -> list[Command]:
    """Return the commands of a family; parameters with one form (``P{i}={v}``) share it, by their
    instances.
    """
    return _commands(schema, machine, _usual_form)


def program_commands_of(schema: Schema, machine: str) -> list[Command]:
    """Return the other forms in which programs of the control set parameters."""
    return _commands(schema, machine, lambda parameter: parameter.program)


def _usual_form(parameter: Parameter) -> tuple[str, ...]:
    return (parameter.storage.command,) if parameter.storage and parameter.storage.command else ()


def _commands(schema: Schema, machine: str, forms: Callable[[Parameter], tuple[str, ...]]) -> list[Command]:
    """Return the commands that set parameters of a machine, each with its settings."""
    commands: dict[str, dict[tuple[Address, ...], CommandSetting]] = {}
    for parameter in schema.parameters.values():
        for template in forms(parameter):
            settings = commands.setdefault(template, {})
            for setting in _settings(schema, machine, parameter, template):
                # Two parameters of one command (NOTCH) both name it: it is one setting.
                settings.setdefault(setting.addresses, setting)
    return [
        Command(template, tuple(settings.values())) for template, settings in commands.items() if settings
    ]


def _settings(schema: Schema, machine: str, parameter: Parameter, template: str) -> Iterator[CommandSetting]:
    places = [m["place"] for m in _PART.finditer(template) if m["place"] not in (None, "i", "k", "n")]
    ids = [parameter.id if place == "v" else place for place in places]
    here = schema.on(machine)
    for place, instance in enumerate(here.instances(parameter)):
        if all(instance in here.instances(schema.parameters[name]) for name in ids):
            number = here.plain_number((parameter.id, instance))
            yield CommandSetting(template, instance, place, number, tuple((name, instance) for name in ids))
