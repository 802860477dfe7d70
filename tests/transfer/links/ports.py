"""Serial ports without hardware, and what is read from them."""

import contextlib
import shutil
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from amp_studio.transfer.links.link import Link


def read_all(link: Link, length: int) -> bytes:
    """Read until so many bytes have come, or nothing more comes for a second."""
    data = b""
    while len(data) < length and (more := link.read(1)):
        data += more
    return data


@contextlib.contextmanager
def socat_pair(folder: Path) -> Iterator[tuple[Path, Path]]:
    """Give the two ends of a cable made by socat; it is pulled at the end."""
    socat = shutil.which("socat")
    if socat is None:
        pytest.skip("socat is not installed")
    near, far = folder / "near", folder / "far"
    process = subprocess.Popen([socat, *(f"pty,rawer,echo=0,link={end}" for end in (near, far))])
    try:
        end = time.monotonic() + 60
        while not (near.exists() and far.exists()):
            assert time.monotonic() < end
        yield near, far
    finally:
        process.kill()
        process.wait()
