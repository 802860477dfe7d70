"""The BASIC task of AutoMax: values in assignments, and what else a task contains."""

from pathlib import Path

import pytest

from amp_studio.families.servo57c422b.formats.automax import TASK
from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, export_file
from amp_studio.schema import Schema, Value
from tests.families.servo57c422b.small_module import filled, taken, told


def message_of(file: ParameterFile) -> dict[str, Value]:
    return {f"{a[0]}@{a[1]}": value for a, value in file.values.items()}


# -- tasks -----------------------------------------------------------------------------------------------


def test_a_task_has_an_assignment_a_line_and_acts_last(module: Schema) -> None:
    file = filled(
        module, mode_X="0x1", gain_X="5", gain_Y="6", travel_X="-7 counts", fast_X="40000000 counts/s"
    )
    file.header.name = "SHUTTLE"
    assert TASK.write(file).split("\n") == [
        "1000 ! SHUTTLE, Small module",
        "2000 PGAIN%=5 \\!Gain (X axis), 5",
        "2010 REG_11!=-7 \\!Travel (X axis), -7 counts",
        # more than a signed double word contains
        "2020 REG_17!=09C400000H \\!Fast (X axis), 40000000 counts/s",
        "2030 REG_2051%=6 \\!Gain (Y axis), 6",
        "2040 REG_65%=01H \\!Mode (X axis), 0x0001",  # the module acts on it at once
        "",
    ]
    assert taken(TASK, module, TASK.write(file)).values == file.values


def test_a_task_may_have_more_settings_than_tens_of_lines(servo: Schema) -> None:
    file = ParameterFile(servo)
    file.values |= {("cam.mode", a): Value(1) for a in "XY"} | {("cam.points", a): Value(1915) for a in "XY"}
    file.values |= {
        ("cam.time_points", f"{a}.{n}"): Value(n % 900, "counts") for a in "XY" for n in range(1915)
    }
    numbers = [int(line.split()[0]) for line in TASK.write(file).split("\n")[1:-1]]
    assert numbers == list(range(2000, 2000 + 3834)) == sorted(set(numbers))
    assert taken(TASK, servo, TASK.write(file)).values == file.values


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("10 REG_300%=1", "line 1, column 4: register 300 is of no parameter"),
        (
            "10 ! x\n20 A%=1",
            "line 2, column 4: A% is the variable of no register: REG_3% is that of register 3",
        ),
        (
            "10 REG_12!=1",
            "line 1, column 4: register 12 is half of Travel (X axis), registers 11, 12, and 11 is missing",
        ),
        ("10 REG_11%=1", "line 1, column 4: register 11 is half of Travel (X axis)"),
        ("10 PGAIN%=32768", "line 1, column 11: 32768 does not fit the 16 bits of Gain, -32768 to 32767"),
        ("10 PGAIN%=70000", "line 1, column 11: 70000 does not fit the 16 bits of a register"),
        ("10 REG_11!=2147483648", "line 1, column 12: 2147483648 does not fit the 32 bits of Travel"),
        ("10 REG_11!=4294967296", "line 1, column 12: 4294967296 does not fit the 32 bits of two registers"),
        ("10 REG_11!=0100000000H", "line 1, column 12: 4294967296 does not fit the 32 bits of two registers"),
        ("10 REG_17!=-1", "line 1, column 12: -1 does not fit the 32 bits of Fast, 0 to 4294967295"),
        ("10 REG_72%=0", "line 1, column 4: register 72, Status (X axis), can only be read"),
        ("10 PGAIN%=1 \\ PGAIN%=2", "line 1, column 15: register 3 is written twice, in line 1 already"),
        ("10 REG_11!=1\n20 REG_12%=2", "line 2, column 4: register 12 is written twice, in line 1 already"),
        ("10 PGAIN%=2*3", "line 1, column 11: PGAIN%: '2*3' is no whole number"),
        ("10 PGAIN%=1.5", "line 1, column 11: PGAIN%: '1.5' is no whole number"),
        ("10 PGAIN% = ", "line 1, column 12: PGAIN%: '' is no whole number"),
        ("10 DELAY 5 TICKS", "line 1, column 4: 'DELAY 5 TICKS' assigns no value to a register"),
        (f"10 GOSUB {'9' * 34}", f"line 1, column 4: 'GOSUB {'9' * 34}' assigns no value"),
        (f"10 GOSUB {'9' * 35}", f"line 1, column 4: 'GOSUB {'9' * 33}…' assigns no value"),
        ("10 PGAIN%=1 \\GOTO 10", "line 1, column 14: 'GOTO 10' assigns no value to a register"),
        ("10 IF A@ THEN PGAIN%=1", "line 1, column 4: 'IF A@ THEN PGAIN%=1' assigns no value to a register"),
        ("PGAIN%=1", "line 1, column 1: a line of a task begins with its number"),
        ("10 PGAIN%=1\n10 REG_4%=1", "line 2, column 1: number 10 occurs twice, in line 1 already"),
        ("10 PGAIN%=1\n20 A@=B@ &", "line 2: the last line ends with '&' and goes on nowhere"),
        (
            "10 ! x\n20 WAIT &\n  ON X \\PGAIN%=A",
            "line 2, column 4: 'WAIT & ON X' assigns no value to a register",
        ),
        ("10 PGAIN%=1 &\n   \\REG_4%=A", "line 1, column 11: PGAIN%: '1 &' is no whole number"),
    ],
)
def test_a_task_that_cannot_be_understood_is_reported_with_its_place(
    module: Schema, text: str, message: str
) -> None:
    assert told(TASK, module, text).startswith(message)


def test_statements_share_a_line_and_remarks_are_no_statements(module: Schema) -> None:
    text = """\
        10 rem PGAIN%=9
        20 LET PGAIN%=5 \\ reg_4%=0FFH! 255 \\ PGAIN%=1
        30 REG_2051% = +6. !Y
        40 !
        50 REG_11%=0 \\REG_12%=1\\
        """
    assert message_of(taken(TASK, module, text)) == {
        "r.gain@X": Value(5),
        "r.limit@X": Value(255, "counts"),
        "r.gain@Y": Value(6),
        "r.travel@X": Value(1, "counts"),
    }


def test_what_a_condition_decides_is_no_setting(module: Schema) -> None:
    """The rest of the line hangs on the condition too:
    4090 IF X_AXIS_DONE@ THEN INT_SRC_X! = 0 \\ INT_ENA_X! = 0 (page 4-48).
    """
    text = "10 IF A@ THEN PGAIN%=1 \\ REG_4%=2\n20 REG_2051%=3\n"
    file = taken(TASK, module, text, keep=True)
    assert message_of(file) == {"r.gain@Y": Value(3)}
    assert TASK.write(file) == text


def test_a_setting_that_is_not_set_takes_its_separator_along(module: Schema) -> None:
    text = "10 STOP \\PGAIN%=1\n20 REG_4%=2\\ CONT\n30 A@=B@ \\REG_2051%=3 \\! y\n40 REG_5%=4\n"
    file = taken(TASK, module, text, keep=True)
    file.values.clear()
    assert TASK.write(file) == "10 STOP \n20  CONT\n30 A@=B@ \\! y\n40 !\n"


def test_marks_of_a_user_else_are_text(module: Schema) -> None:
    text = "10 {3} \\ PGAIN%=1 \\ {{line 10}\n20 ! {line 10}\n"
    file = taken(TASK, module, text, keep=True)
    assert (message_of(file), TASK.write(file)) == ({"r.gain@X": Value(1)}, text)


def test_a_kept_line_that_has_lost_its_place_is_not_written_anywhere(module: Schema) -> None:
    file = taken(TASK, module, "10 PGAIN%=1\n20 STOP\n", keep=True)
    file.header.extra.clear()
    with pytest.raises(
        FormatError, match="'basic line 20' is kept in the file, and 'basic_script' in its header does not"
    ):
        TASK.write(file)
    del file.unknown["basic line 20"]
    assert TASK.write(file).endswith("\n2000 PGAIN%=1 \\!Gain (X axis), 1\n")


def test_a_kept_line_that_a_user_removes_is_gone(module: Schema) -> None:
    file = taken(TASK, module, "10 PGAIN%=1\n20 STOP\n30 END\n", keep=True)
    del file.unknown["basic line 20"]
    assert TASK.write(file) == "10 PGAIN%=1\n30 END\n"


def test_a_sign_that_a_dos_file_does_not_have_is_reported(servo: Schema, tmp_path: Path) -> None:
    file = taken(TASK, servo, "10 PGAIN%=1\n20 STOP\n", keep=True)
    file.unknown["basic line 20"] = "20 STOP ! Ж"
    with pytest.raises(
        FormatError, match=r"^line 2: 'Ж' is no character of cp437, in which this format is written$"
    ):
        export_file(file, tmp_path / "a.bas")
    assert not (tmp_path / "a.bas").exists()


def test_new_values_stand_before_a_task_that_had_none(module: Schema) -> None:
    file = taken(TASK, module, "10 DELAY 5 TICKS\n", keep=True)
    file.set(("r.gain", "X"), Value(3))
    file.set(("r.limit", "X"), Value(4, "counts"))
    assert TASK.write(file) == "10 PGAIN%=3 \\ REG_4%=4 \\ DELAY 5 TICKS\n"
