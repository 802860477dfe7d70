"""Links over TLS: what passes cannot be read or changed on the way, and the certificate is checked."""

from __future__ import annotations

import contextlib
import hashlib
import hmac
import select
import socket
import ssl
import time
from collections.abc import Callable
from functools import partial

from .attempt import SLICE, in_time
from .endpoint import Endpoint
from .link import LinkError, keep_waiting
from .tcp import READ_SIZE, TcpLink, tcp_message


class TlsLink(TcpLink):
    """One TLS connection whose handshake is done."""

    _socket: ssl.SSLSocket

    def read(self, timeout: float) -> bytes:
        end = time.monotonic() + timeout
        while True:
            try:
                data = self._socket.recv(READ_SIZE)
            except (ssl.SSLWantReadError, ssl.SSLWantWriteError) as request:
                left = max(0.0, end - time.monotonic())
                if not self._is_ready(request, left):
                    return b""
                continue
            except (OSError, ValueError) as error:
                raise LinkError(self._endpoint, tls_message(error)) from None
            if not data:
                raise LinkError(self._endpoint, "the other end has closed the connection")
            return data

    def write(self, data: bytes) -> None:
        rest = memoryview(data)
        end = time.monotonic() + self.write_limit
        while rest:
            try:
                rest = rest[self._socket.send(rest) :]
                continue
            except (ssl.SSLWantReadError, ssl.SSLWantWriteError) as request:
                if self._is_ready(request, SLICE):
                    continue
            except (OSError, ValueError) as error:
                raise LinkError(self._endpoint, tls_message(error)) from None
            self._poll()
            if time.monotonic() >= end:
                raise LinkError(self._endpoint, "the other end takes nothing more")

    def close(self) -> None:
        with contextlib.suppress(OSError, ValueError):
            self._socket.unwrap()
        super().close()

    def _is_ready(self, request: ssl.SSLError, seconds: float) -> bool:
        try:
            return is_ready(self._socket, request, seconds)
        except (OSError, ValueError) as error:
            raise LinkError(self._endpoint, tls_message(error)) from None


def is_ready(connection: ssl.SSLSocket, request: ssl.SSLError, seconds: float) -> bool:
    """Wait for what TLS needs of its socket, up to so long; returns whether it is there."""
    is_write = isinstance(request, ssl.SSLWantWriteError)
    ready = select.select([] if is_write else [connection], [connection] if is_write else [], [], seconds)
    return bool(ready[0] or ready[1])


def connect_tls(
    endpoint: Endpoint, timeout: float, look: Callable[[], None] = keep_waiting
) -> tuple[TlsLink, bytes]:
    """Connect and check the certificate within ``timeout`` seconds;
    return the link and the digest of the certificate.

    Raises LinkError, and what ``look`` raises.
    """
    made = in_time(
        partial(_connected, endpoint, timeout),
        ssl.SSLSocket.close,
        timeout,
        look,
        lambda error: error if isinstance(error, LinkError) else LinkError(endpoint, tls_message(error)),
    )
    return TlsLink(endpoint, made, look), hashlib.sha256(made.getpeercert(binary_form=True) or b"").digest()


def _connected(endpoint: Endpoint, timeout: float) -> ssl.SSLSocket:
    """Return a connection whose certificate is checked, by an authority or by its fingerprint."""
    context = _client_context(endpoint)
    plain = socket.create_connection((endpoint.host, endpoint.port), timeout=timeout)
    try:
        connection = context.wrap_socket(plain, server_hostname=endpoint.host)
    except BaseException:
        plain.close()
        raise
    if endpoint.fingerprint:
        found = hashlib.sha256(connection.getpeercert(binary_form=True) or b"").hexdigest()
        if not hmac.compare_digest(found, endpoint.fingerprint):
            connection.close()
            raise LinkError(
                endpoint,
                "the control shows another certificate than the one with this fingerprint: nothing was sent",
            )
    return connection


def _client_context(endpoint: Endpoint) -> ssl.SSLContext:
    """Return what a certificate is checked by: the one fingerprint, a file of certificates (or both),
    or those of the system.
    """
    if endpoint.fingerprint and not endpoint.ca:
        context = ssl.SSLContext(ssl.PROTOCOL_TLS_CLIENT)
        context.check_hostname = False
        context.verify_mode = ssl.CERT_NONE  # its digest is compared instead
    else:
        try:
            context = ssl.create_default_context(cafile=endpoint.ca or None)
        except (OSError, ValueError) as error:
            reason = (
                "no certificate in it" if isinstance(error, ssl.SSLError) else getattr(error, "strerror", "")
            )
            raise LinkError(
                endpoint, f"the certificates of {endpoint.ca} cannot be used ({reason})"
            ) from None
    context.minimum_version = ssl.TLSVersion.TLSv1_2
    return context


def tls_message(error: Exception) -> str:
    """Return an error of TLS or of the socket below in words."""
    if isinstance(error, ssl.SSLCertVerificationError):
        return (
            f"its certificate is not trusted ({error.verify_message or 'no reason given'}): name the file of"
            " its authority (?ca=FILE) or the fingerprint that it prints (?fingerprint=sha256:…)"
        )
    if isinstance(error, ssl.SSLEOFError | ssl.SSLZeroReturnError):
        return "the other end has closed the connection"
    if isinstance(error, ssl.SSLError):
        reason = (error.reason or "").replace("_", " ").lower()
        if "wrong version number" in reason or "record layer failure" in reason:
            return "what answers there does not speak TLS"
        return f"TLS failed ({reason or 'no reason given'})"
    return tcp_message(error)
