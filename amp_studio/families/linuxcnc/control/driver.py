"""The folder of a LinuxCNC: its configuration is read and written as files, and becomes active when the
program starts again.

docs/protocols/linuxcnc.md.
"""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from functools import cached_property
from pathlib import Path
from typing import ClassVar

from amp_studio.families.linuxcnc.formats.ini import FAMILY, FORMAT
from amp_studio.files import ChangedOnDiskError, ParameterFile, SaveError, write_atomic
from amp_studio.formats import ReadOptions
from amp_studio.schema import Address, Value, load_schema
from amp_studio.transfer import (
    QUIET,
    Abilities,
    ControlIdentity,
    ControlStatus,
    Exchange,
    ImageChangedError,
    ImageRejectedError,
    NoConnectionError,
    Receipt,
    Replacement,
    TransferError,
    Waiting,
    WrongFamilyError,
)
from amp_studio.transfer.links import Endpoint

from .content import MAIN, Configuration, ConfigurationContent
from .running import is_running, status_of, values_in_use

_PROTOCOL = "configuration"
IN_USE = "A LinuxCNC runs with this configuration: what is written counts from its next start."
_MAX_BYTES = 20_000_000


class ConfigurationDriver(ConfigurationContent):
    """Speaks to the folder of one configuration on a disk that this computer reaches."""

    abilities: ClassVar[Abilities] = Abilities(
        all_or_nothing=False, maps_numbers=True, lasting_states=("stopped", "running")
    )

    def __init__(self, endpoint: Endpoint) -> None:
        self.endpoint = endpoint
        self._waiting = Waiting()

    @classmethod
    def at(cls, endpoint: Endpoint, family: str = "") -> ConfigurationDriver:
        """Return the driver of an address; raises WrongFamilyError."""
        if family not in ("", FAMILY):
            raise WrongFamilyError(f"a folder with a configuration is of {FAMILY}, not of {family}", "")
        return cls(endpoint)

    @cached_property
    def path(self) -> Path:
        """The configuration; raises NoConnectionError."""
        if self.endpoint.kind != "folder":
            raise NoConnectionError(f"{self.endpoint} is no folder: write folder:NAME.ini", "")
        return _configuration_in(Path(self.endpoint.device))

    def identify(self, exchange: Exchange = QUIET) -> ControlIdentity:
        """Return which machine the configuration is of; raises TransferError."""
        content = self.fetch(exchange)
        file = self.decode(content)
        return ControlIdentity(
            family=FAMILY,
            protocol=_PROTOCOL,
            name=file.header.name,
            revision=file.machine,
            signature=load_schema(FAMILY).signature,
            size=len(content),
            sha256=hashlib.sha256(content).digest(),
            restart_needed=self._uses_others(file),
            notice=IN_USE if is_running(self.path) else "",
        )

    def _uses_others(self, file: ParameterFile) -> bool:
        """Return whether the running program uses other values; False where it does not show them to this
        user, who may write its files anyway.
        """
        try:
            used = values_in_use(file) if is_running(self.path) else {}
        except TransferError:
            return False
        return any(value != file.get(address) for address, value in used.items())

    def fetch(self, exchange: Exchange = QUIET, stage: str = "upload") -> bytes:
        """Return the configuration with all files that it names in its folder; raises TransferError."""
        self._waiting.begin(exchange)
        self._waiting.look()
        files = {MAIN: self._read(self.path)}

        def beside(name: str) -> str | None:
            place = self._place(name)
            if place is None or not place.is_file():
                return None
            files[name] = self._read(place)
            return files[name].decode("latin-1")

        FORMAT.read(files[MAIN].decode("latin-1"), load_schema(FAMILY), ReadOptions(True, beside=beside))
        self._waiting.notify(stage, 1, 1)
        return Configuration(files).written()

    def send(self, replacement: Replacement, exchange: Exchange = QUIET) -> Receipt:
        """Write the files that change, the configuration last; what is written already is put back where one
        cannot be written.
        """
        self._waiting.begin(exchange)
        self._waiting.look()
        old = Configuration.read(replacement.current).files
        new = Configuration.read(replacement.content).files
        changed = sorted((n for n in new if new[n] != old.get(n)), key=lambda name: (name == MAIN, name))
        if outside := [name for name in changed if self._place(name) is None]:
            raise ImageRejectedError(f"{outside[0]} is not in the folder of the configuration", "old")
        written: list[str] = []
        for name in changed:
            try:
                self._write(name, new[name], old.get(name))
            except (ChangedOnDiskError, SaveError) as error:
                raise self._restored_error(error, written, old, new) from error
            written.append(name)
            self._waiting.notify("send", len(written), len(changed))
        return Receipt(restart_needed=is_running(self.path))

    def close(self) -> None:
        """Nothing is open between two exchanges."""

    def status(self) -> ControlStatus:
        """Return positions, following errors and states of the program that runs; raises TransferError."""
        return status_of(self.decode(self.fetch()), is_running(self.path), _PROTOCOL)

    def in_use(self, content: bytes) -> dict[Address, Value]:
        """Return the values that the program uses which runs with this configuration; raises TransferError.

        One that it shows as the content has it is the content's own, with all its digits.
        """
        return values_in_use(self.decode(content)) if is_running(self.path) else {}

    # -- files ------------------------------------------------------------------------------------

    def _place(self, name: str) -> Path | None:
        """Return where a file of the configuration is; None for one outside of its folder."""
        if name == MAIN:
            return self.path
        folder = self.path.parent
        try:
            place = (folder / name).resolve()
        except (OSError, ValueError):
            return None
        return place if place.is_relative_to(folder) and place != self.path else None

    def _read(self, path: Path) -> bytes:
        """Return the content of a file of the folder; raises NoConnectionError."""
        try:
            with path.open("rb") as stream:
                content = stream.read(_MAX_BYTES + 1)
        except OSError as error:
            raise NoConnectionError(f"{path} cannot be read: {error.strerror or error}", "") from error
        if len(content) > _MAX_BYTES:
            raise NoConnectionError(f"{path} is too large for a configuration", "")
        return content

    def _write(self, name: str, content: bytes, before: bytes | None) -> None:
        place = self._place(name)
        assert place is not None
        expected = None if before is None else hashlib.sha256(before).hexdigest()
        write_atomic(place, content, expected, keep_backup=False)

    def _restored_error(
        self,
        error: ChangedOnDiskError | SaveError,
        written: list[str],
        old: Mapping[str, bytes],
        new: Mapping[str, bytes],
    ) -> TransferError:
        """Put back what was written, and return the error with what the folder contains then.

        A file that was not there before stays: nothing is deleted in the folder of a control.
        """
        stays = [name for name in written if name not in old]
        for name in reversed([name for name in written if name in old]):
            try:
                self._write(name, old[name], new[name])
            except (ChangedOnDiskError, SaveError):
                stays.append(name)
        if stays:
            return TransferError(str(error), "mixed", new=tuple(name or self.path.name for name in stays))
        kind: Callable[..., TransferError] = (
            ImageChangedError if isinstance(error, ChangedOnDiskError) else TransferError
        )
        return kind(str(error), "old")


def _configuration_in(path: Path) -> Path:
    """Return the configuration that a path names: itself, or the only one of a folder."""
    try:
        place = path.expanduser().resolve()
        found = sorted(place.glob("*.ini")) if place.is_dir() else [place]
    except (OSError, ValueError, RuntimeError) as error:
        raise NoConnectionError(f"{path} cannot be read: {error}", "") from error
    if len(found) == 1:
        return found[0]
    names = ", ".join(each.name for each in found[:5]) or "none"
    raise NoConnectionError(
        f"{path} has {len(found)} configurations ({names}): name one, folder:NAME.ini", ""
    )
