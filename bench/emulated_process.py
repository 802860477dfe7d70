"""An emulated control in a separate process, with an operator who types."""

import os
import queue
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


class EmulatedProcess:
    """A control that runs."""

    def __init__(self, process: "subprocess.Popen[str]", *, has_screen: bool) -> None:
        self._process = process
        self._printed: queue.Queue[str] = queue.Queue()
        threading.Thread(target=self._read, daemon=True).start()
        self.address = self.line("listening on ")
        """Where its protocol is spoken."""
        self.screen = self.line("screen at ") if has_screen else ""
        """Where its screen is read; "" for a protocol that shows the machine itself."""

    def _read(self) -> None:
        assert self._process.stdout is not None
        for line in self._process.stdout:
            self._printed.put(line.strip())

    def line(self, begin: str) -> str:
        """Return what follows in the next line that begins so."""
        while not (line := self._printed.get(timeout=60)).startswith(begin):
            pass
        return line.removeprefix(begin)

    def operate(self, command: str) -> None:
        """Give a command of the operator."""
        assert self._process.stdin is not None
        self._process.stdin.write(f"{command}\n")
        self._process.stdin.flush()


@contextmanager
def emulated(family: str, listen: str, state: Path, *options: str) -> Iterator[EmulatedProcess]:
    """Run an emulated control until the end of the block."""
    command = [sys.executable, "-m", "amp_studio.cli", "emulate", family, "--listen", listen]
    with subprocess.Popen(
        [*command, "--state", str(state), *options],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    ) as process:
        try:
            control = EmulatedProcess(process, has_screen="--screen" in options)
            yield control
            control.operate("quit")
        finally:
            assert process.stdin is not None
            process.stdin.close()
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
