"""Opening a link: the kind of an endpoint decides which."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from .endpoint import Endpoint
from .link import Link, LinkError, Listener, keep_waiting

if TYPE_CHECKING:
    from .pseudo_terminal import PtyListener
    from .secured import SecuredListener
    from .serial_line import PortListener
    from .tcp import TcpListener


def connect(
    endpoint: Endpoint,
    timeout: float = 3.0,
    look: Callable[[], None] = keep_waiting,
    *,
    own_flow: bool = False,
) -> Link:
    """Open the line to a control, within ``timeout`` seconds; raises LinkError.

    ``look`` is called at least every 0.1 s while opening and writing wait, and may raise to break off.
    ``own_flow`` leaves Xon and Xoff to the protocol on the line: they are read as bytes, whatever the
    endpoint's ``flow`` is. A way of speaking with other usual settings than 115200 8N1 gives
    ``endpoint.with_usual(…)``.
    """
    if endpoint.kind in ("tcp", "tls"):
        from .passwords import find_password

        return _network_link(endpoint, find_password(endpoint), timeout, look)
    if endpoint.kind == "serial":
        from .serial_line import open_port

        return open_port(endpoint, look, own_flow=own_flow)
    if endpoint.kind == "rfc2217":
        from .rfc2217 import connect_rfc2217

        return connect_rfc2217(endpoint, timeout, look, own_flow=own_flow)
    if endpoint.kind == "folder":
        raise LinkError(endpoint, "a folder is no line, and only a control that reads its files has one")
    raise LinkError(
        endpoint, "a pseudo terminal can only be listened on; connect to the serial: name it was given"
    )


def _network_link(endpoint: Endpoint, password: str, timeout: float, look: Callable[[], None]) -> Link:
    """Open a connection, prove the password on it if there is one,
    and else notice when the control asks for one.
    """
    from .password import NO_TLS, GuardedLink, PasswordError, ProvenLink, prove
    from .passwords import ENVIRONMENT, ask_password

    link: Link
    if endpoint.kind == "tls":
        from .tls import connect_tls

        link, certificate = connect_tls(endpoint, timeout, look)
    else:
        from .tcp import connect_tcp

        link, certificate = connect_tcp(endpoint, timeout, look), NO_TLS
    if password:
        try:
            rest = prove(link, endpoint, password, certificate, timeout, look)
        except BaseException:
            link.close()
            raise
        return ProvenLink(link, rest)

    def reopen() -> Link:
        entered = ask_password(endpoint)
        if not entered:
            raise PasswordError(
                endpoint,
                f"the control asks for a password: put it into {ENVIRONMENT} or the system's keyring",
            )
        return _network_link(endpoint, entered, timeout, look)

    return GuardedLink(link, reopen)


def listen(endpoint: Endpoint) -> Listener:
    """Open the control's side of a line; raises LinkError when the place is taken or does not exist.

    What it listens on names the protocol that ``endpoint`` names,
    so that a person can hand it to a client as it is.
    """
    listener = _listener(endpoint)
    listener.endpoint = replace(listener.endpoint, protocol=endpoint.protocol)
    return listener


def _listener(endpoint: Endpoint) -> TcpListener | SecuredListener | PortListener | PtyListener:
    """Return what listens at an endpoint; raises LinkError for one that can only be connected to."""
    if endpoint.kind in ("tcp", "tls"):
        return _network_listener(endpoint)
    if endpoint.security is not None and endpoint.security.password:
        raise LinkError(endpoint, "a serial line has no password: who can plug in the cable has the line")
    if endpoint.kind == "serial":
        from .serial_line import PortListener

        return PortListener(endpoint)
    if endpoint.kind != "pty":
        raise LinkError(endpoint, "this can only be connected to; listen on tcp://, a serial port or pty:")
    from .pseudo_terminal import PtyListener

    return PtyListener()


def _network_listener(endpoint: Endpoint) -> TcpListener | SecuredListener:
    """Listen for connections; with a certificate for TLS and with a password if there are such."""
    from .tcp import TcpListener

    security = endpoint.security
    has_certificate = security is not None and security.certificate is not None
    if has_certificate != (endpoint.kind == "tls"):
        missing = (
            "needs a certificate" if endpoint.kind == "tls" else "has no use for a certificate: write tls://"
        )
        raise LinkError(endpoint, f"this address {missing}")
    if security is None or not (has_certificate or security.password):
        return TcpListener(endpoint)
    from .password import NO_TLS, Gate
    from .secured import SecuredListener
    from .security import fingerprint_of, server_context

    context = server_context(security)
    fingerprint = fingerprint_of(security.certificate) if security.certificate is not None else ""
    return SecuredListener(
        TcpListener(replace(endpoint, fingerprint=fingerprint, security=None)),
        context,
        Gate(security.password) if security.password else None,
        bytes.fromhex(fingerprint) or NO_TLS,
    )
