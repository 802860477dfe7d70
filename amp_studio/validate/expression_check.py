"""What an expression of a builder's rule gives and costs, worked out before it ever runs.

The language has no loops but those over lists, so the largest size of every value and the most steps it takes
follow from the text and from how many instances the parameters have. The engine itself has no bounds: an
expression that doubles a list thirty times would take all memory. The same walk finds what can never be
meant: a choice compared with a text that is not one of its keys, a number with a text,
a whole number added to a decimal one.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace

from amp_studio.schema import did_you_mean

from .expression_tree import Node, quoted
from .expression_worth import (
    ANY,
    DECIMAL,
    LARGEST,
    WHOLE,
    YES_NO,
    KnownChoices,
    ResultKind,
    Signature,
    ValueKind,
    any_of,
    list_result,
    text_result,
)

_STEP = 3
"""Cost of a step; one is the copying of a number, some 50 ns."""
_CALL = 30
"""Cost of a call out of the engine."""
_PATTERN_CHARACTER = 200
"""Cost of a character of a pattern: it is compiled at each call."""

_CALLED = {
    "decimal": "a number",
    "whole": "a whole number",
    "text": "a text",
    "yes/no": "true or false",
    "list": "a list",
    "table": "a table",
    "null": "null",
}
_NUMBERS = ("decimal", "whole")
_PIECES: Mapping[str, Callable[[str, str], bool]] = {
    "contains": str.__contains__,
    "startsWith": str.startswith,
    "endsWith": str.endswith,
}


class ExpressionCheck:
    """Walks one expression: ``slips`` are what can never be meant,
    ``cost`` is what one evaluation costs at most.
    """

    def __init__(self, names: Mapping[str, ResultKind], functions: Mapping[str, Signature]) -> None:
        self._names, self._functions = dict(names), functions
        self._bound: set[str] = set()
        self.slips: list[str] = []
        self.cost = 0

    def result_of(self, node: Node) -> ResultKind:
        """Return what a tree gives; adds to ``slips`` and ``cost``."""
        found, self.cost = self._result_and_cost(node)
        return found

    def _slip(self, what: str) -> None:
        if what not in self.slips:
            self.slips.append(what)

    def _result_and_cost(self, node: Node) -> tuple[ResultKind, int]:
        """Return what a tree gives and what one evaluation of it costs, with all its parts."""
        if node.kind == "over":
            found, cost = self._over(node)
        else:
            parts = [self._result_and_cost(part) for part in node.parts]
            results = [result_of for result_of, _ in parts]
            found, own = self._of(node, results)
            cost = own + sum(cost for _, cost in parts)
        # Bounded: the figures of nested macros multiply.
        return found, min(cost + _STEP + found.size, LARGEST)

    def _of(self, node: Node, parts: list[ResultKind]) -> tuple[ResultKind, int]:
        """Return what a part gives, and what it costs besides its step, its operands and its result."""
        match node.kind:
            case "value":
                return _literal(node), 0
            case "name":
                return self._named(node), 0
            case "list":
                return replace(list_result(len(parts), any_of(parts)), is_closed=True), 0
            case "table":
                return self._table(parts), 0
            case "index":
                return self._indexed(node, *parts), 0
            case "call":
                return self._called(node, parts)
            # Both branches count, though one runs: which one, no check can know.
            case "?:":
                self._demand_yes_no(node.parts[0], parts[0])
                return any_of(parts[1:]), 0
            case "!" | "&&" | "||":
                for part, result_of in zip(node.parts, parts, strict=True):
                    self._demand_yes_no(part, result_of)
                return YES_NO, 0
            case "==" | "!=" | "in" | "<" | "<=" | ">" | ">=":
                self._compare(node, *parts)
                # A comparison of lists walks both of them.
                return YES_NO, sum(part.size for part in parts)
            case _:
                return self._arithmetic(node, parts), 0

    # -- names, lists and functions --------------------------------------------

    def _named(self, node: Node) -> ResultKind:
        name = str(node.value)
        found = self._names.get(name)
        if found is None:
            near = did_you_mean(name, self._names)
            self._slip(f"{quoted(name)} is not read: add it under reads{near.replace('did', 'or did', 1)}")
            return ANY
        return found

    def _table(self, parts: list[ResultKind]) -> ResultKind:
        keys, values = any_of(parts[::2]), any_of(parts[1::2])
        item = replace(values, size=values.size + keys.size)
        return replace(list_result(len(parts) // 2, item), kind="table", literals=keys.literals)

    def _indexed(self, node: Node, of: ResultKind, index: ResultKind) -> ResultKind:
        """Return what an item is; adds a slip for what has no items or is counted otherwise."""
        if of.kind not in ("list", "table", "any"):
            self._slip(
                f"{quoted(node.parts[0].text)} is {_CALLED[of.kind]} and has no items: take the brackets away"
            )
        elif of.kind == "list" and index.kind in ("decimal", "text", "yes/no"):
            self._slip(
                f"{quoted(node.parts[1].text)} is {_CALLED[index.kind]}, and items are counted by whole"
                " numbers" + (f": write int({node.parts[1].text})" if index.kind == "decimal" else "")
            )
        elif of.kind == "table":
            self._compare_choice(node.parts[1], index, of.literals)
        return of.item or ANY

    def _called(self, node: Node, given: list[ResultKind]) -> tuple[ResultKind, int]:
        """Return what a call gives and costs, however wrong its arguments are: the walk goes on to the next
        slip.
        """
        name = str(node.value)
        signature = self._functions.get(name)
        cost = _CALL + 2 * sum(result_of.size for result_of in given)
        if signature is None:
            self._slip(f"{quoted(name)} is no function{did_you_mean(name, self._functions)}")
            return ANY, cost
        if not signature.fewest <= len(given) <= signature.most:
            self._slip(f"{name} takes {_how_many(signature)}, not {len(given)}")
            return signature.gives, cost
        self._demand_numbers(node, given, signature)
        if name == "matches":
            cost += self._pattern(node.parts[1], given)
            self._matched_choice(node, given[0])
        if name in _PIECES:
            self._piece(node, given)
        # The key of a choice is a text already: it stays a choice, and is compared as one.
        if name == "string" and given[0].choices:
            return given[0], cost
        return _given_back(signature.gives, given), cost

    def _demand_numbers(self, node: Node, given: list[ResultKind], signature: Signature) -> None:
        for place in sorted(signature.numbers):
            if place < len(given) and given[place].kind in ("text", "list", "table", "yes/no"):
                self._slip(
                    f"{node.value} takes a number, not {quoted(node.parts[place].text)},"
                    f" {_CALLED[given[place].kind]}"
                )

    def _piece(self, node: Node, given: list[ResultKind]) -> None:
        """See that a text that is looked for in a choice is in one of its keys."""
        of, name = given[0], str(node.value)
        # Where other texts are possible too, a piece that is in no key may still be in one of those.
        if not of.choices or not of.is_closed or of.choices.open:
            return
        for text in given[1].literals:
            if not any(_PIECES[name](key, text) for key in (*of.choices.keys, *of.literals)):
                self._slip(
                    f"no key of {quoted(node.parts[0].text)} has {quoted(text)} there: {_keys(of.choices)}"
                )

    def _matched_choice(self, node: Node, of: ResultKind) -> None:
        """Refuse a pattern on a choice: the message shows its label,
        and the pattern would be compared with its key.
        """
        if of.choices:
            what = "is a choice" if of.is_closed else "has a choice in it"
            self._slip(
                f"{quoted(node.parts[0].text)} {what}, which has a key and is shown by its label: "
                f"compare it with == or in; {_keys(of.choices)}"
            )

    def _pattern(self, node: Node, given: list[ResultKind]) -> int:
        """Return what a pattern costs; one that is worked out could be any."""
        if node.kind != "value" or not isinstance(node.value, str):
            self._slip(f"the pattern of matches must be written out, not {quoted(node.text)}")
            return 0
        if re.search(r"\(\?(?!:|i\))", node.value):
            self._slip("a pattern may begin groups with '(?:' and '(?i)' and no other '(?'")
        # {n} writes out n times what is before it, and nested ones multiply.
        states = 1 + len(node.value)
        for _, least, most in re.findall(r"(\{)\s*(\d+)\s*,?\s*(\d*)", node.value):
            states = min(states * max(1, int(least[:9]), int(most[:9] or 0)), LARGEST)
        return min(_PATTERN_CHARACTER * states, LARGEST) + given[0].length

    def _over(self, node: Node) -> tuple[ResultKind, int]:
        """Return what a macro over a list gives and costs: its body once for each item."""
        of, cost = self._result_and_cost(node.parts[0])
        macro, name = str(node.value), node.bound
        if of.kind not in ("list", "any"):
            self._slip(f"'{macro}' goes over a list, and {quoted(node.parts[0].text)} is {_CALLED[of.kind]}")
        item = of.item or ANY
        # The name of an item hides one that is read, and only inside of the macro.
        outside, self._names = self._names, {**self._names, name: item}
        bodies = [self._result_and_cost(part) for part in node.parts[1:]]
        self._names = outside
        tests = bodies[:-1] if macro == "map" else bodies
        for part, (result_of, _) in zip(node.parts[1:], tests, strict=False):
            self._demand_yes_no(part, result_of)
        given: ResultKind = YES_NO
        if macro == "map":
            given = list_result(of.length, bodies[-1][0])
        elif macro == "filter":
            given = list_result(of.length, item)
        # What map and filter have so far is copied for each item.
        each = sum(c for _, c in bodies) + 3 * _STEP + (given.size // 2 if given.kind == "list" else 0)
        return given, cost + of.size + of.length * each

    # -- operators -------------------------------------------------------------

    def _demand_yes_no(self, node: Node, result_of: ResultKind) -> None:
        if result_of.kind not in ("yes/no", "any"):
            self._slip(f"{quoted(node.text)} is {_CALLED[result_of.kind]}, where true or false is wanted")

    def _arithmetic(self, node: Node, parts: list[ResultKind]) -> ResultKind:
        """Return what an operator gives: numbers, or lists and texts that ``+`` joins."""
        every = {part.kind for part in parts}
        kinds = every - {"any", "null"}
        operator = "-" if node.kind == "negative" else node.kind
        if operator == "+" and kinds in ({"list"}, {"text"}):
            return _joined(parts) if kinds == {"list"} else _joined_texts(parts)
        if slip := _misuse(node, parts, operator, kinds):
            self._slip(slip)
        if kinds == {"whole"}:
            return WHOLE
        return DECIMAL if every <= {*_NUMBERS, "null"} else replace(_joined(parts), kind="any")

    def _compare(self, node: Node, left: ResultKind, right: ResultKind) -> None:
        """Add a slip where two operands can never be equal, or cannot be compared."""
        one, other = node.parts
        if node.kind == "in":
            if right.kind not in ("list", "table", "any"):
                self._slip(f"'in' needs a list, and {quoted(other.text)} is {_CALLED[right.kind]}")
                return
            if right.kind == "table":
                self._compare_choice(one, left, right.literals)
                return
            right = right.item or ANY
        self._compare_kinds(node, left, right)
        if node.kind in ("==", "!=", "in"):
            self._compare_choice(one, left, right.literals)
            self._compare_choice(other, right, left.literals)
            self._compare_choices(node, left, right)

    def _compare_kinds(self, node: Node, left: ResultKind, right: ResultKind) -> None:
        """Add a slip where two kinds cannot be compared, with what to write instead."""
        kinds = {left.kind, right.kind} - {"any", "null"}
        # The engine compares whole numbers with decimal ones; only its arithmetic does not mix them.
        if len(kinds) < 2 or kinds == {*_NUMBERS}:
            return
        one, other = node.parts
        how = "never equals" if node.kind in ("==", "!=", "in") else "cannot be compared with"
        there = "what is in " if node.kind == "in" else ""
        hint = ""
        if kinds >= {"yes/no", "text"}:
            choice, text = left.choices or right.choices, one if left.kind == "yes/no" else other
            hint = f": {nearest_choice(text.text, choice) if choice else 'compare it with true or false'}"
        self._slip(
            f"{quoted(one.text)} is {_CALLED[left.kind]} and {how} {there}{quoted(other.text)},"
            f" {_CALLED[right.kind]}{hint}"
        )

    def _compare_choice(self, node: Node, result_of: ResultKind, literals: tuple[str, ...]) -> None:
        """See that what a choice is compared with are keys of it."""
        for text in literals if result_of.choices and result_of.is_closed else ():
            if result_of.choices and not result_of.choices.contains(text) and text not in result_of.literals:
                self._slip(
                    f"{quoted(node.text)} is never {quoted(text)}: {nearest_choice(text, result_of.choices)}"
                )

    def _compare_choices(self, node: Node, left: ResultKind, right: ResultKind) -> None:
        """Add a slip where two choices have no key in common, so that they are never equal."""
        if (
            not (left.choices and right.choices and left.is_closed and right.is_closed)
            or left.literals + right.literals
        ):
            return
        if not any(right.choices.contains(key) for key in left.choices.keys):
            one, other = node.parts
            self._slip(f"{quoted(one.text)} and {quoted(other.text)} have no choice in common")


def nearest_choice(text: str, choices: KnownChoices) -> str:
    """Return which key was meant by a text that is none, in words."""
    same = [
        key
        for key, label in choices.keys.items()
        if _folded(label) == _folded(text) or _folded(key) == _folded(text)
    ]
    if len(same) == 1:
        return f"write the key '{same[0]}'"
    labels = {_folded(label): key for key, label in choices.keys.items()}
    near = did_you_mean(
        _folded(text), [*map(_folded, choices.keys), *labels], found=lambda n: labels.get(n, n)
    )
    if near:
        return f"write a key{near}"
    return _keys(choices)


def _keys(choices: KnownChoices) -> str:
    keys = list(choices.keys)
    return f"its keys are {', '.join(keys[:12])}{' and others' if len(keys) > 12 else ''}"


def _folded(text: str) -> str:
    return " ".join(text.casefold().split())


def _literal(node: Node) -> ResultKind:
    """Return what a written value is; a text is closed, since it can be no other."""
    match node.value:
        case None:
            return ResultKind("null")
        case bool():
            return YES_NO
        case str() as text:
            return replace(text_result(len(text)), literals=(text,), is_closed=True)
        case int():
            return WHOLE
        case _:
            return DECIMAL


def _unusable(node: Node, parts: list[ResultKind], operator: str) -> str:
    """Return which part of a sum or a product is no number, in words."""
    pairs = zip(node.parts, parts, strict=True)
    odd, kind = next((n, p.kind) for n, p in pairs if p.kind not in (*_NUMBERS, "any", "null"))
    is_beside_number = any(part.kind in _NUMBERS for part in parts)
    hint = ": write string(...) around the number" if is_beside_number and kind == "text" else ""
    return f"{quoted(odd.text)} is {_CALLED[kind]}, and '{operator}' cannot use it here{hint}"


def _how_many(signature: Signature) -> str:
    """Return how many values a function takes, in words."""
    if signature.fewest == signature.most == 1:
        return "1 value"
    count = f"{signature.fewest}" + (f" to {signature.most}" if signature.most > signature.fewest else "")
    return f"{count} values"


def _given_back(gives: ResultKind, given: list[ResultKind]) -> ResultKind:
    """Return what a function gives: a text or a list may be as long as all it is given, and its own."""
    length = gives.length + sum(result_of.length for result_of in given)
    if gives.item:
        return list_result(length, gives.item)
    return text_result(length) if gives.kind == "text" else gives


def _joined(parts: list[ResultKind]) -> ResultKind:
    """Return the list of all items of some lists."""
    return list_result(sum(p.length for p in parts), any_of([p.item for p in parts if p.item]))


def _mixed(node: Node, parts: list[ResultKind]) -> str:
    whole = next(n for n, p in zip(node.parts, parts, strict=True) if p.kind == "whole")
    better = (
        f"{whole.text}.0" if whole.kind == "value" and whole.text.isdecimal() else f"double({whole.text})"
    )
    return f"mixes a whole number with a decimal one: write {better}"


def _joined_texts(parts: list[ResultKind]) -> ResultKind:
    """Return a text made of others; a choice leaves its key in it."""
    return replace(text_result(sum(part.length for part in parts)), choices=any_of(parts).choices)


def _misuse(node: Node, parts: list[ResultKind], operator: str, kinds: set[ValueKind]) -> str:
    """Return what is wrong with arithmetic on these kinds; "" for nothing."""
    if kinds == {*_NUMBERS}:
        return f"{quoted(node.text)} {_mixed(node, parts)}"
    if operator == "%" and "decimal" in kinds:
        return f"'%' takes whole numbers only: write mod({', '.join(p.text for p in node.parts)})"
    return "" if len(kinds) < 2 and kinds <= {*_NUMBERS} else _unusable(node, parts, operator)
