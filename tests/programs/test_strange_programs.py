"""Programs as they come: what a control does not read, or what no page prints, has a message with its
line."""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile
from amp_studio.programs import BlockReader, path_letters, read_program
from amp_studio.programs.interpreter import tool_path

from .test_block import example

EXAMPLES = {
    "9pc": "mill-1394",
    "num": "num-1060-mill",
    "syntec": "syntec-mill",
    "acromill": "acromill-router",
    "grblhal": "grblhal-router",
    "linuxcnc": "linuxcnc-mill",
}


@pytest.fixture(scope="module")
def files() -> dict[str, ParameterFile]:
    return {family: example(name) for family, name in EXAMPLES.items()}


REFUSED = [
    ("O100 SUB", "O100 SUB"),
    ("o<square> call [5]", "O-words are not simulated"),
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


@pytest.mark.parametrize(
    ("family", "line", "words"),
    [
        *((family, *each) for family in EXAMPLES for each in REFUSED),
        *(
            (family, "G1 X-2 F100 (no end", "the remark is not closed")
            for family in EXAMPLES
            if family != "grblhal"
        ),
    ],
)
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
    assert [*read_program(path)] == ["G1 X-1 F100", "(Fr\ufffdser)", "X-2"]


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


REAL = [
    ("G X-5", "a code without its number", "error:2"),
    ("X", "a letter without a number", "error:2"),
    ("S-5 M3", "is no speed", "error:4"),
    ("N-5 G1 X-5", "below 0", "error:4"),
    ("G4 P-1", "cannot be negative", "error:4"),
    ("/2 G1 X-5", "behind the /", ""),
    ("G2 X-11 Y0 R5 I5", "R and with a center", "error:36"),
    ("G2 X-11 Y0 R4", "no circle of R", "error:34"),
    ("G92", "without an axis", "error:26"),
    ("G92 X1 G1", "both take the words", "error:24"),
    ("G0 G1 X-5", "another code of the group", "error:24"),
    ("G93 G1 X-5", "has no F", "error:22"),
    ("P1 G1 X-5", "no code of the block uses", "error:36"),
    ("L3 G1 X-5", "no code of the block uses", "error:36"),
    ("H1 G1 X-5", "no code of the block uses", "error:36"),
    ("G1 X-5 R2", "no code of the block uses", "error:36"),
]
"""What rs274 of LinuxCNC 2.9.0~pre1 and the simulator of a grblHAL refuse, with the code of the latter."""


@pytest.mark.parametrize("family", ["linuxcnc", "grblhal"])
@pytest.mark.parametrize(("line", "words", "code"), REAL)
def test_what_the_real_control_refuses_is_refused(
    files: dict[str, ParameterFile], family: str, line: str, words: str, code: str
) -> None:
    found = tool_path(files[family], ["G21 G90 F500", "G1 X-1", line, "X-7"])
    assert found.fault is not None
    assert (found.fault.line, words in found.fault.message) == (3, True), found.fault.message
    assert found.fault.code == (code if family == "grblhal" else "")


@pytest.mark.parametrize("line", ["M3 M4 S100", "S100 M3 M5", "M7 M8", "Q5 G1 X-5", "D1 G1 X-5"])
def test_a_linuxcnc_refuses_codes_and_words_that_do_not_belong_together(
    files: dict[str, ParameterFile], line: str
) -> None:
    assert tool_path(files["linuxcnc"], ["G21 F500 G64", "G1 X-1", line]).fault is not None


@pytest.mark.parametrize("family", EXAMPLES)
@pytest.mark.parametrize("line", ["X-5\fX-6", "G X-5", "N-1 X-5", "G4 P1 G0 X-5"])
def test_no_control_gets_a_move_that_was_guessed(
    files: dict[str, ParameterFile], family: str, line: str
) -> None:
    """A G without its number was read as G0, a page feed as a blank, and a move beside a dwell was left
    out.
    """
    found = tool_path(files[family], ["G0 X-1", line])
    assert found.fault is not None
    assert len(found) == 1


def test_several_turns_of_an_arc_are_refused(files: dict[str, ParameterFile]) -> None:
    """gcode.c 3619 of the firmware: P is the number of turns. One turn was planned."""
    for family in ("linuxcnc", "grblhal"):
        found = tool_path(files[family], ["G21 F500", "G2 X0 Y0 I-5 J0 P3"])
        assert "several turns" in (found.fault.message if found.fault else "")


@pytest.mark.parametrize(
    ("content", "line", "words"),
    [
        (b"\xef\xbb\xbfG1 X-5 F500\n", 1, "is no word"),
        (b"G1 X-5 F500\rG1 X-6\rM2\r", 1, "G1 and another code of the group motion"),
        (b"F500\nG1 X-5 (" + b"a" * 250 + b")\n", 2, "at most 252 characters"),
        (b"G1 X-5 F500 M3 M7 M48 M0 M6\n", 1, "at most 4 M codes"),
    ],
    ids=["mark", "returns", "long", "codes"],
)
def test_a_file_that_a_linuxcnc_refuses_is_refused(
    files: dict[str, ParameterFile], tmp_path: Path, content: bytes, line: int, words: str
) -> None:
    """Measured with rs274: Bad character, Two g codes used from same modal group, Command too long, Too many
    m codes.
    """
    path = tmp_path / "a.ngc"
    path.write_bytes(content)
    fault = tool_path(files["linuxcnc"], read_program(path, files["linuxcnc"])).fault
    assert fault is not None
    assert fault.line == line
    assert words in fault.message
    if b"M48" not in content:
        other = tool_path(files["grblhal"], read_program(path, files["grblhal"]))
        # Measured on the firmware: 256 characters are read, and of 257 it is error:11.
        assert (other.fault.code if other.fault else "") == ("error:11" if len(content) > 257 else "")


def test_a_return_alone_is_a_blank_to_a_linuxcnc(files: dict[str, ParameterFile], tmp_path: Path) -> None:
    """rs274 makes one move of both lines."""
    path = tmp_path / "a.ngc"
    path.write_bytes(b"G1 X-5 F500\rY-6\r")
    found = tool_path(files["linuxcnc"], read_program(path, files["linuxcnc"]))
    assert found.fault is None
    assert found.ends[:, :2].tolist() == [[-5.0, -6.0]]


def test_a_tool_is_assumed_to_be_in_the_tool_table_of_a_linuxcnc(files: dict[str, ParameterFile]) -> None:
    """rs274: Requested tool 99 not found in the tool table; T0 is none."""
    for block, is_named in (("T99 M6", True), ("T0 M6", False)):
        notes = tool_path(files["linuxcnc"], [block, "G1 X-5 F500"]).assumptions
        assert any("tool table" in note for note in notes) == is_named


@pytest.mark.parametrize("block", ["G2 X-10 I-5 J0 P3", "G1 X-5 P3", "G1 X-5 L2", "G1 X-5 Q1", "G1 X-5 R2"])
def test_a_word_that_no_code_of_an_acromill_uses_is_refused(
    files: dict[str, ParameterFile], block: str
) -> None:
    """Pages 24 to 41 name no such word: a P in an arc was left out, and the arc was one turn."""
    fault = tool_path(files["acromill"], ["G21 G1 X-1 F500", block]).fault
    assert fault is not None
    assert "no code of the block uses this word" in fault.message
    assert BlockReader(files["acromill"]).read(block).faults
    cycle = ["G21 F500", "G82 X-5 Z-5 R-1 P0.5", "X-9 P1", "X-12 L2", "G80"]
    assert tool_path(files["acromill"], cycle).fault is None


@pytest.mark.parametrize(
    ("block", "fault"),
    [
        ("G22 X10.", "X10.: COR-109: G22 with X needs I too"),
        ("G22 X10. I5. Y5.", "Y5.: COR-109: G22 with Y needs J too"),
        ("G22 K5.", "K5.: COR-109: G22 with K needs Z too"),
        ("G22 X10. I5. Z5. K0.", ""),
        ("G22", ""),
    ],
)
def test_a_range_of_a_syntec_has_both_of_its_ends(
    files: dict[str, ParameterFile], block: str, fault: str
) -> None:
    """Slide 3.4: G22 X_ alone is COR-109, the arguments of a group come together."""
    assert BlockReader(files["syntec"]).read(block).faults == ((fault,) if fault else ())
    found = tool_path(files["syntec"], [block, "G00 X-5."]).fault
    assert (found is not None and found.code == "COR-109") == bool(fault)


@pytest.mark.parametrize(
    ("family", "lines", "message", "code"),
    [
        ("linuxcnc", ["G2 F100"], "without a place and a center", ""),
        ("grblhal", ["G2 F100"], "without a place and a center", "error:35"),
        ("linuxcnc", ["G91 G53 G0 X-5"], "coordinates of the machine is absolute", ""),
        ("linuxcnc", ["G1 X-1 F100", "G2 X-1 Y0 I-0.00126 J0"], "has no radius", ""),
    ],
)
def test_what_the_real_ends_refuse_is_refused(
    files: dict[str, ParameterFile], family: str, lines: list[str], message: str, code: str
) -> None:
    """Measured: rs274 (R i j k words all missing for arc, Cannot use g53 incremental, Zero-radius arc), the
    firmware.
    """
    start = [0.0] * len(path_letters(files[family]))
    fault = tool_path(files[family], lines, start=start, zero=dict.fromkeys("XYZ", 0.0)).fault
    assert fault is not None
    assert message in fault.message
    assert fault.code == code


def test_a_control_has_its_own_statements_alone(files: dict[str, ParameterFile]) -> None:
    """A NUM took branches and program parameters of an AcroMill."""
    for line in ("GOTO 1", "GOSUB 1", "P5=0", "IF P5<5 THEN GOTO 1", "RET"):
        fault = tool_path(files["num"], ["N1 G1 X-1 F100", line, "X-9"]).fault
        assert fault is not None
        assert fault.line == 2
        assert "no end" not in fault.message
        assert "deep" not in fault.message


def test_a_subprogram_of_a_9pc_is_named_and_m02_of_a_num_ends_its_program(
    files: dict[str, ParameterFile],
) -> None:
    """9/PC 25-3: a subprogram call (M98) moved nothing. NUM 7-17: N5 behind M02 is called by G77 alone."""
    fault = tool_path(files["9pc"], ["G1 X-1 F100", "M98 P1"]).fault
    assert fault is not None
    assert fault.message == "M98 is not simulated: calls a subprogram"
    assert len(tool_path(files["num"], ["G1 X-1 F100", "M02", "N5 X-9"])) == 1


@pytest.mark.parametrize(
    ("family", "line", "message", "code"),
    [
        *((family, "N G1 X-5", "N: a letter without a number", "") for family in ("9pc", "num", "linuxcnc")),
        ("grblhal", "N G1 X-5", "N: a letter without a number", "error:2"),
        ("grblhal", "N10000001 G1 X-5", "the greatest number", "error:27"),
        ("grblhal", f"G1 X-5 ({'a' * 260})", "at most 256 characters", "error:11"),
        ("grblhal", "G1 X-5..5", "is no word", "error:1"),
        ("grblhal", "G1 X-+5", "is no word", "error:2"),
        ("grblhal", "G80 X-5", "No code of motion", "error:31"),
        ("grblhal", "G18 G2 X-6 Z0 I-1 J1", "off its circle", "error:33"),
        ("grblhal", "G92.1", "G92.1 is not simulated", ""),
        ("grblhal", "G5 I1 J1 P1 Q1 X5 Y5", "G5 is not simulated", ""),
    ],
)
def test_a_refusal_of_a_real_control_has_its_code(
    files: dict[str, ParameterFile], family: str, line: str, message: str, code: str
) -> None:
    """Measured on the firmware and with rs274 (Bad format unsigned integer); a code that the firmware has was
    called unknown to it.
    """
    fault = tool_path(files[family], ["G1 X-1 F100", line], zero=dict.fromkeys("XYZ", 0.0)).fault
    assert fault is not None
    assert message in fault.message
    assert fault.code == code


@pytest.mark.parametrize(
    ("family", "lines", "end"),
    [
        ("linuxcnc", ["G 21 G9 0", "G 1 X - 1 . 5 F1 00", "X-2"], -2.0),
        ("grblhal", ["G 21 G9 0", "G 1 X - 1 . 5 F1 00", "X-2"], -2.0),
        ("grblhal", ["F100", "G2 X-4 Y0 I-2 J0 K1"], -4.0),
        ("grblhal", ["F100", "N10000000 G1 X-4 (open"], -4.0),
        ("grblhal", ["F100", "G1 X-4 ) Y0"], -4.0),
        ("grblhal", ["F100", "G59.3 M48 G1 X-4"], -4.0),
        ("linuxcnc", ["F100", "G2 X-10.0024 Y0 R5"], -10.0024),
    ],
)
def test_what_the_real_ends_take_is_taken(
    files: dict[str, ParameterFile], family: str, lines: list[str], end: float
) -> None:
    """Measured: blanks inside of words, words of a center outside of the plane, open remarks, 0.00127 mm for
    R.
    """
    path = tool_path(files[family], lines, start=[0.0] * 3, zero=dict.fromkeys("XYZ", 0.0))
    assert path.fault is None
    assert path.ends[-1][0] == pytest.approx(end)


def test_an_arc_by_r_that_is_too_far_for_a_linuxcnc_is_refused(files: dict[str, ParameterFile]) -> None:
    """Measured with rs274: half of the way may be longer than R by 0.00126 mm, and not by 0.00128 mm."""
    for family, x in (("linuxcnc", 10.00256), ("grblhal", 10.0024)):
        fault = tool_path(files[family], ["F100", f"G2 X-{x} Y0 R5"], start=[0.0] * 3).fault
        assert fault is not None
        assert "no circle of R" in fault.message


@pytest.mark.parametrize(("last", "is_noted"), [("X-2", True), ("X-2 M2", False), ("M30", False)])
def test_a_program_of_a_linuxcnc_without_an_end_has_a_note(
    files: dict[str, ParameterFile], last: str, is_noted: bool
) -> None:
    """Measured with rs274: File ended with no percent sign or program end, behind its last block."""
    assumed = tool_path(files["linuxcnc"], ["G1 X-1 F100", last]).assumptions
    assert any("no percent sign" in note for note in assumed) == is_noted
    whole = tool_path(files["linuxcnc"], ["%", "G1 X-1 F100", "%"]).assumptions
    assert not any("no percent sign" in note for note in whole)
