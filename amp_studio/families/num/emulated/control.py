"""An emulated NUM control in utility 5: a person at its keys loads, unloads and checks the parameter table.

Written from sections 13.2.1 to 13.2.6 of the NUM parameter manual (pages 13-3 to 13-14). What these pages
leave open is marked "assumed" here and in docs/protocols/num-table.md.
"""

from __future__ import annotations

import re
from typing import Literal, cast

from amp_studio.families.num.lines.content import KIND, NumTableContent
from amp_studio.files import ParameterFile
from amp_studio.transfer import ControlStatus
from amp_studio.transfer.emulated import DeviceSetup, EmulatedOptions, serve_device
from amp_studio.transfer.links import Endpoint, Parity

from .delivered import delivered_table
from .manual_keys import VERBS, NumKeys
from .parameter_memory import ParameterMemory, TableError, TableHeader, content_of

XON, XOFF = 0x11, 0x13
_MENU = "MACHINE SETUP DATA"
READY = "READY?"
FILE_ERROR = "FILE ERROR (INCORRECT TAPE?)"
_LONGEST = 256  # bytes of a line of a table; its length has two hexadecimal digits
_LINES_A_STOP = 40  # lines after which the control stops the peripheral to work on them (assumed)
BUFFER = 4_096  # bytes it still takes after it has stopped the peripheral; more are lost (assumed)
PIECE = 128  # bytes it sends in one turn

Doing = Literal["menu", "ready", "asking", "reading", "held", "sending"]
Job = Literal["load", "unload", "verify"]
_COMMANDS = (
    "load, unload, verify, enter, start, reference NNNNNNNN, comment TEXT, exit, parity none|even|odd, line"
    f" BAUD STOP, patch P9N0=FF, reset, status, quit, {NumKeys.words}"
)


class NumControl:
    """The CNC's side of the line, with the keys that a person presses as commands."""

    def __init__(self, setup: DeviceSetup) -> None:
        self._say = setup.say
        self._parameters = ParameterMemory(setup.memory, delivered_table(setup.family))
        self._keys = NumKeys(lambda: b"".join(self._parameters.lines()), _file_of)
        self._doing: Doing = "menu"
        self._job: Job = "load"
        self._parity: Parity = "even"
        """Of the eighth bit. Page 9-20 gives the Xoff of the ISO code as 93, which is 13 with even parity."""
        self._start = ""
        """The first line of an unload, as the operator left it."""
        self._out = bytearray()
        self._later = bytearray()
        """Bytes that came while the peripheral was stopped."""
        self._line = bytearray()
        self._has_begun = False
        self._lines = 0
        self._header: TableHeader | None = None
        self._is_stopped = False
        """Whether the control has stopped the peripheral with Xoff."""
        self._is_paused = False
        """Whether the peripheral has stopped the control."""

        self._baud, self._stop = 0, 1
        """How its line is set: rate (0 for the client's) and stop bits."""
        self._fits = True
        """Whether the client's end is set so that its characters are understood."""

    # -- the line ---------------------------------------------------------------------------------

    def connected(self) -> None:
        """A serial line has no connections: what is under way goes on."""

    def advance(self, duration: float) -> None:
        """Let time pass, s: the axes move."""
        self._keys.advance(duration)

    def screen(self) -> ControlStatus:
        """Return what its screen shows: the menu it is in, and its axes."""
        return self._keys.screen(self._doing)

    def line_set(self, baud: int, stop: int) -> None:
        """Compare how the client has set its end: another rate, or fewer stop bits than are awaited,
        make no characters.
        """
        self._fits = self._baud in (0, baud) and stop >= self._stop

    def answer(self) -> bytes:
        """Return the next piece of an unload, Xon and Xoff."""
        if self._is_stopped and self._doing == "reading":
            self._resume()
        if self._is_paused and self._doing == "sending":
            return b""
        piece = bytes(self._out[:PIECE])
        del self._out[:PIECE]
        if self._doing == "sending" and not self._out:
            self._to_menu()
        return bytes(self._with_parity(byte) for byte in piece)

    def receive(self, data: bytes) -> None:
        """Take bytes of the peripheral; outside a load or a check they are not read."""
        if self._doing == "sending":
            for byte in data:
                self._is_paused = {XOFF: True, XON: False}.get(byte & 0x7F, self._is_paused)
            return
        for n, byte in enumerate(data):
            if not self._takes():
                self._keep_for_later(data[n:])
                return
            self._read(byte)

    def _takes(self) -> bool:
        return self._doing == "reading" and not self._is_stopped

    def _keep_for_later(self, data: bytes) -> None:
        """Keep what came while the peripheral was stopped, as far as there is room;
        outside a load it is not read.
        """
        if self._doing in ("reading", "held"):
            self._later += data[: BUFFER - len(self._later)]

    def _read(self, byte: int) -> None:
        """Take one byte of a table; a wrong one ends the reading."""
        if not self._fits:
            self._fail("a character without its stop bits, or of another rate")
            return
        if self._parity != "none" and self._with_parity(byte & 0x7F) != byte:
            self._fail("a character with a parity error")
            return
        character = byte & 0x7F if self._parity != "none" else byte
        if not self._has_begun:
            self._has_begun = character == ord("%")  # what comes before the table is its leader (assumed)
            if not self._has_begun:
                return
        if character == XOFF:
            self._end()
        elif character == ord("\n"):
            self._whole_line()
        elif character != ord("\r") or self._line.endswith(b"\r"):
            self._line.append(character)
            # Three more for ";" and the two digits of the length.
            if len(self._line) > _LONGEST + 3:
                self._fail("a line without an end")

    def _end(self) -> None:
        """Xoff: the end of the table."""
        if self._line or self._header is not None:
            self._fail("the table ends within a line")
            return
        if self._job == "load":
            self._parameters.settle()
        self._to_menu()

    def _whole_line(self) -> None:
        """Read a line of the table, and stop the sender for a while after some of them."""
        line, self._line = bytes(self._line), bytearray()
        self._lines += 1
        try:
            text = content_of(line)
            if self._lines == 1:
                self._first(text)
            elif text.startswith("#"):
                self._data(text[1:])
            elif self._header is not None:
                raise TableError(f"{self._header.spelled} without its data line")
            else:
                self._header = self._parameters.header(text)
        except TableError as error:
            self._fail(str(error))
            return
        except OSError as error:
            self._fail(f"the memory takes nothing more: {error.strerror}")
            return
        if self._doing == "reading" and self._lines % _LINES_A_STOP == 0:
            self._stop_peripheral()

    def _first(self, text: str) -> None:
        if not re.fullmatch("%[0-9]{8}(?![0-9]).*", text):
            raise TableError("the table does not begin with % and eight digits")
        if self._job == "load" and text[1:9] != self._parameters.job_reference:
            # Page 13-10: transmission is stopped, the identification number is on the dialogue line.
            self._doing = "held"
            self._stop_peripheral()
            self._say(f"dialogue line: {text[:9]}")

    def _data(self, text: str) -> None:
        """Load or verify the words below a header; raises TableError."""
        header, self._header = self._header, None
        if header is None:
            raise TableError("a data line without a header")
        words = self._parameters.split(header, text)
        if self._job == "load":
            self._parameters.load(header, words)
            return
        # Page 13-13: the parameters are listed by increasing order.
        if header.first == 0:
            self._say(f"(VERI) P{header.parameter}")
        fault = self._parameters.fault_of(header, words)
        different = None if fault else self._parameters.differs(header, words)
        if fault or different is not None:
            raise TableError(fault or f"P{header.parameter}N{different} differs")

    def _fail(self, what: str) -> None:
        """Stop on a fault, as a check does (page 13-13); that a load does the same is assumed."""
        self._stop_peripheral()
        at = f"P{self._header.parameter}" if self._header else f"line {self._lines + bool(self._line)}"
        self._to_menu(silent=True)
        self._say(f"dialogue line: {FILE_ERROR}  [{at}: {what}]")

    def _stop_peripheral(self) -> None:
        self._is_stopped = True
        self._out.append(XOFF)

    def _resume(self) -> None:
        """Have the peripheral go on, and read what has come meanwhile."""
        self._is_stopped = False
        self._out.append(XON)
        later, self._later = bytes(self._later), bytearray()
        self.receive(later)

    def _with_parity(self, byte: int) -> int:
        if self._parity == "none":
            return byte
        odd = (byte & 0x7F).bit_count() % 2 == 1
        return (byte & 0x7F) | (0x80 if odd == (self._parity == "even") else 0)

    # -- the keys ---------------------------------------------------------------------------------

    def operate(self, line: str) -> str:
        """Press a key of the control, or set what its maker's menus set; returns what its screen shows."""
        verb, _, rest = line.partition(" ")
        if verb in VERBS:
            return self._keys.operate(verb, rest)
        match verb:
            case "load" | "unload" | "verify" if not rest:
                return self._select(verb)
            case "enter" if not rest:
                return self._enter()
            case "start" if not rest and self._doing == "asking":
                return self._unload()
            case "exit" | "reset" if not rest:
                self._to_menu(silent=True)
                return _MENU
            case "status" if not rest:
                return (
                    f"{self._doing} {self._job} job reference {self._parameters.job_reference} parity"
                    f" {self._parity}"
                )
        return self._set_up(line, verb, rest)

    def _set_up(self, line: str, verb: str, rest: str) -> str:
        """Set what the menus of the control's maker set."""
        match verb:
            case "reference" if re.fullmatch("[0-9]{8}", rest):
                return self._reference(rest)
            case "comment" if rest.isascii() and rest.isprintable() and self._doing == "asking":
                self._start = f"{self._start[:9]} {rest}"[: _LONGEST - 1]
                return f"dialogue line: {self._start}"
            case "parity" if rest in ("none", "even", "odd"):
                self._parity = cast("Parity", rest)
                return line
            case "line" if found := re.fullmatch("([0-9]{1,6}) ([12])", rest):
                self._baud, self._stop = int(found[1]), int(found[2])
                return line
            case "patch" if found := re.fullmatch(r"P([0-9]{1,4})N([0-9]{1,4})=(.*)", rest):
                return self._patch(int(found[1]), int(found[2]), found[3])
        raise ValueError(f"not possible now, or no command: {_COMMANDS}")

    def _select(self, job: Job) -> str:
        if self._doing != "menu":
            raise ValueError(f"the control is not in the {_MENU} menu (exit)")
        self._job, self._doing = job, "ready"
        return f"dialogue line: {READY}"

    def _enter(self) -> str:
        """Begin the job that the menu has chosen; returns what the screen shows."""
        if self._doing != "ready":
            raise ValueError("there is nothing to enter")
        if self._job == "unload":
            self._doing, self._start = "asking", f"%{self._parameters.job_reference}"
            return f"dialogue line: {self._start}"
        self._doing, self._has_begun, self._lines = "reading", False, 0
        self._line.clear()
        self._out.append(XON)  # assumed: Xon shows the peripheral that it may send
        return "(reading)"

    def _unload(self) -> str:
        self._out += b"".join(self._parameters.lines(self._start)) + bytes((XOFF,))
        self._doing, self._is_paused = "sending", False
        return "(sending)"

    def _reference(self, number: str) -> str:
        """Edit the job reference: of the table while it stops a load, of the table to be unloaded."""
        if self._doing == "asking":
            self._start = f"%{number}{self._start[9:]}"
            return f"dialogue line: {self._start}"
        if self._doing != "held":
            raise ValueError("nothing asks for a job reference")
        if number != self._parameters.job_reference:
            return f"dialogue line: %{number}"
        self._doing = "reading"  # page 13-10: transmission is resumed
        return "(reading)"

    def _patch(self, parameter: int, word: int, text: str) -> str:
        """Set one word as an operator does in the menu; returns it as the control then has it."""
        if self._doing != "menu":
            raise ValueError(f"the control is not in the {_MENU} menu (exit)")
        words = self._parameters.words.get(parameter, [])
        if word >= len(words):
            raise ValueError(f"there is no P{parameter}N{word}")
        header = self._parameters.header(
            f"P{parameter}N{word}:t{self._parameters.types[parameter]}n{len(words)}"
        )
        self._parameters.take(header, [text])
        self._parameters.settle()
        return f"P{parameter}N{word} {self._parameters.words[parameter][word]}"

    def _to_menu(self, *, silent: bool = False) -> None:
        """Return to the menu; what was half read is forgotten."""
        self._doing, self._header, self._is_stopped = "menu", None, False
        self._line.clear()
        self._later.clear()
        if self._job == "unload":
            self._out.clear()
        if not silent:
            self._say(_MENU)


def _file_of(content: bytes) -> ParameterFile:
    """Return what the control has unloaded as a file; raises ImageError."""
    return NumTableContent().decode(f"{KIND}\n".encode() + content + bytes((XOFF,)))


def emulate_peripheral(place: Endpoint, options: EmulatedOptions) -> int:
    """Run an emulated control that speaks to a peripheral until asked to quit."""
    return serve_device(place, options, NumControl)
