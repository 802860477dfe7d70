"""The retry timer learns from answers whose sending is known, and from no others (Karn's rule)."""

from collections.abc import Callable
from typing import Any

import pytest

from amp_studio.transfer.house.frame import FrameDecoder, encode_frame
from amp_studio.transfer.house.message import OpenUpload, UploadReady, pack
from amp_studio.transfer.house.retry_timer import RetryPolicy
from amp_studio.transfer.house.transaction import Transaction
from tests.transfer.null_modem import VirtualClock


class SlowLink:
    """Answers each request, on every sending, after ``delays`` in turn (None: not at all)."""

    bytes_per_second = None

    def __init__(self, clock: VirtualClock, delays: list[float | None]) -> None:
        self._clock = clock
        self._delays = iter(delays)
        self._decoder = FrameDecoder()
        self._out: list[tuple[float, bytes]] = []

    def write(self, data: bytes) -> None:
        for frame in self._decoder.feed(data):
            delay = next(self._delays)
            if delay is not None:
                answer = encode_frame(pack(UploadReady(2, bytes(32)), frame.sequence))
                self._out.append((self._clock.now + delay, answer))
                self._out.sort()

    def read(self, timeout: float) -> bytes:
        if self._out and self._out[0][0] <= self._clock.now + timeout:
            at, data = self._out.pop(0)
            self._clock.now = max(at, self._clock.now)
            return data
        self._clock.sleep(timeout)
        return b""

    def close(self) -> None:
        return


@pytest.fixture
def talk() -> Callable[..., Any]:
    """Give a function that starts a session with a link that answers after these delays."""

    def make(*delays: float | None) -> Transaction:
        clock = VirtualClock()
        return Transaction(SlowLink(clock, list(delays)), clock, RetryPolicy(), look=lambda: None)

    return make


def test_an_answer_to_the_only_sending_is_learnt_from(talk: Callable[..., Any]) -> None:
    session = talk(0.4)
    session.request(OpenUpload(), UploadReady)
    assert session.pace.timeout == pytest.approx(0.4 + 4 * 0.2)


def test_an_answer_to_a_repeated_request_teaches_nothing(talk: Callable[..., Any]) -> None:
    """It may answer the first sending or the second: timed from either, the next timeout would be wrong."""
    session = talk(None, 0.01)
    session.request(OpenUpload(), UploadReady)
    assert session.pace.timeout == pytest.approx(0.7 * 2), "still doubled, and nothing learnt"
    session = talk(0.2, None, 0.01)
    session.request(OpenUpload(), UploadReady)
    before = session.pace.timeout
    session.request(OpenUpload(), UploadReady)
    assert session.pace.timeout == pytest.approx(before * 2)


def test_a_late_answer_to_the_first_sending_does_not_shorten_the_timeouts(talk: Callable[..., Any]) -> None:
    """A control that takes 0.9 s: timed from the second sending it would seem to take 0.2 s, for good."""
    session = talk(0.9, 0.9, 0.9, 0.9)
    session.request(OpenUpload(), UploadReady)
    assert session.pace.timeout >= 0.9
    session.request(OpenUpload(), UploadReady)
    assert session.pace.timeout >= 0.9
