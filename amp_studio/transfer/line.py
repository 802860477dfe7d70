"""The line to one control, made again whenever it is cut, until patience ends."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Callable
from typing import TypeVar

from .conversation import Conversation, Silence
from .errors import (
    Cancelled,
    ControlBusy,
    ControlSilent,
    Held,
    LineCut,
    ProtocolMismatch,
    TransferError,
    WrongFamily,
)
from .link import Link, LinkError
from .message import MAX_CHUNK, PROTOCOL_VERSION, Code, Hello, Refusal, Welcome
from .pace import Limits
from .streaming import window_limit

Result = TypeVar("Result")

PAUSE = 0.2  # seconds before a cut line is tried again; each pause is half as long again as the last,
LONGEST_PAUSE = 2.0  # up to this
SLICE = 0.1  # seconds a pause may last before the cancel event is looked at again


class Line:
    """Conversations with one control, one after the other; ``welcome`` is what it said last about itself.

    ``cancel`` may be set from another thread; then whatever waits here raises Cancelled.
    """

    def __init__(
        self,
        open_link: Callable[[], Link],
        *,
        family: str,
        client: str,
        patience: float,
        limits: Limits,
        clock: Callable[[], float],
        sleep: Callable[[float], None],
        random_bytes: Callable[[int], bytes],
    ) -> None:
        self.cancel: threading.Event | None = None
        self.welcome: Welcome | None = None
        self.reconnections = 0
        self.now = clock
        self.random = random_bytes
        self._open_link = open_link
        self._family = family
        self._client = client
        self._patience = patience
        self._limits = limits
        self._sleep = sleep
        self._talk: Conversation | None = None
        self._moved_at = clock()

    def close(self) -> None:
        """Hang up."""
        if self._talk is not None:
            self._talk.link.close()
            self._talk = None

    def greet(self, tries: int = 3) -> Welcome:
        """Say Hello on the line there is, or on a new one.

        Raises LinkError, Silence, Refusal; WrongFamily and ProtocolMismatch, after which the line is closed.
        """
        talk = self._talk
        if talk is None:
            first = int.from_bytes(self.random(2), "little")
            talk = Conversation(self._open_link(), self.now, self._limits, first=first, look=self._look)
            self._talk = talk
        nonce = self.random(4)
        welcome = talk.request(Hello(PROTOCOL_VERSION, nonce, self._client), Welcome, tries=tries)
        if welcome.nonce != nonce:
            raise Silence
        if welcome.version != PROTOCOL_VERSION or not 1 <= welcome.chunk <= MAX_CHUNK or welcome.window < 1:
            self.close()
            raise ProtocolMismatch(
                "the control answers in a way that version 1 of the protocol does not know"
            )
        if self.welcome is not None and _identity(welcome) != _identity(self.welcome):
            self.close()
            raise ProtocolMismatch(f"another control answers on this line than before: '{welcome.name}'")
        if self._family and welcome.family != self._family:
            self.close()
            raise WrongFamily(f"the control is a {welcome.family}, not a {self._family}")
        self.welcome = welcome
        return welcome

    def persist(
        self, action: Callable[[Conversation], Result], held: Callable[[], Held] = lambda: "old"
    ) -> Result:
        """Run ``action`` to its end, on as many lines as it takes.

        ``held`` says what the control holds should no line come back. Raises Refusal, LineCut, ControlSilent,
        ControlBusy.
        """
        self._moved_at = self.now()
        pause = PAUSE
        while True:
            try:
                if self._talk is None:
                    self.greet()
                    self.reconnections += 1
                assert self._talk is not None
                return action(self._talk)
            except (LinkError, Silence) as error:
                cause: Exception = error
            except Refusal as refusal:
                if refusal.code != Code.BUSY:
                    raise
                cause = refusal
            self.close()
            if self.now() - self._moved_at >= self._patience:
                raise self._gave_up(cause, held()) from cause
            self.pause(pause, held)
            pause = min(pause * 1.5, LONGEST_PAUSE)

    def once(self, action: Callable[[Conversation], object]) -> None:
        """Run ``action`` if there is a line, whether or not it succeeds, and hang up."""
        if self._talk is not None:
            with contextlib.suppress(LinkError, Silence, Refusal):
                action(self._talk)
        self.close()

    def moved(self) -> None:
        """Something got further: patience begins anew."""
        self._moved_at = self.now()

    def sizes(self, talk: Conversation) -> tuple[int, int]:
        """Return the length of a chunk in bytes and how many may be under way."""
        assert self.welcome is not None
        chunk = self.welcome.chunk
        return chunk, window_limit(chunk, self.welcome.window, talk.link.bytes_per_second)

    def pause(self, seconds: float, held: Callable[[], Held] = lambda: "old") -> None:
        """Wait; raises Cancelled."""
        end = self.now() + seconds
        while (left := end - self.now()) > 0:
            if self.cancel is not None and self.cancel.is_set():
                raise Cancelled("cancelled", held())
            self._sleep(min(left, SLICE))

    def _look(self) -> None:
        if self.cancel is not None and self.cancel.is_set():
            raise Cancelled("cancelled")

    def _gave_up(self, cause: Exception, held: Held) -> TransferError:
        waited = f"for {self._patience:g} s"
        if isinstance(cause, LinkError):
            return LineCut(
                f"the line to the control is cut and could not be made again {waited} ({cause})", held
            )
        if isinstance(cause, Refusal):
            return ControlBusy(f"another client has had the control {waited}", held)
        return ControlSilent(f"the control has not answered {waited}", held)


def _identity(welcome: Welcome) -> tuple[str, str, str]:
    return welcome.family, welcome.signature, welcome.name
