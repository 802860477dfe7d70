"""Where a control is reached: ``tcp://host:port``, ``serial:/dev/ttyUSB0?baud=9600&bits=7&parity=even``,
``folder:/home/me/mill.ini``, ``pty:``.
"""

from __future__ import annotations

import contextlib
import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Literal
from urllib.parse import parse_qsl, quote

from amp_studio.errors import AmpStudioError
from amp_studio.schema import quoted

from .security import Security
from .serial_settings import DATA_BITS, FLOWS, PARITIES, STOP_BITS, Flow, Parity, SerialSettings

FORMS = (
    "tcp://host:port, tls://host:port, rfc2217://host:port, serial:/dev/ttyUSB0?baud=9600, COM3, "
    "folder:NAME.ini or pty: (an emulated control only)"
)

LinkKind = Literal["tcp", "tls", "rfc2217", "serial", "folder", "pty"]

LINE = ("baud", "bits", "parity", "stop", "flow")
NETWORK = ("tcp", "tls", "rfc2217")
FOLDER = "folder:"
"""What is behind it is a path as it is, question marks too: the family of a folder has one protocol."""


class EndpointError(AmpStudioError, ValueError):
    """A text that is no address of a control, or one at which it cannot be spoken to as was asked."""

    is_keyed_in = False
    """Whether no way to a control of the family is known, so that its values are keyed in."""


@dataclass(frozen=True)
class Endpoint:
    """One end of a line.

    ``host`` and ``port``       of tcp, tls and rfc2217
    ``device``                  of serial; of folder the path of what the control reads
    ``baud`` (bit/s) to ``flow``  of serial and rfc2217; None where they are left to the protocol on the line
    ``ca``, ``fingerprint``     of tls: a file of certificates to trust, or the SHA-256 of the only one, in
                                hexadecimal
    ``security``                what is asked of who connects, where this is listened on
    ``protocol``                how it is spoken to; "" for the usual way of the control's family
    """

    kind: LinkKind
    host: str = ""
    port: int = 0
    device: str = ""
    baud: int | None = None
    bits: int | None = None
    parity: Parity | None = None
    stop: int | None = None
    flow: Flow | None = None
    ca: str = ""
    fingerprint: str = ""
    protocol: str = ""
    security: Security | None = field(default=None, repr=False, compare=False)

    def __str__(self) -> str:
        if self.kind == "folder":
            return self._place
        given = [(key, getattr(self, key)) for key in LINE]
        if self.fingerprint:
            given.append(("fingerprint", f"sha256:{self.fingerprint}"))
        given += [("ca", self.ca or None), ("protocol", self.protocol or None)]
        options = [f"{key}={quote(str(value), safe='/:')}" for key, value in given if value is not None]
        return f"{self._place}?{'&'.join(options)}" if options else self._place

    @property
    def _place(self) -> str:
        if self.kind in NETWORK:
            host = f"[{self.host}]" if ":" in self.host else self.host
            return f"{self.kind}://{host}:{self.port}"
        return "pty:" if self.kind == "pty" else f"{self.kind}:{self.device}"

    def serial_settings(self) -> SerialSettings:
        """Return how the line is set; what was not given is usual."""
        return SerialSettings(**{key: value for key in LINE if (value := getattr(self, key)) is not None})

    def with_usual(self, usual: SerialSettings) -> Endpoint:
        """Return it with the settings of a way of speaking wherever none was given."""
        return replace(self, **{key: getattr(usual, key) for key in LINE if getattr(self, key) is None})

    def need_all_bytes(self, protocol: str) -> None:
        """Raise EndpointError where the line does not pass every byte as it is, which ``protocol`` needs."""
        if self.bits == 7 or self.flow == "xonxoff":
            raise EndpointError(f"{quoted(str(self))}: {protocol} needs 8 data bits and no XON/XOFF")


def parse_endpoint(text: str) -> Endpoint:
    """Return the address a person wrote; raises EndpointError with one sentence about what is wrong."""
    text = text.strip()
    for kind in NETWORK:
        if text.startswith(f"{kind}://"):
            return _network(text, kind)
    if text.startswith("serial:"):
        return _serial(text, text.removeprefix("serial:"))
    if text.startswith(FOLDER):
        return _folder(text)
    if _is_device(text) or re.match(r"com\d+(\?|$)", text, re.IGNORECASE):
        return _serial(text, text)
    if text.partition("?")[0] == "pty:":
        return Endpoint("pty", **_options(text, "a pseudo terminal", ("protocol",)))
    raise EndpointError(f"{quoted(text)} is no address of a control: write {FORMS}")


def is_endpoint(text: str) -> bool:
    """Return whether a person means a control and not a file."""
    return (
        "://" in text
        or _is_device(text)
        or re.match(r"serial:|folder:|pty:|com\d+(\?|$)", text, re.IGNORECASE) is not None
    )


def _is_device(text: str) -> bool:
    """Return whether a text names a device, there or not;
    a file below /dev is a file (/dev/shm is a disk in memory).
    """
    if not text.startswith("/dev/"):
        return False
    with contextlib.suppress(OSError, ValueError):  # a name too long for a file, or with a NUL, is none
        return not Path(text).is_file() and not Path(text.partition("?")[0]).is_file()
    return True


def _network(text: str, kind: str) -> Endpoint:
    """Return the endpoint of ``tcp://``, ``tls://`` or ``rfc2217://``; raises ValueError."""
    match = re.fullmatch(
        kind + r"://(?:\[([0-9A-Fa-f:.%\w]+)\]|([^\[\]:/?#\s]+)):(\d{1,5})/?",
        text.partition("?")[0],
        re.ASCII,
    )
    if match is None:
        name = {"tcp": "TCP", "tls": "TLS", "rfc2217": "RFC 2217"}[kind]
        raise EndpointError(
            f"{quoted(text)} is no {name} address: write {kind}://host:port, for example"
            f" {kind}://192.168.0.5:7090"
        )
    port = int(match[3])
    if port > 65_535:
        raise EndpointError(f"{quoted(text)} names port {port}, and ports end at 65535")
    host = match[1] or match[2]
    if kind == "tcp":
        return Endpoint("tcp", host=host, port=port, **_options(text, "a TCP connection", ("protocol",)))
    if kind == "tls":
        options = _options(text, "a TLS connection", ("ca", "fingerprint", "protocol"))
        return Endpoint("tls", host=host, port=port, **options)
    return Endpoint(
        "rfc2217", host=host, port=port, **_options(text, "an RFC 2217 line", (*LINE, "protocol"))
    )


def _serial(text: str, rest: str) -> Endpoint:
    device = rest.partition("?")[0]
    if not device.strip() or device != device.strip() or not device.isprintable() or "://" in device:
        raise EndpointError(f"{quoted(text)} names no port: write serial:/dev/ttyUSB0 or serial:COM3")
    if re.fullmatch(r"com\d+", device, re.IGNORECASE):
        device = device.upper()
    return Endpoint("serial", device=device, **_options(text, "a serial line", (*LINE, "protocol")))


def _folder(text: str) -> Endpoint:
    path = text.removeprefix(FOLDER)
    if not path.strip() or not path.isprintable():
        raise EndpointError(f"{quoted(text)} names no file or folder: write folder:NAME.ini")
    return Endpoint("folder", device=path)


def _options(text: str, what: str, known: tuple[str, ...]) -> dict[str, Any]:
    """Read the options behind the question mark; raises EndpointError."""
    options: dict[str, Any] = {}
    for key, value in parse_qsl(text.partition("?")[2].replace("+", "%2B"), keep_blank_values=True):
        if key not in known:
            *most, last = map(repr, known)
            names = f"{', '.join(most)} and {last}" if most else last
            raise EndpointError(f"{quoted(text)} sets {quoted(key)}, and {what} has only {names}")
        if key in options:
            raise EndpointError(f"{quoted(text)} sets {quoted(key)} twice")
        try:
            options[key] = _READERS[key](value)
        except ValueError as error:
            raise EndpointError(f"{quoted(text)} {error}") from None
    return options


def _rate(value: str) -> int:
    if not re.fullmatch(r"[1-9]\d{1,6}", value, re.ASCII):
        raise ValueError(f"has the rate {quoted(value)}: write a number of bits a second, such as baud=9600")
    return int(value)


def _one_of(key: str, known: tuple[Any, ...]) -> Callable[[str], Any]:
    def read(value: str) -> Any:
        for each in known:
            if value.lower() == str(each):
                return each
        raise ValueError(f"sets {key}={quoted(value)}: write {key}={f' or {key}='.join(map(str, known))}")

    return read


def _protocol(value: str) -> str:
    if not re.fullmatch(r"[a-z][a-z0-9-]{0,30}", value, re.ASCII):
        raise ValueError("names no protocol: write ?protocol=house, for example")
    return value


def _ca(value: str) -> str:
    if not value or not value.isprintable():
        raise ValueError("names no file of certificates: write ca=FILE.pem")
    return value


def _fingerprint(value: str) -> str:
    digest = value.removeprefix("sha256:").replace(":", "").lower()
    if not value.startswith("sha256:") or not re.fullmatch(r"[0-9a-f]{64}", digest, re.ASCII):
        raise ValueError("has no fingerprint: write fingerprint=sha256: and 64 hexadecimal digits")
    return digest


_READERS: dict[str, Callable[[str], Any]] = {
    "baud": _rate,
    "bits": _one_of("bits", DATA_BITS),
    "parity": _one_of("parity", PARITIES),
    "stop": _one_of("stop", STOP_BITS),
    "flow": _one_of("flow", FLOWS),
    "ca": _ca,
    "fingerprint": _fingerprint,
    "protocol": _protocol,
}
