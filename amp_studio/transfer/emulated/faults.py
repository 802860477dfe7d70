"""Faults on purpose: cables that are cut, bytes that change, a control that is full or dies in the middle.

They are for trying out what a client does; an emulated control can be started with any of them.
"""

from __future__ import annotations

import dataclasses
import json
import os
import signal
from dataclasses import dataclass
from typing import Any

from amp_studio.schema import quoted
from amp_studio.transfer.links import Link, LinkError

from .control import Control


@dataclass(frozen=True)
class Faults:
    """What goes wrong; nothing by default.

    ``drop_after_bytes``    cut the line when so many bytes have passed it, both ways together
    ``drops``               how many lines are cut so; 0 for every one
    ``corrupt_every``       change one bit in every so-many-th byte, each way
    ``lose_every``          lose every so-many-th byte, each way
    ``silent``              take everything, answer nothing
    ``disk_full_at``        a download cannot grow past so many bytes
    ``die_at_commit_step``  the process is killed just before this step of a commit, counted from 1
    """

    drop_after_bytes: int | None = None
    drops: int = 1
    corrupt_every: int | None = None
    lose_every: int | None = None
    silent: bool = False
    disk_full_at: int | None = None
    die_at_commit_step: int | None = None


def read_faults(text: str) -> Faults:
    """Return the faults a JSON object names; raises ValueError with one sentence for anything else."""
    try:
        found = json.loads(text)
    except (ValueError, RecursionError):
        found = None
    if not isinstance(found, dict):
        raise ValueError("faults are one JSON object")
    for name, value in found.items():
        _check_fault(name, value)
    return Faults(**found)


def _check_fault(name: str, value: object) -> None:
    """Raise ValueError for a fault that there is not, and for a value that is not of its kind."""
    known = [field.name for field in dataclasses.fields(Faults)]
    if name not in known:
        raise ValueError(f"there is no fault {quoted(name)}; there are {', '.join(known)}")
    if name == "silent" and not isinstance(value, bool):
        raise ValueError("the fault 'silent' must be true or false")
    # A yes/no is a whole number to Python.
    if name != "silent" and (not isinstance(value, int) or isinstance(value, bool) or value < 0):
        raise ValueError(f"the fault '{name}' must be a whole number from 0")


class FaultyLink:
    """A link with faults. ``passed`` counts the bytes of this line both ways."""

    def __init__(self, link: Link, faults: Faults, *, cut: bool) -> None:
        self._link = link
        self._faults = faults
        self._cut_at = faults.drop_after_bytes if cut else None
        self._counts = {"in": 0, "out": 0}
        self.passed = 0

    @property
    def bytes_per_second(self) -> float | None:
        return self._link.bytes_per_second

    def read(self, timeout: float) -> bytes:
        self._check()
        return self._pass("in", self._link.read(timeout))

    def write(self, data: bytes) -> None:
        self._check()
        if not self._faults.silent:
            self._link.write(self._pass("out", data))

    def close(self) -> None:
        self._link.close()

    def _check(self) -> None:
        if self._cut_at is not None and self.passed >= self._cut_at:
            self._link.close()
            raise LinkError("the line", "cut on purpose")

    def _pass(self, way: str, data: bytes) -> bytes:
        if self._cut_at is not None:
            data = data[: max(0, self._cut_at - self.passed)]
        self.passed += len(data)
        start = self._counts[way]
        self._counts[way] += len(data)
        return _corrupt(data, start, self._faults.corrupt_every, self._faults.lose_every)


class FaultyLine:
    """Gives each link of one control its faults; only so many of them are cut."""

    def __init__(self, faults: Faults) -> None:
        self._faults = faults
        self._cut = 0

    def wrap(self, link: Link) -> Link:
        """Return the link with its faults."""
        faults = self._faults
        cut = faults.drop_after_bytes is not None and (faults.drops == 0 or self._cut < faults.drops)
        self._cut += cut
        return FaultyLink(link, faults, cut=cut)


def arm(control: Control, faults: Faults) -> None:
    """Prepare a control for the faults of its memory."""
    control.memory.full_at = faults.disk_full_at
    if faults.die_at_commit_step is None:
        return
    left = faults.die_at_commit_step

    def step(_: str) -> None:
        nonlocal left
        if control.is_committing:
            left -= 1
            if left == 0:
                die()

    control.memory.on_step = step


def die() -> None:
    """End this process at once, as if its plug were pulled."""
    kill: Any = getattr(signal, "SIGKILL", None)
    if kill is not None:
        os.kill(os.getpid(), kill)
    os._exit(137)


def _corrupt(data: bytes, start: int, corrupt_every: int | None, lose_every: int | None) -> bytes:
    """Change and lose the bytes whose turn it is; ``start`` is how many have passed before."""
    if not corrupt_every and not lose_every:
        return data
    corrupted = bytearray()
    for count, byte in enumerate(data, start + 1):
        if lose_every and count % lose_every == 0:
            continue
        changed = corrupt_every is not None and corrupt_every > 0 and count % corrupt_every == 0
        corrupted.append(byte ^ (1 << (count % 8)) if changed else byte)
    return bytes(corrupted)
