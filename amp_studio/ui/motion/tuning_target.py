"""What is tuned: the open file, or the control that is connected. Both are set,
undone and read in the same way.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from PySide6.QtCore import QObject, Signal

from amp_studio.calibration import with_followers
from amp_studio.files import ParameterFile
from amp_studio.report import takes_effect
from amp_studio.schema import Address, Schema, Value
from amp_studio.ui.base.translated import worded
from amp_studio.ui.base.workspace import Workspace

if TYPE_CHECKING:
    from amp_studio.transfer import Exchange
    from amp_studio.transfer.client import LiveTuning, Outcome

ControlWork = Callable[["Exchange"], Any]
RunExchange = Callable[[str, ControlWork], Any]
"""Runs work with a control that is shown and can be stopped, and returns its result or raises its error."""


def effect_words(schema: Schema, address: Address) -> str:
    """Return when a changed value takes effect by the manual, in words."""
    return worded(takes_effect(schema, schema.parameters[address[0]]))


class TuningTarget(QObject):
    """Values that are tuned, each change one step that is undone.

    Abstract, with every method in both subclasses; ABCMeta cannot be the metaclass of a QObject.
    """

    changed = Signal(list)
    """Addresses whose values changed; empty for any of them."""

    @property
    def file(self) -> ParameterFile:
        """The values as they are now."""
        raise NotImplementedError

    def simulated(self) -> ParameterFile:
        """Return a copy of the values to simulate, which may be edited meanwhile."""
        return self.file.copy()

    @property
    def may_edit(self) -> bool:
        """Whether values may be changed."""
        raise NotImplementedError

    @property
    def path(self) -> Path:
        """The parameter file, beside which tunings are recorded."""
        raise NotImplementedError

    def set(self, text: str, values: Mapping[Address, Value | None]) -> None:
        """Change values as one step, with those that the control changes by itself; raises ValueError,
        OSError.
        """
        raise NotImplementedError

    def undo(self) -> None:
        """Take the last step back; nothing where there is none."""
        raise NotImplementedError

    def redo(self) -> None:
        """Do the last undone step again."""
        raise NotImplementedError


class FileTarget(TuningTarget):
    """The open file; its steps are those of the window."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self._workspace = workspace
        workspace.changed.connect(self.changed)

    @property
    def file(self) -> ParameterFile:
        """The open file."""
        return self._workspace.file

    @property
    def may_edit(self) -> bool:
        """Whether this program may change the file."""
        return self._workspace.may_edit

    @property
    def path(self) -> Path:
        """The open file."""
        return self._workspace.path

    def set(self, text: str, values: Mapping[Address, Value | None]) -> None:
        """Change values of the file as one undoable step; raises ValueError where another program has it."""
        if not self.may_edit:
            raise ValueError(self.tr("The file is read-only: another program has it open."))
        self._workspace.edit(text, with_followers(self.file, values))

    def undo(self) -> None:
        """Take the last step of the file back."""
        self._workspace.undo_stack.undo()

    def redo(self) -> None:
        """Do it again."""
        self._workspace.undo_stack.redo()


class ControlTarget(TuningTarget):
    """A connected control. One that takes single values gets each at once; any other gets them with
    ``send``.
    """

    notified = Signal(str)
    """What came of an exchange, in a sentence."""

    def __init__(self, live: LiveTuning, run: RunExchange, workspace: Workspace) -> None:
        """``live`` has read the control already; ``workspace`` has the open file."""
        super().__init__()
        self.live, self._run, self._workspace = live, run, workspace
        self._waiting: dict[Address, Value | None] = {}
        self._done: list[tuple[str, dict[Address, Value | None], dict[Address, Value | None]]] = []
        self._undone: list[tuple[str, dict[Address, Value | None], dict[Address, Value | None]]] = []
        self._present = self._copy()

    def _copy(self) -> ParameterFile:
        assert self.live.file is not None
        copy = self.live.file.copy()
        for address, value in self._waiting.items():
            copy.set(address, value)
        return copy

    @property
    def file(self) -> ParameterFile:
        """What the control contains as it was last read, with what is to be sent."""
        return self._present

    def simulated(self) -> ParameterFile:
        """Return the values of the control; what it does not state of itself, as the servo period of an ACR
        card, is that of the open file.
        """
        copy = self.file.copy()
        for address, value in self._workspace.file.values.items():
            if copy.get(address) is None:
                copy.set(address, value)
        return copy

    @property
    def may_edit(self) -> bool:
        """Whether it is known what the control contains."""
        return self.live.file is not None

    @property
    def path(self) -> Path:
        """The file that belongs to the control."""
        return self.live.path

    @property
    def waiting(self) -> int:
        """How many values are changed here and not yet in the control."""
        return len(self._waiting)

    def differences(self) -> int:
        """Return in how many values the control differs from the first look."""
        return len(self.live.changes().differences) if self.live.file is not None else 0

    def set(self, text: str, values: Mapping[Address, Value | None]) -> None:
        """Change values in the control, or collect them where it takes none singly."""
        wanted = with_followers(self.file, values)
        # Taken before it is sent: the control is read again after that.
        before = {a: self.file.get(a) for a in wanted}
        wanted = {a: v for a, v in wanted.items() if v != before[a]}
        if not wanted:
            return
        self._apply(text, wanted)
        self._done.append((text, {a: before[a] for a in wanted}, wanted))
        self._undone.clear()

    def undo(self) -> None:
        """Send the values of before the last step."""
        if self._done:
            text, before, wanted = self._done[-1]
            # Before the step is moved: it stays where it is when the control refuses.
            self._apply(text, before)
            self._undone.append(self._done.pop())
            _ = wanted

    def redo(self) -> None:
        """Send the values of the last undone step again."""
        if self._undone:
            text, _, wanted = self._undone[-1]
            self._apply(text, wanted)
            self._done.append(self._undone.pop())

    def _apply(self, text: str, wanted: dict[Address, Value | None]) -> None:
        if not self.live.is_live:
            trial = self._copy()
            trial.set_checked(wanted)  # raises RangeError
            self._waiting |= wanted
            present = self.live.file
            assert present is not None
            # What was changed back to the control's own value has nothing to be sent.
            self._waiting = {a: v for a, v in self._waiting.items() if present.get(a) != v}
            self._show(list(wanted))
            return
        self._exchange(text, lambda exchange: self.live.set(wanted, exchange), wanted)

    def send(self) -> None:
        """Download what is collected; raises TransferError."""
        waiting = dict(self._waiting)
        self._exchange(self.tr("Download"), lambda exchange: self.live.set(waiting, exchange), waiting)
        self._waiting = {}
        self._show([])

    def put_back(self) -> None:
        """Have the control contain what it contained at the first look; raises TransferError."""
        self._waiting = {}
        if self.differences():
            # Before it is put back: there are no differences after that, and the message names their
            # effect.
            changed = [difference.address for difference in self.live.changes().differences]
            self._exchange(self.tr("Put Back"), self.live.put_back, changed)
        # The steps lead from values that the control has no more.
        self._done.clear()
        self._undone.clear()
        self._show([])

    def look(self) -> None:
        """Read the control again."""
        self._run(self.tr("Read Control"), self.live.look)
        self._show([])

    def _exchange(self, text: str, work: ControlWork, changed: Iterable[Address]) -> None:
        try:
            outcome: Outcome = self._run(text, work)
        # Also after an error: some of the values may have been sent, and what is shown must follow.
        finally:
            if self.live.file is not None:
                self._show([])
            else:
                self.changed.emit([])
        schema = self.file.schema
        effects = dict.fromkeys(effect_words(schema, address) for address in changed)
        takes = self.tr("Takes effect: {when}.").format(when=", ".join(effects))
        self.notified.emit(f"{outcome.text} {takes}")

    def _show(self, addresses: list[Address]) -> None:
        self._present = self._copy()
        self.changed.emit(addresses)
