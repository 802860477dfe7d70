"""What lies beside a parameter file and counts when it is checked: rules,
and what the file was and others are.
"""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path

from amp_studio.files import (
    RECORD,
    ParameterFile,
    ParameterFileError,
    backup_path,
    is_there,
    local_time,
    origin_of,
    real_path,
    text_of_name,
)
from amp_studio.schema import Address, Value, read_file

from .builder_rules import NO_RULES, BuilderRules
from .companions import LARGEST_FLEET, RULES_FILE, fleet_of
from .plausible import Earlier, values_of_fleet
from .validator import Validator


def rules_beside(path: Path, file: ParameterFile) -> BuilderRules:
    """Return the rules that lie beside a parameter file at ``path``; none where there is no such file."""
    beside = real_path(path).parent / RULES_FILE
    if not is_there(beside):
        return NO_RULES
    from .rule_file import read_builder_rules  # most machines have none

    return read_builder_rules(beside, file.schema, axes_by_letter(file))


def axes_by_letter(file: ParameterFile) -> dict[str, str]:
    """Return letter -> axis of a file, for letters that one axis alone has."""
    from amp_studio.files import axis_letters

    letters = list(axis_letters(file).items())
    every = [letter for _, letter in letters]
    # Two axes of one letter are both left out: a rule that reads ``@X`` could mean either.
    return {letter: axis for axis, letter in letters if letter != axis and every.count(letter) == 1}


def validator_of(file: ParameterFile, path: Path | None, own: BuilderRules | None = None) -> Validator:
    """Return the validator of a file at ``path`` with all that lies beside it and counts: the one way to its
    findings, so that they are the same wherever they are shown. ``own`` are a builder's rules where they are
    not those beside it.
    """
    if own is None:
        own = rules_beside(path, file) if path else NO_RULES
    return Validator(file, own, earlier_beside(path, file) if path else ())


def earlier_beside(path: Path, file: ParameterFile) -> tuple[Earlier, ...]:
    """Return what a file is compared with: its backup, its last download, what it was made from,
    other machines in its folder.

    What cannot be read, or is of another family, is left out: none of it is needed to check the file.
    """
    with contextlib.suppress(OSError):
        return tuple(_earlier(real_path(path), file))
    return ()


def _earlier(path: Path, file: ParameterFile) -> Iterator[Earlier]:
    """Yield the contents that a file is compared with; of a value that differs from several the first is
    named.
    """
    backup = backup_path(path)
    if is_there(backup) and (values := _values(backup, file)) is not None:
        yield Earlier("in the backup", values)
    when = _last_download(path)
    if when and (values := _values_at(path, file, when)):
        yield Earlier(f"in the download of {local_time(when)}", values)
    origin = origin_of(file, path)
    if origin is not None and (values := _values(origin, file)) is not None:
        yield Earlier(f"in {origin.name}, which it was made from", values, is_same_machine=False)
    others = [values for other in fleet_of(path) if (values := _values(other, file)) is not None]
    if fleet := values_of_fleet(others):
        yield Earlier(f"of {len(others)} other machines in its folder", fleet, is_same_machine=False)


def _values(path: Path, file: ParameterFile) -> dict[Address, Value] | None:
    """Return the values of another file of the same family and machine type; None where it is none."""
    try:
        about = path.stat()
        other = _opened(path, about.st_mtime_ns, about.st_size)
    except (ParameterFileError, OSError):
        return None
    same = other.schema.family.family == file.schema.family.family and other.machine == file.machine
    return other.values if same else None


# Each file of a folder is compared with all others, which would be read as often as there are files. The
# two more are a backup and the file that one was made from.
@lru_cache(maxsize=LARGEST_FLEET + 2)
def _opened(path: Path, changed: int, size: int) -> ParameterFile:  # noqa: ARG001  # another one after a change
    from amp_studio.files import open_file  # most files are alone

    return open_file(path).file


def _last_download(path: Path) -> str:
    """Return when a control took the content of a file last (UTC); "" for never."""
    try:
        content = read_file(path.with_name(RECORD), follow=False, tail=True)
    except OSError:
        return ""
    for line in reversed(content.decode("utf-8", "replace").split("\n")):
        # A line that a crash cut off, or that someone edited, is no reason to overlook the older ones.
        with contextlib.suppress(ValueError, RecursionError):
            entry = json.loads(line)
            if not isinstance(entry, dict) or entry.get("file") != text_of_name(path.name):
                continue
            if entry.get("verb") == "download" and entry.get("state") == "new":
                return str(entry.get("when", ""))
    return ""


def _values_at(path: Path, file: ParameterFile, when: str) -> dict[Address, Value]:
    """Return the values that a file had at a time and has no more, by its history."""
    from amp_studio.files import Document, before_saves

    later = [entry for entry in Document(file, path, None).history() if entry.when > when]
    was = before_saves(file, later).values
    return {address: value for address, value in was.items() if file.values.get(address) != value}
