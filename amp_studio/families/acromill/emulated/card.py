"""An emulated ACR card behind its terminal: a prompt, an echo of every character,
a line obeyed at its end (page 91).

What the guide does not show is marked "assumed" here and in docs/protocols/acr-terminal.md.
"""

from __future__ import annotations

import re
from pathlib import Path

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import visible
from amp_studio.transfer.emulated import DeviceSetup, EmulatedOptions, serve_device
from amp_studio.transfer.links import Endpoint

from .card_motion import WORDS, CardMotion, set_up_figures
from .settings import COMMANDS_LISTED, CardSettings, CommandError

_BANNER = ("ACR8000 (c) 1993-1998 by AMCS Inc.", "Version 1.17.08 CARD 0")
_LONGEST = 128  # characters of a line; more are neither taken nor echoed (assumed)
PIECE = 256
FILE = "file"
"""Option: the parameter file that card and AcroMill on the PC were set up from."""
BACKSPACE, DELETE, RETURN = 0x08, 0x7F, 0x0D
_COMMANDS = "power, patch COMMAND, echo on|off, home AXES, mdi G28 X1, stop, fault drive X, status, quit"
_LISTED = {"VER": (*_BANNER,), "HELP": (*_BANNER, f"Commands: {COMMANDS_LISTED}")}
"""What the card lists of itself."""
_LIVE = re.compile(r"(?:PRINT\s+|\?\s*)(P|BIT)\s*([0-9]{1,5})\s*", re.IGNORECASE)


class AcrCard:
    """The card's side of the line. Half a line that a client has left is still there for the next one."""

    def __init__(self, setup: DeviceSetup) -> None:
        named = setup.hardware.get(FILE)
        file = None if named is None else _set_up_file(Path(named), setup.family)
        delivered = CardSettings(setup.memory)
        set_up = {} if file is None else set_up_figures(file, delivered.values)
        self.settings = CardSettings(setup.memory, set_up)
        self.motion = CardMotion(self.settings, file)
        self._out = bytearray()
        self._line = bytearray()
        self._program = 0
        self._echoes = True

    def connected(self) -> None:
        """A terminal line has no connections: the card sends nothing, and keeps what it has of a line."""
        self._out.clear()

    def advance(self, duration: float) -> None:
        """Let time pass, s: the axes move."""
        self.motion.advance(duration)

    def answer(self) -> bytes:
        """Return the next characters to be sent."""
        piece = bytes(self._out[:PIECE])
        del self._out[:PIECE]
        return piece

    def receive(self, data: bytes) -> None:
        """Take characters as they are typed."""
        for byte in data:
            if byte == RETURN:
                self._execute()
            elif byte in (BACKSPACE, DELETE):  # assumed
                if self._line:
                    self._line.pop()
                    self._echo(b"\b \b")
            elif 0x20 <= byte < 0x7F and len(self._line) < _LONGEST:
                self._line.append(byte)
                self._echo(bytes((byte,)))

    def _echo(self, characters: bytes) -> None:
        if self._echoes:
            self._out += characters

    def _execute(self) -> None:
        """Answer the line that was typed, and begin the next one with the prompt of the program."""
        line, self._line = self._line.decode("ascii"), bytearray()
        self._echo(b"\r\n")
        try:
            rows = self._done(line)
        except CommandError as error:
            rows = [str(error)]
        except OSError as error:
            rows = [f"EEPROM failure ({error.strerror})"]
        for row in rows:
            self._out += row.encode("ascii", "replace") + b"\r\n"
        self._out += f"P{self._program:02d}>".encode()

    def _done(self, line: str) -> list[str]:
        """Obey a line; ESAVE, ELOAD, ERASE, VER and HELP are words of the list of page 91,
        and what they do is assumed.
        """
        words = line.strip().upper()
        of_memory = {"ESAVE": self.settings.save, "ELOAD": self.settings.load, "ERASE": self.settings.erase}
        if words in of_memory:
            of_memory[words]()
            return []
        if words in _LISTED:
            return list(_LISTED[words])
        if words == "ECHO":
            return ["ON" if self._echoes else "OFF"]
        if match := re.fullmatch("PROG([0-9])", words):
            self._program = int(match[1])
            return []
        if words.partition(" ")[0] in WORDS:
            return self.motion.execute(*words.partition(" ")[::2])
        if (match := _LIVE.fullmatch(words)) and (live := self._live(match)):
            return [live]
        return self.settings.execute(line)

    def _live(self, match: re.Match[str]) -> str:
        """Return a system parameter or a bit as it is now;
        "" for one that is none (-1 for a set bit is assumed).
        """
        number = int(match[2])
        if match[1] == "BIT":
            bit = self.motion.bit(number)
            return "" if bit is None else "-1" if bit else "0"
        value = self.motion.parameter(number)
        return "" if value is None else f"{value:.10g}".upper()

    def operate(self, line: str) -> str:
        """Do what the operator asks for: ``power`` goes off and on,
        ``patch`` is a command from another terminal.
        """
        verb, _, rest = line.partition(" ")
        match verb, rest:
            case "power", "":
                self.settings.load()
                self.settings.variables.clear()
                self.motion.switch_off()
                self._line.clear()
                self._out.clear()
                self._program = 0
            case "echo", "on" | "off":
                self._echoes = rest == "on"
            case "patch", _ if rest:
                return visible("; ".join(self.settings.execute(rest)) or line)
            case "home", _:
                return self.motion.home(rest.replace(",", "").replace(" ", ""))
            case "mdi", _ if rest:
                return self.motion.mdi(rest)
            case "stop", "":
                self.motion.stop()
            case "fault", _ if re.fullmatch(r"drive [A-Z]", rest):
                self.motion.trip(rest[-1])
            case "status", "":
                return f"P{self._program:02d} {len(self._line)} characters of a line; {self.motion.status()}"
            case _:
                raise ValueError(f"no command: {_COMMANDS}")
        return visible(line)


def _set_up_file(path: Path, family: str) -> ParameterFile:
    """Return the file that a card is set up from; raises ValueError for one of another family."""
    file = open_file(path).file
    if file.schema.family.family != family:
        raise ValueError(f"{path.name} is a file of {file.schema.family.name}, not of {family}")
    return file


def emulate_terminal(place: Endpoint, options: EmulatedOptions) -> int:
    """Run an emulated card until asked to quit."""
    return serve_device(place, options, AcrCard, takes=(FILE,))
