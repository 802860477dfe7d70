"""Parameter files and the control: what the command line and the desktop program ask for."""

from __future__ import annotations

import contextlib
import hashlib
import re
import tempfile
import threading
from pathlib import Path

from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Address, fault, written

from .control import Control
from .emulator import serve
from .exchange import Keep, Outcome, download, upload
from .faults import read_faults
from .image import decode_image, encode_image, patch_image
from .interrupts import interrupts
from .kept import BEFORE, Copy, keep_image, open_copy
from .record import Identity
from .session import Progress, Session, quiet

__all__ = ["Copy", "Outcome", "download_file", "emulate", "fetch_file", "fetch_image", "open_copy", "out_of_range",
           "read_digest", "restore_copy", "sha256"]  # fmt: skip


def download_file(
    file: ParameterFile, address: str, folder: Path, stem: str, progress: Progress = quiet,
    cancel: threading.Event | None = None, *, expected: str | None = None,
) -> Outcome:  # fmt: skip
    """Put a file into the control at ``address``; what it held is kept in ``folder`` before anything is replaced.

    ``expected`` is the digest of what may be replaced, None for whatever is there. Raises TransferError, whose
    text says what the control holds, ImageFault for a file no image can carry, and ValueError for an address or
    a digest that is none.
    """
    image, approved = encode_image(file), read_digest(expected)
    decode_image(image)  # what cannot be read again is not sent
    with Session.at(address, family=file.schema.family.family) as session:
        return download(session, image, _keep_in(folder, stem), signature=file.schema.signature, expected=approved,
                        progress=progress, cancel=cancel)  # fmt: skip


def restore_copy(
    copy: Copy, address: str, folder: Path, stem: str, progress: Progress = quiet,
    cancel: threading.Event | None = None, *, expected: str | None = None,
) -> Outcome:  # fmt: skip
    """Put back what a control has held, byte for byte; what it holds instead is kept in ``folder`` first.

    What is kept goes back whatever it is, for the control to say whether it has held it. Raises as ``download_file``.
    """
    family = copy.file.schema.family.family if copy.file and not copy.is_kept else ""
    approved = read_digest(expected)
    with Session.at(address, family=family) as session:
        return download(session, copy.image, _keep_in(folder, stem), signature=copy.signature, expected=approved,
                        is_return=copy.is_kept, progress=progress, cancel=cancel)  # fmt: skip


def _keep_in(folder: Path, stem: str) -> Keep:
    return lambda image: str(keep_image(image, folder, stem.partition(BEFORE)[0]))


def sha256(image: bytes) -> str:
    """Return the digest of an image in hexadecimal, by which a person names it."""
    return hashlib.sha256(image).hexdigest()


def read_digest(text: str | None) -> bytes | None:
    """Return the SHA-256 a person passes on; raises ValueError."""
    if text is None:
        return None
    if not re.fullmatch("[0-9a-fA-F]{64}", text.strip()):
        raise ValueError(
            f"'{text}' is no SHA-256: write its 64 hexadecimal digits, as verify and upload print them"
        )
    return bytes.fromhex(text.strip())


def fetch_image(
    address: str, progress: Progress = quiet, cancel: threading.Event | None = None, *, family: str = ""
) -> bytes:
    """Return what the control at ``address`` holds, byte for byte; raises TransferError."""
    with Session.at(address, family=family) as session:
        return upload(session, progress, cancel)


def fetch_file(
    address: str, progress: Progress = quiet, cancel: threading.Event | None = None
) -> ParameterFile:
    """Return what the control at ``address`` holds as a parameter file; raises TransferError, ImageFault."""
    return decode_image(fetch_image(address, progress, cancel))


def out_of_range(file: ParameterFile) -> list[tuple[Address, str]]:
    """Return every value of an upload that its parameter does not allow, with one sentence each."""
    found = []
    for address in file.addresses():
        value = file.get(address)
        if value is None or file.evaluation.state(address).state == "hidden":
            continue
        said = fault(file.evaluation, address, value)
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
