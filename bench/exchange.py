"""The example on its way to an emulated control and back, over a socket and over a serial line."""

import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import cycle
from pathlib import Path

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
        with _control(listen, kept / "control") as address:
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
    with _control(LINES["TCP loopback"], kept / "control") as address:

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


@contextmanager
def _control(listen: str, state: Path) -> Iterator[str]:
    """Run an emulated control in its own process, and give its address."""
    command = [
        sys.executable,
        "-m",
        "amp_studio.cli",
        "emulate",
        "9pc",
        "--listen",
        listen,
        "--machine",
        "mill",
    ]
    with subprocess.Popen(
        [*command, "--state", str(state)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
        env={**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)},
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            line = next(said for said in process.stdout if said.startswith("listening on "))
            yield line.removeprefix("listening on ").strip()
        finally:
            process.stdin.write("quit\n")
            process.stdin.close()
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
