"""Defects planted in the program, each of which a fault campaign must report:
a campaign that reports none proves nothing.

``python -m tests.faults.planted NAME verb …`` is the program with a defect.
"""

import contextlib
import os
import random
import shutil
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any
from unittest import mock

from amp_studio import cli
from amp_studio.families.acromill.lines import driver as acr
from amp_studio.families.grblhal import reading as grbl
from amp_studio.families.grblhal.driver import GrblDriver
from amp_studio.families.linuxcnc.control import content as configuration
from amp_studio.families.linuxcnc.control.driver import ConfigurationDriver
from amp_studio.families.num.lines import driver as num
from amp_studio.families.servo57c422b.lines import content as registers
from amp_studio.families.servo57c422b.lines.driver import RegisterDriver
from amp_studio.files.atomic import write_atomic as _write_atomic
from amp_studio.transfer.client.exchange import Outcome
from amp_studio.transfer.driver import Receipt
from amp_studio.transfer.house.driver import HouseDriver
from amp_studio.transfer.house.session import Session
from tests.families.grblhal.faulty_grbl import download_with_faults
from tests.ui.killed import kill_editor

from . import lines
from .folders import folder_run
from .own_protocols import Run, house_run, registers_run, repeated, table_run, terminal_run
from .saves import power_off_after_saves

TRIES = 60
"""Runs of a campaign, with faults of chance, of which one must meet a defect that is planted."""
EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"
CLIENT, FAMILIES = "amp_studio.transfer.client", "amp_studio.families"

NO_COPY, SHORT = "was not kept", "the copy is not what the control contained"
NOT_ON_DISK, NOT_SAVED, NOT_DONE = (
    "not on the disk",
    "what is active is not saved",
    "nothing went wrong, and it ended",
)

Plant = Callable[[], "AbstractContextManager[object]"]
Check = Callable[[Path], list[str]]


@dataclass(frozen=True)
class Defect:
    """One defect and what must notice it.

    ``words`` are of the report that must come; ``plant`` puts it into the program for a while; ``fixed`` is
    one case of a campaign that must report it, ``by_chance`` one run of that campaign
    with the faults of a seed.
    """

    name: str
    words: str
    plant: Plant
    fixed: Check
    by_chance: Callable[[int, Path], list[str]]

    def is_in(self, reported: list[str]) -> bool:
        """Return whether the defect is among what a campaign has reported."""
        return any(self.words in fault for fault in reported)


def unnoticed(seed: int, runs: int, folder: Path) -> list[str]:
    """Plant each defect in turn; returns those that nothing has reported: in the fixed case,
    then in runs with faults of chance.
    """
    found = []
    for number in range(runs):
        defect = DEFECTS[number % len(DEFECTS)]
        place = folder / str(number)
        place.mkdir()
        with defect.plant():
            if number < len(DEFECTS):
                how, is_noticed = "the fixed case", defect.is_in(defect.fixed(place))
            else:
                how, is_noticed = (
                    f"seed {seed}, run {number}",
                    _is_met(defect, seed * 10_000 + number * TRIES, place),
                )
        shutil.rmtree(place)
        if not is_noticed:
            found.append(f"nothing has noticed: {defect.name} ({how})")
    return found


def _is_met(defect: Defect, seed: int, folder: Path) -> bool:
    """Return whether a campaign meets a defect that is planted in so many of its runs."""
    for n in range(TRIES):
        place = folder / str(n)
        place.mkdir()
        if defect.is_in(defect.by_chance(seed + n, place)):
            return True
    return False


# -- the defects -----------------------------------------------------------------------------------


def _patched(*patches: tuple[str, object]) -> AbstractContextManager[object]:
    stack = contextlib.ExitStack()
    for target, new in patches:
        stack.enter_context(mock.patch(target, new))
    return stack


class _NoSync:
    """The system without fsync."""

    def __getattr__(self, name: str) -> Any:
        return (lambda _: None) if name == "fsync" else getattr(os, name)


def _no_backup() -> AbstractContextManager[object]:
    return _patched((f"{CLIENT}.parameters._Keeping.keep", lambda *_: "kept"))


def _no_sync_of_files() -> AbstractContextManager[object]:
    return _patched(("amp_studio.files.atomic.os", _NoSync()))


def _no_sync_at_control() -> AbstractContextManager[object]:
    return _patched(("amp_studio.transfer.emulated.memory.os", _NoSync()))


def _no_sync_in_folder() -> AbstractContextManager[object]:
    def written(*arguments: Any, **options: Any) -> str:
        with _no_sync_of_files():
            return _write_atomic(*arguments, **options)

    return _patched(("tests.faults.folders._write", written))


def _no_read_back(*others: tuple[str, object]) -> AbstractContextManager[object]:
    def believed(proof: Any, *_: object) -> Outcome:
        text = "Download complete and read back equal."
        return Outcome("new", True, True, proof.kept, "not needed", "", text)

    return _patched((f"{CLIENT}.exchange._Proof.outcome", believed), *others)


def _not_sent(driver: type) -> AbstractContextManager[object]:
    return mock.patch.object(driver, "send", return_value=Receipt())


def _not_stored() -> AbstractContextManager[object]:
    memory = "amp_studio.transfer.emulated.memory.Memory"
    return _patched(
        (f"{memory}.replace", lambda *_: None),
        (f"{memory}.append", lambda *_: None),
        (f"{memory}.sync", lambda *_: None),
    )


def _without_last(settings: Mapping[int, str]) -> dict[int, str]:
    return dict(list(settings.items())[:-1])


def _short_copy_of_card() -> AbstractContextManager[object]:
    known = acr.settings()
    return mock.patch.object(acr, "settings", return_value=known[:-1])


def _short_copy_of_table() -> AbstractContextManager[object]:
    read = num.content_of_table
    block = "P9N20:t0n32;0B\n#FF FF FF FF FF FF FF FF FF FF;1E\n"
    return mock.patch.object(num, "content_of_table", lambda table: read(table.replace(block, "")))


def _short_copy_of_registers() -> AbstractContextManager[object]:
    known = tuple(register for register in registers.settings() if register != 12)
    names = (f"{FAMILIES}.servo57c422b.lines.{module}.settings" for module in ("content", "driver"))
    return _patched(*((name, lambda: known) for name in names))


def _short_copy_of_folder() -> AbstractContextManager[object]:
    written = configuration.Configuration.written

    def shorter(whole: configuration.Configuration) -> bytes:
        return written(configuration.Configuration({n: t for n, t in whole.files.items() if n != "m.hal"}))

    return mock.patch.object(configuration.Configuration, "written", shorter)


def _short_copy_of_grbl() -> AbstractContextManager[object]:
    read = grbl.read_settings
    return mock.patch.object(grbl, "read_settings", lambda line, who: _without_last(read(line, who)))


def _short_copy_of_house() -> AbstractContextManager[object]:
    fetch = Session.fetch

    def shorter(*arguments: Any, **options: Any) -> bytes:
        *most, _, end, last = fetch(*arguments, **options).split(b"\n")
        return b"\n".join((*most, end, last))

    return mock.patch.object(Session, "fetch", shorter)


# -- what must notice them -------------------------------------------------------------------------


def _download(run: Run, faults: Mapping[str, int], seed: int = 1) -> Check:
    return lambda folder: run(random.Random(seed), folder, faults)


def _downloads(run: Run) -> Callable[[int, Path], list[str]]:
    return lambda seed, folder: repeated(run, seed, 1, folder)


def _settings(fault: str) -> Check:
    return lambda folder: download_with_faults(3, folder / "grbl", fault)


def _killed(seed: int, folder: Path) -> list[str]:
    path = folder / "mill.amp"
    shutil.copy(EXAMPLE, path)
    begin = f"from tests.faults.planted import begin\nbegin({JOURNAL!r})\n"
    return kill_editor(path, seed=seed, begin=begin)


_NO_SYNC: Mapping[Run, Plant | None] = {registers_run: None, folder_run: _no_sync_in_folder}
"""Where fsync is left out at a control that has no memory of the house; None for one without any."""


_NOT_STORED: Mapping[Run, str] = {terminal_run: NOT_SAVED, table_run: NOT_SAVED, house_run: NOT_DONE}
"""What is noticed where a control does not write its memory."""


def _of_drivers() -> Iterator[Defect]:
    """Yield the defects of the downloads: way of speaking by way of speaking."""
    both: tuple[tuple[str, Run, type, Plant, tuple[tuple[str, object], ...], dict[str, int]], ...] = (
        (
            "ACR card",
            terminal_run,
            acr.TerminalDriver,
            _short_copy_of_card,
            ((f"{FAMILIES}.acromill.lines.driver.TerminalDriver._set", _set_only),),
            {"forget": 1},
        ),
        ("NUM control", table_run, num.PeripheralDriver, _short_copy_of_table, (), {"forget": 2}),
        (
            "57C422B",
            registers_run,
            RegisterDriver,
            _short_copy_of_registers,
            ((f"{FAMILIES}.servo57c422b.lines.driver.RegisterDriver._write", _write_only),),
            {"forget": 1},
        ),
        ("control of the house", house_run, HouseDriver, _short_copy_of_house, (), {"forget": 1}),
        ("folder of a LinuxCNC", folder_run, ConfigurationDriver, _short_copy_of_folder, (), {"forget": 1}),
    )
    for what, run, driver, short, read_back, forget in both:
        chance = _downloads(run)
        for name, words, plant, faults in (
            ("backup skipped", NO_COPY, _no_backup, {}),
            ("fsync of the copy removed", NOT_ON_DISK, _no_sync_of_files, {}),
            ("read-back skipped", "it says 'new'", partial(_no_read_back, *read_back), forget),
            ("acknowledged without writing", NOT_DONE, partial(_not_sent, driver), {}),
            ("a setting left out of the copy", SHORT, short, {}),
            *(
                [("fsync removed at the control", NOT_ON_DISK, no_sync, {})]
                if (no_sync := _NO_SYNC.get(run, _no_sync_at_control))
                else []
            ),
            *(
                [("acknowledged by the control without writing", not_stored, _not_stored, {})]
                if (not_stored := _NOT_STORED.get(run))
                else []
            ),
        ):
            yield Defect(f"{what}: {name}", words, plant, _download(run, faults), chance)


def _of_settings() -> Iterator[Defect]:
    for name, words, plant, fault in (
        ("backup skipped", NO_COPY, _no_backup, "none"),
        ("fsync of the copy removed", NOT_ON_DISK, _no_sync_of_files, "none"),
        (
            "read-back skipped",
            "said new",
            partial(_no_read_back, (f"{FAMILIES}.grblhal.writing.Writing._is_stored", lambda *_: True)),
            "forget",
        ),
        ("acknowledged without writing", "without a fault", partial(_not_sent, GrblDriver), "none"),
        ("a setting left out of the copy", SHORT, _short_copy_of_grbl, "none"),
        ("fsync removed at the control", NOT_ON_DISK, _no_sync_at_control, "none"),
        ("acknowledged by the control without writing", NOT_SAVED, _not_stored, "none"),
    ):
        yield Defect(
            f"grblHAL: {name}",
            words,
            plant,
            _settings(fault),
            lambda seed, folder: download_with_faults(seed, folder / "grbl"),
        )


def _of_saves() -> Iterator[Defect]:
    storage = "amp_studio.files.storage.write_atomic"
    for name, words, plant in (
        ("fsync removed", NOT_ON_DISK, _no_sync_of_files),
        (
            "backup skipped",
            "no backup",
            lambda: _patched((storage, partial(_write_atomic, keep_backup=False))),
        ),
        (
            "acknowledged without writing",
            "nothing has changed",
            lambda: _patched(("amp_studio.files.atomic._replace", lambda *_: None)),
        ),
    ):
        saved = partial(power_off_after_saves, 0, 1)
        yield Defect(
            f"a save: {name}", words, plant, saved, lambda _, folder: power_off_after_saves(0, 1, folder)
        )


def _set_only(driver: Any, sending: Any, name: str) -> None:
    driver._command(sending, name)
    sending.sent.confirm(name)


def _write_only(driver: Any, register: int, word: int) -> None:
    driver._line.write(register, word)


JOURNAL = "the journal is not written"
_IN_PROCESSES: dict[str, Plant] = {
    JOURNAL: lambda: _patched(("amp_studio.files.document.Document.unsaved_writer", lambda _: lambda: None)),
    "backup skipped": _no_backup,
}
"""The defects that are planted in a separate process, by name."""


def begin(name: str) -> None:
    """Plant a defect in this process for good."""
    _IN_PROCESSES[name]().__enter__()


def _real_download(seed: int, folder: Path) -> list[str]:
    with mock.patch.object(lines, "DOWNLOADER", (sys.executable, "-m", __name__, "backup skipped")):
        return lines.download_over_bad_lines(seed, 1, folder)


def _first_met(campaign: Callable[[int, Path], list[str]], *seeds: int) -> Check:
    """Return what one of these seeds reports first:
    what a real process has done by a moment differs from run to run.
    """

    def check(folder: Path) -> list[str]:
        for seed in seeds:
            place = folder / str(seed)
            place.mkdir()
            if found := campaign(seed, place):
                return found
        return []

    return check


DEFECTS = (
    *_of_drivers(),
    *_of_settings(),
    *_of_saves(),
    Defect(
        f"the editor: {JOURNAL}", "entered", contextlib.nullcontext, _first_met(_killed, 1, 2, 3), _killed
    ),
    Defect(
        "the program on a real line: backup skipped",
        NO_COPY,
        contextlib.nullcontext,
        _first_met(_real_download, 2, 3, 4),
        _real_download,
    ),
)
SHORT_RUNS = len(DEFECTS) - 2
"""All but the last two, which take real programs."""

if __name__ == "__main__":
    begin(sys.argv[1])
    sys.exit(cli.run(sys.argv[2:]))
