"""A family whose controls take values at their screens only: each exchange with one offers the sheet, in one sentence."""

from __future__ import annotations

import shutil
import socket
from pathlib import Path

import pytest

EXAMPLE = Path(__file__).parents[2] / "examples" / "syntec-mill" / "SYNTEC_MILL.amp"
SENTENCE = "A Syntec control takes values at its parameter screens only"


@pytest.fixture
def nobody() -> str:
    """Return an address at which nothing listens."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        return f"tcp://127.0.0.1:{free.getsockname()[1]}"


@pytest.mark.parametrize("verb", ["download", "verify", "identify"])
def test_who_reaches_no_syntec_control_is_offered_the_sheet_in_the_one_line_of_the_error(
    amp, tmp_path: Path, nobody: str, verb: str
) -> None:
    path = shutil.copy(next(EXAMPLE.parent.glob("*.amp")), tmp_path / "mill.amp")
    line = {
        "download": (path, "--to", nobody, "--accept-errors"),
        "verify": (path, "--with", nobody),
        "identify": (nobody, "--family", "syntec"),
    }[verb]
    said = amp(verb, *line)
    assert said.code == 2
    assert "no connection to the control" in said.err
    assert (
        f"({SENTENCE}, because no protocol of it is published: print what to key in with amp-studio sheet "
        in said.err
    )


def test_other_families_hear_nothing_of_it(amp, tmp_path: Path, nobody: str) -> None:
    assert "sheet" not in amp("identify", nobody, "--family", "num").err


def test_the_sheet_of_a_syntec_has_its_pr_numbers_and_what_the_screens_show(amp, tmp_path: Path) -> None:
    path, other = tmp_path / "mill.amp", tmp_path / "other.amp"
    shutil.copy(next(EXAMPLE.parent.glob("*.amp")), path)
    shutil.copy(path, other)
    assert amp("set", path, "Pr821=7", "Pr61=1500").code == 0
    entries = {
        e["param"]: (e["new"], e["unit"])
        for e in amp("sheet", path, "--against", other, "--json").json["entries"]
    }
    assert entries["Pr61"][0] == "1500"
