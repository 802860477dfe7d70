"""`status -o`: the readings of one axis as a table, from an emulated control whose time passes as it is asked
for."""

import json
import signal
import sys
import time
from collections.abc import Iterator
from itertools import count
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.cli import stopping
from amp_studio.control import ConnectedControl
from amp_studio.families.grblhal.status import status_of
from amp_studio.transfer import ControlIdentity, ControlStatus
from tests.families.grblhal.test_emulated_motion import Bench

GRBL = Path(__file__).parents[2] / "examples" / "grblhal-router" / "GRBL_ROUTER.amp"


@pytest.fixture
def moving(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Bench:
    """Return an emulated Grbl that is asked five times a second of its clock."""
    bench, clock = Bench(tmp_path / "memory"), [0.0]

    def watch(_: ConnectedControl) -> Iterator[ControlStatus]:
        while True:
            bench.firmware.receive(b"?")
            yield status_of(ControlIdentity("grblhal", "grbl", "Grbl"), bench.read().strip())

    def sleep(_: float) -> None:
        clock[0] += 0.2
        for _n in range(2):
            bench.firmware.advance(0.1)

    monkeypatch.setattr(ConnectedControl, "watch", watch)
    monkeypatch.setattr("time.sleep", sleep)
    monkeypatch.setattr("time.monotonic", lambda: clock[0])
    return bench


def test_readings_are_recorded_from_the_trigger_on_and_laid_over_the_simulation(
    moving: Bench, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    moving.identity_word("G91 G1 X40 F1500")
    record = tmp_path / "live.csv"
    wanted = ["--axis", "x", "--seconds", "5", "--trigger", "position>0.5", "--pre-trigger", "0.4", "--json"]
    assert cli.run(["status", "tcp://127.0.0.1:1", "-o", str(record), *wanted]) == 0
    facts = json.loads(capsys.readouterr().out)
    assert (facts["axis"], facts["signals"], facts["has_fired"]) == ("X", ["position"], True)
    assert facts["rate"] == pytest.approx(5.0)
    move = ["move.distance=40", "move.feedrate=1500", "$120=500 mm/s2", "$110=6000 mm/min"]
    sets = [text for each in move for text in ("--set", each)]
    asked = ["simulate", str(GRBL), "step", "--axis", "X", *sets, "--against", str(record), "--json"]
    assert cli.run(asked) == 0
    result = json.loads(capsys.readouterr().out)["result"]
    # A step of the motor is 0.0125 mm; the emulated axis and the simulated one are the same machine.
    assert result["difference_rms_position"]["value"] < 0.05


def test_ctrl_c_ends_a_recording_and_is_no_failure(
    moving: Bench, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without --seconds it is the only way to end one: what was read is written, and nothing was stopped."""
    sleep, asked, before = time.sleep, count(1), signal.getsignal(signal.SIGINT)

    def sleep_and_press(seconds: float) -> None:
        sleep(seconds)
        if next(asked) == 5:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr("time.sleep", sleep_and_press)
    monkeypatch.setattr(stopping, "_asked", [])
    monkeypatch.setattr(sys, "unraisablehook", sys.unraisablehook)
    record = tmp_path / "live.csv"
    try:
        stopping.raise_on_interrupt()
        code = cli.run(["status", "tcp://127.0.0.1:1", "-o", str(record), "--axis", "X", "--json"])
    finally:
        signal.signal(signal.SIGINT, before)
    out = capsys.readouterr()
    assert (code, json.loads(out.out)["readings"], out.err) == (0, 5, "")
    assert len(record.read_text().splitlines()) == 6


def test_what_does_not_belong_together_is_one_sentence(
    moving: Bench, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    record = str(tmp_path / "live.csv")
    for options, words in (
        (["--axis", "X"], "belong to -o"),
        (["-o", record], "the control shows X, Y, Z"),
        (["-o", record, "--axis", "X", "--trigger", "torque>1"], "shows no torque for the trigger"),
        (["-o", record, "--axis", "X", "--pre-trigger", "1"], "belongs to --trigger"),
    ):
        assert cli.run(["status", "tcp://127.0.0.1:1", *options]) == 2, options
        assert words in capsys.readouterr().err
    assert not Path(record).exists()
