"""Whatever a control contains, a download replaces it, keeps it, and it can be put back,
by the command line's verbs.
"""

import hashlib
import json
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.files import Document, new_file, open_file
from amp_studio.transfer.image import encode_image
from tests.campaigns import CAMPAIGN, some
from tests.transfer.conftest import StartControl

GARBAGE = b"\x00\xff no image\r\n"
SHORT_OF_GARBAGE = hashlib.sha256(GARBAGE).hexdigest()[:12]


def sha(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()


def mill_image() -> bytes:
    return encode_image(new_file("9pc", "mill", ["X"]))


HOSTILE = {
    "garbage": GARBAGE,
    "another family": encode_image(new_file("num")),
    "another schema": mill_image().replace(b"signature ", b"signature 0"),
    "a value without its unit": mill_image().replace(b"home.calibration@1\t0 mm", b"home.calibration@1\t0"),
    "a damaged machine line": mill_image().replace(b"machine mill", b"machine \x1b[2Jmill"),
    "an infinite number": mill_image().replace(b"home.calibration@1\t0 mm", b"home.calibration@1\t1e999 mm"),
    "a family that is a path": mill_image().replace(b"family 9pc", b"family ../../../tmp/x"),
    "errors": mill_image(),
}


@dataclass
class Bench:
    """A control that was started with an image in its memory, and what the verbs printed last."""

    address: str
    active: Path
    folder: Path
    printed: Callable[[], tuple[str, str]]

    def kept(self) -> list[Path]:
        return sorted(self.folder.glob("*.before-*.img"))


@pytest.fixture
def bench(
    start_control: StartControl, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> Callable[[bytes], Bench]:
    """Give a function that starts a control which contains these bytes."""

    def make(at_control: bytes) -> Bench:
        memory = tmp_path / "control"
        memory.mkdir()
        (memory / "active.img").write_bytes(at_control)
        _, address = start_control()
        return Bench(address, memory / "active.img", tmp_path, capsys.readouterr)

    return make


@pytest.mark.parametrize("what", some(HOSTILE if CAMPAIGN else ("garbage", "another schema", "errors"), 2))
def test_whatever_a_control_contains_is_kept_replaced_and_put_back(
    what: str, bench: Callable[[bytes], Bench], mill: Path
) -> None:
    """Byte for byte, and what the restore replaces is kept just so."""
    at_control = HOSTILE[what]
    control = bench(at_control)
    sent = encode_image(open_file(mill).file)

    assert run(["download", str(mill), "--to", control.address]) == 0
    [first] = control.kept()
    assert first.read_bytes() == at_control
    assert control.active.read_bytes() == sent

    assert control.printed()[0].startswith("Download complete and read back equal; the control has restarted")
    assert run(["restore", str(first), "--to", control.address, "--expect", sha(sent)]) == 0
    assert control.printed()[0].startswith("Restore complete and read back equal; the control has restarted")
    assert control.active.read_bytes() == at_control
    [second] = [path for path in control.kept() if path != first]
    assert second.name.startswith("mill.before-")
    assert second.name.count(".before-") == 1
    assert second.read_bytes() == sent

    assert run(["restore", str(second.with_suffix(".amp")), "--to", control.address]) == 0
    assert control.active.read_bytes() == sent


def test_a_control_takes_back_what_it_kept_two_downloads_ago(
    bench: Callable[[bytes], Bench], mill: Path, tmp_path: Path
) -> None:
    control = bench(GARBAGE)
    other = tmp_path / "other.amp"
    Document.create(new_file("9pc", "mill", ["X", "Y"]), other).close()
    assert run(["download", str(mill), "--to", control.address]) == 0
    [first] = control.kept()
    assert run(["download", str(other), "--to", control.address, "--accept-errors"]) == 0

    assert run(["restore", str(first), "--to", control.address]) == 0

    assert control.active.read_bytes() == GARBAGE


@pytest.mark.parametrize(
    "image", some([GARBAGE, HOSTILE["another family"], HOSTILE["a value without its unit"]], 2)
)
def test_what_a_control_never_kept_and_cannot_read_it_refuses(
    image: bytes, bench: Callable[[bytes], Bench], tmp_path: Path
) -> None:
    """A copy from another control is no copy of this one."""
    control = bench(mill_image())
    copy = tmp_path / "copy.img"
    copy.write_bytes(image)

    assert run(["restore", str(copy), "--to", control.address]) == 2

    printed = control.printed().err.strip().splitlines()[-1]
    assert "has not contained" in printed
    assert printed.endswith("nothing was replaced in the control")
    assert control.active.read_bytes() == mill_image()


def test_an_empty_control_has_nothing_to_keep_and_shows_it(
    bench: Callable[[bytes], Bench], mill: Path
) -> None:
    control = bench(b"")

    assert run(["upload", "--from", control.address, "-o", str(control.folder / "new.img")]) == 2
    assert "the control is empty" in control.printed().err
    assert run(["verify", str(mill), "--with", control.address]) == 1
    assert "The control contains something else: nothing." in control.printed().out
    assert run(["download", str(mill), "--to", control.address, "--expect", sha(b"")]) == 0

    assert "It was empty before." in control.printed().out
    assert control.kept() == []


def test_a_restore_shows_what_is_wrong_with_what_goes_back(
    bench: Callable[[bytes], Bench], mill: Path
) -> None:
    """Errors are listed but are no reason to refuse what a control contained."""
    control = bench(mill_image())
    assert run(["download", str(mill), "--to", control.address]) == 0
    [first] = control.kept()
    control.printed()

    assert run(["restore", str(first), "--to", control.address]) == 0

    printed = control.printed().err
    assert "error 1030 Servo Hardware Type" in printed
    assert "goes back with 2 errors, as the control contained it" in printed
    assert control.active.read_bytes() == mill_image()


def test_a_parameter_file_with_errors_that_no_control_kept_is_not_restored(
    bench: Callable[[bytes], Bench], tmp_path: Path
) -> None:
    control = bench(mill_image())
    path = tmp_path / "mine.amp"
    Document.create(new_file("9pc", "mill", ["X", "Y"]), path).close()

    assert run(["restore", str(path), "--to", control.address]) == 2

    assert "no image beside it proves that a control contained it" in control.printed().err
    assert control.active.read_bytes() == mill_image()


def test_a_restore_out_of_estop_is_refused(
    bench: Callable[[bytes], Bench], start_control: StartControl, tmp_path: Path
) -> None:
    copy = tmp_path / "copy.img"
    copy.write_bytes(mill_image())
    (tmp_path / "control").mkdir()
    (tmp_path / "control" / "active.img").write_bytes(GARBAGE)
    _, address = start_control("tcp://127.0.0.1:0", "--no-estop")
    assert run(["restore", str(copy), "--to", address]) == 2
    assert (tmp_path / "control" / "active.img").read_bytes() == GARBAGE
    assert list(tmp_path.glob("*.before-*")) == []


def test_without_a_place_to_keep_it_nothing_is_replaced(
    bench: Callable[[bytes], Bench], mill: Path, tmp_path: Path
) -> None:
    control = bench(GARBAGE)
    nowhere = tmp_path / "no folder"

    assert run(["download", str(mill), "--to", control.address, "--keep", str(nowhere)]) == 2

    printed = control.printed().err.strip().splitlines()[-1]
    assert "what the control contains could not be kept (" in printed
    assert printed.endswith(": No such file or directory); nothing was replaced in the control")
    assert control.active.read_bytes() == GARBAGE


# -- what is approved -------------------------------------------------------------------------------


@pytest.mark.parametrize("verb", ["download", "restore"])
def test_only_what_was_approved_is_replaced(verb: str, bench: Callable[[bytes], Bench], mill: Path) -> None:
    """Somebody changed the control after it was checked: exit 2, both digests in the sentence,
    nothing replaced or kept.
    """
    control = bench(GARBAGE)
    copy = control.folder / "copy.img"
    copy.write_bytes(mill_image())
    path = mill if verb == "download" else copy

    assert run([verb, str(path), "--to", control.address, "--expect", sha(b"seen")]) == 2

    printed = control.printed().err.strip().splitlines()[-1]
    assert f"sha256 {SHORT_OF_GARBAGE}…, approved {sha(b'seen')[:12]}…" in printed
    assert printed.endswith("nothing was replaced in the control")
    assert control.active.read_bytes() == GARBAGE
    assert control.kept() == []


@pytest.mark.parametrize("digest", ["", "0", "g" * 64, "0" * 63, "0" * 65, "0x" + "0" * 62])
def test_what_is_no_digest_is_refused_before_anything_is_asked(
    digest: str, mill: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["download", str(mill), "--to", "tcp://127.0.0.1:1", "--expect", digest]) == 2
    assert "is no SHA-256" in capsys.readouterr().err


def test_the_digest_that_verify_prints_is_the_one_to_pass_on(
    bench: Callable[[bytes], Bench], mill: Path
) -> None:
    """Verify, upload and diff print the same; so does JSON."""
    control = bench(mill_image())
    image, file = control.folder / "held.img", control.folder / "held.amp"
    printed = []
    for verb in (
        ["verify", str(mill), "--with", control.address],
        ["upload", "--from", control.address, "-o", str(image)],
        ["upload", "--from", control.address, "-o", str(file)],
        ["diff", str(mill), control.address],
    ):
        run(verb)
        printed.append(control.printed().out.splitlines()[-1])
    run(["verify", str(mill), "--with", control.address, "--json"])
    printed.append("sha256 " + json.loads(control.printed().out)["sha256"])
    run(["diff", str(mill), control.address, "--json"])
    printed.append("sha256 " + json.loads(control.printed().out)["sha256"]["b"])

    assert printed == [f"sha256 {sha(mill_image())}"] * 6
    assert image.read_bytes() == mill_image()
    assert (
        run(["download", str(mill), "--to", control.address, "--expect", printed[0].split()[1].upper()]) == 0
    )


# -- a file with errors ------------------------------------------------------------------------------


def test_a_file_with_errors_is_not_sent_unless_they_are_accepted(
    bench: Callable[[bytes], Bench], tmp_path: Path
) -> None:
    """Its errors are listed either way; the control is not even asked in the first case."""
    path = tmp_path / "mine.amp"
    Document.create(new_file("9pc", "mill", ["X", "Y"]), path).close()
    control = bench(GARBAGE)

    assert run(["download", str(path), "--to", "tcp://127.0.0.1:1"]) == 2
    out, printed = control.printed()
    assert out == ""
    assert [line.split()[0] for line in printed.splitlines()] == ["error"] * 2 + ["amp-studio:"], (
        "what is wrong with both axes alike is one line"
    )
    assert (
        printed.splitlines()[-1]
        == f"amp-studio: {path} has 4 errors: nothing was sent (--accept-errors sends it anyway)"
    )
    assert control.active.read_bytes() == GARBAGE

    assert run(["download", str(path), "--to", control.address, "--accept-errors"]) == 0
    out, printed = control.printed()
    assert [line.split()[0] for line in printed.splitlines()].count("error") == 2
    assert out.startswith("Download complete")


def test_an_error_of_the_builders_own_rules_counts(mill: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (mill.parent / "rules.yaml").write_text(
        "rules:\n  - id: own.slow\n    title: Slow\n    family: 9pc\n    severity: error\n"
        '    reads: {speed: home.speed_off_switch}\n    check: speed < 1.0\n    message: "Too fast."\n'
    )
    assert run(["download", str(mill), "--to", "tcp://127.0.0.1:1"]) == 2
    printed = capsys.readouterr().err
    assert "Too fast." in printed
    assert "nothing was sent" in printed


# -- verify ------------------------------------------------------------------------------------------


def test_verify_reports_a_header_that_differs(bench: Callable[[bytes], Bench], tmp_path: Path) -> None:
    """The values are the same, a byte is not: exit 1, and the line is named."""
    control = bench(mill_image())
    path = tmp_path / "mine.amp"
    file = new_file("9pc", "mill", ["X"])
    file.header.revision = "3.05"
    Document.create(file, path).close()

    assert run(["verify", str(path), "--with", control.address]) == 1
    printed = control.printed().out
    assert "revision in the header: '3.05'  |  ''" in printed
    assert "All values are the same; only the header (revision) differs." in printed
    assert run(["verify", str(path), "--with", control.address, "--json"]) == 1
    reported = json.loads(control.printed().out)
    assert (reported["differences"], reported["same_bytes"]) == ([], False)
    assert reported["header"] == [{"line": "revision", "a": "3.05", "b": ""}]


def test_verify_reports_a_value_in_another_unit(bench: Callable[[bytes], Bench], tmp_path: Path) -> None:
    """25.4 mm and 1 in are the same value and not the same bytes."""
    file = new_file("9pc", "mill", ["X"])
    file.set(file.find("1300"), file.read(file.find("1300"), "1 in"))
    control = bench(encode_image(file))
    file.set(file.find("1300"), file.read(file.find("1300"), "25.4 mm"))
    path = tmp_path / "mine.amp"
    Document.create(file, path).close()

    assert run(["verify", str(path), "--with", control.address]) == 1

    printed = control.printed().out
    assert "0 differ, " in printed
    assert "1300 Home Calibration" in printed
    assert "only the units of some values differ" in printed


def test_verify_of_what_cannot_be_read_shows_it(bench: Callable[[bytes], Bench], mill: Path) -> None:
    control = bench(GARBAGE)
    assert run(["verify", str(mill), "--with", control.address]) == 1
    assert "The control contains something else: the control image is not text." in control.printed().out
    assert run(["verify", str(mill), "--with", control.address, "--json"]) == 1
    reported = json.loads(control.printed().out)
    assert (reported["differences"], reported["same_bytes"], reported["header"]) == ([], False, [])
    assert reported["unreadable"] == "the control image is not text"


@pytest.mark.parametrize(
    "verb", [["verify", "FILE", "--with"], ["upload", "-o", "new.amp", "--from"], ["diff", "FILE"]]
)
def test_who_only_looks_gets_no_word_of_what_was_replaced(
    verb: list[str], mill: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """After a download of unknown outcome that would be the wrong answer to the question."""
    arguments = [str(mill) if word == "FILE" else word for word in verb]
    assert run([*arguments, "tcp://127.0.0.1:1"]) == 2
    printed = capsys.readouterr().err
    assert "no connection to the control" in printed
    assert "replaced" not in printed


# -- uploads -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("what", ["garbage", "a value without its unit", "a damaged machine line"])
def test_an_upload_writes_no_file_of_what_cannot_be_read(
    what: str, bench: Callable[[bytes], Bench], tmp_path: Path
) -> None:
    """The message explains how to keep it byte for byte, and that can be put back."""
    control = bench(HOSTILE[what])
    path = tmp_path / "new.amp"

    assert run(["upload", "--from", control.address, "-o", str(path), "--on-fault", "keep"]) == 2
    assert f"nothing was written (-o {tmp_path / 'new.img'} keeps it byte for byte)" in control.printed().err
    assert not path.exists()

    assert run(["upload", "--from", control.address, "-o", str(tmp_path / "new.img")]) == 0
    assert (tmp_path / "new.img").read_bytes() == HOSTILE[what]
    assert (tmp_path / "new.img.sha256").read_text() == f"{sha(HOSTILE[what])}  new.img\n"
    assert run(["upload", "--from", control.address, "-o", str(tmp_path / "new.img")]) == 2


@pytest.mark.parametrize(
    "port", ["/dev/null", "/dev/zero", "serial:/dev/full", "serial:/etc/passwd", "serial:/tmp"]
)
def test_what_is_no_serial_port_is_reported(
    port: str, mill: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["verify", str(mill), "--with", port]) == 2
    assert "this is no serial port" in capsys.readouterr().err


def test_a_digest_that_cannot_be_read_is_not_taken_for_none(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "a.img").write_bytes(b"what a control contained")
    (tmp_path / "a.img.sha256").symlink_to("nowhere")
    assert run(["restore", str(tmp_path / "a.img"), "--to", "tcp://127.0.0.1:1"]) == 2
    assert "a.img.sha256" in capsys.readouterr().err
