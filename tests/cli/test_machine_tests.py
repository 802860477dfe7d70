"""Test programs from a file: the axis' own letter, feedrate and travel, or a refusal with the reason."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from amp_studio.files import open_file
from amp_studio.schema import Value
from amp_studio.sim import MachineTest, SimulationError, machine_tests

EXAMPLES = Path(__file__).parents[2] / "examples"
MILL = EXAMPLES / "mill-1394" / "MILL_1394.amp"


def programs_of(path: str, axis: str | None = None, **changes: Value) -> dict[str, MachineTest]:
    file = open_file(EXAMPLES / path).file
    for parameter, value in changes.items():
        file.set((parameter.replace("__", "."), axis or ""), value)
    return {test.name: test for test in machine_tests(file, axis)}


def test_the_tuning_program_of_appendix_a_reverses_six_times_at_the_highest_cutting_feedrate() -> None:
    """A-8 prints 5 inches and the highest cutting feedrate of its machine."""
    tuning = programs_of("mill-1394/MILL_1394.amp", "2")["tuning"]
    assert "N00003 G01 Y127. F5000.;" in tuning.lines
    assert "N00008 IF [#100 LT 6] GOTO 3;" in tuning.lines


def test_a_travel_that_is_too_short_for_the_speed_is_refused() -> None:
    short = {"zone__overtravel_positive": Value(0.0, "mm"), "zone__overtravel_negative": Value(-3.0, "mm")}
    assert "its travel gives" in programs_of("mill-1394/MILL_1394.amp", "1", **short)["tuning"].refusal


def test_the_homing_check_of_a_num_has_the_letter_and_number_of_its_axis() -> None:
    """7-17: ten checks, L0 is the physical axis."""
    homing = programs_of("num-1060-mill/MILL_1060.amp", "1")["homing"]
    assert any("HOME Y" in line for line in homing.lines)
    assert any(line.startswith("N5 L0=1 ") for line in homing.lines)
    assert "N4 L10=L10+1 G79 L10<10 N1" in homing.lines


def test_the_circle_of_a_num_is_that_of_page_6_46() -> None:
    circle = programs_of("num-1060-mill/MILL_1060.amp", "0")["circle"]
    assert circle.lines[-1].endswith("G120 G17 G3 R20 F3000")


def test_the_bits_of_appendix_c_are_those_of_the_axes_of_the_file() -> None:
    """Page 113: 769, 801, 833 for three axes, on output 32; three turns of 4096 pulses."""
    lines = programs_of("acromill-router/ROUTER.amp")["excess-error"].lines
    assert [line.split()[-1] for line in lines[-5:]] == ["769", "801", "833", "32", "RUN"]
    assert "AXIS0 0.6" in lines[1]


def test_the_speeds_of_a_num_are_run_by_the_printed_program_inside_its_travel() -> None:
    """11-3: to 100 and -100, at a tenth of P30 and at the whole of it; the travel of X is -1 to 600 mm."""
    found = programs_of("num-1060-mill/MILL_1060.amp", "0")
    assert found["slow"].lines == ("N10 G9 X399.5 F600", "N15 G9 X199.5", "N20 G79 N10", "N25 M02")
    assert found["fast"].lines[0].endswith("F6000")
    assert found["fast"].steps[1].see.startswith("6000 internal units")  # 100 mm/s x 60 ms, in µm


def test_the_first_motion_of_a_num_axis_compares_with_kvar_and_emax() -> None:
    """6-44: 29491 / (VMAX x T) x k and VMAX x T x 11/10/k, of 100 mm/s, 60 ms and 1 µm: 4915 and 6600."""
    see = " ".join(step.see for step in programs_of("num-1060-mill/MILL_1060.amp", "0")["servo-loop"].steps)
    assert "KVAR 4915 and EMAX 6600 at 6000 mm/min and 60 ms; the file has 4915 and 6600" in see
    measurement = programs_of("num-1060-mill/MILL_1060.amp", "1")["measurement"]
    assert "no error 210 to 241" in measurement.steps[0].see  # 5-25


def test_a_modulo_axis_of_a_num_is_checked_in_degrees() -> None:
    """7-18: off the switch in steps of 1 deg, then by 180 deg."""
    lines = programs_of("num-1060-mill/MILL_1060.amp", "3")["homing"].lines
    assert any("L5=L5+1" in line for line in lines)
    assert any("EL1/1000+180" in line for line in lines)


MASKS = {"gear": ["0ADH", "0ADH"], "velocity": ["0AFH", "0BBH"]}


@pytest.mark.parametrize("name", MASKS)
def test_the_tasks_of_a_module_clear_the_printed_bits_of_its_mode(name: str) -> None:
    """5-8 and 5-9: before the mode is switched on, and off again."""
    task = programs_of("57c422b-label-press/LABEL_PRESS.amp", "X")[name]
    assert [line.rpartition(" ")[2] for line in task.lines if " AND " in line] == MASKS[name]
    if name == "velocity":  # half of 160000 counts/s, times 65.536
        assert "CMD_VEL!=5242880" in task.lines


def test_the_home_and_move_tasks_of_a_module_are_those_of_5_6_and_5_7() -> None:
    """Speeds of registers 15 and 19 times 65.536, accelerations of 21 and 23 times 0.065536."""
    file = "57c422b-label-press/LABEL_PRESS.amp"
    home, move = (programs_of(file, "X")[name].lines for name in ("home", "move"))
    assert home[4:8] == (
        "MODES%=MODES% AND 0FEH",
        "DELAY 10 TICKS",
        "MODES%=MODES% OR 1",
        "CMD66%=4 \\GOSUB 25000",
    )
    assert home[0] == f"HOME_SPD!={round(1600 * 65.536)}"
    assert move[1:5] == (
        f"CMD_VEL!={round(160000 * 65.536)}",
        f"CMD_ACC!={round(50000 * 0.065536)}",
        f"CMD_DEC!={round(50000 * 0.065536)}",
        "CMD66%=1 \\GOSUB 25000",
    )


def test_the_task_of_a_cam_begins_it_and_ends_it() -> None:
    """5-10: mode 9 is continuous and in words; 32 points of 12.5 ms."""
    task = programs_of("57c422b-label-press/LABEL_PRESS.amp", "Y")["cam"]
    assert task.lines[:3] == ("REG_2179%=0", "REG_2178%=9", r"REG_2114%=080H \GOSUB 25000")
    assert "32 points are run through in 0.4 s" in task.steps[0].see
    assert programs_of("57c422b-label-press/LABEL_PRESS.amp", "X")["cam"].refusal


def test_the_inputs_of_a_module_are_those_that_register_2_uses() -> None:
    """3-9, step 15; 011CH uses no home switch."""
    wiring = programs_of("57c422b-label-press/LABEL_PRESS.amp", "X")["wiring"]
    assert not any("home switch" in step.do for step in wiring.steps)
    assert any("drive fault" in step.do for step in wiring.steps)


def test_the_zero_point_of_a_syntec_is_set_by_the_steps_of_section_2_1() -> None:
    """For an absolute encoder; any other is homed by a search."""
    assert programs_of("syntec-mill/SYNTEC_MILL.amp", "1")["zero-point"].refusal
    encoder = {"resolution__encoder_type": Value("absolute")}
    steps = programs_of("syntec-mill/SYNTEC_MILL.amp", "1", **encoder)["zero-point"].steps
    assert "Pn002 is 0000" in steps[0].see
    assert "press F7" in steps[2].do
    assert steps[2].see.endswith("Set OK")


def test_a_family_that_prints_none_is_named() -> None:
    with pytest.raises(SimulationError, match="No test program is printed"):
        programs_of("grblhal-router/GRBL_ROUTER.amp")


def test_a_program_is_written_as_the_control_reads_it(
    amp: Callable[..., object], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    from amp_studio.cli import run

    target = tmp_path / "tuning.nc"
    assert run(["machine-tests", str(MILL), "tuning", "--axis", "X", "-o", str(target), "--json"]) == 0
    message = json.loads(capsys.readouterr().out)
    assert target.read_text("ascii").splitlines() == message["tests"][0]["lines"]
    assert message["tests"][0]["steps"][0]["see"]
    assert run(["machine-tests", str(MILL), "warp"]) == 2
    assert "Known: tuning" in capsys.readouterr().err


def test_steps_at_the_machine_are_ticked_and_on_the_check_list(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Each has its box, and the guide shows who ticked a test."""
    from amp_studio.cli import run

    mill = tmp_path / "mill.amp"
    mill.write_bytes((EXAMPLES / "num-1060-mill" / "MILL_1060.amp").read_bytes())
    assert run(["machine-tests", str(mill), "servo-loop", "--axis", "Y", "--done"]) == 0
    assert run(["machine-tests", str(mill), "--done"]) == 2
    assert run(["guide", str(mill)]) == 0
    assert "[x] at the machine: servo-loop, axis 1, ticked" in capsys.readouterr().out
    listed = tmp_path / "list.txt"
    assert run(["guide", str(mill), "-o", str(listed)]) == 0
    text = listed.read_text("utf-8").partition("TESTS AT THE MACHINE")[2]
    assert "[x] Y: First motion under servo-control (page 6-44)" in text
    assert "[ ] Z: First motion under servo-control (page 6-44)" in text
    assert "Must be seen: it cuts off the power." in text
    assert run(["machine-tests", str(mill), "servo-loop", "--axis", "Y", "--not-done"]) == 0
    page = tmp_path / "tests.html"
    assert run(["machine-tests", str(mill), "slow", "-o", str(page)]) == 0
    assert page.read_text("utf-8").count("N20 G79 N10") == 4  # one for each axis
