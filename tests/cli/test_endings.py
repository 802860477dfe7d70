"""How the program ends: the exit code is the truth about the disk,
whatever becomes of its streams and however it is stopped.
"""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from amp_studio import cli
from amp_studio.cli import stopping
from tests.campaigns import CAMPAIGN
from tests.cli.stopped import set_while_stopped
from tests.forked import ended

NOT_READ = "amp-studio: nobody reads the results any more"
pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the program is a copy of this process")


@pytest.fixture
def full():
    """Return a handle to which nothing can be written."""
    with Path("/dev/full").open("wb") as stream:
        yield stream.fileno()


@pytest.fixture
def unread():
    """Return the writing end of a pipe that nobody reads."""
    reading, writing = os.pipe()
    os.close(reading)
    yield writing
    os.close(writing)


def test_a_value_that_is_in_the_file_is_no_refusal_where_the_result_cannot_be_printed(
    mill: Path, full: int
) -> None:
    code, message = ended("set", mill, "1300=1.5", stdout=full)
    assert (code, b"home.calibration@1: 1.5 mm" in mill.read_bytes()) == (3, True)
    assert (
        message
        == f"amp-studio: the results cannot be written: No space left on device; {mill} has been changed and"
        f" contains the new content; its previous content is in {mill}.bak\n"
    )


def test_what_is_done_is_a_success_where_its_reader_has_gone(mill: Path, tmp_path: Path, unread: int) -> None:
    """As an exchange with a control is."""
    code, message = ended("set", mill, "1300=1.5", stdout=unread)
    assert (code, b"home.calibration@1: 1.5 mm" in mill.read_bytes()) == (0, True)
    assert message.startswith(f"{NOT_READ}; {mill} has been changed")
    assert ended("report", mill, "-o", tmp_path / "mill.txt", stdout=unread)[0] == 0
    assert ended("import", tmp_path / "mill.txt", "-o", tmp_path / "new.amp", stdout=unread)[0] == 2


def test_a_new_file_is_shown_to_be_there(mill: Path, tmp_path: Path, full: int) -> None:
    code, message = ended("report", mill, "-o", tmp_path / "mill.txt", stdout=full)
    assert code == 3
    assert f"{tmp_path / 'mill.txt'} has been written and is complete" in message


@pytest.mark.parametrize(
    "arguments", [("get", "{mill}"), ("schema", "9pc", "--json"), ("--help",), ("--version",)]
)
def test_results_that_cannot_be_printed_are_a_refusal_where_nothing_was_changed(
    mill: Path, full: int, arguments: tuple[str, ...]
) -> None:
    code, message = ended(*(text.format(mill=mill) for text in arguments), stdout=full)
    assert (code, message) == (2, "amp-studio: the results cannot be written: No space left on device\n")


def test_a_reader_that_has_enough_gets_no_error(mill: Path, unread: int) -> None:
    assert ended("get", mill, stdout=unread) == (2, "")


def test_notes_that_cannot_be_read_stop_nothing(mill: Path, full: int, unread: int) -> None:
    for stream in (full, unread):  # 1300=0 mm is so already, which is a note
        assert ended("set", mill, "1300=0", stderr=stream)[0] == 0
        assert ended("set", mill, "1300=1e9", stderr=stream)[0] == 2


@pytest.mark.parametrize("closed", [(1,), (2,), (0, 1, 2)])
def test_streams_that_the_shell_has_closed_stop_nothing_and_spoil_no_file(
    mill: Path, closed: tuple[int, ...]
) -> None:
    assert ended("set", mill, "1300=2.5", closed=closed)[0] == 0
    assert ended("get", mill, "--all", closed=closed)[0] == 0
    assert cli.run(["get", str(mill), "1300"]) == 0
    assert b"home.calibration@1: 2.5 mm" in mill.read_bytes()
    assert ended("get", mill, "99999", closed=closed)[0] == 2


def test_it_can_be_stopped_at_any_moment_and_shows_the_state(mill: Path) -> None:
    assert set_while_stopped(mill, seed=1, rounds=12 if CAMPAIGN else 2) == []


@pytest.mark.parametrize("first", [1, 2])
def test_a_file_that_cannot_be_examined_was_not_changed_by_a_verb_that_wrote_nothing(
    amp, mill: Path, monkeypatch, first: int
) -> None:
    stat, asked = Path.stat, []

    def failing(path: Path, **how: bool) -> os.stat_result:
        asked.append(path) if path == mill else None
        if path == mill and len(asked) >= first:
            raise PermissionError(13, "Permission denied", str(path))
        return stat(path, **how)

    monkeypatch.setattr(Path, "stat", failing)
    message = amp("set", mill, "1300=1")
    assert (message.code, "Permission denied" in message.err, "may have been" in message.err) == (
        2,
        True,
        False,
    )


def test_a_file_that_was_written_is_shown_to_be_where_it_cannot_be_examined(
    amp, mill: Path, monkeypatch
) -> None:
    stat = Path.stat

    def failing(path: Path, **how: bool) -> os.stat_result:
        if path == mill and b"1.75 mm" in mill.read_bytes():
            raise PermissionError(13, "Permission denied", str(path))
        return stat(path, **how)

    monkeypatch.setattr(Path, "stat", failing)
    monkeypatch.setattr("amp_studio.cli.program.flush_results", lambda: os.write(-1, b""))
    message = amp("set", mill, "1300=1.75")
    assert (message.code, f"{mill} has been written, and cannot be examined" in message.err) == (3, True)


def test_an_interrupt_that_an_expression_has_swallowed_is_not_forgotten(amp, mill: Path, monkeypatch) -> None:
    def swallow(_: object) -> int:
        monkeypatch.setattr(stopping, "_asked", [signal.SIGINT])
        return 0

    monkeypatch.setattr("amp_studio.cli.verbs.files.get.run", swallow)
    assert (amp("get", mill).code, amp("get", mill).err) == (2, "amp-studio: stopped\n")


def test_an_interrupt_while_a_refusal_is_worded_shows_the_state(amp, mill: Path, monkeypatch) -> None:
    def stop(*_: object) -> str:
        raise KeyboardInterrupt

    def fail(options: object) -> int:
        mill.with_name("new").write_bytes(b"")
        mill.with_name("new").replace(mill)
        raise ValueError("after the change")

    monkeypatch.setattr("amp_studio.cli.program._sentence", stop)
    monkeypatch.setattr("amp_studio.cli.verbs.files.set.run", fail)
    message = amp("set", mill, "1300=1")
    assert (message.code, message.err) == (
        3,
        f"amp-studio: stopped; {mill} has been changed and contains the new content\n",
    )


def test_what_is_unforeseen_is_one_line_with_the_place_of_the_details(amp, mill: Path, monkeypatch) -> None:
    def fail(_: object) -> int:
        raise KeyError("never")

    monkeypatch.setattr("amp_studio.cli.verbs.files.get.run", fail)
    message = amp("get", mill)
    assert (message.code, "should not have happened (KeyError: 'never')" in message.err) == (2, True)
    place = Path(message.err.rpartition("the details are in ")[2].strip())
    assert 'raise KeyError("never")' in place.read_text(encoding="utf-8")


def test_an_interrupt_inside_a_text_given_to_exec_does_not_cost_the_exit_code(tmp_path: Path) -> None:
    """CPython would end itself by the signal; a dataclass is made by such a text."""
    (tmp_path / "interrupted.py").write_text(
        "from amp_studio.cli import program\n"
        "def interrupted(*_):\n"
        "    exec('import os, signal; os.kill(os.getpid(), signal.SIGINT)')\n"
        "program._run = interrupted\n"
        "program.start(['families'])\n",
        encoding="utf-8",
    )
    command = [sys.executable, "-m", "interrupted"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (2, "amp-studio: stopped\n")
