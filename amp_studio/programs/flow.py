"""Which line of a program is next: branches, subroutines, and calls with values for their variables."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice

from .codes import ControlCodes
from .expression import evaluate
from .words import ProgramBlockError as BlockError
from .words import TypedWord, sentence, words_of

_MAX_CALLS = 10_000
"""Repeats of one call."""
MACROS = ("subroutine", "modal-subroutine", "no-subroutine")
"""What the codes do whose words are variables: call once, call after each move, end that."""

_LABEL = re.compile(r"\s*N\s*([0-9]+)")
_SETS = re.compile(r"(?:N[0-9]+\s*)?[P#]\s*([0-9]+)\s*=(.*)")
_BRANCH = re.compile(r"(?:N[0-9]+\s*)?(?:IF\b(.*)\bTHEN\s*)?(GOTO|GOSUB)\s+([0-9]+)\s*")
_RETURN = re.compile(r"(?:N[0-9]+\s*)?RET\s*")
TAKES_IN = re.compile(r"\s*\$I\b.*", re.IGNORECASE)
"""A line that takes in those of a file."""


@dataclass(frozen=True)
class SubroutineCall:
    """A subroutine with values for its variables."""

    label: int
    repeats: int
    values: Mapping[int, float]
    """Number of the program parameter -> its value."""


@dataclass
class _Level:
    """One call that has not returned."""

    back: int
    """Line that follows it, from 0."""
    call: SubroutineCall | None = None
    left: int = 0
    """Repeats that are left."""
    is_modal: bool = False


class ProgramFlow:
    """The way of a control through the lines."""

    def __init__(
        self,
        lines: Sequence[str],
        count: int,
        parameters: dict[int, float],
        codes: ControlCodes,
        notes: list[str],
    ) -> None:
        """``count`` lines are those of the program, ``parameters`` those that it sets, ``notes`` gets what is
        assumed; its methods raise ProgramBlockError.
        """
        self._lines, self._count = lines, count
        self._parameters, self._codes, self._notes = parameters, codes, notes
        self._facts = codes.facts
        path = codes.facts.path
        self._depth = path.depth if path else 0
        self._guarded = path.offset_variables if path else ()
        self._labels: dict[int, int] | None = None
        self._levels: list[_Level] = []
        self._modal: SubroutineCall | None = None
        self._macros = {
            code: str(known.facts.does) for code, known in codes.known.items() if known.facts.does in MACROS
        }
        self._macro = re.compile(
            rf"\s*(?:N\s*[0-9]+\s*)?G\s*0*(?:{'|'.join(code[1:] for code in self._macros)})(?![0-9.])"
        )
        self.at = 0
        """Line that is next, from 0."""

    @property
    def calls_after_moves(self) -> bool:
        """Whether a subroutine is called after each move; its own moves call nothing."""
        return self._modal is not None and not any(level.is_modal for level in self._levels)

    def take(self, line: str) -> bool:
        """Do a branch, an assignment or a call; return whether the line is one. ``at`` is behind it."""
        if not self._facts.statements:
            return False
        # A plain search first: nearly all lines are moves, and the patterns are slow.
        if ("=" in line or "GO" in line or "RET" in line or "$" in line) and self._take_statement(line):
            return True
        if self._macros and self._macro.match(line):
            self._call_macro(line)
            return True
        return False

    def _take_statement(self, line: str) -> bool:
        """Do a branch or an assignment that this control has; return whether the line is one."""
        if not any(re.match(each.pattern, line) for each in self._facts.statements):
            return False
        if _RETURN.fullmatch(line):
            self._return()
        elif (match := _BRANCH.fullmatch(line)) is not None:
            self._notes += [
                sentence(each.assumed)
                for each in self._facts.statements
                if each.assumed and re.match(each.pattern, line)
            ]
            if match[1] is None or evaluate(match[1], self._parameters) != 0.0:
                self._branch(match[2], int(match[3]))
        elif (match := _SETS.fullmatch(line)) is not None:
            self._set(int(match[1]), evaluate(match[2], self._parameters))
        else:
            return TAKES_IN.fullmatch(line) is not None
        return True

    def call_after_move(self) -> None:
        """Call the subroutine that is called after each move."""
        assert self._modal is not None
        self._enter(_Level(self.at, self._modal, self._modal.repeats, is_modal=True))

    # -- branches ------------------------------------------------------------------

    def _branch(self, what: str, label: int) -> None:
        if what == "GOSUB":
            self._push(_Level(self.at))
        self.at = self._place(label)

    def _push(self, level: _Level) -> None:
        if len(self._levels) >= self._depth:
            raise BlockError(f"Subroutines are more than {self._depth} levels deep")
        self._levels.append(level)

    def _return(self) -> None:
        """Go on behind the call, or at its begin where it is repeated."""
        if not self._levels:
            raise BlockError("RET comes without a GOSUB before it", "return-without-call")
        level = self._levels.pop()
        if level.call is not None:
            if level.left > 0:
                self._enter(level)
                return
            # Whether the variables keep what the call gave them is not printed: they have no value then.
            for number in level.call.values:
                self._parameters.pop(number, None)
        self.at = level.back

    def _place(self, label: int) -> int:
        if self._labels is None:
            self._labels = _labels(islice(self._lines, self._count))
        if label not in self._labels:
            raise BlockError(f"No block has the number N{label}")
        return self._labels[label]

    def _set(self, number: int, value: float) -> None:
        for first, last in self._guarded:
            if first <= number <= last:
                raise BlockError(
                    f"P{number} is an offset or a position of the control ({first} to {last}):"
                    " what a program does by setting it is not simulated"
                )
        self._parameters[number] = value

    # -- calls with values ---------------------------------------------------------

    def _call_macro(self, line: str) -> None:
        """Begin the program that a code calls, once or at each move until it is cancelled."""
        head, *words = (word for word in words_of(line, self._facts.expressions) if word.letter != "N")
        does = self._macros[head.code]
        if does == "no-subroutine":
            if words:
                raise BlockError(f"{words[0].text} beside {head.text}: no page prints what it does")
            self._modal = None
            return
        if assumed := self._codes.known[head.code].facts.assumed:
            self._notes.append(sentence(assumed))
        call = self._call_of(head.text, words)
        # Refused now, where the call is, and not at the first move that would call it.
        self._place(call.label)
        if does == "modal-subroutine":
            self._modal = call
        else:
            self._enter(_Level(self.at, call, call.repeats))

    def _call_of(self, head: str, words: Sequence[TypedWord]) -> SubroutineCall:
        """Return what the words of a block call; raises ProgramBlockError."""
        numbers: dict[str, float] = {}
        for word in words:
            if word.letter in numbers:
                raise BlockError(f"{word.letter} is given twice in a block", "repeated")
            if not word.number:
                raise BlockError(f"{word.letter}: a letter without a number", "no-number")
            numbers[word.letter] = evaluate(word.number, self._parameters)
        label, repeats = numbers.pop("P", None), numbers.pop("L", 1.0)
        if label is None or label != int(label):
            raise BlockError(f"{head} needs P, the number of the subroutine", "no-number")
        if repeats != int(repeats) or not 1 <= repeats <= _MAX_CALLS:
            raise BlockError(f"L{repeats:g}: a subroutine is called 1 to {_MAX_CALLS} times")
        if other := sorted(set(numbers) - set(self._facts.variables)):
            raise BlockError(f"{other[0]} is no variable of a subroutine", "unknown-word")
        values = {self._facts.variables[letter]: number for letter, number in numbers.items()}
        return SubroutineCall(int(label), int(repeats), values)

    def _enter(self, level: _Level) -> None:
        assert level.call is not None
        level.left -= 1
        self._push(level)
        # At each repeat: the subroutine may have changed its variables.
        self._parameters.update(level.call.values)
        self.at = self._place(level.call.label)


def _labels(lines: Iterable[str]) -> dict[int, int]:
    """Return number of a block -> its line from 0, the first of each number."""
    labels: dict[int, int] = {}
    for n, line in enumerate(lines):
        # Longer ones are no block numbers, and Python refuses to convert a very long one.
        if (label := _LABEL.match(line.upper())) is not None and len(label[1]) < 12:
            labels.setdefault(int(label[1]), n)
    return labels
