"""Words of a block under a file: printed figures, formats by use, systems of codes,
calls of the builder's programs.
"""

import pytest

from amp_studio.assignments import read_assignments
from amp_studio.files import ParameterFile, new_file, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.programs import BlockReader, ProgramBlockError, ReadBlock, power_up
from amp_studio.programs.block import BlockWord


def example(name: str, **values: str) -> ParameterFile:
    """Return an example with other values."""
    file = open_file(next((examples_folder() / name).glob("*.amp"))).file
    return changed(file, values)


def changed(file: ParameterFile, values: dict[str, str]) -> ParameterFile:
    """Set values of a file by their addresses."""
    file.set_checked(read_assignments(file, values.items()))
    return file


def read(file: ParameterFile, *blocks: str) -> ReadBlock:
    """Return the last of some blocks."""
    reader = BlockReader(file)
    return [reader.read(block) for block in blocks][-1]


def word(file: ParameterFile, *blocks: str, letter: str) -> BlockWord:
    """Return the word of a letter in the last block."""
    return next(word for word in read(file, *blocks).words if word.letter == letter)


@pytest.mark.parametrize(
    ("typed", "zeros", "number"),
    [
        ("X01", "404", 0.001),  # page 15-3, in 4.3
        ("X2790", "404", 2.790),
        ("X01", "407", 100.0),  # page 15-4
        ("X279", "407", 2790.0),
        ("X-01", "407", -100.0),
        ("X27.9", "404", 27.9),  # with a point it is what it is
        ("X279", "", 279.0),
    ],
)
def test_the_printed_numbers_of_words_without_a_point(typed: str, zeros: str, number: float) -> None:
    file = example(
        "mill-1394", **{"404": "Disabled", "407": "Disabled"} | ({zeros: "Enabled"} if zeros else {})
    )
    found = word(file, typed, letter="X")
    assert (found.number, found.unit, found.fault) == (number, "mm", "")
    assert bool(found.assumed) is (zeros == "")


@pytest.mark.parametrize(("typed", "letter", "number"), [("S1500", "S", 15000.0), ("T1", "T", 100000.0)])
def test_zeros_left_out_at_the_end_are_put_back_in_whole_words_too(
    typed: str, letter: str, number: float
) -> None:
    """As `calculate 9pc word_value` has it: page 15-3 makes no exception of words without decimals."""
    file = example("mill-1394", **{"404": "Disabled", "407": "Enabled", "494": "5.0 RPM", "497": "6"})
    found = word(file, typed, letter=letter)
    assert (found.number, found.fault) == (number, "")
    assert ("format.trailing_zeros", "") in found.params


def test_both_zero_modes_leave_a_number_without_a_point_no_place() -> None:
    file = example("mill-1394", **{"404": "Enabled", "407": "Enabled"})
    assert "both zero suppression modes" in word(file, "X1", letter="X").fault
    assert word(file, "X1.", letter="X").number == 1.0


@pytest.mark.parametrize(
    ("unit", "typed", "fits"),
    [
        ("G21", "X9999.999", True),  # 4.3 metric
        ("G21", "X10000.", False),
        ("G21", "X0.0001", False),
        ("G20", "X999.9999", True),  # 3.4 inch
        ("G20", "X1000.", False),
    ],
)
def test_a_word_has_as_many_digits_as_its_format(unit: str, typed: str, fits: bool) -> None:
    found = word(example("mill-1394"), unit, typed, letter="X")
    assert bool(found.fault) is not fits
    assert found.unit == ("in" if unit == "G20" else "mm")


@pytest.mark.parametrize(
    ("choice", "number", "fault"), [("Disabled", 0.0, ""), ("Enabled", None, "a letter without a number")]
)
def test_a_letter_without_a_number_is_what_406_makes_of_it(
    choice: str, number: float | None, fault: str
) -> None:
    found = word(example("mill-1394", **{"406": choice}), "X", letter="X")
    assert (found.number, found.fault) == (number, fault)
    assert ("format.missing_number", "") in found.params


@pytest.mark.parametrize(
    ("machine", "blocks", "letter", "unit", "format_id"),
    [
        ("mill-1394", ("G94 F200",), "F", "mm/min", "letter.f_per_minute"),
        ("mill-1394", ("G95 F.2",), "F", "mm", "letter.f_per_revolution"),
        ("mill-1394", ("G93 F2.",), "F", "min", "letter.f_inverse_time"),
        ("mill-1394", ("G93", "G20 G94 F2."), "F", "in/min", "letter.f_per_minute"),
        ("mill-1394", ("G68 R45.",), "R", "deg", "letter.r_angle"),
        ("mill-1394", ("R45.",), "R", "mm", "letter.r_word"),
        ("mill-1394", ("M19 S90",), "S", "deg", "letter.s_orient"),
        ("mill-1394", ("G96 S90.",), "S", "m/min", "letter.s_css"),
        ("mill-1394", (",C1.",), ",C", "mm", "letter.chamfer"),
        ("mill-1394", ("H3",), "H", "", "letter.h_integer"),
        ("lathe-ls176", ("G76 F1.5",), "F", "mm", "letter.lead"),
        ("lathe-ls176", ("G71 D2.",), "D", "mm", "letter.d_word"),
        ("lathe-ls176", ("D2",), "D", "", "letter.d_integer"),
    ],
)
def test_a_letter_is_read_by_what_is_in_force(
    machine: str, blocks: tuple[str, ...], letter: str, unit: str, format_id: str
) -> None:
    found = word(example(machine), *blocks, letter=letter)
    assert (found.unit, found.params[0][0], found.fault) == (unit, format_id, "")


@pytest.mark.parametrize(
    ("lathe", "code", "meaning"),
    [
        ("Lathe A", "G98", "feed per minute"),  # page 18-2
        ("Lathe B", "G98", "back to the level before the cycle"),
        ("Lathe C", "G70", "inch"),  # page 18-3
        ("Lathe A", "G70", "finishing"),
        ("Lathe A", "G92", "thread, one pass"),
        ("Lathe C", "G21", "thread, one pass"),
    ],
)
def test_a_lathe_has_the_codes_of_its_type(lathe: str, code: str, meaning: str) -> None:
    assert read(example("lathe-ls176", **{"518": lathe}), code).words[0].meaning == meaning


def test_a_lathe_of_type_a_has_words_for_distances() -> None:
    assert (
        word(example("lathe-ls176", **{"518": "Lathe A"}), "U5.", letter="U").meaning
        == "distance of a move along X"
    )
    assert "such a word" in word(example("lathe-ls176", **{"518": "Lathe B"}), "U5.", letter="U").fault


def test_codes_call_programs_of_the_builder_until_the_first_one_that_is_not_used() -> None:
    calls = {"37": "31", "38": "NOT MODAL", "57": "6", "700": "100.1", "701": "MODAL", "702": "1234"}
    more = {"703": "101", "704": "NOT USED", "706": "102", "707": "MODAL", "708": "77"}  # page 20-9: cut off
    file = example("mill-1394", **calls, **more)
    assert (
        read(file, "G31").words[0].meaning
        == "calls the program 9010, not modal, in place of: move until skip signal 1"
    )
    assert read(file, "M06").words[0].meaning == "calls the program 9001"
    assert read(file, "G100.1").words[0].meaning == "calls the program 1234, modal"
    assert not read(file, "G102").words[0].is_known
    assert [line.code for line in power_up(file).calls] == ["G31", "G100.1", "M6"]


def test_a_word_that_calls_a_program_is_no_axis_word() -> None:
    file = example("mill-1394", **{"33": "True"})
    assert word(file, "T12", letter="T").meaning == "calls the program 9000 with its number"
    assert word(file, "T12", letter="T").number == 12.0


@pytest.mark.parametrize("code", ["G47.9", "G87"])
def test_a_code_that_the_control_does_not_take_is_a_fault(code: str) -> None:
    assert read(example("mill-1394" if "." in code else "acromill-router"), code).faults


def test_what_no_page_names_is_not_known() -> None:
    (found,) = read(example("mill-1394"), "G123").words
    assert (found.is_known, found.meaning, found.fault) == (False, "no page here names it", "")


def test_acromill_reads_expressions_branches_and_letters_of_its_cycles() -> None:
    router = example("acromill-router")
    assert word(router, "X(#1+#3)", letter="X").number is None
    assert word(router, "G83 Q.2", letter="Q").meaning == "depth of a peck"
    assert word(router, "G4 F.5", letter="F").unit == "s"
    assert word(router, "G2 I1 J0", letter="I").params == (("control.ij_inversion", ""),)
    assert read(router, "IF P5<5 THEN GOTO 100").words[0].page == "44"
    assert read(router, "N100 P5=P5+1").words[0].meaning == "sets a program parameter"


@pytest.mark.parametrize("block", ["X" * 1001, "@", "X1 ?", "(" * 500, "Ä1"])
def test_what_is_no_block_is_refused_with_a_sentence(block: str) -> None:
    with pytest.raises(ProgramBlockError):
        read(example("acromill-router"), block)


def test_after_power_up_the_codes_are_those_of_the_file() -> None:
    state = power_up(example("mill-1394", **{"526": "Inch mode", "525": "IPR/MMPR", "539": "No"}))
    codes = {line.what: line.code for line in state.active}
    assert (codes["unit"], codes["feed"]) == ("G20", "G95")
    assert [line.meaning for line in state.changes] == [
        "the codes stay as they are",
        "the codes of power-up are back, but for unit",
        "the codes of power-up are back, but for unit",
    ]


def test_a_new_file_names_what_is_not_set() -> None:
    file = new_file("9pc", "mill", ["X", "Y"])
    lines = {line.what: line for line in power_up(file).active}
    assert [(lines[what].code, lines[what].meaning) for what in ("motion", "feed")] == [("", "not set")] * 2
    assert word(file, "F2.", letter="F").unit != "min"  # no code that power-up cannot choose is active


def test_a_word_that_calls_a_program_keeps_what_is_wrong_with_its_number() -> None:
    file = example("mill-1394", **{"33": "True"})
    assert "'1234567' has more" in word(file, "T1234567", letter="T").fault
