"""What can end an exchange early: every error reports in a sentence what happened
and what the control contains.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from amp_studio.errors import AmpStudioError
from amp_studio.schema import visible

# "old": what it contained before this exchange; "new": the content that was sent; "mixed": some of both;
# "defaults": it has lost its memory and starts again; "": nothing was to be sent.
AtControl = Literal["", "old", "new", "mixed", "defaults", "unknown"]

AT_CONTROL_TEXT: dict[AtControl, str] = {
    "": "",
    "old": "nothing was replaced in the control",
    "new": "the control contains the new image, which was not read back",
    "mixed": "the control contains some of the new values and the old ones of the rest",
    "defaults": "the control has lost its memory and contains its defaults",
    "unknown": "whether the control contains the old or the new image is not known: verify before you go on",
}


WHICH_IS_NOT_KNOWN = "which of the new values the control contains is not known: verify before you go on"
"""Instead of "the old or the new image" for a control that takes single values:
only one that commits all or nothing has one of two."""


@dataclass(frozen=True)
class Confirmed:
    """How far a download of single values came: ``count`` of ``of`` are confirmed,
    ``unanswered`` names the one under way.
    """

    count: int
    of: int
    unanswered: str = ""

    def __str__(self) -> str:
        text = f"{self.count} of {self.of} values were confirmed"
        return f"{text}, {visible(self.unanswered)} was not answered" if self.unanswered else text


@dataclass(frozen=True)
class Remains:
    """What a control contains after a break: ``least`` has what of the new is certain, ``most`` what may be
    there too. Both are what was read, or what its answers prove.
    """

    least: bytes
    most: bytes
    is_read: bool


class TransferError(AmpStudioError, OSError):
    """An exchange that did not reach its end.

    ``what`` happened; ``at_control`` is what the control contains now; ``kept`` the place where the image it
    contained before was kept, if it was; ``new`` the numbers of the parameters that are new already, where
    some are; ``confirmed`` how far a download of single values came; ``remains`` what the control contains
    then, where single values were sent.
    """

    confirmed: Confirmed | None = None
    remains: Remains | None = None

    def __init__(
        self, what: str, at_control: AtControl = "old", kept: str | None = None, new: tuple[str, ...] = ()
    ) -> None:
        # Much of it are words of the other end: what steers a terminal is shown, not obeyed.
        what = visible(what)
        super().__init__(what)
        self.what = what
        self.at_control: AtControl = at_control
        self.kept = kept
        self.new = new

    def __str__(self) -> str:
        where = (
            f" (what it contained before is kept in {self.kept})"
            if self.kept and self.at_control != "old"
            else ""
        )
        if not self.at_control:
            return self.what
        return "; ".join(filter(None, (self.what, str(self.confirmed or ""), f"{self._now()}{where}")))

    def _now(self) -> str:
        """Return what the control contains now, in words."""
        if self.at_control == "mixed" and self.new:
            return (
                f"the control contains the new {', '.join(map(visible, self.new))} and the old values of the"
                " rest"
            )
        if self.at_control == "new" and self.new:
            return "the control contains the new content, as it was read since"
        if self.at_control == "unknown" and self.confirmed:
            return WHICH_IS_NOT_KNOWN
        but = (
            f", but the new {', '.join(map(visible, self.new))}"
            if self.at_control == "defaults" and self.new
            else ""
        )
        return AT_CONTROL_TEXT[self.at_control] + but


class NoConnectionError(TransferError):
    """No line to the control could be made at all."""


class ControlSilentError(TransferError):
    """The line is there, and the control does not answer."""


class ControlBusyError(TransferError):
    """Another client has the control."""


class MovingError(TransferError):
    """The control answers, and cannot be read while its axes move."""


class ConnectionCutError(TransferError):
    """The line broke and could not be made again in time."""


class ProtocolMismatchError(TransferError):
    """The other end speaks no version of the protocol that this end knows, or does not keep to it."""


class WrongFamilyError(TransferError):
    """The control is of another family than the image."""


class SignatureMismatchError(TransferError):
    """The control numbers its parameters by another schema than the image."""


class NotInEmergencyStopError(TransferError):
    """The control must be in E-stop before it takes an image."""


class ImageChangedError(TransferError):
    """The control's image is not the one that was fetched: it was changed in between."""


class ImageRejectedError(TransferError):
    """The control has examined the image and does not take it."""


class ImageDamagedError(TransferError):
    """The bytes that arrived are not the ones that were sent, though every piece was whole."""


class ControlFullError(TransferError):
    """The control has no room for the image, or cannot write to its memory."""


class KeepFailedError(TransferError):
    """What the control contains could not be kept, so it was not replaced."""


class CancelledError(TransferError):
    """The person has broken the exchange off."""


def unforeseen(error: Exception) -> str:
    """Return an error of another kind in words; one without any by its name."""
    return str(error) or type(error).__name__
