"""Copies of what a control contained: kept byte for byte before anything is replaced,
and put back as they are.

``NAME.before-STAMP.img`` is the image itself, ``NAME.before-STAMP.img.sha256`` its digest as ``sha256sum``
writes it. ``NAME.before-STAMP.amp`` is there as well where a parameter file contains exactly the same.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import re
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from amp_studio.errors import AmpStudioError
from amp_studio.files import (
    BEFORE,
    ENDING,
    ChangedOnDiskError,
    ParameterFile,
    ParameterFileError,
    content_of,
    open_file,
    read_content,
    write_atomic,
)
from amp_studio.schema import read_file
from amp_studio.transfer.content import decode_content, family_of, kind_of
from amp_studio.transfer.image import MAGIC, ImageError

IMAGE = ".img"
DIGEST = ".sha256"
LARGEST = 1 << 26  # bytes of an image, as in an exchange
_STEM = 120
"""Bytes of a file's name that its copies take over, so that the whole name is short enough for every disk."""
_SIGNED = re.compile(rb"%s\nfamily [^\n]*\nsignature ([0-9a-f]{64})\n" % MAGIC.encode())


class CopyError(AmpStudioError, ValueError):
    """A copy that is not what was kept, or none at all; one clear sentence."""


@dataclass(frozen=True)
class Copy:
    """An image that is to be put back.

    ``image``      its bytes
    ``signature``  of the schema it was made under, as far as that is known, else ""
    ``file``       what it means; None where this program cannot read it
    ``fault``      why it cannot
    ``is_checked`` whether it was compared with a digest beside it
    ``is_kept``    whether it is what a control contained, byte for byte: an image,
                   or a parameter file beside its image
    ``path``       where it was read
    """

    image: bytes
    signature: str
    file: ParameterFile | None
    fault: str
    is_checked: bool
    is_kept: bool
    path: Path

    @property
    def family(self) -> str:
        """The family the control must be of; "" for an image of the house that a control has contained:
        it decides itself.
        """
        if self.file is not None and not self.is_kept:
            return self.file.schema.family.family
        return family_of(self.image)


def keep_image(image: bytes, folder: Path, stem: str, *, readable: bool = True) -> Path:
    """Keep an image under a name that was free, and where possible a parameter file beside it;
    returns the image's path.

    Without ``readable`` the parameter file is left to ``keep_readable``, for which there is time later: the
    image is the copy. Raises OSError, and then nothing is left behind.
    """
    # By bytes, for that is what a disk counts; a character that was cut in two is left out.
    stem = stem.encode()[:_STEM].decode(errors="ignore")
    stamp = datetime.now().astimezone().strftime("%Y%m%d-%H%M%S")
    number = 1
    while True:
        path = folder / f"{stem}{BEFORE}{stamp}{'' if number == 1 else f'-{number}'}{IMAGE}"
        try:
            # The parameter file beside it must not replace another one of that name.
            _need_free(path.with_suffix(ENDING))
            save_image(image, path)
        except FileExistsError:
            number += 1
            continue
        if readable:
            keep_readable(image, path)
        return path


def save_image(image: bytes, path: Path) -> None:
    """Write an image and its digest under a name that nothing has; raises FileExistsError, OSError."""
    beside = digest_path(path)
    for name in (beside, path):
        _need_free(name)
    line = f"{hashlib.sha256(image).hexdigest()}  {path.name}\n".encode(errors="surrogateescape")
    written = []
    try:
        for name, content in ((beside, line), (path, image)):  # an image that is there has its digest
            write_atomic(name, content, expected=None, keep_backup=False)
            written.append(name)
    except BaseException as error:
        for name in written:
            with contextlib.suppress(OSError):
                name.unlink(missing_ok=True)
        if isinstance(error, ChangedOnDiskError):  # another program has taken the name meanwhile
            raise FileExistsError(str(error)) from None
        raise


def _need_free(path: Path) -> None:
    if os.path.lexists(path):  # a link that leads nowhere has the name too
        raise FileExistsError(f"{path} exists already")


def keep_readable(image: bytes, kept: Path) -> None:
    """Write the parameter file of an image, which is ``kept``,
    beside it where it comes back as the same bytes.
    """
    path = kept.with_suffix(ENDING)
    with contextlib.suppress(ImageError, ParameterFileError, OSError):
        kind = kind_of(image)
        file = kind.decode(image)
        file.header.name = path.stem
        content = content_of(file)
        # Only a file that means every byte of the image may be put back in its place.
        if kind.encode(read_content(path, content), image) == image:
            write_atomic(path, content, expected=None)


def digest_path(path: Path) -> Path:
    """Return where the digest of an image lies."""
    return path.with_name(path.name + DIGEST)


def open_copy(path: Path) -> Copy:
    """Read a copy, checked against the digest beside it where there is one; raises CopyError,
    ParameterFileError.
    """
    if path.suffix == ENDING:
        file = open_file(path).file
        beside = path.with_suffix(IMAGE)
        current = _content(beside) if beside.is_file() else b""
        image = kind_of(current).encode(file, current)
        is_kept = image == current
        return Copy(image, file.schema.signature, file, "", is_checked=True, is_kept=is_kept, path=path)
    if path.suffix != IMAGE:
        raise CopyError(f"{path} is no copy of what a control contained: those end in {IMAGE} or {ENDING}")
    image = _content(path)
    is_checked = os.path.lexists(digest_path(path))  # one that cannot be read is not none
    if is_checked:
        _check(path, image)
    signed = _SIGNED.match(image)
    signature = signed[1].decode() if signed else ""
    try:
        file = decode_content(image)
        return Copy(image, file.schema.signature, file, "", is_checked, is_kept=True, path=path)
    except ImageError as error:
        return Copy(image, signature, None, str(error), is_checked, is_kept=True, path=path)


def _content(path: Path) -> bytes:
    try:
        return read_file(path, LARGEST)
    except OSError as error:
        raise CopyError(f"{path} cannot be read: {error.strerror}") from None


def _check(path: Path, image: bytes) -> None:
    beside = digest_path(path)
    digest = _content(beside)[:64].decode("ascii", errors="replace").casefold()
    if not re.fullmatch("[0-9a-f]{64}", digest):
        raise CopyError(
            f"{beside} contains no digest as sha256sum writes it: remove it to put {path.name} back unchecked"
        )
    if digest != hashlib.sha256(image).hexdigest():
        raise CopyError(f"{path} is not what was kept: its digest is not the one in {beside.name}")
