"""A file that cannot be used, whatever it is: facts, rules, projects, parameter files."""

from __future__ import annotations

from pathlib import Path

from amp_studio.errors import AmpStudioError

from .regular_file import MAX_BYTES, read_file
from .yaml_reader import KeyPath, YamlDocument, YamlError, read_yaml

Slip = tuple[KeyPath, str]
"""Where in the data of a file something is wrong, and what."""


class FileError(AmpStudioError, ValueError):
    """A file that cannot be used: path, line and one clear sentence; nothing was changed."""

    def __init__(self, path: Path, line: int | None, what: str) -> None:
        self.path, self.line, self.what = path, line, what
        super().__init__(f"{path}{f', line {line}' if line else ''}: {what}")


class ModelError(ValueError):
    """Data that do not fit a kind of record; ``slips`` is what is wrong, one a place."""

    def __init__(self, slips: list[Slip]) -> None:
        super().__init__("; ".join(what for _, what in slips))
        self.slips = slips


def text_of(path: Path, content: bytes, error: type[FileError] = FileError) -> str:
    """Return the text of a file's content; raises ``error``."""
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError as fault:
        line = content[: fault.start].count(b"\n") + 1
        raise error(path, line, "is not UTF-8 text") from None


def read_yaml_file(
    path: Path, error: type[FileError], *, most: int = MAX_BYTES, references: bool = False
) -> YamlDocument:
    """Return the YAML document of a file, with the places of its entries; raises ``error``."""
    try:
        content = read_file(path, most)
    except OSError as fault:
        raise error(path, None, f"cannot be read: {fault.strerror or fault}") from None
    try:
        return read_yaml(text_of(path, content, error), spans=True, references=references)
    except YamlError as fault:
        raise error(path, fault.line, fault.what) from None
