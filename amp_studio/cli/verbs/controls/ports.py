"""The serial ports of this computer."""

from __future__ import annotations

from dataclasses import asdict

from amp_studio.cli.arguments import JSON
from amp_studio.cli.console import print_json
from amp_studio.cli.verb import Options, Verb

VERB = Verb(__doc__, JSON, examples=("amp-studio ports",))


def run(options: Options) -> int:
    """List the serial ports."""
    from amp_studio.transfer.links import serial_ports

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
