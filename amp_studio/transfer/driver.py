"""What every way of speaking to a control can be asked for: who is there, what does it contain,
take this instead.

A driver moves contents as bytes and is of the kind (``content``) that knows what they mean. It opens its own
link, bounds its peer and its waiting, and ends every exchange with a TransferError that names what the
control contains, or with success.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import ClassVar, Protocol, runtime_checkable

from amp_studio.schema import Address, Value

from .content import ContentKind
from .errors import TransferError
from .exchange import QUIET, Exchange, Replacement
from .links import Endpoint


@dataclass(frozen=True)
class Abilities:
    """What a way of speaking to a control can do.

    ``can_send``        it takes a download
    ``remembers``       it knows by itself what the control has contained before, and takes that back whatever
                        it is
    ``all_or_nothing``  a download that breaks off leaves the old content or the new one, never some of both
    ``maps_numbers``    a file of another schema of the family is sent as well: each parameter by its number
    ``lasting_states``  the states, in the control's own words, in which a write lasts; in any other its
                        driver refuses before
                        anything is written. Empty where the control keeps nothing without power;
                        None where no source states it
    """

    can_send: bool = True
    remembers: bool = False
    all_or_nothing: bool = True
    maps_numbers: bool = False
    lasting_states: tuple[str, ...] | None = None

    def check_lasts(self, state: str, why: str) -> None:
        """Refuse a state in which a write does not last, before anything is written;
        ``why`` is the reason and what to do.
        """
        if state not in (self.lasting_states or ()):
            raise TransferError(f"the control is in the state {state[:20]}: {why}")

    def lasting_text(self) -> str:
        """Return in which states a write lasts, in words."""
        if self.lasting_states is None:
            return "in which states of the control a write lasts is not known"
        return (
            f"a write lasts in {', '.join(self.lasting_states)}"
            if self.lasting_states
            else "a write is lost with the power"
        )


@dataclass(frozen=True)
class ControlIdentity:
    """What answers.

    ``signature``       of the schema it numbers its parameters by, in hexadecimal; "" where it does not name
                        one
    ``axes``            their names, where it names them before it is read
    ``size``, ``sha256``  of what it contains: bytes and digest; None if that is known only once it is fetched
    ``in_estop``        None where there is no such state, or it cannot be asked
    ``restart_needed``  its parameters become active after a restart
    ``notice``          what a person has to know before its content is replaced
    """

    family: str
    protocol: str
    name: str = ""
    revision: str = ""
    signature: str = ""
    axes: tuple[str, ...] = ()
    size: int | None = None
    sha256: bytes | None = None
    in_estop: bool | None = None
    restart_needed: bool = False
    notice: str = ""


@dataclass(frozen=True)
class Receipt:
    """What a control answered when it took a download.

    ``restarting``      whether it restarts now; ``boot_count`` is the number of the start that ends
    ``restart_needed``  whether a restart by hand makes it current, where it does not restart by itself
    ``notes``           sentences that the person has to know
    ``is_answered``     whether the control itself has answered that it took it; without,
                        only reading it back shows it
    """

    restarting: bool = False
    boot_count: int = 0
    restart_needed: bool = True
    notes: tuple[str, ...] = ()
    is_answered: bool = True


class ControlDriver(ContentKind, Protocol):
    """One way of speaking to one control. Everything may raise TransferError; a driver belongs to one
    thread.
    """

    @property
    def abilities(self) -> Abilities:
        """What can be asked for; known before anything is connected."""

    def identify(self, exchange: Exchange = QUIET) -> ControlIdentity:
        """Return who answers; connects where there is no connection yet."""

    def fetch(self, exchange: Exchange = QUIET, stage: str = "upload") -> bytes:
        """Return all that the control contains, whole and undamaged;
        the same bytes while it contains the same.
        """

    def send(self, replacement: Replacement, exchange: Exchange = QUIET) -> Receipt:
        """Have the control contain one content instead of another.

        A driver that sends single values sends those that differ.
        ``at_control`` of an error is what the control contains then.
        """

    def close(self) -> None:
        """Close the line. Closing twice is no fault."""


@runtime_checkable
class RestartsItself(Protocol):
    """A driver whose control restarts by itself after a download."""

    def wait_restarted(self, receipt: Receipt, seconds: float, exchange: Exchange = QUIET) -> bool:
        """Wait up to so many seconds for the restart after ``send``;
        returns whether the control has come back.
        """


@runtime_checkable
class ReadsBackPartly(Protocol):
    """A driver that may prove what it has sent without reading all of it, where the line is slow."""

    @property
    def read_back(self) -> str:
        """How the last fetch was proven, in words; "" where every byte was read."""


@runtime_checkable
class ShowsValuesInUse(Protocol):
    """A driver whose control reads its parameters when it starts, and shows which it uses since."""

    def in_use(self, content: bytes) -> Mapping[Address, Value]:
        """Return the values in use of those that the content sets, as the content has them where they are the
        same as far as they are shown; empty where nothing runs. Raises TransferError.
        """


@runtime_checkable
class TakesLiveValues(Protocol):
    """A driver over which single values go into a control that is at work, one short exchange each."""

    takes_live_values: ClassVar[bool]


@dataclass(frozen=True)
class Recognised:
    """How a control is known by its answer, where its family was not named.

    ``question`` is sent to whatever is there, so it must do nothing to any machine;
    ``answer`` is looked for in what comes.
    """

    protocol: str
    question: bytes
    answer: re.Pattern[bytes]


DriverFactory = Callable[[Endpoint, str], ControlDriver]
"""Make the driver of an endpoint; the text is the family the control must be of, "" for any.
Connects to nothing yet."""
