"""The check of a machine takes every scenario that a file allows, also those of one family."""

import pytest

from amp_studio.files import ParameterFile
from amp_studio.schema import Value
from amp_studio.sim import MotionCheck, check_motion, motion_check
from tests.programs.test_block import example

USUAL = motion_check.SCENARIOS


@pytest.fixture
def checks_of(monkeypatch: pytest.MonkeyPatch):
    """Return checks by scenario, with those of the usual scenarios alone that a test is about: the others
    take most of the time.
    """

    def checked(name: str, axis: str | None, *usual: str) -> dict[str, MotionCheck]:
        monkeypatch.setattr(motion_check, "SCENARIOS", {each: USUAL[each] for each in usual})
        return {each.scenario: each for each in check_motion(example(name), axis)}

    return checked


def test_gear_cam_and_backlash_of_a_module_are_checked(checks_of) -> None:
    """A geared axis jumps to the speed of a reference that is at full speed: the fault is shown,
    and doubtful, as the reference is that of a program.
    """
    found = checks_of("57c422b-label-press", "Y")
    assert {name: check.verdict for name, check in found.items()} == {
        "gear": "doubtful",
        "cam": "good",
        "backlash": "not possible",  # its command position is 0: no move
        "passive-home": "good",
    }
    assert [alarm.code for alarm in found["gear"].alarms] == ["VELOCITY ERROR"]


def test_a_hard_stop_and_a_probe_are_checked_with_the_figures_of_the_file(checks_of) -> None:
    found = checks_of("mill-1394", "1", "probe")
    assert found["hard-stop"].figures["detection_torque"] == (90.0, "%")
    assert found["probe"].figures["speed"] == (pytest.approx(250.0), "mm/min")
    assert not any("what a program does" in note for note in found["probe"].assumptions)


def test_what_a_program_gives_is_assumed_and_shown(checks_of) -> None:
    tap = checks_of("num-1060-mill", None, "tap")["tap"]
    assert (tap.verdict, tap.figures["speed"]) == ("good", (2000.0, "rpm"))
    assert tap.assumptions[0].startswith("ASSUMED: move.pitch 1.0, move.speed highest")


def test_a_loop_whose_gains_frequency_changes_is_doubtful_in_the_check_too(checks_of) -> None:
    """35.7 deg of phase margin: above what is acute, below what a sound axis keeps."""
    found = checks_of("57c422b-label-press", "X", "frequency", "velocity")
    assert found["frequency"].verdict == "doubtful"
    assert found["frequency"].why.startswith("The position loop has too little margin: Ms 2.02")
    assert found["velocity"].verdict == "good"  # its velocity loop is sound


def test_an_axis_that_no_scenario_can_move_is_one_row(checks_of) -> None:
    found = checks_of("mill-1394", "5", "step", "home", "jog")
    assert {name: check.verdict for name, check in found.items()} == {"every": "not possible"}
    assert "spindle" in found["every"].why


@pytest.fixture
def mill() -> ParameterFile:
    return example("mill-1394")


def travel_of(file: ParameterFile, monkeypatch: pytest.MonkeyPatch) -> MotionCheck:
    monkeypatch.setattr(motion_check, "SCENARIOS", {"travel": USUAL["travel"]})
    return next(each for each in check_motion(file, "1") if each.scenario == "travel")


def test_both_ends_of_the_travel_are_checked(mill: ParameterFile, monkeypatch: pytest.MonkeyPatch) -> None:
    check = travel_of(mill, monkeypatch)
    assert (check.figures["limit"][0], check.figures["limit_minus"][0]) == (8.0, -500.0)
    assert len(check.alarms) == 2


def test_a_travel_that_is_too_short_for_the_speed_is_met_with_less(
    mill: ParameterFile, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The axis began beyond the other end of its travel."""
    mill.set(("zone.overtravel_negative", "1"), Value(5.0, "mm"))
    check = travel_of(mill, monkeypatch)
    assert 0.0 < (check.figures["overrun"][0] or 0.0) < 5.0
    assert 0.0 < (check.figures["overrun_minus"][0] or 0.0) < 5.0


@pytest.mark.parametrize(
    ("name", "slip", "scenario", "axis", "named"),
    [
        (
            "mill-1394",
            {("servo.velocity_proportional_gain", "1"): Value(60000)},
            "step",
            "1",
            "servo.velocity_proportional_gain",
        ),
        (
            "mill-1394",
            {("servo.max_torque_negative", "1"): Value(20, "%")},
            "travel",
            "1",
            "servo.max_torque_negative",
        ),
        (
            "mill-1394",
            {("home.g28_direction", "1"): Value("minus")},
            "home",
            "1",
            "home.direction_off_switch",
        ),
        ("grblhal-router", {("homing.pull_off", ""): Value(0.01, "mm")}, "home", "Z", "homing.pull_off"),
        ("grblhal-router", {("limits.soft", ""): Value("no")}, "travel", "X", "limits.soft"),
    ],
)
def test_what_is_not_good_leads_to_its_parameter(
    checks_of, name: str, slip: dict, scenario: str, axis: str, named: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = example(name)
    for address, value in slip.items():
        file.set(address, value)
    monkeypatch.setattr(motion_check, "SCENARIOS", {scenario: USUAL[scenario]})
    found = next(each for each in check_motion(file, axis) if each.scenario == scenario)
    assert found.verdict in ("bad", "not possible")
    assert named in found.params


@pytest.mark.parametrize(
    ("name", "axis", "turned"),
    [
        (
            "mill-1394",
            "1",
            {("home.g28_direction", "1"): "minus", ("home.direction_off_switch", "1"): "positive"},
        ),
        ("num-1060-mill", "0", {("travel.homing_negative", ""): 2}),
        (
            "linuxcnc-mill",
            "X",
            {("joint.home_search_velocity", "0"): -20.0, ("joint.home_latch_velocity", "0"): 2.0},
        ),
    ],
)
def test_a_homing_in_the_wrong_direction_is_doubtful(
    name: str, axis: str, turned: dict[tuple[str, str], object], monkeypatch: pytest.MonkeyPatch
) -> None:
    """`check` was silent: the switch is on the other end of the travel, from which the axis runs away."""
    monkeypatch.setattr(motion_check, "SCENARIOS", {"home": USUAL["home"]})
    file = example(name)

    def home() -> MotionCheck:
        return next(each for each in check_motion(file, axis) if each.scenario == "home")

    assert home().verdict == "good"
    for address, value in turned.items():
        unit = "mm/s" if isinstance(value, float) else ""
        file.set(address, Value(value, unit))
    assert home().verdict == "doubtful"
    assert "from the rest it goes away from it" in home().why
    assert {parameter for parameter, _ in turned} <= set(home().params)


@pytest.mark.parametrize(
    ("name", "axis", "words"),
    [("grblhal-router", "X", "on which side of the machine"), ("num-1060-mill", "0", "in no parameter")],
)
def test_what_no_value_can_show_is_named(
    name: str, axis: str, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """$23 turns the travel with the homing, and P11 is made of figures that no parameter has."""
    monkeypatch.setattr(motion_check, "SCENARIOS", {"home": USUAL["home"]})
    (home,) = [each for each in check_motion(example(name), axis) if each.scenario == "home"]
    assert any(words in note for note in home.assumptions)
