"""A project: a folder with ``project.yaml`` and the parameter files of one machine."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from pathlib import Path
from typing import Any

from amp_studio.errors import AmpStudioError
from amp_studio.schema import (
    UnknownFamilyError,
    YamlDocument,
    YamlError,
    did_you_mean,
    family_ids,
    load_schema,
    quoted,
    read_file,
    read_yaml,
    spelled_scalar,
    text_of,
    text_scalar,
)

from .atomic import SaveError, digest_of, write_atomic
from .document import recover_backup
from .lock import EditLock
from .paths import ENDING, backup_path, hidden_path, history_path, is_link, is_there, parameter_files_in
from .reading import ParameterFileError, file_content, read_content
from .yaml_text import amended, new_text, without_stray_tabs

PROJECT_FORMAT = 1
_VERSION = "amp_studio_project"
_MAX_BYTES = 2**20


class InvalidNameError(AmpStudioError, ValueError):
    """A project or file name that cannot be used; the text is one clear sentence."""


@dataclass(frozen=True)
class ProjectInfo:
    """The machine of a project and the connection to its control."""

    name: str
    family: str
    application: str = ""
    machine: str = ""
    control: str = ""
    """Address of the control: ``tcp://host:port`` or ``serial:/dev/ttyUSB0?baud=115200``."""
    control_name: str = ""
    """The name the control goes by (``CNC_1``)."""
    revision: str = ""
    """Control software revision."""
    builder: str = ""
    """Who built the machine."""
    serial_number: str = ""
    """Serial number of the machine."""
    built: str = ""
    """When it was built or commissioned."""
    options: str = ""
    """Options of the machine and its control."""
    people: str = ""
    """Who set it up, who answers for it."""
    notes: str = ""
    extra: dict[str, Any] = field(default_factory=dict, compare=False)


_TEXTS = tuple(f.name for f in fields(ProjectInfo) if f.name != "extra")


class Project:
    """One project on disk. Every operation on its files is here,
    with one clear sentence when it cannot be done.
    """

    def __init__(self, folder: Path, info: ProjectInfo) -> None:
        self.folder, self.info = folder, info

    # -- the project itself ----------------------------------------------------

    @classmethod
    def create(cls, folder: Path, info: ProjectInfo) -> Project:
        """Make a new project folder; raises InvalidNameError when there is a project already
        or the family is unknown, SaveError.
        """
        _check(info)
        if is_there(folder / "project.yaml"):
            raise InvalidNameError(f"{folder} is a project already")
        folder.mkdir(parents=True, exist_ok=True)
        project = cls(folder, info)
        project.save()
        return project

    @classmethod
    def open(cls, folder: Path) -> Project:
        """Read a project; raises ParameterFileError."""
        path = folder / "project.yaml"
        try:
            content = read_file(path, _MAX_BYTES)
        except OSError as error:
            raise ParameterFileError(path, None, f"cannot be read: {error.strerror or error}") from None
        return cls(folder, _read(path, content))

    def change(self, **changes: str) -> None:
        """Change the project information and save it; raises InvalidNameError."""
        info = replace(self.info, **changes)  # type: ignore[arg-type]  # all of them are texts
        _check(info)
        self.info = info
        self.save()

    def save(self) -> None:
        """Write ``project.yaml``; comments in it survive."""
        path = self.folder / "project.yaml"

        def made(previous: bytes | None) -> bytes:
            try:
                content = without_stray_tabs(_content(self.info, previous).encode("utf-8"))
                is_same = _read(path, content) == self.info
            except (UnicodeError, YamlError, ParameterFileError) as error:
                raise SaveError(f"{path} was not written: {error}") from None
            if not is_same:
                raise SaveError(f"{path} was not written: it would be read back otherwise")
            return content

        write_atomic(path, made)

    # -- its files -------------------------------------------------------------

    def files(self) -> list[Path]:
        """Return the parameter files, by name, without the copies of what controls contained."""
        return parameter_files_in(self.folder)

    def backups(self) -> list[Path]:
        """Return the files that have a backup."""
        deleted = (p.with_name(p.name.removesuffix(".bak")) for p in self.folder.glob(f"*{ENDING}.bak"))
        return sorted(p for p in {*self.files(), *deleted} if _has_backup(p))

    def path(self, name: str) -> Path:
        """Return the path of a file by name; raises InvalidNameError for a name that no system can keep."""
        name = name.removesuffix(ENDING)
        if not re.fullmatch(r"[^\W_][\w .-]{0,63}", name) or name.endswith((".", " ")):
            raise InvalidNameError(
                f"{quoted(name)} is no file name: letters, digits, '_', '-', '.' and spaces, at most 64"
            )
        if name.split(".")[0].rstrip().upper() in _RESERVED:
            raise InvalidNameError(f"'{name}' is a name that Windows keeps for itself")
        return self.folder / f"{name}{ENDING}"

    def copy(self, source: Path, name: str) -> Path:
        """Copy a file, also one of another project, under a new name; raises InvalidNameError,
        ParameterFileError.
        """
        target = self._free(name)
        content = file_content(source)
        family = read_content(source, content).schema.family
        if family.family != self.info.family:
            raise InvalidNameError(
                f"{source.name} is for {family.name}, this project for"
                f" {load_schema(self.info.family).family.name}"
            )
        write_atomic(target, content, None)
        return target

    def rename(self, source: Path, name: str) -> Path:
        """Rename a file with its backup, its history and its unsaved work; raises InvalidNameError,
        and InUseError while it is open.
        """
        target = self._free(name)
        with EditLock(source):
            _move(source, target)
        return target

    def delete(self, source: Path) -> None:
        """Delete a file; its last content stays as its backup, so that it can be recovered.
        Raises InUseError.

        Of a link only the link is removed: the file it leads to may be in other projects too.
        """
        with EditLock(source):
            if is_link(source):
                source.unlink()
            else:
                source.replace(backup_path(source))

    def recover(self, path: Path) -> None:
        """Make a backup the file again; raises FileNotFoundError, ParameterFileError, InUseError."""
        with EditLock(path):
            recover_backup(path, digest_of(path))

    def _free(self, name: str) -> Path:
        target = self.path(name)
        taken = {p.name.casefold() for p in self.files()}
        if is_there(target) or target.name.casefold() in taken:
            raise InvalidNameError(f"there is a file '{target.stem}' already")
        return target


def _read(path: Path, content: bytes) -> ProjectInfo:
    """Return the content of a project file; raises ParameterFileError."""
    try:
        text = text_of(path, content, ParameterFileError)
        document = read_yaml(text, text_scalar, spans=True)
        # Twice: known entries are texts, whatever they look like (1.0, yes), unknown ones keep their type.
        typed = read_yaml(text, spelled_scalar).data
    except YamlError as error:
        raise ParameterFileError(path, error.line, error.what) from None
    data = document.data
    _check_version(path, data.get(_VERSION) if isinstance(data, dict) else None)
    texts = _texts(path, document)
    extra = {k: v for k, v in typed.items() if k not in (*_TEXTS, _VERSION)}
    _refuse_mistyped(path, document, extra, [key for key in ("name", "family") if key not in texts])
    info = ProjectInfo(**{"name": "", "family": "", **texts}, extra=extra)
    try:
        _check(info)
    except InvalidNameError as error:
        line = document.line(("family",)) if info.name.strip() and info.family else None
        raise ParameterFileError(path, line, str(error)) from None
    return info


def _check_version(path: Path, version: object) -> None:
    """Raise ParameterFileError for what is no version of the format, and for a newer one."""
    if not isinstance(version, str) or not re.fullmatch("[0-9]{1,9}", version):
        raise ParameterFileError(path, None, "is not an AMP Studio project")
    if int(version) > PROJECT_FORMAT:
        raise ParameterFileError(path, None, f"was written by a newer AMP Studio (project format {version})")


def _content(info: ProjectInfo, previous: bytes | None) -> str:
    """Return the text of a project file; unchanged and unknown entries are kept."""
    wanted: dict[str, Any] = {_VERSION: PROJECT_FORMAT, **{key: getattr(info, key) for key in _TEXTS}}
    if previous is not None:
        document = read_yaml(previous.decode("utf-8"), text_scalar, spans=True)
        text = _amended(document, wanted) if document.data and isinstance(document.data, dict) else None
        if text is not None:
            return text
    return new_text({k: v for k, v in wanted.items() if v} | info.extra)


def _amended(document: YamlDocument, wanted: Mapping[str, Any]) -> str | None:
    """Return the text with the entries of now; None where it cannot be amended."""
    known = document.data
    own = {k: known[k] for k in known if k not in wanted}
    empty = {k: known[k] for k in wanted if k in known and not wanted[k] and not known[k]}
    entries = {k: v for k, v in {**wanted, **empty}.items() if v or k in known}
    return amended(document, known, entries | {_VERSION: str(PROJECT_FORMAT)} | own)


def _refuse_mistyped(path: Path, document: YamlDocument, extra: Iterable[str], lacking: list[str]) -> None:
    """Refuse an unknown key that is nearly one that the project lacks; any other stays in the file."""
    for key in extra:
        if near := did_you_mean(str(key), lacking):
            raise ParameterFileError(
                path, document.line((key,)), f"{quoted(str(key))}: there is no such key{near}"
            )


def _texts(path: Path, document: YamlDocument) -> dict[str, str]:
    texts = {key: document.data[key] for key in _TEXTS if document.data.get(key) is not None}
    for key, value in texts.items():
        if not isinstance(value, str):
            raise ParameterFileError(path, document.line((key,)), f"{key} is no text")
    return texts


# Windows takes the small raised digits for 1 to 3.
_RESERVED = {"CON", "PRN", "AUX", "NUL", *(f"{d}{n}" for d in ("COM", "LPT") for n in "123456789¹²³")}


def _check(info: ProjectInfo) -> None:
    """Raise InvalidNameError for a project without a name, or of an unknown family or machine type."""
    if not info.name.strip():
        raise InvalidNameError("a project needs a name")
    if not info.family:
        raise InvalidNameError("a project needs a control family")
    if info.family not in family_ids():
        raise InvalidNameError(str(UnknownFamilyError(info.family)))
    machines = [m.key for m in load_schema(info.family).family.machines]
    if info.machine and info.machine not in machines:
        raise InvalidNameError(f"{quoted(info.machine)} is no machine type: {', '.join(machines)}")


def _has_backup(path: Path) -> bool:
    try:
        return backup_path(path).is_file()
    except OSError:
        return False


def _move(source: Path, target: Path) -> None:
    """Rename a file with what lies beside it; an error leaves all of it under the old name."""
    if is_link(source):  # what belongs to the file lies beside it, not beside the link
        source.rename(target)
        return
    import shutil  # with all of Python's compressions

    sides = [(place(source), place(target)) for place in (history_path, backup_path)]
    copied = []
    try:
        # Copied before the rename: whatever ends the program, the file has its companions beside it.
        for side, copy in sides:
            if side.exists():
                copied.append(copy)
                shutil.copy2(side, copy)
        source.rename(target)
    except BaseException:
        for copy in copied:
            copy.unlink(missing_ok=True)
        raise
    with contextlib.suppress(OSError):
        hidden_path(source, ".unsaved").rename(hidden_path(target, ".unsaved"))
    for side, _ in sides:
        with contextlib.suppress(OSError):
            side.unlink(missing_ok=True)
