"""Records of drives as they come: separators, decimal commas, names and units; and what is not guessed."""

from pathlib import Path

import pytest

from amp_studio.sim import SimulationError
from amp_studio.sim.identification.drive_record import (
    DriveRecord,
    drive_record_of,
    read_drive_record,
    speed_factor,
    torque_figure,
)


def read(head: str, *rows: str) -> DriveRecord:
    return drive_record_of("\n".join([head, *rows]))


@pytest.mark.parametrize(
    ("head", "row"),
    [
        ("time (s),velocity (mm/min),torque (%)", "0.5,-600,12.5"),
        ("Time [s]; Velocity [mm/min]; Torque [%]", "0,5;-600;12,5"),
        ("Zeit [ms];Geschwindigkeit [mm/s];Drehmoment [%]", "500;-10;12,5"),
        ("time_s,velocity_mm/min,torque_percent", "0.5,-600,12.5"),
        ("t in s\tv in m/min\ttorque in %", "0.5\t-0.6\t12.5"),
        ('"time (s)","velocity (mm/min)","torque (%)"', '"0,5","-6e2","12,5"'),
        ("t (s);v (mm/s);Moment (% Mn)", "0,5;-10,0;12,5"),
        ("t (us),actual velocity (m/s),torque command (%)", "500000,-0.01,+12.5"),
        (
            "n,time (s),command velocity [mm/min],velocity [mm/min],output [V],torque [%]",
            "1,0.5,7,\u2212600,9,12.5",
        ),
    ],
)
def test_a_record_is_read_as_drives_and_spreadsheets_write_it(head: str, row: str) -> None:
    found = read(head, row)
    assert found.velocity is not None
    assert found.position is None
    assert found.time == pytest.approx([0.5])
    assert speed_factor(found, "mm") * found.velocity == pytest.approx([-10.0])
    assert (found.torque.tolist(), found.torque_unit) == ([12.5], "%")


@pytest.mark.parametrize(
    ("head", "row"),
    [
        ("time (s),speed (rpm),torque (%)", "0.5,-60,12.5"),
        ("Zeit (s);Drehzahl (U/min);Drehmoment (%)", "0,5;-60;12,5"),
        ("Zeit (s);Motordrehzahl (1/min);Drehmoment (%)", "0,5;-60;12,5"),
        ("t (s);n Ist (min-1);Moment (%)", "0,5;-60;12,5"),
        ("time (s),speed (rad/s),torque (%)", "0.5,-6.283185307179586,12.5"),
        ("time (s),speed (deg/s),torque (%)", "0.5,-360,12.5"),
        ("time (s),position (deg),torque (%)", "0.5,-360,12.5"),
    ],
)
def test_a_turn_of_the_motor_gives_the_way_of_a_linear_axis(head: str, row: str) -> None:
    found = read(head, row)
    moved = found.position if found.velocity is None else found.velocity
    assert moved is not None
    assert speed_factor(found, "mm", "10 mm") * moved == pytest.approx([-10.0])
    with pytest.raises(SimulationError, match="give the travel for a turn of the motor"):
        speed_factor(found, "mm")


def test_units_may_have_a_line_of_their_own_and_settings_may_stand_above() -> None:
    found = drive_record_of(
        "Drive 4711;;\n# 12 March\nsep=;\nTime;Position;Current\ns;um;mA\n0,001;2000;1500\n"
    )
    assert found.position is not None
    assert (found.position * speed_factor(found, "mm")).tolist() == [2.0]
    assert (found.torque.tolist(), found.torque_unit) == ([1.5], "A")
    assert found.columns == ("time s", "position um", "current mA")


@pytest.mark.parametrize(
    ("unit", "axis", "factor"),
    [
        ("in/min", "mm", 25.4 / 60.0),
        ("deg/s", "deg", 1.0),
        ("°/s", "deg", 1.0),
        ("counts/s", "counts", 1.0),
        ("counts/min", "counts", 1 / 60),
    ],
)
def test_a_velocity_is_in_the_unit_of_the_axis(unit: str, axis: str, factor: float) -> None:
    found = read(f"time (s),velocity ({unit}),torque (V)", "0,60,1")
    assert found.velocity is not None
    assert (speed_factor(found, axis) * found.velocity).tolist() == pytest.approx([60.0 * factor])


def test_a_length_is_no_angle() -> None:
    found = read("time (s),velocity (mm/s),torque (V)", "0,60,1")
    with pytest.raises(SimulationError, match=r"in mm/s, and the axis moves in deg: give deg or deg/s"):
        speed_factor(found, "deg")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "No line names the columns"),
        ("0,1,2\n1,2,3\n", "No line names the columns"),
        ("time (s),velocity (mm/s)\n0,1\n", "No line names the columns"),
        ("time (s),velocity (mm/s),torque\n0,1,2\n", "column torque has no unit"),
        ("time,velocity (mm/s),torque (%)\n0,1,2\n", "column time has no unit"),
        ("time (s),position (mm/s),torque (%)\n0,1,2\n", "no unit of a position"),
        ("time (mm),velocity (mm/s),torque (%)\n0,1,2\n", "no unit of a time"),
        ("time (s),velocity (mm/s),torque (Hz)\n0,1,2\n", "torque is in Hz; known are"),
        ("time (s),velocity (furlong),torque (%)\n0,1,2\n", "is not a unit"),
        ("time (s),velocity (mm/s),torque (%),torque (A)\n0,1,2,3\n", "2 columns are a torque"),
        ("time (s),velocity (mm/s),torque (%)\n0,1,nan\n", "line 2: 'nan' is no number"),
        ("time (s),velocity (mm/s),torque (%)\n0,1,2\n0,inf,2\n", "line 3: 'inf' is no number"),
        ("time (s),velocity (mm/s),torque (%)\n0,,2\n", "line 2: a cell is empty"),
        ("time (s),velocity (mm/s),torque (%)\n0,1\n", "line 2: 2 cells, and 3 heads"),
        ("time (s),velocity (mm/s),torque (%)\n0,001,2,5,7,1\n", "separate the columns by semicolons"),
        (
            "time (s);velocity (mm/s);torque (%)\n0,1;2;3\n0.2;2;3\n",
            "line 2 has a decimal comma and line 3 a decimal point",
        ),
        ("time (s);velocity (mm/s);torque (%)\n0;1.234,5;3\n", "'1.234,5' is no number"),
        ("time (s),velocity (mm/s),torque (%)\n0,1e13,2\n", "too large"),
        ("time (s),velocity (mm/s),torque (%)\n0,1e999,2\n", "line 2: "),
        ("time (s),velocity (mm/s),torque (%)\n0,1,٣\n", "is no number"),
        ('time (s),velocity (mm/s),torque (%)\n0,"1,2\n', "is no line of a table"),
        ("x" * 20_000, "more than 10000 characters"),
    ],
)
def test_what_is_not_a_record_or_can_be_read_in_two_ways_is_refused(text: str, words: str) -> None:
    with pytest.raises(SimulationError) as caught:
        drive_record_of(text)
    assert words in str(caught.value)


def test_a_file_is_named_in_what_is_wrong_with_it(tmp_path: Path) -> None:
    path = tmp_path / "axis.csv"
    path.write_bytes("Zeit [s];Geschwindigkeit [°/s];Moment [%]\n0,5;1;zwölf\n".encode("cp1252"))
    with pytest.raises(SimulationError, match=r"axis\.csv: line 2: 'zwölf' is no number"):
        read_drive_record(path)


@pytest.mark.parametrize("text", ["", "5", "A", "0 A", "-1 A", "5 Hz", "1e999 A", "nan A", "5 5 A"])
def test_a_scale_is_a_torque_above_0_with_its_unit(text: str) -> None:
    with pytest.raises(SimulationError, match="is no torque above 0"):
        torque_figure(text)


@pytest.mark.parametrize(
    ("text", "figure"),
    [("0.056 A", (0.056, "A")), ("56mA", (0.056, "A")), ("0,02 N m", (0.02, "Nm")), ("2 N·m", (2.0, "Nm"))],
)
def test_a_scale_is_read_with_its_unit(text: str, figure: tuple[float, str]) -> None:
    assert torque_figure(text) == (pytest.approx(figure[0]), figure[1])
