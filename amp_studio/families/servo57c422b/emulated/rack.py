"""The emulated rack at its line and at the operator's terminal (docs/protocols/registers.md)."""

from __future__ import annotations

import binascii
import re
from collections.abc import Callable

from amp_studio.schema import quoted
from amp_studio.transfer.emulated import DeviceSetup, EmulatedOptions, serve_device
from amp_studio.transfer.links import Endpoint

from .module import AXES, NAME, REGISTERS, Module

_LONGEST = 80  # bytes of a request
_MAX_REGISTERS = 32  # registers of one answer
_COMMANDS = "patch R3=160, show R72, fault BIT X|Y, fault drive X|Y, stop-all, power, status, quit"

_REQUEST = re.compile(
    rb"([0-9]{1,3}) (ID|R ([0-9]{1,4}) ([0-9]{1,2})|W ([0-9]{1,4}) ([0-9]{1,5}))\*([0-9A-F]{4})"
)


class Rack:
    """A rack whose processor answers for the registers of one module."""

    def __init__(self, _setup: DeviceSetup) -> None:
        self.module = Module()
        self._line = bytearray()
        self._out = bytearray()

    # -- the line --------------------------------------------------------------------

    def connected(self) -> None:
        """Begin a new line for another client."""
        self._line.clear()
        self._out.clear()

    def receive(self, data: bytes) -> None:
        """Take bytes; a line that is damaged, too long or none gets no answer."""
        for byte in data:
            if byte == 10:
                self._execute(bytes(self._line).removesuffix(b"\r"))
                self._line.clear()
            # One character too many is kept, so that a line that is too long is no request.
            elif len(self._line) <= _LONGEST:
                self._line.append(byte)

    def advance(self, duration: float) -> None:
        """Let time pass, s."""
        self.module.advance(duration)

    def answer(self) -> bytes:
        """Return what has to be sent."""
        out = bytes(self._out[:512])
        del self._out[:512]
        return out

    def _execute(self, line: bytes) -> None:
        match = _REQUEST.fullmatch(line)
        if match is None or int(match[7], 16) != binascii.crc_hqx(line[:-5], 0xFFFF):
            return
        body = match[1] + b" " + self._answer(match).encode("ascii")
        self._out += body + b"*%04X\r\n" % binascii.crc_hqx(body, 0xFFFF)

    def _answer(self, found: re.Match[bytes]) -> str:
        """Return the answer to a request: its name, registers, or a register as it was written."""
        if found[2] == b"ID":
            return f"ID {NAME}"
        if found[3] is not None:
            first, count = int(found[3]), int(found[4])
            if not 1 <= count <= _MAX_REGISTERS or first + count > REGISTERS:
                return "E there are no such registers"
            return f"R {first} " + " ".join(str(self.module.read(r)) for r in range(first, first + count))
        register, word = int(found[5]), int(found[6])
        if register >= REGISTERS or word > 0xFFFF:
            return "E there is no such register or word"
        self.module.write(register, word)
        return f"W {register} {self.module.read(register)}"

    # -- the operator ----------------------------------------------------------------

    def operate(self, line: str) -> str:
        """Do what the operator asks for; raises ValueError."""
        verb, _, rest = line.partition(" ")
        for pattern, order in _ORDERS.items():
            match = re.fullmatch(pattern, f"{verb} {rest.strip()}".rstrip())
            if match and (answer := order(self, *match.groups())):
                return answer
        raise ValueError(f"{quoted(line)} is no command: {_COMMANDS}")

    # Each order returns its answer; an empty one where there is no such register, word or bit.

    def _patch(self, register: str, word: str) -> str:
        if int(register) >= REGISTERS or int(word) > 0xFFFF:
            return ""
        self.module.write(int(register), int(word))
        return self._show(str(int(register)))

    def _show(self, register: str) -> str:
        return f"R{register} = {self.module.read(int(register))}" if int(register) < REGISTERS else ""

    def _fault(self, bit: str, axis: str) -> str:
        if int(bit) > 15:
            return ""
        self.module.fault(AXES[axis], int(bit))
        return f"fault {bit} of axis {axis}"

    def _trip_drive(self, axis: str) -> str:
        self.module.trip(AXES[axis])
        return f"the drive of axis {axis} has tripped"

    def _stop_all(self) -> str:
        self.module.stop_all()
        return "stopped: system fault"

    def _power(self) -> str:
        self.module.power_on()
        return "switched off and on: the registers are lost"

    def _status(self) -> str:
        words = (
            f"{name} R72={self.module.read(axis + 72):04X}H R73={self.module.read(axis + 73):04X}H"
            for name, axis in AXES.items()
        )
        return "status " + " ".join(words)


_ORDERS: dict[str, Callable[..., str]] = {
    r"patch R([0-9]{1,4})\s*=\s*([0-9]{1,5})": Rack._patch,
    r"show R([0-9]{1,4})": Rack._show,
    r"fault (1?[0-9]) ([XY])": Rack._fault,
    r"fault drive ([XY])": Rack._trip_drive,
    "stop-all": Rack._stop_all,
    "power": Rack._power,
    "status": Rack._status,
}
"""What the operator may ask for; the parts in brackets are the arguments."""


def emulate_registers(listen: Endpoint, options: EmulatedOptions) -> int:
    """Run an emulated rack until it is asked to quit."""
    return serve_device(listen, options, Rack)
