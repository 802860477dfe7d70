"""Where a control is reached: ``tcp://host:port``, ``serial:/dev/ttyUSB0?baud=115200``, ``pty:``."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Literal
from urllib.parse import parse_qsl

from amp_studio.schema.quoting import quoted

DEFAULT_BAUD = 115_200
FORMS = "tcp://host:port, serial:PORT?baud=115200 or pty:"

LinkKind = Literal["tcp", "serial", "pty"]


@dataclass(frozen=True)
class Endpoint:
    """One end of a line. ``host`` and ``port`` belong to tcp, ``device`` and ``baud`` (bit/s) to serial.

    ``protocol`` is how it is spoken to; "" for the usual way of the control's family.
    """

    kind: LinkKind
    host: str = ""
    port: int = 0
    device: str = ""
    baud: int = DEFAULT_BAUD
    protocol: str = ""

    def __str__(self) -> str:
        options = [f"baud={self.baud}"] if self.baud != DEFAULT_BAUD else []
        options += [f"protocol={self.protocol}"] if self.protocol else []
        return f"{self._place}?{'&'.join(options)}" if options else self._place

    @property
    def _place(self) -> str:
        if self.kind == "tcp":
            host = f"[{self.host}]" if ":" in self.host else self.host
            return f"tcp://{host}:{self.port}"
        return f"serial:{self.device}" if self.kind == "serial" else "pty:"


def parse_endpoint(text: str) -> Endpoint:
    """Return the address a person wrote; raises ValueError with one sentence about what is wrong."""
    text = text.strip()
    if text.startswith("tcp://"):
        return _tcp(text)
    if text.startswith("serial:"):
        return _serial(text, text.removeprefix("serial:"))
    if re.fullmatch(r"com\d+", text, re.IGNORECASE):
        return Endpoint("serial", device=text.upper())
    if text.startswith("/dev/"):
        return _serial(text, text)
    if text.partition("?")[0] == "pty:":
        options = _options(text, text.partition("?")[2], "a pseudo terminal", ("protocol",))
        return Endpoint("pty", protocol=options.get("protocol", ""))
    raise ValueError(f"{quoted(text)} is no address of a control: write {FORMS}")


def is_endpoint(text: str) -> bool:
    """Whether a person means a control and not a file."""
    return "://" in text or re.match(r"serial:|pty:|/dev/|com\d+$", text, re.IGNORECASE) is not None


def _tcp(text: str) -> Endpoint:
    place, _, query = text.partition("?")
    found = re.fullmatch(r"tcp://(?:\[([0-9A-Fa-f:.%\w]+)\]|([^\[\]:/?#\s]+)):(\d{1,5})/?", place, re.ASCII)
    if found is None:
        raise ValueError(
            f"{quoted(text)} is no TCP address: write tcp://host:port, for example tcp://192.168.0.5:7090"
        )
    port = int(found[3])
    if port > 65_535:
        raise ValueError(f"{quoted(text)} names port {port}, and ports end at 65535")
    options = _options(text, query, "a TCP connection", ("protocol",))
    return Endpoint("tcp", host=found[1] or found[2], port=port, protocol=options.get("protocol", ""))


def _serial(text: str, rest: str) -> Endpoint:
    device, _, query = rest.partition("?")
    if not device.strip() or device != device.strip() or not device.isprintable():
        raise ValueError(f"{quoted(text)} names no port: write serial:/dev/ttyUSB0 or serial:COM3")
    options = _options(text, query, "a serial line", ("baud", "protocol"))
    rate = options.get("baud", str(DEFAULT_BAUD))
    if not re.fullmatch(r"[1-9]\d{1,6}", rate, re.ASCII):
        raise ValueError(
            f"{quoted(text)} has the rate {quoted(rate)}: write a number of bits a second, such as baud=9600"
        )
    return Endpoint("serial", device=device, baud=int(rate), protocol=options.get("protocol", ""))


def _options(text: str, query: str, what: str, known: tuple[str, ...]) -> dict[str, str]:
    options: dict[str, str] = {}
    for key, value in parse_qsl(query, keep_blank_values=True):
        if key not in known:
            raise ValueError(
                f"{quoted(text)} sets {quoted(key)}, and {what} has only {' and '.join(map(repr, known))}"
            )
        if key in options:
            raise ValueError(f"{quoted(text)} sets {quoted(key)} twice")
        options[key] = value
    if "protocol" in options and not re.fullmatch(r"[a-z][a-z0-9-]{0,30}", options["protocol"], re.ASCII):
        raise ValueError(f"{quoted(text)} names no protocol: write ?protocol=house, for example")
    return options
