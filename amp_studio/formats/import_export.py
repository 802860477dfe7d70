"""From a text file to a parameter file and back: which format it is, and what goes with it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from amp_studio.files import (
    Header,
    Notify,
    ParameterFile,
    ParameterFileError,
    erased_question,
    read_content,
    secret_values,
    set_value_note,
    without_secrets,
    write_atomic,
)
from amp_studio.schema import (
    Address,
    Schema,
    Value,
    load_part,
    load_schema,
    read_address,
    read_file,
    registered_families,
    registration_of,
    unknown_name,
)

from . import values_csv
from .account import Account, account_of_export, account_of_import
from .bare_figures import system_of
from .report_pdf import attached_machine, is_pdf
from .text_format import (
    WRITTEN_AROUND,
    FamilyNotGivenError,
    FormatError,
    ReadOptions,
    TextFormat,
    TextOffer,
    TextRead,
    plain_content,
    text_to_recognise,
)

_GENERAL: tuple[TextFormat, ...] = (values_csv.FORMAT,)
"""Formats of every family."""
_MAX_BYTES = 4 * 2**20
"""Some ten times what the largest family would fill in its longest format."""
_MAX_PDF = 64 * 2**20
"""Some ten times the longest report."""


def all_formats() -> tuple[TextFormat, ...]:
    """Return every format, in the order in which they are tried when the family of a text is not named."""
    return (*_GENERAL, *(own for family in registered_families() for own in _own_formats(family)))


def formats_of(family: str) -> tuple[TextFormat, ...]:
    """Return the formats a family can be written in, its own first."""
    return (*_own_formats(family), *_GENERAL)


def _own_formats(family: str) -> tuple[TextFormat, ...]:
    return tuple(load_part(place) for place in registration_of(family).formats)


def import_file(
    path: Path | str,
    family: str | None = None,
    *,
    format_key: str | None = None,
    keep_unknown: bool = False,
    machine: str = "",
    listing: int = 0,
    notify: Callable[[str], None] = lambda _message: None,
    take_account: Callable[[Account], object] = lambda _account: None,
) -> ParameterFile:
    """Return the parameters of a text file, in a file that contains nothing else;
    values out of range are in it too.

    ``take_account`` is called with what became of the text. ``machine`` is the machine type where the text
    shall not decide, ``listing`` which of several listings in one text, counted from 1 (0 is the last one).
    ``notify`` is called with what a person should know of a text that was taken: words it leaves out.
    Without a family, the format or the text has to name it. Raises FormatError with line and column,
    UnknownFamilyError, OSError.
    """
    path = Path(path)
    if family:
        load_schema(family)  # of an unknown one nothing is a format
    content = read_file(path, _MAX_PDF if path.suffix.casefold() == ".pdf" else _MAX_BYTES)
    if is_pdf(content):
        return _machine_of_report(path, content, family, notify, take_account)
    content = plain_content(content)
    chosen = _format_for_reading(content, family, format_key)
    text = _decoded(content, chosen)
    schema = load_schema(family or _only_family(chosen, text))
    _refuse_unknown_machine(schema, machine)
    read = chosen.read(text, schema, ReadOptions(keep_unknown, machine, listing, _beside(path)))
    read.machine = read.machine or machine
    for message in read.notes:
        notify(message)
    file = file_of(schema, read, path.stem)
    if question := erased_question(file):
        notify(question)
    take_account(account_of_import(file, read))
    return file


def _refuse_unknown_machine(schema: Schema, machine: str) -> None:
    if machine and machine not in schema.machines:
        raise FormatError(unknown_name("machine type", machine, (m.key for m in schema.family.machines)))


def _machine_of_report(
    path: Path,
    content: bytes,
    family: str | None,
    notify: Callable[[str], None],
    take_account: Callable[[Account], object],
) -> ParameterFile:
    """Return the machine that is attached to a report; secrets are not in it. Raises FormatError."""
    attached = attached_machine(content)
    if attached is None:
        raise FormatError("is a PDF that has no machine with it: a report of this program has one")
    try:
        file = read_content(path, attached)
    except ParameterFileError as error:
        raise FormatError(f"the machine in it {error.what}") from None
    if family and family != file.schema.family.family:
        raise FormatError(f"the machine in it is one of {file.schema.family.name}")
    if secrets := sorted({each.name for each in file.schema.parameters.values() if each.secret}):
        notify(f"A report is without secret values: {', '.join(secrets)}")
    take_account(Account(written=len(file.values)))
    return file


def offer_of(path: Path) -> TextOffer | None:
    """Return what may be decided about a text before it is imported; None if there is nothing.
    Raises OSError.
    """
    if path.suffix.casefold() == ".pdf":
        return None
    content = plain_content(read_file(path, _MAX_BYTES))
    try:
        chosen = _format_for_reading(content, None, None)
        if chosen.offer is None:
            return None
        text = _decoded(content, chosen)
        return chosen.offer(text, load_schema(_only_family(chosen, text)))
    except FormatError:
        return None  # the import names it


def text_lines(path: Path, file: ParameterFile) -> dict[Address, int]:
    """Return the line of each value of the control's own text that was read as ``file``;
    nothing of what is none, or cannot be read.
    """
    family = file.schema.family.family
    options = ReadOptions(machine=file.machine, beside=_beside(path))
    try:
        content = plain_content(read_file(path, _MAX_BYTES))
        chosen = _format_for_reading(content, family, None)
        return chosen.read(_decoded(content, chosen), file.schema, options).value_lines
    except (FormatError, OSError):
        return {}


def _beside(path: Path) -> Callable[[str], str | None]:
    """Return what reads a file in the folder of a text; one outside of it, or too large, is not there."""
    folder = path.resolve().parent

    def text_of(name: str) -> str | None:
        try:
            # Resolved, so that neither ".." nor a link leads out of the folder.
            place = (folder / name).resolve()
            # Latin-1 keeps every byte: which encoding the file has is a matter of its format.
            return read_file(place, _MAX_BYTES).decode("latin-1") if place.is_relative_to(folder) else None
        except (OSError, ValueError):
            return None

    return text_of


def _decoded(content: bytes, chosen: TextFormat) -> str:
    """Return the text of a content without the marks that its format does not have; raises FormatError."""
    for mark in WRITTEN_AROUND:
        if mark not in chosen.around:
            content = content.removeprefix(mark).removesuffix(mark)
    try:
        return content.decode(chosen.encoding)
    except UnicodeDecodeError as error:
        if chosen.otherwise:
            return content.decode(chosen.otherwise, "replace")
        line = content[: error.start].count(b"\n") + 1
        raise FormatError(f"there is a byte that is no {chosen.encoding} text", line) from None


def file_of(schema: Schema, read: TextRead, name: str) -> ParameterFile:
    """Return the parameter file of a text; the rest is not set."""
    applications = schema.family.applications
    header = Header(
        name=read.name or name,
        application=applications[0] if applications else "",
        machine="" if schema.family.machine_parameter else read.machine or schema.family.default_machine,
        signature=schema.signature,
    )
    file = ParameterFile(schema, header)
    machine_parameter = schema.family.machine_parameter
    # First, as it decides which of the values exist.
    if machine_parameter and read.machine and (machine_parameter, "") not in read.values:
        file.set((machine_parameter, ""), Value(read.machine))
    file.take(read.values)
    file.unknown.update(read.unknown)
    file.header.extra.update(read.extra)
    for key, text in read.value_notes.items():
        set_value_note(file, read_address(key), text)
    # A bare number that a user types is in the unit of the text.
    file.header.units = system_of(file)
    return file


@dataclass(frozen=True)
class Export:
    """A file as a text of a format: what is written, and what becomes of each value."""

    format: TextFormat
    content: bytes
    account: Account


def export_of(
    file: ParameterFile, path: Path | str, format_key: str | None = None, *, secrets: bool = False
) -> Export:
    """Return what ``export_file`` writes; nothing is written yet.
    Its account is made by reading the text back.

    Raises FormatError for a format that is not offered, a value it cannot write,
    and a text that cannot be read back.
    """
    path = Path(path)
    chosen = _format_for_writing(file.schema.family.family, path, format_key)
    left_out = frozenset[Address]() if secrets else frozenset(secret_values(file))
    text = chosen.write(file if secrets else without_secrets(file))
    try:
        newline = chosen.newline_of(file) if chosen.newline_of else chosen.newline
        content = text.replace("\n", newline).encode(chosen.encoding)
    except UnicodeEncodeError as error:
        character, line = error.object[error.start], error.object.count("\n", 0, error.start) + 1
        raise FormatError(
            f"'{character}' is no character of {chosen.encoding}, in which this format is written", line
        ) from None
    try:
        included = chosen.included(file) if chosen.included else {}
        # Unknown entries are kept, so that the account has them: all that is written must come back.
        options = ReadOptions(True, file.machine, beside=included.get)
        read = chosen.read(content.decode(chosen.encoding), file.schema, options)
    except FormatError as error:
        raise FormatError(
            f"what would be written cannot be read back ({error}); nothing was written"
        ) from None
    back = file_of(file.schema, read, path.stem)
    return Export(chosen, content, account_of_export(file, back, chosen.title, left_out))


def export_file(
    file: ParameterFile,
    path: Path | str,
    format_key: str | None = None,
    notify: Notify = lambda _message: None,
    *,
    secrets: bool = False,
) -> Export:
    """Write a file in a format, named or found by the ending; an existing file is replaced only as a whole.

    Secret values are left out unless ``secrets`` asks for them; ``notify`` is called with what of the old
    file could not be kept. Raises as ``export_of`` does, and SaveError.
    """
    export = export_of(file, path, format_key, secrets=secrets)
    write_atomic(Path(path), export.content, notify=notify)
    return export


def _format_for_reading(content: bytes, family: str | None, format_key: str | None) -> TextFormat:
    """Return the format that is named, or by which the content is recognised; raises FormatError."""
    offered = formats_of(family) if family else all_formats()
    if format_key is not None:
        return _named(format_key, offered)
    text = text_to_recognise(content)
    # Our own table has a heading that nothing else has; listings are read out of any text around them.
    found = next((f for f in (*_GENERAL, *offered) if f.recognises(text)), None)
    if found is None:
        known = f"Known: {', '.join(f.key for f in offered)}"
        # A text of another family is the usual mistake: its name helps more than a list of formats.
        other = next((f for f in all_formats() if f.recognises(text)), None) if family else None
        if other is None:
            raise FormatError(f"Unrecognised file format. {known}")
        whose = " or ".join(families_of(other)) or "another family"
        raise FormatError(f"Not a text of {family}, but of {whose} (format {other.key}). {known}")
    return found


def _format_for_writing(family: str, path: Path, format_key: str | None) -> TextFormat:
    """Return the format that is named, or that has the ending of the path; raises FormatError."""
    offered = formats_of(family)
    if format_key is not None:
        return _named(format_key, offered)
    found = next((f for f in offered if path.suffix.lower() in f.endings), None)
    if found is None:
        raise FormatError(
            f"'{path.name}': unknown file extension. Known:"
            f" {', '.join(f'{f.ending} ({f.key})' for f in offered)}"
        )
    return found


def _named(key: str, offered: tuple[TextFormat, ...]) -> TextFormat:
    for found in offered:
        if found.key == key:
            return found
    raise FormatError(unknown_name("format", key, (f.key for f in offered)))


def families_of(chosen: TextFormat) -> tuple[str, ...]:
    """Return the families that have a format for themselves; none for a format of every family."""
    return tuple(family for family in registered_families() if chosen in _own_formats(family))


def _only_family(chosen: TextFormat, text: str) -> str:
    families = families_of(chosen)
    if not families and chosen.is_of is not None:
        families = tuple(name for name in registered_families() if chosen.is_of(text, load_schema(name)))
    if len(families) != 1:
        raise FamilyNotGivenError(f"a {chosen.title} does not show which family it is for")
    return families[0]
