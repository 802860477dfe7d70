"""Measured points as people and lasers write them: every shape gives the same runs, and nothing is
guessed.
"""

from fractions import Fraction
from pathlib import Path

import pytest

from amp_studio.calibration import Measurement, MeasurementAnswers, read_measured_file
from amp_studio.calibration.errors import MeasurementError
from amp_studio.calibration.reading import read_measurement

KNOWN = MeasurementAnswers("mm", "um", "measured-target")


def runs(measurement: Measurement) -> list[tuple[bool, list[tuple[float, float]]]]:
    return [(run.rising, [(float(at), float(by)) for at, by in run.points]) for run in measurement.runs]


THERE_AND_BACK = [
    (True, [(0, 0), (100, 0.004), (200, 0.007)]),
    (False, [(0, 0.005), (100, 0.009), (200, 0.012)]),
]


@pytest.mark.parametrize(
    "text",
    [
        "0,0\n100,4\n200,7\n200,12\n100,9\n0,5\n",
        "0;0\n100;4\n200;7\n200;12\n100;9\n0;5\n",
        "0 0\n100 4\n200\t7\n200 12\n100 9\n0 5".replace("\t", " "),
        "0\t0\n100\t4\n200\t7\n200\t12\n100\t9\n0\t5\n",
        "# laser of 3 May\n\nposition,error\n0,0\n100,4\n! half way\n200,7\n200,12\n100,9\n0,5\n",
        "Position (mm);Run 1 +;Run 1 -\n0;0;5\n100;4;9\n200;7;12\n",
        "position,up,down\n0,0,5\n100,4,9\n200,7,12\n",
        "Target,1 fwd,1 rev\n0,0,5\n100,4,9\n200,7,12\n",
        "direction,position,deviation\n+,0,0\n+,100,4\n+,200,7\n-,200,12\n-,100,9\n-,0,5\n",
        "run,position,deviation\n1,0,0\n1,100,4\n1,200,7\n2,200,12\n2,100,9\n2,0,5\n",
        "Target [mm],Measured [mm]\n0,0\n100,100.004\n200,200.007\n200,200.012\n100,100.009\n0,0.005\n",
        "Target [mm],Correction [um]\n0,0\n100,-4\n200,-7\n200,-12\n100,-9\n0,-5\n",
        (
            'Machine,"XYZ, 3"\nDate,3 May\n"Target","Run 1 +","Run 1'
            ' -"\n"0","0","5"\n"100","4","9"\n"200","7","12"\n'
        ),
        "Position;Vorwärts +;Rückwärts -;Mittelwert;Std Dev\n0;0;5;2.5;1\n100;4;9;6.5;1\n200;7;12;9.5;1\n",
        "Soll [mm]\tIst [mm]\n0\t0\n100\t100.004\n200\t200.007\n200\t200.012\n100\t100.009\n0\t0.005\n",
        "Position,up,down\n[mm],[um],[um]\n0,0,5\n100,4,9\n200,7,12\n",
        "\ufeffposition [in],error [um]\r\n0,0\r\n3.937007874015748,4\r\n",
    ],
)
def test_every_shape_of_a_pass_there_and_back_gives_the_same_runs(text: str) -> None:
    answers = KNOWN if "[" not in text or "[um]" in text.split("\n")[1] else MeasurementAnswers()
    if "[in]" in text:
        measurement = read_measurement(text, MeasurementAnswers(sign="measured-target"))
        assert float(measurement.runs[0].points[1][0]) == pytest.approx(100)
        assert measurement.runs[0].points[1][1] == Fraction(4, 1000)
        return
    assert runs(read_measurement(text, answers)) == THERE_AND_BACK


RTL = """HEADER::
File Type:RTL
Owner:Renishaw

TARGET DATA::
Filetype: Linear
Target-count: 3
Targets :
 0.0000  100.0000
 200.0000
Flags: 0

USER-TEXT::
Machine: mill
Axis: X

RUNS::
Run-count: 2

DEVIATIONS::
Run Target Data:
 1    1    0.000
 1    2    4.000
 1    3    7.000
 2    3    12.000
 2    2    9.000
 2    1    5.000

ENVIRONMENT::
"""


def test_a_file_of_a_renishaw_laser_has_targets_in_mm_and_deviations_in_micrometres() -> None:
    measurement = read_measurement(RTL, MeasurementAnswers())
    assert runs(measurement) == THERE_AND_BACK
    assert measurement.assumed == ("sign",)
    assert "Renishaw" in measurement.notes[0]


@pytest.mark.parametrize(
    ("old", "new", "named"),
    [
        ("Target-count: 3", "Target-count: 4", "target-count"),
        ("Run-count: 2", "Run-count: 4", "run-count"),
        (" 2    1    5.000\n", " 2    4    5.000\n", "no target 4"),
        (" 2    1    5.000\n", " 2    2    5.000\n", "target 2 twice"),
        (" 2    1    5.000\n", " 2    1    5,000\n", "is not run, target and deviation"),
    ],
)
def test_a_damaged_file_of_a_laser_is_refused(old: str, new: str, named: str) -> None:
    with pytest.raises(MeasurementError, match=named):
        read_measurement(RTL.replace(old, new), KNOWN)


def test_degrees_of_a_laser_are_asked_and_not_taken_for_lengths() -> None:
    measurement = read_measurement(RTL.replace("Linear", "Angular"), MeasurementAnswers(), "deg")
    assert measurement.assumed == ("unit", "error_unit", "sign")


def test_what_has_no_answer_is_listed() -> None:
    assert read_measurement("0,0\n100,4\n", MeasurementAnswers()).assumed == ("unit", "error_unit", "sign")
    assert read_measurement("position [mm],error [um]\n0,0\n100,4\n", MeasurementAnswers()).assumed == (
        "sign",
    )
    assert read_measurement("target [mm],measured\n0,0\n100,100.1\n", MeasurementAnswers()).assumed == ()
    assert read_measurement("0,0\n100,4\n", KNOWN).assumed == ()


def test_an_error_that_is_target_less_measured_is_turned_round() -> None:
    turned = read_measurement("0,0\n100,4\n", MeasurementAnswers("mm", "um", "target-measured"))
    assert turned.runs[0].points[1] == (100, Fraction(-4, 1000))


@pytest.mark.parametrize("sign", ["measured-target", "target-measured"])
def test_a_column_that_names_its_sign_is_not_overruled(sign: str) -> None:
    text = "position,measured\n0,0\n100,100.1\n" if sign[0] == "t" else "position,correction\n0,0\n100,0.1\n"
    with pytest.raises(MeasurementError, match=f"not {sign}"):
        read_measurement(text, MeasurementAnswers("mm", "mm", sign))


def test_arc_seconds_belong_to_degrees() -> None:
    found = read_measurement(
        "position [deg],error [arcsec]\n0,0\n90,3.6\n", MeasurementAnswers(sign="measured-target"), "deg"
    )
    assert found.unit == "deg"
    assert found.runs[0].points[1] == (90, Fraction(1, 1000))


# -- decimal commas -------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    [
        "0,000;0,001\n100,000;0,004\n",
        "0,000 0,001\n100,000 0,004\n",
        "0,000\t0,001\n100,000\t0,004\n",
        "position;error\n0,0;0,001\n100,0;0,004\n",
    ],
)
def test_a_decimal_comma_is_refused_until_a_user_confirms_it(text: str) -> None:
    with pytest.raises(MeasurementError, match="decimal"):
        read_measurement(text, KNOWN)
    confirmed = read_measurement(text, MeasurementAnswers("mm", "mm", "measured-target", "comma"))
    assert runs(confirmed) == [(True, [(0, 0.001), (100, 0.004)])]


@pytest.mark.parametrize(
    "text",
    [
        "0,000,0,001\n100,000,0,004\n",  # decimal commas that separate, too
        "0,000\n100,004\n",
        "position,error\n0,0\n100,5,1\n",
    ],
)
def test_commas_that_could_be_either_are_refused(text: str) -> None:
    with pytest.raises(MeasurementError):
        read_measurement(text, KNOWN)


def test_a_point_is_refused_where_the_decimal_sign_is_a_comma() -> None:
    with pytest.raises(MeasurementError, match="has a point"):
        read_measurement("0;0\n100;0.004\n", MeasurementAnswers("mm", "mm", "measured-target", "comma"))


# -- runs -----------------------------------------------------------------------------------------


def test_passes_follow_each_other_in_one_column() -> None:
    up, down = "0,0\n100,1\n200,2\n", "200,3\n100,2\n0,1\n"
    assert [run.rising for run in read_measurement(up + down + up + down, KNOWN).runs] == [
        True,
        False,
        True,
        False,
    ]
    assert [run.rising for run in read_measurement(up + up + up, KNOWN).runs] == [True, True, True]
    assert [run.rising for run in read_measurement(down + down, KNOWN).runs] == [False, False]


def test_a_turning_point_that_is_measured_once_belongs_to_the_run_that_reached_it() -> None:
    found = runs(read_measurement("0,0\n100,1\n200,2\n100,5\n0,6\n", KNOWN))
    assert [(rising, [at for at, _ in points]) for rising, points in found] == [
        (True, [0, 100, 200]),
        (False, [0, 100]),
    ]


def test_several_readings_at_each_target_are_several_runs() -> None:
    found = runs(read_measurement("0,0\n0,1\n0,2\n100,4\n100,5\n100,6\n", KNOWN))
    assert [[by * 1000 for _, by in points] for _, points in found] == [[0, 4], [1, 5], [2, 6]]


def test_a_target_twice_in_a_run_is_refused() -> None:
    with pytest.raises(MeasurementError, match="target 0 twice"):
        read_measurement("position,up,down\n0,0,1\n100,1,2\n0,2,3\n", KNOWN)


# -- refused --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "named"),
    [
        ("", "no line of numbers"),
        ("position,error\n", "no line of numbers"),
        ("0,0\n", "two positions"),
        ("0,0\n100,x\n", "line 2: 'x' is no number"),
        ("0,0\n100,nan\n", "'nan' is no number"),
        ("0,0\n100,inf\n", "'inf' is no number"),
        ("0,0\n100,1e99\n", "too large"),
        ("0,0\n100,1e999\n", "is no number"),
        ("0,0\n100," + "1" * 50 + "\n", "is no number"),
        ("0,0\n100\n", "line 2: 1 cells"),
        ("0,0,1\n100,1,2\n", "3 columns without heads"),
        ("time,error\n0,0\n100,1\n", "name one position"),
        ("position,position,error\n0,0,0\n1,1,1\n", "name one position"),
        ("position,dir,error\n0,x,0\n100,+,1\n", "'x' is no direction"),
        ("position,error 1 [mm],error 2 [um]\n0,0,0\n1,1,1\n", "several units"),
        ("position [deg],error [mm]\n0,0\n1,1\n", "do not belong together"),
        ("0,0\n100,\0\n", "no text"),
        ("0,0\n" + "1" * 10_001, "more than 10000 characters"),
    ],
)
def test_what_cannot_be_read_is_named_with_its_line(text: str, named: str) -> None:
    with pytest.raises(MeasurementError, match=named):
        read_measurement(
            text,
            MeasurementAnswers(
                error_unit="" if "deg" in text or "mm]" in text else "mm", sign="measured-target"
            ),
        )


@pytest.mark.parametrize(
    "answers",
    [
        MeasurementAnswers("km"),
        MeasurementAnswers("mm", "ly"),
        MeasurementAnswers(sign="+"),
        MeasurementAnswers(decimal="."),
    ],
)
def test_an_answer_that_is_none_is_refused(answers: MeasurementAnswers) -> None:
    with pytest.raises(MeasurementError, match="of measured points"):
        read_measurement("0,0\n1,1\n", answers)


def test_what_would_take_minutes_is_refused_at_once() -> None:
    with pytest.raises(MeasurementError, match="more than 1000 runs"):
        read_measurement("0,0\n" * 1_001 + "1,0\n", KNOWN)
    with pytest.raises(MeasurementError, match="too many"):
        read_measurement("\n".join(f"{n},0" for n in range(10_001)), KNOWN)
    with pytest.raises(MeasurementError, match="100001 lines"):
        read_measurement("0,0\n" * 100_001, KNOWN)


def test_a_line_of_units_below_the_heads_answers_for_them() -> None:
    found = read_measurement("Position,Error\nin,um\n0,0\n1,4\n", MeasurementAnswers(sign="measured-target"))
    assert found.assumed == ()
    assert found.runs[0].points[1] == (Fraction("25.4"), Fraction(4, 1000))


def test_means_are_read_where_there_is_nothing_else_and_spreads_never() -> None:
    text = "Position,Bidirectional Avg Error,Std Dev\n0,0,1\n100,4,1\n"
    assert runs(read_measurement(text, KNOWN)) == [(True, [(0, 0), (100, 0.004)])]
    with pytest.raises(MeasurementError, match="what was measured there"):
        read_measurement("Position,Std Dev\n0,1\n100,1\n", KNOWN)


@pytest.mark.parametrize("coding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_a_file_is_read_in_the_codings_of_spreadsheets(coding: str, tmp_path: Path) -> None:
    path = tmp_path / "laser.csv"
    path.write_bytes("Position [mm],Error [µm]\r\n0,0\r\n100,4\r\n".encode(coding))
    found = read_measured_file(path, MeasurementAnswers(sign="measured-target"))
    assert runs(found) == [(True, [(0, 0), (100, 0.004)])]
