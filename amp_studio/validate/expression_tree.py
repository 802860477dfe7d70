"""The expressions of a builder's rule as trees, read before the engine sees them.

The engine takes any text: thousands of brackets end the interpreter, and its message about a slip is no
sentence for a person. So an expression is read here first, by a grammar that is a part of the engine's, with
bounds on length and depth. What this does not read, the engine never gets.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import NamedTuple

from amp_studio.errors import AmpStudioError

LONGEST = 4000
"""Characters of an expression; the longest of our own has 1030."""
DEEPEST_BRACKETS = 24
"""Brackets and alternatives in each other: the engine needs some 10 kB of stack for each,
and a thread has 512 kB."""
DEEPEST = 100
"""Operations in each other; a sum of 100 numbers is so deep."""
# The whole numbers of CEL have 64 bits.
_LARGEST_WHOLE = 2**63 - 1

MACROS = {"all": (2,), "exists": (2,), "exists_one": (2,), "filter": (2,), "map": (2, 3)}
"""What goes over a list, and how many arguments it takes."""
RESERVED = frozenset(
    (
        "as",
        "break",
        "const",
        "continue",
        "else",
        "false",
        "for",
        "function",
        "if",
        "import",
        "in",
        "let",
        "loop",
        "package",
        "namespace",
        "null",
        "return",
        "true",
        "var",
        "void",
        "while",
    )
)
"""Words that the language keeps for itself."""


class ExpressionError(AmpStudioError, ValueError):
    """A text that is no expression: one clause in plain words."""


@dataclass(frozen=True, slots=True)
class Node:
    """A part of an expression.

    ``kind`` is value, name, list, table (keys and values in turn), index, call, over, or an operator.
    """

    kind: str
    text: str
    """As it is written."""
    parts: tuple[Node, ...] = ()
    value: float | int | str | bool | None = None
    """What a value is; the name of a name, a function and of what goes over a list."""
    bound: str = ""
    """The name of each item while a list is gone over."""
    depth: int = 1


class _Token(NamedTuple):
    kind: str
    text: str
    start: int
    end: int


_TOKEN = re.compile(
    r"""(?P<blank>[ \t\r\n\f]+|//[^\n]*)
    |(?P<decimal>(?:[0-9]+\.[0-9]+|\.[0-9]+)(?:[eE][+-]?[0-9]+)?|[0-9]+[eE][+-]?[0-9]+)
    |(?P<whole>0x[0-9a-fA-F]+|[0-9]+)
    |(?P<text>'(?:[^'\\\r\n]|\\[\\'"abfnrtv])*'|"(?:[^"\\\r\n]|\\[\\'"abfnrtv])*")
    |(?P<name>[A-Za-z_][A-Za-z0-9_]*)
    |(?P<sign>&&|\|\||==|!=|<=|>=|[-+*/%<>!?:.,()\[\]{}])""",
    re.VERBOSE,
)
_ESCAPED = {"a": "\a", "b": "\b", "f": "\f", "n": "\n", "r": "\r", "t": "\t", "v": "\v"}
_OPERATORS = {"=": "'=='", "&": "'&&'", "|": "'||'", "and": "'&&'", "or": "'||'"}
"""What people write, and what it is here."""


def read_expression(text: str) -> Node:
    """Return the tree of an expression; raises ExpressionError."""
    if len(text) > LONGEST:
        raise ExpressionError(f"has {len(text):,} characters, and {LONGEST:,} are the most")
    return _ExpressionParser(text).whole()


def _tokens(text: str) -> list[_Token]:
    """Return the tokens of an expression without blanks and comments, and one of kind ``end`` behind them."""
    found, at = [], 0
    while at < len(text):
        match = _TOKEN.match(text, at)
        if match is None:
            raise ExpressionError(_unreadable(text, at))
        at = match.end()
        if match.lastgroup != "blank":
            found.append(_Token(str(match.lastgroup), match[0], match.start(), at))
    return [*found, _Token("end", "", len(text), len(text))]


def _unreadable(text: str, at: int) -> str:
    """Return what is wrong with the character where no token begins, in one clause."""
    character = text[at]
    if character in _OPERATORS:
        return f"'{character}' is no operator: write {_OPERATORS[character]}"
    if character in "'\"":
        return (
            f"the text that begins with {quoted(text[at : at + 20])} has no end in its line, or a \\ that"
            " means nothing"
        )
    return f"{quoted(character)} has no place in an expression"


def quoted(text: str) -> str:
    """Return a piece of an expression as messages show it: short, in one line, and readable."""
    plain = "".join(c if c.isprintable() else f"\\u{ord(c):04x}" for c in " ".join(text.split()) or text)
    short = plain if len(plain) <= 60 else plain[:57] + "..."
    return short if short[:1] and short[0] in "'\"" else f"'{short}'"


class _ExpressionParser:
    def __init__(self, text: str) -> None:
        self._text, self._tokens, self._at = text, _tokens(text), 0
        self._brackets = 0

    # -- tokens ----------------------------------------------------------------

    @property
    def _next(self) -> _Token:
        return self._tokens[self._at]

    def _accept(self, *operators: str) -> str:
        """Take one of these operators, if it is the next one; return it, or nothing."""
        token = self._next
        if token.text in operators and token.kind in ("sign", "name"):
            self._at += 1
            return token.text
        return ""

    def _need(self, operator: str, where: str) -> None:
        if not self._accept(operator):
            raise ExpressionError(f"'{operator}' is missing{where}{self._place()}")

    def _place(self) -> str:
        token = self._next
        return f" before {quoted(token.text)}" if token.kind != "end" else " at the end"

    def _node(
        self, kind: str, start: int, parts: tuple[Node, ...], value: str | None = None, bound: str = ""
    ) -> Node:
        depth = 1 + max((part.depth for part in parts), default=0)
        if depth > DEEPEST:
            raise ExpressionError(f"has more than {DEEPEST} operations in each other")
        end = self._tokens[self._at - 1].end
        return Node(kind, self._text[start:end], parts, value, bound, depth)

    # -- grammar ---------------------------------------------------------------

    def whole(self) -> Node:
        node = self._expression()
        token = self._next
        if token.kind != "end":
            # ``and``, ``or`` and a single ``=`` are what people write first.
            operator = _OPERATORS.get(token.text)
            raise ExpressionError(
                f"{quoted(token.text)} is no operator: write {operator}"
                if operator
                else f"{quoted(token.text)} behind {quoted(node.text)} makes no sense"
            )
        return node

    def _expression(self) -> Node:
        """Read an expression, or an alternative ``a ? b : c``, which binds least."""
        self._brackets += 1
        # Refused while it is read: the parser itself calls itself for each bracket.
        if self._brackets > DEEPEST_BRACKETS:
            raise ExpressionError(f"has more than {DEEPEST_BRACKETS} brackets or alternatives in each other")
        start = self._next.start
        node = self._either()
        if self._accept("?"):
            # No alternative before the colon without brackets, as in the engine's grammar.
            one = self._either()
            self._need(":", " behind '?'")
            node = self._node("?:", start, (node, one, self._expression()))
        self._brackets -= 1
        return node

    def _either(self) -> Node:
        return self._chain("||", self._conjunction)

    def _conjunction(self) -> Node:
        return self._chain("&&", self._relation)

    def _chain(self, operator: str, operand: Callable[[], Node]) -> Node:
        start = self._next.start
        parts = [operand()]
        while self._accept(operator):
            parts.append(operand())
        # One node for a whole chain: its depth does not grow with its length.
        return parts[0] if len(parts) == 1 else self._node(operator, start, tuple(parts))

    def _relation(self) -> Node:
        return self._binary(("==", "!=", "<", "<=", ">", ">=", "in"), self._sum)

    def _sum(self) -> Node:
        return self._binary(("+", "-"), self._product)

    def _product(self) -> Node:
        return self._binary(("*", "/", "%"), self._unary)

    def _binary(self, operators: tuple[str, ...], operand: Callable[[], Node]) -> Node:
        start = self._next.start
        node = operand()
        while operator := self._accept(*operators):
            # To the left, as the engine does: ``a - b - c`` is ``(a - b) - c``.
            node = self._node(operator, start, (node, operand()))
        return node

    def _unary(self) -> Node:
        """Read what may have ``!`` or ``-`` in front of it."""
        start, count = self._next.start, 0
        operator = self._next.text
        # Only one kind of sign in a row: the grammar of the engine has no "!-".
        while operator in ("!", "-") and self._accept(operator):
            count += 1
        node = self._member()
        for _ in range(count):
            node = self._node("!" if operator == "!" else "negative", start, (node,))
        return node

    def _member(self) -> Node:
        """Read a value with the indices and methods behind it: ``a[0].size()``."""
        start = self._next.start
        node = self._primary()
        while True:
            if self._accept("["):
                index = self._expression()
                self._need("]", "")
                node = self._node("index", start, (node, index))
            elif self._accept("."):
                node = self._method(start, node)
            else:
                return node

    def _method(self, start: int, of: Node) -> Node:
        """Read a call behind a point; a macro over a list becomes a node ``over``."""
        name = self._next
        # A point is for calls alone: the values of rules have no parts.
        if name.kind != "name" or self._tokens[self._at + 1].text != "(":
            raise ExpressionError(f"{quoted(of.text + '.' + name.text)}: a value has no parts")
        self._at += 1
        arguments = self._arguments()
        if name.text not in MACROS:
            return self._node("call", start, (of, *arguments), name.text)
        if len(arguments) not in MACROS[name.text] or arguments[0].kind != "name":
            raise ExpressionError(
                f"{quoted(name.text)} takes a name for the items, a comma and an expression"
            )
        bound = str(arguments[0].value)
        return self._node("over", start, (of, *arguments[1:]), name.text, bound)

    def _arguments(self) -> tuple[Node, ...]:
        self._need("(", "")
        return self._listed(")")

    def _listed(self, closing: str) -> tuple[Node, ...]:
        """Read expressions with commas between them, up to a closing bracket."""
        nodes: list[Node] = []
        while not self._accept(closing):
            nodes.append(self._expression())
            if not self._accept(","):
                self._need(closing, "")
                break
        return tuple(nodes)

    def _primary(self) -> Node:
        """Return the node of a value, a name, or an expression in parentheses."""
        token = self._next
        if token.kind in ("decimal", "whole", "text"):
            self._at += 1
            return Node("value", token.text, (), _literal(token))
        if token.kind == "name":
            return self._named(token)
        if self._accept("("):
            node = self._expression()
            self._need(")", "")
            return node
        if self._accept("["):
            return self._node("list", token.start, self._listed("]"))
        if self._accept("{"):
            return self._table(token.start)
        before = self._tokens[self._at - 1].text if self._at else ""
        if token.kind == "end" and not before:
            raise ExpressionError("is empty")
        raise ExpressionError(
            f"a value is missing{f' behind {quoted(before)}' if before else ''}{self._place()}"
        )

    def _named(self, token: _Token) -> Node:
        """Return the node of a word: a constant, a call or a name."""
        self._at += 1
        if token.text in ("true", "false", "null"):
            value = None if token.text == "null" else token.text == "true"
            return Node("value", token.text, (), value)
        if token.text in RESERVED:
            raise ExpressionError(f"{quoted(token.text)} is a word of the language and can be no name")
        if token.text == "not" and self._next.kind == "name":
            raise ExpressionError("'not' is no operator: write '!'")
        if self._next.text == "(":
            return self._node("call", token.start, self._arguments(), token.text)
        return Node("name", token.text, (), token.text)

    def _table(self, start: int) -> Node:
        """Read ``{key: value, ...}``."""
        parts: list[Node] = []
        while not self._accept("}"):
            parts.append(self._expression())
            self._need(":", " behind a key")
            parts.append(self._expression())
            if not self._accept(","):
                self._need("}", "")
                break
        return self._node("table", start, tuple(parts))


def _literal(token: _Token) -> float | int | str:
    """Return the value of a token; raises ExpressionError for what the engine cannot store."""
    if token.kind == "text":
        text = re.sub(r"\\(.)", lambda m: _ESCAPED.get(m[1], m[1]), token.text[1:-1])
        # Half a character of UTF-16 cannot be encoded when the finding is printed.
        if not text.isascii() and any("\ud800" <= c <= "\udfff" for c in text):
            raise ExpressionError(f"{quoted(token.text)} is no text")
        return text
    if token.kind == "decimal":
        number = float(token.text)
        if not math.isfinite(number):
            raise ExpressionError(f"{quoted(token.text)} is too large a number")
        return number
    # Twenty characters are more than 64 bits have; int() of a very long text is slow.
    number = int(token.text, 16 if token.text.startswith("0x") else 10) if len(token.text) <= 20 else math.inf
    if number > _LARGEST_WHOLE:
        raise ExpressionError(f"{quoted(token.text)} is too large a whole number; write it with a point")
    return number
