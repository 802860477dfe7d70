"""Byte links over real sockets and pseudo terminals, and the faults that can be put on them."""

import os
import socket
from collections.abc import Callable, Iterator

import pytest

from amp_studio.transfer.emulated.faults import Faults, FaultyLine, read_faults
from amp_studio.transfer.links.endpoint import Endpoint, parse_endpoint
from amp_studio.transfer.links.link import Link, LinkError, Listener
from amp_studio.transfer.links.opening import connect, listen
from tests.transfer.links.ports import read_all

needs_pty = pytest.mark.skipif(not hasattr(os, "openpty"), reason="this system has no pseudo terminals")
KINDS = [pytest.param("tcp://127.0.0.1:0", id="tcp"), pytest.param("pty:", id="pty", marks=needs_pty)]


@pytest.fixture
def pair(request: pytest.FixtureRequest) -> Iterator[tuple[Listener, Link, Link]]:
    """Give a listener, the client's end and the control's end of a line of the kind asked for."""
    listener = listen(parse_endpoint(request.param))
    near = connect(listener.endpoint)
    far = listener.accept(5)
    assert far is not None
    yield listener, near, far
    for end in (near, far, listener):
        end.close()


@pytest.mark.parametrize("pair", KINDS, indirect=True)
def test_all_256_bytes_pass_both_ways(pair: tuple[Listener, Link, Link]) -> None:
    _, near, far = pair
    everything = bytes(range(256)) * 4
    near.write(everything)
    assert read_all(far, 1024) == everything
    far.write(everything)
    assert read_all(near, 1024) == everything


@pytest.mark.parametrize("pair", KINDS, indirect=True)
def test_nothing_to_read_is_no_fault(pair: tuple[Listener, Link, Link]) -> None:
    _, near, far = pair
    assert near.read(0.01) == b""
    assert far.read(0) == b""


@pytest.mark.parametrize("pair", KINDS, indirect=True)
def test_a_closed_end_is_a_fault_to_use(pair: tuple[Listener, Link, Link]) -> None:
    _, near, far = pair
    near.close()
    near.close()
    with pytest.raises(LinkError):
        near.read(0.1)
    with pytest.raises(LinkError):
        near.write(b"x")
    far.close()
    with pytest.raises(LinkError):
        far.read(0.1)


def test_the_other_end_of_a_tcp_line_notices_the_close() -> None:
    listener = listen(parse_endpoint("tcp://127.0.0.1:0"))
    near = connect(listener.endpoint)
    far = listener.accept(5)
    assert far is not None
    near.write(b"last words")
    near.close()
    assert read_all(far, 10) == b"last words"
    with pytest.raises(LinkError, match="closed the connection"):
        far.read(1)
    far.close()
    listener.close()


def test_a_tcp_listener_names_its_real_port_and_keeps_it_to_itself() -> None:
    listener = listen(parse_endpoint("tcp://127.0.0.1:0"))
    assert listener.endpoint.port > 0
    assert listener.accept(0) is None
    with pytest.raises(LinkError) as caught:
        listen(listener.endpoint)
    assert caught.value.endpoint == listener.endpoint
    listener.close()
    listen(listener.endpoint).close()


@pytest.mark.skipif(not socket.has_ipv6, reason="this system has no IPv6")
def test_ipv6_has_brackets() -> None:
    try:
        listener = listen(parse_endpoint("tcp://[::1]:0"))
    except LinkError:
        pytest.skip("IPv6 is switched off here")
    near = connect(listener.endpoint)
    near.close()
    assert str(listener.endpoint).startswith("tcp://[::1]:")
    listener.close()


@pytest.mark.parametrize(
    ("endpoint", "message"),
    [
        ("serial:/dev/no-such-port", "no such port"),
        ("tcp://host.invalid:7090", "not known"),
        ("pty:", "only be listened on"),
        (f"serial:/dev/{'x' * 5000}", r"^serial:/dev/x{188}: File name too long$"),
    ],
)
def test_what_cannot_be_opened_shows_why(endpoint: str, message: str) -> None:
    with pytest.raises(LinkError, match=message):
        connect(parse_endpoint(endpoint))


def test_nothing_listens_there() -> None:
    listener = listen(parse_endpoint("tcp://127.0.0.1:0"))
    endpoint = listener.endpoint
    listener.close()
    with pytest.raises(LinkError, match="nothing listens there"):
        connect(endpoint)


@needs_pty
def test_a_serial_port_serves_one_program_and_outlives_it() -> None:
    listener = listen(parse_endpoint("pty:"))
    first = connect(listener.endpoint)
    with pytest.raises(LinkError, match="another program"):
        connect(listener.endpoint)
    first.close()
    connect(listener.endpoint).close()
    line = listener.accept(0)
    assert line is not None
    assert listener.accept(0) is None, "nobody connects to a serial port that is in use"
    line.close()
    assert listener.accept(0) is not None
    listener.close()


@needs_pty
def test_a_control_can_be_listened_for_at_a_serial_port() -> None:
    """The port is one end of a pseudo terminal here; its other end is in the place of the cable."""
    cable = listen(parse_endpoint("pty:"))
    port = listen(cable.endpoint)
    assert port.endpoint == Endpoint("serial", device=cable.endpoint.device)
    far, near = cable.accept(0), port.accept(0)
    assert far is not None
    assert near is not None
    far.write(b"\x00\x13\x11\xff")
    assert read_all(near, 4) == b"\x00\x13\x11\xff", "no flow control takes bytes out"
    assert port.accept(0) is None
    near.close()
    again = port.accept(0)
    assert again is not None, "the port is opened again after a restart"
    again.close()
    port.close()
    cable.close()


@needs_pty
def test_bytes_that_are_not_read_are_lost_as_on_a_cable_that_is_out(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("amp_studio.transfer.links.pseudo_terminal.WRITE_LIMIT", 0.05)
    listener = listen(parse_endpoint("pty:"))
    far = listener.accept(0)
    assert far is not None
    far.write(bytes(100_000))
    listener.close()


class Loop:
    """A link that gives back what is written to it."""

    bytes_per_second = None

    def __init__(self) -> None:
        self.received = b""

    def read(self, timeout: float) -> bytes:
        data, self.received = self.received, b""
        return data

    def write(self, data: bytes) -> None:
        self.received += data

    def close(self) -> None:
        self.received = b""


def test_a_line_is_cut_after_so_many_bytes_and_only_so_often() -> None:
    line = FaultyLine(Faults(drop_after_bytes=10, drops=1))
    link = line.wrap(Loop())
    link.write(b"123456")
    assert link.read(0) == b"1234"
    with pytest.raises(LinkError, match="cut on purpose"):
        link.read(0)
    with pytest.raises(LinkError, match="cut on purpose"):
        link.write(b"x")
    whole = line.wrap(Loop())
    whole.write(b"x" * 100)
    assert whole.read(0) == b"x" * 100


@pytest.mark.parametrize(
    ("faults", "expected"),
    [
        (Faults(), bytes(9)),
        (Faults(lose_every=4), bytes(7)),
        (Faults(corrupt_every=4), b"\x00\x00\x00\x10\x00\x00\x00\x01\x00"),
        (Faults(silent=True), b""),
    ],
)
def test_bytes_change_and_vanish_on_their_turn(faults: Faults, expected: bytes) -> None:
    loop = Loop()
    link = FaultyLine(faults).wrap(loop)
    for _ in range(9):
        link.write(b"\x00")
    assert loop.received == expected, "however the bytes are cut into pieces"


def test_faults_are_read_from_json() -> None:
    assert read_faults('{"corrupt_every": 7, "silent": true}') == Faults(corrupt_every=7, silent=True)


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "[" * 100_000,
        '{"drops": ' * 100_000,
        '{"rain": 1}',
        '{"silent": 1}',
        '{"drops": true}',
        '{"drops": -1}',
        '{"drops": "2"}',
    ],
)
def test_faults_that_do_not_exist_are_refused(text: str) -> None:
    with pytest.raises(ValueError, match="fault") as caught:
        read_faults(text)
    assert len(str(caught.value)) < 200


def test_a_link_of_every_kind_has_the_same_face(checkout: object, rig: Callable[..., object]) -> None:
    link: Link = rig().open_link()
    assert link.bytes_per_second is None
    link.close()
