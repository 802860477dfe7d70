"""An emulated control to practise on, in a separate process."""

from __future__ import annotations

import sys
from pathlib import Path

from PySide6.QtCore import QObject, QProcess, QTemporaryDir, QTimer, Signal

_PATIENCE_MS = 2000


class EmulatedControl(QObject):
    """Starts and stops the process; its memory is in a folder that is removed when the program ends."""

    ready = Signal(str)
    """The address it listens on."""
    line_shown = Signal(str)
    """A line of its screen: a message, or its answer to a command."""
    ended = Signal(str)
    """Its last output when it ended by itself; empty when it was stopped."""

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.address = ""
        self.family = ""
        self.screen = ""
        """The address of its screen; empty where its own protocol shows what it is doing."""
        self._stopping = False
        self._folder = QTemporaryDir()
        self._process = QProcess(self)
        self._process.readyReadStandardOutput.connect(self._read)
        self._process.finished.connect(self._finished)
        self._process.errorOccurred.connect(self._failed)

    @property
    def is_running(self) -> bool:
        """Whether the process is running."""
        return self._process.state() != QProcess.ProcessState.NotRunning

    @property
    def has_estop(self) -> bool:
        """Whether it is in E-stop or not: that of a gateway, which every exchange can ask for."""
        return self.is_running and "protocol=" not in self.address

    def start(self, family: str, machine: str) -> None:
        """Start it; ``ready`` gives the address. Its memory is that of the last time it was stopped."""
        from amp_studio.transfer.emulated import protocol_of_machine

        self._stopping, self.family = False, family
        own = protocol_of_machine(family)
        state = Path(self._folder.path()) / f"{family}-{machine}"
        arguments = [
            "-m",
            "amp_studio.cli",
            "emulate",
            family,
            "--listen",
            f"tcp://127.0.0.1:0?protocol={own}" if own else "tcp://127.0.0.1:0",
            "--screen",
            "tcp://127.0.0.1:0",
            "--state",
            str(state),
            "--machine",
            machine,
        ]
        self._process.start(sys.executable, arguments)

    def send(self, command: str) -> None:
        """Send a command of its panel: ``estop on``, ``jog X+``, ``restart``."""
        self._process.write(f"{command}\n".encode())

    def stop(self, wait: bool = False) -> None:
        """Stop the process, and wait for its end if asked; its memory is kept until the program ends."""
        self._stopping = True
        if self.is_running:
            self.send("quit")
            QTimer.singleShot(_PATIENCE_MS, self, self._kill)
            if wait and not self._process.waitForFinished(_PATIENCE_MS):
                self._kill()

    def _kill(self) -> None:
        if self._stopping and self.is_running:
            self._process.kill()
            self._process.waitForFinished(_PATIENCE_MS)

    def _read(self) -> None:
        while self._process.canReadLine():
            line = bytes(self._process.readLine().data()).decode("utf-8", "replace").strip()
            if line.startswith("listening on "):
                self.address = line.removeprefix("listening on ").strip()
            elif line.startswith(("screen at ", "no screen: ")):  # the line after it
                self.screen = line.removeprefix("screen at ") if line.startswith("screen at ") else ""
                self.ready.emit(self.address)
            elif line:
                self.line_shown.emit(line)

    def _failed(self, error: QProcess.ProcessError) -> None:
        if error == QProcess.ProcessError.FailedToStart:
            self.ended.emit(self._process.errorString())

    def _finished(self, *_: object) -> None:
        self.address = self.screen = ""
        lines = (
            bytes(self._process.readAllStandardError().data()).decode("utf-8", "replace").strip().splitlines()
        )
        self.ended.emit(
            "" if self._stopping else (lines[-1] if lines else self.tr("it stopped unexpectedly"))
        )
