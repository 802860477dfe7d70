"""The settings of an emulated ACR card: what a command sets, and what it keeps without power.

Written from pages 91, 107 and 113 to 135 of the AcroMill user's guide; it shares nothing with the driver and
the text formats. What the guide does not show is marked "assumed" here and in docs/protocols/acr-terminal.md.
"""

from __future__ import annotations

import math
import re
import struct
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from amp_studio.transfer.emulated import Memory

AXES = "XYZABCUV"
_SAVED = "saved"
"""What ESAVE has written, one setting a line, the last of each counts."""
_LARGEST_P = 16_383  # assumed; the guide shows P09984 and P12345
_MAX_POSITIONS = 1_000  # of a ballscrew table (assumed)

_NUMBER = r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:E[+-]?[0-9]{1,3})?"
_BY_AXIS = {
    "PPU": "10000",
    "MULT": "4",
    "TLM": "10",
    "PGAIN": "0.00244",
    "IGAIN": "0",
    "IDELAY": "0",
    "ILIMIT": "0",
    "DGAIN": "0",
    "DWIDTH": "0",
    "FFVEL": "0",
    "FFACC": "0",
    "FBVEL": "0",
    "LOPASS": "",
}
"""Commands of an axis -> what a card without saved settings begins with: the defaults of pages 59 to 62;
"" for a filter that is off."""
_LISTED = """
? ABS ACC ADC ALL ALM AS ATTACH AUT AXIS BASE BKL BLK BLM BRESET CAM CLEAR CLOCK CLOSE CLR COM1 COM2 CONFIG
CPU DEC DETACH DIAG DIM DST DWL END F FIFO FLASH FLZ FOV FREQ FWD GAIN GEAR GOSUB GOTO HALT HDW HSINT IF IHPOS
IMAGE INC INH INPUT INT INTCAP IO IPB ITB IVEL JLM JOG JRK LIMIT LIST LISTEN LOAD LOCK LRUN MASK MASTER MAX
MEM MIN MODE MOV MSEEK NEG NEW NONE NORM OFF OFFSET ON OPEN PAUSE PBOOT PERIOD PLC PLS PDIFF PON POS PROM
RATCH RATIO REBOOT REN RES RESUME RETURN REV ROTARY ROTATE ROV RUN SAMP SAVE SCALE SEG SET SHIFT SINE SLAVE
SRC STEP STEPPER STP SYS THEN TLM TRG TRJ TROFF TRON UNLOCK USING VECDEF VECTOR VEL WIDTH XID
"""
"""Words that the terminal lists (page 91) and this card knows by name only."""
COMMANDS_LISTED = " ".join(
    sorted(
        (
            *_LISTED.split(),
            *_BY_AXIS,
            "EXC",
            "NOTCH",
            "DAC",
            "BSC",
            "ECHO",
            "ELOAD",
            "ERASE",
            "ESAVE",
            "HELP",
            "PRINT",
            "PROG",
            "REM",
            "VER",
        )
    )
)
"""All of them, as HELP shows them."""


class CommandError(ValueError):
    """A line that the card does not obey; what it answers."""


def single(text: str) -> float:
    """Return a figure as the card keeps it, in 32 bits (the Board screen of page 94 shows seven digits)."""
    number = float(text)
    try:
        # Through 32 bits, so that a figure is read back as rounded as a card has it.
        kept: float = struct.unpack("<f", struct.pack("<f", number))[0]
    except OverflowError:
        raise CommandError("Number out of range") from None
    return kept


def number_text(number: float) -> str:
    """Return a figure as the card shows it: seven digits (0.002441406 on the Gain screen, page 92)."""
    return f"{number:.7g}".upper() if math.isfinite(number) else "0"


@dataclass(frozen=True)
class Form:
    """What one setting of a command looks like; ``key`` makes its name of the match."""

    pattern: re.Pattern[str]
    key: Callable[[re.Match[str]], str]
    figures: int = 1


def _form(pattern: str, key: Callable[[re.Match[str]], str], figures: int = 1) -> Form:
    return Form(re.compile(pattern, re.IGNORECASE), key, figures)


_V = rf"(?P<v>{_NUMBER})?\s*(?![\w.])"
_ARGUMENT = {
    word: _form(rf"\s*(?P<i>[{AXES}])\s*{_V}", lambda found: found["i"].upper()) for word in _BY_AXIS
} | {
    "EXC": _form(rf"\s*AXIS(?P<i>[0-7])(?:\s+{_V}|(?=\s*$))", lambda found: f"AXIS{found['i']}"),
    "NOTCH": _form(
        rf"\s*(?P<i>[{AXES}])\s*(?:\(\s*(?P<v>{_NUMBER})\s*,\s*(?P<w>{_NUMBER})\s*\))?\s*",
        lambda found: found["i"].upper(),
        2,
    ),
}
_DAC = re.compile(rf"DAC([0-7])\s+GAIN(?:\s+({_NUMBER}))?\s*", re.IGNORECASE)
_P = re.compile(rf"P([0-9]{{1,5}})\s*=\s*(?:({_NUMBER})|P([0-9]{{1,5}}))\s*", re.IGNORECASE)
_PRINT = re.compile(r"(?:PRINT\s+|\?\s*)P([0-9]{1,5})\s*", re.IGNORECASE)
_BSC = re.compile(rf"([{AXES}])(?:([0-9]{{1,4}})E(-?\.[0-9]{{5}}))?\s*", re.IGNORECASE)


class CardSettings:
    """The settings that are active, by name ("PPU X"), and those that ESAVE keeps."""

    def __init__(self, memory: Memory, set_up: Mapping[str, str] | None = None) -> None:
        self._memory = memory
        self._set_up = set_up or {}
        """What it was set up with and saves nothing else of."""
        self.values: dict[str, str] = {}
        self.variables: dict[int, float] = {}
        self.load()

    def load(self) -> None:
        """Make active what is saved, as at power-up and by ELOAD."""
        self.values = {**self._delivered(), **self._set_up}
        # A last line without its end was being written when the power went: it does not count.
        for line in (self._memory.read(_SAVED) or b"").rpartition(b"\n")[0].decode("latin-1").splitlines():
            name, _, value = line.partition("=")
            self.values[name] = value

    @staticmethod
    def _delivered() -> dict[str, str]:
        values = {f"{word} {axis}": text for word, text in _BY_AXIS.items() for axis in AXES}
        values |= {f"NOTCH {axis}": "" for axis in AXES}
        values |= {f"EXC AXIS{n}": "0" for n in range(8)} | {f"DAC{n} GAIN": "3276.8" for n in range(8)}
        return values

    def save(self) -> None:
        """Write what differs from what is saved, a setting at a time; raises OSError."""
        saved = CardSettings(self._memory, self._set_up).values
        for name, value in self.values.items():
            if saved.get(name) != value:
                # One append a setting: a power failure in between leaves the first ones saved, as an EEPROM
                # does.
                self._memory.append(_SAVED, f"{name}={value}\n".encode())
        self._memory.sync(_SAVED) if self._memory.read(_SAVED) is not None else None

    def erase(self) -> None:
        """Forget what is saved; what is active stays active until the power goes."""
        self._memory.remove(_SAVED)

    def execute(self, line: str) -> list[str]:
        """Obey a line and return what the card shows; raises CommandError,
        with what came before it in the line done.
        """
        text = line.strip()
        if not text:
            return []
        if match := _DAC.fullmatch(text):
            return self._figure(f"DAC{match[1]} GAIN", (match[2],))
        if match := _P.fullmatch(text):
            return self._variable(int(match[1]), match[2], match[3])
        if match := _PRINT.fullmatch(text):
            return [number_text(self.variables.get(_p_number(match[1]), 0.0))]
        word, _, rest = text.partition(" ")
        word = word.upper()
        if word == "REM":
            return []
        if word == "BSC":
            return self._ballscrew(rest.strip())
        if word in _ARGUMENT:
            return self._arguments(word, rest)
        raise CommandError("Not in this emulated card" if word in _LISTED.split() else "Unknown command")

    def _arguments(self, word: str, rest: str) -> list[str]:
        """Set or list the figures behind a command; returns the lines of the answer."""
        form, at, answer = _ARGUMENT[word], 0, list[str]()
        if not rest.strip():
            raise CommandError("Axis expected")
        while at < len(rest):
            match = form.pattern.match(rest, at)
            if match is None or match.end() == at:
                raise CommandError("Syntax error")
            answer += self._figure(
                f"{word} {form.key(match)}", tuple(match[name] for name in "vw"[: form.figures])
            )
            at = match.end()
        return answer

    def _figure(self, name: str, figures: tuple[str | None, ...]) -> list[str]:
        """Set a setting, or show it where no figure is given (assumed)."""
        if figures[0] is None:
            return [self.values[name]] if self.values[name] else []
        self.values[name] = ", ".join(number_text(single(figure)) for figure in figures if figure is not None)
        return []

    def _variable(self, number: int, figure: str | None, other: str | None) -> list[str]:
        value = single(figure) if figure is not None else self.variables.get(_p_number(other or "0"), 0.0)
        self.variables[_p_number(str(number))] = value
        return []

    def _ballscrew(self, word: str) -> list[str]:
        """Take a word of the BSC input file (page 107), or show the words of an axis;
        the command in front is assumed.
        """
        found = _BSC.fullmatch(word)
        if found is None:
            raise CommandError("Syntax error")
        axis = found[1].upper()
        if found[2] is None:
            return [f"{axis}{n}E{self.values[f'BSC {axis}{n}']}" for n in range(self._positions(axis))]
        if int(found[2]) > min(self._positions(axis), _MAX_POSITIONS - 1):
            raise CommandError("Position out of range")
        self.values[f"BSC {axis}{int(found[2])}"] = found[3]
        return []

    def _positions(self, axis: str) -> int:
        return sum(name.startswith(f"BSC {axis}") for name in self.values)


def _p_number(text: str) -> int:
    if int(text) > _LARGEST_P:
        raise CommandError("Number out of range")
    return int(text)
