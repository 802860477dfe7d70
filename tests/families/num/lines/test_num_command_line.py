"""Every verb works over the parameter table of a NUM control;
the person reads what to press on standard error.
"""

import os
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from amp_studio.cli import console, run
from amp_studio.families.num.emulated.control import NumControl
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory
from tests.transfer.device_line import served

PTY = pytest.param("pty:", marks=pytest.mark.skipif(os.name != "posix", reason="no pseudo terminals"))

SMALL = (
    b"%00000000;09\nP0N0:t6n1;09\n#00000000;09\nP9N0:t0n32;0A\n#0 1 2 FF FF FF FF FF FF FF;1B\n"
    b"P9N10:t0n32;0B\n#FF FF FF FF FF FF FF FF FF FF;1E\n\x13"
)


@pytest.fixture(params=["tcp://127.0.0.1:0", PTY])
def control(
    request: pytest.FixtureRequest, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> Iterator[tuple[str, NumControl]]:
    memory = Memory(tmp_path / "cnc")
    memory.replace("table", SMALL)
    device = NumControl(DeviceSetup("num", memory, lambda _: None))
    with served(device, f"{request.param}?protocol=peripheral") as (address, service):
        displayed = console.print_notice

        def read(text: str, end: str = "\n") -> None:
            """Be the person at the keys, who reads what the program shows."""
            displayed(text, end=end)
            for operation, item in (("unload", "3 UNLOAD"), ("load", "2 LOAD")):
                if item in text:
                    for key in ("exit", operation, "enter", "start")[: 4 if operation == "unload" else 3]:
                        service.operate(key)

        monkeypatch.setattr(console, "print_notice", read)
        separator = "&" if "?" in address else "?"
        baud = f"{separator}baud=115200" if address.startswith("serial:") else ""
        yield address + baud, device


def test_identify_upload_download_verify_and_restore(
    control: tuple[str, NumControl], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    address, device = control
    assert run(["identify", address]) == 0
    reported = capsys.readouterr()
    assert "CNC with the job reference 00000000 of the family num" in reported.out
    assert "3 UNLOAD, Enter at READY?" in reported.err
    path = tmp_path / "mill.amp"
    assert run(["upload", "--from", address, "-o", str(path), "--on-fault", "keep"]) == 0
    assert run(["set", str(path), "P9N0=7", "--force"]) == 0
    assert run(["verify", str(path), "--with", address]) == 1
    assert run(["download", str(path), "--to", address, "--accept-errors"]) == 0
    assert re.search(r"2 LOAD, Enter at READY\?", capsys.readouterr().err)
    assert device._parameters.words[9][0] == "7"
    assert run(["verify", str(path), "--with", address]) == 0
    (kept,) = tmp_path.glob("mill.before-*.img")
    assert kept.read_bytes().startswith(b"NUM table 1\n%00000000;09\n")
    assert run(["restore", str(kept), "--to", address]) == 0
    assert device._parameters.words[9][0] == "0", "as it was"


@pytest.mark.skipif(os.name != "posix", reason="no pseudo terminals")
@pytest.mark.parametrize(("stop", "code"), [(2, 0), (1, 2)])
def test_stop_bits_of_the_address_reach_the_line(
    control: tuple[str, NumControl], tmp_path: Path, stop: int, code: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    address, device = control
    if address.startswith("tcp"):
        pytest.skip("a TCP connection has no stop bits")
    monkeypatch.setattr("amp_studio.families.num.lines.driver.STOPPED_WAIT", 0.3)
    path = tmp_path / "mill.amp"
    assert run(["upload", "--from", address, "-o", str(path), "--on-fault", "keep"]) == 0
    assert run(["set", str(path), "P9N0=7", "--force"]) == 0
    device.operate("line 0 2")
    ended = run(["download", str(path), "--to", f"{address}&stop={stop}", "--accept-errors"])
    assert ended == code
    assert device._parameters.words[9][0] == ("7" if code == 0 else "0")
