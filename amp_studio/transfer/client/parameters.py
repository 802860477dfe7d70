"""Parameter files and the control: what the command line and the desktop program ask for."""

from __future__ import annotations

import hashlib
import re
from contextlib import closing
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Self

from amp_studio.errors import AmpStudioError
from amp_studio.files import BEFORE, ParameterFile
from amp_studio.schema import quoted
from amp_studio.transfer.content import ContentKind, decode_content
from amp_studio.transfer.driver import ControlDriver
from amp_studio.transfer.exchange import QUIET, Exchange

from .drivers import open_driver, open_driver_at
from .exchange import Outcome, WantedContent, upload
from .kept import Copy, keep_image, keep_readable, open_copy
from .recording import Recording

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


class DigestError(AmpStudioError, ValueError):
    """A text that is no SHA-256."""


def download_file(
    file: ParameterFile,
    address: str,
    exchange: Exchange,
    *,
    expected: str | None = None,
    known: bytes | None = None,
) -> Outcome:
    """Put a file into the control at ``address``; what it contained is kept before anything is replaced,
    and all of it recorded.

    ``expected`` is the digest of what may be replaced, None for whatever is there; ``known`` is what was
    fetched from this control just before. Raises TransferError, whose text names what the control contains,
    ImageError for a file no image can carry or that sets what the control cannot take,
    EndpointError or DigestError for an address or a digest that is none.
    """
    approved = read_digest(expected)
    family = file.schema.family.family
    remarks: list[str] = []
    with closing(open_driver(address, family)) as driver:

        def content(current: bytes) -> bytes:
            made = driver.encode(file, current)
            remarks[:] = remarks_of(driver, file, current)
            return made

        wanted = WantedContent(content, file.schema.signature, approved, known)
        outcome = download_content(driver, wanted, Recording("download", family, address, exchange))
    return replace(outcome, text=" ".join([outcome.text, *remarks]))


def download_content(driver: ControlDriver, wanted: WantedContent, recording: Recording) -> Outcome:
    """Keep, download and record; the parameter file beside the copy is written while the control restarts."""
    with _Keeping(driver, recording) as copy:
        return recording.run(driver, wanted, copy.keep, meanwhile=copy.finish)


def remarks_of(kind: ContentKind, file: ParameterFile, current: bytes) -> list[str]:
    """Return what of a file is not sent to a control that contains ``current``, and what stays there,
    each in a sentence.
    """
    texts = (
        ("Not sent", kind.left_out(file, current)),
        ("Not in the file, and as the control has it", kind.stays(file, current)),
    )
    return [f"{what}: {text}." for what, text in texts if text]


def restore_copy(copy: Copy, address: str, exchange: Exchange, *, expected: str | None = None) -> Outcome:
    """Put back what a control has contained, byte for byte; what it contains instead is kept first.

    What is kept goes back whatever it is, for the control to decide whether it has contained it.
    Raises as ``download_file``.
    """
    approved = read_digest(expected)
    with closing(open_driver(address, copy.family)) as driver:
        content = partial(driver.refit, copy.image)
        if copy.file is not None and not copy.is_kept:
            content = partial(driver.encode, copy.file)
        of = copy.file.schema.family.family if copy.file else ""
        wanted = WantedContent(content, copy.signature, approved, is_return=copy.is_kept, what="Restore")
        return download_content(driver, wanted, Recording("restore", of, address, exchange))


class _Keeping:
    """Keeps what a control contained in a folder: its bytes at once,
    the parameter file beside them when there is time.
    """

    def __init__(self, kind: ContentKind, recording: Recording) -> None:
        place = recording.exchange.keep
        if place is None:
            raise ValueError("a download needs a place for the copy of what it replaces")
        self._folder, self._stem = place.parent, place.stem.partition(BEFORE)[0]
        self._kind, self._recording = kind, recording
        self._kept: tuple[bytes, Path] | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.finish()

    def keep(self, content: bytes) -> str:
        """Keep the bytes and return where; raises CopyError for less than the last copy of the control has,
        OSError.
        """
        self._recording.check_whole(self._kind, content, self._folder)
        path = keep_image(content, self._folder, self._stem, readable=False)
        self._kept = content, path
        return str(path)

    def finish(self) -> None:
        """Write the parameter file, unless it is there already."""
        kept, self._kept = self._kept, None
        if kept is not None:
            keep_readable(*kept)


def sha256(image: bytes) -> str:
    """Return the digest of an image in hexadecimal, by which a person names it."""
    return hashlib.sha256(image).hexdigest()


def read_digest(text: str | None) -> bytes | None:
    """Return the SHA-256 a person passes on; raises DigestError."""
    if text is None:
        return None
    if not re.fullmatch("[0-9a-fA-F]{64}", text.strip()):
        raise DigestError(
            f"{quoted(text)} is no SHA-256: write its 64 hexadecimal digits, as verify and upload print them"
        )
    return bytes.fromhex(text.strip())


def fetch_image(address: str, exchange: Exchange = QUIET, *, family: str = "") -> bytes:
    """Return what the control at ``address`` contains, byte for byte; raises TransferError."""
    with closing(open_driver_at(address, family, exchange)) as driver:
        return upload(driver, exchange)


def fetch_file(address: str, exchange: Exchange = QUIET, *, family: str = "") -> ParameterFile:
    """Return what the control at ``address`` contains as a parameter file; raises TransferError,
    ImageError.
    """
    return decode_content(fetch_image(address, exchange, family=family))
