"""Read and write notes about values, groups and the machine."""

from __future__ import annotations

from typing import TYPE_CHECKING

from amp_studio.cli.arguments import JSON, PATH
from amp_studio.cli.console import print_json, print_remark
from amp_studio.cli.errors import UsageError
from amp_studio.cli.opened import opened
from amp_studio.cli.output import print_remarks
from amp_studio.cli.verb import Options, Verb, VerbArgument

if TYPE_CHECKING:
    from amp_studio.files import ParameterFile
    from amp_studio.schema import Address

VERB = Verb(
    __doc__,
    PATH,
    VerbArgument(
        "about",
        nargs="?",
        metavar="PARAM|group:KEY|machine",
        help="what it is about; KEY of a group, or its name; without it all notes are listed",
    ),
    VerbArgument("text", nargs="?", help="the note; without it the present one is printed"),
    VerbArgument("--remove", action="store_true", help="remove the note"),
    JSON,
    writes=("path",),
    sections=("PARAM",),
    examples=(
        'amp-studio note MILL_1394.amp 1750 "11.5 needed with the long spindle, see order 4711"',
        "amp-studio note MILL_1394.amp 1750",
        'amp-studio note MILL_1394.amp group:home "Switches renewed"',
        "amp-studio note MILL_1394.amp --json",
    ),
)


MACHINE = "machine"

_GROUP = "group:"
"""What a note is about that is about no parameter; what the key of a group comes behind."""


def run(options: Options) -> int:
    """List notes, print one, write one or remove one."""
    from amp_studio import edit
    from amp_studio.files import NoteError

    if options.about is None:
        return _list(options)
    if options.text is None and not options.remove:
        return _show(options)
    if options.text is not None and options.remove:
        raise UsageError("a note is written or removed, not both")
    with edit(options.path) as machine:
        about = _about(machine.file, options)
        try:
            is_new = _write(machine.file, about, options.text or "")
        except NoteError as error:
            raise UsageError(f"{error}; nothing was changed") from None
        if is_new:
            machine.save(verb="note")
        else:
            print_remark("no change")
        print_remarks(machine.notes)
    return 0


def _show(options: Options) -> int:
    """Print one note."""
    file = opened(options.path).file
    text = _present(file, _about(file, options))
    if options.json:
        print_json({"about": options.about, "text": text})
    elif text:
        print(text)
    else:
        print_remark("no note")
    return 0


def _list(options: Options) -> int:
    """Print every note of the file with what it is about."""
    from amp_studio.files import all_notes

    found = list(all_notes(opened(options.path).file))
    if options.json:
        print_json(
            [{"subject": n.subject, "about": n.about, "label": n.label, "text": n.text} for n in found]
        )
        return 0
    if not found:
        print_remark("no notes")
    for one in found:
        head = one.label if one.subject != "machine" else "Machine"
        print(f"{head}{f' ({one.about})' if one.about else ''}:")
        for line in one.text.split("\n"):
            print(f"    {line}")
    return 0


def _about(file: ParameterFile, options: Options) -> Address | str:
    """Return the address, or the key of the group; an empty one for the machine."""
    from amp_studio.schema import UnknownParameterError, unknown_name

    if options.about.startswith(_GROUP):
        name = str(options.about.removeprefix(_GROUP))
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
    from amp_studio.files import group_note, machine_note, value_note

    if isinstance(about, str):
        return group_note(file, about) if about else machine_note(file)
    return value_note(file, about)


def _write(file: ParameterFile, about: Address | str, text: str) -> bool:
    from amp_studio.files import set_group_note, set_machine_note, set_value_note

    if isinstance(about, str):
        return set_group_note(file, about, text) if about else set_machine_note(file, text)
    return set_value_note(file, about, text)
