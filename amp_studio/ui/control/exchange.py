"""Which control a file goes to, and what the window remembers of it."""

from __future__ import annotations

import threading
from collections.abc import Callable
from contextlib import closing
from datetime import UTC, datetime
from functools import partial
from typing import TYPE_CHECKING, Any

from PySide6.QtWidgets import QWidget

from amp_studio.files import ParameterFile
from amp_studio.ui.base.emulated_control import EmulatedControl
from amp_studio.ui.base.known_controls import ControlVerb, with_exchange
from amp_studio.ui.base.task import TaskProgress, run_with_progress
from amp_studio.ui.base.translated import Translated, tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.window.studio_window import StudioWindow

if TYPE_CHECKING:
    from amp_studio.transfer import ControlIdentity, Exchange


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


def run_exchange(title: str, work: Callable[[Exchange], Any], parent: QWidget | None, hint: str = "") -> Any:
    """Run work with a control, in a dialog that shows it and can stop it where it lasts longer than a
    moment; returns its result or raises its error.
    """

    def run(progress: TaskProgress, cancel: threading.Event) -> Any:
        from amp_studio.transfer import Exchange

        return work(Exchange(progress, cancel))

    return run_with_progress(title, run, parent, hint or tr("Waiting for the control …"), stages=stages())


class ControlExchange(Translated):
    """Exchanges with the control of the project, or with the emulated one, in a dialog with progress."""

    def __init__(self, window: StudioWindow, emulated: EmulatedControl) -> None:
        self.window, self._emulated = window, emulated
        self.show_page: Callable[[], None] = lambda: None
        """Shows the page at the control, where one is chosen."""

    def address_of(self, workspace: Workspace | None) -> str:
        """Return the control chosen for a file, of its project, the emulated one, or the last one;
        empty for none.
        """
        project, settings = self.window.project, self.window.settings
        own = settings.control_of(workspace.path) if workspace is not None else ""
        # The nearest first: what was chosen for this very file counts before the machine, and that before
        # habit.
        known = (own, project.info.control if project else "", self._last(workspace))
        return next(filter(None, known), "")

    def _last(self, workspace: Workspace | None) -> str:
        """Return the emulated control or that of the last exchange, unless it is of another family than the
        file.
        """
        last, emulated = self.window.settings.control(), self._emulated
        if emulated.address and (workspace is None or workspace.file.schema.family.family == emulated.family):
            return emulated.address
        known = (control.family for control in self.window.settings.controls() if control.address == last)
        family = next(known, "")
        own = workspace.file.schema.family.family if workspace is not None else family
        # An address of another family would be read with the wrong protocol.
        return last if family in ("", own) else ""

    def chosen_address(self) -> str | None:
        """Return the control chosen for the file in front; without one the page is shown,
        where one is chosen.
        """
        address = self.address_of(self.window.workspace)
        if not address:
            self.show_page()
        return address or None

    def choose(self, workspace: Workspace | None, address: str) -> None:
        """Remember the control of a file, and as the last one."""
        if address != self._emulated.address:  # its port is another one the next time
            self.window.settings.keep_control(address)
        if workspace is not None:
            self.window.settings.keep_control_of(workspace.path, address)

    def known_addresses(self) -> list[str]:
        """Return the addresses of the project's control, of those reached before and of the emulated one."""
        project, settings = self.window.project, self.window.settings
        chosen = settings.control_of(self.window.workspace.path) if self.window.workspace is not None else ""
        reached = [control.address for control in settings.controls()]
        known = (
            project.info.control if project else "",
            chosen,
            *reached,
            settings.control(),
            self._emulated.address,
        )
        return list(dict.fromkeys(address for address in known if address))

    def remember_contact(
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
            from amp_studio.transfer.client import open_driver_at

            with closing(open_driver_at(address, family, exchange)) as driver:
                return driver.identify(exchange)

        run = partial(run_exchange, self.tr("Connect"), work, self.window)
        found: ControlIdentity = self._recorded(address, "connect", run, family)
        self.remember_contact(address, "connect", reached=True, family=found.family, name=found.name)
        return found

    def _recorded(self, address: str, verb: ControlVerb, act: Callable[[], Any], family: str) -> Any:
        """Return the result of an exchange; one that fails is remembered as such."""
        from amp_studio.transfer import TransferError

        try:
            return act()
        except TransferError:
            self.remember_contact(address, verb, reached=False, family=family)
            raise

    def remember(self, workspace: Workspace, present: ParameterFile) -> None:
        """Show the values of the control beside those of a file of the same family."""
        if present.schema.family.family == workspace.file.schema.family.family:
            workspace.remember_control(present.values, f"{datetime.now(UTC).astimezone():%H:%M}")
