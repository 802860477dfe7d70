"""Images in both directions: pieces in a sliding window over one conversation.

Neither function knows of reconnecting; what they have done so far is kept by
the control (``push``) or by the caller (``pull``), who can call again.
"""

from __future__ import annotations

import math
from collections.abc import Callable

from .message import Ack, Data, Gap, Message, Read, RefusalError, Refused
from .transaction import NoAnswerError, Transaction
from .window import Window

Done = Callable[[int], None]

# What may be under way on a line of known rate, in seconds of its rate: more would only wait in buffers,
# and a cancel would wait behind it.
_BACKLOG = 0.3

# Bytes of an image that may be under way, whatever window a control offers.
MAX_FLYING = 1 << 16

# Answers in a row that bring nothing forward: a control that gives that many does not keep to the protocol.
_USELESS = 2_000


def window_limit(chunk: int, offered: int, bytes_per_second: float | None) -> int:
    """Return how many pieces may be under way: what the control offers, fewer where they are large or the
    line is slow.
    """
    offered = min(offered, MAX_FLYING // chunk)
    if bytes_per_second is None:
        return max(1, offered)
    return max(1, min(offered, max(2, math.ceil(bytes_per_second * _BACKLOG / chunk))))


def push(transaction: Transaction, image: bytes, offset: int, chunk: int, limit: int, done: Done) -> None:
    """Send ``image`` from ``offset`` on until the control has staged it all.

    ``done`` is called with how many bytes are staged. Raises RefusalError, NoAnswerError, LinkError.
    """
    window = Window(offset, len(image), chunk, limit)
    staged = offset

    def send(at: int, length: int) -> int:
        return transaction.send(Data(at, image[at : at + length]))

    def answer(number: int, message: Message) -> bool:
        nonlocal staged
        if not isinstance(message, Ack | Gap) or not window.knows(number) or message.next > len(image):
            return False
        new = isinstance(message, Ack) and _measure_round_trip(transaction, window, number)
        if isinstance(message, Gap):
            window.refused(number)
        window.reached(message.next)
        if message.next <= staged:
            return new
        staged = message.next
        done(staged)
        return True

    _run(transaction, window, send, answer)


def pull(
    transaction: Transaction, size: int, chunk: int, limit: int, pieces: dict[int, bytes], done: Done
) -> None:
    """Read the ``size`` bytes of an opened upload into ``pieces`` (offset to bytes); what is there is not
    read again.

    ``done`` is called with how many bytes are there. Raises RefusalError, NoAnswerError, LinkError.
    """
    window = Window(0, size, chunk, limit)
    for at in pieces:
        window.have(at)
    received = sum(map(len, pieces.values()))

    def send(at: int, length: int) -> int:
        return transaction.send(Read(at, length))

    def answer(number: int, message: Message) -> bool:
        nonlocal received
        piece = window.flying(number)
        if not isinstance(message, Data) or piece is None:
            return False
        if (message.offset, len(message.content)) != (piece.offset, piece.length):
            return False
        _measure_round_trip(transaction, window, number)
        pieces[piece.offset] = message.content
        received += piece.length
        done(received)
        return True

    _run(transaction, window, send, answer)


def _run(
    transaction: Transaction,
    window: Window,
    send: Callable[[int, int], int],
    answer: Callable[[int, Message], bool],
) -> None:
    """Keep the window full until every piece has arrived; ``answer`` returns whether it was a step
    forward.
    """
    missed = useless = 0
    while not window.is_done:
        while (piece := window.next_piece()) is not None:
            number = send(*piece)
            window.sent(number, *piece, transaction.now())
        received = transaction.receive(_patience(transaction, window))
        forward = False
        if received is not None:
            number, message = received
            if isinstance(message, Refused) and window.flying(number) is not None:
                raise RefusalError(message.code, message.text)
            forward = answer(number, message)
            useless += 1
            if useless > _USELESS:
                raise NoAnswerError
        if forward:
            missed = useless = 0
        elif _patience(transaction, window) <= 0:  # whatever else has come in the meantime
            missed += 1
            if missed >= transaction.pace.policy.tries:
                raise NoAnswerError
            transaction.pace.missed()
            window.lose_all()


def _patience(transaction: Transaction, window: Window) -> float:
    """Return the seconds until the oldest piece under way counts as lost."""
    oldest = window.oldest
    if oldest is None:
        return 0.0
    rate = transaction.link.bytes_per_second
    on_the_line = window.bytes_flying / rate if rate else 0.0
    return oldest + transaction.pace.timeout + on_the_line - transaction.now()


def _measure_round_trip(transaction: Transaction, window: Window, number: int) -> bool:
    piece = window.arrived(number)
    if piece is None:
        return False
    transaction.pace.answered(transaction.now() - piece.sent_at)
    return True
