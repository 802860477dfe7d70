"""Parameter files and the control: what the command line and the desktop program ask for."""

from __future__ import annotations

import hashlib
import re
import threading
from contextlib import closing
from functools import partial
from pathlib import Path

from amp_studio.files import ParameterFile
from amp_studio.schema.quoting import quoted
from amp_studio.transfer.content import decode_content
from amp_studio.transfer.progress import Progress, quiet

from .drivers import open_driver
from .exchange import Keep, Outcome, download, upload
from .kept import BEFORE, Copy, keep_image, open_copy

__all__ = [
    "Copy",
    "Outcome",
    "download_file",
    "fetch_file",
    "fetch_image",
    "open_copy",
    "read_digest",
    "restore_copy",
    "sha256",
]


def download_file(
    file: ParameterFile, address: str, folder: Path, stem: str, progress: Progress = quiet,
    cancel: threading.Event | None = None, *, expected: str | None = None,
) -> Outcome:  # fmt: skip
    """Put a file into the control at ``address``; what it contained is kept in ``folder`` before anything is replaced.

    ``expected`` is the digest of what may be replaced, None for whatever is there. Raises TransferError, whose
    text names what the control contains, ImageError for a file no image can carry or that sets what the control does not have, and ValueError for an address or
    a digest that is none.
    """
    approved = read_digest(expected)
    with closing(open_driver(address, file.schema.family.family)) as driver:
        return download(driver, partial(driver.encode, file), _keep_in(folder, stem), signature=file.schema.signature,
                        expected=approved, progress=progress, cancel=cancel)  # fmt: skip


def restore_copy(
    copy: Copy, address: str, folder: Path, stem: str, progress: Progress = quiet,
    cancel: threading.Event | None = None, *, expected: str | None = None,
) -> Outcome:  # fmt: skip
    """Put back what a control has contained, byte for byte; what it contains instead is kept in ``folder`` first.

    What is kept goes back whatever it is, for the control to decide whether it has contained it. Raises as ``download_file``.
    """
    family = copy.file.schema.family.family if copy.file and not copy.is_kept else ""
    approved = read_digest(expected)
    with closing(open_driver(address, family)) as driver:
        wanted = partial(driver.refit, copy.image)
        if copy.file is not None and not copy.is_kept:
            wanted = partial(driver.encode, copy.file)
        return download(driver, wanted, _keep_in(folder, stem), signature=copy.signature, expected=approved,
                        is_return=copy.is_kept, what="Restore", progress=progress, cancel=cancel)  # fmt: skip


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
            f"{quoted(text)} is no SHA-256: write its 64 hexadecimal digits, as verify and upload print them"
        )
    return bytes.fromhex(text.strip())


def fetch_image(
    address: str, progress: Progress = quiet, cancel: threading.Event | None = None, *, family: str = ""
) -> bytes:
    """Return what the control at ``address`` contains, byte for byte; raises TransferError."""
    with closing(open_driver(address, family)) as driver:
        return upload(driver, progress, cancel)


def fetch_file(
    address: str, progress: Progress = quiet, cancel: threading.Event | None = None
) -> ParameterFile:
    """Return what the control at ``address`` contains as a parameter file; raises TransferError, ImageError."""
    return decode_content(fetch_image(address, progress, cancel))
