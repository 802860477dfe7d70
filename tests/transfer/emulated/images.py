"""Two images, and how a client downloads one into a control without a line."""

import hashlib

from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.house.message import Commit, Committed, OpenDownload

NEW = b"new image\n" * 40
OLD = b"old image\n" * 30
TRANSFER = bytes(range(16))
LOCK = [".control.holder", ".control.lock"]


def sha(image: bytes) -> bytes:
    return hashlib.sha256(image).digest()


def opening(
    image: bytes = NEW, old: bytes = OLD, transfer: bytes = TRANSFER, signature: str = "s1"
) -> OpenDownload:
    return OpenDownload(transfer, len(image), sha(image), sha(old), signature)


def download(control: Control, image: bytes = NEW) -> Committed:
    """Take the download up where it is, and commit it."""
    offset = control.open_download(opening(image))
    while offset < len(image):
        control.stage(TRANSFER, image[offset : offset + 100])
        offset += len(image[offset : offset + 100])
    return control.commit(Commit(TRANSFER, sha(image)))
