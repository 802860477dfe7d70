"""What the firmware does with the bytes of its line: protocol.c, system.c and report.c of the grblHAL core, Grbl 1.1 likewise.

Its memory is written after the answer to a setting, when the next byte or nothing comes (nvs_buffer.c): who cuts the power
between the two begins with the defaults.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections.abc import Callable, Iterator
from typing import Any

from amp_studio.schema import load_schema
from amp_studio.transfer.emulated.line_device import DeviceSetup

from .stored_settings import FAMILY, OUT_OF_RANGE, RefusedError, StoredSettings

MEMORY = "settings"
LINE, CLASSIC_LINE = 256, 80
"""Characters of the longest line."""
PIECE = 512
OFFSETS = ("G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3")
POSITIONS = ("G28", "G30", "G92")
UNKNOWN, NOT_IDLE, LOCKED, TOO_LONG, NO_HOMING, BAD_WORD = 3, 8, 9, 11, 5, 20
_STATES = ("Idle", "Run", "Hold:0", "Door:0", "Alarm", "Check")
_SUSPENDED = ("Hold:0", "Door:0")  # no line is read (protocol.c ``protocol_exec_rt_suspend``)


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
        self._boot()

    # -- power ---------------------------------------------------------------------------------------

    def _boot(self) -> None:
        self._line, self._overflows, self._is_deaf, self._last_end = "", False, False, ""
        self._unit = 21
        self._unread: list[str] = []
        self.state = "Idle" if self.state not in ("Run", *_SUSPENDED) else "Alarm"
        zeros = ",".join(["0.000"] * len(self._axes))
        self.offsets = dict.fromkeys(
            (*(OFFSETS[:6] if self.settings.is_classic else OFFSETS), *POSITIONS), zeros
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
        content = json.dumps({
            "settings": self.settings.values(), "offsets": self.offsets, "startup": self.startup, "build": self.build,
        }).encode()  # fmt: skip
        self._memory.replace(MEMORY, _checksum(content) + b"\n" + content)
        self.is_writing = False

    def power_cycle(self) -> None:
        """Cut the power: while the memory is being written all of it is lost."""
        if self.is_writing:
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
            self._take(byte)

    def _take(self, byte: int) -> None:
        sign = chr(byte)
        if byte == 0x18:
            self._line, self._is_deaf = "", True  # this build takes no setting after a soft reset
            self._greet()
        elif sign in "?!~" and not self._line.startswith("$"):
            if sign == "~" and self.state == "Hold:0":
                self.state, unread, self._unread = "Idle", self._unread, []
                for line in unread:
                    self._answer_line(line)
            if sign == "?":
                self._send(f"<{self.state}|MPos:{','.join(['0.000'] * len(self._axes))}|FS:0,0>")
        elif sign in "\r\n":
            if not self._line and self._last_end not in ("", sign):
                self._last_end = ""
                return
            self._last_end = sign
            line, self._line = self._line, ""
            if self.state in _SUSPENDED:
                self._unread.append(line)
                return
            if self.is_writing:
                self._save()
            self._answer_line(line)
        elif byte in (0x7F, 0x08) and not self.settings.is_classic:
            self._line = self._line[:-1]
        elif byte > (0x1F if self._line else 0x20) and byte < 0x80:
            limit = CLASSIC_LINE if self.settings.is_classic else LINE
            self._overflows = self._overflows or len(self._line) >= limit - 1
            self._line = (self._line + sign)[: limit - 1]

    def _answer_line(self, line: str) -> None:
        overflows, self._overflows = self._overflows, False
        try:
            if overflows:
                raise RefusedError(TOO_LONG)
            if self._is_deaf and re.match(r"\$\d+=", line):
                return
            self._execute(line)
        except RefusedError as refused:
            self._send(f"error:{refused.code}")
        else:
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
            self._block(line.upper().replace(" ", ""))

    def _system(self, line: str) -> None:
        name, equals, text = line[1:].partition("=")
        name = name.replace(" ", "").upper()
        if found := re.fullmatch(r"N(\d)", name):
            self._startup(int(found[1]), text)
        elif equals and name.isdigit():
            self._need_rest()
            self.settings.store(int(name), text)
            # In check mode it stays in RAM (protocol.c ``protocol_execute_realtime``); a Grbl 1.1 writes at once.
            self.is_writing = self.state != "Check" or self.settings.is_classic
        elif equals and name == "RST":
            self._reset(text)
        elif not equals and name in self._reports():
            if name in ("$", "+", "I"):
                self._need_rest()
            self._send(*self._reports()[name]())
        elif not equals and name.isdigit() and not self.settings.is_classic:
            shown = self.settings.named(int(name))
            if shown is None:
                raise RefusedError(53)
            self._send(f"${shown.number}={shown.show()}")
        elif name == "X":
            self.state = "Idle"
        elif name.startswith("H"):
            raise RefusedError(NO_HOMING)
        else:
            raise RefusedError(UNKNOWN)

    def _need_rest(self) -> None:
        if self.state == "Run":
            raise RefusedError(NOT_IDLE)

    def _startup(self, number: int, line: str) -> None:
        """Store a start-up line, which is executed first (``set_startup_line``)."""
        self._need_rest()
        if number not in self.startup:
            raise RefusedError(UNKNOWN)
        line = line.upper().replace(" ", "")
        if line:
            self._block(line)
        self.startup[number] = line
        self.is_writing = True

    def _reset(self, what: str) -> None:
        if what not in ("$", "#", "*", "&"):
            raise RefusedError(UNKNOWN)
        self._memory.replace(MEMORY, b"")
        self._boot()
        self._is_deaf = True

    def _block(self, line: str) -> None:
        """Execute a block of G-code, of which only units and offsets matter here."""
        if self.state == "Alarm":
            raise RefusedError(LOCKED)
        if found := re.match(r"G(20|21)", line):
            self._unit = int(found[1])
            line = line[3:]
        found = re.fullmatch(r"G10L2P([1-9])((?:[A-Z]-?[\d.]+)*)", line)
        if found is None:
            if not re.fullmatch(r"([A-Z]-?[\d.]+)*", line):
                raise RefusedError(BAD_WORD)
            return
        name = OFFSETS[int(found[1]) - 1]
        if name not in self.offsets:
            raise RefusedError(OUT_OF_RANGE)
        at = dict(zip(self._axes, map(float, self.offsets[name].split(",")), strict=True))
        for axis, number in re.findall(r"([A-Z])(-?[\d.]+)", found[2]):
            if axis not in at:
                raise RefusedError(BAD_WORD)
            at[axis] = float(number) * (25.4 if self._unit == 20 else 1.0)
        self.offsets[name] = ",".join(f"{value:.3f}" for value in at.values())
        self.is_writing = True

    # -- reports -------------------------------------------------------------------------------------

    def _reports(self) -> dict[str, Callable[[], Iterator[str]]]:
        common = {
            "I": self._identity,
            "$": self._values,
            "#": self._coordinates,
            "G": self._modes,
            "N": self._lines,
        }
        if self.settings.is_classic:
            return common
        return {**common, "+": self._values, "EG": self._groups, "ES": self._descriptions, "ESH": self._helps,
                "EA": self._alarms, "EE": self._errors}  # fmt: skip

    def _identity(self) -> Iterator[str]:
        if self.settings.is_classic:
            yield from (f"[VER:1.1h.20190830:{self.build}]", "[OPT:V,15,128]")
            return
        yield f"[VER:1.1f.20260817:{self.build}]"
        yield f"[OPT:VNM{'H' if self.settings.all[22].value else ''},100,1024,{len(self._axes)},0]"
        yield f"[AXS:{len(self._axes)}:{self._axes}]"
        yield from ("[NEWOPT:ENUMS,RT+]", "[FIRMWARE:grblHAL]", "[NVS STORAGE:*EEPROM]", "[FREE MEMORY:64K]",
                    "[DRIVER:Emulated]", "[DRIVER VERSION:1]")  # fmt: skip

    def _values(self) -> Iterator[str]:
        for setting in self.settings.available():
            yield f"${setting.number}={setting.show()}"

    def _coordinates(self) -> Iterator[str]:
        inches = self.settings.all[13].value
        for name, text in self.offsets.items():
            shown = ",".join(f"{float(part) / 25.4:.4f}" for part in text.split(",")) if inches else text
            yield f"[{name}:{shown}]"
        zeros = ",".join(["0.0000" if inches else "0.000"] * len(self._axes))
        yield from (f"[TLO:{'0.000' if self.settings.is_classic else zeros}]", f"[PRB:{zeros}:0]")

    def _modes(self) -> Iterator[str]:
        yield f"[GC:G0 G54 G17 G{self._unit} G90 G94 M5 M9 T0 F0 S0]"

    def _lines(self) -> Iterator[str]:
        for number, line in self.startup.items():
            yield f"$N{number}={line}"

    def _groups(self) -> Iterator[str]:
        yield "[SETTINGGROUP:0|0|Root]"
        for number, group in enumerate(load_schema(FAMILY).groups, 1):
            yield f"[SETTINGGROUP:{42 if group.name == 'Axis' else number}|0|{group.name}]"
        for number, axis in enumerate(self._axes):
            yield f"[SETTINGGROUP:{43 + number}|42|{axis}-axis]"

    def _descriptions(self) -> Iterator[str]:
        for setting in self.settings.available():
            yield setting.describe(len(self._axes))

    def _helps(self) -> Iterator[str]:
        for setting in self.settings.available():
            yield f"{setting.number}\t{setting.name}\t{setting.unit}\t\t\t{setting.help}\t\t\t0\t0"

    def _alarms(self) -> Iterator[str]:
        yield from (
            "[ALARMCODE:1||A limit switch was reached.]",
            "[ALARMCODE:2||A move would have left the travel.]",
        )

    def _errors(self) -> Iterator[str]:
        for number, text in (
            (3, "Not a command."),
            (8, "Not at rest."),
            (9, "Locked."),
            (52, "Out of range."),
        ):
            yield f"[ERRORCODE:{number}||{text}]"

    # -- the operator --------------------------------------------------------------------------------

    def command(self, line: str) -> str:
        """Do what the operator asks for: ``state Run``, ``alarm 1``, ``message TEXT``, ``power``, ``status``."""
        verb, _, rest = line.partition(" ")
        match verb, rest:
            case "state", _ if rest in _STATES:
                self.state = rest
            case "alarm", _ if re.fullmatch(r"\d{1,2}", rest):
                self.state = "Alarm"
                self._send(f"ALARM:{rest}")
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
