"""The controls on the welcome page: which were reached before, when and how; connect to one,
or read it into a new file.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from datetime import UTC, datetime
from functools import partial
from typing import TYPE_CHECKING

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QKeySequence, QShortcut
from PySide6.QtWidgets import QLabel, QListWidgetItem, QMenu, QSizePolicy, QToolButton, QWidget

from amp_studio.ui.base.known_controls import KnownControl
from amp_studio.ui.base.layout import in_column, in_row
from amp_studio.ui.base.modal import pop_up
from amp_studio.ui.base.theme import CONTROL, GAP, GAP2, font, icon
from amp_studio.ui.base.time_words import in_words
from amp_studio.ui.window.studio_window import StudioWindow

from .list import KEY, WelcomeList, WelcomeRow

if TYPE_CHECKING:
    from amp_studio.ui.actions.control import ControlDesk


class WelcomeControls(QWidget):
    """A row for each control that is known. A click or Enter connects, Delete takes it from the list."""

    def __init__(self, window: StudioWindow, control: ControlDesk) -> None:
        super().__init__()
        self._window, self._control = window, control
        self.names: Mapping[str, str] = {}
        """Key of a family -> its short name."""
        self._states: dict[str, str] = {}
        """Address -> revision, axes and state of a control that was connected from this page."""
        self.list = WelcomeList(self.tr("Controls"))
        self.list.itemActivated.connect(lambda item: self._guarded(self._connect, item.data(KEY)))
        self.list.setContextMenuPolicy(Qt.ContextMenuPolicy.CustomContextMenu)
        self.list.customContextMenuRequested.connect(self._menu)
        forget = QShortcut(QKeySequence("Del"), self.list)
        forget.setContext(Qt.ShortcutContext.WidgetShortcut)
        forget.activated.connect(lambda: self._on_current(self._forget))
        self.connect_button = welcome_button(
            self.tr("Connect"), "link-simple", lambda: self._on_current(partial(self._guarded, self._connect))
        )
        self.upload_button = welcome_button(self.tr("Upload…"), "arrow-line-up", self._upload_current)
        self.none = QLabel(self.tr("No control has been reached yet. Upload reads one into a new file."))
        self.none.setFont(font("small"))
        self.none.setWordWrap(True)
        self.none.setForegroundRole(self.palette().ColorRole.PlaceholderText)
        title = QLabel(self.tr("Controls"))
        bold = font("text")
        bold.setWeight(bold.Weight.DemiBold)
        title.setFont(bold)
        title.setFixedHeight(CONTROL)
        row = in_row(title, 0, self.connect_button, self.upload_button, margins=(0, 0, 0, GAP), gap=GAP2)
        in_column(row, self.list, self.none, on=self, margins=0, gap=0)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Maximum)
        self.setFocusProxy(self.list)

    def show_controls(self) -> None:
        """List the controls that are known, the latest first."""
        current, now = self.list.currentRow(), datetime.now(UTC).astimezone()
        self.list.clear()
        known = self._window.settings.controls()
        for control in known:
            self.list.add(control, self._row(control, now))
        self.list.setCurrentRow(max(0, min(current, len(known) - 1)))
        self.list.setVisible(bool(known))
        self.list.fit()
        self.none.setVisible(not known)
        self.connect_button.setEnabled(bool(known))

    def _row(self, control: KnownControl, now: datetime) -> WelcomeRow:
        verbs = {
            "connect": self.tr("connected"),
            "download": self.tr("downloaded"),
            "verify": self.tr("verified"),
            "upload": self.tr("uploaded"),
            "restore": self.tr("restored"),
        }
        moment = control.moment
        when = in_words(moment, now) if moment is not None else ""
        family = self.names.get(control.family, control.family)
        name = control.name or control.address
        state = self._states.get(control.address, "")
        about = ", ".join(filter(None, (family, control.address if control.name else "", state)))
        return WelcomeRow(
            name,
            second=about or self.tr("family not known yet"),
            right=f"{verbs[control.verb]} {when}".strip() if control.reached else when,
            status="" if control.reached else self.tr("not reached"),
        )

    # -- what is done ------------------------------------------------------------------

    def _guarded(self, act: Callable[[KnownControl], object], control: KnownControl) -> None:
        self._window.guarded(partial(act, control), self.tr("Control"))
        self.show_controls()

    def _on_current(self, act: Callable[[KnownControl], object]) -> None:
        item: QListWidgetItem | None = self.list.currentItem()
        if item is not None:
            act(item.data(KEY))

    def _connect(self, control: KnownControl) -> None:
        """Ask the control who it is; nothing is read from it or changed."""
        # First: after an error the old state must not be shown as the present one.
        self._states.pop(control.address, None)
        found = self._control.exchanges.identify(control.address, control.family)
        state = {True: self.tr("in E-stop"), False: self.tr("not in E-stop"), None: ""}[found.in_estop]
        revision = self.tr("revision {revision}").format(revision=found.revision) if found.revision else ""
        axes = " ".join(found.axes[:12])
        self._states[control.address] = ", ".join(filter(None, (revision, axes, state)))
        text = self.tr("{address} answers: {family}").format(
            address=control.address, family=self.names.get(found.family, found.family)
        )
        self._window.show_status(text)

    def _upload_current(self) -> None:
        # Without a control in the list Upload asks for an address.
        item = self.list.currentItem() if self.list.count() else None
        address = item.data(KEY).address if item is not None else None
        self._window.guarded(partial(self._control.upload, address), self.tr("Upload"))
        self.show_controls()

    def _forget(self, control: KnownControl) -> None:
        settings = self._window.settings
        settings.keep_controls([each for each in settings.controls() if each.address != control.address])
        self.show_controls()

    def _menu(self, place: QPoint) -> None:
        item = self.list.itemAt(place)
        if item is None:
            return
        control, menu = item.data(KEY), QMenu(self)
        menu.addAction(self.tr("&Connect"), partial(self._guarded, self._connect, control))
        menu.addAction(self.tr("&Upload…"), self._upload_current)
        menu.addAction(self.tr("&Remove from the List"), partial(self._forget, control))
        pop_up(menu, self.list.viewport().mapToGlobal(place))


def welcome_button(text: str, name: str, act: Callable[[], object]) -> QToolButton:
    """Return a button with an icon, as those of this page are."""
    button = QToolButton()
    button.setText(text)
    button.setIcon(icon(name))
    button.setToolButtonStyle(Qt.ToolButtonStyle.ToolButtonTextBesideIcon)
    button.setProperty("segment", "only")
    button.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
    button.clicked.connect(lambda *_: act())
    return button
