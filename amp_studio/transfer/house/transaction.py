"""A conversation: numbered messages over one link, for as long as that link lives."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable

from amp_studio.transfer.links import Link

from .frame import FrameDecoder, encode_frame
from .message import AnyMessage, Code, Message, RefusalError, Refused, pack, unpack
from .retry_timer import RetryPolicy, RetryTimer

_SLICE = 0.1  # seconds a read may block before ``look`` is called again

# An unnumbered refusal: the control turns the line away before it was asked anything.
UNASKED = 0


class NoAnswerError(Exception):
    """The line is there, and nothing that could be understood came back on it."""


class Transaction:
    """Sends requests and finds their answers; drops what was damaged and what answers nothing.

    ``look`` is called at least every 0.1 s while waiting and may raise to break off. ``first`` is the first
    number given; a random one makes answers to an earlier program's requests miss.
    """

    def __init__(
        self,
        link: Link,
        clock: Callable[[], float],
        policy: RetryPolicy,
        *,
        first: int = 1,
        look: Callable[[], None],
    ) -> None:
        self.link = link
        self.pace = RetryTimer(policy)
        self._clock = clock
        self._poll = look
        self.next_number = 1 + first % 65_535
        self._decoder = FrameDecoder()
        self._received: deque[tuple[int, Message]] = deque()
        link.write(b"\x00")  # ends whatever the other end may have half received before

    def now(self) -> float:
        """Return the time in seconds."""
        return self._clock()

    def send(self, message: Message) -> int:
        """Send a message under a new number and return the number; raises LinkError."""
        number = self._number()
        self.link.write(encode_frame(pack(message, number)))
        return number

    def _number(self) -> int:
        number = self.next_number
        self.next_number = 1 + number % 65_535
        return number

    def receive(self, timeout: float) -> tuple[int, Message] | None:
        """Return the next message and its number, or None after ``timeout`` seconds; raises LinkError."""
        end = self._clock() + timeout
        while True:
            self._poll()
            if self._received:
                return self._received.popleft()
            left = end - self._clock()
            if left < 0:
                return None
            for frame in self._decoder.feed(self.link.read(min(left, _SLICE))):
                try:
                    self._received.append((frame.sequence, unpack(frame)))
                except RefusalError:
                    continue  # a later version's message: nothing here waits for it
            if left == 0 and not self._received:
                return None

    def request(
        self, message: Message, answer: type[AnyMessage], *, at_least: float = 0.0, tries: int = 0
    ) -> AnyMessage:
        """Send a request until it is answered.

        Repeats it under the same number, waiting twice as long each time and at first ``at_least`` seconds.
        Raises RefusalError when the control refuses, NoAnswerError when it never answers, LinkError.
        """
        # Only the answer to a request that was sent once is timed (Karn): after that it is unknown which
        # sending it answers, and a late answer to the first would make the timeouts too short for good.
        number = self._number()
        encoded = encode_frame(pack(message, number))
        for attempt in range(tries or self.pace.policy.tries):
            # The 00 in front parts a repeated request from one whose end was lost.
            self.link.write(b"\x00" + encoded if attempt else encoded)
            asked = self._clock()
            end = asked + max(self.pace.timeout, at_least * 2**attempt)
            while (left := end - self._clock()) > 0:
                found = self._answer(number, answer, left)
                if found is not None:
                    if attempt == 0:
                        self.pace.answered(self._clock() - asked)
                    return found
            self.pace.missed()
        raise NoAnswerError

    def _answer(self, number: int, kind: type[AnyMessage], timeout: float) -> AnyMessage | None:
        """Return the answer to a request; None for anything else that comes, or nothing."""
        received = self.receive(timeout)
        if received is None:
            return None
        sequence, message = received
        if isinstance(message, Refused):
            if sequence == number or (sequence == UNASKED and message.code == Code.BUSY):
                raise RefusalError(message.code, message.text)
        elif sequence == number and isinstance(message, kind):
            return message
        return None
