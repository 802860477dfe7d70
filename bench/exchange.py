"""The example on its way to an emulated control and back, over a socket and over a serial line."""

import os
from collections.abc import Iterator
from itertools import cycle
from pathlib import Path

from emulated_process import emulated
from measure import Measure, timed

from amp_studio.files import open_file
from amp_studio.schema import Value
from amp_studio.transfer.client.parameters import download_file, fetch_file, fetch_image
from amp_studio.transfer.client.verification import verify_content
from amp_studio.transfer.exchange import Exchange

LINES = {"TCP loopback": "tcp://127.0.0.1:0", **({"pty": "pty:"} if os.name == "posix" else {})}


def measures(folder: Path, full: Path, example: Path, times: int) -> Iterator[Measure]:
    """Yield upload and download over every line there is, and those of a full file over TCP."""
    yield from _of_full_file(folder, full, times)
    file, values = open_file(example).file, cycle([Value(12.0, "mm"), Value(11.0, "mm")])

    def change() -> None:  # a control that contains the same already is sent nothing
        file.set(("servo.excess_error", "1"), next(values))

    for name, listen in LINES.items():
        kept = folder / f"kept-{name.replace(' ', '-')}"
        kept.mkdir()
        with emulated("9pc", listen, kept / "control", "--machine", "mill") as control:
            address = control.address
            down = timed(
                lambda a=address, k=kept: download_file(file, a, Exchange(keep=k / "bench")),
                times,
                change,
                warm=0,
            )
            yield Measure(f"download, {name} (restart of the control included)", down)
            yield Measure(f"upload, {name}", timed(lambda a=address: fetch_file(a, family="9pc"), times))


def _of_full_file(folder: Path, full: Path, times: int) -> Iterator[Measure]:
    file, values = open_file(full).file, cycle([Value(12.0, "mm"), Value(11.0, "mm")])
    kept = folder / "kept-full"
    kept.mkdir()
    with emulated("9pc", LINES["TCP loopback"], kept / "control", "--machine", "mill") as control:
        address = control.address

        def change() -> None:
            file.set(("servo.excess_error", "1"), next(values))

        down = timed(
            lambda: download_file(file, address, Exchange(keep=kept / "bench")), times, change, warm=0
        )
        yield Measure(
            "download of a full file, TCP (0.5 s of it is the control's restart)", down, target=0.65
        )
        verify = timed(lambda: verify_content(file, fetch_image(address, family="9pc")), times)
        yield Measure("verify of a full file, TCP", verify, target=0.15)
