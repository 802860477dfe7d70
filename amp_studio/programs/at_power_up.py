"""What is active after power-up, what brings it back, and the codes that call a program of the builder."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, show_value

from .block import code_at_power_up
from .codes import ControlCodes


@dataclass(frozen=True)
class PowerUpLine:
    """One line of it."""

    what: str
    code: str
    meaning: str
    params: tuple[Address, ...]
    page: str


@dataclass(frozen=True)
class PowerUp:
    """The state of a control after power-up."""

    active: tuple[PowerUpLine, ...]
    """A line for each group of codes, then what else is active."""
    changes: tuple[PowerUpLine, ...]
    """What the end of a program, a reset and an E-stop change."""
    calls: tuple[PowerUpLine, ...]
    """The codes and words that call a program of the builder."""


def power_up(file: ParameterFile) -> PowerUp:
    """Return what is active after power-up under a file; empty for a family of which no page prints it."""
    codes = ControlCodes(file)
    return PowerUp(
        (*_active_codes(codes), *_active_values(codes)), tuple(_changes(codes)), tuple(_calls(codes))
    )


def _active_codes(codes: ControlCodes) -> Iterator[PowerUpLine]:
    """Yield the code of each group that is active after power-up."""
    file = codes.file
    for group in codes.groups:
        address = codes.whole((*filter(None, [group.power_up]), *group.params))
        if group.power_up and not file.evaluation.state(address[0]).is_active:
            continue
        key = code_at_power_up(codes, group.key)
        known = codes.known[key] if key else None
        # A choice that is set and names no code of the group means that none is active.
        is_set = not group.power_up or file.get(address[0]) is not None
        if known:
            yield PowerUpLine(group.name, known.code, known.facts.meaning, address, group.page)
        elif group.power_up:
            yield PowerUpLine(group.name, "", "none" if is_set else "not set", address, group.page)


def _active_values(codes: ControlCodes) -> Iterator[PowerUpLine]:
    """Yield the values that programs begin with."""
    file = codes.file
    for value in codes.facts.values:
        for each in codes.whole(value.params):
            if file.evaluation.state(each).is_active:
                text = show_value(file.schema.parameters[each[0]], file.get(each))
                yield PowerUpLine(value.name, "", text, (each,), value.page)


def _changes(codes: ControlCodes) -> Iterator[PowerUpLine]:
    """Yield a line for each event after which codes are back or stay."""
    kept = [group.name for group in codes.groups if group.kept_at_reset]
    back = f"the codes of power-up are back{', but for ' + ' and '.join(kept) if kept else ''}"
    for change in codes.facts.backs:
        address = codes.whole((change.param,) if change.param else ())
        answer = codes.file.evaluation.canonical(address[0]) if address else True
        meaning = (
            {True: back, False: "the codes stay as they are"}[answer]
            if isinstance(answer, bool)
            else "not set"
        )
        yield PowerUpLine(change.what, "", meaning, address, change.page)


def _calls(codes: ControlCodes) -> Iterator[PowerUpLine]:
    """Yield a line for each code and word that calls a program."""
    kinds = {None: "", True: "modal", False: "not modal"}
    for code, call in codes.calls.items():
        yield PowerUpLine(f"program {call.program}", code, kinds[call.modal], call.params, call.facts.page)
    words = codes.facts.word_calls
    for letter, program in words.programs.items() if words else ():
        if words and codes.file.evaluation.canonical((words.param, letter)) is True:
            yield PowerUpLine(
                f"program {program}", f"{letter}-word", "", ((words.param, letter),), words.page
            )
