"""Two images and how they are sent, for every test of the line."""

import hashlib
from typing import Any

from amp_studio.transfer.exchange import Exchange, Replacement
from amp_studio.transfer.house.session import Session

OLD = b"1 old\n" * 20
NEW = b"2 new!\n" * 25


def sha(image: bytes) -> bytes:
    """Return what the control compares."""
    return hashlib.sha256(image).digest()


def send(session: Session, image: bytes = NEW, content: bytes = OLD, **options: Any) -> Any:
    """Send an image to a control that contains the old one."""
    return session.send(Replacement(image, content, "s1"), Exchange(**options))
