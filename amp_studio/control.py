"""The public library at a control: ask it, read it, compare it,
and send a machine to it with everything that the verbs check.
"""

from __future__ import annotations

from collections.abc import Generator
from contextlib import closing
from dataclasses import dataclass, replace
from hashlib import sha256
from pathlib import Path
from threading import Event
from typing import Self

from amp_studio.assignments import MachineError
from amp_studio.files import Notify
from amp_studio.given import checked_types
from amp_studio.machine import MachineParameters
from amp_studio.transfer import (
    Abilities,
    ControlIdentity,
    ControlStatus,
    Exchange,
    Progress,
    decode_content,
    quiet,
)
from amp_studio.transfer.client import (
    Copy,
    ImageComparison,
    Outcome,
    StatusReader,
    download_file,
    fetch_image,
    look_at,
    open_copy,
    open_driver_at,
    record_look,
    restore_copy,
    verify_at,
)


@dataclass(frozen=True)
class ControlLook:
    """What one look at a control has found: who it is, what its protocol can do, and what it contains."""

    identity: ControlIdentity
    abilities: Abilities
    content: bytes
    """What it contains, byte for byte; empty where it contains nothing."""
    sha256: str
    """SHA-256 of the content, in hexadecimal."""

    def machine(self) -> MachineParameters:
        """Return the machine that the content is; raises ImageError for one that cannot be read."""
        return MachineParameters(decode_content(self.content))


class ConnectedControl:
    """A control at an address (``tcp://192.168.1.20:2000``, ``COM3``, ``/dev/ttyUSB0``).

    Each method opens the line, does its work and closes it again, so that nothing is blocked in between.
    Every method raises TransferError, whose ``at_control`` is what the control contains then: old, new,
    mixed, defaults or unknown; EndpointError for an address that is none, and UnknownFamilyError.
    """

    def __init__(self, address: str, family: str = "", exchange: Exchange | None = None) -> None:
        self.address = address
        self.family = family
        """The family of its protocol; empty where the control makes itself known."""
        self.exchange = exchange or Exchange()
        """Who watches an exchange and may stop it, and where it is kept and recorded."""
        self.sha256 = ""
        """SHA-256 of what was fetched last, in hexadecimal; empty before."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Nothing is open between two methods."""

    def __repr__(self) -> str:
        return f"<ConnectedControl {self.address}{f': {self.family}' if self.family else ''}>"

    def identify(self) -> ControlIdentity:
        """Return what the control states of itself: name, revision, whether it is in E-stop,
        the digest of its content.
        """
        with closing(open_driver_at(self.address, self.family, self.exchange)) as driver:
            return driver.identify()

    def look(self) -> ControlLook:
        """Return who the control is and what it contains; its protocol is found out where neither it nor a
        family is named.
        """
        with closing(open_driver_at(self.address, self.family, self.exchange)) as driver:
            abilities = driver.abilities
            identity, content, digest = look_at(driver, self.exchange)
        return ControlLook(identity, abilities, content, digest)

    def status(self) -> ControlStatus:
        """Return what the control shows of itself now: positions, following errors, states and faults;
        nothing is written.
        """
        # Closed with the line: a control may take one client only.
        with closing(self.watch()) as seen:
            return next(seen)

    def watch(self) -> Generator[ControlStatus, None, None]:
        """Yield the status each time it is asked for, over one line that stays open until the generator is
        closed.
        """
        with closing(StatusReader(self.address, self.family)) as reader:
            while True:
                yield reader.read()

    def fetch(self) -> bytes:
        """Return what the control contains, byte for byte, whatever it is."""
        content = fetch_image(self.address, self.exchange, family=self.family)
        self.sha256 = sha256(content).hexdigest()
        return content

    def upload(self) -> MachineParameters:
        """Return the machine that the control contains; it has no file yet. Raises ImageError."""
        return MachineParameters(decode_content(self.fetch()))

    @checked_types
    def verify(self, machine: MachineParameters) -> ImageComparison:
        """Compare a machine with what the control contains, every value and every byte; nothing is
        written but the record of exchanges, where there is one.
        """
        family = machine.schema.family.family
        found, fetched = verify_at(self.address, machine.file, self.exchange, family)
        self.sha256 = sha256(fetched).hexdigest()
        # The record is beside the file of the machine; one without a file has none.
        exchange = replace(self.exchange, record=machine.source)
        record_look("verify", exchange, family, self.address, fetched, found.summary())
        return found

    @checked_types
    def download(
        self,
        machine: MachineParameters,
        *,
        expect: str | None = None,
        accept_errors: bool = False,
        keep: str | Path | None = None,
    ) -> Outcome:
        """Send a machine, read it back and prove it;
        what the control contained is kept in a file before anything is replaced.

        ``expect`` is the SHA-256 of what may be replaced, ``keep`` the folder of the copy: that of the
        machine's file, where it is left out. A machine with errors is refused
        with MachineError unless they are accepted. Raises DigestError, ImageError.
        """
        # First: a machine with errors opens no line.
        if not accept_errors:
            _refuse_errors(machine)
        source = machine.source
        if source is None and keep is None:
            raise MachineError(
                "a machine that was never saved needs the folder for the copy of the control: keep=FOLDER"
            )
        named = source or Path(f"{machine.file.header.name or 'machine'}.amp")
        # A name near which the copy is kept, with the time in it; this file itself is not written.
        kept = Path(keep) / named.name if keep is not None else named
        exchange = replace(self.exchange, keep=kept, record=source)
        return download_file(machine.file, self.address, exchange, expected=expect)

    @checked_types
    def restore(
        self, copy: str | Path | Copy, *, expect: str | None = None, keep: str | Path | None = None
    ) -> Outcome:
        """Put back what a control has contained, byte for byte: a copy that a download has kept
        (``NAME.before-STAMP.img``, or the .amp of that name), which is compared with its digest.

        What the control contains instead is kept first, in the folder ``keep`` or beside the copy. ``expect``
        is as of ``download``. A machine with errors, and no image beside it that proves that a control
        contained it, is refused with MachineError. Raises CopyError, ParameterFileError, DigestError.
        """
        found = copy if isinstance(copy, Copy) else open_copy(Path(copy))
        # What a control has contained goes back even with errors: it ran with them before.
        if found.file is not None and not found.is_kept:
            _refuse_errors(MachineParameters(found.file, found.path))
        kept = Path(keep) / found.path.name if keep is not None else found.path
        exchange = replace(self.exchange, keep=kept, record=found.path)
        return restore_copy(found, self.address, exchange, expected=expect)


def _refuse_errors(machine: MachineParameters) -> None:
    """Raise MachineError for a machine with errors."""
    from amp_studio.report import counted

    # Findings of steps that were not reached count here: the control gets all values.
    errors = [finding for finding in machine.check(as_delivered=True) if finding.severity == "error"]
    if errors:
        number = counted(len(errors), "error")
        raise MachineError(f"{number}, nothing was sent; the first: {errors[0].message}")


@checked_types
def connect(
    address: str,
    family: str = "",
    *,
    progress: Progress = quiet,
    cancel: Event | None = None,
    notify: Notify = lambda _message: None,
) -> ConnectedControl:
    """Return the control at an address; nothing is asked of it yet.

    ``progress`` is called with the step, how far it has come and how far it goes; ``cancel`` breaks off what
    waits, also from another thread; ``notify`` is called with what does not end an exchange.
    """
    return ConnectedControl(address, family, Exchange(progress, cancel, notify=notify))
