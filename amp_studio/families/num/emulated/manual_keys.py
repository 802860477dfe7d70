"""The machine behind an emulated NUM control: jog and homing in manual mode,
and the position page (chapters 6 and 7).

Commands are keys: ``jog X+ slow`` goes on until ``release``, ``homing X`` the homing mode with the key of the
direction of P15, ``position`` the axis page. The peripheral line carries parameters alone (chapter 13):
what the axes do is on the screen (``emulate --screen``).
"""

from __future__ import annotations

import contextlib

from amp_studio.families.num.law import LAW
from amp_studio.families.num.lines.content import KIND, NumTableContent
from amp_studio.files import ParameterFile
from amp_studio.sim import FileMachine, SimulationError, bind_axis
from amp_studio.transfer import ControlStatus, ImageError
from amp_studio.transfer.emulated import screen_status

from .parameter_memory import ParameterMemory

XOFF = b"\x13"
"""End of a table as the control unloads it (page 13-10)."""
VERBS = ("jog", "release", "homing", "position", "fault")


class NumKeys:
    """What an operator moves at the control in its manual modes."""

    words = "jog X+ [slow|normal|fast|reduced], release, homing X, position, fault drive|feedback X"

    def __init__(self, parameters: ParameterMemory) -> None:
        self._parameters = parameters
        self._machine = FileMachine(LAW, bind_axis)
        self._content = b""

    def advance(self, duration: float) -> None:
        """Let time pass, s."""
        self._machine.advance(duration)

    def operate(self, verb: str, rest: str) -> str:
        """Do what one of VERBS asks for; raises ValueError."""
        if verb == "position":
            return self._machine.screen()
        if verb == "release":
            self._machine.stop()
            return "released"
        try:
            self._load_parameters()
            if verb == "fault":
                kind, _, axis = rest.strip().partition(" ")
                return self._machine.fail(axis.strip(), kind)
            if not self._machine.is_busy:
                self._machine.reset()
            if verb == "homing":
                if self._machine.is_busy:
                    raise ValueError("an axis is moving")
                return f"homing {self._machine.home(rest.strip())}"
            return self._jog(rest.strip())
        except SimulationError as error:
            raise ValueError(str(error)) from None

    def _jog(self, what: str) -> str:
        """Press a key of an axis, such as ``X+``, at a speed where one is given."""
        key, _, speed = what.partition(" ")
        if len(key) < 2 or key[-1] not in "+-":
            raise ValueError(f"jog takes an axis with its direction: {self.words}")
        return self._machine.jog(key[:-1], 1.0 if key[-1] == "+" else -1.0, speed.strip())

    def screen(self, state: str) -> ControlStatus:
        """Return the axis page: every axis of the parameters, with what has stopped it."""
        with contextlib.suppress(ValueError, SimulationError):  # a table that makes no machine moves nothing
            self._load_parameters()
            self._machine.make_all()
        return screen_status("num", "NUM", state, self._machine.axes())

    def _load_parameters(self) -> None:
        """Have the machine be that of the parameters, at rest."""
        content = b"".join(self._parameters.lines())
        if content != self._content and not self._machine.is_busy:
            self._machine.take(_file_of(content))
            self._content = content


def _file_of(content: bytes) -> ParameterFile:
    try:
        return NumTableContent().decode(f"{KIND}\n".encode() + content + XOFF)
    except ImageError as error:
        raise ValueError(f"the parameters make no machine: {error}") from None
