"""Where a control is reached: ``tcp://host:port``, ``serial:/dev/ttyUSB0?baud=115200``, ``pty:``."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal
from urllib.parse import parse_qsl

DEFAULT_BAUD = 115_200
FORMS = "tcp://host:port, serial:PORT?baud=115200 or pty:"

Kind = Literal["tcp", "serial", "pty"]


@dataclass(frozen=True)
class Endpoint:
    """One end of a line. ``host`` and ``port`` belong to tcp, ``device`` and ``baud`` (bit/s) to serial."""

    kind: Kind
    host: str = ""
    port: int = 0
    device: str = ""
    baud: int = DEFAULT_BAUD

    def __str__(self) -> str:
        if self.kind == "tcp":
            return (
                f"tcp://[{self.host}]:{self.port}" if ":" in self.host else f"tcp://{self.host}:{self.port}"
            )
        if self.kind == "serial":
            rate = "" if self.baud == DEFAULT_BAUD else f"?baud={self.baud}"
            return f"serial:{self.device}{rate}"
        return "pty:"


def parse_endpoint(text: str) -> Endpoint:
    """Return the address a person wrote; raises ValueError with one sentence that says what is wrong."""
    text = text.strip()
    if text.startswith("tcp://"):
        return _tcp(text)
    if text.startswith("serial:"):
        return _serial(text, text.removeprefix("serial:"))
    if re.fullmatch(r"com\d+", text, re.IGNORECASE):
        return Endpoint("serial", device=text.upper())
    if text.startswith("/dev/"):
        return _serial(text, text)
    if text == "pty:":
        return Endpoint("pty")
    raise ValueError(f"'{text}' is no address of a control: write {FORMS}")


def is_endpoint(text: str) -> bool:
    """Whether a person means a control and not a file."""
    return "://" in text or re.match(r"serial:|pty:|/dev/|com\d+$", text, re.IGNORECASE) is not None


def _tcp(text: str) -> Endpoint:
    found = re.fullmatch(r"tcp://(?:\[([0-9A-Fa-f:.%\w]+)\]|([^\[\]:/?#\s]+)):(\d{1,5})/?", text, re.ASCII)
    if found is None:
        raise ValueError(
            f"'{text}' is no TCP address: write tcp://host:port, for example tcp://192.168.0.5:7090"
        )
    port = int(found[3])
    if port > 65_535:
        raise ValueError(f"'{text}' names port {port}, and ports end at 65535")
    return Endpoint("tcp", host=found[1] or found[2], port=port)


def _serial(text: str, rest: str) -> Endpoint:
    device, _, query = rest.partition("?")
    if not device:
        raise ValueError(f"'{text}' names no port: write serial:/dev/ttyUSB0 or serial:COM3")
    baud = DEFAULT_BAUD
    for key, value in parse_qsl(query, keep_blank_values=True):
        if key != "baud":
            raise ValueError(f"'{text}' sets '{key}', and a serial line has only 'baud'")
        if not re.fullmatch(r"[1-9]\d{1,6}", value, re.ASCII):
            raise ValueError(
                f"'{text}' has the rate '{value}': write a number of bits a second, such as baud=9600"
            )
        baud = int(value)
    return Endpoint("serial", device=device, baud=baud)
