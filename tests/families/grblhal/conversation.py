"""A conversation with the real firmware, recorded in ``conversation.txt``, and a player that answers from it.

``python -m tests.families.grblhal.conversation ADDRESS`` records it again, from a control that has never been
set. Sentences of the firmware (help, texts of alarms and errors) are left out.
"""

import re
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from amp_studio.families.grblhal.line import GrblLine, GrblRefusalError
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.links.link import Link
from amp_studio.transfer.links.opening import connect
from amp_studio.transfer.waiting import Waiting

RECORD = Path(__file__).with_name("conversation.txt")
COMMANDS = (
    "$I",
    "$+",
    "$$",
    "$#",
    "$N",
    "$EG",
    "$ES",
    "$ESH",
    "$EA",
    "$EE",
    "$G",
    "$20=1",
    "$22=3",
    "$20=1",
    "$20",
    "$676",
    "$22=131",
    "$676",
    "$22",
    "$22=0",
    "$20",
    "$22=515",
    "$24=30",
    "$180",
    "$180=77",
    "$24",
    "$22=3",
    "$180",
    "$130=301.5",
    "$130",
    "$130=1e-05",
    "$130",
    "$11=0.0004",
    "$11",
    "$26=70000",
    "$26",
    "$44=8",
    "$44=7",
    "$0=1.5",
    "$999=1",
    "$100=-1",
    "$32=3",
    "$13=2",
    "$1=x",
    "$43=0",
    "$43=129",
    "$394=0",
    "$394=0.2",
    "$30=24000",
    "$30",
    "G21G10L2P1X1.5Y-2.25Z3",
    "$#",
    "$13=1",
    "$#",
    "$13=0",
    "$N0=G21G54",
    "$N1=M3S100",
    "$N",
    "$N0=",
    "$N1=",
    "$N",
    "M5",
    "$110=2000000",
    "$Q",
    "$SED=22",
)


def reduced(lines: Sequence[str]) -> list[str]:
    """Return an answer without the sentences of the firmware."""
    without = [
        re.sub(r"^(\[(?:SETTINGDESCR|ALARMCODE|ERRORCODE):[^|]*\|).*", r"\1…]", line) for line in lines
    ]
    rows = [line.split("\t") for line in without]
    return [
        "\t".join([*row[:5], "…", *row[6:]]) if len(row) == 10 else row[0]
        for row in rows
        if len(row) != 9 and not row[0].startswith(("$-Code", "Keep coolant"))
    ]


def answers(line: GrblLine, commands: Sequence[str] = COMMANDS) -> list[tuple[str, list[str]]]:
    """Return what a control answers to each command, with ``ok`` or ``error:N`` at the end."""
    found = []
    for command in commands:
        try:
            identity_word = [*reduced(line.ask(command, writes=True)), "ok"]
        except GrblRefusalError as refusal:
            identity_word = [f"error:{refusal.code}"]
        found.append((command, identity_word))
    return found


def recorded() -> list[tuple[str, list[str]]]:
    """Return the recorded conversation: each command with the lines of its answer."""
    found: list[tuple[str, list[str]]] = []
    for line in RECORD.read_text("utf-8").splitlines():
        if line.startswith("> "):
            found.append((line[2:], []))
        else:
            found[-1][1].append(line)
    return found


def written(conversation: Sequence[tuple[str, list[str]]]) -> str:
    """Return a conversation as it is recorded."""
    return "".join(
        f"> {command}\n" + "".join(f"{line}\n" for line in identity_word)
        for command, identity_word in conversation
    )


class Player:
    """A line on which every command gets the answer that was recorded the first time;
    anything else ``error:3``.
    """

    bytes_per_second = None

    def __init__(self, wait: Callable[[float], None]) -> None:
        self._said = {"": ["ok"], **dict(reversed(recorded()))}
        self._wait = wait
        self._in, self._out = "", bytearray()

    def open(self, look: Callable[[], None]) -> Link:
        look()
        return self

    def read(self, timeout: float) -> bytes:
        data = bytes(self._out)
        self._out.clear()
        if not data:
            self._wait(timeout)
        return data

    def write(self, data: bytes) -> None:
        text = data.replace(b"\x7f", b"").decode()
        if text == "?":
            self._out += b"<Idle|MPos:0.000,0.000,0.000>\r\n"
            return
        *lines, self._in = (self._in + text).split("\n")
        for line in lines:
            identity_word = self._said.get(line, ["error:3"])
            self._out += "".join(f"{each}\r\n" for each in identity_word).encode()

    def close(self) -> None:
        self._out.clear()


if __name__ == "__main__":
    place = parse_endpoint(sys.argv[1])
    RECORD.write_text(written(answers(GrblLine(lambda look: connect(place, look=look), Waiting()))), "utf-8")
