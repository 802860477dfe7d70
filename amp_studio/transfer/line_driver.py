"""What the drivers have in common that speak to a control over one line in its own way: values are sent,
and read back after a break.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import ClassVar, Self

from .break_state import state_after_break
from .driver import Abilities, ControlIdentity, Receipt
from .errors import CancelledError, ImageRejectedError, Remains, TransferError, WrongFamilyError, unforeseen
from .exchange import QUIET, Exchange, Replacement
from .image import ImageError
from .links import Endpoint, SerialSettings, connect
from .sent_values import SentValues
from .waiting import OpenLink, Waiting


class LineDriver(ABC):
    """One way of speaking to the controls of one family;
    with the family's kind of content it is a ControlDriver.

    A subclass identifies, reads and writes the control. What every such driver does is here: of which family
    it is, whom it obeys while it waits, and that every error of a download names what the control contains.
    """

    family: ClassVar[str]
    protocol: ClassVar[str]
    abilities: ClassVar[Abilities] = Abilities(all_or_nothing=False)
    usual: ClassVar[SerialSettings | None] = None
    """The settings of a line as the control is delivered; None for those of every line."""
    own_flow: ClassVar[bool] = False
    """Whether Xon and Xoff are part of what is spoken, and are read as bytes."""
    is_read_when_stopped: ClassVar[bool] = False
    """Whether the control answers so fast that a user who has stopped a download waits until it is read."""

    def __init__(self, open_link: OpenLink, waiting: Waiting | None = None) -> None:
        self._open_link = open_link
        self._waiting = waiting or Waiting()

    @classmethod
    def at(cls, endpoint: Endpoint, family: str = "") -> Self:
        """Return the driver of an endpoint; ``family`` is the one the control must be of, "" for any.
        Raises WrongFamilyError.
        """
        if family not in ("", cls.family):
            raise WrongFamilyError(
                f"the protocol {cls.protocol} is that of the family {cls.family}, not of {family}", ""
            )
        place = endpoint.with_usual(cls.usual) if cls.usual else endpoint
        return cls(lambda look: connect(place, look=look, own_flow=cls.own_flow))

    def identify(self, exchange: Exchange = QUIET) -> ControlIdentity:
        """Return who answers."""
        self._waiting.begin(exchange)
        return self._identity()

    def fetch(self, exchange: Exchange = QUIET, stage: str = "upload") -> bytes:
        """Return all that the control contains."""
        self._waiting.begin(exchange)
        return self._fetched(stage)

    def send(self, replacement: Replacement, exchange: Exchange = QUIET) -> Receipt:
        """Send what differs; after a break the control is read again,
        so that the error names what it contains.
        """
        self._waiting.begin(exchange)
        sent = SentValues()
        try:
            return self._send(replacement, sent)
        except CancelledError as error:
            # What was sent before the stop stays at the control. Where reading it back would make the user
            # wait for minutes, the answers to what was sent are all that is known.
            if self.is_read_when_stopped and sent.has_begun:
                self._waiting.begin(QUIET)
                self._after_break(error, sent, replacement)
            else:
                error.at_control, error.new = sent.answered_state()
                error.confirmed = sent.confirmed if sent.has_begun else None
                error.remains = self._by_answers(sent, replacement)
            if sent.when_stopped:
                error.what += f"; {sent.when_stopped}"
            raise
        except TransferError as error:
            if sent.has_begun and error.confirmed is None:
                self._after_break(error, sent, replacement)
            raise
        except Exception as error:  # no memory, no handle: something may have been written anyway
            if not sent.has_begun:
                raise
            broken = TransferError(f"the download broke off ({unforeseen(error)})")
            self._after_break(broken, sent, replacement)
            raise broken from error

    @abstractmethod
    def close(self) -> None:
        """Close the line. Closing twice is no fault."""

    # -- what a way of speaking is made of -----------------------------------------------------------

    @abstractmethod
    def _identity(self) -> ControlIdentity:
        """Return who answers; raises TransferError."""

    @abstractmethod
    def _fetched(self, stage: str) -> bytes:
        """Return all that the control contains; raises TransferError."""

    @abstractmethod
    def _send(self, replacement: Replacement, sent: SentValues) -> Receipt:
        """Send what differs and note in ``sent`` how far that came; raises TransferError."""

    @abstractmethod
    def _names(self, content: bytes) -> Mapping[str, str]:
        """Return what can be written of a content: name -> text; raises ImageError."""

    def _names_now(self, found: bytes, replacement: Replacement) -> Mapping[str, str]:  # noqa: ARG002  # other controls show a value otherwise
        """Return what the control was read to contain after a break, as ``_names``; raises ImageError."""
        return self._names(found)

    def _fetched_after_break(self) -> bytes:
        """Return all that the control contains after a break; raises TransferError."""
        return self._fetched("verify")

    def _with_new(self, replacement: Replacement, names: Collection[str]) -> bytes:  # noqa: ARG002  # others send single values
        """Return what the control contains where it has taken these values; empty where no value is sent
        alone.
        """
        return b""

    def _by_answers(self, sent: SentValues, replacement: Replacement) -> Remains | None:
        """Return what the control contains by its answers; None where it answers for no value alone."""
        least = self._with_new(replacement, sent.names)
        most = self._with_new(replacement, [*sent.names, *sent.under_way])
        return Remains(least, most, is_read=False) if least else None

    def _after_break(self, error: TransferError, sent: SentValues, replacement: Replacement) -> None:
        """Read the control and write into the error what it contains: "unknown" where it does not answer."""
        error.confirmed = sent.confirmed
        if error.confirmed and isinstance(error, ImageRejectedError):  # it has been answered
            error.confirmed = replace(error.confirmed, unanswered="")
        error.remains = self._by_answers(sent, replacement)
        try:
            found = self._fetched_after_break()
            error.at_control, error.new = state_after_break(
                self._names(replacement.current),
                self._names(replacement.content),
                self._names_now(found, replacement),
            )
            error.remains = Remains(found, found, is_read=True)
        except (TransferError, ImageError):
            error.at_control = "unknown"
