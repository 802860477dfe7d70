"""Downloads in the families' own ways of speaking, over lines and to controls on which a seed puts every fault.

What is cut, changed, lost, killed or without power: afterwards each setting is old or new, what the program reports of it is
true, what the control contained is kept whole, and nobody's half line is left.
"""

from __future__ import annotations

import random
import shutil
import threading
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

from amp_studio.families.acromill.lines.content import CardContent
from amp_studio.families.num.lines.content import words_of_table
from amp_studio.families.servo57c422b.lines.content import words_of_content
from amp_studio.files import ParameterFile
from amp_studio.schema import load_schema
from amp_studio.schema.storage import value_of_stored
from amp_studio.schema.values import read_value
from amp_studio.transfer.client.exchange import Outcome, download
from amp_studio.transfer.errors import CancelledError, TransferError
from amp_studio.transfer.image import ImageError
from amp_studio.transfer.links.link import Link, LinkError
from tests.families.acromill.lines.bench import CardBench
from tests.families.num.lines.bench import NumBench
from tests.families.servo57c422b.lines.bench import RackBench
from tests.transfer.emulated.memory_steps import PowerLoss, lose_power_at

T = TypeVar("T")
TABLE = (
    b"%00000000;09\nP0N0:t6n1;09\n#00000000;09\nP9N0:t0n32;0A\n#0 1 2 FF FF FF FF FF FF FF;1B\n"
    b"P9N10:t0n32;0B\n#FF FF FF FF FF FF FF FF FF FF;1E\nP9N20:t0n32;0B\n#FF FF FF FF FF FF FF FF FF FF;1E\n"
    b"P9N30:t0n32;0B\n#FF FF;06\nP13N0:t5n18;0B\n#0 0 0 0 0 0 0 0 0 0;14\nP13N10:t5n18;0C\n#0 0 0 0 0 0 0 0;10\n\x13"
)


class BadLine:
    """A line that changes, loses and cuts what a seed chooses, and takes the control's power while a byte is under way."""

    def __init__(
        self, link: Link, chance: random.Random, faults: dict[str, int], die: Callable[[], None]
    ) -> None:
        self._link, self._chance, self._faults, self._die = link, chance, faults, die
        self._passed = 0
        self.bytes_per_second = link.bytes_per_second

    def read(self, timeout: float) -> bytes:
        return self._pass(self._powered(lambda: self._link.read(timeout)))

    def write(self, data: bytes) -> None:
        data = self._pass(data)
        self._powered(lambda: self._link.write(data))

    def _powered(self, act: Callable[[], T]) -> T:
        try:
            return act()
        except PowerLoss:
            self._die()
        self._link.close()
        raise LinkError("bad line", "the control has no power")

    def close(self) -> None:
        self._link.close()

    def _cut(self, why: str) -> None:
        self._link.close()
        raise LinkError("bad line", why)

    def _pass(self, data: bytes) -> bytes:
        passed = bytearray()
        for byte in data:
            self._passed += 1
            if self._faults.pop("cut", 0) if self._passed == self._faults.get("cut") else 0:
                self._cut("cut")
            if self._faults.pop("kill", 0) if self._passed == self._faults.get("kill") else 0:
                self._die()
                self._cut("killed")
            if self._chance.random() * self._faults.get("lose", 0) > self._faults.get("lose", 0) - 1 > 0:
                continue
            if self._chance.random() * self._faults.get("change", 0) > self._faults.get("change", 0) - 1 > 0:
                passed.append(byte ^ 1 << self._chance.randrange(8))
            else:
                passed.append(byte)
            if self._chance.random() * self._faults.get("repeat", 0) > self._faults.get("repeat", 0) - 1 > 0:
                passed.append(passed[-1])
        return bytes(passed)


def _faults(chance: random.Random, size: int) -> dict[str, int]:
    """Return what goes wrong on one line; ``size`` is about what a whole download moves."""
    ways = {"cut": chance.randrange(1, size), "kill": chance.randrange(1, size), "lose": chance.randrange(60, 4_000),
            "change": chance.randrange(60, 4_000), "repeat": chance.randrange(60, 4_000), "power": chance.randrange(1, 12), "stop": chance.randrange(1, 400)}  # fmt: skip
    return {name: ways[name] for name in chance.sample(list(ways), chance.choice([1, 1, 1, 2]))}


def _download(
    bench: Any, file: ParameterFile, cancel: threading.Event, kept: list[bytes], stop_at: int
) -> Any:
    """Return the outcome of a download, or the error it ended with; ``stop_at`` is the call of progress that is Ctrl-C."""
    calls, told = 0, getattr(bench, "progress", lambda *_: None)

    def progress(stage: str, done: int, total: int) -> None:
        nonlocal calls
        told(stage, done, total)
        calls += 1
        if calls == stop_at:
            cancel.set()

    def keep(old: bytes) -> str:
        kept.append(old)
        return "kept"

    try:
        return download(bench.driver, partial(bench.driver.encode, file), keep, signature=file.schema.signature,
                        progress=progress, cancel=cancel)  # fmt: skip
    except (TransferError, ImageError) as error:
        return error


def _untrue(ended: Any, now: dict[str, str], old: dict[str, str], new: dict[str, str]) -> list[str]:
    """Return what does not fit of how a download ended and what the control contains."""
    found = [f"{name} is {now.get(name)}, neither {old.get(name)} nor {new.get(name)}"
             for name in {**old, **new} if now.get(name) not in (old.get(name), new.get(name))]  # fmt: skip
    changed = {name for name in {**old, **new} if now.get(name) != old.get(name)}
    wanted = {name for name in {**old, **new} if new.get(name) != old.get(name)}
    if isinstance(ended, ImageError):
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


# -- the terminal of an ACR card -------------------------------------------------------------------


def _card_file(chance: random.Random) -> ParameterFile:
    file = ParameterFile(load_schema("acromill"))
    for name, unit in (("axes.pulses_per_unit", "counts/in"), ("servo.p_gain", "V/count"), ("servo.torque_limits", "V"),
                       ("servo.i_gain", "V/count/s"), ("axes.excess_error_band", "in")):  # fmt: skip
        for axis in chance.sample("XYZ", chance.randrange(3)):
            text = f"{chance.uniform(0.001, 9):.5f}"
            file.take({(name, axis): read_value(file.schema.parameters[name], text, unit)})
    if chance.random() < 0.3:
        table = file.schema.parameters["ballscrew.table"]
        file.take({("ballscrew.table", "Y"): read_value(table, "Y0E.00325 Y1E-.00120", "")})
    return file


def terminal_under_faults(seed: int, runs: int, folder: Path) -> list[str]:
    """Download to an ACR card under faults; returns what was not true."""
    found = []
    for number in range(runs):
        chance = random.Random(f"terminal {seed} {number}")
        found += [
            f"seed {seed}, run {number}: {what}" for what in _terminal_run(chance, folder / f"card-{number}")
        ]
        shutil.rmtree(folder / f"card-{number}")
    return found


def _terminal_run(chance: random.Random, folder: Path) -> list[str]:
    faults = _faults(chance, 20_000)
    bench, cancel, kept = CardBench(folder), threading.Event(), list[bytes]()
    file = _card_file(chance)
    held = bench.driver.fetch()
    bench.driver.close()
    content = bench.driver.encode(file, held)
    names = _names(content)
    what = str(faults)

    def die() -> None:
        lose_power_at(bench.card.settings._memory, None)
        bench.switch_on()

    lose_power_at(bench.card.settings._memory, faults.pop("power", None))
    stop = faults.pop("stop", 0)
    bench.wrap = lambda link: BadLine(link, chance, faults, die)
    ended = _download(bench, file, cancel, kept, stop)
    bench.wrap = lambda link: link
    lose_power_at(bench.card.settings._memory, None)
    half = bytes(bench.card._line)
    bench.driver.close()
    old = _names(held)
    now = _names(bench.driver.fetch())
    untrue = _untrue(ended, now, old, names)
    if isinstance(ended, CancelledError) and half and not faults.keys() & {"lose", "change", "repeat"}:
        untrue.append(f"half a line is left: {half!r}")
    if now != old and kept != [held]:
        untrue.append("what the card contained was not kept whole")
    bench.driver.close()
    bench.switch_on()
    saved = _names(bench.driver.fetch())
    untrue += [f"{name} is saved as {saved.get(name)}" for name in {**old, **names}
               if saved.get(name) not in (old.get(name), names.get(name))]  # fmt: skip
    if isinstance(ended, Outcome) and ended.verified and saved != now:
        untrue.append("what is active is not saved")
    return [f"{what}: {each}" for each in untrue]


def _names(content: bytes) -> dict[str, str]:
    return {name: ", ".join(f"{float(figure):.7g}" for figure in figures)
            for name, figures in CardContent.read(content).names().items()}  # fmt: skip


# -- the parameter table of a NUM control ----------------------------------------------------------


def table_under_faults(seed: int, runs: int, folder: Path) -> list[str]:
    """Load the table of a NUM control under faults; returns what was not true."""
    found = []
    for number in range(runs):
        chance = random.Random(f"table {seed} {number}")
        work = folder / f"cnc-{number}"
        work.mkdir()
        found += [f"seed {seed}, run {number}: {what}" for what in _table_run(chance, work)]
        shutil.rmtree(work)
    return found


def _table_run(chance: random.Random, folder: Path) -> list[str]:
    (folder / "table").write_bytes(TABLE)
    faults = _faults(chance, 1_500)
    parity = chance.choice(
        ["even", "even", "odd"] + ["none"] * (not faults.keys() & {"lose", "change", "repeat"})
    )
    bench, cancel, kept = NumBench(folder, parity=parity), threading.Event(), list[bytes]()
    file = ParameterFile(load_schema("num"))
    for number in {chance.choice(("P9N0", "P9N11", "P9N31", "P13N2", "P13N17")) for _ in range(3)}:
        address = file.find(number)
        parameter = file.schema.parameters[address[0]]
        file.take({address: value_of_stored(parameter, chance.randrange(3, 25), turns=False)})
    held = bench.driver.fetch(bench.progress)
    bench.driver.close()
    new = words_of_table(bench.driver.encode(file, held))
    what = f"{parity} {faults}"
    if chance.random() < 0.2:
        bench.refuses.add(chance.choice(["unload", "load"]))
        what += f" refuses {bench.refuses}"

    def die() -> None:
        bench.switch_on()
        bench.press(f"parity {parity}")

    lose_power_at(bench.control._parameters._memory, faults.pop("power", None))
    stop = faults.pop("stop", 0)
    bench.wrap = lambda link: BadLine(link, chance, faults, die)
    ended = _download(bench, file, cancel, kept, stop)
    sent = bytes(byte & 0x7F for byte in bench.lines[-1].sent)
    bench.driver.close()
    bench.wrap = lambda link: link
    bench.refuses.clear()
    lose_power_at(bench.control._parameters._memory, None)
    now = words_of_table(bench.driver.fetch(bench.progress))
    old = words_of_table(held)
    untrue = _untrue(ended, now, old, new)
    if isinstance(ended, CancelledError) and sent and not sent.endswith((b"\n", b"\x13")):
        untrue.append(f"half a line is left: {sent[-20:]!r}")
    if now != old and kept != [held]:
        untrue.append("what the control contained was not kept whole")
    return [f"{what}: {each}" for each in untrue]


# -- the registers of a rack -----------------------------------------------------------------------


def registers_under_faults(seed: int, runs: int, folder: Path) -> list[str]:
    """Download to the registers of a module under faults; returns what was not true."""
    found = []
    for number in range(runs):
        chance = random.Random(f"registers {seed} {number}")
        found += [
            f"seed {seed}, run {number}: {what}" for what in _registers_run(chance, folder / f"rack-{number}")
        ]
        shutil.rmtree(folder / f"rack-{number}")
    return found


def _registers_run(chance: random.Random, folder: Path) -> list[str]:
    folder.mkdir()
    faults = {name: how for name, how in _faults(chance, 40_000).items() if name not in ("power", "kill")}
    bench, cancel, kept = RackBench(folder), threading.Event(), list[bytes]()
    file = ParameterFile(load_schema("57c422b"))
    for number in {chance.choice(("R3", "R4", "R5", "R8", "R2051", "R2052", "R63")) for _ in range(4)}:
        address = file.find(number)
        file.take(
            {address: value_of_stored(file.schema.parameters[address[0]], chance.randrange(2), turns=False)}
        )
    held = bench.driver.fetch()
    new = _registers(bench.driver.encode(file, held))
    stop = faults.pop("stop", 0)
    bench.driver.close()
    bench.wrap = lambda link: BadLine(link, chance, faults, lambda: None)
    ended = _download(bench, file, cancel, kept, stop)
    bench.wrap = lambda link: link
    bench.driver.close()
    bench.driver.identify()
    now, old = _registers(bench.driver.fetch()), _registers(held)
    untrue = _untrue(ended, now, old, new)
    if now != old and kept != [held]:
        untrue.append("what the module contained was not kept whole")
    if (isinstance(ended, Outcome) or not faults) and any(
        bench.words[axis + r] for axis in (0, 2048) for r in (66, 67)
    ):
        untrue.append("a command is left behind")
    return [f"{faults}, stop {stop}: {each}" for each in untrue]


def _registers(content: bytes) -> dict[str, str]:
    return {f"R{register}": str(word) for register, word in words_of_content(content).items()}
