"""The ACR command script: every command as the guide prints it, and what else a terminal may be sent."""

import json
import re
from pathlib import Path

import pytest

from amp_studio.cli import run
from amp_studio.families.acromill.formats.acr_command import commands_of
from amp_studio.families.acromill.formats.acr_script import FORMAT, ORDER
from amp_studio.files import Header, ParameterFile, content_of, new_file, open_file
from amp_studio.files.reading import read_content
from amp_studio.formats import FormatError, ReadOptions, export_file, import_file
from amp_studio.schema import Value, load_schema
from tests.families.servo57c422b.small_module import taken, told

MILL = load_schema("acromill")
AXES = "XYZABCUV"

# The blocks of appendix C (pages 114 to 135), one behind the other; of MULT and DAC0 GAIN one form each.
PRINTED = """PROG0
PPU X4096 Y4096
EXC AXIS0 4 AXIS1 4 AXIS2 4 AXIS3 4 AXIS4 4 AXIS5 4 AXIS6 4 AXIS7 4

PLC0
HALT
NEW
10    LD 769
20    AND 801
90    OUT 32
RUN

MULT X-4     (Times 4 multiplication in opposite direction)
DAC0 GAIN 3276.8 (Dac0 normal polarity)
NOTCH X(500, 50)

REM This sets up one of the BiQuads as a NOTCH filter at 500Hz with 50Hz bandwidth.
P12341=P12336
"""


def message_of(file: ParameterFile) -> dict[str, Value]:
    return {f"{a[0]}@{a[1]}" if a[1] else a[0]: value for a, value in file.values.items()}


def mill(**message: Value) -> ParameterFile:
    """Return a file with values: ``servo_p_gain_X=Value(…)``."""
    file = ParameterFile(MILL, Header(name="TRY"))
    for key, value in message.items():
        group, _, rest = key.partition("_")
        name, _, instance = rest.rpartition("_")
        file.set((f"{group}.{name}", instance), value)
    return file


# -- as it is printed ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("line", "values"),
    [
        (
            "PPU X4096 Y4096",
            {f"axes.pulses_per_unit@{a}": Value(4096.0, "counts/in") for a in "XY"},
        ),  # page 114
        (
            "EXC AXIS0 4 AXIS1 4 AXIS2 4 AXIS3 4 AXIS4 4 AXIS5 4 AXIS6 4 AXIS7 4",  # page 114
            {f"axes.excess_error_band@{a}": Value(4.0, "in") for a in AXES},
        ),
        (
            "MULT X4      (Times 4 multiplication in default direction)",
            {"axes.encoder_multiplier@X": Value(4)},
        ),
        (
            "MULT X-4     (Times 4 multiplication in opposite direction)",
            {"axes.encoder_multiplier@X": Value(-4)},
        ),
        ("DAC0 GAIN 3276.8 (Dac0 normal polarity)", {"tuning.dac_gain@X": Value(3276.8)}),
        ("DAC0 GAIN -3276.8 (Dac0 opposite polarity)", {"tuning.dac_gain@X": Value(-3276.8)}),
        ("TLM X 2", {"servo.torque_limits@X": Value(2.0, "V")}),  # page 115
        ("TLM X4", {"servo.torque_limits@X": Value(4.0, "V")}),  # page 115
        ("LOPASS X1000", {"tuning.lopass_frequency@X": Value(1000.0, "Hz")}),  # page 128
        (
            "NOTCH X(500, 50)",  # page 128
            {"tuning.notch_frequency@X": Value(500.0, "Hz"), "tuning.notch_width@X": Value(50.0, "Hz")},
        ),
        (
            "NOTCH X(100,100)",
            {"tuning.notch_frequency@X": Value(100.0, "Hz"), "tuning.notch_width@X": Value(100.0, "Hz")},
        ),
        ("REM This sets up one of the BiQuads as a LOPASS filter", {}),
        ("", {}),
        ("P3=55555", {"p.controller@3": Value(55555.0)}),
    ],
)
def test_a_line_of_the_guide_is_read_as_it_is_printed(line: str, values: dict[str, Value]) -> None:
    assert message_of(taken(FORMAT, MILL, line)) == values


@pytest.mark.parametrize(
    ("word", "name", "figure", "value"),
    [
        ("PGAIN", "servo.p_gain", "0.08", 0.08),
        ("IGAIN", "servo.i_gain", "2", 2.0),
        ("IDELAY", "servo.i_delay", "0.01", 0.01),
        ("ILIMIT", "servo.i_limit", "2", 2.0),
        ("DWIDTH", "servo.d_time", "0", 0.0),
        ("DGAIN", "servo.d_gain", "0.00021", 0.00021),
        ("FFVEL", "servo.vel_ffwd", "0.0000015", 1.5e-6),
        ("FFACC", "servo.acc_ffwd", "0.000000199", 1.99e-7),
        ("TLM", "servo.torque_limits", "4", 4.0),
        ("FBVEL", "tuning.fbvel", "0", 0.0),
    ],
)
def test_a_gain_of_appendix_c_is_written_with_its_axis_and_without_an_exponent(
    word: str, name: str, figure: str, value: float
) -> None:
    """The figures are those the appendix ends with; it prints them in lists,
    and only TLM with an axis (page 115).
    """
    unit = MILL.units_of(MILL.parameter(name))[0]
    for axis in "XV":
        file = mill()
        file.set((name, axis), Value(value, unit))
        assert FORMAT.write(file).split("\n")[2:] == [f"{word} {axis}{figure}", ""]
        assert taken(FORMAT, MILL, f"{word} {axis}{figure}").values == file.values


def test_a_script_has_one_setting_a_line_and_scales_and_limits_before_the_gains() -> None:
    file = mill(
        servo_p_gain_X=Value(0.00244, "V/count"),
        servo_p_gain_Y=Value(1e-7, "V/count"),
        axes_excess_error_band_Y=Value(25.4, "mm"),
        axes_pulses_per_unit_X=Value(4096.0, "counts/in"),
        axes_encoder_multiplier_X=Value(-4),
        tuning_dac_gain_Z=Value(-3276.8),
        p_controller_12=Value(0.5),
        tuning_notch_frequency_X=Value(500.0, "Hz"),
        tuning_notch_width_X=Value(50.0, "Hz"),
    )
    assert FORMAT.write(file).split("\n") == [
        "REM ACR command script of TRY",
        "REM units inch",  # the printed default (page 61)
        "PPU X4096",
        "MULT X-4",
        "DAC2 GAIN -3276.8",
        "EXC AXIS1 1",
        "NOTCH X(500, 50)",
        "PGAIN X0.00244",
        "PGAIN Y0.0000001",
        "P12=0.5",
        "",
    ]


def test_no_gain_is_before_its_scale_its_sign_its_limits_and_its_damping() -> None:
    """A controller obeys line by line: pages 114 and 115 set them in this order."""
    rows = FORMAT.write(new_file("acromill")).split("\n")[2:-1]
    words = list(dict.fromkeys(row.split(" ")[0].rstrip("01234567") for row in rows))
    assert words == [
        "PPU",
        "MULT",
        "DAC",
        "EXC",
        "TLM",
        "DWIDTH",
        "DGAIN",
        "FBVEL",
        "PGAIN",
        "IDELAY",
        "ILIMIT",
        "IGAIN",
        "FFVEL",
        "FFACC",
    ]


def test_every_word_of_the_order_is_that_of_a_command() -> None:
    words = {re.match("[A-Z]*", s.template)[0] for c in commands_of(MILL, "mill") for s in c.settings}
    assert words == {*ORDER, "P"}


def test_what_is_set_later_is_before_the_gains_of_a_kept_script() -> None:
    back = taken(FORMAT, MILL, "PROG0\nPGAIN X0.01\nRES X", keep=True)
    back.set(("servo.torque_limits", "X"), Value(4.0, "V"))
    back.set(("servo.i_gain", "X"), Value(0.1, "V/count/s"))
    assert FORMAT.write(back).split("\n") == ["PROG0", "TLM X4", "PGAIN X0.01", "IGAIN X0.1", "RES X"]


def test_a_new_file_reads_back_as_it_was() -> None:
    file = new_file("acromill", name="NEW")
    back = taken(FORMAT, MILL, FORMAT.write(file))
    assert len(back.values) == 1 + 14 * 8, "the unit, and fourteen commands for eight axes"
    assert back.values.items() <= file.values.items()


# -- units -------------------------------------------------------------------------------------------------


def test_bare_figures_are_in_the_unit_of_the_machine() -> None:
    """Default Units is what a unit is (page 61), and the remark of the script what it was."""
    file = mill(axes_excess_error_band_X=Value(1.0, "in"), axes_pulses_per_unit_X=Value(25400.0, "counts/in"))
    file.set(("control.default_units", ""), Value("metric"))
    assert FORMAT.write(file).split("\n")[1:] == ["REM units metric", "PPU X1000", "EXC AXIS0 25.4", ""]
    back = taken(FORMAT, MILL, FORMAT.write(file))
    assert message_of(back) == {
        "control.default_units": Value("metric"),
        "axes.pulses_per_unit@X": Value(1000.0, "counts/mm"),
        "axes.excess_error_band@X": Value(25.4, "mm"),
    }
    assert FORMAT.write(back).split("\n")[1:] == FORMAT.write(file).split("\n")[1:]


def test_a_script_that_does_not_name_its_unit_is_in_that_of_delivery() -> None:
    back = taken(FORMAT, MILL, "EXC AXIS0 4")
    assert message_of(back) == {"axes.excess_error_band@X": Value(4.0, "in")}
    assert FORMAT.write(back) == "EXC AXIS0 4"
    assert (
        told(FORMAT, MILL, "PPU X1\nREM units furlong")
        == "line 2, column 11: 'furlong' is no unit system here: metric, inch"
    )


# -- what cannot be meant ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("PPU X1\nPGIAN X1", "line 2, column 1: 'PGIAN X1' is no command that sets a parameter here"),
        ("PPU X1\n  PGIAN X1", "line 2, column 3: 'PGIAN X1' is no command that sets a parameter here"),
        ("$110=500", "line 1, column 1: '$110=500' is no command that sets a parameter here"),
        (f"POINT {'9' * 34}", f"line 1, column 1: 'POINT {'9' * 34}' is no command"),
        (f"POINT {'9' * 35}", f"line 1, column 1: 'POINT {'9' * 33}…' is no command"),
        ("DAC8 GAIN 1", "line 1, column 1: 'DAC8 GAIN 1' is no command"),
        ("DAC0 GAIN 1 DAC1 GAIN 2", "line 1, column 13: 'DAC1 GAIN 2' is no command"),
        (
            "PGAIN\t0.05",
            (
                "line 1, column 7: '0.05' sets nothing: PGAIN is written as 'PGAIN X1', for X, Y, Z, A, B, C,"
                " U, V"
            ),
        ),
        ("PGAIN", "line 1, column 6: PGAIN alone sets nothing: it is written as 'PGAIN X1', for X, Y"),
        ("PGAIN X", "line 1, column 7: 'X' sets nothing: PGAIN is written as 'PGAIN X1'"),
        ("PPU X4096 Q4096", "line 1, column 11: 'Q4096' sets nothing: PPU is written as 'PPU X1'"),
        ("PPU X4096Y4096", "line 1, column 5: 'X4096Y4096' sets nothing: PPU is written as"),
        ("EXC 4", "line 1, column 5: '4' sets nothing: EXC is written as 'EXC AXIS0 1'"),
        ("EXC AXIS0 4 AXIS8 4", "line 1, column 13: 'AXIS8 4' sets nothing: EXC is written as 'EXC AXIS0 1'"),
        ("NOTCH X(500)", "line 1, column 7: 'X(500)' sets nothing: NOTCH is written as 'NOTCH X(1, 1)'"),
        ("TLM X#1", "line 1, column 5: 'X#1' sets nothing: TLM is written as 'TLM X1'"),
        ("MULT X1.5", "line 1, column 7: Encoder Mult takes whole numbers, not 1.5"),
        ("PPU X1 Y1E400", "line 1, column 9: '1E400' is too large"),
        ("TLM X1\nTLM Y1 X2", "line 2, column 8: TLM X occurs twice, in line 1 already"),
        ("NOTCH X(1, 2)\nNOTCH X(3, 4)", "line 2, column 7: NOTCH X occurs twice, in line 1 already"),
        ("P1=1 (x)\np1 = 2", "line 2, column 1: P1 occurs twice, in line 1 already"),
    ],
)
def test_a_script_that_cannot_be_understood_is_reported_with_its_place(text: str, message: str) -> None:
    assert told(FORMAT, MILL, text).startswith(message)


@pytest.mark.parametrize(
    ("line", "values"),
    [
        ("ppu x 4096  y +4096.", {f"axes.pulses_per_unit@{a}": Value(4096.0, "counts/in") for a in "XY"}),
        (
            "\tNotch X ( 500 , 5.E1 )\r",
            {"tuning.notch_frequency@X": Value(500.0, "Hz"), "tuning.notch_width@X": Value(50.0, "Hz")},
        ),
        ("EXC AXIS1 -.25 Axis 0 0.000000E+00", None),
        (
            "EXC AXIS1 -.25 axis0 0.000000E+00",
            {"axes.excess_error_band@Y": Value(-0.25, "in"), "axes.excess_error_band@X": Value(0.0, "in")},
        ),
        ("dac7  gain  1", {"tuning.dac_gain@V": Value(1.0)}),
        ("P33 = -2", {"p.controller@33": Value(-2.0)}),
        ("rem PPU X1", {}),
        ("REMOTE", None),
    ],
)
def test_blanks_and_small_letters_make_no_difference(line: str, values: dict[str, Value] | None) -> None:
    if values is None:
        assert told(FORMAT, MILL, line)
    else:
        assert message_of(taken(FORMAT, MILL, line)) == values


def test_a_setting_that_lacks_one_of_its_values_is_reported() -> None:
    file = mill(tuning_notch_frequency_Y=Value(500.0, "Hz"))
    with pytest.raises(
        FormatError, match=r"^NOTCH Y has several values, and tuning\.notch_width@Y is not set$"
    ):
        FORMAT.write(file)


def test_a_value_in_a_unit_of_something_else_is_reported() -> None:
    for value, name in ((Value(1.0, "ms"), "ms"), (Value(1.0), "a bare number")):
        file = mill()
        file.take_read({("servo.p_gain", "X"): value})  # set refuses it
        with pytest.raises(
            FormatError, match=rf"^servo\.p_gain@X: P Gain is stored in V/count, not in {name}$"
        ):
            FORMAT.write(file)


def test_a_script_without_settings_is_known_by_its_head() -> None:
    assert FORMAT.recognises(FORMAT.write(mill()))
    assert not FORMAT.recognises("REM hello\nPROG0\n")


def test_an_axis_the_machine_does_not_have_is_left_out() -> None:
    file = mill(axes_encoder_multiplier_X=Value(4), axes_encoder_multiplier_Z=Value(4))
    file.set(("view.number_of_axes", ""), Value(2))
    assert FORMAT.write(file).split("\n")[2:] == ["MULT X4", ""]


# -- what is kept --------------------------------------------------------------------------------------------


def test_commands_that_set_nothing_are_kept_and_written_back_in_their_place() -> None:
    file = taken(FORMAT, MILL, PRINTED, keep=True)
    assert not file.unknown, "a command that sets nothing is a line of a program, and known"
    assert FORMAT.write(file) == PRINTED
    assert taken(FORMAT, MILL, PRINTED).values == file.values
    again = read_content(Path("TRY.amp"), content_of(file))
    assert FORMAT.write(again) == PRINTED, "the parameter file keeps them too"


def test_values_changed_in_a_kept_script_stand_in_its_place() -> None:
    file = taken(FORMAT, MILL, "PROG0\nTLM X4\nPPU X1\nPROG1\nTLM Y4\nHALT", keep=True)
    file.set(("servo.torque_limits", "X"), Value(3.0, "V"))
    file.set(("servo.torque_limits", "Y"), None)
    file.set(("servo.p_gain", "X"), Value(0.1, "V/count"))
    file.set(("servo.torque_limits", "Z"), Value(5.0, "V"))
    assert FORMAT.write(file).split("\n") == [
        "PROG0",
        "TLM X3",
        "PPU X1",
        "TLM Z5",
        "PGAIN X0.1",
        "PROG1",
        "HALT",
    ]


def test_what_is_set_twice_is_kept_for_the_run_of_the_script_to_decide() -> None:
    """X of program 0 may be another axis than X of program 1."""
    text = "PROG0\nPPU X1 Y2\nPROG1\nPPU X3\nTLM X4\n"
    file = taken(FORMAT, MILL, text, keep=True)
    assert (message_of(file), FORMAT.write(file)) == ({"servo.torque_limits@X": Value(4.0, "V")}, text)


def test_a_kept_script_names_its_unit_once_it_is_another_one() -> None:
    file = taken(FORMAT, MILL, "HALT\nEXC AXIS0 1\n", keep=True)
    file.set(("control.default_units", ""), Value("metric"))
    assert FORMAT.write(file) == "REM units metric\nHALT\nEXC AXIS0 25.4\n"
    back = taken(FORMAT, MILL, FORMAT.write(file), keep=True)
    back.set(("control.default_units", ""), Value("inch"))
    assert FORMAT.write(back) == "REM units inch\nHALT\nEXC AXIS0 1\n"


def test_new_values_stand_at_the_end_of_a_script_that_had_none() -> None:
    file = taken(FORMAT, MILL, "SYS\nHALT ALL\n", keep=True)
    file.set(("servo.torque_limits", "X"), Value(4.0, "V"))
    assert FORMAT.write(file) == "SYS\nHALT ALL\nTLM X4\n"


def test_a_script_that_would_be_written_so_leaves_nothing_behind() -> None:
    """Remarks, blanks and another order are kept with the lines;
    what an export writes needs no copy in the file.
    """
    read = FORMAT.read(FORMAT.write(new_file("acromill")), MILL, ReadOptions())
    assert (read.unknown, read.kept, read.notes, read.extra) == ({}, [], [], {})
    own = "REM of mine\n\nTLM X4 (volts)\n"
    assert FORMAT.write(taken(FORMAT, MILL, own)) == own


# -- start-up programs

STARTUP = """ECHO 1
prog0
DETACH
ATTACH MASTER0
ATTACH SLAVE0 AXIS0 "X"
ATTACH SLAVE1 AXIS1 "Y"
ATTACH AXIS0 ENC0 DAC0 ENC0
PPU X 2000.000000 Y2000.0
BIT8464=0
AXIS0 ON
SLIM X0
HLIM X0
EXC X(0.25, -0.25) Y(0.5,-0.5)
PGAIN  X.00244   (volts)
ACC 40.000000
DEC 40.000000
STP 40.000000
JRK 10.000000
VEL 60.000000
10 LD 769
P12341=P12336
F500
DRIVE ON X
ENDP
"""
"""Commands in the order and notation of a published start-up program; the figures are made up."""


def test_a_start_up_program_is_read_among_its_other_commands_and_comes_back_byte_for_byte(
    tmp_path: Path,
) -> None:
    for end in ("\n", "\r\n"):
        program, back = tmp_path / "startup.8k", tmp_path / "back.acr"
        program.write_bytes(STARTUP.replace("\n", end).encode())
        file = import_file(program)
        assert message_of(file) == {
            "axes.pulses_per_unit@X": Value(2000.0, "counts/in"),
            "axes.pulses_per_unit@Y": Value(2000.0, "counts/in"),
            "axes.excess_error_band@X": Value(0.25, "in"),
            "axes.excess_error_band@Y": Value(0.5, "in"),
            "servo.p_gain@X": Value(0.00244, "V/count"),
            "speeds.feed_acc_dec": Value(40.0, "in/s2"),
        }
        assert not file.unknown
        again = read_content(Path("startup.amp"), content_of(file))
        export_file(again, back)
        assert back.read_bytes() == program.read_bytes()


@pytest.mark.parametrize(
    ("line", "values"),
    [
        ("ACC 500 DEC 500 STP 400 VEL 20 JRK 0", 1),
        ("VEL 20 ACC 500 DEC 500 X10 Y/-20", 1),
        ("ACC(500) DEC(500) STP(P5) X(P1)", 1),
        ("ACC 500 : DEC 500 : STP 3", 1),
        ("PPU X 2000 : PPU Y4000", 2),
        ("PPU X2000 MULT X4 PGAIN X 0.002 REM stiff", 3),
        ("STP 400 VEL 20", 0),
    ],
)
def test_several_commands_are_in_one_line_of_a_program(line: str, values: int) -> None:
    text = f"PROG0\nPGAIN Z 0.01\n{line}\nENDP\n"
    file = taken(FORMAT, MILL, text)
    assert len(file.values) == 1 + values
    assert FORMAT.write(file) == text
    if values == 1:
        file.set(("speeds.feed_acc_dec", ""), Value(300.0, "in/s2"))
        assert FORMAT.write(file) == text.replace("500", "300")


@pytest.mark.parametrize("line", ["PPU X 2000 W 5", "PPU X 2000 FOO 3", "PGAIN X 0.01 Y", "PPU X 2000 X 10Y"])
def test_behind_a_setting_a_slip_is_no_command(line: str) -> None:
    with pytest.raises(FormatError) as caught:
        FORMAT.read(f"PROG0\n{line}\n", MILL, ReadOptions())
    assert caught.value.line == 2


def test_a_changed_value_changes_its_figure_alone() -> None:
    file = taken(FORMAT, MILL, STARTUP)
    file.set(("axes.excess_error_band", "Y"), Value(25.4, "mm"))
    file.set(("axes.pulses_per_unit", "Y"), Value(1000.0, "counts/in"))
    file.set(("speeds.feed_acc_dec", ""), Value(50.0, "in/s2"))
    changed = STARTUP.replace("Y(0.5,-0.5)", "Y(1,-1)").replace("Y2000.0", "Y1000")
    assert FORMAT.write(file) == changed.replace("ACC 40.000000\nDEC 40.000000", "ACC 50\nDEC 50")
    file.set(("axes.excess_error_band", "X"), Value(0.25 * 25.4, "mm"))
    assert "X(0.25, -0.25)" in FORMAT.write(file), "the same value in another unit is no change"


@pytest.mark.parametrize(
    ("lines", "values"),
    [
        ("EXC X(0.25)", {"axes.excess_error_band@X": 0.25}),
        (
            "EXC X0.3 Y( .2 ) Z(4, -4)",
            {f"axes.excess_error_band@{a}": b for a, b in zip("XYZ", (0.3, 0.2, 4.0), strict=True)},
        ),
        ("PPU X (4000) Y(-8000)", {"axes.pulses_per_unit@X": 4000.0, "axes.pulses_per_unit@Y": -8000.0}),
        ("ACC (40)\nDEC(40)", {"speeds.feed_acc_dec": 40.0}),
    ],
)
def test_a_figure_in_brackets_is_an_expression_that_is_a_constant(
    lines: str, values: dict[str, float]
) -> None:
    """Parker Hannifin, ACR Programmer's Guide, page 60."""
    text = f"PROG0\n{lines}\n"
    file = taken(FORMAT, MILL, text)
    assert {name: value.value for name, value in message_of(file).items()} == values
    assert FORMAT.write(file) == text
    file.set(next(iter(file.values)), Value(50.0, next(iter(file.values.values())).unit))
    assert "50" in FORMAT.write(file)


def test_an_expression_that_the_controller_works_out_is_refused() -> None:
    with pytest.raises(FormatError, match="sets nothing"):
        FORMAT.read("PPU X1\nPPU Y(P0*2)\n", MILL, ReadOptions())


def test_what_is_not_set_any_more_leaves_its_line() -> None:
    file = taken(FORMAT, MILL, STARTUP)
    for address in (("axes.pulses_per_unit", "X"), ("servo.p_gain", "X"), ("speeds.feed_acc_dec", "")):
        file.set(address, None)
    text = STARTUP.replace("X 2000.000000 ", "").replace("PGAIN  X.00244   (volts)\n", "")
    assert FORMAT.write(file) == text.replace("ACC 40.000000\nDEC 40.000000\n", "")


def test_a_new_value_comes_after_what_has_to_be_set_before_it() -> None:
    file = taken(FORMAT, MILL, STARTUP)
    file.set(("servo.i_gain", "X"), Value(0.1, "V/count/s"))
    file.set(("servo.torque_limits", "Y"), Value(4.0, "V"))
    lines = FORMAT.write(file).split("\n")
    at = {line.split()[0]: n for n, line in enumerate(lines) if line}
    assert (lines[at["TLM"]], lines[at["IGAIN"]]) == ("TLM Y4", "IGAIN X0.1")
    assert at["PPU"] < at["EXC"] < at["TLM"] < at["PGAIN"] < at["IGAIN"] < at["ACC"]


@pytest.mark.parametrize(
    "lines",
    [
        "EXC X(0.25, -0.3)",  # the band here is one figure for both sides
        "ACC 40\nDEC 50",  # as is the ramp
        "ACC 40",  # nobody knows the other one
        "STP 40",
        "EXC X(1, -1)\nEXC X(2, -2)",
    ],
)
def test_what_one_parameter_cannot_contain_stays_a_line(lines: str) -> None:
    text = f"PPU X1\n{lines}\n"
    file = taken(FORMAT, MILL, text)
    assert (list(message_of(file)), FORMAT.write(file)) == (["axes.pulses_per_unit@X"], text)
    read = FORMAT.read(text, MILL, ReadOptions())
    assert read.kept == lines.split("\n")
    assert len(read.notes) == 1


def test_the_lines_that_are_kept_are_one_note_and_in_the_account(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    program = tmp_path / "startup.acr"
    program.write_text(STARTUP, encoding="ascii")
    assert run(["import", str(program), "-o", str(tmp_path / "a.amp"), "--json"]) == 0
    printed = capsys.readouterr()
    assert (
        printed.err
        == "19 lines of the program set nothing here, kept in their place: ATTACH, AXIS, BIT, DETACH, DRIVE,"
        " ECHO, ENDP, F, HLIM, JRK, LD, P, PROG, SLIM, STP, VEL\n"
    )
    assert json.loads(printed.out)["kept"][:2] == ["ECHO 1", "prog0"]
    assert run(["validate", str(program), "--json"]) in (0, 1)
    found = json.loads(capsys.readouterr().out)["findings"]
    assert "schema.unknown" not in {each["rule"] for each in found}


def test_a_slip_in_a_setting_is_no_line_of_a_program() -> None:
    for line in ("EXC 4", "PPU X4O96", "DAC0 GAIN", "TLM X", "PGAIN Q1"):
        assert told(FORMAT, MILL, f"{STARTUP}{line}").startswith(
            f"line {STARTUP.count(chr(10)) + 1}, column "
        )
        assert FORMAT.write(taken(FORMAT, MILL, f"{STARTUP}{line}", keep=True)) == f"{STARTUP}{line}"


def test_a_letter_that_the_program_gives_another_axis_is_reported() -> None:
    """Written here it would go to the axis of that letter: PPU X to AXIS0, EXC AXIS1 to Y."""
    text = 'ATTACH SLAVE0 AXIS1 "X"\nPPU X1\nEXC AXIS1 1'
    assert (
        told(FORMAT, MILL, text)
        == "line 2, column 5: X is AXIS1 of this program (line 1), and here it is AXIS0"
    )
    kept = taken(FORMAT, MILL, text, keep=True)
    assert message_of(kept) == {"axes.excess_error_band@Y": Value(1.0, "in")}
    assert FORMAT.write(kept) == text


def test_lines_that_an_earlier_version_kept_are_written_too() -> None:
    file = mill(axes_pulses_per_unit_X=Value(2.0, "counts/in"))
    file.header.extra["acr_script"] = {"lines": ["HALT", "{axes.pulses_per_unit@X}", "RUN"]}
    assert FORMAT.write(file) == "HALT\nPPU X2\nRUN"


# -- the verbs


def test_the_verbs_know_a_script_by_its_commands(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    script = tmp_path / "initfile.8k"
    script.write_bytes(b"\xef\xbb\xbfREM caf\xc3\xa9\r\nTLM X4\r\nREX X\r\n")
    assert run(["import", str(script), "-o", str(tmp_path / "a.amp")]) == 2
    assert "line 3, column 1: 'REX X' is no command" in capsys.readouterr().err
    assert run(["import", str(script), "-o", str(tmp_path / "a.amp"), "--keep-unknown"]) == 0
    assert "kept as text: acr line 3 (line 3)" in capsys.readouterr().err
    file = open_file(tmp_path / "a.amp").file
    assert message_of(file) == {"servo.torque_limits@X": Value(4.0, "V")}
    assert run(["export", str(tmp_path / "a.amp"), "-o", str(tmp_path / "b.acr")]) == 0
    assert (tmp_path / "b.acr").read_bytes() == b"REM caf\xc3\xa9\r\nTLM X4\r\nREX X\r\n"
    export_file(new_file("acromill", name="NEW"), tmp_path / "c.acr")
    assert import_file(tmp_path / "c.acr").get(("servo.p_gain", "U")) == Value(0.00244, "V/count")


def test_a_bare_number_in_an_imported_program_is_in_its_unit(tmp_path: Path) -> None:
    """The figures of a program are in inches while it names no other unit (page 61)."""
    program = tmp_path / "startup.acr"
    program.write_text(STARTUP, encoding="ascii")
    file = import_file(program)
    address = file.find("axes.pulses_per_unit@Y")
    assert file.header.units == "inch"
    assert file.read(address, "12000") == Value(12000.0, "counts/in")
