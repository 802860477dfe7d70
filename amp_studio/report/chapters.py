"""What chapters of a report have beside values and findings: dangers, exchanges, checks, part programs."""

from __future__ import annotations

from dataclasses import dataclass

from amp_studio.schema import unit_text

from .language import Language
from .wording import NO_BREAK

ASSUMED = "assumed: "
"""Before the reason of an assumption in the record of tunings."""


@dataclass(frozen=True, slots=True)
class Danger:
    """What the manual calls dangerous about some of the printed values."""

    says: str
    page: str
    about: tuple[tuple[str, str], ...]
    """(anchor, label) of each parameter."""
    brief: str = ""
    """The same in three to five words."""

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
class TunedGain:
    """One gain of a tuning."""

    number: str
    """As it is typed."""
    name: str
    before: str
    """With its unit; empty where it was not set."""
    after: str
    is_in_file: bool
    """Whether the file that is printed has what was proposed."""


@dataclass(frozen=True, slots=True)
class TunedFigure:
    """A figure of the loop before and after; None for an unstable one."""

    name: str
    """Its key, as ``phase_margin``."""
    before: float | None
    after: float | None
    unit: str


@dataclass(frozen=True, slots=True)
class TuningLine:
    """One tuning of one axis, as the record has it."""

    when: str
    who: str
    axis: str
    aim: str
    gains: tuple[TunedGain, ...]
    figures: tuple[TunedFigure, ...]
    plant: tuple[tuple[str, str, str], ...]
    """Figure of the machine, value, and how it is known."""
    note: str

    def rows(self, words: Language) -> tuple[tuple[str, str, str, str], ...]:
        """Return what was changed, what the loop had, and what the machine was taken for, as rows that are
        printed: what, before, after, remark.
        """

        def figure(value: float | None, unit: str) -> str:
            if value is None:
                return words.text("unstable")
            return words.quantity(f"{value:.4g} {unit_text(unit)}".rstrip())

        def known(name: str, value: str, how: str) -> str:
            if not how.startswith(ASSUMED):
                return words.sentence(how)
            # The whole sentence of the simulator has words in another language, its reason alone has none.
            whole = words.sentence(f"ASSUMED: {name} = {value}. {how.removeprefix(ASSUMED)}")
            return words.text("assumed") + ": " + whole.partition(". ")[2]

        kept = words.text("in the file"), words.text("another in the file")
        return (
            *(
                (
                    f"{each.number} {words.sentence(each.name)}".strip(),
                    words.quantity(each.before),
                    words.quantity(each.after),
                    kept[not each.is_in_file],
                )
                for each in self.gains
            ),
            *(
                (
                    words.sentence(n.name.replace("_", " ")),
                    figure(n.before, n.unit),
                    figure(n.after, n.unit),
                    "",
                )
                for n in self.figures
            ),
            *((name, "", words.quantity(value), known(name, value, how)) for name, value, how in self.plant),
        )

    def head(self, words: Language) -> str:
        """Return axis, time, person and aim in one line."""
        aim = words.sentence(self.aim)
        return f"{words.text('Axis')} {self.axis}, {self.when}, {self.who}, {words.text('Aim')}: {aim}"


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
class CheckDrawing:
    """A picture of a check."""

    title: str
    svg: str
    notes: tuple[str, ...] = ()


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
    drawings: tuple[CheckDrawing, ...] = ()
    """The pictures of the page Machine that it has, in English."""

    def printed(self, words: Language) -> tuple[str, str, str]:
        """Return scenario, figures, and what is not good with the alarms, as they are printed."""
        figures = (
            # A number is not parted from its unit at the end of a line.
            f"{words.figure(each.name, each.unit)} {words.sentence(each.text).replace(' ', NO_BREAK)}"
            for each in self.figures
        )
        alarms = (f"{code}: {words.sentence(message)}" for code, message in self.alarms)
        why = words.sentence(self.text) if self.text else ""
        return words.scenario(self.scenario), ", ".join(figures), "; ".join(filter(None, (why, *alarms)))


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
    """Of the parameters that decide it; the ids of those without a number."""
    page: str
    parameters: str
    """The same for a reader: numbers, and the names of those without one."""


@dataclass(frozen=True)
class PrintedTest:
    """One program or procedure that tries a machine out."""

    id: str
    """As a tick names it: ``homing@0``."""
    title: str
    page: str
    lines: tuple[str, ...] = ()
    steps: tuple[tuple[str, str], ...] = ()
    """What to do, and what must be seen."""
    notes: tuple[str, ...] = ()
    refusal: str = ""
    """Why the file does not allow it."""
    ticked: str = ""
    """When and by whom it was ticked as done."""
