"""A 57C422B module in a rack: registers written one at a time and read back,
and taken over by a command with its handshake.

Instruction manual, pages 4-1 to 4-37; docs/protocols/registers.md.
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Collection, Iterator
from typing import ClassVar

from amp_studio.schema import load_schema
from amp_studio.transfer import (
    QUIET,
    Abilities,
    CancelledError,
    ControlIdentity,
    ControlSilentError,
    ControlStatus,
    ImageRejectedError,
    LineDriver,
    NotInEmergencyStopError,
    OpenLink,
    ProtocolMismatchError,
    Receipt,
    Replacement,
    SentValues,
    TransferError,
    Waiting,
)

from .content import AXIS_Y, FAMILY, RegisterContent, settings, words_of_content, written_content
from .register_line import MAX_REGISTERS, RegisterLine
from .status import SHOWN, AxisRegisters, status_of

MODE, COMMAND, COMMAND_2, STATUS, FAULT, VERSION = 65, 66, 67, 72, 73, 99
LOOP = 1 << 0  # of the mode register (page 4-24)
LATCH = 1 << 11  # of the command register: latch status (page 4-32)
CHANGE_DEFAULTS = 1 << 9  # of the command register (page 4-48 uses 0200H)
ACKNOWLEDGE = 1 << 15  # of the status register (page 4-36)
VERSION_WORDS = 5
HANDSHAKE_WAIT = 3.0  # seconds
POLL = 0.02
WRITE_TRIES = 3
AXES = {0: "X", AXIS_Y: "Y"}


class RegisterDriver(RegisterContent, LineDriver):
    """Speaks to the live registers of one module."""

    family, protocol = FAMILY, "registers"
    abilities = Abilities(all_or_nothing=False, lasting_states=())
    is_read_when_stopped = True
    takes_live_values: ClassVar[bool] = True

    def __init__(self, open_link: OpenLink, waiting: Waiting | None = None) -> None:
        super().__init__(open_link, waiting)
        self._line = RegisterLine(open_link, self._waiting)

    def close(self) -> None:
        """Close the line."""
        self._line.close()

    def _identity(self) -> ControlIdentity:
        """Return the name of the rack and the version that the module's registers 99
        to 103 contain (page 4-42).
        """
        name = self._line.name()
        characters = b"".join(word.to_bytes(2, "big") for word in self._line.read(VERSION, VERSION_WORDS))
        revision = characters.decode("ascii", "replace").strip("\0 ")
        return ControlIdentity(FAMILY, self.protocol, name[:60], revision, load_schema(FAMILY).signature)

    def status(self) -> ControlStatus:
        """Return what the module's registers show of both axes; it latches them,
        which changes nothing else (page 4-32).
        """
        identity = self._identity()
        axes = [self._axis_status(first, name) for first, name in AXES.items()]
        return status_of(identity, axes)

    def _axis_status(self, first: int, name: str) -> AxisRegisters:
        """Read the registers of an axis, latched where no command of another program is under way."""
        # The command registers belong to the application while it has a command in them: a latch would
        # overwrite it.
        is_free = self._line.read(first + COMMAND, 2) == (0, 0)
        if is_free:
            self._line.write(first + COMMAND, LATCH)
            end = self._waiting.now() + HANDSHAKE_WAIT
            while (
                self._line.read(first + COMMAND, 1)[0]
                and not self._line.read(first + STATUS, 1)[0] & ACKNOWLEDGE
            ):
                if self._waiting.now() > end:
                    break
                self._waiting.sleep(POLL)
            self._line.write(first + COMMAND, 0)
        words = {first_of: self._line.read(first + first_of, count) for first_of, count in SHOWN}
        return AxisRegisters(name, is_free, words)

    def _fetched(self, stage: str) -> bytes:
        """Return the registers that an application sets."""
        words: dict[int, int] = {}
        blocks = list(_blocks(settings()))
        for number, (first, count) in enumerate(blocks, 1):
            words.update(zip(range(first, first + count), self._line.read(first, count), strict=True))
            self._waiting.notify(stage, number, len(blocks))
        return written_content(words)

    def _names(self, content: bytes) -> dict[str, str]:
        return {f"R{register}": str(word) for register, word in words_of_content(content).items()}

    def _with_new(self, replacement: Replacement, names: Collection[str]) -> bytes:
        wanted = words_of_content(replacement.content).items()
        new = {register: word for register, word in wanted if f"R{register}" in names}
        return written_content(words_of_content(replacement.current) | new)

    def _send(self, replacement: Replacement, sent: SentValues) -> Receipt:
        """Write the registers that differ, read each back, and have the module take its setups over.

        Raises NotInEmergencyStopError while a control loop is on:
        what is written then becomes active in a motion.
        """
        before, wanted = words_of_content(replacement.current), words_of_content(replacement.content)
        changed = [register for register in settings() if before[register] != wanted[register]]
        sent.total = len(changed)
        self._need_loops_off()
        for number, register in enumerate(changed, 1):
            sent.begin(f"R{register}")
            self._write(register, wanted[register])
            sent.confirm(f"R{register}")
            self._waiting.notify("download", number, len(changed))
        notes = tuple(
            self._taken_over(axis) for axis in AXES if any(r // AXIS_Y * AXIS_Y == axis for r in changed)
        )
        lost = (
            "The registers lose it with the power of the rack: load the AutoMax tables there too (page 3-10)."
        )
        return Receipt(restart_needed=False, notes=(*notes, lost))

    # -- parts ------------------------------------------------------------------------

    def _need_loops_off(self) -> None:
        """Raise NotInEmergencyStopError while a control loop is on."""
        for axis, name in AXES.items():
            if self._line.read(axis + MODE, 1)[0] & LOOP:
                raise NotInEmergencyStopError(
                    f"the control loop of axis {name} is on (R{axis + MODE}, bit 0): switch it off to"
                    " download"
                )

    def _write(self, register: int, word: int) -> None:
        """Write one register until it is read back; raises ImageRejectedError."""
        found = None
        for _ in range(WRITE_TRIES):
            self._line.write(register, word)
            # Read, whatever the write was answered with: an answer may be what was sent and nothing more.
            found = self._line.read(register, 1)[0]
            if found == word:
                return
        raise ImageRejectedError(f"register {register} contains {found} after {word} was written to it")

    def _taken_over(self, axis: int) -> str:
        """Have an axis change its default setups, with the handshake of page 4-36; return what came of it."""
        # A fault that was there already is not the answer to this command.
        before = self._line.read(axis + FAULT, 1)[0]
        # The module acknowledges whatever is there: another program's command would be taken for ours.
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
        """Leave no command behind, also after a stop was asked for."""
        # The stop that ended the wait would end the writing of this register too, and leave the command
        # where it is.
        if isinstance(error, CancelledError):
            self._waiting.begin(QUIET)
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


def _blocks(registers: tuple[int, ...]) -> Iterator[tuple[int, int]]:
    """Yield first register and count of runs that can be read at once."""
    first, count = registers[0], 0
    for register in registers:
        if register != first + count or count == MAX_REGISTERS:
            yield first, count
            first, count = register, 0
        count += 1
    yield first, count
