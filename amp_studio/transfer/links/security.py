"""What a control that listens in a network asks for: TLS with a certificate, a password of its clients."""

from __future__ import annotations

import hashlib
import os
import socket
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import ssl

_SHORTEST_PASSWORD = 8
_LONGEST_PASSWORD = 1_024
_LARGEST_FILE = 1 << 20  # bytes of a certificate or a password file


@dataclass(frozen=True)
class Security:
    """``password`` is "" for none; ``certificate`` and ``key`` are PEM files, None without TLS."""

    password: str = ""
    certificate: Path | None = None
    key: Path | None = None

    def __repr__(self) -> str:
        return f"Security(certificate={self.certificate})"  # a password is in no log


def read_password(path: Path) -> str:
    """Return the first line of a file; raises ValueError where it is no password,
    OSError where it cannot be read.
    """
    with path.open("rb") as stream:
        content = stream.read(_LARGEST_FILE)
    try:
        password = content.partition(b"\n")[0].rstrip(b"\r").decode()
    except UnicodeDecodeError:
        raise ValueError(f"{path}: the first line is no text in UTF-8") from None
    if not _SHORTEST_PASSWORD <= len(password) <= _LONGEST_PASSWORD:
        raise ValueError(
            f"{path}: the first line must be a password of {_SHORTEST_PASSWORD} characters or more"
        )
    return password


def can_others_read(path: Path) -> bool:
    """Return whether other users of this computer may read a file; False on other systems than POSIX."""
    return os.name == "posix" and bool(path.stat().st_mode & 0o077)


def server_context(security: Security) -> ssl.SSLContext | None:
    """Return what TLS needs to listen, None without a certificate; raises ValueError where it cannot be
    used.
    """
    if security.certificate is None:
        return None
    import ssl  # not before it is needed: it takes 15 ms of every start

    context = ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER)
    context.minimum_version = ssl.TLSVersion.TLSv1_2
    try:
        context.load_cert_chain(security.certificate, security.key, password=_no_passphrase)
    except ssl.SSLError as error:
        reason = (error.reason or "").replace("_", " ").lower() or "it is no certificate in PEM form"
        raise ValueError(f"{security.certificate}: certificate and key cannot be used ({reason})") from None
    except OSError as error:
        raise ValueError(
            f"{security.certificate}: certificate or key cannot be read ({error.strerror})"
        ) from None
    return context


def _no_passphrase() -> str:
    raise ValueError("the key is encrypted: give one without a passphrase")


def fingerprint_of(certificate: Path) -> str:
    """Return the SHA-256 of the first certificate of a PEM file, in hexadecimal."""
    import ssl

    text = certificate.read_text(encoding="ascii", errors="replace")
    begin, end = text.index(ssl.PEM_HEADER), text.index(ssl.PEM_FOOTER) + len(ssl.PEM_FOOTER)
    return hashlib.sha256(ssl.PEM_cert_to_DER_cert(text[begin:end])).hexdigest()


def _is_public(host: str) -> bool:
    """Return whether others than this computer reach what listens at a host."""
    import ipaddress

    try:
        found = socket.getaddrinfo(host, None, type=socket.SOCK_STREAM)
    except (OSError, UnicodeError):
        return False  # it cannot be listened on either
    return not all(ipaddress.ip_address(str(each[4][0]).partition("%")[0]).is_loopback for each in found)


def exposure(host: str, *, has_tls: bool, has_password: bool) -> str:
    """Return a sentence about what others can do to a control that listens at a host; "" where they
    cannot.
    """
    if not _is_public(host) or (has_tls and has_password):
        return ""
    if not has_password:
        missing = "a password" if has_tls else "TLS and a password"
        return (
            f"{host} can be reached from the network, without {missing}: anybody there can read and replace"
            " the parameters"
        )
    return (
        f"{host} can be reached from the network, without TLS: who can read or change what passes there is"
        " not kept out"
    )
