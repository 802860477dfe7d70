"""The machine behind the emulated 9/PC: the jog and home keys, MDI blocks,
and what its position screen shows (chapters 5, 6 and 8).

Commands are keys: ``jog X+ second`` goes on until ``release``, ``jog X+ increment third`` is one increment,
``manual-home X`` the home key (5-3), ``position`` the position screen; ``mdi G28 X5``, ``mdi G30 X5``,
``mdi G0 X10 Y5`` and ``mdi G1 X10 F500`` are blocks, and ``fault drive X`` is a drive that trips.
The house protocol shows no positions; a live page looks at the screen (``emulate --screen``).
"""

from __future__ import annotations

import contextlib
import re

from amp_studio.families.ninepc.law import LAW
from amp_studio.families.ninepc.law_facts import ids
from amp_studio.files import ParameterFile
from amp_studio.sim import FileMachine, SimulationError, bind_axis
from amp_studio.transfer import ControlStatus, ImageError, decode_image
from amp_studio.transfer.emulated import Control, screen_status
from amp_studio.transfer.house import Flags

_MUST_HOME, _NOT_ALLOWED = "MUST HOME AXIS", "HOMING NOT ALLOWED"
_WORD = re.compile(r"([A-Z])\s*([+-]?[0-9]*\.?[0-9]+)", re.IGNORECASE)
_BLOCK = re.compile(r"G(0|00|1|01|28|30)((?:\s*[A-Z]\s*[+-]?[0-9]*\.?[0-9]+)+)\s*", re.IGNORECASE)


class MachineKeys:
    """What an operator moves at the control."""

    words = (
        "jog X+ [SPEED | increment NAME], release, manual-home AXIS, mdi G0 X10, position, fault drive AXIS"
    )

    def __init__(self) -> None:
        self._machine = FileMachine(LAW, bind_axis)
        self._content = b""
        self._was_estop = False

    def started(self) -> None:
        """Begin as after a power-up: no axis is homed."""
        self._machine.forget()
        self._content = b""

    def advance(self, control: Control, duration: float) -> None:
        """Let time pass, s; E-stop takes the drives away, and an alarm of a servo puts the control into it
        (7-20).
        """
        if control.flags & Flags.ESTOP:
            self._machine.switch_off()
        elif self._was_estop:  # E-STOP RESET gives the drives back, and forgets what has stopped them
            self._machine.reset()
        elif self._machine.has_lost_drive:
            control.set_estop(True)
        self._was_estop = bool(control.flags & Flags.ESTOP)
        self._machine.advance(duration)

    def operate(self, control: Control, verb: str, rest: str) -> str | None:
        """Do what a key does; None for other commands. Raises ValueError."""
        if verb not in ("jog", "release", "manual-home", "mdi", "position", "fault"):
            return None
        if verb == "position":
            return self._machine.screen()
        if verb == "release":
            self._machine.stop()
            return "released"
        try:
            if verb == "fault":
                return self._fault(control, rest)
            self._ready(control)
            if verb == "jog":
                return self._jog(rest.split())
            if verb == "manual-home":
                if self._machine.is_busy:
                    raise ValueError(_NOT_ALLOWED)
                return f"homing {self._machine.home(rest.strip())}"
            return self._mdi(rest)
        except SimulationError as error:
            raise ValueError(str(error)) from None

    def screen(self, control: Control) -> ControlStatus:
        """Return the position screen: every axis of its AMP, with what has stopped it."""
        with contextlib.suppress(ValueError, SimulationError):  # an AMP that makes no machine moves nothing
            self._load_parameters(control)
            self._machine.make_all()
        state = "E-STOP" if control.flags & Flags.ESTOP else "moving" if self._machine.is_busy else "ready"
        identity = control.identity
        return screen_status(identity.family, identity.name, state, self._machine.axes())

    def _load_parameters(self, control: Control) -> None:
        if control.image != self._content and not self._machine.is_busy:
            self._machine.take(_file_of(control))
            self._content = control.image

    def _ready(self, control: Control) -> None:
        if control.flags & Flags.ESTOP:
            raise ValueError("the control is in E-stop")
        self._load_parameters(control)
        if not self._machine.is_busy:
            self._machine.reset()

    def _fault(self, control: Control, rest: str) -> str:
        """Have a fault of the machine, of the axis that is named."""
        kind, _, axis = rest.strip().partition(" ")
        self._load_parameters(control)
        return self._machine.fail(axis.strip(), kind)

    def _jog(self, words: list[str]) -> str:
        """Jog an axis by its key, at a speed or by an increment; returns the answer of the screen."""
        match words:
            case [key]:
                speed = increment = ""
            case [key, "increment", name]:
                speed, increment = "", name
            case [key, speed]:
                increment = ""
            case _:
                raise ValueError(f"jog takes an axis with its direction: {self.words}")
        if len(key) < 2 or key[-1] not in "+-":
            raise ValueError("jog takes an axis with its direction, as X+ or X-")
        return self._machine.jog(key[:-1], 1.0 if key[-1] == "+" else -1.0, speed, increment)

    def _mdi(self, block: str) -> str:
        """Begin the move of a block; returns it, or why the control does not move."""
        match = _BLOCK.fullmatch(block.strip())
        if match is None:
            raise ValueError("of MDI blocks this control moves G0, G1, G28 and G30 with axes and F")
        words = {letter.upper(): float(figure) for letter, figure in _WORD.findall(match[2])}
        feed = words.pop("F", None)
        if match[1] == "28":
            return self._reference(words)
        if match[1] == "30":
            return self._secondary(words)
        self._refuse_unhomed(words)
        if match[1] not in ("1", "01"):
            feed = None
        elif not feed:
            raise ValueError("G1 needs a feedrate F")
        self._machine.move(words, feed / 60.0 if feed else None)
        return block.strip()

    def _refuse_unhomed(self, words: dict[str, float]) -> None:
        if unhomed := [axis for axis in words if not self._machine.is_homed(axis)]:
            raise ValueError(f"{_MUST_HOME} {', '.join(unhomed)}")

    def _secondary(self, words: dict[str, float]) -> str:
        """Go over the point to G30 Secondary Home Position (5-17). ASSUMED: at rapid, as G28 does (5-13)."""
        self._refuse_unhomed(words)
        self._machine.move(
            words, None, {axis: self._machine.number(ids.secondary_home, axis) for axis in words}
        )
        return f"to the secondary home position of {', '.join(words)}"

    def _reference(self, words: dict[str, float]) -> str:
        """Home what is not homed, else go over the point to the home position at rapid (5-13)."""
        unhomed = [axis for axis in words if not self._machine.is_homed(axis)]
        if unhomed:
            return f"homing {', '.join(self._machine.home(axis) for axis in unhomed)}"
        self._machine.move(words, None, {axis: self._machine.home_position(axis) for axis in words})
        return f"to the home position of {', '.join(words)}"


def _file_of(control: Control) -> ParameterFile:
    try:
        return decode_image(control.image)
    except ImageError as error:
        raise ValueError(f"its AMP cannot be read: {error}") from None
