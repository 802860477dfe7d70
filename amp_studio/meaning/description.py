"""A machine described without a word of its control: figures by concept,
each with the parameters that it comes from.

Lengths are mm or degrees, speeds per minute, accelerations per second squared, as everywhere in rules. What a
control does not have is no figure; what a reader does not know is none either, and never a default.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from amp_studio.schema import Address

ConceptValue = float | str | bool | list[float | None] | None
"""A number, the key of a closed choice, a number for each gear, or None: the control has such a thing,
and here it is none."""

CHOICES: dict[str, tuple[str, ...]] = {
    "kind": ("linear", "rotary"),
    "travel.kind": ("limits", "none", "modulo"),
    "ramp.kind": ("trapezoid", "s-curve", "sine-squared", "exponential"),
    "home.kind": (
        "switch-nearest-marker",
        "switch-next-marker",
        "switch",
        "marker",
        "coded",
        "absolute",
        "none",
    ),
}
"""Concept -> what it can be; a reader that gives anything else is wrong."""

OF_AXIS = (
    "kind",
    "travel.kind",
    "travel.low",
    "travel.high",
    "rollover",
    "rapid",
    "ramp.kind",
    "acceleration",
    "jerk",
    "error.limit",
    "gain",
    "feed_forward",
    "backlash",
    "scale",
    "output.sign",
    "home.kind",
    "home.coordinate",
    "home.offset",
    "home.search",
    "home.leave",
    "home.towards",
    "home.first",
    "home.second",
    "work.offsets",
    "feed.ceiling",
    "jog",
)
OF_MACHINE = ("spindle.greatest", "spindle.least", "startup", "tool.radius", "tool.wear")


@dataclass(frozen=True)
class ParameterSource:
    """A parameter that a figure comes from: its address, its number as a person writes it,
    its value and its page.
    """

    address: Address
    param: str
    raw: str
    page: str


@dataclass(frozen=True)
class ConceptFigure:
    """What is known of one concept, with the formula in the names of its parameters and the page."""

    concept: str
    value: ConceptValue
    sources: tuple[ParameterSource, ...]
    formula: str
    page: str


@dataclass(frozen=True)
class AxisMeaning:
    """One axis: its letter, the instance in its file, whether it turns, and its figures by concept;
    ``shares`` where another axis of the machine has this letter too.
    """

    letter: str
    instance: str
    turns: bool
    figures: Mapping[str, ConceptFigure]
    shares: bool = False

    @property
    def name(self) -> str:
        """What questions call it: its letter, with its number where another axis has that letter."""
        return f"{self.letter}{self.instance}" if self.shares else self.letter

    def number(self, concept: str) -> float | None:
        """Return a number, None where there is none."""
        found = self.figures.get(concept)
        return found.value if found and isinstance(found.value, float) else None

    def choice(self, concept: str) -> str:
        """Return a choice, "" where it is not known."""
        found = self.figures.get(concept)
        return found.value if found and isinstance(found.value, str) else ""


@dataclass(frozen=True)
class MigrationQuestion:
    """What only a person can answer; ``sources`` are the parameters that wait for it. ``is_number`` is one
    above 0 that figures are made with, in place of a sign.
    """

    id: str
    question: str
    sources: tuple[ParameterSource, ...] = ()
    is_number: bool = False


@dataclass(frozen=True)
class MachineMeaning:
    """A machine: its axes in their order, and the figures of the whole."""

    family: str
    name: str
    axes: tuple[AxisMeaning, ...]
    figures: Mapping[str, ConceptFigure] = field(default_factory=dict)
    questions: tuple[MigrationQuestion, ...] = ()

    def number(self, concept: str) -> float | None:
        """Return a number of the whole machine, None where there is none."""
        found = self.figures.get(concept)
        return found.value if found and isinstance(found.value, float) else None
