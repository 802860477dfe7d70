"""An emulated control that speaks in its family's own way: one device behind one line.

What it sends and obeys is its family's code (``Registration.emulators``); the line,
the operator and the faults are here.
"""

from __future__ import annotations

import contextlib
import queue
import threading
import time
from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

from amp_studio.schema import quoted, visible
from amp_studio.transfer.interruption import interrupts
from amp_studio.transfer.links import Endpoint, Link, LinkError, Listener, PtyLink, listen
from amp_studio.transfer.status import ControlStatus

from .emulator import LONGEST_COMMAND, LONGEST_LINE, print_line, standard_input
from .family_control import EmulatedOptions, memory_folder
from .faults import Faults, FaultyLine, die, read_faults
from .memory import Memory
from .screen import open_screen

_SLICE = 0.02  # seconds a turn waits for bytes
STEP = 0.001  # seconds of the machine that are stepped at least: a step for each character costs more
PIECE = 256  # bytes that are worked on before the operator has a turn
_COMMANDS_WAITING = 256


class LineDevice(Protocol):
    """What is behind the line of an emulated control. It opens nothing and waits for nothing."""

    def connected(self) -> None:
        """Learn that a client has taken the line; whatever the last one left half done is still there."""

    def receive(self, data: bytes) -> None:
        """Take what has come on the line."""

    def answer(self) -> bytes:
        """Return the next bytes to be sent, some hundred at most; b"" for nothing."""

    def operate(self, line: str) -> str:
        """Do what the operator asks for and return what he reads; raises ValueError with what he is to
        read.
        """


@runtime_checkable
class _SetLineDevice(Protocol):
    """A device to which it matters how the client has set its end of the line."""

    def line_set(self, baud: int, stop: int) -> None:
        """Learn the rate in bit/s and the stop bits, before ``receive``, where the line shows them."""


@runtime_checkable
class TimedDevice(Protocol):
    """A device in which time passes: a machine moves behind it."""

    def advance(self, duration: float) -> None:
        """Let a time pass, s; called before what has come on the line is taken."""


@runtime_checkable
class _ScreenDevice(Protocol):
    """A device whose screen others can read."""

    def screen(self) -> ControlStatus:
        """Return what the screen shows now."""


@dataclass(frozen=True)
class DeviceSetup:
    """What an emulated control is made of.

    ``memory``  what it remembers without power
    ``say``     shows a line to the operator: what the control's own screen shows
    """

    family: str
    memory: Memory
    say: Callable[[str], None]
    machine: str | None = None
    hardware: Mapping[str, str] = field(default_factory=dict)


DeviceFactory = Callable[[DeviceSetup], LineDevice]


class DeviceService:
    """Serves one client at a time until ``quit`` or ``stop``;
    a new connection takes the line over from the old one.
    """

    def __init__(
        self,
        device: LineDevice,
        listener: Listener,
        *,
        faults: Faults | None = None,
        say: Callable[[str], None] = print,
        stop: threading.Event | None = None,
        screen: Callable[[], None] = lambda: None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._device = device
        self._listener = listener
        self._line = FaultyLine(faults or Faults())
        self._show = say
        self._screen = screen
        self._stop = stop or threading.Event()
        self._commands: queue.Queue[str] = queue.Queue(_COMMANDS_WAITING)
        self._link: Link | None = None
        self._port: Link | None = None
        """The line itself, under its faults."""
        self._has_quit = False
        self._clock, self._now = clock, clock()

    def operate(self, line: str) -> None:
        """Give an operator's command; may be called from any other thread,
        and waits there while too many are waiting.
        """
        self._commands.put(line)

    def run(self) -> None:
        """Serve until ``quit`` or ``stop``; raises LinkError when nothing can be listened on any more."""
        try:
            while not (self._has_quit or self._stop.is_set()):
                self.turn()
        finally:
            self._drop()

    def turn(self) -> None:
        """Do what the operator asks for, then send and take some bytes; waits 0.02 s at most."""
        if isinstance(self._device, TimedDevice) and (passed := self._clock() - self._now) >= STEP:
            self._now += passed
            self._device.advance(passed)
        self._screen()
        self._execute()
        caller = self._listener.accept(0 if self._link else _SLICE)
        if caller is not None:
            self._drop()
            self._port, self._link = caller, self._line.wrap(caller)
            self._device.connected()
        if self._link is None:
            return
        try:
            answer = self._device.answer()
            if answer:
                self._link.write(answer)
            data = self._link.read(0 if answer else _SLICE)
            if isinstance(self._port, PtyLink) and isinstance(self._device, _SetLineDevice):
                self._device.line_set(*self._port.client_settings())
            for start in range(0, len(data), PIECE):
                self._device.receive(data[start : start + PIECE])
                self._link.write(self._device.answer())
        except LinkError:
            self._drop()
        except Exception as error:  # a fault of the device itself: another client may do better
            self._drop()
            self._show(f"the line was cut: {type(error).__name__}: {_one_line(str(error))}")

    def _drop(self) -> None:
        if self._link is not None:
            self._link.close()
            self._link = None

    def _execute(self) -> None:
        while not self._commands.empty() and not self._has_quit:
            line = self._commands.get().strip()
            if line == "quit":
                self._has_quit = True
                self._show("bye")
            elif line:
                try:
                    if len(line) > LONGEST_COMMAND:
                        raise ValueError(f"a command has {LONGEST_COMMAND} bytes at most")
                    self._show(self._device.operate(line))
                except (ValueError, OSError) as error:
                    self._show(f"refused: {_one_line(str(error))}")


def serve_device(
    place: Endpoint, options: EmulatedOptions, factory: DeviceFactory, *, takes: Collection[str] = ()
) -> int:
    """Run a device until ``quit`` on standard input, or an interrupt; returns the exit code 0.

    Prints ``listening on ADDRESS`` when it is ready; ``takes`` are the options that the device knows.
    Raises LinkError for a place that cannot be listened on, ValueError for a folder of something else and
    for another option.
    """
    for name in options.hardware:
        if name not in takes:
            known = f"Known: {', '.join(takes)}" if takes else "It has none"
            raise ValueError(f"Unknown option {quoted(name)} of an emulated {options.family}. {known}")
    stop = threading.Event()
    with contextlib.ExitStack() as stack:
        stack.enter_context(interrupts(stop.set))
        faults = read_faults(options.faults)
        memory = Memory(memory_folder(options, stack))
        device = factory(DeviceSetup(options.family, memory, print_line, options.machine, options.hardware))
        _arm(memory, faults)
        listener = listen(place)
        stack.callback(listener.close)
        print_line(f"listening on {listener.endpoint}")
        status = device.screen if isinstance(device, _ScreenDevice) else None
        screen = open_screen(options.screen, status, print_line, stack)
        service = DeviceService(device, listener, faults=faults, say=print_line, stop=stop, screen=screen)

        def forward() -> None:
            for line in standard_input():
                service.operate(line)

        threading.Thread(target=forward, name="operator", daemon=True).start()
        service.run()
        if stop.is_set():
            print_line("bye")
    return 0


def _arm(memory: Memory, faults: Faults) -> None:
    """Prepare a memory for the faults that it can have; a step of a save is any step on the disk."""
    memory.full_at = faults.disk_full_at
    left = faults.die_at_commit_step

    def step(_: str) -> None:
        nonlocal left
        if left is not None:
            left -= 1
            if left == 0:
                die()

    memory.on_step = step


def _one_line(text: str) -> str:
    """Return a text, some of which may be a stranger's, as one short line that steers no terminal."""
    printable = visible(text[: LONGEST_LINE + 1])
    return printable if len(printable) <= LONGEST_LINE else printable[:LONGEST_LINE] + " …"
