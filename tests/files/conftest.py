"""A file of the 9/PC on disk, and a disk that fails on demand."""

import errno
import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from textwrap import dedent

import pytest

from amp_studio.files import ParameterFile, new_file
from amp_studio.files.storage import save_file
from amp_studio.schema import Value, family_ids, load_schema
from amp_studio.schema import load as loading
from amp_studio.schema.load import load_compiled


@pytest.fixture
def mill() -> ParameterFile:
    """Return a mill with the linear axes X, Y and Z, its servos chosen;
    of the axes it does not have nothing is set.
    """
    file = new_file("9pc", "mill", ["X", "Y", "Z"], name="bench")
    for address in [address for address in file.values if address[1] in tuple("45678")]:
        file.set(address, None)
    for axis in "123":
        file.set(("servo.hardware_type", axis), Value("sercos"))
        file.set(("servo.loop_type", axis), Value("digital"))
    return file


@pytest.fixture
def on_disk(tmp_path: Path, mill: ParameterFile) -> Path:
    """Return the path of the mill, saved."""
    path = tmp_path / "bench.amp"
    save_file(mill, path)
    return path


SMALL = """\
amp_studio: 1
family: 9pc
values:
  control.type: Mill
  axis.type@1: linear
  home.calibration@1: 1.5 mm
  home.position@1: 0.25 in
  axis.name@1: X
...
"""


@pytest.fixture
def small(tmp_path: Path) -> Path:
    """Return the path of a file of five values, as a person may have written it."""
    path = tmp_path / "small.amp"
    path.write_text(SMALL, encoding="utf-8")
    return path


CALLS = ("open", "fdopen", "write", "fsync", "replace", "rename", "chmod", "close", "link")


class FailingDisk:
    """Counts the calls of the operating system that a save makes, and fails one, or all from one on."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self._patch = monkeypatch
        self.made: list[str] = []
        self.fails_at, self.for_ever = 0, False

    def fail(self, at: int, for_ever: bool) -> None:
        """Fail at call ``at``, counting from 1; from then on every call when ``for_ever``."""
        self.made.clear()
        self.fails_at, self.for_ever = at, for_ever
        for name in CALLS:
            if hasattr(os, name):
                self._patch.setattr(os, name, self._failing(name, getattr(os, name)))

    def mend(self) -> None:
        """Let everything pass again."""
        self._patch.undo()

    @property
    def failed(self) -> bool:
        """Whether a call has been made to fail."""
        return 0 < self.fails_at <= len(self.made)

    def _failing(self, name: str, original: Callable[..., object]) -> Callable[..., object]:
        def call(*args: object, **options: object) -> object:
            self.made.append(name)
            n = len(self.made)
            if n == self.fails_at or (self.for_ever and n > self.fails_at):
                if name == "close":
                    original(*args, **options)  # a close that fails has closed anyway
                raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
            return original(*args, **options)

        return call


@pytest.fixture
def disk(monkeypatch: pytest.MonkeyPatch) -> Iterator[FailingDisk]:
    """Return a disk that can be made to fail."""
    with monkeypatch.context() as patch:
        yield FailingDisk(patch)


class Other:
    """Another program: a Python process that runs a script, reports what it has done,
    and waits for a command or its end.
    """

    def __init__(self, script: str, *arguments: object) -> None:
        self.process = subprocess.Popen(
            [sys.executable, "-c", dedent(script), *map(str, arguments)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            encoding="utf-8",
        )

    def says(self) -> str:
        """Return the next line it prints."""
        assert self.process.stdout is not None
        return self.process.stdout.readline().strip()

    def go_on(self) -> None:
        """Let it go on from where it waits for a line."""
        assert self.process.stdin is not None
        self.process.stdin.write("\n")
        self.process.stdin.flush()

    def kill(self) -> None:
        """Kill it as ``kill -9`` does, without a chance to tidy up."""
        self.process.kill()
        self.process.wait()

    def end(self) -> int:
        """Let it end and return its exit code."""
        assert self.process.stdin is not None
        assert self.process.stdout is not None
        self.process.stdin.close()
        self.process.stdout.close()
        return self.process.wait()


@pytest.fixture
def other() -> Iterator[Callable[..., Other]]:
    """Return what starts another program; all of them have ended after the test."""
    started: list[Other] = []

    def start(script: str, *arguments: object) -> Other:
        started.append(Other(script, *arguments))
        return started[-1]

    yield start
    for program in started:
        program.kill()
        program.end()


@pytest.fixture
def family(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[str, str], None]]:
    """Return what writes a small family of our own, which is the whole database during the test."""
    database = tmp_path / "database"
    monkeypatch.setattr(loading, "database_folder", lambda: database)
    monkeypatch.setattr(loading, "cache_folder", lambda: tmp_path / "cache")

    def forget() -> None:
        load_compiled.cache_clear()
        load_schema.cache_clear()

    def write(head: str, parameters: str) -> None:
        name = next(
            line.split(":")[1].strip() for line in dedent(head).splitlines() if line.startswith("family:")
        )
        (database / name / "groups").mkdir(parents=True, exist_ok=True)
        (database / name / "family.yaml").write_text(dedent(head), encoding="utf-8")
        group = f'key: all\nname: All\nchapter: "1"\nparameters:\n{dedent(parameters)}'
        (database / name / "groups" / "all.yaml").write_text(group, encoding="utf-8")
        forget()
        assert name in family_ids()

    forget()
    yield write
    forget()
