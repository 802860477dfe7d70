"""The program as other programs start it: exit codes, streams and encodings."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from amp_studio import __version__
from tests.campaigns import some


def start(*arguments: object, **env: str) -> subprocess.CompletedProcess[bytes]:
    """Run the program and wait for it."""
    command = [sys.executable, "-m", "amp_studio.cli", *map(str, arguments)]
    return subprocess.run(
        command, capture_output=True, check=False, stdin=subprocess.DEVNULL, env=os.environ | env
    )


def test_exit_codes_and_streams_are_those_of_the_contract(mill: Path) -> None:
    right, refused = start("get", mill, "1300", "--json"), start("get", mill, "99999")
    assert [right.returncode, refused.returncode] == [0, 2]
    assert (json.loads(right.stdout)["values"][0]["value"], right.stderr) == (0.0, b"")
    assert refused.stdout == b""
    assert refused.stderr.startswith(b"amp-studio: Unknown parameter '99999'. Did you mean: ")
    assert refused.stderr.count(b"\n") == 1


def test_the_version_and_the_help_are_reported() -> None:
    reported = start("--version")
    assert (0, f"amp-studio {__version__}\n".encode()) == (reported.returncode, reported.stdout)
    reported = start("set", "--help")
    assert (reported.returncode, b"PARAM=VALUE" in reported.stdout) == (0, True)


@pytest.mark.parametrize(("encoding", "degrees"), some([("ascii", r"0\xb0"), ("cp1252", "0°")]))
def test_a_terminal_that_lacks_signs_still_shows_everything(mill: Path, encoding: str, degrees: str) -> None:
    displayed = start("get", mill, "3300", "3207", PYTHONIOENCODING=encoding)
    assert (displayed.returncode, displayed.stderr) == (0, b"")
    assert degrees in displayed.stdout.decode(encoding)


def test_a_document_for_another_program_is_json_in_any_encoding(mill: Path) -> None:
    displayed = start("schema", "grblhal", "--json", PYTHONIOENCODING="ascii")
    assert (displayed.returncode, displayed.stderr) == (0, b"")
    assert json.loads(displayed.stdout)["parameters"][0]["name"] == "Axes"


def test_a_reader_that_has_enough_is_no_fault_to_be_shown() -> None:
    command = [sys.executable, "-m", "amp_studio.cli", "schema", "grblhal", "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as program:
        assert program.stdout.read(1)
        program.stdout.close()
        assert program.stderr.read() == b""
    assert program.wait() > 0


def test_a_message_is_one_line_that_can_be_read_whatever_it_repeats(amp) -> None:
    message = amp("verify", "nothing.amp", "--with", "x" * 1_000_000).err
    assert len(message) < 3100
    message = amp("calculate", "9pc", "x" * 1_000_000).err
    assert len(message) < 3100
