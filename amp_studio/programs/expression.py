"""The arithmetic of a part program: numbers, program parameters, functions, comparisons."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping

from amp_studio.schema import quoted

from .words import DEEPEST, ProgramBlockError

_TOKEN = re.compile(r"\s*([0-9]+\.?[0-9]*|\.[0-9]+|[P#]\s*[0-9]+|[A-Z]+|<=|>=|[-+*/()<>=])")
_SIGNS = {"+": 1.0, "-": -1.0}
_FUNCTIONS: Mapping[str, Callable[[float], float]] = {
    "SIN": lambda x: math.sin(math.radians(x)),
    "COS": lambda x: math.cos(math.radians(x)),
    "TAN": lambda x: math.tan(math.radians(x)),
    "ATAN": lambda x: math.degrees(math.atan(x)),
    "NOT": lambda x: float(x == 0.0),
}
_LEVELS: tuple[Mapping[str, Callable[[float, float], float]], ...] = (
    {
        "AND": lambda a, b: float(a != 0.0 and b != 0.0),
        "OR": lambda a, b: float(a != 0.0 or b != 0.0),
        "XOR": lambda a, b: float((a != 0.0) != (b != 0.0)),
    },
    {
        "=": lambda a, b: float(a == b),
        "<": lambda a, b: float(a < b),
        ">": lambda a, b: float(a > b),
        "<=": lambda a, b: float(a <= b),
        ">=": lambda a, b: float(a >= b),
    },
    {"+": lambda a, b: a + b, "-": lambda a, b: a - b},
    {"*": lambda a, b: a * b, "/": lambda a, b: a / b},
)
"""Operators and what they do, those that bind least first."""


def evaluate(text: str, parameters: Mapping[int, float]) -> float:
    """Return what an expression results in; raises ProgramBlockError for what is none,
    a parameter without a value, and a figure that is no number.
    """
    tokens, place = [], 0
    upper = text.upper().rstrip()
    while place < len(upper):
        match = _TOKEN.match(upper, place)
        if match is None:
            raise ProgramBlockError(f"{quoted(text)} is no expression")
        tokens.append(match[1])
        place = match.end()
    reading = _ExpressionReader(tokens, text, parameters)
    value = reading.level(0, 0)
    if reading.place < len(tokens):
        raise ProgramBlockError(f"{quoted(text)} is no expression")
    if not math.isfinite(value):
        raise ProgramBlockError(f"{quoted(text)} results in no number")
    return value


class _ExpressionReader:
    """One expression, read from left to right."""

    def __init__(self, tokens: list[str], text: str, parameters: Mapping[int, float]) -> None:
        self._tokens, self._text, self._parameters = tokens, text, parameters
        self.place = 0

    def _next(self) -> str:
        if self.place >= len(self._tokens):
            raise ProgramBlockError(f"{quoted(self._text)} ends too early")
        self.place += 1
        return self._tokens[self.place - 1]

    def level(self, level: int, depth: int) -> float:
        """Return the value of what binds at least as ``level``."""
        if level == len(_LEVELS):
            return self._single(depth + 1)
        value = self.level(level + 1, depth)
        while self.place < len(self._tokens) and self._tokens[self.place] in _LEVELS[level]:
            operation = _LEVELS[level][self._next()]
            other = self.level(level + 1, depth)
            try:
                value = operation(value, other)
            except ZeroDivisionError:
                raise ProgramBlockError(f"{quoted(self._text)} divides by 0") from None
        return value

    def _single(self, depth: int) -> float:
        """Return what one operator has at a side: a number, parameter, function or parenthesis."""
        if depth > DEEPEST:
            raise ProgramBlockError(f"{quoted(self._text)} is deeper than {DEEPEST} parentheses")
        piece = self._next()
        if piece in _SIGNS:
            # Counted as a level: a thousand signs in a row would end Python's stack.
            return _SIGNS[piece] * self._single(depth + 1)
        if piece == "(":
            value = self.level(0, depth)
            if self._next() != ")":
                raise ProgramBlockError(f"{quoted(self._text)} has a parenthesis that is not closed")
            return value
        if piece in _FUNCTIONS:
            return _FUNCTIONS[piece](self._single(depth + 1))
        if piece[0] in "P#" and piece[1:].strip().isdigit():
            return self._value_of_parameter(int(piece[1:]))
        if piece[0].isdigit() or piece.startswith("."):
            return float(piece)
        raise ProgramBlockError(f"{quoted(self._text)} is no expression")

    def _value_of_parameter(self, number: int) -> float:
        if number not in self._parameters:
            raise ProgramBlockError(f"P{number} has no value here")
        return self._parameters[number]
