"""The machine behind an emulated NUM control: jog and homing in manual mode,
and the position page (chapters 6 and 7).

Commands are keys: ``jog X+ slow`` goes on until ``release``, ``homing X`` the homing mode with the key of the
direction of P15, ``position`` the axis page. The lines carry parameters alone (chapter 13):
what the axes do is on the screen (``emulate --screen``).
"""

from __future__ import annotations

import contextlib
from collections.abc import Callable

from amp_studio.families.num.law import LAW
from amp_studio.files import ParameterFile
from amp_studio.sim import FileMachine, SimulationError, bind_axis
from amp_studio.transfer import ControlStatus, ImageError
from amp_studio.transfer.emulated import screen_status

VERBS = ("jog", "release", "homing", "position", "fault")


class NumKeys:
    """What an operator moves at the control in its manual modes."""

    words = "jog X+ [slow|normal|fast|reduced], release, homing X, position, fault drive|feedback X"

    def __init__(self, content: Callable[[], bytes], read: Callable[[bytes], ParameterFile]) -> None:
        """``content`` gives the parameters that the control works with, ``read`` makes a file of them."""
        self._now, self._read = content, read
        self._machine = FileMachine(LAW, bind_axis)
        self._content = b""
        self._was_pressed = False

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

    def follow_estop(self, is_pressed: bool) -> None:
        """Take the drives away, or give them back and forget what has stopped them."""
        if is_pressed:
            self._machine.switch_off()
        elif self._was_pressed:
            self._machine.reset()
        self._was_pressed = is_pressed

    def screen(self, state: str) -> ControlStatus:
        """Return the axis page: every axis of the parameters, with what has stopped it."""
        with contextlib.suppress(ValueError, SimulationError):  # a table that makes no machine moves nothing
            self._load_parameters()
            self._machine.make_all()
        return screen_status("num", "NUM", state, self._machine.axes())

    def _load_parameters(self) -> None:
        """Have the machine be that of the parameters, at rest."""
        content = self._now()
        if content != self._content and not self._machine.is_busy:
            try:
                self._machine.take(self._read(content))
            except ImageError as error:
                raise ValueError(f"the parameters make no machine: {error}") from None
            self._content = content
