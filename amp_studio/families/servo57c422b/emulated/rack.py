"""The emulated rack at its line and at the operator's terminal (docs/protocols/registers.md)."""

from __future__ import annotations

import binascii
import re

from amp_studio.schema import quoted
from amp_studio.transfer.emulated import DeviceSetup, EmulatedOptions, serve_device
from amp_studio.transfer.links import Endpoint

from .module import AXES, NAME, REGISTERS, Module

LONGEST = 80  # bytes of a request
MOST = 32  # registers of one answer
COMMANDS = "patch R3=160, show R72, fault BIT X|Y, stop-all, power, status, quit"

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
                self._obey(bytes(self._line).removesuffix(b"\r"))
                self._line.clear()
            elif len(self._line) <= LONGEST:
                self._line.append(byte)

    def advance(self, duration: float) -> None:
        """Let time pass, s."""
        self.module.advance(duration)

    def answer(self) -> bytes:
        """Return what has to be sent."""
        out = bytes(self._out[:512])
        del self._out[:512]
        return out

    def _obey(self, line: bytes) -> None:
        match = _REQUEST.fullmatch(line)
        if match is None or int(match[7], 16) != binascii.crc_hqx(line[:-5], 0xFFFF):
            return
        answer = self._answer(match)
        if answer is not None:
            body = match[1] + b" " + answer.encode("ascii")
            self._out += body + b"*%04X\r\n" % binascii.crc_hqx(body, 0xFFFF)

    def _answer(self, found: re.Match[bytes]) -> str | None:
        if found[2] == b"ID":
            return f"ID {NAME}"
        if found[3] is not None:
            first, count = int(found[3]), int(found[4])
            if not 1 <= count <= MOST or first + count > REGISTERS:
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
        rest = rest.strip()
        if verb == "patch" and (match := re.fullmatch(r"R([0-9]{1,4})\s*=\s*([0-9]{1,5})", rest)):
            register, word = int(match[1]), int(match[2])
            if register < REGISTERS and word <= 0xFFFF:
                self.module.write(register, word)
                return f"R{register} = {self.module.read(register)}"
        if verb == "show" and (match := re.fullmatch(r"R([0-9]{1,4})", rest)) and int(match[1]) < REGISTERS:
            return f"R{match[1]} = {self.module.read(int(match[1]))}"
        if verb == "fault" and (match := re.fullmatch(r"(1?[0-9]) ([XY])", rest)) and int(match[1]) < 16:
            self.module.fault(AXES[match[2]], int(match[1]))
            return f"fault {match[1]} of axis {match[2]}"
        if verb == "stop-all" and not rest:
            self.module.stop_all()
            return "stopped: system fault"
        if verb == "power" and not rest:
            self.module.power_on()
            return "switched off and on: the registers are lost"
        if verb == "status" and not rest:
            words = (
                f"{name} R72={self.module.read(axis + 72):04X}H R73={self.module.read(axis + 73):04X}H"
                for name, axis in AXES.items()
            )
            return "status " + " ".join(words)
        raise ValueError(f"{quoted(line)} is no command: {COMMANDS}")


def emulate_registers(listen: Endpoint, options: EmulatedOptions) -> int:
    """Run an emulated rack until it is asked to quit."""
    return serve_device(listen, options, Rack)
