"""A control asks for its password, and who attacks it gets nothing and delays nobody."""

import contextlib
import select
import socket
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace

import pytest

from amp_studio.transfer.links import passwords
from amp_studio.transfer.links.endpoint import Endpoint, parse_endpoint
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
from amp_studio.transfer.links.security import Security

from .secured import CONTROL, PASSWORD, echo


@pytest.mark.parametrize("address", ["tcp://127.0.0.1:0", "tls://127.0.0.1:0"])
def test_the_password_comes_from_the_environment_the_keyring_or_the_user(
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


def test_who_guesses_waits_longer_each_time_and_others_do_not() -> None:
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
    "message",
    [
        b"",
        b"\n",
        b"PROOF\n",
        b"x" * 100_000,
        b"\x16\x03\x01" + bytes(500),
        b"PROOF " + b"0" * 64 + b" " + b"0" * 64 + b"\nGET",
    ],
)
def test_who_does_not_prove_it_is_not_let_in_and_delays_no_other(
    echoing: Callable[[str, Security], Endpoint], message: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = echoing("tcp://127.0.0.1:0", Security(PASSWORD))
    with contextlib.ExitStack() as stack:
        for _ in range(40):  # more than may wait at once
            attacker = stack.enter_context(socket.create_connection(("127.0.0.1", place.port), timeout=60))
            with contextlib.suppress(OSError):
                attacker.sendall(message)
        monkeypatch.setenv(passwords.ENVIRONMENT, PASSWORD)
        if message.startswith(b"PROOF "):
            assert b"WRONG" in attacker.recv(1000) + attacker.recv(1000)
            return
        assert echo(place) == b"\x00\xffframe"


def _serve_no_client_until_it_hears(listener: SecuredListener, client: socket.socket) -> None:
    """Listen, and let nobody in, until there is something for a client to read,
    the end of the connection for one.
    """
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
        _serve_no_client_until_it_hears(listener, last)
        assert last.recv(1000).startswith(b"AMP-STUDIO-PASSWORD 1 ")


def test_a_handshake_that_is_never_ended_is_ended_by_the_control(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("amp_studio.transfer.links.secured.TIME_TO_ENTER", 0.1)
    listener = listen(replace(parse_endpoint("tls://127.0.0.1:0"), security=CONTROL))
    with socket.create_connection(("127.0.0.1", listener.endpoint.port), timeout=60) as client:
        _serve_no_client_until_it_hears(listener, client)
        assert client.recv(1) == b""
    listener.close()


def test_a_crowd_displaces_only_its_own() -> None:
    callers = [
        SimpleNamespace(peer=Endpoint("tcp", host=host)) for host in ("person", "crowd", "crowd", "crowd")
    ]
    listener = SecuredListener(SimpleNamespace(endpoint=Endpoint("tcp")), None, None)
    listener._entering = [(caller, 0.0, iter(())) for caller in callers]
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
