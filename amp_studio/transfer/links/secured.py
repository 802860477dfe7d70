"""The control's side of TLS and passwords: a caller is let in once both are done,
and does not delay other callers meanwhile.
"""

from __future__ import annotations

import ipaddress
import ssl
import time
from collections import Counter
from collections.abc import Generator
from functools import partial

from .endpoint import Endpoint
from .link import Link, LinkError
from .password import LONGEST, NO_TLS, Gate
from .tcp import TcpLink, TcpListener
from .tls import TlsLink, is_ready, tls_message

WAITING = 16  # callers at once that are not let in yet; beyond them one of the host that has most
TIME_TO_ENTER = 10.0  # seconds
_SLICE = 0.02  # seconds between two looks at those who wait


Entering = tuple[TcpLink, float, Generator[Link | None]]
"""A caller, when he has to be through, and the steps that he still has to take."""


class SecuredListener:
    """A listener whose ``accept`` returns only links that have passed TLS and password; either may be
    None.
    """

    def __init__(
        self,
        listener: TcpListener,
        context: ssl.SSLContext | None,
        gate: Gate | None,
        certificate: bytes = NO_TLS,
    ) -> None:
        self.endpoint: Endpoint = listener.endpoint
        self._listener = listener
        self._context = context
        self._gate = gate
        self._certificate = certificate
        self._entering: list[Entering] = []

    def accept(self, timeout: float) -> Link | None:
        end = time.monotonic() + timeout
        while True:
            left = max(0.0, end - time.monotonic())
            wait = min(left, _SLICE) if self._entering else left
            for _ in range(WAITING):
                caller = self._listener.accept(wait)
                if caller is None:
                    break
                self._begin(caller)
                wait = 0.0
            link = self._accept_next()
            if link is not None or time.monotonic() >= end:
                return link

    def close(self) -> None:
        self._listener.close()
        while self._entering:
            self._reject(self._entering[0])

    def _reject(self, entry: Entering) -> None:
        self._entering.remove(entry)
        caller, _, steps = entry
        steps.close()
        caller.close()

    def _begin(self, caller: TcpLink) -> None:
        if len(self._entering) >= WAITING:
            self._reject(self._most_numerous())
        self._entering.append((caller, time.monotonic() + TIME_TO_ENTER, self._enter(caller)))

    def _most_numerous(self) -> Entering:
        """Return the first of those who wait from the host that has most of them:
        a crowd displaces only its own.
        """
        hosts = Counter(neighbourhood(caller.peer.host) for caller, _, _ in self._entering)
        return max(self._entering, key=lambda entry: hosts[neighbourhood(entry[0].peer.host)])

    def _accept_next(self) -> Link | None:
        """Take each of those who wait a step further; return the first who is through."""
        for entry in list(self._entering):
            _, until, steps = entry
            try:
                link = next(steps)
                if link is None and time.monotonic() >= until:
                    raise LinkError(self.endpoint, "not let in in time")
            except (LinkError, StopIteration):
                self._reject(entry)
                continue
            if link is not None:
                self._entering.remove(entry)
                return link
        return None

    def _enter(self, caller: TcpLink) -> Generator[Link | None]:
        """Yield None until the link is through, and then the link; raises LinkError. Closed before that,
        it hangs up.
        """
        link, is_through = caller, False
        try:
            if self._context is not None:
                connection = caller.wrap(
                    partial(self._context.wrap_socket, server_side=True, do_handshake_on_connect=False)
                )
                link = TlsLink(caller.peer, connection)
                yield from self._tls_handshake(connection)
            if self._gate is not None:
                yield from self._ask(link, self._gate)
            is_through = True
            yield link
        except (OSError, ValueError) as error:
            raise (
                error if isinstance(error, LinkError) else LinkError(self.endpoint, tls_message(error))
            ) from None
        finally:
            if not is_through:
                link.close()

    def _tls_handshake(self, connection: ssl.SSLSocket) -> Generator[None]:
        """Yield until TLS is agreed on."""
        while True:
            try:
                connection.do_handshake()
            except (ssl.SSLWantReadError, ssl.SSLWantWriteError) as request:
                if not is_ready(connection, request, 0):
                    yield
            else:
                return

    def _ask(self, link: TcpLink, gate: Gate) -> Generator[None]:
        """Yield until the password is proven; raises LinkError where it is not."""
        challenge, got = gate.challenge(), b""
        link.write(challenge)
        while b"\n" not in got and len(got) <= LONGEST:
            came = link.read(0)
            got += came
            if not came:
                yield None
        answer, is_right = gate.answer(neighbourhood(link.peer.host), challenge, got, self._certificate)
        link.write(answer)
        if not is_right:
            raise LinkError(self.endpoint, "wrong password")


def neighbourhood(host: str) -> str:
    """Return what counts as one host: an IPv4 address, or the 64 bits of an IPv6 network,
    in which each host has any number of addresses.
    """
    try:
        found = ipaddress.ip_address(host.partition("%")[0])
    except ValueError:
        return host
    if isinstance(found, ipaddress.IPv4Address):
        return str(found)
    return str(found.ipv4_mapped or ipaddress.ip_network((found, 64), strict=False))
