"""An emulated NUM control behind a gateway that speaks the exchange protocol; its keys move a machine."""

from __future__ import annotations

from amp_studio.transfer import ControlStatus, decode_image
from amp_studio.transfer.emulated import Control, EmulatedOptions, Start, run_house
from amp_studio.transfer.house import Flags
from amp_studio.transfer.links import Endpoint

from .manual_keys import VERBS, NumKeys


class NumPanel:
    """What an operator moves at the control, and its axis page."""

    words = NumKeys.words

    def __init__(self) -> None:
        self._image = b""
        self._keys = NumKeys(lambda: self._image, decode_image)

    def started(self, _control: Control) -> Start:
        """Return that nothing is known of a start."""
        return Start()

    def advance(self, control: Control, duration: float) -> None:
        """Let time pass, s; E-stop takes the drives away."""
        self._image = control.image
        self._keys.follow_estop(bool(control.flags & Flags.ESTOP))
        self._keys.advance(duration)

    def operate(self, control: Control, verb: str, rest: str) -> str | None:
        """Do what a key does; None for other commands. Raises ValueError."""
        if verb not in VERBS:
            return None
        if verb in ("jog", "homing") and control.flags & Flags.ESTOP:
            raise ValueError("the control is in E-stop")
        self._image = control.image
        return self._keys.operate(verb, rest)

    def screen(self, control: Control) -> ControlStatus:
        """Return the axis page."""
        self._image = control.image
        return self._keys.screen("E-STOP" if control.flags & Flags.ESTOP else "ready")


def emulate(listen: Endpoint, options: EmulatedOptions) -> int:
    """Run an emulated NUM control in the exchange protocol until asked to quit; raises ValueError."""
    if options.hardware:
        raise ValueError(f"an emulated control of {options.family} has no options")
    return run_house(listen, options, NumPanel())
