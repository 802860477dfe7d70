"""A control in a network shows its certificate and asks for its password, and who attacks either gets nothing and delays nobody."""

from __future__ import annotations

import contextlib
import select
import socket
import ssl
import sys
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest

from amp_studio.transfer.links import passwords
from amp_studio.transfer.links.endpoint import Endpoint, parse_endpoint
from amp_studio.transfer.links.link import Link, LinkError
from amp_studio.transfer.links.opening import connect, listen
from amp_studio.transfer.links.password import (
    GREETING,
    NO_TLS,
    Gate,
    GuardedLink,
    PasswordError,
    key_of,
    proof_of,
)
from amp_studio.transfer.links.secured import WAITING, SecuredListener, neighbourhood
from amp_studio.transfer.links.security import Security, exposure, read_password

HERE = Path(__file__).with_name("certificates")
PASSWORD = "correct horse"
CONTROL = Security("", HERE / "control.pem", HERE / "control.key")


@pytest.fixture(autouse=True)
def no_password_of_this_computer(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    monkeypatch.delenv(passwords.ENVIRONMENT, raising=False)
    monkeypatch.setitem(sys.modules, "keyring", None)
    monkeypatch.setattr("amp_studio.transfer.links.password.ROUNDS", 10)
    passwords.ask_with(None)
    yield
    passwords.ask_with(None)


@pytest.fixture
def echoing() -> Iterator[Callable[[str, Security], Endpoint]]:
    """Give a function that listens with some security and gives every caller back what it sends."""
    over = threading.Event()
    threads: list[threading.Thread] = []

    def start(address: str, security: Security) -> Endpoint:
        listener = listen(replace(parse_endpoint(address), security=security))

        def serve() -> None:
            lines: list[Link] = []
            while not over.is_set():
                if line := listener.accept(0.01):
                    lines.append(line)
                for each in list(lines):
                    try:
                        each.write(each.read(0))
                    except LinkError:
                        lines.remove(each)
            listener.close()
            for each in lines:
                each.close()

        threads.append(threading.Thread(target=serve))
        threads[-1].start()
        return listener.endpoint

    yield start
    over.set()
    for thread in threads:
        thread.join(60)


def echo(endpoint: Endpoint, data: bytes = b"\x00\xffframe") -> bytes:
    """Send and return what comes back; raises LinkError."""
    link = connect(endpoint)
    with contextlib.closing(link):
        link.write(data)
        got = b""
        while len(got) < len(data) and (came := link.read(5)):
            got += came
        return got


# -- TLS --------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("options", [f"ca={HERE / 'authority.pem'}", "fingerprint"])
def test_a_control_is_trusted_by_its_authority_or_its_fingerprint(
    echoing: Callable[[str, Security], Endpoint], options: str
) -> None:
    place = echoing("tls://127.0.0.1:0", CONTROL)
    assert len(place.fingerprint) == 64, "the control prints it, for whoever connects"
    if options != "fingerprint":
        place = parse_endpoint(f"tls://127.0.0.1:{place.port}?{options}")
    assert echo(place, bytes(range(256)) * 1000) == bytes(range(256)) * 1000


@pytest.mark.parametrize(
    ("options", "security", "said"),
    [
        ("", CONTROL, "its certificate is not trusted"),
        (f"?ca={HERE / 'authority.pem'}", Security("", HERE / "other.pem"), "its certificate is not trusted"),
        (f"?ca={HERE / 'other.pem'}", Security("", HERE / "other.pem"), r"not trusted \(IP address mismatch"),
        (
            f"?fingerprint=sha256:{'0' * 64}",
            CONTROL,
            "another certificate than the one with this fingerprint",
        ),
        ("?ca=/no/such/file", CONTROL, "No such file"),
        (f"?ca={HERE / 'control.key'}", CONTROL, "no certificate in it"),
    ],
)
def test_another_certificate_is_refused_before_anything_is_sent(
    echoing: Callable[[str, Security], Endpoint], options: str, security: Security, said: str
) -> None:
    place = echoing("tls://127.0.0.1:0", security)
    with pytest.raises(LinkError, match=said):
        connect(parse_endpoint(f"tls://127.0.0.1:{place.port}{options}"))


def test_tls_is_not_taken_away_by_who_answers_without_it(
    echoing: Callable[[str, Security], Endpoint],
) -> None:
    def talk(listening: socket.socket) -> None:
        with listening, listening.accept()[0] as client:
            client.sendall(b"welcome without TLS\n" * 20)
            client.recv(1)

    listening = socket.create_server(("127.0.0.1", 0))
    thread = threading.Thread(target=talk, args=[listening])
    thread.start()
    with pytest.raises(LinkError, match="does not speak TLS"):
        connect(parse_endpoint(f"tls://127.0.0.1:{listening.getsockname()[1]}?fingerprint=sha256:{'0' * 64}"))
    thread.join(60)
    place = echoing("tls://127.0.0.1:0", CONTROL)
    with pytest.raises(LinkError, match=r"closed the connection|broken off"):
        echo(parse_endpoint(f"tcp://127.0.0.1:{place.port}"), b"\x00frame\x00" * 100)


def test_old_versions_of_tls_are_refused(echoing: Callable[[str, Security], Endpoint]) -> None:
    place = echoing("tls://127.0.0.1:0", CONTROL)
    context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
    context.check_hostname, context.verify_mode = False, ssl.CERT_NONE
    context.set_ciphers("ALL:@SECLEVEL=0")
    context.minimum_version = ssl.TLSVersion.MINIMUM_SUPPORTED
    context.maximum_version = ssl.TLSVersion.TLSv1_1
    with (
        socket.create_connection(("127.0.0.1", place.port), timeout=60) as plain,
        pytest.raises(OSError, match=r"."),
    ):
        context.wrap_socket(plain)


@pytest.mark.parametrize(
    ("security", "said"),
    [
        (Security("", HERE / "missing.pem"), "cannot be read"),
        (Security("", HERE / "control.pem"), "cannot be used"),
        (Security("", HERE / "other.pem", HERE / "control.key"), "cannot be used"),
        (Security("", HERE / "control.pem", HERE / "locked.key"), "encrypted"),
    ],
)
def test_a_certificate_that_cannot_be_used_is_refused_at_the_start(security: Security, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        listen(replace(parse_endpoint("tls://127.0.0.1:0"), security=security))


@pytest.mark.parametrize(
    ("address", "security", "said"),
    [
        ("tls://127.0.0.1:0", Security(PASSWORD), "needs a certificate"),
        ("tcp://127.0.0.1:0", CONTROL, "write tls://"),
        ("pty:", Security(PASSWORD), "a serial line has no password"),
        ("rfc2217://127.0.0.1:1", Security(PASSWORD), "a serial line has no password"),
    ],
)
def test_security_that_does_not_fit_the_address_is_refused(
    address: str, security: Security, said: str
) -> None:
    with pytest.raises(LinkError, match=said):
        listen(replace(parse_endpoint(address), security=security))


# -- passwords --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:0", "tls://127.0.0.1:0"])
def test_the_password_comes_from_the_environment_the_keyring_or_the_person(
    echoing: Callable[[str, Security], Endpoint], address: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    security = replace(CONTROL, password=PASSWORD) if address.startswith("tls") else Security(PASSWORD)
    place = echoing(address, security)
    with pytest.raises(
        PasswordError, match="asks for a password: put it into AMP_STUDIO_PASSWORD or the system's keyring"
    ):
        echo(place)
    asked: list[str] = []

    def ask(where: str) -> str:
        asked.append(where)
        return PASSWORD

    passwords.ask_with(ask)
    assert echo(place) == echo(place) == b"\x00\xffframe", "asked once, what was written before is sent again"
    assert asked == [f"{place.kind}://127.0.0.1:{place.port}"]
    passwords.ask_with(None)
    kept = {("amp-studio", asked[0]): PASSWORD}
    monkeypatch.setitem(sys.modules, "keyring", SimpleNamespace(get_password=lambda *key: kept.get(key)))
    assert echo(place) == b"\x00\xffframe"
    kept.clear()
    monkeypatch.setenv(passwords.ENVIRONMENT, PASSWORD)
    assert echo(place, b"x" * 100_000) == b"x" * 100_000


@pytest.mark.parametrize("is_asked", [False, True])
def test_a_control_may_greet_as_soon_as_the_password_is_proven(
    is_asked: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    listener = listen(replace(parse_endpoint("tcp://127.0.0.1:0"), security=Security(PASSWORD)))
    over = threading.Event()

    def greet() -> None:
        while not over.is_set():
            if line := listener.accept(0.01):
                line.write(b"GrblHAL 1.1f ready\r\n")

    thread = threading.Thread(target=greet)
    thread.start()
    if is_asked:
        passwords.ask_with(lambda where: PASSWORD)
    else:
        monkeypatch.setenv(passwords.ENVIRONMENT, PASSWORD)
    link = connect(listener.endpoint)
    link.write(b"$I\n")
    assert link.read(5).startswith(b"GrblHAL")
    over.set()
    thread.join(60)
    link.close()
    listener.close()


def test_a_control_that_does_not_ask_for_a_known_password_is_not_spoken_to(
    echoing: Callable[[str, Security], Endpoint], monkeypatch: pytest.MonkeyPatch
) -> None:
    place = echoing("tcp://127.0.0.1:0", Security())
    assert echo(place) == b"\x00\xffframe"
    monkeypatch.setenv(passwords.ENVIRONMENT, PASSWORD)
    with pytest.raises(PasswordError, match="asks for no password, and one is set for it: nothing was sent"):
        connect(place, timeout=0.2)


def test_a_stranger_that_asks_for_the_password_learns_and_proves_nothing(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    heard = b""

    def pretend(listening: socket.socket) -> None:
        nonlocal heard
        with listening, listening.accept()[0] as client:
            client.sendall(GREETING + b"0" * 32 + b" " + b"1" * 64 + b"\n")
            heard = client.recv(1000)
            client.sendall(b"WELCOME " + b"2" * 64 + b"\n")
            client.recv(1)

    monkeypatch.setenv(passwords.ENVIRONMENT, PASSWORD)
    listening = socket.create_server(("127.0.0.1", 0))
    thread = threading.Thread(target=pretend, args=[listening])
    thread.start()
    with pytest.raises(PasswordError, match="does not know the password itself"):
        connect(parse_endpoint(f"tcp://127.0.0.1:{listening.getsockname()[1]}"))
    thread.join(60)
    assert heard.startswith(b"PROOF ")
    assert PASSWORD.encode() not in heard


def proof(challenge: bytes, password: str = PASSWORD, certificate: bytes = NO_TLS) -> bytes:
    """Return what a client answers to a challenge."""
    key = key_of(password, bytes.fromhex(challenge.split()[2].decode()))
    nonce = b"a" * 64
    return b"PROOF " + nonce + b" " + proof_of(key, b"client", challenge, certificate, nonce) + b"\n"


def test_a_proof_is_good_for_one_connection_one_certificate_and_one_direction() -> None:
    gate = Gate(PASSWORD)
    challenge = gate.challenge()
    good = proof(challenge)
    assert gate.answer("here", challenge, good, NO_TLS)[1]
    assert not gate.answer("a", gate.challenge(), good, NO_TLS)[1], "replayed on another connection"
    assert not gate.answer("b", challenge, good, b"x" * 32)[1], "passed on from another TLS connection"
    assert not gate.answer("c", challenge, proof(challenge, "Correct horse"), NO_TLS)[1]
    key = key_of(PASSWORD, bytes.fromhex(challenge.split()[2].decode()))
    reflected = b"PROOF " + b"a" * 64 + b" " + proof_of(key, b"server", challenge, NO_TLS, b"a" * 64) + b"\n"
    assert not gate.answer("d", challenge, reflected, NO_TLS)[1]


def test_who_guesses_waits_longer_each_time_and_nobody_else_does() -> None:
    now = 0.0
    gate = Gate(PASSWORD, clock=lambda: now)

    def answer(host: str, password: str) -> bytes:
        challenge = gate.challenge()
        return gate.answer(host, challenge, proof(challenge, password), NO_TLS)[0]

    tried = 0
    for _ in range(3600):
        now += 1
        tried += answer("attacker", "guess") == b"WRONG\n"
    assert tried < 120, "an hour of guesses"
    assert answer("attacker", PASSWORD).startswith(b"LATER "), "a right one is not told either"
    assert answer("person", PASSWORD).startswith(b"WELCOME ")
    now += 40
    assert answer("attacker", PASSWORD).startswith(b"WELCOME ")
    for number in range(2_000):
        answer(f"host {number}", "guess")
    assert len(gate._wrong) <= 256


@pytest.mark.parametrize(
    "said",
    [
        b"",
        b"\n",
        b"PROOF\n",
        b"x" * 100_000,
        b"\x16\x03\x01" + bytes(500),
        b"PROOF " + b"0" * 64 + b" " + b"0" * 64 + b"\nGET",
    ],
)
def test_who_does_not_prove_it_is_not_let_in_and_holds_nobody_up(
    echoing: Callable[[str, Security], Endpoint], said: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = echoing("tcp://127.0.0.1:0", Security(PASSWORD))
    with contextlib.ExitStack() as stack:
        for _ in range(40):  # more than may wait at once
            attacker = stack.enter_context(socket.create_connection(("127.0.0.1", place.port), timeout=60))
            with contextlib.suppress(OSError):
                attacker.sendall(said)
        monkeypatch.setenv(passwords.ENVIRONMENT, PASSWORD)
        if said.startswith(b"PROOF "):
            assert b"WRONG" in attacker.recv(1000) + attacker.recv(1000)
            return
        assert echo(place) == b"\x00\xffframe"


def _serve_nobody_until_it_hears(listener: SecuredListener, client: socket.socket) -> None:
    """Listen, and let nobody in, until there is something for a client to read, the end of the connection for one."""
    end = time.monotonic() + 60
    while not select.select([client], [], [], 0)[0]:
        assert listener.accept(0.05) is None
        assert time.monotonic() < end


def test_who_comes_right_behind_a_crowd_is_asked_too() -> None:
    listener = listen(replace(parse_endpoint("tcp://127.0.0.1:0"), security=Security(PASSWORD)))
    with contextlib.closing(listener), contextlib.ExitStack() as stack:
        *_, last = [
            stack.enter_context(socket.create_connection(("127.0.0.1", listener.endpoint.port), timeout=60))
            for _ in range(WAITING + 1)
        ]
        _serve_nobody_until_it_hears(listener, last)
        assert last.recv(1000).startswith(b"AMP-STUDIO-PASSWORD 1 ")


def test_a_handshake_that_is_never_ended_is_ended_by_the_control(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("amp_studio.transfer.links.secured.TIME_TO_ENTER", 0.1)
    listener = listen(replace(parse_endpoint("tls://127.0.0.1:0"), security=CONTROL))
    with socket.create_connection(("127.0.0.1", listener.endpoint.port), timeout=60) as client:
        _serve_nobody_until_it_hears(listener, client)
        assert client.recv(1) == b""
    listener.close()


def test_a_crowd_displaces_only_its_own() -> None:
    callers = [
        SimpleNamespace(peer=Endpoint("tcp", host=host)) for host in ("person", "crowd", "crowd", "crowd")
    ]
    listener = SecuredListener(SimpleNamespace(endpoint=Endpoint("tcp")), None, None)  # type: ignore[arg-type]
    listener._entering = [(caller, 0.0, iter(())) for caller in callers]  # type: ignore[misc]
    assert listener._most_numerous()[0] is callers[1]


def test_who_has_a_whole_network_of_addresses_is_one_who_guesses() -> None:
    assert neighbourhood("192.168.0.5") == neighbourhood("::ffff:192.168.0.5") == "192.168.0.5"
    assert neighbourhood("2001:db8::1") == neighbourhood("2001:db8::ffff:2%eth0") == "2001:db8::/64"
    assert neighbourhood("room") == "room"


def test_a_control_whose_first_words_begin_like_a_challenge_is_heard(monkeypatch: pytest.MonkeyPatch) -> None:
    class Card:
        bytes_per_second = None
        words = b"AMP"

        def read(self, timeout: float) -> bytes:
            data, self.words = self.words, b""
            return data

        def write(self, data: bytes) -> None: ...

        def close(self) -> None: ...

    link = GuardedLink(Card(), Card)
    assert link.read(0) == b"", "it may go on"
    monkeypatch.setattr("amp_studio.transfer.links.password.BEGINNING", -1.0)
    assert link.read(0) == b"AMP"
    assert link.read(0) == b""


# -- what a person does -----------------------------------------------------------------------------------------------


def test_a_password_file_has_it_in_its_first_line(tmp_path: Path) -> None:
    path = tmp_path / "password"
    path.write_bytes("größer als\r\nmore".encode())
    assert read_password(path) == "größer als"
    for content in (b"", b"short\n", b"\xff" * 20, b"x" * 2000):
        path.write_bytes(content)
        with pytest.raises(ValueError, match=r"first line"):
            read_password(path)


@pytest.mark.parametrize(
    ("host", "has_tls", "has_password", "said"),
    [
        ("127.0.0.1", False, False, ""),
        ("localhost", False, False, ""),
        ("::1", False, False, ""),
        ("0.0.0.0", True, True, ""),
        ("0.0.0.0", False, False, "without TLS and a password"),
        ("::", True, False, "without a password"),
        ("0.0.0.0", False, True, "without TLS"),
    ],
)
def test_who_listens_for_everybody_is_warned(host: str, has_tls: bool, has_password: bool, said: str) -> None:
    found = exposure(host, has_tls=has_tls, has_password=has_password)
    assert (said in found) if said else not found


def test_a_password_is_in_no_text() -> None:
    place = replace(parse_endpoint("tcp://127.0.0.1:1"), security=Security(PASSWORD))
    assert PASSWORD not in f"{place} {place!r} {place.security!r} {place.security}"
