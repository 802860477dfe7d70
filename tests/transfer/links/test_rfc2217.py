"""A port behind an RFC 2217 server is set and spoken over like an own one, and no server harms the client."""

import shutil
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import closing
from pathlib import Path

import pytest

from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.links.link import Link, LinkError
from amp_studio.transfer.links.opening import connect

from .ports import read_all, socat_pair

SERVER = Path(__file__).with_name("rfc2217_server.py")
OPTIONS = "baud=9600&bits=7&parity=even&stop=2&flow=rtscts"
ALL = bytes(range(256)) * 2


@pytest.fixture
def echoing() -> Iterator[subprocess.Popen[str]]:
    """Start pyserial's server for one client; its first line is the port."""
    process = subprocess.Popen([sys.executable, str(SERVER), "1"], stdout=subprocess.PIPE, text=True)
    yield process
    process.kill()
    process.communicate()


def test_settings_and_every_byte_reach_the_port_of_pyserials_own_server(
    echoing: subprocess.Popen[str],
) -> None:
    assert echoing.stdout is not None
    port = int(echoing.stdout.readline())
    link = connect(parse_endpoint(f"rfc2217://127.0.0.1:{port}?{OPTIONS}"))
    link.write(ALL)
    assert read_all(link, len(ALL)) == ALL, "IAC (255) is doubled on the way and single at its end"
    assert link.bytes_per_second == pytest.approx(9600 / 11)
    link.close()
    link.close()
    assert echoing.stdout.readline().split() == ["9600", "7", "E", "2", "False", "True"]
    with pytest.raises(LinkError, match="the port is closed"):
        link.read(0.1)
    with pytest.raises(LinkError, match="the port is closed"):
        link.write(b"x")


def test_a_real_ser2net_is_reached_and_sets_its_port(tmp_path: Path) -> None:
    ser2net = shutil.which("ser2net") or shutil.which("/usr/sbin/ser2net")
    if ser2net is None:
        pytest.skip("ser2net is not installed")
    with socat_pair(tmp_path) as (near, far), socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
        free.close()
        config = tmp_path / "ser2net.yaml"
        config.write_text(
            f"connection: &mill\n  accepter: telnet(rfc2217),tcp,127.0.0.1,{port}\n"
            f"  connector: serialdev,{near},115200n81,local\n",
            encoding="utf-8",
        )
        process = subprocess.Popen([ser2net, "-n", "-c", str(config), "-P", str(tmp_path / "pid")])
        try:
            link = _connected(f"rfc2217://127.0.0.1:{port}?baud=9600")
            with closing(link), far.open("r+b", buffering=0) as control:
                link.write(b"\xff\x11hello\x00")
                assert control.read(8) == b"\xff\x11hello\x00"
                control.write(b"answer\xff\xf0")
                assert read_all(link, 8) == b"answer\xff\xf0"
        finally:
            process.kill()
            process.wait()


def _connected(address: str) -> Link:
    end = time.monotonic() + 60
    while True:
        try:
            return connect(parse_endpoint(address))
        except LinkError as error:
            if "nothing listens" not in str(error) or time.monotonic() > end:
                raise


def _answers(serve: Callable[[socket.socket], None]) -> tuple[str, threading.Thread]:
    """Let a hostile server answer one client; return its address and its thread."""
    listening = socket.create_server(("127.0.0.1", 0))

    def run() -> None:
        with listening, listening.accept()[0] as client:
            client.settimeout(60)
            try:
                serve(client)
            except OSError:
                return

    thread = threading.Thread(target=run)
    thread.start()
    return f"rfc2217://127.0.0.1:{listening.getsockname()[1]}", thread


def _await_end(client: socket.socket) -> None:
    while client.recv(4096):
        pass


@pytest.mark.parametrize(
    "greeting",
    [
        pytest.param(b"login: ", id="another kind of server"),
        pytest.param(b"\xff\xf0" * 100, id="the end of no option"),
        pytest.param(b"\xff\xfa" + b"x" * 100_000, id="an option without end"),
        pytest.param(b"\xff\xfd\x2c\xff\xfb\x2c\xff\xfa\x2c\x65\xff\xf0", id="an empty answer"),
        pytest.param(b"", id="nothing"),
    ],
)
def test_what_is_no_rfc2217_server_is_refused_in_time(greeting: bytes) -> None:
    def serve(client: socket.socket) -> None:
        client.sendall(greeting)
        _await_end(client)

    address, thread = _answers(serve)
    with pytest.raises(LinkError, match=r"no answer in time|no RFC 2217 server|does not set the port"):
        connect(parse_endpoint(address), timeout=0.3)
    thread.join(60)
    assert not thread.is_alive(), "the connection was given up"


def test_the_opening_can_be_broken_off_at_once() -> None:
    address, thread = _answers(_await_end)

    def stop() -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        connect(parse_endpoint(address), look=stop)
    thread.join(60)


def test_a_flood_is_stored_no_further_than_is_read_and_the_end_of_a_line_is_met() -> None:
    sent = 4 * 65_536

    def serve(client: socket.socket) -> None:
        _agree(client)
        client.sendall(bytes(sent))

    address, thread = _answers(serve)
    link = connect(parse_endpoint(address))
    got = 0
    while got < sent:
        piece = link.read(2)
        assert 0 < len(piece) <= 65_536, "no more than is read at once"
        got += len(piece)
    with pytest.raises(LinkError, match="the server has closed the connection"):
        link.read(2)
    assert got == sent
    link.close()
    thread.join(60)


def _agree(client: socket.socket) -> None:
    """Agree to everything, as a server without a port would, until the client purges the second time."""
    purges, rest = 0, b""
    while purges < 2:
        rest += client.recv(4096)
        *whole, rest = rest.split(b"\xff\xf0")
        for each in whole:
            for at in range(len(each) - 2):
                if each[at] == 0xFF and each[at + 1] in (0xFB, 0xFD):
                    client.sendall(bytes([0xFF, {0xFB: 0xFD, 0xFD: 0xFB}[each[at + 1]], each[at + 2]]))
            option = each.partition(b"\xff\xfa")[2]
            if option:
                client.sendall(b"\xff\xfa\x2c" + bytes([option[1] + 100]) + option[2:] + b"\xff\xf0")
                purges += option[1] == 12
        if not whole and rest:
            client.sendall(b"\xff\xfd\x2c\xff\xfb\x2c")
