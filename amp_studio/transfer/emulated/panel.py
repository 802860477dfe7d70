"""What the control of a family does besides taking and giving contents: at each start, and at its own
screen.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol, runtime_checkable

from amp_studio.transfer.status import ControlStatus

from .control import Control


@dataclass(frozen=True)
class Start:
    """What comes of a start with a content.

    ``messages``  what the control's screen shows, one line each
    ``estop_reason``      why it stays in E-stop; "" where E-stop can be released
    """

    messages: tuple[str, ...] = ()
    estop_reason: str = ""


class OperatorPanel(Protocol):
    """A family's own behaviour, found by its ``Registration.emulators``.
    It waits for nothing and opens nothing.
    """

    words: str
    """The operator's commands that it knows, for the list of all."""

    def started(self, control: Control) -> Start:
        """Return what happens at a start of the control, whatever its content is."""

    def operate(self, control: Control, verb: str, rest: str) -> str | None:
        """Do an operator's command and return what he reads; None for one of others. Raises ValueError,
        RefusalError, OSError.
        """


@runtime_checkable
class TimedPanel(Protocol):
    """A panel behind which a machine moves."""

    def advance(self, control: Control, duration: float) -> None:
        """Let a time pass, s; called before anything else of a turn."""


@runtime_checkable
class ScreenPanel(Protocol):
    """A panel whose screen others can read."""

    def screen(self, control: Control) -> ControlStatus:
        """Return what the screen shows now."""


class PlainPanel:
    """A control of which no such behaviour is known."""

    words = ""

    def started(self, _control: Control) -> Start:
        """Return that nothing happens."""
        return Start()

    def operate(self, _control: Control, _verb: str, _rest: str) -> str | None:
        """Know no command."""
        return None
