"""The main job against an emulated control in a separate process, by the command line's verbs."""

from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.files import new_file, open_file
from amp_studio.files.range_decisions import out_of_range
from amp_studio.schema import Value
from amp_studio.transfer.image import decode_image
from tests.campaigns import some
from tests.forked import Program
from tests.transfer.conftest import StartControl


def panel(process: Program, command: str) -> str:
    """Do something at the control's panel and return what it answers; its earlier answers are read over."""
    process.stdin.write(command + "\n")
    process.stdin.flush()
    verb = command.partition(" ")[0]
    return next(line.strip() for line in process.stdout if line.startswith(verb))


@pytest.mark.parametrize("line", some(["tcp://127.0.0.1:0", "pty:"], 2))
def test_download_verify_upload_and_nothing_differs(
    line: str, mill: Path, start_control: StartControl, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The whole round over the network and over a serial line; 10 in/min comes back as 10 in/min."""
    _, address = start_control(line)
    upload = tmp_path / "from-control.amp"

    assert run(["download", str(mill), "--to", address]) == 0
    assert run(["verify", str(mill), "--with", address]) == 0
    assert run(["upload", "--from", address, "-o", str(upload)]) == 0
    assert run(["diff", str(mill), str(upload), "--json"]) == 0

    assert open_file(upload).file.values == open_file(mill).file.values
    kept = list(tmp_path.glob("mill.before-*.amp"))
    assert len(kept) == 1
    assert decode_image(kept[0].with_suffix(".img").read_bytes()).values == new_file("9pc", "mill").values
    assert open_file(kept[0]).file.values == new_file("9pc", "mill").values
    assert '"differences": []' in capsys.readouterr().out


def test_out_of_estop_nothing_is_sent(
    mill: Path, start_control: StartControl, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """The control must be in E-stop (page 2-14); one line reports it, and nothing was replaced."""
    process, address = start_control("tcp://127.0.0.1:0", "--no-estop")
    before = (tmp_path / "control" / "active.img").read_bytes()

    assert run(["download", str(mill), "--to", address]) == 2

    message = capsys.readouterr().err.strip().splitlines()[-1]
    assert "E-stop" in message
    assert (tmp_path / "control" / "active.img").read_bytes() == before
    assert panel(process, "estop on") == "estop on"
    assert run(["download", str(mill), "--to", address]) == 0


def test_a_control_that_is_restarted_by_hand_shows_it(
    mill: Path, start_control: StartControl, capsys: pytest.CaptureFixture[str]
) -> None:
    """Without autostart the new file is current only after a restart (page 2-14)."""
    _, address = start_control("tcp://127.0.0.1:0", "--manual-restart")

    assert run(["download", str(mill), "--to", address]) == 0

    assert "Restart the control" in capsys.readouterr().out


def test_an_upload_with_a_patched_value_is_walked_through(
    mill: Path, start_control: StartControl, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A value keyed in out of range stops the upload, or is kept and marked (page 2-24)."""
    process, address = start_control()
    assert run(["download", str(mill), "--to", address]) == 0
    assert panel(process, "patch 1203=99999") == "patch 1203=99999"
    upload = tmp_path / "patched.amp"

    assert run(["upload", "--from", address, "-o", str(upload)]) == 2
    assert not upload.exists()
    assert "1203 Rapid Feedrate for Positioning" in capsys.readouterr().err

    assert run(["upload", "--from", address, "-o", str(upload), "--on-fault", "keep"]) == 0
    file = open_file(upload).file
    assert file.get(("feedrate.rapid", "1")) == Value(99999.0, "mm/s")
    assert ("feedrate.rapid", "1") in file.forced
    assert run(["validate", str(upload)]) == 1
    assert run(["verify", str(mill), "--with", address]) == 1


def test_an_upload_gets_a_new_name(mill: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """A file that is there is never overwritten by an upload (page 2-23); the control is not even asked."""
    assert run(["upload", "--from", "tcp://127.0.0.1:1", "-o", str(mill)]) == 2
    assert "new name" in capsys.readouterr().err


def test_only_values_that_exist_for_the_machine_are_walked_through() -> None:
    """A value of a hidden parameter is no reason to stop an upload; one that another bounds is (page 9-2)."""
    file = new_file("9pc", "mill", ["X"])
    file.set(("servo.excess_error", "1"), Value(999.0, "mm"))
    file.set(("feedrate.rapid", "1"), Value(-1.0, "mm/min"))

    assert [address for address, _ in out_of_range(file)] == [
        ("feedrate.rapid", "1"),
        ("feedrate.max_cutting", "1"),
    ]
