"""Whole programs to their path: modal state, arcs, coordinates, printed cycles, branches; what is refused."""

from pathlib import Path

import numpy as np
import pytest

from amp_studio.assignments import read_assignments
from amp_studio.files import ParameterFile, new_file
from amp_studio.programs import ARC, DWELL, RAPID, ProgramBlockError, ToolPath, read_program
from amp_studio.programs.interpreter import MAX_REPEATED, tool_path
from amp_studio.programs.toolpath import LINE
from amp_studio.programs.words import LONGEST

from .test_block import example


@pytest.fixture(scope="module")
def router() -> ParameterFile:
    return example("acromill-router")


def path(file: ParameterFile, text: str, **given: float) -> ToolPath:
    """Return the path of blocks separated by ``|``."""
    return tool_path(file, [block.strip() for block in text.split("|")], **given)


def ends(found: ToolPath) -> list[tuple[float, ...]]:
    """Return the ends of all rows in mm."""
    return [tuple(np.round(end, 6).tolist()) for end in found.ends]


def test_modal_codes_last_and_axes_that_are_not_named_stay(router: ParameterFile) -> None:
    found = path(router, "G21 G90 G0 X-10|G1 Y-20 F600|X-30|G91 Z-1|G0 X5")
    assert ends(found) == [(-10, 0, 0), (-10, -20, 0), (-30, -20, 0), (-30, -20, -1), (-25, -20, -1)]
    assert found.kind.tolist() == [RAPID, LINE, LINE, LINE, RAPID]
    assert found.feed.tolist() == [0.0, 10.0, 10.0, 10.0, 0.0]


def test_inch_and_metric_are_read_where_they_are_active(router: ParameterFile) -> None:
    found = path(router, "X-1 F10|G21 X-1 F10|G70 X-2")
    assert found.ends[:, 0].tolist() == pytest.approx([-25.4, -1.0, -50.8])
    assert found.feed.tolist() == pytest.approx([254.0 / 60.0, 10.0 / 60.0, 10.0 / 60.0])


def test_a_program_without_a_feed_moves_at_cut_speed(router: ParameterFile) -> None:
    """Page 74."""
    assert path(router, "G1 X-1").feed.tolist() == pytest.approx([10.0 * 25.4 / 60.0])


@pytest.mark.parametrize(
    ("selected", "i", "j"), [("G200 F2", "X", -10.0), ("G200 F1", "d", 10.0), ("G200 F0", "n", -10.0)]
)
def test_the_three_ways_to_give_the_center_of_an_arc(
    router: ParameterFile, selected: str, i: str, j: float
) -> None:
    """Page 41: against, with, and absolute; a quarter around (-20, -10) from (-20, -20)."""
    words = {"X": "I-20 J-10", "d": f"I0 J{j}", "n": f"I0 J{j}"}[i]
    found = path(router, f"G21|{selected}|G0 X-20 Y-20|G3 X-10 Y-10 {words} F600")
    assert found.fault is None
    assert found.center[1].tolist() == pytest.approx([-20.0, -10.0])
    assert found.sweep[1] == pytest.approx(np.pi / 2.0)


def test_a_whole_circle_and_a_helix_in_the_plane_of_z_and_x(router: ParameterFile) -> None:
    circle = path(router, "G21 G200 F1|G0 X-20 Y-20|G2 X-20 Y-20 I5 J0 F600")
    assert circle.kind.tolist() == [RAPID, ARC]
    assert circle.sweep[1] == pytest.approx(-2.0 * np.pi)
    helix = path(router, "G21 G200 F1 G18|G0 X-20 Z-20|G2 X-30 Z-10 I-10 K0 Y-3 F600")
    assert helix.fault is None
    assert helix.center[1].tolist() == pytest.approx([-20.0, -30.0])  # Z first, then X
    assert helix.sweep[1] == pytest.approx(-np.pi / 2.0)


def test_an_arc_that_misses_its_circle_ends_the_path_there(router: ParameterFile) -> None:
    found = path(router, "G21 G200 F1|G0 X-20 Y-20|G2 X-20 Y-40 I5 J0 F600|G0 X0")
    assert len(found) == 1
    assert found.fault is not None
    assert (found.fault.line, found.fault.block[:2]) == (3, "G2")
    assert "off its circle" in found.fault.message


def test_deep_hole_drilling_does_the_printed_steps(router: ParameterFile) -> None:
    """Page 38: Q, out to R, in to D before the depth, Q and D; D is 0.05 inch in the example."""
    found = path(router, "G20 G0 X-3 Y-3 Z-0.5|G98 G83 X-4 Z-2 R-1 Q0.4 F10")
    depths = np.round(found.ends[1:, 2] / 25.4, 6).tolist()
    assert depths == [-0.5, -1, -1.4, -1, -1.35, -1.8, -1, -1.75, -2, -0.5]
    assert found.kind[1:].tolist() == [0, 0, 1, 0, 0, 1, 0, 0, 1, 0]


@pytest.mark.parametrize(
    ("cycle", "steps"),
    [
        ("G81", [(-1, 0), (-2, 1), (-1, 0)]),
        ("G82 P0.5", [(-1, 0), (-2, 1), (-2, 3), (-1, 0)]),
        ("G84 P0.2", [(-1, 0), (-2, 1), (-2, 3), (-1, 1)]),
        ("G74", [(-1, 0), (-2, 1), (-1, 1)]),
        ("G85", [(-1, 0), (-2, 1), (-1, 1)]),
        ("G86", [(-1, 0), (-2, 1), (-1, 0)]),
        ("G89 P1", [(-1, 0), (-2, 1), (-2, 3), (-1, 0)]),
    ],
)
def test_cycles_do_their_printed_steps(
    router: ParameterFile, cycle: str, steps: list[tuple[float, int]]
) -> None:
    """Pages 35 to 41, back to R with G99."""
    found = path(router, f"G20 G99 G0 Z-0.5|{cycle} X-4 Z-2 R-1 F10")
    assert [
        (round(end[2] / 25.4, 6), kind)
        for end, kind in zip(found.ends[2:], found.kind[2:].tolist(), strict=True)
    ] == steps
    assert found.seconds.sum() == (float(cycle.partition("P")[2]) if "P" in cycle else 0.0)


def test_fine_boring_shifts_in_x_before_it_goes_back(router: ParameterFile) -> None:
    found = path(router, "G20 G99 G0 Z-0.5|G76 X-4 Z-2 R-1 Q0.1 F10")
    assert np.round(found.ends[-2:] / 25.4, 6).tolist() == [[-3.9, 0, -2], [-3.9, 0, -1]]


def test_a_cycle_is_repeated_by_distances_and_ended_by_g80(router: ParameterFile) -> None:
    found = path(router, "G20 G90 G0 Z-0.5|G91 G81 X-1 Z-1 R-0.5 L3 F10|G80|G90 G1 X-8")
    holes = found.ends[(found.kind == LINE)]
    assert np.round(holes[:3, 0] / 25.4, 6).tolist() == [-1, -2, -3]
    assert np.round(holes[:3, 2] / 25.4, 6).tolist() == [-2, -2, -2]
    assert found.fault is None


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("G87 X-1 Z-1 R0 F1", "does not do it"),
        ("G41 X-1", "G41 is not simulated"),
        ("G73 X-4 Z-2 R-1 Q0.4 F10", "retract distance of the cycle is printed nowhere"),
        ("G33 X-1", "no page here names"),
        ("G1 X(1/0)", "divides by 0"),
        ("X(P7)", "P7 has no value here"),
        ("X1 X2", "given twice"),
        ("G0 G1 X1", "another code of the group"),
        ("RET", "without a GOSUB"),
        ("GOTO 70", "No block has the number N70"),
        ("X1e300", "such a word"),
        ("P5=P", "is no expression"),
        ("X99999999999", "beyond every machine"),
        ("G3 X-1 Y-1 R1", "No page prints arcs by R"),
        ("G81 X-1 Z-1 F1", "needs the depth and R"),
        ("G43 H900 Z-1", "is not set"),
        ("é", "is no word"),
        ("X" + "(" * 100 + "1" + ")" * 100, ""),
        ("G4 F1000", "0.1 to 999.9 are printed"),
        ("G68 X0 Y0", "without R"),
        ("G90 G65 P50", "G65 comes first"),
        ("G65 X1", "needs P"),
        ("G65 P50 S3", "S is no variable"),
        ("G65 P50 L0", "is called 1 to"),
        ("G67 X1", "X1 beside G67"),
        ("P900=5", "an offset or a position of the control"),
        ("G19 G76 Y-1 X-2 R-1 Q0.1", "along which it bores"),
    ],
)
def test_what_cannot_be_known_ends_the_path_with_its_reason(
    router: ParameterFile, text: str, words: str
) -> None:
    found = path(router, f"G0 X-1|{text}")
    assert found.fault is not None
    assert found.fault.line == 2
    assert words in found.fault.message
    assert len(found) == 1


def test_the_printed_example_of_a_loop_moves_five_times(router: ParameterFile) -> None:
    """Page 44."""
    found = path(router, "G91|F100|P5=0|N100|P5=P5+1|X-1|Y-1|IF P5<5 THEN GOTO 100|M2|X-9")
    assert len(found) == 10
    assert np.round(found.ends[-1] / 25.4, 6).tolist() == [-5, -5, 0]


def test_subroutines_return_and_end_at_ten_levels(router: ParameterFile) -> None:
    found = path(router, "G91 F100|GOSUB 20|GOSUB 20|M2|N20|X-1|RET")
    assert np.round(found.ends[:, 0] / 25.4, 6).tolist() == [-1, -2]
    deep = path(router, "N1 F1|GOSUB 1")
    assert deep.fault is not None
    assert "more than 10 levels" in deep.fault.message


def test_a_call_gives_its_values_to_the_variables_of_the_subroutine(router: ParameterFile) -> None:
    """Page 33: X is #1, Y is #2, G is #10; L calls it more often."""
    found = path(router, "F10 G91|N5 G65 P1000 L2 X-1 Y(0-2) G-0.5|M2|N1000 G1 X(#1) Y(#2)|X(#10)|RET")
    assert np.round(found.ends[:, 0] / 25.4, 6).tolist() == [-1, -1.5, -2.5, -3]
    assert found.ends[-1, 1] / 25.4 == pytest.approx(-4)
    after = path(router, "F10 G91|G65 P50 X-1|X(#1)|M2|N50 G1 X(#1)|RET")
    assert after.fault is not None
    assert "P1 has no value" in after.fault.message  # whether it is kept is not printed


def test_a_modal_call_comes_after_each_move_until_it_is_ended(router: ParameterFile) -> None:
    """Page 34."""
    found = path(router, "F10 G91|G66 P50 A-0.5|G0 X-1|G4 F1|X-1|G67|X-1|M2|N50 G1 Z(#4)|Z(0-#4)|RET")
    assert found.fault is None
    assert np.round(found.ends[:, 2] / 25.4, 6).tolist() == [0, -0.5, 0, 0, 0, -0.5, 0, 0]


def test_the_first_level_of_a_cycle_is_where_it_begins(router: ParameterFile) -> None:
    """Page 37: the position of Z at the beginning of the G81 command."""
    found = path(router, "F10|G0 Z-0.5|G99 G81 X-1 Z-2 R-1|G98 X-2")
    assert np.round(found.ends[[-4, -1], 2] / 25.4, 6).tolist() == [-1, -0.5]


def test_the_offset_without_a_number_is_none() -> None:
    """Page 25: H0 is the end of an offset."""
    offsets = {"offset.h_geometric@1": "1 in", "offset.h_wear@1": "0 in"}
    found = path(example("acromill-router", **offsets), "F10 G43 H1 Z-2|H0 Z-2")
    assert np.round(found.ends[:, 2] / 25.4, 6).tolist() == [-1, -2]


def test_what_no_page_prints_of_a_code_is_assumed_where_a_program_has_it(router: ParameterFile) -> None:
    found = path(router, "F10 G31 X-1|#1=1|IF #1 = 1 THEN GOTO 5|N5 G81 Z-2 R-1|T P9")
    assert found.fault is None
    texts = " ".join(found.assumptions)
    for words in ("makes no contact", "on page 44 it is input 1", "CYCLES.TXT"):
        assert words in texts
    assert "CYCLES.TXT" not in " ".join(path(router, "F10 G81 Z-2 R-1|M2|$I CYCLES.TXT").assumptions)
    probed = path(router, "#101=1|F10 G31 X-1|X(#101)")
    assert probed.fault is not None
    kept = example("acromill-router", **{"p.acromill@150": "-3"})
    assert path(kept, "F10 X(#150)").ends[0, 0] / 25.4 == pytest.approx(-3)


def test_a_program_without_an_end_is_bounded(router: ParameterFile, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("amp_studio.programs.interpreter.MAX_REPEATED", 498)
    found = path(router, "N1 F1|GOTO 1")
    assert found.fault is not None
    assert "no end within 500" in found.fault.message
    assert MAX_REPEATED >= 100_000


def test_expressions_are_calculated_as_printed(router: ParameterFile) -> None:
    """Page 46: parameters in words, functions in degrees."""
    found = path(router, "F10|P40=1.5*Sin(30)+6/3|X(0-P40) Y((#40)-(1+(1+(1))))")
    assert np.round(found.ends[0] / 25.4, 6).tolist() == [-2.75, -0.25, 0]


def test_work_coordinates_local_shifts_and_floating_zeros_add_up() -> None:
    file = example("acromill-router", **{"work.system_1@X": "-5 in", "work.system_1@Y": "-6 in"})
    found = path(file, "G20 F10|G54|X1|G52 X1 Y0|X1|G92 X0|X1|G53 X-1")
    assert np.round(found.ends[:, 0] / 25.4, 6).tolist() == [-4, -3, -2, 0]
    other = path(file, "G20 F10|G54|G10 L2 P1 X-7 Y0|X1")
    assert round(other.ends[0, 0] / 25.4, 6) == -6


def test_a_grblhal_is_in_its_first_work_system_and_waits_only_for_another_one() -> None:
    """gcode.c: G54 is active at the start, so its G10 counts at once; C2989, C2717: the same is not
    switched.
    """
    file = new_file("grblhal", "grblhal", ["X", "Y", "Z"])
    found = path(file, "F600 G1 X1|G10 L2 P1 X5|X0|G54 X1|G55 X0|G10 L2 P3 X9|X2|M48 X3|M49 X4|M49 X5")
    assert found.ends[:, 0].tolist() == [1, 1, 5, 6, 6, 0, 2, 3, 3, 4, 5]
    assert np.flatnonzero(found.kind == DWELL).tolist() == [1, 4, 8]
    in_motion = new_file("grblhal", "grblhal", ["X", "Y", "Z"])
    in_motion.set_checked(read_assignments(in_motion, [("$10", "255")]))
    assert DWELL not in path(in_motion, "F600 G1 X1|G10 L2 P1 X5|X0|G55 X0|G92 X7|X8").kind


def test_reference_points_are_reached_by_way_of_the_point() -> None:
    points = {f"reference.point_1@{axis}": f"-{n} in" for n, axis in enumerate("XYZ", 1)}
    file = example("acromill-router", **points)
    found = path(file, "G20 F10|G28 Z-0.5|G29 X-4")
    assert np.round(found.ends / 25.4, 6).tolist() == [[0, 0, -0.5], [-1, -2, -3], [0, 0, -0.5], [-4, -2, -3]]
    assert set(found.kind.tolist()) == {RAPID}


def test_inverse_time_is_minutes_for_the_move_on_a_9pc_and_moves_a_minute_on_a_grbl() -> None:
    """Page 16-7 of the 9/PC: 0.5 minutes for 60 mm; gcode.c: 4 moves a minute."""
    mill = path(example("mill-1394"), "G21 G90|G93 G01 X60. F0.5")
    assert mill.feed.tolist() == pytest.approx([60.0 / 30.0])
    router = path(example("grblhal-router"), "G93 G1 X60 F4|X0")
    assert router.feed.tolist() == pytest.approx([60.0 / 15.0])
    assert router.fault is not None
    assert router.fault.code == "error:22"


@pytest.mark.parametrize(
    ("program", "line"),
    [
        ("F0|G0 X-1 F0|G1 X-2 F10", 0),
        ("G1 X-1 F10|G0 X-2 F0|G1 X-3", 3),
        ("G1 X-1 F0", 1),
        # Measured on the firmware: a code is refused without a place too, and a place where the axis is.
        ("G1 F0", 1),
        ("F10|G1|F0|G0|G2", 5),
        ("F10|G1 X0 F0", 2),
        ("G93 G1 F2|G1", 2),
    ],
)
def test_a_feed_of_0_is_refused_where_a_move_needs_it(program: str, line: int) -> None:
    """The firmware takes F0 in a block that moves at no feed, and refuses the next one that does."""
    fault = path(example("grblhal-router"), program).fault
    assert (fault.line, fault.code) == (line, "error:22") if fault else not line


def test_scale_and_turn_are_around_their_points(router: ParameterFile) -> None:
    found = path(router, "G20 F10|G51 X-1 Y-1 P2|X-2 Y-1|G50|G68 X0 Y0 R90|X-1 Y0")
    assert np.round(found.ends[:, :2] / 25.4, 6).tolist() == [[-3, -1], [0, -1]]


def test_a_dwell_is_a_row_with_its_seconds(router: ParameterFile) -> None:
    found = path(router, "G4 F2.5")
    assert (found.kind.tolist(), found.seconds.tolist()) == ([DWELL], [2.5])


@pytest.mark.parametrize(
    ("content", "words"),
    [(b"G0 X1\n" + b"X" * (LONGEST + 5) + b"\n", "more than"), (b"G0\0X1\n", "zero byte")],
)
def test_a_file_that_is_no_program_is_refused_in_a_sentence(
    tmp_path: Path, content: bytes, words: str
) -> None:
    file = tmp_path / "a.nc"
    file.write_bytes(content)
    with pytest.raises(ProgramBlockError, match=words):
        read_program(file)


def test_the_lines_of_a_program_come_without_their_ends(tmp_path: Path) -> None:
    file = tmp_path / "a.nc"
    file.write_bytes(b"%\r\nG0 X1\r\n\xff\n")
    assert read_program(file)[:2] == ["%", "G0 X1"]


def test_a_lone_return_ends_a_block_and_the_mark_of_utf_8_is_none(tmp_path: Path) -> None:
    """Three blocks of such a file were read as one."""
    file = tmp_path / "a.nc"
    file.write_bytes(b"\xef\xbb\xbfG90\rG0 X1\r\rY2")
    assert [*read_program(file)] == ["G90", "G0 X1", "", "Y2"]


def test_the_format_of_a_number_is_that_of_the_unit_of_its_block() -> None:
    """15-1: 3.4 digits in inch, 4.3 in metric, also where both come again."""
    blocks = ["F100", *("G21 G1 X2.", "G20 G1 X.1") * 2, "G21 G1 X4.", "G20 G1 X.1234"]
    found = tool_path(example("mill-1394"), blocks)
    assert found.fault is None
    assert found.ends[-1, 0] == pytest.approx(25.4 * 0.1234)
