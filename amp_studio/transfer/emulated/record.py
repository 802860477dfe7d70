"""What an emulated control remembers besides its images."""

from __future__ import annotations

import json
import re
from dataclasses import asdict, dataclass, field, fields
from typing import Any

from amp_studio.schema import short
from amp_studio.transfer.house import Committed, Flags

from .memory import Memory

RECORD = "control.json"
_REMEMBERED = 100  # digests of images a control has contained
LAST = (1 << 32) - 1  # the greatest number of a start that the wire can carry


class StateError(ValueError):
    """A state folder that cannot be used; one clear sentence."""


@dataclass(frozen=True)
class Identity:
    """What a control answers about itself: family id, signature of its schema, its name,
    its software revision.
    """

    family: str
    signature: str
    name: str = "Emulated control"
    revision: str = "1.0"


@dataclass
class Record:
    """The state of a control.

    ``committed`` is its answer to the last commit, in words JSON has; ``images`` are the digests of what it
    has contained, the newest last.
    """

    family: str
    signature: str
    estop: bool = True
    autostart: bool = True
    incarnation: int = 0
    running: bool = True
    restart_needed: bool = False
    changed_at_control: bool = False
    committed: dict[str, Any] | None = None
    images: list[str] = field(default_factory=list)

    def remember(self, sha256: bytes) -> None:
        """Remember that the control contains an image with this digest."""
        digest = sha256.hex()
        self.images = [*(d for d in self.images if d != digest), digest][-_REMEMBERED:]

    def has_contained(self, sha256: bytes) -> bool:
        """Whether the control has contained this image, so that it may be given back whatever it is."""
        return sha256.hex() in self.images

    def save(self, memory: Memory) -> None:
        """Write the record; raises OSError, and then the old one stays."""
        memory.replace(RECORD, to_json(asdict(self)))

    def flags(self) -> Flags:
        """Return the state as it is sent."""
        flags = Flags(0)
        for on, flag in (
            (self.estop, Flags.ESTOP),
            (self.running, Flags.RUNNING),
            (self.restart_needed, Flags.RESTART_NEEDED),
            (self.autostart, Flags.AUTOSTART),
            (self.changed_at_control, Flags.CHANGED_AT_CONTROL),
        ):
            if on:
                flags |= flag
        return flags

    def answer_to(self, transfer: bytes, sha256: bytes) -> Committed | None:
        """Return what was answered to this commit, if it was the last that happened."""
        found = self.committed
        if found is None or (found["transfer"], found["sha256"]) != (transfer.hex(), sha256.hex()):
            return None
        return Committed(transfer, sha256, found["incarnation"], found["restarting"])


def load_record(memory: Memory, identity: Identity) -> Record:
    """Return a folder's record, or a new one; raises StateError when it is another control's or damaged."""
    found = load_json(memory, RECORD)
    if found is None:
        return Record(identity.family, identity.signature)
    try:
        record = Record(**found)
    except TypeError:
        record = None
    if record is None or not _is_sound(record):
        raise StateError(f"{memory.folder / RECORD} is not what an emulated control writes")
    if record.family != identity.family:
        raise StateError(
            f"{memory.folder} is the memory of a {short(record.family)}, not of a {identity.family}"
        )
    if record.signature != identity.signature:
        raise StateError(f"{memory.folder} is the memory of a control with another parameter schema")
    return record


def _is_sound(record: Record) -> bool:
    """Whether every field has the type it is written with, and the numbers have the size of the wire."""
    new = Record("", "")
    for name in (each.name for each in fields(Record) if each.name != "committed"):
        if type(getattr(record, name)) is not type(getattr(new, name)):
            return False
    return 0 <= record.incarnation < LAST and (record.committed is None or is_answer(record.committed))


def is_answer(found: object) -> bool:
    """Return whether this is a Committed as ``written`` gives it."""
    if not isinstance(found, dict) or set(found) != {each.name for each in fields(Committed)}:
        return False
    digits = all(
        isinstance(found[name], str) and re.fullmatch(f"[0-9a-f]{{{length}}}", found[name])
        for name, length in (("transfer", 32), ("sha256", 64))
    )
    number, restarting = found["incarnation"], found["restarting"]
    return digits and type(number) is int and 0 <= number <= LAST and type(restarting) is bool


def written(answer: Committed) -> dict[str, Any]:
    """Return an answer in words JSON has."""
    return {
        name: value.hex() if isinstance(value, bytes) else value for name, value in asdict(answer).items()
    }


def to_json(content: dict[str, Any]) -> bytes:
    """Return the bytes of a JSON file."""
    return json.dumps(content, indent=1).encode() + b"\n"


def load_json(memory: Memory, name: str) -> dict[str, Any] | None:
    """Return the object of a JSON file, None when there is no such file; raises StateError."""
    content = memory.read(name)
    if content is None:
        return None
    try:
        found = json.loads(content)
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict):
        raise StateError(f"{memory.folder / name} is damaged")
    return found
