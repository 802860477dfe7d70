"""Programs as they come: what a control does not read, or what no page prints, has a message with its line."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile
from amp_studio.programs import read_program, tool_path

from .test_block import example

EXAMPLES = {
    "9pc": "mill-1394",
    "num": "num-1060-mill",
    "syntec": "syntec-mill",
    "acromill": "acromill-router",
    "grblhal": "grblhal-router",
    "linuxcnc": "linuxcnc-mill",
}
WITHOUT_G90 = ("num", "syntec")
"""Whose pages name no G90."""


@pytest.fixture(scope="module")
def files() -> dict[str, ParameterFile]:
    return {family: example(name) for family, name in EXAMPLES.items()}


REFUSED = [
    ("O100 SUB", "O100 SUB"),
    ("o<square> call [5]", "O-words are not simulated"),
    ("G1 X-2 F100 (no end", "the remark is not closed"),
    ("X[1+2]", "is no word"),
    ("X--5", "is no word"),
    ("X1,5", "is no word"),
    ("X\u22125", "is no word"),
    ("X\uff15", "is no word"),
    ("X\u00a05", "is no word"),
    ("\u017f5", "is no word"),
    ("X-5*33", "is no word"),
    ("X-5 /X-6", "is no word"),
    ("X-5 %", "is no word"),
    ("X-5 X-6", "given twice"),
    ("N1 X-5 N2", "given twice"),
    ("G123.4", "no page here names"),
    ("X", "a letter without a number"),
    ("X1e3", "such a word"),
]


@pytest.mark.parametrize("family", EXAMPLES)
@pytest.mark.parametrize(("line", "words"), REFUSED)
def test_a_block_that_cannot_be_read_is_named_by_its_line(
    files: dict[str, ParameterFile], family: str, line: str, words: str
) -> None:
    move = "G0 X-1" if family == "syntec" else "G1 X-1 F100"
    found = tool_path(files[family], [move, "", line, "X-7"])
    assert found.fault is not None
    assert found.fault.line == 3
    assert words in found.fault.message
    assert len(found) == 1


READ = [
    ["g1 x-1 f100", "x-2", "m30"],
    ["G1X-1F100", "X-2M30"],
    ["G1\tX-1\tF100", "  X -2\t"],
    ["N100 G1 X-1 F100", "N20 X-2", "N5"],
    ["(Fräser Ø6, für Größe ſ)", "G1 X-1 F100 ; hin", "X-2 (läuft)", ";"],
    ["(MSG, tool 5)", "G1 X-1 F100", "(DEBUG, #1)", "X-2"],
    ["G1 X-1 F100", "/X-2"],
    ["%", "G1 X-1 F100", "X-2", "%"],
    ["%1234", "G1 X-1 F100", "X-2"],
]


@pytest.mark.parametrize("family", [each for each in EXAMPLES if each != "syntec"])  # it has no G1
@pytest.mark.parametrize("lines", READ, ids=lambda lines: lines[0])
def test_a_program_of_any_hand_is_read(
    files: dict[str, ParameterFile], family: str, lines: list[str]
) -> None:
    found = tool_path(files[family], lines)
    assert found.fault is None
    assert len(found) == 2


@pytest.mark.parametrize("ends", [b"\r", b"\n", b"\r\n"])
def test_lines_end_in_each_way(tmp_path: Path, ends: bytes) -> None:
    path = tmp_path / "a.nc"
    path.write_bytes(b"\xef\xbb\xbf" + ends.join((b"G1 X-1 F100", b"(Fr\xe4ser)", b"X-2", b"")))
    assert read_program(path) == ["G1 X-1 F100", "(Fr\ufffdser)", "X-2"]


def test_blocks_behind_the_percent_are_not_run_where_it_ends_the_program(
    files: dict[str, ParameterFile],
) -> None:
    """LinuxCNC: R1418 of 2.9.8. grblHAL: C1276. The pages of the others do not print it."""
    lines = ["%", "G1 X-1 F100", "%", "X-2"]
    found = {family: tool_path(file, lines) for family, file in files.items() if family != "syntec"}
    assert {family: len(each) for family, each in found.items()} == {
        "9pc": 1,
        "num": 1,
        "acromill": 1,
        "grblhal": 2,
        "linuxcnc": 1,
    }
    assert any("line 3 ends the program" in note for note in found["9pc"].assumptions)
    alone = tool_path(files["linuxcnc"], lines[1:])
    assert alone.fault is not None
    assert "does not begin with one" in alone.fault.message


def test_a_skipped_block_is_among_what_is_assumed(files: dict[str, ParameterFile]) -> None:
    found = tool_path(files["grblhal"], ["/G1 X-1 F100"])
    assert any("/ in front are run" in note for note in found.assumptions)


def test_a_number_inside_a_block_is_refused_where_the_source_refuses_it(
    files: dict[str, ParameterFile],
) -> None:
    fault = tool_path(files["linuxcnc"], ["N1 G1 X-1 F100", "X-2 N3"]).fault
    assert fault is not None
    assert (fault.line, fault.message) == (2, "N is not at the beginning of its block")
    assert tool_path(files["grblhal"], ["G1 X-1 F100", "X-2 N3"]).fault is None


def test_the_number_of_a_program_is_read_where_a_page_names_it(files: dict[str, ParameterFile]) -> None:
    lines = ["O1234 (PART)", "G0 X-1"]
    faults = {family: tool_path(file, lines).fault for family, file in files.items()}
    assert {family for family, fault in faults.items() if fault is None} == {"9pc", "grblhal"}
    assert {fault.message for fault in faults.values() if fault is not None} == {
        "O: numbers of programs and subroutines are not simulated"
    }
