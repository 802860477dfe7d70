"""Lines of controls; no password of this computer is used."""

import sys
import threading
from collections.abc import Callable, Iterator
from dataclasses import replace

import pytest

from amp_studio.transfer.links import passwords
from amp_studio.transfer.links.endpoint import Endpoint, parse_endpoint
from amp_studio.transfer.links.link import Link, LinkError
from amp_studio.transfer.links.opening import listen
from amp_studio.transfer.links.security import Security


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
