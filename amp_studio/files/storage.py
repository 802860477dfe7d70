"""Parameter files as they are written: the previous text is amended, read back,
and compared before it replaces anything.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from itertools import chain
from pathlib import Path
from typing import Any

from amp_studio.schema import (
    InvalidValueError,
    YamlError,
    read_address,
    read_yaml,
    short,
    text_scalar,
    write_value,
    written,
)

from .atomic import Notify, SaveError, write_atomic
from .parameter_file import Header, ParameterFile
from .reading import (
    DESCRIPTION,
    FORMAT,
    HEADER_KEYS,
    NOTE_SECTIONS,
    SECTIONS,
    ParameterFileError,
    extra_entries,
    read_content,
    seal_of,
    value_in_file,
)


def content_of(file: ParameterFile, previous: bytes | None = None) -> bytes:
    """Return a file's content; with the ``previous`` content what did not change stays
    as it is written there.
    """
    wanted = _sections(file)
    text = None if previous is None else _amended(file, previous, wanted)
    if text is None:
        from .yaml_text import new_text  # what only opens files does not write any

        wanted |= {"amp_studio": FORMAT}  # a number: everything else that is one is a text
        text = new_text({key: value for key, value in wanted.items() if value or key not in SECTIONS}, "...")
    return text.encode("utf-8")


def _sections(file: ParameterFile) -> dict[str, Any]:
    """Return what a file contains, as the keys of its YAML in their order."""
    found: dict[str, Any] = {"amp_studio": str(FORMAT), "family": file.schema.family.family}
    found |= {key: getattr(file.header, key) for key in HEADER_KEYS if getattr(file.header, key)}
    found |= file.header.extra
    found |= {"done": dict(file.header.done), "values": _entries(file)}
    found |= {"forced": {written(a): why for a, why in file.forced.items()}}
    found |= {name: dict(getattr(file.header, name)) for name in NOTE_SECTIONS}
    if description := file.schema.description:
        found[DESCRIPTION] = [seal_of(description), *description.decode("utf-8").split("\n")[:-1]]
    return found


def _amended(file: ParameterFile, previous: bytes, wanted: dict[str, Any]) -> str | None:
    """Return the text of the previous content, amended; None where it cannot be."""
    try:
        text = previous.decode("utf-8")
        document = read_yaml(text, text_scalar, spans=True)
    except (UnicodeDecodeError, YamlError):
        return None
    # A text with an open quote or nothing in it has no place where an entry could be put.
    if not isinstance(document.data, dict) or not document.is_closed or not document.data:
        return None
    known = document.data | extra_entries(text, document.data)
    wanted = wanted | {"values": _as_spelled(file, wanted["values"], known.get("values"))}
    wanted |= {"forced": _forced_as_spelled(wanted["forced"], known.get("forced") or ())}
    if "units" not in known and wanted.get("units") == Header.units:
        del wanted["units"]  # what goes without saying is not added to what a person wrote
    for key in SECTIONS + HEADER_KEYS:
        if not wanted.get(key):
            wanted.pop(key, None)
            if not known.get(key, True):
                wanted[key] = known[key]  # an empty entry stays as it is written
    from .yaml_text import amended

    found = amended(document, known, wanted, SECTIONS)
    return found if found is None or not text.startswith("\ufeff") else "\ufeff" + found


def _forced_as_spelled(forced: Mapping[str, str], present: Iterable[str]) -> dict[str, str]:
    """Return the forced values; a person may have written an address otherwise than the program does, and
    his spelling stays.
    """
    spelled = {written(read_address(key)): key for key in present}
    return {spelled.get(name, name): why for name, why in forced.items()}


def _as_spelled(file: ParameterFile, entries: dict[str, str], known: object) -> dict[str, str]:
    """Return entries with those that mean the same already as a person spelled them: 0.50 in,
    control.type@.
    """
    found: dict[str, tuple[str, str]] = {}
    for key, text in known.items() if isinstance(known, dict) else ():
        address = read_address(key)
        value = file.values.get(address)
        try:
            if value is not None and value_in_file(file, address, text) == value:
                found[written(address)] = key, text
        except InvalidValueError:
            continue
    return dict(found.get(name, (name, text)) for name, text in entries.items())


def _entries(file: ParameterFile) -> dict[str, str]:
    order = file.machine_schema.places
    known = sorted(file.values, key=lambda a: order.get(a, len(order)))
    entries = {written(a): write_value(file.schema.parameters[a[0]], file.values[a]) for a in known}
    return entries | {key: text for key, text in file.unknown.items() if key not in entries}


def save_file(
    file: ParameterFile, path: Path | str, expected: str | None = None, notify: Notify = lambda _message: None
) -> str:
    """Save a file, all or nothing; the previous file becomes the backup.

    ``expected`` is the digest the file had when it was opened, None for a new
    one; ``notify`` is called with what could not be kept. The content is read back before it replaces
    anything. Returns the new digest; raises ChangedOnDiskError or SaveError.
    """
    path = Path(path)
    file.header.signature = file.schema.signature
    return write_atomic(
        path, lambda previous: readable_content(file, path, previous), expected, notify=notify
    )


def readable_content(file: ParameterFile, path: Path, previous: bytes | None = None) -> bytes:
    """Return a file's content that has been read back and means what the file does; raises SaveError."""
    try:
        content = content_of(file, previous)
        found = _fault_of(file, path, content)
        # A tab that a person left behind a value is the usual cause: without it the text is tried once
        # more.
        if found and previous is not None:
            from .yaml_text import without_stray_tabs

            content = without_stray_tabs(content)
            found = _fault_of(file, path, content)
    except UnicodeEncodeError as error:
        found = f"the character U+{ord(error.object[error.start]):04X} is in no file"
    if found:
        raise SaveError(f"{path} was not written: {found}")
    return content


def _fault_of(file: ParameterFile, path: Path, content: bytes) -> str:
    """Return why a content does not mean what the file does; empty where it does."""
    try:
        return _difference(file, read_content(path, content, file.schema))
    except ParameterFileError as error:
        return f"it would be unreadable: {f'line {error.line}: ' if error.line else ''}{error.what}"


def _difference(file: ParameterFile, again: ParameterFile) -> str:
    """Return in what a file differs from what was read back; empty where it does not."""
    if found := _lost_value(file, again) or _other_entry(file, again):
        return found
    if file.forced != again.forced:
        return "the marks of force would be read back as others"
    plain = replace(file.header, extra={}) == replace(again.header, extra={})
    # By their text: to Python 1, 1.0 and True are equal, and in a file they are not.
    if not plain or repr(file.header.extra) != repr(again.header.extra):
        return "the head of the file would be read back otherwise"
    return ""


def _lost_value(file: ParameterFile, again: ParameterFile) -> str:
    """Return which value would be another one or lost; one of the other machine type may be an entry."""
    for address, value in file.values.items():
        name = written(address)
        if address in again.values:
            if again.values[address] != value:
                return f"{name} would be read back as another value"
        elif again.unknown.get(name) != write_value(file.schema.parameters[address[0]], value):
            return f"{name} would be lost"
    return ""


def _other_entry(file: ParameterFile, again: ParameterFile) -> str:
    """Return which entry would be lost, added or another one.

    An entry of the other machine type becomes a value when the machine type changes, or a value an entry.
    """
    lost = (k for k in file.unknown if k not in again.unknown and read_address(k) not in again.values)
    added = (written(a) for a in again.values if a not in file.values and written(a) not in file.unknown)
    if odd := next(chain(lost, added), ""):
        return f"{short(odd)} would be another entry"
    if any(again.unknown.get(key, text) != text for key, text in file.unknown.items()):
        return "an entry that the schema does not know would be read back as another"
    return ""
