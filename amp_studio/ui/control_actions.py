"""The control menu: download, verify, upload, and an emulated control to practise on."""

from __future__ import annotations

import threading
from collections.abc import Callable
from datetime import UTC, datetime
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QInputDialog, QLineEdit, QMessageBox, QStyle

from amp_studio.files import Document, ParameterFile, RangeError
from amp_studio.files.lock import now
from amp_studio.schema import Address, InvalidValueError, write_value

from .emulated_control import EmulatedControl
from .questions import ask, show_message
from .restore import restore
from .task import Progress, ProgressDialog

if TYPE_CHECKING:
    from amp_studio.transfer.client.parameters import Outcome

    from .main_window import MainWindow
    from .workspace import Workspace

STAGES = {
    "keep": "Saving the control's present parameters …",
    "download": "Sending the file …",
    "commit": "The control is checking and storing the parameters …",
    "restart": "Waiting for the control to restart …",
    "verify": "Reading all parameters back and comparing …",
    "upload": "Reading the parameters of the control …",
}


class ControlActions:
    """Exchange with the control of the project, or with the emulated one."""

    def __init__(self, window: MainWindow) -> None:
        self.window = window
        self.emulated = EmulatedControl(window)
        self.emulated.ready.connect(self._ready)
        self.emulated.ended.connect(self._ended)
        act, icons = window.action, QStyle.StandardPixmap
        menu = window.menuBar().addMenu("&Control")
        download = act("&Download to Control…", self.download, "F5", "file", icons.SP_ArrowDown, "Download")
        verify = act("&Verify With Control…", self.verify, "F6", "file", icons.SP_DialogApplyButton, "Verify")
        upload = act("&Upload From Control…", self.upload, "F7", "", icons.SP_ArrowUp, "Upload")
        put_back = act("&Restore Control From Backup…", partial(restore, self), None, "")
        menu.addActions([download, verify, upload, put_back])
        menu.addSeparator()
        self.start_action = act("&Start Emulated Control", self.start_emulated, None, "file")
        self.estop_action = act("Emulated Control in &E-Stop", self._estop, None, "")
        self.estop_action.setCheckable(True)
        self.stop_action = act("Sto&p Emulated Control", self.emulated.stop, None, "")
        menu.addActions([self.start_action, self.estop_action, self.stop_action])
        self.toolbar: list[QAction] = [download, verify, upload]

    def enable(self) -> None:
        """Enable the actions that fit the state of the emulated control."""
        running = self.emulated.is_running
        self.start_action.setEnabled(self.window.workspace is not None and not running)
        self.estop_action.setEnabled(running)
        self.stop_action.setEnabled(running)

    # -- the emulated control --------------------------------------------------

    def start_emulated(self) -> None:
        """Start an emulated control for the open file's family and machine type."""
        workspace = self.window.workspace
        if workspace is not None and not self.emulated.is_running:
            self.emulated.start(workspace.file.schema.family.family, workspace.file.machine)
            self.estop_action.setChecked(True)
            self.window.show_status("Starting an emulated control …")
            self.enable()

    def _ready(self, address: str) -> None:
        self.window.show_status(f"Emulated control at {address}, in E-stop")
        self.enable()

    def _ended(self, output: str) -> None:
        self.window.show_status(
            f"The emulated control stopped: {output}" if output else "Emulated control stopped"
        )
        self.enable()

    def _estop(self) -> None:
        self.emulated.send("estop on" if self.estop_action.isChecked() else "estop off")

    def close(self) -> None:
        """Stop the emulated control."""
        self.emulated.ended.disconnect(self._ended)
        self.emulated.stop(wait=True)

    # -- exchange --------------------------------------------------------------

    def ask_address(self, title: str) -> str | None:
        """Ask for the address of the control; suggests the emulated control, that of the project and the last one."""
        project, settings = self.window.projects.project, self.window.settings
        known = (
            self.emulated.address,
            project.info.control if project else "",
            settings.control(),
        )
        offered = list(dict.fromkeys(a for a in known if a)) or ["tcp://127.0.0.1:9600"]
        label = (
            "Address of the control (for example tcp://192.168.0.10:9600 or serial:/dev/ttyUSB0?baud=115200)"
        )
        text, accepted = QInputDialog.getItem(self.window, title, label, offered, 0, True)
        if not accepted or not text.strip():
            return None
        settings.keep_control(text.strip())
        return text.strip()

    def _workspace(self) -> Workspace:
        workspace = self.window.workspace
        assert workspace is not None
        return workspace

    def download(self) -> None:
        """Show what would change, then download: back up the control, send, restart, read back, compare."""
        workspace = self._workspace()
        if not self._is_ready(workspace):
            return
        address = self.ask_address("Download")
        if address is None:
            return
        file, path = workspace.file.copy(), workspace.path
        approved = self._preview(workspace, address)
        if approved is None:
            return

        def work(progress: Progress, cancel: threading.Event) -> Outcome:
            from amp_studio.transfer.client.parameters import download_file

            return download_file(file, address, path.parent, path.stem, progress, cancel, expected=approved)

        if self.exchange("Download", work).verified:
            self.remember(workspace, file)

    def exchange(self, title: str, work: Callable[[Progress, threading.Event], Outcome]) -> Outcome:
        """Run a download or restore, show its outcome and return it."""
        hint = "Waiting for the control …"
        outcome: Outcome = ProgressDialog(title, work, self.window, hint, STAGES).run()
        icon = QMessageBox.Icon.Information if outcome.verified else QMessageBox.Icon.Warning
        show_message(self.window, title, outcome.text, icon)
        return outcome

    def _is_ready(self, workspace: Workspace) -> bool:
        """Ask about unsaved changes and errors; returns whether the file may be downloaded."""
        if workspace.is_dirty and workspace.may_edit:
            question = f"{workspace.path.name} has unsaved changes. A download sends the saved file."
            if ask(self.window, "Download", question, "&Save and Continue", "Cancel") != "&Save and Continue":
                return False
            if not self.window.save():
                return False
        errors = [f for f in workspace.findings if f.severity == "error"]
        if not errors:
            return True
        count = "1 error" if len(errors) == 1 else f"{len(errors)} errors, the first"
        question = f"The file has {count}: {errors[0].message}\n\nDownload it anyway?"
        answer = ask(
            self.window, "Download", question, "&Download", "Cancel", default=1, icon=QMessageBox.Icon.Warning
        )
        return answer == "&Download"

    def _preview(self, workspace: Workspace, address: str) -> str | None:
        """Show what the download would change in the control; returns the digest of the image to replace, or None."""
        from amp_studio.transfer.client.parameters import sha256
        from amp_studio.transfer.image import ImageError, decode_image

        from .compare_dialog import DownloadPreview

        image = self.fetch(address, "Download", workspace.file.schema.family.family)
        approved = sha256(image)
        if not image:
            return approved
        try:
            present = decode_image(image)
            if present.schema is not workspace.file.schema:
                raise ImageError(f"The control contains parameters for {present.schema.family.name}")
        except ImageError as error:
            question = f"{error}.\n\nThe control's present parameters are saved as they are. Download anyway?"
            answer = ask(self.window, "Download", question, "&Download", "Cancel", default=1)
            return approved if answer == "&Download" else None
        self.remember(workspace, present)
        found = workspace.differences_to(present.values)
        if (
            not found.differences
            or DownloadPreview(workspace.file, found, self.window, secrets=workspace.secrets).exec()
        ):
            return approved
        return None

    def remember(self, workspace: Workspace, present: ParameterFile) -> None:
        if present.schema is workspace.file.schema:
            workspace.remember_control(present.values, f"{datetime.now(UTC).astimezone():%H:%M}")

    def verify(self) -> None:
        """Compare the file with the parameters of the control."""
        workspace = self._workspace()
        address = self.ask_address("Verify")
        if address is None:
            return
        from amp_studio.transfer.client.verification import verify_images
        from amp_studio.transfer.image import decode_image, encode_image

        image = self.fetch(address, "Verify", workspace.file.schema.family.family)
        found = verify_images(encode_image(workspace.file), image)
        if not found.unreadable:
            present = decode_image(image)
            self.remember(workspace, present)
        if not found.values.differences:
            icon = QMessageBox.Icon.Information if found.is_same else QMessageBox.Icon.Warning
            show_message(self.window, "Verify", found.summary(), icon)
            return
        from .compare_dialog import CompareDialog

        CompareDialog(workspace, present.values, "the control", self.window.go_to, self.window).show()

    def fetch(self, address: str, title: str, family: str = "") -> bytes:
        """Return the image of the control, byte for byte; raises an error for a control of another family."""

        def work(progress: Progress, cancel: threading.Event) -> bytes:
            from amp_studio.transfer.client.parameters import fetch_image

            return fetch_image(address, progress, cancel, family=family)

        image: bytes = ProgressDialog(title, work, self.window, "Waiting for the control …", STAGES).run()
        return image

    def upload(self) -> None:
        """Read the parameters of the control, ask about each value out of range, and save them as a new file."""
        from amp_studio.files.out_of_range import out_of_range

        if not self.window.may_leave():
            return
        address = self.ask_address("Upload")
        if address is None:
            return
        file = self._uploaded(address)
        for place, problem in out_of_range(file):
            if not self._walk(file, place, problem):
                self.window.show_status("Upload cancelled. No file was written.")
                return
        self._save_upload(file)

    def _uploaded(self, address: str) -> ParameterFile:
        """Return the parameters of the control as a file; raises ValueError when they cannot be read."""
        from amp_studio.transfer.image import ImageError, decode_image

        image = self.fetch(address, "Upload")
        if not image:
            raise ValueError("The control contains no parameters: there is nothing to upload.")
        try:
            return decode_image(image)
        except ImageError as error:
            raise ValueError(
                f"{error}.\n\nTo save it byte for byte, use 'amp-studio upload --from {address} -o NAME.img'."
            ) from None

    def _save_upload(self, file: ParameterFile) -> None:
        """Save an upload as a new file; asks for another name when it cannot be written."""
        while (path := self.window.files.ask_path("Save upload as", Path("from-control"))) is not None:
            file.header.name = path.stem
            try:
                self.window.files.write_new(path, partial(Document.create, file, path))
            except OSError as error:
                show_message(self.window, "Upload", f"{error}.\n\nChoose another name.")
            else:
                return
        self.window.show_status("Upload cancelled. No file was written.")

    def _walk(self, file: ParameterFile, place: Address, problem: str) -> bool:
        """Ask about one out-of-range value: continue checking, edit it, or quit. Returns whether to continue."""
        go_on, edit, stop = "&Continue checking", "&Edit parameter", "&Quit checking"
        while True:
            answer = ask(
                self.window, "Out of range", f"{problem}.", go_on, edit, stop, icon=QMessageBox.Icon.Warning
            )
            if answer == stop:
                return False
            if answer == go_on:
                file.forced[place] = f"on {now()} by an upload"
                return True
            parameter = file.schema.parameters[place[0]]
            old = "" if parameter.secret else write_value(parameter, file.get(place))
            echo = QLineEdit.EchoMode.Password if parameter.secret else QLineEdit.EchoMode.Normal
            text, accepted = QInputDialog.getText(self.window, "Edit parameter", problem, echo, old)
            try:
                if accepted:
                    file.set_many({place: file.read(place, text)})
                    return True
            except (InvalidValueError, RangeError) as error:
                show_message(self.window, "Edit parameter", f"{error}.")
