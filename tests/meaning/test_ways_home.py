"""Machines that are homed without a switch, and travel that a grblHAL does not limit."""

from pathlib import Path

import pytest

from amp_studio.assignments import read_assignments
from amp_studio.cli import run
from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.meaning import Migration, TargetError, migrate
from amp_studio.meaning.migration import less_safe


def other(name: str, values: dict[str, str]) -> ParameterFile:
    """Return an example with other values."""
    file = open_file(next((examples_folder() / name).glob("*.amp"))).file
    file.set_checked(read_assignments(file, values.items()), force="a mutation")
    return file


def settings(found: Migration) -> dict[str, str]:
    text = next(iter(found.written.texts.values()))
    return dict(line.split("=", 1) for line in text.splitlines() if line.startswith("$"))


def grade(found: Migration, param: str) -> str:
    return next(entry.outcome for entry in found.entries if entry.param == param)


@pytest.mark.parametrize(
    ("name", "values", "lost"),
    [
        ("mill-1394", {"1570": "dcm"}, "homing over distance-coded markers"),
        ("mill-1394", {"1570": "hiperface-absolute"}, "the position that is known without homing"),
        ("mill-1394", {"1570": "aqb-no-marker"}, "homing as it was"),
        ("num-1060-mill", {"P34N0": "0x06000000"}, "homing over distance-coded markers"),
        ("num-1060-mill", {"P34N0": "0x02000000"}, "the position that is known without homing"),
        ("syntec-mill", {"Pr961": "index-only"}, "homing to a marker without a switch"),
    ],
)
def test_an_axis_without_a_home_switch_is_not_homed_by_a_grblhal_and_has_no_limits_there(
    name: str, values: dict[str, str], lost: str
) -> None:
    found = migrate(other(name, values), "grblhal")
    written = settings(found)
    assert int(written["$23"]) & 1 == 0
    assert "$190" not in written
    assert "$130" not in written
    assert lost in {str(entry.facts.get("loses")) for entry in found.of("not_possible")}
    (unlimited,) = [text for text in less_safe(found) if "checks only axes that are homed" in text]
    assert "X" in unlimited.partition(":")[0].split(", ")
    (order,) = [q.question for q in found.written.asked if q.id == "home.order"]
    assert "X" not in order.partition("(")[2].partition(")")[0]


@pytest.mark.parametrize(
    "values", [{"1330": "6 mm"}, {"1020": "no"}], ids=["home at the other end", "no overtravel"]
)
def test_a_travel_that_is_not_known_is_asked_for_as_0_is_no_limit(values: dict[str, str]) -> None:
    """With $130=0 the firmware neither limits nor homes an axis that goes straight (machine_limits.c,
    settings.c).
    """
    file = other("mill-1394", values)
    found = migrate(file, "grblhal")
    assert "travel.X" in [question.id for question in found.written.open]
    assert "$130" not in settings(found)
    assert settings(migrate(file, "grblhal", {"travel.X": "400.00049"}))["$130"] == "400"


def test_a_limit_beyond_home_that_is_missing_leaves_the_other_one() -> None:
    file = other("mill-1394", {})
    file.set(file.find("1320"), None)
    assert settings(migrate(file, "grblhal"))["$130"] == "506"
    file.set(file.find("1330"), None)
    assert "travel.X" in [question.id for question in migrate(file, "grblhal").written.open]


def test_jogs_end_at_the_limits_too() -> None:
    assert settings(migrate(other("mill-1394", {}), "grblhal"))["$40"] == "1"


def test_an_absolute_encoder_gets_what_it_reports_at_zero() -> None:
    """Measured on 2.9.0~pre1: the position after homing is that of the encoder and HOME_OFFSET, and nothing
    moves.
    """
    file = other("mill-1394", {"1570": "hiperface-absolute"})
    asked = [question.id for question in migrate(file, "linuxcnc").written.open]
    assert "home.encoder.X" in asked
    found = migrate(file, "linuxcnc", {"home.encoder.X": "-12.5"})
    joint = found.written.texts["MILL_1394.ini"].partition("[JOINT_0]")[2].partition("\n[")[0]
    assert "HOME_ABSOLUTE_ENCODER = 2" in joint
    assert "HOME_OFFSET = 12.5" in joint
    assert "HOME_SEARCH_VEL" not in joint
    assert (grade(found, "1010"), grade(found, "1310")) == ("exact", "not_possible")


def test_a_scale_with_coded_markers_is_not_homed_by_a_linuxcnc() -> None:
    found = migrate(other("mill-1394", {"1570": "dcm"}), "linuxcnc")
    joint = found.written.texts["MILL_1394.ini"].partition("[JOINT_0]")[2].partition("\n[")[0]
    assert "HOME_USE_INDEX" not in joint
    assert "HOME_SEARCH_VEL" not in joint
    assert grade(found, "1010") == "not_possible"


def test_an_axis_that_turns_in_an_unknown_unit_is_refused() -> None:
    """The guide of AcroMill knows no axis that turns (page 60): -28 of A would have been 711 mm."""
    with pytest.raises(TargetError, match="Axis A turns by its name"):
        migrate(other("acromill-router", {"axes.name@Y": "a"}), "linuxcnc")


def test_a_joint_without_a_gain_follows_at_full_speed() -> None:
    """With a gain of 50 alone a jog of a router (133 mm/s) lagged 2.7 mm and tripped at the 1 mm that a
    LinuxCNC takes where FERROR is not known.
    """
    routers, mill = (
        migrate(other(name, {}), "linuxcnc").written.texts for name in ("grblhal-router", "mill-1394")
    )
    assert "setp pid.0.FF1 1\n" in routers["machine.hal"]
    assert "setp pid.0.FF1 [JOINT_0]FF1\n" in mill["machine.hal"]


@pytest.mark.parametrize(
    ("name", "values", "sign"),
    [
        ("num-1060-mill", {}, "above 0"),
        ("num-1060-mill", {"P20N0": "0x00000001"}, "below 0"),
        ("acromill-router", {}, "below 0"),
        ("acromill-router", {"axes.dac_polarity@X": "neg"}, "above 0"),
        ("mill-1394", {}, None),
        ("syntec-mill", {}, None),
    ],
)
def test_the_sign_of_the_output_is_graded_where_a_page_prints_it(
    name: str, values: dict[str, str], sign: str | None
) -> None:
    """NUM P20 (6-12) and the DAC polarity of AcroMill (114); a digital drive and a Syntec have none."""
    written = migrate(other(name, values), "linuxcnc").written
    found = [g for g in written.graded if (g.axis, g.concept) == ("X", "output.sign")]
    assert [(g.outcome, g.value) for g in found] == [("approximate", sign)] * bool(sign)
    assert "OUTPUT_SCALE =" not in next(iter(written.texts.values()))


def test_work_offsets_reference_points_and_tools_go_along() -> None:
    texts = migrate(other("acromill-router", {"work.system_2@Z": "-2.5 in"}), "linuxcnc").written.texts
    rows = dict(line.split("\t") for line in texts["ROUTER.var"].splitlines())
    assert [rows[n] for n in ("5221", "5222", "5223")] == ["-660.400000", "-660.400000", "-152.400000"]
    assert (rows["5243"], rows["5161"], rows["5181"]) == ("-63.500000", "0.000000", "-355.600000")
    assert texts["tool.tbl"].startswith("T1 P1 D85.801200\nT2 P2 D83.725004\n")


def test_no_speed_is_asked_for_an_axis_that_searches_nothing() -> None:
    found = migrate(other("num-1060-mill", {"P34N0": "0x02000000"}), "linuxcnc")  # Z has a coded scale
    speeds = {question.id for question in found.written.asked if question.id.startswith("home.speed.")}
    assert speeds == {"home.speed.Y", "home.speed.B"}


PRESS = {"R0": "0x0404", "R11": "400000", "R13": "-40000", "R8": "8000"}


def test_a_57c422b_asks_how_many_counts_a_millimetre_has() -> None:
    file = other("57c422b-label-press", PRESS)
    assert grade(migrate(file, "linuxcnc"), "R11") == "not_possible"
    found = migrate(file, "linuxcnc", {"counts.X": "4000", "feedback.sign.X": "-"})
    joint = found.written.texts["LABEL_PRESS.ini"].partition("[JOINT_0]")[2].partition("\n[")[0]
    for line in ("MIN_LIMIT = -10", "MAX_LIMIT = 100", "FERROR = 2", "ENCODER_SCALE = -4000"):
        assert line in joint.splitlines()
    assert (grade(found, "R11"), grade(found, "R8")) == ("exact", "exact")


def test_crossed_limits_of_a_57c422b_are_no_limits() -> None:
    found = migrate(other("57c422b-label-press", PRESS | {"R11": "-50000"}), "linuxcnc", {"counts.X": "4000"})
    assert "X, Y: its travel limits are not known; none was written" in less_safe(found)


def test_a_folder_that_is_there_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = str(examples_folder() / "mill-1394" / "MILL_1394.amp")
    assert run(["migrate", path, "--to", "linuxcnc", "--draft", "-o", str(tmp_path)]) == 2
    assert "exists already: a migration gets a new name\n" in capsys.readouterr().err
