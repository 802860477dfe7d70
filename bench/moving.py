"""Whether an emulated control keeps the times of its protocol while its machine moves: at rest, and with
all of its axes under way.
"""

import socket
from collections.abc import Callable, Iterator
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from statistics import median

from emulated_process import EmulatedProcess, emulated
from measure import Measure, timed

from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.transfer import ControlStatus, Exchange
from amp_studio.transfer.client import StatusReader, download_file, fetch_image

TCP = "tcp://127.0.0.1:0"
SHARE, MAX_EXTRA_S = 1.1, 0.005
"""What an answer may take of its time at rest, and s more: it waits for the slice of the machine that is
under way."""


@dataclass(frozen=True)
class Moving:
    """A control, its machine, and the orders that move all of its axes for longer than it is measured."""

    name: str
    family: str
    example: str
    keys: tuple[str, ...] = ()
    """Of the operator."""
    typed: bytes = b""
    """Over the line of the control."""
    protocol: str = ""
    options: tuple[str, ...] = ("--screen", TCP)
    is_set_up: bool = False
    """Whether its parameters come by an option, not by a download."""
    loads: bool = True
    """Whether its protocol gives the parameters while an axis moves; a Grbl does so at rest alone."""

    @property
    def path(self) -> Path:
        """Return where its file is."""
        return next((examples_folder() / self.example).glob("*.amp"))


JOGS = tuple(f"jog {axis}+ slow" for axis in "XYZ")
RUN = tuple(f"patch R{base + 65}={word}" for word in (1, 5) for base in (0, 2048))
CONTROLS = (
    Moving("57C422B", "57c422b", "57c422b-label-press", RUN, protocol="?protocol=registers", options=()),
    Moving(
        "AcroMill",
        "acromill",
        "acromill-router",
        typed=b"JOG FWD X\rJOG FWD Y\rJOG FWD Z\r",
        protocol="?protocol=terminal",
        is_set_up=True,
    ),
    Moving("Grbl", "grblhal", "grblhal-router", typed=b"$J=G91X-250Y-250Z-50F100\n", options=(), loads=False),
    Moving("NUM, serial line", "num", "num-1060-mill", JOGS, protocol="?protocol=peripheral"),
    Moving("NUM, gateway", "num", "num-1060-mill", ("estop off", *JOGS)),
    Moving("9/PC", "9pc", "mill-1394", ("estop off", *(f"jog {axis}- lowest" for axis in "XYZ"))),
)


def measures(folder: Path, times: int) -> Iterator[Measure]:
    """Yield a status and an upload of each control at rest and moving; the median at rest is the target."""
    for n, control in enumerate(CONTROLS):
        state = folder / f"moving-{n}"
        state.mkdir()
        options = ("--option", f"file={control.path}") if control.is_set_up else control.options
        with emulated(control.family, TCP + control.protocol, state / "control", *options) as process:
            yield from _of_control(control, process, state, times)


def _of_control(control: Moving, process: EmulatedProcess, state: Path, times: int) -> Iterator[Measure]:
    exchange = Exchange(keep=state / "bench", progress=_person_at(process))
    if not control.is_set_up:
        download_file(open_file(control.path).file, process.address, exchange)
    seen_at = process.screen or process.address
    resting: dict[str, float] = {}
    for moment in ("at rest", "moving"):
        if moment == "moving":
            _move(control, process)
        with closing(StatusReader(seen_at, control.family)) as reader:
            figures = {"status": timed(reader.read, times)}
            before = reader.read()
        if control.loads:
            few = max(1, times // 5)
            figures["upload"] = timed(
                lambda: fetch_image(process.address, exchange, family=control.family), few
            )
        if moment == "moving":
            with closing(StatusReader(seen_at, control.family)) as reader:
                _assert_moved(before, reader.read())
        for what, seconds in figures.items():
            target = SHARE * resting[what] + MAX_EXTRA_S if what in resting else None
            yield Measure(f"{control.name}: {what} {moment}", seconds, target)
            resting[what] = median(seconds)


def _person_at(process: EmulatedProcess) -> Callable[[str, int, int], None]:
    """Return who reads which key a NUM has to be given, and presses it."""

    def read(stage: str, _done: int, _total: int) -> None:
        for key, menu in (("unload", "3 UNLOAD"), ("load", "2 LOAD")):
            if menu in stage:
                for command in ("exit", key, "enter", *(("start",) if key == "unload" else ())):
                    process.operate(command)

    return read


def _move(control: Moving, process: EmulatedProcess) -> None:
    for command in control.keys:
        process.operate(command)
    if control.typed:
        host, _, port = process.address.partition("?")[0].removeprefix("tcp://").rpartition(":")
        with socket.create_connection((host, int(port)), timeout=10) as line:
            line.settimeout(10)
            line.sendall(control.typed)
            line.recv(1)  # it has begun to read


def _assert_moved(before: ControlStatus, after: ControlStatus) -> None:
    """Raise AssertionError where one of the first axes, X to Z, did not move all the time."""
    for first, last in [*zip(before.axes, after.axes, strict=True)][:3]:
        assert first.position != last.position, (
            f"axis {first.axis} stands still: {after.state} {after.faults}"
        )
