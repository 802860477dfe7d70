"""Reaches a control from the window: asks for its address, reads it, runs a download or a restore, remembers its values."""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import closing
from datetime import UTC, datetime
from typing import TYPE_CHECKING, Any

from PySide6.QtWidgets import QInputDialog, QMessageBox, QWidget

from amp_studio.files import ParameterFile
from amp_studio.ui.base.emulated_control import EmulatedControl
from amp_studio.ui.base.known_controls import ControlVerb, with_exchange
from amp_studio.ui.base.questions import show_message
from amp_studio.ui.base.task import ProgressDialog, TaskProgress
from amp_studio.ui.base.translated import Translated, tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.window.studio_window import StudioWindow

if TYPE_CHECKING:
    from amp_studio.transfer.client.parameters import Outcome
    from amp_studio.transfer.driver import ControlIdentity
    from amp_studio.transfer.exchange import Exchange


def stages() -> dict[str, str]:
    """Return each stage of an exchange in words."""
    return {
        "keep": tr("Saving the control's present parameters …"),
        "download": tr("Sending the file …"),
        "commit": tr("The control is checking and storing the parameters …"),
        "restart": tr("Waiting for the control to restart …"),
        "verify": tr("Reading all parameters back and comparing …"),
        "upload": tr("Reading the parameters of the control …"),
    }


def exchange_dialog(
    title: str, work: Callable[[Exchange], Any], parent: QWidget | None, hint: str = ""
) -> ProgressDialog:
    """Return the dialog in which work with a control is shown and can be stopped."""

    def run(progress: TaskProgress, cancel: threading.Event) -> Any:
        from amp_studio.transfer.exchange import Exchange

        return work(Exchange(progress, cancel))

    return ProgressDialog(title, run, parent, hint or tr("Waiting for the control …"), stages())


class ControlExchange(Translated):
    """Exchanges with the control of the project, or with the emulated one, in a dialog with progress."""

    def __init__(self, window: StudioWindow, emulated: EmulatedControl) -> None:
        self.window, self._emulated = window, emulated

    def known_addresses(self) -> list[str]:
        """Return the addresses of the emulated control, of the project's control and of the last one."""
        project, settings = self.window.project, self.window.settings
        known = (self._emulated.address, project.info.control if project else "", settings.control())
        return list(dict.fromkeys(address for address in known if address))

    def ask_address(self, title: str) -> str | None:
        """Ask for the address of the control; suggests the emulated control, that of the project and the last one."""
        settings = self.window.settings
        offered = self.known_addresses() or ["tcp://127.0.0.1:9600"]
        label = self.tr(
            "Address of the control (for example tcp://192.168.0.10:9600 or serial:/dev/ttyUSB0?baud=115200)"
        )
        text, accepted = QInputDialog.getItem(self.window, title, label, offered, 0, True)
        if not accepted or not text.strip():
            return None
        settings.keep_control(text.strip())
        return text.strip()

    def note(
        self, address: str, verb: ControlVerb, *, reached: bool, family: str = "", name: str = ""
    ) -> None:
        """Remember an exchange with a control, for the welcome page."""
        settings = self.window.settings
        settings.keep_controls(
            with_exchange(settings.controls(), address, verb, reached=reached, family=family, name=name)
        )

    def identify(self, address: str, family: str = "") -> ControlIdentity:
        """Return who answers at an address; nothing is read or changed. Raises as ``open_driver_at``."""

        def work(exchange: Exchange) -> ControlIdentity:
            from amp_studio.transfer.client.drivers import open_driver_at

            with closing(open_driver_at(address, family, exchange)) as driver:
                return driver.identify(exchange)

        dialog = exchange_dialog(self.tr("Connect"), work, self.window)
        found: ControlIdentity = self._noted(address, "connect", dialog.run, family)
        self.note(address, "connect", reached=True, family=found.family, name=found.name)
        return found

    def _noted(self, address: str, verb: ControlVerb, act: Callable[[], Any], family: str) -> Any:
        """Return the result of an exchange; one that fails is remembered as such."""
        from amp_studio.transfer.errors import TransferError

        try:
            return act()
        except TransferError:
            self.note(address, verb, reached=False, family=family)
            raise

    def fetch(self, address: str, title: str, family: str = "", verb: ControlVerb = "connect") -> bytes:
        """Return the image of the control, byte for byte; raises an error for a control of another family."""

        def work(exchange: Exchange) -> bytes:
            from amp_studio.transfer.client.parameters import fetch_image

            return fetch_image(address, exchange, family=family)

        dialog = exchange_dialog(title, work, self.window)
        image: bytes = self._noted(address, verb, dialog.run, family)
        self.note(address, verb, reached=True, family=family)
        return image

    def run(self, title: str, work: Callable[[Exchange], Outcome]) -> Outcome:
        """Run a download or restore, show its outcome and return it."""
        outcome: Outcome = exchange_dialog(title, work, self.window).run()
        icon = QMessageBox.Icon.Information if outcome.verified else QMessageBox.Icon.Warning
        show_message(self.window, title, outcome.text, icon)
        return outcome

    def remember(self, workspace: Workspace, present: ParameterFile) -> None:
        """Show the values of the control beside those of a file of the same family."""
        if present.schema.family.family == workspace.file.schema.family.family:
            workspace.remember_control(present.values, f"{datetime.now(UTC).astimezone():%H:%M}")
