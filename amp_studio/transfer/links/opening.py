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


def connect(endpoint: Endpoint, timeout: float = 3.0, look: Callable[[], None] = keep_waiting) -> Link:
    """Open the line to a control, within ``timeout`` seconds; raises LinkError.

    ``look`` is called at least every 0.1 s while opening and writing wait, and may raise to break off.
    """
    if endpoint.kind == "tcp":
        from .tcp import connect_tcp

        return connect_tcp(endpoint, timeout, look)
    if endpoint.kind == "serial":
        from .serial_line import open_port

        return open_port(endpoint, look)
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
    from .pseudo_terminal import PtyListener

    return PtyListener()
