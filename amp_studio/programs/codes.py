"""The codes of a control under a parameter file: its system, what each code means there,
and the macro calls of the builder.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property

from amp_studio.files import ParameterFile
from amp_studio.schema import ACTIVE, Address, CodeGroup, MacroCall, ProgramCode

from .words import ProgramBlockError, TypedWord, words_of


@dataclass(frozen=True)
class KnownCode:
    """A code of this control."""

    code: str
    """As it is programmed: G01."""
    group: CodeGroup | None
    facts: ProgramCode


@dataclass(frozen=True)
class Call:
    """A code that calls a program of the builder."""

    code: str
    program: str
    modal: bool | None
    params: tuple[Address, ...]
    facts: MacroCall


class ControlCodes:
    """What codes the control of a file has."""

    def __init__(self, file: ParameterFile) -> None:
        self.file = file
        self.facts = file.schema.program

    @cached_property
    def system(self) -> str:
        """The machine type, or the system that a parameter chooses; "" while that is not set."""
        system = self.facts.system
        if system is None or self.file.machine not in system.machines:
            return self.file.machine
        return str(self.file.evaluation.canonical((system.param, "")) or "")

    @cached_property
    def groups(self) -> tuple[CodeGroup, ...]:
        """The groups that this control has."""
        return tuple(g for g in self.facts.groups if not g.systems or self.system in g.systems)

    @cached_property
    def known(self) -> dict[str, KnownCode]:
        """Code without zeros -> what it is."""
        found: dict[str, KnownCode] = {}
        # Those of groups last: a code of a group counts more than the same one without.
        for group in (None, *self.groups):
            for facts in group.codes if group else self.facts.codes:
                for code in self._written(facts):
                    found[TypedWord(code[0], code[1:], code).code] = KnownCode(code, group, facts)
        return found

    def _written(self, facts: ProgramCode) -> Iterator[str]:
        code = facts.code if isinstance(facts.code, str) else facts.code.get(self.system, "")
        first, _, last = code.partition("..")
        if last:
            yield from (f"{first[0]}{n}" for n in range(int(first[1:]), int(last[1:]) + 1))
        elif first:
            yield first

    @cached_property
    def started(self) -> dict[str, str]:
        """Key of a group -> code without zeros that is active at the start though no parameter chooses it:
        that of the block that is run then, or of the control itself.
        """
        path = self.facts.path
        if path is None:
            return {}
        block = self.file.evaluation.canonical((path.startup, "")) if path.startup else None
        typed = [TypedWord(code[0], code[1:], code) for code in path.first]
        with suppress(ProgramBlockError):  # a program ends at this block with its reason
            typed += words_of(block) if isinstance(block, str) else ()
        found = {}
        for word in typed:
            known = self.known.get(word.code)
            if known is not None and known.group is not None:
                found[known.group.key] = word.code
        return found

    @cached_property
    def calls(self) -> dict[str, Call]:
        """Code without zeros -> the program that it calls."""
        return {call.code: call for facts in self.facts.calls for call in self._calls(facts)}

    def _calls(self, facts: MacroCall) -> Iterator[Call]:
        """Yield the codes to which the file gives a program."""
        for instance, number in self._numbers_of_codes(facts.code, facts.none):
            kind = self._value(facts.call, instance)
            if facts.call and kind in (None, facts.not_used):
                continue
            named = filter(None, (facts.code, facts.call, facts.program))
            program = self._value(facts.program, instance) if facts.program else instance
            program_text = f"{program:g}" if isinstance(program, float | int) else str(program or "?")
            is_modal = kind == "modal" if facts.call else None
            code = TypedWord(facts.letter, f"{number:g}", "").code
            yield Call(code, program_text, is_modal, tuple((param, instance) for param in named), facts)

    def _numbers_of_codes(self, parameter: str, none: float | None) -> Iterator[tuple[str, float]]:
        """Yield instance and number of each active parameter that makes a code call a program."""
        evaluation = self.file.evaluation
        for instance in self.file.machine_schema.instances(self.file.schema.parameters[parameter]):
            number = evaluation.canonical((parameter, instance))
            if not isinstance(number, float | int) or number == none:
                continue
            if evaluation.state((parameter, instance)) is ACTIVE:
                yield instance, number

    def _value(self, parameter: str | None, instance: str) -> object:
        return self.file.evaluation.canonical((parameter, instance)) if parameter else None

    def whole(self, parameters: tuple[str, ...], axis: str = "") -> tuple[Address, ...]:
        """Return addresses of parameters: the one of an axis where they have axes, else the first."""
        found = []
        for named in parameters:
            instances = self.file.machine_schema.instances(self.file.schema.parameters[named])
            if instances:
                found.append((named, axis if axis in instances else instances[0]))
        return tuple(found)
