"""What was last put into a control from a file: the record of exchanges and the kept copies lead back to
it.
"""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path

from amp_studio.errors import AmpStudioError
from amp_studio.files import ParameterFile, by_schema, read_stored, real_path, secret_values, text_of_name
from amp_studio.schema import InvalidValueError, read_address

from .kept import open_copy
from .record import RecordedExchange, read_exchanges
from .verification import completed


class NoDownloadError(AmpStudioError, ValueError):
    """Nothing was downloaded from a file, or it cannot be known any more what; the text is one sentence."""


@dataclass(frozen=True)
class LastDownload:
    """The values of the last download: ``file`` has them; ``when`` is UTC, ``control`` its address."""

    file: ParameterFile
    when: str
    control: str


def last_download(file: ParameterFile, path: Path) -> LastDownload:
    """Return what a control contained after the last download of ``file``, which is at ``path``.

    A secret, and a value that no control of this kind keeps, is as in ``file``: neither is recorded. Raises
    NoDownloadError, OSError.
    """
    place = real_path(path)
    exchanges = read_exchanges(place.parent, text_of_name(place.name))
    sent = [e for e in exchanges if e.verb in ("download", "restore") and e.after]
    if not sent:
        raise NoDownloadError(f"No download of {path.name} is recorded in {place.parent}.")
    last = sent[-1]
    for each in reversed(exchanges):  # one that sent the same, or a copy of it that was kept later
        if each.kept and last.after in (each.after, each.before):
            found = _content(each, last.after, file, place.parent)
            if found is not None:
                return LastDownload(found, last.when, last.control)
    for each in reversed(sent):
        if each.after == last.after and not each.before and each.changes:  # into a control that was empty
            found = _changed(_empty(file), each, file)
            return LastDownload(completed(found, b"", file), last.when, last.control)
    raise NoDownloadError(
        f"The last download of {path.name} cannot be shown: the copy that was kept before it is not in"
        f" {place.parent}."
    )


def _content(each: RecordedExchange, wanted: str, file: ParameterFile, folder: Path) -> ParameterFile | None:
    """Return the content whose digest is ``wanted``: the copy that an exchange kept,
    or that with its changes.
    """
    path = Path(each.kept)
    path = path if path.is_file() else folder / path.name  # the folder may have been moved
    try:
        copy = open_copy(path)
    except (OSError, ValueError):
        return None
    if copy.file is None or copy.file.schema.family.family != file.schema.family.family:
        return None
    current = by_schema(copy.file, file.schema)
    digest = hashlib.sha256(copy.image).hexdigest()
    if digest != wanted:
        if each.after != wanted or digest != each.before:
            return None
        current = _changed(current, each, file)
    return completed(current, copy.image, file)


def _changed(current: ParameterFile, each: RecordedExchange, file: ParameterFile) -> ParameterFile:
    """Return a content after the changes of an exchange; secrets, which are recorded without what they were,
    as in ``file``.
    """
    found = current.copy()
    for entry, _, text in each.changes:
        address = read_address(entry)
        parameter = found.schema.parameters.get(address[0])
        if parameter is None or parameter.secret or address not in found.machine_schema.places:
            continue
        try:
            found.set(address, read_stored(found.schema, parameter, text) if text else None)
        except InvalidValueError:  # of another version of the program
            continue
    for address in secret_values(file):
        found.set(address, file.get(address))
    return found


def _empty(file: ParameterFile) -> ParameterFile:
    twin = file.copy()
    for found in (twin.values, twin.forced, twin.unknown):
        found.clear()
    return twin
