"""Asking a control for its status: begun, stopped while something else needs the line, silent, lost."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal

from amp_studio.files import ParameterFile
from amp_studio.transfer.links import PasswordError
from amp_studio.ui.base.translated import message_in_words
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.control.readings import StatusReadings
from amp_studio.ui.control.session import ControlSession

from .answer_times import AnswerTimes
from .page_parts import LivePageParts

if TYPE_CHECKING:
    from amp_studio.transfer import ControlStatus


class LiveAsking(LivePageParts):
    """The part of the page that has the line to its control, one at a time: the readings or an exchange."""

    changed = Signal()
    """The control is asked, or not any more."""
    control_requested = Signal()
    """The page at the control is wanted: a password, another one."""

    def __init__(self, workspace: Workspace, present: Callable[[], ParameterFile | None]) -> None:
        super().__init__(workspace, present)
        self._family = workspace.file.schema.family.family
        self.session: ControlSession | None = None
        self.readings: StatusReadings | None = None
        self._status: ControlStatus | None = None
        self._answers = AnswerTimes(self)
        self._why = ""
        self._then: Callable[[], object] | None = None
        """What takes the line once the readings have left it."""
        self._is_own = self._is_away = self._is_silent = False
        self._refused_in: object = None
        self._answers.silent.connect(self._silent)
        self._answers.aged.connect(self.panel.age.setText)
        workspace.closed.connect(self._close)

    @property
    def is_live(self) -> bool:
        """Whether the control is being asked."""
        return self.readings is not None and self.readings.is_running

    @property
    def state(self) -> tuple[str, bool]:
        """How the control answers while it is asked, in words, and whether that needs a look."""
        return (self.tr("no answer"), True) if self._is_silent else (self.tr("live"), False)

    def start(self) -> None:
        """Begin to ask: first what the control contains, where that needs no operator at its keys."""
        session = self.session
        if session is None or self.readings is None or session.is_busy:
            return
        if self.is_live:
            if self._why:  # it is being stopped: again once the line is free
                self._then = self.start
            return
        self._why, self._is_away = "", False
        self.bar.hide()
        if self._status is None:
            self.panel.show_nothing(self.tr("no readings yet"))
        if self._takes_one():  # again each time: what was read before may be old
            self._is_own = True
            session.read()
            return
        self._ask()

    def _takes_one(self) -> bool:
        """Return whether single values go into the control, which can be read at any time then."""
        assert self.session is not None
        if self.session.seen is not None:
            return self.session.seen.takes_one
        from amp_studio.transfer import TakesLiveValues
        from amp_studio.transfer.client import open_driver
        from amp_studio.transfer.links import EndpointError

        try:
            return isinstance(open_driver(self.session.address, self._family), TakesLiveValues)
        except EndpointError:
            return False

    def _ask(self) -> None:
        if self.readings is not None and not self._is_away:
            self.readings.start()
            self._answers.begin()
            self.changed.emit()

    def stop(self, why: str) -> None:
        """Ask no more, and say why."""
        if self.readings is not None and self.readings.is_running:
            self._why = why
            self.readings.stop()

    def turned_away(self) -> None:
        """Rest while another page is in front."""
        self._is_away = True
        self.recorder.stop()
        self.stop(self.tr("Live was left."))

    def _over(self, error: object) -> None:
        self._is_silent = False
        self.panel.grey(True)
        self._answers.end()
        if isinstance(error, Exception) and self.session is not None:
            self.session.note_loss(error)
        self.changed.emit()
        if self._then is not None:
            then, self._then = self._then, None
            then()
            return
        if isinstance(error, Exception):  # of an exchange without what the control contains: this reads only
            text = sentence_of(getattr(error, "what", "") or str(error))
            ways = [(self.tr("Try Again"), self.start), self._to_control()]
            if isinstance(error.__cause__, PasswordError):
                text, ways = self.tr("The control asks for its password, which is entered there."), ways[1:]
            self.bar.say(text, "error", *ways)
            self.frame.refuse(text)
            self._refused_in = None  # the next reading allows it
        elif self._why and not self._is_away:
            self.bar.say(self._why, "advice", (self.tr("Go On"), self.start))

    def _to_control(self) -> tuple[str, Callable[[], object]]:
        return self.tr("At the Control"), self.control_requested.emit

    def _silent(self) -> None:
        """Show that the figures are old."""
        if self.is_live:
            since = f"{self._answers.last:%H:%M:%S}" if self._answers.last else "–"
            self.bar.say(
                self.tr("No answer since {time}: the figures are the last ones.").format(time=since),
                "warning",
            )
            self.panel.grey(True)
            self._is_silent = True
            self.changed.emit()

    def _with_line(self, act: Callable[[], object]) -> None:
        """Do something that needs the line; the readings leave it for that and come back afterwards."""

        def begin() -> None:
            self._is_own = True
            act()

        if self.is_live:
            self._then = begin
            assert self.readings is not None
            self.readings.stop()
        else:
            begin()

    def _close(self) -> None:
        """Ask no more: the file is closed."""
        self._is_away = True
        if self.readings is not None:
            self.readings.stop()


def sentence_of(error: str) -> str:
    """Return an error as a sentence in the language of the window."""
    text = message_in_words(error)
    return f"{text[:1].upper()}{text[1:]}"
