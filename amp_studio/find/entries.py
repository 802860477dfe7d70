"""What there is to find of a family on a machine type: parameters, choices, messages and groups,
with the words of each.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from amp_studio.schema import ControlMessage, Parameter, Schema

from .words import parts_of, words_of

HitKind = Literal["parameter", "value", "choice", "message", "group", "note", "command"]
Where = Literal["number", "name", "choice", "value", "code", "text", "group", "id", "help", "meaning", "note"]
WEIGHT: dict[Where, float] = {
    "number": 10.0,
    "code": 10.0,
    "name": 8.0,
    "text": 8.0,
    "choice": 6.0,
    "note": 6.0,
    "value": 6.0,
    "group": 4.0,
    "id": 4.0,
    "meaning": 2.0,
    "help": 1.5,
}
"""What a word is worth by where it is found."""
KINDS: dict[HitKind, float] = {
    "parameter": 1.0,
    "message": 1.0,
    "value": 0.95,
    "note": 0.95,
    "command": 0.9,
    "choice": 0.8,
    "group": 0.7,
}
"""What a kind is worth among others whose words match as well: the parameter before its choice,
that before its group."""


_ESTOP = "E-Stop estop emergency stop"
"""What people call the reaction of a control to such a message."""


@dataclass(frozen=True, slots=True)
class Entry:
    """One thing that can be found."""

    kind: HitKind
    title: str
    """What is read first: the name, the text of the message, the label of the choice."""
    key: str
    """Id of the parameter or the message, key of the group or the command."""
    texts: tuple[tuple[Where, str], ...]
    """Every text that is searched."""
    detail: str = ""
    """What is read second: group, page, parameter of a choice."""


def entries_of(schema: Schema, machine: str) -> Iterator[Entry]:
    """Yield all entries of a family on a machine type, in the manual's order."""
    here = schema.on(machine)
    for parameter in schema.parameters.values():
        if here.instances(parameter):
            yield _parameter(schema, machine, parameter)
            yield from _choices(parameter)
    for listed in schema.message_lists:
        for message in listed.messages:
            yield _message(message, listed.title)
    groups: dict[str, list[str]] = {}
    for group in schema.groups:
        if any(here.instances(parameter) for parameter in group.parameters):
            groups.setdefault(group.name, []).append(group.key)
            title = group.whole_name
            yield Entry("group", title, group.key, (("name", title),), f"Chapter {group.chapter}")


def _parameter(schema: Schema, machine: str, parameter: Parameter) -> Entry:
    """Return a parameter with all texts by which it is found."""
    group = schema.group_of[parameter.id]
    units = " ".join(schema.units_of(parameter))
    helped = parameter.help
    noted = " ".join(n.says for n in (*helped.danger, *helped.warning, *helped.note))
    texts: list[tuple[Where, str]] = [
        ("number", " ".join(schema.on(machine).numbers(parameter).values())),
        ("name", parameter.name),
        ("id", parameter.id.replace(".", " ").replace("_", " ")),
        ("group", f"{group.name} {group.section}"),
        ("choice", " ".join(choice.label for choice in parameter.choices or ())),
        ("choice", " ".join(bit.label for bit in parameter.bits or () if not bit.unknown)),
        ("help", f"{helped.what} {helped.find} {helped.wrong} {noted} {units}"),
    ]
    page = f"page {parameter.page}"
    return Entry(
        "parameter",
        parameter.name,
        parameter.id,
        tuple(t for t in texts if t[1].strip()),
        f"{group.name}, {page}",
    )


def _choices(parameter: Parameter) -> Iterator[Entry]:
    """Yield each choice and each named bit that a person may look for by its words; yes and no are none."""
    labels = [] if parameter.type == "boolean" else [choice.label for choice in parameter.choices or ()]
    labels += [bit.label for bit in parameter.bits or () if not bit.unknown]
    for label in labels:
        texts: tuple[tuple[Where, str], ...] = (("choice", label), ("id", parameter.name))
        yield Entry("choice", label, parameter.id, texts, parameter.name)


def _message(message: ControlMessage, listed: str) -> Entry:
    """Return the entry of a message or symptom, with the texts that a search compares, by where each is."""
    if message.reaction == "symptom":  # its causes have the words of many parameters
        called = " ".join((message.name, *message.called, _ESTOP if "E-Stop" in message.name else ""))
        return Entry("message", message.name, message.id, (("text", called),), f"page {message.page}")
    texts: list[tuple[Where, str]] = [
        ("code", " ".join(_codes(message))),
        ("text", message.text or message.title),
        ("text", " ".join(message.also)),
        ("group", f"{listed} {_ESTOP if message.reaction == 'e-stop' else ''}"),
        ("meaning", " ".join((message.means, *message.causes, *message.cures))),
    ]
    return Entry(
        "message", message.name, message.id, tuple(t for t in texts if t[1].strip()), f"page {message.page}"
    )


def _codes(message: ControlMessage) -> Iterator[str]:
    """Yield the code, other ones that the control shows, and those of a whole span."""
    yield message.code
    yield from (other for other in message.also if any(c.isdigit() for c in other))
    if message.span is not None:
        yield from map(str, range(message.span[0], message.span[1] + 1))


def searched_words(where: Where, text: str) -> set[str]:
    """Return the words by which a text is found: a code and a number with letters also in parts,
    without leading zeros.
    """
    words = set(words_of(text))
    if where in ("number", "code"):
        for word in tuple(words):
            parts = parts_of(word)
            # The letters of a parameter number are those of thousands; those of a code name the module.
            words.update(parts if where == "code" else ())
            # Displays and manuals differ in leading zeros: MOT-022 is looked for as 22.
            words.update(part.lstrip("0") or "0" for part in parts[-1:] if part.isdigit())
    return words
