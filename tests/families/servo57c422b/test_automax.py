r"""AutoMax texts of a servo module: tables of registers, and the assignments of BASIC tasks."""

from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.families.servo57c422b.formats.automax import TABLE, TASK
from amp_studio.families.servo57c422b.formats.registers import Registers
from amp_studio.files import Header, ParameterFile, content_of, open_file
from amp_studio.files.reading import read_content
from amp_studio.formats import FormatError, export_file, import_file
from amp_studio.schema import Schema, Value
from tests.families.servo57c422b.small_module import filled, taken, told

# The example of section 5.3 as it is printed (page 5-5), line 24999 and its end put right where the text of
# the page has them out of order.
INITIALIZATION = r"""1000 !
1010 ! Initialize Axis Parameters
1020 !
2000 ENCODER_SETUP%=01414H\!Rotary, polarity reversed, *4
2010 DRIVE_SETUP%=02H \!Polarity reversed, current ref
2020 SWITCHES%=01DH \!Marker pulse, home negative
2030 PGAIN%=18700 \!Position Gain
2040 IGAIN%=1575 \!Integral Gain
2050 VGAIN%=140 \!Velocity Gain
2060 FGAIN%=8256 \!V Feedforward Gain
2070 DBCOMP%=27 \!Deadband Compensation
2080 MAX_FOLL_ERR%=1000 \!Maximum following error
2090 MAX_VEL_ERR%=8 \!Maximum velocity error
2100 IN_TOLERANCE%=40 \!In position tolerance
2110 GEAR_RATIO!=16777216 \!Gear ratio
2120 MAX_VOLTS%=1984 \!Maximum drive reference value
2130 P_CONST%=-1 \!Positive linearization constant
2140 N_CONST%=-1 \!Negative linearization constant
2150 FDBK_UNWIND!=4000 \!V Fdbk unwind = 1 revolution
2160 GEAR_UNWIND!=4000 \!Gearing unwind = 1 revolution
2170 MODES%=0
"""
COMMAND = r"""2180 CMD66%=0200H\GOSUB 25000\!Change default setups
2190 !
24999 ! Subroutine to write command to module
25000 DELAY 2 TICKS \IF NOT (CMD_ACK@ OR ILLEGAL_CMD@) &
THEN GOTO 25000
25005 FAULT@=ILLEGAL_CMD@
25010 CMD66%=0 \CMD67%=0
25015 DELAY 2 TICKS \IF CMD_ACK@ THEN GOTO 25015
25020 RETURN
30000 END
"""
PRINTED = {
    "setup.encoder@X": Value(0x1414),
    "setup.drive@X": Value(2),
    "setup.switches@X": Value(0x1D),
    "gain.proportional@X": Value(18700),
    "gain.integral@X": Value(1575),
    "gain.velocity@X": Value(140),
    "gain.feedforward@X": Value(8256),
    "gain.deadband@X": Value(27),
    "setup.max_position_error@X": Value(1000, "counts"),
    "setup.max_velocity_error@X": Value(6400.0, "counts/s"),  # 8 counts in a scan of 1.25 ms (page 4-9)
    "setup.in_position_tolerance@X": Value(40, "counts"),
    "command.gear_ratio@X": Value(1.0),
    "output.max_voltage@X": Value(10.0, "V"),
    "output.linearization_positive@X": Value(-1),
    "output.linearization_negative@X": Value(-1),
    "output.feedback_unwind@X": Value(4000, "counts"),
    "output.gearing_unwind@X": Value(4000, "counts"),
    "control.mode@X": Value(0),
}


def message_of(file: ParameterFile) -> dict[str, Value]:
    return {f"{a[0]}@{a[1]}": value for a, value in file.values.items()}


# -- tables of registers -----------------------------------------------------------------------------


def test_a_table_has_a_line_a_register_and_two_for_a_double_word(module: Schema) -> None:
    file = filled(
        module,
        gain_X="-5",
        gain_Y="3",
        travel_X="40000 counts",
        setup_X="0x1414",
        slow_Y="2000 counts/s",
        point_X__1="-2 counts",
        volts_X="10 V",
        sense_X="Down",
        marker_Y="On",
    )
    file.header.name = "SHUTTLE"
    assert TABLE.write(file).split("\n") == [
        "! Register table of SHUTTLE, Small module",
        "! register\tvalue\tparameter",
        "0\t01414H\tSetup (X axis), 0x1414",
        "3\t-5\tGain (X axis), -5",
        "11\t0H\tTravel (X axis), 40000 counts",
        "12\t09C40H\tthe rest of it",
        "28\t1984\tVolts (X axis), 10 V",
        "40\t-1\tSense (X axis), Down",
        "134\t0FFFEH\tPoint (X axis, point 1), -2 counts",
        "135\t0FFFFH\tthe rest of it",
        "2051\t3\tGain (Y axis), 3",
        "2063\t02H\tSlow (Y axis), 2000 counts/s",  # 2000 * 65.536 = 131072
        "2064\t0H\tthe rest of it",
        "2089\t1\tMarker (Y axis), On",
        "",
    ]
    assert taken(TABLE, module, TABLE.write(file)).values == file.values


def test_a_table_of_a_user_else_is_read_too(module: Schema) -> None:
    file = taken(
        TABLE,
        module,
        """\
        ! Saved on the machine
        R3 = 100
          r2051\t-1 ! proportional gain
        12, 40000
        11, 0
        4;0FFFFH
        134 65534
        135 -1
        """,
    )
    assert message_of(file) == {
        "r.gain@X": Value(100),
        "r.gain@Y": Value(-1),
        "r.travel@X": Value(40000, "counts"),
        "r.limit@X": Value(65535, "counts"),
        "r.point@X.1": Value(-2, "counts"),
    }


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "3 1\n12 5",
            "line 2, column 1: register 12 is half of Travel (X axis), registers 11, 12, and 11 is missing",
        ),
        (
            "11 5",
            "line 1, column 1: register 11 is half of Travel (X axis), registers 11, 12, and 12 is missing",
        ),
        ("! x\n\n  R300 17", "line 3, column 4: register 300 is of no parameter"),
        ("2348 17", "line 1, column 1: register 2348 is of no parameter"),
        ("3 40000", "line 1, column 3: 40000 does not fit the 16 bits of Gain, -32768 to 32767"),
        ("3 65536", "line 1, column 3: 65536 does not fit the 16 bits of a register"),
        ("3 -32769", "line 1, column 3: -32769 does not fit the 16 bits of a register"),
        ("3 010000H", "line 1, column 3: 65536 does not fit the 16 bits of a register"),
        ("4 -1", "line 1, column 3: -1 does not fit the 16 bits of Limit, 0 to 65535"),
        ("5 128", "line 1, column 3: 128 does not fit the 8 bits of Byte, -128 to 127"),
        ("5 0FFH", "line 1, column 3: 255 does not fit the 8 bits of Byte, -128 to 127"),
        ("72 1", "line 1, column 1: register 72, Status (X axis), can only be read"),
        ("2120 1", "line 1, column 1: register 2120, Status (Y axis), can only be read"),
        ("3 1\n4 1\n3 1", "line 3, column 1: register 3 is written twice, in line 1 already"),
        ("3", "line 1: a line is the number of a register and its value"),
        ("gain 3", "line 1: a line is the number of a register and its value"),
        ("3\tfast", "line 1, column 3: 'fast' is no whole number, as 1984, -1 or 01414H"),
        ("3 0x10", "line 1, column 3: '0x10' is no whole number"),
    ],
)
def test_a_table_that_cannot_be_understood_is_reported_with_its_place(
    module: Schema, text: str, message: str
) -> None:
    assert told(TABLE, module, text).startswith(message)


def test_the_other_registers_decide_what_a_shared_register_means(module: Schema) -> None:
    """Registers 25 and 26 are one gear ratio or two numbers (page 4-15)."""
    file = taken(TABLE, module, "25 1\n26 3\n38 04H\n2073 256\n2074 0")
    assert message_of(file) == {
        "r.modes@X": Value(4),
        "r.over@X": Value(1),
        "r.under@X": Value(3),
        "r.ratio@Y": Value(1.0),
    }
    assert taken(TABLE, module, TABLE.write(file)).values == file.values
    assert "register 25 is half of Ratio (X axis)" in told(TABLE, module, "25 1\n38 0")
    assert message_of(taken(TABLE, module, "25 1\n38 04H")) == {"r.modes@X": Value(4), "r.over@X": Value(1)}


def test_a_value_that_does_not_exist_here_is_not_written(module: Schema) -> None:
    file = filled(module, modes_X="0x4", ratio_X="1", over_X="1", status_X="0x1")
    assert [line.split("\t")[0] for line in TABLE.write(file).split("\n")[2:-1]] == ["25", "38"]
    assert "\t1\tOver" in TABLE.write(file)


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ({"gain_X": "70000"}, r"register 3, r\.gain@X: 70000 does not fit the 16 bits of Gain"),
        (
            {"fast_Y": "1e9 counts/s"},
            r"register 2065, r\.fast@Y: 65536000000 does not fit the 32 bits of Fast",
        ),
        ({"sense_X": "Odd"}, r"register 40, r\.sense@X: no code is printed for 'Odd' of Sense"),
    ],
)
def test_a_value_that_no_register_can_hold_is_reported(
    module: Schema, value: dict[str, str], message: str
) -> None:
    file = filled(module, **value)
    for form in (TABLE, TASK):
        with pytest.raises(FormatError, match=message):
            form.write(file)


def test_registers_of_no_parameter_and_odd_halves_are_kept_where_that_is_wanted(module: Schema) -> None:
    text = "3 1\n12 5\n300 17\n301 0FFFFH\n"
    file = taken(TABLE, module, text, keep=True)
    assert message_of(file) == {"r.gain@X": Value(1)}
    assert file.unknown == {"R12": "5", "R300": "17", "R301": "0FFFFH"}
    rows = TABLE.write(file).split("\n")[2:-1]
    assert [row.split("\t")[:2] for row in rows] == [
        ["3", "1"],
        ["12", "5"],
        ["300", "17"],
        ["301", "0FFFFH"],
    ]
    assert taken(TABLE, module, TABLE.write(file), keep=True).unknown == file.unknown
    with pytest.raises(FormatError, match=r"register 72, .* can only be read"):
        taken(TABLE, module, "72 1", keep=True)
    file.unknown["R300"] = "17\n18"
    with pytest.raises(FormatError, match=r"R300: '17\\n18' is no whole number"):
        TABLE.write(file)


def test_a_dos_file_may_end_with_its_own_sign(module: Schema) -> None:
    assert message_of(taken(TABLE, module, "3 1\r\n4 2\r\n\x1a")) == {
        "r.gain@X": Value(1),
        "r.limit@X": Value(2, "counts"),
    }


def test_names_with_other_signs_do_not_spoil_a_dos_file(module: Schema, tmp_path: Path) -> None:
    file = filled(module, gain_X="3")
    file.header.name = "Läufer\nЖ"
    for form in (TABLE, TASK):
        assert (
            form.write(file)
            .encode("cp437")
            .splitlines()[0]
            .endswith("Läufer ?, Small module".encode("cp437"))
        )


# -- the real module -----------------------------------------------------------------------------------


def test_the_printed_initialization_gives_its_values(servo: Schema) -> None:
    """Page 5-5: every variable of the example is the register its name and remark say."""
    assert message_of(taken(TASK, servo, INITIALIZATION)) == PRINTED


def test_the_printed_initialization_comes_back_as_it_was(servo: Schema) -> None:
    file = taken(TASK, servo, INITIALIZATION + COMMAND, keep=True)
    assert message_of(file) == PRINTED | {"control.command_67@X": Value(0)}
    assert list(file.unknown) == [f"basic line {n}" for n in (2180, 25000, 25005, 25010, 25015, 25020, 30000)]
    assert file.unknown["basic line 25010"] == "25010 CMD66%=0 \\{67}", (
        "one command is given twice, so nothing tells"
    )
    assert TASK.write(file) == INITIALIZATION + COMMAND


def test_a_kept_task_outlasts_the_parameter_file(servo: Schema) -> None:
    file = taken(TASK, servo, INITIALIZATION + COMMAND, keep=True)
    again = read_content(Path("TRY.amp"), content_of(file))
    assert (again.values, again.unknown, again.header.extra) == (file.values, file.unknown, file.header.extra)
    again = read_content(Path("TRY.amp"), content_of(again, content_of(file)))
    assert TASK.write(again) == INITIALIZATION + COMMAND


def test_values_changed_in_a_kept_task_stand_in_its_place(servo: Schema) -> None:
    file = taken(TASK, servo, INITIALIZATION + COMMAND, keep=True)
    file.set(("gain.proportional", "X"), Value(100))
    file.set(("setup.drive", "X"), None)
    file.set(("control.mode", "X"), None)
    file.set(("setup.overtravel_positive", "X"), Value(-40000, "counts"))
    file.set(("gain.proportional", "Y"), Value(7))
    changed = (
        (INITIALIZATION + COMMAND)
        .replace("PGAIN%=18700", "PGAIN%=100")
        .replace("2010 DRIVE_SETUP%=02H \\!", "2010 !")
        .replace("2170 MODES%=0", "2170 !")
        .replace("IN_TOLERANCE%=40 \\!", "IN_TOLERANCE%=40 \\ REG_11!=-40000 \\!")
        .replace("CMD67%=0", "CMD67%=0 \\ REG_2051%=7")
    )
    assert TASK.write(file) == changed
    assert taken(TASK, servo, changed, keep=True).values == file.values


def test_the_printed_numbers_of_a_move_are_read_back_in_engineering_units(servo: Schema) -> None:
    """20 units of 4000 counts at 40 units/s, and 12.5 units/s2 (page 4-48)."""
    file = taken(TASK, servo, "4010 CMD_POS!=80000\n4020 CMD_VEL! = 10485760\n4030 CMD_ACC!=3277")
    assert message_of(file) == {
        "command.position@X": Value(80000, "counts"),
        "command.velocity@X": Value(160000.0, "counts/s"),
        "command.acceleration@X": Value(50_000.0, "counts/s2"),
    }


def test_a_double_precision_variable_has_its_upper_half_first(servo: Schema) -> None:
    """INT_ENA_X!=80000000H is bit 15 of register 68, 00010000H its bit 0 (page 4-48)."""
    for number, word in (("80000000H", 0x8000), ("00010000H", 1)):
        values = message_of(taken(TASK, servo, f"15010 INT_ENA_X!={number}"))
        assert values == {"interrupt.enable_status@X": Value(word), "interrupt.enable_fault@X": Value(0)}


def test_a_cam_of_positions_is_written_word_by_word(servo: Schema) -> None:
    """Its even registers are the lower half (page 4-57), and those of a ``!`` the upper one."""
    file = ParameterFile(servo, Header(name="CAM"))
    for name, value in (
        ("cam.mode@X", Value(0x100)),
        ("cam.points@X", Value(2)),
        ("cam.position_points@X.0", Value(0, "counts")),
        ("cam.position_points@X.1", Value(70000, "counts")),
    ):
        file.set((name.split("@")[0], name.split("@")[1]), value)
    task = TASK.write(file)
    assert "REG_134%=01170H \\ REG_135%=01H \\!" in task
    assert taken(TASK, servo, task).values == file.values == taken(TABLE, servo, TABLE.write(file)).values
    assert message_of(taken(TASK, servo, "1 CAM_MODE%=0100H\n2 REG_128%=1\n3 REG_132!=1"))[
        "cam.position_points@X.0"
    ] == (Value(65536, "counts"))


def test_registers_beyond_the_points_of_a_cam_stand_for_nothing(servo: Schema) -> None:
    message = told(TABLE, servo, "130 1\n128 1\n132 5\n133 5")
    assert message.startswith("line 4, column 1: register 133 means nothing here: ")
    assert taken(TABLE, servo, "130 1\n128 1\n132 5\n133 5", keep=True).unknown == {"R133": "5"}


# -- the verbs -------------------------------------------------------------------------------------------


def test_the_verbs_know_the_formats_by_name_and_by_content(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    source = tmp_path / "axisinit.bas"
    source.write_text(INITIALIZATION, "utf-8")
    assert run(["import", str(source), "-o", str(tmp_path / "a.amp")]) == 0
    assert message_of(open_file(tmp_path / "a.amp").file) == PRINTED
    assert run(["export", str(tmp_path / "a.amp"), "-o", str(tmp_path / "a.reg")]) == 0
    assert (tmp_path / "a.reg").read_bytes().startswith(b"! Register table of a, ")
    assert b"\r\n19\t" not in (tmp_path / "a.reg").read_bytes(), "an unset register stays as it is"
    assert import_file(tmp_path / "a.reg").values == open_file(tmp_path / "a.amp").file.values
    export_file(open_file(tmp_path / "a.amp").file, tmp_path / "b.bas")
    assert import_file(tmp_path / "b.bas").values == open_file(tmp_path / "a.amp").file.values
    (tmp_path / "bare.txt").write_text("R3 18700\nR2051 5\n", "utf-8")
    assert message_of(import_file(tmp_path / "bare.txt")) == {
        "gain.proportional@X": Value(18700),
        "gain.proportional@Y": Value(5),
    }
    source.write_text(INITIALIZATION + COMMAND, "utf-8")
    capsys.readouterr()
    assert run(["import", str(source), "-o", str(tmp_path / "c.amp")]) == 2
    assert "line 22, column 19: 'GOSUB 25000' assigns no value" in capsys.readouterr().err
    assert run(["import", str(source), "-o", str(tmp_path / "c.amp"), "--keep-unknown"]) == 0
    assert "kept as text: basic line 2180 (line " in capsys.readouterr().err
    assert run(["export", str(tmp_path / "c.amp"), "-o", str(tmp_path / "c.bas")]) == 0
    assert (tmp_path / "c.bas").read_bytes() == (INITIALIZATION + COMMAND).replace("\n", "\r\n").encode()


def test_a_text_is_a_table_if_most_of_its_lines_are_rows() -> None:
    assert TABLE.recognises("! x\n\n3 1\nR4 = 0FFH\n  gain\n")
    assert not TABLE.recognises("3 1\nPROG0\nPPU X4\n")
    assert not TABLE.recognises("10 PGAIN%=1\n")
    assert not TABLE.recognises("! nothing\n")


def test_the_names_of_registers_are_those_of_the_printed_tasks(servo: Schema) -> None:
    """What two tables of the family say of one register agrees,
    and each ``!`` has two registers and each ``%`` one.
    """
    names = servo.tables["basic-variables"]
    registers = dict(zip(names.column("Variable") or (), names.column("Register") or (), strict=True))
    printed = servo.tables["printed-programs"]
    for message, name in zip(printed.column("Register") or (), printed.column("Variable") or (), strict=True):
        numbers = [int(n) for n in str(message).split(", ")]
        assert (registers[name], len(numbers)) == (numbers[0], 2 if str(name).endswith("!") else 1)
    known = Registers(servo, "module")
    for name, register in registers.items():
        last = int(register) + (1 if str(name).endswith("!") else 0)
        assert {len(known.claims.get(n, ())) for n in range(int(register), last + 1)} <= {1, 2, 3}, name
