"""What the tests of the exchange share: emulated controls, in this process or in one of their own."""

import json
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import pytest

from amp_studio.files import Document, open_file
from amp_studio.schema import Value
from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.faults import Faults, FaultyLine
from amp_studio.transfer.emulated.record import Identity
from amp_studio.transfer.house.session import Session
from amp_studio.transfer.links.link import Link, LinkError
from tests.forked import Program, start_program

from . import emulated_control, images
from .null_modem import NullModem, VirtualClock

OLD = b"".join(b"%d\told.value.%d\t%d mm\n" % (n, n, n * 7) for n in range(12))
NEW = b"".join(b"%d\tnew.value.%d\t%d mm\n" % (n, n, n * 9) for n in range(14))
SIGNATURE = "s1"
EXAMPLE = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"
StartControl = Callable[..., tuple[Program, str]]


@pytest.fixture(autouse=True)
def quick_disk(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leave out the waiting for the disk in this process; what is written and renamed stays as it is."""
    monkeypatch.setattr("amp_studio.transfer.emulated.memory.os.fsync", lambda handle: None)


@pytest.fixture
def new_control(tmp_path: Path) -> Iterator[Callable[..., Control]]:
    """Give a function that makes a control, in a separate folder unless one is given."""
    made: list[Control] = []

    def make(folder: Path | None = None, initial: bytes = OLD, **options: Any) -> Control:
        place = folder or tmp_path / f"control-{len(made)}"
        control = Control(place, Identity("9pc", SIGNATURE, "CNC_1", "3.05"), initial, **options)
        made.append(control)
        return control

    yield make
    for control in made:
        control.close()


@dataclass
class Rig:
    """A session and a control on a null modem, in a separate time."""

    control: Control
    clock: VirtualClock
    modem: NullModem
    line: FaultyLine
    options: dict[str, Any] = field(default_factory=dict)
    lines_left: int = 1_000_000

    def open_link(self, look: Callable[[], None] = lambda: None) -> Link:
        if self.lines_left == 0:
            raise LinkError("null modem", "the cable is out")
        link = self.modem.connect()
        self.lines_left -= 1
        return self.line.wrap(link)

    def session(self) -> Session:
        numbers = iter(range(1, 1_000_000))

        def counted(length: int) -> bytes:
            return next(numbers).to_bytes(4, "little").ljust(length, b"\x07")[:length]

        return Session(
            self.open_link, clock=self.clock, sleep=self.clock.sleep, random_bytes=counted, **self.options
        )


@pytest.fixture
def rig(new_control: Callable[..., Control]) -> Callable[..., Rig]:
    """Give a function that connects a session and a control; little images have many pieces."""

    def make(
        faults: Faults | None = None,
        *,
        control: Control | None = None,
        bytes_per_second: float | None = None,
        latency: float = 0.0,
        window: int = 4,
        chunk: int = 32,
        lines: int = 1_000_000,
        **options: Any,
    ) -> Rig:
        clock = VirtualClock()
        modem = NullModem(
            control or new_control(),
            clock,
            bytes_per_second=bytes_per_second,
            latency=latency,
            window=window,
            chunk=chunk,
        )
        return Rig(modem.control, clock, modem, FaultyLine(faults or Faults()), options, lines)

    return make


@dataclass
class Emulated:
    """An emulated control in a separate process; ``address`` is where it listens."""

    process: Program
    address: str

    def operate(self, line: str) -> str:
        """Give an operator's command and return the control's answer."""
        self.process.stdin.write(line + "\n")
        self.process.stdin.flush()
        return self.next_line()

    def next_line(self) -> str:
        return self.process.stdout.readline().strip()

    @property
    def is_dead(self) -> bool:
        return self.process.poll() is not None

    def kill(self) -> None:
        self.process.kill()
        self.process.wait(60)


@pytest.fixture
def emulate() -> Iterator[Callable[..., Emulated]]:
    """Give a function that starts an emulated control: ``emulate(folder, address, **options)``."""
    started: list[Program] = []

    def start(folder: Path, address: str = "tcp://127.0.0.1:0", **options: Any) -> Emulated:
        options.setdefault("initial", OLD.decode())
        process = start_program(address, folder, json.dumps(options), script=emulated_control)
        started.append(process)
        emulated = Emulated(process, "")
        message = emulated.next_line()
        assert message.startswith("listening on "), f"the emulator said {message!r}"
        emulated.address = message.removeprefix("listening on ")
        return emulated

    yield start
    for process in started:
        process.kill()
        process.communicate()


@pytest.fixture
def control(new_control: Callable[..., Any]) -> Callable[..., Any]:
    """Return what makes a control that contains the old image."""
    return lambda **options: new_control(initial=images.OLD, **options)


@pytest.fixture
def start_control(tmp_path: Path) -> Iterator[StartControl]:
    """Give a function that starts ``amp-studio emulate`` and returns the process
    and the address to connect to.
    """
    started: list[Program] = []

    def start(listen: str = "tcp://127.0.0.1:0", *options: str) -> tuple[Program, str]:
        place = ("--listen", listen, "--state", tmp_path / "control", "--machine", "mill")
        started.append(start_program("emulate", "9pc", *place, *options))
        return started[-1], started[-1].stdout.readline().removeprefix("listening on ").strip()

    yield start
    for process in started:
        process.kill()
        process.communicate()


@pytest.fixture(scope="session")
def content_of_mill(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    path = tmp_path_factory.mktemp("made") / "mill.amp"
    file = open_file(EXAMPLE).file
    file.set(file.find("1350"), Value(10.0, "in/min"))
    Document.create(file, path).close()
    return path.read_bytes()


@pytest.fixture
def mill(tmp_path: Path, content_of_mill: bytes) -> Path:
    """The example's mill, which has no errors, with one speed in inches."""
    path = tmp_path / "mill.amp"
    path.write_bytes(content_of_mill)
    return path
