"""An emulated control in a separate process, on a real line, with its memory on disk.

The manual's chapter 2 for the 9/PC is its model: a download needs E-stop, the control restarts to make it
current (by itself or by hand), and until then no client can talk to it.
"""

from __future__ import annotations

import contextlib
import os
import queue
import stat
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from functools import partial

from amp_studio.schema import quoted, visible
from amp_studio.transfer.house import Code, Flags, RefusalError, Refused, encode_frame, pack
from amp_studio.transfer.interruption import interrupts
from amp_studio.transfer.links import Endpoint, Link, LinkError, Listener, TcpLink, listen, parse_endpoint
from amp_studio.transfer.status import ControlStatus

from .control import Control
from .faults import Faults, FaultyLine, arm
from .panel import OperatorPanel, PlainPanel, ScreenPanel, Start, TimedPanel
from .responder import CHUNK, WINDOW, Responder
from .screen import open_screen

_RESTART_SECONDS = 0.5
_SLICE = 0.05  # seconds between two looks at the operator's commands
CLIENT_SILENCE = 5.0  # seconds without a whole frame after which another client may take the control over
_UNREAD_LIMIT = 0.2  # seconds for which a client that reads no answers may keep all others waiting
LINES = 8  # open at once; beyond them the one that was opened first and does not have the control is cut
PIECE = 2_048  # bytes of one client that are worked on before the next client has a turn
_COMMANDS_WAITING = 256  # operator's commands that are kept until there is time for them
_COMMANDS_A_TURN = 16
LONGEST_COMMAND = 4_096  # bytes
LONGEST_LINE = 300  # characters the operator sees of what another program has sent

Patch = Callable[[bytes, str, str], bytes]

_COMMANDS = "estop on|off, autostart on|off, restart, patch KEY=VALUE, status, quit"


class Caller:
    """An open line; ``last_frame`` is when it brought a whole frame, at first when it was opened
    (seconds).
    """

    def __init__(self, link: Link, responder: Responder, now: float) -> None:
        self.link = link
        self.responder = responder
        self.last_frame = now

    def is_silent(self, now: float) -> bool:
        """Whether nothing that could be understood has come for so long that another client is served."""
        return now - self.last_frame > CLIENT_SILENCE


class Emulator:
    """Serves one client at a time until ``quit`` or ``stop``.

    The control belongs to the client that has sent a whole frame, until another sends one after the first
    has sent none for HELD_LINE seconds: bytes that are no frame do not count.

    ``patch`` gets the image, a key and a value and returns the changed image; it may raise ValueError with
    what the operator is to read. ``screen`` has its turn whatever the control does. ``say`` gets what the
    operator is to see, one line at a time.
    """

    def __init__(
        self,
        control: Control,
        listener: Listener,
        *,
        patch: Patch | None = None,
        panel: OperatorPanel | None = None,
        faults: Faults | None = None,
        screen: Callable[[], None] = lambda: None,
        restart_seconds: float = _RESTART_SECONDS,
        window: int = WINDOW,
        chunk: int = CHUNK,
        say: Callable[[str], None] = print,
        stop: threading.Event | None = None,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self._control = control
        self._listener = listener
        self._patch = patch
        self._panel = panel or PlainPanel()
        self._start: tuple[object, Start] | None = None
        """What the next start brings, and for which state of the control."""
        faults = faults or Faults()
        self._line = FaultyLine(faults)
        self._restart_seconds = restart_seconds
        self._window = window
        self._chunk = chunk
        self._show = say
        self._screen = screen
        self._commands: queue.Queue[str] = queue.Queue(_COMMANDS_WAITING)
        self._callers: list[Caller] = []  # in the order in which they came
        self._holder: Caller | None = None
        self._has_quit = False
        self._stop = stop or threading.Event()
        self._restart_due = False
        self._back_at: float | None = None  # when a restart ends
        self._clock, self._sleep = clock, sleep
        self._now = clock()
        arm(control, faults)

    def operate(self, line: str) -> None:
        """Give an operator's command; it is done between two messages. May be called from any other thread,
        and waits there while too many are waiting.
        """
        self._commands.put(line)

    def run(self) -> None:
        """Serve until ``quit`` or ``stop``; raises LinkError when nothing can be listened on any more."""
        try:
            self._started()
            while not self._is_over():
                self.turn()
        finally:
            self._close_link()

    def turn(self) -> None:
        """Do what the operator asks for, and give each client its turn;
        waits 0.05 s at most for something to do.
        """
        if isinstance(self._panel, TimedPanel):
            before, self._now = self._now, self._clock()
            self._panel.advance(self._control, self._now - before)
        self._screen()
        self._execute()
        if self._restart_due:
            self._restart_due = False
            self._back_at = self._clock() + self._restart_seconds
            self._close_link()
            self._prepare_start()
        if self._back_at is not None:
            self._stay_away(self._back_at)
            return
        self._admit()
        for caller in list(self._callers):
            self._serve(caller)

    def _admit(self) -> None:
        """Take the next line, and cut those that are in its way."""
        link = self._listener.accept(0 if self._callers else _SLICE)
        if link is None:
            return
        # A window of answers has room in any line: one that is full is not being read.
        if isinstance(link, TcpLink):
            link.write_limit = _UNREAD_LIMIT
        responder = Responder(self._control, window=self._window, chunk=self._chunk)
        newest = Caller(self._line.wrap(link), responder, self._clock())
        others = [caller for caller in self._callers if caller is not self._holder]
        for caller in others:
            if caller.is_silent(self._clock()) or len(self._callers) >= LINES:
                self._drop(caller)
        self._callers.append(newest)

    def _serve(self, caller: Caller) -> None:
        """Answer what has come on one line; whatever goes wrong with it ends that line and nothing else."""
        if caller not in self._callers or self._is_over() or self._restart_due:
            return
        waited_for = self._holder or self._callers[-1]
        try:
            data = caller.link.read(_SLICE if caller is waited_for else 0)
            for start in range(0, len(data), PIECE):
                self._answer(caller, data[start : start + PIECE])
                self._execute()
                if self._is_over() or self._restart_due or caller not in self._callers:
                    return
        except LinkError:
            self._drop(caller)  # the client is gone; what it has staged stays
        except Exception as error:  # a fault of the control itself: another client may do better
            self._drop(caller)
            self._show(f"a client was cut off: {type(error).__name__}: {_line(str(error))}")

    def _answer(self, caller: Caller, data: bytes) -> None:
        """Answer the frames of a caller; the control is of one at a time, until that one is silent."""
        for frame in caller.responder.frames(data):
            caller.last_frame = now = self._clock()
            holder = self._holder
            if holder is not None and holder is not caller:
                if not holder.is_silent(now):
                    busy = Refused(Code.BUSY, "another client has the control")
                    caller.link.write(encode_frame(pack(busy, frame.sequence)))
                    self._drop(caller)
                    return
                self._drop(holder)
            self._holder = caller
            answer = caller.responder.answer(frame)
            self._restart_due |= caller.responder.restart_due
            caller.link.write(answer)
            if self._restart_due:
                return

    def _drop(self, caller: Caller) -> None:
        caller.link.close()
        self._callers.remove(caller)
        if self._holder is caller:
            self._holder = None

    def _is_over(self) -> bool:
        return self._has_quit or self._stop.is_set()

    def _close_link(self) -> None:
        for caller in list(self._callers):
            self._drop(caller)

    def _stay_away(self, back_at: float) -> None:
        """Be gone until a time, and come back started once more."""
        self._close_link()
        left = back_at - self._clock()
        if left <= 0:
            self._back_at = None
            self._report(self._restarted)
            self._started()
            return
        caller = self._listener.accept(min(left, _SLICE))
        if caller is not None:
            caller.close()
            self._sleep(min(left, _SLICE))

    # -- the operator ------------------------------------------------------------------------------

    def _execute(self) -> None:
        for _ in range(_COMMANDS_A_TURN):
            if self._commands.empty():
                return
            line = self._commands.get().strip()
            if line:
                self._report(partial(self._done, line))

    def _report(self, action: Callable[[], str]) -> None:
        """Do something and show the operator how it went."""
        try:
            self._show(action())
        except (RefusalError, ValueError) as error:
            self._show(f"refused: {_line(str(error))}")
        except OSError as error:
            self._show(f"refused: the control cannot write its memory ({error.strerror or error})")
        except Exception as error:  # no word of an operator ends a control
            self._show(f"refused: {type(error).__name__}: {_line(str(error))}")

    def _restarted(self) -> str:
        self._control.restart()
        return f"restarted {self._control.boot_count}"

    def _prepare_start(self) -> None:
        """Ask the panel for the next start, while there is time; again if the control was changed since."""
        state = self._control.sha256, self._control.flags & Flags.CHANGED_AT_CONTROL
        if self._start is None or self._start[0] != state:
            self._start = state, self._panel.started(self._control)

    def _started(self) -> None:
        """Show what the family's control shows at a start,
        and keep it in E-stop where it does not come out of it.
        """
        self._prepare_start()
        assert self._start is not None
        _, start = self._start
        self._start = None
        for message in start.messages:
            self._show(_line(message))
        self._control.keep_in_estop(start.estop_reason)
        if start.estop_reason:
            self._show(f"kept in E-stop: {_line(start.estop_reason)}")

    def _done(self, line: str) -> str:
        """Do a command and return what the operator reads."""
        if len(line) > LONGEST_COMMAND:
            raise ValueError(f"a command has {LONGEST_COMMAND} bytes at most")
        verb, _, rest = line.partition(" ")
        rest = rest.strip()
        match verb, rest:
            case "estop", "on" | "off":
                self._control.set_estop(rest == "on")
            case "autostart", "on" | "off":
                self._control.set_autostart(rest == "on")
            case "restart", "":
                self._restart_due = True
                return "restarting"
            case "status", "":
                return self._status()
            case "quit", "":
                self._has_quit = True
                return "bye"
            case "patch", _ if "=" in rest:
                self._patched(*rest.split("=", 1))
            case _:
                answer = self._panel.operate(self._control, verb, rest)
                if answer is None:
                    words = ", ".join(filter(None, (_COMMANDS, self._panel.words)))
                    raise ValueError(f"{quoted(line)} is no command: {words}")
                return answer
        return visible(line)

    def _patched(self, key: str, value: str) -> None:
        patch = self._patch
        if patch is None:
            raise ValueError("this control cannot be patched")
        self._control.patch(lambda image: patch(image, key.strip(), value.strip()))

    def _status(self) -> str:
        control = self._control
        flags = control.flags
        state = {flag.name: "on" if flags & flag else "off" for flag in Flags}
        words = " ".join(f"{str(name).lower().replace('_', '-')}={on}" for name, on in state.items())
        image = f"size={len(control.image)} sha256={control.sha256.hex()}"
        return f"status {words} incarnation={control.boot_count} {image}"


def serve(
    address: Endpoint | str,
    control: Control,
    *,
    patch: Patch | None = None,
    panel: OperatorPanel | None = None,
    faults: Faults | None = None,
    screen: Endpoint | None = None,
    restart_seconds: float = _RESTART_SECONDS,
    commands: Iterable[str] | None = None,
    say: Callable[[str], None] | None = None,
    stop: threading.Event | None = None,
) -> int:
    """Run an emulated control until ``quit``, an interrupt or ``stop``; return the exit code 0.

    Prints ``listening on ADDRESS`` when it is ready. ``commands`` are the operator's lines; by default those
    of standard input if that is a terminal or a pipe. Raises ValueError for an address that is none,
    LinkError for one that cannot be listened on.
    """
    show = say or print_line
    stop = stop or threading.Event()
    with contextlib.ExitStack() as stack:
        stack.callback(control.close)
        stack.enter_context(interrupts(stop.set))
        place = parse_endpoint(address) if isinstance(address, str) else address
        place.need_all_bytes("the house protocol")
        listener = listen(place)
        stack.callback(listener.close)
        show(f"listening on {listener.endpoint}")
        emulator = Emulator(
            control,
            listener,
            patch=patch,
            panel=panel,
            faults=faults,
            screen=open_screen(screen, _screen_of(panel, control), show, stack),
            restart_seconds=restart_seconds,
            say=show,
            stop=stop,
        )
        lines = standard_input() if commands is None else commands

        def forward() -> None:
            for line in lines:
                emulator.operate(line)

        threading.Thread(target=forward, name="operator", daemon=True).start()
        emulator.run()
        if stop.is_set():
            show("bye")
    return 0


def _screen_of(panel: OperatorPanel | None, control: Control) -> Callable[[], ControlStatus] | None:
    return partial(panel.screen, control) if isinstance(panel, ScreenPanel) else None


def print_line(line: str) -> None:
    """Print a line for the operator; where it is not read, the control goes on without a word."""
    try:
        print(line, flush=True)
    except (OSError, ValueError):
        # What waits to be written would fail again at the end of the program.
        with contextlib.suppress(OSError, ValueError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def standard_input() -> Iterator[str]:
    """Yield the lines of standard input where an operator can write there: at a terminal or through a pipe.

    It reads the handle itself: a thread that waits inside ``sys.stdin`` would delay the end of the program.
    """
    try:
        handle = sys.stdin.fileno()
        if not (os.isatty(handle) or stat.S_ISFIFO(os.fstat(handle).st_mode)):
            return
        rest = b""
        while data := os.read(handle, 4_096):
            *lines, rest = (rest + data).split(b"\n")
            yield from (line.decode("utf-8", errors="replace") for line in lines)
            rest = rest[: LONGEST_COMMAND + 1]  # enough to be refused as too long
        yield rest.decode("utf-8", errors="replace")
    except (AttributeError, OSError, ValueError):
        return


def _line(text: str) -> str:
    """Return a text, some of which may be a stranger's, as one short line that steers no terminal."""
    printable = visible(text[: LONGEST_LINE + 1])
    return printable if len(printable) <= LONGEST_LINE else printable[:LONGEST_LINE] + " …"
