"""Spindles of the real 9/PC: which of their parameters are active goes by the axis that is the spindle."""

import pytest

from amp_studio.schema import Evaluation, Value

ANALOG = {
    "axis.type": "spindle",
    "servo.hardware_type": "sercos",
    "servo.loop_type": "analog",
    "servo.position_port": "j9",
    "servo.spindle_type": "s1",
}
DIGITAL = ANALOG | {"servo.loop_type": "digital", "servo.position_port": "j4", "servo.velocity_port": "j4"}
TWO_DEVICES = DIGITAL | {"servo.position_port": "j9"}
THIRD_PARTY = ANALOG | {"servo.loop_type": "sercos"}

ORIENTED = ("marker_calibration", "orient_angle", "orient_inposition_band")
"""What only a spindle with position feedback has a use for (page 12-10)."""


@pytest.fixture
def evaluation(ninepc, machine):
    """Return what builds a machine: its axes one after the other, then other values."""

    def build(*axes: dict[str, str], **own: Value) -> Evaluation:
        values = {f"{name}@{n}": Value(text) for n, axis in enumerate(axes, 1) for name, text in axis.items()}
        own = {name.replace("__", ".").replace("_of_", "@"): value for name, value in own.items()}
        return machine(ninepc, values | own).evaluation

    return build


def state(evaluation: Evaluation, name: str, instance: str = "") -> str:
    return evaluation.state((name, instance)).state


@pytest.mark.parametrize(
    ("number", "expected"),
    [
        ("70", "spindle.deviation_filter_time@1"),
        ("875", "spindle.deviation_filter_time@2"),
        ("784", "spindle.gain@1.8"),
        ("785", "spindle.gain@2.1"),
        ("760", "tapping.max_speed@1.8"),
        ("761", "tapping.max_speed@2.1"),
        ("889", "tapping.acceleration_time@1.8"),
        ("812", "tapping.acceleration_time@2.1"),
        ("837", "spindle.voltage_at_max@2.8"),
        ("920", "spindle.min_speed@2.1"),
        ("917", "spindle.max_speed@1.8"),
        ("592", "sync.follower_orientation@"),
    ],
)
def test_a_number_names_spindle_and_gear(evaluation, number: str, expected: str) -> None:
    """Pages 12-5 to 12-15, 13-5 to 13-15, 27-2, 27-3, 37-3."""
    name, _, instance = expected.partition("@")
    assert evaluation(ANALOG, ANALOG | {"servo.spindle_type": "s2"}).find(number) == (name, instance)


def test_a_spindle_that_no_axis_is_does_not_exist(evaluation) -> None:
    """Page 7-82; what is left over on an axis that is no spindle does not count."""
    one = evaluation(ANALOG)
    assert state(one, "spindle.gear_count", "1") == "in-force"
    assert state(one, "spindle.gear_count", "2") == "hidden"
    assert state(one, "tapping.max_speed", "1.1") == "in-force"
    assert state(one, "tapping.max_speed", "2.1") == "hidden"
    second = evaluation({"axis.type": "linear"}, ANALOG | {"servo.spindle_type": "s2"})
    assert state(second, "spindle.max_speed", "2.1") == "in-force"
    assert state(second, "spindle.min_speed", "1.1") == "hidden"
    assert state(evaluation(ANALOG | {"axis.type": "linear"}), "spindle.gear_count", "1") == "hidden"


def test_gears_beyond_the_number_used_are_ignored(evaluation) -> None:
    """Page 12-8; gear 1 stays even where the number is missing or wrong."""
    here = evaluation(ANALOG, spindle__gear_count_of_1=Value(3))
    for name in (
        "spindle.min_speed",
        "spindle.max_speed",
        "spindle.voltage_at_max",
        "spindle.gain",
        "tapping.acceleration_time",
        "tapping.max_speed",
    ):
        states = [state(here, name, f"1.{gear}") for gear in range(1, 9)]
        assert states == ["in-force"] * 3 + ["ignored"] * 5, name
    assert state(evaluation(ANALOG), "spindle.max_speed", "1.8") == "in-force"
    none = evaluation(ANALOG, spindle__gear_count_of_1=Value(0))
    assert state(none, "spindle.max_speed", "1.1") == "in-force"


def test_a_spindle_on_a_1394_module_has_one_gear_and_no_voltage(evaluation) -> None:
    """Page 7-79."""
    here = evaluation(TWO_DEVICES, spindle__gear_count_of_1=Value(2))
    assert state(here, "spindle.gear_count", "1") == "ignored"
    assert state(here, "spindle.voltage_at_max", "1.1") == "ignored"
    for name in ("spindle.max_speed", "spindle.min_speed", "spindle.gain", "tapping.max_speed"):
        assert (state(here, name, "1.1"), state(here, name, "1.2")) == ("in-force", "ignored")


@pytest.mark.parametrize(
    ("axis", "expected"),
    [
        (ANALOG, "in-force"),
        (ANALOG | {"servo.velocity_port": "j9"}, "in-force"),
        (ANALOG | {"servo.position_port": "none"}, "ignored"),
        (DIGITAL, "ignored"),
        (DIGITAL | {"servo.position_port": "none"}, "ignored"),
        (TWO_DEVICES, "in-force"),
        (THIRD_PARTY | {"servo.position_port": "none"}, "in-force"),
        ({k: v for k, v in DIGITAL.items() if not k.endswith("_port")}, "in-force"),
    ],
)
def test_orient_to_an_angle_takes_position_feedback(evaluation, axis: dict[str, str], expected: str) -> None:
    """Pages 7-79, 12-5 and 12-10; speed and direction also serve an open-loop orient (pages 12-3 and
    12-13).
    """
    here = evaluation(axis)
    names = [f"spindle.{name}" for name in (*ORIENTED, "deviation_tolerance")]
    assert {state(here, name, "1") for name in names} == {expected}
    assert state(here, "spindle.gain", "1.1") == expected
    assert {state(here, f"spindle.orient_{name}", "1") for name in ("speed", "direction")} == {"in-force"}


def test_the_gear_that_scales_the_dac_monitor_is_there_without_a_spindle(evaluation) -> None:
    """Pages A-4 and A-5: the spindles are unfitted for tuning, but 820 and 910, 830 and 930 scale the
    output.
    """
    for monitor, spindle, other in (("2", "1", "2"), ("3", "2", "1")):
        here = evaluation({"axis.type": "linear"}, **{f"patch__dac_monitor_of_{monitor}": Value(101)})
        for name in ("spindle.voltage_at_max", "spindle.max_speed"):
            states = [state(here, name, gear) for gear in (f"{spindle}.1", f"{spindle}.2", f"{other}.1")]
            assert states == ["in-force", "hidden", "hidden"]
        assert state(here, "spindle.min_speed", f"{spindle}.1") == "hidden"
    off = evaluation({"axis.type": "linear"}, patch__dac_monitor_of_2=Value(0))
    assert state(off, "spindle.max_speed", "1.1") == "hidden"


def test_a_third_party_spindle_keeps_voltage_and_ramp_in_its_drive(evaluation) -> None:
    """Page 12-2."""
    here = evaluation(THIRD_PARTY)
    assert state(here, "spindle.voltage_at_max", "1.1") == "ignored"
    assert state(here, "spindle.dac_ramping", "1") == "ignored"
    assert state(here, "spindle.max_speed", "1.1") == "in-force"
    assert state(evaluation(ANALOG), "spindle.dac_ramping", "1") == "in-force"


def test_synchronization_takes_two_spindles_and_a_pair(evaluation) -> None:
    """Pages 14-1 and 14-2."""
    second = ANALOG | {"servo.spindle_type": "s2"}
    assert state(evaluation(ANALOG), "sync.controlling_spindle") == "ignored"
    assert state(evaluation(second), "sync.controlling_spindle") == "ignored"
    pair = {"sync__controlling_spindle": Value("s1"), "sync__follower_spindle": Value("s2")}
    both = evaluation(ANALOG, second, **pair)
    assert {state(both, f"sync.{name}") for name in ("controlling_spindle", "gain")} == {"in-force"}
    for name in pair:
        half = evaluation(ANALOG, second, **(pair | {name: Value("none")}))
        assert (state(half, "sync.follower_spindle"), state(half, "sync.gain")) == ("in-force", "ignored")
