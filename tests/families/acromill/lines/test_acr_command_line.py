"""Every verb works over the terminal of an ACR card, on a TCP connection and on a serial line."""

import json
import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.families.acromill.emulated.card import AcrCard
from amp_studio.transfer.emulated.line_device import DeviceSetup
from amp_studio.transfer.emulated.memory import Memory
from tests.campaigns import some
from tests.transfer.device_line import served


@pytest.fixture(
    params=some(
        [
            "tcp://127.0.0.1:0",
            pytest.param("pty:", marks=pytest.mark.skipif(os.name != "posix", reason="no pty")),
        ],
        2,
    )
)
def card(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[tuple[str, AcrCard]]:
    device = AcrCard(DeviceSetup("acromill", Memory(tmp_path / "card"), print))
    with served(device, f"{request.param}?protocol=terminal") as (address, _):
        yield address, device


def test_identify_upload_download_verify_diff_and_restore(
    card: tuple[str, AcrCard], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    address, device = card
    assert run(["identify", address, "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert (found["protocol"], found["revision"], found["values"]) == ("terminal", "1.17.08", 112)
    assert found["abilities"]["all_or_nothing"] is False
    path = tmp_path / "router.amp"
    assert run(["upload", "--from", address, "-o", str(path)]) == 0
    assert (
        run(["set", str(path), "servo.p_gain@X=0.08 V/count", "axes.pulses_per_unit@X=4096 counts/in"]) == 0
    )
    assert run(["set", str(path), "control.trial_speed=50"]) in (0, 2)
    capsys.readouterr()
    assert run(["verify", str(path), "--with", address]) == 1
    displayed = capsys.readouterr().out
    assert "Pulses/Unit" in displayed
    assert "The control contains other values." in displayed
    assert run(["download", str(path), "--to", address, "--accept-errors"]) == 0
    assert (device.settings.values["PGAIN X"], device.settings.values["PPU X"]) == ("0.08", "4096")
    assert run(["verify", str(path), "--with", address]) == 0
    (kept,) = tmp_path.glob("router.before-*.img")
    assert run(["diff", str(path), str(kept.with_suffix(".amp"))]) == 1
    assert run(["restore", str(kept), "--to", address]) == 0
    assert device.settings.values["PPU X"] == "10000"


def test_what_the_card_does_not_keep_is_counted_and_not_called_a_difference(
    card: tuple[str, AcrCard], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "new.amp"
    assert run(["new", "acromill", str(path)]) == 0
    capsys.readouterr()
    assert run(["verify", str(path), "--with", card[0]]) == 0
    displayed = capsys.readouterr().out
    assert "values of the file are not kept by this control." in displayed
    assert displayed.startswith("0 differ, 112 are the same")
