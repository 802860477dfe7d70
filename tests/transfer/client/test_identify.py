"""identify shows who answers at an address and what it contains; ports lists where something could."""

import json
from pathlib import Path
from types import SimpleNamespace

import pytest

from amp_studio.cli import run
from amp_studio.schema import load_schema
from tests.transfer.conftest import StartControl


def test_identify_names_family_revision_axes_and_checksum(
    start_control: StartControl, capsys: pytest.CaptureFixture[str]
) -> None:
    _, address = start_control()
    assert run(["identify", address, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["family"], found["revision"], found["protocol"]) == ("9pc", "emulated", "house")
    assert found["signature"] == load_schema("9pc").signature
    assert found["abilities"] == {
        "can_send": True,
        "remembers": True,
        "all_or_nothing": True,
        "maps_numbers": False,
        "lasting_states": ["E-stop"],
    }
    assert (found["in_estop"], found["restart_needed"], found["unreadable"]) == (True, False, None)
    assert run(["identify", address]) == 0
    text = capsys.readouterr().out.splitlines()
    assert text[0] == "CNC_1 of the family 9pc, revision emulated"
    assert f"sha256 {found['sha256']}" in text
    assert "a write lasts in E-stop" in text
    assert f"{found['size']} bytes, {found['values']} values" in text


def test_identify_refuses_another_family_than_was_asked_for(
    start_control: StartControl, capsys: pytest.CaptureFixture[str]
) -> None:

    _, address = start_control()
    assert run(["identify", address, "--family", "num"]) == 2
    assert "the control is of the family 9pc, not num" in capsys.readouterr().err
    assert run(["identify", address + "?protocol=dnc"]) == 2
    assert "Unknown protocol 'dnc'. Known: house" in capsys.readouterr().err


ADAPTER = SimpleNamespace(
    device="/dev/ttyUSB0",
    product="FT232R",
    description="FT232R - USB",
    manufacturer="FTDI",
    vid=0x0403,
    pid=0x6001,
    serial_number="A50285BI",
    location="1-2",
)
BARE_PORT = SimpleNamespace(
    device="/dev/ttyS0",
    product=None,
    description="n/a",
    manufacturer=None,
    vid=None,
    pid=None,
    serial_number=None,
    location=None,
)
FOUND = {
    "device": "/dev/ttyUSB0",
    "name": "FT232R",
    "manufacturer": "FTDI",
    "usb_id": "0403:6001",
    "serial_number": "A50285BI",
    "location": "1-2",
    "description": "FT232R by FTDI, number A50285BI, USB 0403:6001, in USB socket 1-2",
}


def test_ports_are_listed_with_their_usb_names(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    links = tmp_path / "by-id"
    links.mkdir()
    (links / "usb-FTDI_FT232R-if00").symlink_to("/dev/ttyUSB0")
    monkeypatch.setattr("amp_studio.transfer.links.usb_ports.BY_ID", links)
    monkeypatch.setattr("serial.tools.list_ports.comports", lambda: [ADAPTER, BARE_PORT])
    assert run(["ports", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["ports"] == [
        dict.fromkeys((*FOUND, "lasting"), "") | {"device": "/dev/ttyS0"},
        FOUND | {"lasting": str(links / "usb-FTDI_FT232R-if00")},
    ]
    assert run(["ports"]) == 0
    assert (
        "/dev/ttyUSB0         FT232R by FTDI, number A50285BI, USB 0403:6001, in USB socket 1-2\n"
        in capsys.readouterr().out
    )
    monkeypatch.setattr("serial.tools.list_ports.comports", list)
    assert run(["ports"]) == 0
    assert capsys.readouterr().out == "There are no serial ports.\n"
