"""What is typed for a value where it is more than a value: ``25.4/5``, ``=rapid*0.8``, ``=X``,
``="Excess Error"@Y / 2``.

A name is an id or its end (``rapid``), the beginning or the whole of a parameter's name in quotes, a number
of the manual in quotes or after ``#``, or the letter of another axis for the same parameter there. Without
``@`` the axis at hand is meant. The text is parsed by the reader of the builder's rules, with its bounds on
length and depth, and calculated in fractions: one rounding, at the end. What does not measure what the
parameter does is refused, never converted in silence.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction
from functools import partial, reduce
from typing import NamedTuple

from amp_studio.files import ParameterFile
from amp_studio.schema import (
    UNITS,
    Address,
    InvalidValueError,
    Parameter,
    UnitError,
    UnknownParameterError,
    Value,
    dimension,
    quoted,
    read_exact,
    read_real,
    read_value,
    resolve_address,
    resolve_axis,
    unit_named,
    unit_text,
    write_number,
)

from .expression_tree import ExpressionError, Node, read_expression

LONGEST = 300
"""Characters of an expression in a cell."""
_SHOWN_CANDIDATES = 4
_LIKE_A_NUMBER = 4
"""Digits of a whole number from which it is taken for the number of a parameter where one has it; 25,
100 and 1000 are figures."""

UnitOf = Callable[[Address], str]
"""The unit in which the value of an address is shown and typed."""


class Entered(NamedTuple):
    """A value that was typed, and the expression it came from; empty where it was typed as it is."""

    value: Value | None
    expression: str = ""


@dataclass(frozen=True, slots=True)
class _Quantity:
    """A number and its unit; the unit is None for a product of units, which is a figure only."""

    number: Fraction
    unit: str | None = ""


_UNIT = r"(?:°|[A-Za-zµ%]+)(?:/[A-Za-z]+[0-9²³]*)*"
_TOKEN = re.compile(
    r"""(?P<blank>\s+)
    |(?P<number>(?:[0-9][0-9.,]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?)
    |(?P<name>(?:"[^"]*"|'[^']*'|\#[A-Za-z$]*[0-9][\w.]*|[^\W\d]\w*(?:\.\w+)*|\$[0-9]+)(?:@\w+(?:\.\w+)?)?)
    |(?P<sign>[-+*/(),;×÷−·])""",
    re.VERBOSE,
)
_BEHIND = re.compile(rf"\s*({_UNIT})")
_OPERATORS = {"×": "*", "·": "*", "÷": "/", "−": "-", ";": ","}
_LOOKS_LIKE = re.compile(r"[\d)\"'\w°]\s*[-+*/×÷−·]\s*[\d(\"'#.A-Za-z]|^\s*[-+−]?\s*\(")
_ONE_VALUE = re.compile(rf"[-+]?[0-9][0-9.,]*(?:[eE][-+]?[0-9]+)?\s*(?:{_UNIT})?")
"""A number with its unit, right or wrong: ``10 mm/min`` is no division."""
_FUNCTIONS: Mapping[str, int] = {"min": 0, "max": 0, "abs": 1, "round": 1, "figure": 1}
"""Name -> how many arguments it takes; 0 for one or more."""


def is_expression(text: str) -> bool:
    """Return whether a text may be an expression: it begins with ``=``,
    or has an operator between two operands.
    """
    text = text.strip()
    return text.startswith("=") or bool(_LOOKS_LIKE.search(text) and not _ONE_VALUE.fullmatch(text))


def enter(file: ParameterFile, address: Address, text: str, unit_of: UnitOf) -> Entered:
    """Read what a person typed for an address: a value, nothing, or an expression; raises InvalidValueError.

    A text of a value is a value, whatever else it could be: ``10 mm/min`` is no division. A parameter that is
    a text takes every text as it is.
    """
    parameter = file.schema.parameters[address[0]]
    if not text.strip():
        return Entered(None)
    may_be = is_expression(text) and parameter.type not in ("text", "format")
    if not (may_be and text.lstrip().startswith("=")):
        try:
            return Entered(read_plain(file, address, text, unit_of))
        except InvalidValueError:
            # Of a choice only ``=`` begins an expression: for a label with a slip in it the error about
            # choices helps.
            if not may_be or parameter.choices:
                raise
    return Entered(_result(file, address, text, unit_of), text.strip().lstrip("=").strip())


def read_plain(file: ParameterFile, address: Address, text: str, unit_of: UnitOf) -> Value:
    """Read a value that was pasted, which is no expression: ``2026-10-06`` is a date.
    Raises InvalidValueError.
    """
    unit = unit_of(address)
    counted = read_real(file.evaluation, address, text, unit)
    return counted or read_value(file.schema.parameters[address[0]], text, unit)


def _result(file: ParameterFile, address: Address, text: str, unit_of: UnitOf) -> Value | None:
    """Return the value of an expression in the unit of its cell; None where what it copies is not set."""
    parameter = file.schema.parameters[address[0]]
    text = text.strip().removeprefix("=").strip()
    if len(text) > LONGEST:
        raise InvalidValueError(f"the expression has {len(text)} characters, and {LONGEST} are the most")
    reader = _Reader(file, address, unit_of)
    if (copied := reader.reference_alone(text)) is not None:
        return copied
    if parameter.choices:
        name = parameter.name
        raise InvalidValueError(f"{name} is a choice: only the value of another one can be taken, as =Y")
    found = reader.calculated(text)
    unit = unit_of(address)
    if found.unit:
        if dimension(found.unit) != dimension(unit):
            raise InvalidValueError(
                f"the result is in {unit_text(found.unit)}, and {parameter.name} is given in"
                f" {unit_text(unit) or 'a bare number'}; figure(…) takes a number without its unit"
            )
        # The only conversion: what was added or compared is in one unit by then, see _alike.
        found = _in_unit(found, unit)
    figure = _figure(found.number)
    if parameter.type in ("integer", "bits"):
        # Exact in fractions; as a double 0.57 * 100 is 56.99999999999999.
        if found.number.denominator != 1:
            name = parameter.name
            raise InvalidValueError(f"{name} takes whole numbers, and the result is {figure}: use round(…)")
        return read_value(parameter, str(found.number.numerator), unit)
    # Through the reader of typed values, so that a result has the same checks and errors as a figure.
    return read_value(parameter, f"{figure} {unit}".strip(), unit)


def _figure(number: Fraction) -> str:
    """Return the nearest double in digits; raises InvalidValueError where there is none,
    or only 0 for what is not 0.
    """
    try:
        if (nearest := float(number)) or not number:
            return write_number(nearest)
    except OverflowError:
        raise InvalidValueError("the result is too large") from None
    raise InvalidValueError("the result is too small")


def _before_comma(piece: str) -> str:
    """Return what is before a comma between the values that a function takes; raises InvalidValueError for
    one that a digit follows: ``min(0,5 mm, 2 mm)`` would be 0.
    """
    whole, _, behind = piece.partition(",")
    if behind:
        raise InvalidValueError(f"'{piece}' can be read two ways: put semicolons between the values")
    return whole


class _Reader:
    """Reads and calculates one expression for one address."""

    def __init__(self, file: ParameterFile, address: Address, unit_of: UnitOf) -> None:
        self._file, self._here, self._unit_of = file, address, unit_of
        self._known: dict[str, tuple[str, _Quantity]] = {}
        """Name for the parser -> the text in its place, and what that is."""

    def reference_alone(self, text: str) -> Value | None:
        """Return the value that a text names as it is, of any kind; None where the text is more than a
        name.
        """
        token = _TOKEN.fullmatch(text)
        if token is None or token.lastgroup != "name":
            return None
        source = self._address(text)
        value = self._set_value(source, text)
        mine, other = (self._file.schema.parameters[a[0]] for a in (self._here, source))
        if mine.id == other.id:
            return value
        if isinstance(value.value, (str, bool)) or mine.choices:
            raise InvalidValueError(f"{quoted(text)} is a choice or a text of another parameter")
        return None

    def calculated(self, text: str) -> _Quantity:
        """Return what an expression comes to; raises InvalidValueError."""
        try:
            return self._value(read_expression(self._for_parser(text)))
        except ExpressionError as error:
            raise InvalidValueError(
                f"the expression cannot be read: {self._in_own_words(str(error))}"
            ) from None

    def _in_own_words(self, message: str) -> str:
        """Return a message of the parser with what the user wrote in place of the names that the parser was
        given.
        """
        return re.sub(r"v\d+_", lambda m: self._known.get(m[0], (m[0],))[0], message)

    # -- names and numbers -------------------------------------------------------

    def _for_parser(self, text: str) -> str:
        """Return the text with a plain name for each quantity, which is what the parser reads."""
        pieces, at = [], 0
        brackets: list[bool] = []
        """Of each open bracket: whether it is that of a function that takes several values."""
        while at < len(text):
            token = _TOKEN.match(text, at)
            if token is None:
                raise InvalidValueError(f"{quoted(text[at])} has no place in an expression")
            kind, piece, at = token.lastgroup, token[0], token.end()
            if kind == "number":
                if any(brackets[-1:]) and "," in piece and ";" not in text:
                    piece = _before_comma(piece)
                    at = token.start() + len(piece)
                quantity, at = self._quantity(piece, text, at)
                pieces.append(self._plain_name(text[token.start() : at], quantity))
            elif kind == "name" and not (piece in _FUNCTIONS and text[at:].lstrip().startswith("(")):
                pieces.append(self._plain_name(piece, self._referred(piece)))
            else:
                if piece == "(":
                    brackets.append(bool(pieces) and _FUNCTIONS.get(pieces[-1]) == 0)
                elif piece == ")":
                    del brackets[-1:]
                if kind != "blank":
                    pieces.append(_OPERATORS.get(piece, piece))
        return " ".join(pieces)

    def _plain_name(self, text: str, quantity: _Quantity) -> str:
        name = f"v{len(self._known)}_"
        self._known[name] = text, quantity
        return name

    def _quantity(self, digits: str, text: str, at: int) -> tuple[_Quantity, int]:
        """Return a number with the unit behind it, if there is one, and where it ends."""
        number, rest = read_exact(digits)
        if rest:
            raise InvalidValueError(f"{quoted(digits)} is not a number")
        behind = _BEHIND.match(text, at)
        word = behind[1] if behind else ""
        while word:  # "25.4 mm/min", but "25.4 mm/X" divides by X
            try:
                return _Quantity(number, unit_named(word)), behind.start(1) + len(word) if behind else at
            except UnitError:
                word = word.rpartition("/")[0]
        if behind:
            raise InvalidValueError(f"{quoted(behind[1])} behind {digits} is no unit")
        if len(digits) >= _LIKE_A_NUMBER and digits.isdecimal() and not digits.endswith("000"):
            self._ask_about(digits)
        return _Quantity(number), at

    def _ask_about(self, digits: str) -> None:
        """Refuse a bare whole number that is the number of a parameter;
        raises InvalidValueError with both ways to write it.
        """
        try:
            address = resolve_address(self._file.evaluation, digits).address
        except UnknownParameterError:
            return
        label = self._file.machine_schema.label(address)
        raise InvalidValueError(
            f"{digits} is also the number of {label}: write #{digits} for its value, or {digits}.0 for the"
            " figure"
        )

    def _referred(self, name: str) -> _Quantity:
        """Return the value of a parameter in the unit in which it is shown."""
        address = self._address(name)
        value = self._set_value(address, name)
        if isinstance(value.value, (str, bool)):
            raise InvalidValueError(f"{quoted(name)} is no number")
        # By its shortest decimals: 0.1 is a tenth here, not the double beside it.
        number = Fraction(Decimal(repr(value.value)))
        return _in_unit(_Quantity(number, value.unit), self._unit_of(address) if value.unit else "")

    def _set_value(self, address: Address, name: str) -> Value:
        value, parameter = self._file.get(address), self._file.schema.parameters[address[0]]
        if parameter.secret:
            raise InvalidValueError(f"{quoted(name)}: {parameter.name} is secret")
        if value is None:
            raise InvalidValueError(f"{quoted(name)}: {self._file.machine_schema.label(address)} is not set")
        return value

    def _address(self, text: str) -> Address:
        """Return the one value that a name means; raises InvalidValueError."""
        name, _, instance = text.rpartition("@") if "@" in text else (text, "", "")
        is_quoted = name[:1] in ("'", '"')
        name = name.strip("\"'").removeprefix("#").strip()
        if not name:
            raise InvalidValueError(f"{quoted(text)} names nothing")
        if not instance and not is_quoted and (axis := self._other_axis(name)) is not None:
            return axis
        try:
            # An id by itself goes on to _at, which takes the instance at hand.
            if instance or name.casefold() not in self._file.schema.parameters:
                text_of_address = "@".join(filter(None, (name, instance)))
                return resolve_address(self._file.evaluation, text_of_address).address
        except UnknownParameterError as error:
            if name.casefold() in self._file.schema.parameters:
                raise InvalidValueError(str(error)) from None
        return self._at(self._parameter(name, text), instance)

    def _other_axis(self, letter: str) -> Address | None:
        """Return the same parameter on the axis that a letter names; None where it names none."""
        here, part = self._here[1].partition(".")[::2]
        if not here or len(letter) > 2 or not self._file.machine_schema.kin(self._scope(), "axis"):
            return None
        instances = self._file.machine_schema.instances(self._file.schema.parameters[self._here[0]])
        try:
            axis = resolve_axis(self._file.evaluation, tuple(i.partition(".")[0] for i in instances), letter)
        except UnknownParameterError:
            return None
        instance = f"{axis}.{part}" if part else axis
        return (self._here[0], instance) if instance in instances else None

    def _scope(self) -> str | None:
        return self._file.evaluation.scope(self._here)

    def _parameter(self, name: str, text: str) -> str:
        """Return the id of the parameter whose id, name, or end of the id this is,
        or which alone begins with it.
        """
        word, known = name.casefold(), self._file.schema.parameters.values()
        here = [p for p in known if self._file.machine_schema.instances(p)]
        # From exact to vague, and the first way that finds anything decides: a whole name is never
        # ambiguous because a longer one contains it.
        ways: tuple[Callable[[Parameter], bool], ...] = (
            lambda p: word in (p.id, p.name.casefold()),
            lambda p: p.id.endswith("." + word),
            lambda p: p.name.casefold().startswith(word),
            lambda p: f" {word} " in f" {p.name.casefold()} ",
        )
        for fits in ways:
            found = [p for p in here if fits(p)]
            if len(found) == 1:
                return found[0].id
            if found:
                near = ", ".join(p.id for p in found[:_SHOWN_CANDIDATES])
                more = f" and {len(found) - _SHOWN_CANDIDATES} more" if len(found) > _SHOWN_CANDIDATES else ""
                raise InvalidValueError(f"{quoted(text)} can mean several parameters: {near}{more}")
        raise InvalidValueError(f"{quoted(text)} is no parameter")

    def _at(self, parameter_id: str, instance: str) -> Address:
        """Return the instance of a parameter that is meant: the one named, the one at hand, or the only
        one.
        """
        instances = self._file.machine_schema.instances(self._file.schema.parameters[parameter_id])
        if instance:
            try:
                return resolve_address(self._file.evaluation, f"{parameter_id}@{instance}").address
            except UnknownParameterError as error:
                raise InvalidValueError(str(error)) from None
        whole = self._here[1].partition(".")[0]
        alike = self._file.machine_schema.scopes[parameter_id] == self._scope()
        for wanted in (self._here[1], whole) if alike else ("",):
            if wanted in instances:
                return parameter_id, wanted
        if whole in instances:
            return parameter_id, whole
        if len(instances) == 1:
            return parameter_id, instances[0]
        raise InvalidValueError(f"{parameter_id} has several values: write {parameter_id}@{instances[0]}")

    # -- calculating -------------------------------------------------------------

    def _value(self, node: Node) -> _Quantity:
        """Return what a tree comes to, in fractions; raises InvalidValueError for what is no arithmetic."""
        if node.kind == "name" and node.text in self._known:
            # A quantity of the text; any other name is none, and ends below.
            return self._known[node.text][1]
        parts = (
            [self._value(part) for part in node.parts] if node.kind in (*"+-*/", "negative", "call") else []
        )
        match node.kind:
            case "negative":
                return _Quantity(-parts[0].number, parts[0].unit)
            case "+" | "-":
                return _sum(parts[0], parts[1], {"+": 1, "-": -1}[node.kind])
            case "*":
                return _product(*parts)
            case "/":
                return _quotient(*parts)
            case "call":
                return _called(str(node.value), parts)
        raise InvalidValueError(f"{quoted(self._in_own_words(node.text))} is no arithmetic")


def _in_unit(quantity: _Quantity, unit: str) -> _Quantity:
    """Return a quantity in another unit of the same dimension, exactly."""
    if quantity.unit == unit or not quantity.unit:
        return quantity
    return _Quantity(quantity.number * UNITS[quantity.unit][1] / UNITS[unit][1], unit)


def _alike(a: _Quantity, b: _Quantity) -> tuple[_Quantity, _Quantity]:
    """Return two quantities in one unit; a bare number takes the unit of the other. Raises
    InvalidValueError.
    """
    if b.unit in (a.unit, ""):
        return a, _Quantity(b.number, a.unit)
    if a.unit == "":
        return _Quantity(a.number, b.unit), b
    if a.unit is None or b.unit is None or dimension(a.unit) != dimension(b.unit):
        names = [unit_text(q.unit) if q.unit else "a product of units" for q in (a, b)]
        raise InvalidValueError(f"{names[0]} and {names[1]} cannot be added or compared")
    return a, _in_unit(b, a.unit)


def _sum(a: _Quantity, b: _Quantity, sign: int) -> _Quantity:
    a, b = _alike(a, b)
    return _Quantity(a.number + sign * b.number, a.unit)


def _product(a: _Quantity, b: _Quantity) -> _Quantity:
    unit = b.unit if a.unit == "" else a.unit if b.unit == "" else None
    return _Quantity(a.number * b.number, unit)


def _quotient(a: _Quantity, b: _Quantity) -> _Quantity:
    if b.number == 0:
        raise InvalidValueError("the expression divides by 0")
    if a.unit and b.unit and dimension(a.unit) == dimension(b.unit):
        # Two lengths give a ratio, which is a bare number again and may be used anywhere.
        return _Quantity(a.number / _in_unit(b, a.unit).number)
    return _Quantity(a.number / b.number, a.unit if b.unit == "" else None)


def _called(name: str, parts: list[_Quantity]) -> _Quantity:
    """Return the result of a function; raises InvalidValueError for an unknown one or a wrong number of
    values.
    """
    if name not in _FUNCTIONS:
        raise InvalidValueError(f"{quoted(name)} is no function: {', '.join(_FUNCTIONS)}")
    wanted = _FUNCTIONS[name]
    if not parts or (wanted and len(parts) != wanted):
        raise InvalidValueError(f"{name}(…) takes {f'{wanted} value' if wanted else 'one or more values'}")
    first = parts[0]
    match name:
        case "abs":
            return _Quantity(abs(first.number), first.unit)
        case "round":
            half = Fraction(1, 2) if first.number >= 0 else Fraction(-1, 2)
            # A half goes away from 0, as people round.
            return _Quantity(Fraction(int(first.number + half)), first.unit)
        case "figure":
            return _Quantity(first.number)
    return reduce(partial(_better, {"min": -1, "max": 1}[name]), parts)


def _better(sign: int, one: _Quantity, other: _Quantity) -> _Quantity:
    """Return the larger of two, or the smaller where ``sign`` is -1; the first where they are equal."""
    mine, theirs = _alike(one, other)
    return theirs if sign * theirs.number > sign * mine.number else mine
