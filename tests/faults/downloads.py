"""One download under faults, whatever way of speaking, and what is checked afterwards.

Each value is old or new, what the program reports of it is true, and what the control contained is kept whole
on the disk before the first value is sent. What a control contains is read from its memory, not over the
driver, which may leave something out.
"""

import random
import threading
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Protocol
from unittest import mock

from amp_studio.files import ParameterFile
from amp_studio.transfer.client.exchange import Outcome
from amp_studio.transfer.client.kept import CopyError, open_copy
from amp_studio.transfer.client.parameters import download_file
from amp_studio.transfer.driver import Receipt
from amp_studio.transfer.emulated.memory import Memory
from amp_studio.transfer.errors import TransferError
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.image import ImageError
from amp_studio.transfer.links.link import Link
from tests.transfer.emulated.memory_steps import lose_power_at

from .bad_line import BadLine, Seconds
from .disk import Disk

Values = dict[str, str]
DAMAGE = {"lose", "change", "repeat", "swap"}


class FaultBench(Protocol):
    """A driver at an emulated control, and a way into that control which shares nothing with the driver."""

    clock: Seconds
    driver: Any
    wrap: Callable[[Link], Link]

    @property
    def memory(self) -> Memory | None:
        """Where the control keeps its values without power; None where it does not."""

    @property
    def files_at_control(self) -> Path | None:
        """The folder that must be on the disk once a download is complete."""

    def progress(self, stage: str, done: int, total: int) -> None:
        """Do what a person is asked for."""

    def present(self) -> Values:
        """Return what the control contains, from its memory."""

    def names(self, content: bytes) -> Values:
        """Return what a content contains, as ``present``."""

    def arm(self, faults: Mapping[str, int]) -> None:
        """Have the control do wrong what the faults name:
        ``forget`` is the write that it acknowledges and does not do.
        """

    def power_cycle(self) -> None:
        """Take the control's power away and give it back."""

    def left_over(self, ended: Outcome | Exception, faults: Mapping[str, int]) -> list[str]:
        """Return what the download should not have left at the control."""


def download_under_faults(
    bench: FaultBench, file: ParameterFile, faults: Mapping[str, int], chance: random.Random, folder: Path
) -> list[str]:
    """Download a file; returns what was not true. ``folder`` is where the copy is kept."""
    present, stored = bench.present(), bench.driver.fetch(Exchange(bench.progress))
    wanted = bench.names(bench.driver.encode(file, stored))
    bench.driver.close()
    folder.mkdir()
    on_line, unsafe, disk = dict(faults), list[str](), Disk()
    bench.arm(faults)
    steps, stop_at = on_line.pop("power", None), on_line.pop("stop", 0)

    def die() -> None:
        lose_power(None)
        bench.power_cycle()

    def lose_power(step: int | None) -> None:
        if bench.memory is not None:
            lose_power_at(bench.memory, step)

    def sent(*arguments: Any, **options: Any) -> Receipt:
        unsafe.extend(disk.unsafe(folder, *folder.glob("*.img*")))
        receipt: Receipt = send(*arguments, **options)
        return receipt

    lose_power(steps)
    bench.wrap = lambda link: BadLine(link, bench.clock, chance, on_line, die)
    send = bench.driver.send
    with disk.watched(), mock.patch.object(bench.driver, "send", sent):
        ended = _downloaded(bench, file, folder, stop_at)
        if isinstance(ended, Outcome) and ended.verified and (stored := bench.files_at_control):
            unsafe += disk.unsafe(stored, *(path for path in stored.iterdir() if path.name[0] != "."))
    bench.wrap = lambda link: link
    lose_power(None)
    bench.arm({})
    left = bench.left_over(ended, faults)
    bench.driver.close()
    now = bench.present()
    found = [*unsafe, *disk.faults, *left, *untrue(ended, now, present, wanted)]
    if not faults and not (isinstance(ended, Outcome) and ended.verified):
        found.append(f"nothing went wrong, and it ended with: {ended}")
    if bench.memory is not None:
        bench.power_cycle()
        saved = bench.present()
        found += [
            f"{name} is saved as {saved.get(name)}"
            for name in {**present, **wanted}
            if saved.get(name) not in (present.get(name), wanted.get(name))
        ]
        if isinstance(ended, Outcome) and ended.verified and saved != now:
            found.append("what is active is not saved")
    return [*found, *false_copies(folder, bench.names, present, is_needed=now != present)]


def _downloaded(bench: FaultBench, file: ParameterFile, folder: Path, stop_at: int) -> Outcome | Exception:
    """Return the outcome of a download, or the error it ended with;
    ``stop_at`` is the call of the progress that is Ctrl-C.
    """
    calls, cancel = 0, threading.Event()

    def progress(stage: str, done: int, total: int) -> None:
        nonlocal calls
        bench.progress(stage, done, total)
        calls += 1
        if calls == stop_at:
            cancel.set()

    with mock.patch("amp_studio.transfer.client.parameters.open_driver", return_value=bench.driver):
        try:
            return download_file(file, "", Exchange(progress, cancel, folder / "control"))
        except (TransferError, ImageError) as error:
            return error


def untrue(ended: Outcome | Exception, now: Values, old: Values, new: Values) -> list[str]:
    """Return what does not fit of how a download ended and what the control contains."""
    found = [
        f"{name} is {now.get(name)}, neither {old.get(name)} nor {new.get(name)}"
        for name in {**old, **new}
        if now.get(name) not in (old.get(name), new.get(name))
    ]
    changed = {name for name in {**old, **new} if now.get(name) != old.get(name)}
    wanted = {name for name in {**old, **new} if new.get(name) != old.get(name)}
    if not isinstance(ended, (Outcome, TransferError)):
        return [*found, *([f"refused, and {sorted(changed)} have changed"] if changed else [])]
    state = ended.at_control
    fits = {
        "old": not changed,
        "new": changed == wanted,
        "mixed": True,
        "unknown": True,
        "": not changed,
    }.get(state, False)
    if state == "mixed" and isinstance(ended, TransferError):
        fits = set(ended.new) == changed != set()
    if isinstance(ended, Outcome) and ended.verified:
        fits = changed == wanted
    if not fits:
        found.append(f"it says '{state}' ({ended}), and new are {sorted(changed)} of {sorted(wanted)}")
    return found


def false_copies(
    folder: Path, names: Callable[[bytes], Values], contained: Values, *, is_needed: bool
) -> list[str]:
    """Return what is wrong with the copies in a folder: each is all that the control contained,
    with its digest.
    """
    copies = sorted(folder.glob("*.img"))
    found = ["what the control contained was not kept"] if is_needed and not copies else []
    for path in copies:
        try:
            copy = open_copy(path)
        except CopyError as error:
            found.append(f"the copy cannot be put back: {error}")
            continue
        kept = names(copy.image)
        if not copy.is_checked or copy.fault:
            found.append(f"the copy {path.name} is {copy.fault or 'without its digest'}")
        if wrong := [name for name in {**contained, **kept} if kept.get(name) != contained.get(name)]:
            found.append(f"the copy is not what the control contained: {sorted(wrong)}")
    return found


def forgetting(faults: Mapping[str, int], act: Callable[..., Any]) -> Callable[..., Any]:
    """Return a function that does what ``act`` does, but not the call whose number, from 1,
    is the fault ``forget``.
    """
    left = faults.get("forget", 0)

    def called(*arguments: Any, **options: Any) -> Any:
        nonlocal left
        left -= 1
        return None if left == 0 else act(*arguments, **options)

    return called
