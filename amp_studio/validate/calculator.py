"""The published formulas as calculators: what they ask for, read as a person writes it, and what comes
out.
"""

from __future__ import annotations

import inspect
import json
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from types import UnionType
from typing import Any, Literal, Union, get_args, get_origin, get_type_hints

from amp_studio.schema import InvalidValueError, quoted, read_bare_number, unknown_name, visible, write_number

from .functions import formulas

_LONGEST = 500
"""Most characters that are shown of the message of a formula about its arguments."""
_WORD = re.compile(r'"[^"]*"|[^\[\],\s"][^\[\],"]*')
# What JSON reads as a number; anything else (``05``, ``+5``) is put into quotes as a word.
_NUMBER = re.compile(r"-?(0|[1-9]\d*)(\.\d+)?([eE][-+]?\d+)?")
_YES_NO = {"yes": True, "true": True, "1": True, "no": False, "false": False, "0": False}

_CAPITALS = ("blu", "css", "dac", "dcm", "dda", "led", "num", "oem", "plc", "sercos", "ssi")
_UNITS = {
    **{u: u for u in ("ms", "s", "mm", "deg", "amps", "volts", "rpm")},
    "us": "µs",
    "hz": "Hz",
    "mhz": "MHz",
    "kbytes": "KB",
}
"""Last word of a name -> the unit that it is."""


@dataclass(frozen=True)
class Argument:
    """One thing a calculator asks for."""

    name: str
    kind: Any
    """Its type, as the formula declares it."""
    default: str | None
    """What counts where nothing is given; None where it has to be."""

    @property
    def title(self) -> str:
        """Its name for a person: ``Max contouring``, ``Scan, in ms``."""
        return _title(self.name)

    @property
    def is_several(self) -> bool:
        """Whether it is a list."""
        return get_origin(self.kind) not in (None, Union, UnionType, Literal)

    @property
    def example(self) -> str:
        """How it is written, where it is more than a number."""
        if self.kind is bool:
            return "yes or no"
        if self.kind in (float, int, float | None):
            return ""
        return "text" if self.kind is str else "values with commas, pairs in [ ]"


@dataclass(frozen=True)
class Calculator:
    """One formula: its name, its description, and its arguments."""

    name: str
    description: str
    arguments: tuple[Argument, ...]

    @property
    def title(self) -> str:
        """Its name for a person: ``Lead from threads per inch``."""
        return _title(self.name)


def _title(name: str) -> str:
    """Return a name as a person reads it; a unit at its end is named as one."""
    words = [word.upper() if word in _CAPITALS else word for word in name.split("_")]
    if len(words) > 1 and words[-1] in _UNITS and words[-2] != "per":
        words[-2:] = [f"{words[-2]}, in", _UNITS[words[-1]]]
    text = " ".join(words)
    return text[:1].upper() + text[1:]


@cache
def calculators(family: str) -> dict[str, Calculator]:
    """Return name -> calculator of every published formula of a family."""
    return {name: _calculator(name, function) for name, function in formulas(family).items()}


def _calculator(name: str, function: Any) -> Calculator:
    hints = get_type_hints(function)
    arguments = []
    for parameter in inspect.signature(function).parameters.values():
        required = parameter.default is inspect.Parameter.empty
        default = None if required else shown_result(parameter.default)
        arguments.append(Argument(parameter.name, hints[parameter.name], default))
    return Calculator(name, (inspect.getdoc(function) or "").replace("``", ""), tuple(arguments))


def calculate(family: str, name: str, texts: Mapping[str, str]) -> Any:
    """Return what a formula gives for arguments as a person writes them.

    Raises ValueError with one sentence: an unknown formula or argument, one that is missing, a text that is
    none, or an argument that makes no sense to the formula.
    """
    calculator = calculators(family).get(name)
    if calculator is None:
        raise ValueError(unknown_name("formula", name, calculators(family)))
    arguments = [argument.name for argument in calculator.arguments]
    if unknown := [text for text in texts if text not in arguments]:
        raise ValueError(". ".join(unknown_name(f"argument of {name}", text, arguments) for text in unknown))
    try:
        return formulas(family)[name](**_values(calculator.arguments, name, texts))
    except ArithmeticError:
        raise ValueError(f"{name} cannot be calculated: a number is too large or too small") from None
    except ValueError as error:  # it may repeat a text of any length
        message = visible(str(error))
        raise ValueError(message if len(message) <= _LONGEST else f"{message[: _LONGEST - 1]}…") from None


def _values(arguments: Iterable[Argument], name: str, texts: Mapping[str, str]) -> dict[str, Any]:
    """Return the value of each argument that is given; raises ValueError for one that is missing."""
    values = {}
    for argument in arguments:
        text = texts.get(argument.name, "").strip()
        if text:
            values[argument.name] = _read(argument, text)
        elif argument.default is None:
            raise ValueError(f"{name} needs {argument.name}")
    return values


def _read(argument: Argument, text: str) -> Any:
    """Return the value of an argument in the type that its formula declares; raises ValueError."""
    if argument.kind is str:
        return text
    from pydantic import TypeAdapter  # a check uses formulas and reads no arguments

    try:
        if argument.kind is bool:
            return _YES_NO[text.casefold()]
        if argument.kind in (float, int):
            return TypeAdapter(argument.kind).validate_python(read_bare_number(text))
        if argument.kind == (float | None) and text.casefold() != "none":
            return read_bare_number(text)
        one = None if text.casefold() == "none" else text
        values = _several(argument.kind, text) if argument.is_several else one
        found = TypeAdapter(argument.kind).validate_python(values)
        return list(found) if isinstance(found, Iterator) else found  # pydantic checks its items only now
    except (InvalidValueError, KeyError, ValueError, RecursionError):
        example = f" ({argument.example})" if argument.example else ""
        raise ValueError(f"{quoted(text)} is no {argument.name}{example}") from None


def _several(kind: Any, text: str) -> Any:
    """Return the values of a text with commas and brackets: ``[REAL,1],[INT,4]``, ``X,X,Z``, ``1.5,2`` or
    ``1,5;2``; raises ValueError.

    Words need no quotes; where the formula takes words, what looks like a number is one too (the name of axis
    1).
    """

    def spelled(match: re.Match[str]) -> str:
        word = match[0].strip()
        is_plain = word.startswith('"') or (
            _NUMBER.fullmatch(word) is not None and get_args(kind)[0] is not str
        )
        return word if is_plain else "null" if word.casefold() == "none" else json.dumps(word)

    # Between semicolons a comma is a decimal one.
    spelt = _WORD.sub(spelled, text.replace(",", ".").replace(";", ",") if ";" in text else text)
    # A list of pairs may be written with its outer brackets or without.
    return json.loads(spelt if spelt.startswith("[[") else f"[{spelt}]")


def shown_result(result: Any) -> str:
    """Return what comes out of a formula as a person reads it."""
    if result is None:
        return "none"
    if isinstance(result, bool):
        return "yes" if result else "no"
    if isinstance(result, (int, float)):
        # Nine digits: the tail that the arithmetic leaves (0.30000000000000004) is no result.
        return write_number(float(f"{result:.9g}") if isinstance(result, float) else result)
    if isinstance(result, (tuple, list)):
        return ", ".join(shown_result(part) for part in result)
    return str(result)
