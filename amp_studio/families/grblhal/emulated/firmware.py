"""What the firmware does with the bytes of its line: protocol.c and system.c of the grblHAL core,
Grbl 1.1 likewise.

Its memory is written after the answer to a setting, when the next byte or nothing comes (nvs_buffer.c): who
cuts the power between the two begins with the defaults.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Callable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from typing import Any

from amp_studio.sim import SimulationError
from amp_studio.transfer.emulated import DeviceSetup

from .motion import GrblMotion, MotionBlock
from .reports import FirmwareReports
from .stored_settings import OUT_OF_RANGE, RefusedError, StoredSettings

MEMORY = "settings"
_LINE, _CLASSIC_LINE = 256, 80
"""Characters of the longest line."""
PIECE = 512
_OFFSETS = ("G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3")
_POSITIONS = ("G28", "G30", "G92")
_UNKNOWN, _NOT_IDLE, _LOCKED, _TOO_LONG, _NO_HOMING, _BAD_WORD = 3, 8, 9, 11, 5, 20
_TRAVEL_EXCEEDED, _BAD_JOG, _NO_FEED = 15, 16, 22
_CRITICAL = 79
_RESET = "[MSG:Reset to continue]"
_CRITICAL_ALARMS = {
    1: _RESET,
    2: _RESET,
    10: "[MSG:Emergency stop - clear, then reset to continue]",
    17: "[MSG:Motor fault - clear, then reset to continue]",
}
"""Alarms that only a reset ends (alarms.h ``alarm_is_critical``), and what follows them."""
_SOFT_RESET = 0x18
_JOG_CANCEL = 0x85
_MOVING = ("Run", "Jog", "Home")
_STATES = ("Idle", "Run", "Hold:0", "Door:0", "Alarm", "Check")
_SUSPENDED = ("Hold:0", "Door:0")  # no line is read (protocol.c ``protocol_exec_rt_suspend``)


_NUMBER = r"-?(?:\d+\.?\d*|\.\d+)"
_WORDS = re.compile(rf"([A-FH-Z])({_NUMBER})")
_BLOCK = re.compile(rf"(?:[A-Z]{_NUMBER})*")
_NO_MOTION = {4.0, 10.0, 28.0, 28.1, 30.0, 30.1, 92.0}
"""Of a block whose axis words are no straight move here."""


class _AnswerLater(Exception):
    """A line that is not answered now."""


class Firmware:
    """A control with its memory. ``power_cycle`` takes its power away and gives it back.

    ``is_writing`` is whether an answer is out and the memory not yet written.
    """

    def __init__(self, setup: DeviceSetup, axes: str = "XYZ") -> None:
        self._memory, self._say = setup.memory, setup.say
        self.settings = StoredSettings(setup.machine, axes)
        self._axes = axes if not self.settings.is_classic else "XYZ"
        self.is_writing = False
        self.state = "Idle"
        self._out = bytearray()
        self._is_moved = False  # whether the machine moved at the last look
        self._is_critical = False  # an alarm that only a reset ends
        self._motion = GrblMotion(self.settings, self._axes)
        self._boot()

    # -- power ---------------------------------------------------------------------------------------

    def _boot(self) -> None:
        """Start as after power: with what is stored, or with the defaults and error 7 where nothing is."""
        self._line, self._overflows, self._ignores_settings, self._last_end = "", False, False, ""
        self._is_critical = False
        self._unit = 21
        self._refusal = 0
        self._distance, self._mode, self._feed = 90, 0, 0.0
        self._motion.switch_off()
        self._unread: list[str] = []
        self.state = "Idle" if self.state not in ("Run", *_SUSPENDED) else "Alarm"
        zeros = ",".join(["0.000"] * len(self._axes))
        self.offsets = dict.fromkeys(
            (*(_OFFSETS[:6] if self.settings.is_classic else _OFFSETS), *_POSITIONS), zeros
        )
        self.startup = {0: "", 1: ""}
        self.build = ""
        self.settings.load(self.settings.defaults)
        stored = self._stored()
        if stored is None:
            self._send("error:7")
            self._save()
        else:
            self.settings.load({int(n): v for n, v in stored["settings"].items()})
            self.offsets |= stored["offsets"]
            self.startup |= {int(n): line for n, line in stored["startup"].items()}
            self.build = stored["build"]
        self.is_writing = False
        self._greet()

    def _stored(self) -> dict[str, Any] | None:
        """Return what the memory contains; None where its checksum is wrong."""
        checksum, _, content = (self._memory.read(MEMORY) or b"").partition(b"\n")
        if checksum != _checksum(content):
            return None
        found: dict[str, Any] = json.loads(content)
        return found

    def _save(self) -> None:
        """Store settings, offsets and startup lines, as a board does in its EEPROM."""
        content = json.dumps(
            {
                "settings": self.settings.values(),
                "offsets": self.offsets,
                "startup": self.startup,
                "build": self.build,
            }
        ).encode()
        self._memory.replace(MEMORY, _checksum(content) + b"\n" + content)
        self.is_writing = False

    def power_cycle(self) -> None:
        """Cut the power: while the memory is being written all of it is lost."""
        if self.is_writing:
            # A memory that is half written has a wrong checksum: the next start begins with the defaults.
            self._memory.replace(MEMORY, b"")
        self._out.clear()
        self._boot()

    def _greet(self) -> None:
        name = (
            "Grbl 1.1h ['$' for help]"
            if self.settings.is_classic
            else "GrblHAL 1.1f ['$' or '$HELP' for help]"
        )
        self._send("", name)

    # -- the line ------------------------------------------------------------------------------------

    def connected(self) -> None:
        """A client has come: nothing happens, half a line of another one stays."""

    def answer(self) -> bytes:
        """Return what is to be sent; once nothing is, the memory is written."""
        data = bytes(self._out[:PIECE])
        del self._out[:PIECE]
        if not data and self.is_writing:
            self._save()
        return data

    def receive(self, data: bytes) -> None:
        """Take bytes of a client."""
        for byte in data:
            self._receive_byte(byte)

    def _receive_byte(self, byte: int) -> None:
        """Take one byte: a real-time command, the end of a line, or a character of it."""
        character = chr(byte)
        if byte == _SOFT_RESET:
            self._soft_reset()
        elif self._is_critical and self.settings.is_classic:
            return  # a Grbl 1.1 does nothing, not even a report, and forgets its line (protocol.c)
        elif byte == _JOG_CANCEL:
            self._cancel_jog()
        elif character in "?!~" and not self._line.startswith("$"):
            self._real_time(character)
        elif character in "\r\n":
            self._end_line(character)
        else:
            self._edit_line(byte)

    def _cancel_jog(self) -> None:
        """End a jog where the axes are; nothing while none is under way."""
        if self._motion.state == "Jog":
            self._motion.cancel()
            self.state = "Idle"

    def _edit_line(self, byte: int) -> None:
        """Add a character to the line, or take the last one back."""
        if byte in (0x7F, 0x08) and not self.settings.is_classic:
            self._line = self._line[:-1]
        elif byte > (0x1F if self._line else 0x20) and byte < 0x80:  # no blank at its beginning
            limit = _CLASSIC_LINE if self.settings.is_classic else _LINE
            # The buffer of the firmware has room for the line and the zero at its end.
            self._overflows = self._overflows or len(self._line) >= limit - 1
            self._line = (self._line + chr(byte))[: limit - 1]

    def _soft_reset(self) -> None:
        """Start again as Ctrl-X does, in the middle of whatever is under way."""
        self._line, self._ignores_settings = "", True  # this build takes no setting after a soft reset
        self._is_critical = False
        was = self._motion.state
        if self._motion.cancel():  # motion_control.c ``mc_reset``: the position may be lost
            self.state, self._unread = "Alarm", []
            self._send("ALARM:6" if was == "Home" else "ALARM:3")
        self._greet()

    def _real_time(self, command: str) -> None:
        """Do a command that acts at once, whatever line is under way: report, feed hold or cycle start."""
        if command == "?":
            self._send(self._status())
        elif command == "!" and self._motion.state in ("Run", "Jog"):
            self._motion.pause()
            self.state = "Hold:0"
        elif command == "~" and self.state == "Hold:0":
            self._motion.resume()
            self.state, unread, self._unread = self._motion.state, self._unread, []
            for line in unread:
                self._answer_line(line)

    def _end_line(self, end: str) -> None:
        """Answer the line that has come, or keep it while no line is read."""
        # The second character of CR LF ends no line; two equal ones end an empty one.
        if not self._line and self._last_end not in ("", end):
            self._last_end = ""
            return
        self._last_end = end
        line, self._line = self._line, ""
        if self.state in (*_SUSPENDED, "Home"):
            self._unread.append(line)
            return
        if self.is_writing:
            self._save()
        self._answer_line(line)

    def _answer_line(self, line: str) -> None:
        """Answer a line with ok or error; some answers come later."""
        overflows, self._overflows = self._overflows, False
        try:
            if overflows:
                raise RefusedError(_TOO_LONG)
            if self._ignores_settings and re.match(r"\$\d+=", line):
                return
            self._execute(line)
        except _AnswerLater:
            pass
        except RefusedError as refused:
            self._refusal = refused.code
            self._send(f"error:{refused.code}")
        else:
            self._refusal = 0
            self._send("ok")

    def _send(self, *lines: str) -> None:
        self._out += "".join(f"{line}\r\n" for line in lines).encode()

    # -- commands ------------------------------------------------------------------------------------

    def _execute(self, line: str) -> None:
        if line == "$":
            self._send("[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]")
            return
        if line.startswith("$"):
            self._system(line)
        elif line:
            # After a refusal no G-code is executed until a line is taken (protocol.c ``protocol_main_loop``).
            if self._refusal and not self.settings.is_classic:
                raise RefusedError(self._refusal)
            self._block(line.upper().replace(" ", ""))

    def _system(self, line: str) -> None:
        """Do a line that begins with ``$``; raises RefusedError."""
        name, equals, text = line[1:].partition("=")
        name = name.replace(" ", "").upper()
        if match := re.fullmatch(r"N(\d)", name):
            self._startup(int(match[1]), text)
        elif name == "X":
            if self._is_critical:
                raise RefusedError(_CRITICAL)
            self.state = "Idle"
        elif name.startswith("H"):
            self._home(name[1:])
        elif equals:
            self._assign(name, text)
        else:
            self._report(name)

    def _assign(self, name: str, text: str) -> None:
        """Do a line ``$name=text``."""
        if name.isdigit():
            self._need_rest()
            self.settings.store(int(name), text)
            # In check mode it stays in RAM (protocol.c ``protocol_execute_realtime``); a Grbl 1.1 writes at
            # once.
            self.is_writing = self.state != "Check" or self.settings.is_classic
        elif name == "RST":
            self._reset(text)
        elif name == "J":
            self._jog(text.upper().replace(" ", ""))
        else:
            raise RefusedError(_UNKNOWN)

    def _report(self, name: str) -> None:
        """Send a report, or one setting by its number."""
        if report := self._reports().get(name):
            if name in ("$", "+", "I"):
                self._need_rest()
            self._send(*report())
            return
        if not name.isdigit() or self.settings.is_classic:
            raise RefusedError(_UNKNOWN)
        setting = self.settings.named(int(name))
        if setting is None:
            raise RefusedError(53)
        self._send(f"${setting.number}={setting.show()}")

    def _home(self, axes: str) -> None:
        """Home all axes, or one where $22 allows it; the answer comes at its end (system.c ``home``)."""
        cycle = int(self.settings.all[22].value)
        if not cycle & 1 or (axes and not cycle & 2):
            raise RefusedError(_NO_HOMING)
        self._need_rest()
        try:
            self._motion.home(axes or self._axes)
        except SimulationError:
            raise RefusedError(_NO_HOMING) from None
        self.state = "Home"
        raise _AnswerLater

    def _jog(self, text: str) -> None:
        """Move by a jog, which changes no mode (gcode.c)."""
        if not _BLOCK.fullmatch(text):
            raise RefusedError(_BAD_WORD)
        words = dict(_WORDS.findall(text))
        if "F" not in words:
            raise RefusedError(_NO_FEED)
        if not set(words) & set(self._axes) or self.state not in ("Idle", "Jog"):
            raise RefusedError(_BAD_JOG if self.state in ("Idle", "Jog") else _NOT_IDLE)
        distance = 91 if "G91" in text else 90 if "G90" in text else self._distance
        targets = self._targets(words, distance, is_machine="G53" in text)
        if self._motion.leaves_travel(targets):
            raise RefusedError(_TRAVEL_EXCEEDED)
        self._move(targets, float(words["F"]) * self._factor(text), is_jog=True)

    def _move(self, targets: dict[str, float], feed: float | None, *, is_jog: bool = False) -> None:
        try:
            self._motion.add(MotionBlock(targets, None if feed is None else feed / 60.0, is_jog))
        except SimulationError:
            return  # no steps, no rate: nothing moves
        self.state = self._motion.state

    def _targets(self, words: dict[str, str], distance: int, *, is_machine: bool) -> dict[str, float]:
        """Return where a block ends, in machine coordinates."""
        offsets = dict(zip(self._axes, map(float, self.offsets["G54"].split(",")), strict=True))
        factor, found = 25.4 if self._unit == 20 else 1.0, {}
        for axis in self._axes:
            if axis in words:
                way = float(words[axis]) * factor
                start = self._motion.planned[axis] if distance == 91 else 0.0 if is_machine else offsets[axis]
                found[axis] = start + way
        return found

    def _factor(self, text: str) -> float:
        return 25.4 if "G20" in text or (self._unit == 20 and "G21" not in text) else 1.0

    def advance(self, duration: float) -> None:
        """Let time pass, s: the machine moves."""
        ended = self._motion.advance(duration)
        if ended is not None:
            self.state = "Alarm" if ended else "Idle"
            self._send(*([ended, "error:9"] if ended else ["ok"]))
            unread, self._unread = self._unread, []
            for line in unread:
                self._answer_line(line)
        elif self.state in ("Run", "Jog") and self._is_moved:
            self.state = self._motion.state
        self._is_moved = self._motion.state in _MOVING

    def _status(self) -> str:
        places = ",".join(f"{place:.3f}" for place in self._motion.positions)
        homed = (
            f"|H:{int(bool(self._motion.homed))}"
            if self.settings.all[22].value and not self.settings.is_classic
            else ""
        )
        return f"<{self.state}|MPos:{places}|FS:{self._motion.feed:.0f},0{homed}>"

    def _need_rest(self) -> None:
        if self.state in _MOVING:
            raise RefusedError(_NOT_IDLE)

    def _startup(self, number: int, line: str) -> None:
        """Store a start-up line, which is executed first (``set_startup_line``)."""
        self._need_rest()
        if number not in self.startup:
            raise RefusedError(_UNKNOWN)
        line = line.upper().replace(" ", "")
        if line:
            self._block(line)
        self.startup[number] = line
        self.is_writing = True

    def _reset(self, what: str) -> None:
        if what not in ("$", "#", "*", "&"):
            raise RefusedError(_UNKNOWN)
        self._memory.replace(MEMORY, b"")
        self._boot()
        self._ignores_settings = True

    def _block(self, line: str) -> None:
        """Execute a block of G-code, of which only units and offsets matter here."""
        if self.state == "Alarm":
            raise RefusedError(_LOCKED)
        if match := re.match(r"G(20|21)", line):
            self._unit = int(match[1])
            line = line[3:]
        match = re.fullmatch(rf"G10L2P([1-9])({_BLOCK.pattern})", line)
        if match is None:
            if not _BLOCK.fullmatch(line):
                raise RefusedError(_BAD_WORD)
            self._words(line)
            return
        name = _OFFSETS[int(match[1]) - 1]
        if name not in self.offsets:
            raise RefusedError(OUT_OF_RANGE)
        at = dict(zip(self._axes, map(float, self.offsets[name].split(",")), strict=True))
        for axis, number in re.findall(rf"([A-Z])({_NUMBER})", match[2]):
            if axis not in at:
                raise RefusedError(_BAD_WORD)
            at[axis] = float(number) * (25.4 if self._unit == 20 else 1.0)
        self.offsets[name] = ",".join(f"{value:.3f}" for value in at.values())
        self.is_writing = True

    def _words(self, line: str) -> None:
        """Do the words of a block that move: G0, G1, G53, G90, G91, F, axes."""
        codes = {float(code) for code in re.findall(rf"G({_NUMBER})", line)}
        words = dict(_WORDS.findall(line))
        self._select(codes)
        if "F" in words:
            self._feed = float(words["F"]) * (25.4 if self._unit == 20 else 1.0)
        targets = self._targets(words, self._distance, is_machine=53.0 in codes)
        if not targets or codes & _NO_MOTION:
            return
        if self._mode == 1 and not self._feed:
            raise RefusedError(_NO_FEED)
        if self._motion.leaves_travel(targets):
            self._motion.cancel()
            self._alarm(2)
            raise _AnswerLater
        if self.state != "Check":
            self._move(targets, self._feed if self._mode == 1 else None)

    def _select(self, codes: AbstractSet[float]) -> None:
        """Keep the modes that the codes of a block choose: G90 or G91, G0 or G1."""
        self._distance = int(next((code for code in (91.0, 90.0) if code in codes), self._distance))
        self._mode = int(next((code for code in (0.0, 1.0) if code in codes), self._mode))

    def _alarm(self, number: int) -> None:
        """Stop in an alarm; a critical one is ended by a reset alone (protocol.c
        ``protocol_exec_rt_system``).
        """
        self.state = "Alarm"
        self._send(f"ALARM:{number}")
        self._is_critical = number in _CRITICAL_ALARMS
        if self._is_critical:
            self._send(_CRITICAL_ALARMS[number])

    def _reports(self) -> Mapping[str, Callable[[], Iterator[str]]]:
        return FirmwareReports(
            self.settings, self._axes, self.offsets, self.startup, self.build, self._unit
        ).by_name()

    # -- the operator --------------------------------------------------------------------------------

    def operate(self, line: str) -> str:
        """Do what the operator asks for: ``state Run``, ``alarm 1``, ``message TEXT``, ``power``,
        ``status``.
        """
        verb, _, rest = line.partition(" ")
        match verb, rest:
            case "state", _ if rest in _STATES:
                self.state = rest
            case "alarm", _ if re.fullmatch(r"\d{1,2}", rest):
                self._motion.halt()
                self._alarm(int(rest))
            case "message", _ if rest.isprintable():
                self._send(f"[MSG:{rest}]")
            case "power", "":
                self.power_cycle()
            case "status", "":
                return f"status {self.state} settings={len(list(self.settings.available()))}"
            case _:
                states = "|".join(_STATES)
                raise ValueError(f"commands are state {states}, alarm N, message TEXT, power, status, quit")
        return line


def _checksum(content: bytes) -> bytes:
    return hashlib.sha256(content).hexdigest().encode()
