"""The serial ports of this computer, with what their USB devices report about themselves."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class SerialPort:
    """A port: ``device`` is what an endpoint names; the rest is "" where nothing is known."""

    device: str
    name: str
    manufacturer: str
    usb_id: str
    serial_number: str


def serial_ports() -> list[SerialPort]:
    """Return the ports there are, by device."""
    from serial.tools.list_ports import comports

    return [
        SerialPort(
            port.device,
            port.product or (port.description if port.description != "n/a" else "") or "",
            port.manufacturer or "",
            f"{port.vid:04x}:{port.pid:04x}" if port.vid is not None and port.pid is not None else "",
            port.serial_number or "",
        )
        for port in sorted(comports(), key=lambda port: port.device)
    ]
