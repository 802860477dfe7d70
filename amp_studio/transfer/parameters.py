"""Parameter files and the control: what the command line and the desktop program ask for."""

from __future__ import annotations

import contextlib
import tempfile
import threading
from datetime import datetime
from pathlib import Path

from amp_studio.files import ENDING, ParameterFile, content_of, new_file, write_atomic
from amp_studio.schema import Address, fault, written

from .control import Control
from .emulator import serve
from .exchange import Outcome, download, upload
from .faults import read_faults
from .image import ImageFault, decode_image, encode_image, patch_image
from .record import Identity
from .session import Progress, Session, quiet

__all__ = ["Outcome", "download_file", "emulate", "fetch_file", "keep_image", "out_of_range"]


def download_file(
    file: ParameterFile, address: str, folder: Path, stem: str, progress: Progress = quiet,
    cancel: threading.Event | None = None,
) -> Outcome:  # fmt: skip
    """Put a file into the control at ``address``; what it held is kept in ``folder`` before anything is replaced.

    Raises TransferError, whose text says what the control holds, and ValueError for an address that is none.
    """

    def keep(image: bytes) -> str:
        return str(keep_image(image, folder, stem))

    with Session.at(address, family=file.schema.family.family) as session:
        return download(
            session,
            encode_image(file),
            keep,
            signature=file.schema.signature,
            progress=progress,
            cancel=cancel,
        )


def fetch_file(
    address: str, progress: Progress = quiet, cancel: threading.Event | None = None
) -> ParameterFile:
    """Return what the control at ``address`` holds as a parameter file; raises TransferError, ImageFault."""
    with Session.at(address) as session:
        return decode_image(upload(session, progress, cancel))


def keep_image(image: bytes, folder: Path, stem: str) -> Path:
    """Keep an image as a parameter file that can be downloaded again; one that cannot be read is kept as it is."""
    stamp = datetime.now().astimezone().strftime("%Y%m%d-%H%M%S")
    name = f"{stem}.before-{stamp}"
    number = 1
    while any((folder / f"{name}{ending}").exists() for ending in (ENDING, ".img")):
        number += 1
        name = f"{stem}.before-{stamp}-{number}"
    try:
        file = decode_image(image)
    except ImageFault:
        path, content = folder / f"{name}.img", image
    else:
        file.header.name, path = name, folder / f"{name}{ENDING}"
        content = content_of(file)
    write_atomic(path, content, expected=None)
    return path


def out_of_range(file: ParameterFile) -> list[tuple[Address, str]]:
    """Return every value of an upload that its parameter does not allow, with one sentence each."""
    found = []
    for address in file.addresses():
        value = file.get(address)
        if value is None or file.situation.state(address).state == "hidden":
            continue
        said = fault(file.situation, address, value)
        if said:
            found.append(
                (address, f"{file.schema.label(address, file.machine)} ({written(address)}): {said}")
            )
    return found


def emulate(
    family: str, listen: str, state: Path | None = None, *, machine: str | None = None, estop: bool = True,
    autostart: bool = True,
    faults: str = "{}",
) -> int:  # fmt: skip
    """Run an emulated control until it is told to quit; returns the exit code.

    It is born with the family's printed defaults; its memory lies in ``state``, or in a temporary folder. ``faults``
    are what goes wrong, to practise with, as one JSON object.
    """
    file = new_file(family, machine)
    identity = Identity(family=family, signature=file.schema.signature, name="CNC_1", revision="emulated")
    with contextlib.ExitStack() as stack:
        folder = state or Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="amp-studio-control-")))
        folder.mkdir(parents=True, exist_ok=True)
        control = Control(
            folder, identity, encode_image(file), estop=estop, autostart=autostart, accept=decode_image
        )
        return serve(listen, control, patch=patch_image, faults=read_faults(faults))
