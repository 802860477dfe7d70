"""What a writer gives: the parameters of the new control, and a grade for each concept."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal
from typing import Literal

from amp_studio.errors import AmpStudioError
from amp_studio.schema import quoted

from .description import AxisMeaning, MigrationQuestion

GradeKind = Literal["exact", "approximate", "not_possible"]
_STEP = Decimal("0.000001")
NUMBER = r"[0-9]+\.?[0-9]*|\.[0-9]+"


class TargetError(AmpStudioError, ValueError):
    """A target that nothing can be migrated to, or an answer that is none; one clear sentence."""


@dataclass(frozen=True)
class Graded:
    """One concept of one axis ("" for the machine): what it became, and how well.

    ``key``, ``value``   of the new control, as they are written
    ``old``, ``new``     how either control behaves, and ``safe_side`` which of them is safe, of what is
                         approximate
    ``loses``, ``do``    what the machine loses, and what to do, of what is not possible
    """

    axis: str
    concept: str
    outcome: GradeKind
    key: str = ""
    value: str = ""
    old: str = ""
    new: str = ""
    safe_side: str = ""
    loses: str = ""
    do: str = ""


@dataclass
class WrittenMachine:
    """What a writer gives.

    ``texts``      name of a file -> its text; the first one is the configuration
    ``graded``     a grade for every concept that it knows
    ``open``       questions that have no answer, with those that have one in ``answered``
    ``less_safe``  sentences
    ``measure``    what is to be measured at the machine
    """

    texts: dict[str, str] = field(default_factory=dict)
    graded: list[Graded] = field(default_factory=list)
    open: list[MigrationQuestion] = field(default_factory=list)
    answered: dict[str, str] = field(default_factory=dict)
    asked: list[MigrationQuestion] = field(default_factory=list)
    less_safe: list[str] = field(default_factory=list)
    measure: list[str] = field(default_factory=list)

    def grade(
        self, axis: AxisMeaning, concept: str, outcome: GradeKind, *written: str, **reasons: str
    ) -> None:
        """Grade one concept of an axis; key, value and reasons as in ``Graded``."""
        self.graded.append(Graded(axis.letter, concept, outcome, *written, **reasons))

    def answer(self, question: MigrationQuestion, answers: Mapping[str, str], form: str = ".*") -> str:
        """Return the answer to a question, "" where it is open;
        raises TargetError for one that is not of the ``form``.
        """
        self.asked.append(question)
        found = answers.get(question.id, "").strip()
        if not found:
            self.open.append(question)
        elif not re.fullmatch(form, found, re.IGNORECASE):
            raise TargetError(f"{question.id}: {quoted(found)} is no answer. {question.question}")
        else:
            self.answered[question.id] = found
        return found

    def number(self, question: MigrationQuestion, answers: Mapping[str, str]) -> float | None:
        """Return the number above 0 that a question is answered with, None where it is open;
        raises TargetError.
        """
        found = self.answer(question, answers, NUMBER)
        if found and not float(found) > 0.0:
            raise TargetError(f"{question.id}: {quoted(found)} is not above 0. {question.question}")
        return float(found) if found else None

    def letter(
        self, axis: AxisMeaning, axes: Iterable[AxisMeaning], alike: Sequence[str], answers: Mapping[str, str]
    ) -> str:
        """Return the letter of an axis, one of those ``alike`` that move as it does and no other has;
        asked for where its own cannot stay, "" while that is open. Raises TargetError.
        """
        taken = [a.letter for a in axes if a is not axis]
        free = [x for x in alike if x not in taken]
        # Programs name axes by their letters: a letter that can stay, stays.
        if axis.letter in free:
            return axis.letter
        what = "turns" if axis.turns else "does not turn"
        question = MigrationQuestion(
            f"letter.{axis.name}",
            f"Axis {axis.name} {what}: which letter shall it have ({', '.join(free)})?",
            axis.figures["kind"].sources if "kind" in axis.figures else (),
        )
        return self.answer(question, answers, f"[{''.join(free)}]").upper()

    def home_steps(self, letters: Sequence[str], answers: Mapping[str, str]) -> list[str]:
        """Return the letters of each step of homing, none where the question is open; raises TargetError."""
        names = ", ".join(letters)
        question = MigrationQuestion(
            "home.order", f"In which order do the axes home ({names})? Write the steps, as: Z, X Y"
        )
        found = self.answer(question, answers, "[A-Z, ]*").upper()
        steps = [step.replace(" ", "") for step in found.split(",") if step.strip()]
        # Each axis once: one that is left out would never be homed.
        if found and sorted("".join(steps)) != sorted(letters):
            raise TargetError(f"home.order: {quoted(found)} does not have each of {names} once")
        return steps


def inwards_high(value: float) -> str:
    """Return a greatest position, never beyond the old one: rounded down to a millionth."""
    # By the shortest text: the binary value may lie below it, and would lose a whole step.
    return _text(Decimal(repr(value)).quantize(_STEP, ROUND_FLOOR))


def inwards_low(value: float) -> str:
    """Return a least position, never beyond the old one: rounded up to a millionth."""
    return _text(Decimal(repr(value)).quantize(_STEP, ROUND_CEILING))


def not_above(value: float) -> str:
    """Return a speed, a ramp or an error limit, never above the old one: rounded towards zero to a
    millionth.
    """
    rounding = ROUND_FLOOR if value >= 0 else ROUND_CEILING
    return _text(Decimal(repr(value)).quantize(_STEP, rounding))


def _text(number: Decimal) -> str:
    text = format(number, "f").rstrip("0").rstrip(".")
    return "0" if text in ("", "-0") else text
