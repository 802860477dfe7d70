"""The emulated 9/PC at its own screen: password, Patch AMP, and what it shows at each start (chapters 2, 33,
36 and 37).

Commands are keys: ``password AB-D4`` is {PASSWORD}, ``patch-amp LOCK`` the softkey {PATCH AMP} with its
second password, ``search 1750`` is {SEARCH NUMBER}, ``replace 1750 40`` {REPLACE VALUE}, ``update`` {UPDATE &
EXIT}, ``leave`` goes without it, and ``can`` is the key [CAN].
``patch KEY=VALUE`` of every emulated control does all of it at once.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace

from amp_studio.files import ParameterFile
from amp_studio.schema import UnknownParameterError, quoted, stored_number, visible, write_number
from amp_studio.transfer import ControlStatus, ImageError, decode_image, patch_image
from amp_studio.transfer.emulated import Control, Start
from amp_studio.transfer.house import Flags

from .machine_keys import MachineKeys
from .online_amp import OnlineAmp
from .power_up import CORRECTED, MAX_AXES, corrected_limits, estop_reasons

MODIFIED = "AMP HAS BEEN MODIFIED BY PATCH AMP"
_NOT_FOUND = "PARAMETER NUMBER NOT FOUND"
_SECOND_PASSWORD = "LOCK"  # noqa: S105  # printed on page 37-2
_CHARACTERS = 6


def axes_supported(hardware: Mapping[str, str]) -> int:
    """Return how many axes the control was ordered with; raises ValueError for another option or number."""
    for name in hardware:
        if name != "axes":
            raise ValueError(f"Unknown option {quoted(name)} of an emulated 9/PC. Known: axes")
    text = hardware.get("axes", str(MAX_AXES))
    if text not in map(str, range(1, MAX_AXES + 1)):
        raise ValueError(f"{quoted(text)} is no number of axes: 1 to {MAX_AXES}")
    return int(text)


class NinePcPanel:
    """What an operator sees and does at a 9/PC that supports so many axes."""

    words = (
        "password WORD, patch-amp WORD, search NUMBER, replace NUMBER VALUE, update, leave, can, messages,"
        f" {OnlineAmp.words}, {MachineKeys.words}"
    )

    def __init__(self, axes: int = MAX_AXES) -> None:
        self._axes = axes
        self._online = OnlineAmp()
        self._keys = MachineKeys()
        self._has_level_0 = False
        self._edited: bytes | None = None
        """The copy of AMP that is edited; None while Patch AMP is not on the screen."""
        self._messages: list[str] = []

    # -- at a start ------------------------------------------------------------------

    def started(self, control: Control) -> Start:
        """Return the messages of a power-up and why E-Stop stays; no user is logged on after it (assumed)."""
        self._has_level_0, self._edited = False, None
        self._online.started()
        self._keys.started()
        self._messages = []
        if control.is_as_delivered:  # it is not configured yet: the manual names all of this after a download
            return Start()
        if control.flags & Flags.CHANGED_AT_CONTROL:
            self._messages.append(MODIFIED)  # page 37-3: at every power-up, until AMP is downloaded again
        reasons: list[str] = []
        try:
            file = _amp_of(control)
        except ImageError:
            reasons = ["its AMP cannot be read"] if control.image else []
        else:
            self._messages += _corrections(file)
            reasons = list(estop_reasons(file, self._axes))
        return Start(tuple(self._messages), "; ".join(reasons))

    def advance(self, control: Control, duration: float) -> None:
        """Let time pass, s: the axes move."""
        self._keys.advance(control, duration)

    def screen(self, control: Control) -> ControlStatus:
        """Return the position screen and what is in the message line."""
        status = self._keys.screen(control)
        return replace(status, values={"messages": "; ".join(self._messages)} if self._messages else {})

    # -- at the keys -----------------------------------------------------------------

    def operate(self, control: Control, verb: str, rest: str) -> str | None:
        """Do what a key does."""
        match verb:
            case "password":
                return self._password(control, rest)
            case "patch-amp":
                return self._open(control, rest)
            case "search":
                return self._search(rest)
            case "replace":
                return self._replace(rest)
            case "update" if not rest:
                return self._update(control)
            case "leave" if not rest:
                self._screen()
                self._edited = None
                return "left; nothing is changed"
            case "can" if not rest:
                self._messages = [message for message in self._messages if message != MODIFIED]
                return "cleared"
            case "messages" if not rest:
                return "; ".join(self._messages) or "no message"
        moved = self._keys.operate(control, verb, rest)
        return self._online.operate(control, verb, rest) if moved is None else moved

    def _password(self, control: Control, word: str) -> str:
        if word.ljust(_CHARACTERS) != _master_password(control):
            raise ValueError("this is not the password of the control")
        self._has_level_0 = True
        return "access level 0"

    def _open(self, control: Control, word: str) -> str:
        if not self._has_level_0:
            raise ValueError("the softkey {PATCH AMP} is not visible at this access level (page 37-2)")
        if word != _SECOND_PASSWORD:
            raise ValueError("the second password is another one (page 37-2)")
        _amp_of(control)
        self._edited = control.image
        return "patch AMP"

    def _screen(self) -> bytes:
        if self._edited is None:
            raise ValueError("the Patch AMP utility is not on the screen: password, then patch-amp")
        return self._edited

    def _search(self, number: str) -> str:
        """Return number and value of a parameter as the patch screen lists it."""
        file = decode_image(self._screen())
        try:
            address = file.find(number)
        except UnknownParameterError:
            raise ValueError(_NOT_FOUND) from None
        parameter, value = file.schema.parameters[address[0]], file.get(address)
        if not parameter.patchable:
            raise ValueError(_NOT_FOUND)
        number = visible(number)
        if value is None:
            return f"{number} not set"
        stored = stored_number(parameter, value, turns=file.evaluation.turns(address))
        if stored is None:
            return f"{number} ?"
        decimals = parameter.storage.decimals if parameter.storage and not parameter.choices else None
        return f"{number} {write_number(stored) if decimals is None else format(stored, f'.{decimals}f')}"

    def _replace(self, rest: str) -> str:
        number, _, value = rest.partition(" ")
        edited = self._screen()
        if not value.strip():
            raise ValueError("replace takes a number and a value")
        self._edited = patch_image(edited, number, value.strip())
        return self._search(number)

    def _update(self, control: Control) -> str:
        """Store all that was edited at once; it becomes active
        when the control is switched off and on (page 37-3).
        """
        edited = self._screen()
        control.patch(lambda _image: edited)
        self._edited = None
        return "updated: switch the control off and on (restart)"


def _amp_of(control: Control) -> ParameterFile:
    """Return the AMP that a control contains; raises ImageError for what is none."""
    file = decode_image(control.image)
    if file.schema.family.family != control.identity.family:
        raise ImageError(f"the control contains parameters for {file.schema.family.name}")
    return file


def _corrections(file: ParameterFile) -> Iterator[str]:
    for axis, limits in corrected_limits(file).items():
        values = ", ".join(
            f"{file.machine_schema.number(address)} = {write_number(float(value))}"
            for address, value in limits.items()
        )
        yield f"{CORRECTED}: axis {axis} works with {values} (the values are assumed, none are printed)"


def _master_password(control: Control) -> str:
    """Return the six characters of 101 to 106; those that are not set are as delivered, AB-D4 (page
    33-11).
    """
    file = _amp_of(control)
    codes = []
    for n in range(1, _CHARACTERS + 1):
        address = ("password.character", str(n))
        value = file.get(address) or file.default(address)
        codes.append(32 if value is None or not isinstance(value.value, int) else value.value)
    return "".join(map(chr, codes))
