"""The public library at a control: ask it, read it, compare it,
and send a machine to it with everything that the verbs check.
"""

from __future__ import annotations

from contextlib import closing
from pathlib import Path
from typing import Self

from amp_studio.machine import MachineError, MachineParameters
from amp_studio.transfer import ControlIdentity, ControlStatus, Exchange
from amp_studio.transfer.client import (
    ImageComparison,
    Outcome,
    StatusReader,
    download_file,
    fetch_file,
    fetch_image,
    open_driver,
    verify_content,
)


class ConnectedControl:
    """A control at an address (``tcp://192.168.1.20:2000``, ``COM3``, ``/dev/ttyUSB0``).

    Each method opens the line, does its work and closes it again, so that nothing is blocked in between.
    Every method raises TransferError, whose ``at_control`` is what the control contains then: old, new,
    mixed, defaults or unknown.
    """

    def __init__(self, address: str, family: str = "") -> None:
        self.address = address
        self.family = family
        """The family of its protocol; empty where the control makes itself known."""

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        """Nothing is open between two methods."""

    def identify(self) -> ControlIdentity:
        """Return what the control states of itself: name, revision, whether it is in E-stop,
        the digest of its content.
        """
        with closing(open_driver(self.address, self.family)) as driver:
            return driver.identify()

    def status(self) -> ControlStatus:
        """Return what the control shows of itself now: positions, following errors, states and faults;
        nothing is written.
        """
        with closing(StatusReader(self.address, self.family)) as reader:
            return reader.read()

    def upload(self) -> MachineParameters:
        """Return the machine that the control contains; it has no file yet."""
        return MachineParameters(fetch_file(self.address, family=self.family))

    def verify(self, machine: MachineParameters) -> ImageComparison:
        """Compare a machine with what the control contains, every value and every byte; nothing is
        written.
        """
        return verify_content(machine.file, fetch_image(self.address, family=machine.schema.family.family))

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
        with MachineError unless they are accepted.
        """
        errors = [finding for finding in machine.check(as_delivered=True) if finding.severity == "error"]
        if errors and not accept_errors:
            raise MachineError(f"{len(errors)} errors, nothing was sent; the first: {errors[0].message}")
        folder = Path(keep) if keep is not None else machine.path.parent if machine.path else None
        if folder is None:
            raise MachineError(
                "a machine that was never saved needs the folder for the copy of the control: keep=FOLDER"
            )
        stem = machine.path.stem if machine.path else machine.file.header.name or "machine"
        exchange = Exchange(keep=folder / f"{stem}.amp", record=machine.path)
        return download_file(machine.file, self.address, exchange, expected=expect)


def connect(address: str, family: str = "") -> ConnectedControl:
    """Return the control at an address; nothing is asked of it yet."""
    return ConnectedControl(address, family)
