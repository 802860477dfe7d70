"""The serial ports of this computer, with what their USB devices report about themselves."""

from __future__ import annotations

import contextlib
import re
from dataclasses import dataclass
from pathlib import Path

BY_ID = Path("/dev/serial/by-id")


@dataclass(frozen=True)
class SerialPort:
    """A port: ``device`` is what an endpoint names; the rest is "" where nothing is known.

    ``lasting`` is a name that stays with the adapter when it is plugged in elsewhere or after another one,
    and ``location`` the socket it is plugged into (bus, then port of each hub).
    """

    device: str
    name: str
    manufacturer: str
    usb_id: str
    serial_number: str
    location: str = ""
    lasting: str = ""

    @property
    def description(self) -> str:
        """What a person distinguishes it by."""
        name = self.name
        if self.manufacturer and self.manufacturer.casefold() not in name.casefold():
            name = f"{name} by {self.manufacturer}" if name else self.manufacturer
        parts = [name or ("USB adapter" if self.usb_id else "")]
        facts = (("number", self.serial_number), ("USB", self.usb_id), ("in USB socket", self.location))
        parts += [f"{what} {text}" for what, text in facts if text]
        return ", ".join(filter(None, parts))


def serial_ports() -> list[SerialPort]:
    """Return the ports there are, by device."""
    from serial.tools.list_ports import comports

    lasting = _lasting_names()
    return [
        SerialPort(
            port.device,
            port.product or (port.description if port.description != "n/a" else "") or "",
            port.manufacturer or "",
            f"{port.vid:04x}:{port.pid:04x}" if port.vid is not None and port.pid is not None else "",
            port.serial_number or "",
            port.location or "",
            lasting.get(port.device, ""),
        )
        for port in sorted(comports(), key=lambda port: _in_order(port.device))
    ]


def _in_order(device: str) -> list[tuple[str, int]]:
    """Return what devices are sorted by: COM2 comes before COM10."""
    return [(text, int(number or 0)) for text, number in re.findall(r"(\D+)(\d{0,9})", device)]


def _lasting_names() -> dict[str, str]:
    """Return device -> the name that udev gives it by its maker and number."""
    names: dict[str, str] = {}
    with contextlib.suppress(OSError):
        for link in sorted(BY_ID.iterdir()):
            names.setdefault(str(link.resolve()), str(link))
    return names
