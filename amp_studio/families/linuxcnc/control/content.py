"""What the folder of a LinuxCNC contains: its configuration with the files that it includes and the HAL files
that it names, byte for byte, under a line that names the kind.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field

from amp_studio.families.linuxcnc.formats.ini import FAMILY, FORMAT, contents_of
from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, ReadOptions, file_of
from amp_studio.schema import load_schema
from amp_studio.transfer import ImageError, TakesAllOrRefuses

KIND = "LinuxCNC configuration 1"
MAIN = ""
"""The name of the configuration itself: only the address of the control names it."""
_HEAD = re.compile(rb"([0-9]{1,8}) ([^\n]{0,200})\n")
_NAMED = 5


@dataclass(frozen=True)
class Configuration:
    """The files of a configuration by the names that it has for them; its own is ``MAIN``."""

    files: Mapping[str, bytes] = field(default_factory=dict)

    def written(self) -> bytes:
        """Return them as one content; nothing where there is no file."""
        if not self.files:
            return b""
        parts = [b"%d %s\n%s\n" % (len(text), name.encode(), text) for name, text in self.files.items()]
        return b"".join((KIND.encode() + b"\n", *parts, b"end\n"))

    @classmethod
    def read(cls, content: bytes) -> Configuration:
        """Take a content apart; raises ImageError."""
        first = KIND.encode() + b"\n"
        if not content.startswith(first):
            raise ImageError("this is not the configuration of a LinuxCNC")
        files: dict[str, bytes] = {}
        at = len(first)
        while head := _HEAD.match(content, at):
            try:
                name = head[2].decode()
            except UnicodeDecodeError:
                raise ImageError("the name of a file of the configuration is damaged") from None
            end = head.end() + int(head[1])
            if name in files or content[end : end + 1] != b"\n":
                raise ImageError("the configuration has been cut off or damaged")
            files[name] = content[head.end() : end]
            at = end + 1
        if content[at:] != b"end\n" or MAIN not in files:
            raise ImageError("the configuration has been cut off or damaged")
        return cls(files)

    def file(self, machine: str = "") -> ParameterFile:
        """Return what it means, for a version of the program ("": the one that reads most of it);
        raises ImageError.
        """
        schema = load_schema(FAMILY)
        texts = {name: text.decode("latin-1") for name, text in self.files.items()}
        try:
            read = FORMAT.read(texts[MAIN], schema, ReadOptions(True, machine, beside=texts.get))
        except FormatError as error:
            raise ImageError(f"the configuration: {error}") from None
        return file_of(schema, read, "LinuxCNC")


class ConfigurationContent(TakesAllOrRefuses):
    """Between a parameter file and the configuration of one LinuxCNC.

    Every key that is a parameter becomes as the file has it, also one that the file does not set. All other
    lines, remarks and HAL files among them, belong to the control and stay.
    """

    has_header = False

    def decode(self, content: bytes) -> ParameterFile:
        """Return what the configuration means; raises ImageError."""
        return Configuration.read(content).file()

    def encode(self, file: ParameterFile, current: bytes) -> bytes:
        """Return the configuration with the values of a file in it; raises ImageError."""
        before = Configuration.read(current)
        wanted = before.file(file.machine)
        wanted.values.clear()
        wanted.take(file.values)
        try:
            made = Configuration(contents_of(wanted, before.files))
        except FormatError as error:
            raise ImageError(str(error)) from None
        back = made.file(file.machine)
        if lost := [
            a for a in wanted.values if a not in back.values and wanted.evaluation.state(a).is_active
        ]:
            labels = [wanted.machine_schema.label(address) for address in lost[:_NAMED]]
            raise ImageError(f"no line of the configuration can set {', '.join(labels)}")
        return made.written()

    def left_out(self, file: ParameterFile, current: bytes) -> str:
        """Return the entries of a file that are no parameters and that the control does not have."""
        present = {_bare(name) for name in Configuration.read(current).file(file.machine).unknown}
        missing = sorted({_bare(name) for name in file.unknown} - present)
        more = len(missing) - _NAMED
        return ", ".join(missing[:_NAMED]) + (f" and {more} more" if more > 0 else "")

    def refit(self, content: bytes, current: bytes) -> bytes:  # noqa: ARG002  # other kinds need it
        """Return the content itself: a copy is put back as it was."""
        Configuration.read(content)
        return content

    def difference(self, content: bytes, found: bytes) -> str:
        """Return which files differ, in words."""
        wanted, present = Configuration.read(content).files, Configuration.read(found).files
        names = {**wanted, **present}
        different = [name or "the configuration" for name in names if wanted.get(name) != present.get(name)]
        return f"in {', '.join(different)}" if different else ""


def _bare(name: str) -> str:
    """Return an entry without its place: ``[RS274NGC]LOG in line 4`` is ``[RS274NGC]LOG``."""
    return name.split(" in ", maxsplit=1)[0]
