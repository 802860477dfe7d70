"""Damaged contents of the families' own kinds, damaged unloads,
and odd keys and bytes at their emulated controls.
"""

import contextlib
import random
import zlib
from collections.abc import Iterator
from pathlib import Path

from amp_studio.families.acromill.emulated.card import AcrCard
from amp_studio.families.acromill.lines.content import AcrContent
from amp_studio.families.linuxcnc.control import running
from amp_studio.families.linuxcnc.control.content import Configuration, ConfigurationContent
from amp_studio.families.num.emulated.control import NumControl
from amp_studio.families.num.lines.content import NumTableContent, content_of_table, words_of_table
from amp_studio.families.num.lines.table_reader import TableReader
from amp_studio.formats.report_pdf import attached_machine
from amp_studio.transfer.content import kind_of
from amp_studio.transfer.emulated.line_device import DeviceSetup, LineDevice
from amp_studio.transfer.emulated.memory import Memory
from amp_studio.transfer.errors import ImageDamagedError, TransferError
from amp_studio.transfer.image import ImageError

from .own_protocols import TABLE
from .texts import violations
from .wire import damaged

SCRIPT = (
    b"ACR script 1\nREM units inch\nPPU X4096\nPPU Y1000.5\nDAC0 GAIN -3276.8\nEXC AXIS0 0.25\nLOPASS"
    b" X\nNOTCH X(500, 50)\nPGAIN X0.00244\nFFACC X0.000000199\nBSC X0E.00325\nBSC X1E-.00250\nend 10\n"
)
CONTENT = b"NUM table 1\n" + TABLE
CONFIGURATION = Configuration(
    {
        "": b"#INCLUDE joints.inc\n[EMC]\nMACHINE = mill\n[KINS]\nJOINTS = 1\n",
        "joints.inc": b"[JOINT_0]\nFERROR = 1.5 # mm\nMAX_LIMIT = 8\n",
    }
).written()
KINDS: dict[type, bytes] = {AcrContent: SCRIPT, NumTableContent: CONTENT, ConfigurationContent: CONFIGURATION}
KEYS = (
    "load",
    "unload",
    "verify",
    "enter",
    "start",
    "reference 00000001",
    "comment \x1b[2J",
    "exit",
    "parity odd",
    "parity none",
    "patch P9N0=FF",
    "patch P9N99=0",
    "reset",
    "status",
    "power",
    "patch PPU X5",
    "patch BSC X0E.1",
    "echo off",
    "",
)


def _cases(seed: int, count: int) -> Iterator[bytes]:
    chance = random.Random(seed)
    for _ in range(count):
        content = chance.choice((SCRIPT, CONTENT, CONFIGURATION))
        for _ in range(chance.choice((1, 1, 2, 4))):
            content = damaged(content, chance)
        yield content


def _look(content: bytes) -> None:
    """What is taken for a content means something, and is the same when it is written again."""
    kind = kind_of(content)
    kept = KINDS.get(type(kind))
    if kept is None:
        return
    file = kind.decode(content)
    kind.difference(content, kept)
    kind.difference(kept, content)
    assert not kind.difference(kind.encode(file, content), content), (
        "it is written otherwise than it was read"
    )
    kind.refit(content, kept)


def fuzz_contents(seed: int, count: int) -> list[str]:
    """Read damaged contents of a NUM control, an ACR card and the folder of a LinuxCNC."""
    return violations(_cases(seed, count), _look, (ImageError,))


PINS = b"""Component Type Dir Value Name
inihal float IN 1.5 ini.0.ferror
inihal float IN 8 ini.0.max_limit
motmod bit OUT TRUE joint.0.active
motmod bit OUT TRUE joint.0.homed
motmod float OUT 3.25 joint.0.pos-fb
motmod float OUT 0 joint.0.f-error
motmod float OUT 0 joint.0.vel-cmd
motmod bit OUT TRUE motion.motion-enabled
motmod float OUT 0 motion.current-vel
"""


def fuzz_pins(seed: int, count: int) -> list[str]:
    """Read damaged answers of the program that shows the pins of LinuxCNC."""
    chance = random.Random(seed)
    file = Configuration.read(CONFIGURATION).file()

    def look(data: bytes) -> None:
        shown = running.pins_of(data.decode("latin-1"))
        running.values_of(file, shown)
        running.status_from(file, shown, "configuration")

    return violations((damaged(PINS, chance) for _ in range(count)), look, (TransferError,))


REPORT = (
    b"%PDF-1.7\n1 0 obj\n<</Type /EmbeddedFile /Filter /FlateDecode>>\nstream\n"
    + zlib.compress(b"amp_studio: 1\nfamily: 9pc\n" * 40)
    + b"\nendstream\nendobj\n"
)
"""As much of a report as its reader needs."""


def fuzz_reports(seed: int, count: int) -> list[str]:
    """Read the machine of damaged reports."""
    chance = random.Random(seed)
    return violations((damaged(REPORT, chance) for _ in range(count)), attached_machine, ())


def _unload(data: bytes) -> None:
    reader = TableReader()
    for start in range(0, len(data), 97):
        reader.feed(data[start : start + 97])
    if reader.is_whole:
        words_of_table(content_of_table(reader.table.decode("ascii")))


def fuzz_unloads(seed: int, count: int) -> list[str]:
    """Read damaged unloads of a NUM control, as they come over the line."""
    chance = random.Random(seed)
    even = bytes(byte | 0x80 if byte.bit_count() % 2 else byte for byte in TABLE)
    return violations(
        (damaged(chance.choice((TABLE, even)), chance) for _ in range(count)),
        _unload,
        (ImageDamagedError, ImageError),
    )


def fuzz_devices(folder: Path, seed: int, count: int) -> list[str]:
    """Press odd keys at the emulated controls and send them odd bytes; they go on,
    and answer no more than they are asked.
    """
    chance = random.Random(seed)
    (folder / "cnc").mkdir()
    (folder / "cnc" / "table").write_bytes(TABLE)
    devices: tuple[LineDevice, ...] = (
        NumControl(DeviceSetup("num", Memory(folder / "cnc"), lambda _: None)),
        AcrCard(DeviceSetup("acromill", Memory(folder / "card"), lambda _: None)),
    )

    def look(case: tuple[LineDevice, str, bytes]) -> None:
        device, key, data = case
        with contextlib.suppress(ValueError):
            assert len(device.operate(key)) < 5_000
        device.receive(data)
        for _ in range(2_000):
            if not device.answer():
                return
        raise AssertionError("it sends without an end")

    def cases() -> Iterator[tuple[LineDevice, str, bytes]]:
        for _ in range(count):
            data = damaged(chance.choice((TABLE, SCRIPT.replace(b"\n", b"\r"), b"")), chance)
            key = chance.choice(KEYS)
            yield (
                chance.choice(devices),
                key if chance.random() < 0.8 else key[1:] + chance.choice(KEYS),
                data[:1_500],
            )

    return violations(cases(), look, ())
