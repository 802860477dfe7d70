"""Verbs that only look: which serial ports there are, and what answers at an address."""

from __future__ import annotations

import argparse
from contextlib import closing
from dataclasses import asdict

from amp_studio.files import fitted_axes
from amp_studio.report.wording import counted
from amp_studio.transfer.client.drivers import open_driver_at
from amp_studio.transfer.client.exchange import look_at
from amp_studio.transfer.content import decode_content
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.image import ImageError
from amp_studio.transfer.links.serial_ports import serial_ports

from .by_hand import note_by_hand, sheet_offered
from .console import family, print_json, progress


def ports_verb(options: argparse.Namespace) -> int:
    """List the serial ports."""
    found = serial_ports()
    if options.json:
        print_json({"ports": [asdict(port) | {"description": port.description} for port in found]})
        return 0
    for port in found:
        print(f"{port.device:20} {port.description}".rstrip())
        if port.lasting:
            print(f"{'':20} also {port.lasting}")
    if not found:
        print("There are no serial ports.")
    return 0


def identify_verb(options: argparse.Namespace) -> int:
    """Print who answers at an address, and what it contains."""
    if options.family:
        family(options.family)
    exchange = Exchange(progress())
    with (
        closing(open_driver_at(options.address, options.family or "", exchange)) as driver,
        sheet_offered(options.family or ""),
    ):
        abilities = driver.abilities
        control, content, digest = look_at(driver, exchange)
    note_by_hand(control.family)
    unreadable, axes, values, signature = "", list(control.axes), None, control.signature
    try:
        file = decode_content(content)
        axes, values = axes or list(fitted_axes(file)), len(file.values)
        signature = signature or file.schema.signature
    except ImageError as error:
        unreadable = str(error) if content else "it is empty"
    if options.json:
        print_json({
            "address": options.address, "protocol": control.protocol, "abilities": asdict(abilities),
            "family": control.family, "name": control.name, "revision": control.revision, "axes": axes,
            "signature": signature, "size": len(content), "sha256": digest, "values": values,
            "unreadable": unreadable or None, "in_estop": control.in_estop, "restart_needed": control.restart_needed,
        })  # fmt: skip
        return 0
    print(
        f"{control.name or 'A control'} of the family {control.family}, revision {control.revision or 'unknown'}"
    )
    print(f"protocol {control.protocol}" + ("" if abilities.can_send else ", which takes no download"))
    if abilities.can_send:
        print(abilities.lasting_text())
    print(f"axes {', '.join(axes)}" if axes else "axes unknown")
    print(
        f"{len(content)} bytes, "
        + (f"not readable: {unreadable}" if unreadable else counted(values or 0, "value"))
    )
    print(f"sha256 {digest}")
    if control.restart_needed:
        print("Its parameters become active after a restart.")
    return 0
