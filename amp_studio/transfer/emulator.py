"""An emulated control in a process of its own, on a real line, with its memory on disk.

The manual's chapter 2 for the 9/PC is its model: a download needs E-stop, the
control restarts to make it current (by itself or by hand), and until then
nobody can talk to it.
"""

from __future__ import annotations

import os
import queue
import stat
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from functools import partial

from .address import Address, parse_address
from .control import Control
from .faults import Faults, FaultyLine, arm
from .frame import FrameDecoder, encode_frame
from .link import Link, LinkError, Listener, listen
from .message import Code, Flags, Refusal, Refused, pack
from .responder import CHUNK, WINDOW, Responder

RESTART_SECONDS = 0.5
SLICE = 0.05  # seconds between two looks at the operator's commands
HELD_LINE = 5.0  # seconds of silence after which another client may take the control over
TURN_AWAY = 0.1  # seconds a second client has for its first word

Patch = Callable[[bytes, str, str], bytes]

COMMANDS = "estop on|off, autostart on|off, restart, patch KEY=VALUE, status, quit"


class Emulator:
    """Serves one client at a time until ``quit``.

    ``patch`` gets the image, a key and a value and returns the changed image; it may raise ValueError with
    what the operator is to read. ``say`` gets what the operator is told, one line at a time.
    """

    def __init__(
        self,
        control: Control,
        listener: Listener,
        *,
        patch: Patch | None = None,
        faults: Faults | None = None,
        restart_seconds: float = RESTART_SECONDS,
        window: int = WINDOW,
        chunk: int = CHUNK,
        say: Callable[[str], None] = print,
    ) -> None:
        self._control = control
        self._listener = listener
        self._patch = patch
        faults = faults or Faults()
        self._line = FaultyLine(faults)
        self._restart_seconds = restart_seconds
        self._window = window
        self._chunk = chunk
        self._say = say
        self._commands: queue.SimpleQueue[str] = queue.SimpleQueue()
        self._next: Link | None = None
        self._quit = False
        self._restart_due = False
        arm(control, faults)

    def command(self, line: str) -> None:
        """Give an operator's command; it is done between two messages. May be called from any thread."""
        self._commands.put(line)

    def run(self) -> None:
        """Serve until ``quit``; raises LinkError when nothing can be listened on any more."""
        while not self._quit:
            self._obey()
            if self._restart_due:
                self._restart()
                continue
            link, self._next = self._next or self._listener.accept(SLICE), None
            if link is not None:
                self._serve(self._line.wrap(link))

    def _serve(self, link: Link) -> None:
        """Answer one client until it hangs up, is cut off, or the control restarts."""
        responder = Responder(self._control, window=self._window, chunk=self._chunk)
        heard = time.monotonic()
        try:
            while not (self._quit or self._restart_due):
                data = link.read(SLICE)
                if data:
                    heard = time.monotonic()
                    answers = responder.receive(data)
                    self._restart_due |= responder.restart_due
                    if answers:
                        link.write(answers)
                self._obey()
                if not data and not self._stays(heard):
                    return
        except LinkError:
            return  # the client is gone; what it has staged stays
        finally:
            link.close()

    def _stays(self, heard: float) -> bool:
        """Whether the client keeps the line; another one gets it only when this one has long been silent."""
        other = self._listener.accept(0)
        if other is None:
            return True
        if time.monotonic() - heard > HELD_LINE:
            self._next = other
            return False
        turn_away(other)
        return True

    def _restart(self) -> None:
        """Be gone for a while, and come back as a new incarnation."""
        end = time.monotonic() + self._restart_seconds
        self._restart_due = False
        while (left := end - time.monotonic()) > 0:
            caller = self._listener.accept(min(left, SLICE))
            if caller is not None:
                caller.close()
                time.sleep(min(left, SLICE))
        self._tell(self._restarted)

    # -- the operator ------------------------------------------------------------------------------

    def _obey(self) -> None:
        while not self._commands.empty():
            line = self._commands.get().strip()
            if line:
                self._tell(partial(self._done, line))

    def _tell(self, action: Callable[[], str]) -> None:
        """Do something and tell the operator how it went."""
        try:
            self._say(action())
        except (Refusal, ValueError) as error:
            self._say(f"refused: {error}")
        except OSError as error:
            self._say(f"refused: the control cannot write its memory ({error.strerror or error})")

    def _restarted(self) -> str:
        self._control.restart()
        return f"restarted {self._control.incarnation}"

    def _done(self, line: str) -> str:
        """Do a command and return what the operator reads."""
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
                self._quit = True
                return "bye"
            case "patch", _ if "=" in rest:
                self._patched(*rest.split("=", 1))
            case _:
                raise ValueError(f"'{line}' is no command: {COMMANDS}")
        return line

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
        return f"status {words} incarnation={control.incarnation} {image}"


def serve(
    address: Address | str,
    control: Control,
    *,
    patch: Patch | None = None,
    faults: Faults | None = None,
    restart_seconds: float = RESTART_SECONDS,
    commands: Iterable[str] | None = None,
    say: Callable[[str], None] | None = None,
) -> int:
    """Run an emulated control until ``quit`` or an interrupt; return the exit code 0.

    Says ``listening on ADDRESS`` when it is ready. ``commands`` are the operator's lines; by default those of
    standard input where that is a terminal or a pipe. Raises ValueError for an address that is none,
    LinkError for one that cannot be listened on.
    """
    tell = say or (lambda line: print(line, flush=True))
    listener = listen(parse_address(address) if isinstance(address, str) else address)
    emulator = Emulator(
        control, listener, patch=patch, faults=faults, restart_seconds=restart_seconds, say=tell
    )
    lines = standard_input() if commands is None else commands

    def forward() -> None:
        for line in lines:
            emulator.command(line)

    threading.Thread(target=forward, name="operator", daemon=True).start()
    tell(f"listening on {listener.address}")
    try:
        emulator.run()
    except KeyboardInterrupt:
        tell("bye")
    finally:
        listener.close()
        control.close()
    return 0


def standard_input() -> Iterator[str]:
    """Yield the lines of standard input where somebody can write there: at a terminal or through a pipe.

    It reads the handle itself: a thread that waits inside ``sys.stdin`` would hold up the end of the program.
    """
    try:
        handle = sys.stdin.fileno()
        if not (os.isatty(handle) or stat.S_ISFIFO(os.fstat(handle).st_mode)):
            return
        rest = b""
        while data := os.read(handle, 4_096):
            *lines, rest = (rest + data).split(b"\n")
            yield from (line.decode("utf-8", errors="replace") for line in lines)
        yield rest.decode("utf-8", errors="replace")
    except (AttributeError, OSError, ValueError):
        return


def turn_away(link: Link) -> None:
    """Tell a second client that the control is busy."""
    try:
        frames = FrameDecoder().feed(link.read(TURN_AWAY))
        sequence = frames[0].sequence if frames else 0
        link.write(encode_frame(pack(Refused(Code.BUSY, "another client has the control"), sequence)))
    except LinkError:
        return
    finally:
        link.close()
