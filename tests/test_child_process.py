"""The command line makes parts of a report on a second processor, and nobody sees a difference."""

import os
import pickle
import signal
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

import pytest

from amp_studio import child_process
from amp_studio.child_process import Awaited, beside
from amp_studio.dossier import write_report
from amp_studio.files import open_file
from amp_studio.files.example_files import examples_folder

needs_copies = pytest.mark.skipif(not hasattr(os, "sched_getaffinity"), reason="made on Linux alone")


@pytest.fixture
def program(monkeypatch: pytest.MonkeyPatch) -> None:
    """Be the command line, on two processors."""
    monkeypatch.setattr(child_process, "_own", [True])
    monkeypatch.setattr(os, "sched_getaffinity", lambda _process: {0, 1})


@needs_copies
@pytest.mark.usefixtures("program")
def test_the_work_is_done_in_a_copy_which_has_gone_afterwards() -> None:
    (process,) = beside(lambda: [os.getpid()])
    assert process != os.getpid()
    with pytest.raises(ChildProcessError):
        os.waitpid(process, os.WNOHANG)


@needs_copies
@pytest.mark.usefixtures("program")
@pytest.mark.parametrize("end", ["error", "exit", "kill"])
def test_what_a_copy_does_not_make_is_made_here(end: str) -> None:
    here = os.getpid()

    def make() -> Iterator[int]:
        yield 1
        if os.getpid() != here:
            if end == "kill":
                os.kill(os.getpid(), signal.SIGKILL)
            raise {"error": ValueError, "exit": SystemExit}[end]
        yield 2

    assert list(beside(make)) == [1, 2]


@needs_copies
@pytest.mark.usefixtures("program")
def test_an_error_of_the_work_is_raised_to_who_asks(capfd: pytest.CaptureFixture[str]) -> None:
    def make() -> list[int]:
        os.write(1, b"once\n")
        raise ValueError("no axis")

    made = beside(make)
    with pytest.raises(ValueError, match="no axis"):
        list(made)
    assert capfd.readouterr().out == "once\n"


@needs_copies
@pytest.mark.usefixtures("program")
def test_without_a_process_to_be_had_it_is_made_here(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(os, "fork", lambda: (_ for _ in ()).throw(BlockingIOError("no process")))
    before = len(list(Path("/proc/self/fd").iterdir()))
    assert list(beside(lambda: [os.getpid()])) == [os.getpid()]
    assert len(list(Path("/proc/self/fd").iterdir())) == before


def test_in_a_program_that_uses_the_library_it_is_made_here_and_not_before_it_is_asked_for() -> None:
    asked: list[int] = []

    def make() -> list[int]:
        asked.append(os.getpid())
        return [3]

    made = beside(make)
    assert asked == []
    assert list(made) == [3]
    assert asked == [os.getpid()]


@needs_copies
@pytest.mark.usefixtures("program")
def test_as_many_are_made_at_once_as_there_are_processors() -> None:
    first = beside(lambda: [os.getpid()])
    assert list(beside(lambda: [os.getpid()])) == [os.getpid()]  # the second processor has the first
    assert list(first) != [os.getpid()]
    assert list(beside(lambda: [os.getpid()])) != [os.getpid()]


def test_what_is_awaited_is_asked_for_at_the_first_look_and_once() -> None:
    asked: list[int] = []

    def make() -> Iterator[str]:
        asked.append(1)
        yield from "ab"

    found = Awaited(make())
    assert asked == []
    assert (len(found), found[0], found[1:], list(found)) == (2, "a", ("b",), ["a", "b"])
    assert pickle.loads(pickle.dumps(found)) == ("a", "b")
    assert asked == [1]


@needs_copies
def test_a_report_is_the_same_to_the_byte(tmp_path: Path, request: pytest.FixtureRequest) -> None:
    path = examples_folder() / "grblhal-router" / "GRBL_ROUTER.amp"
    file, date = open_file(path).file, datetime(2026, 1, 2, tzinfo=UTC)
    write_report(file, tmp_path / "here.html", source=path, date=date)
    request.getfixturevalue("program")
    write_report(file, tmp_path / "beside.html", source=path, date=date)
    assert (tmp_path / "beside.html").read_bytes() == (tmp_path / "here.html").read_bytes()
