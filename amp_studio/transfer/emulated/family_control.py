"""An emulated control of a family, as it is delivered."""

from __future__ import annotations

import contextlib
import tempfile
import threading
from pathlib import Path

from amp_studio.files import new_file
from amp_studio.transfer.image import decode_image, encode_image, patch_image
from amp_studio.transfer.interrupts import interrupts

from .control import Control
from .emulator import serve
from .faults import read_faults
from .record import Identity


def emulate(
    family: str, listen: str, state: Path | None = None, *, machine: str | None = None, estop: bool = True,
    autostart: bool = True,
    faults: str = "{}",
) -> int:  # fmt: skip
    """Run an emulated control until it is asked to quit; returns the exit code.

    It begins with the family's printed defaults; its memory lies in ``state``, or in a temporary folder. ``faults``
    are what goes wrong, to practise with, as one JSON object.
    """
    stop = threading.Event()
    with contextlib.ExitStack() as stack:
        stack.enter_context(interrupts(stop.set))
        file = new_file(family, machine)
        identity = Identity(family=family, signature=file.schema.signature, name="CNC_1", revision="emulated")
        folder = state or Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="amp-studio-control-")))
        folder.mkdir(parents=True, exist_ok=True)
        control = Control(
            folder, identity, encode_image(file), estop=estop, autostart=autostart, accept=decode_image
        )
        return serve(listen, control, patch=patch_image, faults=read_faults(faults), stop=stop)
