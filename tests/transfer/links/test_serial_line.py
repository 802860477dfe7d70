"""A serial port is set as it was asked for, belongs to one program,
and is missed at once when it is pulled out.
"""

import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest

from amp_studio.transfer.links.endpoint import Endpoint, parse_endpoint
from amp_studio.transfer.links.link import LinkError
from amp_studio.transfer.links.opening import connect
from amp_studio.transfer.links.serial_line import FLOW_LIMIT, SerialLink, open_port

from .ports import read_all, socat_pair

pytestmark = pytest.mark.skipif(not hasattr(os, "openpty"), reason="this system has no pseudo terminals")

XON, XOFF = b"\x11", b"\x13"


@pytest.fixture
def port() -> Iterator[tuple[int, str]]:
    """Give the control's end of a pseudo terminal as a handle, and the name of the port of the other end."""
    master, slave = os.openpty()
    yield master, os.ttyname(slave)
    for handle in (master, slave):
        os.close(handle)


@pytest.mark.parametrize(
    ("options", "expected"),
    [
        (
            "",
            {
                "baudrate": 115_200,
                "bytesize": 8,
                "parity": "N",
                "stopbits": 1,
                "xonxoff": False,
                "rtscts": False,
            },
        ),
        (
            "?baud=9600&bits=7&parity=even&stop=2&flow=xonxoff",
            {"baudrate": 9600, "bytesize": 7, "parity": "E", "stopbits": 2, "xonxoff": True, "rtscts": False},
        ),
        (
            "?parity=odd&flow=rtscts",
            {
                "baudrate": 115_200,
                "bytesize": 8,
                "parity": "O",
                "stopbits": 1,
                "xonxoff": False,
                "rtscts": True,
            },
        ),
    ],
)
def test_pyserial_opens_the_port_for_one_program_with_these_settings(
    monkeypatch: pytest.MonkeyPatch, port: tuple[int, str], options: str, expected: dict[str, Any]
) -> None:
    asked: dict[str, Any] = {}

    def open_it(device: str, **settings: Any) -> object:
        asked.update(settings, device=device)
        return SimpleNamespace(reset_input_buffer=lambda: None, fileno=lambda: port[0])

    monkeypatch.setattr("serial.Serial", open_it)
    open_port(parse_endpoint(port[1] + options))
    assert expected.items() <= asked.items()
    assert asked["exclusive"] is True
    assert asked["device"] == port[1]


def test_flow_control_of_the_port_waits_for_xon_and_can_be_broken_off(
    port: tuple[int, str], monkeypatch: pytest.MonkeyPatch
) -> None:
    looked: list[float] = []
    link = connect(parse_endpoint(f"{port[1]}?flow=xonxoff"), look=lambda: looked.append(time.monotonic()))
    link.write(b"before")
    assert os.read(port[0], 100) == b"before"
    os.write(port[0], XOFF)
    monkeypatch.setattr(link, "_flow_limit", 0.3)
    with pytest.raises(LinkError, match=r"the other end has taken nothing for 0\.3 s"):
        link.write(bytes(100_000))
    assert len(looked) >= 3, "whoever waits can break it off"
    assert link.read(0) == b"", "Xoff is no data here"
    link.close()


def test_a_driver_that_reads_xoff_itself_gets_it_as_a_byte_and_writes_on(port: tuple[int, str]) -> None:
    link = connect(parse_endpoint(f"{port[1]}?flow=xonxoff"), own_flow=True)
    os.write(port[0], b"P0" + XOFF + XON)
    assert read_all(link, 4) == b"P0" + XOFF + XON
    link.write(b"after")
    assert os.read(port[0], 100) == b"after"
    link.close()


def test_a_second_program_gets_one_sentence(port: tuple[int, str]) -> None:
    first = connect(parse_endpoint(port[1]))
    with pytest.raises(LinkError) as caught:
        connect(parse_endpoint(port[1]))
    assert str(caught.value) == f"serial:{port[1]}: another program has this port open"
    first.close()
    connect(parse_endpoint(port[1])).close()


@pytest.mark.parametrize(
    "use", [lambda link: link.read(20), lambda link: link.write(b"x" * 1000)], ids=["read", "write"]
)
def test_a_pulled_adapter_is_missed_at_once(tmp_path: Path, use: Callable[[Any], object]) -> None:
    with socat_pair(tmp_path) as (near, _):
        link = connect(parse_endpoint(f"serial:{near}"))
        assert link.read(0) == b""
    start = time.monotonic()
    with pytest.raises(LinkError, match=r"near: the port is gone: its adapter was unplugged or switched off"):
        use(link)
    assert time.monotonic() - start < 10, "not the 20 s that a silence is waited for"
    link.close()
    with pytest.raises(LinkError, match="there is no such port"):
        connect(parse_endpoint(f"serial:{near}"))
    with socat_pair(tmp_path) as (near, far):
        again = connect(parse_endpoint(f"serial:{near}"))
        with far.open("wb", buffering=0) as control:
            control.write(b"back")
        assert read_all(again, 4) == b"back"
        again.close()


def test_a_look_that_breaks_off_is_not_taken_for_a_fault_of_the_port(port: tuple[int, str]) -> None:
    def stop() -> None:
        raise ConnectionError("stopped")

    link = connect(parse_endpoint(port[1]), look=stop)
    with pytest.raises(ConnectionError, match="stopped"):
        link.write(b"x")
    link.close()


def test_the_rate_of_a_line_counts_every_bit_of_a_byte() -> None:
    link = SerialLink(Endpoint("serial", device="COM3", baud=9600, bits=7, parity="even", stop=2), None)
    assert link.bytes_per_second == pytest.approx(872.7, abs=0.1)


def test_closing_a_kept_line_does_not_wait_for_it_and_a_free_one_keeps_what_was_written(
    port: tuple[int, str],
) -> None:
    free = connect(parse_endpoint(f"{port[1]}?flow=xonxoff"))
    free.write(b"last words")
    free.close()
    assert os.read(port[0], 100) == b"last words"
    content = connect(parse_endpoint(f"{port[1]}?flow=xonxoff"))
    os.write(port[0], XOFF)
    start = time.monotonic()
    content.close()
    assert time.monotonic() - start < 10, "not the 30 s that a port is given to send the rest"


def test_what_a_port_has_not_sent_yet_is_waited_for(monkeypatch: pytest.MonkeyPatch) -> None:
    waiting, flushed = [30, 20, 10, 0], list[bool]()

    class Slow:
        @property
        def out_waiting(self) -> int:
            return waiting.pop(0) if len(waiting) > 1 else waiting[0]

        def reset_output_buffer(self) -> None:
            flushed.append(True)

        def close(self) -> None: ...

    link = SerialLink(parse_endpoint("COM3?flow=rtscts"), Slow())
    link.drain()
    assert waiting == [0]
    waiting[:] = [5]
    monkeypatch.setattr(link, "_flow_limit", 0.1)
    with pytest.raises(LinkError, match=r"has taken nothing for 0\.1 s"):
        link.drain()
    waiting[:] = [9, 9, 9, 5, 5, 0]
    monkeypatch.setattr(link, "_flow_limit", FLOW_LIMIT)
    link.close()
    assert (waiting, flushed) == ([0], [])
    content = SerialLink(parse_endpoint("COM3?flow=rtscts"), Slow())
    waiting[:] = [7]
    content.close()
    assert flushed == [True], "the system would wait for half a minute"
