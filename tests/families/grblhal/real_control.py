"""The real firmware on this machine, where ``make peers`` has built it: started on a free port,
ended by its number.
"""

import socket
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

PEERS = Path(__file__).resolve().parents[3] / "build" / "peers"
FIRMWARE, FIVE_AXES = PEERS / "grblhal" / "grblHAL_sim", PEERS / "grblhal5" / "grblHAL_sim"


class RealControl:
    """The firmware's simulator with its memory in a file; it keeps a core busy,
    and obeys nothing but SIGKILL.
    """

    def __init__(self, memory: Path, firmware: Path = FIRMWARE, pace: str = "0") -> None:
        """``pace`` is its time for one of the clock; 0 is as fast as it can, and a move is over at once."""
        self._memory, self._firmware, self._pace = memory, firmware, pace
        self.port = 0
        self._process: subprocess.Popen[bytes] | None = None

    @property
    def address(self) -> str:
        return f"tcp://127.0.0.1:{self.port}?protocol=grbl"

    def start(self) -> None:
        """Give it power, on a port that was free; on another where a stranger was quicker."""
        listens = False
        while not listens:
            with socket.socket() as free:
                free.bind(("127.0.0.1", 0))
                self.port = free.getsockname()[1]
            # Without a time factor of 0 it reads a byte a millisecond of the clock, and computes all the
            # while.
            self._process = subprocess.Popen(
                [self._firmware, "-n", "-t", self._pace, "-p", str(self.port), "-e", self._memory],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                cwd=self._memory.parent,
            )
            listens = _listens(self.port, self._process)

    def kill(self) -> None:
        """Take its power away at once."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            self._process = None


def _listens(port: int, process: subprocess.Popen[bytes]) -> bool:
    """Return whether the port is taken and the firmware runs; it has one client,
    so nobody connects to find out.
    """
    end = time.monotonic() + 60
    while time.monotonic() < end:
        if process.poll() is not None:
            return False
        with socket.socket() as probe:
            try:
                probe.bind(("127.0.0.1", port))
            except OSError:
                time.sleep(0.02)  # it may be about to end because the port is another's
                return process.poll() is None
        time.sleep(0.02)
    raise AssertionError("the firmware does not listen")


@contextmanager
def real_control(folder: Path, firmware: Path = FIRMWARE, pace: str = "0") -> Iterator[RealControl]:
    """Give a control that runs, with a memory that has never been written."""
    control = RealControl(folder / "EEPROM.DAT", firmware, pace)
    control.start()
    try:
        yield control
    finally:
        control.kill()
