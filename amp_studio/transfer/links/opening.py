"""Opening a link: the kind of an endpoint decides which."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING

from .endpoint import Endpoint
from .link import Link, LinkError, Listener, keep_waiting

if TYPE_CHECKING:
    from .pseudo_terminal import PtyListener
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

    ``look`` is called at least every 0.1 s while opening and writing wait, and may raise to break off. ``own_flow``
    leaves Xon and Xoff to the protocol on the line: they are read as bytes, whatever the endpoint's ``flow`` is.
    A way of speaking with other usual settings than 115200 8N1 gives ``endpoint.with_usual(…)``.
    """
    if endpoint.kind == "tcp":
        from .tcp import connect_tcp

        return connect_tcp(endpoint, timeout, look)
    if endpoint.kind == "serial":
        from .serial_line import open_port

        return open_port(endpoint, look, own_flow=own_flow)
    if endpoint.kind == "rfc2217":
        from .rfc2217 import connect_rfc2217

        return connect_rfc2217(endpoint, timeout, look, own_flow=own_flow)
    if endpoint.kind == "tls":
        raise LinkError(endpoint, "TLS is not there yet")
    raise LinkError(
        endpoint, "a pseudo terminal can only be listened on; connect to the serial: name it was given"
    )


def listen(endpoint: Endpoint) -> Listener:
    """Open the control's side of a line; raises LinkError when the place is taken or does not exist.

    What it listens on names the protocol that ``endpoint`` names, so that a person can hand it to a client as it is.
    """
    listener = _listener(endpoint)
    listener.endpoint = replace(listener.endpoint, protocol=endpoint.protocol)
    return listener


def _listener(endpoint: Endpoint) -> TcpListener | PortListener | PtyListener:
    if endpoint.kind == "tcp":
        from .tcp import TcpListener

        return TcpListener(endpoint)
    if endpoint.kind == "serial":
        from .serial_line import PortListener

        return PortListener(endpoint)
    if endpoint.kind != "pty":
        raise LinkError(endpoint, "this can only be connected to; listen on tcp://, a serial port or pty:")
    from .pseudo_terminal import PtyListener

    return PtyListener()
