"""A wait on a line without frames has an end, shows silence, and ends at once for somebody who stops it."""

import threading

import pytest

from amp_studio.transfer.errors import CancelledError
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.waiting import OPERATOR, Waiting

from .null_modem import VirtualClock


class Silent:
    bytes_per_second = None

    def __init__(self, clock: VirtualClock) -> None:
        self.clock = clock

    def read(self, timeout: float) -> bytes:
        self.clock.sleep(timeout)
        return b"x" if self.clock.now > 4.05 else b""

    def write(self, data: bytes) -> None:
        raise AssertionError

    def close(self) -> None:
        raise AssertionError


def test_silence_is_shown_after_two_seconds_each_second_until_something_comes() -> None:
    clock, displayed = VirtualClock(), list[tuple[str, int, int]]()
    waiting = Waiting(clock, clock.sleep)
    waiting.begin(Exchange(lambda *event: displayed.append(event)))
    assert waiting.read(Silent(clock), 3) == b""
    assert displayed == [("silent", 2, 0), ("silent", 3, 0)]
    assert waiting.read(Silent(clock), 3) == b"x"
    waiting.note_answer()
    assert displayed[2:] == [("silent", 4, 0), ("silent", 0, 0)]


def test_a_user_who_stops_waits_no_longer_than_a_slice() -> None:
    clock, cancel = VirtualClock(), threading.Event()
    waiting = Waiting(clock, clock.sleep)
    waiting.begin(Exchange(lambda *_: cancel.set(), cancel))
    with pytest.raises(CancelledError):
        waiting.read(Silent(clock), 3)
    assert 1.8 <= clock.now < 2.1, "the first silence was shown, and there the person stopped"


def test_a_sentence_for_a_user_is_marked_as_one_and_whoever_fails_to_show_it_ends_nothing() -> None:
    displayed = list[tuple[str, int, int]]()

    def show(*event: object) -> None:
        displayed.append(event)
        raise OSError("nobody reads")

    waiting = Waiting(VirtualClock())
    waiting.begin(Exchange(show))
    waiting.ask("At the control: start")
    assert displayed == [("At the control: start", 0, OPERATOR)]
