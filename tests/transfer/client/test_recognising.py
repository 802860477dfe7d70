"""A control whose family nobody has named is known by its answer,
and nothing is sent to it that acts on a machine.
"""

import socket
import threading
from collections.abc import Callable, Iterator
from contextlib import closing, suppress

import pytest

import amp_studio
from amp_studio.transfer.client import drivers
from amp_studio.transfer.client.drivers import open_driver_at
from amp_studio.transfer.errors import CancelledError, TransferError
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.house.connection import ACTS_ON_GRBL
from amp_studio.transfer.progress import Stop
from tests.campaigns import some


class Machine:
    """What answers each byte that comes with a text; ``heard`` is all that was sent to it."""

    def __init__(self, answer: bytes) -> None:
        self.heard = b""
        self._answer = answer
        self._socket = socket.create_server(("127.0.0.1", 0))
        self.address = f"tcp://127.0.0.1:{self._socket.getsockname()[1]}"
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self) -> None:
        try:
            while True:
                line, _ = self._socket.accept()
                with line:
                    while data := line.recv(100):
                        self.heard += data
                        line.sendall(self._answer)
        except OSError:
            return

    def close(self) -> None:
        """Hang up."""
        self._socket.close()


@pytest.fixture
def impatient(monkeypatch: pytest.MonkeyPatch) -> None:
    """Give a machine that is at the line but never answers a second, not twelve."""
    monkeypatch.setattr("amp_studio.families.grblhal.line.START", 1.0)


@pytest.fixture
def machine() -> Iterator[Callable[[bytes], Machine]]:
    """Return what starts a machine."""
    started: list[Machine] = []

    def start(answer: bytes) -> Machine:
        started.append(Machine(answer))
        return started[-1]

    yield start
    for each in started:
        each.close()


@pytest.mark.parametrize(
    "answer",
    [
        b"<Idle|MPos:0.000,0.000,0.000|FS:0,0>\r\n",
        b"<Alarm|WPos:1,2,3>",
        b"\r\nGrblHAL 1.1f ['$' or '$HELP' for help]\r\n",
    ],
)
def test_a_grbl_is_known_by_its_status_report_or_its_greeting(
    machine: Callable[[bytes], Machine], answer: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(drivers, "RECOGNISED", 10.0)
    grbl = machine(answer)
    with closing(open_driver_at(grbl.address)) as driver:
        assert type(driver).__name__ == "GrblDriver"
    assert set(grbl.heard) == set(b"?")


@pytest.mark.usefixtures("impatient")
@pytest.mark.parametrize("ask", ["status", "identify", "look"])
def test_a_grbl_that_moves_is_asked_without_a_reset(machine: Callable[[bytes], Machine], ask: str) -> None:
    """A frame of the house protocol contains 0x18, which stops the axes where they are."""
    grbl = machine(b"<Jog|MPos:2.401,0.000,0.000|FS:415,0>\r\n")
    with suppress(TransferError), amp_studio.connect(grbl.address) as control:
        getattr(control, ask)()
    assert grbl.heard.startswith(b"?")
    assert not ACTS_ON_GRBL & set(grbl.heard)


@pytest.mark.parametrize("ask", some(["fetch", "status", "look", "identify"]))  # 5 s each
def test_a_grbl_that_is_taken_for_another_family_goes_on(
    machine: Callable[[bytes], Machine], ask: str
) -> None:
    grbl = machine(b"error:3\r\n")
    with suppress(TransferError), amp_studio.connect(grbl.address, "9pc") as control:
        getattr(control, ask)()
    assert b"AMP Studio" in grbl.heard
    assert not ACTS_ON_GRBL & set(grbl.heard)


@pytest.mark.parametrize(
    "answer", [b"", b"P00>?", b"<html>", b"\0\xff"], ids=["silent", "ACR", "web server", "binary"]
)
def test_what_answers_otherwise_is_left_to_the_house_protocol(
    machine: Callable[[bytes], Machine], answer: bytes
) -> None:
    other = machine(answer)
    with closing(open_driver_at(other.address)) as driver:
        assert type(driver).__name__ == "HouseDriver"
    assert set(other.heard) == set(b"?"), "nothing else goes to a control that is not known yet"


def test_nothing_is_asked_where_the_protocol_or_the_family_is_named(
    machine: Callable[[bytes], Machine],
) -> None:
    named = machine(b"<Idle|")
    for address, family in ((f"{named.address}?protocol=house", ""), (named.address, "num")):
        with closing(open_driver_at(address, family)) as driver:
            assert type(driver).__name__ == "HouseDriver"
    assert named.heard == b""


def test_finding_out_can_be_stopped(machine: Callable[[bytes], Machine]) -> None:
    silent, stop = machine(b""), Stop()
    stop.set()
    with pytest.raises(CancelledError):
        open_driver_at(silent.address, "", Exchange(cancel=stop))


def test_a_control_that_is_not_there_is_left_to_its_driver() -> None:
    with closing(open_driver_at("tcp://127.0.0.1:1")) as driver:
        assert type(driver).__name__ == "HouseDriver"
