"""The command line, run in process: what it prints, where, and with which exit code."""

import json
import re
import shutil
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from amp_studio import cli


@dataclass(frozen=True)
class Outcome:
    """How one run ended."""

    code: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        """Return the one JSON document on standard output."""
        return json.loads(self.out)


MEASURED = ("--sign", "measured-target")


def from_points(path: Path, points: Path) -> tuple[object, ...]:
    """Return the arguments that calibrate X from measured points."""
    return ("calibrate", path, "--axis", "X", "--from", points)


@pytest.fixture
def amp(capsys: pytest.CaptureFixture[str]) -> Callable[..., Outcome]:
    """Return what runs one verb; whatever is refused is refused in one line that names the program."""

    def run(*arguments: object) -> Outcome:
        capsys.readouterr()
        code = cli.run([str(argument) for argument in arguments])
        message = Outcome(code, *capsys.readouterr())
        assert "Traceback" not in message.err
        if code == 2:
            assert message.out == ""
            assert len(message.err.splitlines()) == 1, message.err
            assert message.err.startswith("amp-studio: ")
        return message

    return run


@pytest.fixture(scope="session")
def new_mill(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """Return the content of a new mill with the axes X, Y, A and S;
    of the axes it does not have nothing is set.
    """
    path = tmp_path_factory.mktemp("new") / "mill.amp"
    assert cli.run(["new", "9pc", str(path), "--machine", "mill", "--axes", "X,Y,A,S"]) == 0
    return re.sub(rb"\n  [^\n]*@[5-8]:[^\n]*", b"", path.read_bytes())


@pytest.fixture
def mill(new_mill: bytes, tmp_path: Path) -> Path:
    """Return the path of a new mill with the axes X, Y, A and S."""
    path = tmp_path / "mill.amp"
    path.write_bytes(new_mill)
    return path


@pytest.fixture
def example(checkout: Path, tmp_path: Path) -> Path:
    """Return a copy of the example mill, which has no errors."""
    return Path(shutil.copy(checkout / "examples" / "mill-1394" / "MILL_1394.amp", tmp_path / "mill.amp"))


@pytest.fixture
def folder(tmp_path: Path) -> Callable[[], dict[str, bytes]]:
    """Return what lists the files of the test's folder with their contents."""
    return lambda: {str(p.relative_to(tmp_path)): p.read_bytes() for p in tmp_path.rglob("*") if p.is_file()}
