"""Downloads to an emulated Grbl control whose line, power and memory fail as a seed chooses.

Afterwards the copy of the old state must be whole,
and what is reported of the control must be true of each setting.
"""

import random
from pathlib import Path
from typing import Any

from amp_studio.families.grblhal.content import read_content, write_content
from amp_studio.families.grblhal.emulated.firmware import Firmware
from amp_studio.transfer.client.exchange import WantedContent
from amp_studio.transfer.client.parameters import download_content
from amp_studio.transfer.client.recording import Recording
from amp_studio.transfer.driver import Receipt
from amp_studio.transfer.errors import TransferError
from amp_studio.transfer.exchange import Exchange
from tests.families.grblhal.bench import Bench, damage
from tests.faults.bad_line import BadLine
from tests.faults.disk import Disk
from tests.faults.downloads import false_copies, forgetting

CHANGES = {
    0: "6.0",
    11: "0.0004",
    12: "0.005",
    20: "1",
    22: "3",
    26: "100",
    40: "1",
    100: "320.5",
    110: "3000",
    111: "2500.125",
    120: "250",
    130: "301.5",
    131: "1e3",
    132: "77",
}
FAULTS = (
    "none",
    "cut",
    "cut for good",
    "power",
    "power while it writes",
    "noise in",
    "noise out",
    "deaf",
    "runs",
    "alarm",
    "half a line",
    "messages",
    "another person",
    "forget",
    "repeat",
    "swap",
    "delay",
    "pause",
)
OF_THE_LINE = {
    "repeat": range(60, 600),
    "swap": range(60, 600),
    "delay": range(3, 60),
    "pause": range(1, 900),
}
"""Faults of a bad line, with how often or when they strike."""


def download_with_faults(seed: int, folder: Path, only: str | None = None) -> list[str]:
    """Return what was violated, a sentence each; ``only`` is the fault instead of one that the seed
    chooses.
    """
    choose = random.Random(seed)
    bench = Bench(folder, choose.choice([None, None, "grbl-1.1"]))
    firmware = bench.firmware
    if choose.random() < 0.5:  # a control that was set up: to lose its memory can be seen
        for number, text in (
            (100, "160"),
            (101, "160"),
            (110, "900"),
            (121, "33.5"),
            (132, "90"),
            (30, "24000"),
        ):
            firmware.settings.store(number, text)
        firmware.is_writing = True
    bench.driver.identify()
    current = bench.driver.fetch()
    before, present = firmware.settings.values(), read_content(current)
    numbers = [n for n in choose.sample(sorted(CHANGES), choose.randint(1, 8)) if n in present.settings]
    wanted = {**present.settings, **{n: CHANGES[n] for n in numbers if CHANGES[n] != "1e3"}}
    if "1" in (wanted.get(20), wanted.get(40)) or 22 in numbers:
        wanted[22] = "3" if 676 in wanted else "1"
    content = write_content(
        type(present)(present.identity, wanted, present.offsets, present.startup, present.enumerations)
    )
    fault = choose.choice(FAULTS) if only is None else only
    bench.driver.close()
    shown, copies = _shown(firmware), folder / "copies"
    copies.mkdir()
    _arm(bench, fault, choose)
    told, text, new = "old", "", ()
    unsafe, disk, is_verified = list[str](), Disk(), False
    send = bench.driver.send

    def sent(*arguments: Any, **options: Any) -> Receipt:
        unsafe.extend(disk.unsafe(copies, *copies.glob("*.img*")))
        return send(*arguments, **options)

    bench.driver.send = sent
    try:
        with disk.watched():
            recording = Recording("download", "grblhal", "", Exchange(keep=copies / "control"))
            outcome = download_content(bench.driver, WantedContent(content, ""), recording)
        told, text, is_verified = outcome.at_control, outcome.text, outcome.verified
    except TransferError as error:
        told, text, new = error.at_control or "old", str(error), error.new
    bench.spoil_in = bench.spoil_out = lambda data: data
    found = [*unsafe, *disk.faults, *_violations(bench, before, wanted, present, told, new, text, fault)]
    if fault not in ("another person", "power while it writes"):
        is_needed = firmware.settings.values() != before
        found += false_copies(copies, _names, shown, is_needed=is_needed)
    if is_verified and fault in ("none", "forget", *OF_THE_LINE):
        now = firmware.settings.values()
        firmware.answer()  # nothing more is to be sent: the memory is written
        firmware.power_cycle()
        found += ["what is active is not saved"] if firmware.settings.values() != now else []
    return [f"seed {seed}, {fault}: {v}" for v in found]


def _names(content: bytes) -> dict[str, str]:
    """Return what a copy contains."""
    read = read_content(content)
    return _named(read.settings, read.offsets, read.startup)


def _shown(firmware: Firmware) -> dict[str, str]:
    """Return what a control contains, from its memory."""
    settings = {setting.number: setting.show() for setting in firmware.settings.available()}
    return _named(settings, firmware.offsets, firmware.startup)


def _named(settings: dict, offsets: dict, startup: dict) -> dict[str, str]:
    return {
        **{f"${n}": text for n, text in settings.items()},
        **{n: text for n, text in offsets.items() if n[0] == "G"},
        **{f"$N{n}": line for n, line in startup.items()},
    }


def _arm(bench: Bench, fault: str, choose: random.Random) -> None:
    """Have something go wrong after so many bytes of the download."""
    firmware = bench.firmware
    if fault == "half a line":
        firmware.receive(choose.choice([b"$130=3", b"$100=1", b"(half", b"$RST=", b"G1X10", b"$22=0" * 30]))
        return
    if fault == "forget":
        bench.firmware.settings.store = forgetting(
            {fault: choose.randint(1, 4)}, bench.firmware.settings.store
        )
        return
    if fault in OF_THE_LINE:
        on_line, opened = {fault: choose.choice(OF_THE_LINE[fault])}, bench.open
        bench.driver._open_link = lambda look: BadLine(
            opened(look), bench.clock, choose, on_line, lambda: None
        )
        return
    left = choose.randint(1, 900) if choose.random() < 0.8 else choose.randint(900, 1500)
    original = bench.spoil_in
    every = choose.randint(30, 600)

    def after(data: bytes) -> bytes:
        nonlocal left
        data = original(data)
        if left <= 0:
            return data
        left -= len(data) if not data.startswith(b"\x7f") else 1
        if left > 0:
            return data
        _strike(bench, fault, choose, every)
        return data if not bench.is_cut else data[: choose.randint(0, len(data))]

    bench.spoil_in = after


def _strike(bench: Bench, fault: str, choose: random.Random, every: int) -> None:
    firmware = bench.firmware
    match fault:
        case "cut":
            bench.is_cut = True
            back = bench.clock.now + choose.choice([0.0, 3.0])
            opened = bench.open

            def again(look: object) -> object:
                bench.is_cut = bench.clock.now < back
                return opened(look)

            bench.driver._open_link = again
        case "cut for good":
            bench.is_cut = True
        case "power":
            firmware.is_writing = False
            firmware.power_cycle()
        case "power while it writes":
            _cut_power_at_next_save(bench, choose.randrange(2))
        case "noise in":
            bench.spoil_in = damage(choose, every)
        case "noise out":
            bench.spoil_out = damage(choose, every)
        case "deaf":
            firmware._ignores_settings = True
        case "runs":
            firmware.state = "Run"
        case "alarm":
            firmware.operate("alarm 1")
        case "messages":
            bench.spoil_out = lambda data: (
                data + b"[MSG:Caution: Unlocked]\r\n<Idle|MPos:0>\r\n" if data.endswith(b"\n") else data
            )
        case "another person":
            firmware.settings.store(30, "1234")


def _cut_power_at_next_save(bench: Bench, answers: int) -> None:
    """Cut the power between an answer and the writing of the memory, once; the answer may have left."""
    is_over = False

    def cut(data: bytes) -> bytes:
        nonlocal is_over
        if is_over or not bench.firmware.is_writing:
            return data
        is_over = True
        bench.firmware.power_cycle()
        return data if answers else b""

    bench.spoil_out = cut


def _violations(
    bench: Bench, before: dict, wanted: dict, present: object, told: str, new: tuple, text: str, fault: str
) -> list[str]:
    found = []
    reference = Bench(
        bench.folder / "reference", "grbl-1.1" if bench.firmware.settings.is_classic else None
    ).firmware.settings
    reference.load(before)
    for number in sorted(wanted, key=lambda n: (n != 22, n)):
        if wanted[number] != present.settings.get(number):
            reference.store(number, wanted[number])
    after, goal, delivered = bench.firmware.settings.values(), reference.values(), reference.defaults
    if fault == "another person":
        before, goal = {**before, 30: after[30]}, {**goal, 30: after[30]}
    fresh = {n for n in goal if goal[n] != before[n] and after[n] == goal[n]}
    moved = {20, 22, 24, 25, 40, 676}
    truth = {
        "old": after == before,
        "new": after == goal,
        "defaults": all(after[n] == (goal if f"${n}" in new else delivered)[n] for n in after),
        "mixed": all(after[n] in (before[n], goal[n]) or n in moved for n in after),
        "unknown": True,
    }
    if not truth[told]:
        differing = {
            n: (before[n], goal[n], after[n])
            for n in after
            if after[n] != (before if told == "old" else goal)[n]
        }
        found.append(
            f"said {told}: {text}, and (old, new, is) are {differing};"
            f" {[(n, after[n], delivered[n]) for n in after if after[n] != delivered[n]]}"
        )
    if told == "mixed" and new and {int(n[1:]) for n in new if n[1:].isdigit()} - moved != fresh - moved:
        found.append(f"said that {new} are new, and {sorted(fresh)} are: {text}")
    if fault == "none" and told != "new":
        found.append(f"said {told} without a fault: {text}")
    if told == "unknown" and fault not in (
        "cut for good",
        "runs",
        "noise in",
        "noise out",
        "deaf",
        "another person",
        "power while it writes",
        *OF_THE_LINE,
    ):
        found.append(f"did not know: {text}")
    return found
