"""The control menu: download, verify, upload, and an emulated control to practise on."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtGui import QAction
from PySide6.QtWidgets import QMessageBox

from amp_studio.files import Document, ParameterFile
from amp_studio.files.by_schema import by_schema
from amp_studio.files.out_of_range import settle
from amp_studio.ui.base.emulated_control import EmulatedControl
from amp_studio.ui.base.modal import run_dialog
from amp_studio.ui.base.questions import ask, show_message
from amp_studio.ui.base.translated import Translated
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.control.exchange import ControlExchange
from amp_studio.ui.control.restore import restore
from amp_studio.ui.forms.out_of_range import AskInDialogs
from amp_studio.ui.window.studio_window import StudioWindow

from .file import FileActions
from .sheet import enter_by_hand
from .tuning import tune

if TYPE_CHECKING:
    from amp_studio.transfer.client.parameters import Outcome
    from amp_studio.transfer.exchange import Exchange


class ControlActions(Translated):
    """Exchange with the control of the project, or with the emulated one."""

    def __init__(self, window: StudioWindow, files: FileActions) -> None:
        self.window, self._files = window, files
        self.emulated = EmulatedControl(window)
        self.exchanges = ControlExchange(window, self.emulated)
        files.comparing.ask_address = self.exchanges.ask_address
        self.emulated.ready.connect(self._ready)
        self.emulated.shown.connect(self._shown)
        self.emulated.ended.connect(self._ended)
        act = window.action
        menu = window.menuBar().addMenu(self.tr("&Control"))
        download = act(
            self.tr("&Download to Control…"),
            self.download,
            "F5",
            "file",
            "arrow-line-down",
            self.tr("Download"),
        )
        verify = act(
            self.tr("&Verify With Control…"), self.verify, "F6", "file", "check-circle", self.tr("Verify")
        )
        upload = act(
            self.tr("&Upload From Control…"), self.upload, "F7", "", "arrow-line-up", self.tr("Upload")
        )
        put_back = act(self.tr("&Restore Control From Backup…"), partial(restore, self.exchanges), None, "")
        by_hand = act(self.tr("Enter Values by &Hand…"), partial(enter_by_hand, self.exchanges), None, "file")
        several = act(self.tr("Several &Controls…"), self.several, None, "file")
        exchanges = act(self.tr("E&xchanges of This File…"), self.recorded, None, "file")
        menu.addActions([download, verify, upload, put_back, by_hand])
        menu.addSeparator()
        tuning = act(self.tr("&Tuning…"), lambda: tune(self.window, self.exchanges), "Shift+F9", "file")
        menu.addActions([several, exchanges])
        menu.addAction(tuning)
        menu.addSeparator()
        self.start_action = act(self.tr("&Start Emulated Control"), self.start_emulated, None, "file")
        self.estop_action = act(self.tr("Emulated Control in &E-Stop"), self._estop, None, "")
        self.estop_action.setCheckable(True)
        self.stop_action = act(self.tr("Sto&p Emulated Control"), self.emulated.stop, None, "")
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
            self.window.show_status(self.tr("Starting an emulated control …"))
            self.enable()

    def _ready(self, address: str) -> None:
        self.window.show_status(self.tr("Emulated control at {address}, in E-stop").format(address=address))
        self.enable()

    def _ended(self, output: str) -> None:
        self.window.show_status(
            self.tr("The emulated control stopped: {output}").format(output=output)
            if output
            else self.tr("Emulated control stopped")
        )
        self.enable()

    def _shown(self, line: str) -> None:
        """Show a line of the emulated control's screen; one that stays in E-stop stays so in the menu too."""
        if line.startswith(("kept in E-stop: ", "refused: the control stays in E-stop: ")):
            self.estop_action.setChecked(True)
        if not line.startswith("estop "):
            self.window.show_status(self.tr("Emulated control: {line}").format(line=line))

    def _estop(self) -> None:
        self.emulated.send("estop on" if self.estop_action.isChecked() else "estop off")

    def close(self) -> None:
        """Stop the emulated control."""
        self.emulated.ended.disconnect(self._ended)
        self.emulated.stop(wait=True)

    # -- exchange --------------------------------------------------------------

    def _workspace(self) -> Workspace:
        workspace = self.window.workspace
        assert workspace is not None
        return workspace

    def download(self) -> None:
        """Show what would change, then download: back up the control, send, restart, read back, compare.

        Where no way to a control of the family is known, the sheet to key in is made instead.
        """
        from amp_studio.transfer.client.drivers import protocols_of

        workspace = self._workspace()
        if not protocols_of(workspace.file.schema.family.family):  # nothing can be sent: keyed in by hand
            enter_by_hand(self.exchanges)
            return
        if not self._is_ready(workspace):
            return
        self._name_the_only_way(workspace)
        address = self.exchanges.ask_address(self.tr("Download"))
        if address is None:
            return
        file, path = workspace.file.copy(), workspace.path
        present = self._preview(workspace, address)
        if present is None:
            return

        notes: list[str] = []

        def work(exchange: Exchange) -> Outcome:
            from amp_studio.transfer.client.parameters import download_file, sha256

            beside = replace(exchange, keep=path, record=path, notify=notes.append)
            return download_file(file, address, beside, expected=sha256(present), known=present)

        if self.exchanges.run(self.tr("Download"), work).verified:
            self.exchanges.remember(workspace, file)
            self.exchanges.note(address, "download", reached=True)
        if notes:
            self.window.show_status("; ".join(notes))

    def _name_the_only_way(self, workspace: Workspace) -> None:
        """Show in the status bar that real controls of this family cannot be spoken to, if so."""
        if only := workspace.file.schema.family.by_hand:
            self.window.show_status(self.tr("{only}: use Control > Enter Values by Hand").format(only=only))

    def _is_ready(self, workspace: Workspace) -> bool:
        """Ask about unsaved changes and errors; returns whether the file may be downloaded."""
        if workspace.is_dirty and workspace.may_edit:
            question = self.tr("{name} has unsaved changes. A download sends the saved file.").format(
                name=workspace.path.name
            )
            if ask(
                self.window,
                self.tr("Download"),
                question,
                self.tr("&Save and Continue"),
                self.tr("Cancel"),
            ) != self.tr("&Save and Continue"):
                return False
            if not self.window.save():
                return False
        errors = [f for f in workspace.findings if f.severity == "error"]
        if not errors:
            return True
        count = (
            self.tr("1 error")
            if len(errors) == 1
            else self.tr("{count} errors, the first").format(count=len(errors))
        )
        question = self.tr("The file has {count}: {message}\n\nDownload it anyway?").format(
            count=count, message=errors[0].message
        )
        answer = ask(
            self.window,
            self.tr("Download"),
            question,
            self.tr("&Download"),
            self.tr("Cancel"),
            default=1,
            icon=QMessageBox.Icon.Warning,
        )
        return answer == self.tr("&Download")

    def _preview(self, workspace: Workspace, address: str) -> bytes | None:
        """Show what the download would change in the control; returns the image to replace, or None."""
        from amp_studio.transfer.client.verification import verify_content
        from amp_studio.transfer.content import decode_content
        from amp_studio.transfer.image import ImageError
        from amp_studio.ui.control.download_preview import DownloadPreview

        image = self.exchanges.fetch(address, self.tr("Download"), workspace.file.schema.family.family)
        if not image:
            return image
        try:
            present = decode_content(image)
            if present.schema.family.family != workspace.file.schema.family.family:
                raise ImageError(
                    self.tr("The control contains parameters for {name}").format(
                        name=present.schema.family.name
                    )
                )
        except ImageError as error:
            question = self.tr(
                "{error}.\n\nThe control's present parameters are saved as they are. Download anyway?"
            ).format(error=error)
            answer = ask(
                self.window, self.tr("Download"), question, self.tr("&Download"), self.tr("Cancel"), default=1
            )
            return image if answer == self.tr("&Download") else None
        self.exchanges.remember(workspace, by_schema(present, workspace.file.schema))
        found = verify_content(workspace.file, image).values
        if not found.differences or run_dialog(
            DownloadPreview(workspace.file, found, self.window, secrets=workspace.secrets)
        ):
            return image
        return None

    def several(self) -> None:
        """Open the dialog that exchanges the file with several controls."""
        from amp_studio.ui.control.fleet_dialog import FleetDialog

        known = self.exchanges.known_addresses()
        FleetDialog(self._workspace(), known, self.window.guarded, self._is_ready, self.window).show()

    def recorded(self) -> None:
        """Open the list of the exchanges of the file."""
        from amp_studio.ui.control.exchanges_dialog import ExchangesDialog

        ExchangesDialog(self._workspace(), self.window).show()

    def verify(self) -> None:
        """Compare the file with the parameters of the control."""
        workspace = self._workspace()
        self._name_the_only_way(workspace)
        address = self.exchanges.ask_address(self.tr("Verify"))
        if address is None:
            return
        from amp_studio.transfer.client.verification import verify_content
        from amp_studio.transfer.content import decode_content

        image = self.exchanges.fetch(
            address, self.tr("Verify"), workspace.file.schema.family.family, "verify"
        )
        found = verify_content(workspace.file, image)
        if not found.unreadable:
            present = by_schema(decode_content(image), workspace.file.schema)
            self.exchanges.remember(workspace, present)
        if not found.values.differences:
            icon = QMessageBox.Icon.Information if found.is_same else QMessageBox.Icon.Warning
            show_message(self.window, self.tr("Verify"), found.summary(), icon)
            return
        page = self.window.page
        assert page is not None
        self._files.comparing.with_control(page, image, address)

    def upload(self, address: str | None = None) -> None:
        """Read the parameters of a control, ask about each value out of range, and save them as a new file."""
        address = address or self.exchanges.ask_address(self.tr("Upload"))
        if address is None:
            return
        file = self._uploaded(address)
        if settle(file, "an upload", AskInDialogs(self.window)):
            self._save_upload(file)
        else:
            self.window.show_status(self.tr("Upload cancelled. No file was written."))

    def _uploaded(self, address: str) -> ParameterFile:
        """Return the parameters of the control as a file; raises ValueError when they cannot be read."""
        from amp_studio.transfer.content import decode_content
        from amp_studio.transfer.image import ImageError

        image = self.exchanges.fetch(address, self.tr("Upload"), verb="upload")
        if not image:
            raise ValueError(self.tr("The control contains no parameters: there is nothing to upload."))
        try:
            file = decode_content(image)
        except ImageError as error:
            raise ValueError(
                self.tr(
                    "{error}.\n\nTo save it byte for byte, use 'amp-studio upload --from {address} -o NAME.img'."
                ).format(error=error, address=address)
            ) from None
        self.exchanges.note(address, "upload", reached=True, family=file.schema.family.family)
        return file

    def _save_upload(self, file: ParameterFile) -> None:
        """Save an upload as a new file; asks for another name when it cannot be written."""
        while (path := self._files.ask_path(self.tr("Save upload as"), Path("from-control"))) is not None:
            file.header.name = path.stem
            try:
                self._files.write_new(path, partial(Document.create, file, path))
            except OSError as error:
                show_message(
                    self.window,
                    self.tr("Upload"),
                    self.tr("{error}.\n\nChoose another name.").format(error=error),
                )
            else:
                return
        self.window.show_status(self.tr("Upload cancelled. No file was written."))
