"""An emulated control to practise on, in a process of its own."""

from __future__ import annotations

import sys
from pathlib import Path

from PySide6.QtCore import QObject, QProcess, QTemporaryDir, QTimer, Signal

PATIENCE_MS = 2000


class EmulatedControl(QObject):
    """Starts and ends the process; its memory lies in a folder that goes with the program."""

    ready = Signal(str)
    """The address it listens on."""
    ended = Signal(str)
    """What it said when it ended by itself; empty when it was told to."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.address = ""
        self._stopping = False
        self._folder = QTemporaryDir()
        self._process = QProcess(self)
        self._process.readyReadStandardOutput.connect(self._read)
        self._process.finished.connect(self._finished)
        self._process.errorOccurred.connect(self._failed)

    @property
    def is_running(self) -> bool:
        """Whether the process is there."""
        return self._process.state() != QProcess.ProcessState.NotRunning

    def start(self, family: str, machine: str) -> None:
        """Start it; ``ready`` tells the address. What it held when it was stopped is still there."""
        self._stopping = False
        state = Path(self._folder.path()) / f"{family}-{machine}"
        arguments = ["-m", "amp_studio.cli", "emulate", family, "--listen", "tcp://127.0.0.1:0", "--state", str(state),
                     "--machine", machine]  # fmt: skip
        self._process.start(sys.executable, arguments)

    def say(self, command: str) -> None:
        """Do something at its panel: ``estop on``, ``estop off``, ``restart``."""
        self._process.write(f"{command}\n".encode())

    def stop(self, wait: bool = False) -> None:
        """End the process, or wait for its end as well; its memory stays until the program ends."""
        self._stopping = True
        if self.is_running:
            self.say("quit")
            QTimer.singleShot(PATIENCE_MS, self, self._kill)
            if wait and not self._process.waitForFinished(PATIENCE_MS):
                self._kill()

    def _kill(self) -> None:
        if self._stopping and self.is_running:
            self._process.kill()
            self._process.waitForFinished(PATIENCE_MS)

    def _read(self) -> None:
        while self._process.canReadLine():
            line = bytes(self._process.readLine().data()).decode("utf-8", "replace").strip()
            if line.startswith("listening on "):
                self.address = line.removeprefix("listening on ").strip()
                self.ready.emit(self.address)

    def _failed(self, error: QProcess.ProcessError) -> None:
        if error == QProcess.ProcessError.FailedToStart:
            self.ended.emit(self._process.errorString())

    def _finished(self, *_: object) -> None:
        self.address = ""
        said = (
            bytes(self._process.readAllStandardError().data()).decode("utf-8", "replace").strip().splitlines()
        )
        self.ended.emit("" if self._stopping else (said[-1] if said else "it ended by itself"))
