"""An emulated control of a family, as it is delivered: on the line that the endpoint names,
in the protocol it names.
"""

from __future__ import annotations

import contextlib
import tempfile
import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from amp_studio.files import new_file
from amp_studio.schema import load_part, quoted, registration_of
from amp_studio.transfer.image import decode_image, encode_image, patch_image
from amp_studio.transfer.interruption import interrupts
from amp_studio.transfer.links import Endpoint, parse_endpoint
from amp_studio.transfer.ways import HOUSE, in_order_of_ways

from .control import Control
from .emulator import serve
from .faults import read_faults
from .panel import OperatorPanel
from .record import Identity


@dataclass(frozen=True)
class EmulatedOptions:
    """What an emulated control is like.

    ``state``    the folder of its memory; None for a temporary one
    ``machine``  the machine type, None for the family's first
    ``estop``, ``autostart``  as it begins, where a protocol knows of them
    ``faults``   what goes wrong, to practise with, as one JSON object
    ``screen``   where its screen is read; None for nowhere
    ``hardware`` what was ordered with it, by the names that its family knows
    """

    family: str
    state: Path | None = None
    machine: str | None = None
    estop: bool = True
    autostart: bool = True
    faults: str = "{}"
    screen: Endpoint | None = None
    hardware: Mapping[str, str] = field(default_factory=dict)


Emulate = Callable[[Endpoint, EmulatedOptions], int]
"""Be a control until asked to quit; prints ``listening on ADDRESS`` when it is ready
and returns the exit code."""


def emulate(listen: Endpoint | str, options: EmulatedOptions) -> int:
    """Run an emulated control of a family until it is asked to quit; returns the exit code.

    ``?protocol=NAME`` of the address chooses what it speaks; else it is the family's first protocol that has
    an emulated control. Raises ValueError for an address that is none and for a protocol without one.
    """
    place = parse_endpoint(listen) if isinstance(listen, str) else listen
    offered = emulators_of(options.family)
    if not offered:
        raise ValueError(
            f"There is no emulated control of {options.family}: its facts list no line and no gateway (see"
            " 'ways' in family.yaml)"
        )
    name = place.protocol or next(iter(offered))
    if name not in offered:
        raise ValueError(
            f"There is no emulated control of {options.family} with the protocol {quoted(name)}. "
            f"Known: {', '.join(offered)}"
        )
    run: Emulate = load_part(offered[name])
    # Its address names the protocol, where a client would try the house protocol on it.
    return run(replace(place, protocol=place.protocol or ("" if name == HOUSE else name)), options)


def emulators_of(family: str) -> dict[str, str]:
    """Return protocol -> emulated control, the usual one first;
    none where no way to a control of the family is known.
    """
    return in_order_of_ways(
        family, registration_of(family).emulators, "amp_studio.transfer.emulated.family_control:emulate_house"
    )


def protocol_of_machine(family: str) -> str:
    """Return the protocol whose emulated control has the machine of the family behind it; "" for that of a
    gateway, which has parameters alone where its family brings nothing to it.
    """
    name = next(iter(registration_of(family).emulators), HOUSE)
    return "" if name == HOUSE else name


def emulate_house(listen: Endpoint, options: EmulatedOptions) -> int:
    """Run an emulated control in the house protocol; it begins with the family's printed defaults."""
    if options.hardware:
        raise ValueError(f"an emulated control of {options.family} has no options")
    return run_house(listen, options)


def run_house(listen: Endpoint, options: EmulatedOptions, panel: OperatorPanel | None = None) -> int:
    """Run an emulated control in the house protocol, with what its family does at its own panel."""
    stop = threading.Event()
    with contextlib.ExitStack() as stack:
        stack.enter_context(interrupts(stop.set))
        file = new_file(options.family, options.machine)
        identity = Identity(
            family=options.family, signature=file.schema.signature, name="CNC_1", revision="emulated"
        )
        folder = memory_folder(options, stack)
        control = Control(
            folder,
            identity,
            encode_image(file),
            estop=options.estop,
            autostart=options.autostart,
            accept=decode_image,
        )
        return serve(
            listen,
            control,
            patch=patch_image,
            panel=panel,
            faults=read_faults(options.faults),
            screen=options.screen,
            stop=stop,
        )


def memory_folder(options: EmulatedOptions, stack: contextlib.ExitStack) -> Path:
    """Return the folder of its memory, which is there; a temporary one goes with the stack."""
    folder = options.state or Path(
        stack.enter_context(tempfile.TemporaryDirectory(prefix="amp-studio-control-"))
    )
    folder.mkdir(parents=True, exist_ok=True)
    return folder
