"""A control with a certificate and a password, and a caller that sends something and hears it back."""

import contextlib
from pathlib import Path

from amp_studio.transfer.links.endpoint import Endpoint
from amp_studio.transfer.links.opening import connect
from amp_studio.transfer.links.security import Security

HERE = Path(__file__).with_name("certificates")
PASSWORD = "correct horse"
CONTROL = Security("", HERE / "control.pem", HERE / "control.key")


def echo(endpoint: Endpoint, data: bytes = b"\x00\xffframe") -> bytes:
    """Send and return what comes back; raises LinkError."""
    link = connect(endpoint)
    with contextlib.closing(link):
        link.write(data)
        got = b""
        while len(got) < len(data) and (came := link.read(5)):
            got += came
        return got
