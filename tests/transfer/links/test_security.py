"""A control in a network shows its certificate and asks for its password,
and who attacks either gets nothing and delays nobody.
"""

import socket
import ssl
import threading
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from urllib.parse import quote

import pytest

from amp_studio.transfer.links.endpoint import Endpoint, parse_endpoint
from amp_studio.transfer.links.link import LinkError
from amp_studio.transfer.links.opening import connect, listen
from amp_studio.transfer.links.security import Security, exposure, read_password

from .secured import CONTROL, HERE, PASSWORD, echo

# -- TLS


@pytest.mark.parametrize("options", [f"ca={quote(str(HERE / 'authority.pem'))}", "fingerprint"])
def test_a_control_is_trusted_by_its_authority_or_its_fingerprint(
    echoing: Callable[[str, Security], Endpoint], options: str
) -> None:
    place = echoing("tls://127.0.0.1:0", CONTROL)
    assert len(place.fingerprint) == 64, "the control prints it, for whoever connects"
    if options != "fingerprint":
        place = parse_endpoint(f"tls://127.0.0.1:{place.port}?{options}")
    assert echo(place, bytes(range(256)) * 1000) == bytes(range(256)) * 1000


@pytest.mark.parametrize(
    ("options", "security", "message"),
    [
        ("", CONTROL, "its certificate is not trusted"),
        (
            f"?ca={quote(str(HERE / 'authority.pem'))}",
            Security("", HERE / "other.pem"),
            "its certificate is not trusted",
        ),
        (
            f"?ca={quote(str(HERE / 'other.pem'))}",
            Security("", HERE / "other.pem"),
            r"not trusted \(IP address mismatch",
        ),
        (
            f"?fingerprint=sha256:{'0' * 64}",
            CONTROL,
            "another certificate than the one with this fingerprint",
        ),
        ("?ca=/no/such/file", CONTROL, "No such file"),
        (f"?ca={quote(str(HERE / 'control.key'))}", CONTROL, "no certificate in it"),
    ],
)
def test_another_certificate_is_refused_before_anything_is_sent(
    echoing: Callable[[str, Security], Endpoint], options: str, security: Security, message: str
) -> None:
    place = echoing("tls://127.0.0.1:0", security)
    with pytest.raises(LinkError, match=message):
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
    ("security", "message"),
    [
        (Security("", HERE / "missing.pem"), "cannot be read"),
        (Security("", HERE / "control.pem"), "cannot be used"),
        (Security("", HERE / "other.pem", HERE / "control.key"), "cannot be used"),
        (Security("", HERE / "control.pem", HERE / "locked.key"), "encrypted"),
    ],
)
def test_a_certificate_that_cannot_be_used_is_refused_at_the_start(security: Security, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        listen(replace(parse_endpoint("tls://127.0.0.1:0"), security=security))


@pytest.mark.parametrize(
    ("address", "security", "message"),
    [
        ("tls://127.0.0.1:0", Security(PASSWORD), "needs a certificate"),
        ("tcp://127.0.0.1:0", CONTROL, "write tls://"),
        ("pty:", Security(PASSWORD), "a serial line has no password"),
        ("rfc2217://127.0.0.1:1", Security(PASSWORD), "a serial line has no password"),
    ],
)
def test_security_that_does_not_fit_the_address_is_refused(
    address: str, security: Security, message: str
) -> None:
    with pytest.raises(LinkError, match=message):
        listen(replace(parse_endpoint(address), security=security))


# -- what a person does


def test_a_password_file_has_it_in_its_first_line(tmp_path: Path) -> None:
    path = tmp_path / "password"
    path.write_bytes("größer als\r\nmore".encode())
    assert read_password(path) == "größer als"
    for content in (b"", b"short\n", b"\xff" * 20, b"x" * 2000):
        path.write_bytes(content)
        with pytest.raises(ValueError, match=r"first line"):
            read_password(path)


@pytest.mark.parametrize(
    ("host", "has_tls", "has_password", "message"),
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
def test_who_listens_for_everybody_is_warned(
    host: str, has_tls: bool, has_password: bool, message: str
) -> None:
    found = exposure(host, has_tls=has_tls, has_password=has_password)
    assert (message in found) if message else not found


def test_a_password_is_in_no_text() -> None:
    place = replace(parse_endpoint("tcp://127.0.0.1:1"), security=Security(PASSWORD))
    assert PASSWORD not in f"{place} {place!r} {place.security!r} {place.security}"
