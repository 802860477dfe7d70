"""Real programs and real signals: whatever is stopped and when, the exit code and the sentence are the
truth.
"""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from amp_studio import cli
from tests.forked import ended

from . import stopped_exchanges as campaign

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="signals")


def test_a_download_stopped_at_any_moment_ends_with_the_truth(mill: Path, tmp_path: Path) -> None:
    assert campaign.download_while_stopped(mill, tmp_path, seed=3, rounds=2) == []


def test_an_emulated_control_stopped_at_any_moment_shows_goodbye(tmp_path: Path) -> None:
    assert campaign.control_while_stopped(tmp_path, seed=2, rounds=2) == []


def test_ctrl_c_while_the_control_is_silent_stops_at_once_and_the_silence_was_shown(
    mill: Path, tmp_path: Path
) -> None:
    with campaign.emulated(tmp_path / "control", silent=True) as (_, address):
        program = _start("download", mill, "--to", address, "--accept-errors")
        assert program.stderr is not None
        assert "no answer for 2 s, trying again …\n" in program.stderr, "it reads as far as that line"
        program.send_signal(signal.SIGINT)
        begun = time.monotonic()
        _, err = program.communicate(timeout=60)
    message = err.splitlines()[-1]  # before it the silence may have been shown again
    assert (program.returncode, message) == (2, "amp-studio: stopped; nothing was replaced in the control")
    assert time.monotonic() - begun < campaign.LATEST


def test_ctrl_c_twice_while_a_commit_is_not_answered_ends_at_once_with_not_known(
    mill: Path, tmp_path: Path
) -> None:
    assert cli.run(["set", str(mill), "1300=1.5"]) == 0
    with campaign.emulated(tmp_path / "control", die_at_commit_step=3) as (control, address):
        program = _start("download", mill, "--to", address, "--accept-errors")
        control.wait(120)  # it has died in the middle of the commit
        program.send_signal(signal.SIGINT)
        time.sleep(0.3)
        program.send_signal(signal.SIGINT)
        _, err = program.communicate(timeout=60)
    assert program.returncode == 4, err
    message = err.splitlines()[-1]
    assert "stopped before the control has answered" in message
    assert "amp-studio verify FILE --with ADDRESS" in message
    assert "kept in" in message


def test_an_emulated_control_whose_output_is_not_read_serves_on_and_ends_well(
    mill: Path, tmp_path: Path
) -> None:
    """Its first line is read, then the reader is gone."""
    with campaign.emulated(tmp_path / "control") as (control, address):
        assert control.stdout is not None
        assert control.stdin is not None
        control.stdout.close()
        control.stdin.write("estop off\nestop on\n" * 20)
        control.stdin.flush()
        code, message = ended("verify", mill, "--with", address)
        assert code == 1, message
        control.send_signal(signal.SIGINT)
        assert control.wait(120) == 0


def test_the_result_of_a_download_that_cannot_be_printed_is_reported_and_is_no_full_success(
    mill: Path, tmp_path: Path
) -> None:
    assert cli.run(["set", str(mill), "1300=2.5"]) == 0
    with campaign.emulated(tmp_path / "control") as (_, address), Path("/dev/full").open("w") as full:
        code, message = ended("download", mill, "--to", address, "--accept-errors", stdout=full.fileno())
    assert code == 3
    assert "the result cannot be printed; Download complete and read back equal" in message


def test_a_restore_is_complete_where_its_result_is_not_read(mill: Path, tmp_path: Path) -> None:
    reading, writing = os.pipe()
    os.close(reading)
    with campaign.emulated(tmp_path / "control") as (_, address):
        image = tmp_path / "held.img"
        download = ["download", str(mill), "--to", address, "--accept-errors"]
        assert cli.run(download) == 0
        assert cli.run(["upload", "--from", address, "-o", str(image)]) == 0
        assert cli.run(["set", str(mill), "1300=2.5"]) == 0
        assert cli.run(download) == 0
        assert ended("restore", image, "--to", address, stdout=writing, stderr=writing)[0] == 0
        again = tmp_path / "again.img"
        assert cli.run(["upload", "--from", address, "-o", str(again)]) == 0
    os.close(writing)
    assert again.read_bytes() == image.read_bytes()


def _start(*arguments: object) -> subprocess.Popen[str]:
    return subprocess.Popen(
        campaign._command(*arguments), stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
