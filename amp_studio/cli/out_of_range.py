"""What happens with values out of range in an upload or an import: the option ``--on-fault``,
or a question for each.
"""

from __future__ import annotations

import sys

from amp_studio.files import ParameterFile, RangeDecision, settle
from amp_studio.schema import Address

from .console import ask, print_remark
from .errors import UsageError


class _AtTheTerminal:
    """A person at a terminal, or the decision that ``--on-fault`` has made."""

    def __init__(self, on_fault: str, by: str) -> None:
        # A script or a pipe cannot answer.
        self._on_fault = "quit" if on_fault == "ask" and not sys.stdin.isatty() else on_fault
        self._by = by

    def decide(self, problem: str) -> RangeDecision:
        if self._on_fault == "keep":
            return "keep"
        if self._on_fault == "quit":
            raise UsageError(
                f"{self._by} contains an illegal value, nothing was written: {problem} (--on-fault keep"
                " takes it)"
            )
        while True:
            answer = ask(f"{problem}\n[C]ontinue checking, [E]dit parameter, [Q]uit? ").strip().casefold()
            for letter, decision in _LETTERS.items():
                if answer.startswith(letter):
                    return decision

    def new_value(self, file: ParameterFile, address: Address, problem: str) -> str:  # noqa: ARG002  # it is on the screen
        return ask("new value: ")

    def refused(self, problem: str) -> None:
        print_remark(problem)


_LETTERS: dict[str, RangeDecision] = {"c": "keep", "e": "edit", "q": "quit"}


def settle_values(file: ParameterFile, on_fault: str, by: str) -> None:
    """Decide about each value out of range; raises UsageError where nothing is to be written."""
    if not settle(file, by, _AtTheTerminal(on_fault, by)):
        raise UsageError("cancelled, nothing was written")
