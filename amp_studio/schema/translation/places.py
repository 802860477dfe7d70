"""Every text of a family that decides, under the place that it has in its facts and in a translation."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import chain
from string import Formatter
from typing import Any

from amp_studio.schema.load import Compiled, FurtherFacts
from amp_studio.schema.model import (
    Commissioning,
    FactTranslation,
    HelpNote,
    Messages,
    Model,
    MotionFacts,
    Parameter,
)

TextPlace = tuple[str | int, ...]
"""``("rules", "9pc.axis.two-spindles", "title")``: the keys of a file of a language."""
_FIGURE = re.compile(r"\{([a-z_]+)\}")
_WITHOUT_PLACE: tuple[TextPlace, ...] = (("phrases",), ("formulas",))
_GRADES = ("danger", "warning", "note")


def english_texts(compiled: Compiled, further: FurtherFacts) -> dict[TextPlace, str]:
    """Return place -> English text; wrapped lines are one."""
    return {place: " ".join(text.split()) for place, text in _english(compiled, further) if text}


def own_texts(translation: FactTranslation) -> dict[TextPlace, str]:
    """Return place -> text of a file of a language."""
    return {place: " ".join(text.split()) for place, text in _leaves((), translation) if text}


def figures_in(phrase: str) -> set[str]:
    """Return the names of the figures of a phrase; ``{UPDATE BACKUP}`` is a key of a control."""
    return set(_FIGURE.findall(phrase))


def names_in(message: str) -> set[str]:
    """Return the names in braces of a message."""
    return {name for _, name, _, _ in Formatter().parse(message) if name is not None}


def _of_help(parameter: Parameter) -> Iterator[tuple[TextPlace, str]]:
    for grade in _GRADES:
        notes: tuple[HelpNote, ...] = getattr(parameter.help, grade)
        yield from ((("help", parameter.id, grade, n), note.says) for n, note in enumerate(notes))


def _english(compiled: Compiled, further: FurtherFacts) -> Iterator[tuple[TextPlace, str]]:
    """Yield each text of a family that is translated, with its place; empty ones too."""
    for rule in compiled.rules:
        for part in ("title", "message", "reason"):
            yield ("rules", rule.id, part), getattr(rule, part)
    for parameter in chain.from_iterable(group.parameters for group in compiled.groups):
        yield from _of_help(parameter)
    for name, condition in compiled.family.conditions.items():
        yield ("conditions", name), condition.why
    if further.commissioning:
        yield from _of_order(further.commissioning)
    for guide in further.guides:
        yield ("guides", guide.id, "title"), guide.title
        for n, each in enumerate(guide.steps):
            yield ("guides", guide.id, "steps", n, "title"), each.title
            yield ("guides", guide.id, "steps", n, "what"), each.what
            yield ("guides", guide.id, "steps", n, "look"), each.look
    yield from _of_motion(further.motion)
    for listed in further.messages:
        yield from _of_messages(listed)


def _of_motion(motion: MotionFacts) -> Iterator[tuple[TextPlace, str]]:
    if motion.scenarios:
        yield ("motion", "without_axes"), motion.without_axes
    yield from ((("motion", "assumed", name), figure.why) for name, figure in motion.assumed.items())
    yield from ((("motion", "settings", name), what) for name, what in motion.settings.items())


def _of_messages(listed: Messages) -> Iterator[tuple[TextPlace, str]]:
    yield from ((("message_lists", listed.id, part), getattr(listed, part)) for part in ("title", "note"))
    for message in listed.messages:
        for part in ("title", "means", "note"):
            yield ("messages", message.id, part), getattr(message, part)
        for part in ("causes", "cures"):
            texts: tuple[str, ...] = getattr(message, part)
            yield from ((("messages", message.id, part, n), text) for n, text in enumerate(texts))


def _of_order(order: Commissioning) -> Iterator[tuple[TextPlace, str]]:
    yield ("order", "why"), order.why
    for part in ("title", "what"):
        yield ("order", "rest", part), getattr(order.rest, part)
        yield from ((("steps", step.id, part), getattr(step, part)) for step in order.steps)


def _leaves(place: TextPlace, value: Any) -> Iterator[tuple[TextPlace, str]]:
    """Yield each text below a place of a record."""
    if isinstance(value, str):
        yield place, value
        return
    below = value.items() if isinstance(value, (Model, dict)) else enumerate(value or ())
    for key, entry in below:
        # These are found by their English words, which have no place in the facts.
        if (*place, key) not in _WITHOUT_PLACE:
            yield from _leaves((*place, key), entry)
