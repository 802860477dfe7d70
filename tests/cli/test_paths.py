"""Paths that are no files, outputs that are inputs, folders that cannot be read: one sentence, exit 2,
nothing changed.
"""

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.cli.verbs.checks import validate
from amp_studio.files import atomic

ODD = ("pipe", "folder", "zero", "loop", "nowhere")


@pytest.fixture(params=ODD)
def odd(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    """Return a path that is no file."""
    path = tmp_path / f"{request.param}.csv"
    match request.param:
        case "pipe":
            os.mkfifo(path)
        case "folder":
            path.mkdir()
        case "zero":
            path.symlink_to("/dev/zero")
        case "loop":
            path.symlink_to(path)
        case "nowhere":
            path.symlink_to("nothing")
    return path


@pytest.mark.parametrize(
    "verb",
    [
        "get IT",
        "set IT 1300=1",
        "validate IT",
        "validate MILL --rules IT",
        "diff MILL IT",
        "merge MILL IT MILL -o NEW",
        "report IT -o NEW.csv",
        "import IT -o NEW",
        "import IT -o NEW --family 9pc --format csv",
        "export IT -o NEW.csv",
        "simulate IT step -o NEW.csv",
    ],
)
def test_a_path_that_is_no_file_is_no_input(amp, mill: Path, odd: Path, folder, verb: str) -> None:
    before = folder()
    words = {"IT": odd, "MILL": mill, "NEW": mill.with_name("new.amp"), "NEW.csv": mill.with_name("new.csv")}
    message = amp(*[words.get(word, word) for word in verb.split()])
    assert message.code == 2
    assert odd.name in message.err
    assert folder() == before


@pytest.mark.parametrize(
    "verb",
    [
        "report MILL -o IT",
        "export MILL -o IT",
        "simulate MILL step -o IT",
        "merge MILL MILL MILL -o IT",
        "import MILL -o IT",
        "new 9pc IT",
        "upload --from tcp://127.0.0.1:1 -o IT",
    ],
)
def test_a_path_that_is_no_file_is_no_output(amp, mill: Path, odd: Path, folder, verb: str) -> None:
    before, kind = folder(), odd.lstat().st_mode
    message = amp(*[{"IT": odd, "MILL": mill}.get(word, word) for word in verb.split()])
    assert message.code == 2
    assert odd.name in message.err
    assert (folder(), odd.lstat().st_mode) == (before, kind)


def hard(path: Path, of: Path) -> None:
    """Give a file a second name."""
    path.hardlink_to(of)


@pytest.mark.parametrize("link", [hard, Path.symlink_to])
@pytest.mark.parametrize("verb", ["report MILL -o IT", "export MILL -o IT", "simulate MILL step -o IT"])
def test_an_output_that_is_the_input_by_another_name_is_refused(
    amp, mill: Path, folder, link: Callable[[Path, Path], None], verb: str
) -> None:
    other = mill.with_name("other.csv")
    link(other, mill)
    before = folder()
    message = amp(*[{"IT": other, "MILL": mill}.get(word, word) for word in verb.split()])
    assert message.code == 2
    assert "is the input" in message.err
    assert (folder(), other.is_symlink()) == (before, link is not hard)


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("mill.amp", "is the input"),
        ("./mill.amp", "is the input"),
        ("below/../mill.amp", "is the input"),
        ("mill.amp.bak", "Belongs to mill.amp"),
        ("mill.amp.history", "Belongs to mill.amp"),
        (".mill.amp.unsaved", "Belongs to mill.amp"),
        (".mill.amp.lock", "Belongs to mill.amp"),
    ],
)
def test_an_export_onto_the_file_itself_or_what_is_kept_beside_it_is_refused(
    amp, mill: Path, folder, name: str, message: str
) -> None:
    (mill.parent / "below").mkdir()
    before = folder()
    refused = amp("export", mill, "-o", f"{mill.parent}/{name}", "--format", "csv")
    assert (refused.code, folder()) == (2, before)
    assert message in refused.err


def test_an_export_whose_backup_would_replace_the_input_is_refused(amp, mill: Path, folder) -> None:
    backup = mill.rename(mill.with_name("table.csv.bak"))
    mill.with_name("table.csv").write_bytes(b"older")
    before = folder()
    message = amp("export", backup, "-o", mill.with_name("table.csv"))
    assert (message.code, folder()) == (2, before)
    assert "in the place of the input" in message.err


def test_results_are_not_printed_into_the_output(amp, mill: Path, folder) -> None:
    message = amp("report", mill, "-o", "/dev/stdout")
    assert (message.code, set(folder())) == (2, {"mill.amp"})


def test_a_report_that_does_not_fit_on_the_disk_leaves_the_old_one(
    amp, mill: Path, folder, monkeypatch
) -> None:
    report = mill.with_name("mill.csv")
    report.write_bytes(b"old")

    def full(handle: int, content: bytes) -> int:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(atomic.os, "write", full)
    message = amp("report", mill, "-o", report)
    monkeypatch.undo()
    assert (message.code, set(folder()), report.read_bytes()) == (2, {"mill.amp", "mill.csv"}, b"old")
    assert message.err == f"amp-studio: {report} cannot be written: No space left on device\n"


# -- folders


def test_what_is_no_file_in_a_folder_is_reported_and_the_rest_is_checked(
    amp, mill: Path, tmp_path: Path
) -> None:
    os.mkfifo(tmp_path / "a-pipe.amp")
    (tmp_path / "endless.amp").symlink_to("/dev/zero")
    (tmp_path / "loop.amp").symlink_to("loop.amp")
    message = _validated(tmp_path)
    assert (message[0], message[1]) == (2, ["a-pipe.amp", "endless.amp", "loop.amp"])
    assert "mill.amp: " in message[2]


def test_a_folder_that_cannot_be_read_is_reported_after_the_rest(
    mill: Path, tmp_path: Path, monkeypatch
) -> None:
    """As root reads every folder, the system reports it here by itself."""
    shut = tmp_path / "shut"
    shut.mkdir()
    scandir = os.scandir

    def denied(path: str) -> object:
        if Path(path) == shut:
            raise PermissionError(13, "Permission denied", str(path))
        return scandir(path)

    monkeypatch.setattr(validate.os, "scandir", denied)
    code, unread, out = _validated(tmp_path)
    assert (code, unread) == (2, ["shut"])
    assert "mill.amp: " in out
    code, unread, out = _validated(shut)
    assert (code, unread, out) == (2, ["shut"], "")


def _validated(folder: Path) -> tuple[int, list[str], str]:
    """Check a folder; return the exit code, the names of what could not be read, and the results."""
    import contextlib
    import io

    from amp_studio import cli

    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = cli.run(["validate", str(folder)])
    reported = [line for line in err.getvalue().splitlines() if line.startswith("amp-studio: ")]
    return code, [Path(line.split(": ")[1]).name for line in reported], out.getvalue()


# -- names


def test_a_name_that_is_no_text_is_worked_with_and_shown(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def program(*words: str) -> tuple[int, bytes]:
        done = subprocess.run(
            [sys.executable, "-m", "amp_studio.cli", *words], cwd=tmp_path, capture_output=True, check=False
        )
        return done.returncode, done.stdout + done.stderr

    name, csv, again = (os.fsdecode(n) for n in (b"m\xfcll.amp", b"m\xfcll.csv", b"\xe9.amp"))
    assert program("new", "9pc", name)[1].startswith(b"m\\udcfcll.amp: Allen-Bradley")
    # What is written on a stream is that of the first; what becomes of a name is the same in this process.
    monkeypatch.chdir(tmp_path)
    assert cli.run(["set", name, "1300=2 mm"]) == 0
    assert cli.run(["export", name, "-o", csv]) == 0
    assert cli.run(["report", name, "--changed-only", "-o", os.fsdecode(b"\xff.html")]) == 0
    assert cli.run(["import", csv, "-o", again, "--family", "9pc"]) == 0
    code, out = program("get", again, "1300", "--json")
    assert (code, json.loads(out)["values"][0]["value"]) == (0, 2.0)


def test_a_name_too_long_to_be_edited_can_be_read_and_is_reported(amp, mill: Path) -> None:
    long = mill.rename(mill.with_name(f"{'x' * 250}.amp"))
    assert amp("get", long, "1300").code == 0
    assert amp("report", long, "-o", long.with_suffix(".txt")).code == 0
    message = amp("set", long, "1300=2 mm")
    assert message.code == 2
    assert "The name is too long for the files kept beside it" in message.err


def test_a_path_that_cannot_be_read_and_an_empty_folder_end_no_other_check(
    mill: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "empty").mkdir()
    code = cli.run(["validate", "x" * 5000, str(tmp_path / "empty"), str(mill), "--json"])
    files = json.loads(capsys.readouterr().out)["files"]
    assert (code, len(files)) == (2, 3)
    assert {one["file"] for one in files if "error" in one} == {"x" * 5000, str(tmp_path / "empty")}


@pytest.mark.parametrize("verb", ["validate", "get", "set", "export"])
def test_an_empty_path_is_not_the_folder_one_is_in(amp, verb: str) -> None:
    more = {"set": ["1300=1 mm"], "export": ["-o", "out.csv"]}.get(verb, [])
    assert "the path is empty" in amp(verb, "", *more).err


@pytest.mark.parametrize(
    "name",
    [
        ".other.amp.lock",
        ".other.amp.holder",
        ".other.amp.unsaved",
        "other.amp.bak",
        "other.amp.history",
        "project.yaml",
        "rules.yaml",
        "RULES.YAML",
    ],
)
def test_nothing_is_written_under_a_name_that_the_program_keeps_for_itself(
    amp, mill: Path, name: str
) -> None:
    """Not beside any other file either, whether that file is there or not."""
    output, before = mill.parent / name, sorted(mill.parent.iterdir())
    for words in (
        ("export", mill, "-o", output, "--format", "csv"),
        ("merge", mill, mill, mill, "-o", output),
        ("new", "9pc", output),
        ("simulate", mill, "step", "-o", output),
    ):
        message = amp(*words)
        assert (message.code, message.out) == (2, "")
        assert (
            "choose another name" in message.err
            or "written to such a name" in message.err
            or "-o" in message.err
        )
    assert sorted(mill.parent.iterdir()) == before


@pytest.mark.parametrize("ending", ["/", "//", "/."])
def test_a_name_that_ends_like_a_folder_is_not_the_file_before_it(amp, mill: Path, ending: str) -> None:
    content = mill.read_bytes()
    for words in (
        ("get", f"{mill}{ending}", "1300"),
        ("set", f"{mill}{ending}", "1300=5"),
        ("diff", f"{mill}{ending}", mill),
        ("report", mill, "-o", f"{mill.parent}/new.txt{ending}"),
        ("new", "9pc", f"{mill.parent}/new.amp{ending}"),
    ):
        message = amp(*words)
        assert (message.code, "ends like a folder, and there is no such folder" in message.err) == (2, True)
    assert (mill.read_bytes(), (mill.parent / "new.txt").exists()) == (content, False)
    assert amp("validate", f"{mill.parent}{ending}").code in (0, 1), "a folder may be written so"
