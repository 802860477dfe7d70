"""The verb about notes of people: about a value, a group of parameters, the machine."""

from __future__ import annotations

import argparse

from amp_studio.files import Document, ParameterFile
from amp_studio.files.notes import (
    NoteError,
    all_notes,
    group_note,
    machine_note,
    set_group_note,
    set_machine_note,
    set_value_note,
    value_note,
)
from amp_studio.schema import Address, UnknownParameterError
from amp_studio.schema.nearest import unknown_name

from .console import note, print_json
from .errors import UsageError
from .opened import opened
from .output import note_all

MACHINE, GROUP = "machine", "group:"
"""What a note is about that is about no parameter; what the key of a group comes behind."""


def note_verb(options: argparse.Namespace) -> int:
    """List notes, print one, write one or remove one."""
    if options.about is None:
        return _list(options)
    if options.text is None and not options.remove:
        file = opened(options.path)
        text = _present(file, _about(file, options))
        if options.json:
            print_json({"about": options.about, "text": text})
        elif text:
            print(text)
        else:
            note("no note")
        return 0
    if options.text is not None and options.remove:
        raise UsageError("a note is written or removed, not both")
    with Document.open(options.path) as document:
        about = _about(document.file, options)
        try:
            is_new = _write(document.file, about, options.text or "")
        except NoteError as error:
            raise UsageError(f"{error}; nothing was changed") from None
        if is_new:
            document.save("note")
        else:
            note("no change")
        note_all(document.notes)
    return 0


def _list(options: argparse.Namespace) -> int:
    found = list(all_notes(opened(options.path)))
    if options.json:
        print_json(
            [{"subject": n.subject, "about": n.about, "label": n.label, "text": n.text} for n in found]
        )
        return 0
    if not found:
        note("no notes")
    for one in found:
        head = one.label if one.subject != "machine" else "Machine"
        print(f"{head}{f' ({one.about})' if one.about else ''}:")
        for line in one.text.split("\n"):
            print(f"    {line}")
    return 0


def _about(file: ParameterFile, options: argparse.Namespace) -> Address | str:
    """Return the address, or the key of the group; an empty one for the machine."""
    if options.about.startswith(GROUP):
        name = str(options.about.removeprefix(GROUP))
        keys = {group.name: group.key for group in file.schema.groups}
        if name not in (*keys, *keys.values()):
            raise UsageError(unknown_name("group", name, [*keys.values(), *keys]))
        return keys.get(name, name)
    if options.about == MACHINE:
        return ""
    try:
        return file.find(options.about)
    except UnknownParameterError as error:
        raise UsageError(str(error)) from None


def _present(file: ParameterFile, about: Address | str) -> str:
    if isinstance(about, str):
        return group_note(file, about) if about else machine_note(file)
    return value_note(file, about)


def _write(file: ParameterFile, about: Address | str, text: str) -> bool:
    if isinstance(about, str):
        return set_group_note(file, about, text) if about else set_machine_note(file, text)
    return set_value_note(file, about, text)
