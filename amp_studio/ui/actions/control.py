"""What the control menu does: the page at the control, and an emulated control to practise on."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QStackedWidget

from amp_studio.files import Document, ParameterFile, settle
from amp_studio.schema import Address
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.emulated_control import EmulatedControl
from amp_studio.ui.base.known_controls import ControlVerb
from amp_studio.ui.base.modal import is_alive
from amp_studio.ui.base.places import family_name
from amp_studio.ui.base.questions import show_message
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.theme import icon
from amp_studio.ui.base.translated import Translated, message_in_words, tr
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.control.exchange import ControlExchange
from amp_studio.ui.forms.out_of_range import AskInDialogs
from amp_studio.ui.window.studio_window import StudioWindow
from amp_studio.validate import Validator, rules_beside

from .file import Files
from .sheet import sheet_of_control, sheet_of_file

if TYPE_CHECKING:
    from amp_studio.transfer.client import Copy
    from amp_studio.ui.control.known_list import ListedControl
    from amp_studio.ui.control.next_step import ExchangeDirection
    from amp_studio.ui.control.page import ControlPage
    from amp_studio.ui.control.session import ControlSession
    from amp_studio.ui.live.page import LiveView

_REFUSED = "refused: "
"""Begins the line of an emulated control that took no word."""
STATE_ROOM = 152
"""Of the button in the tool bar for the name of a control and its state, in logical pixels."""
_STOPPING_MS = 50
"""Milliseconds after which it is looked again whether an exchange has stopped."""
_COPIES = "Backups of a control (*.img *.before-*.amp);;All files (*)"


class ControlDesk(Translated):
    """Exchange with the control of the project, or with the emulated one."""

    def __init__(
        self, window: StudioWindow, files: Files, centre: QStackedWidget, show_values: Callable[[], None]
    ) -> None:
        self.window, self._files, self._centre, self._show_values = window, files, centre, show_values
        self.emulated = EmulatedControl(window)
        self.exchanges = ControlExchange(window, self.emulated)
        self._page: ControlPage | None = None
        self._sessions: dict[tuple[str, str, str], ControlSession] = {}
        """Address, family and file -> its exchanges."""
        self._workspace_of: dict[ControlSession, Workspace | None] = {}
        """The file that a session was last chosen for: it may be closed and opened again meanwhile."""
        self._live: LiveView | None = None
        """The page that was live last: one control is asked at a time."""
        self.exchanges.show_page = self.open
        files.comparing.address_of = self.exchanges.chosen_address
        self.emulated.ready.connect(self._ready)
        self.emulated.line_shown.connect(self._add_line)
        self.emulated.ended.connect(self._ended)

    def show_state(self, action: QAction) -> None:
        """Show in the action of the page the control of the file in front and its state."""
        name, state, warns = self.state_of(self.window.workspace)
        address = self.exchanges.address_of(self.window.workspace)
        # The state is whole: "not connected" with its beginning cut would be the opposite.
        letters = self.window.fontMetrics()
        room = max(STATE_ROOM - letters.horizontalAdvance(f"  {state}"), 0)
        short = letters.elidedText(self._own_name_of(address), Qt.TextElideMode.ElideMiddle, room)
        action.setIconText(f"{short}  {state}" if address else name)
        action.setToolTip(self.tr("{name}: {state} (Alt+0)").format(name=name, state=state))
        action.setIcon(icon("warning-fill", "warn") if warns else icon("cpu"))

    def read_address(self) -> str | None:
        """Return where the control of the file in front shows its status, None where none is chosen; the page
        Live reads it no more. Raises ValueError while something is sent.
        """
        if self.is_sending:
            raise ValueError(self.tr("Something is being sent to a control: look at it afterwards."))
        if self._live is not None and is_alive(self._live):
            self._live.stop(self.tr("Stopped: the recorder reads the control."))
        address = self.exchanges.chosen_address()
        own = address is not None and address == self.emulated.address
        return (self.emulated.screen or address) if own else address

    def make_live(self, page: LiveView, workspace: Workspace, seen: str) -> None:
        """Let a page ask the control of its file, whose status is read at an address."""
        address = self.exchanges.address_of(workspace)
        own = self.emulated if address == self.emulated.address else None
        session = self._session_of(address, workspace)
        self._live = page
        page.use(session, seen, self._name_of(address), own)

    def _end_live(self) -> None:
        """End Live before several controls are written to: its control may be one of them."""
        if self._live is not None and is_alive(self._live) and self.page.several.is_sending:
            self._live.stop(self.tr("Live has ended: an exchange is under way."))

    # -- the emulated control --------------------------------------------------

    def start_emulated(self) -> None:
        """Start an emulated control for the open file's family and machine type."""
        from amp_studio.transfer.emulated import emulators_of

        workspace = self.window.workspace
        if workspace is not None and not self.emulated.is_running:
            family = workspace.file.schema.family.family
            if not emulators_of(family):
                text = self.tr("There is no emulated control of {family}.")
                self.window.show_status(text.format(family=family_name(family)))
                return
            self.emulated.start(family, workspace.file.machine)
            self.window.menus["control.estop"].setChecked(True)
            self.window.show_status(self.tr("Starting an emulated control …"))
            self.window.enable()

    def _ready(self, address: str) -> None:
        text = (
            self.tr("Emulated control at {address}, in E-stop")
            if self.emulated.has_estop
            else self.tr("Emulated control at {address}")
        )
        self.window.show_status(text.format(address=address))
        if self.is_shown:
            self.use(address)
        elif self.window.workspace is not None:
            self.exchanges.choose(self.window.workspace, address)
        self.window.enable()

    def _ended(self, output: str) -> None:
        self.window.show_status(
            self.tr("The emulated control stopped: {output}").format(output=output)
            if output
            else self.tr("Emulated control stopped")
        )
        self.window.enable()

    def _add_line(self, line: str) -> None:
        """Show a line of the emulated control's screen; one that stays in E-stop stays so in the menu too."""
        # The action was switched before the control answered, which has refused.
        if line.startswith(("kept in E-stop: ", "refused: the control stays in E-stop: ")):
            self.window.menus["control.estop"].setChecked(True)
        if line.startswith("estop "):
            return
        if line.startswith(_REFUSED):
            line = f"{self.tr('refused')}: {message_in_words(line.removeprefix(_REFUSED))}"
        self.window.show_status(self.tr("Emulated control: {line}").format(line=line))

    def switch_estop(self) -> None:
        """Put the emulated control into E-stop or out of it, as its action is."""
        self.emulated.send("estop on" if self.window.menus["control.estop"].isChecked() else "estop off")

    def close(self) -> None:
        """Stop the emulated control."""
        for session in self._sessions.values():
            session.cancel()
        if self._page is not None:
            self._page.several.stop_all()
        # Disconnected first: the window that shows its end is being closed.
        self.emulated.ended.disconnect(self._ended)
        self.emulated.stop(wait=True)

    # -- the page ----------------------------------------------------------------

    @property
    def page(self) -> ControlPage:
        """The page at the control; made when it is first wanted."""
        if self._page is None:
            from amp_studio.ui.control.page import ControlPage

            page = self._page = ControlPage(self.window.save)
            page.left.connect(self.leave)
            page.chosen.connect(self.use)
            page.state_changed.connect(self._follow)
            page.several.changed.connect(self._end_live)
            page.read_requested.connect(
                lambda file: self.window.guarded(partial(self._save_upload, file), self.tr("Read"))
            )
            page.restore_requested.connect(
                lambda path: self.window.guarded(partial(self._offer_backup, path), self.tr("Restore"))
            )
            page.hand.control_requested.connect(partial(sheet_of_control, page))
            page.hand.file_requested.connect(
                lambda: self.window.guarded(partial(sheet_of_file, page), self.tr("Enter Values by Hand"))
            )
            self._centre.addWidget(page)
        return self._page

    @property
    def is_shown(self) -> bool:
        """Whether the page is in front."""
        return self._page is not None and self._centre.currentWidget() is self._page

    def open(self) -> None:
        """Show the page in the direction that it had last, first in that of sending: a look and one click are
        left. What is in front stays as it is: a second click of the tool bar sends nothing.
        """
        if not self.is_shown:
            self.show(self._page.direction if self._page is not None and self._page.workspace else "send")

    def show(
        self, direction: ExchangeDirection, address: str = "", *, only: Iterable[Address] | None = None
    ) -> None:
        """Show the page in a direction; the key that opened it is its primary button the second time. Of what
        differs ``only`` these values are to be sent, unless another choice is made.
        """
        workspace = self.window.workspace
        if direction == "send" and workspace is not None and not self._has_a_way(workspace):
            direction = "hand"  # nothing can be sent: keyed in by hand
        page = self.page
        is_in_front = self.is_shown and page.workspace is workspace
        if is_in_front and page.direction == direction and not address:
            page.press()
            return
        if self.window.table_view is not None and not self.window.table_view.finish():
            return
        # A page that opens is about one control; several are chosen again on purpose.
        page.known.several.setChecked(False)
        page.show_file(workspace, direction, only)
        self._centre.setCurrentWidget(page)
        self.window.docks.show_page(None)
        self.window.enable()
        if place := address or self.exchanges.address_of(workspace):
            self.use(place)
        else:
            self._list()
            page.known.setFocus()  # one is chosen there, or "+" asks for an address
            return
        page.setFocus()
        page.take_keyboard(page.session)

    def _has_a_way(self, workspace: Workspace) -> bool:
        """Return whether a way to a control of the family is known; else the sheet to key in is made
        instead.
        """
        from amp_studio.transfer.client import protocols_of

        return bool(protocols_of(workspace.file.schema.family.family))

    def leave(self) -> None:
        """Show the values again."""
        if self.is_shown:
            self._show_values()

    def use(self, address: str) -> None:
        """Choose a control for the file in front, and read it; one more among several gets its tick."""
        self.window.guarded(partial(self._use, address), self.tr("Connect"))

    def _use(self, address: str) -> None:
        from amp_studio.transfer.links import parse_endpoint

        # A typing error is reported before anything is changed.
        parse_endpoint(address)
        if self.page.known.several.isChecked():
            self.page.several.tick(address)
            return
        workspace = self.window.workspace
        self.exchanges.choose(workspace, address)
        self.page.use(self._session_of(address, workspace), self._name_of(address))
        self._follow()

    def _session_of(self, address: str, workspace: Workspace | None) -> ControlSession:
        """Return the exchanges of a file with the control at an address."""
        from amp_studio.ui.control.session import ControlSession

        family = workspace.file.schema.family.family if workspace is not None else ""
        # Of a file too: what differs, what was approved and what was read belong to both.
        key = (address, family, str(workspace.path) if workspace is not None else "")
        session = self._sessions.get(key)
        if session is None:
            session = self._sessions[key] = ControlSession(address, family, self.window)
            session.ended.connect(partial(self._ended_exchange, session))
            session.progressed.connect(self._show_percent)
        self._workspace_of[session] = workspace
        return session

    def _show_percent(self) -> None:
        self.show_state(self.window.menus["control.page"])

    def _ended_exchange(self, session: ControlSession, verb: ControlVerb, reached: bool) -> None:
        """Remember how an exchange ended, and the values of the control beside those of the file."""
        seen = session.seen
        family, name = (seen.control.family, seen.control.name) if seen is not None else (session.family, "")
        has_answered = reached or session.is_refused
        self.exchanges.remember_contact(session.address, verb, reached=has_answered, family=family, name=name)
        workspace = self._workspace_of[session]
        if workspace is None or not is_alive(workspace):
            return
        if session.is_seen_old:  # it broke off: what it contains now was not read
            workspace.forget_control()
        elif reached and (present := session.present(workspace.file)) is not None:
            self.exchanges.remember(workspace, present)
        if session.notes:
            self.window.show_status("; ".join(session.notes))

    def _name_of(self, address: str) -> str:
        """Return the name of a control, with its address where another one is called the same."""
        name, place = self._own_name_of(address), _place_of(address)
        others = (each for each in self.exchanges.known_addresses() if each != address)
        is_shared = name != place and any(self._own_name_of(each) == name for each in others)
        return f"{name} ({place})" if is_shared else name

    def _own_name_of(self, address: str) -> str:
        project = self.window.project
        if project is not None and project.info.control == address and project.info.control_name:
            return project.info.control_name
        known = next((c for c in self.window.settings.controls() if c.address == address), None)
        if address == self.emulated.address:
            return self.tr("Emulated control")
        return known.name if known is not None and known.name else _place_of(address)

    def _listed(self, address: str) -> ListedControl:
        from amp_studio.ui.control.known_list import ListedControl

        known = next((c for c in self.window.settings.controls() if c.address == address), None)
        # That of the page first: another file may have asked the same control before.
        sessions = filter(None, (self.page.session, *self._sessions.values()))
        session = next((each for each in sessions if each.address == address), None)
        state, warns = state_in_words(session)
        family = (
            self.tr("emulated")
            if address == self.emulated.address
            else family_name(known.family)
            if known and known.family
            else ""
        )
        return ListedControl(address, self._own_name_of(address), family, state, warns)

    def _list(self) -> None:
        chosen = (
            self._page.session.address if self._page is not None and self._page.session is not None else ""
        )
        known = self.exchanges.known_addresses()
        addresses = known if not chosen or chosen in known else [*known, chosen]
        listed = [self._listed(a) for a in addresses]
        self.page.known.show_controls(listed, chosen)
        self.page.several.show_controls(listed)

    def _follow(self) -> None:
        """Show the state of the control where it is chosen, in the tool bar and in the status line."""
        if self._page is not None and self._page.session is not None:
            self._page.rename(self._name_of(self._page.session.address))
        self._list()
        self.window.enable()

    def state_of(self, workspace: Workspace | None) -> tuple[str, str, bool]:
        """Return the name of the control of a file, its state in words, and whether it needs something."""
        address = self.exchanges.address_of(workspace)
        if not address:
            return self.tr("Control"), self.tr("none chosen"), False
        family = workspace.file.schema.family.family if workspace is not None else ""
        session = self._sessions.get((address, family, str(workspace.path) if workspace is not None else ""))
        live = self._live
        if live is not None and is_alive(live) and live.session is session and live.is_live:
            return self._name_of(address), *live.state
        return self._name_of(address), *state_in_words(session)

    @property
    def is_sending(self) -> bool:
        """Whether something is being written to a control."""
        several = self._page is not None and self._page.several.is_sending
        return several or any(session.phase == "running" for session in self._sessions.values())

    def stop_sending(self, then: Callable[[], object]) -> None:
        """Stop what is being sent; what each control contains then is shown, and ``then`` is done."""
        from amp_studio.ui.control.session_words import text_of_end

        running = [session for session in self._sessions.values() if session.phase == "running"]
        several = self._page.several if self._page is not None and self._page.several.is_sending else None
        for each in running:
            each.cancel()
        if several is not None:
            several.stop_all()

        def look() -> None:
            if self.is_sending:
                QTimer.singleShot(_STOPPING_MS, self.window, look)
                return
            ends = [
                f"{self._name_of(each.address)}: {text_of_end(each, self._name_of(each.address))}"
                for each in running
            ]
            ends += several.ends() if several is not None else []
            show_message(self.window, self.tr("Sending"), "\n\n".join(ends))
            then()

        look()

    def restore(self) -> None:
        """Ask for a backup and offer to put it back;
        raises ValueError for a file with errors that is no proven backup.
        """
        workspace = self.window.workspace
        folder = workspace.path.parent if workspace is not None else Path()
        if path := ask_to_open(self.window, self.tr("Restore"), folder, _COPIES):
            self._offer_backup(path)

    def _offer_backup(self, path: Path) -> None:
        """Show on the page what putting back a backup changes; raises as ``restore``."""
        from amp_studio.transfer.client import open_copy
        from amp_studio.ui.control.session_words import ControlBackup

        copy = in_background(self.window, self.tr("Opening"), partial(open_copy, path))
        _check_copy(copy, path)
        if not self.is_shown:
            self.show("compare")
        self.page.show_backup(ControlBackup(copy, path))

    def several(self) -> None:
        """Show the state of the page that exchanges the file with several controls."""
        if not self.is_shown:
            self.show("compare")
        self.page.show_several(True)

    def recorded(self) -> None:
        """Show the exchanges of the file."""
        if not self.is_shown:
            self.show("compare")
        self.page.show_history(True)

    def upload(self, address: str | None = None) -> None:
        """Show the page that reads a control into a new file."""
        self.show("read", address or "")

    def _save_upload(self, file: ParameterFile | None) -> None:
        """Ask about each value out of range, and save an upload as a new file;
        another name when it cannot be written.
        """
        if file is None or not settle(file, "an upload", AskInDialogs(self.window)):
            self.window.show_status(self.tr("Upload cancelled. No file was written."))
            return
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


def state_in_words(session: ControlSession | None) -> tuple[str, bool]:
    """Return the state of a control in words, and whether it needs something."""
    if session is None:
        return tr("not connected"), False
    if session.lacks_password:
        return tr("needs a password"), True
    if session.phase == "ready" and session.in_estop is False:
        return tr("not in E-stop"), True
    words = {
        "away": _away(session),
        "connecting": tr("connecting"),
        "ready": tr("ready"),
        "running": f"{session.percent} %" if session.percent else tr("sending"),
        "done": tr("ready"),
        "failed": tr("broke off"),
    }
    return words[session.phase], session.phase == "failed" or (
        session.phase == "away" and bool(session.error)
    )


def _place_of(address: str) -> str:
    """Return an address as a name: ``tcp://10.0.0.1:9600?protocol=peripheral`` is ``10.0.0.1:9600``."""
    return (address.partition("://")[2] or address).partition("?")[0]


def _away(session: ControlSession) -> str:
    if not session.error:
        return tr("not connected")
    if session.is_refused:
        return tr("moves, not read")
    return tr("connection lost") if session.has_answered else tr("not reached")


def _check_copy(copy: Copy, path: Path) -> None:
    """Raise ValueError for a file with errors that is not a proven backup of a control."""
    if copy.file is None or copy.is_kept:
        return
    findings = Validator(copy.file, rules_beside(path, copy.file)).run()
    error = next((f for f in findings if f.severity == "error"), None)
    if error is not None:
        raise ValueError(
            tr("{name} has errors, and there is no control image beside it. First error: {message}").format(
                name=path.name, message=error.message
            )
        )
