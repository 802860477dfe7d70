"""The client's side of an exchange: it survives cut lines and ends by saying what the control holds."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable
from typing import TypeVar

from .address import Address, parse_address
from .conversation import Conversation, Silence
from .errors import ControlSilent, NoConnection, TransferError, error_of
from .fetching import Fetching
from .line import PAUSE, Line
from .link import Link, LinkError, connect
from .message import (
    Refusal,
    Restart,
    Restarting,
    State,
    Status,
    Welcome,
    shorten,
)
from .pace import Limits
from .progress import Progress, quiet
from .sending import Sending, Sent

Result = TypeVar("Result")


__all__ = ["Progress", "Session", "quiet"]


class Session:
    """An exchange with one control.

    ``open_link`` makes the line, and makes it again when it is cut, for up to ``patience`` seconds without
    progress. ``family`` is the family the control must be of ("" for any). ``clock`` and ``sleep`` are in
    seconds. A session belongs to one thread; only a cancel event may be set from another.
    """

    def __init__(
        self,
        open_link: Callable[[], Link],
        *,
        family: str = "",
        patience: float = 20.0,
        limits: Limits | None = None,
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], None] = time.sleep,
        random_bytes: Callable[[int], bytes] = os.urandom,
        client: str = "AMP Studio",
    ) -> None:
        self._line = Line(
            open_link,
            family=family,
            client=shorten(client),
            patience=patience,
            limits=limits or Limits(),
            clock=clock,
            sleep=sleep,
            random_bytes=random_bytes,
        )

    @classmethod
    def at(cls, address: Address | str, *, family: str = "", patience: float = 20.0) -> Session:
        """Return a session with the control at an address; raises ValueError when it is none."""
        place = parse_address(address) if isinstance(address, str) else address
        return cls(lambda: connect(place), family=family, patience=patience)

    def __enter__(self) -> Session:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Hang up."""
        self._line.close()

    # -- asking ------------------------------------------------------------------------------------

    def hello(self, cancel: threading.Event | None = None) -> Welcome:
        """Return who the control is and what it holds; connects where there is no line yet.

        Raises NoConnection, ControlSilent, ControlBusy, WrongFamily, ProtocolMismatch, Cancelled.
        """
        self._line.cancel = cancel
        try:
            return self._line.greet()
        except LinkError as error:
            failure: TransferError = NoConnection(f"no connection to the control ({error})")
        except Silence:
            failure = ControlSilent("the control does not answer")
        except Refusal as refusal:
            failure = error_of(refusal)
        self.close()
        raise failure

    def status(self) -> State:
        """Return the state of the control; raises TransferError."""
        return self._ask(lambda talk: talk.request(Status(), State))

    def restart(self) -> int:
        """Have the control restart and return the incarnation that ends; raises TransferError."""
        incarnation = self.hello().incarnation
        self._ask(lambda talk: talk.request(Restart(incarnation), Restarting))
        self.close()
        return incarnation

    def wait_restarted(
        self,
        incarnation: int,
        seconds: float,
        progress: Progress = quiet,
        cancel: threading.Event | None = None,
    ) -> Welcome | None:
        """Call the control until it answers with another incarnation; None when it has not after ``seconds``.

        Raises Cancelled and what tells that another control answers.
        """
        self._line.cancel = cancel
        self.close()
        start = self._line.now()
        while (gone := self._line.now() - start) < seconds:
            progress("restart", int(gone * 10), max(1, int(seconds * 10)))
            try:
                welcome = self._line.greet(tries=1)
            except (LinkError, Silence, Refusal):
                self.close()
            else:
                if welcome.incarnation != incarnation:
                    progress("restart", 1, 1)
                    return welcome
            self._line.pause(PAUSE)
        return None

    # -- images ------------------------------------------------------------------------------------

    def fetch(
        self, progress: Progress = quiet, cancel: threading.Event | None = None, stage: str = "upload"
    ) -> bytes:
        """Return the control's active image, checked against its digest; raises TransferError."""
        self._line.cancel = cancel
        return Fetching(self._line, progress, stage).run()

    def send(
        self,
        image: bytes,
        *,
        signature: str,
        expected: bytes,
        progress: Progress = quiet,
        cancel: threading.Event | None = None,
    ) -> Sent:
        """Have the control replace the image whose SHA-256 is ``expected`` by ``image``, all or nothing.

        Breaks off at ``cancel`` until the commit is asked for; from then on it sees the matter through.
        Raises TransferError, whose ``held`` says what the control holds.
        """
        return Sending(self._line, image, signature, expected, progress).run(cancel)

    def _ask(self, action: Callable[[Conversation], Result]) -> Result:
        try:
            return self._line.persist(action)
        except Refusal as refusal:
            raise error_of(refusal) from None
