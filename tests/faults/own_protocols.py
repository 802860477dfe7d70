"""Downloads in the families' ways of speaking and in the house protocol,
over lines and to controls on which a seed puts every fault.
"""

import contextlib
import random
import shutil
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from amp_studio.families.acromill.lines.content import CardContent
from amp_studio.families.num.lines.content import words_of_table
from amp_studio.families.servo57c422b.emulated.module import AXIS_Y, READ_ONLY
from amp_studio.families.servo57c422b.lines.content import words_of_content
from amp_studio.files import ParameterFile
from amp_studio.schema import load_schema
from amp_studio.schema.storage import value_of_stored
from amp_studio.schema.values import read_value
from amp_studio.transfer.client.exchange import Outcome
from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.memory import Memory
from amp_studio.transfer.emulated.record import Identity
from amp_studio.transfer.errors import CancelledError
from amp_studio.transfer.house.driver import HouseDriver
from amp_studio.transfer.house.session import Session
from amp_studio.transfer.image import decode_image, encode_image
from amp_studio.transfer.links.link import Link, LinkError
from tests.families.acromill.lines.bench import CardBench
from tests.families.num.lines.bench import NumBench
from tests.families.servo57c422b.lines.bench import RackBench
from tests.transfer.emulated.memory_steps import PowerLoss
from tests.transfer.null_modem import NullModem, VirtualClock

from .bad_line import choose_faults
from .downloads import DAMAGE, FaultBench, Values, download_under_faults, forgetting

TABLE = (
    b"%00000000;09\nP0N0:t6n1;09\n#00000000;09\nP9N0:t0n32;0A\n#0 1 2 FF FF FF FF FF FF"
    b" FF;1B\nP9N10:t0n32;0B\n#FF FF FF FF FF FF FF FF FF FF;1E\nP9N20:t0n32;0B\n#FF FF FF FF FF FF FF FF FF"
    b" FF;1E\nP9N30:t0n32;0B\n#FF FF;06\nP13N0:t5n18;0B\n#0 0 0 0 0 0 0 0 0 0;14\nP13N10:t5n18;0C\n#0 0 0 0 0"
    b" 0 0 0;10\n\x13"
)

Run = Callable[[random.Random, Path, "Mapping[str, int] | None"], list[str]]
"""One download with faults, those of chance for None; returns what was not true."""


def repeated(run: Run, seed: int, runs: int, folder: Path) -> list[str]:
    """Make so many runs, each with chances of the seed; returns what was not true."""
    name = run.__name__
    found = []
    for number in range(runs):
        work = folder / f"{name}-{number}"
        work.mkdir()
        chance = random.Random(f"{name} {seed} {number}")
        found += [f"seed {seed}, run {number}: {what}" for what in run(chance, work, None)]
        shutil.rmtree(work)
    return found


def _tried(
    bench: FaultBench,
    file: ParameterFile,
    faults: Mapping[str, int],
    chance: random.Random,
    folder: Path,
    what: str = "",
) -> list[str]:
    found = download_under_faults(bench, file, faults, chance, folder / "copies")
    return [f"{what}{dict(faults)}: {each}" for each in found]


# -- the terminal of an ACR card -------------------------------------------------------------------


class _Remembering:
    """A control whose memory is a folder."""

    memory: Memory

    @property
    def files_at_control(self) -> Path:
        return self.memory.folder


class CardFaults(_Remembering, CardBench):
    """An ACR card."""

    def progress(self, stage: str, done: int, total: int) -> None:
        """Nobody is asked for anything."""

    @property
    def memory(self) -> Memory:
        return self.card.settings._memory

    def present(self) -> Values:
        return {
            name: _figures(text.split(",") if text else [])
            for name, text in self.card.settings.values.items()
        }

    def names(self, content: bytes) -> Values:
        return {name: _figures(figures) for name, figures in CardContent.read(content).names().items()}

    def arm(self, faults: Mapping[str, int]) -> None:
        settings = self.card.settings
        plain = type(settings)._figure.__get__(settings)
        write = forgetting(faults, plain)
        settings._figure = lambda name, figures: (plain if figures[0] is None else write)(name, figures) or []

    def power_cycle(self) -> None:
        self.switch_on()

    def left_over(self, ended: Outcome | Exception, faults: Mapping[str, int]) -> list[str]:
        half = bytes(self.card._line)
        is_left = isinstance(ended, CancelledError) and half and not faults.keys() & DAMAGE
        return [f"half a line is left: {half!r}"] if is_left else []


def _figures(figures: Any) -> str:
    return ", ".join(f"{float(figure):.7g}" for figure in figures)


def card_file(chance: random.Random) -> ParameterFile:
    """Return some values for a card."""
    file = ParameterFile(load_schema("acromill"))
    for name, unit in (
        ("axes.pulses_per_unit", "counts/in"),
        ("servo.p_gain", "V/count"),
        ("servo.torque_limits", "V"),
        ("servo.i_gain", "V/count/s"),
        ("axes.excess_error_band", "in"),
    ):
        for axis in chance.sample("XYZ", chance.randrange(3)):
            text = f"{chance.uniform(0.001, 9):.5f}"
            file.take({(name, axis): read_value(file.schema.parameters[name], text, unit)})
    if chance.random() < 0.3:
        table = file.schema.parameters["ballscrew.table"]
        file.take({("ballscrew.table", "Y"): read_value(table, "Y0E.00325 Y1E-.00120", "")})
    return file


def terminal_run(chance: random.Random, folder: Path, faults: Mapping[str, int] | None) -> list[str]:
    """Download to an ACR card."""
    faults = choose_faults(chance, 20_000) if faults is None else faults
    return _tried(CardFaults(folder / "card"), card_file(chance), faults, chance, folder)


# -- the parameter table of a NUM control ----------------------------------------------------------


class TableFaults(_Remembering, NumBench):
    """A NUM control with a small table."""

    def __init__(self, folder: Path, parity: str) -> None:
        folder.mkdir()
        (folder / "table").write_bytes(TABLE)
        self.parity = parity
        super().__init__(folder, parity=parity)

    @property
    def memory(self) -> Memory:
        return self.control._parameters._memory

    def present(self) -> Values:
        types, words = self.control._parameters.types, self.control._parameters.words
        base = {0: 16, 5: 10, 6: 16}
        return {
            f"P{p}N{n}": f"{int(word, base[types[p]]):X}" for p in words for n, word in enumerate(words[p])
        }

    def names(self, content: bytes) -> Values:
        found = {
            name: int(word, 10 if name.startswith("P13") else 16)
            for name, word in words_of_table(content).items()
        }
        return {name: f"{word:X}" for name, word in found.items()}

    def arm(self, faults: Mapping[str, int]) -> None:
        self.refuses = {"load", "unload"} & faults.keys()
        parameters = self.control._parameters
        parameters.load = forgetting(faults, type(parameters).load.__get__(parameters))

    def power_cycle(self) -> None:
        self.switch_on()
        self.press(f"parity {self.parity}")

    def left_over(self, ended: Outcome | Exception, faults: Mapping[str, int]) -> list[str]:
        sent = bytes(byte & 0x7F for byte in self.lines[-1].sent)
        is_left = isinstance(ended, CancelledError) and sent and not sent.endswith((b"\n", b"\x13"))
        return [f"half a line is left: {sent[-20:]!r}"] if is_left else []


def table_run(chance: random.Random, folder: Path, faults: Mapping[str, int] | None) -> list[str]:
    """Load the table of a NUM control."""
    if faults is None:
        # A table has lengths and parity, which two characters in the other order leave as they are; no serial
        # line does that.
        faults = choose_faults(chance, 1_500, without=("swap",))
        if chance.random() < 0.2:
            faults[chance.choice(("unload", "load"))] = 1  # which the person does not do
    parity = chance.choice(["even", "even", "odd"] + ["none"] * (not faults.keys() & DAMAGE))
    bench = TableFaults(folder / "cnc", parity)
    file = ParameterFile(load_schema("num"))
    for number in {chance.choice(("P9N0", "P9N11", "P9N31", "P13N2", "P13N17")) for _ in range(3)}:
        address = file.find(number)
        parameter = file.schema.parameters[address[0]]
        file.take({address: value_of_stored(parameter, chance.randrange(3, 25), turns=False)})
    return _tried(bench, file, faults, chance, folder, f"{parity} ")


# -- the registers of a rack -----------------------------------------------------------------------

_LIVE = (64, 65, 66, 67, 104, 105, AXIS_Y - 1)


class RackFaults(RackBench):
    """A module in a rack, which keeps nothing without power; registers that contain 0 are left out."""

    memory = files_at_control = None

    def progress(self, stage: str, done: int, total: int) -> None:
        """Nobody is asked for anything."""

    def present(self) -> Values:
        return {
            f"R{r}": str(word)
            for r, word in enumerate(self.words)
            if word and r % AXIS_Y not in _LIVE and r % AXIS_Y not in READ_ONLY
        }

    def names(self, content: bytes) -> Values:
        return {f"R{register}": str(word) for register, word in words_of_content(content).items() if word}

    def arm(self, faults: Mapping[str, int]) -> None:
        module = self.rack.module
        module.write = forgetting(faults, type(module).write.__get__(module))

    def power_cycle(self) -> None:
        raise AssertionError("a rack without power has no registers")

    def left_over(self, ended: Outcome | Exception, faults: Mapping[str, int]) -> list[str]:
        self.driver.close()
        self.driver.identify()  # ends half a line that the download has left
        is_left = any(self.words[axis + r] for axis in (0, AXIS_Y) for r in (66, 67))
        is_looked_at = isinstance(ended, Outcome) or not faults.keys() - {"stop"}
        return ["a command is left behind"] if is_left and is_looked_at else []


def registers_run(chance: random.Random, folder: Path, faults: Mapping[str, int] | None) -> list[str]:
    """Download to the registers of a module."""
    faults = choose_faults(chance, 40_000, without=("power", "kill")) if faults is None else faults
    bench, file = RackFaults(folder / "rack"), ParameterFile(load_schema("57c422b"))
    bench.words[12], bench.words[AXIS_Y + 10] = 17, 4
    for number in {chance.choice(("R3", "R4", "R5", "R8", "R2051", "R2052", "R63")) for _ in range(4)}:
        address = file.find(number)
        file.take(
            {address: value_of_stored(file.schema.parameters[address[0]], chance.randrange(2), turns=False)}
        )
    return _tried(bench, file, faults, chance, folder)


# -- the house protocol ----------------------------------------------------------------------------


class HouseFaults(_Remembering):
    """A control of the house at a line of 11,520 bytes a second."""

    def __init__(self, folder: Path, initial: ParameterFile, chance: random.Random) -> None:
        self.clock = VirtualClock()
        self.wrap: Callable[[Link], Link] = lambda link: link
        self._folder, self._initial = folder, initial
        self._forgets = 0
        self._modem = NullModem(self._control(), self.clock, bytes_per_second=11_520, window=4, chunk=64)
        session = Session(self._open, clock=self.clock, sleep=self.clock.sleep, random_bytes=chance.randbytes)
        self.driver = HouseDriver(session)

    def _control(self) -> Control:
        schema = self._initial.schema
        identity = Identity(schema.family.family, schema.signature)
        return Control(self._folder, identity, encode_image(self._initial), accept=decode_image)

    def _open(self, look: Callable[[], None]) -> Link:
        look()
        self.clock.sleep(0.001)
        try:
            link = self._modem.connect()
        except PowerLoss:
            self.power_cycle()
            raise LinkError("bench", "the control has no power") from None
        return self.wrap(link)

    def progress(self, stage: str, done: int, total: int) -> None:
        """Nobody is asked for anything."""

    @property
    def memory(self) -> Memory:
        return self._modem.control.memory

    def present(self) -> Values:
        return self.names(self._modem.control.image)

    def names(self, content: bytes) -> Values:
        *lines, end = content.decode("utf-8").splitlines()
        values = [line.split("\t") for line in lines if "\t" in line]
        return {"end": end} | {address: value for _, address, value in values}

    def arm(self, faults: Mapping[str, int]) -> None:
        control = self._modem.control  # one commit is all that it writes
        faults = {"forget": 1} if "forget" in faults else {}
        control._replace_active = forgetting(faults, type(control)._replace_active.__get__(control))

    def power_cycle(self) -> None:
        with contextlib.suppress(PowerLoss):
            self._modem.control.close()
        self._modem.control = self._control()

    def left_over(self, ended: Outcome | Exception, faults: Mapping[str, int]) -> list[str]:
        return []


def house_run(chance: random.Random, folder: Path, faults: Mapping[str, int] | None) -> list[str]:
    """Download an image in the house protocol."""
    faults = choose_faults(chance, 8_000) if faults is None else faults
    file = ParameterFile(load_schema("57c422b"))
    for number in ("R3", "R4", "R5", "R8", "R2051", "R2052", "R63"):
        address = file.find(number)
        file.take({address: value_of_stored(file.schema.parameters[address[0]], 0, turns=False)})
    bench = HouseFaults(folder / "control", file, chance)
    changed = file.copy()
    for address in chance.sample(list(file.values), 3):
        changed.take({address: value_of_stored(file.schema.parameters[address[0]], 1, turns=False)})
    try:
        return _tried(bench, changed, faults, chance, folder)
    finally:
        bench._modem.control.close()
