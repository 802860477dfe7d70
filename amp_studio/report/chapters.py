"""What chapters of a report have beside values and findings: dangers, exchanges, checks, part programs."""

from __future__ import annotations

from dataclasses import dataclass

from .language import Language
from .wording import NO_BREAK


@dataclass(frozen=True, slots=True)
class Danger:
    """What the manual calls dangerous about some of the printed values."""

    says: str
    page: str
    about: tuple[tuple[str, str], ...]
    """(anchor, label) of each parameter."""

    @property
    def line(self) -> str:
        """All of it in one line."""
        return f"{', '.join(label for _, label in self.about)}: {self.says} (page {self.page})"


@dataclass(frozen=True, slots=True)
class ExchangeLine:
    """One exchange with a control, as the record has it."""

    when: str
    who: str
    verb: str
    control: str
    before: str
    """Digest of what the control contained, shortened; empty where it is not known."""
    after: str
    text: str
    """How it ended."""


@dataclass(frozen=True, slots=True)
class CheckedFigure:
    """One figure of a scenario."""

    name: str
    """In words."""
    value: float
    unit: str
    """As it is printed."""
    text: str
    """The value with its unit, rounded."""


@dataclass(frozen=True, slots=True)
class CheckedMotion:
    """One scenario of the check in motion."""

    verdict: str
    scenario: str
    axis: str
    figures: tuple[CheckedFigure, ...]
    text: str
    """What is not good."""
    alarms: tuple[tuple[str, str], ...] = ()
    """Code and message of each other alarm of the control."""

    def printed(self, words: Language) -> tuple[str, str, str]:
        """Return scenario, figures, and what is not good with the alarms, as they are printed."""
        figures = (
            # A number is not parted from its unit at the end of a line.
            f"{words.sentence(each.name)} {words.sentence(each.text).replace(' ', NO_BREAK)}"
            for each in self.figures
        )
        alarms = (f"{code}: {words.sentence(message)}" for code, message in self.alarms)
        why = words.sentence(self.text) if self.text else ""
        return words.scenario(self.scenario), ", ".join(figures), " ".join(filter(None, (why, *alarms)))


@dataclass(frozen=True, slots=True)
class ProgramLimit:
    """What limits the feed of a part program, and how long."""

    letter: str
    """In its picture."""
    name: str
    param: str
    """As it is typed; "" for none."""
    time_s: float
    share: float

    @property
    def texts(self) -> tuple[str, str]:
        """Time in s and share in %, as they are printed."""
        return f"{self.time_s:.3f}", f"{100.0 * self.share:.1f}"


@dataclass(frozen=True, slots=True)
class PrintedProgram:
    """A part program under the file."""

    name: str
    blocks: int
    time_s: float
    limits: tuple[ProgramLimit, ...]
    """The longest first."""
    contour: str
    """Its contour error, or why there is none, in words."""
    alarms: tuple[str, ...]
    svg: str
    assumptions: tuple[str, ...]

    @property
    def notes(self) -> tuple[str, ...]:
        """What is below its picture, sentences."""
        whole = f"{self.blocks} blocks, {self.time_s:.4g} s"
        return whole, self.contour, *self.alarms, *self.assumptions


@dataclass(frozen=True, slots=True)
class ProgramState:
    """A line of what is active in part programs after power-up, and what changes it."""

    what: str
    code: str
    meaning: str
    numbers: str
    """Of the parameters that decide it."""
    page: str
