"""Notes of people: about one value, about a group of parameters, about the machine.
They are part of the file.

In the file they are the entries ``value_notes`` (by address), ``group_notes`` (by the key of the group) and
``notes``. A note about a value of another machine type, or of a group that is no more, stays as it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Literal, NamedTuple

from amp_studio.errors import AmpStudioError
from amp_studio.schema import Address, read_address, written

from .parameter_file import ParameterFile

_LONGEST_NOTE = 4_000
"""Characters of a note."""
# What YAML cannot contain: control characters, halves of surrogate pairs.
_UNWRITABLE = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ud800-\udfff\ufffe\uffff]")

NoteSubject = Literal["machine", "group", "value"]


class MachineNote(NamedTuple):
    """One note: what it is about, in a stable form and for a person, and its text."""

    subject: NoteSubject
    about: str
    """Empty for the machine, the key of a group, an address as files write it."""
    label: str
    """``1750 Excess Error, Axis 1``, the name of the group, or the name of the machine."""
    text: str


class NoteError(AmpStudioError, ValueError):
    """A note that no file can contain, or about something that the family does not have;
    the text is one sentence.
    """


def machine_note(file: ParameterFile) -> str:
    """Return the note about the machine; empty where there is none."""
    return file.header.notes


def value_note(file: ParameterFile, address: Address) -> str:
    """Return the note about a value; empty where there is none."""
    return file.header.value_notes.get(written(address), "")


def group_note(file: ParameterFile, key: str) -> str:
    """Return the note about a group of parameters; empty where there is none."""
    return file.header.group_notes.get(key, "")


def set_machine_note(file: ParameterFile, text: str) -> bool:
    """Note something about the machine, nothing with an empty text; returns whether it was new.
    Raises NoteError.
    """
    text, old = _checked(text), file.header.notes
    file.header.notes = text
    return text != old


def set_value_note(file: ParameterFile, address: Address, text: str) -> bool:
    """Note something about a value, nothing with an empty text; returns whether it was new. Raises
    NoteError.
    """
    found = _with(file.header.value_notes, written(address), text)
    is_new = dict(found) != dict(file.header.value_notes)
    file.header.value_notes = found
    return is_new


def set_group_note(file: ParameterFile, key: str, text: str) -> bool:
    """Note something about a group, nothing with an empty text; returns whether it was new. Raises
    NoteError.
    """
    if key not in {group.key for group in file.schema.groups}:
        raise NoteError(f"there is no group '{key}'")
    found = _with(file.header.group_notes, key, text)
    is_new = dict(found) != dict(file.header.group_notes)
    file.header.group_notes = found
    return is_new


def all_notes(file: ParameterFile) -> Iterator[MachineNote]:
    """Yield every note: about the machine, the groups and the values, each in the manual's order."""
    if file.header.notes:
        yield MachineNote("machine", "", file.header.name, file.header.notes)
    groups = {group.key: group for group in file.schema.groups}
    for key in sorted(
        file.header.group_notes, key=lambda k: list(groups).index(k) if k in groups else len(groups)
    ):
        name = groups[key].own_name if key in groups else key
        yield MachineNote("group", key, name, file.header.group_notes[key])
    places = file.machine_schema.places
    addresses = {key: read_address(key) for key in file.header.value_notes}
    for key in sorted(addresses, key=lambda k: places.get(addresses[k], len(places))):
        yield MachineNote("value", key, _label(file, addresses[key]), file.header.value_notes[key])


def _label(file: ParameterFile, address: Address) -> str:
    if address not in file.machine_schema.places:
        return written(address)
    place = file.machine_schema.instance_label(address)
    label = file.machine_schema.label(address)
    return f"{label}, {place}" if place else label


def _with(notes: Mapping[str, str], key: str, text: str) -> dict[str, str]:
    """Return notes with one of them changed: a new mapping, as steps to undo keep the old one."""
    found = dict(notes)
    found.pop(key, None)
    if text := _checked(text):
        found[key] = text
    return found


def note_fault(text: str) -> str:
    """Return why a text can be no note; empty where it can."""
    if len(text) > _LONGEST_NOTE:
        return f"the note has {len(text)} characters, and {_LONGEST_NOTE} are the most"
    if odd := _UNWRITABLE.search(text):
        return f"the note contains the character U+{ord(odd[0]):04X}, which no file can contain"
    return ""


def _checked(text: str) -> str:
    # YAML reads every end of a line as \n: another one would come back as a change.
    text = text.replace("\r\n", "\n").replace("\r", "\n").strip()
    if problem := note_fault(text):
        raise NoteError(problem)
    return text
