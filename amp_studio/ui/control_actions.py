"""The control menu: download, verify, upload, and an emulated control to practise on."""

from __future__ import annotations

import sys
import tempfile
import threading
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QProcess, Signal
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QFileDialog, QInputDialog, QMessageBox

from amp_studio.files import Document, ParameterFile, RangeFault, compare
from amp_studio.files.lock import now
from amp_studio.schema import Address, ValueFault
from amp_studio.transfer.parameters import Outcome, download_file, fetch_file, out_of_range

from .file_actions import FILTER
from .task import Progress, ProgressDialog

if TYPE_CHECKING:
    from .main_window import MainWindow


class EmulatedControl(QObject):
    """An emulated control in a process of its own; its memory lies in a folder."""

    ready = Signal(str)
    """The address it listens on."""
    ended = Signal()

    def __init__(self, parent: QObject) -> None:
        super().__init__(parent)
        self.address = ""
        self._process = QProcess(self)
        self._process.readyReadStandardOutput.connect(self._read)
        self._process.finished.connect(lambda *_: self._finished())

    @property
    def is_running(self) -> bool:
        """Whether the process is there."""
        return self._process.state() != QProcess.ProcessState.NotRunning

    def start(self, family: str, machine: str, state: Path) -> None:
        """Start it; ``ready`` tells the address."""
        arguments = ["-m", "amp_studio.cli", "emulate", family, "--listen", "tcp://127.0.0.1:0", "--state", str(state),
                     "--machine", machine]  # fmt: skip
        self._process.start(sys.executable, arguments)

    def say(self, command: str) -> None:
        """Do something at its panel: ``estop on``, ``estop off``, ``restart``."""
        self._process.write(f"{command}\n".encode())

    def stop(self) -> None:
        """End the process; its memory stays on disk."""
        if self.is_running:
            self.say("quit")
            if not self._process.waitForFinished(2000):
                self._process.kill()
                self._process.waitForFinished(2000)

    def _read(self) -> None:
        for line in bytes(self._process.readAllStandardOutput().data()).decode("utf-8", "replace").splitlines():
            if line.startswith("listening on "):
                self.address = line.removeprefix("listening on ").strip()
                self.ready.emit(self.address)

    def _finished(self) -> None:
        self.address = ""
        self.ended.emit()


class ControlActions:
    """Exchange with the control of the project, or with the emulated one."""

    def __init__(self, window: MainWindow) -> None:
        self.window = window
        self.emulated = EmulatedControl(window)
        self.emulated.ready.connect(lambda address: self._tell(f"Emulated control at {address}, in E-stop"))
        self.emulated.ended.connect(self._enable)
        self.emulated.ready.connect(lambda _: self._enable())
        act = window.action
        menu = window.menuBar().addMenu("&Control")
        self.download_action = act("&Download to Control…", self.download, "F5")
        self.verify_action = act("&Verify With Control…", self.verify, "F6")
        self.upload_action = act("&Upload From Control…", self.upload, "F7", needs_file=False)
        menu.addActions([self.download_action, self.verify_action, self.upload_action])
        menu.addSeparator()
        self.start_action = act("Start &Emulated Control", self.start_emulated, None)
        self.estop_action = act("Emulated Control in E-&Stop", self._estop, None, needs_file=False)
        self.estop_action.setCheckable(True)
        self.estop_action.setChecked(True)
        self.stop_action = act("S&top Emulated Control", self.emulated.stop, None, needs_file=False)
        menu.addActions([self.start_action, self.estop_action, self.stop_action])
        self.toolbar: list[QAction] = [self.download_action, self.verify_action, self.upload_action]
        self._enable()

    def _tell(self, text: str) -> None:
        self.window.statusBar().showMessage(text, 10_000)

    def _enable(self) -> None:
        running = self.emulated.is_running
        self.estop_action.setEnabled(running)
        self.stop_action.setEnabled(running)

    # -- the emulated control --------------------------------------------------

    def start_emulated(self) -> None:
        """Start an emulated control for the open file's family; its memory lies beside the project or in a temporary folder."""
        file = self.window.workspace
        if file is None or self.emulated.is_running:
            return
        state = Path(tempfile.mkdtemp(prefix="amp-studio-control-"))
        self.emulated.start(file.file.schema.family.family, file.file.machine, state)

    def _estop(self) -> None:
        self.emulated.say("estop on" if self.estop_action.isChecked() else "estop off")

    def close(self) -> None:
        """End what was started."""
        self.emulated.stop()

    # -- exchange --------------------------------------------------------------

    def _address(self) -> str | None:
        """Ask for the control's address; the project's or the emulated control's is offered."""
        project = self.window.files.project
        known = [a for a in (self.emulated.address, project.info.control if project else "",
                             str(self.window.settings.value("control", "") or "")) if a]  # fmt: skip
        offered = list(dict.fromkeys(known)) or ["tcp://127.0.0.1:9600"]
        text, accepted = QInputDialog.getItem(self.window, "Control", "Address (tcp://host:port or serial:…?baud=…)", offered, 0, True)
        if not accepted or not text.strip():
            return None
        self.window.settings.setValue("control", text.strip())
        return text.strip()

    def download(self) -> None:
        """Send the file: keep what the control held, send, restart, read back, compare."""
        workspace = self.window.workspace
        assert workspace is not None
        if workspace.is_dirty and not self.window.save_or_tell():
            return
        errors = [f for f in workspace.findings if f.severity == "error"]
        question = f"The file has {len(errors)} errors, the first: {errors[0].message}\n\nDownload it all the same?" if errors else ""
        if question and QMessageBox.question(self.window, "Download", question) != QMessageBox.StandardButton.Yes:
            return
        address = self._address()
        if address is None:
            return
        file, path = workspace.file.copy(), workspace.path

        def work(progress: Progress, cancel: threading.Event) -> Outcome:
            return download_file(file, address, path.parent, path.stem, progress, cancel)

        hint = "Put the control in E-stop. Waiting for its answer …"
        outcome: Outcome = ProgressDialog("Download", work, self.window, hint).run()
        show = QMessageBox.information if outcome.verified else QMessageBox.warning
        show(self.window, "Download", outcome.text)

    def verify(self) -> None:
        """Compare the file with what the control holds."""
        workspace = self.window.workspace
        assert workspace is not None
        address = self._address()
        if address is None:
            return
        held = self._fetch(address, "Verify")
        found = compare(workspace.file.schema, workspace.file.values, held.values)
        if not found.differences:
            QMessageBox.information(self.window, "Verify", f"Nothing differs: {found.same} values are the same.")
            return
        from .compare_dialog import CompareDialog

        CompareDialog(workspace, found, "the control", self.window.go_to, self.window).show()

    def _fetch(self, address: str, title: str) -> ParameterFile:
        def work(progress: Progress, cancel: threading.Event) -> ParameterFile:
            return fetch_file(address, progress, cancel)

        file: ParameterFile = ProgressDialog(title, work, self.window, "Waiting for the control …").run()
        return file

    def upload(self) -> None:
        """Fetch the control's file, walk through what is out of range in it, and save it under a new name."""
        if not self.window.may_leave():
            return
        address = self._address()
        if address is None:
            return
        file = self._fetch(address, "Upload")
        for place, said in out_of_range(file):
            if not self._walk(file, place, said):
                self._tell("Upload given up; nothing was written")
                return
        text, _ = QFileDialog.getSaveFileName(self.window, "Save the upload under a new name", "from-control.amp", FILTER,
                                              options=QFileDialog.Option.DontConfirmOverwrite)  # fmt: skip
        if text:
            path = Path(text)
            file.header.name = path.stem
            self.window.files.show_document(Document.create(file, path))

    def _walk(self, file: ParameterFile, place: Address, said: str) -> bool:
        """Ask about one out-of-range value: continue checking, edit it, or quit. Tells whether to go on."""
        while True:
            box = QMessageBox(QMessageBox.Icon.Warning, "Out of range", f"{said}.", parent=self.window)
            go_on = box.addButton("&Continue checking", QMessageBox.ButtonRole.AcceptRole)
            edit = box.addButton("&Edit parameter", QMessageBox.ButtonRole.ActionRole)
            stop = box.addButton("&Quit checking", QMessageBox.ButtonRole.RejectRole)
            box.exec()
            if box.clickedButton() is stop:
                return False
            if box.clickedButton() is go_on:
                file.forced[place] = f"on {now()} by an upload"
                return True
            if box.clickedButton() is edit:
                text, accepted = QInputDialog.getText(self.window, "Edit parameter", said)
                try:
                    if accepted and file.set_many({place: file.read(place, text)}) is not None:
                        return True
                except (ValueFault, RangeFault) as error:
                    QMessageBox.warning(self.window, "Edit parameter", str(error))
