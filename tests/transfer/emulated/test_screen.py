"""The screen of an emulated control over its line, and who reads it there."""

import contextlib
import threading
from collections.abc import Iterator
from dataclasses import dataclass

import pytest

from amp_studio.transfer import ControlStatus
from amp_studio.transfer.client import StatusReader
from amp_studio.transfer.client.screen import read_status
from amp_studio.transfer.emulated.screen import open_screen, screen_status
from amp_studio.transfer.errors import NoConnectionError, ProtocolMismatchError
from amp_studio.transfer.links import parse_endpoint


@dataclass(frozen=True)
class Axis:
    letter: str = "X"
    position: float = 12.5
    following_error: float = 0.25
    velocity: float = 3.0
    unit: str = "mm"
    is_homed: bool = True
    is_busy: bool = True
    alarm: tuple[str, str] | None = None


FAULTED = Axis("Y", is_homed=False, is_busy=False, alarm=("EXCESS FOLLOWING ERROR", "0.6 mm"))
SHOWN = screen_status("9pc", "CNC_1", "moving", (Axis(), FAULTED))


@contextlib.contextmanager
def screen() -> Iterator[tuple[str, list[str]]]:
    """Serve a screen; yields its address and what its operator sees."""
    seen: list[str] = []
    stop = threading.Event()
    with contextlib.ExitStack() as stack:
        turn = open_screen(parse_endpoint("tcp://127.0.0.1:0"), lambda: SHOWN, seen.append, stack)

        def serve() -> None:
            while not stop.wait(0.002):
                turn()

        thread = threading.Thread(target=serve)
        thread.start()
        try:
            yield seen[0].removeprefix("screen at "), seen
        finally:
            stop.set()
            thread.join()


def test_a_screen_shows_positions_states_and_alarms_with_what_the_manual_has_about_them() -> None:
    assert SHOWN.axes[0].states == ("homed", "moving")
    fault = SHOWN.faults[0]
    assert (fault.axis, fault.code, fault.text) == ("Y", "EXCESS FOLLOWING ERROR", "0.6 mm")
    assert fault.cures
    assert fault.params


def test_a_screen_is_read_again_and_again_over_its_line_as_it_is() -> None:
    with screen() as (address, _), contextlib.closing(StatusReader(address)) as reader:
        assert reader.read() == SHOWN
        assert reader.read() == SHOWN


def test_who_comes_later_takes_the_line_over() -> None:
    with screen() as (address, _):
        first, second = StatusReader(address), StatusReader(address)
        first.read()
        assert second.read() == SHOWN
        with pytest.raises(NoConnectionError):
            first.read()
        first.close()
        second.close()


def test_a_control_that_shows_its_status_over_its_line_has_no_screen() -> None:
    seen: list[str] = []
    with contextlib.ExitStack() as stack:
        open_screen(parse_endpoint("tcp://127.0.0.1:0"), None, seen.append, stack)()
    assert seen == ["no screen: the status of this control is asked for over its line"]


@pytest.mark.parametrize("line", [b"", b"ok\n", b"{}\n", b'{"family": 1}\n', b"\xff\x00\n", b"[" * 50_000])
def test_what_is_no_status_is_refused_in_words(line: bytes) -> None:
    with pytest.raises(ProtocolMismatchError, match="no screen"):
        read_status(line)


def test_a_status_that_was_written_is_read() -> None:
    line = b'{"family": "num", "protocol": "screen", "name": "NUM", "state": "menu"}'
    assert read_status(line) == ControlStatus("num", "screen", "NUM", "menu")
