"""A 57C422B module in a rack: registers written one at a time and read back, and taken over by a command with its handshake.

Instruction manual, pages 4-1 to 4-37; docs/protocols/registers.md.
"""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable, Iterator
from typing import ClassVar

from amp_studio.schema import load_schema
from amp_studio.transfer.break_state import state_after_break
from amp_studio.transfer.driver import Abilities, ControlIdentity, NeverRestarts, Receipt
from amp_studio.transfer.errors import (
    CancelledError,
    Confirmed,
    ControlSilentError,
    ImageRejectedError,
    NotInEmergencyStopError,
    ProtocolMismatchError,
    TransferError,
    WrongFamilyError,
)
from amp_studio.transfer.image import ImageError
from amp_studio.transfer.links.endpoint import Endpoint
from amp_studio.transfer.links.opening import connect
from amp_studio.transfer.progress import Progress, quiet
from amp_studio.transfer.waiting import OpenLink, Waiting

from .content import AXIS_Y, FAMILY, RegisterContent, settings, words_of_content, written_content
from .register_line import MOST, RegisterLine

MODE, COMMAND, COMMAND_2, STATUS, FAULT, VERSION = 65, 66, 67, 72, 73, 99
LOOP = 1 << 0  # of the mode register (page 4-24)
CHANGE_DEFAULTS = 1 << 9  # of the command register (page 4-48 uses 0200H)
ACKNOWLEDGE = 1 << 15  # of the status register (page 4-36)
VERSION_WORDS = 5
HANDSHAKE_WAIT = 3.0  # seconds
POLL = 0.02
WRITE_TRIES = 3
AXES = {0: "X", AXIS_Y: "Y"}


class RegisterDriver(RegisterContent, NeverRestarts):
    """Speaks to the live registers of one module."""

    abilities = Abilities(can_send=True, all_or_nothing=False, lasting_states=())
    takes_live_values: ClassVar[bool] = True

    def __init__(
        self,
        open_link: OpenLink,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._waiting = Waiting(clock, sleep)
        self._line = RegisterLine(open_link, self._waiting)

    @classmethod
    def at(cls, endpoint: Endpoint, family: str = "") -> RegisterDriver:
        """Return the driver of an endpoint; raises WrongFamilyError where another family is asked for."""
        if family not in ("", FAMILY):
            raise WrongFamilyError(f"this is how the registers of a {FAMILY} are read, not a {family}")
        return cls(lambda look: connect(endpoint, look=look))

    def identify(self, progress: Progress = quiet, cancel: threading.Event | None = None) -> ControlIdentity:
        """Return the name of the rack and the version that the module's registers 99 to 103 contain (page 4-42)."""
        self._waiting.begin(progress, cancel)
        name = self._line.name()
        signs = b"".join(word.to_bytes(2, "big") for word in self._line.read(VERSION, VERSION_WORDS))
        revision = signs.decode("ascii", "replace").strip("\0 ")
        return ControlIdentity(FAMILY, "registers", name[:60], revision, load_schema(FAMILY).signature)

    def fetch(
        self, progress: Progress = quiet, cancel: threading.Event | None = None, stage: str = "upload"
    ) -> bytes:
        """Return the registers that an application sets."""
        self._waiting.begin(progress, cancel)
        return self._fetched(stage)

    def send(
        self,
        content: bytes,
        *,
        signature: str,  # noqa: ARG002 -- every module has the same registers
        expected: bytes,  # noqa: ARG002
        held: bytes,
        progress: Progress = quiet,
        cancel: threading.Event | None = None,
    ) -> Receipt:
        """Write the registers that differ, read each back, and have the module take its setups over.

        Raises NotInEmergencyStopError while a control loop is on: what is written then becomes active in a motion.
        """
        self._waiting.begin(progress, cancel)
        before, wanted = words_of_content(held), words_of_content(content)
        changed = [register for register in settings() if before[register] != wanted[register]]
        self._need_loops_off()
        written: list[int] = []
        proved = 0
        try:
            for number, register in enumerate(changed, 1):
                written.append(register)
                self._write(register, wanted[register])
                proved = number
                self._waiting.notify("download", number, len(changed))
            notes = tuple(
                self._taken_over(axis) for axis in AXES if any(r // AXIS_Y * AXIS_Y == axis for r in changed)
            )
        except TransferError as error:
            if written:
                self._tell_state(error, held, content)
                is_refused = isinstance(error, ImageRejectedError)  # it has been answered
                under_way = f"R{written[-1]}" if len(written) > proved and not is_refused else ""
                error.confirmed = Confirmed(proved, len(changed), under_way)
            raise
        lost = (
            "The registers lose it with the power of the rack: load the AutoMax tables there too (page 3-10)."
        )
        return Receipt(restart_needed=False, notes=(*notes, lost))

    def close(self) -> None:
        """Hang up."""
        self._line.close()

    # -- parts ------------------------------------------------------------------------

    def _fetched(self, stage: str) -> bytes:
        words: dict[int, int] = {}
        blocks = list(_blocks(settings()))
        for number, (first, count) in enumerate(blocks, 1):
            words.update(zip(range(first, first + count), self._line.read(first, count), strict=True))
            self._waiting.notify(stage, number, len(blocks))
        return written_content(words)

    def _need_loops_off(self) -> None:
        for axis, name in AXES.items():
            if self._line.read(axis + MODE, 1)[0] & LOOP:
                raise NotInEmergencyStopError(
                    f"the control loop of axis {name} is on (R{axis + MODE}, bit 0): switch it off to download"
                )

    def _write(self, register: int, word: int) -> None:
        found = None
        for _ in range(WRITE_TRIES):
            found = self._line.write(register, word)
            if found == word and self._line.read(register, 1)[0] == word:
                return
        raise ImageRejectedError(f"register {register} contains {found} after {word} was written to it")

    def _taken_over(self, axis: int) -> str:
        """Have an axis change its default setups, with the handshake of page 4-36; return what came of it."""
        before = self._line.read(axis + FAULT, 1)[0]
        if self._line.read(axis + COMMAND, 2) != (0, 0):
            raise ProtocolMismatchError(f"a command is in R{axis + COMMAND} or R{axis + COMMAND_2} already")
        try:
            self._line.write(axis + COMMAND, CHANGE_DEFAULTS)
            new = self._wait_for(
                axis, before, lambda status, command: bool(status & ACKNOWLEDGE) or command == 0
            )
        except TransferError as error:
            self._take_back(axis, error)
            raise
        self._line.write(axis + COMMAND, 0)  # the application clears it; one that is cleared already stays so
        if not new:
            new = self._wait_for(
                axis, before, lambda status, command: not status & ACKNOWLEDGE and command == 0
            )
        if new:
            bits = ", ".join(f"b{n}" for n in range(16) if new >> n & 1)
            raise ImageRejectedError(
                f"axis {AXES[axis]} shows a fault for its setups (R{axis + FAULT}, {bits})"
            )
        return f"Axis {AXES[axis]} has taken its setups over (change default setups, acknowledged)."

    def _take_back(self, axis: int, error: TransferError) -> None:
        """Leave no command behind, also if somebody asked to stop."""
        if isinstance(error, CancelledError):
            self._waiting.begin(quiet, None)
        with contextlib.suppress(TransferError):
            self._line.write(axis + COMMAND, 0)

    def _wait_for(self, axis: int, before: int, is_there: Callable[[int, int], bool]) -> int:
        """Wait for a state of the handshake; return the faults that came up instead, 0 for none."""
        end = self._waiting.now() + HANDSHAKE_WAIT
        while True:
            status, fault = self._line.read(axis + STATUS, 2)
            command = self._line.read(axis + COMMAND, 1)[0]
            if (new := fault & ~before) or is_there(status, command):
                return new
            if self._waiting.now() >= end:
                raise ControlSilentError(
                    f"axis {AXES[axis]} does not acknowledge the command (R{axis + STATUS}, bit 15)"
                )
            self._waiting.look()
            self._waiting.sleep(POLL)

    def _tell_state(self, error: TransferError, held: bytes, content: bytes) -> None:
        """Read everything again and set what the module contains now; "unknown" where it does not answer."""
        if isinstance(error, CancelledError):
            self._waiting.begin(quiet, None)
        try:
            now = self._fetched("verify")
            error.at_control, error.new = state_after_break(_named(held), _named(content), _named(now))
        except (TransferError, ImageError):
            error.at_control = "unknown"


def _named(content: bytes) -> dict[str, str]:
    return {f"R{register}": str(word) for register, word in words_of_content(content).items()}


def _blocks(registers: tuple[int, ...]) -> Iterator[tuple[int, int]]:
    """Yield first register and count of runs that can be read at once."""
    first, count = registers[0], 0
    for register in registers:
        if register != first + count or count == MOST:
            yield first, count
            first, count = register, 0
        count += 1
    yield first, count
