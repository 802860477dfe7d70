"""The programs of lrzsz, which nobody here wrote, are the other end."""

import random
import shutil
import threading
from collections.abc import Sequence
from pathlib import Path

import pytest

from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.plain.files import receive_files, send_files
from amp_studio.transfer.plain.ymodem import PlainFile
from tests.transfer.cable import Cable

pytestmark = pytest.mark.skipif(
    not all(map(shutil.which, ("sx", "rx", "sb", "rb"))), reason="lrzsz is not installed"
)

SENDERS = {
    "xmodem": ["sx", "-b"],
    "xmodem-1k": ["sx", "-b", "-k"],
    "xmodem-checksum": ["sx", "-b"],
    "ymodem": ["sb", "-b"],
}
RECEIVERS = {"xmodem": ["rx", "-b"], "xmodem-1k": ["rx", "-b", "-c"], "ymodem": ["rb", "-b"]}


def content(size: int) -> bytes:
    """Return any bytes that do not end like padding."""
    return random.Random(size).randbytes(size)[:-1] + b"x" if size else b""


def from_lrzsz(protocol: str, sizes: Sequence[int], folder: Path, noise: int = 0) -> list[PlainFile]:
    """Let lrzsz send files of these sizes, and return what has come."""
    for size in sizes:
        (folder / f"f{size}").write_bytes(content(size))
    with Cable(noise=noise) as cable:
        near = parse_endpoint(cable.port())
        process = cable.attach([*SENDERS[protocol], *(f"f{size}" for size in sizes)], folder)
        try:
            return receive_files(near, protocol)
        finally:
            process.kill()
            process.wait()


def to_lrzsz(protocol: str, sizes: Sequence[int], folder: Path, noise: int = 0) -> list[bytes]:
    """Send files of these sizes to lrzsz, and return what it has written."""
    files = [PlainFile(f"f{size}", content(size)) for size in sizes]
    names = [] if protocol == "ymodem" else [files[0].name]
    with Cable(noise=noise) as cable:
        near = parse_endpoint(cable.port())
        started = []
        # What it asks for before the port is open is lost, and it asks again after some seconds only.
        timer = threading.Timer(
            0.1, lambda: started.append(cable.attach([*RECEIVERS[protocol], *names], folder))
        )
        timer.start()
        send_files(near, protocol, files)
        timer.join()
        started[0].wait(60)
    written = [(folder / file.name).read_bytes() for file in files]
    return written if protocol == "ymodem" else [written[0].rstrip(b"\x1a")]


@pytest.mark.parametrize("protocol", ["xmodem", "xmodem-1k", "xmodem-checksum"])
@pytest.mark.parametrize("size", [0, 1025])
def test_xmodem_receives_what_sx_sends(protocol: str, size: int, tmp_path: Path) -> None:
    (file,) = from_lrzsz(protocol, [size], tmp_path)
    assert file.content == content(size)


def test_ymodem_receives_a_batch_of_sb_over_a_clean_and_a_noisy_line(tmp_path: Path) -> None:
    sizes = (0, 1, 127, 128, 129, 1023, 1024, 1025, 100_000)
    expected = [PlainFile(f"f{size}", content(size)) for size in sizes]
    assert from_lrzsz("ymodem", sizes, tmp_path) == expected
    assert from_lrzsz("ymodem", sizes[4:8], tmp_path, noise=3_000) == expected[4:8]


def test_rx_receives_what_xmodem_sends(tmp_path: Path) -> None:
    assert to_lrzsz("xmodem-1k", [20_000], tmp_path) == [content(20_000)]


def test_rb_receives_a_batch_of_ymodem(tmp_path: Path) -> None:
    assert to_lrzsz("ymodem", [1025], tmp_path) == [content(1025)]
